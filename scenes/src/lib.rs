//! What is rendered: scenes, shapes, media, cameras, environments, and the
//! form in which every renderer is asked and answers.
//!
//! Data only. Nothing here bends light and nothing here knows a GPU: the two
//! renderers, `reference` and `realtime`, share these descriptions and no
//! optics, so that their agreement means something.

pub mod builtin;
pub mod camera;
pub mod deform;
pub mod environment;
pub mod export;
pub mod format;
pub mod generate;
mod ice;
pub mod image;
pub mod import;
pub mod medium;
pub mod mesh;
mod plain;
pub mod rendering;
pub mod scene;
pub mod shape;
pub mod whole;

pub use builtin::{Builtin, builtin, builtins, find};
pub use camera::{Camera, Projection, Ray};
pub use environment::{Cube, Environment};
pub use format::{Error, Overrides, load, parse};
pub use ice::{air, crack, noise};
pub use medium::{Dispersion, Medium, MediumId, eta, eta::Eta, materials};
pub use mesh::{Mesh, distance, normals, obj, topology};
pub use rendering::layer::{Layer, LayerName, Layers};

pub use rendering::{Rendering, View, layer, plan, plan::Plan};
pub use scene::{Object, Scene, Surface};
pub use shape::{Shape, box_corners};
