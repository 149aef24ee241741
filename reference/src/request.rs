//! What the reference is asked for.

use crate::error::Error;
use crate::receiver::map::CausticMap;
use scenes::View;
use std::sync::Arc;

/// An exact image of a scene, and how exact.
#[derive(Clone, Debug, PartialEq)]
pub struct Request {
    /// Size, positions per pixel, frame, layers.
    pub view: View,
    /// How much of the light transport counts.
    pub level: Level,
    /// How the sum over paths is formed.
    pub estimator: Estimator,
    /// Which form of the environment map is looked up.
    pub environment_lookup: EnvironmentLookup,
    /// Physics taken away on purpose, to attribute an approximation's error.
    pub restriction: Restriction,
    /// Follow the polarisation of light (Stokes vectors) instead of averaging it
    /// away at every interface. Needs [`Estimator::Tree`] and
    /// [`Fresnel::Exact`]; without effect on [`Level::R0`].
    pub polarised: bool,
    /// What light is made of where media disperse it.
    pub spectrum: Spectrum,
    /// Light on a receiver, straight and through glass, in place of the direct
    /// light that shades it otherwise. For [`Level::R2`].
    pub caustics: Option<Arc<CausticMap>>,
    /// How far every event of a chain is off: to see which chains rounding decides.
    /// Without effect on trees and paths.
    pub disturbance: Disturbance,
    /// Whether the tracer is specialised to the scene.
    pub keep: Keep,
}

/// What is done to each event of a chain, the camera's first: the ray that leaves it
/// starts aside, along the surface, and is turned aside.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Disturbance {
    /// The angle in radians, 0 to 1e-3, and the shift as a share of the position's
    /// largest coordinate. 0: nothing.
    pub share: f64,
    /// Of the sides to which the events are disturbed.
    pub seed: u64,
}

/// What of the tracer is compiled in. The image is the same, bit by bit.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Keep {
    /// What the scene and the request need.
    #[default]
    Needed,
    /// Everything: for tests of what is left out otherwise.
    Everything,
}

/// Which light arrives.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Level {
    /// One chain: always transmitted, reflected only when totally reflected; no
    /// Fresnel weights, environment only.
    R0,
    /// The full tree of refractions and reflections, environment only.
    R1,
    /// R1 and opaque surroundings.
    R2,
}

/// What light is made of.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Spectrum {
    /// The C, d and F lines in place of red, green and blue, as on the GPU.
    Channels,
    /// This many wavelengths across the visible spectrum, [`FEWEST_WAVELENGTHS`]
    /// to 1024.
    Wavelengths(u32),
}

/// Fewer do not tell the three channels apart well.
pub const FEWEST_WAVELENGTHS: u32 = 8;

/// How the sum over paths is formed.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Estimator {
    /// Follows both continuations of every event. The weaker one is dropped
    /// when its weight falls below `cut`; what was dropped is reported in the
    /// `truncated` layer.
    Tree {
        /// Weight of a branch, of 1 per camera ray.
        cut: f64,
    },
    /// Random paths, of which the mean has no bias.
    Paths(Paths),
}

/// Random paths.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Paths {
    /// Independent estimates, from which the variance is taken.
    pub batches: u32,
    /// Paths per batch and pixel, or per position of [`Positions::Cells`].
    pub samples: u32,
    /// Where in a pixel they start.
    pub positions: Positions,
    /// Weight, of 1 per camera ray, above which paths branch and below which
    /// they go one way at random, 0 to 1. 1: one way from the start.
    pub split: f64,
    /// Seed of the sample sequence.
    pub seed: u64,
}

impl Default for Paths {
    /// 16 batches of 16 paths through random positions, and a split weight that
    /// serves most scenes well.
    fn default() -> Self {
        Self { batches: 16, samples: 16, positions: Positions::Random, split: 1.0 / 32.0, seed: 0 }
    }
}

/// Where in a pixel random paths start.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Positions {
    /// Anywhere. Their mean is that over the pixel, without bias.
    Random,
    /// The points of one lattice, the same in every pixel, dealt out to the
    /// batches in turn; as many as a number of Fibonacci lie best. Where edges
    /// cross pixels they leave less error than random ones.
    Lattice,
    /// The centres of the view's K x K cells, as the tree's, in every batch: an
    /// estimate of the tree's own mean, and its variance.
    Cells,
}

