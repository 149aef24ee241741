//! Gates as their users see them: what fails, what passes, what cannot be told.
//! Every failure has a twin that differs in one thing and passes.
#![allow(clippy::print_stdout, reason = "`--nocapture` shows what was measured")]
#![allow(clippy::unwrap_used, reason = "an answer that cannot be read must fail its test")]

use scenes::{LayerName, Layers};
use serde_json::Value;
use snell_tests::{Ran, root, run};
use std::fs;
use std::path::Path;
use std::process::Command;

const SIDE_PX: u32 = 48;

fn snell(arguments: &[&str]) -> Ran {
    let mut command = Command::new(env!("CARGO_BIN_EXE_snell-under-test"));
    command.env_remove("GITHUB_ACTIONS").env_remove("GITHUB_STEP_SUMMARY");
    run(command.current_dir(root()).args(arguments))
}

fn rows(ran: &Ran) -> Vec<Value> {
    ran.answer.lines().map(|line| serde_json::from_str(line).unwrap()).collect()
}

/// A small gate over two methods on the ball, in a folder of its own, accepted.
struct Gate {
    folder: tempfile::TempDir,
}

impl Gate {
    fn new(more: &str) -> Self {
        let gate = Self { folder: tempfile::tempdir().unwrap() };
        gate.write(more);
        let ran = gate.run("baseline", &["accept"], &[]);
        assert_eq!(ran.status, Some(0), "{}", ran.message);
        gate
    }

    fn write(&self, more: &str) {
        let text = format!(
            "resolution_px = 32\npositions = 2\n[[cells]]\nscenes = [\"ball\"]\n\
             methods = [\"blended\", \"one-interface\"]\n{more}"
        );
        fs::write(self.path("gate.toml"), text).unwrap();
    }

    fn path(&self, name: &str) -> String {
        self.folder.path().join(name).display().to_string()
    }

    fn run(&self, command: &str, before: &[&str], after: &[&str]) -> Ran {
        let (gate, cache) = (self.path("gate.toml"), self.path("cache"));
        let mut arguments = vec![command];
        arguments.extend(before);
        arguments.extend([gate.as_str(), "--cache", &cache]);
        arguments.extend(after);
        snell(&arguments)
    }

    fn check(&self, after: &[&str]) -> Ran {
        let out = self.path("out");
        let mut arguments = vec!["--json", "--out", &out];
        arguments.extend(after);
        self.run("check", &[], &arguments)
    }
}

/// One changed parameter fails, in the one method that has it, and leaves images
/// and commands behind; nothing changed passes and leaves nothing.
#[test]
fn a_changed_parameter_fails_and_an_unchanged_method_passes() {
    let gate = Gate::new("");
    let same = gate.check(&[]);
    assert_eq!(same.status, Some(0), "{} {}", same.answer, same.message);
    let unchanged = rows(&same);
    assert!(unchanged.iter().all(|row| row["outcome"] == "pass"), "{unchanged:?}");
    let relmse = unchanged.iter().find(|row| row["metric"] == "relmse_e1e-2_frozen").unwrap();
    assert!(relmse["base"].as_f64().unwrap() > 0.01, "it was really measured: {relmse}");
    assert_eq!(relmse["difference"], 0.0, "bit for bit the same: {relmse}");
    assert!(!Path::new(&gate.path("out")).exists());

    let junit = gate.path("junit.xml");
    let changed = gate.check(&["--head-param", "blended.a=0.5", "--junit", &junit, "--github"]);
    assert_eq!(changed.status, Some(1), "{}", changed.answer);
    let failed: Vec<_> = rows(&changed).into_iter().filter(|r| r["outcome"] == "fail").collect();
    assert!(!failed.is_empty() && failed.iter().all(|row| row["cell"] == "ball/blended"));
    for name in ["triple.png", "triple.exr", "exact.exr", "base.exr", "head.exr"] {
        let path = Path::new(&gate.path("out")).join("ball_blended").join(name);
        assert!(fs::metadata(&path).unwrap().len() > 100, "{}", path.display());
    }
    assert!(
        changed.message.contains("snell check") && changed.message.contains("--only ball/blended")
    );
    assert!(changed.message.contains("--head-param blended.a=0.5"), "{}", changed.message);
    assert!(changed.message.contains("snell baseline accept"), "{}", changed.message);
    assert!(changed.message.contains("::error title=ball/blended"), "{}", changed.message);
    let xml = fs::read_to_string(junit).unwrap();
    assert!(xml.contains("<failure") && xml.contains("classname=\"ball/blended\""), "{xml}");
    assert!(xml.contains("classname=\"ball/one-interface\""), "{xml}");
}

