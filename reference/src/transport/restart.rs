//! Light that interpolated normals would trap.
//!
//! Real surfaces preserve phase space, so what enters a body leaves it again
//! (almost surely). Interpolated normals do not: a path can be caught in an
//! orbit of total reflections without end. A path that has been totally
//! reflected [`PATIENCE`] times in a row therefore goes back to the event
//! before and is followed from there with geometric normals, which do.

use crate::optics::bend::Normals;
use crate::transport::media_optics::{Optics, reflected, transmitted};
use crate::world::short_way::{Event, Flight};
use crate::world::winding::Media;
use glam::DVec3;

/// Total reflections in a row before a path starts again.
const PATIENCE: u32 = 64;

/// What a path needs to start again from its last event that was no total
/// reflection.
#[derive(Clone, Debug)]
pub(crate) struct Memory<M> {
    turn: Option<Turn<M>>,
    in_a_row: u32,
    /// The path has started again: geometric normals from now on.
    flat: bool,
}

#[derive(Clone, Debug)]
struct Turn<M> {
    event: Event<M>,
    incoming: DVec3,
    reflected: bool,
    tint: DVec3,
}

impl<M: Media> Memory<M> {
    pub(crate) fn new() -> Self {
        Self { turn: None, in_a_row: 0, flat: false }
    }

    /// Takes the shading normal from an event if this path no longer uses it.
    pub(crate) fn prepare(&self, event: &mut Event<M>) {
        if self.flat {
            let geometric = event.spot.normals.geometric;
            event.spot.normals = Normals { geometric, shading: geometric };
        }
    }

    /// Remembers an event that was no total reflection, unless the geometric
    /// normal would have made it one: from there no light comes from outside.
    pub(crate) fn turn(
        &mut self,
        event: &Event<M>,
        incoming: DVec3,
        reflected: bool,
        tint: DVec3,
        optics: &Optics,
    ) {
        self.in_a_row = 0;
        let cosine = incoming.dot(event.spot.normals.geometric);
        let sides = [optics.indices.eta(&event.before), optics.indices.eta(&event.after)];
        let sine_beyond = sides[0] / sides[1] * (1.0 - cosine * cosine).max(0.0).sqrt();
        if !self.flat && sine_beyond < 1.0 {
            self.turn = Some(Turn { event: event.clone(), incoming, reflected, tint });
        }
    }

    /// Counts a total reflection. After too many: the path from where it starts
    /// again, and its transmittance there.
    pub(crate) fn total_reflection(&mut self, optics: &Optics) -> Option<(Flight<M>, DVec3)> {
        self.in_a_row += 1;
        if self.flat || self.in_a_row < PATIENCE {
            return None;
        }
        self.flat = true;
        let Turn { mut event, incoming, reflected: back, tint } = self.turn.take()?;
        self.prepare(&mut event);
        let bend = optics.bend(incoming, &event);
        let flight = match bend.transmitted {
            Some(direction) if !back => transmitted(&event, direction),
            _ => reflected(&event, &bend),
        };
        Some((flight, tint))
    }
}
