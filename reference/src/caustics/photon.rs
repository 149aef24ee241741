//! One photon's way, and where its power goes.

use crate::receiver::face::Face;
use crate::receiver::map::Balance;
use crate::sampling::sobol::Points;
use crate::transport::media_optics::{MediaOptics, Side};
use crate::transport::path::Met;
use crate::transport::tracer::Tracer;
use crate::world::crossing::Crossing;
use crate::world::flight::Flight;
use crate::world::scratch::Scratch;
use crate::world::winding::Winding;
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
    ending: Ending,
}

enum Ending {
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
        for Fate { mask, tint, ending } in fates.iter().flatten() {
            let left = *mask * *tint;
            self.0.emitted += *mask;
            self.0.absorbed += *mask - left;
            match ending {
                Ending::Bin(bin) => {
                    self.0.deposited += left;
                    deposits.push(Deposit { bin: *bin, share: left });
                }
                Ending::Surface => self.0.absorbed += left,
                Ending::Environment => self.0.escaped += left,
                Ending::Nowhere => self.0.dropped += left,
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
pub(super) fn photon<W: Winding, const LENGTHS: bool>(
    tracer: &Tracer<'_>,
    target: &Target<'_>,
    flight: Flight<W>,
    draws: Draws,
    scratch: &mut Scratch,
) -> [Option<Fate>; 3] {
    let mut fates = [None, None, None];
    for (fate, wavelength) in fates.iter_mut().zip(&tracer.wavelengths) {
        let start = (flight.clone(), draws.clone());
        let optics = &wavelength.optics;
        let (tint, ending) = follow::<W, LENGTHS>(tracer, target, start, optics, scratch);
        // One wavelength carries all colours, or each of three its own.
        let share = &wavelength.share;
        let mask = DVec3::new(share.x_axis.x, share.y_axis.y, share.z_axis.z);
        *fate = Some(Fate { mask, tint, ending });
    }
    fates
}

/// What media have left of a photon, and where it ends.
fn follow<W: Winding, const LENGTHS: bool>(
    tracer: &Tracer<'_>,
    target: &Target<'_>,
    (flight, mut draws): (Flight<W>, Draws),
    optics: &MediaOptics,
    scratch: &mut Scratch,
) -> (DVec3, Ending) {
    let mut path = tracer.path(flight, ());
    let ending = loop {
        match tracer.meet::<W, _, LENGTHS>(&mut path, optics, scratch) {
            Met::Environment => break Ending::Environment,
            Met::OneTooMany => break Ending::Nowhere,
            Met::Opaque(crossing) => break target.ending(tracer, &crossing),
            Met::Boundary(fork) => {
                let back = !fork.is_total() && draws.next() < fork.bend.reflectance;
                let side = if back { Side::Reflected } else { Side::Transmitted };
                path.go_on(&fork, side, optics);
            }
        }
    };
    (path.so_far.tint, ending)
}

impl Target<'_> {
    /// Where a photon ends that meets an opaque surface.
    fn ending(&self, tracer: &Tracer<'_>, crossing: &Crossing) -> Ending {
        let body = &tracer.world.bodies[crossing.body as usize];
        let spot = tracer.world.spot(crossing);
        let lit = crossing.entering && body.object == self.receiver;
        let shares = self.face.shares_at(spot.position, spot.normals.geometric);
        shares.filter(|_| lit).map_or(Ending::Surface, |at| self.bin(at))
    }

    fn bin(&self, at: [f64; 2]) -> Ending {
        let index = |share: f64, count: u32| ((share * f64::from(count)) as u32).min(count - 1);
        let [columns, rows] = self.size_bins;
        Ending::Bin(index(at[1], rows) * columns + index(at[0], columns))
    }
}
