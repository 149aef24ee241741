//! From axes to the explicit list of jobs.

use super::job::Asked;
use super::{Axes, External, Grid, Job, Knob, Place, Sweep, Task, Variant};
use crate::Error;
use crate::results::{Columns, REFERENCE, Scalar};
use crate::study::Spec;
use crate::study::cache::{Id, hex};
use crate::support::files::FileError;
use realtime::Method;
use realtime::methods::{Kind, Settings};
use scenes::Scene;
use scenes::image::Alpha;
use sha2::{Digest, Sha256};
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

/// Every combination of one value of each list; one empty one if there is none.
fn product<T: Clone>(lists: &[(&String, &Vec<T>)]) -> Vec<BTreeMap<String, T>> {
    lists.iter().fold(vec![BTreeMap::new()], |all, (name, values)| {
        let with = |one: &BTreeMap<String, T>, value: &T| {
            let mut one = one.clone();
            one.insert((*name).clone(), value.clone());
            one
        };
        let with = &with;
        all.iter().flat_map(|one| values.iter().map(move |value| with(one, value))).collect()
    })
}

fn variants(spec: &Spec, sweep: &Sweep, axes: &Axes) -> Result<Vec<Variant>, Error> {
    let methods: Vec<&String> = match &sweep.method {
        Some(method) => vec![method],
        None => spec.methods.iter().collect(),
    };
    let mut owned: Vec<(&Knob, String)> = Vec::new();
    for knob in &axes.param {
        match owner(knob, spec, sweep)? {
            Some(owner) => owned.push((knob, owner)),
            // A sweep of one method has nothing to do with another's knobs.
            None => continue,
        }
    }
    let supersampling =
        if axes.supersampling.is_empty() { vec![1] } else { axes.supersampling.clone() };
    let mut list = Vec::new();
    for id in methods {
        let own = owned.iter().filter(|(_, owner)| owner == id);
        let lists: Vec<_> = own.map(|(knob, _)| (&knob.name, &knob.values)).collect();
        let method = Method::find(id)?;
        for set in product(&lists) {
            let param = all_parameters(method, &set)?;
            let supersampling = supersampling.clone();
            list.push(Variant { method: id.clone(), set, param, supersampling });
        }
    }
    Ok(list)
}

/// The method that a knob turns, `None` if it turns none of this sweep.
fn owner(knob: &Knob, spec: &Spec, sweep: &Sweep) -> Result<Option<String>, Error> {
    let fail = |what: String| Err(Error::Usage(what));
    let has = |id: &str| -> Result<bool, Error> {
        Ok(Method::find(id)?.parameters.iter().any(|parameter| parameter.name == knob.name))
    };
    let known = |id: &str| -> Result<String, Error> {
        let names: Vec<_> = Method::find(id)?.parameters.iter().map(|p| p.name).collect();
        Ok(if names.is_empty() { "none".to_owned() } else { names.join(", ") })
    };
    if let Some(method) = &knob.method {
        let id = Method::find(method)?.id.to_owned();
        if !has(&id)? {
            return fail(format!(
                "{id} has no parameter \"{}\"; it has {}",
                knob.name,
                known(&id)?
            ));
        }
        if !spec.methods.contains(&id) {
            return fail(format!("{id}.{} is set, and {id} is not in the study", knob.name));
        }
        let here = sweep.method.as_ref().is_none_or(|method| *method == id);
        return Ok(here.then_some(id));
    }
    if let Some(method) = &sweep.method {
        let of_sweep = sweep.axes.param.contains(knob);
        if of_sweep && !has(method)? {
            let (name, there) = (&knob.name, known(method)?);
            return fail(format!("{method} has no parameter \"{name}\"; it has {there}"));
        }
        if of_sweep {
            return Ok(Some(method.clone()));
        }
    }
    let mut owners = Vec::new();
    for id in &spec.methods {
        if has(id)? {
            owners.push(id.clone());
        }
    }
    match &owners[..] {
        [] => fail(format!("no method of the study has a parameter \"{}\"", knob.name)),
        [one] => Ok(sweep.method.as_ref().is_none_or(|m| m == one).then(|| one.clone())),
        several => {
            let names: Vec<_> = several.iter().map(|id| format!("{id}.{}", knob.name)).collect();
            fail(format!(
                "\"{}\" is a parameter of several methods; write {}",
                knob.name,
                names.join(" or ")
            ))
        }
    }
}

/// Every parameter with its type, those that are not set at their defaults.
fn all_parameters(
    method: &Method,
    set: &BTreeMap<String, Scalar>,
) -> Result<BTreeMap<String, Scalar>, Error> {
    let text = set.iter().map(|(name, value)| (name.clone(), value.to_string())).collect();
    Ok(typed(method, &Settings::new(method, &text)?.describe()))
}

