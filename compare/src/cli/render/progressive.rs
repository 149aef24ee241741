//! A coarse image at once and finer ones after it. Each is whole when it takes
//! the place of the one before, so stopping at any moment leaves an image.

use crate::Error;
use crate::cli::arguments::view::ImageArgs;
use crate::cli::output::Output;
use crate::study::cache::Id;
use crate::study::jobs::Exact;
use crate::support::progress::Progress;
use reference::{Estimator, Level, Paths, Positions, Request, Watch, render_watched};
use scenes::{LayerName, Rendering, Scene};
use std::time::Instant;

/// Renders and writes every stage; the last is the image that was asked for.
pub(in crate::cli) fn render(
    scene: &Scene,
    request: &Request,
    image: &ImageArgs,
    started: Instant,
) -> Result<Rendering, Error> {
    let stages = stages(request);
    let last = stages.len() - 1;
    for stage in &stages[..last] {
        let rendering = render_watched(scene, stage, Watch::default())?;
        image.write(&rendering, &scene.name, &exact_id(scene, stage))?;
        tell(stage, started);
    }
    let progress = Progress::new(&format!("tracing {}", scene.name));
    let watch = Watch { progress: Some(&|share| progress.at(share)), ..Watch::default() };
    let rendering = render_watched(scene, &stages[last], watch)?;
    drop(progress);
    image.write(&rendering, &scene.name, &exact_id(scene, request))?;
    tell(&stages[last], started);
    Ok(rendering)
}

/// Content id of the exact image that is asked for.
pub(super) fn exact_id(scene: &Scene, request: &Request) -> Id {
    Exact { scene, request: request.clone() }.id()
}

fn tell(stage: &Request, started: Instant) {
    let rays = rays_per_pixel(stage);
    let plural = if rays == 1 { "" } else { "s" };
    let seconds = started.elapsed().as_secs_f64();
    Output::note(&format!("{seconds:.2} s: {rays} ray{plural} per pixel written"));
}

fn rays_per_pixel(request: &Request) -> u64 {
    let k = request.view.positions_per_axis;
    match request.estimator {
        Estimator::Paths(paths) if request.level != Level::R0 => {
            let cells = if paths.positions == Positions::Cells { u64::from(k).pow(2) } else { 1 };
            u64::from(paths.batches) * u64::from(paths.samples) * cells
        }
        _ => u64::from(k).pow(2),
    }
}

/// Requests with one ray per pixel, then four times as many each, then what was
/// asked for. All before the last cost a third of it together.
fn stages(request: &Request) -> Vec<Request> {
    let whole = rays_per_pixel(request);
    let mut stages = Vec::new();
    let mut rays = 1;
    while rays < whole {
        let stage = coarser(request, rays);
        if stage != *request {
            stages.push(stage);
        }
        rays *= 4;
    }
    if let (Some(first), true) = (stages.first_mut(), can_be_random(request)) {
        // One path in place of a tree: the same image on average, much sooner.
        first.estimator =
            Estimator::Paths(Paths { batches: 1, samples: 1, split: 1.0, ..Paths::default() });
    }
    stages.push(request.clone());
    stages
}

/// Random paths show every layer that is asked for.
fn can_be_random(request: &Request) -> bool {
    !request.polarised
        && request.level != Level::R0
        && !request.view.layers.contains(&LayerName::Variance)
}

/// The request with `rays` per pixel, a power of four.
fn coarser(request: &Request, rays: u64) -> Request {
    let mut coarse = request.clone();
    let k = (rays.isqrt() as u32).min(request.view.positions_per_axis);
    let Estimator::Paths(paths) = &mut coarse.estimator else {
        coarse.view.positions_per_axis = k;
        return coarse;
    };
    let mut left = rays;
    if paths.positions == Positions::Cells || request.level == Level::R0 {
        coarse.view.positions_per_axis = k;
        left = (rays / u64::from(k).pow(2)).max(1);
    }
    // Batches first: a variance needs two, and more are better.
    let least = if request.view.layers.contains(&LayerName::Variance) { 2 } else { 1 };
    paths.batches = paths.batches.min(u32::try_from(left).unwrap_or(u32::MAX).max(least));
    left /= u64::from(paths.batches);
    paths.samples = paths.samples.min(u32::try_from(left).unwrap_or(u32::MAX).max(1));
    coarse
}

#[cfg(test)]
mod tests {
    use super::*;
    use scenes::View;

    fn request(estimator: Estimator, layers: Vec<LayerName>) -> Request {
        let view = View { resolution_px: [8, 8], positions_per_axis: 6, frame: 0, layers };
        Request { estimator, ..Request::new(view, Level::R1) }
    }

    #[test]
    fn the_last_stage_is_what_was_asked_for_and_the_first_has_one_ray() {
        let paths =
            |batches, samples| Estimator::Paths(Paths { batches, samples, ..Paths::default() });
        let cells = |batches, samples| {
            let positions = Positions::Cells;
            Estimator::Paths(Paths { batches, samples, positions, ..Paths::default() })
        };
        for (estimator, layers, rays) in [
            (Estimator::Tree { cut: 1e-4 }, vec![LayerName::Radiance], vec![1, 4, 16, 36]),
            (paths(16, 4), vec![LayerName::Radiance], vec![1, 4, 16, 64]),
            (paths(3, 9), vec![LayerName::Radiance], vec![1, 3, 15, 27]),
            (paths(16, 4), vec![LayerName::Variance], vec![2, 4, 16, 64]),
            (paths(1, 1), vec![LayerName::Radiance], vec![1]),
            (cells(1, 1), vec![LayerName::Radiance], vec![1, 4, 16, 36]),
            (cells(3, 1), vec![LayerName::Radiance], vec![1, 4, 16, 36, 108]),
            (cells(2, 1), vec![LayerName::Variance], vec![2, 8, 32, 72]),
        ] {
            let request = request(estimator, layers);
            let stages = stages(&request);
            assert_eq!(stages.iter().map(rays_per_pixel).collect::<Vec<_>>(), rays);
            assert_eq!(stages.last(), Some(&request));
        }
    }

    #[test]
    fn what_random_paths_cannot_show_is_traced_as_a_tree_from_the_start() {
        let tree = Estimator::Tree { cut: 1e-4 };
        let plain = request(tree, vec![LayerName::Radiance]);
        assert_ne!(stages(&plain)[0].estimator, tree);
        let polarised = Request { polarised: true, ..plain.clone() };
        assert_eq!(stages(&polarised)[0].estimator, tree);
        assert_eq!(stages(&Request { level: Level::R0, ..plain })[0].estimator, tree);
    }
}
