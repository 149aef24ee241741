//! An image, in execution order. Read this first.
//!
//! bake the scene -> choose the tracer's variant -> rows in parallel: for each
//! pixel, the chain through its centre and the radiance over its positions ->
//! layers.

use crate::error::Error;
use crate::image::layers::RequestedLayers;
use crate::image::run::{ImageRun, Watch};
use crate::request::{Estimator, Request};
use crate::transport::spectrum;
use crate::transport::tracer::Tracer;
use crate::transport::variant::Variant;
use crate::world::World;
use scenes::rendering::{Pass, Provenance, Time, TimeSource};
use scenes::{Camera, Rendering, Scene};
use std::collections::BTreeMap;
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
    spectrum::check(scene, request.spectrum)?;
    let asked = RequestedLayers::new(scene, request)?;
    let started = Instant::now();
    let world = World::new(scene, request.view.frame, request.level)?;
    let built = Instant::now();
    let camera = Camera { resolution_px: request.view.resolution_px, ..scene.camera };
    let variant = Variant::new(scene, &world, request.keep, asked.needs_lengths());
    let tracer = Tracer::new(scene, &world, &camera, request);
    let image = ImageRun { tracer: &tracer, camera, request, layers: &asked, watch };
    let (layers, counters) = variant.run(&image)?;
    let time = |name: &str, from: Instant, to: Instant| Pass {
        name: name.to_owned(),
        times: vec![Time::once(TimeSource::Wall, to.duration_since(from).as_secs_f64() * 1e3)],
    };
    Ok(Rendering {
        layers,
        passes: vec![time("build", started, built), time("trace", built, Instant::now())],
        counters: counters.named(&world),
        plan: variant.plan(scene, &world, request, &asked),
        provenance: provenance(request),
    })
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