/// Parameters as numbers where they are numbers.
pub(in crate::study) fn typed(
    method: &Method,
    text: &BTreeMap<String, String>,
) -> BTreeMap<String, Scalar> {
    let is_number = |name: &str| {
        let parameter = method.parameters.iter().find(|parameter| parameter.name == name);
        parameter.is_some_and(|parameter| matches!(parameter.kind, Kind::Number { .. }))
    };
    let value = |name: &str, text: &String| match is_number(name) {
        true => Scalar::read(text),
        false => Scalar::Word(text.clone()),
    };
    text.iter().map(|(name, text)| (name.clone(), value(name, text))).collect()
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
            if key.starts_with("camera.resolution_px") {
                let what = "camera.resolution_px is set with --resolution WxH, or resolution in a study file";
                return Err(Error::Usage(what.to_owned()));
            }
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

fn job(spec: &Spec, place: &Place, task: Task, of_image: Option<&str>) -> Job {
    let scene = &spec.scenes[place.scene];
    let nothing = BTreeMap::new();
    let external = |index: &usize| spec.externals.get(*index);
    let (method, param, supersampling): (&str, _, &[u32]) = match &task {
        Task::Exact => (REFERENCE, &nothing, &[]),
        Task::Method(variant) => (&variant.method, &variant.param, &variant.supersampling),
        Task::External(index) => (external(index).map_or("", |e| &e.name), &nothing, &[]),
    };
    let of_file = Method::find(method).ok().and_then(Method::file_text);
    let gpu = if matches!(task, Task::Method(_)) { env!("SNELL_REALTIME_SOURCES") } else { "" };
    let asked = Asked {
        version: env!("CARGO_PKG_VERSION"),
        sources: [env!("SNELL_EXACT_SOURCES"), gpu],
        name: &scene.name,
        scene: &scene.source.sha256,
        set: &place.set,
        resolution_px: place.resolution_px,
        positions: spec.positions_per_axis,
        cut: spec.cut,
        timing_s: spec.timing_s,
        thorough: spec.thorough,
        method,
        text: of_image.or(of_file),
        param,
        supersampling,
        milliseconds: match &task {
            Task::External(index) => external(index).and_then(|e| e.milliseconds),
            _ => None,
        },
    };
    Job {
        id: Id::of(&asked),
        order: 0,
        scene: scene.name.clone(),
        method: method.to_owned(),
        columns: Columns::new(param, &place.set),
        resolution_px: place.resolution_px,
        positions: spec.positions_per_axis,
        task,
    }
}

/// Images of others belong to the place of their scene that is as large as they.
fn add_externals(spec: &Spec, grid: &mut Grid) -> Result<(), Error> {
    for (index, external) in spec.externals.iter().enumerate() {
        let refuse = |what: String| Error::Usage(format!("{}: {what}", external.name));
        check_name(external, spec, index).map_err(refuse)?;
        let bytes = std::fs::read(&external.image)
            .map_err(FileError::of(&external.image, "cannot be read"))?;
        let size = scenes::image::open(&external.image, Alpha::OverBlack)?.layers.resolution_px;
        let of_scene = |place: &&mut Place| {
            let name = &spec.scenes[place.scene].name;
            external.scene.as_ref().is_none_or(|wanted| wanted == name)
        };
        if external.scene.is_none() && spec.scenes.len() > 1 {
            return Err(refuse("the study has several scenes; say which one it shows".to_owned()));
        }
        let mut of_scene: Vec<&mut Place> = grid.places.iter_mut().filter(of_scene).collect();
        let sizes: Vec<String> = of_scene
            .iter()
            .map(|place| place.resolution_px.map(|n| n.to_string()).join("x"))
            .collect();
        let [width, height] = size;
        let fits = |place: &&mut &mut Place| place.resolution_px == size && place.set.is_empty();
        let place = of_scene.iter_mut().find(fits).ok_or_else(|| {
            refuse(format!(
                "the image is {width}x{height}, and the study has that scene at {}; add \
                 --resolution {width}x{height}",
                if sizes.is_empty() { "no size".to_owned() } else { sizes.join(", ") }
            ))
        })?;
        let hash = hex(&Sha256::digest(&bytes));
        let job = job(spec, place, Task::External(index), Some(&hash));
        place.jobs.push(job);
    }
    Ok(())
}

fn check_name(external: &External, spec: &Spec, index: usize) -> Result<(), String> {
    let name = &external.name;
    let plain = |c: char| c.is_ascii_alphanumeric() || "-_.".contains(c);
    if name.is_empty() || !name.chars().all(plain) {
        return Err("a name is letters, digits, `-`, `_` and `.`".to_owned());
    }
    let taken = name == REFERENCE || Method::find(name).is_ok();
    let twice =
        spec.externals[..index].iter().any(|e| e.name == *name && e.scene == external.scene);
    if taken || twice {
        return Err("the name is taken; choose another".to_owned());
    }
    match external.milliseconds {
        Some(ms) if !(ms.is_finite() && ms > 0.0) => Err(format!("{ms} ms is no time of a frame")),
        _ => Ok(()),
    }
}
