//! A ray in flight from one event to the next.
//!
//! Most rays take the short way: the closest crossing that is not with the
//! surface they left. Where rounding could confuse that (near an edge, where
//! surfaces coincide, at grazing angles between bodies, or when a count fails
//! to close) the flight is settled by all crossings of its line.

use crate::geometry::bvh::Stack;
use crate::geometry::line::Line;
use crate::world::crossing::{Crossing, Departed, Spot};
use crate::world::winding::Media;
use crate::world::{Role, World};
use glam::DVec3;
use scenes::MediumId;

/// What a ray knows about its origin.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Start {
    /// In free space: at the camera.
    Free,
    /// On a surface, clearly.
    Surface(Departed),
    /// On or near surfaces that rounding cannot tell apart.
    Unclear,
}

/// A ray about to be traced.
#[derive(Clone, Debug)]
pub(crate) struct Flight<M> {
    pub(crate) origin: DVec3,
    pub(crate) direction: DVec3,
    pub(crate) start: Start,
    /// Where it is just after its origin.
    pub(crate) media: M,
}

/// A boundary at which the index or the owner changes.
#[derive(Clone, Debug)]
pub(crate) struct Event<M> {
    pub(crate) id: u32,
    pub(crate) spot: Spot,
    /// The ray goes against the surface's outward side.
    pub(crate) entering: bool,
    /// No other surface coincides.
    pub(crate) single: bool,
    /// A gap of air without thickness: the same medium on both sides.
    pub(crate) gap: bool,
    pub(crate) before: M,
    pub(crate) after: M,
}

/// How a flight ends.
#[derive(Clone, Debug)]
pub(crate) enum End<M> {
    /// Nothing more in the way.
    Environment,
    /// A change of index.
    Event(Event<M>),
    /// An opaque surface.
    Opaque(Crossing),
}

/// Working memory of one thread and its counts of work.
#[derive(Clone, Debug, Default)]
pub(crate) struct Scratch {
    pub(crate) stack: Stack,
    pub(crate) crossings: Vec<Crossing>,
    pub(crate) splits: Vec<Split>,
    /// Lengths of the last flight per medium, metres, if asked for.
    pub(crate) pieces: Vec<(MediumId, f64)>,
    pub(crate) counters: Counters,
}

/// Deterministic counts of work.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub(crate) struct Counters {
    /// Rays sent through the tree.
    pub(crate) rays: u64,
    /// Events that bent or reflected light.
    pub(crate) events: u64,
    /// Flights settled by listing every crossing.
    pub(crate) settled: u64,
    /// Of those, flights whose state had to follow the geometry.
    pub(crate) reconciled: u64,
    /// Paths that reached the environment while inside a body.
    pub(crate) left_inside: u64,
    /// Paths that met the limit on events.
    pub(crate) capped: u64,
}

impl Counters {
    pub(crate) fn add(&mut self, other: &Self) {
        self.rays += other.rays;
        self.events += other.events;
        self.settled += other.settled;
        self.reconciled += other.reconciled;
        self.left_inside += other.left_inside;
        self.capped += other.capped;
    }
}

/// How many crossings of a class lie behind the ray.
#[derive(Clone, Copy, Debug, Default)]
pub(crate) struct Split {
    pub(crate) skip: usize,
    pub(crate) seen: usize,
}

/// Indices of refraction by class, the surroundings last.
#[derive(Clone, Debug)]
pub(crate) struct Indices {
    pub(crate) eta: Vec<f64>,
    pub(crate) medium: Vec<MediumId>,
}

impl Indices {
    pub(crate) fn place<M: Media>(&self, media: &M) -> usize {
        media.top().unwrap_or(self.eta.len() - 1)
    }

    pub(crate) fn eta<M: Media>(&self, media: &M) -> f64 {
        self.eta[self.place(media)]
    }
}

/// Cosine below which coincident surfaces may look apart.
pub(crate) const GRAZING: f64 = 1.0 / 256.0;

impl World {
    /// Follows a ray to its next event. With `LENGTHS`, `scratch.pieces` says
    /// what it passed through.
    #[inline]
    pub(crate) fn follow<M: Media, const LENGTHS: bool>(
        &self,
        flight: &Flight<M>,
        indices: &Indices,
        scratch: &mut Scratch,
    ) -> End<M> {
        if LENGTHS {
            scratch.pieces.clear();
        }
        let departed = match flight.start {
            Start::Unclear => return self.settle::<M, LENGTHS>(flight, indices, scratch),
            Start::Surface(departed) if M::CONVEX && !departed.inside => return End::Environment,
            Start::Surface(departed) => Some(departed),
            Start::Free => None,
        };
        let line = Line::new(flight.origin, flight.direction);
        let near = line.rounding_at(0.0);
        let mut media = flight.media.clone();
        let (mut after, mut from_t) = ((-near, 0), 0.0);
        let mut fresh = true;
        loop {
            scratch.counters.rays += 1;
            let next = self.next(&line, departed, after, &mut scratch.stack);
            let Some(crossing) = next.first else {
                if next.lost || !media.is_outside() {
                    return self.settle::<M, LENGTHS>(flight, indices, scratch);
                }
                return End::Environment;
            };
            let t = crossing.t;
            let own = departed.is_some_and(|d| self.same_analytic(d.id, crossing.id));
            let close = (fresh && t < near && !own) || next.second_t - t <= line.rounding_at(t);
            let grazing = self.bodies.len() > 1 && self.cosine(&line, &crossing) < GRAZING;
            if close || next.lost || grazing {
                return self.settle::<M, LENGTHS>(flight, indices, scratch);
            }
            let class = match self.bodies[crossing.body as usize].role {
                Role::Solid(class) => class,
                Role::Crack(host) if media.top() != Some(host) => {
                    (after, fresh) = (crossing.key(), false);
                    continue;
                }
                role => {
                    note::<M, LENGTHS>(scratch, indices, &media, t - from_t);
                    return self.thin(&crossing, role, media);
                }
            };
            let mut beyond = media.clone();
            beyond.cross(class, crossing.entering);
            note::<M, LENGTHS>(scratch, indices, &media, t - from_t);
            if indices.eta(&media) != indices.eta(&beyond) {
                return End::Event(self.event(&crossing, true, media, beyond));
            }
            (media, after, from_t, fresh) = (beyond, crossing.key(), t, false);
        }
    }

    /// What a surface without an inside does.
    pub(crate) fn thin<M: Media>(&self, crossing: &Crossing, role: Role, media: M) -> End<M> {
        if role == Role::Opaque {
            return End::Opaque(*crossing);
        }
        let gap = self.event(crossing, true, media.clone(), media);
        End::Event(Event { gap: true, ..gap })
    }

    pub(crate) fn event<M: Media>(
        &self,
        crossing: &Crossing,
        single: bool,
        before: M,
        after: M,
    ) -> Event<M> {
        let (id, entering) = (crossing.id, crossing.entering);
        let spot = self.spot(crossing);
        Event { id, spot, entering, single, gap: false, before, after }
    }
}

/// Notes a piece of the way.
#[inline(always)]
pub(crate) fn note<M: Media, const LENGTHS: bool>(
    scratch: &mut Scratch,
    indices: &Indices,
    media: &M,
    length: f64,
) {
    if LENGTHS && length > 0.0 {
        scratch.pieces.push((indices.medium[indices.place(media)], length));
    }
}
