//! The command line as its users see it: help, answers, errors, exit status.
#![allow(clippy::unwrap_used, reason = "an answer that cannot be read must fail its test")]

use serde_json::Value;
use snell_tests::{Ran, root, run};
use std::process::Command;

/// Runs `snell` in the project's folder; arguments are separated by spaces.
fn snell(arguments: &str) -> Ran {
    let mut command = Command::new(env!("CARGO_BIN_EXE_snell-under-test"));
    run(command.current_dir(root()).args(arguments.split_whitespace()))
}

fn done(arguments: &str) -> String {
    let ran = snell(arguments);
    assert_eq!(ran.status, Some(0), "snell {arguments}: {}", ran.message);
    ran.answer
}

/// Every line of a `--json` answer is an object that names its schema.
fn objects(arguments: &str) -> Vec<Value> {
    let answer = done(&format!("{arguments} --json"));
    let objects: Vec<Value> =
        answer.lines().map(|line| serde_json::from_str(line).unwrap()).collect();
    assert!(!objects.is_empty(), "snell {arguments} --json answers nothing");
    for object in &objects {
        assert!(object["schema"].as_str().unwrap().starts_with("snell."), "{object}");
    }
    objects
}

const GLASS: [&str; 2] =
    ["tests/data/vectors/images/hdr_glass_ref.exr", "tests/data/vectors/images/hdr_glass_test.exr"];

#[test]
fn every_help_ends_with_the_exit_status() {
    let help = done("--help");
    let commands = help.split("Commands:").nth(1).unwrap().split("Options:").next().unwrap();
    let names: Vec<&str> =
        commands.lines().filter_map(|line| line.split_whitespace().next()).collect();
    assert!(names.contains(&"compare"), "{help}");
    for name in names.into_iter().filter(|name| *name != "help") {
        let help = done(&format!("{name} --help"));
        let last = help.lines().last().unwrap();
        assert!(last.starts_with("Exit status: 0 done"), "{name}: {last}");
        assert!(help.contains("Usage: snell"), "{help}");
    }
}

#[test]
fn comparing_prints_the_metrics_and_what_it_left_out() {
    let text = done(&format!("compare {} {}", GLASS[0], GLASS[1]));
    assert!(text.contains("relmse_e1e-2") && text.contains("left out: exit_angle"), "{text}");
    let objects = objects(&format!("compare {} {}", GLASS[0], GLASS[1]));
    let relmse = objects.iter().find(|o| o["metric"] == "relmse_e1e-2").unwrap();
    assert!((relmse["value"].as_f64().unwrap() - 0.1419).abs() < 1e-3, "{relmse}");
}

#[test]
fn an_image_compared_with_itself_is_identical() {
    let objects = objects(&format!("compare {} {}", GLASS[0], GLASS[0]));
    assert!(objects.iter().all(|object| object["status"] == "identical"), "{objects:?}");
}

#[test]
fn a_word_that_is_no_command_ends_with_status_2_and_a_hint() {
    let ran = snell("comprae a b");
    assert_eq!(ran.status, Some(2));
    assert!(ran.message.contains("compare"), "{}", ran.message);
    assert_eq!(ran.answer, "");
}
