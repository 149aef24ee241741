//! Newell's teapot from its Bézier control points.
//!
//! Body, lid, rim and bottom are bodies of revolution: four quarter turns of a
//! profile, each quarter a cubic whose inner control points lie 0.56 of the
//! radius along the tangent (at the knob Newell wrote 0.45 for 0.8). Handle and
//! spout are mirrored halves of a ring swept along a path. So the 306 published
//! points follow from the tables below.
//!
//! Source: M. Newell's data (University of Utah, 1975, public domain) in the
//! proportions of J. Blinn, whose squashed version everybody uses.

use super::grid::add_patch;
use crate::Mesh;
use crate::topology::{clean, rims, weld};
use glam::{DVec2, DVec3};

/// (radius, height) of the body's profile from the bottom's centre to the rim.
const BODY: [(f64, f64); 13] = [
    (0.0, 0.0),
    (1.425, 0.0),
    (1.5, 0.075),
    (1.5, 0.15),
    (1.5, 0.225),
    (2.0, 0.45),
    (2.0, 0.9),
    (2.0, 1.35),
    (1.75, 1.875),
    (1.5, 2.4),
    (1.4375, 2.53125),
    (1.3375, 2.53125),
    (1.4, 2.4),
];
/// (radius, height) of the lid's profile from its edge to the top of the knob.
const LID: [(f64, f64); 7] =
    [(1.3, 2.4), (1.3, 2.55), (0.4, 2.55), (0.2, 2.7), (0.0, 2.85), (0.8, 3.15), (0.0, 3.15)];
/// Sections (inner x, z, outer x, z, half width) along the handle, from the top.
const HANDLE: [[f64; 5]; 7] = [
    [-1.6, 2.025, -1.5, 2.25, 0.3],
    [-2.3, 2.025, -2.5, 2.25, 0.3],
    [-2.7, 2.025, -3.0, 2.25, 0.3],
    [-2.7, 1.8, -3.0, 1.8, 0.3],
    [-2.7, 1.575, -3.0, 1.35, 0.3],
    [-2.5, 1.125, -2.65, 0.9375, 0.3],
    [-2.0, 0.9, -1.9, 0.6, 0.3],
];
/// The same along the spout, from the body to the mouth.
const SPOUT: [[f64; 5]; 7] = [
    [1.7, 1.425, 1.7, 0.6, 0.66],
    [2.6, 1.425, 3.1, 0.825, 0.66],
    [2.3, 2.1, 2.4, 2.025, 0.25],
    [2.7, 2.4, 3.3, 2.4, 0.25],
    [2.8, 2.475, 3.525, 2.49375, 0.25],
    [2.9, 2.475, 3.45, 2.5125, 0.15],
    [2.8, 2.4, 3.2, 2.4, 0.15],
];

/// Four rows of four control points.
type Patch = [[DVec3; 4]; 4];

/// Newell's 32 patches, each divided into `divisions`² quads, as published:
/// open where handle, spout and lid meet the body, and with triangles without
/// area at the knob and at the bottom's centre. 15 divisions: 14,400 triangles,
/// 120 of them degenerate, 240 boundary edges.
///
/// Three units of Newell's are one metre; y is up and the bottom at y = 0. At
/// least 2 divisions are made.
#[must_use]
pub fn teapot_newell(divisions: u32) -> Mesh {
    let divisions = divisions.max(2);
    let mut mesh = Mesh::default();
    let patches = [turned(&BODY), turned(&LID), swept(&HANDLE), swept(&SPOUT)];
    for patch in patches.iter().flatten() {
        add_bezier(&mut mesh, patch, [divisions, divisions]);
    }
    metres(&weld(&mesh))
}

