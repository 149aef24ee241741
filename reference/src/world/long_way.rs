//! From one event to the next: the long way, by all crossings of the line.
//!
//! Flights that rounding could confuse take it. The winding decides where among
//! the crossings the ray is, so that it and the geometry always agree.

use super::crossing::Crossing;
use super::flight::{End, Flight};
use super::scratch::{Scratch, Split};
use super::short_way::GRAZING;
use super::winding::{Indices, Winding};
use super::{Role, World};
use crate::geometry::line::Line;
use glam::DVec3;
use scenes::Ray;

/// Cosine at which the blur of a crossing stops growing.
const FLATTEST: f64 = 1.0 / (1u64 << 26) as f64;

impl World {
    /// Follows a ray to its next event with all crossings of its line in view.
    #[cold]
    pub(crate) fn long_way<W: Winding, const LENGTHS: bool>(
        &self,
        flight: &Flight<W>,
        indices: &Indices,
        scratch: &mut Scratch,
    ) -> End<W> {
        scratch.counters.settled += 1;
        scratch.counters.rays += 1;
        if LENGTHS {
            scratch.stretches.clear();
        }
        let line = Line::new(flight.origin, flight.direction);
        let mut crossings = std::mem::take(&mut scratch.crossings);
        self.all_crossings(&line, &mut crossings);
        let mut winding = flight.winding.clone();
        self.split(&line, &mut crossings, &mut winding, scratch);
        let end = self.walk::<W, LENGTHS>(&line, &crossings, winding, indices, scratch);
        scratch.crossings = crossings;
        end
    }

    fn class_of(&self, crossing: &Crossing) -> Option<usize> {
        self.bodies[crossing.body as usize].class()
    }

    /// How far along the line rounding can move a crossing. Not at all where that
    /// is infinitely far away.
    fn blur(&self, line: &Line, crossing: &Crossing) -> f64 {
        if crossing.t.is_infinite() {
            return 0.0;
        }
        line.rounding_at(crossing.t) / self.cosine(line, crossing).max(FLATTEST)
    }

    /// Removes the crossings behind the ray: per class as many as make the
    /// count what it is, if that is possible within rounding.
    fn split<W: Winding>(
        &self,
        line: &Line,
        crossings: &mut Vec<Crossing>,
        winding: &mut W,
        scratch: &mut Scratch,
    ) {
        scratch.splits.clear();
        for class in 0..self.classes.len() {
            let own = crossings.iter().filter(|c| self.class_of(c) == Some(class));
            let behind = self.behind(line, own.clone());
            let skip = behind.that_make(winding.get(class), own).unwrap_or_else(|count| {
                scratch.counters.reconciled += 1;
                winding.set(class, count);
                behind.by_t
            });
            scratch.splits.push(Split { skip, seen: 0 });
        }
        let splits = &mut scratch.splits;
        crossings.retain(|crossing| match self.class_of(crossing) {
            Some(class) => {
                splits[class].seen += 1;
                splits[class].seen > splits[class].skip
            }
            None => crossing.t > self.blur(line, crossing),
        });
    }

