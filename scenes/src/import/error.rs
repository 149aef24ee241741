//! What keeps a glTF file from being a scene.

/// Why a glTF file is not a scene.
#[derive(Debug, thiserror::Error)]
pub enum ImportError {
    /// The file or one of its buffers is missing or damaged.
    #[error("{file}: {source}")]
    File {
        /// As given.
        file: String,
        /// What the reader said.
        source: Box<gltf::Error>,
    },
    /// The environment that the file names cannot be read.
    #[error(transparent)]
    Environment(#[from] crate::image::Error),
    /// A value that no renderer can use.
    #[error("{file}, {place}: {what}")]
    Value {
        /// As given.
        file: String,
        /// Mesh or material.
        place: String,
        /// What is wrong and what to write instead.
        what: String,
    },
}
