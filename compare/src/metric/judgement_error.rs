//! What makes a pair of images impossible to judge.

/// Why a pair cannot be judged at all.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
pub enum JudgementError {
    /// The sizes differ.
    #[error(
        "the reference has {}x{} pixels, the candidate {}x{}: render both at one resolution",
        reference[0], reference[1], candidate[0], candidate[1]
    )]
    Size {
        /// Width and height of the reference.
        reference: [u32; 2],
        /// Width and height of the candidate.
        candidate: [u32; 2],
    },
    /// There is no layer that both have.
    #[error("reference and candidate share neither a radiance (R,G,B) nor an exit layer")]
    NothingShared,
    /// The reference is not a picture.
    #[error("the reference is not usable: {0}")]
    Reference(String),
}
