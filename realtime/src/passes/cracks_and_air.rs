//! What is inside a body and drawn as an overlay: sheets of cracks that glitter,
//! clipped by the body's depth interval, and planes of enclosed air. Source:
//! Seipel & Nivfors, "Efficient rendering of multiple refractions and
//! reflections in natural objects", SIGRAD 2006.

use crate::Error;
use crate::composition::chosen::piece;
use crate::composition::inputs::{Order, asked};
use crate::drawn::frame_uniforms::{self, Viewed};
use crate::drawn::uniforms;
use crate::gpu::recorder::Recorder;
use crate::gpu::resources::Resources;
use crate::methods::Settings;
use crate::passes::peel;
use crate::passes::pipelines::{DrawnSurfaces, Maker};
use crate::passes::raster_pass::{Sides, Surfaces, Target, target};
use crate::wgsl::Piece;
use wgpu::{BufferUsages, TextureFormat};

/// The passes that draw the inside.
pub(crate) struct Interior {
    /// The body's depth interval, where the frame's own does not serve.
    pub(crate) clip: Option<[Surfaces; 2]>,
    pub(crate) cracks: Option<Surfaces>,
    pub(crate) air: Option<Surfaces>,
    /// Cracks drawn over the body's back normals.
    pub(crate) onto_back: Option<Surfaces>,
    /// The cracks' sheets end at the body's surface by themselves.
    pub(crate) clipped_sheets: bool,
    pub(crate) resolution_px: [u32; 2],
}

/// What decides whether a point is inside.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Clip {
    Depth,
    Layers,
    Mesh,
    None,
}

fn clip(settings: &Settings) -> Option<Clip> {
    Some(match settings.word_if_any("clip")? {
        "layers" => Clip::Layers,
        "mesh" => Clip::Mesh,
        "none" => Clip::None,
        _ => Clip::Depth,
    })
}

impl Interior {
    /// None if the scene has neither cracks nor air, or the method shows none.
    pub(crate) fn new(order: &Order<'_>, head: &[Piece]) -> Result<Option<Self>, Error> {
        let Some(clip) = clip(order.settings) else { return Ok(None) };
        let geometry = order.geometry;
        if geometry.cracks.is_empty() && geometry.air.is_empty() {
            return Ok(None);
        }
        let resolution_px = resolution_px(order, clip);
        let precise = order.settings.word("depth_format") == "float";
        // The frame's own depths serve where they are as many and as precise.
        let shared = precise && resolution_px == order.resolution_px;
        let names =
            if shared { ["front_depth", "back_depth"] } else { ["clip_front", "clip_back"] };
        let mut inside = head.to_vec();
        inside.push(piece!("inside/interior.wgsl"));
        inside.extend(clip_pieces(order, clip, names));
        let cracks = (!geometry.cracks.is_empty()).then(|| {
            let mut head = inside.clone();
            if geometry.bumps.is_none() {
                head.push(piece!("core/noise.wgsl"));
            }
            head.extend([cracks_constants(order.settings), piece!("inside/cracks.wgsl")]);
            Surfaces::new("cracks", crack_targets(order), Sides::Sum, &head, &geometry.cracks)
        });
        let air = (!geometry.air.is_empty()).then(|| {
            let mut head = inside.clone();
            if geometry.bumps.is_none() {
                head.push(piece!("core/noise.wgsl"));
            }
            head.push(piece!("inside/air.wgsl"));
            let colour =
                Target { format: TextureFormat::Rgba8Unorm, ..target("air", true, "air_light(v)") };
            Surfaces::new("air", vec![colour], Sides::Over, &head, &geometry.air)
        });
        let bends = order.settings.number("a") > 0.0;
        let onto_back = (bends && order.settings.word("crack_normals") == "back").then(|| {
            let mut head = head.to_vec();
            head.extend(depth_clip(["front_depth", "back_depth"], FLOAT_DEPTH.to_owned()));
            head.push(piece!("inside/crack_normals.wgsl"));
            let normal = vec![target("back_normal", true, "crack_normal(v)")];
            Surfaces::new("cracks onto normals", normal, Sides::Onto, &head, &geometry.cracks)
        });
        let onto_back = onto_back.filter(|_| !geometry.cracks.is_empty());
        let clip_passes = (clip == Clip::Depth && !shared).then(|| depth_passes(order, head));
        Ok(Some(Self {
            clip: clip_passes.transpose()?,
            cracks: cracks.transpose()?,
            air: air.transpose()?,
            onto_back: onto_back.transpose()?,
            clipped_sheets: clip == Clip::Mesh,
            resolution_px,
        }))
    }

