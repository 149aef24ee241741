//! Whether a mesh bounds a body: one answer for every renderer.

use super::edges::{edges, sides};
use super::orient::consistent;
use super::parts::{Part, inverted_part, parts};
use super::report::signed_volume;
use crate::Mesh;
use std::collections::HashSet;

/// Share of area times extent below which a volume is rounding and no volume.
const NO_VOLUME: f64 = 1e-14;

/// Why a mesh does not bound a solid.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
pub enum NotSolid {
    /// There is nothing.
    #[error("the mesh has no triangles")]
    Empty,
    /// The surface has holes.
    #[error(
        "the mesh is open: {boundary_edges} edges have a triangle on one side only{}, so inside \
         and outside are not defined", also(*.wrong_way)
    )]
    Open {
        /// Edges of one triangle only.
        boundary_edges: usize,
        /// Triangles that face the wrong way besides.
        wrong_way: usize,
    },
    /// Some triangles face the wrong way, and nothing else is amiss.
    #[error(
        "{faces} of {triangles} triangles run the wrong way: the mesh has no holes, but its \
         triangles disagree about which side is out"
    )]
    WrongWay {
        /// Triangles to turn.
        faces: usize,
        /// All triangles.
        triangles: usize,
    },
    /// Like a Möbius strip.
    #[error("the surface has only one side, so inside and outside cannot be told apart")]
    OneSided,
    /// More than two triangles at an edge, and not in pairs.
    #[error(
        "{unbalanced_edges} edges are shared by three or more triangles that do not pair up, so \
         inside and outside are not defined"
    )]
    Inconsistent {
        /// Edges with unequal use.
        unbalanced_edges: usize,
    },
    /// A surface without thickness.
    #[error(
        "every triangle is there twice, once in each sense: the surface has two sides and no \
         inside (volume 0)"
    )]
    TwoSided,
    /// The volumes of its parts cancel.
    #[error("the mesh encloses no volume ({signed_volume_m3:e} m³)")]
    Flat {
        /// Zero within rounding.
        signed_volume_m3: f64,
    },
    /// The surface faces inwards.
    #[error(
        "the mesh faces inwards (volume {signed_volume_m3:e} m³), so its inside is everything else"
    )]
    Inverted {
        /// Negative.
        signed_volume_m3: f64,
    },
    /// A part of it does, and is no cavity of another.
    #[error(
        "a part of {triangles} triangles around {centre} faces inwards (volume \
         {signed_volume_m3:e} m³) and lies in no other part, so it is no cavity"
    )]
    PartInverted {
        /// Triangles of the part.
        triangles: usize,
        /// Middle of its bounds, object space, metres.
        centre: glam::DVec3,
        /// Negative.
        signed_volume_m3: f64,
    },
}

fn also(wrong_way: usize) -> String {
    match wrong_way {
        0 => String::new(),
        count => format!(" and {count} triangles run the wrong way"),
    }
}

/// A body that no renderer can fill with a medium.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
#[error(
    "object \"{object}\": {reason}\n`snell mesh FILE` says where, and mends much of it (--repair \
     OUT.obj); or make the object opaque (surface = \"unlit\" or \"lambert\")"
)]
pub struct NotABody {
    /// Name of the object.
    pub object: String,
    /// What its mesh is instead.
    pub reason: NotSolid,
}

/// Holds a transparent object's mesh, if it is one, to have an inside. A mesh without triangles
/// has none and hides nothing; it passes.
///
/// # Errors
/// What is wrong with the mesh, and how to mend it.
pub fn must_be_body(object: &str, mesh: Option<&Mesh>) -> Result<(), NotABody> {
    match mesh {
        Some(mesh) if !mesh.triangles.is_empty() => {
            solid(mesh).map_err(|reason| NotABody { object: object.to_owned(), reason })
        }
        _ => Ok(()),
    }
}

/// Holds a welded mesh to be closed and to face outwards, cavities inwards.
///
/// # Errors
/// The first reason why not.
pub fn solid(mesh: &Mesh) -> Result<(), NotSolid> {
    if mesh.triangles.is_empty() {
        return Err(NotSolid::Empty);
    }
    let sides = sides(mesh);
    let (mut boundary_edges, mut wrong_edges, mut unbalanced_edges) = (0, 0, 0);
    for edge in edges(&sides) {
        let forward = edge.iter().filter(|side| side.is_forward(mesh)).count();
        match edge.len() {
            _ if 2 * forward == edge.len() => {}
            1 => boundary_edges += 1,
            2 => wrong_edges += 1,
            _ => unbalanced_edges += 1,
        }
    }
    let wrong_way = match wrong_edges {
        0 => 0,
        _ => consistent(mesh)
            .map_err(|_| NotSolid::OneSided)?
            .iter()
            .filter(|is_turned| **is_turned)
            .count(),
    };
    if boundary_edges > 0 {
        return Err(NotSolid::Open { boundary_edges, wrong_way });
    }
    if unbalanced_edges > 0 {
        return Err(NotSolid::Inconsistent { unbalanced_edges });
    }
    if wrong_edges > 0 {
        return Err(NotSolid::WrongWay { faces: wrong_way, triangles: mesh.triangles.len() });
    }
    encloses(mesh)
}

/// Holds a mesh without open edges to enclose a volume.
fn encloses(mesh: &Mesh) -> Result<(), NotSolid> {
    let signed_volume_m3 = signed_volume(mesh);
    let [low, high] = mesh.bounds();
    let area: f64 = (0..mesh.triangles.len()).map(|i| 0.5 * mesh.area_vector(i).length()).sum();
    if signed_volume_m3.abs() <= NO_VOLUME * area * (high - low).length() {
        let is_two_sided = opposed(mesh) == mesh.triangles.len();
        return Err(match is_two_sided {
            true => NotSolid::TwoSided,
            false => NotSolid::Flat { signed_volume_m3 },
        });
    }
    // NaN is no volume either.
    if signed_volume_m3.is_nan() || signed_volume_m3 < 0.0 {
        return Err(NotSolid::Inverted { signed_volume_m3 });
    }
    let parts = parts(mesh);
    match inverted_part(mesh, &parts) {
        None => Ok(()),
        Some(Part { triangles, bounds, signed_volume_m3, .. }) => Err(NotSolid::PartInverted {
            triangles: triangles.len(),
            centre: 0.5 * (bounds[0] + bounds[1]),
            signed_volume_m3: *signed_volume_m3,
        }),
    }
}

/// How many triangles are there in the opposite sense too.
#[must_use]
pub fn opposed(mesh: &Mesh) -> usize {
    use super::weld::cyclic;
    let all: HashSet<[u32; 3]> = mesh.triangles.iter().map(|t| cyclic(*t)).collect();
    mesh.triangles.iter().filter(|[a, b, c]| all.contains(&cyclic([*a, *c, *b]))).count()
}
