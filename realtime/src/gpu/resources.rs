//! Named resources, and bind groups made from what a shader really uses.

use crate::wgsl::Shader;
use crate::{Error, Gpu};

use std::collections::BTreeMap;

/// Something that can be bound.
#[derive(Clone)]
pub(crate) enum Resource {
    Texture(wgpu::Texture, wgpu::TextureView),
    Buffer(wgpu::Buffer),
    Sampler(wgpu::Sampler),
}

/// Resources by the name of their global in WGSL.
#[derive(Default)]
pub(crate) struct Resources(BTreeMap<String, Resource>);

impl Resources {
    pub(crate) fn texture(&mut self, name: &str, texture: wgpu::Texture) {
        let view = texture.create_view(&wgpu::TextureViewDescriptor::default());
        self.0.insert(name.to_owned(), Resource::Texture(texture, view));
    }

    pub(crate) fn texture_as(
        &mut self,
        name: &str,
        texture: wgpu::Texture,
        dimension: wgpu::TextureViewDimension,
    ) {
        let view = texture.create_view(&wgpu::TextureViewDescriptor {
            dimension: Some(dimension),
            ..Default::default()
        });
        self.0.insert(name.to_owned(), Resource::Texture(texture, view));
    }

    /// One layer of an array of images, to draw into.
    pub(crate) fn layer(&mut self, name: &str, texture: &wgpu::Texture, layer: u32) {
        let view = texture.create_view(&wgpu::TextureViewDescriptor {
            dimension: Some(wgpu::TextureViewDimension::D2),
            base_array_layer: layer,
            array_layer_count: Some(1),
            ..Default::default()
        });
        self.0.insert(name.to_owned(), Resource::Texture(texture.clone(), view));
    }

    /// Lets others use what is called `name`, if it is there.
    pub(crate) fn share(&self, with: &mut Self, name: &str) {
        if let Some(resource) = self.0.get(name) {
            with.0.insert(name.to_owned(), resource.clone());
        }
    }

    pub(crate) fn buffer(&mut self, name: &str, buffer: wgpu::Buffer) {
        self.0.insert(name.to_owned(), Resource::Buffer(buffer));
    }

    pub(crate) fn sampler(&mut self, name: &str, sampler: wgpu::Sampler) {
        self.0.insert(name.to_owned(), Resource::Sampler(sampler));
    }

    pub(crate) fn view(&self, name: &str) -> &wgpu::TextureView {
        match self.0.get(name) {
            Some(Resource::Texture(_, view)) => view,
            _ => panic!("there is no texture {name}"),
        }
    }

    pub(crate) fn stored(&self, name: &str) -> &wgpu::Buffer {
        match self.0.get(name) {
            Some(Resource::Buffer(buffer)) => buffer,
            _ => panic!("there is no buffer {name}"),
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
        own: &[(&str, &wgpu::Buffer)],
    ) -> Result<wgpu::BindGroup, Error> {
        let mut used: Vec<_> = entry_points.iter().flat_map(|entry| shader.used(entry)).collect();
        used.sort();
        used.dedup();
        let mut entries = Vec::new();
        for global in &used {
            let name = global.name.strip_prefix("out_").unwrap_or(&global.name);
            let private = own.iter().find(|(own_name, _)| *own_name == name);
            let resource = match (private, self.0.get(&global.name).or_else(|| self.0.get(name))) {
                (Some((_, buffer)), _) => buffer.as_entire_binding(),
                (None, Some(Resource::Texture(_, view))) => {
                    wgpu::BindingResource::TextureView(view)
                }
                (None, Some(Resource::Buffer(buffer))) => buffer.as_entire_binding(),
                (None, Some(Resource::Sampler(sampler))) => wgpu::BindingResource::Sampler(sampler),
                (None, None) => {
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
