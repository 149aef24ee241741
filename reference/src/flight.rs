//! A ray in flight from one event to the next.
//!
//! Most rays take the short way: the closest crossing that is not with the
//! surface they left. Where rounding could confuse that (near an edge, where
//! surfaces coincide, at grazing angles between bodies, or when a count fails
//! to close) every crossing of the line is listed and the count decides where
//! on it the ray is. So state and geometry always agree.

use crate::crossing::{Crossing, Departed, Spot};
use crate::line::Line;
use crate::media::Media;
use crate::wide::Stack;
use crate::world::{Role, World};
use glam::DVec3;
use scenes::{MediumId, Ray};

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
    crossings: Vec<Crossing>,
    splits: Vec<Split>,
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
struct Split {
    skip: usize,
    seen: usize,
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
const GRAZING: f64 = 1.0 / 256.0;
/// Cosine at which the blur of a crossing stops growing.
const FLATTEST: f64 = 1.0 / (1u64 << 26) as f64;

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
    fn thin<M: Media>(&self, crossing: &Crossing, role: Role, media: M) -> End<M> {
        if role == Role::Opaque {
            return End::Opaque(*crossing);
        }
        let gap = self.event(crossing, true, media.clone(), media);
        End::Event(Event { gap: true, ..gap })
    }

    fn event<M: Media>(&self, crossing: &Crossing, single: bool, before: M, after: M) -> Event<M> {
        let (id, entering) = (crossing.id, crossing.entering);
        let spot = self.spot(crossing);
        Event { id, spot, entering, single, gap: false, before, after }
    }

    /// The same with all crossings of the line in view.
    #[cold]
    fn settle<M: Media, const LENGTHS: bool>(
        &self,
        flight: &Flight<M>,
        indices: &Indices,
        scratch: &mut Scratch,
    ) -> End<M> {
        scratch.counters.settled += 1;
        scratch.counters.rays += 1;
        if LENGTHS {
            scratch.pieces.clear();
        }
        let line = Line::new(flight.origin, flight.direction);
        let mut crossings = std::mem::take(&mut scratch.crossings);
        self.all_crossings(&line, &mut crossings);
        let mut media = flight.media.clone();
        self.split(&line, &mut crossings, &mut media, scratch);
        let end = self.walk::<M, LENGTHS>(&line, &crossings, media, indices, scratch);
        scratch.crossings = crossings;
        end
    }

    /// Removes the crossings behind the ray: per class as many as make the
    /// count what it is, if that is possible within rounding.
    fn split<M: Media>(
        &self,
        line: &Line,
        crossings: &mut Vec<Crossing>,
        media: &mut M,
        scratch: &mut Scratch,
    ) {
        let window = |c: &Crossing| line.rounding_at(c.t) / self.cosine(line, c).max(FLATTEST);
        let class_of = |c: &Crossing| self.bodies[c.body as usize].class();
        scratch.splits.clear();
        for class in 0..self.classes.len() {
            let (mut least, mut behind, mut most, mut seen) = (0, 0, usize::MAX, 0);
            for crossing in crossings.iter().filter(|c| class_of(c) == Some(class)) {
                seen += 1;
                if crossing.t < -window(crossing) {
                    least = seen;
                } else if crossing.t > window(crossing) && most == usize::MAX {
                    most = seen - 1;
                }
                if crossing.t <= 0.0 {
                    behind = seen;
                }
            }
            let most = most.min(seen);
            let wanted = media.get(class);
            let mut count = 0_i16;
            let mut best: Option<(usize, usize)> = None; // (distance, how many)
            let mut nearest = 0_i16;
            let own = crossings.iter().filter(|c| class_of(c) == Some(class));
            let signs = own.map(|c| if c.entering { 1 } else { -1 }).chain([0]);
            for (before, sign) in signs.enumerate() {
                let distance = before.abs_diff(behind);
                let open = (least..=most).contains(&before) && count == wanted;
                if open && best.is_none_or(|best| distance < best.0) {
                    best = Some((distance, before));
                }
                if before == behind {
                    nearest = count;
                }
                count += sign;
            }
            if best.is_none() {
                scratch.counters.reconciled += 1;
                media.set(class, nearest);
            }
            scratch.splits.push(Split { skip: best.map_or(behind, |best| best.1), seen: 0 });
        }
        let splits = &mut scratch.splits;
        crossings.retain(|crossing| match class_of(crossing) {
            Some(class) => {
                splits[class].seen += 1;
                splits[class].seen > splits[class].skip
            }
            None => crossing.t > window(crossing),
        });
    }

