//! Sweeps: what varies becomes explicit jobs, typed columns and curves; images of
//! others stand in the same table.
#![allow(clippy::unwrap_used, reason = "a missing file or value must fail its test")]

use compare::results::{ResultRow, RowKind, Scalar, read_rows, read_study};
use snell_tests::{Ran, run};
use std::path::Path;
use std::process::Command;

/// A unit ball seen along -Z by parallel rays, of glass that has a name.
const BALL: &str = r#"title = "Ball"
[camera]
eye = [0.0, 0.0, 4.0]
target = [0.0, 0.0, 0.0]
orthographic_height_m = 2.4
resolution_px = [32, 32]
[environment]
sky = {}
[medium.glass]
eta = 1.5
[[object]]
shape = { sphere = { radius_m = 1.0 } }
surface = "dielectric"
medium = "glass"
[judgement]
flip_exposures = { start = -2.0, stop = 2.0, count = 2 }
"#;

const TWO: &str = "ball.toml -m one-interface -m blended --timing 0.01 --quick --resolution 32";

fn folder() -> tempfile::TempDir {
    let folder = tempfile::tempdir().unwrap();
    std::fs::write(folder.path().join("ball.toml"), BALL).unwrap();
    folder
}

fn snell(folder: &Path, arguments: &str) -> Ran {
    let mut command = Command::new(env!("CARGO_BIN_EXE_snell-under-test"));
    run(command.current_dir(folder).args(arguments.split_whitespace()))
}

fn done(folder: &Path, arguments: &str) -> String {
    let ran = snell(folder, arguments);
    assert_eq!(ran.status, Some(0), "snell {arguments}: {}", ran.message);
    ran.answer
}

fn ids(folder: &Path, study: &str) -> Vec<String> {
    done(folder, &format!("jobs {study} --ids")).lines().map(str::to_owned).collect()
}

/// A study file and the same on the command line come to the same jobs. One other
/// value changes the one job that it belongs to.
#[test]
fn a_study_file_and_the_command_line_say_the_same() {
    let folder = folder();
    let folder = folder.path();
    let study = r#"
scenes = ["ball.toml"]
methods = ["one-interface", "blended"]
resolution = ["32x32", "48x32"]
timing_s = 0.01
quick = true
set = { medium.glass.eta = "1.3:1.5:0.1" }
[[sweep]]
method = "blended"
a = [0, 0.5]
"#;
    std::fs::write(folder.join("study.toml"), study).unwrap();
    let words = "ball.toml -m one-interface -m blended --resolution 32x32,48x32 --timing 0.01 \
                 --quick --set medium.glass.eta=1.3:1.5:0.1 -p blended.a=0,0.5";
    let (of_file, of_words) = (ids(folder, "study.toml"), ids(folder, words));
    // Three indices at two sizes: the exact images, one-interface, two of blended.
    assert_eq!(of_file.len(), 3 * 2 * (1 + 1 + 2));
    let sorted = |mut ids: Vec<String>| {
        ids.sort();
        ids.dedup();
        ids
    };
    let of_file = sorted(of_file);
    assert_eq!(of_file.len(), 24, "every id is there once");
    assert_eq!(of_file, sorted(of_words));
    let other = sorted(ids(folder, &words.replace("a=0,0.5", "a=0,0.6")));
    let gone = of_file.iter().filter(|id| !other.contains(id)).count();
    assert_eq!(gone, 6, "one value of one method at six places");
}

/// What cannot be swept ends with status 2, says what can be, and leaves nothing.
#[test]
fn what_cannot_be_swept_is_refused_before_anything_is_written() {
    let folder = folder();
    let folder = folder.path();
    std::fs::write(folder.join("typo.toml"), "scenes = [\"ball.toml\"]\nmethod = \"multi\"\n")
        .unwrap();
    for (words, say) in [
        (format!("{TWO} -p b=1"), "no method of the study has a parameter \"b\""),
        (format!("{TWO} -p a=0:2:0.5"), "is not a number from 0 to 1"),
        (format!("{TWO} -m dx7 -p index=own"), "write one-interface.index or dx7.index"),
        (format!("{TWO} -p multi.peel_px=64"), "multi is not in the study"),
        (format!("{TWO} --set medium.water.eta=1.3"), "no medium `water`; it has glass"),
        (format!("{TWO} --set medium.glass.eta=0.5,1.5"), "below 1"),
        (format!("{TWO} --set camera.resolution_px.0=8"), "is set with --resolution"),
        (format!("{TWO} --budget-ms -1"), "budget-ms"),
        (format!("{TWO} -p a=0:1"), "START:STOP:STEP"),
        (format!("{TWO} --time engine=4"), "--image"),
        ("typo.toml".to_owned(), "unknown field `method`"),
    ] {
        let ran = snell(folder, &format!("study {words} -o out"));
        assert_eq!(ran.status, Some(2), "{words}: {}", ran.message);
        assert!(ran.message.contains(say), "{words}: {}", ran.message);
        assert!(!folder.join("out").exists(), "{words} left something behind");
    }
}

fn value(rows: &[ResultRow], metric: &str, is: impl Fn(&ResultRow) -> bool) -> f64 {
    let row = rows.iter().find(|row| row.metric == metric && is(row));
    row.unwrap_or_else(|| panic!("no {metric}")).value.unwrap()
}

