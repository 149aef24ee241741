//! Turning triangles so that a closed surface faces outwards.

use super::edges::{edges, sides};
use super::{inspect, report::signed_volume};
use crate::Mesh;

/// Why no choice of orientations makes a surface consistent.
#[derive(Clone, Copy, Debug, PartialEq, Eq, thiserror::Error)]
#[error(
    "the surface has only one side (around triangle {triangle}): inside and outside cannot be \
     told apart; repair the model"
)]
pub struct NotOrientable {
    /// Where the contradiction appeared.
    pub triangle: usize,
}

/// Turns triangles so that neighbours agree and the enclosed volume is
/// positive; returns how many were turned.
///
/// A part that is consistent already keeps its sense, so cavities stay
/// cavities; a part that had to be repaired is made to face outwards; if the
/// whole volume is negative after that, everything is reversed. Only edges of
/// exactly two triangles carry the sense from one to the next. Open parts are
/// made consistent, but have no outside to face.
///
/// # Errors
/// If a part is one-sided, like a Möbius strip; the mesh is then unchanged.
pub fn orient_outward(mesh: &mut Mesh) -> Result<usize, NotOrientable> {
    let is_turned = consistent(mesh)?;
    let count = is_turned.iter().filter(|turned| **turned).count();
    for (index, _) in is_turned.iter().enumerate().filter(|(_, turned)| **turned) {
        turn(mesh, index);
    }
    let is_closed = inspect(mesh).is_closed();
    if is_closed && signed_volume(mesh) < 0.0 {
        (0..mesh.triangles.len()).for_each(|index| turn(mesh, index));
        return Ok(mesh.triangles.len() - count);
    }
    Ok(count)
}

fn turn(mesh: &mut Mesh, index: usize) {
    mesh.triangles[index].swap(1, 2);
    if let Some(normals) = &mut mesh.normals {
        normals.indices[index].swap(1, 2);
    }
}

/// Which triangles must turn so that neighbours agree.
pub(super) fn consistent(mesh: &Mesh) -> Result<Vec<bool>, NotOrientable> {
    let neighbours = neighbours(mesh);
    let mut is_turned = vec![None; mesh.triangles.len()];
    for start in 0..mesh.triangles.len() {
        if is_turned[start].is_some() {
            continue;
        }
        is_turned[start] = Some(false);
        let mut part = vec![start];
        let mut at = 0;
        while let Some(triangle) = part.get(at).copied() {
            at += 1;
            let ours = is_turned[triangle] == Some(true);
            for (other, same_sense) in neighbours[triangle].iter().flatten() {
                let wanted = ours != *same_sense;
                match is_turned[*other] {
                    None => {
                        is_turned[*other] = Some(wanted);
                        part.push(*other);
                    }
                    Some(known) if known != wanted => {
                        return Err(NotOrientable { triangle: *other });
                    }
                    Some(_) => {}
                }
            }
        }
        face_out(mesh, &part, &mut is_turned);
    }
    Ok(is_turned.into_iter().map(|turned| turned == Some(true)).collect())
}

/// Makes a repaired part face outwards by its own volume.
fn face_out(mesh: &Mesh, part: &[usize], is_turned: &mut [Option<bool>]) {
    if part.iter().all(|triangle| is_turned[*triangle] == Some(false)) {
        return;
    }
    let origin = mesh.corners(part[0])[0];
    let volume: f64 = part
        .iter()
        .map(|triangle| {
            let [a, b, c] = mesh.corners(*triangle).map(|p| p - origin);
            let volume = a.dot(b.cross(c));
            if is_turned[*triangle] == Some(true) { -volume } else { volume }
        })
        .sum();
    if volume < 0.0 {
        for triangle in part {
            is_turned[*triangle] = is_turned[*triangle].map(|turned| !turned);
        }
    }
}

/// Up to three neighbours of each triangle across edges of exactly two
/// triangles, and whether both run along the edge in the same sense.
fn neighbours(mesh: &Mesh) -> Vec<[Option<(usize, bool)>; 3]> {
    let mut neighbours = vec![[None; 3]; mesh.triangles.len()];
    let sides = sides(mesh);
    for edge in edges(&sides) {
        let [one, two] = edge else { continue };
        let same = one.is_forward(mesh) == two.is_forward(mesh);
        neighbours[one.triangle()][one.corner as usize % 3] = Some((two.triangle(), same));
        neighbours[two.triangle()][two.corner as usize % 3] = Some((one.triangle(), same));
    }
    neighbours
}
