//! Embree on the same triangles and rays: a small program of our own, compiled
//! when it is needed, so that nobody else needs Embree.

use super::{BenchError, Input};
use crate::support::clock::Taken;
use crate::support::files::FileError;
use std::ffi::{OsStr, OsString};
use std::io::{BufRead, BufReader, Write};
use std::path::Path;
use std::process::{Child, ChildStdin, ChildStdout, Command, Stdio};
use tempfile::TempDir;

const SOURCE: &str = include_str!("embree.cpp");
/// As a user of Embree would compile.
const FLAGS: [&str; 4] = ["-O3", "-march=native", "-std=c++17", "-o"];

/// How carefully Embree intersects.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Robust {
    /// Its default.
    Off,
    /// `RTC_SCENE_FLAG_ROBUST`.
    On,
}

impl Robust {
    pub(super) const BOTH: [Self; 2] = [Self::Off, Self::On];

    fn word(self) -> &'static str {
        match self {
            Self::Off => "fast",
            Self::On => "robust",
        }
    }
}

/// The compiled program and a folder for its files.
#[derive(Debug)]
pub struct Program {
    folder: TempDir,
}

/// The compiler that `CXX` names, or `c++`.
#[must_use]
pub fn compiler() -> OsString {
    std::env::var_os("CXX").filter(|name| !name.is_empty()).unwrap_or_else(|| "c++".into())
}

impl Program {
    /// Compiles it.
    ///
    /// # Errors
    /// There is no compiler, or it does not find Embree.
    pub fn compile(compiler: &OsStr) -> Result<Self, BenchError> {
        let folder = tempfile::tempdir().map_err(FileError::unwritten(&std::env::temp_dir()))?;
        let source = folder.path().join("embree.cpp");
        std::fs::write(&source, SOURCE).map_err(FileError::unwritten(&source))?;
        let mut command = Command::new(compiler);
        command.args(FLAGS).arg(folder.path().join("embree")).arg(&source).arg("-lembree3");
        let compiler = compiler.to_string_lossy().into_owned();
        let output = command.output().map_err(|source| {
            let compiler = compiler.clone();
            BenchError::Compiler { compiler, source }
        })?;
        if output.status.success() {
            return Ok(Self { folder });
        }
        let said = String::from_utf8_lossy(&output.stderr);
        let said = said.lines().take(4).collect::<Vec<_>>().join("\n");
        Err(BenchError::Compile { compiler, said })
    }

    /// Builds Embree's scenes over an input, and waits for its rays' hits.
    pub(super) fn start(&self, input: &Input) -> Result<Running, BenchError> {
        let [triangles, rays, hits] =
            ["triangles", "rays", "hits"].map(|name| self.folder.path().join(name));
        write_floats(&triangles, input.corners.iter().flatten().flat_map(|p| p.to_array()))?;
        let numbers = |ray: &scenes::Ray| [ray.origin.to_array(), ray.direction.to_array()];
        write_floats(&rays, input.rays.iter().flat_map(numbers).flatten())?;
        let mut child = Command::new(self.folder.path().join("embree"))
            .args([&triangles, &rays, &hits])
            .stdin(Stdio::piped())
            .stdout(Stdio::piped())
            .spawn()
            .map_err(FileError::of(&self.folder.path().join("embree"), "cannot be started"))?;
        let (Some(to), Some(from)) = (child.stdin.take(), child.stdout.take()) else {
            return Err(broke_off("has no pipes"));
        };
        let mut running = Running { child, to, from: BufReader::new(from), version: String::new() };
        running.version = version(&running.line()?)?;
        Ok(running)
    }

    /// The triangle that each ray meets first.
    pub(super) fn hits(&self, robust: Robust) -> Result<Vec<u32>, BenchError> {
        let path = self.folder.path().join("hits").with_extension(robust.word());
        let bytes = std::fs::read(&path).map_err(FileError::of(&path, "cannot be read"))?;
        Ok(bytes.as_chunks().0.iter().map(|four| u32::from_le_bytes(*four)).collect())
    }
}

/// "Embree 31305" as "Embree 3.13.5".
fn version(line: &str) -> Result<String, BenchError> {
    let number: Option<u32> = line.strip_prefix("Embree ").and_then(|n| n.trim().parse().ok());
    let number = number.ok_or_else(|| broke_off("does not say its version"))?;
    Ok(format!("Embree {}.{}.{}", number / 10_000, number / 100 % 100, number % 100))
}

/// The program, waiting for a word.
pub(super) struct Running {
    child: Child,
    to: ChildStdin,
    from: BufReader<ChildStdout>,
    pub(super) version: String,
}

impl Running {
    /// Traces all rays once.
    pub(super) fn trace(&mut self, robust: Robust) -> Result<Taken, BenchError> {
        let asked = writeln!(self.to, "{}", robust.word()).and_then(|()| self.to.flush());
        asked.map_err(|error| broke_off(&error.to_string()))?;
        let line = self.line()?;
        let mut numbers = line.split_whitespace().map_while(|word| word.parse().ok());
        match (numbers.next(), numbers.next()) {
            (Some(cpu_s), Some(wall_s)) => Ok(Taken { cpu_s, wall_s }),
            _ => Err(broke_off(&format!("answers {line:?}"))),
        }
    }

    fn line(&mut self) -> Result<String, BenchError> {
        let mut line = String::new();
        match self.from.read_line(&mut line) {
            Ok(0) => Err(broke_off("ended without an answer")),
            Ok(_) => Ok(line),
            Err(error) => Err(broke_off(&error.to_string())),
        }
    }
}

impl Drop for Running {
    fn drop(&mut self) {
        let _ = self.child.kill();
        let _ = self.child.wait();
    }
}

fn write_floats(path: &Path, numbers: impl Iterator<Item = f64>) -> Result<(), BenchError> {
    let bytes: Vec<u8> = numbers.flat_map(|x| (x as f32).to_le_bytes()).collect();
    Ok(std::fs::write(path, bytes).map_err(FileError::unwritten(path))?)
}

fn broke_off(why: &str) -> BenchError {
    BenchError::Other { program: "Embree's side", why: why.to_owned() }
}

#[cfg(test)]
mod tests {
    #![allow(clippy::unwrap_used, reason = "a failing test may panic")]
    use super::*;

    #[test]
    fn without_a_compiler_the_packages_are_named() {
        let error = Program::compile(OsStr::new("no-such-compiler")).unwrap_err();
        assert!(matches!(error, BenchError::Compiler { .. }), "{error}");
        let text = error.to_string();
        assert!(text.contains("no-such-compiler") && text.contains("libembree-dev g++"), "{text}");
    }

    /// `false` stands for a compiler that finds no Embree.
    #[cfg(unix)]
    #[test]
    fn a_compiler_that_fails_is_an_error_with_the_packages() {
        let error = Program::compile(OsStr::new("false")).unwrap_err();
        assert!(matches!(error, BenchError::Compile { .. }), "{error}");
        assert!(error.to_string().contains("apt-get install libembree-dev g++"), "{error}");
    }

    #[test]
    fn the_version_is_read() {
        assert_eq!(version("Embree 31305\n").unwrap(), "Embree 3.13.5");
        assert!(version("hello").is_err());
    }
}
