//! From the images of a frame to layers.

use crate::composition::layer_images::LayerImage;
use crate::composition::outputs::{BUFFERS, SINGLE, buffers};
use crate::drawn::geometry::Geometry;
use crate::error::Error;
use crate::frame::Frame;
use crate::frames::FrameRequest;
use crate::gpu::Gpu;
use crate::gpu::readback;
use crate::methods::Method;
use crate::passes::peel;
use rayon::prelude::*;
use scenes::{LayerName, Layers, View};

/// A frame that was rendered, and what of it is kept.
pub(crate) struct Readout<'a> {
    pub(crate) gpu: &'a Gpu,
    pub(crate) method: &'static Method,
    pub(crate) geometry: &'a Geometry,
    /// As it was asked for.
    pub(crate) view: &'a View,
    pub(crate) frame: &'a Frame,
}

impl Readout<'_> {
    /// Reads every layer that a frame answers.
    pub(crate) fn read(&self, request: &FrameRequest, layers: &mut Layers) -> Result<(), Error> {
        if request.outputs.contains(&"radiance") {
            self.radiance(request.scale, layers)?;
        }
        if request.scale == 1 {
            self.single(request, layers)?;
            self.buffers(request, layers)?;
        }
        Ok(())
    }

    /// Means over k x k positions.
    fn radiance(&self, k: u32, layers: &mut Layers) -> Result<(), Error> {
        let values = self.image("radiance")?;
        let [width, height] = self.view.resolution_px.map(|n| n as usize);
        let k = k as usize;
        let mut radiance = vec![0.0; 3 * width * height];
        let mut coverage = vec![0.0; width * height];
        let rows = radiance.par_chunks_mut(3 * width).zip(coverage.par_chunks_mut(width));
        rows.zip(values.par_chunks(4 * width * k * k)).for_each(
            |((radiance, coverage), values)| {
                for (i, value) in values.chunks_exact(4).enumerate() {
                    let pixel = i % (width * k) / k;
                    for channel in 0..3 {
                        radiance[3 * pixel + channel] += f64::from(value[channel]);
                    }
                    coverage[pixel] += f64::from(value[3]);
                }
            },
        );
        let positions = (k * k) as f64;
        radiance.iter_mut().chain(&mut coverage).for_each(|value| *value /= positions);
        self.push(layers, LayerName::Radiance, 3, radiance);
        self.push(layers, LayerName::Coverage, 1, coverage);
        Ok(())
    }

    /// What shading says at pixel centres.
    fn single(&self, request: &FrameRequest, layers: &mut Layers) -> Result<(), Error> {
        for layer in &request.request.view.layers {
            let Some(row) = SINGLE.iter().find(|row| (row.is)(layer)) else { continue };
            let texels = self.image(row.output)?;
            let texels = texels.chunks_exact(4);
            match row.channel {
                Some(channel) => {
                    let values = texels.map(|v| f64::from(v[channel])).collect();
                    self.push(layers, layer.clone(), 1, values);
                }
                None => {
                    let origin = self.geometry.centre.to_array();
                    let origin = if row.is_position { origin } else { [0.0; 3] };
                    let vectors = texels.flat_map(|v| {
                        let written = f64::from(v[3]);
                        [0, 1, 2].map(|i| (f64::from(v[i]) + origin[i]) * written)
                    });
                    self.push(layers, layer.clone(), 3, vectors.collect());
                }
            }
        }
        Ok(())
    }

    fn buffers(&self, request: &FrameRequest, layers: &mut Layers) -> Result<(), Error> {
        for name in buffers(&request.request) {
            let values = self.buffer(name, layers.pixels())?;
            let channels = values.len() / layers.pixels();
            let (channels, values) = if channels == 4 {
                let vectors = values.chunks_exact(4).flat_map(|v| [v[0], v[1], v[2]]);
                (3, vectors.collect())
            } else {
                (channels, values)
            };
            self.push(layers, LayerName::Buffer(name.to_owned()), channels, values);
        }
        Ok(())
    }

    fn buffer(&self, name: &str, pixels: usize) -> Result<Vec<f64>, Error> {
        let outputs = &self.frame.outputs;
        // Nothing is cracked.
        if name == "crack_mask" && outputs.image(name).is_none() {
            return Ok(vec![0.0; pixels]);
        }
        if let (Some(image), Some(counted)) = (LayerImage::named(name), self.frame.counted()) {
            return peel::read(image, self.gpu, outputs, counted, self.geometry.nested);
        }
        if name == "thickness" {
            let (front, back) = (self.image("front_depth")?, self.image("back_depth")?);
            return Ok(back.iter().zip(&front).map(|(b, f)| f64::from((b - f).max(0.0))).collect());
        }
        Ok(self.image(name)?.into_iter().map(f64::from).collect())
    }

    fn image(&self, name: &str) -> Result<Vec<f32>, Error> {
        let texture = self.frame.outputs.image(name).ok_or_else(|| Error::UnknownLayer {
            method: self.method.id.to_owned(),
            layer: name.to_owned(),
            available: BUFFERS.join(", "),
        })?;
        let channels = if texture.format() == wgpu::TextureFormat::R32Float { 1 } else { 4 };
        readback::texture_values(self.gpu, texture, channels)
    }

    /// Keeps a layer if it was asked for.
    fn push(&self, layers: &mut Layers, name: LayerName, channels: usize, data: Vec<f64>) {
        if self.view.wants(&name) && layers.get(&name).is_none() {
            layers.push(name, channels, data);
        }
    }
}
