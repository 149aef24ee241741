//! Bodies in bodies, bodies that touch, and a camera inside one.
#![allow(clippy::unwrap_used, reason = "a test may fail by panicking")]

mod common;

use common::{cube, cup, furnace, icosphere, object};
use glam::{DAffine3, DVec3};
use reference::{Estimator, Level, Request, render};
use scenes::scene::Normals;
use scenes::{
    Eta, LayerName, Medium, MediumId, Object, Projection, Rendering, Scene, Shape, Surface,
};
use test_support::view;

fn body(shape: Shape, medium: u16, priority: i32) -> Object {
    let mut object = object(shape, medium, Normals::Flat);
    object.surface = Surface::Dielectric { medium: MediumId(medium), priority };
    object
}

fn at(mut object: Object, offset: DVec3, scale: f64) -> Object {
    object.world_from_object =
        DAffine3::from_translation(offset) * DAffine3::from_scale(DVec3::splat(scale));
    object
}

/// Media: vacuum, glass 1.5, water 1.33, diamond 2.4.
fn scene(objects: Vec<Object>) -> Scene {
    let mut scene = furnace(objects, 1.5);
    for (name, eta) in [("water", 1.33), ("diamond", 2.4)] {
        scene.media.push(Medium::plain(name, Eta::try_from(eta).unwrap()));
    }
    scene
}

fn white(scene: &Scene, cut: f64) -> Rendering {
    let layers = [LayerName::Radiance, LayerName::Truncated];
    let mut request = Request::new(view(32, 1, &layers), Level::R1);
    request.estimator = Estimator::Tree { cut };
    let rendering = render(scene, &request).unwrap();
    let data = |name| rendering.layers.get(&name).unwrap().data.clone();
    for (pixel, lost) in data(LayerName::Radiance).chunks(3).zip(data(LayerName::Truncated)) {
        assert!(
            pixel.iter().all(|v| *v <= 1.0 + 1e-9 && *v >= 1.0 - lost - 1e-9),
            "{pixel:?} {lost}"
        );
    }
    assert_eq!(rendering.counters["left_inside"], 0);
    rendering
}

