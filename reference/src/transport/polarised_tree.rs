//! The full tree of refractions and reflections with the polarisation of light
//! followed from event to event.
//!
//! Rays go from the camera to the light, matrices the other way: a path carries
//! the Mueller matrix from its end to the camera, and unpolarised light at its
//! end arrives as the matrix's first column.

use crate::optics::interface::amplitudes;
use crate::optics::mueller::{Boundary, across, restate};
use crate::transport::branching::{Cut, Policy};
use crate::transport::media_optics::{Optics, reflected, transmitted};
use crate::transport::tracer::Tracer;
use crate::world::short_way::{End, Event, Flight, Scratch};
use crate::world::winding::Media;
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

/// A continuation.
struct Branch<M> {
    flight: Flight<M>,
    /// Stokes vector at the camera from the one here, for `axis`.
    mueller: DMat4,
    axis: DVec3,
    tint: DVec3,
    events: u32,
}

impl Tracer<'_> {
    /// Sums the tree below a camera ray.
    ///
    /// `axis`: unit, across the ray; the axis that the sum refers to.
    pub(crate) fn polarised_tree<M: Media, const UNIFORM: bool, const LENGTHS: bool>(
        &self,
        flight: Flight<M>,
        axis: DVec3,
        optics: &Optics,
        cut: Cut,
        scratch: &mut Scratch,
    ) -> Stokes {
        let mut sum = Stokes::default();
        let (mueller, tint) = (DMat4::IDENTITY, DVec3::ONE);
        let mut waiting = vec![Branch { flight, mueller, axis, tint, events: 0 }];
        let interfaces = self.restriction.max_interfaces.unwrap_or(u32::MAX);
        while let Some(mut branch) = waiting.pop() {
            let end = if branch.events >= interfaces {
                End::Environment
            } else {
                self.world.follow::<M, LENGTHS>(&branch.flight, &optics.indices, scratch)
            };
            if LENGTHS {
                branch.tint *= optics.transmittance(&scratch.pieces);
            }
            sum.met |= branch.events == 0 && !matches!(end, End::Environment);
            let light = match end {
                End::Event(event) => {
                    scratch.counters.events += 1;
                    if branch.events >= self.restriction.max_events {
                        sum.truncated += branch.mueller.x_axis.x * branch.tint.max_element();
                        scratch.counters.capped += 1;
                    } else {
                        let internal = self.restriction.internal_reflection || event.entering;
                        let lost = turn(&branch, &event, optics, (cut, internal), &mut waiting);
                        sum.truncated += lost;
                    }
                    continue;
                }
                End::Environment => self.environment::<UNIFORM>(branch.flight.direction),
                End::Opaque(crossing) => self.shade(&branch.flight, &crossing),
            };
            for channel in 0..3 {
                let strength = light[channel] * branch.tint[channel];
                sum.channels[channel] += branch.mueller.x_axis * strength;
            }
        }
        sum
    }
}

/// Takes a branch over an event; the weight that was dropped.
fn turn<M: Media>(
    branch: &Branch<M>,
    event: &Event<M>,
    optics: &Optics,
    (mut cut, internal): (Cut, bool),
    waiting: &mut Vec<Branch<M>>,
) -> f64 {
    let d = branch.flight.direction;
    let bend = optics.bend(d, event);
    let normals = event.spot.normals;
    let normal = if bend.geometric { normals.geometric } else { normals.shading };
    let [here, beyond] = [&event.before, &event.after].map(|media| optics.indices.eta(media));
    let cos_i = d.dot(normal).abs().min(1.0);
    let boundary = if event.gap {
        Boundary::gap(amplitudes(cos_i, here, 1.0))
    } else {
        Boundary::surface(amplitudes(cos_i, here, beyond))
    };
    // Light arrives at the camera's side travelling against the ray.
    let axis = across(d, normal);
    let before = branch.mueller * restate(axis, branch.axis, -d);
    let back = before * boundary.reflected;
    let on = before * boundary.transmitted;
    let continued = |flight: Flight<M>, mueller: DMat4| {
        let (tint, events) = (branch.tint, branch.events + 1);
        Branch { flight, mueller, axis, tint, events }
    };
    let Some(direction) = bend.transmitted else {
        waiting.push(continued(reflected(event, &bend), back));
        return 0.0;
    };
    let weight = |mueller: DMat4| mueller.x_axis.x.max(0.0);
    let weights = [if internal { weight(back) } else { 0.0 }, weight(on)];
    let choice = cut.choose(weights, branch.tint.max_element());
    if choice.reflected > 0.0 {
        waiting.push(continued(reflected(event, &bend), back));
    }
    if choice.transmitted > 0.0 {
        waiting.push(continued(transmitted(event, direction), on));
    }
    choice.lost
}
