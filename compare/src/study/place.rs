//! What a study does at one place: trace the truth, then judge each method.

use super::judge::{Judge, times, times_with_all_kept};
use super::output::{FLIP, IMAGE};
use super::sweep::{Job, Place, Task, Variant, typed};
use super::{Outcome, Spec, external, output};
use crate::Error;
use crate::results::{
    Columns, FLIP_EXPOSURES, NotDone, REFERENCE, ResultRow, Run, Scalar, SceneEntry,
};
use crate::study::cache::Store;
use crate::study::jobs::{Approximation, Exact, Made, is_disjoint};
use realtime::{Gpu, Method};
use scenes::Scene;
use std::collections::BTreeMap;
use std::path::Path;

/// A cut weight that is cheap and visibly wrong: the left end of the curve.
const CHEAP_CUT: f64 = 1e-2;

/// A place with its scene, and the exact images that it needs.
pub(super) struct PlaceWork<'a> {
    spec: &'a Spec,
    place: &'a Place,
    scene: &'a Scene,
    truth: Exact<'a>,
    /// Cheaper images of the same, for the exact renderer's own curve.
    curve: Vec<Exact<'a>>,
}

impl<'a> PlaceWork<'a> {
    pub(super) fn new(spec: &'a Spec, place: &'a Place, scene: &'a Scene) -> Self {
        let (size, k) = (place.resolution_px, spec.positions_per_axis);
        let truth = Exact::truth(scene, size, k, spec.cut);
        let cheaper = [(1, CHEAP_CUT), (1, spec.cut), (2, spec.cut), (3, spec.cut)];
        let cheaper = &cheaper[..if spec.thorough { 4 } else { 3 }];
        let disjoint = cheaper.iter().filter(|(j, _)| is_disjoint(k, *j));
        let curve = disjoint.map(|(j, cut)| Exact::estimate(scene, size, *j, *cut)).collect();
        Self { spec, place, scene, truth, curve }
    }