/// The teapot as glass can be made of it: three closed solids that overlap,
/// body with lid, handle, and spout. The gap between body and lid is closed by
/// a ring, the ends of handle and spout by flat caps, and the triangles without
/// area are gone. Inside is where the winding number is positive.
#[must_use]
pub fn teapot(divisions: u32) -> Mesh {
    let divisions = divisions.max(2);
    let mut body = Mesh::default();
    for patch in turned(&BODY).iter().chain(&turned(&LID)) {
        add_bezier(&mut body, patch, [divisions, divisions]);
    }
    let (from, to) = (BODY[12], LID[0]);
    let seam =
        [0.0, 1.0 / 3.0, 2.0 / 3.0, 1.0].map(|t| DVec2::from(from).lerp(DVec2::from(to), t).into());
    for patch in turned(&seam) {
        add_bezier(&mut body, &patch, [divisions, 1]);
    }
    let mut teapot = clean(&weld(&body)).0;
    for sections in [HANDLE, SPOUT] {
        let mut tube = Mesh::default();
        for patch in swept(&sections) {
            add_bezier(&mut tube, &patch, [divisions, divisions]);
        }
        teapot.append(&capped(weld(&tube)));
    }
    metres(&teapot)
}

fn metres(mesh: &Mesh) -> Mesh {
    mesh.clone().with_positions(|p| DVec3::new(p.x, p.z, -p.y) / 3.0)
}

/// Closes every open ring by a flat polygon, which must be convex.
fn capped(mut tube: Mesh) -> Mesh {
    for ring in rims(&tube) {
        let ring = ring.vertices;
        // A strip that zigzags across, so that the triangles stay fat.
        let (mut low, mut high) = (0, ring.len() - 1);
        while high - low > 1 {
            let next = if low <= ring.len() - 1 - high { low + 1 } else { high - 1 };
            tube.triangles.push([ring[low], ring[high], ring[next]]);
            if next == low + 1 { low = next } else { high = next }
        }
    }
    tube
}

/// Patches of a profile turned about the z axis; rows run along the profile.
fn turned(profile: &[(f64, f64)]) -> Vec<Patch> {
    let quarter = [DVec2::X, DVec2::Y, DVec2::NEG_X, DVec2::NEG_Y];
    let mut patches = Vec::new();
    for piece in profile.windows(4).step_by(3) {
        for turn in 0..4 {
            let (a, b) = (quarter[turn], quarter[(turn + 1) % 4]);
            patches.push([0, 1, 2, 3].map(|row: usize| {
                let (r, z) = piece[row];
                let k = if (r, z) == (0.8, 3.15) { 0.45 } else { 0.56 * r };
                [r * a, r * a + k * b, k * a + r * b, r * b].map(|p| p.extend(z))
            }));
        }
    }
    patches
}

/// Patches of a mirrored half ring swept along sections.
fn swept(sections: &[[f64; 5]; 7]) -> Vec<Patch> {
    let mut patches = Vec::new();
    for piece in sections.windows(4).step_by(3) {
        for side in [-1.0, 1.0] {
            patches.push([0, 1, 2, 3].map(|row: usize| {
                let [x0, z0, x1, z1, half] = piece[row];
                let (inner, outer) = (DVec3::new(x0, 0.0, z0), DVec3::new(x1, 0.0, z1));
                let out = DVec3::new(0.0, side * half, 0.0);
                let arc = [inner, inner + out, outer + out, outer];
                if side < 0.0 { arc } else { [arc[3], arc[2], arc[1], arc[0]] }
            }));
        }
    }
    patches
}

/// Adds a patch divided into the given numbers of quads.
fn add_bezier(mesh: &mut Mesh, patch: &Patch, [across, along]: [u32; 2]) {
    add_patch(mesh, across, along, |i, j| {
        let u = f64::from(i) / f64::from(across);
        cubic(patch.map(|row| cubic(row, u)), f64::from(j) / f64::from(along))
    });
}

/// Point on a Bézier curve by de Casteljau's construction, which is exact at
/// both ends and where all points are equal: so patches meet without a gap.
fn cubic([a, b, c, d]: [DVec3; 4], t: f64) -> DVec3 {
    let [ab, bc, cd] = [between(a, b, t), between(b, c, t), between(c, d, t)];
    between(between(ab, bc, t), between(bc, cd, t), t)
}

fn between(a: DVec3, b: DVec3, t: f64) -> DVec3 {
    if t < 0.5 { a + (b - a) * t } else { b - (b - a) * (1.0 - t) }
}
