//! Shapes as they are drawn: triangles and formulas, moved to the scene's centre
//! in f64 and narrowed to f32 once.

use bytemuck::{Pod, Zeroable};
use glam::{DAffine3, DMat3, DVec3, Vec4};
use scenes::scene::Normals;
use scenes::{Mesh, Shape};
use std::ops::Range;

/// One corner of a triangle, as raster_mesh.wgsl reads it.
#[derive(Clone, Copy, Debug, Pod, Zeroable)]
#[repr(C)]
pub(crate) struct Corner {
    pub(crate) p_lc: [f32; 3],
    pub(crate) normal_ws: [f32; 3],
    pub(crate) geometric_ws: [f32; 3],
    pub(crate) thickness_m: f32,
    pub(crate) body: f32,
}

/// Formulas that the GPU knows for shapes without triangles.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub(crate) enum Formula {
    Sphere,
    Box,
    Cylinder,
    HalfSpace,
}

/// How one body is drawn.
#[derive(Clone, Debug)]
pub(crate) enum Draw {
    /// Corners of triangles.
    Triangles(Range<u32>),
    /// An analytic body: formula, placement, size and number.
    Analytic(Formula, DAffine3, Vec4, u32),
}

/// Shapes that one pass draws.
#[derive(Clone, Debug, Default)]
pub(crate) struct Drawables {
    pub(crate) corners: Vec<Corner>,
    pub(crate) draws: Vec<Draw>,
    /// Some mesh has interpolated normals.
    pub(crate) smooth: bool,
    /// Local origin in world space, metres.
    pub(crate) centre: DVec3,
    /// For each triangle its body's first corner and vertex numbers, so that
    /// thickness can be filled in when a method reads it.
    vertices: Vec<[u32; 3]>,
}

/// A shape, where it is, and the number that the shaders know it by.
pub(crate) struct PlacedShape<'a> {
    pub(crate) shape: &'a Shape,
    pub(crate) world_from_object: DAffine3,
    pub(crate) normals: Normals,
    /// 1 for the first.
    pub(crate) number: u32,
}

impl Drawables {
    pub(crate) fn new(centre: DVec3) -> Self {
        Self { centre, ..Self::default() }
    }

    pub(crate) fn is_empty(&self) -> bool {
        self.draws.is_empty()
    }

    /// Adds a shape. `wide_m`: half the width of what is infinitely wide.
    pub(crate) fn add(&mut self, placed: &PlacedShape<'_>, wide_m: f64) {
        let size = |v: DVec3| v.as_vec3().extend(0.0);
        let (formula, size_m) = match placed.shape {
            Shape::Mesh(mesh) => return self.add_mesh(mesh, placed),
            Shape::Sphere { radius_m } => (Formula::Sphere, size(DVec3::splat(*radius_m))),
            Shape::Slab { thickness_m } => {
                let wide_m = wide_m.max(1e4 * thickness_m);
                (Formula::Box, size(DVec3::new(wide_m, wide_m, 0.5 * thickness_m)))
            }
            Shape::Box { half_extent_m } => (Formula::Box, size(*half_extent_m)),
            Shape::Cylinder { radius_m, half_height_m } => {
                (Formula::Cylinder, size(DVec3::new(*radius_m, *half_height_m, 0.0)))
            }
            Shape::HalfSpace => (Formula::HalfSpace, Vec4::ZERO),
        };
        let (at, number) = (placed.world_from_object, placed.number);
        self.draws.push(Draw::Analytic(formula, at, size_m, number));
    }

