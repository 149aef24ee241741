//! A study over many processes and machines: a folder that each of them fills.
//!
//! A job's result is a folder named by its id, stored whole or not at all, so a job
//! that runs twice, or is killed and runs again, is there once. What the jobs are
//! is written down in the folder by whoever comes first.

use super::gather::Gallery;
use super::output::{FLIP, IMAGE};
use super::sweep::{Grid, Job, expand};
use super::{Means, Outcome, Spec, begin, do_jobs};
use crate::Error;
use crate::results::{NotDone, REFERENCE, ResultRow, Study};
use crate::study::cache::{Found, Id, Store};
use crate::support::files::{self, FileError};
use realtime::Gpu;
use serde::{Deserialize, Serialize};
use std::collections::BTreeSet;
use std::fs;
use std::path::{Path, PathBuf};
use std::time::Instant;

/// Schema of the list of jobs in a store.
const MANIFEST_SCHEMA: &str = "snell.manifest/1";
const MANIFEST: &str = "manifest.json";
const OUTCOME: &str = "outcome.json";
/// Folder of exact images inside a store, where no other cache is named.
const EXACT: &str = "exact";

/// The jobs of a study as they are written down in its store.
#[derive(Debug, PartialEq, Serialize, Deserialize)]
struct Manifest {
    schema: String,
    /// Hash of the ids of all jobs.
    study: String,
    budget_ms: Option<f64>,
    left_out: Vec<NotDone>,
    /// Per place, the ids and methods of its jobs.
    places: Vec<Vec<(String, String)>>,
}

/// Which jobs of a study are to be done.
#[derive(Clone, Debug, PartialEq)]
pub enum Share {
    /// All.
    All,
    /// Those of these ids.
    Ids(Vec<String>),
    /// Part `index`, from 0, of `count` parts of equal length. Jobs that need the
    /// same exact image stand together, so most parts trace few images.
    Part {
        /// Which part, from 0.
        index: usize,
        /// How many parts.
        count: usize,
    },
}

/// One job that a process has done, or found done.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Placed {
    /// Id of the job.
    pub id: String,
    /// Name of the scene.
    pub scene: String,
    /// Method, `reference` or the name of an external image.
    pub method: String,
    /// True if its result was in the store already.
    pub found: bool,
    /// Seconds that it took, with the exact image if that was not there.
    pub seconds: f64,
}

/// Does a share of the jobs of a study; results go to the store in a folder.
/// Results that are there already are not made again. `told` hears of each.
///
/// # Errors
/// If an id is no job of the study, the folder holds another study, or the disk or
/// the GPU does not do its part.
pub fn fill(
    spec: &Spec,
    share: &Share,
    gpu: &mut dyn FnMut() -> Result<Gpu, Error>,
    root: &Path,
    cache: Option<PathBuf>,
    told: &mut dyn FnMut(&Placed) -> Result<(), Error>,
) -> Result<(), Error> {
    let grid = expand(spec)?;
    let wanted = wanted(&grid, share)?;
    let store = Store::new(root.to_owned());
    let cache = Store::new(cache.unwrap_or_else(|| root.join(EXACT)));
    write_manifest(root, &manifest(spec, &grid))?;
    let mut missing = BTreeSet::new();
    for job in grid.jobs().filter(|job| wanted.contains(job.id.as_str())) {
        if matches!(store.find(&job.id), Found::Whole(_)) {
            told(&placed(job, true, 0.0))?;
        } else {
            missing.insert(job.id.to_string());
        }
    }
    let timed = |job: &Job| missing.contains(job.id.as_str()) && job.is_timed_on_gpu();
    let gpu = if grid.jobs().any(timed) { Some(gpu()?) } else { None };
    for place in &grid.places {
        let mut start = Instant::now();
        let mut deliver = |job: &Job, folder: &Path, outcome: Outcome| {
            store.put(&job.id, |partial| fill_folder(folder, partial, &outcome))?;
            let seconds = start.elapsed().as_secs_f64();
            start = Instant::now();
            told(&placed(job, false, seconds))
        };
        let chosen = |id: &Id| missing.contains(id.as_str());
        let (now, share) = (|_: &str| (), |_: f64| ());
        let means = Means { spec, gpu: gpu.as_ref(), cache: &cache, now: &now, share: &share };
        do_jobs(&means, place, &chosen, root, &mut deliver)?;
    }
    Ok(())
}

fn placed(job: &Job, found: bool, seconds: f64) -> Placed {
    let (scene, method) = (job.scene.clone(), job.method.clone());
    Placed { id: job.id.to_string(), scene, method, found, seconds }
}

/// Puts a job's files and what else it came to into a folder of the store.
fn fill_folder(from: &Path, to: &Path, outcome: &Outcome) -> Result<(), Error> {
    let failed = FileError::of(to, "the store cannot be written");
    for name in [IMAGE, FLIP] {
        if from.join(name).exists() {
            fs::copy(from.join(name), to.join(name)).map_err(&failed)?;
        }
    }
    let text = serde_json::to_vec(outcome).map_err(std::io::Error::from);
    Ok(text.and_then(|text| fs::write(to.join(OUTCOME), text)).map_err(&failed)?)
}

