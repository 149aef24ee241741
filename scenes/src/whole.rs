//! Files and folders that appear under their name whole or not at all: made
//! beside it, then renamed.

use std::fs::{self, File};
use std::hash::{BuildHasher, Hasher, RandomState};
use std::io::{self, BufWriter, Write};
use std::path::{Path, PathBuf};
use std::sync::LazyLock;
use std::sync::atomic::{AtomicU64, Ordering};

/// Lets `make` write a file or a folder under another name in the same folder,
/// and renames it when that is done. Of a failure nothing is left, and what stood
/// under the name before stays. `failed` makes an error of the system's refusal
/// to rename.
///
/// # Errors
/// That of `make`, or that it cannot be renamed.
pub fn replace<E>(
    path: &Path,
    failed: impl FnOnce(io::Error) -> E,
    make: impl FnOnce(&Path) -> Result<(), E>,
) -> Result<(), E> {
    let partial = partial(path);
    let made = make(&partial).and_then(|()| fs::rename(&partial, path).map_err(failed));
    if made.is_err() {
        // It is ours alone; that it may linger is no second error.
        let _ = fs::remove_file(&partial).or_else(|_| fs::remove_dir_all(&partial));
    }
    made
}

/// Writes a file, and waits until the disk has it before it gets its name.
///
/// # Errors
/// The system's answer.
pub fn write(path: &Path, bytes: &[u8]) -> io::Result<()> {
    replace(
        path,
        |error| error,
        |partial| {
            let mut file = BufWriter::new(File::create(partial)?);
            file.write_all(bytes)?;
            file.into_inner().map_err(io::IntoInnerError::into_error)?.sync_all()
        },
    )
}

/// A name in the same folder that no other writer uses. Its end stays, because
/// writers look at it.
fn partial(path: &Path) -> PathBuf {
    static COUNT: AtomicU64 = AtomicU64::new(0);
    // Machines that share a folder may share the numbers of their processes.
    static OURS: LazyLock<u64> = LazyLock::new(|| RandomState::new().build_hasher().finish());
    let number = COUNT.fetch_add(1, Ordering::Relaxed);
    let name = path.file_name().unwrap_or_default().to_string_lossy();
    path.with_file_name(format!(".partial-{:x}-{number}-{name}", *OURS))
}

#[cfg(test)]
mod tests {
    #![allow(clippy::unwrap_used, reason = "a test that cannot use the disk must fail")]
    use super::*;

    fn names(folder: &Path) -> Vec<PathBuf> {
        fs::read_dir(folder).unwrap().map(|entry| entry.unwrap().path()).collect()
    }

    #[test]
    fn a_failed_write_leaves_the_old_file_and_nothing_else() {
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("image.exr");
        write(&path, b"old").unwrap();
        let failing = |partial: &Path| {
            assert!(partial.extension().is_some_and(|end| end == "exr"), "{partial:?}");
            fs::write(partial, "ha").unwrap();
            Err(io::ErrorKind::StorageFull.into())
        };
        assert!(replace(&path, |error: io::Error| error, failing).is_err());
        assert_eq!(fs::read_to_string(&path).unwrap(), "old");
        assert_eq!(names(folder.path()), std::slice::from_ref(&path));
        write(&path, b"new").unwrap();
        assert_eq!(fs::read_to_string(&path).unwrap(), "new");
    }

    #[test]
    fn a_failed_folder_is_taken_away_with_what_is_in_it() {
        let folder = tempfile::tempdir().unwrap();
        let fill = |partial: &Path, answer: io::Result<()>| {
            fs::create_dir(partial).unwrap();
            fs::write(partial.join("scene.bin"), "half").unwrap();
            answer
        };
        let path = folder.path().join("scene");
        let failing = |partial: &Path| fill(partial, Err(io::ErrorKind::StorageFull.into()));
        assert!(replace(&path, |error| error, failing).is_err());
        assert_eq!(names(folder.path()), [""; 0].map(PathBuf::from));
        replace(&path, |error| error, |partial| fill(partial, Ok(()))).unwrap();
        assert!(path.join("scene.bin").is_file());
    }
}