/// A ball of index 1 is invisible and cannot be bent wrongly; one of 1.5 can. What was
/// set stands in columns of its own, and a time beside the error of its own image.
#[test]
fn what_varies_is_in_typed_columns_and_changes_what_it_must() {
    let folder = folder();
    let folder = folder.path();
    let study =
        format!("study {TWO} --set medium.glass.eta=1,1.5 -p a=0,1 --supersampling 1,2 -o out");
    let text = done(folder, &format!("{study} --budget-ms 2000"));
    assert!(text.contains("blended a=0") && text.contains("within 2.00 s: "), "{text}");
    let rows = read_rows(&folder.join("out")).unwrap();
    let eta = |row: &ResultRow| row.columns.0["scene.medium.glass.eta"].clone();
    let at = |index: f64| {
        move |row: &ResultRow| eta(row) == Scalar::Number(index) && row.method == "one-interface"
    };
    assert!(value(&rows, "relmse_e1e-2", at(1.0)) < 1e-6);
    assert!(value(&rows, "relmse_e1e-2", at(1.5)) > 1e-2);
    let of = |a: f64| {
        move |row: &ResultRow| {
            row.columns.0.get("param.a") == Some(&Scalar::Number(a))
                && eta(row) == Scalar::Number(1.5)
        }
    };
    let errors = [0.0, 1.0].map(|a| value(&rows, "exit_angle_median_deg", of(a)));
    assert!((errors[0] - errors[1]).abs() > 1.0, "{errors:?}");

    let blended: Vec<&ResultRow> = rows.iter().filter(|row| of(0.0)(row)).collect();
    let positions = |kind: RowKind, metric: &str| {
        let chosen = blended.iter().filter(|row| row.kind == kind && row.metric == metric);
        chosen
            .filter(|row| row.mask == Default::default())
            .map(|row| row.positions)
            .collect::<Vec<_>>()
    };
    assert_eq!(positions(RowKind::Time, "time_wall_ms"), [1, 2]);
    assert_eq!(positions(RowKind::Error, "relmse_e1e-2"), [4, 1, 2]);
    assert!(blended.iter().all(|row| row.columns.0["flip_exposures.count"] == Scalar::Number(2.0)));

    let wide = std::fs::read_to_string(folder.join("out/wide.csv")).unwrap();
    let head = wide.lines().next().unwrap();
    for column in ["param.a", "scene.medium.glass.eta", "positions", "relmse_e1e-2", "time_wall_ms"]
    {
        assert!(head.split(',').any(|name| name == column), "{column} is not in {head}");
    }
    // Two indices; three settings at three numbers of positions, three cheap exact
    // images and the truth.
    assert_eq!(wide.lines().count() - 1, 2 * (3 * 3 + 3 + 1));
    let study = read_study(&folder.join("out")).unwrap();
    assert_eq!(study.scenes.len(), 2);
    let kept = study.runs.iter().filter(|run| !run.image.as_os_str().is_empty()).count();
    assert_eq!(kept, 2 * 3, "of each method the best setting is kept, and the truth");
}

/// Our own image of a method, handed in as somebody else's, gets the method's own
/// numbers. The truth itself is without error, and another method's is not.
#[test]
fn images_of_others_are_judged_like_ours() {
    let folder = folder();
    let folder = folder.path();
    let view = "--resolution 32 --positions 4";
    done(folder, &format!("realtime ball.toml -m one-interface {view} -o ours.exr"));
    done(folder, &format!("reference ball.toml {view} -o exact.exr"));
    done(folder, &format!("reference ball.toml {view} --exposure 0 -o exact.png"));
    let images = "--image engine=ours.exr --time engine=4.2 --made-on engine=anything \
                  --image perfect=exact.exr --time perfect=0.001 --image screen=exact.png";
    let text = done(folder, &format!("study {TWO} {images} --budget-ms 0.01 -o out"));
    assert!(text.contains("within 10.0 µs: perfect, 0 in 1.00 µs"), "{text}");
    let rows = read_rows(&folder.join("out")).unwrap();
    let of = |method: &'static str| move |row: &ResultRow| row.method == method;
    for metric in ["relmse_e1e-2", "relmse_e1e-2_trim0.1", "flip_hdr", "bias"] {
        let own = value(&rows, metric, of("one-interface"));
        assert_eq!(value(&rows, metric, of("engine")), own, "{metric}");
        assert_ne!(value(&rows, metric, of("blended")), own, "{metric}");
        assert_eq!(value(&rows, metric, of("perfect")), 0.0, "{metric}");
    }
    let engine = rows.iter().find(|row| row.metric == "time_given_ms" && row.method == "engine");
    let engine = engine.unwrap();
    assert_eq!((engine.value, engine.adapter.as_str()), (Some(4.2), "anything"));
    assert_eq!(value(&rows, "display_encoded", of("screen")), 1.0);
    assert_eq!(value(&rows, "display_encoded", of("engine")), 0.0);

    // Added to a finished study, it gets the same numbers; its name then is taken.
    done(folder, &format!("study {TWO} -o finished"));
    let add = "report finished --image engine=ours.exr --time engine=4.2";
    done(folder, add);
    let added = read_rows(&folder.join("finished")).unwrap();
    for metric in ["relmse_e1e-2", "flip_hdr", "time_given_ms"] {
        assert_eq!(value(&added, metric, of("engine")), value(&rows, metric, of("engine")));
    }
    let again = snell(folder, add);
    assert_eq!((again.status, read_rows(&folder.join("finished")).unwrap()), (Some(2), added));
    assert!(again.message.contains("of that name"), "{}", again.message);

    let larger = TWO.replace("--resolution 32", "--resolution 48");
    let ran = snell(folder, &format!("study {larger} --image engine=ours.exr -o other"));
    assert_eq!(ran.status, Some(2));
    assert!(
        ran.message.contains("the image is 32x32") && ran.message.contains("48x48"),
        "{}",
        ran.message
    );
}
