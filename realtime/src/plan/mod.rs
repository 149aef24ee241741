//! What will run for a scene, and what is left out and why: derived from the
//! composition, before anything exists on a GPU.

pub(crate) mod entries;
pub(crate) mod timing;

use crate::Error;
use crate::composition::chosen::OUTPUTS;
use crate::composition::inputs::Order;
use crate::composition::outputs::{camera, outputs};
use crate::drawn::geometry::Geometry;
use crate::drawn::uniforms;
use crate::frames::{Part, parts};
use crate::methods::{Method, Settings};
use crate::passes::Composition;
use crate::passes::peel::Counted;
use crate::plan::entries::Draft;
use crate::request::Request;
use encase::ShaderType;
use scenes::plan::{Buffer, Kind, Unsupported};
use scenes::{Environment, Plan, Scene};

/// What a method will do with a scene.
///
/// # Errors
/// If the method, a parameter or a layer is unknown.
pub fn plan(scene: &Scene, request: &Request) -> Result<Plan, Error> {
    let method = Method::find(&request.method)?;
    let settings = Settings::new(method, &request.parameters)?;
    let geometry = Geometry::new(scene, request.view.frame)?;
    let camera = camera(scene, request);
    let outputs = outputs(method, request)?;
    let mut plan = Plan::default();
    for part in parts(request, &outputs) {
        let order = Order {
            method,
            settings: &settings,
            scene,
            camera: &camera,
            geometry: &geometry,
            request: &part.request,
            outputs: &part.outputs,
            resolution_px: part.resolution_px(),
        };
        let mut geometry = geometry.clone();
        let composition = Composition::new(&order)?;
        if composition.draws_clipped_cracks() {
            geometry.clip_cracks(scene, request.view.frame);
        }
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
    layers: Option<Counted>,
) {
    let of_frame = of(composition, scene, geometry, part, layers);
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
    part: &Part,
    layers: Option<Counted>,
) -> Plan {
    let [width, height] = part.resolution_px().map(u64::from);
    let mut draft = Draft { plan: Plan::default(), pixels: width * height, geometry };
    draft.numbers();
    draft.thickness(composition);
    match &composition.backdrop {
        Some(backdrop) => draft.backdrop(backdrop, scene, part),
        None => draft.environment(scene, part.request.filter),
    }
    for output in &composition.outputs {
        draft.buffer(output, draft.pixels * 16);
    }
    draft.corners(&geometry.bodies);
    if let Some(normals) = &composition.normals {
        draft.normals(normals, part);
    }
    match &composition.front {
        Some(front) => {
            draft.surfaces(front, draft.pixels, 1);
            draft.pass("front");
        }
        None => {
            let reason = "no body is in the image";
            draft.plan.leave_out(Kind::Pass, "front", reason, draft.pixels * (16 + 4 + 4));
        }
    }
    match &composition.back {
        Some(back) => {
            draft.surfaces(back, draft.pixels, 1);
            draft.pass("back");
        }
        None => {
            let reason = "the method does not read the surface behind";
            draft.plan.leave_out(Kind::Pass, "back", reason, draft.pixels * (16 + 4));
        }
    }
    if let Some(peel) = &composition.peel {
        draft.layers(peel, layers);
    } else {
        let reason = "the method does not look between the first and the last surface";
        draft.plan.leave_out(Kind::Pass, "layers", reason, 8 * draft.pixels * 2);
    }
    if let Some(interior) = &composition.interior {
        draft.interior(interior, part.resolution_px());
    }
    draft.pass("shade");
    let Draft { mut plan, pixels, .. } = draft;
    leave_out(&mut plan, composition, scene, geometry, pixels);
    if let Some([_, _, width, height]) = composition.within_px {
        let kept = u64::from(width) * u64::from(height);
        let share = 100.0 * (1.0 - kept as f64 / pixels as f64);
        let reason = format!("the bodies lie within {width} x {height} pixels");
        let what = format!("drawing {share:.0} % of the image");
        plan.leave_out(Kind::Code, &what, &reason, 0);
    }
    if composition.index_matched {
        let reason = "the bodies have the index of what is around them: light goes straight on";
        plan.leave_out(Kind::Code, "refraction and reflection", reason, 0);
    }
    unsupported(&mut plan, composition.method, composition, geometry);
    plan
}

/// What the scene has and the method does not show.
fn unsupported(plan: &mut Plan, method: &Method, composition: &Composition, geometry: &Geometry) {
    let inside = !geometry.cracks.is_empty() || !geometry.air.is_empty();
    if inside && composition.interior.is_none() {
        plan.unsupported.push(Unsupported {
            what: "cracks and enclosed air".to_owned(),
            instead: "the inside of the body is clear".to_owned(),
        });
    }
    if geometry.opaque_in_cube.draws.len() < geometry.opaque.draws.len() {
        plan.unsupported.push(Unsupported {
            what: "an opaque solid in the middle of the bodies".to_owned(),
            instead: "it is seen around the bodies and not through them".to_owned(),
        });
    }
    if geometry.disperses && !method.traces_colours {
        plan.unsupported.push(Unsupported {
            what: "dispersion".to_owned(),
            instead: "light of all colours takes the way of the d line".to_owned(),
        });
    }
    if geometry.media.len() > 1 && composition.peel.is_none() {
        plan.unsupported.push(Unsupported {
            what: "several bodies".to_owned(),
            instead: "light bends at the nearest body and does not meet another".to_owned(),
        });
    }
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
    if !geometry.disperses {
        plan.leave_out(Kind::Code, "traces of red and blue", "no medium disperses", 0);
    }
    if !geometry.bodies.smooth {
        plan.leave_out(
            Kind::Buffer,
            "front_geometric",
            "normals are flat or analytic",
            pixels * 16,
        );
    }
    if geometry.bodies.corners.is_empty() {
        plan.leave_out(Kind::Buffer, "corners", "every body is analytic", 0);
    }
    if geometry.bodies.formulas().is_empty() {
        plan.leave_out(Kind::Code, "ray against analytic bodies", "every body is a mesh", 0);
    }
    if geometry.opaque.is_empty() {
        let reason = "nothing opaque stands around the bodies";
        plan.leave_out(Kind::Pass, "background, six faces of the cube", reason, 20 * pixels);
    }
    if geometry.cracks.is_empty() {
        plan.leave_out(Kind::Pass, "cracks", "no body is cracked", 8 * pixels);
    }
    if geometry.air.is_empty() {
        plan.leave_out(Kind::Pass, "air", "no body encloses air", 4 * pixels);
    }
    if geometry.bumps.is_none() {
        let bytes = uniforms::Bumps::min_size().get();
        plan.leave_out(Kind::Binding, "bumps", "every surface is smooth", bytes);
    }
    for output in OUTPUTS {
        if !composition.outputs.contains(&output) {
            plan.leave_out(Kind::Buffer, output, "nobody asked for it", pixels * 16);
        }
    }
}
