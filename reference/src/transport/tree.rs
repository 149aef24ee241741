//! The full tree of refractions and reflections below a camera ray.
//!
//! At every event a policy decides what is followed; the stronger continuation
//! goes on and the weaker one waits on a stack.

use super::branching::Policy;
use super::media_optics::{MediaOptics, Side};
use super::path::{Fork, Met, Path};
use super::tracer::Tracer;
use crate::world::flight::Flight;
use crate::world::scratch::Scratch;
use crate::world::winding::Winding;
use glam::DVec3;

/// A continuation.
#[derive(Clone, Debug)]
pub(crate) struct Branch<W> {
    path: Path<W, ()>,
    /// Product of the shares taken at every event.
    weight: f64,
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
pub(crate) struct Climb<'a, W, P> {
    pub(crate) optics: &'a MediaOptics,
    pub(crate) policy: P,
    /// Continuations that wait, kept between trees for its memory.
    pub(crate) waiting: &'a mut Vec<Branch<W>>,
    pub(crate) scratch: &'a mut Scratch,
    /// Radiance by number of interfaces, as far as asked for.
    pub(crate) bounces: &'a mut [DVec3],
}

impl<W: Winding> Branch<W> {
    /// Transmittance so far, 0 to 1; 1 where nothing absorbs.
    fn present<const LENGTHS: bool>(&self) -> f64 {
        if LENGTHS { self.path.so_far.tint.max_element() } else { 1.0 }
    }

    fn go_on(mut self, fork: &Fork<W>, side: Side, weight: f64, optics: &MediaOptics) -> Self {
        self.path.go_on(fork, side, optics);
        Self { weight, ..self }
    }
}

impl Tracer<'_> {
    /// Sums the tree below a camera ray.
    pub(crate) fn tree<W: Winding, P: Policy, const UNIFORM: bool, const LENGTHS: bool>(
        &self,
        flight: Flight<W>,
        climb: &mut Climb<'_, W, P>,
    ) -> Sum {
        let mut sum = Sum::default();
        climb.waiting.clear();
        let mut next = Some(Branch { path: self.path(flight, ()), weight: 1.0 });
        while let Some(branch) = next.or_else(|| climb.waiting.pop()) {
            next = self.step::<W, P, UNIFORM, LENGTHS>(branch, climb, &mut sum);
        }
        sum
    }

    /// Follows a branch to its next event and over it; `None` where it ends.
    #[inline(always)]
    fn step<W: Winding, P: Policy, const UNIFORM: bool, const LENGTHS: bool>(
        &self,
        mut branch: Branch<W>,
        climb: &mut Climb<'_, W, P>,
        sum: &mut Sum,
    ) -> Option<Branch<W>> {
        let before = branch.path.so_far.events;
        let met = self.meet::<W, _, LENGTHS>(&mut branch.path, climb.optics, climb.scratch);
        sum.met |= before == 0 && !matches!(met, Met::Environment);
        let light = match met {
            Met::Boundary(fork) => {
                return self.branch::<W, P, LENGTHS>(branch, &fork, climb, sum);
            }
            Met::OneTooMany => {
                sum.truncated += branch.weight * branch.present::<LENGTHS>();
                return None;
            }
            Met::Environment => self.environment::<UNIFORM>(branch.path.flight.direction),
            Met::Opaque(crossing) => self.shade(&branch.path.flight, &crossing),
        };
        let light = light * branch.path.so_far.tint * branch.weight;
        sum.radiance += light;
        if let Some(bounce) = climb.bounces.get_mut(before as usize) {
            *bounce += light;
        }
        None
    }

    /// Takes a branch over a boundary: the stronger continuation, if any.
    #[inline(always)]
    fn branch<W: Winding, P: Policy, const LENGTHS: bool>(
        &self,
        branch: Branch<W>,
        fork: &Fork<W>,
        climb: &mut Climb<'_, W, P>,
        sum: &mut Sum,
    ) -> Option<Branch<W>> {
        let (optics, weight) = (climb.optics, branch.weight);
        let present = branch.present::<LENGTHS>();
        if fork.is_total() {
            // Nothing to choose, and a path that starts again needs its weight:
            // only what is too faint for any sum ends here.
            let next = branch.go_on(fork, Side::Reflected, weight, optics);
            return (weight * present >= f64::MIN_POSITIVE).then_some(next);
        }
        let reflectance = fork.bend.reflectance;
        let dropped = !fork.event.entering && !self.restriction.internal_reflection;
        let back = if dropped { 0.0 } else { reflectance };
        let choice = climb.policy.choose([weight * back, weight * (1.0 - reflectance)], present);
        sum.truncated += choice.lost;
        let back = (Side::Reflected, choice.reflected);
        let on = (Side::Transmitted, choice.transmitted);
        let [weak, strong] = if back.1 <= on.1 { [back, on] } else { [on, back] };
        if weak.1 > 0.0 {
            climb.waiting.push(branch.clone().go_on(fork, weak.0, weak.1, optics));
        }
        (strong.1 > 0.0).then(|| branch.go_on(fork, strong.0, strong.1, optics))
    }
}
