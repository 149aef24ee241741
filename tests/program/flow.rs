//! One number's journey: the index in a scene file reaches both renderers, the
//! results and the report.
#![allow(clippy::unwrap_used, reason = "a missing file or value must fail its test")]

use compare::results::{REFERENCE, ResultRow, RowKind, read_rows, read_study, saved_ms};
use scenes::LayerName;
use snell_tests::run;
use std::path::Path;
use std::process::Command;

const SIZE_PX: usize = 48;
const HEIGHT_M: f64 = 2.4;

/// A unit ball of one index, seen along -Z by parallel rays.
fn ball(eta: f64) -> String {
    format!(
        r#"title = "One index"
[camera]
eye = [0.0, 0.0, 4.0]
target = [0.0, 0.0, 0.0]
orthographic_height_m = {HEIGHT_M:?}
resolution_px = [{SIZE_PX}, {SIZE_PX}]
[environment]
sky = {{}}
[[object]]
shape = {{ sphere = {{ radius_m = 1.0 }} }}
surface = "dielectric"
medium = {{ eta = {eta} }}
"#
    )
}

fn snell(folder: &Path, arguments: &str) -> String {
    let mut command = Command::new(env!("CARGO_BIN_EXE_snell-under-test"));
    let ran = run(command.current_dir(folder).args(arguments.split_whitespace()));
    assert_eq!(ran.status, Some(0), "snell {arguments}: {}", ran.message);
    ran.answer
}

/// Smallest and largest index that Snell's law finds in the directions after
/// the first event: sin θi / sin θt against the ball's own normal. Pixels near
/// the axis, where both sines vanish, are left out.
fn measured(image: &Path) -> [f64; 2] {
    let layers = scenes::image::read(image).unwrap();
    let first = layers.get(&LayerName::First).unwrap();
    let mut range = [f64::INFINITY, f64::NEG_INFINITY];
    for (pixel, d) in first.data.chunks_exact(3).enumerate() {
        let at = |i: usize| (i as f64 + 0.5) / SIZE_PX as f64 - 0.5;
        let (x, y) = (at(pixel % SIZE_PX) * HEIGHT_M, -at(pixel / SIZE_PX) * HEIGHT_M);
        let sin_i = x.hypot(y);
        if !(0.3..0.97).contains(&sin_i) {
            continue;
        }
        let normal = glam::DVec3::new(x, y, (1.0 - sin_i * sin_i).sqrt());
        let sin_t = normal.cross(glam::DVec3::from_slice(d)).length();
        range = [range[0].min(sin_i / sin_t), range[1].max(sin_i / sin_t)];
    }
    range
}

#[test]
fn the_index_in_the_file_is_the_index_that_bends_light_on_both_sides() {
    let folder = tempfile::tempdir().unwrap();
    let folder = folder.path();
    for eta in [1.37, 1.38] {
        std::fs::write(folder.join("ball.toml"), ball(eta)).unwrap();
        let view = "--layers first --positions 1";
        snell(folder, &format!("reference ball.toml -o exact.exr {view}"));
        snell(folder, &format!("realtime ball.toml -m one-interface -o fast.exr {view}"));
        for (image, tolerance) in [("exact.exr", 1e-6), ("fast.exr", 1e-4)] {
            let [low, high] = measured(&folder.join(image));
            assert!((low - eta).abs() < tolerance, "{image}: {low}, not {eta}");
            assert!((high - eta).abs() < tolerance, "{image}: {high}, not {eta}");
        }
    }
}

/// The rows that must not depend on when a study was made.
fn lasting(folder: &Path) -> Vec<ResultRow> {
    let rows = read_rows(folder).unwrap();
    assert!(rows.iter().any(|row| row.kind == RowKind::Time));
    rows.into_iter().filter(|row| row.kind == RowKind::Error).collect()
}

#[test]
fn a_study_says_what_it_judged_and_a_warm_one_repeats_its_numbers() {
    let folder = tempfile::tempdir().unwrap();
    let folder = folder.path();
    std::fs::write(folder.join("ball.toml"), ball(1.37)).unwrap();
    let study = "study ball.toml -m one-interface -m undeviated --timing 0.05 --cache cache";
    let text = snell(folder, &format!("{study} -o cold"));
    assert!(text.contains("one-interface") && text.contains("report: cold/report.html"), "{text}");
    for file in ["report.html", "report.md", "results.csv", "results.jsonl", "study.json"] {
        assert!(folder.join("cold").join(file).is_file(), "{file}");
    }
    let page = std::fs::read_to_string(folder.join("cold/report.html")).unwrap();
    assert!(page.contains("eta = 1.37"), "the report does not show the scene's index");
    let found = read_study(&folder.join("cold")).unwrap();
    assert_eq!(found.scenes[0].toml, ball(1.37));
    let rows = read_rows(&folder.join("cold")).unwrap();
    for run in &found.runs {
        // What leaving out saves is measured, and the exact renderer's is not.
        let of_run = rows.iter().filter(|row| row.id == run.id);
        let saved = saved_ms(of_run, &found.time_metric);
        assert_eq!(saved.is_some(), run.method != REFERENCE, "{}", run.method);
        assert!(folder.join("cold").join(&run.image).is_file(), "{:?}", run.image);
    }

    snell(folder, &format!("{study} -o warm"));
    let (cold, warm) = (lasting(&folder.join("cold")), lasting(&folder.join("warm")));
    assert_eq!(cold, warm);
    let error = |method: &str| {
        let row = |r: &&ResultRow| r.method == method && r.metric == "exit_angle_mean_deg";
        cold.iter().find(row).unwrap().value.unwrap()
    };
    assert!(error("one-interface") < error("undeviated"), "bending once must beat not bending");
}
