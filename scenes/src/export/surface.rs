//! Meshes as other formats want them: one index per corner, f64 positions,
//! normals only where the scene shades with them.

use super::{ExportError, Format, write_text};
use crate::{Mesh, Object, Shape, generate, normals, scene::Normals};
use glam::DVec3;
use std::collections::HashMap;
use std::fmt::Write as _;
use std::path::Path;

/// A mesh whose vertices carry at most one normal each.
pub(super) struct Indexed {
    pub(super) positions: Vec<DVec3>,
    pub(super) normals: Option<Vec<DVec3>>,
    pub(super) triangles: Vec<[u32; 3]>,
}

/// The object's triangles; `None` for shapes that have none. A box has twelve,
/// which are flat.
pub(super) fn indexed(object: &Object) -> Option<Indexed> {
    if let Shape::Box { half_extent_m } = *object.shape {
        let Mesh { positions, triangles, .. } = generate::cuboid(half_extent_m);
        return Some(Indexed { positions, triangles, normals: None });
    }
    let mesh = object.shape.mesh()?;
    let Some(corner) = mesh.normals.as_ref().filter(|_| object.normals == Normals::Smooth) else {
        let normals = (object.normals == Normals::Smooth).then(|| normals::smooth(mesh).values);
        return Some(Indexed {
            positions: mesh.positions.clone(),
            normals,
            triangles: mesh.triangles.clone(),
        });
    };
    let mut numbers = HashMap::new();
    let mut split = Indexed { positions: vec![], normals: Some(vec![]), triangles: vec![] };
    for (triangle, normals) in mesh.triangles.iter().zip(&corner.indices) {
        split.triangles.push([0, 1, 2].map(|corner_index| {
            let key = (triangle[corner_index], normals[corner_index]);
            *numbers.entry(key).or_insert_with(|| {
                split.positions.push(mesh.positions[key.0 as usize]);
                split.normals.get_or_insert_default().push(corner.values[key.1 as usize]);
                (split.positions.len() - 1) as u32
            })
        }));
    }
    Some(split)
}

/// Writes Wavefront OBJ with as many digits as an f64 has.
pub(super) fn write_obj(indexed: &Indexed, path: &Path) -> Result<(), ExportError> {
    let mut text = String::new();
    for p in &indexed.positions {
        let _ = writeln!(text, "v {} {} {}", p.x, p.y, p.z);
    }
    for n in indexed.normals.iter().flatten() {
        let _ = writeln!(text, "vn {} {} {}", n.x, n.y, n.z);
    }
    for triangle in &indexed.triangles {
        let [a, b, c] = triangle.map(|i| i + 1);
        let _ = match indexed.normals {
            Some(_) => writeln!(text, "f {a}//{a} {b}//{b} {c}//{c}"),
            None => writeln!(text, "f {a} {b} {c}"),
        };
    }
    write_text(path, &text)
}

/// The error for a shape that the format has no word for.
pub(super) fn unknown_shape(format: Format, object: &Object) -> ExportError {
    let what = match &*object.shape {
        Shape::Mesh(_) => "the mesh",
        Shape::Sphere { .. } => "the analytic sphere",
        Shape::Slab { .. } => "the unbounded slab",
        Shape::HalfSpace => "the half-space",
        Shape::Box { .. } => "the analytic box",
        Shape::Cylinder { .. } => "the analytic cylinder",
    };
    ExportError::Inexpressible {
        format,
        what: what.to_owned(),
        object: object.name.clone(),
        advice: "replace it by a mesh, for example a built-in of the same form".to_owned(),
    }
}

/// Two decimals more than f32, in the shortest form that reads back the same.
pub(super) fn numbers(values: impl IntoIterator<Item = f64>) -> String {
    let mut text = String::new();
    for value in values {
        if !text.is_empty() {
            text.push(' ');
        }
        let _ = write!(text, "{value}");
    }
    text
}
