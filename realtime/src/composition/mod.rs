//! What passes are composed from: the decisions that follow from a request and a
//! scene before anything exists on a GPU.

pub(crate) mod chosen;
pub(crate) mod inputs;
pub(crate) mod layer_images;
pub(crate) mod outputs;
