//! What passes hand on, and bind groups made from what a shader really uses.

use crate::error::Error;
use crate::gpu::Gpu;
use crate::wgsl::Shader;

use std::collections::BTreeMap;

/// Something that can be bound.
#[derive(Clone)]
pub(crate) enum Resource {
    Texture(wgpu::Texture, wgpu::TextureView),
    Buffer(wgpu::Buffer),
    Sampler(wgpu::Sampler),
}

/// What a pass hands on: each by the name of the global that reads it in WGSL.
#[derive(Clone, Default)]
pub(crate) struct Outputs(BTreeMap<&'static str, Resource>);

impl Outputs {
    pub(crate) fn texture(&mut self, name: &'static str, texture: wgpu::Texture) {
        let view = texture.create_view(&wgpu::TextureViewDescriptor::default());
        self.0.insert(name, Resource::Texture(texture, view));
    }

    pub(crate) fn texture_as(
        &mut self,
        name: &'static str,
        texture: wgpu::Texture,
        dimension: wgpu::TextureViewDimension,
    ) {
        let view = texture.create_view(&wgpu::TextureViewDescriptor {
            dimension: Some(dimension),
            ..Default::default()
        });
        self.0.insert(name, Resource::Texture(texture, view));
    }

    /// One layer of an array of images, to draw into.
    pub(crate) fn layer(&mut self, name: &'static str, texture: &wgpu::Texture, layer: u32) {
        let view = texture.create_view(&wgpu::TextureViewDescriptor {
            dimension: Some(wgpu::TextureViewDimension::D2),
            base_array_layer: layer,
            array_layer_count: Some(1),
            ..Default::default()
        });
        self.0.insert(name, Resource::Texture(texture.clone(), view));
    }

    /// These, and of what was handed on before all that they do not hide.
    pub(crate) fn over(mut self, before: &Self) -> Self {
        for (name, resource) in &before.0 {
            self.0.entry(name).or_insert_with(|| resource.clone());
        }
        self
    }

    /// Only what has one of the names.
    pub(crate) fn only(mut self, names: &[&str]) -> Self {
        self.0.retain(|name, _| names.contains(name));
        self
    }

    pub(crate) fn buffer(&mut self, name: &'static str, buffer: wgpu::Buffer) {
        self.0.insert(name, Resource::Buffer(buffer));
    }

    pub(crate) fn sampler(&mut self, name: &'static str, sampler: wgpu::Sampler) {
        self.0.insert(name, Resource::Sampler(sampler));
    }

    pub(crate) fn view(&self, name: &str) -> Option<&wgpu::TextureView> {
        match self.0.get(name) {
            Some(Resource::Texture(_, view)) => Some(view),
            _ => None,
        }
    }

    pub(crate) fn stored(&self, name: &str) -> &wgpu::Buffer {
        self.buffer_named(name).unwrap_or_else(|| panic!("there is no buffer {name}"))
    }

    pub(crate) fn buffer_named(&self, name: &str) -> Option<&wgpu::Buffer> {
        match self.0.get(name) {
            Some(Resource::Buffer(buffer)) => Some(buffer),
            _ => None,
        }
    }

    pub(crate) fn image(&self, name: &str) -> Option<&wgpu::Texture> {
        match self.0.get(name) {
            Some(Resource::Texture(texture, _)) => Some(texture),
            _ => None,
        }
    }

    /// The bind group of an entry point: its globals, found by name.
    pub(crate) fn bind(
        &self,
        gpu: &Gpu,
        shader: &Shader,
        entry_points: &[&str],
        layout: &wgpu::BindGroupLayout,
    ) -> Result<wgpu::BindGroup, Error> {
        let mut used: Vec<_> = entry_points.iter().flat_map(|entry| shader.used(entry)).collect();
        used.sort();
        used.dedup();
        let mut entries = Vec::new();
        for global in &used {
            let name = global.name.strip_prefix("out_").unwrap_or(&global.name);
            let resource = match self.0.get(global.name.as_str()).or_else(|| self.0.get(name)) {
                Some(Resource::Texture(_, view)) => wgpu::BindingResource::TextureView(view),
                Some(Resource::Buffer(buffer)) => buffer.as_entire_binding(),
                Some(Resource::Sampler(sampler)) => wgpu::BindingResource::Sampler(sampler),
                None => {
                    return Err(Error::Shader(format!(
                        "nothing is called {name}, which the shader reads"
                    )));
                }
            };
            entries.push(wgpu::BindGroupEntry { binding: global.binding, resource });
        }
        let descriptor = wgpu::BindGroupDescriptor { label: None, layout, entries: &entries };
        Ok(gpu.device.create_bind_group(&descriptor))
    }
}
