//! The report in a real browser, opened from a file, without a network.
//!
//! Needs Chromium: `chromium` on the PATH, or its path in `CHROMIUM`. Slow, so
//! `make test-all` runs it.
#![allow(clippy::unwrap_used, reason = "a test may stop at the first failure")]

mod made_up_study;

use compare::report::pictures::colour_map::{exposure, ramp, show};
use compare::report::{self};
use half::f16;
use made_up_study::{SIZE, ball, study};
use scenes::LayerName;
use serde_json::Value;
use std::path::{Path, PathBuf};
use std::process::Command;

/// A script that visits addresses and reads the colour of one pixel in each.
const PROBE: &str = r#"<script>
(async () => {
  const pause = (ms) => new Promise((done) => setTimeout(done, ms));
  const canvas = document.getElementById('v-canvas');
  const found = [];
  for (const { hash, x, y } of VISITS) {
    location.hash = hash;
    await pause(1500);
    const gl = canvas.getContext('webgl2'), size = WIDTH, scale = canvas.width / size;
    const pixel = new Uint8Array(4);
    gl.readPixels(Math.floor((x + 0.5) * scale), canvas.height - 1 - Math.floor((y + 0.5) * scale),
      1, 1, gl.RGBA, gl.UNSIGNED_BYTE, pixel);
    found.push([pixel[0], pixel[1], pixel[2]]);
  }
  const box = canvas.getBoundingClientRect();
  canvas.dispatchEvent(new PointerEvent('pointermove', { clientX: box.left + box.width / 2, clientY: box.top + box.height / 4 }));
  const pressed = () => document.querySelector('#v-images [aria-pressed=true]').textContent;
  const inspected = () => document.getElementById('v-pixel').textContent;
  const labels = () => getComputedStyle(document.getElementById('v-left-name')).display !== 'none';
  const keys = [];
  for (const key of ['1', 'ArrowRight', 'ArrowRight', 'ArrowRight', 's', 's']) {
    document.dispatchEvent(new KeyboardEvent('keydown', { key }));
    await pause(500);
    keys.push({ key, chosen: pressed(), text: inspected(), split_label: labels() });
  }
  document.dispatchEvent(new KeyboardEvent('keydown', { key: '1' }));
  await pause(500);
  const wide = document.documentElement.scrollWidth > innerWidth;
  document.documentElement.dataset.probe = JSON.stringify({
    found, keys, wide, text: inspected(), hash: location.hash, texel: canvas.dataset.texel });
})();
</script></body>"#;

fn chromium() -> PathBuf {
    std::env::var_os("CHROMIUM").map_or_else(|| PathBuf::from("chromium"), PathBuf::from)
}

/// The document after the probe has run, and what the console said.
fn visit(page: &Path, width: u32) -> (String, String) {
    let profile = tempfile::tempdir().unwrap();
    let output = Command::new(chromium())
        .args(["--headless=new", "--no-sandbox", "--use-angle=swiftshader"])
        .args(["--enable-unsafe-swiftshader", "--enable-logging=stderr", "--dump-dom"])
        .args(["--virtual-time-budget=30000", "--host-resolver-rules=MAP * ~NOTFOUND"])
        .arg(format!("--window-size={width},1000"))
        .arg(format!("--user-data-dir={}", profile.path().display()))
        .arg(format!("file://{}", page.display()))
        .output()
        .expect("Chromium is needed: install Debian's `chromium`, or set CHROMIUM");
    let log = String::from_utf8_lossy(&output.stderr);
    let console: Vec<&str> = log.lines().filter(|line| line.contains("CONSOLE")).collect();
    (String::from_utf8_lossy(&output.stdout).into_owned(), console.join("\n"))
}

/// Visits addresses of the report and returns what the probe saw.
fn probe(name: &str, width: u32, visits: &Value) -> Value {
    let directory = Path::new(env!("CARGO_TARGET_TMPDIR")).join(name);
    study(&directory);
    let page = report::write(&directory, report::Options::default()).unwrap().html;
    probe_page(&page, width, visits)
}

/// The same of a page that is there.
fn probe_page(page: &Path, width: u32, visits: &Value) -> Value {
    let script = PROBE.replace("VISITS", &visits.to_string()).replace("WIDTH", &SIZE.to_string());
    let html = std::fs::read_to_string(page).unwrap().replace("</body>", &script);
    let probed = page.with_file_name("probed.html");
    std::fs::write(&probed, html).unwrap();
    let (dom, console) = visit(&probed, width);
    assert_eq!(console, "", "the console is not silent");
    let start = dom.find("data-probe=\"").expect("the probe did not finish") + 12;
    let end = start + dom[start..].find('"').unwrap();
    serde_json::from_str(&dom[start..end].replace("&quot;", "\"").replace("&amp;", "&")).unwrap()
}

fn near(found: &Value, expected: [u8; 3]) -> bool {
    (0..3).all(|c| (found[c].as_i64().unwrap() - i64::from(expected[c])).abs() <= 1)
}

