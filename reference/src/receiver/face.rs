//! The face of a receiver: a parallelogram in world space.

use crate::error::Error;
use glam::DVec3;
use scenes::{Mesh, Scene, Shape, Surface};

/// A parallelogram: corner, two sides, and the side that is lit.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Face {
    corner_ws: DVec3,
    /// Columns run along the first, rows along the second.
    sides_ws: [DVec3; 2],
    /// Unit, out of the lit side.
    normal_ws: DVec3,
}

impl Face {
    /// The face of an object that can receive light.
    pub(crate) fn of(scene: &Scene, receiver: usize, frame: u32) -> Result<Self, Error> {
        let Some(object) = scene.objects.get(receiver) else {
            let value = receiver.to_string();
            return Err(Error::Range { name: "receiver", value, range: "an object of the scene" });
        };
        let refuse = |what: &str| {
            let (object, what) = (object.name.clone(), what.to_owned());
            Err(Error::Receiver { object, what })
        };
        if !matches!(object.surface, Surface::Lambert { .. }) {
            return refuse("is not diffuse (surface = \"lambert\")");
        }
        let time_s = scene.time_s(frame);
        let shape = object.shape_at(time_s);
        let found = match shape.as_ref() {
            Shape::Box { half_extent_m: half } => Some((
                DVec3::new(-half.x, half.y, -half.z),
                [DVec3::X * 2.0 * half.x, DVec3::Z * 2.0 * half.z],
            )),
            Shape::Mesh(mesh) => parallelogram(mesh),
            _ => None,
        };
        let Some((corner, sides)) = found else {
            return refuse("has no face that is a parallelogram");
        };
        let place = object.world_from_object_at(time_s);
        let sides_ws = sides.map(|side| place.transform_vector3(side));
        let outward = if place.matrix3.determinant() < 0.0 { -1.0 } else { 1.0 };
        let normal_ws = sides_ws[1].cross(sides_ws[0]).normalize_or_zero() * outward;
        if normal_ws == DVec3::ZERO {
            return refuse("has a face without area");
        }
        Ok(Self { corner_ws: place.transform_point3(corner), sides_ws, normal_ws })
    }

    pub(crate) fn corners_ws(&self) -> [DVec3; 4] {
        let [u, v] = self.sides_ws;
        [DVec3::ZERO, u, v, u + v].map(|offset| self.corner_ws + offset)
    }

    pub(crate) fn area_m2(&self) -> f64 {
        self.sides_ws[0].cross(self.sides_ws[1]).length()
    }

    /// Shares of the two sides at a point of the receiver, 0 to 1; `None` if a
    /// surface with this outward normal is another one of its sides.
    pub(crate) fn shares_at(&self, point_ws: DVec3, outward_ws: DVec3) -> Option<[f64; 2]> {
        if outward_ws.dot(self.normal_ws) < 0.999 {
            return None;
        }
        let [u, v] = self.sides_ws;
        let offset = point_ws - self.corner_ws;
        let along = |side: DVec3, other: DVec3| {
            let dual = other.cross(self.normal_ws);
            (offset.dot(dual) / side.dot(dual)).clamp(0.0, 1.0)
        };
        Some([along(u, v), along(v, u)])
    }
}

/// Corner and sides of two triangles that make a parallelogram, lit from where
/// they run counter-clockwise.
fn parallelogram(mesh: &Mesh) -> Option<(DVec3, [DVec3; 2])> {
    let [first, second] = mesh.triangles[..] else { return None };
    // The corner of the first that the second lacks, and its neighbours.
    let k = first.iter().position(|corner| !second.contains(corner))?;
    let at = |index: u32| mesh.positions[index as usize];
    let [own, next, last] = [0, 1, 2].map(|i| at(first[(k + i) % 3]));
    let opposite = at(*second.iter().find(|corner| !first.contains(corner))?);
    let (u, v) = (next - own, last - own);
    let is_whole = (own + u + v).distance(opposite) <= 1e-9 * (u.length() + v.length());
    // The second side cross the first points out of the lit side.
    is_whole.then_some((own, [v, u]))
}
