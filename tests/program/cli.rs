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
    // Lines of two spaces and a name; what a terminal's width wraps stands deeper.
    let starts = |line: &&str| line.starts_with("  ") && !line.starts_with("   ");
    let names: Vec<&str> =
        commands.lines().filter(starts).filter_map(|line| line.split_whitespace().next()).collect();
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

#[test]
fn built_in_scenes_are_listed_and_printed() {
    let scenes = objects("scenes");
    let names: Vec<&str> = scenes.iter().map(|scene| scene["name"].as_str().unwrap()).collect();
    assert!(names.contains(&"ball") && names.contains(&"bunny"), "{names:?}");
    let quick = scenes.iter().filter(|scene| scene["in_quick_study"] == true).count();
    assert_eq!(quick, 4);
    assert!(done("scenes ball").contains("[camera]"));
}

#[test]
fn methods_tell_their_parameters_and_their_papers() {
    let methods = objects("methods");
    let blended = methods.iter().find(|method| method["id"] == "blended").unwrap();
    assert_eq!(blended["alias"], "M2");
    let parameters = blended["parameters"].as_array().unwrap();
    assert!(parameters.iter().any(|parameter| parameter["name"] == "a"), "{parameters:?}");
    for method in &methods {
        for parameter in method["parameters"].as_array().unwrap() {
            for key in ["default", "range", "help"] {
                assert!(!parameter[key].as_str().unwrap().is_empty(), "{key} of {parameter}");
            }
        }
    }
    let flags = blended["flags"].as_array().unwrap();
    let cap = flags.iter().find(|flag| flag["name"] == "cap").unwrap();
    assert!(cap["bit"] == 4 && cap["meaning"].as_str().unwrap().contains("cap"), "{cap}");
    let told = done("methods");
    for layer in blended["layers"].as_array().unwrap() {
        let (name, meaning) = (layer["name"].as_str().unwrap(), layer["meaning"].as_str().unwrap());
        assert!(told.contains(name) && told.contains(meaning), "{name}");
    }
    assert!(told.contains("geometric_normal") && told.contains("layer_facing.<n>"), "{told}");
    assert!(done("methods --bibtex").contains("@"));
}

#[test]
fn some_adapter_is_seen() {
    let adapters = objects("adapters");
    assert!(adapters.iter().all(|adapter| !adapter["name"].as_str().unwrap().is_empty()));
}

#[test]
fn a_plan_says_what_runs_and_what_is_left_out() {
    for renderer in ["--reference", "--method undeviated"] {
        let plan = &objects(&format!("plan uniform-ball {renderer}"))[0];
        assert!(!plan["passes"].as_array().unwrap().is_empty(), "{plan}");
        let left_out = plan["left_out"].as_array().unwrap();
        assert!(left_out.iter().all(|left| left["reason"].as_str().is_some_and(|r| r.len() > 8)));
        assert!(!left_out.is_empty(), "a uniform environment needs no lookup: {plan}");
    }
}

/// The exact image of a lossless ball in uniform light 1 is 1 everywhere: so the file
/// says, and so says a comparison with undeviated light; glass that absorbs differs.
#[test]
fn the_reference_writes_an_image_that_can_be_compared() {
    let folder = tempfile::tempdir().unwrap();
    let file = |name: &str| folder.path().join(name).to_string_lossy().into_owned();
    let size = "--resolution 24 --positions 1";
    let (exact, straight, other) = (file("exact.exr"), file("straight.exr"), file("other.exr"));
    done(&format!("reference uniform-ball -o {exact} {size} --cut 1e-8"));
    let image = scenes::image::read(std::path::Path::new(&exact)).unwrap();
    let radiance = &image.get(&scenes::LayerName::Radiance).unwrap().data;
    assert!(radiance.iter().all(|value| (value - 1.0).abs() < 1e-6));
    done(&format!("realtime uniform-ball --method undeviated -o {straight} {size}"));
    done(&format!("reference ice-cube -o {other} {size}"));
    let mae = |test: &str| {
        let scores = objects(&format!("compare {exact} {test}"));
        let found = scores.iter().find(|score| score["metric"] == "mae").unwrap();
        assert_eq!(found["n"], 24 * 24);
        found["value"].as_f64().unwrap()
    };
    assert!(mae(&straight) < 1e-6, "{}", mae(&straight));
    assert!(mae(&other) > 0.05, "{}", mae(&other));
}

