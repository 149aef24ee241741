//! From axes to the explicit list of jobs.

use super::externals::add_externals;
use super::job::job;
use super::variants::{product, variants};
use super::{Axes, Grid, Place, Sweep, Task, Variant};
use crate::Error;
use crate::study::Spec;
use scenes::Scene;
use std::collections::{BTreeMap, BTreeSet};

/// Most jobs of one study.
const MOST_JOBS: usize = 100_000;

/// Every job of a study, place by place.
///
/// # Errors
/// If axes name what does not exist, make no sense together, or come to too much.
pub fn expand(spec: &Spec) -> Result<Grid, Error> {
    let mut grid = Grid::default();
    let mut wanted: Vec<Vec<Variant>> = Vec::new();
    let mut known: BTreeMap<String, usize> = BTreeMap::new();
    let mut total = 0;
    for sweep in sweeps(spec) {
        let axes = overlaid(&spec.axes, &sweep.axes);
        let variants = variants(spec, &sweep, &axes)?;
        let places = places(spec, &sweep, &axes)?;
        total += places.len() * (variants.len() + 1);
        if total > MOST_JOBS {
            let what = format!("the study comes to more than {MOST_JOBS} jobs; vary less at once");
            return Err(Error::Usage(what));
        }
        for place in places {
            let key = format!("{} {:?} {:?}", place.scene, place.set, place.resolution_px);
            if let Some(index) = known.get(&key) {
                variants.iter().for_each(|variant| add(&mut wanted[*index], variant));
                continue;
            }
            known.insert(key, wanted.len());
            grid.places.push(place);
            wanted.push(variants.clone());
        }
    }
    label(spec, &mut grid.places);
    for (place, variants) in grid.places.iter_mut().zip(wanted) {
        let mut tasks = vec![Task::Exact];
        tasks.extend(variants.into_iter().map(Task::Method));
        place.jobs = tasks.into_iter().map(|task| job(spec, place, task, None)).collect();
    }
    add_externals(spec, &mut grid)?;
    // Jobs are numbered as they are listed.
    let all = grid.places.iter_mut().flat_map(|place| &mut place.jobs);
    all.enumerate().for_each(|(order, job)| job.order = order);
    Ok(grid)
}

/// The sweeps that were asked for and, for methods in none of them, a plain one.
fn sweeps(spec: &Spec) -> Vec<Sweep> {
    let in_sweep = |method: &String| {
        spec.sweeps.iter().any(|s| s.method.is_none() || s.method.as_ref() == Some(method))
    };
    let plain = spec.methods.iter().filter(|method| !in_sweep(method));
    let plain = plain.map(|method| Sweep { method: Some(method.clone()), ..Sweep::default() });
    let mut list: Vec<Sweep> = plain.collect();
    if list.is_empty() && spec.sweeps.is_empty() {
        list.push(Sweep::default());
    }
    list.extend(spec.sweeps.iter().cloned());
    list
}

/// The study's axes with those of a sweep in their place.
fn overlaid(whole: &Axes, own: &Axes) -> Axes {
    let mut axes = whole.clone();
    if !own.resolution_px.is_empty() {
        axes.resolution_px.clone_from(&own.resolution_px);
    }
    if !own.supersampling.is_empty() {
        axes.supersampling.clone_from(&own.supersampling);
    }
    axes.scene.extend(own.scene.clone());
    axes.param.retain(|knob| !own.param.iter().any(|other| other.name == knob.name));
    axes.param.extend(own.param.clone());
    axes
}

fn places(spec: &Spec, sweep: &Sweep, axes: &Axes) -> Result<Vec<Place>, Error> {
    let chosen = |scene: &Scene| sweep.scenes.is_empty() || sweep.scenes.contains(&scene.name);
    for name in &sweep.scenes {
        if !spec.scenes.iter().any(|scene| scene.name == *name) {
            let known: Vec<_> = spec.scenes.iter().map(|scene| scene.name.as_str()).collect();
            let what =
                format!("no scene of the study is called \"{name}\"; it has {}", known.join(", "));
            return Err(Error::Usage(what));
        }
    }
    if axes.scene.keys().any(|key| key.starts_with("camera.resolution_px")) {
        let what =
            "camera.resolution_px is set with --resolution WxH, or resolution in a study file";
        return Err(Error::Usage(what.to_owned()));
    }
    let lists: Vec<(&String, &Vec<f64>)> = axes.scene.iter().collect();
    let settings = product(&lists);
    let mut places = Vec::new();
    for (index, scene) in spec.scenes.iter().enumerate().filter(|(_, scene)| chosen(scene)) {
        let own = [scene.camera.resolution_px];
        let sizes = if axes.resolution_px.is_empty() { &own[..] } else { &axes.resolution_px };
        for set in &settings {
            for &resolution_px in sizes {
                let (label, jobs) = (String::new(), Vec::new());
                places.push(Place { scene: index, set: set.clone(), resolution_px, label, jobs });
            }
        }
    }
    Ok(places)
}

/// Adds a variant; of one that is there already, only what it is supersampled at.
fn add(list: &mut Vec<Variant>, variant: &Variant) {
    let same = |v: &&mut Variant| v.method == variant.method && v.param == variant.param;
    let Some(known) = list.iter_mut().find(same) else {
        list.push(variant.clone());
        return;
    };
    known.supersampling.extend(&variant.supersampling);
    known.supersampling.sort_unstable();
    known.supersampling.dedup();
}

/// Tries every number that is set, one by one, as is done before a study starts.
/// What runs one job of many leaves that to whoever listed them.
///
/// # Errors
/// If a number cannot be set.
pub fn check(spec: &Spec, grid: &Grid) -> Result<(), Error> {
    let mut tried: BTreeSet<(usize, &str, u64)> = BTreeSet::new();
    for place in &grid.places {
        for (key, value) in &place.set {
            if tried.insert((place.scene, key.as_str(), value.to_bits())) {
                spec.scenes[place.scene].with(&BTreeMap::from([(key.clone(), *value)]))?;
            }
        }
    }
    Ok(())
}

/// Names places by what tells them apart from the others of their scene.
fn label(spec: &Spec, places: &mut [Place]) {
    let scenes: Vec<(usize, [u32; 2])> =
        places.iter().map(|p| (p.scene, p.resolution_px)).collect();
    for place in places {
        let mut parts = vec![spec.scenes[place.scene].name.clone()];
        parts.extend(place.set.iter().map(|(key, value)| format!("{key}={value}")));
        let [width, height] = place.resolution_px;
        if scenes.iter().any(|(scene, size)| *scene == place.scene && *size != [width, height]) {
            parts.push(format!("{width}x{height}"));
        }
        place.label = parts.join(" ");
    }
}
