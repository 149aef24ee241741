//! Time, gated in the one way that holds: head and base in turns on the same
//! machine, minutes apart at most, and the ratio of each turn.
//!
//! The same source differs by a quarter between two jobs on hosted machines and
//! by a few parts in a thousand between turns of one job.

use super::GateError;
use super::file::scenes::SceneCell;
use super::verdict::{Check, Outcome};
use crate::support::statistics::median_interval;
use serde::Deserialize;
use std::path::{Path, PathBuf};
use std::process::Command;

/// Fewest turns; the interval of the median leaves out three at either end.
pub const FEWEST_TURNS: u32 = 15;
/// Head may be slower by this share.
pub const MARGIN: f64 = 0.10;

/// A `snell` that renders and times.
#[derive(Clone, Debug)]
pub struct Program {
    /// The binary.
    pub path: PathBuf,
    /// Arguments that pick the adapter.
    pub adapter: Vec<String>,
}

/// Judges the ratio of times measured in turns, head first in every other turn.
///
/// # Errors
/// Those of the two measurements.
pub fn ratio<E>(
    cell: &str,
    turns: u32,
    mut head_ms: impl FnMut() -> Result<f64, E>,
    mut base_ms: impl FnMut() -> Result<f64, E>,
) -> Result<Check, E> {
    let mut ratios = Vec::new();
    for turn in 0..turns.max(FEWEST_TURNS) {
        let (head, base) = if turn % 2 == 0 {
            let head = head_ms()?;
            (head, base_ms()?)
        } else {
            let base = base_ms()?;
            (head_ms()?, base)
        };
        ratios.push(head / base);
    }
    let ratio = median_interval(&ratios);
    let (outcome, reason) = if !ratio.median.is_finite() {
        (Outcome::Fail, "no time was measured".to_owned())
    } else if ratio.low > 1.0 + MARGIN {
        (Outcome::Fail, format!("slower by more than {:.0} %", 100.0 * MARGIN))
    } else if ratio.high - ratio.low > MARGIN {
        let wide = ratio.high - ratio.low;
        (
            Outcome::Inconclusive,
            format!("the interval is {wide:.2} wide: a quieter machine, or more turns"),
        )
    } else if ratio.median > 1.0 + MARGIN {
        (Outcome::Warn, "slower, but not surely".to_owned())
    } else {
        (Outcome::Pass, String::new())
    };
    Ok(Check {
        base: Some(1.0),
        head: Some(ratio.median),
        difference: Some(ratio.median - 1.0),
        ci_lo: Some(ratio.low - 1.0),
        ci_hi: Some(ratio.high - 1.0),
        margin: Some(MARGIN),
        ..Check::plain(cell, "time_ratio", outcome, reason)
    })
}

impl Program {
    /// Median milliseconds of a frame of a cell: of GPU timestamps, or of the wall
    /// where the adapter is a CPU.
    ///
    /// # Errors
    /// If the program cannot be run or answers something else.
    pub fn frame_ms(&self, cell: &SceneCell, resolution_px: [u32; 2]) -> Result<f64, GateError> {
        let fail = |reason: String| GateError::Program {
            program: self.path.display().to_string(),
            reason,
        };
        let folder = tempfile::tempdir().map_err(|error| fail(error.to_string()))?;
        let scene = cell.scene.source.path.as_deref();
        let scene = scene.map_or_else(|| cell.scene.name.clone(), |p| p.display().to_string());
        let mut command = Command::new(&self.path);
        command.args(["--json", "realtime", &scene, "--method", &cell.method]);
        command.args(["--positions", "1", "--timing", "0.2", "--hardware-filter"]);
        command.args(["--resolution", &format!("{}x{}", resolution_px[0], resolution_px[1])]);
        for (name, value) in &cell.parameters {
            command.args(["--param", &format!("{name}={value}")]);
        }
        command.arg("--out").arg(folder.path().join("frame.exr")).args(&self.adapter);
        let ran = command.output().map_err(|error| fail(error.to_string()))?;
        if !ran.status.success() {
            return Err(fail(String::from_utf8_lossy(&ran.stderr).trim().to_owned()));
        }
        time(&ran.stdout).map_err(fail)
    }
}

/// What we read of a rendering's answer.
#[derive(Deserialize)]
struct Answer {
    passes: Vec<scenes::rendering::Pass>,
    provenance: scenes::rendering::Provenance,
}

