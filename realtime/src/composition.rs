//! Which pieces of WGSL make up a frame, and what follows from them: the passes,
//! the buffers, and what is left out.

use crate::geometry::{Formula, Geometry};
use crate::method::{Method, Settings};
use crate::wgsl::{Piece, Shader};
use crate::{Error, Request};
use scenes::{Camera, Environment, LayerName, Projection};

macro_rules! piece {
    ($name:literal) => {
        Piece::new($name, include_str!(concat!("shaders/", $name)))
    };
}

/// A buffer of the surfaces that a raster pass can write.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) struct Target {
    pub(crate) name: &'static str,
    pub(crate) format: wgpu::TextureFormat,
    pub(crate) channels: u32,
    wgsl_type: &'static str,
    value: &'static str,
}

const RGBA: wgpu::TextureFormat = wgpu::TextureFormat::Rgba32Float;
const R: wgpu::TextureFormat = wgpu::TextureFormat::R32Float;

const fn target(name: &'static str, rgba: bool, value: &'static str) -> Target {
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

/// Everything the front pass can write.
const FRONT: [Target; 5] = [
    target("front_normal", true, "vec4f(normalize(v.normal_ws), v.body)"),
    target("front_depth", false, "depth_of_m(v.p_lc)"),
    target("front_geometric", true, "vec4f(v.geometric_ws, 1.0)"),
    target("front_vector", true, "vec4f(v.vector_ws, 1.0)"),
    target("front_thickness", false, "v.thickness_m"),
];

/// Everything the back pass can write.
const BACK: [Target; 2] = [
    target("back_normal", true, "vec4f(normalize(v.normal_ws), 1.0)"),
    target("back_depth", false, "depth_of_m(v.p_lc)"),
];

/// What a peeling pass writes as colour: nothing. A raster pass must have a target.
const STORED: Target = Target {
    name: "no colour",
    format: wgpu::TextureFormat::R8Unorm,
    channels: 1,
    wgsl_type: "vec4f",
    value: "store_interface(v)",
};

/// Images that the shading pass can write.
pub(crate) const OUTPUTS: [&str; 5] = ["radiance", "exit", "first", "hit2", "count"];

/// A raster pass over the bodies.
pub(crate) struct Surfaces {
    pub(crate) name: &'static str,
    pub(crate) targets: Vec<Target>,
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
    /// All of them, without a depth test.
    All,
}

/// The passes that collect and sort every interface of a pixel.
pub(crate) struct Peel {
    pub(crate) count: Surfaces,
    pub(crate) collect: Surfaces,
    pub(crate) sort: Shader,
}

/// A frame, as far as it can be known without a GPU.
pub(crate) struct Composition {
    pub(crate) shade: Shader,
    pub(crate) outputs: Vec<&'static str>,
    pub(crate) front: Surfaces,
    pub(crate) back: Option<Surfaces>,
    pub(crate) peel: Option<Peel>,
}

/// How the environment is looked up.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Filter {
    /// By hand, with the exact renderer's formula: judged images.
    Manual,
    /// By the hardware's sampler: timed frames.
    Hardware,
}

