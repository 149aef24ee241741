//! The integrator of one pixel: the mean of light over its positions, or over
//! random ones.

use super::layer_table::Pixel;
use super::run::ImageRun;
use crate::request::{Estimator, Level, Paths, Positions};
use crate::sampling::lattice::Lattice;
use crate::sampling::sobol::Points;
use crate::transport::branching::{Cut, Policy, Roulette};
use crate::transport::spectrum::{Total, Wavelength};
use crate::transport::tree::{Branch, Climb, Sum};
use crate::world::flight::Flight;
use crate::world::scratch::Scratch;
use crate::world::winding::Winding;
use glam::{DVec2, DVec3, Vec4Swizzles};

/// Working memory for the light of one pixel.
pub(super) struct PixelIntegrator<'a, 'b, W> {
    pub(super) image: &'a ImageRun<'b>,
    pub(super) waiting: &'a mut Vec<Branch<W>>,
    pub(super) scratch: &'a mut Scratch,
    pub(super) bounces: Vec<DVec3>,
}

impl<W: Winding> PixelIntegrator<'_, '_, W> {
    /// Fills in everything that is a mean over the pixel.
    pub(crate) fn pixel<const UNIFORM: bool, const LENGTHS: bool>(
        &mut self,
        corner_px: DVec2,
        pixel: &mut Pixel,
    ) {
        pixel.bounces = vec![DVec3::ZERO; self.image.layers.bounces];
        let k = self.image.request.view.positions_per_axis;
        let count = match self.image.request.estimator {
            Estimator::Paths(paths) if self.image.request.level != Level::R0 => {
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
        let view = &self.image.request.view;
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
        let tracer = self.image.tracer;
        let ray = self.image.camera.ray_through(position_px);
        let flight: Flight<W> = tracer.launch(ray, self.scratch);
        if self.image.request.level == Level::R0 {
            let chain = tracer.chain::<W, UNIFORM, LENGTHS>(flight, self.scratch);
            pixel.radiance += chain.radiance;
            pixel.truncated += f64::from(u8::from(chain.lost()));
            pixel.coverage += f64::from(u8::from(chain.met));
            return;
        }
        if let (true, Estimator::Tree { cut }) =
            (self.image.request.polarised, self.image.request.estimator)
        {
            self.polarised::<UNIFORM, LENGTHS>(flight, Cut(cut), pixel);
            return;
        }
        let mut total = Total::default();
        for (number, wavelength) in tracer.wavelengths.iter().enumerate() {
            let flight = flight.clone();
            let sum = self.tree::<P, UNIFORM, LENGTHS>(flight, wavelength, policy.clone(), pixel);
            wavelength.add(sum.radiance, sum.truncated, &mut total);
            if number == tracer.wavelengths.len() / 2 {
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
        flight: Flight<W>,
        cut: Cut,
        pixel: &mut Pixel,
    ) {
        let tracer = self.image.tracer;
        let axis = flight.direction.cross(self.image.camera.basis().up).normalize();
        let mut total = Total::default();
        for (number, wavelength) in tracer.wavelengths.iter().enumerate() {
            let sum = tracer.polarised_tree::<W, UNIFORM, LENGTHS>(
                flight.clone(),
                axis,
                &wavelength.optics,
                cut,
                self.scratch,
            );
            let [red, green, blue] = sum.channels;
            wavelength.add(DVec3::new(red.x, green.x, blue.x), sum.truncated, &mut total);
            // The polarisation that is shown is that of green.
            let share = wavelength.share.row(1);
            pixel.polarisation +=
                share.x * red.yzw() + share.y * green.yzw() + share.z * blue.yzw();
            if number == tracer.wavelengths.len() / 2 {
                pixel.coverage += f64::from(u8::from(sum.met));
            }
        }
        pixel.radiance += total.radiance;
        pixel.truncated += total.truncated();
    }

    /// The tree below a camera ray; its light by bounce goes to the pixel.
    fn tree<P: Policy, const UNIFORM: bool, const LENGTHS: bool>(
        &mut self,
        flight: Flight<W>,
        wavelength: &Wavelength,
        policy: P,
        pixel: &mut Pixel,
    ) -> Sum {
        self.bounces.clear();
        self.bounces.resize(self.image.layers.bounces, DVec3::ZERO);
        let tracer = self.image.tracer;
        let mut climb = Climb {
            optics: &wavelength.optics,
            policy,
            waiting: self.waiting,
            scratch: self.scratch,
            bounces: &mut self.bounces,
        };
        let sum = tracer.tree::<W, P, UNIFORM, LENGTHS>(flight, &mut climb);
        for (total, bounce) in pixel.bounces.iter_mut().zip(&self.bounces) {
            *total += wavelength.share * *bounce;
        }
        sum
    }
}

/// Centre of one of the k x k cells of a pixel, from its corner.
fn cell_centre(index: u32, k: u32) -> DVec2 {
    (DVec2::new(f64::from(index % k), f64::from(index / k)) + 0.5) / f64::from(k)
}
