//! Meshes as other formats want them: one index per corner, f64 positions,
//! normals only where the scene shades with them.

use super::{ExportError, Format, write_text};
use crate::{Mesh, Object, Shape, generate, normals, scene::Normals};
use glam::{DVec2, DVec3};
use std::collections::HashMap;
use std::fmt::Write as _;
use std::path::Path;

/// Divisions of the icosahedron's edges that stand for a ball: 81,920 triangles.
const BALL: u32 = 64;
/// Sides that stand for a cylinder.
const ROUND: u32 = 512;
/// Edges sharper than this stay sharp, degrees.
const CREASE_DEG: f64 = 40.0;

/// A mesh whose vertices carry at most one normal each.
pub(super) struct Indexed {
    /// How far it is from the shape that it stands for, if it is not that shape.
    pub(super) told: Option<String>,
    pub(super) positions: Vec<DVec3>,
    pub(super) normals: Option<Vec<DVec3>>,
    pub(super) triangles: Vec<[u32; 3]>,
}

/// The object's triangles; `None` for shapes without bounds. A box has twelve, which
/// are flat; a ball and a cylinder have enough to look round, with exact normals at
/// their corners.
pub(super) fn indexed(object: &Object) -> Option<Indexed> {
    match *object.shape {
        Shape::Box { half_extent_m } => {
            let Mesh { positions, triangles, .. } = generate::cuboid(half_extent_m);
            Some(Indexed { told: None, positions, triangles, normals: None })
        }
        Shape::Sphere { radius_m } => Some(ball(object, radius_m)),
        Shape::Cylinder { radius_m, half_height_m } => {
            Some(cylinder(object, radius_m, half_height_m))
        }
        Shape::Slab { .. } | Shape::HalfSpace => None,
        Shape::Mesh(ref mesh) => Some(of_mesh(mesh, object.normals)),
    }
}

fn ball(object: &Object, radius_m: f64) -> Indexed {
    let Mesh { positions, triangles, .. } = generate::geodesic(BALL);
    let unit = Mesh { positions, triangles, normals: None };
    let depth = |i: usize| 1.0 - unit.corners(i)[0].dot(unit.area_vector(i).normalize_or_zero());
    let deepest = (0..unit.triangles.len()).map(depth).fold(0.0, f64::max);
    Indexed {
        told: Some(within(object, "ball", unit.triangles.len(), deepest)),
        positions: unit.positions.iter().map(|p| *p * radius_m).collect(),
        normals: Some(unit.positions),
        triangles: unit.triangles,
    }
}

fn cylinder(object: &Object, radius_m: f64, half_height_m: f64) -> Indexed {
    let (r, h) = (radius_m, half_height_m);
    let profile = [(0.0, -h), (r, -h), (r, h), (0.0, h)].map(|(x, y)| DVec2::new(x, y));
    let mut mesh = generate::revolve(&profile, ROUND, false);
    mesh.normals = Some(normals::creased(&mesh, CREASE_DEG));
    let deepest = 1.0 - (std::f64::consts::PI / f64::from(ROUND)).cos();
    let told = Some(within(object, "cylinder", mesh.triangles.len(), deepest));
    Indexed { told, ..of_mesh(&mesh, Normals::Smooth) }
}

fn within(object: &Object, kind: &str, triangles: usize, deepest: f64) -> String {
    format!(
        "the {kind} \"{}\" is written as {triangles} triangles, which lie up to {deepest:.1e} of \
         its radius below its surface",
        object.name
    )
}

fn of_mesh(mesh: &Mesh, shading: Normals) -> Indexed {
    let is_smooth = shading == Normals::Smooth;
    let Some(corner) = mesh.normals.as_ref().filter(|_| is_smooth) else {
        return Indexed {
            told: None,
            positions: mesh.positions.clone(),
            normals: is_smooth.then(|| normals::smooth(mesh).values),
            triangles: mesh.triangles.clone(),
        };
    };
    let mut numbers = HashMap::new();
    let mut split =
        Indexed { told: None, positions: vec![], normals: Some(vec![]), triangles: vec![] };
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
    split
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

/// The error for a shape without bounds, which no format has a word for.
pub(super) fn without_bounds(format: Format, object: &Object) -> ExportError {
    let what = match *object.shape {
        Shape::HalfSpace => "the half-space",
        _ => "the unbounded slab",
    };
    ExportError::Inexpressible {
        format,
        what: what.to_owned(),
        object: object.name.clone(),
        advice: "no format can: write box = { half_extent_m = [x, y, z] }, wider than the camera \
                 sees"
            .to_owned(),
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
