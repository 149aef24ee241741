//! The rows.

use super::{Kind, Method, Parameter, Pieces, Settings};
use crate::Error;
use crate::wgsl::Piece;

const fn number(
    name: &'static str,
    default: f64,
    min: f64,
    max: f64,
    unit: &'static str,
    help: &'static str,
) -> Parameter {
    Parameter { name, kind: Kind::Number { default, min, max }, unit, help }
}

const fn choice(
    name: &'static str,
    words: &'static [&'static str],
    help: &'static str,
) -> Parameter {
    Parameter { name, kind: Kind::Choice(words), unit: "", help }
}

const INDEX_SCALE: Parameter = choice(
    "index",
    &["own", "ball"],
    "effective index m of the single interface: the medium's own n, or n/(2 - n), which sends a paraxial ray through a ball the right way",
);

/// Every method, simplest first.
pub static METHODS: &[Method] = &[
    Method {
        id: "undeviated",
        alias: "M0",
        title: "no refraction",
        about: "Light goes straight through. What every method must beat; exact for thin parallel plates. Seen beside the exact image, the body is simply not there.",
        bibtex: "",
        parameters: &[],
        traces_colours: false,
        pieces: Pieces::Built(|_| Ok(vec![file!("methods/undeviated.wgsl")])),
    },
    Method {
        id: "dx7-vertex",
        alias: "M1a",
        title: "fake refraction, per vertex",
        about: "The reflection formula with another factor, per vertex, interpolated without normalising. With the printed 1/n light bends the wrong way; triangles show. Beside the exact image the sky stands upright in the upper half of a ball where it should hang below, and bands follow the triangles.",
        bibtex: DX7_BIBTEX,
        parameters: &[DX7_FACTOR, INDEX_SCALE],
        traces_colours: false,
        pieces: Pieces::Built(vertex_pieces),
    },
    Method {
        id: "dx7",
        alias: "M1b",
        title: "fake refraction, per pixel",
        about: "The same formula at every pixel. Bends the wrong way with the printed 1/n; no second interface, no parallax. Beside the exact image the sky stands upright in the upper half of a ball where it should hang below.",
        bibtex: DX7_BIBTEX,
        parameters: &[DX7_FACTOR, INDEX_SCALE],
        traces_colours: false,
        pieces: Pieces::Built(|settings| {
            Ok(vec![dx7_factor(settings), effective_index(settings), file!("methods/dx7.wgsl")])
        }),
    },
    Method {
        id: "one-interface",
        alias: "M1c",
        title: "Snell's law at the first surface",
        about: "Exact at the first surface, nothing at the second: a slab turns light that it should only shift, a ball refracts half of what it should. Beside the exact image the picture in a ball is blurred by too little inversion, each face of a box shows one bent view where it should mirror, and there are no highlights.",
        bibtex: DX7_BIBTEX,
        parameters: &[INDEX_SCALE],
        traces_colours: false,
        pieces: Pieces::Built(|settings| {
            Ok(vec![effective_index(settings), file!("methods/one_interface.wgsl")])
        }),
    },
    Method {
        id: "one-interface-vertex",
        alias: "M1d",
        title: "Snell's law at the vertices",
        about: "As one-interface, but bent at the vertices and interpolated: coarse triangles show. Beside the exact image it has the faults of one-interface; on fine meshes the two cannot be told apart.",
        bibtex: DX7_BIBTEX,
        parameters: &[INDEX_SCALE],
        traces_colours: false,
        pieces: Pieces::Built(vertex_pieces),
    },
    Method {
        id: "blended",
        alias: "M2",
        title: "blended front and back normals",
        about: "One bend at a mixture of the front normal and the back normal seen through the same pixel. As printed it weakens refraction: good for ice cubes, wrong for lenses. No total reflection inside. Beside the exact image a ball is a nearly clear disc, upper faces are too bright where eq. 4 overrates the reflection, and nothing mirrors inside.",
        bibtex: "@inproceedings{SeipelNivfors2006,\n  author = {Stefan Seipel and Anders Nivfors},\n  title = {Efficient Rendering of Multiple Refractions and Reflections in Natural Objects},\n  booktitle = {SIGRAD 2006},\n  year = {2006}\n}",
        parameters: &[
            number("a", 0.33, 0.0, 1.0, "", "weight of the back normal"),
            choice("back_normal", &["outward", "inward"], "which way n_b points in eq. 1"),
            choice(
                "back_select",
                &["farthest", "nearest"],
                "which back face, where there are several",
            ),
            choice(
                "normal",
                &["normalised", "raw", "flip"],
                "what is done to the mixture: made a unit vector, left as it is, or made one and turned to the eye",
            ),
            choice("fresnel", &["eq4", "schlick", "exact", "none"], "share of the reflection"),
            choice(
                "eye",
                &["fragment", "vertex"],
                "where the viewing direction and the reflected share are found; the paper has them at vertices",
            ),
            choice("back_format", &["32-bit", "8-bit"], "precision of the stored back normals"),
            choice(
                "clip",
                &["depth", "layers", "mesh", "none"],
                "what ends cracks and air at the body's surface: its depth interval as published, all its layers, sheets cut beforehand, or nothing",
            ),
            choice(
                "crack_normals",
                &["no", "back"],
                "whether cracks also replace the back normals that bend the light",
            ),
            choice("depth_format", &["float", "16-bit"], "how the depth interval is stored"),
            choice(
                "depth_planes",
                &["fitted", "default"],
                "clip planes of a 16-bit depth: around the body, or 0.1 m and 1000 m",
            ),
            number(
                "interior_px",
                512.0,
                0.0,
                4096.0,
                "px",
                "edge of the images of cracks and air; 0: the image's own size",
            ),
            number("crack_shininess", 64.0, 8.0, 256.0, "", "exponent of the cracks' glitter"),
            number("crack_strength", 1.0, 0.0, 100.0, "", "brightness of the cracks' glitter"),
        ],
        traces_colours: false,
        pieces: Pieces::Built(blended_pieces),
    },
    Method {
        id: "two-interface",
        alias: "M3",
        title: "two interfaces in image space",
        about: "Bends at the first surface, guesses the distance to the second from two known ones, and bends again at the back normal found there. A ring of clamped total reflection near a ball's limb; wrong surfaces on concave bodies. Beside the exact image a cup looks like a solid lens, faces of a box that should mirror are one flat colour, and highlights are missing.",
        bibtex: "@inproceedings{Wyman2005,\n  author = {Chris Wyman},\n  title = {An Approximate Image-Space Approach for Interactive Refraction},\n  booktitle = {ACM SIGGRAPH 2005},\n  pages = {1050--1053},\n  year = {2005}\n}",
        parameters: &[
            choice(
                "distance",
                &["weighted", "view", "normal"],
                "how far it is to the second surface: d_V and d_N weighted by the angles, or one of them alone",
            ),
            choice(
                "back_select",
                &["farthest", "nearest"],
                "which back face, where there are several",
            ),
            choice("n2_filter", &["bilinear", "nearest"], "how the back normal is looked up"),
            choice(
                "fresnel",
                &["none", "schlick", "exact"],
                "share of the reflection; the paper has none",
            ),
        ],
        traces_colours: true,
        pieces: Pieces::Built(two_interface_pieces),
    },
    Method {
        id: "normal-cube",
        alias: "M3n",
        title: "back normals from a cube map of the body",
        about: "Bends at the first surface, takes the second normal from a cube of the body's normals in the direction of the ray, and bends again. Needs no second image of the body and no depth; the second surface is where the ray would leave from the middle, so what lies off the middle is bent wrongly. Wrong surfaces on concave bodies. Beside the exact image a ball about the middle shows what one-interface shows, for its far normals are the rays themselves.",
        bibtex: "@misc{Khan2004,\n  author = {A. Khan},\n  title = {Dual-sided Refraction Simulation},\n  note = {Shadertech contest, 2004; as described by Seipel and Nivfors, SIGRAD 2006}\n}",
        parameters: &[
            choice(
                "lookup",
                &["direction", "position"],
                "where in the cube: along the ray's direction as published, or where the ray leaves a ball about the middle",
            ),
            choice(
                "fresnel",
                &["none", "schlick", "exact"],
                "share of the reflection; the original has none",
            ),
        ],
        traces_colours: true,
        pieces: Pieces::Built(normal_cube_pieces),
    },
    Method {
        id: "multi-paper",
        alias: "M4p",
        title: "march through peeled layers, as published",
        about: "Walks from layer to layer by number, with the repairs without which the printed listing does not run. Wrong where the ray crosses an interface sideways: walls of shells, bubbles. Beside the exact image a cup is right down to its base, where the chain breaks; side faces that should mirror show one flat colour.",
        bibtex: MA_BIBTEX,
        parameters: &[
            PROBE_DIV,
            BINARY_STEPS,
            MAX_STEPS,
            MAX_EVENTS,
            MULTI_FRESNEL,
            PEEL,
            PEEL_CAMERA,
            PEEL_PX,
            MAX_LAYERS,
        ],
        traces_colours: true,
        pieces: Pieces::Built(|settings| {
            Ok(vec![march_constants(settings, false), file!("methods/multi_paper.wgsl")])
        }),
    },
    Method {
        id: "multi",
        alias: "M4r",
        title: "march through peeled layers, medium by winding",
        about: "As multi-paper, but an interface is where the medium changes, counted from the layers in front. First order in the resolution of the layers; rays that turn sideways find no layer to hit. Beside the exact image everything seen through front and back is right; what should mirror totally is one flat colour or grain, and reflections on the outside are missing.",
        bibtex: MA_BIBTEX,
        parameters: &[
            PROBE_DIV,
            BINARY_STEPS,
            MAX_STEPS,
            MAX_EVENTS,
            TIR,
            MULTI_FRESNEL,
            PEEL,
            PEEL_CAMERA,
            PEEL_PX,
            MAX_LAYERS,
        ],
        traces_colours: true,
        pieces: Pieces::Built(|settings| {
            Ok(vec![march_constants(settings, true), file!("methods/multi.wgsl")])
        }),
    },
];