    fn add_mesh(&mut self, mesh: &Mesh, object: &PlacedShape<'_>) {
        let (placed, number) = (object.world_from_object, object.number);
        let start = self.corners.len() as u32;
        let smooth = object.normals == Normals::Smooth;
        self.smooth |= smooth;
        let made = (smooth && mesh.normals.is_none()).then(|| scenes::normals::smooth(mesh));
        let normals = mesh.normals.as_ref().filter(|_| smooth).or(made.as_ref());
        let normal_matrix: DMat3 = placed.matrix3.inverse().transpose();
        // A mirrored placement turns the triangles' sense of rotation round.
        let mirrored = placed.matrix3.determinant() < 0.0;
        for (index, triangle) in mesh.triangles.iter().enumerate() {
            let points = mesh.corners(index).map(|p| placed.transform_point3(p) - self.centre);
            let face = (points[1] - points[0]).cross(points[2] - points[0]);
            let face = if mirrored { -face } else { face };
            let Some(face) = face.try_normalize() else { continue };
            let order = if mirrored { [0, 2, 1] } else { [0, 1, 2] };
            self.vertices.push(order.map(|k| triangle[k]));
            for k in order {
                let normal = normals.map_or(face, |own| {
                    let normal = own.values[own.indices[index][k] as usize];
                    (normal_matrix * normal).normalize_or(face)
                });
                self.corners.push(Corner {
                    p_lc: points[k].as_vec3().to_array(),
                    normal_ws: normal.as_vec3().to_array(),
                    geometric_ws: face.as_vec3().to_array(),
                    thickness_m: 0.0,
                    body: number as f32,
                });
            }
        }
        self.draws.push(Draw::Triangles(start..self.corners.len() as u32));
    }

    /// Adds the unit square of a plane, turned into the world. The normals of its
    /// corners hold their positions on the plane.
    pub(crate) fn add_plane(&mut self, world_from_plane: &DAffine3, number: u32) {
        let start = self.corners.len() as u32;
        let face = world_from_plane.transform_vector3(DVec3::Z).normalize_or(DVec3::Z).as_vec3();
        let square = [[0, 1, 2], [0, 2, 3]];
        let at = [[-0.5, -0.5], [0.5, -0.5], [0.5, 0.5], [-0.5, 0.5]];
        for triangle in square {
            self.vertices.push(triangle.map(|k: usize| k as u32));
            self.corners.extend(triangle.map(|k| {
                let p = DVec3::new(at[k][0], at[k][1], 0.0);
                Corner {
                    p_lc: (world_from_plane.transform_point3(p) - self.centre).as_vec3().to_array(),
                    normal_ws: p.as_vec3().to_array(),
                    geometric_ws: face.to_array(),
                    thickness_m: 0.0,
                    body: number as f32,
                }
            }));
        }
        self.draws.push(Draw::Triangles(start..self.corners.len() as u32));
    }

    /// Fills in every corner's distance through its body along the inward normal.
    pub(crate) fn measure_thickness(&mut self) {
        for draw in &self.draws {
            let Draw::Triangles(range) = draw else { continue };
            let corners = &mut self.corners[range.start as usize..range.end as usize];
            let vertices = &self.vertices[range.start as usize / 3..range.end as usize / 3];
            let wide = |v: [f32; 3]| DVec3::from_array(v.map(f64::from));
            let triangles = || corners.chunks_exact(3);
            let points: Vec<_> =
                triangles().map(|t| [wide(t[0].p_lc), wide(t[1].p_lc), wide(t[2].p_lc)]).collect();
            let inward: Vec<_> = triangles()
                .map(|t| [0, 1, 2].map(|k| -wide(t[k].normal_ws).normalize_or_zero()))
                .collect();
            let found = crate::drawn::thickness::along_normals(&points, vertices, &inward);
            for (corner, thickness_m) in corners.iter_mut().zip(found.iter().flatten()) {
                corner.thickness_m = *thickness_m as f32;
            }
        }
    }

    /// The formulas that occur.
    pub(crate) fn formulas(&self) -> Vec<Formula> {
        let formula = |draw: &Draw| match draw {
            Draw::Analytic(formula, ..) => Some(*formula),
            Draw::Triangles(_) => None,
        };
        self.draws.iter().filter_map(formula).collect()
    }
}
