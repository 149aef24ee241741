//! Who may depend on whom. The two renderers share descriptions and no optics;
//! if one could call the other, their agreement would mean nothing.
#![allow(clippy::unwrap_used, reason = "a test that cannot read the manifest must fail")]

use serde_json::Value;
use snell_tests::root;
use std::collections::{BTreeMap, BTreeSet};
use std::path::PathBuf;
use std::process::Command;

type Dependencies = BTreeMap<String, BTreeSet<String>>;

/// Names each package of the workspace may use: ordinary and build
/// dependencies, not those of its own tests.
fn dependencies() -> Dependencies {
    let output = Command::new(env!("CARGO"))
        .args(["metadata", "--no-deps", "--offline", "--format-version", "1"])
        .current_dir(root())
        .output()
        .unwrap();
    assert!(output.status.success(), "{}", String::from_utf8_lossy(&output.stderr));
    let metadata: Value = serde_json::from_slice(&output.stdout).unwrap();
    let name = |value: &Value| value["name"].as_str().unwrap().to_owned();
    let used = |package: &Value| {
        let list = package["dependencies"].as_array().unwrap();
        list.iter().filter(|used| used["kind"] != "dev").map(name).collect()
    };
    metadata["packages"].as_array().unwrap().iter().map(|p| (name(p), used(p))).collect()
}

/// Every sentence about the layers that the manifests contradict.
fn violations(dependencies: &Dependencies) -> Vec<String> {
    let allowed: [(&str, &[&str]); 6] = [
        ("snell-scenes", &[]),
        ("snell-reference", &["snell-scenes"]),
        ("snell-realtime", &["snell-scenes"]),
        ("snell", &["snell-scenes", "snell-reference", "snell-realtime"]),
        ("snell-test-support", &["snell-scenes"]),
        ("snell-tests", &["snell-scenes", "snell-reference", "snell-realtime", "snell"]),
    ];
    let mut wrong = Vec::new();
    for (package, used) in dependencies {
        let Some((_, may_use)) = allowed.iter().find(|(name, _)| name == package) else {
            wrong.push(format!("{package} is a package this test does not know"));
            continue;
        };
        for name in used {
            let ours = name == "snell" || name.starts_with("snell-");
            if ours && !may_use.contains(&name.as_str()) {
                wrong.push(format!("{package} must not use {name}"));
            }
            if name == "wgpu" && package != "snell-realtime" {
                wrong.push(format!("{package} must not know wgpu"));
            }
        }
    }
    wrong
}

#[test]
fn packages_use_only_what_lies_below_them() {
    assert_eq!(violations(&dependencies()), [""; 0]);
}

#[test]
fn a_renderer_that_calls_the_other_is_noticed() {
    let mut dependencies = dependencies();
    dependencies.get_mut("snell-realtime").unwrap().insert("snell-reference".into());
    dependencies.get_mut("snell").unwrap().insert("wgpu".into());
    let expected = ["snell must not know wgpu", "snell-realtime must not use snell-reference"];
    assert_eq!(violations(&dependencies), expected);
}

/// Sources below a folder that name a terminal stream outside comments. (The
/// printing macros are lints; this finds what they do not cover.)
fn files_that_reach_a_terminal(folder: &str) -> Vec<PathBuf> {
    let mut found = Vec::new();
    let mut folders = vec![root().join(folder)];
    while let Some(folder) = folders.pop() {
        for entry in std::fs::read_dir(folder).unwrap() {
            let path = entry.unwrap().path();
            if path.is_dir() {
                folders.push(path);
            } else if path.extension().is_some_and(|e| e == "rs") {
                let text = std::fs::read_to_string(&path).unwrap();
                let mut code = text.lines().filter(|line| !line.trim_start().starts_with("//"));
                if code.any(|line| line.contains("io::stdout") || line.contains("io::stderr")) {
                    found.push(path.strip_prefix(root()).unwrap().to_owned());
                }
            }
        }
    }
    found
}

/// Libraries answer with values; only the command line writes to a terminal.
#[test]
fn only_the_command_line_prints() {
    for library in ["scenes/src", "reference/src", "realtime/src"] {
        let printing = files_that_reach_a_terminal(library);
        assert!(printing.is_empty(), "{printing:?} print");
    }
    let printing = files_that_reach_a_terminal("compare/src");
    assert!(!printing.is_empty(), "the search finds nothing, so it would not find a fault");
    for path in printing {
        let may = ["compare/src/cli", "compare/src/support/progress.rs"];
        assert!(may.iter().any(|place| path.starts_with(place)), "{path:?} prints");
    }
}
