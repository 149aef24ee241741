//! An image, in execution order. Read this first.
//!
//! bake the scene -> choose the tracer's variant -> rows in parallel: for each
//! pixel, the chain through its centre and the radiance over its positions ->
//! layers.

use crate::error::Error;
use crate::image::job::{Job, Watch};
use crate::image::layers::{Columns, Pixel};
use crate::image::pixel::Light;
use crate::image::plan::Variant;
use crate::request::{Estimator, Request};
use crate::transport::tracer::Tracer;
use crate::transport::tree::Branch;
use crate::world::World;
use crate::world::short_way::{Counters, Scratch};
use crate::world::winding::{Counts, Inside, Media};
use glam::DVec2;
use rayon::prelude::*;
use scenes::rendering::{Pass, Provenance, Time, TimeSource};
use scenes::{Camera, Layers, Rendering, Scene};
use std::collections::BTreeMap;
use std::sync::atomic::{AtomicBool, AtomicUsize, Ordering};
use std::time::Instant;

/// Renders a scene exactly.
///
/// The layers are the same, bit by bit, for any number of threads.
///
/// # Errors
/// [`Error`]: the scene has no exact image (an open glass mesh), the request
/// asks for something unknown or out of range.
pub fn render(scene: &Scene, request: &Request) -> Result<Rendering, Error> {
    render_watched(scene, request, Watch::default())
}

/// [`render`] with progress and a way to stop.
///
/// # Errors
/// As [`render`], and [`Error::Cancelled`].
pub fn render_watched(
    scene: &Scene,
    request: &Request,
    watch: Watch<'_>,
) -> Result<Rendering, Error> {
    request.check()?;
    let columns = Columns::new(scene, request)?;
    let started = Instant::now();
    let world = World::new(scene, request.view.frame, request.level)?;
    let built = Instant::now();
    let camera = Camera { resolution_px: request.view.resolution_px, ..scene.camera };
    let variant = Variant::new(scene, &world, request, &columns);
    let tracer = Tracer::new(scene, &world, &camera, request);
    let job = Job { tracer: &tracer, camera, request, columns: &columns, watch };
    let (layers, counters) = variant.run(&job)?;
    let time = |name: &str, from: Instant, to: Instant| Pass {
        name: name.to_owned(),
        times: vec![Time {
            source: TimeSource::Wall,
            milliseconds: to.duration_since(from).as_secs_f64() * 1e3,
        }],
    };
    Ok(Rendering {
        layers,
        passes: vec![time("build", started, built), time("trace", built, Instant::now())],
        counters: counters.named(&world),
        plan: variant.plan(scene, &world, request, &columns),
        provenance: provenance(request),
    })
}

impl Variant {
    /// Compiled code for each combination that can be chosen.
    fn run(&self, job: &Job<'_>) -> Result<(Layers, Counters), Error> {
        match self.classes {
            0 => self.run_with::<Inside>(job),
            1 => self.run_with::<Counts<1>>(job),
            2..=4 => self.run_with::<Counts<4>>(job),
            5..=16 => self.run_with::<Counts<16>>(job),
            _ => self.run_with::<Counts<256>>(job),
        }
    }

    fn run_with<M: Media + Send>(&self, job: &Job<'_>) -> Result<(Layers, Counters), Error> {
        match (self.uniform, self.lengths) {
            (false, false) => job.image::<M, false, false>(),
            (false, true) => job.image::<M, false, true>(),
            (true, false) => job.image::<M, true, false>(),
            (true, true) => job.image::<M, true, true>(),
        }
    }
}

impl Job<'_> {
    fn image<M: Media + Send, const UNIFORM: bool, const LENGTHS: bool>(
        &self,
    ) -> Result<(Layers, Counters), Error> {
        let [width, height] = self.request.view.resolution_px;
        let done = AtomicUsize::new(0);
        let rows: Result<Vec<(Vec<f64>, Counters)>, Error> = (0..height)
            .into_par_iter()
            .map_init(
                || (Scratch::default(), Vec::new()),
                |(scratch, waiting), y| {
                    let cancelled = |flag: &AtomicBool| flag.load(Ordering::Relaxed);
                    if self.watch.cancel.is_some_and(cancelled) {
                        return Err(Error::Cancelled);
                    }
                    scratch.counters = Counters::default();
                    let mut row = Vec::with_capacity(width as usize * self.columns.stride);
                    for x in 0..width {
                        let pixel = self.pixel::<M, UNIFORM, LENGTHS>(
                            DVec2::new(x.into(), y.into()),
                            scratch,
                            waiting,
                        );
                        self.columns.write(&pixel, &mut row);
                    }
                    let rows_done = done.fetch_add(1, Ordering::Relaxed) + 1;
                    if let Some(progress) = self.watch.progress {
                        progress(rows_done as f64 / f64::from(height));
                    }
                    Ok((row, scratch.counters))
                },
            )
            .collect();
        let rows = rows?;
        let mut counters = Counters::default();
        rows.iter().for_each(|(_, counted)| counters.add(counted));
        let rows: Vec<Vec<f64>> = rows.into_iter().map(|(row, _)| row).collect();
        Ok((self.columns.layers([width, height], &rows), counters))
    }

    /// One pixel: the chain through its centre, if a layer shows it, and the
    /// mean over its positions.
    fn pixel<M: Media, const UNIFORM: bool, const LENGTHS: bool>(
        &self,
        corner_px: DVec2,
        scratch: &mut Scratch,
        waiting: &mut Vec<Branch<M>>,
    ) -> Pixel {
        let mut pixel = Pixel::default();
        if self.columns.needs_chain {
            let ray = self.camera.ray_through(corner_px + 0.5);
            let flight = self.tracer.launch(ray, scratch);
            pixel.chain = self.tracer.chain::<M, UNIFORM, LENGTHS>(flight, scratch);
        }
        if self.columns.needs_cracks {
            let ray = self.camera.ray_through(corner_px + 0.5);
            pixel.crack = self.tracer.world.meets_crack::<M>(ray, scratch);
        }
        if self.columns.needs_mean {
            let mut light = Light { job: self, waiting, scratch, bounces: Vec::new() };
            light.pixel::<UNIFORM, LENGTHS>(corner_px, &mut pixel);
        }
        pixel
    }
}

fn provenance(request: &Request) -> Provenance {
    let mut parameters = BTreeMap::new();
    let mut set = |name: &str, value: String| parameters.insert(name.to_owned(), value);
    set("level", format!("{:?}", request.level));
    set("estimator", format!("{:?}", request.estimator));
    set("environment_lookup", format!("{:?}", request.environment_lookup));
    set("restriction", format!("{:?}", request.restriction));
    set("spectrum", format!("{:?}", request.spectrum));
    if let Some(map) = &request.caustics {
        set("caustics", format!("{map:?}"));
    }
    set("polarised", request.polarised.to_string());
    set("positions_per_axis", request.view.positions_per_axis.to_string());
    set("frame", request.view.frame.to_string());
    let seed = match request.estimator {
        Estimator::Paths(paths) => Some(paths.seed),
        Estimator::Tree { .. } => None,
    };
    Provenance {
        renderer: "reference".to_owned(),
        parameters,
        adapter: format!("CPU, {} threads", rayon::current_num_threads()),
        driver: String::new(),
        software: true,
        seed,
        version: env!("CARGO_PKG_VERSION").to_owned(),
    }
}
