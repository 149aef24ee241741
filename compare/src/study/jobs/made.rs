//! A finished job: an image file, and everything else the renderer told.

use crate::Error;
use crate::study::cache::{CANNOT_BE_WRITTEN, Found, Id, Store};
use crate::support::files::FileError;
use scenes::rendering::{Pass, Provenance};
use scenes::{Layers, Plan, Rendering};
use serde::{Deserialize, Serialize};
use std::collections::BTreeMap;
use std::fs;
use std::path::{Path, PathBuf};

const IMAGE: &str = "image.exr";
const FACTS: &str = "facts.json";

/// A rendering whose layers are those of a file.
#[derive(Clone, Debug)]
pub struct Made {
    /// Content id of the job.
    pub id: Id,
    /// The EXR file with all layers.
    pub image: PathBuf,
    /// The layers of that file: f32 values, however they were computed.
    pub layers: Layers,
    /// Everything about the rendering that is not a layer.
    pub facts: Facts,
}

/// Everything about a rendering that is not a layer.
#[derive(Clone, Debug, Default, Serialize, Deserialize)]
pub struct Facts {
    /// What ran, with its times.
    pub passes: Vec<Pass>,
    /// Deterministic counts.
    pub counters: BTreeMap<String, u64>,
    /// What was to run and what was left out.
    pub plan: Plan,
    /// By whom, where and from what.
    pub provenance: Provenance,
}

impl Made {
    /// The stored result, if there is one that is whole.
    #[must_use]
    pub fn find(store: &Store, id: &Id) -> Option<Self> {
        match store.find(id) {
            Found::Whole(folder) => Self::read(id, &folder).ok(),
            Found::Absent | Found::Damaged(_) => None,
        }
    }

    /// Stores a rendering and reads it back, so that what is judged does not
    /// depend on whether it was just made.
    ///
    /// # Errors
    /// If the store cannot be written or read.
    pub fn store(store: &Store, id: &Id, rendering: Rendering) -> Result<Self, Error> {
        let (layers, facts) = parts(rendering);
        let folder = store.put(id, |folder| {
            scenes::image::write_exr(&folder.join(IMAGE), &layers)?;
            let text = serde_json::to_vec(&facts).map_err(std::io::Error::from);
            text.and_then(|text| fs::write(folder.join(FACTS), text))
                .map_err(FileError::of(folder, CANNOT_BE_WRITTEN))?;
            Ok(())
        })?;
        Self::read(id, &folder)
    }

    /// Writes a rendering's layers to a file, with attributes, and reads them back.
    ///
    /// # Errors
    /// If the file cannot be written or read.
    pub fn write(
        id: Id,
        image: &Path,
        rendering: Rendering,
        attributes: &BTreeMap<String, String>,
    ) -> Result<Self, Error> {
        let (layers, facts) = parts(rendering);
        scenes::image::write_exr_with(image, &layers, attributes)?;
        Ok(Self { id, image: image.to_owned(), layers: scenes::image::read(image)?, facts })
    }

    /// An image that a study has kept, without what else was told of it.
    ///
    /// # Errors
    /// If the file cannot be read.
    pub fn kept(id: &str, image: &Path) -> Result<Self, Error> {
        let layers = scenes::image::read(image)?;
        Ok(Self { id: Id::known(id), image: image.to_owned(), layers, facts: Facts::default() })
    }

    fn read(id: &Id, folder: &Path) -> Result<Self, Error> {
        let image = folder.join(IMAGE);
        let failed = FileError::of(folder, "the cache cannot be read");
        let text = fs::read(folder.join(FACTS)).map_err(&failed)?;
        let facts = serde_json::from_slice(&text).map_err(|error| failed(error.into()))?;
        let layers = scenes::image::read(&image)?;
        Ok(Self { id: id.clone(), image, layers, facts })
    }
}

fn parts(rendering: Rendering) -> (Layers, Facts) {
    let Rendering { layers, passes, counters, plan, provenance } = rendering;
    (layers, Facts { passes, counters, plan, provenance })
}
