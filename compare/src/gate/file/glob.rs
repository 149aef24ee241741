//! Names with one `*`: `renders/*.exr`.

use std::path::{Path, PathBuf};

/// Files that a pattern with one `*` in its last part names, each with the text
/// that stands for the `*`, in the order of that text; a pattern without a star
/// names itself.
///
/// # Errors
/// If there is more than one star, one in a folder's name, or no such file.
pub(super) fn files(pattern: &Path) -> Result<Vec<(String, PathBuf)>, String> {
    let shown = pattern.display();
    let name = pattern.file_name().unwrap_or_default().to_string_lossy().into_owned();
    let folder = pattern.parent().unwrap_or(Path::new(""));
    if folder.to_string_lossy().contains('*') || name.matches('*').count() > 1 {
        return Err(format!("{shown}: write at most one *, and that in the file's name"));
    }
    let Some((before, after)) = name.split_once('*') else {
        return Ok(vec![(String::new(), pattern.to_owned())]);
    };
    let place = if folder.as_os_str().is_empty() { Path::new(".") } else { folder };
    let entries = std::fs::read_dir(place)
        .map_err(|error| format!("{}: cannot be read: {error}", place.display()))?;
    let mut found: Vec<(String, PathBuf)> = entries
        .filter_map(|entry| {
            let name = entry.ok()?.file_name().into_string().ok()?;
            let star = name.strip_prefix(before)?.strip_suffix(after)?.to_owned();
            Some((star, folder.join(name)))
        })
        .collect();
    found.sort();
    if found.is_empty() { Err(format!("{shown}: names no file")) } else { Ok(found) }
}

/// The pattern with a text for its `*`.
pub(super) fn filled(pattern: &Path, star: &str) -> PathBuf {
    PathBuf::from(pattern.to_string_lossy().replace('*', star))
}

#[cfg(test)]
mod tests {
    #![allow(clippy::unwrap_used, reason = "a test that cannot use the disk must fail")]
    use super::*;

    #[test]
    fn a_star_stands_for_what_differs() {
        let folder = tempfile::tempdir().unwrap();
        for name in ["b.exr", "a.exr", "a.png", "ref-c.exr"] {
            std::fs::write(folder.path().join(name), "").unwrap();
        }
        let stars = |name: &str| -> Vec<String> {
            files(&folder.path().join(name)).unwrap().into_iter().map(|(star, _)| star).collect()
        };
        assert_eq!(stars("*.exr"), ["a", "b", "ref-c"]);
        assert_eq!(stars("ref-*.exr"), ["c"]);
        assert_eq!(stars("one.exr"), [""]);
        assert!(files(&folder.path().join("*.hdr")).is_err());
        assert!(files(&folder.path().join("*-*.exr")).is_err());
        assert!(files(Path::new("x*/a.exr")).is_err());
        assert_eq!(filled(Path::new("out/*-t.png"), "a"), Path::new("out/a-t.png"));
    }
}
