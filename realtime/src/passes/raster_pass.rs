//! Raster passes, as far as they can be known without a GPU: what they draw, what
//! they write, and the shaders that follow from it.

use crate::drawn::drawables::{Drawables, Formula};
use crate::error::Error;
use crate::plan::entries::Entries;
use crate::wgsl::{Choices, Shader};
use wgpu::TextureFormat;

/// An image that a raster pass writes. What a pass could write and nobody wants is
/// not among its targets: its location stays empty.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) struct Target {
    pub(crate) name: &'static str,
    /// Of the member of `Targets` in WGSL.
    pub(crate) location: u32,
    pub(crate) format: TextureFormat,
}

impl Target {
    /// Four channels of 32 bits.
    pub(crate) const fn rgba(name: &'static str, location: u32) -> Self {
        Self { name, location, format: TextureFormat::Rgba32Float }
    }

    /// One channel of 32 bits.
    pub(crate) const fn r(name: &'static str, location: u32) -> Self {
        Self { name, location, format: TextureFormat::R32Float }
    }

    /// Bytes of an image of it.
    pub(crate) fn bytes(&self, pixels: u64) -> u64 {
        let texel = self.format.block_copy_size(None).unwrap_or(4);
        pixels * u64::from(texel)
    }
}

/// Which sides of the bodies a raster pass draws.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Sides {
    /// Those that face the eye, nearest first.
    Front,
    /// Those that face away; the farthest or the nearest of them is kept.
    Back {
        /// Keep the farthest.
        farthest: bool,
    },
    /// All of them, without a depth test and without a colour.
    All,
    /// Both sides of opaque surfaces, nearest first.
    Opaque,
    /// Both sides; the farthest is kept.
    Outermost,
    /// Both sides, nearest first, by linear depth to its last bit.
    Nearest,
    /// Both sides, without a depth test: the largest value of each channel.
    Largest,
    /// Both sides, without a depth test: colours add up.
    Sum,
    /// Both sides, without a depth test: colours cover each other in the order
    /// in which they are drawn.
    Over,
    /// Both sides, without a depth test, written over what another pass left.
    Onto,
}

impl Sides {
    /// Whether a depth test decides what is seen.
    pub(crate) fn has_depth(self) -> bool {
        matches!(
            self,
            Self::Front | Self::Back { .. } | Self::Opaque | Self::Outermost | Self::Nearest
        )
    }
}

/// The files of a raster pass.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Files {
    /// Defines `Targets` and `targets()`.
    pub(crate) targets: &'static str,
    /// Defines `analytic_fragment`; none if only triangles are drawn.
    pub(crate) analytic: Option<&'static str>,
}

/// A raster pass over some drawables.
pub(crate) struct RasterPass {
    pub(crate) name: &'static str,
    pub(crate) targets: Vec<Target>,
    /// Covers the image before anything else is drawn.
    pub(crate) behind: Option<Shader>,
    pub(crate) mesh: Option<Shader>,
    pub(crate) analytic: Vec<(Formula, Shader)>,
    pub(crate) sides: Sides,
}

impl RasterPass {
    pub(crate) fn new(
        name: &'static str,
        targets: Vec<Target>,
        sides: Sides,
        files: &Files,
        choices: &Choices,
        drawables: &Drawables,
    ) -> Result<Self, Error> {
        let choices = choices.with("targets", files.targets);
        let drawn = !drawables.corners.is_empty();
        let mesh = drawn.then(|| Shader::compose(&["raster_mesh"], &choices)).transpose()?;
        let mut formulas: Vec<Formula> = drawables.formulas();
        formulas.sort();
        formulas.dedup();
        let mut analytic = Vec::new();
        if let Some(file) = files.analytic {
            for formula in formulas {
                let choices = choices.with("intersect", intersect(formula));
                analytic.push((formula, Shader::compose(&[file], &choices)?));
            }
        }
        Ok(Self { name, targets, behind: None, mesh, analytic, sides })
    }

    /// Draws the environment behind everything. `file`: defines `sky_fragment`.
    pub(crate) fn over_sky(mut self, file: &str, choices: &Choices) -> Result<Self, Error> {
        self.behind = Some(Shader::compose(&[file], choices)?);
        Ok(self)
    }

    /// The shaders of its triangles read a global.
    pub(crate) fn reads(&self, global: &str) -> bool {
        self.mesh.as_ref().is_some_and(|shader| shader.uses(&["mesh_fragment"], global))
    }

    /// Adds its images and its depth test to a plan.
    pub(crate) fn plan(&self, entries: &mut Entries<'_>, pixels: u64) {
        for target in &self.targets {
            entries.buffer(target.name, target.bytes(pixels));
        }
        self.plan_depth_test(entries, pixels);
    }

    pub(crate) fn plan_depth_test(&self, entries: &mut Entries<'_>, pixels: u64) {
        if self.sides.has_depth() {
            entries.buffer(&self.depth_test(), pixels * 4);
        }
    }

    /// Name of its depth test's image.
    pub(crate) fn depth_test(&self) -> String {
        format!("{} depth test", self.name)
    }
}

fn intersect(formula: Formula) -> &'static str {
    match formula {
        Formula::Sphere => "intersect_sphere",
        Formula::Box => "intersect_box",
        Formula::Cylinder => "intersect_cylinder",
        Formula::HalfSpace => "intersect_half_space",
    }
}
