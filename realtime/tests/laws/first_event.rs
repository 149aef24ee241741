//! Where a method is exact, it agrees with a closed form to f32.

use crate::*;

/// f32 directions after a normalisation and a square root.
const BOUND: f64 = 1e-6;

fn shapes() -> Vec<Shape> {
    vec![
        Shape::Sphere { radius_m: 0.8 },
        Shape::Box { half_extent_m: DVec3::new(0.6, 0.5, 0.7) },
        Shape::Cylinder { radius_m: 0.5, half_height_m: 0.6 },
        Shape::Slab { thickness_m: 0.3 },
        Shape::HalfSpace,
    ]
}

/// With everything kept: the method's own shader runs, whatever the index.
fn exits(scene: &Scene, method: &str, layer: LayerName) -> Vec<DVec3> {
    let mut request = request(scene, method, &[layer.clone(), LayerName::Events]);
    request.keep = Keep::Everything;
    let rendering = realtime::render(&GPU, scene, &request).unwrap();
    assert!(bends(&rendering), "another shader than that of {method} ran");
    vectors(&rendering.layers, &layer)
}

/// An index of 1 bends nothing, though every pass runs.
#[test]
fn index_one_leaves_the_view_direction() {
    let camera = perspective(DVec3::new(1.0, 1.4, 4.2), [96, 64]);
    for shape in shapes() {
        let scene = scene_of(shape, 1.0, camera);
        for method in ["dx7", "one-interface", "blended"] {
            let exits = exits(&scene, method, LayerName::Exit);
            let met = exits.iter().filter(|exit| **exit != DVec3::ZERO).count();
            assert!(met > 200, "{method}: {met} pixels");
            let pairs = exits.iter().zip(centre_rays(&camera));
            let errors = pairs.filter(|(exit, _)| **exit != DVec3::ZERO);
            let errors: Vec<_> = errors.map(|(exit, ray)| angle(*exit, ray.direction)).collect();
            // The cosine of a grazing ray comes from 1 - sin², which magnifies
            // the sine's rounding by 1 / cos.
            let worst = errors.iter().copied().fold(0.0, f64::max);
            let beyond = errors.iter().filter(|error| **error > BOUND).count();
            assert!(worst < 10.0 * BOUND, "{method}: {worst}");
            assert!(100 * beyond <= met, "{method}: {beyond} of {met} pixels");
        }
    }
}

/// On a ball, Snell's law at the analytic normal. Normals near the limb carry
/// the rounding of the square root that finds the hit: the bound grows as
/// 1 / cos.
#[test]
fn the_first_event_obeys_snells_law() {
    let camera = perspective(DVec3::new(1.0, 1.4, 4.2), [128, 128]);
    let scene = scene_of(Shape::Sphere { radius_m: 0.8 }, 1.5, camera);
    let first = exits(&scene, "one-interface", LayerName::First);
    let mut met = 0;
    for (first, ray) in first.iter().zip(centre_rays(&camera)) {
        let along = -ray.origin.dot(ray.direction);
        let height2 = ray.origin.length_squared() - along * along;
        let depth2 = 0.64 - height2;
        if depth2 <= 1e-4 || *first == DVec3::ZERO {
            continue;
        }
        met += 1;
        let normal = (ray.origin + (along - depth2.sqrt()) * ray.direction) / 0.8;
        let exact = snell(ray.direction, normal, 1.0 / 1.5);
        let cosine = -ray.direction.dot(normal);
        let error = angle(*first, exact);
        assert!(error < BOUND / cosine, "{error} at cosine {cosine}");
        // A wrong ratio is far outside the bound, save on the axis.
        let wrong = snell(ray.direction, normal, 1.0 / 1.49);
        assert!(cosine > 0.999 || angle(*first, wrong) > 1e-4);
    }
    assert!(met > 2000, "{met}");
}

/// A slab's normal is exact, so the error is that of the bend alone.
#[test]
fn a_slab_bends_to_rounding() {
    let camera = perspective(DVec3::new(0.7, 1.1, 3.0), [64, 64]);
    let scene = scene_of(Shape::Slab { thickness_m: 0.5 }, 1.7, camera);
    let first = exits(&scene, "one-interface", LayerName::First);
    for (first, ray) in first.iter().zip(centre_rays(&camera)) {
        let exact = snell(ray.direction, DVec3::Z, 1.0 / 1.7);
        assert!(angle(*first, exact) < BOUND);
    }
}

/// What vertices know is what pixels know, up to interpolation: the same image
/// on a fine mesh, another on a coarse one.
#[test]
fn vertices_tell_their_pixels_the_way_to_the_eye() {
    let exits = |divisions: u32, eye: &str| {
        let mesh = scenes::generate::cube(divisions);
        let camera = perspective(DVec3::new(1.0, 0.8, 2.0), [48, 48]);
        let mut scene = scene_of(Shape::Mesh(mesh), 1.3, camera);
        scene.objects[0].normals = Normals::Flat;
        let asked = request(&scene, "blended", &[LayerName::Exit]);
        let rendering = realtime::render(&GPU, &scene, &with(asked, &[("eye", eye)])).unwrap();
        vectors(&rendering.layers, &LayerName::Exit)
    };
    let worst = |divisions: u32| {
        let (one, other) = (exits(divisions, "vertex"), exits(divisions, "fragment"));
        let angles = one.iter().zip(&other).filter(|(a, _)| **a != DVec3::ZERO);
        angles.map(|(a, b)| angle(*a, *b)).fold(0.0, f64::max)
    };
    let (coarse, fine) = (worst(1), worst(32));
    // Second order: 32 times finer is about a thousand times better.
    assert!(coarse > 1e-3 && fine < coarse / 500.0, "{coarse} {fine}");
}
