//! Pieces of WGSL that depend on settings, and the few that are generated.

use crate::methods::{Method, Settings};
use crate::wgsl::Piece;
use scenes::{Camera, Projection};

macro_rules! piece {
    ($name:literal) => {
        $crate::wgsl::Piece::new(
            $name,
            include_str!(concat!(env!("CARGO_MANIFEST_DIR"), "/src/shaders/", $name)),
        )
    };
}
pub(crate) use piece;

/// Images that the shading pass can write.
pub(crate) const OUTPUTS: [&str; 5] = ["radiance", "exit", "first", "hit2", "count"];

/// The precision of stored back normals.
pub(crate) fn stored_normal_piece(settings: &Settings) -> Piece {
    let body = match settings.word_if_any("back_format") {
        // What an 8-bit texture keeps of (n + 1) / 2.
        Some("8-bit") => "round((0.5 * n_ws + 0.5) * 255.0) / 127.5 - 1.0",
        _ => "n_ws",
    };
    let text = format!("fn stored_normal(n_ws: vec3f) -> vec3f {{ return {body}; }}\n");
    Piece::new("stored normal", text)
}

pub(crate) fn camera_piece(camera: &Camera) -> Piece {
    match camera.projection {
        Projection::Perspective { .. } => piece!("core/camera_perspective.wgsl"),
        Projection::Orthographic { .. } => piece!("core/camera_orthographic.wgsl"),
    }
}

/// The reflected part: which formula, or none at all.
pub(crate) fn reflection(settings: &Settings) -> Vec<Piece> {
    let share = match settings.word_if_any("fresnel") {
        None | Some("none") => return vec![piece!("shade/reflect_none.wgsl")],
        _ if settings.word_if_any("eye") == Some("vertex") => "share_of_vertices(surface.pixel)",
        Some("eq4") => "fresnel_cubed(v_ws, surface.normal_ws)",
        Some("schlick") => {
            "fresnel_schlick(v_ws, surface.normal_ws, frame.eta_outside, eta_body(surface.body))"
        }
        Some(_) => {
            "fresnel_exact(v_ws, surface.normal_ws, frame.eta_outside, eta_body(surface.body))"
        }
    };
    let text = format!(
        "fn share_at_surface(v_ws: vec3f, surface: Surface) -> f32 {{ return {share}; }}\n"
    );
    vec![Piece::new("share at the surface", text), piece!("shade/reflect.wgsl")]
}

/// put_NAME() writes an image that is wanted and does nothing for one that is not.
pub(crate) fn outputs_piece(outputs: &[&str]) -> Piece {
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
pub(crate) fn vector_piece(method: &Method, settings: &Settings) -> Vec<Piece> {
    let index = match settings.word_if_any("index") {
        Some("ball") => "eta / max(2.0 - eta, 1e-3)",
        _ => "eta",
    };
    let body = match method.id {
        "dx7-vertex" => {
            let a = if settings.word("a") == "direct" { "n" } else { "1.0 / n" };
            format!(
                "let n = {index} / frame.eta_outside;\n    let a = {a};\n    \
                 return vec4f((1.0 - a) * dot(n_ws, -v_ws) * n_ws + v_ws, 1.0);"
            )
        }
        "one-interface-vertex" => {
            format!("return vec4f(bend(v_ws, n_ws, frame.eta_outside / ({index})).direction, 1.0);")
        }
        "blended" if settings.word("eye") == "vertex" => {
            let share = match settings.word("fresnel") {
                "schlick" => "fresnel_schlick(v_ws, n_ws, frame.eta_outside, eta)",
                "exact" => "fresnel_exact(v_ws, n_ws, frame.eta_outside, eta)",
                _ => "fresnel_cubed(v_ws, n_ws)",
            };
            format!("return vec4f(v_ws, {share});")
        }
        _ => {
            return vec![no_vector_piece()];
        }
    };
    let text = format!(
        "fn vertex_vector(v_ws: vec3f, n_ws: vec3f, body: u32) -> vec4f {{\n    \
         let eta = bodies[body].eta;\n    {body}\n}}\n"
    );
    vec![piece!("core/interface.wgsl"), Piece::new("vertex vector", text)]
}

/// For passes whose vertices have nothing to hand on.
pub(crate) fn no_vector_piece() -> Piece {
    Piece::new(
        "no vertex vector",
        "fn vertex_vector(v_ws: vec3f, n_ws: vec3f, body: u32) -> vec4f { return vec4f(0.0); }\n",
    )
}
