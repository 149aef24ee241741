//! Leaving out changes no image, and what is not needed is really gone.

use crate::*;
use realtime::methods::Settings;
use realtime::{METHODS, Method};
use scenes::Rendering;

fn bodies() -> Vec<Scene> {
    let eye = perspective(DVec3::new(0.4, 0.8, 3.5), [64, 64]);
    let names = ["ice-cube", "cup", "uniform-ball", "ball-orthographic"];
    let built_in = names.map(|name| scenes::builtin(name).unwrap());
    let box_shape = Shape::Box { half_extent_m: DVec3::splat(0.5) };
    built_in.into_iter().chain([scene_of(box_shape, 1.5, eye)]).collect()
}

fn rendered(scene: &Scene, method: &str, keep: Keep) -> Rendering {
    let layers = [LayerName::Radiance, LayerName::Exit, LayerName::Flags, LayerName::Events];
    let mut request = request(scene, method, &layers);
    request.view.resolution_px = [64, 64];
    request.keep = keep;
    realtime::render(&GPU, scene, &request).unwrap()
}

/// Share of values that differ by more than one part in a million.
pub(crate) fn differing(a: &Rendering, b: &Rendering) -> f64 {
    let data = |r: &Rendering| -> Vec<f64> {
        [LayerName::Radiance, LayerName::Exit]
            .iter()
            .flat_map(|name| r.layers.get(name).unwrap().data.clone())
            .collect()
    };
    let (a, b) = (data(a), data(b));
    let far = a.iter().zip(&b).filter(|(a, b)| (*a - *b).abs() > 1e-6 * a.abs().max(1.0));
    far.count() as f64 / a.len() as f64
}

#[test]
fn the_image_is_the_same_with_and_without() {
    for scene in bodies() {
        for method in METHODS.iter() {
            let (with, without) = (
                rendered(&scene, method.id, Keep::Needed),
                rendered(&scene, method.id, Keep::Everything),
            );
            let share = differing(&with, &without);
            assert!(share <= 1e-4, "{} {}: {share}", scene.name, method.id);
            // And something was left out.
            assert!(with.counters["bytes"] < without.counters["bytes"], "{}", method.id);
        }
    }
    // The control: another index is another image.
    let mut other = bodies().remove(0);
    other.media[1] = Medium::plain("other", Eta::try_from(1.32).unwrap());
    let (a, b) = (
        rendered(&bodies()[0], "one-interface", Keep::Needed),
        rendered(&other, "one-interface", Keep::Needed),
    );
    assert!(differing(&a, &b) > 0.01);
}

#[test]
fn bodies_of_the_same_index_bend_nothing() {
    // Vectors between vertices and eq. 4 bend and reflect light even so.
    let settings = |method: &Method| Settings::new(method, &[].into()).unwrap();
    let bends = |method: &&Method| method.bends_at_equal_index(&settings(method));
    let bending: Vec<_> = METHODS.iter().filter(bends).map(|method| method.id).collect();
    assert_eq!(bending, ["dx7-vertex", "one-interface-vertex", "blended"]);
    for method in METHODS.iter().filter(|method| !bends(method)) {
        let mut scene = bodies().remove(0);
        scene.media[1] = Medium::plain("same", Eta::try_from(1.0).unwrap());
        let (with, without) = (
            rendered(&scene, method.id, Keep::Needed),
            rendered(&scene, method.id, Keep::Everything),
        );
        let ran = [&with, &without].map(crate::bends);
        // To a ray a crossing between equal indices is none.
        let bends = method.id != "undeviated" && !method.follows_rays;
        assert_eq!(ran, [false, bends], "{}", method.id);
        let passes = |r: &Rendering| r.passes.iter().map(|p| p.name.clone()).collect::<Vec<_>>();
        let needed: &[&str] = if method.follows_rays { &["shade"] } else { &["front", "shade"] };
        assert_eq!(passes(&with), needed, "{}", method.id);
        let share = differing(&with, &without);
        assert!(share <= 1e-3, "{}: {share}", method.id);
        let left_out = |what: &str| with.plan.left_out.iter().any(|l| l.what == what);
        assert!(left_out("refraction and reflection"));
    }
}

#[test]
fn bodies_outside_the_image_are_not_drawn() {
    let mut scene = scene_of(
        Shape::Sphere { radius_m: 0.5 },
        1.5,
        perspective(DVec3::new(0.0, 0.0, 4.0), [64, 64]),
    );
    for x_m in [0.0, 1.5, 3.0, 100.0] {
        scene.objects[0].world_from_object = DAffine3::from_translation(DVec3::X * x_m);
        for method in ["one-interface", "multi"] {
            let (with, without) = (
                rendered(&scene, method, Keep::Needed),
                rendered(&scene, method, Keep::Everything),
            );
            assert!(differing(&with, &without) <= 1e-4, "{x_m} {method}");
            let drawn = with.passes.iter().any(|pass| pass.name == "front");
            assert_eq!(drawn, x_m < 2.0, "{x_m}");
        }
    }
}