/// What is missing is said before anything is measured, and nothing is answered.
#[test]
fn a_comparison_without_a_compiler_ends_with_status_2_and_names_the_packages() {
    let mut command = Command::new(env!("CARGO_BIN_EXE_snell-under-test"));
    command.args(["bench", "--reference", "--against", "embree"]);
    let ran = run(command.current_dir(root()).env("CXX", "no-such-compiler"));
    assert_eq!(ran.status, Some(2), "{}", ran.message);
    assert!(ran.message.contains("apt-get install libembree-dev g++"), "{}", ran.message);
    assert_eq!(ran.answer, "");
    let mut command = Command::new(env!("CARGO_BIN_EXE_snell-under-test"));
    command.args(["bench", "--reference", "--against", "mitsuba"]);
    let ran = run(command.current_dir(root()).env("PYTHON", "no-such-python"));
    assert_eq!((ran.status, ran.answer.as_str()), (Some(2), ""), "{}", ran.message);
    assert!(ran.message.contains("pip install mitsuba numpy"), "{}", ran.message);
    let ran = snell("bench --reference --repetitions 3");
    assert_eq!((ran.status, ran.answer.as_str()), (Some(2), ""));
}

/// The layers of an image file and the channels of each.
fn layers_of(path: &str) -> Vec<(String, usize)> {
    let layers = scenes::image::read(std::path::Path::new(path)).unwrap();
    layers.list.iter().map(|layer| (layer.name.to_string(), layer.channels)).collect()
}

#[test]
fn every_layer_of_the_reference_can_be_asked_for() {
    let folder = tempfile::tempdir().unwrap();
    let image = folder.path().join("paths.exr").to_string_lossy().into_owned();
    let help = done("reference --help");
    let common = "--resolution 8";
    let in_paths = "radiance,variance,samples,truncated,coverage,bounce2,bounce.3,exit,\
                    exit_position,first,hit2,events,total_reflections,flags,crack_mask,path.vacuum";
    done(&format!(
        "reference ball -o {image} {common} --estimator paths --batches 2 --samples 1 --layers {in_paths}"
    ));
    let found = layers_of(&image);
    assert_eq!(found.len(), in_paths.split(',').count(), "{found:?}");
    assert!(found.contains(&("bounce3".to_owned(), 3)), "{found:?}");
    let image = folder.path().join("stokes.exr").to_string_lossy().into_owned();
    done(&format!("reference ball -o {image} {common} --polarised --layers stokes"));
    assert_eq!(layers_of(&image), [("stokes".to_owned(), 3)]);
    for (name, _) in reference::LAYERS {
        assert!(help.contains(&format!("\n  {name} ")), "{name} is not in the help");
        let stem = name.split('<').next().unwrap();
        assert!(in_paths.contains(stem) || stem == "stokes", "{name} is not tested here");
    }
    let ran = snell(&format!("reference ball -o {image} {common} --layers path.lead"));
    assert_eq!(ran.status, Some(2));
    assert!(ran.message.contains("path.<MEDIUM>"), "{}", ran.message);
}

/// Help for the exact renderer stands in groups, rendering and planning alike.
#[test]
fn options_of_the_reference_are_grouped() {
    for command in ["reference", "plan"] {
        let help = done(&format!("{command} --help"));
        for (heading, option) in [
            ("View:", "--layers"),
            ("Light transport:", "--estimator"),
            ("Physics taken away:", "--max-interfaces"),
        ] {
            let place = |what: &str| help.find(what).unwrap_or_else(|| panic!("{what}: {help}"));
            assert!(place(heading) < place(&format!("  {option}")), "{help}");
        }
    }
}

#[test]
fn the_seed_and_not_the_threads_decides_an_image_of_random_paths() {
    let folder = tempfile::tempdir().unwrap();
    let image = |name: &str, options: &str| {
        let path = folder.path().join(name);
        done(&format!(
            "reference ice-cube -o {} --resolution 16 --estimator paths --batches 2 --samples 2 \
             --layers radiance,variance {options}",
            path.display()
        ));
        scenes::image::read(&path).unwrap()
    };
    let first = image("a.exr", "--seed 7 --threads 1");
    assert_eq!(first, image("b.exr", "--seed 7 --threads 3"));
    assert_ne!(first, image("c.exr", "--seed 8 --threads 1"));
}

#[test]
fn a_plan_of_the_reference_tells_what_the_options_take_away() {
    let plan = |options: &str| objects(&format!("plan ball --reference {options}"))[0].to_string();
    let whole = plan("");
    for (options, words) in [
        ("--max-interfaces 2", "interfaces after the first 2"),
        ("--no-internal-reflection", "reflections inside a body that are not total"),
        ("--fresnel schlick", "Schlick's reflectance"),
        ("--fresnel cubic", "cubic reflectance"),
        ("--max-events 9", "paths of at most 9 events"),
        ("--estimator paths", "Paths"),
        ("--layers exit", "positions per pixel"),
        ("--level r0", "one chain per position"),
    ] {
        assert!(plan(options).contains(words), "{options}: {}", plan(options));
        assert!(!whole.contains(words), "{words}: {whole}");
    }
    assert!(
        whole.contains("\"polarisation\"")
            && !plan("--polarised").contains("\"polarisation\",\"kind\"")
    );
}

