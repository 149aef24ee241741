//! Flights that rounding could confuse: every crossing of the line is listed,
//! and the count decides where on it the ray is. So state and geometry always
//! agree.

use crate::geometry::line::Line;
use crate::world::crossing::Crossing;
use crate::world::short_way::{End, Flight, GRAZING, Indices, Scratch, Split, note};
use crate::world::winding::Media;
use crate::world::{Role, World};
use glam::DVec3;
use scenes::Ray;

/// Cosine at which the blur of a crossing stops growing.
const FLATTEST: f64 = 1.0 / (1u64 << 26) as f64;

impl World {
    /// The same with all crossings of the line in view.
    #[cold]
    pub(crate) fn settle<M: Media, const LENGTHS: bool>(
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
