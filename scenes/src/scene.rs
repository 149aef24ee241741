//! A scene, resolved and checked: what both renderers receive.

use crate::topology::{NotABody, must_be_body};
use crate::{Camera, Environment, Medium, MediumId, Shape};
use glam::{DAffine3, DVec3};
use std::path::PathBuf;
use std::sync::Arc;

/// Everything that is rendered.
#[derive(Clone, Debug)]
pub struct Scene {
    /// Short name: the built-in's, or the file's stem.
    pub name: String,
    /// One line for people.
    pub title: String,
    /// Where it was read from, for provenance and content ids.
    pub source: Source,
    /// The camera of frame 0.
    pub camera: Camera,
    /// Light from infinity.
    pub environment: Environment,
    /// Media; `[0]` fills the surroundings.
    pub media: Vec<Medium>,
    /// Bodies and surroundings.
    pub objects: Vec<Object>,
    /// Lights that only opaque surfaces see.
    pub lights: Vec<Light>,
    /// How many frames, and how far apart.
    pub sequence: Sequence,
    /// How images of this scene are judged.
    pub judgement: Judgement,
    /// What the reader wants the user to know: unusual indices, repaired texels.
    pub warnings: Vec<String>,
}

/// The text a scene came from.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Source {
    /// File, if it was one.
    pub path: Option<PathBuf>,
    /// Folder that paths in the text are relative to; `None` where there is no
    /// text of a scene file, as with glTF.
    pub folder: Option<PathBuf>,
    /// TOML text.
    pub text: String,
    /// SHA-256 (hex) of the text and of every file it refers to.
    pub sha256: String,
}

/// A shape somewhere, made of something.
#[derive(Clone, Debug)]
pub struct Object {
    /// Name for messages: given, or the shape's with its position in the file.
    pub name: String,
    /// Shared by instances.
    pub shape: Arc<Shape>,
    /// What light meets there.
    pub surface: Surface,
    /// World space from object space at frame 0: scale, then rotation, then
    /// translation.
    pub world_from_object: DAffine3,
    /// Smooth or flat shading normals.
    pub normals: Normals,
    /// Movement over the sequence.
    pub motion: Option<Motion>,
    /// Change of form over the sequence (meshes only).
    pub deform: Option<Wave>,
    /// Bump map of the surface.
    pub bump: Option<Bump>,
    /// Cracks inside.
    pub crack: Option<Crack>,
    /// Enclosed air.
    pub air: Option<Air>,
}

/// What an object's surface does to light.
#[derive(Clone, Debug, PartialEq)]
pub enum Surface {
    /// The boundary of a transparent solid.
    Dielectric {
        /// What is inside.
        medium: MediumId,
        /// Where solids overlap, the highest priority decides what is there.
        priority: i32,
    },
    /// Opaque, shows this radiance whatever the light.
    Unlit {
        /// Linear R, G, B.
        radiance: Paint,
    },
    /// Opaque and diffuse, lit by the scene's lights.
    Lambert {
        /// Albedo, 0 to 1 per channel.
        albedo: Paint,
    },
}

/// Colour over an opaque surface.
#[derive(Clone, Debug, PartialEq)]
pub enum Paint {
    /// One value everywhere.
    Constant(DVec3),
    /// Two values in cubes of this edge length, in object space.
    Checker {
        /// The two colours.
        colours: [DVec3; 2],
        /// Edge length, metres.
        size_m: f64,
    },
}

/// Which normals bend light.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Normals {
    /// Interpolated: the file's, or angle-weighted means where it has none.
    Smooth,
    /// The triangle's own.
    Flat,
}

/// Movement of an object.
#[derive(Clone, Debug, PartialEq)]
pub enum Motion {
    /// Turns about an axis through the object's own origin.
    Spin {
        /// Unit axis, world space.
        axis: DVec3,
        /// Degrees per second, counter-clockwise seen against the axis.
        deg_per_s: f64,
    },
    /// Moves along straight pieces at constant time per piece; repeats.
    Path {
        /// Offsets from the rest position, metres.
        points_m: Vec<DVec3>,
        /// Seconds from one point to the next.
        seconds_per_point: f64,
    },
}

/// A travelling wave that displaces vertices along `direction`.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Wave {
    /// Displacement at the crest, metres in object space.
    pub amplitude_m: f64,
    /// Metres in object space.
    pub wavelength_m: f64,
    /// Unit vector along which the wave travels, object space.
    pub travel: DVec3,
    /// Unit vector along which vertices move, object space.
    pub direction: DVec3,
    /// Seconds per period.
    pub period_s: f64,
}