#[test]
fn options_that_mean_nothing_together_are_refused_and_leave_no_file() {
    let folder = tempfile::tempdir().unwrap();
    let image = folder.path().join("no.exr");
    for (options, hint) in [
        ("--seed 1", "--estimator paths"),
        ("--estimator tree --batches 4", "--estimator paths"),
        ("--estimator paths --cut 1e-3", "--estimator tree"),
        ("--lattice", "--estimator paths"),
        ("--estimator paths --lattice --positions 2", "write one of them"),
        ("--estimator paths --positions 64 --samples 2000000", "less than"),
        ("--estimator paths --polarised", "tree"),
        ("--estimator paths --batches 0", "at least 1"),
        ("--estimator paths --batches 1 --layers variance", "2 batches"),
        ("--layers variance", "random paths"),
        ("--threads 0", "1..=1024"),
        ("--cut 2", "0 to 1"),
    ] {
        let ran = snell(&format!("reference ball -o {} --resolution 4 {options}", image.display()));
        assert_eq!(ran.status, Some(2), "{options}");
        assert!(ran.message.contains(hint), "{options}: {}", ran.message);
        assert!(!image.exists(), "{options}");
    }
    let ran = snell("plan ball --method undeviated --max-interfaces 2");
    assert_eq!(ran.status, Some(2), "{}", ran.message);
}

/// What is taken away changes the image, so no option is lost on its way.
#[test]
fn each_restriction_reaches_the_renderer() {
    let folder = tempfile::tempdir().unwrap();
    let image = |name: &str, options: &str| {
        let path = folder.path().join(name).with_extension("exr");
        done(&format!(
            "reference ball -o {} --resolution 12 --positions 1 {options}",
            path.display()
        ));
        scenes::image::read(&path).unwrap()
    };
    let whole = image("whole", "");
    let options = [
        "--max-interfaces 1",
        "--max-events 2",
        "--no-internal-reflection",
        "--fresnel schlick",
        "--fresnel cubic",
        "--level r0",
        "--lat-long",
        "--cut 0.1",
        "--polarised",
    ];
    for (index, option) in options.iter().enumerate() {
        assert_ne!(whole, image(&index.to_string(), option), "{option}");
    }
}

/// The first image comes first, the last is the same as without stages, and
/// stopping in between leaves a whole one.
#[test]
fn progressive_rendering_ends_with_the_same_image() {
    let folder = tempfile::tempdir().unwrap();
    let path = |name: &str| folder.path().join(name).to_string_lossy().into_owned();
    let common = "--resolution 24 --positions 4";
    done(&format!("reference ball -o {} {common}", path("plain.exr")));
    let ran = snell(&format!("reference ball -o {} {common} --progressive", path("staged.exr")));
    assert_eq!(ran.status, Some(0), "{}", ran.message);
    let stages: Vec<&str> = ran.message.lines().filter(|line| line.contains("written")).collect();
    assert_eq!(stages.len(), 3, "{}", ran.message);
    assert!(stages[0].contains(" 1 ray per pixel"), "{stages:?}");
    let read = |name: &str| scenes::image::read(std::path::Path::new(&path(name))).unwrap();
    assert_eq!(read("plain.exr"), read("staged.exr"));
}

#[test]
fn stopping_progressive_rendering_leaves_the_last_whole_image() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("stopped.exr");
    let arguments = "reference diamond --resolution 64 --positions 64 --cut 1e-9 --progressive -o";
    let mut child = Command::new(env!("CARGO_BIN_EXE_snell-under-test"))
        .current_dir(root())
        .args(arguments.split_whitespace())
        .arg(&path)
        .stdout(std::process::Stdio::null())
        .stderr(std::process::Stdio::null())
        .spawn()
        .unwrap();
    while !path.exists() {
        assert!(child.try_wait().unwrap().is_none(), "it ended without an image");
        std::thread::sleep(std::time::Duration::from_millis(5));
    }
    assert!(child.try_wait().unwrap().is_none(), "the work is too small for this test");
    // Not -INT, which a test in the background of a shell inherits as ignored.
    let stop = Command::new("kill").args(["-TERM", &child.id().to_string()]).status();
    assert!(stop.unwrap().success());
    assert!(!child.wait().unwrap().success());
    assert_eq!(scenes::image::read(&path).unwrap().resolution_px, [64, 64]);
}

