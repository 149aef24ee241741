//! A small made-up study: a glass ball whose exact and approximate images are
//! closed forms.

use compare::metric::{Candidate, Exposures, Mask, Reference, Selection, judge};
use compare::results::{
    Columns, FLIP_LAYER, NotDone, RESULT_SCHEMA, ResultRow, RowKind, Run, STUDY_SCHEMA, Scalar,
    SceneEntry, Study, write_rows, write_study,
};
use glam::DVec3;
use scenes::rendering::{Pass, Time, TimeSource};
use scenes::{LayerName, Layers, Plan};
use std::collections::BTreeMap;
use std::path::{Path, PathBuf};

pub(crate) const SIZE: usize = 192;

/// A blue sky over a chequered ground, with a sun.
fn sky(d: DVec3) -> DVec3 {
    if d.dot(DVec3::new(0.4, 0.7, -0.6).normalize()) > 0.995 {
        return DVec3::new(60.0, 50.0, 40.0);
    }
    if d.y >= 0.0 {
        return DVec3::new(0.35, 0.55, 0.9).lerp(DVec3::ONE, (1.0 - d.y).powi(3));
    }
    let at = d / -d.y;
    let odd = ((2.0 * at.x).floor() + (2.0 * at.z).floor()).rem_euclid(2.0) > 0.5;
    let tile = if odd { 0.08 } else { 0.6 };
    DVec3::new(tile, 0.9 * tile, 0.7 * tile).lerp(DVec3::splat(0.5), (1.0 + d.y).powi(8))
}

fn refract(d: DVec3, n: DVec3, eta_i_over_t: f64) -> DVec3 {
    let cos_i = -d.dot(n);
    let cos_t = (1.0 - eta_i_over_t * eta_i_over_t * (1.0 - cos_i * cos_i)).max(0.0).sqrt();
    (eta_i_over_t * d + (eta_i_over_t * cos_i - cos_t) * n).normalize()
}

/// The ball after `interfaces` refractions (0 to 2), orthographic.
pub(crate) fn ball(interfaces: u32) -> Layers {
    let (mut radiance, mut exit, mut coverage) = (Vec::new(), Vec::new(), Vec::new());
    for pixel in 0..SIZE * SIZE {
        let centre = |i: usize| 2.4 * ((i as f64 + 0.5) / SIZE as f64 - 0.5);
        let (x, y) = (centre(pixel % SIZE), -centre(pixel / SIZE));
        let straight = DVec3::new(0.0, -0.2, -1.0).normalize();
        let inside = x * x + y * y < 1.0;
        let mut d = straight;
        if inside {
            let n = DVec3::new(x, y, (1.0 - x * x - y * y).sqrt());
            if interfaces > 0 {
                d = refract(DVec3::NEG_Z, n, 1.0 / 1.5);
                let leaves = n - 2.0 * d.dot(n) * d;
                if interfaces > 1 {
                    d = refract(d, -leaves, 1.5);
                }
            }
        }
        radiance.extend(sky(d).to_array());
        exit.extend(if inside { d.to_array() } else { [0.0; 3] });
        coverage.push(f64::from(u8::from(inside)));
    }
    let mut layers = Layers::new([SIZE as u32; 2]);
    layers.push(LayerName::Radiance, 3, radiance);
    layers.push(LayerName::Exit, 3, exit);
    layers.push(LayerName::Coverage, 1, coverage);
    layers
}

fn write_exr(path: &Path, layers: &Layers) {
    std::fs::create_dir_all(path.parent().unwrap()).unwrap();
    scenes::image::write_exr(path, layers).unwrap();
}

fn run(scene: &str, method: &str, image: &str) -> Run {
    let mut plan = Plan::default();
    plan.buffers.push(scenes::plan::Buffer { name: "front".to_owned(), bytes: 1 << 20 });
    plan.leave_out(scenes::plan::Kind::Pass, "back normals", "one interface needs none", 1 << 19);
    Run {
        id: format!("{scene}-{method}"),
        scene: scene.to_owned(),
        method: method.to_owned(),
        image: PathBuf::from(image),
        passes: vec![Pass {
            name: "shade".to_owned(),
            times: vec![Time::once(TimeSource::Wall, 1.25)],
        }],
        plan,
        ..Run::default()
    }
}

