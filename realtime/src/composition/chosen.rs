//! Which file stands for each need of the shaders that is a choice: by the scene,
//! by what was asked for, or by a word of a parameter.

use super::inputs::Inputs;
use crate::methods::{Settings, Value};
use crate::request::Filter;
use crate::wgsl::{Choices, Source, named};
use crate::{Error, methods::Method};
use scenes::{Environment, Projection};

/// Images that the shading pass can write.
pub(crate) const OUTPUTS: [&str; 5] = ["radiance", "exit", "first", "hit2", "count"];

/// What stands for a parameter's need where a method has no such parameter.
const WITHOUT_PARAMETER: [(&str, &str); 6] = [
    ("back_format", "back_format_32_bit"),
    ("depth_format", "depth_format_float"),
    ("eye", "eye_fragment"),
    ("fresnel", "fresnel_none"),
    ("index", "index_own"),
    ("peel_camera", "peel_camera_screen"),
];

/// Every choice.
pub(crate) fn choices(inputs: &Inputs<'_>) -> Choices {
    let mut choices = Choices::default();
    by_parameters(inputs.settings, &mut choices);
    by_scene(inputs, &mut choices);
    for output in OUTPUTS {
        let way = if inputs.outputs.contains(&output) { "out" } else { "no" };
        choices.choose(&format!("out_{output}"), &format!("{way}_{output}"));
    }
    choices
}

/// A word of a parameter chooses the file `PARAMETER_WORD`, where there is one, and
/// a number chooses `PARAMETER_zero` or `PARAMETER_nonzero`. All numbers are
/// constants in `parameters`.
fn by_parameters(settings: &Settings, choices: &mut Choices) {
    for (need, file) in WITHOUT_PARAMETER {
        choices.choose(need, file);
    }
    let mut constants = String::new();
    for (name, value) in settings.all() {
        let constant = name.to_uppercase();
        let kind = match value {
            Value::Word(word) => word.replace('-', "_"),
            Value::Number(number) => {
                constants += &format!("const {constant}: f32 = {number:?};\n");
                if *number == 0.0 { "zero".to_owned() } else { "nonzero".to_owned() }
            }
            Value::Whole(number) => {
                constants += &format!("const {constant}: u32 = {number}u;\n");
                if *number == 0 { "zero".to_owned() } else { "nonzero".to_owned() }
            }
        };
        let file = format!("{name}_{kind}");
        if named(&file).is_some() {
            choices.choose(name, &file);
        }
    }
    choices.give("parameters", Source::new("parameters", constants));
    let reflects = !matches!(settings.word_if_any("fresnel"), None | Some("none"));
    choices.choose("reflection", if reflects { "reflect" } else { "reflect_nothing" });
}

fn by_scene(inputs: &Inputs<'_>, choices: &mut Choices) {
    let (geometry, keep_all) = (inputs.geometry, inputs.keeps_all());
    let mut either = |need: &str, condition: bool, then: &str, otherwise: &str| {
        choices.choose(need, if condition { then } else { otherwise });
    };
    let perspective = matches!(inputs.camera.projection, Projection::Perspective { .. });
    either("camera", perspective, "camera_perspective", "camera_orthographic");
    either("background", inputs.draws_backdrop(), "background_drawn", "background_sky");
    either("pack", geometry.nested, "pack_nested", "pack_single");
    either("media", geometry.nested, "media_nested", "media_single");
    either("surface_normal", geometry.bumps.is_some(), "bump", "bump_none");
    let smooth = geometry.bodies.smooth || keep_all;
    either("geometric_normal", smooth, "geometric_stored", "geometric_same");
    let apart = (geometry.disperses || keep_all) && inputs.method.traces_colours;
    either("eta", apart, "eta_dispersed", "eta_single");
    either("colours", apart, "colours_apart", "colours_together");
    either("absorption", geometry.absorbs || keep_all, "absorb", "absorb_none");
    either("shown_cracks", inputs.shows_cracks(), "cracks_shown", "cracks_none");
    either("shown_air", inputs.shows_air(), "air_shown", "air_none");
    choices.choose("environment", environment(inputs, inputs.draws_backdrop()));
}

/// How the environment is looked up: the scene's, or one that was drawn.
pub(crate) fn environment(inputs: &Inputs<'_>, drawn: bool) -> &'static str {
    match (&inputs.scene.environment, inputs.request.filter) {
        (Environment::Uniform(_), _) if !drawn => "environment_uniform",
        (_, Filter::Manual) => "environment_manual",
        (_, Filter::Hardware) => "environment_sampler",
    }
}

/// Puts the method in: its file, and what it does at vertices. True if it changes
/// the image even where all indices are equal.
pub(crate) fn method(method: &Method, choices: &mut Choices) -> Result<bool, Error> {
    choices.give("method", method.source.clone());
    let files = choices.closure(&["method"])?;
    let heads: Vec<_> = files.iter().map(Source::head).collect();
    let at_vertices = heads.iter().find_map(|head| head.at_vertices.as_deref());
    choices.choose("vertex_vector", at_vertices.unwrap_or("vertex_none"));
    Ok(heads.iter().any(|head| head.bends_at_equal_index))
}
