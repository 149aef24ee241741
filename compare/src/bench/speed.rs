//! How many rays a second each set of instructions traces.

use super::{BenchError, Input};
use crate::support::clock::{Taken, timed};
use crate::support::statistics::{Interval, median_interval, ratio_interval};
use rayon::prelude::*;
use rayon::{ThreadPool, ThreadPoolBuilder};
use reference::{Instructions, Triangles};
use serde::Serialize;

/// Rays that a thread takes at a time.
const CHUNK: usize = 4096;

/// One way to trace all rays of an input once, when it is its turn.
pub(super) type Turn<'a> = Box<dyn FnMut() -> Result<Taken, BenchError> + 'a>;

/// The speed of one set of instructions on some threads.
#[derive(Clone, Debug, Serialize)]
pub struct Speed {
    /// Which instructions.
    pub instructions: String,
    /// Threads of the pool.
    pub threads: usize,
    /// Million rays per second of processor time, all threads together.
    pub mrays_per_cpu_s: Interval,
    /// Million rays per second on the wall.
    pub mrays_per_wall_s: Interval,
    /// How many times as fast as one thread, on the wall. Says little while
    /// other programs run.
    pub scaling_wall: Interval,
    /// The same, had the threads had processors for themselves: from processor
    /// time.
    pub scaling_cpu: Interval,
}

/// Something to measure: instructions and threads.
struct Way {
    instructions: Instructions,
    threads: usize,
    pool: ThreadPool,
    triangles: Triangles,
}

/// A tree over an input, and all the ways to trace its rays.
pub(super) struct Bench<'a> {
    input: &'a Input,
    ways: Vec<Way>,
    /// Of the answers of the first way; all others must have the same.
    answer: u64,
}

impl<'a> Bench<'a> {
    /// Builds the tree, and checks that all ways answer alike.
    pub(super) fn new(input: &'a Input, threads: &[usize]) -> Result<Self, BenchError> {
        let triangles = Triangles::build(&input.corners);
        let mut ways = Vec::new();
        for instructions in Instructions::available() {
            for threads in threads {
                let mut triangles = triangles.clone();
                triangles.use_instructions(instructions);
                let pool = ThreadPoolBuilder::new().num_threads(*threads).build()?;
                ways.push(Way { instructions, threads: *threads, pool, triangles });
            }
        }
        let answer = ways.first().map_or(0, |way| way.trace(input));
        let this = Self { input, ways, answer };
        this.ways.iter().try_for_each(|way| this.check(way, way.trace(input)))?;
        Ok(this)
    }

    fn check(&self, way: &Way, answer: u64) -> Result<(), BenchError> {
        if answer == self.answer {
            return Ok(());
        }
        let what = format!("{} with {:?}", self.input.name, way.instructions);
        Err(BenchError::Disagree { what, than: "portable instructions".to_owned() })
    }

