//! What a study does with one scene: trace it, then judge each method.

use super::judge::{Judge, times, times_with_all_kept};
use super::{Spec, output};
use crate::Error;
use crate::results::{NotDone, REFERENCE, ResultRow, Run, SceneEntry, Study};
use crate::study::cache::Store;
use crate::study::jobs::{Approximation, Exact, Made, is_disjoint};
use crate::support::files;
use realtime::Gpu;
use scenes::Scene;
use std::collections::BTreeMap;

/// A cut weight that is cheap and visibly wrong: the left end of the curve.
const CHEAP_CUT: f64 = 1e-2;

/// Everything exact that a scene needs.
pub(super) struct SceneWork<'a> {
    scene: &'a Scene,
    truth: Exact<'a>,
    /// Cheaper images of the same, for the exact renderer's own curve.
    curve: Vec<Exact<'a>>,
}

/// The images that a [`SceneWork`] comes to.
pub(super) struct Traced {
    truth: Made,
    curve: Vec<Made>,
}

impl<'a> SceneWork<'a> {
    pub(super) fn new(scene: &'a Scene, spec: &Spec) -> Self {
        let size = spec.resolution_px.unwrap_or(scene.camera.resolution_px);
        let k = spec.positions_per_axis;
        let truth = Exact::truth(scene, size, k, spec.cut);
        let cheaper = [(1, CHEAP_CUT), (1, spec.cut), (2, spec.cut), (3, spec.cut)];
        let cheaper = &cheaper[..if spec.thorough { 4 } else { 3 }];
        let disjoint = cheaper.iter().filter(|(j, _)| is_disjoint(k, *j));
        let curve = disjoint.map(|(j, cut)| Exact::estimate(scene, size, *j, *cut)).collect();
        Self { scene, truth, curve }
    }

    pub(super) fn name(&self) -> String {
        self.scene.name.clone()
    }

    /// The image that methods are judged by.
    pub(super) fn truth(&self) -> &Exact<'a> {
        &self.truth
    }

    /// All jobs, the truth first.
    pub(super) fn exact(&self) -> impl Iterator<Item = &Exact<'a>> {
        std::iter::once(&self.truth).chain(&self.curve)
    }

    /// Traces what the store does not have. `now` is told what is being done,
    /// `share` how much of this scene is done, 0 to 1.
    pub(super) fn trace(
        &self,
        store: &Store,
        now: &dyn Fn(&str),
        share: &(dyn Fn(f64) + Sync),
    ) -> Result<Traced, Error> {
        let all: f64 = self.exact().map(Exact::camera_rays).sum();
        let mut before = 0.0;
        let mut make = |job: &Exact| {
            now(&format!("{}: tracing", self.scene.name));
            let made = job.make(store, &|part| share((before + part * job.camera_rays()) / all));
            before += job.camera_rays();
            made
        };
        let truth = make(&self.truth)?;
        let curve = self.curve.iter().map(make).collect::<Result<_, _>>()?;
        Ok(Traced { truth, curve })
    }

    /// Renders and judges every method, and adds the results.
    pub(super) fn judge(
        &self,
        traced: &Traced,
        spec: &Spec,
        gpu: &Gpu,
        now: &dyn Fn(&str),
        study: &mut Study,
        rows: &mut Vec<ResultRow>,
    ) -> Result<(), Error> {
        let Traced { truth, curve } = traced;
        let judge = Judge::new(self.scene, truth);
        study.scenes.push(SceneEntry {
            name: self.name(),
            title: self.scene.title.clone(),
            toml: self.scene.source.text.clone(),
            resolution_px: truth.layers.resolution_px,
            flip_exposures: judge.exposures(),
        });
        let place = output::image_place(&self.scene.name, REFERENCE);
        output::copy_image(truth, &spec.out.join(&place))?;
        let run = Run { image: place, ..self.run(REFERENCE, truth, &self.truth.parameters()) };
        rows.extend(times(&truth.facts.passes, &common(&run, truth)));
        study.runs.push(run);
        for (job, made) in self.curve.iter().zip(curve) {
            let run = self.run(REFERENCE, made, &job.parameters());
            rows.extend(judge.curve_rows(made, &common(&run, made))?);
        }
        for method in &spec.methods {
            now(&format!("{}: {method}", self.scene.name));
            let view = &self.truth.request.view;
            let job = Approximation::judged(self.scene, view, method, spec.timing_s);
            let place = output::image_place(&self.scene.name, method);
            let image = spec.out.join(&place);
            files::make_folder_of(&image)?;
            match job.make(gpu, &image) {
                Ok(made) => {
                    let parameters = &made.facts.provenance.parameters;
                    let mut run = Run { image: place, ..self.run(method, &made, parameters) };
                    let common = common(&run, &made);
                    let judged = judge.judged(&made, &common)?;
                    rows.extend(judged.rows);
                    let kept = if spec.thorough { job.with_all_kept()? } else { None };
                    if let Some(full) = kept {
                        rows.extend(times_with_all_kept(&full.passes(gpu)?, &common));
                    }
                    run.metrics_left_out = judged.left_out;
                    if let Some(map) = judged.flip_map {
                        run.flip_map = run.image.with_extension("flip.exr");
                        let path = spec.out.join(&run.flip_map);
                        output::write_flip(&path, made.layers.resolution_px, map)?;
                    }
                    study.runs.push(run);
                }
                Err(Error::Realtime(reason)) => study.left_out.push(NotDone {
                    what: format!("{} × {method}", self.scene.name),
                    reason: reason.to_string(),
                }),
                Err(error) => return Err(error),
            }
        }
        Ok(())
    }

    /// A run without an image of its own in the folder of the study.
    fn run(&self, method: &str, made: &Made, parameters: &BTreeMap<String, String>) -> Run {
        Run {
            id: made.id.to_string(),
            scene: self.name(),
            method: method.to_owned(),
            parameters: parameters.clone(),
            plan: made.facts.plan.clone(),
            passes: made.facts.passes.clone(),
            counters: made.facts.counters.clone(),
            ..Run::default()
        }
    }
}

/// What every row of a run shares.
fn common(run: &Run, made: &Made) -> ResultRow {
    let [width_px, height_px] = made.layers.resolution_px;
    ResultRow {
        id: run.id.clone(),
        scene: run.scene.clone(),
        method: run.method.clone(),
        parameters: run.parameters.clone(),
        width_px,
        height_px,
        seed: made.facts.provenance.seed,
        adapter: made.facts.provenance.adapter.clone(),
        software: made.facts.provenance.software,
        ..ResultRow::default()
    }
}
