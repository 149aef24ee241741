//! The built-in methods: which there are, simplest first, and what can be set. All
//! else about a method is in its file of WGSL, as for a user's own.

use super::{Kind, Method, Parameter};
use std::sync::LazyLock;

/// A file in `shaders/methods` (with `_` for `-`) and its parameters.
struct Row {
    id: &'static str,
    parameters: &'static [Parameter],
}

/// Every built-in method.
pub static METHODS: LazyLock<Vec<Method>> =
    LazyLock::new(|| ROWS.iter().map(|row| Method::built_in(row.id, row.parameters)).collect());

static ROWS: &[Row] = &[
    Row { id: "undeviated", parameters: &[] },
    Row { id: "dx7-vertex", parameters: &[DX7_FACTOR, INDEX_SCALE] },
    Row { id: "dx7", parameters: &[DX7_FACTOR, INDEX_SCALE] },
    Row { id: "one-interface", parameters: &[INDEX_SCALE] },
    Row { id: "one-interface-vertex", parameters: &[INDEX_SCALE] },
    Row {
        id: "blended",
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
            whole(
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
    },
    Row {
        id: "two-interface",
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
    },
    Row {
        id: "normal-cube",
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
    },
    Row {
        id: "multi-paper",
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
    },
    Row {
        id: "multi",
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
    },
    Row {
        id: "traced",
        parameters: &[
            whole(
                "samples",
                0.0,
                0.0,
                8.0,
                "",
                "ways of the light per position, chosen by chance at every interface; 0: the one that always goes through where it can",
            ),
            whole("seed", 0.0, 0.0, 4294967295.0, "", "of the chances"),
            whole(
                "max_events",
                1024.0,
                1.0,
                20000.0,
                "",
                "interfaces of one way; what needs more is dark and flagged",
            ),
        ],
    },
];

const fn number(
    name: &'static str,
    default: f64,
    min: f64,
    max: f64,
    unit: &'static str,
    help: &'static str,
) -> Parameter {
    Parameter { name, kind: Kind::Number { default, min, max, whole: false }, unit, help }
}

const fn whole(
    name: &'static str,
    default: f64,
    min: f64,
    max: f64,
    unit: &'static str,
    help: &'static str,
) -> Parameter {
    Parameter { name, kind: Kind::Number { default, min, max, whole: true }, unit, help }
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

const PROBE_DIV: Parameter =
    number("linear_probe_div", 8.0, 1.0, 64.0, "", "steps per gap between two layers");
const BINARY_STEPS: Parameter =
    whole("binary_steps", 6.0, 0.0, 16.0, "", "halvings of the step that crossed an interface");
const MAX_STEPS: Parameter =
    whole("max_steps", 64.0, 1.0, 4096.0, "", "steps between two interfaces");
const MAX_EVENTS: Parameter = whole("max_events", 12.0, 1.0, 64.0, "", "interfaces of one chain");
const PEEL: Parameter = choice(
    "peel",
    &["slots", "everitt", "dual", "cascade", "auto"],
    "how layers are found: by atomic slots and a sort; one per pass (coincident ones are one); nearest and farthest per pass (the same; needs 32-bit float blending; of too many, keeps both ends); by an atomic cascade (needs 64-bit atomics; of too many, keeps the nearest); cascade where the adapter can, else slots (which a plan states)",
);
const MAX_LAYERS: Parameter =
    whole("max_layers", 32.0, 2.0, 32.0, "", "most layers per pixel; where there are more, a flag");
const PEEL_CAMERA: Parameter = choice(
    "peel_camera",
    &["screen", "fitted"],
    "the camera that layers are seen with: the image's, or one of their own that holds all of the bodies, also outside the image",
);
const PEEL_PX: Parameter = whole(
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

const DX7_FACTOR: Parameter =
    choice("a", &["inverse", "direct"], "1/n as printed, or n, which bends towards the normal");