    /// True if some pass reads what is called `name`.
    pub(crate) fn reads(&self, name: &str) -> bool {
        let drawn = [self.cracks.as_ref(), self.air.as_ref(), self.onto_back.as_ref()];
        let mut shaders = drawn.into_iter().flatten().filter_map(|s| s.mesh.as_ref());
        shaders.any(|shader| shader.uses(&["mesh_fragment"], name))
    }

    /// What the shading pass shows of it.
    pub(crate) fn shown(order: &Order<'_>) -> Vec<Piece> {
        let method_shows = clip(order.settings).is_some();
        let cracks = method_shows && !order.geometry.cracks.is_empty();
        let air = method_shows && !order.geometry.air.is_empty();
        let mut pieces = Vec::new();
        if cracks || air {
            pieces.push(piece!("inside/interior_lookup.wgsl"));
        }
        pieces.push(if cracks {
            piece!("inside/cracks_shown.wgsl")
        } else {
            piece!("inside/cracks_none.wgsl")
        });
        pieces.push(if air {
            piece!("inside/air_shown.wgsl")
        } else {
            piece!("inside/air_none.wgsl")
        });
        pieces
    }

    /// Its passes in the order in which they run.
    pub(crate) fn passes(&self) -> impl Iterator<Item = &Surfaces> {
        let clip = self.clip.iter().flatten();
        clip.chain(&self.cracks).chain(&self.air)
    }
}

/// Layers are those of the frame; everything else has a size of its own.
fn resolution_px(order: &Order<'_>, clip: Clip) -> [u32; 2] {
    let size = order.settings.number("interior_px") as u32;
    if size == 0 || clip == Clip::Layers || asked(order.request, "crack_mask") {
        order.resolution_px
    } else {
        [size; 2]
    }
}

fn crack_targets(order: &Order<'_>) -> Vec<Target> {
    let light = target("cracks", true, "crack_light(v)");
    let mut targets = vec![Target { format: TextureFormat::Rgba16Float, ..light }];
    if asked(order.request, "crack_mask") {
        targets.push(target("crack_mask", false, "1.0"));
    }
    targets
}

fn cracks_constants(settings: &Settings) -> Piece {
    let [shininess, strength] = ["crack_shininess", "crack_strength"].map(|n| settings.number(n));
    let text = format!(
        "const CRACK_SHININESS: f32 = {shininess:?};\nconst CRACK_STRENGTH: f32 = {strength:?};\n"
    );
    Piece::new("crack constants", text)
}

fn clip_pieces(order: &Order<'_>, clip: Clip, names: [&str; 2]) -> Vec<Piece> {
    match clip {
        Clip::Mesh | Clip::None => vec![piece!("inside/clip_none.wgsl")],
        Clip::Layers => {
            let mut pieces = vec![order.pack()];
            pieces.extend(peel::camera_pieces(order));
            pieces.extend([piece!("layers/layers.wgsl"), piece!("inside/clip_layers.wgsl")]);
            pieces
        }
        Clip::Depth => depth_clip(names, stored_depth(order)),
    }
}

/// The clip by two depth images, and how they keep depths.
fn depth_clip([front, back]: [&str; 2], stored_depth: String) -> Vec<Piece> {
    let text = include_str!("../shaders/inside/clip_depth.wgsl");
    let text = text.replace("CLIP_FRONT", front).replace("CLIP_BACK", back);
    vec![Piece::new("clip_depth.wgsl", text), Piece::new("stored depth", stored_depth)]
}

/// Off by two steps of a 32-bit number.
const FLOAT_DEPTH: &str = "fn stored_depth_m(z_m: f32) -> f32 { return z_m; }
fn depth_error_m(z_m: f32) -> f32 { return 2.4e-7 * abs(z_m); }
";

