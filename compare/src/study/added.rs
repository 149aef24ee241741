//! Images of others, added to a study that is finished.

use super::external;
use super::jobs::Made;
use super::judge::Judge;
use super::sweep::External;
use super::{Outcome, output};
use crate::Error;
use crate::results::{
    Columns, FLIP_EXPOSURES, REFERENCE, ResultRow, Run, Scalar, SceneEntry, Study, read_rows,
    read_study,
};
use crate::study::cache::Id;
use crate::study::readings;
use crate::support::files::FileError;
use scenes::image::Alpha;
use std::collections::BTreeMap;
use std::path::Path;

/// Judges images against the truths that a study kept, adds their rows, and writes
/// the results and the report again.
///
/// # Errors
/// If the folder holds no study, a name is taken, or an image fits no place of it.
pub fn add(directory: &Path, externals: &[External]) -> Result<(), Error> {
    let (mut study, mut rows) = (read_study(directory)?, read_rows(directory)?);
    for external in externals {
        let refuse = |what: String| Error::Usage(format!("{}: {what}", external.name));
        if study.runs.iter().any(|run| run.method == external.name) {
            return Err(refuse("the study has a method or an image of that name".to_owned()));
        }
        let size = scenes::image::open(&external.image, Alpha::OverBlack)?.layers.resolution_px;
        let entry = place(&study, external, size).map_err(refuse)?.clone();
        let (run, found) = judged(directory, &study, &entry, external)?;
        rows.extend(found);
        study.runs.push(run);
    }
    study.readings = readings::readings(&study, &rows);
    output::write(directory, &study, &rows)
}

/// The place that an image shows: of its scene and size, as the scene was written.
fn place<'a>(
    study: &'a Study,
    external: &External,
    size: [u32; 2],
) -> Result<&'a SceneEntry, String> {
    let of_scene =
        |entry: &&SceneEntry| external.scene.as_ref().is_none_or(|wanted| wanted == entry.scene());
    let of_scene: Vec<&SceneEntry> = study.scenes.iter().filter(of_scene).collect();
    let several = of_scene.iter().any(|entry| entry.scene() != of_scene[0].scene());
    if several {
        return Err("the study has several scenes; write SCENE:NAME=FILE".to_owned());
    }
    let fits = |entry: &&&SceneEntry| entry.resolution_px == size && entry.set.is_empty();
    of_scene.iter().find(fits).copied().ok_or_else(|| {
        let sizes =
            of_scene.iter().map(|entry| entry.resolution_px.map(|n| n.to_string()).join("x"));
        let sizes = sizes.collect::<Vec<_>>().join(", ");
        format!("the image is {}x{}, and the study has that scene at {sizes}", size[0], size[1])
    })
}

fn judged(
    directory: &Path,
    study: &Study,
    entry: &SceneEntry,
    external: &External,
) -> Result<(Run, Vec<ResultRow>), Error> {
    let exact = |run: &&Run| run.scene == entry.name && run.method == REFERENCE;
    let exact = study.runs.iter().find(exact);
    let kept = exact.filter(|run| !run.image.as_os_str().is_empty()).ok_or_else(|| {
        Error::Usage(format!("the study has not kept the exact image of {}", entry.name))
    })?;
    let truth = Made::kept(&kept.id, &directory.join(&kept.image))?;
    let judge = Judge::at(entry.flip_exposures, &truth);
    let asked = (&kept.id, &external.name, external.milliseconds, &external.adapter);
    let run = Run {
        id: Id::of(&asked).to_string(),
        scene: entry.name.clone(),
        method: external.name.clone(),
        positions: kept.positions,
        ..Run::default()
    };
    let mut columns = Columns::new(&BTreeMap::new(), &entry.set);
    if let Some((start, stop, count)) = entry.flip_exposures {
        for (name, value) in [("start", start), ("stop", stop), ("count", f64::from(count))] {
            columns.0.insert(format!("{FLIP_EXPOSURES}{name}"), Scalar::Number(value));
        }
    }
    let [width_px, height_px] = entry.resolution_px;
    let common = ResultRow {
        id: run.id.clone(),
        scene: entry.scene().to_owned(),
        method: run.method.clone(),
        columns,
        positions: run.positions,
        width_px,
        height_px,
        adapter: external.adapter.clone(),
        ..ResultRow::default()
    };
    let folder =
        tempfile::tempdir_in(directory).map_err(FileError::of(directory, "cannot be written"))?;
    let outcome = external::outcome(external, run, &common, &truth, &judge, folder.path())?;
    let Outcome { run, rows, .. } = outcome;
    let mut run = run.unwrap_or_default();
    output::keep(&mut run, folder.path(), directory)?;
    Ok((run, rows))
}
