//! A study over several processes, one of which is killed.
#![allow(clippy::unwrap_used, reason = "a missing file or value must fail its test")]

use compare::results::{ResultRow, RowKind, read_rows};
use snell_tests::{Ran, run};
use std::collections::BTreeSet;
use std::io::{BufRead, BufReader};
use std::path::Path;
use std::process::{Child, Command, Stdio};

const STUDY: &str = r#"
scenes = ["ball", "box"]
methods = ["one-interface", "undeviated"]
resolution = "24x24"
positions = 2
timing_s = 0
quick = true
set = { camera.orbit_deg = [0, 40] }
[[sweep]]
method = "blended"
a = [0, 1]
"#;

fn snell(folder: &Path, arguments: &str) -> Command {
    let mut command = Command::new(env!("CARGO_BIN_EXE_snell-under-test"));
    command.current_dir(folder).env("NODEVICE_SELECT", "1").args(arguments.split_whitespace());
    command
}

fn ran(folder: &Path, arguments: &str) -> Ran {
    run(&mut snell(folder, arguments))
}

fn done(folder: &Path, arguments: &str) -> String {
    let ran = ran(folder, arguments);
    assert_eq!(ran.status, Some(0), "snell {arguments}: {}", ran.message);
    ran.answer
}

fn start(folder: &Path, arguments: &str) -> Child {
    snell(folder, arguments).stdout(Stdio::piped()).stderr(Stdio::null()).spawn().unwrap()
}

/// Folders of the store whose names are ids.
fn stored(folder: &Path) -> BTreeSet<String> {
    let entries = std::fs::read_dir(folder.join("store")).unwrap();
    let names = entries.map(|entry| entry.unwrap().file_name().into_string().unwrap());
    names.filter(|name| name.len() == 32).collect()
}

/// What does not depend on when and where it was measured.
fn lasting(folder: &Path) -> Vec<ResultRow> {
    let rows = read_rows(folder).unwrap();
    assert!(rows.iter().any(|row| row.kind == RowKind::Time));
    let lasting = |row: &ResultRow| row.kind != RowKind::Time && row.metric != "timed_frames";
    rows.into_iter().filter(lasting).collect()
}

/// Three processes share a study; one is killed when it has stored its first result.
/// What it leaves behind is not taken for a whole, and once its share has run again
/// every job is there once and every number is that of a single process.
#[test]
fn a_killed_worker_costs_its_time_and_nothing_else() {
    let folder = tempfile::tempdir().unwrap();
    let folder = folder.path();
    std::fs::write(folder.join("study.toml"), STUDY).unwrap();
    let ids: Vec<String> =
        done(folder, "jobs study.toml --ids").lines().map(str::to_owned).collect();
    let all: BTreeSet<String> = ids.iter().cloned().collect();
    assert_eq!((ids.len(), all.len()), (20, 20), "an id is there twice");

    let shard = |i: usize| format!("run study.toml --shard {i}/3 -o store --json");
    let mut victim = start(folder, &shard(0));
    let mut others = [start(folder, &shard(1)), start(folder, &shard(2))];
    let mut first = String::new();
    BufReader::new(victim.stdout.take().unwrap()).read_line(&mut first).unwrap();
    victim.kill().unwrap(); // SIGKILL: nothing of it runs after this.
    assert!(first.contains("snell.placed/1"), "{first}");
    assert!(!victim.wait().unwrap().success());
    for other in &mut others {
        assert!(other.wait().unwrap().success());
    }
    let before = stored(folder);
    assert!(before.is_subset(&all) && before.len() < all.len(), "it was killed too late");
    let incomplete = ran(folder, "collect store -o early");
    assert_eq!(incomplete.status, Some(2));
    let missing = format!("{} of 20 results are missing", all.len() - before.len());
    assert!(incomplete.message.contains(&missing), "{}", incomplete.message);
    assert!(!folder.join("early").exists());

    let again = done(folder, &shard(0));
    let found = again.lines().filter(|line| line.contains("\"found\":true")).count();
    assert!(found >= 1, "what was stored was made again: {again}");
    assert_eq!(stored(folder), all);
    let kept = done(folder, "run study.toml -o store --json");
    assert_eq!(kept.matches("\"found\":true").count(), 20, "a second run made something again");

    done(folder, "collect store -o many");
    done(folder, "study study.toml -o one --cache cache");
    let (many, one) = (lasting(&folder.join("many")), lasting(&folder.join("one")));
    assert_eq!(many.len(), one.len());
    for (many, one) in many.iter().zip(&one) {
        assert_eq!(many, one);
    }
    for file in ["report.html", "wide.csv", "images/box_camera_orbit_deg_40.blended.exr"] {
        assert!(folder.join("many").join(file).is_file(), "{file}");
        assert!(folder.join("one").join(file).is_file(), "{file}");
    }

    // The control: a result of another study is not taken for one of this.
    std::fs::write(folder.join("study.toml"), STUDY.replace("[0, 1]", "[0, 0.5]")).unwrap();
    let other = ran(folder, "run study.toml -o store");
    assert_eq!(other.status, Some(2));
    assert!(other.message.contains("results of another study"), "{}", other.message);
    let unknown = ran(folder, "run study.toml --job 0123 -o new");
    assert_eq!(unknown.status, Some(2));
    assert!(unknown.message.contains("no job of the study has the id"), "{}", unknown.message);
}
