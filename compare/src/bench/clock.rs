//! The time that this process has used: of its processors, and on the wall.

use std::time::Instant;

/// What a piece of work took.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Taken {
    /// Seconds on processors, of all threads of the process.
    pub cpu_s: f64,
    /// Seconds on the wall.
    pub wall_s: f64,
}

/// Times a piece of work. While other programs share the processors only
/// `cpu_s` says anything about the work.
pub(super) fn timed<T>(work: impl FnOnce() -> T) -> (Taken, T) {
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
    use std::time::Duration;

    /// Work counts on both clocks; sleep only on the wall.
    #[test]
    fn sleep_takes_no_processor() {
        let (slept, ()) = timed(|| std::thread::sleep(Duration::from_millis(60)));
        assert!(slept.wall_s >= 0.06 && slept.cpu_s < 0.03, "{slept:?}");
        let work = || {
            let until = Instant::now() + Duration::from_millis(60);
            while Instant::now() < until {}
        };
        let (worked, ()) = timed(work);
        assert!(worked.cpu_s > 0.0 && worked.wall_s >= 0.06, "{worked:?}");
    }
}
