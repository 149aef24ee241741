//! What will run for a scene, and what is left out and why: derived from the
//! composition, before anything exists on a GPU.

use crate::backdrop::{Backdrop, FACES};
use crate::composition::Composition;
use crate::geometry::Geometry;
use crate::interior::Interior;
use crate::method::{Method, Settings};
use crate::normals;
use crate::order::Order;
use crate::outputs::{camera, outputs};
use crate::part::{Part, parts};
use crate::parts::{Corner, Parts};
use crate::peel::{Counted, Peel};
use crate::pieces::OUTPUTS;
use crate::request::Request;
use crate::surfaces::Surfaces;
use crate::tally::THICKNESS;
use crate::uniforms::{self, Bodies};
use crate::{Error, Filter};
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

/// A plan in the making.
struct Draft<'a> {
    plan: Plan,
    pixels: u64,
    geometry: &'a Geometry,
}

impl Draft<'_> {
    fn pass(&mut self, name: &str) {
        self.plan.passes.push(name.to_owned());
    }

    fn buffer(&mut self, name: &str, bytes: u64) {
        self.plan.buffers.push(Buffer { name: name.to_owned(), bytes });
    }

    fn numbers(&mut self) {
        self.buffer("frame", uniforms::Frame::min_size().get());
        self.buffer("bodies", Bodies::min_size().get());
        if self.geometry.bumps.is_some() {
            self.buffer("bumps", uniforms::Bumps::min_size().get());
        }
    }

    fn thickness(&mut self, composition: &Composition) {
        if !composition.reads_thickness() {
            let reason = "the method does not read distances through the body";
            self.plan.leave_out(Kind::Pass, THICKNESS, reason, 4 * self.pixels);
        } else if self.geometry.deforms {
            self.pass(THICKNESS);
        } else {
            let reason = "no body deforms: measured once, before the first frame";
            self.plan.leave_out(Kind::Pass, THICKNESS, reason, 0);
        }
    }

    fn environment(&mut self, scene: &Scene, filter: Filter) {
        match &scene.environment {
            Environment::Uniform(_) => self.buffer("uniform_radiance", 16),
            Environment::Map(map) => {
                let border = 2 * u64::from(filter == Filter::Manual);
                let edge = u64::from(map.cube.size_px) + border;
                let name = if border == 2 { "environment_faces" } else { "environment_cube" };
                self.buffer(name, 6 * edge * edge * 16);
            }
        }
    }

    fn corners(&mut self, parts: &Parts) {
        if !parts.corners.is_empty() {
            self.buffer("corners", (parts.corners.len() * size_of::<Corner>()) as u64);
        }
    }

    /// Images of a raster pass, its depth test and its analytic bodies.
    fn surfaces(&mut self, surfaces: &Surfaces, pixels: u64, sides: usize) {
        for target in &surfaces.targets {
            self.buffer(target.name, target.bytes(pixels));
        }
        self.depth_test(surfaces, pixels);
        self.analytic(&self.geometry.bodies, sides);
    }

    fn depth_test(&mut self, surfaces: &Surfaces, pixels: u64) {
        if surfaces.sides.has_depth() {
            self.buffer(&format!("{} depth test", surfaces.name), pixels * 4);
        }
    }

    fn analytic(&mut self, parts: &Parts, times: usize) {
        for _ in 0..times * parts.formulas().len() {
            self.buffer("analytic", uniforms::Analytic::min_size().get());
        }
    }

    fn layers(&mut self, peel: &Peel, layers: Option<Counted>) {
        self.plan.passes.extend(peel.passes(layers));
        self.plan.buffers.extend(peel.buffers(layers));
        // Both sides of every analytic body, to be counted and to be collected.
        self.analytic(&self.geometry.bodies, 4);
    }

    fn backdrop(&mut self, backdrop: &Backdrop, scene: &Scene, part: &Part) {
        self.buffer("surroundings", uniforms::Surroundings::min_size().get());
        self.environment(scene, part.request.filter);
        self.corners(&self.geometry.opaque);
        self.corners(&self.geometry.opaque_in_cube);
        let edge = u64::from(backdrop.edge_px());
        self.buffer("drawn cube", 6 * edge * edge * 16);
        for target in &backdrop.background.targets {
            self.buffer(target.name, target.bytes(self.pixels));
        }
        self.depth_test(&backdrop.background, self.pixels);
        for _ in FACES {
            self.buffer("frame of a face", uniforms::Frame::min_size().get());
            self.depth_test(&backdrop.face, edge * edge);
        }
        // Both sides, for the camera and for every face.
        self.analytic(&self.geometry.opaque, 2);
        self.analytic(&self.geometry.opaque_in_cube, 2 * FACES.len());
        self.pass("background");
        if self.geometry.changes || !part.is_timed() {
            FACES.iter().for_each(|face| self.pass(face));
        } else {
            let reason = "nothing moves: the cube was drawn before the first frame";
            self.plan.leave_out(Kind::Pass, "six faces of the cube", reason, 0);
        }
    }

    fn normals(&mut self, surfaces: &Surfaces, part: &Part) {
        let pixels = u64::from(normals::SIZE_PX).pow(2);
        self.buffer("normal_faces", 6 * pixels * 16);
        for _ in normals::FACES {
            self.buffer("frame of a face", uniforms::Frame::min_size().get());
            self.depth_test(surfaces, pixels);
        }
        // Both sides, for every face.
        self.analytic(&self.geometry.bodies, 2 * normals::FACES.len());
        if self.geometry.changes || !part.is_timed() {
            normals::FACES.iter().for_each(|face| self.pass(face));
        } else {
            let reason = "nothing moves: the normals were drawn before the first frame";
            self.plan.leave_out(Kind::Pass, "six faces of normals", reason, 0);
        }
    }

    fn interior(&mut self, interior: &Interior, frame_px: [u32; 2]) {
        let pixels = interior.resolution_px.map(u64::from).iter().product();
        if interior.resolution_px != frame_px {
            self.buffer("frame of the inside", uniforms::Frame::min_size().get());
        }
        self.buffer("interior", uniforms::Interior::min_size().get());
        if let Some(surfaces) = &interior.onto_back {
            self.corners(&self.geometry.cracks);
            self.pass(surfaces.name);
        }
        for surfaces in interior.passes() {
            for target in &surfaces.targets {
                self.buffer(target.name, target.bytes(pixels));
            }
            self.depth_test(surfaces, pixels);
            if surfaces.sides.has_depth() {
                self.analytic(&self.geometry.bodies, 1);
            }
            self.pass(surfaces.name);
        }
        if interior.cracks.is_some() {
            self.corners(&self.geometry.cracks);
        }
        if interior.air.is_some() {
            self.corners(&self.geometry.air);
        }
        if interior.clip.is_none() {
            let reason = "the frame's own depths, layers or sheets end cracks and air";
            self.plan.leave_out(Kind::Pass, "clip front, clip back", reason, 2 * 8 * pixels);
        }
    }
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