/// Ids of the jobs of a share.
fn wanted(grid: &Grid, share: &Share) -> Result<BTreeSet<String>, Error> {
    let all: Vec<&Job> = grid.jobs().collect();
    let ids = |jobs: &[&Job]| jobs.iter().map(|job| job.id.to_string()).collect();
    match share {
        Share::All => Ok(ids(&all)),
        Share::Part { index, count } => {
            let at = |part: usize| part * all.len() / count;
            Ok(ids(&all[at(*index)..at(*index + 1)]))
        }
        Share::Ids(wanted) => {
            let known: BTreeSet<String> = ids(&all);
            match wanted.iter().find(|id| !known.contains(*id)) {
                None => Ok(wanted.iter().cloned().collect()),
                Some(id) => Err(Error::Usage(format!(
                    "no job of the study has the id \"{id}\"\n`snell jobs` with the same study \
                     lists them; an id changes with the study, its files and the version of snell"
                ))),
            }
        }
    }
}

fn manifest(spec: &Spec, grid: &Grid) -> Manifest {
    let jobs = |place: &super::sweep::Place| {
        let jobs = place.jobs.iter();
        jobs.map(|job| (job.id.to_string(), job.method.clone())).collect::<Vec<_>>()
    };
    let places: Vec<Vec<(String, String)>> = grid.places.iter().map(jobs).collect();
    Manifest {
        schema: MANIFEST_SCHEMA.to_owned(),
        study: Id::of(&places).to_string(),
        budget_ms: spec.budget_ms,
        left_out: spec.left_out.clone(),
        places,
    }
}

/// Writes the list of jobs, or finds the same one there.
fn write_manifest(root: &Path, manifest: &Manifest) -> Result<(), Error> {
    let path = root.join(MANIFEST);
    if path.exists() {
        let other = read_manifest(root)?;
        return if other.study == manifest.study {
            Ok(())
        } else {
            Err(Error::Usage(format!(
                "{} holds the results of another study, or of other files or another version\n\
                 write another folder after -o",
                root.display()
            )))
        };
    }
    fs::create_dir_all(root).map_err(FileError::of(root, "cannot be made"))?;
    let text = serde_json::to_vec(manifest).map_err(std::io::Error::from);
    let text = text.map_err(FileError::unwritten(&path))?;
    Ok(files::write(&path, &text)?)
}

fn read_manifest(root: &Path) -> Result<Manifest, Error> {
    let path = root.join(MANIFEST);
    let failed = FileError::of(&path, "no list of jobs; `snell run STUDY -o STORE` writes it");
    let text = fs::read(&path).map_err(&failed)?;
    Ok(serde_json::from_slice(&text).map_err(|error| failed(error.into()))?)
}

/// Gathers the results of a store into the folder that `snell study` would have
/// left behind. With `partial`, what is missing is left out and named.
///
/// # Errors
/// If results are missing and that was not allowed, or a folder cannot be read or
/// written.
pub fn collect(
    root: &Path,
    out: &Path,
    partial: bool,
    command: &str,
) -> Result<(Study, Vec<ResultRow>), Error> {
    let manifest = read_manifest(root)?;
    let store = Store::new(root.to_owned());
    let all: Vec<&(String, String)> = manifest.places.iter().flatten().collect();
    let missing: Vec<&str> = all
        .iter()
        .map(|(id, _)| id.as_str())
        .filter(|id| !root.join(id).join(OUTCOME).exists())
        .collect();
    if !missing.is_empty() && !partial {
        let first = missing.iter().take(3).copied().collect::<Vec<_>>().join(", ");
        return Err(Error::Usage(format!(
            "{} of {} results are missing in {}, the first: {first}\nrun the same `snell run` again \
             for what is missing, or collect with --partial",
            missing.len(),
            all.len(),
            root.display()
        )));
    }
    let mut gallery = Gallery::of_places(manifest.places.len(), out);
    let mut made = Made::default();
    for (place, jobs) in manifest.places.iter().enumerate() {
        for (id, method) in jobs {
            let folder = root.join(id);
            match outcome(&store, id, &folder)? {
                Some(outcome) => {
                    made.note(&outcome);
                    gallery.take(method, place, &folder, outcome)?;
                }
                None => made.left_out.push(NotDone {
                    what: format!("job {id}, {method}"),
                    reason: "its result is not in the store".to_owned(),
                }),
            }
        }
    }
    let spec_left_out = manifest.left_out.into_iter().chain(made.left_out).collect();
    let study = Study {
        command: command.to_owned(),
        adapter: made.adapters.join("; "),
        driver: made.drivers.join("; "),
        software: made.software,
        left_out: spec_left_out,
        budget_ms: manifest.budget_ms,
        ..begin()
    };
    gallery.finish(study)
}

/// What the processes that filled a store say of themselves.
#[derive(Default)]
struct Made {
    adapters: Vec<String>,
    drivers: Vec<String>,
    software: bool,
    left_out: Vec<NotDone>,
}

impl Made {
    fn note(&mut self, outcome: &Outcome) {
        let methods = outcome.run.iter().any(|run| run.method != REFERENCE);
        if !methods || outcome.driver.is_empty() {
            return;
        }
        let row = outcome.rows.first();
        self.software |= row.is_some_and(|row| row.software);
        let adapter = row.map(|row| row.adapter.clone()).unwrap_or_default();
        for (list, name) in
            [(&mut self.adapters, adapter), (&mut self.drivers, outcome.driver.clone())]
        {
            if !list.contains(&name) {
                list.push(name);
            }
        }
    }
}

/// What a job came to, if its result is there and whole.
fn outcome(store: &Store, id: &str, folder: &Path) -> Result<Option<Outcome>, Error> {
    if !matches!(store.find(&Id::known(id)), Found::Whole(_)) {
        return Ok(None);
    }
    let failed = FileError::of(folder, "the store cannot be read");
    let text = fs::read(folder.join(OUTCOME)).map_err(&failed)?;
    Ok(serde_json::from_slice(&text).map(Some).map_err(|error| failed(error.into()))?)
}
