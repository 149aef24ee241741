//! From the statements of a file to a mesh, and what had to be decided on the way.

use super::Bad;
use super::statements::{Corner, Statements};
use crate::topology::{Removed, Seams, close_seams, weld};
use crate::{Mesh, mesh::CornerNormals, mesh::polygon, normals};
use glam::DVec3;

/// A file's mesh.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Model {
    /// Welded, without degenerate or repeated triangles.
    pub mesh: Mesh,
    /// Triangles that were left out.
    pub removed: Removed,
    /// Vertices that were taken for one though their last bits differ.
    pub seams: Seams,
    /// What the file's author may not expect, a sentence each.
    pub warnings: Vec<String>,
}

pub(super) fn parse(bytes: &[u8]) -> Result<Model, Bad> {
    let statements = Statements::read(bytes)?;
    let mut warnings = Vec::new();
    let cut = Triangles::of(&statements, &mut warnings);
    if cut.triangles.is_empty() {
        let what = "no faces; write at least one line like \"f 1 2 3\"".to_owned();
        return Err(Bad { line: None, what });
    }
    let at = |corner: u32| statements.corners[corner as usize];
    let mesh = Mesh {
        triangles: cut.triangles.iter().map(|t| t.map(|c| at(c).position)).collect(),
        positions: statements.positions.clone(),
        normals: None,
    };
    let (mesh, seams) = close_seams(&weld(&mesh));
    let (kept, removed) = crate::topology::kept(&mesh);
    let faces: Vec<DVec3> = kept.iter().map(|index| cut.facing[*index]).collect();
    let corners: Vec<[Corner; 3]> =
        kept.iter().map(|index| cut.triangles[*index].map(at)).collect();
    let triangles = kept.iter().map(|index| mesh.triangles[*index]).collect();
    let mut mesh = Mesh { triangles, ..mesh };
    mesh.normals = shading(&statements, &mesh, &corners, &faces, &mut warnings);
    warnings.extend(seams.warning());
    if removed.duplicate > 0 {
        warnings.push(format!("{} triangles repeat others and are left out", removed.duplicate));
    }
    Ok(Model { mesh, removed, seams, warnings })
}

/// Faces as triangles.
struct Triangles {
    /// Numbers of corners in the statements.
    triangles: Vec<[u32; 3]>,
    /// Unit normal of the whole face that each triangle is of; zero without area.
    facing: Vec<DVec3>,
}

impl Triangles {
    fn of(statements: &Statements, warnings: &mut Vec<String>) -> Self {
        let mut all = Self { triangles: Vec::new(), facing: Vec::new() };
        let (mut first, mut crossing) = (0, 0);
        for face in statements.faces() {
            let numbers: Vec<u32> = (first..).take(face.len()).collect();
            first += face.len() as u32;
            crossing += usize::from(all.add(statements, &numbers));
        }
        if crossing > 0 {
            warnings.push(format!(
                "{crossing} polygons cross themselves, so that what they cover is not defined"
            ));
        }
        if statements.too_small > 0 {
            let count = statements.too_small;
            warnings.push(format!("{count} faces of fewer than three corners are left out"));
        }
        for (word, count) in &statements.unread {
            warnings.push(format!("{count} free-form statements \"{word}\" are not read"));
        }
        all
    }

    /// Adds a face; true if it crosses itself.
    fn add(&mut self, statements: &Statements, numbers: &[u32]) -> bool {
        let at = |corner: &u32| {
            statements.positions[statements.corners[*corner as usize].position as usize]
        };
        let last = numbers.last().map(at);
        let mut before = last;
        // A corner where the one before it lies says nothing.
        let mut face: Vec<u32> = numbers
            .iter()
            .copied()
            .filter(|corner| before.replace(at(corner)) != Some(at(corner)))
            .collect();
        if face.len() < 3 {
            return false;
        }
        let mut corners: Vec<DVec3> = face.iter().map(at).collect();
        if face.len() > 3 {
            let first = polygon::first_corner(&corners);
            face.rotate_left(first);
            corners.rotate_left(first);
        }
        let cut = polygon::cut(&corners);
        let facing = polygon::area_vector(&corners).normalize_or_zero();
        self.facing.extend(cut.triangles.iter().map(|_| facing));
        self.triangles.extend(cut.triangles.iter().map(|t| t.map(|i| face[i as usize])));
        cut.crosses
    }
}

/// The normals of each corner: the file's, and where it has none, those of the
/// faces around. Nothing where all would be made and the triangles alone say the
/// same.
fn shading(
    statements: &Statements,
    mesh: &Mesh,
    corners: &[[Corner; 3]],
    faces: &[DVec3],
    warnings: &mut Vec<String>,
) -> Option<CornerNormals> {
    let mut number = vec![None; statements.normals.len()];
    let mut values = Vec::new();
    let (mut missing, mut unusable) = (0, 0);
    let mut given = |corner: Corner| {
        let Some(normal) = corner.normal.map(|index| index as usize) else {
            missing += 1;
            return None;
        };
        if number[normal].is_none() {
            number[normal] = statements.normals[normal].try_normalize().map(|n| {
                values.push(n);
                values.len() as u32 - 1
            });
        }
        unusable += usize::from(number[normal].is_none());
        number[normal]
    };
    let given: Vec<[Option<u32>; 3]> =
        corners.iter().map(|triangle| triangle.map(&mut given)).collect();
    let all = 3 * corners.len();
    warnings.extend(doubts(statements.normals_written, all, missing, unusable));
    let has_polygons = statements.faces().any(|face| face.len() > 3);
    if values.is_empty() && !has_polygons {
        return None;
    }
    let first_made = values.len() as u32;
    if missing + unusable > 0 {
        values.extend(normals::smooth_over(mesh, faces).values);
    }
    let indices = given.iter().zip(&mesh.triangles).map(|(given, triangle)| {
        std::array::from_fn(|i| given[i].unwrap_or(first_made + triangle[i]))
    });
    let indices = indices.collect();
    Some(CornerNormals { values, indices })
}

/// What to say of normals that could not be used.
fn doubts(written: usize, all: usize, missing: usize, unusable: usize) -> Vec<String> {
    let made = "normals are made from the faces there";
    let mut doubts = Vec::new();
    if missing == all && written > 0 {
        doubts.push(format!(
            "{written} normals (vn) are written and no face uses them: all are made from the faces"
        ));
    } else if missing > 0 && missing < all {
        doubts.push(format!("{missing} of {all} corners have no normal: {made}"));
    }
    if unusable > 0 {
        doubts.push(format!(
            "{unusable} of {all} corners have a normal that is zero or not a number: {made}"
        ));
    }
    doubts
}
