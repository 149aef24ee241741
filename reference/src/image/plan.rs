//! Which variant of the tracer a scene needs, and what it leaves out and why.

use crate::error::Error;
use crate::image::layers::Columns;
use crate::request::{
    EnvironmentLookup, Estimator, Fresnel, Level, Request, Restriction, Spectrum,
};
use crate::world::World;
use crate::world::short_way::Counters;
use scenes::plan::{Buffer, Kind};
use scenes::{Environment, Plan, Scene};
use std::collections::BTreeMap;

/// Compile-time features of a run.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) struct Variant {
    /// Winding counts to carry; 0 for a single convex body.
    pub(crate) classes: usize,
    /// The environment is the same everywhere.
    pub(crate) uniform: bool,
    /// Lengths per medium are needed.
    pub(crate) lengths: bool,
}

impl Variant {
    pub(crate) fn new(scene: &Scene, world: &World, request: &Request, columns: &Columns) -> Self {
        if request.general {
            return Self { classes: 256, uniform: false, lengths: true };
        }
        let absorbs = scene.media.iter().any(scenes::Medium::absorbs);
        Self {
            classes: if world.is_one_convex_body() { 0 } else { world.classes.len().max(1) },
            uniform: matches!(scene.environment, Environment::Uniform(_)),
            lengths: absorbs || columns.needs_lengths(),
        }
    }

    pub(crate) fn plan(
        self,
        scene: &Scene,
        world: &World,
        request: &Request,
        columns: &Columns,
    ) -> Plan {
        let passes = vec!["build".to_owned(), "trace".to_owned()];
        let mut plan = Plan { passes, ..Plan::default() };
        let [width, height] = request.view.resolution_px.map(u64::from);
        let buffer = |name: String, bytes: u64| Buffer { name, bytes };
        plan.buffers = vec![buffer("geometry".to_owned(), world.bytes())];
        plan.buffers.extend(columns.names().iter().map(|(name, channels)| {
            buffer(name.to_string(), width * height * *channels as u64 * 8)
        }));
        plan.features = vec![format!("{:?}", request.level), format!("{:?}", request.estimator)];
        self.media(&mut plan);
        self.rest(&mut plan, scene, world, request, columns);
        restricted(&mut plan, request);
        plan
    }

    fn media(self, plan: &mut Plan) {
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

    fn rest(
        self,
        plan: &mut Plan,
        scene: &Scene,
        world: &World,
        request: &Request,
        columns: &Columns,
    ) {
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
        if world.tree.len() == 0 {
            plan.leave_out(Kind::Buffer, "tree", "no body is a mesh", 0);
        }
        if !columns.needs_chain {
            let reason = "no layer shows the chain through the pixel's centre";
            plan.leave_out(Kind::Pass, "centre chain", reason, 0);
        }
        if !columns.needs_mean {
            let reason = "no layer shows a mean over the pixel";
            plan.leave_out(Kind::Pass, "positions per pixel", reason, 0);
        }
        if matches!(request.estimator, Estimator::Tree { .. }) {
            plan.leave_out(Kind::State, "random numbers", "the tree of paths is followed whole", 0);
        }
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
    let columns = Columns::new(scene, request)?;
    let world = World::new(scene, request.view.frame, request.level)?;
    let variant = Variant::new(scene, &world, request, &columns);
    Ok(variant.plan(scene, &world, request, &columns))
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
