//! The passes of a frame. Each file says what its pass draws, what it adds to a
//! plan, how it is made ready and how it is recorded; [`crate::frame`] lists them.

pub(crate) mod back;
pub(crate) mod backdrop;
pub(crate) mod cracks_and_air;
pub(crate) mod front;
pub(crate) mod normal_cube;
pub(crate) mod peel;
mod pipelines;
mod raster_pass;
mod raster_state;
pub(crate) mod rays;
pub(crate) mod shade;

pub(crate) use pipelines::Maker;

use crate::composition::inputs::Inputs;
use crate::drawn::frame_uniforms::Viewed;
use crate::error::Error;
use crate::gpu::Gpu;
use crate::gpu::recorder::Recorder;
use crate::gpu::resources::Outputs;
use crate::plan::counted::Counted;
use crate::plan::entries::Entries;
use glam::DVec2;

/// A pass, or a few that belong together, as far as it can be known without a GPU.
pub(crate) trait Pass {
    /// Some shader of it reads a global.
    fn reads(&self, global: &str) -> bool;

    /// It draws the bodies' triangles.
    fn draws_bodies(&self) -> bool {
        true
    }

    /// Adds its passes and buffers to a plan, and what it leaves out.
    fn plan(&self, entries: &mut Entries<'_>);

    /// Refuses what an adapter does not allow, as far as it is known before, or
    /// after, layers are counted.
    fn check(&self, _: &Gpu, _: Option<Counted>) -> Result<(), Error> {
        Ok(())
    }

    /// Counts the layers of the view, if it collects any.
    fn count(&self, _: &Making<'_>) -> Result<Option<Counted>, Error> {
        Ok(None)
    }

    /// Makes pipelines and memory.
    fn ready(&self, making: &Making<'_>) -> Result<Ready, Error>;
}

/// A pass, if it is needed.
pub(crate) type Composed = Result<Option<Box<dyn Pass>>, Error>;

/// How a pass comes into a frame: a row of the list.
pub(crate) struct Listed {
    /// None if nothing that runs later reads what it would write.
    pub(crate) compose: fn(&Inputs<'_>, &Wanted<'_>) -> Composed,
    /// What a plan says where it is not there.
    pub(crate) absent: fn(&mut Entries<'_>),
}

/// What is wanted of a pass.
pub(crate) struct Wanted<'a> {
    pub(crate) inputs: &'a Inputs<'a>,
    /// The passes that run after it.
    pub(crate) later: &'a [Option<Box<dyn Pass>>],
}

impl Wanted<'_> {
    /// A later pass reads it.
    pub(crate) fn reads(&self, global: &str) -> bool {
        self.later.iter().flatten().any(|pass| pass.reads(global))
    }

    /// An image of the surfaces is read or asked for, or all are kept.
    pub(crate) fn image(&self, name: &str) -> bool {
        self.inputs.keeps_all() || self.reads(name) || self.inputs.asked_for(name)
    }
}

/// What passes are made ready with.
pub(crate) struct Making<'a> {
    pub(crate) view: &'a Viewed<'a>,
    /// Every shift that the view will have.
    pub(crate) shifts: &'a [DVec2],
    /// Draws the bodies into images of the frame's size.
    pub(crate) bodies: Maker<'a>,
    /// What the passes before hand on.
    pub(crate) before: &'a Outputs,
}

/// A pass that can be recorded any number of times, and what it hands on.
pub(crate) struct Ready {
    pub(crate) pass: Box<dyn Record>,
    pub(crate) outputs: Outputs,
    /// Layers per pixel that were counted on the way.
    pub(crate) counted: Option<Counted>,
    /// Numbers of the image's camera at a resolution of the pass's own, which follow
    /// it from position to position.
    pub(crate) following: Option<(wgpu::Buffer, [u32; 2])>,
}

impl Ready {
    fn new(pass: impl Record + 'static, outputs: Outputs) -> Self {
        Self { pass: Box::new(pass), outputs, counted: None, following: None }
    }
}

/// What a frame runs.
pub(crate) trait Record {
    /// `first`: the first frame, which also draws what never changes.
    fn record(&self, recorder: &mut Recorder<'_>, first: bool);
}
