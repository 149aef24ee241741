//! What the scene is made of, for one wavelength, and how a ray goes on
//! after an event.

use crate::optics::bend::{Bend, bend, through_gap};
use crate::request::Fresnel;
use crate::world::World;
use crate::world::crossing::Departed;
use crate::world::flight::{Event, Flight, Start};
use crate::world::winding::{Indices, Winding};
use glam::DVec3;
use scenes::{MediumId, Scene};

/// Indices for one wavelength, and absorption.
#[derive(Clone, Debug)]
pub(crate) struct MediaOptics {
    pub(crate) indices: Indices,
    /// By medium.
    pub(crate) absorption_per_m: Vec<DVec3>,
    pub(crate) fresnel: Fresnel,
}

impl MediaOptics {
    pub(crate) fn new(scene: &Scene, world: &World, wavelength_um: f64, fresnel: Fresnel) -> Self {
        let classes = world.classes.iter().map(|class| class.medium);
        let medium: Vec<MediumId> = classes.chain([MediumId::SURROUNDINGS]).collect();
        let eta_of = |id: &MediumId| {
            scene.media.get(usize::from(id.0)).map_or(1.0, |medium| {
                if medium.is_dispersive() { medium.eta_at(wavelength_um) } else { medium.eta.get() }
            })
        };
        Self {
            indices: Indices { eta: medium.iter().map(eta_of).collect(), medium },
            absorption_per_m: scene.media.iter().map(|medium| medium.absorption_per_m).collect(),
            fresnel,
        }
    }

    /// What an event does to a ray of this direction.
    pub(crate) fn bend<W: Winding>(&self, direction: DVec3, event: &Event<W>) -> Bend {
        let sides = [self.indices.eta(&event.before), self.indices.eta(&event.after)];
        if event.gap {
            return through_gap(direction, event.spot.normals, event.entering, sides[0]);
        }
        bend(direction, event.spot.normals, event.entering, sides, self.fresnel)
    }

    /// Transmittance of the stretches of a path, per channel.
    pub(crate) fn transmittance(&self, stretches: &[(MediumId, f64)]) -> DVec3 {
        let depth = stretches.iter().fold(DVec3::ZERO, |sum, (medium, length_m)| {
            let per_m =
                self.absorption_per_m.get(usize::from(medium.0)).copied().unwrap_or_default();
            // Zero times an infinite length is nothing absorbed.
            sum + DVec3::select(per_m.cmpeq(DVec3::ZERO), DVec3::ZERO, per_m * *length_m)
        });
        DVec3::from_array((-depth).to_array().map(f64::exp))
    }
}

/// Sides of a boundary to go on at.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Side {
    Reflected,
    /// There is none under total reflection.
    Transmitted,
}

/// How a ray goes on at one side of a boundary; under total reflection it is
/// reflected whatever the side.
pub(crate) fn continuation<W: Winding>(event: &Event<W>, bend: &Bend, side: Side) -> Flight<W> {
    match bend.transmitted {
        Some(direction) if side == Side::Transmitted => {
            go_on(event, direction, event.after.clone(), event.entering)
        }
        _ => go_on(event, bend.reflected, event.before.clone(), !event.entering),
    }
}

fn go_on<W: Winding>(event: &Event<W>, direction: DVec3, winding: W, inside: bool) -> Flight<W> {
    let clear = event.single && event.spot.is_clear(direction);
    let departed = Departed { id: event.id, inside };
    let start = if clear { Start::Surface(departed) } else { Start::Unclear };
    Flight { origin: event.spot.position, direction, start, winding }
}
