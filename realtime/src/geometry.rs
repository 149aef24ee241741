//! What the GPU draws: triangles and analytic bodies, moved to the scene's
//! centre in f64 and narrowed to f32 once.

use crate::Error;
use crate::uniforms::{Body, MAX_BODIES};
use bytemuck::{Pod, Zeroable};
use glam::{DAffine3, DMat3, DVec3, Vec4};
use scenes::scene::Normals;
use scenes::{Mesh, Object, Scene, Shape, Surface};
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

/// The bodies of one frame.
#[derive(Clone, Debug)]
pub(crate) struct Geometry {
    pub(crate) corners: Vec<Corner>,
    pub(crate) draws: Vec<Draw>,
    pub(crate) bodies: Vec<Body>,
    /// Local origin in world space, metres.
    pub(crate) centre: DVec3,
    /// Radius about the centre that holds every bounded body, metres.
    pub(crate) radius_m: f64,
    /// Some mesh has interpolated normals.
    pub(crate) smooth: bool,
    /// Some body absorbs.
    pub(crate) absorbs: bool,
    /// Bodies differ in medium or priority.
    pub(crate) nested: bool,
    /// For each triangle its body's first corner and vertex numbers, so that
    /// thickness can be filled in when a method reads it.
    vertices: Vec<[u32; 3]>,
}

impl Geometry {
    /// The bodies of a frame.
    pub(crate) fn new(scene: &Scene, frame: u32) -> Result<Self, Error> {
        let time_s = scene.time_s(frame);
        let solids: Vec<&Object> = scene
            .objects
            .iter()
            .filter(|object| matches!(object.surface, Surface::Dielectric { .. }))
            .collect();
        if solids.len() > MAX_BODIES {
            return Err(Error::NotYet {
                what: format!("a scene of {} bodies (at most {MAX_BODIES})", solids.len()),
                method: "any".to_owned(),
            });
        }
        let [low, high] = scene.bounds();
        let bounded = low.is_finite() && high.is_finite();
        let (centre, radius_m) = if bounded {
            (0.5 * (low + high), 0.5 * (high - low).length())
        } else {
            (scene.camera.target, (scene.camera.target - scene.camera.eye).length() * 10.0)
        };
        let mut geometry = Self {
            corners: Vec::new(),
            draws: Vec::new(),
            bodies: Vec::new(),
            centre,
            radius_m: radius_m.max(f64::MIN_POSITIVE),
            smooth: false,
            absorbs: false,
            nested: false,
            vertices: Vec::new(),
        };
        let solids_by_priority = numbered(&solids);
        geometry.nested = solids_by_priority.iter().any(|solid| *solid > 0);
        for (object, solid) in solids.iter().zip(solids_by_priority) {
            geometry.add(scene, object, solid, time_s);
        }
        Ok(geometry)
    }

    fn add(&mut self, scene: &Scene, object: &Object, solid: u32, time_s: f64) {
        let Some(medium) = scene.medium_of(object) else { return };
        self.absorbs |= medium.absorbs();
        self.bodies.push(Body {
            eta: medium.eta.get() as f32,
            solid,
            absorption_per_m: medium.absorption_per_m.as_vec3(),
        });
        let number = self.bodies.len() as u32;
        let placed = object.world_from_object_at(time_s);
        let size = |v: DVec3| v.as_vec3().extend(0.0);
        let (formula, size_m) = match &*object.shape {
            Shape::Mesh(mesh) => return self.add_mesh(mesh, object, placed, number),
            Shape::Sphere { radius_m } => (Formula::Sphere, size(DVec3::splat(*radius_m))),
            Shape::Slab { thickness_m } => {
                let wide_m = 1e4 * self.radius_m.max(*thickness_m);
                (Formula::Box, size(DVec3::new(wide_m, wide_m, 0.5 * thickness_m)))
            }
            Shape::Box { half_extent_m } => (Formula::Box, size(*half_extent_m)),
            Shape::Cylinder { radius_m, half_height_m } => {
                (Formula::Cylinder, size(DVec3::new(*radius_m, *half_height_m, 0.0)))
            }
            Shape::HalfSpace => (Formula::HalfSpace, Vec4::ZERO),
        };
        self.draws.push(Draw::Analytic(formula, placed, size_m, number));
    }

    fn add_mesh(&mut self, mesh: &Mesh, object: &Object, placed: DAffine3, number: u32) {
        let start = self.corners.len() as u32;
        let smooth = object.normals == Normals::Smooth;
        self.smooth |= smooth;
        let normals = if smooth { Some(smooth_normals(mesh)) } else { None };
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
                let normal = match (&normals, &mesh.normals) {
                    (None, _) => face,
                    (Some(_), Some(own)) => (normal_matrix
                        * own.values[own.indices[index][k] as usize])
                        .normalize_or(face),
                    (Some(made), None) => {
                        (normal_matrix * made[triangle[k] as usize]).normalize_or(face)
                    }
                };
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
}

/// Numbers by falling priority, then medium; bodies of one medium and priority
/// are one solid.
fn numbered(solids: &[&Object]) -> Vec<u32> {
    let key = |object: &&Object| match object.surface {
        Surface::Dielectric { medium, priority } => (-i64::from(priority), medium),
        _ => (i64::MAX, scenes::MediumId::SURROUNDINGS),
    };
    let mut kinds: Vec<_> = solids.iter().map(key).collect();
    kinds.sort();
    kinds.dedup();
    let number = |object| kinds.iter().position(|kind| *kind == key(object)).unwrap_or(0);
    solids.iter().map(|object| number(object) as u32).collect()
}

/// Means of the triangles' normals, weighted by the angle at the vertex.
fn smooth_normals(mesh: &Mesh) -> Vec<DVec3> {
    let mut sums = vec![DVec3::ZERO; mesh.positions.len()];
    for (index, triangle) in mesh.triangles.iter().enumerate() {
        let p = mesh.corners(index);
        let face = (p[1] - p[0]).cross(p[2] - p[0]).normalize_or_zero();
        for i in 0..3 {
            let (a, b) = (p[(i + 1) % 3] - p[i], p[(i + 2) % 3] - p[i]);
            sums[triangle[i] as usize] += a.cross(b).length().atan2(a.dot(b)) * face;
        }
    }
    sums
}

impl Geometry {
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
            let found = crate::thickness::along_normals(&points, vertices, &inward);
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
