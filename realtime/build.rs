//! Lists the files of WGSL, so that a new one is only a file.

use std::collections::BTreeMap;
use std::path::{Path, PathBuf};

fn main() -> std::io::Result<()> {
    let folder = PathBuf::from(variable("CARGO_MANIFEST_DIR")).join("src/shaders");
    println!("cargo::rerun-if-changed=src/shaders");
    let mut files = BTreeMap::new();
    find(&folder, &mut files)?;
    let rows = files.iter().map(|(name, path)| {
        let path = path.display().to_string();
        format!("    ({name:?}, include_str!({path:?})),\n")
    });
    let list = Path::new(&variable("OUT_DIR")).join("shaders.rs");
    std::fs::write(list, format!("&[\n{}]\n", rows.collect::<String>()))
}

/// Files by their names without the ending, which must be unique: needs are called
/// by them.
fn find(folder: &Path, files: &mut BTreeMap<String, PathBuf>) -> std::io::Result<()> {
    for entry in std::fs::read_dir(folder)? {
        let path = entry?.path();
        if path.is_dir() {
            find(&path, files)?;
            continue;
        }
        let name = path.file_name().unwrap_or_default().to_string_lossy().into_owned();
        let Some(name) = name.strip_suffix(".wgsl") else {
            panic!("{} is no file of WGSL", path.display());
        };
        if let Some(other) = files.insert(name.to_owned(), path.clone()) {
            panic!("{} and {} have one name", path.display(), other.display());
        }
    }
    Ok(())
}

fn variable(name: &str) -> String {
    std::env::var(name).unwrap_or_else(|_| panic!("cargo sets {name}"))
}
