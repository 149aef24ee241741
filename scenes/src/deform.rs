//! Bodies that change their form: a travelling wave through a mesh.

use crate::scene::{Object, Wave};
use crate::{Mesh, Scene, Shape, mesh::CornerNormals};
use glam::DVec3;
use std::collections::HashMap;
use std::f64::consts::TAU;
use std::sync::Arc;

impl Wave {
    /// Where a point is at a time in seconds, object space, metres:
    /// p + direction · amplitude · sin(2π (p · travel / wavelength - t / period)).
    #[must_use]
    pub fn place(&self, p: DVec3, time_s: f64) -> DVec3 {
        p + self.direction * (self.amplitude_m * self.phase(p, time_s).sin())
    }

    fn phase(&self, p: DVec3, time_s: f64) -> f64 {
        TAU * (p.dot(self.travel) / self.wavelength_m - time_s / self.period_s)
    }

    /// The normal at `p` (its rest position) after the surface has moved.
    ///
    /// The motion's derivative is I + d gᵀ with g the gradient of the
    /// displacement's size; normals go with its cofactors,
    /// (1 + d · g) n - (d · n) g, which needs no division and keeps the side.
    #[must_use]
    pub fn turn(&self, p: DVec3, normal: DVec3, time_s: f64) -> DVec3 {
        let rate = TAU / self.wavelength_m * self.amplitude_m * self.phase(p, time_s).cos();
        let g = rate * self.travel;
        let moved = (1.0 + self.direction.dot(g)) * normal - self.direction.dot(normal) * g;
        moved.try_normalize().unwrap_or(normal)
    }

    /// A mesh at a time in seconds. Triangles stay the same, so trees can be
    /// refitted; normals turn with the surface.
    #[must_use]
    pub fn deform(&self, mesh: &Mesh, time_s: f64) -> Mesh {
        let normals = mesh.normals.as_ref().map(|normals| self.turned(mesh, normals, time_s));
        let positions = mesh.positions.iter().map(|p| self.place(*p, time_s)).collect();
        Mesh { positions, triangles: mesh.triangles.clone(), normals }
    }

    /// Corners with different positions turn differently even where they shared
    /// a normal at rest.
    fn turned(&self, mesh: &Mesh, normals: &CornerNormals, time_s: f64) -> CornerNormals {
        let mut index_of: HashMap<(u32, u32), u32> = HashMap::new();
        let mut values = Vec::new();
        let indices = mesh
            .triangles
            .iter()
            .zip(&normals.indices)
            .map(|(triangle, corner)| {
                [0, 1, 2].map(|i| {
                    *index_of.entry((triangle[i], corner[i])).or_insert_with(|| {
                        let position = mesh.positions[triangle[i] as usize];
                        let normal = normals.values[corner[i] as usize];
                        values.push(self.turn(position, normal, time_s));
                        u32::try_from(values.len() - 1).unwrap_or(u32::MAX)
                    })
                })
            })
            .collect();
        CornerNormals { values, indices }
    }
}

impl Object {
    /// The shape at a time in seconds: the shape itself unless a mesh deforms.
    #[must_use]
    pub fn shape_at(&self, time_s: f64) -> Arc<Shape> {
        match (&self.deform, self.shape.mesh()) {
            (Some(wave), Some(mesh)) => Arc::new(Shape::Mesh(wave.deform(mesh, time_s))),
            _ => Arc::clone(&self.shape),
        }
    }
}

impl Scene {
    /// The scene as it stands in a frame, with nothing left that moves or deforms.
    #[must_use]
    pub fn still(&self, frame: u32) -> Self {
        let time_s = self.time_s(frame);
        let mut still = self.clone();
        for object in &mut still.objects {
            object.shape = object.shape_at(time_s);
            object.world_from_object = object.world_from_object_at(time_s);
            (object.deform, object.motion) = (None, None);
        }
        still
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::generate::{builtin, geodesic};
    use crate::{normals, topology::solid};

    fn wave() -> Wave {
        Wave {
            amplitude_m: 0.05,
            wavelength_m: 0.9,
            travel: DVec3::new(0.6, 0.0, 0.8),
            direction: DVec3::new(0.0, 0.8, 0.6),
            period_s: 2.0,
        }
    }

    #[test]
    fn a_period_later_the_body_is_where_it_was() {
        let ball = geodesic(8);
        let [first, later] = [0.3, 2.3].map(|time_s| wave().deform(&ball, time_s));
        for (one, other) in first.positions.iter().zip(&later.positions) {
            assert!(one.distance(*other) < 1e-15);
        }
        let half = wave().deform(&ball, 1.3);
        assert!(first.positions.iter().zip(&half.positions).any(|(a, b)| a.distance(*b) > 0.05));
    }

    #[test]
    fn a_deformed_body_stays_closed() {
        let mesh = wave().deform(&geodesic(8), 0.4);
        assert_eq!(solid(&mesh), Ok(()));
    }

    /// The turned normals are those of the deformed surface.
    #[test]
    fn normals_turn_with_the_surface() {
        let Some(ball) = builtin("geodesic-64") else { unreachable!() };
        let mesh = wave().deform(&ball, 0.7);
        let expected = normals::smooth(&mesh);
        let Some(turned) = &mesh.normals else { unreachable!() };
        let worst = |normals: &CornerNormals| {
            let pairs = normals.indices.iter().zip(&expected.indices);
            pairs
                .flat_map(|(one, other)| one.iter().zip(other))
                .map(|(i, j)| {
                    normals.values[*i as usize].angle_between(expected.values[*j as usize])
                })
                .fold(0.0, f64::max)
        };
        assert!(worst(turned) < 2e-3, "{}", worst(turned));
        // Normals that stayed as they were at rest are not.
        let Some(rest) = &ball.normals else { unreachable!() };
        assert!(worst(rest) > 0.1);
    }
}
