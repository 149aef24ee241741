//! From one event to the next: the short way, by closest crossings.
//!
//! Most rays take it: the closest crossing that is not with the surface they
//! left. Where rounding could confuse that (near an edge, where surfaces
//! coincide, at grazing angles between bodies, or when a count fails to close)
//! the flight takes the long way.

use super::crossing::{Crossing, Departed, Next};
use super::flight::{End, Event, Flight, Start};
use super::scratch::Scratch;
use super::winding::{Indices, Winding};
use super::{Role, World};
use crate::geometry::line::Line;

/// Cosine below which coincident surfaces may look apart.
pub(crate) const GRAZING: f64 = 1.0 / 256.0;

impl World {
    /// Follows a ray to its next event. With `LENGTHS`, `scratch.stretches` says
    /// what it passed through.
    #[inline]
    pub(crate) fn follow<W: Winding, const LENGTHS: bool>(
        &self,
        flight: &Flight<W>,
        indices: &Indices,
        scratch: &mut Scratch,
    ) -> End<W> {
        if LENGTHS {
            scratch.stretches.clear();
        }
        let departed = match flight.start {
            Start::Unclear => return self.long_way::<W, LENGTHS>(flight, indices, scratch),
            Start::Surface(departed) if W::CONVEX && !departed.inside => return End::Environment,
            Start::Surface(departed) => Some(departed),
            Start::Free => None,
        };
        let clear = self.short_way::<W, LENGTHS>(flight, departed, indices, scratch);
        clear.unwrap_or_else(|| self.long_way::<W, LENGTHS>(flight, indices, scratch))
    }

    /// `None` where rounding leaves a doubt.
    #[inline(always)]
    fn short_way<W: Winding, const LENGTHS: bool>(
        &self,
        flight: &Flight<W>,
        departed: Option<Departed>,
        indices: &Indices,
        scratch: &mut Scratch,
    ) -> Option<End<W>> {
        let line = Line::new(flight.origin, flight.direction);
        let mut winding = flight.winding.clone();
        let (mut after, mut from_t) = ((-line.rounding_at(0.0), 0), 0.0);
        let mut fresh = true;
        loop {
            scratch.counters.rays += 1;
            let next = self.next(&line, departed, after, &mut scratch.stack);
            let Some(crossing) = next.first else {
                let free = !next.lost && winding.is_outside();
                return free.then_some(End::Environment);
            };
            if self.is_doubtful(&line, departed, &next, &crossing, fresh) {
                return None;
            }
            let t = crossing.t;
            let class = match self.bodies[crossing.body as usize].role {
                Role::Solid(class) => class,
                Role::Crack(host) if winding.top() != Some(host) => {
                    (after, fresh) = (crossing.key(), false);
                    continue;
                }
                role => {
                    scratch.note::<W, LENGTHS>(indices, &winding, t - from_t);
                    return Some(self.thin(&crossing, role, winding));
                }
            };
            let mut beyond = winding.clone();
            beyond.cross(class, crossing.entering);
            scratch.note::<W, LENGTHS>(indices, &winding, t - from_t);
            if indices.eta(&winding) != indices.eta(&beyond) {
                return Some(End::Event(self.event(&crossing, true, winding, beyond)));
            }
            (winding, after, from_t, fresh) = (beyond, crossing.key(), t, false);
        }
    }

    /// Rounding could make the closest crossing another one. `fresh`: the ray has
    /// passed nothing yet.
    #[inline(always)]
    fn is_doubtful(
        &self,
        line: &Line,
        departed: Option<Departed>,
        next: &Next,
        crossing: &Crossing,
        fresh: bool,
    ) -> bool {
        let t = crossing.t;
        let own = departed.is_some_and(|d| self.same_analytic(d.id, crossing.id));
        let at_start = fresh && t < line.rounding_at(0.0) && !own;
        let close = at_start || next.second_t - t <= line.rounding_at(t);
        let grazing = self.bodies.len() > 1 && self.cosine(line, crossing) < GRAZING;
        close || next.lost || grazing
    }

    /// What a surface without an inside does.
    pub(crate) fn thin<W: Winding>(&self, crossing: &Crossing, role: Role, winding: W) -> End<W> {
        if role == Role::Opaque {
            return End::Opaque(*crossing);
        }
        let gap = self.event(crossing, true, winding.clone(), winding);
        End::Event(Event { gap: true, ..gap })
    }

    pub(crate) fn event<W: Winding>(
        &self,
        crossing: &Crossing,
        single: bool,
        before: W,
        after: W,
    ) -> Event<W> {
        let (id, entering) = (crossing.id, crossing.entering);
        let spot = self.spot(crossing);
        Event { id, spot, entering, single, gap: false, before, after }
    }
}
