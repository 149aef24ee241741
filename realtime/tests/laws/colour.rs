//! Dispersion: each channel is the image of a body of that channel's index.

use crate::*;
use scenes::environment::{LatLong, Map};
use scenes::medium::{Dispersion, RGB_WAVELENGTH_UM};
use scenes::{Cube, Plan};

/// A ball before a smooth environment, so that directions show.
fn ball(medium: Medium) -> Scene {
    let mut scene = scene_of(Shape::Sphere { radius_m: 1.0 }, 1.5, parallel(2.2, [48, 48]));
    scene.media[1] = medium;
    let cube = Cube::from_fn(32, |direction| 0.5 * direction + 0.5);
    let lat_long = LatLong { size_px: [1, 1], texels: vec![[1.0; 3]] };
    let map = Map { name: "test".into(), lat_long, cube, rotation_deg: 0.0, repaired_texels: 0 };
    scene.environment = Environment::Map(Arc::new(map));
    scene
}

fn radiance(scene: &Scene, method: &str) -> Vec<DVec3> {
    let request = request(scene, method, &[LayerName::Radiance]);
    let rendering = realtime::render(&GPU, scene, &request).unwrap();
    vectors(&rendering.layers, &LayerName::Radiance)
}

fn strong() -> Medium {
    let dispersion = Dispersion::Gltf { dispersion: 4.0 };
    Medium { dispersion, ..Medium::plain("flint", Eta::try_from(1.6).unwrap()) }
}

#[test]
fn each_channel_is_the_image_at_its_own_index() {
    let glass = strong();
    for method in ["two-interface", "multi", "multi-paper"] {
        let together = radiance(&ball(glass.clone()), method);
        for (channel, um) in RGB_WAVELENGTH_UM.into_iter().enumerate() {
            let eta = Eta::try_from(glass.eta_at(um)).unwrap();
            let alone = radiance(&ball(Medium::plain("one", eta)), method);
            let worst = together.iter().zip(&alone).map(|(a, b)| (a[channel] - b[channel]).abs());
            let worst = worst.fold(0.0, f64::max);
            assert!(worst < 1e-5, "{method} channel {channel}: {worst}");
        }
        // The control: the channels do differ.
        let plain = radiance(&ball(Medium::plain("d", glass.eta)), method);
        assert!(together.iter().zip(&plain).any(|(a, b)| (a.z - b.z).abs() > 0.01), "{method}");
    }
}

/// Three traces only where a medium disperses and the method can; else it says so.
#[test]
fn one_trace_serves_where_nothing_disperses() {
    let plan = |medium: Medium, method: &str| -> Plan {
        let scene = ball(medium);
        realtime::plan(&scene, &request(&scene, method, &[LayerName::Radiance])).unwrap()
    };
    let left_out = |plan: &Plan| plan.left_out.iter().any(|l| l.what.contains("red and blue"));
    let says_so = |plan: &Plan| plan.unsupported.iter().any(|u| u.what == "dispersion");
    let plain = plan(Medium::plain("d", strong().eta), "multi");
    assert!(left_out(&plain) && !says_so(&plain));
    let coloured = plan(strong(), "multi");
    assert!(!left_out(&coloured) && !says_so(&coloured));
    assert!(says_so(&plan(strong(), "blended")));
}
