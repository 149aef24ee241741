//! Scenes made in code: a solid without anything special, in white light.

use crate::scene::{Judgement, Normals, Sequence, Source};
use crate::{Camera, Environment, Medium, MediumId, Object, Scene, Shape, Surface};
use glam::{DAffine3, DVec3};
use std::sync::Arc;

impl Object {
    /// A solid of a medium where its shape says, at rest, with smooth normals and
    /// nothing inside.
    #[must_use]
    pub fn solid(name: &str, shape: impl Into<Arc<Shape>>, medium: MediumId) -> Self {
        Self {
            name: name.to_owned(),
            shape: shape.into(),
            surface: Surface::Dielectric { medium, priority: 0 },
            world_from_object: DAffine3::IDENTITY,
            normals: Normals::Smooth,
            motion: None,
            deform: None,
            bump: None,
            crack: None,
            air: None,
        }
    }
}

impl Scene {
    /// Objects in radiance 1 from everywhere, as a still. The first medium is
    /// that of the surroundings.
    #[must_use]
    pub fn in_white_light(
        name: &str,
        camera: Camera,
        media: Vec<Medium>,
        objects: Vec<Object>,
    ) -> Self {
        Self {
            name: name.to_owned(),
            title: name.to_owned(),
            source: Source::default(),
            camera,
            environment: Environment::Uniform(DVec3::ONE),
            media,
            objects,
            lights: Vec::new(),
            sequence: Sequence { frames: 1, seconds_per_frame: 1.0 },
            judgement: Judgement::default(),
            warnings: Vec::new(),
        }
    }
}
