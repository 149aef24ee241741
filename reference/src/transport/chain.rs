//! The primary chain: transmitted wherever possible, reflected where total
//! reflection leaves no choice. It has one exit, which layers can show.

use super::media_optics::Side;
use super::path::{Met, Path};
use super::tracer::Tracer;
use crate::request::Disturbance;
use crate::world::flight::Flight;
use crate::world::scratch::Scratch;
use crate::world::winding::Winding;
use glam::DVec3;
use scenes::layer::flag;
use scenes::noise::SplitMix64;
use std::f64::consts::TAU;

/// What is known about a chain when it ends.
#[derive(Clone, Debug, Default)]
pub(crate) struct Chain {
    /// Unit direction in which it leaves; zero if it met nothing or never left.
    pub(crate) exit: DVec3,
    /// Where it leaves its last surface.
    pub(crate) exit_position: DVec3,
    /// Unit direction after the first event.
    pub(crate) first: DVec3,
    /// Where it meets its second surface.
    pub(crate) hit2: DVec3,
    pub(crate) events: u32,
    /// The camera ray met a surface.
    pub(crate) met: bool,
    pub(crate) total_reflections: u32,
    /// Bits of [`flag`].
    pub(crate) flags: u32,
    /// Radiance that it brings; zero if it never left.
    pub(crate) radiance: DVec3,
    /// Metres per medium, if asked for.
    pub(crate) lengths: Vec<f64>,
}

impl Chain {
    /// It met the limit on events and never left.
    pub(crate) fn lost(&self) -> bool {
        self.flags & flag::LOST != 0
    }
}

/// Turns a ray aside and moves its origin along the surface that it leaves.
fn disturb<W>(flight: &mut Flight<W>, by: Disturbance, normal: DVec3, event: u32) {
    let mut chance = SplitMix64(by.seed.wrapping_mul(0x1_0000_0001) ^ u64::from(event));
    let (sine, cosine) = (TAU * chance.uniform()).sin_cos();
    let aside = |axis: DVec3| {
        let (one, other) = axis.any_orthonormal_pair();
        by.share * (one * cosine + other * sine)
    };
    flight.direction = (flight.direction + aside(flight.direction)).normalize();
    flight.origin += aside(normal) * flight.origin.abs().max_element();
}

impl Tracer<'_> {
    /// Traces the chain of a ray from the camera.
    pub(crate) fn chain<W: Winding, const UNIFORM: bool, const LENGTHS: bool>(
        &self,
        mut flight: Flight<W>,
        scratch: &mut Scratch,
    ) -> Chain {
        if self.disturbance.share > 0.0 {
            let along = flight.direction;
            disturb(&mut flight, self.disturbance, along, 0);
        }
        let optics = &self.d_line;
        let mut chain = Chain::default();
        if LENGTHS {
            // The last is air that no medium of the scene stands for.
            chain.lengths = vec![0.0; optics.absorption_per_m.len() + 1];
        }
        let mut path = self.path(flight, chain);
        loop {
            let met = self.meet::<W, _, LENGTHS>(&mut path, optics, scratch);
            let chain = &mut path.so_far.own;
            if LENGTHS {
                for (medium, length_m) in &scratch.stretches {
                    chain.lengths[usize::from(medium.0)] += length_m;
                }
            }
            chain.met |= !matches!(met, Met::Environment);
            let Met::Boundary(fork) = met else {
                return self.end::<W, UNIFORM>(path, &met);
            };
            chain.total_reflections += u32::from(fork.is_total());
            chain.flags |= if fork.bend.geometric { flag::GEOMETRIC_NORMAL } else { 0 };
            let again = path.go_on(&fork, Side::Transmitted, optics);
            if self.disturbance.share > 0.0 {
                let event = path.so_far.events;
                let normal = fork.event.spot.normals.geometric;
                disturb(&mut path.flight, self.disturbance, normal, event);
            }
            let chain = &mut path.so_far.own;
            chain.flags |= if again { flag::GEOMETRIC_NORMAL } else { 0 };
            match path.so_far.events {
                1 => chain.first = path.flight.direction,
                2 => chain.hit2 = path.flight.origin,
                _ => {}
            }
        }
    }

    /// A chain where it ends, and what it brings from there.
    fn end<W: Winding, const UNIFORM: bool>(&self, path: Path<W, Chain>, met: &Met<W>) -> Chain {
        let (flight, tint) = (path.flight, path.so_far.tint);
        let mut chain = Chain { events: path.so_far.events, ..path.so_far.own };
        match met {
            Met::Environment => {
                chain.radiance = tint * self.environment::<UNIFORM>(flight.direction);
                if chain.events > 0 {
                    (chain.exit, chain.exit_position) = (flight.direction, flight.origin);
                }
            }
            Met::Opaque(crossing) => chain.radiance = tint * self.shade(&flight, crossing),
            Met::OneTooMany => chain.flags |= flag::CAP | flag::LOST,
            Met::Boundary(_) => {}
        }
        chain
    }
}