/// How a depth is kept, and how far it may then be off.
fn stored_depth(order: &Order<'_>) -> String {
    if order.settings.word("depth_format") == "float" {
        return FLOAT_DEPTH.to_owned();
    }
    let planes = if order.settings.word("depth_planes") == "fitted" {
        "vec2f(max(dot(-frame.eye_lc, frame.forward_ws) - frame.radius_m, 1e-3 * frame.radius_m), \
         dot(-frame.eye_lc, frame.forward_ws) + frame.radius_m)"
    } else {
        "vec2f(0.1, 1000.0)"
    };
    include_str!("../shaders/inside/stored_depth_16.wgsl").replace("DEPTH_PLANES", planes)
}

fn depth_passes(order: &Order<'_>, head: &[Piece]) -> Result<[Surfaces; 2], Error> {
    let mut head = head.to_vec();
    head.push(Piece::new("stored depth", stored_depth(order)));
    let bodies = &order.geometry.bodies;
    let value = "stored_depth_m(depth_of_m(v.p_lc))";
    let front = vec![target("clip_front", false, value)];
    let back = vec![target("clip_back", false, value)];
    Ok([
        Surfaces::new("clip front", front, Sides::Front, &head, bodies)?,
        Surfaces::new("clip back", back, Sides::Back { farthest: true }, &head, bodies)?,
    ])
}

/// The inside, ready to be drawn.
pub(crate) struct DrawnInterior {
    passes: Vec<DrawnSurfaces>,
    resources: Resources,
    onto_back: Option<(DrawnSurfaces, Resources)>,
}

impl DrawnInterior {
    /// Makes pipelines and memory. `shown`: the frame's resources, which get
    /// what the shading pass reads.
    pub(crate) fn new(
        bodies: &Maker<'_>,
        interior: &Interior,
        view: &Viewed<'_>,
        shown: &mut Resources,
    ) -> Result<Self, Error> {
        let allocator = bodies.allocator;
        let mut resources = Resources::default();
        let names = ["bodies", "bumps", "front_depth", "back_depth"];
        let layers = ["slot_counts", "slot_depths", "slot_normals"];
        for name in names.into_iter().chain(layers) {
            shown.share(&mut resources, name);
        }
        if interior.resolution_px == view.resolution_px {
            shown.share(&mut resources, "frame");
        } else {
            let own = Viewed { resolution_px: interior.resolution_px, ..*view };
            let bytes = uniforms::bytes_of(&frame_uniforms::numbers(&own, 0));
            let buffer = allocator.filled("frame of the inside", &bytes, BufferUsages::UNIFORM)?;
            resources.buffer("frame", buffer);
        }
        let numbers = uniforms::Interior {
            towards_light_ws: view.geometry.towards_light_ws,
            size_m: view.geometry.radius_m as f32,
        };
        let bytes = uniforms::bytes_of(&numbers);
        let buffer = allocator.filled("interior", &bytes, BufferUsages::UNIFORM)?;
        resources.buffer("interior", buffer);
        let size_px = interior.resolution_px;
        let mut passes = Vec::new();
        let bodies = bodies.clone().resized(size_px);
        for surfaces in interior.clip.iter().flatten() {
            passes.push(bodies.surfaces(surfaces, &mut resources)?);
        }
        let insides =
            [(&interior.cracks, &view.geometry.cracks), (&interior.air, &view.geometry.air)];
        for (surfaces, parts) in insides {
            if let Some(surfaces) = surfaces {
                let maker = Maker::new(bodies.gpu, allocator, parts, size_px)?;
                passes.push(maker.surfaces(surfaces, &mut resources)?);
            }
        }
        for name in ["cracks", "crack_mask", "air"] {
            resources.share(shown, name);
        }
        let onto_back = match &interior.onto_back {
            Some(surfaces) => {
                let mut own = Resources::default();
                for name in ["frame", "bodies", "bumps", "front_depth", "back_depth", "back_normal"]
                {
                    shown.share(&mut own, name);
                }
                let cracks = &view.geometry.cracks;
                let maker = Maker::new(bodies.gpu, allocator, cracks, view.resolution_px)?;
                Some((maker.surfaces(surfaces, &mut own)?, own))
            }
            None => None,
        };
        Ok(Self { passes, resources, onto_back })
    }

    pub(crate) fn record(&self, recorder: &mut Recorder<'_>) {
        if let Some((pass, own)) = &self.onto_back {
            pass.record(recorder, own);
        }
        for pass in &self.passes {
            pass.record(recorder, &self.resources);
        }
    }
}
