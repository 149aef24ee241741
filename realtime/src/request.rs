//! What a method is asked for.

use scenes::View;
use std::collections::BTreeMap;

/// What a method is asked.
#[derive(Clone, Debug)]
pub struct Request {
    /// What every renderer is asked.
    pub view: View,
    /// Id or alias of the method.
    pub method: String,
    /// Parameters as `name = value`; the others have their defaults.
    pub parameters: BTreeMap<String, String>,
    /// How the environment is looked up.
    pub filter: Filter,
    /// How long to measure, if at all.
    pub timing: Option<Timing>,
    /// Whether what the scene does not need is left out.
    pub keep: Keep,
}

impl Request {
    /// An image by a method with its default parameters, not timed.
    #[must_use]
    pub fn new(view: View, method: &str, keep: Keep) -> Self {
        Self {
            view,
            method: method.to_owned(),
            parameters: BTreeMap::new(),
            filter: Filter::Manual,
            timing: None,
            keep,
        }
    }
}

/// What of a frame is kept.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Keep {
    /// What the scene needs. Where the bodies have the index of what is around
    /// them, light goes straight on and the method's own shader does not run.
    Needed,
    /// Also, with neutral input, the surface buffers that nobody reads, stored
    /// geometric normals, absorption, traces of red and blue, refraction at equal
    /// indices, bodies and pixels outside the image: to see that the image is the
    /// same and what is saved. Cracks, air, bumps and surroundings that a scene
    /// does not have stay out.
    Everything,
}

/// How the environment is looked up.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Filter {
    /// By hand, with the exact renderer's formula: judged images.
    Manual,
    /// By the hardware's sampler: timed frames.
    Hardware,
}

/// How long frames are timed.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Timing {
    /// Frames that are not counted, at least the first.
    pub warm_up: u32,
    /// At least this long, seconds.
    pub seconds: f64,
    /// At least this many frames, unless they take ten times `seconds`.
    pub min_frames: u32,
    /// At most this many frames.
    pub max_frames: u32,
    /// k: a frame is drawn at k x k positions in each pixel, one after the other;
    /// adding them up is not timed.
    pub positions_per_axis: u32,
}

impl Default for Timing {
    fn default() -> Self {
        Self { warm_up: 2, seconds: 0.3, min_frames: 20, max_frames: 200, positions_per_axis: 1 }
    }
}
