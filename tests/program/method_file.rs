//! A method of one's own: one file of WGSL, no compiler. It gets a plan, an image,
//! times, and its place in a report.

#![allow(clippy::unwrap_used, reason = "a failing test may panic")]

use snell_tests::{Ran, root, run};
use std::process::Command;

fn snell(arguments: &[&str]) -> Ran {
    let mut command = Command::new(env!("CARGO_BIN_EXE_snell-under-test"));
    run(command.current_dir(root()).args(arguments))
}

/// Bends once, at the mean of the front normal and the reversed back normal.
const TOY: &str = "// A toy: one bend at the mean of both normals.

fn trace(pixel: vec2i, v_ws: vec3f, surface: Surface) -> Trace {
    let back = back_normal_at(pixel);
    let mean = normalize(surface.normal_ws - select(vec3f(0.0), back.xyz, back.w > 0.5));
    let bent = bend(v_ws, mean, frame.eta_outside / eta_body(surface.body));
    return Trace(bent.direction, bent.direction, vec3f(0.0), 0.0, 1u, 0u);
}
";

fn folder_with(name: &str, text: &str) -> (tempfile::TempDir, String) {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join(name);
    std::fs::write(&path, text).unwrap();
    let path = path.to_str().unwrap().to_owned();
    (folder, path)
}

#[test]
fn a_file_is_a_method_with_a_plan_of_its_own() {
    let (_folder, file) = folder_with("toy.wgsl", TOY);
    let plan = snell(&["plan", "ball", "-m", &file, "--json"]);
    assert_eq!(plan.status, Some(0), "{}", plan.message);
    // It reads the back normals, so they are drawn; it reads no depth of the back.
    assert!(plan.answer.contains("back_normal") && !plan.answer.contains("\"back_depth\""));
    let (_folder, file) =
        folder_with("less.wgsl", &TOY.replace("back_normal_at(pixel)", "vec4f(0.0)"));
    let plan = snell(&["plan", "ball", "-m", &file, "--json"]);
    assert!(!plan.answer.contains("\"back_normal\""), "{}", plan.answer);
}

#[test]
fn a_file_is_judged_timed_and_reported() {
    let (folder, file) = folder_with("toy.wgsl", TOY);
    let out = folder.path().join("out").to_str().unwrap().to_owned();
    let cache = folder.path().join("cache").to_str().unwrap().to_owned();
    let size = ["--resolution", "48x48", "--positions", "1", "--timing", "0.01"];
    let study = ["study", "ball", "-m", "undeviated", "--method-file", &file];
    let places = ["--out", &out, "--cache", &cache];
    let ran = snell(&[&study[..], &size[..], &places[..]].concat());
    assert_eq!(ran.status, Some(0), "{}", ran.message);
    assert!(ran.answer.contains("toy"), "{}", ran.answer);
    let rows = std::fs::read_to_string(folder.path().join("out/results.jsonl")).unwrap();
    let rows = rows.lines().map(|line| serde_json::from_str::<serde_json::Value>(line).unwrap());
    let is_time =
        |row: &serde_json::Value| row["metric"] == "time_wall_ms" && row["method"] == "toy";
    let timed: Vec<_> = rows.filter(is_time).collect();
    assert!(!timed.is_empty() && timed.iter().all(|row| row["n"].as_u64().unwrap() >= 3));
    let is_software = timed[0]["software"].as_bool().unwrap();
    let heading = if is_software { "CPU ms (software adapter)" } else { "GPU ms" };
    assert!(ran.answer.contains(heading), "{}", ran.answer);
    let report = std::fs::read_to_string(folder.path().join("out/report.html")).unwrap();
    assert!(report.contains("toy"));
    assert_eq!(std::fs::read_to_string(folder.path().join("out/methods/toy.wgsl")).unwrap(), TOY);
    assert!(!folder.path().join("out/methods/undeviated.wgsl").exists());
}

/// A parameter of the head is listed, set, refused out of its range, and is a constant.
#[test]
fn parameters_of_a_file_are_set_like_those_of_any_method() {
    let head = "// parameter: tilt = 0 [-1 to 1 rad]: turns what comes out\n";
    let turned = TOY.replace(
        "return Trace(bent.direction,",
        "return Trace(normalize(bent.direction + vec3f(TILT, 0.0, 0.0)),",
    );
    let (folder, file) = folder_with("tilted.wgsl", &format!("{head}{turned}"));
    let image = |name: &str, set: &[&str]| {
        let path = folder.path().join(name).to_str().unwrap().to_owned();
        let asked = ["realtime", "ball", "-m", &file, "--resolution", "16x16", "-o", &path];
        let ran = snell(&[&asked[..], set].concat());
        // The light, and not what the file says of how it was asked for.
        let layers = scenes::image::read(&folder.path().join(name)).ok();
        let light =
            layers.and_then(|l| l.get(&scenes::LayerName::Radiance).map(|l| l.data.clone()));
        (ran, light)
    };
    let (ran, plain) = image("plain.exr", &[]);
    assert_eq!(ran.status, Some(0), "{}", ran.message);
    let (_, same) = image("same.exr", &["-p", "tilt=0"]);
    let (_, other) = image("other.exr", &["-p", "tilt=0.5"]);
    assert!(plain == same && plain.is_some() && plain != other && other.is_some());
    let (refused, nothing) = image("refused.exr", &["-p", "tilt=2"]);
    assert!(refused.status == Some(2) && nothing.is_none());
    assert!(refused.message.contains("from -1 to 1"), "{}", refused.message);
    let (refused, _) = image("unknown.exr", &["-p", "tild=0.1"]);
    assert!(refused.message.contains("there are: tilt"), "{}", refused.message);
}

#[test]
fn what_is_wrong_with_a_file_is_said_with_its_line() {
    let cases = [
        ("broken.wgsl", TOY.replace("select(", "selekt("), "broken.wgsl:5"),
        ("empty.wgsl", String::new(), "fn trace("),
        ("type.wgsl", TOY.replace("0.0, 1u, 0u)", "0.0, 1.0, 0u)"), "type.wgsl:7: "),
        ("value.wgsl", TOY.replace("let mean = ", "let mean: f32 = "), "value.wgsl:5: "),
        ("head.wgsl", format!("// parameter: a\n{TOY}"), "line 1: `// parameter: a`"),
        ("dx7.wgsl", TOY.to_owned(), "already"),
    ];
    for (name, text, expected) in cases {
        let (_folder, file) = folder_with(name, &text);
        let ran = snell(&["plan", "ball", "-m", &file]);
        assert_eq!(ran.status, Some(2), "{name}");
        assert!(ran.message.contains(expected), "{name}: {}", ran.message);
    }
    let ran = snell(&["plan", "ball", "-m", "nowhere.wgsl"]);
    assert!(ran.status == Some(2) && ran.message.contains("nowhere.wgsl"), "{}", ran.message);
}
