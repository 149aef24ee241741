//! What will run for a scene, and what is left out and why: derived from the
//! composition, before anything exists on a GPU.

use crate::composition::{Composition, OUTPUTS};
use crate::geometry::{Corner, Geometry};
use crate::method::{Method, Settings};
use crate::render::{self, Part, Request};
use crate::uniforms::{self, Bodies};
use crate::{Error, Filter};
use encase::ShaderType;
use scenes::plan::{Buffer, Kind, Unsupported};
use scenes::{Environment, Plan, Scene, Surface};

/// What a method will do with a scene.
///
/// # Errors
/// If the method, a parameter or a layer is unknown.
pub fn plan(scene: &Scene, request: &Request) -> Result<Plan, Error> {
    let method = Method::find(&request.method)?;
    let settings = Settings::new(method, &request.parameters)?;
    let geometry = Geometry::new(scene, request.view.frame)?;
    let camera = render::camera(scene, request);
    let outputs = render::outputs(method, request)?;
    let mut plan = Plan::default();
    for part in render::parts(request, &outputs) {
        let (request, outputs) = (&part.request, part.outputs.clone());
        let composition =
            Composition::new(method, &settings, scene, &camera, &geometry, request, outputs)?;
        add(&mut plan, &composition, scene, &geometry, &part, None);
    }
    Ok(plan)
}

/// Adds a frame to a plan. What is left out is told once, for the first.
pub(crate) fn add(
    plan: &mut Plan,
    composition: &Composition,
    scene: &Scene,
    geometry: &Geometry,
    part: &Part,
    layers: Option<u32>,
) {
    let of_frame = of(composition, scene, geometry, &part.request, part.scale, layers);
    if part.label.is_empty() {
        *plan = of_frame;
        return;
    }
    let labelled = |name: &str| format!("{}{name}", part.label);
    plan.passes.extend(of_frame.passes.iter().map(|name| labelled(name)));
    let buffers = of_frame.buffers.iter();
    let labelled = buffers.map(|b| Buffer { name: labelled(&b.name), bytes: b.bytes });
    plan.buffers.extend(labelled);
}

/// The plan of one frame. The number of layers is counted on the GPU; before
/// that, the bytes of one layer are stated.
fn of(
    composition: &Composition,
    scene: &Scene,
    geometry: &Geometry,
    request: &Request,
    scale: u32,
    layers: Option<u32>,
) -> Plan {
    let mut plan = Plan::default();
    let [width, height] = request.view.resolution_px.map(|n| u64::from(n * scale));
    let pixels = width * height;
    plan.passes.push("front".to_owned());
    let mut add =
        |name: &str, bytes: u64| plan.buffers.push(Buffer { name: name.to_owned(), bytes });
    add("frame", uniforms::Frame::min_size().get());
    add("bodies", Bodies::min_size().get());
    match &scene.environment {
        Environment::Uniform(_) => add("uniform_radiance", 16),
        Environment::Map(map) => {
            let border = 2 * u64::from(request.filter == Filter::Manual);
            let edge = u64::from(map.cube.size_px) + border;
            let name = if border == 2 { "environment_faces" } else { "environment_cube" };
            add(name, 6 * edge * edge * 16);
        }
    }
    for output in &composition.outputs {
        add(output, pixels * 16);
    }
    if !geometry.corners.is_empty() {
        add("corners", (geometry.corners.len() * size_of::<Corner>()) as u64);
    }
    for surfaces in [Some(&composition.front), composition.back.as_ref()].into_iter().flatten() {
        for target in &surfaces.targets {
            add(target.name, pixels * 4 * u64::from(target.channels));
        }
        add(&format!("{} depth test", surfaces.name), pixels * 4);
        for _ in 0..geometry.formulas().len() {
            add("analytic", uniforms::Analytic::min_size().get());
        }
    }
    if composition.back.is_some() {
        plan.passes.push("back".to_owned());
    } else {
        let bytes = pixels * (16 + 4);
        plan.leave_out(Kind::Pass, "back", "the method does not read the surface behind", bytes);
    }
    if composition.peel.is_some() {
        for pass in ["clear layers", "collect layers", "sort layers"] {
            plan.passes.push(pass.to_owned());
        }
        let mut add =
            |name: &str, bytes: u64| plan.buffers.push(Buffer { name: name.to_owned(), bytes });
        add("slot_counts", 4 * pixels);
        // A raster pass must have a target, though nothing is written to it.
        add("no colour", pixels);
        // Both sides of every analytic body, to be counted and to be collected.
        for _ in 0..4 * geometry.formulas().len() {
            add("analytic", uniforms::Analytic::min_size().get());
        }
        let suffix = if layers.is_some() { "" } else { " (per layer)" };
        for name in ["slot_depths", "slot_normals"] {
            add(&format!("{name}{suffix}"), 4 * pixels * u64::from(layers.unwrap_or(1)));
        }
    } else {
        let reason = "the method does not look between the first and the last surface";
        plan.leave_out(Kind::Pass, "layers", reason, 8 * pixels * 2);
    }
    plan.passes.push("shade".to_owned());
    leave_out(&mut plan, composition, scene, geometry, pixels);
    let opaque =
        scene.objects.iter().any(|object| !matches!(object.surface, Surface::Dielectric { .. }));
    if opaque {
        plan.unsupported.push(Unsupported {
            what: "opaque objects".to_owned(),
            instead: "only the environment is seen through and around the bodies".to_owned(),
        });
    }
    plan
}

fn leave_out(
    plan: &mut Plan,
    composition: &Composition,
    scene: &Scene,
    geometry: &Geometry,
    pixels: u64,
) {
    if let Environment::Uniform(_) = scene.environment {
        plan.leave_out(
            Kind::Buffer,
            "environment cube",
            "the environment is uniform",
            6 * 256 * 256 * 16,
        );
    }
    if !geometry.absorbs {
        plan.leave_out(Kind::Code, "absorption", "no medium absorbs", 0);
    }
    if !geometry.smooth {
        plan.leave_out(
            Kind::Buffer,
            "front_geometric",
            "normals are flat or analytic",
            pixels * 16,
        );
    }
    if geometry.corners.is_empty() {
        plan.leave_out(Kind::Buffer, "corners", "every body is analytic", 0);
    }
    if geometry.formulas().is_empty() {
        plan.leave_out(Kind::Code, "ray against analytic bodies", "every body is a mesh", 0);
    }
    for output in OUTPUTS {
        if !composition.outputs.contains(&output) {
            plan.leave_out(Kind::Buffer, output, "nobody asked for it", pixels * 16);
        }
    }
}