impl Composition {
    pub(crate) fn new(
        method: &Method,
        settings: &Settings,
        scene: &scenes::Scene,
        camera: &Camera,
        geometry: &Geometry,
        request: &Request,
        outputs: Vec<&'static str>,
    ) -> Result<Self, Error> {
        let camera_piece = camera_piece(camera);
        let method_pieces = (method.pieces)(settings)?;
        let mut pieces = vec![piece!("frame.wgsl"), camera_piece.clone(), piece!("interface.wgsl")];
        pieces.push(match (&scene.environment, request.filter) {
            (Environment::Uniform(_), _) => piece!("environment_uniform.wgsl"),
            (_, Filter::Manual) => piece!("environment_manual.wgsl"),
            (_, Filter::Hardware) => piece!("environment_sampler.wgsl"),
        });
        pieces.extend([piece!("front.wgsl"), piece!("back.wgsl"), piece!("shade.wgsl")]);
        let pack =
            if geometry.nested { piece!("pack_nested.wgsl") } else { piece!("pack_single.wgsl") };
        let media =
            if geometry.nested { piece!("media_nested.wgsl") } else { piece!("media_single.wgsl") };
        pieces.extend([pack.clone(), piece!("layers.wgsl"), media, piece!("march.wgsl")]);
        pieces.push(if geometry.smooth {
            piece!("geometric_stored.wgsl")
        } else {
            piece!("geometric_same.wgsl")
        });
        pieces.push(piece!("first_event.wgsl"));
        pieces.push(if geometry.absorbs {
            piece!("absorb.wgsl")
        } else {
            piece!("absorb_none.wgsl")
        });
        pieces.extend(reflection(settings));
        pieces.push(outputs_piece(&outputs));
        pieces.extend(method_pieces);
        let shade = Shader::link(&pieces)?;
        let wanted =
            |target: &Target| shade.uses(&["shade"], target.name) || asked(request, target.name);
        let front: Vec<Target> = FRONT.into_iter().filter(wanted).collect();
        let back: Vec<Target> = BACK.into_iter().filter(wanted).collect();
        let vector = vector_piece(method, settings);
        let mut head = vec![piece!("frame.wgsl"), camera_piece];
        head.extend(vector);
        let surfaces = |name, targets, sides| Surfaces::new(name, targets, sides, &head, geometry);
        let farthest = settings.word_if_any("back_select") != Some("nearest");
        let peel = if shade.uses(&["shade"], "slot_counts") {
            let sort = Shader::link(&[piece!("frame.wgsl"), piece!("peel_sort.wgsl")])?;
            let store = |name, store: Vec<Piece>| {
                let head: Vec<Piece> = head.iter().cloned().chain(store).collect();
                Surfaces::new(name, vec![STORED], Sides::All, &head, geometry)
            };
            Some(Peel {
                count: store("count layers", vec![piece!("peel_count.wgsl")])?,
                collect: store("collect layers", vec![pack, piece!("peel_slots.wgsl")])?,
                sort,
            })
        } else {
            None
        };
        Ok(Self {
            front: surfaces("front", front, Sides::Front)?,
            peel,
            back: if back.is_empty() {
                None
            } else {
                Some(surfaces("back", back, Sides::Back { farthest })?)
            },
            shade,
            outputs,
        })
    }
}

impl Composition {
    /// True if some pass reads the distance through the body.
    pub(crate) fn reads_thickness(&self) -> bool {
        self.front.targets.iter().any(|target| target.name == "front_thickness")
    }
}

fn asked(request: &Request, name: &str) -> bool {
    request.view.layers.iter().any(|layer| match layer {
        LayerName::Buffer(buffer) if buffer == "thickness" => name.ends_with("_depth"),
        LayerName::Buffer(buffer) => buffer == name,
        _ => false,
    })
}

fn camera_piece(camera: &Camera) -> Piece {
    match camera.projection {
        Projection::Perspective { .. } => piece!("camera_perspective.wgsl"),
        Projection::Orthographic { .. } => piece!("camera_orthographic.wgsl"),
    }
}

/// The reflected part: which formula, or none at all.
fn reflection(settings: &Settings) -> Vec<Piece> {
    let share = match settings.word_if_any("fresnel") {
        None | Some("none") => return vec![piece!("reflect_none.wgsl")],
        Some("eq4") => "fresnel_cubed(v_ws, surface.normal_ws)",
        Some("schlick") => {
            "fresnel_schlick(v_ws, surface.normal_ws, frame.eta_outside, bodies[surface.body].eta)"
        }
        Some(_) => {
            "fresnel_exact(v_ws, surface.normal_ws, frame.eta_outside, bodies[surface.body].eta)"
        }
    };
    let text = format!(
        "fn share_at_surface(v_ws: vec3f, surface: Surface) -> f32 {{ return {share}; }}\n"
    );
    vec![Piece::new("share at the surface", text), piece!("reflect.wgsl")]
}

/// put_NAME() writes an image that is wanted and does nothing for one that is not.
fn outputs_piece(outputs: &[&str]) -> Piece {
    let mut text = String::new();
    for (index, name) in OUTPUTS.iter().enumerate() {
        let binding = 32 + index;
        let body = if outputs.contains(name) {
            text.push_str(&format!(
                "@group(0) @binding({binding}) var out_{name}: texture_storage_2d<rgba32float, write>;\n"
            ));
            format!("textureStore(out_{name}, pixel, value);")
        } else {
            String::new()
        };
        text.push_str(&format!("fn put_{name}(pixel: vec2i, value: vec4f) {{ {body} }}\n"));
    }
    Piece::new("outputs", text)
}

