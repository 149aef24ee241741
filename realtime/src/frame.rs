//! The frame, in the order in which it runs. Read this first: [`PASSES`] is
//! everything that happens on the GPU.

use crate::composition::chosen::decided;
use crate::composition::inputs::Inputs;
use crate::drawn::drawables::Drawables;
use crate::drawn::frame_uniforms::{self, Viewed, upload_numbers};
use crate::drawn::geometry::Geometry;
use crate::error::Error;
use crate::gpu::Gpu;
use crate::gpu::allocator::Allocator;
use crate::gpu::limits::Limits;
use crate::gpu::recorder::Recorder;
use crate::gpu::resources::Outputs;
use crate::passes::{Listed, Maker, Making, Pass, Ready, Wanted};
use crate::passes::{back, backdrop, cracks_and_air, front, normal_cube, peel, rays, shade};
use crate::plan::counted::Counted;
use crate::plan::entries::Entries;
use crate::plan::timing::{REFIT, THICKNESS};
use glam::DVec2;
use scenes::Plan;
use scenes::plan::Kind;

/// Every pass there is, in the order in which they run.
const PASSES: [Listed; 8] = [
    backdrop::LISTED,
    normal_cube::LISTED,
    front::LISTED,
    back::LISTED,
    peel::LISTED,
    cracks_and_air::LISTED,
    rays::LISTED,
    shade::LISTED,
];

/// A frame, as far as it can be known without a GPU.
pub(crate) struct Composition<'a> {
    inputs: Inputs<'a>,
    /// Beside [`PASSES`], the last first; `None` for those that are not needed.
    passes: Vec<Option<Box<dyn Pass>>>,
    /// Column, row, width and height of the pixels that the bodies can reach, if
    /// they are not all.
    within_px: Option<[u32; 4]>,
}

impl<'a> Composition<'a> {
    /// The last pass first: what it reads decides what runs before it.
    pub(crate) fn new(inputs: Inputs<'a>) -> Result<Self, Error> {
        let inputs = decided(inputs);
        let mut passes: Vec<Option<Box<dyn Pass>>> = Vec::new();
        for listed in PASSES.iter().rev() {
            let wanted = Wanted { inputs: &inputs, later: &passes };
            let pass = (listed.compose)(&inputs, &wanted)?;
            passes.push(pass);
        }
        let drawn = passes.iter().flatten().any(|pass| pass.draws_bodies());
        let within_px = if drawn { inputs.within_px() } else { None };
        Ok(Self { inputs, passes, within_px })
    }

    /// True if some pass writes the distance through the body.
    pub(crate) fn reads_thickness(&self) -> bool {
        let keeps = self.inputs.keeps_all();
        keeps || self.passes.iter().flatten().any(|pass| pass.reads(front::THICKNESS))
    }

    /// Some pass draws the bodies' triangles.
    fn draws_bodies(&self) -> bool {
        self.passes.iter().flatten().any(|pass| pass.draws_bodies())
    }

    /// Rays meet the bodies by themselves.
    pub(crate) fn follows_rays(&self) -> bool {
        self.inputs.follows_rays()
    }

    pub(crate) fn draws_clipped_cracks(&self) -> bool {
        self.inputs.draws_clipped_cracks()
    }

    /// Its plan, drawn at some positions in each pixel, one after the other.
    /// `repeated`: of a frame after the first.
    pub(crate) fn plan(
        &self,
        geometry: &Geometry,
        positions: usize,
        repeated: bool,
        counted: Option<Counted>,
    ) -> Plan {
        let mut plan = self.plan_at_one(geometry, repeated, counted);
        if positions > 1 {
            let mut again = self.plan_at_one(geometry, true, counted).passes;
            // The CPU's part is done once for all of them.
            again.retain(|pass| pass != THICKNESS && pass != REFIT);
            plan.passes.extend((1..positions).flat_map(|_| again.iter().cloned()));
        }
        plan
    }

