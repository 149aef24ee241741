//! Every layer, once: its name, what it shows, its channels, where it comes from,
//! what it needs.

use crate::request::{Estimator, Level, Paths, Request};
use crate::transport::chain::Chain;
use glam::DVec3;
use scenes::LayerName;

/// Everything that can be known about a pixel.
#[derive(Clone, Debug, Default)]
pub(crate) struct Pixel {
    pub(crate) chain: Chain,
    pub(crate) radiance: DVec3,
    pub(crate) truncated: f64,
    pub(crate) coverage: f64,
    pub(crate) samples: f64,
    /// Of the mean over batches.
    pub(crate) variance: DVec3,
    /// Radiance by number of interfaces, as far as asked for.
    pub(crate) bounces: Vec<DVec3>,
    /// Q, U, V of the d line, for the image's horizontal axis.
    pub(crate) polarisation: DVec3,
    /// The straight ray through the centre meets a crack inside a solid.
    pub(crate) crack: bool,
}

/// A layer that can be asked for.
pub(crate) struct LayerRow {
    /// With a word in place of what is chosen: `path.<MEDIUM>`, `bounce<N>`.
    pub(super) name: &'static str,
    pub(super) shows: &'static str,
    pub(super) values: Values,
    pub(super) source: Source,
    pub(super) needs: Needs,
}

/// What a layer holds of a pixel. The number is that of the medium or of the
/// bounce, and 0 where nothing is chosen.
#[derive(Clone, Copy)]
pub(super) enum Values {
    One(fn(&Pixel, usize) -> f64),
    Three(fn(&Pixel, usize) -> DVec3),
}

/// What is traced for a layer.
#[derive(Clone, Copy, PartialEq, Eq)]
pub(super) enum Source {
    /// The mean over the pixel's positions.
    Mean,
    /// The chain through its centre.
    Chain,
    /// The straight line through its centre.
    StraightLine,
}

/// What must be asked for with a layer.
#[derive(Clone, Copy, PartialEq, Eq)]
pub(super) enum Needs {
    Nothing,
    /// Random paths in two batches or more.
    Batches,
    /// The tree or paths, without polarisation.
    Unpolarised,
    /// The polarised tree.
    Polarised,
}

impl Needs {
    pub(super) fn are_met(self, request: &Request) -> bool {
        let weighted = request.level != Level::R0;
        match self {
            Self::Nothing => true,
            Self::Batches => {
                let batches =
                    matches!(request.estimator, Estimator::Paths(Paths { batches: 2.., .. }));
                weighted && batches
            }
            Self::Unpolarised => weighted && !request.polarised,
            Self::Polarised => weighted && request.polarised,
        }
    }
}

impl Values {
    pub(super) fn channels(self) -> usize {
        match self {
            Self::One(_) => 1,
            Self::Three(_) => 3,
        }
    }
}

const fn row(
    name: &'static str,
    shows: &'static str,
    values: Values,
    source: Source,
    needs: Needs,
) -> LayerRow {
    LayerRow { name, shows, values, source, needs }
}

use Source::{Chain as Centre, Mean, StraightLine};
use Values::{One, Three};

/// Every layer that can be asked for.
pub(super) const TABLE: [LayerRow; 16] = [
    row(
        "radiance",
        "linear radiance, mean over the pixel",
        Three(|p, _| p.radiance),
        Mean,
        Needs::Nothing,
    ),
    row(
        "variance",
        "variance of that mean; random paths in 2 batches or more",
        Three(|p, _| p.variance),
        Mean,
        Needs::Batches,
    ),
    row("samples", "camera rays per pixel", One(|p, _| p.samples), Mean, Needs::Nothing),
    row(
        "truncated",
        "weight of the paths that were cut off, mean over the pixel",
        One(|p, _| p.truncated),
        Mean,
        Needs::Nothing,
    ),
    row(
        "coverage",
        "share of the pixel's positions whose ray meets an object",
        One(|p, _| p.coverage),
        Mean,
        Needs::Nothing,
    ),
    row(
        "bounce<N>",
        "radiance that arrives after exactly N interfaces, such as bounce2; not with R0",
        Three(|p, order| p.bounces.get(order).copied().unwrap_or_default()),
        Mean,
        Needs::Unpolarised,
    ),
    row(
        "stokes",
        "Stokes parameters Q, U, V of the d line; polarised, not with R0",
        Three(|p, _| p.polarisation),
        Mean,
        Needs::Polarised,
    ),
    row(
        "exit",
        "unit direction in which the chain through the pixel's centre leaves",
        Three(|p, _| p.chain.exit),
        Centre,
        Needs::Nothing,
    ),
    row(
        "exit_position",
        "where the chain leaves, metres",
        Three(|p, _| p.chain.exit_position),
        Centre,
        Needs::Nothing,
    ),
    row(
        "first",
        "unit direction after the chain's first event",
        Three(|p, _| p.chain.first),
        Centre,
        Needs::Nothing,
    ),
    row(
        "hit2",
        "where the chain meets its second interface, metres",
        Three(|p, _| p.chain.hit2),
        Centre,
        Needs::Nothing,
    ),
    row(
        "events",
        "interfaces that the chain meets",
        One(|p, _| p.chain.events.into()),
        Centre,
        Needs::Nothing,
    ),
    row(
        "total_reflections",
        "how many of them reflect it totally",
        One(|p, _| p.chain.total_reflections.into()),
        Centre,
        Needs::Nothing,
    ),
    row(
        "flags",
        "bits, told by `snell methods`",
        One(|p, _| p.chain.flags.into()),
        Centre,
        Needs::Nothing,
    ),
    row(
        "path.<MEDIUM>",
        "metres that the chain travels in a medium, by its name in the scene",
        One(|p, medium| p.chain.lengths.get(medium).copied().unwrap_or(0.0)),
        Centre,
        Needs::Nothing,
    ),
    row(
        "crack_mask",
        "1 where the straight ray through the centre meets a crack in a solid",
        One(|p, _| u8::from(p.crack).into()),
        StraightLine,
        Needs::Nothing,
    ),
];

/// The row of a layer, if there is one.
pub(super) fn row_of(name: &LayerName) -> Option<&'static LayerRow> {
    static ROWS: [LayerRow; 16] = TABLE;
    let written = name.to_string();
    let listed = match name {
        LayerName::Path(_) => "path.<MEDIUM>",
        LayerName::Bounce(_) => "bounce<N>",
        _ => written.as_str(),
    };
    ROWS.iter().find(|row| row.name == listed)
}
