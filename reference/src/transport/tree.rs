//! The full tree of refractions and reflections below a camera ray.
//!
//! At every event a policy decides what is followed; the stronger continuation
//! goes on and the weaker one waits on a stack.

use crate::transport::branching::Policy;
use crate::transport::media_optics::{Optics, reflected, transmitted};
use crate::transport::restart::Memory;
use crate::transport::tracer::Tracer;
use crate::world::short_way::{End, Event, Flight, Scratch};
use crate::world::winding::Media;
use glam::DVec3;

/// A continuation that waits.
#[derive(Clone, Debug)]
pub(crate) struct Branch<M> {
    flight: Flight<M>,
    /// Product of the shares taken at every event.
    weight: f64,
    /// Transmittance so far.
    tint: DVec3,
    events: u32,
    memory: Memory<M>,
}

/// Sum over a tree.
#[derive(Clone, Copy, Debug, Default)]
pub(crate) struct Sum {
    pub(crate) radiance: DVec3,
    /// Weight of what was dropped.
    pub(crate) truncated: f64,
    /// The camera ray met a surface.
    pub(crate) met: bool,
}

/// Everything a tree is followed with.
pub(crate) struct Climb<'a, M, P> {
    pub(crate) optics: &'a Optics,
    pub(crate) policy: P,
    /// Continuations that wait, kept between trees for its memory.
    pub(crate) waiting: &'a mut Vec<Branch<M>>,
    pub(crate) scratch: &'a mut Scratch,
    /// Radiance by number of interfaces, as far as asked for.
    pub(crate) bounces: &'a mut [DVec3],
}

impl Tracer<'_> {
    /// Sums the tree below a camera ray.
    pub(crate) fn tree<M: Media, P: Policy, const UNIFORM: bool, const LENGTHS: bool>(
        &self,
        flight: Flight<M>,
        climb: &mut Climb<'_, M, P>,
    ) -> Sum {
        let mut sum = Sum::default();
        climb.waiting.clear();
        let (tint, memory) = (DVec3::ONE, Memory::new());
        let mut next = Some(Branch { flight, weight: 1.0, tint, events: 0, memory });
        while let Some(branch) = next.or_else(|| climb.waiting.pop()) {
            next = self.step::<M, P, UNIFORM, LENGTHS>(branch, climb, &mut sum);
        }
        sum
    }

    /// Follows a branch to its next event and over it; `None` where it ends.
    #[inline(always)]
    fn step<M: Media, P: Policy, const UNIFORM: bool, const LENGTHS: bool>(
        &self,
        mut branch: Branch<M>,
        climb: &mut Climb<'_, M, P>,
        sum: &mut Sum,
    ) -> Option<Branch<M>> {
        let interfaces = self.restriction.max_interfaces.unwrap_or(u32::MAX);
        let end = if branch.events >= interfaces {
            End::Environment
        } else {
            let indices = &climb.optics.indices;
            self.world.follow::<M, LENGTHS>(&branch.flight, indices, climb.scratch)
        };
        if LENGTHS {
            branch.tint *= climb.optics.transmittance(&climb.scratch.pieces);
        }
        sum.met |= branch.events == 0 && !matches!(end, End::Environment);
        let light = match end {
            End::Event(event) => return self.turn::<M, P, LENGTHS>(branch, event, climb, sum),
            End::Environment => self.environment::<UNIFORM>(branch.flight.direction),
            End::Opaque(crossing) => self.shade(&branch.flight, &crossing),
        };
        let light = light * branch.tint * branch.weight;
        sum.radiance += light;
        if let Some(bounce) = climb.bounces.get_mut(branch.events as usize) {
            *bounce += light;
        }
        None
    }

    /// Takes a branch over an event: the stronger continuation, if any.
    #[inline(always)]
    fn turn<M: Media, P: Policy, const LENGTHS: bool>(
        &self,
        mut branch: Branch<M>,
        mut event: Event<M>,
        climb: &mut Climb<'_, M, P>,
        sum: &mut Sum,
    ) -> Option<Branch<M>> {
        let optics = climb.optics;
        branch.memory.prepare(&mut event);
        let bend = optics.bend(branch.flight.direction, &event);
        branch.events += 1;
        climb.scratch.counters.events += 1;
        let present = if LENGTHS { branch.tint.max_element() } else { 1.0 };
        if branch.events > self.restriction.max_events {
            sum.truncated += branch.weight * present;
            climb.scratch.counters.capped += 1;
            return None;
        }
        let Some(direction) = bend.transmitted else {
            // Nothing to choose, and a path that starts again needs its weight:
            // only what is too faint for any sum ends here.
            branch.flight = reflected(&event, &bend);
            if let Some((flight, tint)) = branch.memory.total_reflection(optics) {
                (branch.flight, branch.tint) = (flight, tint);
            }
            return (branch.weight * present >= f64::MIN_POSITIVE).then_some(branch);
        };
        let dropped = !event.entering && !self.restriction.internal_reflection;
        let reflectance = if dropped { 0.0 } else { bend.reflectance };
        let weights = [branch.weight * reflectance, branch.weight * (1.0 - bend.reflectance)];
        let choice = climb.policy.choose(weights, present);
        sum.truncated += choice.lost;
        let incoming = branch.flight.direction;
        let continued = |back: bool, weight: f64| {
            let mut memory = branch.memory.clone();
            memory.turn(&event, incoming, back, branch.tint, optics);
            let flight =
                if back { reflected(&event, &bend) } else { transmitted(&event, direction) };
            Branch { flight, weight, tint: branch.tint, events: branch.events, memory }
        };
        let (back, on) = (choice.reflected, choice.transmitted);
        match (back > 0.0, on > 0.0) {
            (true, true) => {
                let [weak, strong] = if back <= on {
                    [(true, back), (false, on)]
                } else {
                    [(false, on), (true, back)]
                };
                climb.waiting.push(continued(weak.0, weak.1));
                Some(continued(strong.0, strong.1))
            }
            (true, false) => Some(continued(true, back)),
            (false, true) => Some(continued(false, on)),
            (false, false) => None,
        }
    }
}
