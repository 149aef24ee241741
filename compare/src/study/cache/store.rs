//! A folder of results by content id, each stored whole or not at all.
//!
//! A result is a folder. It is filled under another name and renamed when it
//! is complete, so a reader never sees half of one, whoever is killed when. A
//! list of checksums inside finds what changed on the disk afterwards.

use super::id::{Id, hex};
use crate::Error;
use crate::support::files::FileError;
use scenes::whole;
use sha2::{Digest, Sha256};
use std::collections::BTreeMap;
use std::fs;
use std::path::{Path, PathBuf};
use std::sync::Arc;
use tempfile::TempDir;

const CHECKSUMS: &str = "checksums.json";
/// Folder of files that are locked while a result is being made.
const TURNS: &str = ".turns";
pub(in crate::study) const CANNOT_BE_WRITTEN: &str =
    "the cache cannot be written; name another folder with --cache";

/// A folder of results by content id.
#[derive(Clone, Debug)]
pub struct Store {
    root: PathBuf,
    /// Removes the folder with the last store that uses it.
    _temporary: Option<Arc<TempDir>>,
}

/// What the store knows about an id.
#[derive(Debug, PartialEq)]
pub enum Found {
    /// The folder that holds the result, verified.
    Whole(PathBuf),
    /// Nothing.
    Absent,
    /// A result whose files are not those that were stored: it has been
    /// removed and must be made again.
    Damaged(String),
}

impl Store {
    /// A store in a folder, which is made when the first result is stored.
    #[must_use]
    pub fn new(root: PathBuf) -> Self {
        Self { root, _temporary: None }
    }

    /// A store in a folder of its own that no other user can read and that is
    /// removed at the end.
    ///
    /// # Errors
    /// If there is no place for temporary files.
    pub fn for_this_run() -> Result<Self, Error> {
        let place = std::env::temp_dir();
        let folder = tempfile::Builder::new().prefix("snell-").tempdir();
        let folder = folder.map_err(FileError::of(&place, CANNOT_BE_WRITTEN))?;
        Ok(Self { root: folder.path().to_owned(), _temporary: Some(Arc::new(folder)) })
    }

    /// The folder of the whole store.
    #[must_use]
    pub fn root(&self) -> &Path {
        &self.root
    }

    /// True if there is a result, verified or not.
    #[must_use]
    pub fn has(&self, id: &Id) -> bool {
        self.root.join(id.as_str()).exists()
    }

    /// Waits until nobody else is making the result of that id, in this process or
    /// another, and holds the turn until it is dropped. Whoever is killed loses it.
    ///
    /// # Errors
    /// If the disk does not take a file of no bytes.
    pub fn turn(&self, id: &Id) -> Result<fs::File, Error> {
        let folder = self.root.join(TURNS);
        let failed = FileError::of(&folder, CANNOT_BE_WRITTEN);
        fs::create_dir_all(&folder).map_err(&failed)?;
        let file = fs::File::create(folder.join(id.as_str())).map_err(&failed)?;
        file.lock().map_err(&failed)?;
        Ok(file)
    }

    /// Looks a result up and verifies it.
    #[must_use]
    pub fn find(&self, id: &Id) -> Found {
        let folder = self.root.join(id.as_str());
        if !folder.exists() {
            return Found::Absent;
        }
        match verify(&folder) {
            Ok(()) => Found::Whole(folder),
            Err(why) => {
                // What cannot be removed will be replaced by `put`.
                let _ = fs::remove_dir_all(&folder);
                Found::Damaged(why)
            }
        }
    }