    /// Each way as something to time.
    pub(super) fn runs(&'a self) -> Vec<Turn<'a>> {
        let run = |way: &'a Way| -> Turn<'a> {
            Box::new(|| {
                let (taken, answer) = timed(|| way.trace(self.input));
                self.check(way, answer).map(|()| taken)
            })
        };
        self.ways.iter().map(run).collect()
    }

    /// The place of the way that renderings use, on one thread.
    pub(super) fn best(&self) -> usize {
        let best = |way: &Way| way.threads == 1 && way.instructions == Instructions::best();
        self.ways.iter().position(best).unwrap_or(0)
    }

    /// Figures from what each way took.
    pub(super) fn speeds(&self, taken: &[Vec<Taken>]) -> Vec<Speed> {
        let rates = |taken: &[Taken], seconds: fn(&Taken) -> f64| -> Vec<f64> {
            let mrays = self.input.rays.len() as f64 * 1e-6;
            taken.iter().map(|taken| mrays / seconds(taken)).collect()
        };
        let mut alone = 0;
        let mut speeds = Vec::with_capacity(self.ways.len());
        for (place, way) in self.ways.iter().enumerate() {
            if self.ways[alone].instructions != way.instructions {
                alone = place;
            }
            let cpu = [place, alone].map(|i| rates(&taken[i], |taken| taken.cpu_s));
            let wall = [place, alone].map(|i| rates(&taken[i], |taken| taken.wall_s));
            speeds.push(Speed {
                instructions: format!("{:?}", way.instructions).to_lowercase(),
                threads: way.threads,
                mrays_per_cpu_s: median_interval(&cpu[0]),
                mrays_per_wall_s: median_interval(&wall[0]),
                scaling_wall: ratio_interval(&wall[0], &wall[1]),
                scaling_cpu: ratio_interval(&cpu[0], &cpu[1]).times(way.threads as f64),
            });
        }
        speeds
    }

    /// The triangle that each ray meets first; `u32::MAX` for none.
    pub(super) fn hits(&self) -> Vec<u32> {
        let Some(way) = self.ways.first() else { return Vec::new() };
        let mut triangles = way.triangles.clone();
        let mut first = |ray| triangles.closest(ray, u32::MAX, f64::INFINITY);
        self.input.rays.iter().map(|ray| first(ray).map_or(u32::MAX, |hit| hit.triangle)).collect()
    }
}

impl Way {
    /// Traces all rays on the pool's threads; a sum over all answers.
    fn trace(&self, input: &Input) -> u64 {
        let chunk = |triangles: &mut Triangles, rays: &[scenes::Ray]| {
            rays.iter().fold(0_u64, |sum, ray| {
                let hit = triangles.closest(ray, u32::MAX, f64::INFINITY);
                let bits = hit.map_or(1, |hit| hit.t.to_bits().rotate_left(hit.triangle));
                sum.wrapping_add(bits)
            })
        };
        self.pool.install(|| {
            let chunks = input.rays.par_chunks(CHUNK);
            chunks.map_init(|| self.triangles.clone(), chunk).reduce(|| 0, u64::wrapping_add)
        })
    }
}

/// Runs all in turns, each turn starting with another one, so that what slows
/// the machine for a while slows all alike.
pub(super) fn interleaved(
    runs: &mut [Turn<'_>],
    repetitions: usize,
    progress: impl Fn(f64),
) -> Result<Vec<Vec<Taken>>, BenchError> {
    let mut taken = vec![Vec::with_capacity(repetitions); runs.len()];
    for repetition in 0..repetitions {
        for turn in 0..runs.len() {
            let which = (repetition + turn) % runs.len();
            taken[which].push(runs[which]()?);
            progress(
                (repetition * runs.len() + turn + 1) as f64 / (repetitions * runs.len()) as f64,
            );
        }
    }
    Ok(taken)
}

#[cfg(test)]
mod tests {
    #![allow(clippy::unwrap_used, reason = "a failing test may panic")]
    use super::*;

    #[test]
    fn runs_take_turns_and_an_error_ends_them() {
        let order = std::cell::RefCell::new(Vec::new());
        let run = |which: usize| -> Turn<'_> {
            let order = &order;
            Box::new(move || {
                order.borrow_mut().push(which);
                let seconds = which as f64;
                Ok(Taken { cpu_s: seconds, wall_s: seconds })
            })
        };
        let taken = interleaved(&mut [run(0), run(1), run(2)], 3, |_| ()).unwrap();
        assert_eq!(*order.borrow(), [0, 1, 2, 1, 2, 0, 2, 0, 1]);
        assert_eq!(taken[2], [Taken { cpu_s: 2.0, wall_s: 2.0 }; 3]);
        let broken: Turn<'_> =
            Box::new(|| Err(BenchError::Other { program: "made up", why: "broke off".to_owned() }));
        assert!(interleaved(&mut [run(0), broken], 3, |_| ()).is_err());
    }

    #[test]
    fn every_way_answers_alike_and_a_wrong_answer_is_noticed() {
        let mut input = Input::new("ball", &scenes::generate::geodesic(2));
        input.rays.truncate(5_000);
        let bench = Bench::new(&input, &[1, 2]).unwrap();
        assert_eq!(bench.ways.len(), 2 * Instructions::available().len());
        let way = &bench.ways[bench.best()];
        assert_eq!((way.threads, way.instructions), (1, Instructions::best()));
        assert!(bench.check(way, bench.answer).is_ok());
        assert!(bench.check(way, bench.answer ^ 1).is_err());
        assert!(bench.hits().iter().all(|hit| *hit < 80));
    }
}
