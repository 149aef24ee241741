//! What a raster pass does beside its shaders: which sides it draws, how depths
//! are compared, and how colours meet.

use super::raster_pass::{RasterPass, Sides, Target};
use crate::drawn::drawables::Corner;
use std::mem::size_of;

/// Entry points that read corners of triangles.
pub(crate) const MESH: [&str; 2] = ["mesh_vertex", "mesh_fragment"];

/// The pipeline of a pass, from the vertex and fragment entry points of a module.
pub(crate) fn pipeline(
    device: &wgpu::Device,
    raster: &RasterPass,
    module: &wgpu::ShaderModule,
    [vertex, fragment]: [&str; 2],
) -> wgpu::RenderPipeline {
    let mesh = vertex == MESH[0];
    let attributes = wgpu::vertex_attr_array![0 => Float32x3, 1 => Float32x3, 2 => Float32x3, 3 => Float32, 4 => Float32];
    let buffers = [Some(wgpu::VertexBufferLayout {
        array_stride: size_of::<Corner>() as u64,
        step_mode: wgpu::VertexStepMode::Vertex,
        attributes: &attributes,
    })];
    let targets = colour_states(raster);
    let options = wgpu::PipelineCompilationOptions::default;
    device.create_render_pipeline(&wgpu::RenderPipelineDescriptor {
        label: Some(raster.name),
        layout: None,
        vertex: wgpu::VertexState {
            module,
            entry_point: Some(vertex),
            compilation_options: options(),
            buffers: if mesh { &buffers } else { &[] },
        },
        primitive: wgpu::PrimitiveState {
            cull_mode: culled(raster.sides).filter(|_| mesh),
            ..Default::default()
        },
        depth_stencil: compare(raster.sides).map(depth_state),
        multisample: wgpu::MultisampleState::default(),
        fragment: Some(wgpu::FragmentState {
            module,
            entry_point: Some(fragment),
            compilation_options: options(),
            targets: &targets,
        }),
        multiview_mask: None,
        cache: None,
    })
}

fn depth_state(compare: wgpu::CompareFunction) -> wgpu::DepthStencilState {
    wgpu::DepthStencilState {
        format: wgpu::TextureFormat::Depth32Float,
        depth_write_enabled: Some(true),
        depth_compare: Some(compare),
        stencil: wgpu::StencilState::default(),
        bias: wgpu::DepthBiasState::default(),
    }
}

/// By location; what is not drawn has none.
fn colour_states(raster: &RasterPass) -> Vec<Option<wgpu::ColorTargetState>> {
    let locations = raster.targets.iter().map(|target| target.location + 1).max().unwrap_or(0);
    let mut states = vec![None; locations as usize];
    for target in &raster.targets {
        states[target.location as usize] = Some(colour_state(target, raster.sides));
    }
    states
}

fn colour_state(target: &Target, sides: Sides) -> wgpu::ColorTargetState {
    let write_mask = match sides {
        Sides::All => wgpu::ColorWrites::empty(),
        _ => wgpu::ColorWrites::ALL,
    };
    let add = |dst_factor| wgpu::BlendComponent {
        src_factor: wgpu::BlendFactor::One,
        dst_factor,
        operation: wgpu::BlendOperation::Add,
    };
    let factor = match sides {
        Sides::Sum => Some(wgpu::BlendFactor::One),
        Sides::Over => Some(wgpu::BlendFactor::OneMinusSrcAlpha),
        _ => None,
    };
    let largest = wgpu::BlendComponent {
        src_factor: wgpu::BlendFactor::One,
        dst_factor: wgpu::BlendFactor::One,
        operation: wgpu::BlendOperation::Max,
    };
    // A mask has one channel of 32 bits and is written, not summed.
    let factor = factor.filter(|_| target.format != wgpu::TextureFormat::R32Float);
    let blend = factor.map(|f| wgpu::BlendState { color: add(f), alpha: add(f) });
    let blend = match sides {
        Sides::Largest => Some(wgpu::BlendState { color: largest, alpha: largest }),
        _ => blend,
    };
    wgpu::ColorTargetState { format: target.format, blend, write_mask }
}

fn culled(sides: Sides) -> Option<wgpu::Face> {
    match sides {
        Sides::Front => Some(wgpu::Face::Back),
        Sides::Back { .. } => Some(wgpu::Face::Front),
        _ => None,
    }
}

/// Depth is 1 in front and 0 infinitely far away.
fn compare(sides: Sides) -> Option<wgpu::CompareFunction> {
    match sides {
        Sides::Back { farthest: true } | Sides::Outermost => Some(wgpu::CompareFunction::Less),
        Sides::Front | Sides::Back { farthest: false } => Some(wgpu::CompareFunction::Greater),
        // What is at 0 still covers the sky.
        Sides::Opaque => Some(wgpu::CompareFunction::GreaterEqual),
        // This pass writes a depth of its own, which grows with the distance.
        Sides::Nearest => Some(wgpu::CompareFunction::Less),
        _ => None,
    }
}
