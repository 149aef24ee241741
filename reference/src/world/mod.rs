//! The scene at one moment, in world space and ready to be traced.

mod bake;
mod convex;
pub(crate) mod crossing;
pub(crate) mod flight;
mod long_way;
pub(crate) mod scratch;
mod short_way;
#[cfg(test)]
mod watertight;
pub(crate) mod winding;

use crate::geometry::analytic_body::AnalyticBody;
use crate::geometry::bvh::Tree;
use crate::geometry::shading_normals::ShadingNormals;
use glam::{DAffine3, DVec3};
use scenes::MediumId;
use scenes::scene::Bump;

/// Bodies, what they are made of, and the tree over their triangles.
#[derive(Clone, Debug)]
pub(crate) struct World {
    pub(crate) tree: Tree,
    pub(crate) bodies: Vec<Body>,
    /// Bodies that are not in the tree.
    pub(crate) analytic: Vec<AnalyticBody>,
    /// Number of the first analytic body's entry; triangles have smaller ones.
    pub(crate) first_analytic: u32,
    /// Sorted by precedence.
    pub(crate) classes: Vec<Class>,
    /// Corners of a box around every body; infinite with unbounded ones.
    pub(crate) bounds: [DVec3; 2],
}

/// A kind of solid.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) struct Class {
    pub(crate) medium: MediumId,
    pub(crate) priority: i32,
}

/// One object of the scene.
#[derive(Clone, Debug)]
pub(crate) struct Body {
    /// Index into the scene's objects.
    pub(crate) object: usize,
    pub(crate) role: Role,
    pub(crate) world_from_object: DAffine3,
    pub(crate) object_from_world: DAffine3,
    /// Number of its first triangle.
    pub(crate) first_id: u32,
    /// Shading normals, if they differ from the geometric ones.
    pub(crate) smooth: Option<ShadingNormals>,
    /// Tilts shading normals.
    pub(crate) bump: Option<Bump>,
}

/// What a body's surface is.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Role {
    /// The boundary of a solid of this class.
    Solid(usize),
    /// An end of light.
    Opaque,
    /// A gap of air without thickness in solids of this class.
    Crack(usize),
}

impl Body {
    /// Index into the classes of a solid.
    pub(crate) fn class(&self) -> Option<usize> {
        if let Role::Solid(class) = self.role { Some(class) } else { None }
    }

    /// Its shading normals may differ from the geometric ones.
    pub(crate) fn has_shading_normals(&self) -> bool {
        self.smooth.is_some() || self.bump.is_some()
    }
}

impl World {
    /// Bytes held: tree, triangles, normals.
    pub(crate) fn bytes(&self) -> u64 {
        let smooth = self.bodies.iter().filter_map(|body| body.smooth.as_ref());
        self.tree.bytes() + smooth.map(ShadingNormals::bytes).sum::<u64>()
    }

    /// True when both numbers belong to one analytic body.
    pub(crate) fn same_analytic(&self, a: u32, b: u32) -> bool {
        let pair = |id: u32| id.checked_sub(self.first_analytic).map(|id| id / 2);
        pair(a).is_some() && pair(a) == pair(b)
    }
}