/// Procedural bump map (fBm) of a surface.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Bump {
    /// 0 to 1.
    pub amplitude: f64,
    /// Features per metre.
    pub frequency_per_m: f64,
    /// Seed of the noise.
    pub seed: u64,
}

/// Crack surfaces inside a solid.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Crack {
    /// How many, 0 to 64.
    pub count: u32,
    /// Grid points along each side of a crack, 8 to 128.
    pub grid: u32,
    /// Seed of shapes and poses.
    pub seed: u64,
}

/// Air enclosed in a solid.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Air {
    /// Textured planes of the image-space method.
    pub planes: u32,
    /// Spherical bubbles of the exact stand-in.
    pub bubbles: u32,
    /// Radius of a bubble as a share of the object's bounding-box diagonal.
    pub bubble_radius: f64,
    /// Seed of poses and positions.
    pub seed: u64,
}

/// A light that opaque surfaces see.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Light {
    /// Isotropic.
    Point {
        /// World space, metres.
        position_m: DVec3,
        /// Radiant intensity, linear R, G, B.
        intensity: DVec3,
    },
    /// Parallel.
    Directional {
        /// Unit vector in which the light travels.
        direction: DVec3,
        /// Irradiance on a surface facing it, linear R, G, B.
        irradiance: DVec3,
    },
}

/// Frames of a sequence.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Sequence {
    /// How many, at least 1.
    pub frames: u32,
    /// Time between frames, seconds.
    pub seconds_per_frame: f64,
}

/// How images are judged.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Judgement {
    /// HDR-FLIP exposures (start, stop in stops, count), pinned so that scores
    /// do not depend on noise in the reference; `None`: taken from the
    /// reference once and recorded.
    pub flip_exposures: Option<(f64, f64, u32)>,
}

impl Scene {
    /// Seconds from frame 0 to a frame.
    #[must_use]
    pub fn time_s(&self, frame: u32) -> f64 {
        f64::from(frame) * self.sequence.seconds_per_frame
    }

    /// Holds every transparent object to have an inside, at frame 0.
    ///
    /// # Errors
    /// The first that has none, why, and how to mend it.
    pub fn must_have_bodies(&self) -> Result<(), NotABody> {
        let mut transparent = self.objects.iter().filter(|object| self.medium_of(object).is_some());
        transparent.try_for_each(|object| must_be_body(&object.name, object.shape_at(0.0).mesh()))
    }

    /// Axis-aligned box around every bounded object at frame 0, world space;
    /// inverted infinities when there is none.
    #[must_use]
    pub fn bounds(&self) -> [DVec3; 2] {
        let mut bounds = [DVec3::INFINITY, DVec3::NEG_INFINITY];
        for object in &self.objects {
            let [low, high] = object.shape.bounds();
            if !(low.is_finite() && high.is_finite()) {
                continue;
            }
            for corner in 0..8 {
                let pick = |bit: u32, l: f64, h: f64| if corner >> bit & 1 == 0 { l } else { h };
                let at = DVec3::new(
                    pick(0, low.x, high.x),
                    pick(1, low.y, high.y),
                    pick(2, low.z, high.z),
                );
                let placed = object.world_from_object.transform_point3(at);
                bounds = [bounds[0].min(placed), bounds[1].max(placed)];
            }
        }
        bounds
    }

    /// Medium of a dielectric object, `None` for opaque ones.
    #[must_use]
    pub fn medium_of(&self, object: &Object) -> Option<&Medium> {
        match object.surface {
            Surface::Dielectric { medium, .. } => self.media.get(usize::from(medium.0)),
            _ => None,
        }
    }
}

impl Object {
    /// World space from object space at a time in seconds.
    #[must_use]
    pub fn world_from_object_at(&self, time_s: f64) -> DAffine3 {
        match &self.motion {
            None => self.world_from_object,
            Some(Motion::Spin { axis, deg_per_s }) => {
                let turn = DAffine3::from_axis_angle(*axis, (deg_per_s * time_s).to_radians());
                let mut placed = turn * self.world_from_object;
                placed.translation = self.world_from_object.translation;
                placed
            }
            Some(Motion::Path { points_m, seconds_per_point }) => {
                let offset = along_path(points_m, time_s / seconds_per_point);
                let mut placed = self.world_from_object;
                placed.translation += offset;
                placed
            }
        }
    }
}

/// Position on a closed polyline; `at` counts points.
fn along_path(points_m: &[DVec3], at: f64) -> DVec3 {
    let Some(first) = points_m.first() else { return DVec3::ZERO };
    let count = points_m.len();
    let index = (at.floor() as i64).rem_euclid(count as i64) as usize;
    let here = points_m.get(index).unwrap_or(first);
    here.lerp(points_m[(index + 1) % count], at - at.floor())
}
