//! One photon's way, and where its power goes.

use crate::receiver::face::Face;
use crate::receiver::map::Balance;
use crate::sampling::sobol::Points;
use crate::transport::media_optics::{reflected, transmitted};
use crate::transport::restart::Memory;
use crate::transport::spectrum::Wave;
use crate::transport::tracer::Tracer;
use crate::world::short_way::{End, Flight, Scratch};
use crate::world::winding::Media;
use glam::DVec3;

/// Where photons are counted.
pub(super) struct Target<'a> {
    /// Index of the receiver among the scene's objects.
    pub(super) receiver: usize,
    pub(super) face: &'a Face,
    pub(super) size_bins: [u32; 2],
}

/// Random numbers after the first pair, which decides where a photon starts.
#[derive(Clone)]
pub(super) struct Draws {
    points: Points,
    sample: u32,
    drawn: u32,
    kept: f64,
}

impl Draws {
    pub(super) fn new(points: Points, sample: u32) -> Self {
        Self { points, sample, drawn: 2, kept: 0.0 }
    }

    fn next(&mut self) -> f64 {
        self.drawn += 1;
        if self.drawn.is_multiple_of(2) {
            return self.kept;
        }
        let [first, second] = self.points.pair(self.sample, self.drawn / 2);
        self.kept = second;
        first
    }
}

/// A share of one photon's power in a bin.
pub(super) struct Deposit {
    pub(super) bin: u32,
    pub(super) share: DVec3,
}

/// How one photon, or one of its colours, ends.
pub(super) struct Fate {
    /// Colours that it carries.
    mask: DVec3,
    /// What media have left of it.
    tint: DVec3,
    place: Place,
}

enum Place {
    Bin(u32),
    Surface,
    Environment,
    Nowhere,
}

/// Power by where it went, in units of a photon's.
#[derive(Clone, Copy, Default)]
pub(super) struct Tally(Balance);

impl Tally {
    /// Counts a photon; what arrives on the receiver is added to the deposits.
    pub(super) fn count(&mut self, fates: &[Option<Fate>; 3], deposits: &mut Vec<Deposit>) {
        for Fate { mask, tint, place } in fates.iter().flatten() {
            let left = *mask * *tint;
            self.0.emitted += *mask;
            self.0.absorbed += *mask - left;
            match place {
                Place::Bin(bin) => {
                    self.0.deposited += left;
                    deposits.push(Deposit { bin: *bin, share: left });
                }
                Place::Surface => self.0.absorbed += left,
                Place::Environment => self.0.escaped += left,
                Place::Nowhere => self.0.dropped += left,
            }
        }
    }

    pub(super) fn merge(&mut self, other: &Self) {
        self.add(&other.0, DVec3::ONE);
    }

    fn add(&mut self, other: &Balance, unit: DVec3) {
        self.0.emitted += other.emitted * unit;
        self.0.deposited += other.deposited * unit;
        self.0.absorbed += other.absorbed * unit;
        self.0.escaped += other.escaped * unit;
        self.0.dropped += other.dropped * unit;
    }

    /// Adds it to a balance; `unit`: power of one photon.
    pub(super) fn add_to(&self, balance: &mut Balance, unit: DVec3) {
        let mut sum = Self(*balance);
        sum.add(&self.0, unit);
        *balance = sum.0;
    }
}

/// Follows a photon: once for all colours, or once for each where they bend
/// differently.
pub(super) fn photon<M: Media>(
    tracer: &Tracer<'_>,
    target: &Target<'_>,
    flight: Flight<M>,
    draws: Draws,
    scratch: &mut Scratch,
) -> [Option<Fate>; 3] {
    let mut fates = [None, None, None];
    for (fate, wave) in fates.iter_mut().zip(&tracer.waves) {
        let draws = draws.clone();
        let (tint, place) = follow(tracer, target, (flight.clone(), wave), draws, scratch);
        // One wave carries all colours, or each of three its own.
        let mask = DVec3::new(wave.share.x_axis.x, wave.share.y_axis.y, wave.share.z_axis.z);
        *fate = Some(Fate { mask, tint, place });
    }
    fates
}

fn follow<M: Media>(
    tracer: &Tracer<'_>,
    target: &Target<'_>,
    (mut flight, wave): (Flight<M>, &Wave),
    mut draws: Draws,
    scratch: &mut Scratch,
) -> (DVec3, Place) {
    let optics = &wave.optics;
    let (mut tint, mut memory) = (DVec3::ONE, Memory::new());
    for _ in 0..=tracer.restriction.max_events {
        let end = tracer.world.follow::<M, true>(&flight, &optics.indices, scratch);
        tint *= optics.transmittance(&scratch.pieces);
        let mut event = match end {
            End::Event(event) => event,
            End::Environment => return (tint, Place::Environment),
            End::Opaque(crossing) => {
                let body = &tracer.world.bodies[crossing.body as usize];
                let spot = tracer.world.spot(&crossing);
                let lit = crossing.entering && body.object == target.receiver;
                let outward = spot.normals.geometric;
                let place = target.face.place(spot.position, outward).filter(|_| lit);
                return (tint, place.map_or(Place::Surface, |at| target.bin(at)));
            }
        };
        memory.prepare(&mut event);
        let bend = optics.bend(flight.direction, &event);
        let incoming = flight.direction;
        match bend.transmitted {
            Some(direction) => {
                let back = draws.next() < bend.reflectance;
                memory.turn(&event, incoming, back, tint, optics);
                flight =
                    if back { reflected(&event, &bend) } else { transmitted(&event, direction) };
            }
            None => {
                flight = reflected(&event, &bend);
                if let Some(again) = memory.total_reflection(optics) {
                    (flight, tint) = again;
                }
            }
        }
    }
    (tint, Place::Nowhere)
}

impl Target<'_> {
    fn bin(&self, at: [f64; 2]) -> Place {
        let index = |share: f64, count: u32| ((share * f64::from(count)) as u32).min(count - 1);
        let [columns, rows] = self.size_bins;
        Place::Bin(index(at[1], rows) * columns + index(at[0], columns))
    }
}