const MA_BIBTEX: &str = "@misc{MaXiaoYang,\n  author = {Lei Ma and Shuangjiu Xiao and Xubo Yang},\n  title = {Multi-interfaces based Refractive Rendering},\n  note = {Shanghai Jiao Tong University}\n}";
const PROBE_DIV: Parameter =
    number("linear_probe_div", 8.0, 1.0, 64.0, "", "steps per gap between two layers");
const BINARY_STEPS: Parameter =
    number("binary_steps", 6.0, 0.0, 16.0, "", "halvings of the step that crossed an interface");
const MAX_STEPS: Parameter =
    number("max_steps", 64.0, 1.0, 4096.0, "", "steps between two interfaces");
const MAX_EVENTS: Parameter = number("max_events", 12.0, 1.0, 64.0, "", "interfaces of one chain");
const PEEL: Parameter = choice(
    "peel",
    &["slots", "everitt", "dual", "cascade", "auto"],
    "how layers are found: by atomic slots and a sort; one per pass (coincident ones are one); nearest and farthest per pass (the same; needs 32-bit float blending; of too many, keeps both ends); by an atomic cascade (needs 64-bit atomics; of too many, keeps the nearest); cascade where the adapter can, else slots (which a plan states)",
);
const MAX_LAYERS: Parameter = number(
    "max_layers",
    32.0,
    2.0,
    32.0,
    "",
    "most layers per pixel; where there are more, a flag",
);
const PEEL_CAMERA: Parameter = choice(
    "peel_camera",
    &["screen", "fitted"],
    "the camera that layers are seen with: the image's, or one of their own that holds all of the bodies, also outside the image",
);
const PEEL_PX: Parameter = number(
    "peel_px",
    0.0,
    0.0,
    8192.0,
    "px",
    "edge of a fitted camera's image; 0: the longer edge of the frame",
);
const TIR: Parameter = choice(
    "tir",
    &["clamp", "reflect"],
    "total reflection: leave along the tangent, or reflect up to four times",
);
const MULTI_FRESNEL: Parameter = choice(
    "fresnel",
    &["none", "schlick", "exact"],
    "share of the reflection at the first surface; the paper has none",
);

