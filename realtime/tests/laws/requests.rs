//! Requests that make no sense get one clear message.

use crate::*;
use realtime::Error;

fn refused(change: impl FnOnce(&mut Request)) -> Error {
    let scene = scene_of(Shape::Sphere { radius_m: 1.0 }, 1.5, parallel(2.1, [32, 32]));
    let mut request = request(&scene, "blended", &[LayerName::Radiance]);
    change(&mut request);
    realtime::plan(&scene, &request).unwrap_err()
}

#[test]
fn unknown_names_are_told_what_there_is() {
    let message = refused(|r| r.method = "blend".into()).to_string();
    assert!(message.contains("\"blend\"") && message.contains("blended"), "{message}");
    let message = refused(|r| *r = with(r.clone(), &[("b", "1")])).to_string();
    assert!(message.contains("back_normal"), "{message}");
    let message = refused(|r| *r = with(r.clone(), &[("a", "1.5")])).to_string();
    assert!(message.contains("from 0 to 1"), "{message}");
    let message = refused(|r| r.view.layers = vec![LayerName::Variance]).to_string();
    assert!(message.contains("thickness"), "{message}");
}

/// A law that gives no index for red is refused, one that gives one is not.
#[test]
fn a_colour_without_an_index_is_refused() {
    let plan = |dispersion: f64| {
        let camera = parallel(2.1, [32, 32]);
        let mut scene = scene_of(Shape::Sphere { radius_m: 1.0 }, 1.5, camera);
        scene.media[1].dispersion = scenes::Dispersion::Gltf { dispersion };
        realtime::plan(&scene, &request(&scene, "blended", &[LayerName::Radiance])).map(|_| ())
    };
    assert!(plan(1.0).is_ok());
    assert!(matches!(plan(300.0), Err(Error::Dispersion(error)) if error.eta < 0.1));
}

#[test]
fn absurd_sizes_are_refused_before_anything_is_allocated() {
    assert!(matches!(refused(|r| r.view.resolution_px = [0, 8]), Error::Size(_)));
    assert!(matches!(refused(|r| r.view.resolution_px = [1 << 30; 2]), Error::Size(_)));
    assert!(matches!(refused(|r| r.view.positions_per_axis = u32::MAX), Error::Size(_)));
    let timed = |positions_per_axis| {
        refused(|r| r.timing = Some(realtime::Timing { positions_per_axis, ..Default::default() }))
    };
    assert!([0, 65].into_iter().all(|k| matches!(timed(k), Error::Size(_))));
}

#[test]
fn an_unknown_adapter_is_told_what_there_is() {
    let error = Gpu::open(Some("no such adapter")).err().unwrap();
    assert!(matches!(error, Error::UnknownAdapter { .. } | Error::NoAdapter), "{error}");
}

/// Methods count metres inside the bodies: those are a medium's only if all of the
/// bodies are of it.
#[test]
fn a_path_is_that_of_the_bodies_medium_or_refused() {
    let mut scene = scene_of(Shape::Sphere { radius_m: 1.0 }, 1.5, parallel(2.1, [8, 8]));
    let asked = |scene: &Scene, medium: &str| {
        realtime::plan(scene, &request(scene, "multi", &[LayerName::Path(medium.into())]))
    };
    assert!(asked(&scene, "glass").is_ok());
    let message = asked(&scene, "vacuum").unwrap_err().to_string();
    assert!(message.contains("path.vacuum") && message.contains("all bodies"), "{message}");
    // With a second body, of vacuum, it is nobody's.
    scene.objects.push(Object::solid("bubble", Shape::Sphere { radius_m: 0.5 }, MediumId(0)));
    assert!(asked(&scene, "glass").is_err() && asked(&scene, "vacuum").is_err());
}

/// Numbers that count something are whole.
#[test]
fn half_a_step_is_refused() {
    let steps = |text: &str| {
        let scene = scene_of(Shape::Sphere { radius_m: 1.0 }, 1.5, parallel(2.1, [8, 8]));
        let asked = request(&scene, "multi", &[LayerName::Radiance]);
        realtime::plan(&scene, &with(asked, &[("binary_steps", text)]))
    };
    assert!(steps("6").is_ok());
    let message = steps("6.5").unwrap_err().to_string();
    assert!(message.contains("whole number"), "{message}");
}

/// What is listed for people is what is taken, of every method; and nothing of it is
/// missing in what a refusal names.
#[test]
fn every_layer_that_is_listed_can_be_asked_of_every_method() {
    let scene = scene_of(Shape::Sphere { radius_m: 1.0 }, 1.5, parallel(2.1, [8, 8]));
    let refusal = refused(|r| r.view.layers = vec![LayerName::Variance]).to_string();
    for (name, meaning) in realtime::methods::LAYERS {
        assert!(refusal.contains(name) && !meaning.is_empty(), "{name}: {refusal}");
        let name = name.replace("<medium>", "glass").replace("<n>", "3");
        for method in realtime::METHODS.iter() {
            let asked = request(&scene, method.id, &[LayerName::from(name.as_str())]);
            assert!(realtime::plan(&scene, &asked).is_ok(), "{} {name}", method.id);
        }
    }
}
