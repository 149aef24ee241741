//! What can go wrong, and what to do about it.

/// Why an image could not be rendered.
#[derive(Debug, thiserror::Error)]
pub enum Error {
    /// No adapter at all.
    #[error(
        "no GPU adapter was found\ninstall a Vulkan driver; without a GPU, Mesa's software driver \
         will do: on Debian and Ubuntu `apt-get install mesa-vulkan-drivers libvulkan1`"
    )]
    NoAdapter,
    /// No adapter of that name or number.
    #[error("no adapter is called \"{wanted}\"; there are: {available}")]
    UnknownAdapter {
        /// As given.
        wanted: String,
        /// What there is, numbered.
        available: String,
    },
    /// The adapter refused to open.
    #[error("adapter {adapter} cannot be opened: {reason}")]
    Open {
        /// Name.
        adapter: String,
        /// What the driver said.
        reason: String,
    },
    /// No method of that name.
    #[error("there is no method \"{wanted}\"; there are: {available}")]
    UnknownMethod {
        /// As given.
        wanted: String,
        /// Ids of all methods.
        available: String,
    },
    /// A user's file that holds no method.
    #[error("{path}: {why}")]
    MethodFile {
        /// As given.
        path: String,
        /// What is wrong and what to write instead.
        why: String,
    },
    /// A parameter that the method does not have, or a value out of its range.
    #[error("method {method}: {what}")]
    Parameter {
        /// Id of the method.
        method: String,
        /// What is wrong and what to write instead.
        what: String,
    },
    /// A layer that the method does not write.
    #[error("method {method} has no layer \"{layer}\"; it has: {available}")]
    UnknownLayer {
        /// Id of the method.
        method: String,
        /// As given.
        layer: String,
        /// What there is.
        available: String,
    },
    /// Something larger than the adapter allows.
    #[error("{what} needs {needed}, adapter {adapter} allows {allowed}; {advice}")]
    Limit {
        /// What is too large.
        what: String,
        /// Size asked for.
        needed: u64,
        /// Name.
        adapter: String,
        /// Size allowed.
        allowed: u64,
        /// What to change.
        advice: String,
    },
    /// Something that the adapter cannot do.
    #[error("{what} needs {feature}, which adapter {adapter} does not have; {instead}")]
    Feature {
        /// What was asked for.
        what: String,
        /// What the adapter lacks, by wgpu's name.
        feature: String,
        /// Name.
        adapter: String,
        /// What to write instead.
        instead: String,
    },
    /// An image that is empty, or larger than any adapter holds.
    #[error("{0}")]
    Size(String),
    /// WGSL that does not compile, with the place in the file it came from.
    #[error("{0}")]
    Shader(String),
    /// The device went away.
    #[error("adapter {adapter} was lost: {reason}\nits driver was reset or removed; run again")]
    Lost {
        /// Name.
        adapter: String,
        /// What the driver said.
        reason: String,
    },
    /// The device has too little memory.
    #[error("adapter {adapter} has too little memory; lower the resolution or the positions")]
    OutOfMemory {
        /// Name.
        adapter: String,
    },
    /// The driver reported an error during a pass.
    #[error("adapter {adapter}: {what}")]
    Device {
        /// Name.
        adapter: String,
        /// What the driver said.
        what: String,
    },
    /// A wavelength at which a medium has no index.
    #[error(transparent)]
    Dispersion(#[from] scenes::medium::DispersionError),
    /// A transparent body without an inside.
    #[error("{0}")]
    NotABody(scenes::topology::NotABody),
    /// More of something than the shaders have room for.
    #[error("a scene of {count} {what} cannot be drawn by any method; there may be {most}")]
    TooMany {
        /// What there is too much of.
        what: &'static str,
        /// How many.
        count: usize,
        /// How many there may be.
        most: usize,
    },
}
