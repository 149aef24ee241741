//! The full tree of refractions and reflections below a camera ray.
//!
//! At every event the stronger continuation goes on and the weaker one waits on
//! a stack, or is dropped if its weight is below the cut. So a branch normally
//! ends in the environment, and what is lost is a small share of what was
//! followed.

use crate::flight::{End, Flight, Scratch};
use crate::media::Media;
use crate::optics::{Optics, reflected, transmitted};
use crate::tracer::Tracer;
use crate::trapped::Memory;
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

/// The stronger continuation may fall this far below the cut before it is
/// dropped too.
const FLOOR: f64 = 1.0 / 1024.0;

impl Tracer<'_> {
    /// Sums the tree below a camera ray.
    pub(crate) fn tree<M: Media, const UNIFORM: bool, const LENGTHS: bool>(
        &self,
        flight: Flight<M>,
        optics: &Optics,
        cut: f64,
        waiting: &mut Vec<Branch<M>>,
        scratch: &mut Scratch,
    ) -> Sum {
        let mut sum = Sum::default();
        waiting.clear();
        waiting.push(Branch {
            flight,
            weight: 1.0,
            tint: DVec3::ONE,
            events: 0,
            memory: Memory::new(),
        });
        let interfaces = self.restriction.max_interfaces.unwrap_or(u32::MAX);
        while let Some(mut branch) = waiting.pop() {
            loop {
                let end = if branch.events >= interfaces {
                    End::Environment
                } else {
                    self.world.follow::<M, LENGTHS>(&branch.flight, &optics.indices, scratch)
                };
                if LENGTHS {
                    branch.tint *= optics.transmittance(&scratch.pieces);
                }
                let light = match &end {
                    End::Event(_) => None,
                    End::Environment => Some(self.environment::<UNIFORM>(branch.flight.direction)),
                    End::Opaque(crossing) => Some(self.shade(&branch.flight, crossing)),
                };
                sum.met |= !matches!(end, End::Environment) && branch.events == 0;
                if let Some(light) = light {
                    sum.radiance += light * branch.tint * branch.weight;
                    break;
                }
                let End::Event(mut event) = end else { break };
                branch.memory.prepare(&mut event);
                let bend = optics.bend(branch.flight.direction, &event);
                branch.events += 1;
                scratch.counters.events += 1;
                let present = if LENGTHS { branch.tint.max_element() } else { 1.0 };
                if branch.events > self.restriction.max_events {
                    sum.truncated += branch.weight * present;
                    scratch.counters.capped += 1;
                    break;
                }
                let Some(direction) = bend.transmitted else {
                    branch.flight = reflected(&event, &bend);
                    if let Some((flight, tint)) = branch.memory.total_reflection(optics) {
                        (branch.flight, branch.tint) = (flight, tint);
                    }
                    continue;
                };
                let on = [
                    (true, branch.weight * bend.reflectance),
                    (false, branch.weight * (1.0 - bend.reflectance)),
                ];
                let [weak, strong] = if on[0].1 <= on[1].1 { on } else { [on[1], on[0]] };
                let incoming = branch.flight.direction;
                let continued = |(back, weight): (bool, f64), mut memory: Memory<M>| {
                    memory.turn(&event, incoming, back, branch.tint, optics);
                    let flight = if back {
                        reflected(&event, &bend)
                    } else {
                        transmitted(&event, direction)
                    };
                    Branch { flight, weight, tint: branch.tint, events: branch.events, memory }
                };
                if weak.1 * present >= cut {
                    waiting.push(continued(weak, branch.memory.clone()));
                } else {
                    sum.truncated += weak.1 * present;
                }
                if strong.1 * present < cut * FLOOR {
                    sum.truncated += strong.1 * present;
                    break;
                }
                branch = continued(strong, branch.memory.clone());
            }
        }
        sum
    }
}
