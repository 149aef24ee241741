//! The light that falls on one pixel: the mean over its positions, or over
//! random ones.

use crate::image::job::Job;
use crate::image::layers::Pixel;
use crate::request::{Estimator, Level, Paths, Positions};
use crate::sampling::lattice::Lattice;
use crate::sampling::sobol::Points;
use crate::transport::branching::{Cut, Policy, Roulette};
use crate::transport::spectrum::{Total, Wave};
use crate::transport::tree::{Branch, Climb, Sum};
use crate::world::short_way::{Flight, Scratch};
use crate::world::winding::Media;
use glam::{DVec2, DVec3, Vec4Swizzles};

/// Working memory for the light of one pixel.
pub(crate) struct Light<'a, 'b, M> {
    pub(crate) job: &'a Job<'b>,
    pub(crate) waiting: &'a mut Vec<Branch<M>>,
    pub(crate) scratch: &'a mut Scratch,
    pub(crate) bounces: Vec<DVec3>,
}

impl<M: Media> Light<'_, '_, M> {
    /// Fills in everything that is a mean over the pixel.
    pub(crate) fn pixel<const UNIFORM: bool, const LENGTHS: bool>(
        &mut self,
        corner_px: DVec2,
        pixel: &mut Pixel,
    ) {
        pixel.bounces = vec![DVec3::ZERO; self.job.columns.bounces];
        let k = self.job.request.view.positions_per_axis;
        let count = match self.job.request.estimator {
            Estimator::Paths(paths) if self.job.request.level != Level::R0 => {
                self.batches::<UNIFORM, LENGTHS>(corner_px, paths, pixel);
                f64::from(paths.batches) * f64::from(paths.per_batch(k))
            }
            estimator => {
                let cut = if let Estimator::Tree { cut } = estimator { cut } else { 0.0 };
                for index in 0..k * k {
                    let at = corner_px + cell_centre(index, k);
                    self.position::<_, UNIFORM, LENGTHS>(at, Cut(cut), pixel);
                }
                f64::from(k * k)
            }
        };
        let share = 1.0 / count;
        pixel.radiance *= share;
        pixel.truncated *= share;
        pixel.coverage *= share;
        pixel.polarisation *= share;
        pixel.bounces.iter_mut().for_each(|bounce| *bounce *= share);
        pixel.samples = count;
    }

    /// Independent batches of random paths, and the variance of their mean.
    fn batches<const UNIFORM: bool, const LENGTHS: bool>(
        &mut self,
        corner_px: DVec2,
        paths: Paths,
        pixel: &mut Pixel,
    ) {
        let view = &self.job.request.view;
        let k = view.positions_per_axis;
        let index = (corner_px.y * f64::from(view.resolution_px[0]) + corner_px.x) as u64;
        // Mean and sum of squared deviations so far (Welford 1962).
        let (mut mean, mut squares) = (DVec3::ZERO, DVec3::ZERO);
        let per_batch = paths.per_batch(k);
        let lattice = Lattice::new(per_batch * paths.batches);
        for batch in 0..paths.batches {
            let before = pixel.radiance;
            let points = Points::new(paths.seed, index, batch);
            for path in 0..per_batch {
                let at = match paths.positions {
                    Positions::Random => DVec2::from_array(points.pair(path, 0)),
                    Positions::Cells => cell_centre(path % (k * k), k),
                    Positions::Lattice => lattice.at(path * paths.batches + batch),
                };
                let policy = Roulette::new(points, path, paths.split);
                self.position::<_, UNIFORM, LENGTHS>(corner_px + at, policy, pixel);
            }
            let estimate = (pixel.radiance - before) / f64::from(per_batch);
            let step = estimate - mean;
            mean += step / f64::from(batch + 1);
            squares += step * (estimate - mean);
        }
        let n = f64::from(paths.batches);
        pixel.variance = squares / (n * (n - 1.0).max(1.0));
    }

