//! Light that lights send to a surface, against closed forms.
#![allow(clippy::unwrap_used, reason = "a scene that cannot be read must fail its test")]

use glam::DVec3;
use reference::{CausticMap, CausticsRequest, Level, Request, caustics, render};
use scenes::{LayerName, Scene, View};
use std::path::Path;
use std::sync::Arc;

const HEAD: &str = "[camera]\neye = [0.0, 4.0, 0.01]\ntarget = [0.0, 0.0, 0.0]\n\
    vertical_fov_deg = 20.0\nresolution_px = [16, 16]\n[environment]\nradiance = [0.0, 0.0, 0.0]\n";

/// A floor whose face is y = 0, 2 m wide, and more.
fn scene(more: &str) -> Scene {
    let floor = "[[object]]\nname = \"floor\"\nshape = { box = { half_extent_m = [1.0, 0.1, 1.0] } }\n\
        surface = \"lambert\"\nalbedo = [0.5, 0.5, 0.5]\ntranslation_m = [0.0, -0.1, 0.0]\n";
    scenes::parse(&format!("{HEAD}{floor}{more}"), "test", Path::new("")).unwrap()
}

fn glass(shape: &str, more: &str) -> String {
    format!("[[object]]\nname = \"glass\"\nshape = {shape}\nsurface = \"dielectric\"\n{more}\n")
}

const DOWN: &str =
    "[[light]]\ndirectional = { direction = [0.0, -1.0, 0.0], irradiance = [3.0, 2.0, 1.0] }\n";

fn request(bins: u32, photons: u64) -> CausticsRequest {
    CausticsRequest {
        receiver: 0,
        size_bins: [bins, bins],
        photons,
        batches: 64,
        seed: 1,
        frame: 0,
    }
}

fn map(scene: &Scene, bins: u32, photons: u64) -> CausticMap {
    caustics(scene, &request(bins, photons)).unwrap()
}

/// Bins that differ from what is expected by more than 4 standard errors.
fn beyond_4_se(map: &CausticMap, expected: impl Fn(usize) -> DVec3) -> usize {
    let far = |i: &usize| {
        let difference = (map.irradiance[*i] - expected(*i)).abs();
        difference.cmpgt(4.0 * map.variance[*i].map(f64::sqrt) + 1e-9).any()
    };
    (0..map.irradiance.len()).filter(far).count()
}

/// Without glass a point light gives E = I cos θ / d².
#[test]
fn a_point_light_falls_off_with_the_square() {
    let at = DVec3::new(0.3, 1.2, -0.2);
    let light =
        "[[light]]\npoint = { position_m = [0.3, 1.2, -0.2], intensity = [2.0, 1.0, 0.5] }\n";
    let found = map(&scene(light), 8, 1 << 20);
    let exact = |i: usize, tilt: f64| {
        // The mean over a bin by 16 x 16 midpoints.
        let mut sum = DVec3::ZERO;
        for k in 0..256 {
            let x = ((i % 8) as f64 + (f64::from(k % 16) + 0.5) / 16.0) / 4.0 - 1.0;
            let z = ((i / 8) as f64 + (f64::from(k / 16) + 0.5) / 16.0) / 4.0 - 1.0;
            let to = at - DVec3::new(x, 0.0, z);
            sum += DVec3::new(2.0, 1.0, 0.5) * (to.y + tilt) / to.length().powi(3);
        }
        sum / 256.0
    };
    assert_eq!(beyond_4_se(&found, |i| exact(i, 0.0)), 0);
    // A tenth more is seen.
    assert!(beyond_4_se(&found, |i| exact(i, 0.12)) > 16);
}

/// A pane across the light passes (1 - R)² / (1 - R²) of it.
#[test]
fn a_pane_at_normal_incidence_passes_what_its_reflections_leave() {
    let pane = glass(
        "{ box = { half_extent_m = [1.5, 0.1, 1.5] } }",
        "medium = { eta = 4.0 }\ntranslation_m = [0.0, 0.5, 0.0]",
    );
    let found = map(&scene(&(pane + DOWN)), 4, 1 << 20);
    let r: f64 = 0.36;
    let light = DVec3::new(3.0, 2.0, 1.0);
    assert_eq!(beyond_4_se(&found, |_| light * (1.0 - r).powi(2) / (1.0 - r * r)), 0);
    // One reflection at each surface alone is too little.
    assert!(beyond_4_se(&found, |_| light * (1.0 - r).powi(2)) > 8);
}

/// What was sent arrived, was absorbed, or left.
#[test]
fn power_is_conserved() {
    let ball = "{ sphere = { radius_m = 0.4 } }";
    let up = "translation_m = [0.1, 0.6, 0.0]";
    let lamp = "[[light]]\npoint = { position_m = [0.5, 2.0, 0.0], intensity = [1.0, 2.0, 3.0] }\n";
    for (name, body) in [
        ("clear", glass(ball, &format!("medium = {{ eta = 1.5 }}\n{up}"))),
        (
            "coloured",
            glass(
                ball,
                &format!("medium = {{ eta = 1.5, absorption_per_m = [0.5, 2.0, 9.0] }}\n{up}"),
            ),
        ),
        (
            "dispersive",
            glass(ball, &format!("medium = {{ cauchy = {{ a = 1.7, b_um2 = 0.013 }} }}\n{up}")),
        ),
        (
            "mesh",
            glass(
                "{ builtin = \"cup\" }",
                "medium = { eta = 1.5 }\nscale = [0.5, 0.5, 0.5]\ntranslation_m = [0.0, 0.05, 0.0]",
            ),
        ),
    ] {
        let scene = scene(&(body + DOWN + lamp));
        let balance = map(&scene, 8, 1 << 16).balance;
        let arrived = balance.deposited + balance.absorbed + balance.escaped + balance.dropped;
        let lost = ((arrived - balance.emitted) / balance.emitted).abs().max_element();
        assert!(lost < 1e-12, "{name}: {lost:e} {balance:?}");
        assert!(balance.deposited.cmpgt(DVec3::ZERO).all(), "{name}");
        assert!(balance.dropped == DVec3::ZERO, "{name}: {balance:?}");
        let total: DVec3 = map(&scene, 8, 1 << 16).irradiance.iter().sum();
        let deposited = total * 4.0 / 64.0;
        assert!((deposited / balance.deposited - 1.0).abs().max_element() < 1e-12, "{name}");
    }
}

