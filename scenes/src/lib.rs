//! What is rendered: scenes, shapes, media, cameras, environments, and the
//! form in which every renderer is asked and answers.
//!
//! Data only. Nothing here bends light and nothing here knows a GPU: the two
//! renderers, `reference` and `realtime`, share these descriptions and no
//! optics, so that their agreement means something.

pub mod air;
pub mod builtin;
pub mod camera;
mod columns;
pub mod crack;
pub mod deform;
pub mod distance;
pub mod environment;
pub mod eta;
pub mod export;
pub mod format;
pub mod generate;
pub mod image;
pub mod import;
pub mod layer;
pub mod materials;
pub mod medium;
pub mod mesh;
pub mod noise;
pub mod normals;
pub mod obj;
mod plain;
pub mod plan;
mod pose;
mod proxy;
pub mod rendering;
pub mod scene;
pub mod shape;
pub mod topology;

pub use builtin::{Builtin, builtin, builtins, find};
pub use camera::{Camera, Projection, Ray};
pub use environment::{Cube, Environment};
pub use eta::Eta;
pub use format::{Error, load, parse};
pub use layer::{Layer, LayerName, Layers};
pub use medium::{Dispersion, Medium, MediumId};
pub use mesh::Mesh;
pub use plan::Plan;
pub use rendering::{Rendering, View};
pub use scene::{Object, Scene, Surface};
pub use shape::Shape;
