//! Rows of pixels in parallel: for each pixel, the chain through its centre and
//! the mean over its positions, as far as layers show them.

use super::layer_table::Pixel;
use super::pixel::PixelIntegrator;
use super::run::ImageRun;
use crate::error::Error;
use crate::transport::tree::Branch;
use crate::transport::variant::Specialised;
use crate::world::scratch::{Counters, Scratch};
use crate::world::winding::Winding;
use glam::DVec2;
use rayon::prelude::*;
use scenes::Layers;
use std::sync::atomic::{AtomicUsize, Ordering};

impl Specialised for &ImageRun<'_> {
    type Output = Result<(Layers, Counters), Error>;

    fn run<W, const UNIFORM: bool, const LENGTHS: bool>(self) -> Self::Output
    where
        W: Winding + Send + Sync,
    {
        let [width, height] = self.request.view.resolution_px;
        let done = AtomicUsize::new(0);
        let rows: Result<Vec<(Vec<f64>, Counters)>, Error> = (0..height)
            .into_par_iter()
            .map_init(
                || (Scratch::default(), Vec::new()),
                |(scratch, waiting), y| {
                    if self.watch.is_cancelled() {
                        return Err(Error::Cancelled);
                    }
                    let row = self.row::<W, UNIFORM, LENGTHS>(y, scratch, waiting);
                    let rows_done = done.fetch_add(1, Ordering::Relaxed) + 1;
                    if let Some(progress) = self.watch.progress {
                        progress(rows_done as f64 / f64::from(height));
                    }
                    Ok(row)
                },
            )
            .collect();
        let mut counters = Counters::default();
        let count = |(row, counted)| {
            counters.add(&counted);
            row
        };
        let rows: Vec<Vec<f64>> = rows?.into_iter().map(count).collect();
        Ok((self.layers.gather([width, height], &rows), counters))
    }
}

impl ImageRun<'_> {
    /// The numbers of one row, and the work that it took.
    fn row<W: Winding, const UNIFORM: bool, const LENGTHS: bool>(
        &self,
        y: u32,
        scratch: &mut Scratch,
        waiting: &mut Vec<Branch<W>>,
    ) -> (Vec<f64>, Counters) {
        scratch.counters = Counters::default();
        let width = self.request.view.resolution_px[0];
        let mut row = Vec::with_capacity(width as usize * self.layers.stride);
        for x in 0..width {
            let corner_px = DVec2::new(x.into(), y.into());
            let pixel = self.pixel::<W, UNIFORM, LENGTHS>(corner_px, scratch, waiting);
            self.layers.write(&pixel, &mut row);
        }
        (row, scratch.counters)
    }

    fn pixel<W: Winding, const UNIFORM: bool, const LENGTHS: bool>(
        &self,
        corner_px: DVec2,
        scratch: &mut Scratch,
        waiting: &mut Vec<Branch<W>>,
    ) -> Pixel {
        let mut pixel = Pixel::default();
        if self.layers.needs_chain() {
            let ray = self.camera.ray_through(corner_px + 0.5);
            let flight = self.tracer.launch(ray, scratch);
            pixel.chain = self.tracer.chain::<W, UNIFORM, LENGTHS>(flight, scratch);
        }
        if self.layers.needs_cracks() {
            let ray = self.camera.ray_through(corner_px + 0.5);
            pixel.crack = self.tracer.world.meets_crack::<W>(ray, scratch);
        }
        if self.layers.needs_mean() {
            let bounces = Vec::new();
            let mut integrator = PixelIntegrator { image: self, waiting, scratch, bounces };
            integrator.pixel::<UNIFORM, LENGTHS>(corner_px, &mut pixel);
        }
        pixel
    }
}
