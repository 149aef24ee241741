//! Files that are written whole or not at all.

use crate::Error;
use std::fs;
use std::path::Path;

/// Writes a file under another name beside its place and renames it when
/// `write` is done, so that nobody ever sees half of it. Folders are made.
///
/// # Errors
/// The error of `write`, or that the place cannot be written.
pub(crate) fn replace(
    path: &Path,
    write: impl FnOnce(&Path) -> Result<(), Error>,
) -> Result<(), Error> {
    let failed = || Error::file(path, "cannot be written");
    let not_a_file = || std::io::Error::from(std::io::ErrorKind::IsADirectory);
    let name = path.file_name().ok_or_else(not_a_file).map_err(failed())?;
    if path.is_dir() {
        return Err(failed()(not_a_file()));
    }
    make_folder_of(path)?;
    // The extension stays last, because writers look at it.
    let mut partial = std::ffi::OsString::from(format!(".partial-{}-", std::process::id()));
    partial.push(name);
    let partial = path.with_file_name(partial);
    let written = write(&partial).and_then(|()| fs::rename(&partial, path).map_err(failed()));
    if written.is_err() {
        let _ = fs::remove_file(&partial);
    }
    written
}

/// Makes the folder that a file is to be written to.
///
/// # Errors
/// If it cannot be made.
pub(crate) fn make_folder_of(path: &Path) -> Result<(), Error> {
    let folder = path.parent().filter(|folder| !folder.as_os_str().is_empty());
    let made = folder.map_or(Ok(()), fs::create_dir_all);
    made.map_err(Error::file(path, "its folder cannot be made"))
}

#[cfg(test)]
mod tests {
    #![allow(clippy::unwrap_used, reason = "a test that cannot use the disk must fail")]
    use super::*;

    #[test]
    fn a_failed_write_leaves_the_old_file_and_nothing_else() {
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("new/image.exr");
        replace(&path, |partial| fs::write(partial, "old").map_err(Error::Output)).unwrap();
        let failing = |partial: &Path| {
            fs::write(partial, "ha").unwrap();
            Err(Error::Output(std::io::ErrorKind::StorageFull.into()))
        };
        assert!(replace(&path, failing).is_err());
        assert_eq!(fs::read_to_string(&path).unwrap(), "old");
        assert_eq!(fs::read_dir(path.parent().unwrap()).unwrap().count(), 1);
    }

    #[test]
    fn a_folder_is_not_overwritten() {
        let folder = tempfile::tempdir().unwrap();
        let error = replace(folder.path(), |_| unreachable!()).unwrap_err();
        assert!(error.to_string().contains("cannot be written"), "{error}");
    }
}
