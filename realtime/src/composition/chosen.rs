//! Which file stands for each need of the shaders that is a choice: by the scene,
//! by what was asked for, or by a word of a parameter.

use super::inputs::Inputs;
use crate::methods::Settings;
use crate::request::Filter;
use crate::wgsl::{Choices, Source};
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

/// Makes the choices that all passes share, and finds out whether the method has
/// any say.
pub(crate) fn decided(mut inputs: Inputs<'_>) -> Inputs<'_> {
    let Inputs { method, settings, .. } = inputs;
    let bends_anyway = method.bends_at_equal_index(settings);
    inputs.index_matched = !bends_anyway && inputs.is_index_matched();
    let mut choices = choices(&inputs);
    if inputs.index_matched && !method.follows_rays {
        choices.choose("method", "undeviated");
        choices.choose("reflection", "reflect_nothing");
    } else {
        choices.give("method", method.source.clone());
    }
    let at_vertices = method.at_vertices(settings).filter(|_| !inputs.index_matched);
    choices.choose("vertex_vector", at_vertices.as_deref().unwrap_or("vertex_none"));
    inputs.choices = choices;
    inputs
}

/// Every choice.
fn choices(inputs: &Inputs<'_>) -> Choices {
    let mut choices = Choices::default();
    by_parameters(inputs.settings, &mut choices);
    by_scene(inputs, &mut choices);
    if inputs.method.follows_rays {
        by_rays(inputs, &mut choices);
    }
    for output in OUTPUTS {
        let way = if inputs.outputs.contains(&output) { "out" } else { "no" };
        choices.choose(&format!("out_{output}"), &format!("{way}_{output}"));
    }
    choices
}

/// What the parameters choose. All numbers are constants in `parameters`.
fn by_parameters(settings: &Settings, choices: &mut Choices) {
    for (need, file) in WITHOUT_PARAMETER {
        choices.choose(need, file);
    }
    for (need, file) in settings.files() {
        choices.choose(need, &file);
    }
    choices.give("parameters", Source::new("parameters", settings.constants()));
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

/// What rays meet, and where they start.
fn by_rays(inputs: &Inputs<'_>, choices: &mut Choices) {
    let (geometry, rays) = (inputs.geometry, inputs.geometry.rays());
    let mut either = |need: &str, condition: bool, then: &str, otherwise: &str| {
        choices.choose(need, if condition { then } else { otherwise });
    };
    let bends = geometry.bodies.smooth || geometry.opaque.smooth || geometry.bumps.is_some();
    let apart = geometry.disperses || inputs.keeps_all();
    either("ray_tree", !rays.nodes.is_empty(), "ray_tree", "ray_tree_none");
    either("ray_analytic", !rays.analytic.is_empty(), "ray_analytic", "ray_analytic_none");
    either("ray_normals", bends, "ray_normals_smooth", "ray_normals_flat");
    either("ray_opaque", !geometry.opaque.is_empty(), "ray_opaque", "ray_opaque_none");
    either("ray_colours", apart, "ray_colours_apart", "ray_colours_together");
    either("winding", geometry.nested, "winding_nested", "winding_single");
    let whole = |name: &str, otherwise| inputs.settings.whole_if_any(name).unwrap_or(otherwise);
    let layers = inputs.outputs.iter().any(|output| *output != "radiance");
    let constants = format!(
        "const RAY_STACK: u32 = {}u;\nconst RAY_SAMPLES: u32 = {}u;\nconst RAY_SEED: u32 = {}u;\n\
         const RAY_EVENTS: u32 = {}u;\nconst RAY_CHANNELS: u32 = {}u;\nconst RAY_LAYERS: bool = {layers};\n\
         const RAY_LIGHT: bool = {};\nconst RAY_STARTS_INSIDE: bool = {};\n",
        rays.depth.max(1),
        whole("samples", 0),
        whole("seed", 0),
        whole("max_events", 1024),
        if apart { 3 } else { 1 },
        inputs.outputs.contains(&"radiance"),
        inputs.may_start_inside(),
    );
    choices.give("ray_constants", Source::new("ray_constants", constants));
}

/// How the environment is looked up: the scene's, or one that was drawn.
pub(crate) fn environment(inputs: &Inputs<'_>, drawn: bool) -> &'static str {
    match (&inputs.scene.environment, inputs.request.filter) {
        (Environment::Uniform(_), _) if !drawn => "environment_uniform",
        (_, Filter::Manual) => "environment_manual",
        (_, Filter::Hardware) => "environment_sampler",
    }
}

#[cfg(test)]
mod tests {
    #![allow(clippy::unwrap_used, reason = "a failing test may panic")]
    use super::*;
    use crate::drawn::geometry::Geometry;
    use crate::methods::METHODS;
    use crate::request::{Keep, Request};
    use crate::wgsl::{FILES, Shader};
    use scenes::View;

    /// What only some passes choose.
    const OF_PASSES: [(&str, &str); 5] = [
        ("clip", "clip_depth"),
        ("depth_interval", "interval_of_clip"),
        ("intersect", "intersect_box"),
        ("stored_interface", "peel_slots"),
        ("targets", "front_targets"),
    ];

    /// Alone with what it needs, or in the place of what was chosen for some need.
    fn is_read(file: &str, choices: &Choices) -> bool {
        let read = |choices: &Choices| Shader::compose(&[file], choices).is_ok();
        read(choices) || choices.needs().any(|need| read(&choices.with(need, file)))
    }

    /// No file is a template: with what it needs, each is WGSL.
    #[test]
    fn every_file_is_read_by_naga() {
        let mut unread: Vec<&str> = FILES.iter().map(|(name, _)| *name).collect();
        for scene in ["ice-block", "dispersion-ball"] {
            let scene = scenes::builtin(scene).unwrap();
            let geometry = Geometry::new(&scene, 0).unwrap();
            let camera = &scene.camera;
            let resolution_px = camera.resolution_px;
            let view = View { resolution_px, positions_per_axis: 1, frame: 0, layers: Vec::new() };
            for method in METHODS.iter() {
                let settings = Settings::new(method, &[].into()).unwrap();
                let request = Request {
                    view: view.clone(),
                    method: method.id.to_owned(),
                    parameters: [].into(),
                    filter: Filter::Manual,
                    timing: None,
                    keep: Keep::Needed,
                };
                let inputs = decided(Inputs {
                    method,
                    settings: &settings,
                    scene: &scene,
                    camera,
                    geometry: &geometry,
                    request: &request,
                    outputs: &OUTPUTS,
                    resolution_px,
                    choices: Choices::default(),
                    index_matched: false,
                });
                let mut choices = inputs.choices;
                OF_PASSES.iter().for_each(|(need, file)| choices.choose(need, file));
                unread.retain(|file| !is_read(file, &choices));
            }
        }
        assert!(unread.is_empty(), "{unread:?}");
    }
}