/// The change is measured first, without the gate: by how much relMSE grows when
/// `a` goes from 0.33 to 0.4. The gate sees the same growth and fails for it.
#[test]
fn a_change_measured_elsewhere_is_the_change_that_the_gate_sees() {
    let gate = Gate::new("");
    let image = ["--resolution", "32", "--positions", "2"];
    let render = |command: &[&str], name: &str| {
        let path = gate.path(name);
        let ran = snell(&[command, &image, &["--out", &path]].concat());
        assert_eq!(ran.status, Some(0), "{}", ran.message);
        path
    };
    let exact = render(&["reference", "ball"], "exact.exr");
    let relmse = |a: &str| {
        let a = format!("a={a}");
        let path = render(&["realtime", "ball", "--method", "blended", "--param", &a], "it.exr");
        let measured = rows(&snell(&["compare", &exact, &path, "--json"]));
        let row = measured.iter().find(|row| row["metric"] == "relmse_e1e-2").unwrap();
        row["value"].as_f64().unwrap()
    };
    let (before, after) = (relmse("0.33"), relmse("0.4"));
    let growth = after / before - 1.0;
    println!("relMSE {before:.5} -> {after:.5}: {:.2} %", 100.0 * growth);
    assert!(growth > 0.02, "more than the margin: {growth}");

    let checked = gate.check(&["--head-param", "blended.a=0.4"]);
    assert_eq!(checked.status, Some(1), "{}", checked.answer);
    let of_blended =
        |row: &&Value| row["cell"] == "ball/blended" && row["metric"] == "relmse_e1e-2_frozen";
    let rows = rows(&checked);
    let row = rows.iter().find(of_blended).unwrap();
    let seen = row["difference"].as_f64().unwrap() / row["base"].as_f64().unwrap();
    assert!((seen - growth).abs() < 1e-3, "{seen} is not {growth}");
    assert_eq!(row["outcome"], "fail", "{row}");
}

/// What is no longer the baseline's own thing is told, not passed over.
#[test]
fn a_cell_without_its_baseline_fails_and_accepting_it_mends_that() {
    let gate = Gate::new("");
    gate.write("parameters = { index = \"ball\" }\n");
    // `blended` has no such parameter: the gate cannot be run so.
    let wrong = gate.run("baseline", &["accept"], &[]);
    assert_eq!(wrong.status, Some(2), "{}", wrong.answer);
    gate.write("[[cells]]\nscenes = [\"ball\"]\nmethods = [\"undeviated\"]\n");
    let unknown = gate.check(&[]);
    assert_eq!(unknown.status, Some(1), "{}", unknown.answer);
    assert!(unknown.answer.contains("the baseline does not have it"), "{}", unknown.answer);
    let only = gate.run("baseline", &["accept"], &["--only", "ball/undeviated"]);
    assert!(only.answer.contains("3 cells"), "{} {}", only.answer, only.message);
    assert_eq!(gate.check(&[]).status, Some(0));
    // And the other way round: accepted, but no longer watched.
    gate.write("");
    let lost = gate.check(&[]);
    assert_eq!(lost.status, Some(1), "{}", lost.answer);
    assert!(lost.answer.contains("no longer watches it"), "{}", lost.answer);
}

