//! Triangles of a glTF primitive.

use super::accessor::vectors;
use super::{ImportError, Reader};
use crate::obj::Model;
use crate::topology::{close_seams, kept};
use crate::{Mesh, mesh::CornerNormals, normals};
use glam::DVec3;
use gltf::Semantic;
use std::collections::HashMap;

impl Reader<'_> {
    pub(super) fn mesh_of(
        &self,
        primitive: &gltf::Primitive<'_>,
        name: &str,
    ) -> Result<Model, ImportError> {
        let wrong = |what: &str| self.wrong(name, what);
        if primitive.mode() != gltf::mesh::Mode::Triangles {
            let mode = primitive.mode();
            return Err(wrong(&format!("{mode:?} are not rendered; export plain triangles")));
        }
        if primitive.morph_targets().next().is_some() {
            return Err(wrong("morph targets are not rendered; apply them and export"));
        }
        let attribute = |semantic: Semantic| {
            let accessor = primitive.get(&semantic)?;
            Some(vectors(accessor, self.buffers).ok_or_else(|| {
                wrong(&format!("{semantic:?} cannot be read; export it as 32-bit floats"))
            }))
        };
        let positions = attribute(Semantic::Positions)
            .ok_or_else(|| wrong("has no POSITION; export it with positions"))??;
        if !positions.iter().all(|p| p.is_finite()) {
            return Err(wrong("a position is not finite; repair the mesh"));
        }
        let given = attribute(Semantic::Normals).transpose()?;
        if given.as_ref().is_some_and(|normals| normals.len() != positions.len()) {
            return Err(wrong("NORMAL and POSITION differ in length; repair the mesh"));
        }
        let triangles = self.triangles_of(primitive, positions.len(), name)?;
        let (mesh, seams) = close_seams(&welded(&positions, &triangles));
        let (kept, removed) = kept(&mesh);
        let of_kept = |list: &[[u32; 3]]| kept.iter().map(|index| list[*index]).collect::<Vec<_>>();
        let mesh = Mesh { triangles: of_kept(&mesh.triangles), ..mesh };
        let mut model = Model { mesh, removed, seams, warnings: Vec::new() };
        if let Some(given) = given {
            shade(&mut model, &of_kept(&triangles), &given);
        }
        model.warnings.extend(seams.warning());
        if removed.duplicate > 0 {
            let count = removed.duplicate;
            model.warnings.push(format!("{count} triangles repeat others and are left out"));
        }
        Ok(model)
    }

    fn triangles_of(
        &self,
        primitive: &gltf::Primitive<'_>,
        count: usize,
        name: &str,
    ) -> Result<Vec<[u32; 3]>, ImportError> {
        let reader =
            primitive.reader(|buffer| self.buffers.get(buffer.index()).map(|data| &data.0[..]));
        let indices: Vec<u32> = match reader.read_indices() {
            Some(indices) => indices.into_u32().collect(),
            None => (0..count as u32).collect(),
        };
        if indices.iter().any(|index| *index as usize >= count) {
            let what = "an index points beyond the last vertex; repair the mesh";
            return Err(self.wrong(name, what));
        }
        Ok(indices.as_chunks().0.to_vec())
    }
}

/// One position per distinct point, in the order of the file, so that shared edges
/// share indices.
fn welded(corners: &[DVec3], triangles: &[[u32; 3]]) -> Mesh {
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
    Mesh { positions, triangles, normals: None }
}

/// Gives each corner the normal of its vertex in the file, or where that is zero or
/// not a number, one made from the faces around.
fn shade(model: &mut Model, corners: &[[u32; 3]], given: &[DVec3]) {
    let mesh = &model.mesh;
    let unit: Vec<Option<DVec3>> = given.iter().map(|n| n.try_normalize()).collect();
    let is_unusable = |vertex: &&u32| unit[**vertex as usize].is_none();
    let unusable = corners.iter().flatten().filter(is_unusable).count();
    // A vertex without a normal has a zero here, and no corner that points to it.
    let mut values: Vec<DVec3> = unit.iter().map(|n| n.unwrap_or_default()).collect();
    let made = values.len() as u32;
    if unusable > 0 {
        values.extend(normals::smooth(mesh).values);
        let all = 3 * corners.len();
        model.warnings.push(format!(
            "{unusable} of {all} corners have a normal that is zero or not a number: normals are \
             made from the faces there"
        ));
    }
    let indices = corners.iter().zip(&mesh.triangles).map(|(corner, triangle)| {
        std::array::from_fn(|i| match unit[corner[i] as usize] {
            Some(_) => corner[i],
            None => made + triangle[i],
        })
    });
    let indices = indices.collect();
    model.mesh.normals = Some(CornerNormals { values, indices });
}