    /// Stores what `fill` writes into the folder it is given, all or nothing.
    ///
    /// # Errors
    /// The error of `fill`, or that the disk did not take the result.
    pub fn put(
        &self,
        id: &Id,
        fill: impl FnOnce(&Path) -> Result<(), Error>,
    ) -> Result<PathBuf, Error> {
        let unwritten = FileError::of(&self.root, CANNOT_BE_WRITTEN);
        let failed = |error| Error::from(unwritten(error));
        let folder = self.root.join(id.as_str());
        let stored = whole::replace(&folder, failed, |partial| {
            fs::create_dir_all(partial).map_err(failed)?;
            fill(partial)?;
            let sums = checksums(partial).map_err(failed)?;
            let text = serde_json::to_vec(&sums).map_err(|error| failed(error.into()))?;
            fs::write(partial.join(CHECKSUMS), text).map_err(failed)
        });
        match stored {
            // Someone else stored the same result first: theirs is as good.
            Err(_) if verify(&folder).is_ok() => Ok(folder),
            stored => stored.map(|()| folder),
        }
    }
}

/// SHA-256 of every file of a result but the list itself.
fn checksums(folder: &Path) -> std::io::Result<BTreeMap<String, String>> {
    let mut sums = BTreeMap::new();
    for entry in fs::read_dir(folder)? {
        let entry = entry?;
        let name = entry.file_name().to_string_lossy().into_owned();
        if name != CHECKSUMS {
            sums.insert(name, hex(&Sha256::digest(fs::read(entry.path())?)));
        }
    }
    Ok(sums)
}

fn verify(folder: &Path) -> Result<(), String> {
    let text = fs::read(folder.join(CHECKSUMS)).map_err(|e| e.to_string())?;
    let stored: BTreeMap<String, String> =
        serde_json::from_slice(&text).map_err(|e| e.to_string())?;
    let found = checksums(folder).map_err(|e| e.to_string())?;
    if stored == found { Ok(()) } else { Err("a checksum differs".to_owned()) }
}

#[cfg(test)]
mod tests {
    #![allow(clippy::unwrap_used, reason = "a test that cannot use the disk must fail")]
    use super::*;

    fn store() -> (tempfile::TempDir, Store, Id) {
        let folder = tempfile::tempdir().unwrap();
        let store = Store::new(folder.path().join("deep/cache"));
        (folder, store, Id::of(&"a result"))
    }

    fn write(text: &'static str) -> impl FnOnce(&Path) -> Result<(), Error> {
        move |folder| {
            fs::write(folder.join("image"), text).unwrap();
            Ok(())
        }
    }

    #[test]
    fn what_was_stored_is_found() {
        let (_keep, store, id) = store();
        assert_eq!(store.find(&id), Found::Absent);
        let folder = store.put(&id, write("pixels")).unwrap();
        assert_eq!(store.find(&id), Found::Whole(folder.clone()));
        assert_eq!(fs::read_to_string(folder.join("image")).unwrap(), "pixels");
    }

    #[test]
    fn a_failed_result_leaves_nothing() {
        let (_keep, store, id) = store();
        let failing = |folder: &Path| {
            write("half")(folder)?;
            Err(Error::Output(std::io::ErrorKind::StorageFull.into()))
        };
        assert!(store.put(&id, failing).is_err());
        assert_eq!(store.find(&id), Found::Absent);
        assert_eq!(fs::read_dir(store.root()).unwrap().count(), 0);
    }

    #[test]
    fn a_flipped_bit_is_noticed_and_the_result_can_be_made_again() {
        let (_keep, store, id) = store();
        let folder = store.put(&id, write("pixels")).unwrap();
        fs::write(folder.join("image"), "pixelt").unwrap();
        assert!(matches!(store.find(&id), Found::Damaged(_)));
        assert_eq!(store.find(&id), Found::Absent);
        let folder = store.put(&id, write("pixels")).unwrap();
        assert_eq!(store.find(&id), Found::Whole(folder));
    }

    #[test]
    fn the_same_result_stored_twice_is_one() {
        let (_keep, store, id) = store();
        store.put(&id, write("pixels")).unwrap();
        let folder = store.put(&id, write("pixels")).unwrap();
        assert_eq!(store.find(&id), Found::Whole(folder));
        assert_eq!(fs::read_dir(store.root()).unwrap().count(), 1);
    }
}