    /// How many of ordered crossings are behind the ray.
    fn behind<'a>(&self, line: &Line, ordered: impl Iterator<Item = &'a Crossing>) -> Behind {
        let (mut least, mut by_t, mut most, mut seen) = (0, 0, usize::MAX, 0);
        for crossing in ordered {
            let blur = self.blur(line, crossing);
            seen += 1;
            if crossing.t < -blur {
                least = seen;
            } else if crossing.t > blur && most == usize::MAX {
                most = seen - 1;
            }
            if crossing.t <= 0.0 {
                by_t = seen;
            }
        }
        Behind { least, by_t, most: most.min(seen) }
    }

    /// Walks ordered crossings ahead to the first change of index. Crossings
    /// within rounding of each other are one.
    fn walk<W: Winding, const LENGTHS: bool>(
        &self,
        line: &Line,
        crossings: &[Crossing],
        mut winding: W,
        indices: &Indices,
        scratch: &mut Scratch,
    ) -> End<W> {
        let (mut rest, mut from_t) = (crossings, 0.0);
        while let Some(first) = rest.first() {
            if first.t == f64::INFINITY {
                // A body without end, and no surface there.
                scratch.note::<W, LENGTHS>(indices, &winding, f64::INFINITY);
                return End::Environment;
            }
            let t = first.t.max(0.0);
            match self.bodies[first.body as usize].role {
                Role::Solid(_) => {}
                Role::Crack(host) if winding.top() != Some(host) => {
                    rest = &rest[1..];
                    continue;
                }
                role => {
                    scratch.note::<W, LENGTHS>(indices, &winding, t - from_t);
                    return self.thin(first, role, winding);
                }
            }
            scratch.note::<W, LENGTHS>(indices, &winding, t - from_t);
            let group = &rest[..self.together(line, rest)];
            let beyond = self.beyond(group, &winding);
            if indices.eta(&winding) != indices.eta(&beyond) {
                // The surface of the medium that begins here, or else ends here.
                let of = |w: &W| group.iter().find(|c| self.class_of(c) == w.top());
                let decisive = of(&beyond).or(of(&winding)).unwrap_or(first);
                return End::Event(self.event(decisive, group.len() == 1, winding, beyond));
            }
            (winding, from_t) = (beyond, t);
            rest = &rest[group.len()..];
        }
        if !winding.is_outside() {
            scratch.counters.left_inside += 1;
        }
        End::Environment
    }

    /// The winding behind crossings that are one.
    fn beyond<W: Winding>(&self, group: &[Crossing], winding: &W) -> W {
        let mut beyond = winding.clone();
        for crossing in group {
            if let Some(class) = self.class_of(crossing) {
                beyond.cross(class, crossing.entering);
            }
        }
        beyond
    }

    /// How many of the first of ordered crossings rounding cannot tell apart.
    fn together(&self, line: &Line, ordered: &[Crossing]) -> usize {
        let Some(first) = ordered.first() else { return 0 };
        let window = line.rounding_at(first.t) / self.cosine(line, first).max(GRAZING);
        let near = |c: &&Crossing| c.t <= first.t + window && self.class_of(c).is_some();
        ordered.iter().take_while(near).count().max(1)
    }
}

/// How many of a class's crossings lie behind a ray.
#[derive(Clone, Copy, Debug)]
struct Behind {
    /// Certainly.
    least: usize,
    /// If t were exact.
    by_t: usize,
    /// If rounding is taken to the full.
    most: usize,
}

impl Behind {
    /// How many crossings behind the ray make this count, the nearest to what t
    /// says; the count that t says if none do.
    fn that_make<'a>(
        &self,
        wanted: i16,
        ordered: impl Iterator<Item = &'a Crossing>,
    ) -> Result<usize, i16> {
        let mut count = 0_i16;
        let mut best: Option<(usize, usize)> = None; // (distance, how many)
        let mut by_t = 0_i16;
        let signs = ordered.map(|c| if c.entering { 1 } else { -1 }).chain([0]);
        for (before, sign) in signs.enumerate() {
            let distance = before.abs_diff(self.by_t);
            let open = (self.least..=self.most).contains(&before) && count == wanted;
            if open && best.is_none_or(|best| distance < best.0) {
                best = Some((distance, before));
            }
            if before == self.by_t {
                by_t = count;
            }
            count += sign;
        }
        best.map(|best| best.1).ok_or(by_t)
    }
}

impl World {
    /// What a point in free space is inside of, from the crossings of one line.
    pub(crate) fn winding_at<W: Winding>(&self, point: DVec3, scratch: &mut Scratch) -> W {
        let direction = DVec3::new(0.48, 0.6, 0.64);
        let line = Line::new(point, direction);
        let mut crossings = std::mem::take(&mut scratch.crossings);
        self.all_crossings(&line, &mut crossings);
        let mut winding = W::outside();
        for crossing in crossings.iter().filter(|crossing| crossing.t <= 0.0) {
            if let Some(class) = self.class_of(crossing) {
                winding.cross(class, crossing.entering);
            }
        }
        scratch.crossings = crossings;
        winding
    }

    /// True if a straight ray meets a crack while inside its solid.
    pub(crate) fn meets_crack<W: Winding>(&self, ray: Ray, scratch: &mut Scratch) -> bool {
        let line = Line::new(ray.origin, ray.direction);
        let mut winding = W::outside();
        self.all_crossings(&line, &mut scratch.crossings);
        scratch.crossings.iter().any(|crossing| {
            match self.bodies[crossing.body as usize].role {
                Role::Solid(class) => winding.cross(class, crossing.entering),
                Role::Crack(host) => return crossing.t > 0.0 && winding.top() == Some(host),
                Role::Opaque => {}
            }
            false
        })
    }
}