/// What a vertex hands to its pixels, for the methods that bend at vertices.
fn vector_piece(method: &Method, settings: &Settings) -> Vec<Piece> {
    let index = match settings.word_if_any("index") {
        Some("ball") => "eta / max(2.0 - eta, 1e-3)",
        _ => "eta",
    };
    let body = match method.id {
        "dx7-vertex" => {
            let a = if settings.word("a") == "direct" { "n" } else { "1.0 / n" };
            format!(
                "let n = {index} / frame.eta_outside;\n    let a = {a};\n    \
                 return (1.0 - a) * dot(n_ws, -v_ws) * n_ws + v_ws;"
            )
        }
        "one-interface-vertex" => {
            format!("return bend(v_ws, n_ws, frame.eta_outside / ({index})).direction;")
        }
        _ => {
            return vec![Piece::new(
                "no vertex vector",
                "fn vertex_vector(v_ws: vec3f, n_ws: vec3f, body: u32) -> vec3f { return vec3f(0.0); }\n",
            )];
        }
    };
    let text = format!(
        "fn vertex_vector(v_ws: vec3f, n_ws: vec3f, body: u32) -> vec3f {{\n    \
         let eta = bodies[body].eta;\n    {body}\n}}\n"
    );
    vec![piece!("interface.wgsl"), Piece::new("vertex vector", text)]
}

impl Surfaces {
    fn new(
        name: &'static str,
        targets: Vec<Target>,
        sides: Sides,
        head: &[Piece],
        geometry: &Geometry,
    ) -> Result<Self, Error> {
        let link =
            |tail: Vec<Piece>| Shader::link(&head.iter().cloned().chain(tail).collect::<Vec<_>>());
        let generated = targets_piece(&targets);
        let mesh = if geometry.corners.is_empty() {
            None
        } else {
            Some(link(vec![piece!("raster_mesh.wgsl"), generated.clone()])?)
        };
        let mut formulas: Vec<Formula> = geometry.formulas();
        formulas.sort();
        formulas.dedup();
        let analytic = formulas
            .into_iter()
            .map(|formula| {
                let depth = sides != Sides::All;
                let pieces = vec![
                    analytic_piece(&targets, depth),
                    formula_piece(formula),
                    generated.clone(),
                ];
                Ok((formula, link(pieces)?))
            })
            .collect::<Result<_, Error>>()?;
        Ok(Self { name, targets, mesh, analytic, sides })
    }
}

fn formula_piece(formula: Formula) -> Piece {
    match formula {
        Formula::Sphere => piece!("intersect_sphere.wgsl"),
        Formula::Box => piece!("intersect_box.wgsl"),
        Formula::Cylinder => piece!("intersect_cylinder.wgsl"),
        Formula::HalfSpace => piece!("intersect_half_space.wgsl"),
    }
}

fn targets_piece(targets: &[Target]) -> Piece {
    let fields: String = targets
        .iter()
        .enumerate()
        .map(|(i, target)| {
            format!("    @location({i}) {}: {},\n", target.field(), target.wgsl_type)
        })
        .collect();
    let values: Vec<_> = targets.iter().map(|target| target.value).collect();
    Piece::new(
        "targets",
        format!(
            "struct Targets {{\n{fields}}}\nfn targets(v: Varyings) -> Targets {{ return Targets({}); }}\n",
            values.join(", ")
        ),
    )
}

fn analytic_piece(targets: &[Target], depth: bool) -> Piece {
    let fields: String = targets
        .iter()
        .enumerate()
        .map(|(i, target)| {
            format!("    @location({i}) {}: {},\n", target.field(), target.wgsl_type)
        })
        .collect();
    let values: Vec<_> = targets.iter().map(|target| format!("out.{}", target.field())).collect();
    let (depth_field, depth_value) =
        if depth { ("@builtin(frag_depth) depth: f32,", "clip.z / clip.w, ") } else { ("", "") };
    let text = include_str!("shaders/raster_analytic.wgsl")
        .replace("ANALYTIC_DEPTH_FIELD", depth_field)
        .replace("ANALYTIC_DEPTH_VALUE", depth_value)
        .replace("ANALYTIC_FIELDS", fields.trim_end())
        .replace("ANALYTIC_VALUES", &values.join(", "));
    Piece::new("raster_analytic.wgsl", text)
}