fn time(answer: &[u8]) -> Result<f64, String> {
    use scenes::rendering::TimeSource::{Timestamp, Wall};
    let answer: Answer = serde_json::from_slice(answer).map_err(|error| error.to_string())?;
    let source = if answer.provenance.software { Wall } else { Timestamp };
    let times = answer.passes.iter().flat_map(|pass| &pass.times).filter(|t| t.source == source);
    let all: Vec<f64> = times.map(|time| time.milliseconds).collect();
    match all.is_empty() {
        true => Err(format!("it measured no time by {source:?}")),
        false => Ok(all.iter().sum()),
    }
}

/// Builds `snell` as it was at a commit, beside the build of now, and returns the
/// binary. What was built once is used again.
///
/// # Errors
/// If git does not know the commit, or it does not build.
pub fn program_at(commit: &str) -> Result<PathBuf, GateError> {
    let run = |command: &mut Command| -> Result<String, GateError> {
        let shown = format!("{command:?}");
        let fail = |reason: String| GateError::Program { program: shown.clone(), reason };
        let ran = command.output().map_err(|error| fail(error.to_string()))?;
        match ran.status.success() {
            true => Ok(String::from_utf8_lossy(&ran.stdout).trim().to_owned()),
            false => Err(fail(String::from_utf8_lossy(&ran.stderr).trim().to_owned())),
        }
    };
    let top = run(Command::new("git").args(["rev-parse", "--show-toplevel"]))?;
    let wanted = format!("{commit}^{{commit}}");
    let hash =
        run(Command::new("git").args(["rev-parse", "--verify", "--end-of-options", &wanted]))?;
    let place = Path::new(&top).join("target/gate");
    let kept = place.join(format!("snell-{hash}"));
    if kept.exists() {
        return Ok(kept);
    }
    let sources = place.join("sources");
    // A worktree left by a build that was stopped.
    let _ = run(Command::new("git").args(["worktree", "remove", "--force"]).arg(&sources));
    run(Command::new("git")
        .args(["worktree", "add", "--detach", "--force"])
        .arg(&sources)
        .arg(&hash))?;
    let built = run(Command::new("cargo")
        .args(["build", "--release", "--package", "snell", "--target-dir"])
        .arg(place.join("build"))
        .current_dir(&sources));
    let _ = run(Command::new("git").args(["worktree", "remove", "--force"]).arg(&sources));
    built?;
    let binary = place.join("build/release/snell").with_extension(std::env::consts::EXE_EXTENSION);
    std::fs::copy(&binary, &kept).map_err(|error| GateError::file(&binary, error))?;
    Ok(kept)
}

#[cfg(test)]
mod tests {
    #![allow(clippy::unwrap_used, reason = "a test may stop at the first failure")]
    use super::*;
    use scenes::noise::SplitMix64;
    use std::cell::RefCell;

    /// Times of a machine that is ever busier, with 2 % of noise.
    fn outcome(slower: f64, noise: f64) -> Outcome {
        let machine = RefCell::new((SplitMix64(3), 1.0));
        let measure = |factor: f64| {
            let (random, load) = &mut *machine.borrow_mut();
            *load *= 1.03;
            Ok::<_, ()>(factor * *load * (noise * random.normal()).exp())
        };
        ratio("ball/multi", 15, || measure(slower), || measure(1.0)).unwrap().outcome
    }

    #[test]
    fn a_slower_head_fails_on_a_machine_that_gets_busier() {
        assert_eq!(outcome(1.0, 0.02), Outcome::Pass);
        assert_eq!(outcome(1.3, 0.02), Outcome::Fail);
        assert_eq!(outcome(0.5, 0.02), Outcome::Pass);
        assert_eq!(outcome(1.0, 0.5), Outcome::Inconclusive);
        let none = ratio("a", 1, || Ok::<_, ()>(f64::NAN), || Ok(1.0)).unwrap();
        assert_eq!(none.outcome, Outcome::Fail);
    }

    #[test]
    fn the_clock_is_that_of_the_adapter() {
        let answer = |software: bool| {
            let passes = r#"[{"name":"shade","times":[{"source":"timestamp","milliseconds":2.0}]},
                {"name":"frame","times":[{"source":"wall","milliseconds":5.0}]}]"#;
            let provenance = scenes::rendering::Provenance { software, ..Default::default() };
            let provenance = serde_json::to_string(&provenance).unwrap();
            format!("{{\"schema\":\"x\",\"passes\":{passes},\"provenance\":{provenance}}}")
        };
        assert_eq!(time(answer(true).as_bytes()), Ok(5.0));
        assert_eq!(time(answer(false).as_bytes()), Ok(2.0));
        assert!(time(b"{}").is_err() && time(b"").is_err());
    }
}