    /// Walks ordered crossings ahead to the first change of index. Crossings
    /// within rounding of each other are one.
    fn walk<M: Media, const LENGTHS: bool>(
        &self,
        line: &Line,
        crossings: &[Crossing],
        mut media: M,
        indices: &Indices,
        scratch: &mut Scratch,
    ) -> End<M> {
        let class_of = |c: &Crossing| self.bodies[c.body as usize].class();
        let (mut rest, mut from_t) = (crossings, 0.0);
        while let Some(first) = rest.first() {
            let t = first.t.max(0.0);
            match self.bodies[first.body as usize].role {
                Role::Solid(_) => {}
                Role::Crack(host) if media.top() != Some(host) => {
                    rest = &rest[1..];
                    continue;
                }
                role => {
                    note::<M, LENGTHS>(scratch, indices, &media, t - from_t);
                    return self.thin(first, role, media);
                }
            }
            note::<M, LENGTHS>(scratch, indices, &media, t - from_t);
            let window = line.rounding_at(first.t) / self.cosine(line, first).max(GRAZING);
            let together = |c: &&Crossing| c.t <= first.t + window && class_of(c).is_some();
            let group = &rest[..rest.iter().take_while(together).count().max(1)];
            let mut beyond = media.clone();
            for crossing in group {
                if let Some(class) = class_of(crossing) {
                    beyond.cross(class, crossing.entering);
                }
            }
            if indices.eta(&media) != indices.eta(&beyond) {
                // The surface of the medium that begins here, or else ends here.
                let of = |m: &M| group.iter().find(|c| class_of(c) == m.top());
                let decisive = of(&beyond).or(of(&media)).unwrap_or(first);
                return End::Event(self.event(decisive, group.len() == 1, media, beyond));
            }
            (media, from_t) = (beyond, t);
            rest = &rest[group.len()..];
        }
        if !media.is_outside() {
            scratch.counters.left_inside += 1;
        }
        End::Environment
    }

    /// The state at a point in free space, from the crossings of one line.
    pub(crate) fn media_at<M: Media>(&self, point: DVec3, scratch: &mut Scratch) -> M {
        let direction = DVec3::new(0.48, 0.6, 0.64);
        let line = Line::new(point, direction);
        let mut crossings = std::mem::take(&mut scratch.crossings);
        self.all_crossings(&line, &mut crossings);
        let mut media = M::outside();
        for crossing in crossings.iter().filter(|crossing| crossing.t <= 0.0) {
            if let Some(class) = self.bodies[crossing.body as usize].class() {
                media.cross(class, crossing.entering);
            }
        }
        scratch.crossings = crossings;
        media
    }
}

impl World {
    /// True if a straight ray meets a crack while inside its solid.
    pub(crate) fn meets_crack<M: Media>(&self, ray: Ray, scratch: &mut Scratch) -> bool {
        let line = Line::new(ray.origin, ray.direction);
        let mut media = M::outside();
        self.all_crossings(&line, &mut scratch.crossings);
        scratch.crossings.iter().any(|crossing| {
            match self.bodies[crossing.body as usize].role {
                Role::Solid(class) => media.cross(class, crossing.entering),
                Role::Crack(host) => return crossing.t > 0.0 && media.top() == Some(host),
                Role::Opaque => {}
            }
            false
        })
    }
}

#[inline(always)]
fn note<M: Media, const LENGTHS: bool>(
    scratch: &mut Scratch,
    indices: &Indices,
    media: &M,
    length: f64,
) {
    if LENGTHS && length > 0.0 {
        scratch.pieces.push((indices.medium[indices.place(media)], length));
    }
}
