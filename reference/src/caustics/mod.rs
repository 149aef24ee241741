//! Caustics: the light that lights send to a receiver, straight and through
//! glass, by following photons from the lights.
//!
//! A photon starts at a light, towards a ball around the receiver and all
//! glass. At every interface it is reflected or transmitted at random, by
//! Fresnel's equations, and loses what media absorb; on an opaque surface it
//! ends. Those that end on the receiver's face are counted in bins. So a map
//! holds *all* light of the scene's lights on that face, shadows included:
//! whoever shades with it leaves the direct light out, and nothing is counted
//! twice.
//!
//! Photons carry power, and a surface that is bent by interpolated normals
//! turns them without changing the width of their bundle (Veach 1997, 5.3): on
//! meshes with smooth normals a map is as exact as those normals are.

mod emission;
mod photon;

use crate::error::Error;
use crate::receiver::face::Face;
use crate::receiver::map::{Balance, CausticMap};
use crate::request::{Keep, Level, Request, Spectrum};
use crate::sampling::sobol::Points;
use crate::transport::spectrum;
use crate::transport::tracer::Tracer;
use crate::transport::variant::{Specialised, Variant};
use crate::world::World;
use crate::world::scratch::Scratch;
use crate::world::winding::Winding;
use emission::Emission;
use glam::DVec3;
use photon::{Deposit, Tally, photon};
use rayon::prelude::*;
use scenes::{Camera, Projection, Scene, View};
use std::ops::Range;

/// A map of the light on an object's face.
#[derive(Clone, Debug, PartialEq)]
pub struct CausticsRequest {
    /// Index into the scene's objects of an opaque box (its upper face, +y, is
    /// the map) or of a mesh of two triangles that make a parallelogram.
    pub receiver: usize,
    /// Bins along the face's two sides.
    pub size_bins: [u32; 2],
    /// Photons per light, over all batches.
    pub photons: u64,
    /// Independent batches, at least 2, from which the variance is taken.
    pub batches: u32,
    /// Seed of the photons.
    pub seed: u64,
    /// Frame of the scene's sequence.
    pub frame: u32,
}

/// Photons of one piece of parallel work.
const CHUNK: u64 = 16_384;
/// Pieces whose deposits are held at once.
const CHUNKS: u64 = 64;

/// Follows photons from the scene's lights to a receiver.
///
/// The map is the same, bit by bit, for any number of threads.
///
/// # Errors
/// The receiver is no opaque face, the scene has no lights, unbounded glass, or
/// what [`crate::render`] refuses.
pub fn caustics(scene: &Scene, request: &CausticsRequest) -> Result<CausticMap, Error> {
    let face = check(scene, request)?;
    let world = World::new(scene, request.frame, Level::R2)?;
    // Photons start anywhere, as rays of an orthographic camera do.
    let projection = Projection::Orthographic { height_m: 1.0 };
    let camera = Camera { projection, ..scene.camera };
    let view = View { resolution_px: [1, 1], positions_per_axis: 1, frame: 0, layers: vec![] };
    let plain = Request::new(view, Level::R2);
    let tracer = Tracer::new(scene, &world, &camera, &plain);
    let run = PhotonRun { scene, request, tracer: &tracer, face };
    Ok(Variant::new(scene, &world, Keep::Needed, false).run(&run))
}

fn check(scene: &Scene, request: &CausticsRequest) -> Result<Face, Error> {
    let range = |name, value: String, range| Error::Range { name, value, range };
    let [columns, rows] = request.size_bins;
    if !(1..=16_384).contains(&columns) || !(1..=16_384).contains(&rows) {
        let size = format!("{columns} x {rows}");
        return Err(range("bins", size, "1 to 16384 a side"));
    }
    if request.batches < 2 || request.photons < u64::from(request.batches) {
        let value = format!("{} in {} batches", request.photons, request.batches);
        return Err(range("photons", value, "at least 2 batches and a photon in each"));
    }
    if request.photons / u64::from(request.batches) > u64::from(u32::MAX) {
        let value = request.photons.to_string();
        return Err(range("photons", value, "at most 4294967295 per batch"));
    }
    spectrum::check(scene, Spectrum::Channels)?;
    if scene.lights.is_empty() {
        return Err(Error::NoLights);
    }
    emission::must_be_bounded(scene)?;
    Face::of(scene, request.receiver, request.frame)
}

struct PhotonRun<'a> {
    scene: &'a Scene,
    request: &'a CausticsRequest,
    tracer: &'a Tracer<'a>,
    face: Face,
}

impl Specialised for &PhotonRun<'_> {
    type Output = CausticMap;

    fn run<W, const UNIFORM: bool, const LENGTHS: bool>(self) -> CausticMap
    where
        W: Winding + Send + Sync,
    {
        self.map::<W, LENGTHS>()
    }
}

