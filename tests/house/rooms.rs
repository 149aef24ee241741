//! Inside a crate too, imports run down only: of the rooms of one folder none
//! imports from one that imports from it, however many lie between them.
#![allow(clippy::unwrap_used, reason = "a test that cannot read the sources must fail")]

mod sources;

use sources::{Crate, Module};
use std::collections::{BTreeMap, BTreeSet};
use std::path::Path;

const CRATES: [&str; 4] = ["scenes", "reference", "realtime", "compare"];

/// Rooms that stand in a circle, with the imports that close it.
fn circles(of: &Crate) -> Vec<String> {
    of.rooms().iter().filter_map(|room| circle(room, of.imports(room))).collect()
}

/// Takes away, again and again, what imports from nothing that is left; what
/// remains stands in circles or above them.
fn circle(
    room: &Module,
    mut imports: BTreeMap<String, BTreeMap<String, Module>>,
) -> Option<String> {
    loop {
        let above: BTreeSet<String> = imports.keys().cloned().collect();
        for below in imports.values_mut() {
            below.retain(|name, _| above.contains(name));
        }
        let before = imports.len();
        imports.retain(|_, below| !below.is_empty());
        if imports.is_empty() {
            return None;
        }
        if imports.len() == before {
            break;
        }
    }
    let arrow = |(from, below): (&String, &BTreeMap<String, Module>)| {
        let arrows = below.iter().map(|(to, file)| format!("{from} -> {to} ({})", file.join("/")));
        arrows.collect::<Vec<_>>().join(", ")
    };
    let arrows: Vec<String> = imports.iter().map(arrow).collect();
    Some(format!("in src/{}: {}", room.join("/"), arrows.join("; ")))
}

#[test]
fn imports_run_down() {
    for name in CRATES {
        let found = circles(&Crate::read(&snell_tests::root().join(name).join("src")));
        assert_eq!(found, [""; 0], "{name}");
    }
}

fn made_up(files: [(&str, &str); 5]) -> Crate {
    let module =
        |path: &str| path.split('/').filter(|p| !p.is_empty()).map(str::to_owned).collect();
    Crate::new(files.into_iter().map(|(path, text)| (module(path), text.to_owned())).collect())
}

/// The same sources, but for one import.
#[test]
fn an_import_that_runs_up_is_found_however_it_is_written() {
    let with = |text: &'static str| {
        circles(&made_up([
            ("", "mod study;\nmod report;\npub use study::Study;\n"),
            ("study", "mod jobs;\npub use jobs::{Job, made::Made as Done};\npub struct Study;\n"),
            ("study/jobs", "use crate::report::Report;\npub struct Job;\n"),
            ("report", text),
            ("study/cache", "use super::{Job, jobs};\n"),
        ]))
    };
    assert_eq!(
        with("use std::fmt;\n// crate::study is above\npub(crate) struct Report;\n"),
        [""; 0]
    );
    for up in [
        "use crate::study::jobs::Job;",
        "use crate::{\n    study::{jobs::Job},\n};",
        "use super::study;",
        "use crate::Study;",
        "fn f() { crate::study::run() }",
    ] {
        let found = with(up);
        assert_eq!(found.len(), 1, "{up}");
        assert!(found[0].contains("report -> study (report)"), "{found:?}");
    }
}

/// Shaders lie beside each other by what they are chosen for, however many.
fn is_of_shaders(folder: &Path) -> bool {
    folder.components().any(|part| part.as_os_str() == "shaders")
}

/// Files of every folder below a crate's sources, but shaders.
#[test]
fn no_folder_holds_more_than_fourteen_files() {
    let mut folders: Vec<_> = CRATES.map(|name| snell_tests::root().join(name).join("src")).into();
    let mut seen = 0;
    while let Some(folder) = folders.pop() {
        let entries = std::fs::read_dir(&folder).unwrap().map(|entry| entry.unwrap().path());
        let (inner, files): (Vec<_>, Vec<_>) = entries.partition(|path| path.is_dir());
        seen += files.len();
        assert!(files.len() <= 14 || is_of_shaders(&folder), "{folder:?}: {}", files.len());
        folders.extend(inner);
    }
    assert!(seen > 200, "{seen}");
}