const DX7_BIBTEX: &str = "@misc{FakeRefraction2000,\n  title = {Approximating Refraction: Fake Refraction in DX7},\n  year = {2000},\n  note = {cube maps indexed by R = (1 - a)(N.E)N - E}\n}";

const DX7_FACTOR: Parameter =
    choice("a", &["inverse", "direct"], "1/n as printed, or n, which bends towards the normal");

macro_rules! file {
    ($name:literal) => {
        Piece::new($name, include_str!(concat!("../shaders/", $name)))
    };
}
use file;

fn effective_index(settings: &Settings) -> Piece {
    let body = match settings.word("index") {
        "ball" => "eta / max(2.0 - eta, 1e-3)",
        _ => "eta",
    };
    Piece::new(
        "effective index",
        format!("fn effective_index(eta: f32) -> f32 {{ return {body}; }}\n"),
    )
}

fn dx7_factor(settings: &Settings) -> Piece {
    let a = if settings.word("a") == "direct" { "n" } else { "1.0 / n" };
    Piece::new("dx7 factor", format!("fn dx7_a(n: f32) -> f32 {{ return {a}; }}\n"))
}

fn vertex_pieces(_: &Settings) -> Result<Vec<Piece>, Error> {
    Ok(vec![file!("methods/vertex_vector.wgsl")])
}

