//! From what jobs came to, to the folder that a study leaves behind.

use super::output;
use super::{Outcome, readings};
use crate::Error;
use crate::metric::{Mask, Metric};
use crate::results::{NotDone, REFERENCE, ResultRow, Run, SceneEntry, Study};
use std::collections::BTreeMap;
use std::path::{Path, PathBuf};

/// Most places of a study whose images are kept and shown.
const MOST_PICTURED: usize = 8;

/// Results as they come in, in the order of the jobs. Of each method at each place
/// the image with the least error is kept, of places at most
/// [`MOST_PICTURED`], spread over all.
pub(super) struct Gallery {
    out: PathBuf,
    pictured: Vec<bool>,
    entries: Vec<SceneEntry>,
    runs: Vec<Run>,
    rows: Vec<ResultRow>,
    left_out: Vec<NotDone>,
    /// Per place and method: the least error so far, and the run that has it.
    best: BTreeMap<(usize, String), (f64, usize)>,
}

impl Gallery {
    /// For the results of so many places, in a folder.
    pub(super) fn of_places(count: usize, out: &Path) -> Self {
        let shown = |i: usize| count <= MOST_PICTURED || i * MOST_PICTURED % count < MOST_PICTURED;
        Self {
            out: out.to_owned(),
            pictured: (0..count).map(shown).collect(),
            entries: Vec::new(),
            runs: Vec::new(),
            rows: Vec::new(),
            left_out: Vec::new(),
            best: BTreeMap::new(),
        }
    }

    /// Takes what a job came to, and its images out of its folder.
    pub(super) fn take(
        &mut self,
        method: &str,
        place: usize,
        folder: &Path,
        outcome: Outcome,
    ) -> Result<(), Error> {
        let Outcome { entry, run, rows, left_out, .. } = outcome;
        self.entries.extend(entry);
        self.left_out.extend(left_out);
        if let Some(run) = run {
            self.hang(method, place, folder, run, &rows)?;
        }
        self.rows.extend(rows);
        Ok(())
    }

    /// Keeps the images of a run if they are to be shown.
    fn hang(
        &mut self,
        method: &str,
        place: usize,
        folder: &Path,
        mut run: Run,
        rows: &[ResultRow],
    ) -> Result<(), Error> {
        let key = (place, method.to_owned());
        let (error, before) = (error(rows), self.best.get(&key).copied());
        let better = before.is_none_or(|(least, _)| error < least);
        if self.pictured.get(place) == Some(&true) && better {
            output::keep(&mut run, folder, &self.out)?;
            if let Some((_, loser)) = before {
                forget(&mut self.runs[loser]);
            }
            self.best.insert(key, (error, self.runs.len()));
        } else {
            forget(&mut run);
        }
        self.runs.push(run);
        Ok(())
    }

    /// Writes the results and the report.
    pub(super) fn finish(self, study: Study) -> Result<(Study, Vec<ResultRow>), Error> {
        let Self { out, entries, runs, rows, mut left_out, .. } = self;
        left_out.splice(0..0, study.left_out.iter().cloned());
        if runs.iter().all(|run| run.method == REFERENCE) {
            return Err(Error::NothingDone(left_out));
        }
        let clock = if study.software { "time_wall_ms" } else { "time_timestamp_ms" };
        let mut study =
            Study { time_metric: clock.to_owned(), scenes: entries, runs, left_out, ..study };
        study.readings = readings::readings(&study, &rows);
        output::write(&out, &study, &rows)?;
        Ok((study, rows))
    }
}

/// A run whose images are not kept.
fn forget(run: &mut Run) {
    (run.image, run.flip_map) = (PathBuf::new(), PathBuf::new());
}

/// What settings of a method are told apart by: robust against a few pixels.
fn error(rows: &[ResultRow]) -> f64 {
    let metric = Metric::RelMseTrimmed.describe().name;
    let row = rows.iter().find(|row| row.metric == metric && row.mask == Mask::All);
    row.and_then(|row| row.value).unwrap_or(f64::INFINITY)
}