/// An expected failure passes, an unexpected pass fails, on the class it names.
#[test]
fn an_expectation_holds_on_its_class_of_adapters() {
    let expect = |adapter: &str| {
        format!(
            "[[expect]]\nadapter = \"{adapter}\"\ncell = \"ball/blended\"\n\
             metric = \"relmse_e1e-2_frozen\"\nreason = \"as an example\"\n"
        )
    };
    let gate = Gate::new("");
    let class = {
        let adapters = rows(&snell(&["adapters", "--json"]));
        let name = adapters[0]["name"].as_str().unwrap().to_lowercase();
        if name.contains("llvmpipe") { "lavapipe" } else { "hardware" }
    };
    gate.write(&expect(class));
    let pass = gate.check(&[]);
    assert_eq!(pass.status, Some(1), "{}", pass.answer);
    assert!(pass.answer.contains("remove the expectation"), "{}", pass.answer);
    gate.write(&expect("swiftshader"));
    assert_eq!(gate.check(&[]).status, Some(0));
}

#[test]
fn what_cannot_be_run_ends_with_status_2() {
    let gate = Gate::new("");
    fs::write(gate.path("gate.baseline"), "snell.baseline/1\n{}").unwrap();
    let broken = gate.check(&[]);
    assert_eq!((broken.status, broken.answer.as_str()), (Some(2), ""));
    assert!(broken.message.contains("gate.baseline"), "{}", broken.message);
    fs::remove_file(gate.path("gate.baseline")).unwrap();
    let none = gate.check(&[]);
    assert_eq!(none.status, Some(2));
    assert!(none.message.contains("snell baseline accept"), "{}", none.message);
    gate.write("[margin.all]\nflop = 1\n");
    let typo = gate.check(&[]);
    assert_eq!(typo.status, Some(2));
    assert!(typo.message.contains("line 7") && typo.message.contains("flip"), "{}", typo.message);
    let nobody = snell(&["check", "nowhere.toml"]);
    assert_eq!(nobody.status, Some(2));
}

/// An image of somebody's: a wave, with something added to each value.
fn image(path: &Path, added: impl Fn(u32) -> f64) {
    let mut layers = Layers::new([SIDE_PX, SIDE_PX]);
    let value = |i: u32| 1.0 + (f64::from(i) * 0.05).sin() + added(i);
    layers.push(LayerName::Radiance, 3, (0..3 * SIDE_PX * SIDE_PX).map(value).collect());
    scenes::image::write_exr(path, &layers).unwrap();
}

#[test]
fn a_limit_ends_compare_with_status_1_and_names_the_metrics() {
    let folder = tempfile::tempdir().unwrap();
    let path = |name: &str| folder.path().join(name).display().to_string();
    image(Path::new(&path("ref.exr")), |_| 0.0);
    image(Path::new(&path("test.exr")), |_| 0.1);
    let compare =
        |limit: &str| snell(&["compare", &path("ref.exr"), &path("test.exr"), "--limit", limit]);
    assert_eq!(compare("mae=0.11").status, Some(0));
    let beyond = compare("mae=0.09");
    assert_eq!(beyond.status, Some(1));
    assert!(beyond.answer.contains("fail: limit_mae 0.09"), "{}", beyond.answer);
    let unknown = compare("flop=1");
    assert_eq!(unknown.status, Some(2));
    assert!(unknown.message.contains("relmse_e1e-2_trim0.1"), "{}", unknown.message);
    // A metric of PNG files, for a pair of EXR files.
    let absent = compare("flip_ldr=1");
    assert_eq!(absent.status, Some(2));
    assert!(absent.message.contains("it has:") && absent.message.contains("flip_hdr"));
    image(Path::new(&path("test.exr")), |i| if i == 7 { f64::NAN } else { 0.0 });
    assert_eq!(compare("mae=1000").status, Some(1), "NaN holds no limit");
}

