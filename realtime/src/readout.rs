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

/// Light, summed over positions in the pixels. Only what was asked for has room.
pub(crate) struct Light {
    radiance: Option<Vec<f64>>,
    coverage: Option<Vec<f64>>,
}

impl Light {
    /// Nothing yet.
    pub(crate) fn of(view: &View) -> Self {
        let pixels: usize = view.resolution_px.map(|n| n as usize).iter().product();
        let zeros = |name, channels| view.wants(&name).then(|| vec![0.0; channels * pixels]);
        let radiance = zeros(LayerName::Radiance, 3);
        Self { radiance, coverage: zeros(LayerName::Coverage, 1) }
    }

    /// Adds radiance and coverage, four numbers per pixel, from some pixel on.
    fn add(&mut self, first_pixel: usize, values: &[f32]) {
        let values = || values.chunks_exact(4);
        if let Some(radiance) = &mut self.radiance {
            for (sums, value) in radiance[3 * first_pixel..].chunks_exact_mut(3).zip(values()) {
                sums.iter_mut().zip(value).for_each(|(sum, value)| *sum += f64::from(*value));
            }
        }
        if let Some(coverage) = &mut self.coverage {
            let pixels = coverage[first_pixel..].iter_mut().zip(values());
            pixels.for_each(|(sum, value)| *sum += f64::from(value[3]));
        }
    }

    /// Keeps the means.
    pub(crate) fn keep(self, positions: usize, layers: &mut Layers) {
        let sums =
            [(LayerName::Radiance, 3, self.radiance), (LayerName::Coverage, 1, self.coverage)];
        for (name, channels, sums) in sums {
            if let Some(mut sums) = sums {
                sums.iter_mut().for_each(|sum| *sum /= positions as f64);
                layers.push(name, channels, sums);
            }
        }
    }
}

impl Readout<'_> {
    /// Adds what was shaded at one position.
    pub(crate) fn add_light(&self, light: &mut Light) -> Result<(), Error> {
        let mut first_pixel = 0;
        readback::texture_rows(self.gpu, self.texture("radiance")?, 4, |row| {
            light.add(first_pixel, row);
            first_pixel += row.len() / 4;
        })
    }

    /// Reads every layer that belongs to pixel centres.
    pub(crate) fn at_centres(
        &self,
        request: &FrameRequest,
        layers: &mut Layers,
    ) -> Result<(), Error> {
        self.single(request, layers)?;
        self.buffers(request, layers)
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
                    let origin = self.geometry.extent.origin.to_array();
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

    fn texture(&self, name: &str) -> Result<&wgpu::Texture, Error> {
        self.frame.outputs.image(name).ok_or_else(|| Error::UnknownLayer {
            method: self.method.id.to_owned(),
            layer: name.to_owned(),
            available: BUFFERS.join(", "),
        })
    }

    fn image(&self, name: &str) -> Result<Vec<f32>, Error> {
        let texture = self.texture(name)?;
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
