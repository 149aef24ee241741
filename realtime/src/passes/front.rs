//! The surface that a pixel sees first: its normal, its depth, and what else a
//! method reads of it.

use super::raster_pass::{Files, RasterPass, Sides, Target};
use super::{Composed, Listed, Making, Pass, Ready, Wanted};
use crate::composition::inputs::Inputs;
use crate::error::Error;
use crate::plan::entries::Entries;
use scenes::plan::Kind;

pub(crate) const LISTED: Listed = Listed { compose, absent };

/// Everything it can write, as in front_targets.wgsl.
const TARGETS: [Target; 5] = [
    Target::rgba("front_normal", 0),
    Target::r("front_depth", 1),
    Target::rgba("front_geometric", 2),
    Target::rgba("front_vector", 3),
    Target::r(THICKNESS, 4),
];

/// Distance through the body along the inward normal, known at vertices.
pub(crate) const THICKNESS: &str = "front_thickness";
const FILES: Files = Files { targets: "front_targets", analytic: Some("front_analytic") };

struct Front(RasterPass);

fn compose(inputs: &Inputs<'_>, wanted: &Wanted<'_>) -> Composed {
    let targets: Vec<_> = TARGETS.into_iter().filter(|t| wanted.image(t.name)).collect();
    if targets.is_empty() {
        return Ok(None);
    }
    let (choices, bodies) = (&inputs.choices, &inputs.geometry.bodies);
    let pass = RasterPass::new("front", targets, Sides::Front, &FILES, choices, bodies)?;
    Ok(Some(Box::new(Front(pass))))
}

fn absent(entries: &mut Entries<'_>) {
    let rays = entries.inputs.follows_rays();
    let reason =
        if rays { "rays meet the bodies by themselves" } else { "no body is in the image" };
    let bytes = entries.pixels * (16 + 4 + 4);
    entries.plan.leave_out(Kind::Pass, "front", reason, bytes);
    entries.thickness(false);
}

impl Pass for Front {
    fn reads(&self, global: &str) -> bool {
        self.0.reads(global)
    }

    fn plan(&self, entries: &mut Entries<'_>) {
        entries.thickness(self.0.targets.iter().any(|target| target.name == THICKNESS));
        entries.pass(self.0.name);
        self.0.plan(entries, entries.pixels);
        entries.analytic_bodies(1);
    }

    fn ready(&self, making: &Making<'_>) -> Result<Ready, Error> {
        let (pass, outputs) = making.bodies.raster(&self.0, making.before)?;
        Ok(Ready::new(pass, outputs))
    }
}
