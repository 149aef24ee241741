//! Raster passes, as far as they can be known without a GPU: what they draw, what
//! they write, and the shaders that follow from it.

use crate::Error;
use crate::composition::chosen::piece;
use crate::drawn::drawables::{Formula, Parts};
use crate::wgsl::{Piece, Shader};

/// A buffer of the surfaces that a raster pass can write.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) struct Target {
    pub(crate) name: &'static str,
    pub(crate) format: wgpu::TextureFormat,
    pub(crate) channels: u32,
    pub(crate) wgsl_type: &'static str,
    pub(crate) value: &'static str,
}

pub(crate) const RGBA: wgpu::TextureFormat = wgpu::TextureFormat::Rgba32Float;
pub(crate) const R: wgpu::TextureFormat = wgpu::TextureFormat::R32Float;

pub(crate) const fn target(name: &'static str, rgba: bool, value: &'static str) -> Target {
    if rgba {
        Target { name, format: RGBA, channels: 4, wgsl_type: "vec4f", value }
    } else {
        Target { name, format: R, channels: 1, wgsl_type: "f32", value }
    }
}

impl Target {
    /// The name as an identifier.
    fn field(&self) -> String {
        self.name.replace(' ', "_")
    }
}

/// What a peeling pass writes as colour: nothing. A raster pass must have a target.
pub(crate) const STORED: Target = Target {
    name: "no colour",
    format: wgpu::TextureFormat::R8Unorm,
    channels: 1,
    wgsl_type: "vec4f",
    value: "store_interface(v)",
};

/// A raster pass over some parts of the scene.
pub(crate) struct Surfaces {
    pub(crate) name: &'static str,
    pub(crate) targets: Vec<Target>,
    /// Covers the image before anything else is drawn.
    pub(crate) behind: Option<Shader>,
    pub(crate) mesh: Option<Shader>,
    pub(crate) analytic: Vec<(Formula, Shader)>,
    pub(crate) sides: Sides,
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

impl Surfaces {
    pub(crate) fn new(
        name: &'static str,
        targets: Vec<Target>,
        sides: Sides,
        head: &[Piece],
        parts: &Parts,
    ) -> Result<Self, Error> {
        let link =
            |tail: Vec<Piece>| Shader::link(&head.iter().cloned().chain(tail).collect::<Vec<_>>());
        let generated = targets_piece(&targets, sides);
        let mesh = if parts.corners.is_empty() {
            None
        } else {
            Some(link(vec![piece!("raster/raster_mesh.wgsl"), generated.clone()])?)
        };
        let mut formulas: Vec<Formula> = parts.formulas();
        formulas.sort();
        formulas.dedup();
        let analytic = formulas
            .into_iter()
            .map(|formula| {
                let pieces = vec![
                    analytic_piece(&targets, sides),
                    formula_piece(formula),
                    generated.clone(),
                ];
                Ok((formula, link(pieces)?))
            })
            .collect::<Result<_, Error>>()?;
        Ok(Self { name, targets, behind: None, mesh, analytic, sides })
    }
}

fn formula_piece(formula: Formula) -> Piece {
    match formula {
        Formula::Sphere => piece!("raster/intersect_sphere.wgsl"),
        Formula::Box => piece!("raster/intersect_box.wgsl"),
        Formula::Cylinder => piece!("raster/intersect_cylinder.wgsl"),
        Formula::HalfSpace => piece!("raster/intersect_half_space.wgsl"),
    }
}

impl Target {
    /// Bytes of an image of it.
    pub(crate) fn bytes(&self, pixels: u64) -> u64 {
        let texel = self.format.block_copy_size(None).unwrap_or(4);
        pixels * u64::from(texel)
    }
}

impl Surfaces {
    /// Draws the environment behind everything. `head`: camera and environment;
    /// `values`: what the targets hold there.
    pub(crate) fn over_sky(mut self, head: &[Piece], values: &str) -> Result<Self, Error> {
        let text = format!(
            "@fragment\nfn sky_fragment(@builtin(position) at: vec4f) -> Targets {{\n    \
             return Targets({values});\n}}\n"
        );
        let mut pieces = head.to_vec();
        pieces.extend([piece!("raster/sky.wgsl"), structure_piece(&self.targets, self.sides)]);
        pieces.push(Piece::new("sky fragment", text));
        self.behind = Some(Shader::link(&pieces)?);
        Ok(self)
    }
}

/// Linear depth as a depth test keeps it, if that is what decides. The scale is
/// a power of two: no bit is lost.
fn exact_depth(sides: Sides) -> [&'static str; 2] {
    match sides {
        Sides::Nearest => {
            ["@builtin(frag_depth) exact_depth: f32,", "depth_of_m(v.p_lc) * 0x1p-64f, "]
        }
        _ => ["", ""],
    }
}

/// The structure that a pass writes.
fn structure_piece(targets: &[Target], sides: Sides) -> Piece {
    let field = |(i, target): (usize, &Target)| {
        format!("    @location({i}) {}: {},\n", target.field(), target.wgsl_type)
    };
    let fields: String = targets.iter().enumerate().map(field).collect();
    Piece::new(
        "target structure",
        format!("struct Targets {{\n{}\n{fields}}}\n", exact_depth(sides)[0]),
    )
}

fn targets_piece(targets: &[Target], sides: Sides) -> Piece {
    let values: Vec<_> = targets.iter().map(|target| target.value).collect();
    let structure = structure_piece(targets, sides).text;
    let text = format!(
        "{structure}fn targets(v: Varyings) -> Targets {{ return Targets({}{}); }}\n",
        exact_depth(sides)[1],
        values.join(", ")
    );
    Piece::new("targets", text)
}

fn analytic_piece(targets: &[Target], sides: Sides) -> Piece {
    let fields: String = targets
        .iter()
        .enumerate()
        .map(|(i, target)| {
            format!("    @location({i}) {}: {},\n", target.field(), target.wgsl_type)
        })
        .collect();
    let values: Vec<_> = targets.iter().map(|target| format!("out.{}", target.field())).collect();
    let (depth_field, depth_value) = match sides {
        Sides::Nearest => (exact_depth(sides)[0], "out.exact_depth, "),
        sides if sides.has_depth() => ("@builtin(frag_depth) depth: f32,", "clip.z / clip.w, "),
        _ => ("", ""),
    };
    let text = include_str!("../shaders/raster/raster_analytic.wgsl")
        .replace("ANALYTIC_DEPTH_FIELD", depth_field)
        .replace("ANALYTIC_DEPTH_VALUE", depth_value)
        .replace("ANALYTIC_FIELDS", fields.trim_end())
        .replace("ANALYTIC_VALUES", &values.join(", "));
    Piece::new("raster_analytic.wgsl", text)
}
