//! What each part of a frame adds to a plan: its passes and its buffers.

use crate::Filter;
use crate::drawn::drawables::{Corner, Parts};
use crate::drawn::geometry::Geometry;
use crate::drawn::uniforms::{self, Bodies};
use crate::frames::Part;
use crate::passes::Composition;
use crate::passes::backdrop::{Backdrop, FACES};
use crate::passes::cracks_and_air::Interior;
use crate::passes::normal_cube as normals;
use crate::passes::peel::{Counted, Peel};
use crate::passes::raster_pass::Surfaces;
use crate::plan::timing::THICKNESS;
use encase::ShaderType;
use scenes::plan::{Buffer, Kind};
use scenes::{Environment, Plan, Scene};

/// A plan in the making.
pub(crate) struct Draft<'a> {
    pub(crate) plan: Plan,
    /// Of the frame.
    pub(crate) pixels: u64,
    pub(crate) geometry: &'a Geometry,
}

impl Draft<'_> {
    pub(crate) fn pass(&mut self, name: &str) {
        self.plan.passes.push(name.to_owned());
    }

    pub(crate) fn buffer(&mut self, name: &str, bytes: u64) {
        self.plan.buffers.push(Buffer { name: name.to_owned(), bytes });
    }

    pub(crate) fn numbers(&mut self) {
        self.buffer("frame", uniforms::Frame::min_size().get());
        self.buffer("bodies", Bodies::min_size().get());
        if self.geometry.bumps.is_some() {
            self.buffer("bumps", uniforms::Bumps::min_size().get());
        }
    }

    pub(crate) fn thickness(&mut self, composition: &Composition) {
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

    pub(crate) fn environment(&mut self, scene: &Scene, filter: Filter) {
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

    pub(crate) fn corners(&mut self, parts: &Parts) {
        if !parts.corners.is_empty() {
            self.buffer("corners", (parts.corners.len() * size_of::<Corner>()) as u64);
        }
    }

    /// Images of a raster pass, its depth test and its analytic bodies.
    pub(crate) fn surfaces(&mut self, surfaces: &Surfaces, pixels: u64, sides: usize) {
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

    pub(crate) fn layers(&mut self, peel: &Peel, layers: Option<Counted>) {
        self.plan.passes.extend(peel.passes(layers));
        self.plan.buffers.extend(peel.buffers(layers));
        // Both sides of every analytic body, to be counted and to be collected.
        self.analytic(&self.geometry.bodies, 4);
    }

    pub(crate) fn backdrop(&mut self, backdrop: &Backdrop, scene: &Scene, part: &Part) {
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

    pub(crate) fn normals(&mut self, surfaces: &Surfaces, part: &Part) {
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

    pub(crate) fn interior(&mut self, interior: &Interior, frame_px: [u32; 2]) {
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
