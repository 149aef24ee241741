//! Arguments of the exact renderer: the same for rendering and for planning.

use crate::Error;
use clap::ValueEnum;
use reference::{
    EnvironmentLookup, Estimator, Fresnel, Level, Paths, Positions, Request, Restriction, Spectrum,
};
use scenes::View;

/// How light is followed.
#[derive(clap::Args, Debug)]
#[command(next_help_heading = "Light transport")]
pub(in crate::cli) struct ExactArgs {
    /// How much light transport counts
    #[arg(long, value_enum, default_value_t = LevelName::R1)]
    level: LevelName,
    /// How the sum over paths is formed
    #[arg(long, value_enum, default_value_t = EstimatorName::Tree)]
    estimator: EstimatorName,
    /// Tree: weight, of 1 per camera ray, below which a branch is cut [default: 1e-4]
    #[arg(long, value_name = "WEIGHT")]
    cut: Option<f64>,
    /// Paths: independent estimates, from which the layer `variance` is taken [default: 16]
    #[arg(long, value_name = "N")]
    batches: Option<u32>,
    /// Paths: how many per pixel and batch [default: 16], or with --positions per position
    /// [default: 1]
    #[arg(long, value_name = "N")]
    samples: Option<u32>,
    /// Paths: start at the points of one lattice, the same in every pixel, and not at random: less
    /// error for the time, least with 1, 2, 3, 5, 8, 13, 21, … paths in all
    #[arg(long)]
    lattice: bool,
    /// Paths: weight, of 1 per camera ray, above which paths branch and below which they go one
    /// way at random; 1: one way from the start [default: 1/32]
    #[arg(long, value_name = "WEIGHT")]
    split: Option<f64>,
    /// Paths: seed; the same seed gives the same image [default: 0]
    #[arg(long, value_name = "SEED")]
    seed: Option<u64>,
    /// Follow the polarisation of light through every event (tree only); the layer `stokes` shows it
    #[arg(long)]
    polarised: bool,
    /// Trace this many wavelengths across the visible spectrum, where media disperse light, and not
    /// one line each for red, green and blue
    #[arg(long, value_name = "N", value_parser = clap::value_parser!(u32).range(8..=1024))]
    wavelengths: Option<u32>,
    /// Look the environment up in its lat-long original, to agree with other renderers, and not in
    /// the cube that the GPU uses
    #[arg(long)]
    lat_long: bool,
    #[command(flatten)]
    restriction: RestrictionArgs,
}

/// Physics that is taken away on purpose, to see what an approximation lacks.
#[derive(clap::Args, Debug)]
#[command(next_help_heading = "Physics taken away")]
struct RestrictionArgs {
    /// After this many interfaces light comes straight from the environment [default: no limit]
    #[arg(long, value_name = "N")]
    max_interfaces: Option<u32>,
    /// Paths with more events are dropped; the layer `truncated` counts them [default: 20000]
    #[arg(long, value_name = "N")]
    max_events: Option<u32>,
    /// Drop reflections off the inside of a body that are not total
    #[arg(long)]
    no_internal_reflection: bool,
    /// How much an interface reflects
    #[arg(long, value_enum, default_value_t = FresnelName::Exact)]
    fresnel: FresnelName,
}

#[derive(Clone, Copy, Debug, ValueEnum)]
enum LevelName {
    /// One chain of refractions, reflected only when totally reflected, no Fresnel weights
    R0,
    /// The full tree of refractions and reflections
    R1,
    /// The full tree and opaque surroundings
    R2,
}

#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
enum EstimatorName {
    /// Both continuations of every event, at K x K positions in each pixel
    Tree,
    /// Random paths, with their variance: through random positions, and then unbiased, or through
    /// fixed ones (--lattice, --positions)
    Paths,
}

#[derive(Clone, Copy, Debug, ValueEnum)]
enum FresnelName {
    /// Fresnel's equations
    Exact,
    /// Schlick's polynomial
    Schlick,
    /// (1 - cos θ)³
    Cubic,
}

impl ExactArgs {
    /// The request for a view. `positions_given`: the user wrote how many
    /// positions a pixel has, which random paths need not.
    pub(in crate::cli) fn request(
        &self,
        view: View,
        positions_given: bool,
    ) -> Result<Request, Error> {
        let level = match self.level {
            LevelName::R0 => Level::R0,
            LevelName::R1 => Level::R1,
            LevelName::R2 => Level::R2,
        };
        let environment_lookup =
            if self.lat_long { EnvironmentLookup::LatLong } else { EnvironmentLookup::Cube };
        Ok(Request {
            estimator: self.estimator(positions_given)?,
            environment_lookup,
            restriction: self.restriction.restriction(),
            polarised: self.polarised,
            spectrum: self.wavelengths.map_or(Spectrum::Channels, Spectrum::Wavelengths),
            ..Request::new(view, level)
        })
    }

    fn estimator(&self, positions_given: bool) -> Result<Estimator, Error> {
        let paths = self.estimator == EstimatorName::Paths;
        let of_the_other = [
            ("--cut", self.cut.is_some(), paths),
            ("--batches", self.batches.is_some(), !paths),
            ("--samples", self.samples.is_some(), !paths),
            ("--lattice", self.lattice, !paths),
            ("--split", self.split.is_some(), !paths),
            ("--seed", self.seed.is_some(), !paths),
        ];
        if let Some((flag, ..)) = of_the_other.iter().find(|(_, given, other)| *given && *other) {
            let (this, that) = if paths { ("paths", "tree") } else { ("tree", "paths") };
            return Err(Error::Usage(format!(
                "{flag} means nothing to --estimator {this}\nleave it out, or write --estimator {that}"
            )));
        }
        if !paths {
            return Ok(Estimator::Tree { cut: self.cut.unwrap_or(1e-4) });
        }
        let all = Paths::default();
        let (positions, samples) = match (self.lattice, positions_given) {
            (true, true) => {
                return Err(Error::Usage(
                    "--lattice and --positions are two sets of fixed positions
write one of them"
                        .to_owned(),
                ));
            }
            (true, false) => (Positions::Lattice, all.samples),
            (false, true) => (Positions::Cells, 1),
            (false, false) => (Positions::Random, all.samples),
        };
        Ok(Estimator::Paths(Paths {
            batches: self.batches.unwrap_or(all.batches),
            samples: self.samples.unwrap_or(samples),
            positions,
            split: self.split.unwrap_or(all.split),
            seed: self.seed.unwrap_or(all.seed),
        }))
    }
}

impl RestrictionArgs {
    fn restriction(&self) -> Restriction {
        let all = Restriction::default();
        Restriction {
            max_interfaces: self.max_interfaces,
            max_events: self.max_events.unwrap_or(all.max_events),
            internal_reflection: !self.no_internal_reflection,
            fresnel: match self.fresnel {
                FresnelName::Exact => Fresnel::Exact,
                FresnelName::Schlick => Fresnel::Schlick,
                FresnelName::Cubic => Fresnel::Cubic,
            },
        }
    }
}
