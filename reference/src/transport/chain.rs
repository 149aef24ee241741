//! The primary chain: transmitted wherever possible, reflected where total
//! reflection leaves no choice. It has one exit, which layers can show.

use crate::transport::media_optics::{reflected, transmitted};
use crate::transport::restart::Memory;
use crate::transport::tracer::Tracer;
use crate::world::short_way::{End, Flight, Scratch};
use crate::world::winding::Media;
use glam::DVec3;
use scenes::layer::flag;

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

impl Tracer<'_> {
    /// Traces the chain of a ray from the camera.
    pub(crate) fn chain<M: Media, const UNIFORM: bool, const LENGTHS: bool>(
        &self,
        mut flight: Flight<M>,
        scratch: &mut Scratch,
    ) -> Chain {
        let optics = &self.d_line;
        let mut chain = Chain::default();
        if LENGTHS {
            // The last is air that no medium of the scene stands for.
            chain.lengths = vec![0.0; optics.absorption.len() + 1];
        }
        let (mut tint, mut memory) = (DVec3::ONE, Memory::new());
        let interfaces = self.restriction.max_interfaces.unwrap_or(u32::MAX);
        loop {
            let end = if chain.events >= interfaces {
                End::Environment
            } else {
                self.world.follow::<M, LENGTHS>(&flight, &optics.indices, scratch)
            };
            if LENGTHS {
                tint *= optics.transmittance(&scratch.pieces);
                for (medium, length) in &scratch.pieces {
                    chain.lengths[usize::from(medium.0)] += length;
                }
            }
            chain.met |= !matches!(end, End::Environment);
            let mut event = match end {
                End::Event(event) => event,
                End::Environment => {
                    chain.radiance = tint * self.environment::<UNIFORM>(flight.direction);
                    if chain.events > 0 {
                        chain.exit = flight.direction;
                        chain.exit_position = flight.origin;
                    }
                    return chain;
                }
                End::Opaque(crossing) => {
                    chain.radiance = tint * self.shade(&flight, &crossing);
                    return chain;
                }
            };
            chain.events += 1;
            scratch.counters.events += 1;
            if chain.events > self.restriction.max_events {
                chain.flags |= flag::CAP | flag::LOST;
                scratch.counters.capped += 1;
                return chain;
            }
            memory.prepare(&mut event);
            let bend = optics.bend(flight.direction, &event);
            chain.flags |= if bend.geometric { flag::GEOMETRIC_NORMAL } else { 0 };
            if let Some(direction) = bend.transmitted {
                memory.turn(&event, flight.direction, false, tint, optics);
                flight = transmitted(&event, direction);
            } else {
                chain.total_reflections += 1;
                flight = reflected(&event, &bend);
                if let Some(again) = memory.total_reflection(optics) {
                    (flight, tint) = again;
                    chain.flags |= flag::GEOMETRIC_NORMAL;
                }
            }
            match chain.events {
                1 => chain.first = flight.direction,
                2 => chain.hit2 = flight.origin,
                _ => {}
            }
        }
    }
}