    /// Adds the light through one position.
    fn position<P: Policy + Clone, const UNIFORM: bool, const LENGTHS: bool>(
        &mut self,
        position_px: DVec2,
        policy: P,
        pixel: &mut Pixel,
    ) {
        let tracer = self.job.tracer;
        let ray = self.job.camera.ray_through(position_px);
        let flight: Flight<M> = tracer.launch(ray, self.scratch);
        if self.job.request.level == Level::R0 {
            let chain = tracer.chain::<M, UNIFORM, LENGTHS>(flight, self.scratch);
            pixel.radiance += chain.radiance;
            pixel.truncated += f64::from(u8::from(chain.lost()));
            pixel.coverage += f64::from(u8::from(chain.met));
            return;
        }
        if let (true, Estimator::Tree { cut }) =
            (self.job.request.polarised, self.job.request.estimator)
        {
            self.polarised::<UNIFORM, LENGTHS>(flight, Cut(cut), pixel);
            return;
        }
        let mut total = Total::default();
        for (number, wave) in tracer.waves.iter().enumerate() {
            let flight = flight.clone();
            let sum = self.tree::<P, UNIFORM, LENGTHS>(flight, wave, policy.clone(), pixel);
            wave.add(sum.radiance, sum.truncated, &mut total);
            if number == tracer.waves.len() / 2 {
                pixel.coverage += f64::from(u8::from(sum.met));
            }
        }
        pixel.radiance += total.radiance;
        pixel.truncated += total.truncated();
    }

    /// Adds the light below a camera ray with its polarisation; axis: the
    /// image's horizontal.
    fn polarised<const UNIFORM: bool, const LENGTHS: bool>(
        &mut self,
        flight: Flight<M>,
        cut: Cut,
        pixel: &mut Pixel,
    ) {
        let tracer = self.job.tracer;
        let axis = flight.direction.cross(self.job.camera.basis().up).normalize();
        let mut total = Total::default();
        for (number, wave) in tracer.waves.iter().enumerate() {
            let sum = tracer.polarised_tree::<M, UNIFORM, LENGTHS>(
                flight.clone(),
                axis,
                &wave.optics,
                cut,
                self.scratch,
            );
            let [red, green, blue] = sum.channels;
            wave.add(DVec3::new(red.x, green.x, blue.x), sum.truncated, &mut total);
            // The polarisation that is shown is that of green.
            let share = wave.share.row(1);
            pixel.polarisation +=
                share.x * red.yzw() + share.y * green.yzw() + share.z * blue.yzw();
            if number == tracer.waves.len() / 2 {
                pixel.coverage += f64::from(u8::from(sum.met));
            }
        }
        pixel.radiance += total.radiance;
        pixel.truncated += total.truncated();
    }

    /// The tree below a camera ray; its light by bounce goes to the pixel.
    fn tree<P: Policy, const UNIFORM: bool, const LENGTHS: bool>(
        &mut self,
        flight: Flight<M>,
        wave: &Wave,
        policy: P,
        pixel: &mut Pixel,
    ) -> Sum {
        self.bounces.clear();
        self.bounces.resize(self.job.columns.bounces, DVec3::ZERO);
        let tracer = self.job.tracer;
        let mut climb = Climb {
            optics: &wave.optics,
            policy,
            waiting: self.waiting,
            scratch: self.scratch,
            bounces: &mut self.bounces,
        };
        let sum = tracer.tree::<M, P, UNIFORM, LENGTHS>(flight, &mut climb);
        for (total, bounce) in pixel.bounces.iter_mut().zip(&self.bounces) {
            *total += wave.share * *bounce;
        }
        sum
    }
}

/// Centre of one of the k x k cells of a pixel, from its corner.
fn cell_centre(index: u32, k: u32) -> DVec2 {
    (DVec2::new(f64::from(index % k), f64::from(index / k)) + 0.5) / f64::from(k)
}
