//! What the passes of a frame add to a plan: passes, buffers, and what is left out.

use super::counted::Counted;
use super::timing::THICKNESS;
use crate::composition::inputs::Inputs;
use crate::drawn::drawables::{Corner, Drawables};
use crate::drawn::frame_uniforms::FrameUniform;
use crate::drawn::geometry::Geometry;
use crate::drawn::uniforms::{self, Bodies};
use crate::request::Filter;
use encase::ShaderType;
use scenes::plan::{Buffer, Kind};
use scenes::{Environment, Plan};

/// The plan of one frame in the making.
pub(crate) struct Entries<'a> {
    pub(crate) plan: Plan,
    pub(crate) inputs: &'a Inputs<'a>,
    /// As it is drawn.
    pub(crate) geometry: &'a Geometry,
    /// Of the frame.
    pub(crate) pixels: u64,
    /// A frame after the first: what never changes was drawn before.
    pub(crate) repeated: bool,
    /// Layers, which are counted on the GPU; before that, the bytes of one are
    /// stated.
    pub(crate) counted: Option<Counted>,
    /// Some pass draws the bodies' triangles.
    pub(crate) draws_bodies: bool,
}

impl<'a> Entries<'a> {
    pub(crate) fn new(inputs: &'a Inputs<'a>, geometry: &'a Geometry) -> Self {
        let pixels = inputs.resolution_px.map(u64::from).iter().product();
        let plan = Plan::default();
        Self { plan, inputs, geometry, pixels, repeated: false, counted: None, draws_bodies: true }
    }

    pub(crate) fn pass(&mut self, name: &str) {
        self.plan.passes.push(name.to_owned());
    }

    /// The faces of a cube, which are drawn once where nothing changes.
    pub(crate) fn faces(&mut self, faces: &[&str], what: &str, drawn_before: &str) {
        if self.geometry.changes || !self.repeated {
            faces.iter().for_each(|face| self.pass(face));
        } else {
            self.plan.leave_out(Kind::Pass, what, drawn_before, 0);
        }
    }

    pub(crate) fn buffer(&mut self, name: &str, bytes: u64) {
        self.plan.buffers.push(Buffer { name: name.to_owned(), bytes });
    }

    /// What every frame has: its numbers, the bodies' and their triangles.
    pub(crate) fn bodies(&mut self) {
        let geometry = self.geometry;
        self.buffer("frame", FrameUniform::min_size().get());
        self.buffer("bodies", Bodies::min_size().get());
        let bumps = uniforms::Bumps::min_size().get();
        if geometry.bumps.is_some() {
            self.buffer("bumps", bumps);
        } else {
            self.plan.leave_out(Kind::Binding, "bumps", "every surface is smooth", bumps);
        }
        if self.draws_bodies {
            self.corners(&geometry.bodies);
        }
        let plan = &mut self.plan;
        if !geometry.bodies.smooth {
            let reason = "normals are flat or analytic";
            plan.leave_out(Kind::Buffer, "front_geometric", reason, self.pixels * 16);
        }
        if geometry.bodies.corners.is_empty() {
            plan.leave_out(Kind::Buffer, "corners", "every body is analytic", 0);
        }
        if geometry.bodies.formulas().is_empty() {
            let reason = "every body is a mesh";
            plan.leave_out(Kind::Code, "ray against analytic bodies", reason, 0);
        }
    }

    /// Distances along normals, which the CPU finds before everything else.
    pub(crate) fn thickness(&mut self, read: bool) {
        if !read {
            let reason = "the method does not read distances through the body";
            self.plan.leave_out(Kind::Pass, THICKNESS, reason, 4 * self.pixels);
        } else if self.geometry.deforms {
            self.plan.passes.insert(0, THICKNESS.to_owned());
        } else {
            let reason = "no body deforms: measured once, before the first frame";
            self.plan.leave_out(Kind::Pass, THICKNESS, reason, 0);
        }
    }

    pub(crate) fn environment(&mut self) {
        match &self.inputs.scene.environment {
            Environment::Uniform(_) => {
                self.buffer("uniform_radiance", 16);
                let (reason, bytes) = ("the environment is uniform", 6 * 256 * 256 * 16);
                self.plan.leave_out(Kind::Buffer, "environment cube", reason, bytes);
            }
            Environment::Map(map) => {
                let border = 2 * u64::from(self.inputs.request.filter == Filter::Manual);
                let edge = u64::from(map.cube.size_px) + border;
                let name = if border == 2 { "environment_faces" } else { "environment_cube" };
                self.buffer(name, 6 * edge * edge * 16);
            }
        }
    }

    pub(crate) fn corners(&mut self, drawables: &Drawables) {
        if !drawables.corners.is_empty() {
            self.buffer("corners", (drawables.corners.len() * size_of::<Corner>()) as u64);
        }
    }

    /// Numbers of analytic drawables that are drawn some times.
    pub(crate) fn analytic(&mut self, drawables: &Drawables, times: usize) {
        for _ in 0..times * drawables.formulas().len() {
            self.buffer("analytic", uniforms::Analytic::min_size().get());
        }
    }

    /// Those of the bodies.
    pub(crate) fn analytic_bodies(&mut self, times: usize) {
        self.analytic(&self.geometry.bodies, times);
    }
}
