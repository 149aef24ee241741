//! The measured speed of the exact renderer, alone and beside other programs.
//! Read [`measure`] first.

mod embree;
mod error;
mod footprint;
mod input;
mod mitsuba;
mod speed;

pub use embree::{Program, Robust, compiler};
pub use error::BenchError;
pub use footprint::{Footprint, footprint};
pub use input::{BEYOND, ETA, IMAGE_PX, Input, inputs};
pub use mitsuba::{
    BesideMitsuba, MITSUBA_PX, MITSUBA_REPETITIONS, ToError, beside_mitsuba, python,
};
pub use speed::Speed;

use crate::support::clock::Taken;
use crate::support::statistics::{Interval, median_interval, ratio_interval};
use serde::Serialize;
use speed::{Bench, interleaved};
use std::cell::RefCell;

/// The speed on one input.
#[derive(Clone, Debug, Serialize)]
pub struct Measured {
    /// Name of the mesh.
    pub input: &'static str,
    /// How many.
    pub triangles: usize,
    /// How many.
    pub rays: usize,
    /// Ours, the oldest instructions first.
    pub speeds: Vec<Speed>,
    /// Embree's, if it was asked for.
    pub embree: Vec<Beside>,
}

/// The same rays traced by Embree on one thread.
#[derive(Clone, Debug, Serialize)]
pub struct Beside {
    /// Name and version.
    pub program: String,
    /// Its flag for careful intersection.
    pub robust: bool,
    /// Million rays per second of processor time.
    pub mrays_per_cpu_s: Interval,
    /// Our speed with the instructions that renderings use on one thread, of its: above 1 we
    /// are faster.
    pub ratio: Interval,
    /// Share of the rays for which both name the same triangle, or none.
    pub same_triangle: f64,
}

/// Traces all rays of an input in every way, in turns with Embree where its
/// program is given.
///
/// # Errors
/// Threads cannot be started, or the other program breaks off.
pub fn measure(
    input: &Input,
    threads: &[usize],
    repetitions: usize,
    embree: Option<&Program>,
    progress: impl Fn(f64),
) -> Result<Measured, BenchError> {
    let bench = Bench::new(input, threads)?;
    let running = embree.map(|program| program.start(input).map(RefCell::new)).transpose()?;
    let mut runs = bench.runs();
    let ours = runs.len();
    if let Some(running) = &running {
        for robust in Robust::BOTH {
            runs.push(Box::new(move || running.borrow_mut().trace(robust)));
        }
    }
    let taken = interleaved(&mut runs, repetitions, progress)?;
    let mut beside = Vec::new();
    if let (Some(program), Some(running)) = (embree, &running) {
        let hits = bench.hits();
        for (robust, theirs) in Robust::BOTH.into_iter().zip(&taken[ours..]) {
            let cpu = |taken: &[Taken]| taken.iter().map(|t| t.cpu_s).collect::<Vec<_>>();
            let mrays = |seconds: f64| input.rays.len() as f64 * 1e-6 / seconds;
            let rates: Vec<f64> = theirs.iter().map(|taken| mrays(taken.cpu_s)).collect();
            beside.push(Beside {
                program: running.borrow().version.clone(),
                robust: robust == Robust::On,
                mrays_per_cpu_s: median_interval(&rates),
                ratio: ratio_interval(&cpu(theirs), &cpu(&taken[bench.best()])),
                same_triangle: same(&hits, &program.hits(robust)?),
            });
        }
    }
    Ok(Measured {
        input: input.name,
        triangles: input.corners.len(),
        rays: input.rays.len(),
        speeds: bench.speeds(&taken),
        embree: beside,
    })
}

/// Share of equal entries.
fn same(ours: &[u32], theirs: &[u32]) -> f64 {
    let equal = ours.iter().zip(theirs).filter(|(a, b)| a == b).count();
    equal as f64 / ours.len().max(theirs.len()).max(1) as f64
}

/// The processor's name, where the system tells.
#[must_use]
pub fn processor() -> String {
    let text = std::fs::read_to_string("/proc/cpuinfo").unwrap_or_default();
    let line = text.lines().find(|line| line.starts_with("model name"));
    let name = line.and_then(|line| line.split_once(':')).map(|(_, name)| name.trim().to_owned());
    name.unwrap_or_else(|| std::env::consts::ARCH.to_owned())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_missing_answer_is_not_the_same() {
        assert_eq!(same(&[1, 2, 3, 4], &[1, 2, 3]), 0.75);
        assert_eq!(same(&[u32::MAX; 3], &[u32::MAX; 3]), 1.0);
    }
}