    /// The image that methods are judged by.
    pub(super) fn truth(&self) -> &Exact<'a> {
        &self.truth
    }

    /// All exact images, the truth first.
    pub(super) fn exact(&self) -> impl Iterator<Item = &Exact<'a>> {
        std::iter::once(&self.truth).chain(&self.curve)
    }

    /// What its images are judged by. Exposures of FLIP are the same at every
    /// place of a scene: those of its file, or what the scene as it was written
    /// asks for.
    pub(super) fn judge<'t>(&self, truth: &'t Made) -> Result<Judge<'t>, Error> {
        Judge::new(&self.spec.scenes[self.place.scene], truth)
    }

    /// The truth's own times, and the exact renderer's curve of error against time.
    pub(super) fn exact_outcome(
        &self,
        truth: &Made,
        judge: &Judge,
        store: &Store,
        share: &(dyn Fn(f64) + Sync),
        folder: &Path,
    ) -> Result<Outcome, Error> {
        let entry = SceneEntry {
            name: self.place.label.clone(),
            scene: self.scene.name.clone(),
            set: self.place.set.clone(),
            title: self.scene.title.clone(),
            toml: self.scene.source.text.clone(),
            resolution_px: truth.layers.resolution_px,
            warnings: self.scene.warnings.clone(),
            flip_exposures: judge.exposures(),
        };
        let run = self.run(REFERENCE, truth, &self.truth.parameters());
        let common = self.common(&run, truth, judge, untyped(&run.parameters));
        output::write_image(&folder.join(IMAGE), &truth.layers, &common)?;
        let mut rows = times(&truth.facts.passes, &common);
        for job in &self.curve {
            let made = job.make(store, share)?;
            let parameters = job.parameters();
            let run = self.run(REFERENCE, &made, &parameters);
            let positions = job.request.view.positions_per_axis;
            let common = self.common(&run, &made, judge, untyped(&parameters));
            rows.extend(judge.curve_rows(&made, &ResultRow { positions, ..common })?);
        }
        let run = Run { image: IMAGE.into(), ..run };
        Ok(Outcome { entry: Some(entry), run: Some(run), rows, ..Outcome::default() })
    }

    /// Draws, judges and times a method.
    pub(super) fn method_outcome(
        &self,
        job: &Job,
        variant: &Variant,
        judge: &Judge,
        gpu: &Gpu,
        folder: &Path,
    ) -> Result<Outcome, Error> {
        match self.judged(job, variant, judge, gpu, folder) {
            Ok(outcome) => Ok(outcome),
            Err(Error::Realtime(reason)) => {
                let what = format!("{} × {}", self.place.label, name_of(variant));
                let left_out = vec![NotDone { what, reason: reason.to_string() }];
                Ok(Outcome { left_out, ..Outcome::default() })
            }
            Err(error) => Err(error),
        }
    }

    fn judged(
        &self,
        job: &Job,
        variant: &Variant,
        judge: &Judge,
        gpu: &Gpu,
        folder: &Path,
    ) -> Result<Outcome, Error> {
        let method = Method::find(&variant.method)?;
        let view = &self.truth.request.view;
        let parameters: BTreeMap<String, String> =
            variant.set.iter().map(|(name, value)| (name.clone(), value.to_string())).collect();
        let asked =
            Approximation::judged(self.scene, view, method.id, parameters, self.spec.timing_s);
        let named = ResultRow {
            id: job.id.to_string(),
            scene: self.scene.name.clone(),
            method: method.id.to_owned(),
            columns: self.columns(judge, BTreeMap::new()),
            positions: view.positions_per_axis,
            ..ResultRow::default()
        };
        let made = asked.make(gpu, &folder.join(IMAGE), output::attributes(&named))?;
        let parameters = &made.facts.provenance.parameters;
        let mut run = Run {
            id: job.id.to_string(),
            image: IMAGE.into(),
            ..self.run(method.id, &made, parameters)
        };
        let common = self.common(&run, &made, judge, typed(method, parameters));
        let judged = judge.judged(&made, &common)?;
        let mut rows = judged.rows;
        for &k in &variant.supersampling {
            let common = ResultRow { positions: k, ..common.clone() };
            let passes =
                if k == 1 { made.facts.passes.clone() } else { asked.timed_at(k).passes(gpu)? };
            rows.extend(times(&passes, &common));
            if k != view.positions_per_axis {
                let layers = asked.light_at(k).layers(gpu)?;
                rows.extend(judge.pixel_integral_rows(&layers, &common)?);
            }
        }
        if let Some(full) = if self.spec.thorough { asked.with_all_kept()? } else { None } {
            let common = ResultRow { positions: 1, ..common.clone() };
            rows.extend(times_with_all_kept(&full.passes(gpu)?, &common));
        }
        run.metrics_left_out = judged.left_out;
        if let Some(map) = judged.flip_map {
            run.flip_map = FLIP.into();
            output::write_flip(&folder.join(FLIP), &common, map)?;
        }
        let driver = made.facts.provenance.driver.clone();
        Ok(Outcome { run: Some(run), rows, driver, ..Outcome::default() })
    }

    /// Judges an image that somebody else made.
    pub(super) fn external_outcome(
        &self,
        job: &Job,
        index: usize,
        truth: &Made,
        judge: &Judge,
        folder: &Path,
    ) -> Result<Outcome, Error> {
        let external = &self.spec.externals[index];
        let run = Run {
            id: job.id.to_string(),
            scene: self.place.label.clone(),
            method: external.name.clone(),
            positions: self.spec.positions_per_axis,
            image: IMAGE.into(),
            ..Run::default()
        };
        let [width_px, height_px] = self.place.resolution_px;
        let common = ResultRow {
            id: run.id.clone(),
            scene: self.scene.name.clone(),
            method: run.method.clone(),
            columns: self.columns(judge, BTreeMap::new()),
            positions: run.positions,
            width_px,
            height_px,
            adapter: external.adapter.clone(),
            ..ResultRow::default()
        };
        external::outcome(external, run, &common, truth, judge, folder)
    }

    /// A run that has no image yet.
    fn run(&self, method: &str, made: &Made, parameters: &BTreeMap<String, String>) -> Run {
        Run {
            id: made.id.to_string(),
            scene: self.place.label.clone(),
            method: method.to_owned(),
            positions: self.spec.positions_per_axis,
            parameters: parameters.clone(),
            plan: made.facts.plan.clone(),
            passes: made.facts.passes.clone(),
            counters: made.facts.counters.clone(),
            ..Run::default()
        }
    }

    /// What every row of a run shares.
    fn common(
        &self,
        run: &Run,
        made: &Made,
        judge: &Judge,
        param: BTreeMap<String, Scalar>,
    ) -> ResultRow {
        let [width_px, height_px] = made.layers.resolution_px;
        ResultRow {
            id: run.id.clone(),
            scene: self.scene.name.clone(),
            method: run.method.clone(),
            columns: self.columns(judge, param),
            positions: run.positions,
            width_px,
            height_px,
            seed: made.facts.provenance.seed,
            adapter: made.facts.provenance.adapter.clone(),
            software: made.facts.provenance.software,
            ..ResultRow::default()
        }
    }

    fn columns(&self, judge: &Judge, param: BTreeMap<String, Scalar>) -> Columns {
        let mut columns = Columns::new(&param, &self.place.set);
        if let Some((start, stop, count)) = judge.exposures() {
            for (name, value) in [("start", start), ("stop", stop), ("count", f64::from(count))] {
                columns.0.insert(format!("{FLIP_EXPOSURES}{name}"), Scalar::Number(value));
            }
        }
        columns
    }
}

/// A variant as people read it: the method and what is set.
fn name_of(variant: &Variant) -> String {
    let set = variant.set.iter().map(|(name, value)| format!(" {name}={value}"));
    std::iter::once(variant.method.clone()).chain(set).collect()
}

fn untyped(parameters: &BTreeMap<String, String>) -> BTreeMap<String, Scalar> {
    parameters.iter().map(|(name, value)| (name.clone(), Scalar::read(value))).collect()
}

/// Does a job whose place has its truth.
pub(super) struct Bench<'a, 'w> {
    pub(super) work: &'w PlaceWork<'a>,
    pub(super) truth: &'w Made,
    pub(super) judge: &'w Judge<'w>,
    pub(super) store: &'w Store,
    pub(super) gpu: Option<&'w Gpu>,
}

impl Bench<'_, '_> {
    /// Does one job; its files go to a folder.
    pub(super) fn outcome(
        &self,
        job: &Job,
        share: &(dyn Fn(f64) + Sync),
        folder: &Path,
    ) -> Result<Outcome, Error> {
        let Bench { work, truth, judge, store, gpu } = self;
        match &job.task {
            Task::Exact => work.exact_outcome(truth, judge, store, share, folder),
            Task::Method(variant) => match gpu {
                Some(gpu) => work.method_outcome(job, variant, judge, gpu, folder),
                None => Err(Error::Usage("a method needs a GPU, and none was opened".to_owned())),
            },
            Task::External(index) => work.external_outcome(job, *index, truth, judge, folder),
        }
    }
}