type Case = (&'static str, Vec<Object>);

/// Bodies in each other.
fn nested() -> Vec<Case> {
    let sphere = |r| Shape::Sphere { radius_m: r };
    let mesh = |m| Shape::Mesh(m);
    vec![
        (
            "bubble",
            vec![
                body(mesh(icosphere(3)), 1, 0),
                at(body(mesh(icosphere(2)), 0, 1), DVec3::new(0.2, 0.1, 0.0), 0.5),
            ],
        ),
        (
            "four deep",
            vec![
                body(mesh(icosphere(3)), 1, 0),
                at(body(mesh(cube(2)), 2, 1), DVec3::ZERO, 0.5),
                at(body(mesh(icosphere(2)), 3, 2), DVec3::ZERO, 0.4),
                body(sphere(0.2), 0, 3),
            ],
        ),
        (
            "overlap of equals",
            vec![body(mesh(cube(2)), 1, 0), at(body(mesh(icosphere(2)), 1, 0), DVec3::X, 0.7)],
        ),
        (
            "overlap of different",
            vec![body(mesh(cube(2)), 1, 0), at(body(sphere(0.7), 2, 1), DVec3::Y, 1.0)],
        ),
        ("the same mesh twice", vec![body(mesh(cup()), 1, 0), body(mesh(cup()), 2, 1)]),
    ]
}

/// Bodies that share a face, or cut through each other's.
fn touching() -> Vec<Case> {
    let mesh = |m| Shape::Mesh(m);
    vec![
        (
            "touching cubes",
            vec![
                at(body(mesh(cube(2)), 1, 0), DVec3::new(-0.5, 0.0, 0.0), 0.5),
                at(body(mesh(cube(2)), 2, 1), DVec3::new(0.5, 0.0, 0.0), 0.5),
            ],
        ),
        (
            "a box on a cube",
            vec![
                at(body(mesh(cube(2)), 1, 0), DVec3::new(0.0, -0.5, 0.0), 0.5),
                at(
                    body(Shape::Box { half_extent_m: DVec3::splat(0.5) }, 2, 0),
                    DVec3::new(0.0, 0.5, 0.0),
                    1.0,
                ),
            ],
        ),
        (
            "slab through a ball",
            vec![body(mesh(icosphere(3)), 1, 0), body(Shape::Slab { thickness_m: 0.3 }, 2, 1)],
        ),
    ]
}

#[test]
fn nested_overlapping_and_touching_bodies_vanish_in_uniform_light() {
    for (name, objects) in nested().into_iter().chain(touching()) {
        let rendering = white(&scene(objects), 1e-3);
        assert!(rendering.counters["events"] > 1000, "{name}");
    }
}

fn exits(scene: &Scene) -> Vec<DVec3> {
    let request = Request::new(view(64, 1, &[LayerName::Exit]), Level::R0);
    let rendering = render(scene, &request).unwrap();
    assert_eq!(rendering.counters["left_inside"], 0);
    let data = &rendering.layers.get(&LayerName::Exit).unwrap().data;
    data.chunks(3).map(DVec3::from_slice).collect()
}

fn worst(a: &[DVec3], b: &[DVec3]) -> f64 {
    a.iter().zip(b).map(|(a, b)| (*a - *b).length()).fold(0.0, f64::max)
}

#[test]
fn two_cubes_that_touch_are_one_body() {
    let half = |x: f64, m| at(body(Shape::Mesh(cube(3)), m, 0), DVec3::new(x, 0.0, 0.0), 0.5);
    let one = body(Shape::Box { half_extent_m: DVec3::new(1.0, 0.5, 0.5) }, 1, 0);
    let whole = exits(&scene(vec![one]));
    let joined = exits(&scene(vec![half(-0.5, 1), half(0.5, 1)]));
    assert!(whole.iter().filter(|d| **d != DVec3::ZERO).count() > 300);
    assert!(worst(&whole, &joined) < 1e-12, "{}", worst(&whole, &joined));
    // The control: with water on one side it is another body.
    assert!(worst(&whole, &exits(&scene(vec![half(-0.5, 1), half(0.5, 2)]))) > 0.1);
}

#[test]
fn liquid_that_overlaps_its_glass_is_the_liquid_that_touches_it() {
    let ball = |r, medium, priority| body(Shape::Sphere { radius_m: r }, medium, priority);
    // A shell of glass around water: as a hole in the glass that is filled
    // exactly, and as water that reaches into the glass, which wins.
    let touching = vec![ball(1.0, 1, 0), ball(0.8, 0, 1), ball(0.8, 2, 2)];
    let simple = vec![ball(1.0, 1, 0), ball(0.8, 2, 1)];
    let difference = worst(&exits(&scene(touching)), &exits(&scene(simple.clone())));
    assert!(difference < 1e-9, "{difference}");
    // The control: a gap of air between them shows.
    let gap = vec![ball(1.0, 1, 0), ball(0.8, 0, 1), ball(0.79, 2, 2)];
    assert!(worst(&exits(&scene(gap)), &exits(&scene(simple))) > 0.1);
}

/// Deviation by a hollow ball, outer radius 1, inner r: three regimes of the
/// impact parameter b.
#[test]
fn a_hollow_ball_deviates_as_plane_geometry_says() {
    let (n, r) = (1.5_f64, 0.8_f64);
    let mut scene = scene(vec![
        body(Shape::Sphere { radius_m: 1.0 }, 1, 0),
        body(Shape::Sphere { radius_m: r }, 0, 1),
    ]);
    scene.camera.eye = DVec3::new(0.0, 0.0, 5.0);
    scene.camera.projection = Projection::Orthographic { height_m: 2.0 };
    let size = 200_u32;
    let mut request = Request::new(view(size, 1, &[LayerName::Exit]), Level::R0);
    request.view.resolution_px = [size, size];
    let rendering = render(&scene, &request).unwrap();
    let data = &rendering.layers.get(&LayerName::Exit).unwrap().data;
    let mut regimes = [0; 3];
    for (index, exit) in data.chunks(3).map(DVec3::from_slice).enumerate() {
        let at = |i: u32| 2.0 * (f64::from(i) + 0.5) / f64::from(size) - 1.0;
        let (x, y) = (at(index as u32 % size), -at(index as u32 / size));
        let b = x.hypot(y);
        if b > 0.999 || (b - r).abs() < 1e-3 || (b - n * r).abs() < 1e-3 {
            continue;
        }
        let (outside, inside) = (b.asin(), (b / n).asin());
        let away = if b >= n * r {
            regimes[0] += 1;
            -2.0 * (outside - inside)
        } else if b >= r {
            regimes[1] += 1;
            let phi = (b / (n * r)).asin();
            std::f64::consts::PI - 2.0 * phi - 2.0 * (outside - inside)
        } else {
            regimes[2] += 1;
            let (phi, beyond) = ((b / (n * r)).asin(), (b / r).asin());
            -2.0 * ((outside - inside) - (beyond - phi))
        };
        let radial = DVec3::new(x, y, 0.0) / b;
        let expected = radial * away.sin() - DVec3::Z * away.cos();
        assert!((exit - expected).length() < 1e-9, "b = {b}: {exit} {expected}");
    }
    assert!(regimes[1] > 1000 && regimes[2] > 1000, "{regimes:?}");
}

#[test]
fn a_camera_inside_a_body_sees_out() {
    for shape in [Shape::Mesh(icosphere(4)), Shape::Sphere { radius_m: 1.0 }] {
        let mut scene = scene(vec![body(shape, 1, 0)]);
        scene.camera.eye = DVec3::new(0.1, 0.05, -0.1);
        scene.camera.target = DVec3::new(0.0, 0.0, 1.0);
        let rendering = white(&scene, 1e-6);
        // Near the centre no ray is totally reflected, so one event lets light in.
        let truncated = &rendering.layers.get(&LayerName::Truncated).unwrap().data;
        assert!(truncated.iter().all(|t| *t < 1e-5));
        assert!(exits(&scene).iter().all(|exit| (exit.length() - 1.0).abs() < 1e-12));
    }
}

/// A shell with walls of 1e-6 of its radius hardly bends light; the walls are
/// met all the same.
#[test]
fn thin_walls_are_met() {
    let wall = 1e-6;
    let thin = |shape: fn(f64) -> Shape| {
        scene(vec![body(shape(1.0), 1, 0), body(shape(1.0 - wall), 0, 1)])
    };
    let request = |size| {
        let layers = [LayerName::Exit, LayerName::Events, LayerName::First];
        Request::new(view(size, 1, &layers), Level::R0)
    };
    let rendering = render(&thin(|r| Shape::Sphere { radius_m: r }), &request(64)).unwrap();
    let events = &rendering.layers.get(&LayerName::Events).unwrap().data;
    assert_eq!(rendering.counters["left_inside"], 0);
    assert!(events.contains(&4.0));
    assert!(events.iter().all(|e| *e == 0.0 || *e == 4.0 || *e == 2.0 || *e == 3.0), "{events:?}");
}
