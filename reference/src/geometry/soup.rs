//! The triangles of a world before a tree holds them. Each vertex is placed in
//! world space once, so that triangles which share it share its bits; corners
//! are copied only into the tree.

use crate::geometry::triangle::Triangle;
use glam::{DAffine3, DVec3};
use scenes::Shape;
use std::sync::Arc;

/// Triangles, numbered through from 0.
#[derive(Debug, Default)]
pub(crate) struct Soup {
    bodies: Vec<BodyTriangles>,
    count: usize,
}

/// The triangles of one body.
#[derive(Debug)]
struct BodyTriangles {
    first_id: u32,
    body: u32,
    positions: Vec<[f64; 3]>,
    corners: Corners,
    /// The last two corners are swapped, so that triangles run counter-clockwise.
    mirrored: bool,
}

/// Which positions a triangle has.
#[derive(Debug)]
enum Corners {
    /// Three after three.
    InOrder,
    /// As a mesh says.
    Mesh(Arc<Shape>),
}

impl Soup {
    /// Triangles given by their corners, of body 0.
    pub(crate) fn of_corners(corners: &[[DVec3; 3]]) -> Self {
        let positions = corners.iter().flatten().map(DVec3::to_array).collect();
        let corners_of = Corners::InOrder;
        let body =
            BodyTriangles { first_id: 0, body: 0, positions, corners: corners_of, mirrored: false };
        Self { bodies: vec![body], count: corners.len() }
    }

    /// Adds the triangles of a shape, if it is a mesh.
    pub(crate) fn add(&mut self, shape: &Arc<Shape>, place: DAffine3, body: u32) {
        let Some(mesh) = shape.mesh() else { return };
        let positions = mesh.positions.iter().map(|p| place.transform_point3(*p).to_array());
        self.bodies.push(BodyTriangles {
            first_id: self.count as u32,
            body,
            positions: positions.collect(),
            corners: Corners::Mesh(Arc::clone(shape)),
            mirrored: place.matrix3.determinant() < 0.0,
        });
        self.count += mesh.triangles.len();
    }

    pub(crate) fn len(&self) -> usize {
        self.count
    }

    /// A triangle by its number.
    pub(crate) fn triangle(&self, id: u32) -> Triangle {
        let after = self.bodies.partition_point(|body| body.first_id <= id);
        self.bodies[after - 1].triangle(id)
    }
}

impl BodyTriangles {
    fn triangle(&self, id: u32) -> Triangle {
        let index = id - self.first_id;
        let corners = match &self.corners {
            Corners::InOrder => [3 * index, 3 * index + 1, 3 * index + 2],
            Corners::Mesh(shape) => shape.mesh().map_or([0; 3], |m| m.triangles[index as usize]),
        };
        let [a, b, c] = corners.map(|corner| self.positions[corner as usize]);
        let corners = if self.mirrored { [a, c, b] } else { [a, b, c] };
        Triangle { corners, id, body: self.body }
    }
}