#[test]
#[ignore = "starts a browser"]
fn the_viewer_shows_the_values_of_the_images() {
    let (exact, one) = (ball(2), ball(1));
    let colours = |layers: &scenes::Layers| layers.get(&LayerName::Radiance).unwrap().data.clone();
    let (r, t) = (colours(&exact), colours(&one));
    let half = |v: f64| f16::from_f64(v).to_f64();
    let at = |image: &[f64], x: usize, y: usize| {
        let from = 3 * (y * SIZE + x);
        [half(image[from]), half(image[from + 1]), half(image[from + 2])]
    };
    let visits = serde_json::json!([
        { "hash": "#v=0.0.radiance&split=0", "x": 60, "y": 150 },
        { "hash": "#v=0.2.radiance&split=0&ev=1", "x": 60, "y": 150 },
        { "hash": "#v=0.2.difference&split=0&ev=2", "x": 96, "y": 30 },
        { "hash": "#v=1.2.angle&split=0", "x": 96, "y": 20 },
        { "hash": "#v=1.2.angle&split=0", "x": 1, "y": 1 },
        { "hash": "#v=0.2.radiance&split=0.9", "x": 60, "y": 150 },
    ]);
    let seen = probe("probed-report", 1280, &visits);
    let (ev, found) = (exposure(&r), &seen["found"]);
    assert!(near(&found[0], show(at(&r, 60, 150), ev)), "exact: {seen}");
    assert!(near(&found[1], show(at(&t, 60, 150), 1.0)), "one interface, a stop more: {seen}");
    let (a, b) = (at(&t, 96, 30), at(&r, 96, 30));
    let difference = std::array::from_fn(|c| (a[c] - b[c]).abs());
    assert!(near(&found[2], show(difference, 2.0)), "difference: {seen}");
    let exits = |layers: &scenes::Layers| layers.get(&LayerName::Exit).unwrap().data.clone();
    let angles = compare::metric::exit_angle::exit_angle_map_deg(&exits(&exact), &exits(&one));
    let angle = half(angles[20 * SIZE + 96]);
    let share = compare::report::pictures::colour_map::angle_share(angle);
    assert!(near(&found[3], ramp(share)), "angle {angle}: {seen}");
    assert!(near(&found[4], [128; 3]), "no exit is grey: {seen}");
    assert!(near(&found[5], show(at(&r, 60, 150), ev)), "left of the split is exact: {seen}");
    // Negative control: the two images differ where they were probed.
    assert!(!near(&found[0], show(at(&t, 60, 150), ev)), "{seen}");

    let text = seen["text"].as_str().unwrap();
    assert!(text.starts_with("pixel 96, 48") || text.starts_with("pixel 95, 4"), "{text}");
    assert!(seen["hash"].as_str().unwrap().contains("v=0.0.radiance"), "{seen}");
    keys_choose_and_the_inspector_follows(&seen["keys"]);
}

/// Keys 1, →, →, →, s, s: the arrows go round, what is told of the pixel is the chosen
/// image's, and no name stands left of a split that is not there.
fn keys_choose_and_the_inspector_follows(keys: &Value) {
    let text = |step: usize| keys[step]["text"].as_str().unwrap();
    let chosen: Vec<&str> = (0..4).map(|i| keys[i]["chosen"].as_str().unwrap()).collect();
    assert_eq!(chosen[0], "1 exact");
    assert!(chosen[1].starts_with("2 ") && chosen[2].starts_with("3 "), "{chosen:?}");
    assert_eq!(chosen[3], "1 exact");
    assert_eq!((&keys[4]["split_label"], &keys[5]["split_label"]), (&false.into(), &true.into()));
    assert_ne!(text(1), text(2), "the pointer rests and the image changed");
    assert!(text(1).contains(&chosen[1][2..]), "{keys}");
}

/// A page that would become too large holds means of pixels and says so; with the folder
/// beside it the viewer shows every pixel.
#[test]
#[ignore = "starts a browser"]
fn pixels_that_the_page_has_no_room_for_lie_beside_it() {
    let directory = Path::new(env!("CARGO_TARGET_TMPDIR")).join("large-report");
    study(&directory);
    let small = report::Options { data_in_page_bytes: 1e6, ..report::Options::default() };
    let page = report::write(&directory, small).unwrap().html;
    let visits = serde_json::json!([{ "hash": "#v=0.0.radiance&split=0", "x": 60, "y": 150 }]);
    let r = ball(2).get(&LayerName::Radiance).unwrap().data.clone();
    let exact = std::array::from_fn(|c| f16::from_f64(r[3 * (150 * SIZE + 60) + c]).to_f64());
    let full = probe_page(&page, 1280, &visits);
    assert_eq!(full["texel"], "1", "{full}");
    assert!(near(&full["found"][0], show(exact, exposure(&r))), "{full}");
    assert!(full["text"].as_str().unwrap().starts_with("pixel 9"), "{full}");
    std::fs::remove_dir_all(directory.join("data")).unwrap();
    let alone = probe_page(&page, 1280, &visits);
    assert_eq!(alone["texel"], "2", "{alone}");
    let text = alone["text"].as_str().unwrap();
    assert!(text.starts_with("pixels 96 to 97, 48 to 49 (their mean"), "{text}");
}

#[test]
#[ignore = "starts a browser"]
fn nothing_is_wider_than_a_narrow_window() {
    let seen = probe("narrow-report", 500, &serde_json::json!([]));
    assert_eq!(seen["wide"], false, "{seen}");
}
