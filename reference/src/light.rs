//! The light that falls on one pixel: the mean over its positions, or over
//! random ones.

use crate::branches::{Branch, Climb, Sum};
use crate::flight::{Flight, Scratch};
use crate::frame::Job;
use crate::layers::Pixel;
use crate::media::Media;
use crate::optics::D_LINE;
use crate::policy::{Cut, Policy, Roulette};
use crate::request::{Estimator, Level};
use crate::sampling::Points;
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
        let count = match self.job.request.estimator {
            Estimator::Paths { batches, samples, seed } if self.job.request.level != Level::R0 => {
                self.batches::<UNIFORM, LENGTHS>(corner_px, pixel, [batches, samples], seed);
                f64::from(batches) * f64::from(samples)
            }
            estimator => {
                let cut = if let Estimator::Tree { cut } = estimator { cut } else { 0.0 };
                let k = self.job.request.view.positions_per_axis;
                for index in 0..k * k {
                    let at = DVec2::new(f64::from(index % k), f64::from(index / k)) + 0.5;
                    let at = corner_px + at / f64::from(k);
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
        pixel: &mut Pixel,
        [batches, samples]: [u32; 2],
        seed: u64,
    ) {
        let width = f64::from(self.job.request.view.resolution_px[0]);
        let index = (corner_px.y * width + corner_px.x) as u64;
        // Mean and sum of squared deviations so far (Welford 1962).
        let (mut mean, mut squares) = (DVec3::ZERO, DVec3::ZERO);
        for batch in 0..batches {
            let before = pixel.radiance;
            let points = Points::new(seed, index, batch);
            for sample in 0..samples {
                let at = corner_px + DVec2::from_array(points.pair(sample, 0));
                self.position::<_, UNIFORM, LENGTHS>(at, Roulette::new(points, sample), pixel);
            }
            let estimate = (pixel.radiance - before) / f64::from(samples);
            let step = estimate - mean;
            mean += step / f64::from(batch + 1);
            squares += step * (estimate - mean);
        }
        let n = f64::from(batches);
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
        if !tracer.disperses {
            let sum = self.tree::<P, UNIFORM, LENGTHS>(flight, D_LINE, policy, pixel);
            pixel.radiance += sum.radiance;
            pixel.truncated += sum.truncated;
            pixel.coverage += f64::from(u8::from(sum.met));
            return;
        }
        let mut truncated = 0.0_f64;
        for channel in 0..3 {
            let sum =
                self.tree::<P, UNIFORM, LENGTHS>(flight.clone(), channel, policy.clone(), pixel);
            pixel.radiance[channel] += sum.radiance[channel];
            truncated = truncated.max(sum.truncated);
            if channel == D_LINE {
                pixel.coverage += f64::from(u8::from(sum.met));
            }
        }
        pixel.truncated += truncated;
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
        let mut truncated = 0.0_f64;
        // Without dispersion one trace serves every channel.
        let channels = if tracer.disperses { 0..3 } else { D_LINE..D_LINE + 1 };
        for channel in channels {
            let shows = |c: usize| c == channel || !tracer.disperses;
            let optics = &tracer.optics[channel];
            let sum = tracer.polarised_tree::<M, UNIFORM, LENGTHS>(
                flight.clone(),
                axis,
                optics,
                cut,
                self.scratch,
            );
            for c in (0..3).filter(|c| shows(*c)) {
                pixel.radiance[c] += sum.channels[c].x;
            }
            if shows(D_LINE) {
                pixel.polarisation += sum.channels[D_LINE].yzw();
                pixel.coverage += f64::from(u8::from(sum.met));
            }
            truncated = truncated.max(sum.truncated);
        }
        pixel.truncated += truncated;
    }

    /// The tree below a camera ray; its light by bounce goes to the pixel.
    fn tree<P: Policy, const UNIFORM: bool, const LENGTHS: bool>(
        &mut self,
        flight: Flight<M>,
        channel: usize,
        policy: P,
        pixel: &mut Pixel,
    ) -> Sum {
        self.bounces.clear();
        self.bounces.resize(self.job.columns.bounces, DVec3::ZERO);
        let tracer = self.job.tracer;
        let mut climb = Climb {
            optics: &tracer.optics[channel],
            policy,
            waiting: self.waiting,
            scratch: self.scratch,
            bounces: &mut self.bounces,
        };
        let sum = tracer.tree::<M, P, UNIFORM, LENGTHS>(flight, &mut climb);
        for (total, bounce) in pixel.bounces.iter_mut().zip(&self.bounces) {
            let one = DVec3::from_array([0, 1, 2].map(|c| f64::from(u8::from(c == channel))));
            *total += if tracer.disperses { *bounce * one } else { *bounce };
        }
        sum
    }
}
