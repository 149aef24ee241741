//! Light that interpolated normals would trap.
//!
//! Real surfaces preserve phase space, so what enters a body leaves it again
//! (almost surely). Interpolated normals do not: a path can be caught in an
//! orbit of total reflections without end. A path that has been totally
//! reflected [`PATIENCE`] times in a row, and not by geometric normals alone,
//! therefore goes back to the event before and is followed from there with
//! geometric normals, which do. What it came through since is forgotten.

use super::media_optics::{MediaOptics, Side, continuation};
use crate::optics::bend::SurfaceNormals;
use crate::world::flight::{Event, Flight};
use crate::world::winding::Winding;
use glam::DVec3;

/// Total reflections in a row before a path starts again.
const PATIENCE: u32 = 64;

/// What a path needs to start again from its last event that was no total
/// reflection. `T`: what it had come through behind that event.
#[derive(Clone, Debug)]
pub(crate) struct Restart<W, T> {
    last: Option<Remembered<W, T>>,
    in_a_row: u32,
    /// Since then a shading normal was another one than the geometric.
    bent: bool,
    /// Geometric normals from now on, because the path has started again or there
    /// are no others.
    flat: bool,
}

#[derive(Clone, Debug)]
struct Remembered<W, T> {
    event: Event<W>,
    incoming: DVec3,
    side: Side,
    so_far: T,
}

impl<W: Winding, T: Clone> Restart<W, T> {
    /// * `may_trap`: there are shading normals.
    pub(crate) fn new(may_trap: bool) -> Self {
        Self { last: None, in_a_row: 0, bent: false, flat: !may_trap }
    }

    /// Takes the shading normal from an event if this path no longer uses it.
    pub(crate) fn prepare(&self, event: &mut Event<W>) {
        if self.flat {
            let geometric = event.spot.normals.geometric;
            event.spot.normals = SurfaceNormals { geometric, shading: geometric };
        }
    }

    /// Remembers an event that was no total reflection, unless the geometric
    /// normal would have made it one: from there no light comes from outside.
    pub(crate) fn remember(
        &mut self,
        event: &Event<W>,
        incoming: DVec3,
        side: Side,
        so_far: &T,
        optics: &MediaOptics,
    ) {
        self.in_a_row = 0;
        if self.flat {
            return;
        }
        let bent = event.spot.normals.are_apart();
        let cosine = incoming.dot(event.spot.normals.geometric);
        let eta_i_over_t = optics.indices.eta(&event.before) / optics.indices.eta(&event.after);
        let sine_beyond = eta_i_over_t * (1.0 - cosine * cosine).max(0.0).sqrt();
        if sine_beyond < 1.0 {
            let (event, so_far) = (event.clone(), so_far.clone());
            self.last = Some(Remembered { event, incoming, side, so_far });
            self.bent = bent;
        } else {
            self.bent |= bent;
        }
    }

    /// Counts a total reflection. After too many: the path from where it starts
    /// again, and what it had come through there.
    pub(crate) fn total_reflection(
        &mut self,
        event: &Event<W>,
        optics: &MediaOptics,
    ) -> Option<(Flight<W>, T)> {
        self.in_a_row += 1;
        self.bent |= event.spot.normals.are_apart();
        if self.flat || !self.bent || self.in_a_row < PATIENCE {
            return None;
        }
        self.flat = true;
        let Remembered { mut event, incoming, side, so_far } = self.last.take()?;
        self.prepare(&mut event);
        let bend = optics.bend(incoming, &event);
        Some((continuation(&event, &bend, side), so_far))
    }
}
