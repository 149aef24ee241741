//! Shapes in their own space: meshes, and the analytic ones that carry no
//! tessellation error.

use crate::Mesh;
use glam::DVec3;

/// A body in object space, metres before the object's transform.
#[derive(Clone, Debug, PartialEq)]
pub enum Shape {
    /// Triangles, counter-clockwise seen from outside.
    Mesh(Mesh),
    /// Ball about the origin.
    Sphere {
        /// Metres.
        radius_m: f64,
    },
    /// |z| ≤ thickness / 2, without bounds in x and y.
    Slab {
        /// Metres.
        thickness_m: f64,
    },
    /// The half-space y ≤ 0.
    HalfSpace,
    /// Axis-aligned box about the origin.
    Box {
        /// Half the edge lengths, metres.
        half_extent_m: DVec3,
    },
    /// Solid with caps about the origin, axis along y.
    Cylinder {
        /// Metres.
        radius_m: f64,
        /// Half the distance between the caps, metres.
        half_height_m: f64,
    },
}

/// The eight corners of a box given by its lowest and its highest one; bit k of a
/// corner's number says which of the two gives its coordinate k.
#[must_use]
pub fn box_corners([low, high]: [DVec3; 2]) -> [DVec3; 8] {
    std::array::from_fn(|corner| {
        let pick = |axis: usize| if corner >> axis & 1 == 0 { low[axis] } else { high[axis] };
        DVec3::new(pick(0), pick(1), pick(2))
    })
}

impl Shape {
    /// Corners of the bounding box in object space; infinite for unbounded shapes.
    #[must_use]
    pub fn bounds(&self) -> [DVec3; 2] {
        let symmetric = |half: DVec3| [-half, half];
        match self {
            Self::Mesh(mesh) => mesh.bounds(),
            Self::Sphere { radius_m } => symmetric(DVec3::splat(*radius_m)),
            Self::Slab { thickness_m } => {
                symmetric(DVec3::new(f64::INFINITY, f64::INFINITY, 0.5 * thickness_m))
            }
            Self::HalfSpace => [DVec3::NEG_INFINITY, DVec3::new(f64::INFINITY, 0.0, f64::INFINITY)],
            Self::Box { half_extent_m } => symmetric(*half_extent_m),
            Self::Cylinder { radius_m, half_height_m } => {
                symmetric(DVec3::new(*radius_m, *half_height_m, *radius_m))
            }
        }
    }

    /// The mesh, if this is one.
    #[must_use]
    pub fn mesh(&self) -> Option<&Mesh> {
        match self {
            Self::Mesh(mesh) => Some(mesh),
            _ => None,
        }
    }
}
