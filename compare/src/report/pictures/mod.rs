//! What the pictures of a report show: light, FLIP and exit angles.

pub mod colour_map;
mod picture;
mod scene_images;

pub use picture::{Picture, contact_sheet};
pub(in crate::report) use scene_images::{MethodPictures, SceneImages, ScenePictures};
