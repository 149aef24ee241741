//! The time that this process has used: of its processors, and on the wall.

use std::time::Instant;

/// What a piece of work took.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Taken {
    /// Seconds on processors, of all threads of the process.
    pub cpu_s: f64,
    /// Seconds on the wall.
    pub wall_s: f64,
}

/// Times a piece of work. While other programs share the processors only
/// `cpu_s` says anything about the work.
pub(crate) fn timed<T>(work: impl FnOnce() -> T) -> (Taken, T) {
    let (wall, cpu) = (Instant::now(), process_cpu_s());
    let answer = work();
    let wall_s = wall.elapsed().as_secs_f64();
    let cpu_s = match (cpu, process_cpu_s()) {
        (Some(before), Some(after)) => after - before,
        _ => wall_s,
    };
    (Taken { cpu_s, wall_s }, answer)
}

/// Processor seconds of all threads of this process so far, where the system
/// tells (POSIX `CLOCK_PROCESS_CPUTIME_ID`).
fn process_cpu_s() -> Option<f64> {
    #[cfg(unix)]
    {
        let time = rustix::time::clock_gettime(rustix::time::ClockId::ProcessCPUTime);
        Some(time.tv_sec as f64 + time.tv_nsec as f64 * 1e-9)
    }
    #[cfg(not(unix))]
    None
}

#[cfg(test)]
mod tests {
    use super::*;

    /// However busy the machine, processors give no more time than they have.
    /// (Other tests of this process count too, so there is no lower bound but
    /// that of the work.)
    #[test]
    fn processor_time_is_between_the_work_and_all_processors() {
        let work = || {
            let start = process_cpu_s();
            let passed = || Some(process_cpu_s()? - start?);
            while passed().is_some_and(|seconds| seconds < 0.05) {}
        };
        let (taken, ()) = timed(work);
        let processors = std::thread::available_parallelism().map_or(1, usize::from) as f64;
        assert!(cfg!(not(unix)) || taken.cpu_s >= 0.05, "{taken:?}");
        assert!(taken.cpu_s <= 1.2 * processors * taken.wall_s, "{taken:?}");
    }
}