fn common(run: &Run) -> ResultRow {
    ResultRow {
        schema: RESULT_SCHEMA.to_owned(),
        id: run.id.clone(),
        scene: run.scene.clone(),
        method: run.method.clone(),
        columns: Columns::new(
            &run.parameters.iter().map(|(n, v)| (n.clone(), Scalar::read(v))).collect(),
            &BTreeMap::new(),
        ),
        width_px: SIZE as u32,
        height_px: SIZE as u32,
        adapter: "llvmpipe <256 bits>".to_owned(),
        software: true,
        ..ResultRow::default()
    }
}

fn time(run: &Run, milliseconds: f64) -> ResultRow {
    ResultRow {
        kind: RowKind::Time,
        metric: "time_wall_ms".to_owned(),
        unit: "ms".to_owned(),
        value: Some(milliseconds),
        n: 20,
        ..common(run)
    }
}

/// Writes a study of two scenes, one of them with a name that tries to be markup.
pub(crate) fn study(directory: &Path) {
    std::fs::create_dir_all(directory).unwrap();
    let scenes = ["ball", "a | <script>alert(1)</script>"];
    let mut rows = Vec::new();
    let mut runs = Vec::new();
    for (place, scene) in scenes.into_iter().enumerate() {
        let exact = ball(2);
        let reference = run(scene, "reference", &format!("images/{place}/reference.exr"));
        write_exr(&directory.join(&reference.image), &exact);
        for samples in [1u32, 4, 16, 64] {
            let mut own = run(scene, "reference", "");
            own.id = format!("{scene}-curve-{samples}");
            own.parameters = BTreeMap::from([("samples".to_owned(), samples.to_string())]);
            rows.push(time(&own, 40.0 * f64::from(samples)));
            rows.push(ResultRow {
                metric: "relmse_e1e-2".to_owned(),
                value: Some(0.2 / f64::from(samples)),
                ..common(&own)
            });
        }
        runs.push(reference);
        for (interfaces, method, cost) in [(0, "undeviated", 0.8), (1, "one-interface", 1.4)] {
            let candidate = ball(interfaces);
            let mut own = run(scene, method, &format!("images/{place}/{method}.exr"));
            write_exr(&directory.join(&own.image), &candidate);
            let mut selection = Selection::all(compare::metric::Encoding::Linear);
            selection.flip_exposures = Some(Exposures { start: -4.0, stop: 2.0, count: 4 });
            selection.masks.push(Mask::Object);
            let judgement = judge(Reference(&exact), Candidate(&candidate), &selection).unwrap();
            if place == 0 {
                own.flip_map = own.image.with_extension("flip.exr");
                let mut map = Layers::new([SIZE as u32; 2]);
                let name = LayerName::Buffer(FLIP_LAYER.to_owned());
                map.push(name, 1, judgement.flip_map.unwrap());
                write_exr(&directory.join(&own.flip_map), &map);
            }
            rows.push(time(&own, cost));
            rows.extend(judgement.measurements.iter().map(|m| m.row(&common(&own))));
            runs.push(own);
        }
    }
    write_rows(directory, &rows).unwrap();
    let entry = |name: &str| SceneEntry {
        name: name.to_owned(),
        title: "A ball of glass under a clear sky".to_owned(),
        toml: "title = \"</pre><b>\"".to_owned(),
        resolution_px: [SIZE as u32; 2],
        flip_exposures: Some((-4.0, 2.0, 4)),
        ..SceneEntry::default()
    };
    let study = Study {
        schema: STUDY_SCHEMA.to_owned(),
        version: "0.1.0".to_owned(),
        command: "snell study ball -o out".to_owned(),
        adapter: "llvmpipe <256 bits>".to_owned(),
        finished_utc: "2026-11-23T00:00:00Z".to_owned(),
        time_metric: "time_wall_ms".to_owned(),
        software: true,
        elapsed_s: 12.5,
        scenes: scenes.into_iter().map(entry).collect(),
        left_out: vec![NotDone {
            what: "bunny".to_owned(),
            reason: "bunny.obj is not in target/assets".to_owned(),
        }],
        runs,
        ..Study::default()
    };
    write_study(directory, &study).unwrap();
}