fn blended_pieces(settings: &Settings) -> Result<Vec<Piece>, Error> {
    let a = settings.number("a");
    let eye = match settings.word("eye") {
        "vertex" => file!("methods/eye_per_vertex.wgsl"),
        _ => file!("methods/eye_per_fragment.wgsl"),
    };
    if a == 0.0 {
        return Ok(vec![eye, file!("methods/blend_one_sided.wgsl"), file!("methods/blended.wgsl")]);
    }
    let sign = if settings.word("back_normal") == "inward" { -1.0 } else { 1.0 };
    let finish = match settings.word("normal") {
        "raw" => "mixed",
        "flip" => "normalize(select(-mixed, mixed, dot(mixed, v_ws) < 0.0))",
        _ => "normalize(mixed)",
    };
    let constants = format!(
        "const BLEND_A: f32 = {a:?};\nconst BACK_SIGN: f32 = {sign:?};\n\
         fn finish_normal(mixed: vec3f, v_ws: vec3f) -> vec3f {{ return {finish}; }}\n"
    );
    Ok(vec![
        eye,
        Piece::new("blend constants", constants),
        file!("methods/blend_two_sided.wgsl"),
        file!("methods/blended.wgsl"),
    ])
}

fn two_interface_pieces(settings: &Settings) -> Result<Vec<Piece>, Error> {
    let distance = match settings.word("distance") {
        "view" => "d_view_m",
        "normal" => "d_normal_m",
        _ => "w * d_view_m + (1.0 - w) * d_normal_m",
    };
    let guess = format!(
        "fn guessed_distance_m(w: f32, d_view_m: f32, d_normal_m: f32) -> f32 {{ return {distance}; }}\n"
    );
    let filter = match settings.word("n2_filter") {
        "nearest" => file!("methods/back_nearest.wgsl"),
        _ => file!("methods/back_bilinear.wgsl"),
    };
    Ok(vec![Piece::new("guessed distance", guess), filter, file!("methods/two_interface.wgsl")])
}

fn normal_cube_pieces(settings: &Settings) -> Result<Vec<Piece>, Error> {
    let lookup = match settings.word("lookup") {
        "position" => file!("methods/normal_lookup_position.wgsl"),
        _ => file!("methods/normal_lookup_direction.wgsl"),
    };
    Ok(vec![lookup, file!("methods/normal_cube.wgsl")])
}

fn march_constants(settings: &Settings, winding: bool) -> Piece {
    let mut text = format!(
        "const LINEAR_PROBE_DIV: f32 = {:?};\nconst BINARY_STEPS: u32 = {}u;\n\
         const MAX_STEPS: u32 = {}u;\nconst MAX_EVENTS: u32 = {}u;\n",
        settings.number("linear_probe_div"),
        settings.number("binary_steps"),
        settings.number("max_steps"),
        settings.number("max_events"),
    );
    if winding {
        let reflect = settings.word("tir") == "reflect";
        text += &format!(
            "const REFLECT_TOTAL: bool = {reflect};\nconst MAX_TOTAL_REFLECTIONS: u32 = 4u;\n"
        );
    }
    Piece::new("march constants", text)
}
