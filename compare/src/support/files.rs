//! Files that cannot be read or written, and files that are written whole or
//! not at all.

use scenes::whole;
use std::fs;
use std::io;
use std::path::{Path, PathBuf};

/// A file or folder that cannot be read or written.
#[derive(Debug, thiserror::Error)]
#[error("{}: {what}: {source}", path.display())]
pub struct FileError {
    /// Which one.
    path: PathBuf,
    /// What was to be done with it.
    what: &'static str,
    /// The system's answer.
    source: io::Error,
}

impl FileError {
    /// Turns the system's answer into an error about a path, for `map_err`.
    pub(crate) fn of(path: &Path, what: &'static str) -> impl Fn(io::Error) -> Self {
        let path = path.to_owned();
        move |source| Self { path: path.clone(), what, source }
    }

    /// The same for what was to be written.
    pub(crate) fn unwritten(path: &Path) -> impl Fn(io::Error) -> Self {
        Self::of(path, "cannot be written")
    }
}

/// Writes a file under another name beside its place and renames it when
/// `make` is done, so that nobody ever sees half of it. Folders are made.
///
/// # Errors
/// The error of `make`, or that the place cannot be written.
pub(crate) fn replace<E: From<FileError>>(
    path: &Path,
    make: impl FnOnce(&Path) -> Result<(), E>,
) -> Result<(), E> {
    if path.file_name().is_none() || path.is_dir() {
        return Err(FileError::unwritten(path)(io::ErrorKind::IsADirectory.into()).into());
    }
    make_folder_of(path)?;
    whole::replace(path, |error| FileError::unwritten(path)(error).into(), make)
}

/// Writes a file whole or not at all. Folders are made.
///
/// # Errors
/// That the place cannot be written.
pub(crate) fn write(path: &Path, bytes: &[u8]) -> Result<(), FileError> {
    replace(path, |partial| fs::write(partial, bytes).map_err(FileError::unwritten(path)))
}

/// Makes the folder that a file is to be written to.
///
/// # Errors
/// If it cannot be made.
pub(crate) fn make_folder_of(path: &Path) -> Result<(), FileError> {
    let folder = path.parent().filter(|folder| !folder.as_os_str().is_empty());
    let made = folder.map_or(Ok(()), fs::create_dir_all);
    made.map_err(FileError::of(path, "its folder cannot be made"))
}

#[cfg(test)]
mod tests {
    #![allow(clippy::unwrap_used, reason = "a test that cannot use the disk must fail")]
    use super::*;

    #[test]
    fn folders_are_made_and_a_failed_write_leaves_the_old_file() {
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("new/report.md");
        write(&path, b"old").unwrap();
        let failing = |partial: &Path| {
            fs::write(partial, "ha").unwrap();
            Err(FileError::unwritten(&path)(io::ErrorKind::StorageFull.into()))
        };
        assert!(replace(&path, failing).is_err());
        assert_eq!(fs::read_to_string(&path).unwrap(), "old");
        assert_eq!(fs::read_dir(path.parent().unwrap()).unwrap().count(), 1);
    }

    #[test]
    fn a_folder_is_not_overwritten() {
        let folder = tempfile::tempdir().unwrap();
        let error = write(folder.path(), b"").unwrap_err();
        assert!(error.to_string().contains("cannot be written"), "{error}");
    }
}
