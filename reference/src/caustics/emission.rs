//! Photons at their start.

use crate::error::Error;
use crate::receiver::face::Face;
use crate::sampling::sobol::Points;
use crate::transport::tracer::Tracer;
use crate::world::flight::{Flight, Start};
use crate::world::scratch::Scratch;
use crate::world::winding::Winding;
use glam::DVec3;
use scenes::scene::Light;
use scenes::{Object, Scene, Surface, box_corners};
use std::f64::consts::TAU;

/// A ball that photons are sent to, and one around everything.
#[derive(Clone, Copy, Debug)]
pub(super) struct Aim {
    centre_ws: DVec3,
    radius_m: f64,
    /// About the same centre.
    all_m: f64,
}

/// Photons of one light.
pub(super) struct Emission<W> {
    kind: Kind,
    /// Of all its photons that are sent.
    pub(super) power: DVec3,
    winding: W,
}

enum Kind {
    /// From a point into a cone: axis, and 1 - cosine of its half angle.
    Cone { from_ws: DVec3, axis: DVec3, one_minus_cos: f64 },
    /// From a disc along its normal.
    Disc { centre_ws: DVec3, direction: DVec3, radius_m: f64 },
}

/// Glass without bounds bends light from everywhere.
pub(super) fn must_be_bounded(scene: &Scene) -> Result<(), Error> {
    for object in &scene.objects {
        let [low, high] = object.shape.bounds();
        let bounded = low.is_finite() && high.is_finite();
        if !bounded && matches!(object.surface, Surface::Dielectric { .. }) {
            return Err(Error::Unbounded { object: object.name.clone() });
        }
    }
    Ok(())
}

/// The ball around the receiver's face and all glass.
pub(super) fn target(scene: &Scene, face: &Face, frame: u32) -> Aim {
    let time_s = scene.time_s(frame);
    let corners = |object: &Object| {
        let world_from_object = object.world_from_object_at(time_s);
        let corners = box_corners(object.shape_at(time_s).bounds());
        corners.map(|corner| world_from_object.transform_point3(corner))
    };
    let is_glass = |object: &&Object| matches!(object.surface, Surface::Dielectric { .. });
    let glass = scene.objects.iter().filter(is_glass).flat_map(corners);
    let wanted: Vec<DVec3> = face.corners_ws().into_iter().chain(glass).collect();
    let low = wanted.iter().fold(DVec3::INFINITY, |low, p| low.min(*p));
    let high = wanted.iter().fold(DVec3::NEG_INFINITY, |high, p| high.max(*p));
    let centre_ws = 0.5 * (low + high);
    let furthest = |radius: f64, p: DVec3| radius.max(p.distance(centre_ws));
    let radius_m = wanted.into_iter().fold(0.0, furthest) * (1.0 + 1e-9);
    let everything = scene.objects.iter().flat_map(corners).filter(|p| p.is_finite());
    Aim { centre_ws, radius_m, all_m: everything.fold(radius_m, furthest) }
}

impl<W: Winding> Emission<W> {
    pub(super) fn new(light: &Light, aim: &Aim, tracer: &Tracer<'_>) -> Self {
        let Aim { centre_ws, radius_m, all_m } = *aim;
        match *light {
            Light::Point { position_m, intensity } => {
                let to = centre_ws - position_m;
                let sine = radius_m / to.length();
                // 1 - cos without cancellation; all around from inside the ball.
                let one_minus_cos =
                    if sine < 1.0 { sine * sine / (1.0 + (1.0 - sine * sine).sqrt()) } else { 2.0 };
                let axis = to.normalize_or(DVec3::Y);
                Self {
                    kind: Kind::Cone { from_ws: position_m, axis, one_minus_cos },
                    power: intensity * TAU * one_minus_cos,
                    winding: tracer.world.winding_at(position_m, &mut Scratch::default()),
                }
            }
            Light::Directional { direction, irradiance } => Self {
                kind: Kind::Disc {
                    centre_ws: centre_ws - direction * (1.01 * all_m),
                    direction,
                    radius_m,
                },
                power: irradiance * (0.5 * TAU * radius_m * radius_m),
                winding: W::outside(),
            },
        }
    }

    /// A photon; the first pair of random numbers is its place.
    pub(super) fn start(&self, points: &Points, sample: u32) -> Flight<W> {
        let [a, b] = points.pair(sample, 0);
        let (sin_phi, cos_phi) = (TAU * b).sin_cos();
        let (origin, direction) = match self.kind {
            Kind::Cone { from_ws, axis, one_minus_cos } => {
                let (x, y) = axis.any_orthonormal_pair();
                let down = a * one_minus_cos;
                let sine = (down * (2.0 - down)).max(0.0).sqrt();
                let direction = axis * (1.0 - down) + (x * cos_phi + y * sin_phi) * sine;
                (from_ws, direction.normalize())
            }
            Kind::Disc { centre_ws, direction, radius_m } => {
                let (x, y) = direction.any_orthonormal_pair();
                let radius = radius_m * a.sqrt();
                (centre_ws + (x * cos_phi + y * sin_phi) * radius, direction)
            }
        };
        Flight { origin, direction, start: Start::Free, winding: self.winding.clone() }
    }
}
