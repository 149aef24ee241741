//! Vectors as glTF stores them: as floats or, with `KHR_mesh_quantization`, as
//! whole numbers.

use glam::DVec3;
use gltf::accessor::{DataType, Dimensions, Item, Iter};

/// The vectors of an accessor; `None` if it holds none or its data is not there.
///
/// Normalised whole numbers are c / (2^bits - 1), signed ones c / (2^(bits - 1) - 1)
/// and at least -1. Source: glTF 2.0 specification, §3.11.
pub(super) fn vectors(
    accessor: gltf::Accessor<'_>,
    buffers: &[gltf::buffer::Data],
) -> Option<Vec<DVec3>> {
    if accessor.dimensions() != Dimensions::Vec3 {
        return None;
    }
    let full = |full: f64| accessor.normalized().then_some(full);
    match accessor.data_type() {
        DataType::F32 => read::<f32>(&accessor, buffers, None),
        DataType::I8 => read::<i8>(&accessor, buffers, full(127.0)),
        DataType::U8 => read::<u8>(&accessor, buffers, full(255.0)),
        DataType::I16 => read::<i16>(&accessor, buffers, full(32_767.0)),
        DataType::U16 => read::<u16>(&accessor, buffers, full(65_535.0)),
        DataType::U32 => None,
    }
}

fn read<T: Item + Copy + Into<f64>>(
    accessor: &gltf::Accessor<'_>,
    buffers: &[gltf::buffer::Data],
    full: Option<f64>,
) -> Option<Vec<DVec3>> {
    let data = |buffer: gltf::Buffer<'_>| buffers.get(buffer.index()).map(|data| &data.0[..]);
    let number = |value: T| match full {
        Some(full) => (value.into() / full).max(-1.0),
        None => value.into(),
    };
    let vectors = Iter::<[T; 3]>::new(accessor.clone(), data)?;
    Some(vectors.map(|v| DVec3::from_array(v.map(number))).collect())
}
