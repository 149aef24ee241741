//! Light from opaque surfaces: painted radiance, or lit by the scene's lights.
//!
//! Lights are not blocked and surfaces do not light each other: the same
//! formula that the GPU side uses. Where a caustic map says what arrives, it
//! stands in place of that formula, because it holds the direct light too.

use crate::transport::tracer::Tracer;
use crate::world::crossing::Crossing;
use crate::world::flight::Flight;
use glam::DVec3;
use scenes::Surface;
use scenes::scene::{Light, Paint};

impl Tracer<'_> {
    /// Radiance of an opaque surface towards the ray that meets it.
    pub(crate) fn shade<W>(&self, flight: &Flight<W>, crossing: &Crossing) -> DVec3 {
        let body = &self.world.bodies[crossing.body as usize];
        let spot = self.world.spot(crossing);
        let here = body.object_from_world.transform_point3(spot.position);
        let outward = spot.normals.shading;
        let normal = if outward.dot(flight.direction) < 0.0 { outward } else { -outward };
        match &self.scene.objects[body.object].surface {
            Surface::Dielectric { .. } => DVec3::ZERO,
            Surface::Unlit { radiance } => colour(radiance, here),
            Surface::Lambert { albedo } => {
                let lights = self.scene.lights.iter();
                let direct = || lights.map(|l| irradiance(l, spot.position, normal)).sum();
                let own = self.caustics.filter(|map| map.receiver == body.object);
                let lit = outward.dot(flight.direction) < 0.0;
                let mapped = own.filter(|_| lit);
                let mapped = mapped.and_then(|map| map.at(spot.position, spot.normals.geometric));
                colour(albedo, here) * mapped.unwrap_or_else(direct) / std::f64::consts::PI
            }
        }
    }
}

/// Irradiance from one light on a surface at a point with a unit normal.
fn irradiance(light: &Light, point: DVec3, normal: DVec3) -> DVec3 {
    match light {
        Light::Point { position_m, intensity } => {
            let to = *position_m - point;
            let squared = to.length_squared();
            if squared == 0.0 {
                return DVec3::ZERO;
            }
            *intensity * ((to / squared.sqrt()).dot(normal).max(0.0) / squared)
        }
        Light::Directional { direction, irradiance } => {
            *irradiance * (-direction.dot(normal)).max(0.0)
        }
    }
}

fn colour(paint: &Paint, at: DVec3) -> DVec3 {
    match paint {
        Paint::Constant(colour) => *colour,
        Paint::Checker { colours, size_m } => {
            let cell = (at / *size_m).floor();
            colours[(cell.x + cell.y + cell.z).rem_euclid(2.0) as usize % 2]
        }
    }
}
