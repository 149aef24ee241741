//! Every option of every command has an effect or is refused: none is ignored.
#![allow(clippy::unwrap_used, reason = "an answer that cannot be read must fail its test")]

use How::{Answer, Elsewhere, Image, Refused};
use serde_json::Value;
use snell_tests::{Ran, root, run};
use std::collections::BTreeSet;
use std::path::Path;
use std::process::Command;

/// How one sees that an option is not ignored.
#[derive(Clone, Copy)]
enum How {
    /// With these words in place of the option alone, the image is another one.
    Image(&'static str),
    /// The answer is another one, times apart.
    Answer(&'static str),
    /// These words are refused with that one.
    Refused(&'static str, &'static str),
    /// A test of that name sees to it.
    Elsewhere(&'static str),
}

/// One scene in which everything matters.
const SCENE: &str = r#"[camera]
eye = [0.0, 0.3, 4.0]
target = [0.0, 0.0, 0.0]
vertical_fov_deg = 35.0
resolution_px = [10, 10]
[environment]
sky = { sun = { direction = [0.3, 1.0, 0.5], radius_deg = 4.0, radiance = [30.0, 30.0, 30.0] } }
cube_size_px = 16
[sequence]
frames = 2
seconds_per_frame = 0.5
[[object]]
shape = { box = { half_extent_m = [0.5, 0.5, 0.5] } }
surface = "dielectric"
medium = { eta = 1.5, dispersion = 1.0 }
motion = { path = { points_m = [[0.0, 0.0, 0.0], [0.4, 0.1, 0.0]], seconds_per_point = 0.5 } }
rotation_deg = [20.0, 30.0, 0.0]
[[object]]
name = "floor"
shape = { box = { half_extent_m = [3.0, 0.1, 3.0] } }
translation_m = [0.0, -1.0, 0.0]
surface = "lambert"
albedo = [0.5, 0.5, 0.5]
[[light]]
directional = { direction = [0.0, -1.0, 0.1], irradiance = [1.0, 1.0, 1.0] }
"#;

const REFERENCE: &str = "reference s.toml -o OUT --positions 1 --cut 1e-3";
const REALTIME: &str = "realtime s.toml -m two-interface -o OUT --positions 1";
const CAUSTICS: &str =
    "caustics s.toml --receiver floor -o OUT --size 4 --photons 4000 --batches 4";
const PATHS: &str = "--estimator paths --batches 2 --samples 2";

/// Command, how it is run without the option, option, how it shows.
const TABLE: &[(&str, &str, &str, How)] = &[
    ("reference", REFERENCE, "--map", Image("--map grey.exr")),
    ("reference", REFERENCE, "--eta", Image("--eta 2.0")),
    ("reference", REFERENCE, "--layers", Image("--layers exit")),
    ("reference", REFERENCE, "--resolution", Image("--resolution 9x10")),
    ("reference", "reference s.toml -o OUT", "--positions", Image("--positions 1")),
    ("reference", REFERENCE, "--frame", Image("--frame 1")),
    ("reference", REFERENCE, "--frame", Refused("--frame 2", "the frames 0 to 1")),
    ("reference", REFERENCE, "--exposure", Refused("--exposure 1", "that of a .png")),
    ("reference", "reference s.toml -o OUT.png --positions 1", "--exposure", Image("--exposure 3")),
    ("reference", REFERENCE, "--level", Image("--level r2")),
    ("reference", "reference s.toml -o OUT --positions 1", "--estimator", Image(PATHS)),
    ("reference", "reference s.toml -o OUT --positions 1", "--cut", Image("--cut 0.2")),
    ("reference", REFERENCE, "--batches", Refused("--batches 2", "--estimator paths")),
    ("reference", REFERENCE, "--samples", Refused("--samples 2", "--estimator paths")),
    ("reference", REFERENCE, "--lattice", Refused("--lattice", "--estimator paths")),
    ("reference", REFERENCE, "--split", Refused("--split 1", "--estimator paths")),
    ("reference", REFERENCE, "--seed", Refused("--seed 1", "--estimator paths")),
    (
        "reference",
        "reference s.toml -o OUT --estimator paths --samples 2",
        "--batches",
        Image("--batches 3"),
    ),
    (
        "reference",
        "reference s.toml -o OUT --estimator paths --batches 2",
        "--samples",
        Image("--samples 3"),
    ),
    ("reference", RANDOM, "--lattice", Image("--lattice")),
    ("reference", RANDOM, "--split", Image("--split 1")),
    ("reference", RANDOM, "--seed", Image("--seed 1")),
    ("reference", RANDOM, "--cut", Refused("--cut 0.1", "--estimator tree")),
    ("reference", REFERENCE, "--polarised", Image("--polarised")),
    ("reference", REFERENCE, "--wavelengths", Image("--wavelengths 9")),
    ("reference", REFERENCE, "--lat-long", Image("--lat-long")),
    ("reference", REFERENCE, "--max-interfaces", Image("--max-interfaces 1")),
    ("reference", REFERENCE, "--max-events", Image("--max-events 2")),
    ("reference", REFERENCE, "--no-internal-reflection", Image("--no-internal-reflection")),
    ("reference", REFERENCE, "--fresnel", Image("--fresnel cubic")),
    ("reference", REFERENCE, "--caustics", Refused("--caustics floor=c.exr", "--level r2")),
    (
        "reference",
        REFERENCE,
        "--caustics",
        Elsewhere("a_caustic_is_written_and_shades_its_receiver"),
    ),
    ("reference", REFERENCE, "--threads", Refused("--threads 0", "1..=1024")),
    ("reference", "", "--progressive", Elsewhere("progressive_rendering_ends_with_the_same_image")),
    ("reference", "", "--progress", Elsewhere("progress_is_told_to_programs_too")),
    ("reference", "", "--out", Elsewhere("every_option_shows")),
    ("realtime", REALTIME, "--map", Image("--map grey.exr")),
    ("realtime", REALTIME, "--eta", Image("--eta 2.0")),
    (
        "realtime",
        "realtime s.toml -o OUT --positions 1",
        "--method",
        Refused("-m no-such-method", "no-such-method"),
    ),
    ("realtime", REALTIME, "--param", Refused("--param nonsense=1", "nonsense")),
    ("realtime", REALTIME, "--timing", Answer("--timing 0.01")),
    ("realtime", REALTIME, "--hardware-filter", Image("--hardware-filter")),
    ("realtime", REALTIME, "--keep-all", Answer("--keep-all")),
    ("realtime", REALTIME, "--layers", Image("--layers exit")),
    ("realtime", REALTIME, "--resolution", Image("--resolution 9x10")),
    ("realtime", "realtime s.toml -m two-interface -o OUT", "--positions", Image("--positions 1")),
    ("realtime", REALTIME, "--frame", Image("--frame 1")),
    ("realtime", REALTIME, "--exposure", Refused("--exposure 1", "that of a .png")),
    ("realtime", REALTIME, "--adapter", Refused("--adapter no-such-thing", "no-such-thing")),
    ("realtime", "", "--out", Elsewhere("every_option_shows")),
    ("plan", "plan s.toml", "--method", Answer("--method undeviated")),
    ("plan", "plan s.toml", "--reference", Answer("--reference")),
    ("plan", "plan s.toml -m multi", "--adapter", Refused("--adapter no-such", "no-such")),
    ("plan", "plan s.toml --reference", "--map", Refused("--map no.exr", "no.exr")),
    ("plan", "plan s.toml --reference", "--eta", Refused("--eta 0.5", "below 1")),
    ("plan", "plan s.toml --reference", "--param", Refused("--param a=1", "--reference")),
    ("plan", "plan s.toml --reference", "--layers", Answer("--layers exit")),
    ("plan", "plan s.toml --reference", "--resolution", Answer("--resolution 4")),
    ("plan", "plan s.toml -m undeviated", "--positions", Answer("--positions 1")),
    ("plan", "plan s.toml --reference", "--frame", Refused("--frame 2", "the frames 0 to 1")),
    ("plan", "plan s.toml --reference", "--cut", Refused("--cut 2", "0 to 1")),
    ("plan", "plan s.toml --reference", "--polarised", Answer("--polarised")),
    ("plan", "plan s.toml --reference", "--wavelengths", Answer("--wavelengths 9")),
    ("plan", "plan s.toml --reference", "--lat-long", Answer("--lat-long")),
    ("plan", "", "--level", Elsewhere(OF_PLANS)),
    ("plan", "", "--estimator", Elsewhere(OF_PLANS)),
    ("plan", "", "--max-interfaces", Elsewhere(OF_PLANS)),
    ("plan", "", "--max-events", Elsewhere(OF_PLANS)),
    ("plan", "", "--no-internal-reflection", Elsewhere(OF_PLANS)),
    ("plan", "", "--fresnel", Elsewhere(OF_PLANS)),
    ("plan", "plan s.toml --reference", "--batches", Refused("--batches 2", "--estimator paths")),
    ("plan", "plan s.toml --reference", "--samples", Refused("--samples 2", "--estimator paths")),
    ("plan", "plan s.toml --reference", "--lattice", Refused("--lattice", "--estimator paths")),
    ("plan", "plan s.toml --reference", "--split", Refused("--split 1", "--estimator paths")),
    ("plan", "plan s.toml --reference", "--seed", Refused("--seed 1", "--estimator paths")),
    ("caustics", CAUSTICS, "--map", Refused("--map grey.exr", "changes nothing")),
    ("caustics", CAUSTICS, "--eta", Image("--eta 2.0")),
    ("caustics", CAUSTICS, "--receiver", Elsewhere("a_caustic_is_written_and_shades_its_receiver")),
    (
        "caustics",
        "caustics s.toml --receiver floor -o OUT --photons 4000",
        "--size",
        Image("--size 4"),
    ),
    (
        "caustics",
        "caustics s.toml --receiver floor -o OUT --size 4",
        "--photons",
        Image("--photons 4000"),
    ),
    (
        "caustics",
        "caustics s.toml --receiver floor -o OUT --size 4 --photons 4000",
        "--batches",
        Image("--batches 8"),
    ),
    ("caustics", CAUSTICS, "--seed", Image("--seed 1")),
    ("caustics", CAUSTICS, "--frame", Image("--frame 1")),
    ("caustics", "", "--out", Elsewhere("every_option_shows")),
    (
        "compare",
        "",
        "--flip-exposures",
        Refused("compare a.exr a.exr --flip-exposures 1,2", "START,STOP,COUNT"),
    ),
    ("compare", "", "--alpha", Refused("compare a.exr a.exr --alpha half", "over-black")),
    ("compare", "", "--display", Refused("compare a.exr a.exr --display 1", "ev=STOPS")),
    ("mesh", "", "--longest-hole", Refused("mesh a.obj --longest-hole 1", "--repair")),
    ("export", "", "--eta", Refused("export s.toml --to gltf -o x --eta 0.5", "below 1")),
    ("export", "", "--map", Refused("export s.toml --to mitsuba -o x --map no.exr", "no.exr")),
    (
        "export",
        "",
        "--frame",
        Refused("export s.toml --to gltf -o x --frame 2", "the frames 0 to 1"),
    ),
    ("export", "", "--to", Refused("export s.toml --to stl -o x", "mitsuba")),
    ("methods", "", "--bibtex", Elsewhere("methods_tell_their_parameters_and_their_papers")),
    (
        "bench",
        "",
        "--repetitions",
        Refused("bench --reference --against mitsuba --repetitions 9", "leave it out"),
    ),
    ("study", "", "--map", Refused("study s.toml --eta 2.0 --map missing.exr", "missing.exr")),
    ("study", "", "--eta", Refused("study s.toml --eta 0.5", "below 1")),
    ("study", "", "--adapter", Refused("study s.toml --adapter no-such-thing", "no-such-thing")),
    ("study", "", "--method", Refused("study s.toml -m no-such-method", "no-such-method")),
    ("study", "", "--cache", Elsewhere("a_cache_that_cannot_be_names_its_option")),
];

const RANDOM: &str = "reference s.toml -o OUT --estimator paths --batches 2 --samples 2";
const OF_PLANS: &str = "a_plan_of_the_reference_tells_what_the_options_take_away";

fn snell(folder: &Path, words: &str) -> Ran {
    let mut command = Command::new(env!("CARGO_BIN_EXE_snell-under-test"));
    run(command.current_dir(folder).args(words.split_whitespace()))
}

fn folder() -> tempfile::TempDir {
    let folder = tempfile::tempdir().unwrap();
    std::fs::write(folder.path().join("s.toml"), SCENE).unwrap();
    let mut layers = scenes::Layers::new([8, 4]);
    layers.push(scenes::LayerName::Radiance, 3, vec![0.25; 96]);
    scenes::image::write_exr(&folder.path().join("grey.exr"), &layers).unwrap();
    folder
}

/// What a run leaves in its image.
fn image(folder: &Path, words: &str) -> Vec<u8> {
    let name = if words.contains("OUT.png") { "x.png" } else { "x.exr" };
    let ran = snell(folder, &words.replace("OUT.png", name).replace("OUT", name));
    assert_eq!(ran.status, Some(0), "{words}: {}", ran.message);
    let bytes = std::fs::read(folder.join(name)).unwrap();
    std::fs::remove_file(folder.join(name)).unwrap();
    bytes
}

/// What a run answers, but for its times.
fn answer(folder: &Path, words: &str) -> Option<Value> {
    let ran = snell(folder, &format!("{} --json", words.replace("OUT", "x.exr")));
    let mut object: Value = serde_json::from_str(ran.answer.lines().next()?).unwrap();
    if let Some(passes) = object.get_mut("passes").and_then(Value::as_array_mut) {
        for times in passes.iter_mut().filter_map(|pass| pass.get_mut("times")) {
            *times = times.as_array().unwrap().len().into();
        }
    }
    Some(object)
}

#[test]
fn every_option_shows() {
    let folder = folder();
    let folder = folder.path();
    for (command, base, option, how) in TABLE {
        let named = |words: &str| words.contains(option) || words.contains(short(option));
        match how {
            Image(words) => {
                assert!(named(words) || *words == PATHS, "{words} is no case of {option}");
                let with = image(folder, &format!("{base} {words}"));
                assert_ne!(image(folder, base), with, "{command} {option}");
            }
            Answer(words) => {
                assert!(named(words), "{words} is no case of {option}");
                let with = answer(folder, &format!("{base} {words}"));
                assert!(with.is_some(), "{command} {option}");
                assert_ne!(answer(folder, base), with, "{command} {option}");
            }
            Refused(words, hint) => {
                assert!(named(words), "{words} is no case of {option}");
                let ran = snell(folder, &format!("{base} {words}").replace("OUT", "x.exr"));
                assert_eq!((ran.status, ran.answer.as_str()), (Some(2), ""), "{command} {option}");
                assert!(ran.message.contains(hint), "{command} {option}: {}", ran.message);
                assert!(!folder.join("x.exr").exists(), "{command} {option}");
            }
            Elsewhere(_) => {}
        }
    }
}

fn short(option: &str) -> &'static str {
    match option {
        "--method" => "-m ",
        _ => "\0",
    }
}

/// Whoever adds an option adds a row; those of studies, which take long, are in
/// the tests of studies.
#[test]
fn no_option_is_forgotten() {
    let tests: String = ["cli.rs", "options.rs", "warnings.rs", "flow.rs"]
        .map(|file| std::fs::read_to_string(root().join("tests/program").join(file)).unwrap())
        .concat();
    for (_, _, option, how) in TABLE {
        if let Elsewhere(test) = how {
            assert!(tests.contains(&format!("fn {test}()")), "{option}: {test}");
        }
    }
    for command in ["reference", "realtime", "plan", "caustics"] {
        let help = snell(&root(), &format!("{command} --help")).answer;
        let words = help.split_whitespace().map(|word| word.trim_end_matches(','));
        let starts = help.lines().filter(|line| line.trim_start().starts_with('-'));
        let options: BTreeSet<&str> = starts
            .flat_map(|line| line.split_whitespace().find(|word| word.starts_with("--")))
            .filter(|option| !["--json", "--help", "--deny-warnings"].contains(option))
            .collect();
        assert!(options.len() > 6 && words.count() > 50, "{help}");
        let rows = TABLE.iter().filter(|row| row.0 == command).map(|row| row.2);
        assert_eq!(options, rows.collect::<BTreeSet<_>>(), "{command}");
    }
}