/// Irradiance per bin over batches: mean and sum of squared deviations so far
/// (Welford 1962).
struct Estimates {
    mean: Vec<DVec3>,
    squares: Vec<DVec3>,
}

impl Estimates {
    fn new(bins: usize) -> Self {
        Self { mean: vec![DVec3::ZERO; bins], squares: vec![DVec3::ZERO; bins] }
    }

    /// Adds a batch; `number`: from 0.
    fn add(&mut self, number: u32, estimate: &[DVec3]) {
        for ((mean, squares), estimate) in self.mean.iter_mut().zip(&mut self.squares).zip(estimate)
        {
            let step = *estimate - *mean;
            *mean += step / f64::from(number + 1);
            *squares += step * (*estimate - *mean);
        }
    }

    /// The mean and its variance.
    fn of_mean(self, batches: u32) -> (Vec<DVec3>, Vec<DVec3>) {
        let n = f64::from(batches);
        (self.mean, self.squares.into_iter().map(|sum| sum / (n * (n - 1.0))).collect())
    }
}

impl PhotonRun<'_> {
    fn map<W: Winding + Send + Sync, const LENGTHS: bool>(&self) -> CausticMap {
        let [columns, rows] = self.request.size_bins;
        let bins = columns as usize * rows as usize;
        let mut estimates = Estimates::new(bins);
        let mut balance = Balance::default();
        let aim = emission::target(self.scene, &self.face, self.request.frame);
        let lights = &self.scene.lights;
        let emissions: Vec<Emission<W>> =
            lights.iter().map(|light| Emission::new(light, &aim, self.tracer)).collect();
        let batches = self.request.batches;
        let per_batch = self.request.photons / u64::from(batches);
        let per_m2 = 1.0 / self.face.area_m2() * f64::from(columns) * f64::from(rows);
        for batch in 0..batches {
            let mut estimate = vec![DVec3::ZERO; bins];
            for (index, emission) in emissions.iter().enumerate() {
                let mut power = vec![DVec3::ZERO; bins];
                let numbers = [batch, index as u32];
                let tally = self.batch::<W, LENGTHS>(emission, numbers, per_batch, &mut power);
                // Photons are counted in units of one photon's power.
                let unit = emission.power / per_batch as f64;
                tally.add_to(&mut balance, unit / f64::from(batches));
                for (sum, power) in estimate.iter_mut().zip(&power) {
                    *sum += *power * unit * per_m2;
                }
            }
            estimates.add(batch, &estimate);
        }
        let (irradiance, variance) = estimates.of_mean(batches);
        let (receiver, size_bins) = (self.request.receiver, [columns, rows]);
        CausticMap { receiver, size_bins, irradiance, variance, balance, face: self.face }
    }

    /// The photons of one light in one batch.
    fn batch<W: Winding + Send + Sync, const LENGTHS: bool>(
        &self,
        emission: &Emission<W>,
        [batch, light]: [u32; 2],
        count: u64,
        power: &mut [DVec3],
    ) -> Tally {
        let points = Points::new(self.request.seed, light.into(), batch);
        let mut tally = Tally::default();
        let mut first = 0;
        while first < count {
            let end = count.min(first + CHUNK * CHUNKS);
            let chunks: Vec<u64> = (first..end).step_by(CHUNK as usize).collect();
            let work = |start: &u64| {
                self.chunk::<W, LENGTHS>(emission, &points, *start..end.min(start + CHUNK))
            };
            // In order, so that sums do not depend on who finished first.
            let done: Vec<(Vec<Deposit>, Tally)> = chunks.par_iter().map(work).collect();
            for (deposits, part) in done {
                tally.merge(&part);
                deposits.iter().for_each(|deposit| power[deposit.bin as usize] += deposit.share);
            }
            first = end;
        }
        tally
    }

    /// Some photons of a light, in order.
    fn chunk<W: Winding, const LENGTHS: bool>(
        &self,
        emission: &Emission<W>,
        points: &Points,
        photons: Range<u64>,
    ) -> (Vec<Deposit>, Tally) {
        let target = photon::Target {
            receiver: self.request.receiver,
            face: &self.face,
            size_bins: self.request.size_bins,
        };
        let mut scratch = Scratch::default();
        let (mut deposits, mut tally) = (Vec::new(), Tally::default());
        for sample in photons {
            let flight = emission.start(points, sample as u32);
            let draws = photon::Draws::new(*points, sample as u32);
            let one = photon::<W, LENGTHS>(self.tracer, &target, flight, draws, &mut scratch);
            tally.count(&one, &mut deposits);
        }
        (deposits, tally)
    }
}
