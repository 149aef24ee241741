//! A path over its events: what every way of tracing does at each of them.
//!
//! [`Tracer::meet`] follows the ray to what it meets next, takes away what media
//! absorb, and says where a boundary would send it. [`Path::go_on`] goes to one
//! of these sides, or starts again where interpolated normals trap light.

use super::media_optics::{MediaOptics, Side, continuation};
use super::restart::Restart;
use super::tracer::Tracer;
use crate::optics::bend::Bend;
use crate::world::crossing::Crossing;
use crate::world::flight::{End, Event, Flight};
use crate::world::scratch::Scratch;
use crate::world::winding::Winding;
use glam::DVec3;

/// A path under way.
#[derive(Clone, Debug)]
pub(crate) struct Path<W, S> {
    pub(crate) flight: Flight<W>,
    pub(crate) so_far: SoFar<S>,
    restart: Restart<W, SoFar<S>>,
}

/// What a path has come through.
#[derive(Clone, Debug)]
pub(crate) struct SoFar<S> {
    /// Transmittance, per channel.
    pub(crate) tint: DVec3,
    /// Boundaries met.
    pub(crate) events: u32,
    /// What one way of tracing keeps besides.
    pub(crate) own: S,
}

/// What a path meets.
pub(crate) enum Met<W> {
    /// Nothing more: light from infinity.
    Environment,
    /// An opaque surface.
    Opaque(Crossing),
    /// A boundary, and one more than a path may have.
    OneTooMany,
    /// A boundary.
    Boundary(Fork<W>),
}

/// A boundary and where it sends a path.
pub(crate) struct Fork<W> {
    pub(crate) event: Event<W>,
    pub(crate) bend: Bend,
}

impl<W> Fork<W> {
    /// All light is reflected.
    pub(crate) fn is_total(&self) -> bool {
        self.bend.transmitted.is_none()
    }
}

impl Tracer<'_> {
    /// A path at its start.
    pub(crate) fn path<W: Winding, S: Clone>(&self, flight: Flight<W>, own: S) -> Path<W, S> {
        let so_far = SoFar { tint: DVec3::ONE, events: 0, own };
        Path { flight, so_far, restart: Restart::new(self.may_trap) }
    }

    /// Follows a path to what it meets next. With `LENGTHS`, media absorb on the
    /// way and `scratch.stretches` says what it passed through.
    #[inline(always)]
    pub(crate) fn meet<W: Winding, S: Clone, const LENGTHS: bool>(
        &self,
        path: &mut Path<W, S>,
        optics: &MediaOptics,
        scratch: &mut Scratch,
    ) -> Met<W> {
        let interfaces = self.restriction.max_interfaces.unwrap_or(u32::MAX);
        let end = if path.so_far.events >= interfaces {
            scratch.stretches.clear();
            End::Environment
        } else {
            self.world.follow::<W, LENGTHS>(&path.flight, &optics.indices, scratch)
        };
        if LENGTHS {
            path.so_far.tint *= optics.transmittance(&scratch.stretches);
        }
        let mut event = match end {
            End::Event(event) => event,
            End::Environment => return Met::Environment,
            End::Opaque(crossing) => return Met::Opaque(crossing),
        };
        path.so_far.events += 1;
        scratch.counters.events += 1;
        if path.so_far.events > self.restriction.max_events {
            scratch.counters.capped += 1;
            return Met::OneTooMany;
        }
        path.restart.prepare(&mut event);
        let bend = optics.bend(path.flight.direction, &event);
        Met::Boundary(Fork { event, bend })
    }
}

impl<W: Winding, S: Clone> Path<W, S> {
    /// Goes on at one side of a boundary; under total reflection there is only
    /// one. True if that was one total reflection too many: the path is then back
    /// at an earlier boundary, behind it, with what it had come through there.
    #[inline(always)]
    pub(crate) fn go_on(&mut self, fork: &Fork<W>, side: Side, optics: &MediaOptics) -> bool {
        let Fork { event, bend } = fork;
        let incoming = self.flight.direction;
        self.flight = continuation(event, bend, side);
        if fork.is_total() {
            let Some((flight, so_far)) = self.restart.total_reflection(event, optics) else {
                return false;
            };
            (self.flight, self.so_far) = (flight, so_far);
            return true;
        }
        self.restart.remember(event, incoming, side, &self.so_far, optics);
        false
    }
}