/// A ball gathers parallel light n r / (2 (n - 1)) from its centre, a little
/// nearer for a spot of finite size, because rays far from the axis meet before.
#[test]
fn a_ball_has_its_focal_length() {
    let (n, r) = (1.5, 0.2);
    let spot = |distance_m: f64| {
        let ball = glass(
            "{ sphere = { radius_m = 0.2 } }",
            &format!("medium = {{ eta = 1.5 }}\ntranslation_m = [0.0, {distance_m:?}, 0.0]"),
        );
        // Bins of 0.008 m; the middle one is on the axis.
        let found = map(&scene(&(ball + DOWN)), 251, 1 << 21);
        let brightest = (0..251 * 251)
            .max_by(|a: &usize, b| found.irradiance[*a].x.total_cmp(&found.irradiance[*b].x));
        (found.irradiance[125 * 251 + 125].x, brightest.unwrap())
    };
    let focal_m = n * r / (2.0 * (n - 1.0));
    let at: Vec<f64> = [0.8, 0.86, 0.92, 0.96, 1.0, 1.04, 1.08, 1.16].to_vec();
    let spots: Vec<(f64, usize)> = at.iter().map(|share| spot(share * focal_m)).collect();
    let best = (0..at.len()).max_by(|a, b| spots[*a].0.total_cmp(&spots[*b].0)).unwrap();
    assert!((0.9..=1.0).contains(&at[best]), "{:?}", spots.iter().map(|s| s.0).collect::<Vec<_>>());
    assert_eq!(spots[best].1, 125 * 251 + 125, "the brightest place is on the axis");
    assert!(spots[best].0 > 100.0 * 3.0, "{}", spots[best].0);
}

#[test]
fn the_map_does_not_depend_on_the_number_of_threads() {
    let ball = glass(
        "{ sphere = { radius_m = 0.4 } }",
        "medium = { eta = 1.5 }\ntranslation_m = [0.0, 0.6, 0.0]",
    );
    let scene = scene(&(ball + DOWN));
    let with = |threads: usize, seed: u64| {
        let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build().unwrap();
        let request = CausticsRequest { seed, ..request(16, 3_000_000) };
        pool.install(|| caustics(&scene, &request).unwrap())
    };
    let one = with(1, 5);
    assert_eq!(one, with(3, 5));
    assert_ne!(one, with(1, 6));
}

/// A map in place of the direct light: under no glass the image stays the same;
/// under a pane it is darker by what the pane keeps, and not twice as bright.
#[test]
fn shading_with_a_map_counts_no_light_twice() {
    let image = |scene: &Scene, map: Option<CausticMap>| {
        let view = View {
            resolution_px: [8, 8],
            positions_per_axis: 1,
            frame: 0,
            layers: vec![LayerName::Radiance],
        };
        let request = Request { caustics: map.map(Arc::new), ..Request::new(view, Level::R2) };
        let layers = render(scene, &request).unwrap().layers;
        layers.get(&LayerName::Radiance).unwrap().data[3 * 36]
    };
    let bare = scene(DOWN);
    let direct = image(&bare, None);
    assert!((direct - 0.5 * 3.0 / std::f64::consts::PI).abs() < 1e-12);
    let mapped = image(&bare, Some(map(&bare, 4, 1 << 18)));
    assert!((mapped / direct - 1.0).abs() < 1e-3, "{mapped} {direct}");
    let pane = glass(
        "{ box = { half_extent_m = [1.5, 0.1, 1.5] } }",
        "medium = { eta = 1.5 }\ntranslation_m = [0.0, 0.5, 0.0]",
    );
    let covered = scene(&(pane + DOWN));
    let ratio = image(&covered, Some(map(&covered, 4, 1 << 20))) / image(&covered, None);
    assert!((ratio - 0.96 / 1.04).abs() < 2e-3, "{ratio}");
}

#[test]
fn what_can_receive_nothing_is_refused() {
    let refused = |scene: &Scene, request: &CausticsRequest| {
        caustics(scene, request).unwrap_err().to_string()
    };
    let ball = glass("{ sphere = { radius_m = 0.4 } }", "medium = { eta = 1.5 }");
    let whole = scene(&(ball + DOWN));
    assert!(
        refused(&whole, &CausticsRequest { receiver: 1, ..request(4, 100) }).contains("lambert")
    );
    assert!(
        refused(&whole, &CausticsRequest { receiver: 7, ..request(4, 100) }).contains("receiver")
    );
    assert!(refused(&whole, &request(0, 100)).contains("bins"));
    assert!(refused(&whole, &request(4, 10)).contains("photons"));
    assert!(refused(&scene(""), &request(4, 100)).contains("[[light]]"));
    let slab = glass("{ slab = { thickness_m = 0.1 } }", "medium = { eta = 1.5 }");
    assert!(refused(&scene(&(slab + DOWN)), &request(4, 100)).contains("box"));
}
