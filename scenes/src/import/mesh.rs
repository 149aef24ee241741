//! Triangles of a glTF primitive.

use super::{ImportError, Reader};
use crate::{Mesh, mesh::CornerNormals};
use glam::DVec3;
use std::collections::HashMap;

impl Reader<'_> {
    pub(super) fn mesh_of(
        &self,
        primitive: &gltf::Primitive<'_>,
        name: &str,
    ) -> Result<Mesh, ImportError> {
        let wrong = |what: &str| self.wrong(name, what);
        let reader =
            primitive.reader(|buffer| self.buffers.get(buffer.index()).map(|data| &data.0[..]));
        let vector = |v: [f32; 3]| DVec3::from_array(v.map(f64::from));
        let corners: Vec<DVec3> = reader
            .read_positions()
            .ok_or_else(|| wrong("has no POSITION; export it with positions"))?
            .map(vector)
            .collect();
        if !corners.iter().all(|p| p.is_finite()) {
            return Err(wrong("a position is not finite; repair the mesh"));
        }
        let indices: Vec<u32> = match reader.read_indices() {
            Some(indices) => indices.into_u32().collect(),
            None => (0..corners.len() as u32).collect(),
        };
        if indices.iter().any(|index| *index as usize >= corners.len()) {
            return Err(wrong("an index points beyond the last vertex; repair the mesh"));
        }
        let triangles: Vec<[u32; 3]> =
            indices.chunks_exact(3).map(|t| [t[0], t[1], t[2]]).collect();
        let normals = reader.read_normals().map(|normals| CornerNormals {
            values: normals.map(|n| vector(n).normalize_or(DVec3::Y)).collect(),
            indices: triangles.clone(),
        });
        if normals.as_ref().is_some_and(|normals| normals.values.len() != corners.len()) {
            return Err(wrong("NORMAL and POSITION differ in length; repair the mesh"));
        }
        Ok(welded(&corners, &triangles, normals))
    }
}

/// One position per distinct point, so that shared edges share indices.
fn welded(corners: &[DVec3], triangles: &[[u32; 3]], normals: Option<CornerNormals>) -> Mesh {
    let mut numbers: HashMap<[u64; 3], u32> = HashMap::new();
    let mut positions = Vec::new();
    let number: Vec<u32> = corners
        .iter()
        .map(|p| {
            // Adding zero makes -0 and +0 the same bits.
            let bits = (*p + DVec3::ZERO).to_array().map(f64::to_bits);
            *numbers.entry(bits).or_insert_with(|| {
                positions.push(*p);
                (positions.len() - 1) as u32
            })
        })
        .collect();
    let triangles = triangles.iter().map(|t| t.map(|i| number[i as usize])).collect();
    Mesh { positions, triangles, normals }
}
