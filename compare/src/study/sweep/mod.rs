//! What a study varies, and the explicit list of what that comes to.
//!
//! Read this first: [`Axes`] are lists of values, [`Grid`] is their product. A
//! place is a scene with its numbers at a resolution; a variant is a method with
//! its parameters. Every variant at every place is a job with an id.

mod expand;
mod externals;
pub mod file;
mod job;
pub mod values;
mod variants;

pub use expand::{check, expand};
pub use job::{Job, Task};
pub(in crate::study) use variants::typed;

use crate::results::Scalar;
use std::collections::BTreeMap;
use std::path::PathBuf;

/// Lists of values of which all combinations are studied.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Axes {
    /// Image sizes; none: each scene's own.
    pub resolution_px: Vec<[u32; 2]>,
    /// k of the k x k positions per pixel that the timed frame draws; none: 1.
    pub supersampling: Vec<u32>,
    /// Numbers of the scene file, by their path.
    pub scene: BTreeMap<String, Vec<f64>>,
    /// Parameters of methods.
    pub param: Vec<Knob>,
}

/// A parameter that is varied.
#[derive(Clone, Debug, PartialEq)]
pub struct Knob {
    /// Method that it belongs to; `None`: the only one that has it.
    pub method: Option<String>,
    /// Name.
    pub name: String,
    /// Values.
    pub values: Vec<Scalar>,
}

/// Axes of some of the scenes and methods; what they do not name is as in the
/// whole study.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Sweep {
    /// Names of scenes; none: all.
    pub scenes: Vec<String>,
    /// Method; `None`: all.
    pub method: Option<String>,
    /// What varies.
    pub axes: Axes,
}

/// An image that somebody else made.
#[derive(Clone, Debug, PartialEq)]
pub struct External {
    /// Name in tables, where a method's would stand.
    pub name: String,
    /// Scene that it shows; `None`: the only one.
    pub scene: Option<String>,
    /// EXR or HDR (linear) or PNG (display-encoded).
    pub image: PathBuf,
    /// Time of a frame as its maker measured it.
    pub milliseconds: Option<f64>,
    /// On what; empty if not told.
    pub adapter: String,
}

/// A method with its parameters.
#[derive(Clone, Debug, PartialEq)]
pub struct Variant {
    /// Method id.
    pub method: String,
    /// Parameters that are set; the others have their defaults.
    pub set: BTreeMap<String, Scalar>,
    /// All parameters.
    pub param: BTreeMap<String, Scalar>,
    /// k of each k x k that is timed.
    pub supersampling: Vec<u32>,
}

/// A scene with its numbers at a resolution, and what is to be done there.
#[derive(Clone, Debug, PartialEq)]
pub struct Place {
    /// Index of the scene.
    pub scene: usize,
    /// Numbers that are set in it.
    pub set: BTreeMap<String, f64>,
    /// Width and height, pixels.
    pub resolution_px: [u32; 2],
    /// Name that no other place of the study has.
    pub label: String,
    /// Jobs, the exact images first.
    pub jobs: Vec<Job>,
}

/// Everything that a study comes to, in order.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Grid {
    /// Places, scene by scene.
    pub places: Vec<Place>,
}

impl Grid {
    /// All jobs in order.
    pub fn jobs(&self) -> impl Iterator<Item = &Job> {
        self.places.iter().flat_map(|place| &place.jobs)
    }
}