    fn plan_at_one(&self, geometry: &Geometry, repeated: bool, counted: Option<Counted>) -> Plan {
        let draws_bodies = self.draws_bodies();
        let new = Entries::new(&self.inputs, geometry);
        let mut entries = Entries { repeated, counted, draws_bodies, ..new };
        entries.bodies();
        for (listed, pass) in PASSES.iter().zip(self.passes.iter().rev()) {
            match pass {
                Some(pass) => pass.plan(&mut entries),
                None => (listed.absent)(&mut entries),
            }
        }
        if let Some([_, _, width, height]) = self.within_px {
            let kept = u64::from(width) * u64::from(height);
            let share = 100.0 * (1.0 - kept as f64 / entries.pixels as f64);
            let reason = format!("the bodies lie within {width} x {height} pixels");
            let what = format!("drawing {share:.0} % of the image");
            entries.plan.leave_out(Kind::Code, &what, &reason, 0);
        }
        entries.plan
    }
}

impl Composition<'_> {
    /// Refuses what an adapter does not allow, before anything is allocated.
    pub(crate) fn check(&self, gpu: &Gpu, counted: Option<Counted>) -> Result<(), Error> {
        Limits::of(gpu).image("the image", self.inputs.resolution_px)?;
        self.passes.iter().flatten().try_for_each(|pass| pass.check(gpu, counted))
    }

    /// Counts the layers of a view as a frame does before it is drawn.
    pub(crate) fn count(
        &self,
        gpu: &Gpu,
        view: &Viewed<'_>,
        shifts: &[DVec2],
    ) -> Result<Option<Counted>, Error> {
        let allocator = Allocator::new(gpu);
        let outputs = upload_numbers(&allocator, view)?;
        let bodies = Maker::new(gpu, &allocator, &view.geometry.bodies, view.resolution_px)?;
        let bodies = bodies.within(self.within_px);
        let making = Making { view, shifts, bodies, before: &outputs };
        let counted = self.passes.iter().flatten().map(|pass| pass.count(&making));
        Ok(counted.collect::<Result<Vec<_>, _>>()?.into_iter().flatten().next())
    }
}

/// Pipelines and memory of a frame, ready to run any number of times.
pub(crate) struct Frame {
    passes: Vec<Ready>,
    /// What all of them handed on.
    pub(crate) outputs: Outputs,
}

impl Frame {
    /// Everything that happens, in order. `first`: also what never changes.
    pub(crate) fn record(&self, recorder: &mut Recorder<'_>, first: bool) {
        self.passes.iter().for_each(|ready| ready.pass.record(recorder, first));
    }

    /// Layers per pixel that were counted, if any are collected.
    pub(crate) fn counted(&self) -> Option<Counted> {
        self.passes.iter().find_map(|ready| ready.counted)
    }

    /// Turns to another shift of the view.
    pub(crate) fn aim(&self, gpu: &Gpu, view: &Viewed<'_>) {
        let capacity = self.counted().map_or(0, |counted| counted.capacity);
        frame_uniforms::write(gpu, self.outputs.stored("frame"), view, capacity);
        for (buffer, resolution_px) in self.passes.iter().filter_map(|pass| pass.following.as_ref())
        {
            let own = Viewed { resolution_px: *resolution_px, ..*view };
            frame_uniforms::write(gpu, buffer, &own, 0);
        }
    }

    /// Makes pipelines and memory for a view at all of its shifts.
    pub(crate) fn new(
        gpu: &Gpu,
        allocator: &Allocator<'_>,
        composition: &Composition<'_>,
        view: &Viewed<'_>,
        shifts: &[DVec2],
    ) -> Result<Self, Error> {
        let mut outputs = upload_numbers(allocator, view)?;
        let nothing = Drawables::default();
        let drawn = if composition.draws_bodies() { &view.geometry.bodies } else { &nothing };
        let bodies = Maker::new(gpu, allocator, drawn, view.resolution_px)?;
        let bodies = bodies.within(composition.within_px);
        let mut passes = Vec::new();
        for pass in composition.passes.iter().rev().flatten() {
            let making = Making { view, shifts, bodies: bodies.clone(), before: &outputs };
            let ready = pass.ready(&making)?;
            outputs = ready.outputs.clone().over(&outputs);
            passes.push(ready);
        }
        Ok(Self { passes, outputs })
    }
}
