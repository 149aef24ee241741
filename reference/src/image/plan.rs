//! What a run does, and what it leaves out and why.

use super::layers::RequestedLayers;
use crate::error::Error;
use crate::request::{
    EnvironmentLookup, Estimator, Fresnel, Level, Request, Restriction, Spectrum,
};
use crate::transport::spectrum;
use crate::transport::variant::Variant;
use crate::world::World;
use crate::world::scratch::Counters;
use scenes::plan::{Buffer, Kind};
use scenes::{Plan, Scene};
use std::collections::BTreeMap;

impl Variant {
    /// What is run for a request, and what is left out.
    pub(crate) fn plan(
        self,
        scene: &Scene,
        world: &World,
        request: &Request,
        layers: &RequestedLayers,
    ) -> Plan {
        let passes = vec!["build".to_owned(), "trace".to_owned()];
        let mut plan = Plan { passes, ..Plan::default() };
        let [width, height] = request.view.resolution_px.map(u64::from);
        let buffer = |name: String, bytes: u64| Buffer { name, bytes };
        plan.buffers = vec![buffer("geometry".to_owned(), world.bytes())];
        plan.buffers.extend(layers.names().map(|(name, channels)| {
            buffer(name.to_string(), width * height * channels as u64 * 8)
        }));
        plan.features = vec![format!("{:?}", request.level), format!("{:?}", request.estimator)];
        self.windings(&mut plan);
        self.lookups(&mut plan, request);
        light(&mut plan, scene, request);
        unasked(&mut plan, world, request, layers);
        restricted(&mut plan, request);
        plan
    }

    fn windings(self, plan: &mut Plan) {
        match self.classes {
            0 => {
                plan.features.push("one convex body".to_owned());
                let convex = "there is one body and it is convex";
                plan.leave_out(Kind::State, "winding counts", convex, 0);
                plan.leave_out(Kind::Code, "rays that leave the body", convex, 0);
            }
            1 => {
                plan.features.push("one winding count".to_owned());
                let one = "all bodies are of one medium and priority";
                plan.leave_out(Kind::State, "a winding count per medium", one, 0);
            }
            n => plan.features.push(format!("{n} winding counts")),
        }
    }

    fn lookups(self, plan: &mut Plan, request: &Request) {
        if self.uniform {
            let reason = "the environment is the same in every direction";
            plan.leave_out(Kind::Code, "environment lookup", reason, 0);
        } else {
            let lookup = match request.environment_lookup {
                EnvironmentLookup::Cube => "environment from the cube",
                EnvironmentLookup::LatLong => "environment from the lat-long original",
            };
            plan.features.push(lookup.to_owned());
        }
        if self.lengths {
            plan.features.push("lengths per medium".to_owned());
        } else {
            let reason = "no medium absorbs and no layer shows lengths";
            plan.leave_out(Kind::State, "lengths per medium", reason, 0);
        }
    }
}

/// What light is made of.
fn light(plan: &mut Plan, scene: &Scene, request: &Request) {
    if scene.media.iter().any(scenes::Medium::is_dispersive) && request.level != Level::R0 {
        plan.features.push(match request.spectrum {
            Spectrum::Channels => "three traces, one per channel".to_owned(),
            Spectrum::Wavelengths(count) => format!("{count} traces, one per wavelength"),
        });
    } else {
        let reason = "no medium is dispersive, or the chain follows the d line alone";
        plan.leave_out(Kind::Pass, "traces for other wavelengths", reason, 0);
    }
    if request.polarised {
        plan.features.push("polarisation".to_owned());
    } else {
        plan.leave_out(Kind::State, "polarisation", "it was not asked for", 0);
    }
}

/// What no layer or no body asks for.
fn unasked(plan: &mut Plan, world: &World, request: &Request, layers: &RequestedLayers) {
    if world.tree.len() == 0 {
        plan.leave_out(Kind::Buffer, "tree", "no body is a mesh", 0);
    }
    if !layers.needs_chain() {
        let reason = "no layer shows the chain through the pixel's centre";
        plan.leave_out(Kind::Pass, "centre chain", reason, 0);
    }
    if !layers.needs_mean() {
        let reason = "no layer shows a mean over the pixel";
        plan.leave_out(Kind::Pass, "positions per pixel", reason, 0);
    }
    if matches!(request.estimator, Estimator::Tree { .. }) {
        plan.leave_out(Kind::State, "random numbers", "the tree of paths is followed whole", 0);
    }
}

/// Physics that the request takes away.
fn restricted(plan: &mut Plan, request: &Request) {
    let Restriction { max_interfaces, max_events, internal_reflection, fresnel } =
        request.restriction;
    let asked = "the request takes it away";
    if let Some(most) = max_interfaces {
        plan.features.push(format!("environment after {most} interfaces"));
        plan.leave_out(Kind::Code, &format!("interfaces after the first {most}"), asked, 0);
    }
    if max_events != Restriction::default().max_events {
        plan.features.push(format!("paths of at most {max_events} events"));
    }
    if !internal_reflection {
        plan.leave_out(Kind::Code, "reflections inside a body that are not total", asked, 0);
    }
    match fresnel {
        Fresnel::Exact => {}
        Fresnel::Schlick => plan.features.push("Schlick's reflectance".to_owned()),
        Fresnel::Cubic => plan.features.push("cubic reflectance".to_owned()),
    }
    if request.level == Level::R0 {
        let chain = "one chain per position has no weights";
        plan.leave_out(Kind::Code, "reflectances", chain, 0);
    }
    if request.level != Level::R2 {
        let surroundings = "opaque surroundings count from level R2 on";
        plan.leave_out(Kind::Code, "shading of opaque surfaces", surroundings, 0);
    }
}

/// What [`crate::render`] would do, without doing it (the geometry is baked, to
/// know its size).
///
/// # Errors
/// As [`crate::render`].
pub fn plan(scene: &Scene, request: &Request) -> Result<Plan, Error> {
    request.check()?;
    spectrum::check(scene, request.spectrum)?;
    let layers = RequestedLayers::new(scene, request)?;
    let world = World::new(scene, request.view.frame, request.level)?;
    let variant = Variant::new(scene, &world, request.keep, layers.needs_lengths());
    Ok(variant.plan(scene, &world, request, &layers))
}

impl Counters {
    /// Counts by name.
    pub(crate) fn named(&self, world: &World) -> BTreeMap<String, u64> {
        let list = [
            ("rays", self.rays),
            ("events", self.events),
            ("settled", self.settled),
            ("reconciled", self.reconciled),
            ("left_inside", self.left_inside),
            ("capped", self.capped),
            ("triangles", world.tree.len() as u64),
            ("geometry_bytes", world.bytes()),
        ];
        list.into_iter().map(|(name, count)| (name.to_owned(), count)).collect()
    }
}