#[test]
fn a_caustic_is_written_and_shades_its_receiver() {
    let folder = tempfile::tempdir().unwrap();
    let path = |name: &str| folder.path().join(name).to_string_lossy().into_owned();
    let map = path("floor.exr");
    let answer = &objects(&format!(
        "caustics caustic-ball --receiver floor --size 32x16 --photons 20000 --seed 3 --out {map}"
    ))[0];
    assert_eq!(answer["size_bins"], serde_json::json!([32, 16]));
    assert!(answer["deposited"][0].as_f64().unwrap() > 0.0, "{answer}");
    let layers = layers_of(&map);
    assert_eq!(layers.len(), 2, "{layers:?}");
    assert!(layers.contains(&("irradiance".to_owned(), 3)), "{layers:?}");
    let common = "reference caustic-ball --resolution 16 --positions 1 --level r2 -o";
    done(&format!("{common} {}", path("direct.exr")));
    done(&format!("{common} {} --caustics floor={map}", path("lit.exr")));
    let read = |name: &str| scenes::image::read(std::path::Path::new(&path(name))).unwrap();
    assert_ne!(read("direct.exr"), read("lit.exr"));
    let out = path("no.exr");
    for (arguments, hint) in [
        (format!("caustics caustic-ball --receiver roof -o {out}"), "1 (floor)"),
        (format!("caustics caustic-ball --receiver ball -o {out}"), "lambert"),
        (format!("caustics ball --receiver 0 -o {out}"), "[[light]]"),
        (format!("caustics caustic-ball --receiver floor -o {}", path("no.png")), ".exr"),
        (format!("reference caustic-ball -o {out} --caustics floor={map}"), "--level r2"),
        (format!("reference caustic-ball -o {out} --level r2 --caustics {map}"), "RECEIVER=FILE"),
        (
            format!(
                "reference caustic-ball -o {out} --level r2 --caustics floor={}",
                path("lit.exr")
            ),
            "no layer \"irradiance\"",
        ),
    ] {
        let ran = snell(&arguments);
        assert_eq!(ran.status, Some(2), "{arguments}");
        assert!(ran.message.contains(hint), "{arguments}: {}", ran.message);
    }
    assert!(!std::path::Path::new(&out).exists());
}

/// Lines of standard error that are objects of a schema.
fn told(ran: &Ran, schema: &str) -> Vec<Value> {
    let objects = ran.message.lines().filter_map(|line| serde_json::from_str(line).ok());
    objects.filter(|object: &Value| object["schema"] == schema).collect()
}

#[test]
fn progress_is_told_to_programs_too() {
    let folder = tempfile::tempdir().unwrap();
    let image = folder.path().join("a.exr").to_string_lossy().into_owned();
    let asked = format!("reference ball -o {image} --resolution 64 --positions 2");
    let lines = told(&snell(&format!("{asked} --progress json")), "snell.progress/1");
    assert!(!lines.is_empty());
    let shares: Vec<f64> = lines.iter().map(|line| line["share"].as_f64().unwrap()).collect();
    assert!(shares.is_sorted() && shares.iter().all(|share| (0.0..=1.0).contains(share)));
    assert_eq!(lines[0]["work"], "tracing ball");
    // Unasked, nothing is told where nobody looks.
    for silent in [asked.clone(), format!("{asked} --progress none")] {
        assert_eq!(snell(&silent).message, "", "{silent}");
    }
}

/// Of a command that fails and of words that are none: text, or one object.
#[test]
fn errors_are_objects_where_answers_are() {
    for (arguments, word) in [
        ("reference no-such-scene -o a.exr", "no-such-scene"),
        ("reference ball -o a.exr --no-such-option", "--no-such-option"),
        ("comprae a b", "compare"),
    ] {
        let ran = snell(&format!("{arguments} --json"));
        assert_eq!((ran.status, ran.answer.as_str()), (Some(2), ""), "{arguments}");
        let object: Value = serde_json::from_str(&ran.message).unwrap();
        assert_eq!(object["schema"], "snell.error/1");
        assert_eq!(object["exit_status"], 2);
        assert!(object["message"].as_str().unwrap().contains(word), "{object}");
        let text = snell(arguments).message;
        assert!(text.starts_with("error: ") && text.contains(word), "{text}");
    }
}

#[test]
fn shells_and_manuals_know_the_commands() {
    for shell in ["bash", "zsh", "fish"] {
        let text = done(&format!("completions {shell}"));
        for word in ["caustics", "budget-ms"] {
            assert!(text.contains(word), "{shell}: {word}");
        }
    }
    assert!(done("man").contains(".TH snell 1"));
    let study = done("man study");
    assert!(study.contains("budget") && study.contains(".TH snell"), "{study}");
    let ran = snell("man no-such-command");
    assert_eq!(ran.status, Some(2));
    assert!(ran.message.contains("write one of scenes, methods"), "{}", ran.message);
}
