//! The full tree of refractions and reflections with the polarisation of light
//! followed from event to event.
//!
//! Rays go from the camera to the light, matrices the other way: a path carries
//! the Mueller matrix from its end to the camera, and unpolarised light at its
//! end arrives as the matrix's first column.

use super::branching::{Cut, Policy};
use super::media_optics::{MediaOptics, Side};
use super::path::{Fork, Met, Path};
use super::tracer::Tracer;
use crate::optics::interface::amplitudes;
use crate::optics::mueller::{Boundary, across, restate};
use crate::world::flight::Flight;
use crate::world::scratch::Scratch;
use crate::world::winding::Winding;
use glam::{DMat4, DVec3, DVec4};

/// Light of a tree at the camera.
#[derive(Clone, Copy, Debug, Default)]
pub(crate) struct Stokes {
    /// I, Q, U, V per colour channel, for the axis the tree began with.
    pub(crate) channels: [DVec4; 3],
    /// Weight of what was dropped.
    pub(crate) truncated: f64,
    /// The camera ray met a surface.
    pub(crate) met: bool,
}

/// What a path does to polarised light.
#[derive(Clone, Copy, Debug)]
struct Polarisation {
    /// Stokes vector at the camera from the one here, for `axis`.
    mueller: DMat4,
    /// Unit, across the ray.
    axis: DVec3,
}

/// A continuation.
type PolarisedPath<W> = Path<W, Polarisation>;

/// What a tree drops.
#[derive(Clone, Copy)]
struct Dropping {
    cut: Cut,
    /// Reflections off the inside of a body are kept.
    internal: bool,
}

impl Tracer<'_> {
    /// Sums the tree below a camera ray.
    ///
    /// `axis`: unit, across the ray; the axis that the sum refers to.
    pub(crate) fn polarised_tree<W: Winding, const UNIFORM: bool, const LENGTHS: bool>(
        &self,
        flight: Flight<W>,
        axis: DVec3,
        optics: &MediaOptics,
        cut: Cut,
        scratch: &mut Scratch,
    ) -> Stokes {
        let mut sum = Stokes::default();
        let dropping = Dropping { cut, internal: self.restriction.internal_reflection };
        let start = Polarisation { mueller: DMat4::IDENTITY, axis };
        let mut waiting = vec![self.path(flight, start)];
        while let Some(mut path) = waiting.pop() {
            let first = path.so_far.events == 0;
            let met = self.meet::<W, _, LENGTHS>(&mut path, optics, scratch);
            sum.met |= first && !matches!(met, Met::Environment);
            let mueller = path.so_far.own.mueller;
            let light = match met {
                Met::Boundary(fork) => {
                    sum.truncated += branch(&path, &fork, optics, dropping, &mut waiting);
                    continue;
                }
                Met::OneTooMany => {
                    sum.truncated += mueller.x_axis.x * path.so_far.tint.max_element();
                    continue;
                }
                Met::Environment => self.environment::<UNIFORM>(path.flight.direction),
                Met::Opaque(crossing) => self.shade(&path.flight, &crossing),
            };
            for channel in 0..3 {
                let strength = light[channel] * path.so_far.tint[channel];
                sum.channels[channel] += mueller.x_axis * strength;
            }
        }
        sum
    }
}

/// Takes a path over a boundary; the weight that was dropped.
fn branch<W: Winding>(
    path: &PolarisedPath<W>,
    fork: &Fork<W>,
    optics: &MediaOptics,
    mut dropping: Dropping,
    waiting: &mut Vec<PolarisedPath<W>>,
) -> f64 {
    let (boundary, axis) = boundary(path.flight.direction, fork, optics);
    let own = path.so_far.own;
    // Light arrives at the camera's side travelling against the ray.
    let before = own.mueller * restate(axis, own.axis, -path.flight.direction);
    let back = before * boundary.reflected;
    let on = before * boundary.transmitted;
    let mut go_on = |side: Side, mueller: DMat4| {
        let mut next = path.clone();
        next.so_far.own = Polarisation { mueller, axis };
        if next.go_on(fork, side, optics) {
            next.so_far.own.start_again(next.flight.direction, mueller);
        }
        waiting.push(next);
    };
    if fork.is_total() {
        go_on(Side::Reflected, back);
        return 0.0;
    }
    let internal = dropping.internal || fork.event.entering;
    let weight = |mueller: DMat4| mueller.x_axis.x.max(0.0);
    let weights = [if internal { weight(back) } else { 0.0 }, weight(on)];
    let choice = dropping.cut.choose(weights, path.so_far.tint.max_element());
    if choice.reflected > 0.0 {
        go_on(Side::Reflected, back);
    }
    if choice.transmitted > 0.0 {
        go_on(Side::Transmitted, on);
    }
    choice.lost
}

/// What a boundary does to polarised light of direction `d`, and the axis across
/// the plane of incidence that this refers to.
fn boundary<W: Winding>(d: DVec3, fork: &Fork<W>, optics: &MediaOptics) -> (Boundary, DVec3) {
    let Fork { event, bend } = fork;
    let normals = event.spot.normals;
    let normal = if bend.geometric { normals.geometric } else { normals.shading };
    let [eta_i, eta_t] = [&event.before, &event.after].map(|side| optics.indices.eta(side));
    let cos_i = d.dot(normal).abs().min(1.0);
    let boundary = if event.gap {
        Boundary::gap(amplitudes(cos_i, eta_i, 1.0))
    } else {
        Boundary::surface(amplitudes(cos_i, eta_i, eta_t))
    };
    (boundary, across(d, normal))
}

impl Polarisation {
    /// Makes the matrix of an earlier boundary that of a path which starts again
    /// there, into another direction, from where its matrix was `now`. The path may
    /// have branched in between: it keeps the weight that it has now, and with it the
    /// light that comes from everywhere alike.
    fn start_again(&mut self, direction: DVec3, now: DMat4) {
        let then = self.mueller.x_axis.x;
        if then > 0.0 {
            self.mueller *= now.x_axis.x / then;
        }
        let across = self.axis - direction * self.axis.dot(direction);
        self.axis = across.try_normalize().unwrap_or_else(|| direction.any_orthonormal_vector());
    }
}