/// A folder of pairs: one render gets worse, the other does not; a missing one, a
/// NaN, a broken limit; a mask that hides the change.
#[test]
fn a_folder_of_pairs_is_held_to_limits_and_to_its_baseline() {
    let folder = tempfile::tempdir().unwrap();
    let at = |name: &str| folder.path().join(name);
    for name in ["ref", "out", "mask"] {
        fs::create_dir(at(name)).unwrap();
    }
    let left = |i: u32| i / 3 % SIDE_PX < SIDE_PX / 2;
    for name in ["a", "b"] {
        image(&at(&format!("ref/{name}.exr")), |_| 0.0);
        image(&at(&format!("out/{name}-test.exr")), |i| 0.05 * f64::from(i % 7));
        let mut mask = Layers::new([SIDE_PX, SIDE_PX]);
        let value = |i: u32| f64::from(u8::from(left(3 * i)));
        mask.push(
            LayerName::Radiance,
            3,
            (0..3 * SIDE_PX * SIDE_PX).map(|i| value(i / 3)).collect(),
        );
        scenes::image::write_exr(&at(&format!("mask/{name}.exr")), &mask).unwrap();
    }
    let write = |more: &str| {
        let text =
            format!("[[pair]]\nreference = \"ref/*.exr\"\ntest = \"out/*-test.exr\"\n{more}");
        fs::write(at("pairs.toml"), text).unwrap();
    };
    let pairs = at("pairs.toml").display().to_string();
    let out = at("gate-out").display().to_string();
    let check = || snell(&["check", "--pairs", &pairs, "--out", &out, "--json"]);
    let accept = || snell(&["baseline", "accept", "--pairs", &pairs]);

    write("");
    assert_eq!(check().status, Some(2), "neither limits nor a baseline: nothing to check");
    write("limits = { mae = 0.2 }\n");
    assert_eq!(check().status, Some(0));
    write("limits = { mae = 0.1 }\n");
    assert_eq!(check().status, Some(1));

    write("");
    assert_eq!(accept().status, Some(0));
    let same = check();
    assert_eq!(same.status, Some(0), "{} {}", same.answer, same.message);
    // b gets 3 % further from its reference, which is 6 % of squared error.
    image(&at("out/b-test.exr"), |i| 1.03 * 0.05 * f64::from(i % 7));
    let worse = check();
    assert_eq!(worse.status, Some(1), "{}", worse.answer);
    let failed: Vec<_> = rows(&worse).into_iter().filter(|r| r["outcome"] == "fail").collect();
    assert!(failed.iter().all(|row| row["cell"] == "b-test"), "{failed:?}");
    // Better is not worse.
    image(&at("out/b-test.exr"), |i| 0.5 * 0.05 * f64::from(i % 7));
    assert_eq!(check().status, Some(0));
    image(&at("out/b-test.exr"), |i| if i == 99 { f64::INFINITY } else { 0.0 });
    let broken = check();
    assert_eq!(broken.status, Some(1));
    assert!(broken.answer.contains("NaN or infinity"), "{}", broken.answer);
    fs::remove_file(at("out/b-test.exr")).unwrap();
    assert!(check().answer.contains("is missing"));

    // Wrong on the right only; the mask counts the left.
    image(&at("out/b-test.exr"), |i| 0.05 * f64::from(i % 7));
    write("mask = \"mask/*.exr\"\n");
    assert_eq!(accept().status, Some(0));
    let doubled = |i: u32| 0.05 * f64::from(i % 7) * if left(i) { 1.0 } else { 2.0 };
    image(&at("out/b-test.exr"), doubled);
    assert_eq!(check().status, Some(0), "hidden by the mask");
    write("");
    assert_eq!(accept().status, Some(0));
    image(&at("out/b-test.exr"), |i| 2.0 * doubled(i));
    assert_eq!(check().status, Some(1), "and seen without");
}
