//! The surface behind: the farthest of those that face away, or the nearest.

use super::raster_pass::{Files, RasterPass, Sides, Target};
use super::{Composed, Listed, Making, Pass, Ready, Wanted};
use crate::composition::inputs::Inputs;
use crate::error::Error;
use crate::plan::entries::Entries;
use scenes::plan::Kind;

pub(crate) const LISTED: Listed = Listed { compose, absent };

/// Everything it can write, as in back_targets.wgsl.
const TARGETS: [Target; 2] = [Target::rgba("back_normal", 0), Target::r("back_depth", 1)];
const FILES: Files = Files { targets: "back_targets", analytic: Some("back_analytic") };

struct Back(RasterPass);

fn compose(inputs: &Inputs<'_>, wanted: &Wanted<'_>) -> Composed {
    let targets: Vec<_> = TARGETS.into_iter().filter(|t| wanted.image(t.name)).collect();
    if targets.is_empty() {
        return Ok(None);
    }
    let farthest = inputs.settings.word_if_any("back_select") != Some("nearest");
    let (choices, bodies) = (&inputs.choices, &inputs.geometry.bodies);
    let sides = Sides::Back { farthest };
    Ok(Some(Box::new(Back(RasterPass::new("back", targets, sides, &FILES, choices, bodies)?))))
}

fn absent(entries: &mut Entries<'_>) {
    let reason = "the method does not read the surface behind";
    let bytes = entries.pixels * (16 + 4);
    entries.plan.leave_out(Kind::Pass, "back", reason, bytes);
}

impl Pass for Back {
    fn reads(&self, global: &str) -> bool {
        self.0.reads(global)
    }

    fn plan(&self, entries: &mut Entries<'_>) {
        entries.pass(self.0.name);
        self.0.plan(entries, entries.pixels);
        entries.analytic_bodies(1);
    }

    fn ready(&self, making: &Making<'_>) -> Result<Ready, Error> {
        let (pass, outputs) = making.bodies.raster(&self.0, making.before)?;
        Ok(Ready::new(pass, outputs))
    }
}