/// Which form of the environment map is looked up.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum EnvironmentLookup {
    /// The cube that the GPU uses too: for judging approximations.
    Cube,
    /// The lat-long original: for agreement with other renderers.
    LatLong,
}

/// Reflectance formulas.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Fresnel {
    /// Fresnel's equations, unpolarised.
    #[default]
    Exact,
    /// Schlick's polynomial.
    Schlick,
    /// (1 - cos θ)³, as Seipel & Nivfors used it.
    Cubic,
}

/// Physics taken away.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Restriction {
    /// After this many interfaces light comes straight from the environment.
    pub max_interfaces: Option<u32>,
    /// Paths with more events than this are dropped (and count as truncated).
    pub max_events: u32,
    /// Reflections off the inside of a body that are not total are dropped.
    pub internal_reflection: bool,
    /// Reflectance formula.
    pub fresnel: Fresnel,
}

impl Default for Restriction {
    fn default() -> Self {
        Self {
            max_interfaces: None,
            max_events: 20_000,
            internal_reflection: true,
            fresnel: Fresnel::Exact,
        }
    }
}

impl Paths {
    /// Paths per batch and pixel with a view's K.
    pub(crate) fn per_batch(&self, k: u32) -> u32 {
        let positions = if self.positions == Positions::Cells { k.saturating_mul(k) } else { 1 };
        positions.saturating_mul(self.samples)
    }

    fn check(&self, k: u32) -> Result<(), Error> {
        let range = |name, value: String, range| Err(Error::Range { name, value, range });
        let paths = self.per_batch(k).saturating_mul(self.batches);
        if self.batches == 0 || self.samples == 0 {
            return range("batches or samples", "0".to_owned(), "at least 1");
        }
        if paths == u32::MAX {
            return range("paths per pixel", paths.to_string(), "less than 4,294,967,295");
        }
        if !(0.0..=1.0).contains(&self.split) {
            return range("split weight", self.split.to_string(), "0 to 1");
        }
        Ok(())
    }
}

impl Request {
    /// Refuses numbers that cannot be meant.
    pub(crate) fn check(&self) -> Result<(), Error> {
        let [width, height] = self.view.resolution_px;
        let range = |name, value: String, range| Err(Error::Range { name, value, range });
        if !(1..=65_536).contains(&width) || !(1..=65_536).contains(&height) {
            return range("resolution", format!("{width} x {height}"), "1 to 65536 pixels a side");
        }
        let k = self.view.positions_per_axis;
        if !(1..=256).contains(&k) {
            return range("positions per axis", k.to_string(), "1 to 256");
        }
        if !(0.0..=1e-3).contains(&self.disturbance.share) {
            return range("disturbance", self.disturbance.share.to_string(), "0 to 0.001");
        }
        let tree = matches!(self.estimator, Estimator::Tree { .. });
        if self.polarised && !(tree && self.restriction.fresnel == Fresnel::Exact) {
            let value = format!("{:?}, {:?}", self.estimator, self.restriction.fresnel);
            return range("polarised rendering by", value, "the tree with exact Fresnel equations");
        }
        if let Spectrum::Wavelengths(count) = self.spectrum
            && !(FEWEST_WAVELENGTHS..=1024).contains(&count)
        {
            return range("wavelengths", count.to_string(), "8 to 1024");
        }
        match self.estimator {
            Estimator::Tree { cut } if !(0.0..=1.0).contains(&cut) => {
                range("cut", cut.to_string(), "0 to 1")
            }
            Estimator::Tree { .. } => Ok(()),
            Estimator::Paths(paths) => paths.check(k),
        }
    }

    /// The full tree to a cut weight of 1e-4, everything on.
    #[must_use]
    pub fn new(view: View, level: Level) -> Self {
        Self {
            view,
            level,
            estimator: Estimator::Tree { cut: 1e-4 },
            environment_lookup: EnvironmentLookup::Cube,
            restriction: Restriction::default(),
            polarised: false,
            spectrum: Spectrum::Channels,
            caustics: None,
            disturbance: Disturbance::default(),
            keep: Keep::Needed,
        }
    }
}
