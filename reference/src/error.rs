//! Why an exact image cannot be made.

/// Every error says where, what, and what to do instead.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
pub enum Error {
    /// A body without an inside.
    #[error(transparent)]
    NotABody(#[from] scenes::topology::NotABody),
    /// A wavelength at which a medium has no index.
    #[error(transparent)]
    Dispersion(#[from] scenes::medium::DispersionError),
    /// More triangles than a tree can address.
    #[error("the scene has {count} triangles; the reference can hold {most}")]
    TooManyTriangles {
        /// How many there are.
        count: usize,
        /// How many a tree can hold.
        most: usize,
    },
    /// More kinds of media than the winding counts can hold.
    #[error("the scene has {0} different pairs of medium and priority; the reference can hold 256")]
    TooManyMedia(usize),
    /// A layer that is unknown, or not to be had with this request.
    #[error(
        "the reference has no layer \"{layer}\" for this scene and request\nit has {available}"
    )]
    Layer {
        /// What was asked for.
        layer: String,
        /// All there are.
        available: String,
    },
    /// Variance of something that is not an estimate.
    #[error(
        "the layer \"variance\" needs random paths in at least 2 batches, at level R1 or R2\nthe tree \
         of paths reports what it dropped in the layer \"truncated\" instead"
    )]
    NoVariance,
    /// An object that cannot receive a caustic.
    #[error(
        "object \"{object}\" {what}, so it cannot receive light\nname a diffuse box, or a mesh of two \
         triangles that make a parallelogram"
    )]
    Receiver {
        /// Name of the object.
        object: String,
        /// What it is not.
        what: String,
    },
    /// A caustic without light.
    #[error("the scene has no lights, so there is no caustic\nadd a [[light]]")]
    NoLights,
    /// Glass that light meets everywhere.
    #[error(
        "object \"{object}\" is glass without bounds, and photons would have to start everywhere\nmake \
         it a box or a cylinder that is wide enough"
    )]
    Unbounded {
        /// Name of the object.
        object: String,
    },
    /// A number outside its range.
    #[error("{name} = {value} is out of range: {range}")]
    Range {
        /// Which number.
        name: &'static str,
        /// What it was.
        value: String,
        /// What it may be.
        range: &'static str,
    },
    /// The caller asked to stop.
    #[error("stopped before the image was finished")]
    Cancelled,
}
