//! Hashes the sources that decide what an image looks like, so that a stored
//! result is used only by the program that would make it again.

use sha2::{Digest, Sha256};
use std::path::{Path, PathBuf};

fn main() -> std::io::Result<()> {
    for (name, folders) in [
        ("SNELL_EXACT_SOURCES", ["scenes", "reference"]),
        ("SNELL_REALTIME_SOURCES", ["scenes", "realtime"]),
    ] {
        let mut hash = Sha256::new();
        for folder in folders {
            add(&mut hash, &Path::new("..").join(folder).join("src"))?;
        }
        // The versions of every dependency.
        add(&mut hash, Path::new("../Cargo.lock"))?;
        let digest: String = hash.finalize().iter().map(|byte| format!("{byte:02x}")).collect();
        println!("cargo::rustc-env={name}={digest}");
    }
    Ok(())
}

/// Adds a file, or every file below a folder in the order of their names.
fn add(hash: &mut Sha256, path: &Path) -> std::io::Result<()> {
    println!("cargo::rerun-if-changed={}", path.display());
    if path.is_dir() {
        let entries = std::fs::read_dir(path)?;
        let mut paths: Vec<PathBuf> =
            entries.map(|entry| entry.map(|entry| entry.path())).collect::<Result<_, _>>()?;
        paths.sort();
        return paths.iter().try_for_each(|path| add(hash, path));
    }
    let content = std::fs::read(path)?;
    hash.update(path.to_string_lossy().as_bytes());
    hash.update((content.len() as u64).to_le_bytes());
    hash.update(content);
    Ok(())
}
