//! Every flag is raised where it should be, and only there.

use crate::*;
use scenes::layer::flag;

const SIZE_PX: [u32; 2] = [64, 64];

/// Share of the body's pixels in which a flag is raised.
fn share(scene: &Scene, request: &Request, bit: u32) -> f64 {
    let rendering = realtime::render(&GPU, scene, request).unwrap();
    let data = |name| &rendering.layers.get(&name).unwrap().data;
    let (flags, coverage) = (data(LayerName::Flags), data(LayerName::Coverage));
    let on_body = flags.iter().zip(coverage).filter(|(_, covered)| **covered > 0.0);
    let raised = on_body.clone().filter(|(flags, _)| **flags as u32 & bit != 0).count();
    raised as f64 / on_body.count() as f64
}

fn asked(scene: &Scene, method: &str, parameters: &[(&str, &str)]) -> Request {
    with(request(scene, method, &[LayerName::Flags, LayerName::Coverage]), parameters)
}

fn ball(eta: f64) -> Scene {
    scene_of(Shape::Sphere { radius_m: 1.0 }, eta, parallel(2.1, SIZE_PX))
}

#[test]
fn total_reflection_is_flagged_where_it_is_clamped() {
    let glass = ball(1.5);
    let clamped = share(&glass, &asked(&glass, "two-interface", &[]), flag::TIR_CLAMPED);
    assert!((0.001..0.5).contains(&clamped), "{clamped}");
    // From a weaker medium nothing is reflected totally.
    let weak = ball(1.01);
    assert_eq!(share(&weak, &asked(&weak, "one-interface", &[]), flag::TIR_CLAMPED), 0.0);
}

#[test]
fn a_second_surface_beyond_the_silhouette_is_flagged() {
    // Behind the end of a rod the way to its other end leaves it by the side.
    let half_extent_m = DVec3::new(0.2, 0.2, 1.2);
    let mut scene = scene_of(
        Shape::Box { half_extent_m },
        1.1,
        perspective(DVec3::new(2.4, 1.0, 2.0), SIZE_PX),
    );
    let request = asked(&scene, "two-interface", &[("distance", "normal")]);
    let found = share(&scene, &request, flag::FALLBACK);
    scene.media[1] = Medium::plain("none", Eta::try_from(1.0).unwrap());
    // Along the view at an index of 1 the way ends at the surface behind.
    let mut straight = asked(&scene, "two-interface", &[("distance", "view")]);
    straight.view.layers.push(LayerName::Events);
    straight.keep = Keep::Everything;
    assert!(bends(&realtime::render(&GPU, &scene, &straight).unwrap()), "another shader ran");
    let none = share(&scene, &straight, flag::FALLBACK);
    assert!(found > 0.005 && none < 0.1 * found, "{found} {none}");
}

#[test]
fn a_chain_that_is_cut_off_is_flagged() {
    let scene = ball(1.5);
    let cut = asked(&scene, "multi", &[("max_events", "1")]);
    assert!(share(&scene, &cut, flag::CAP) > 0.5);
    assert!(share(&scene, &asked(&scene, "multi", &[]), flag::CAP) < 0.05);
}

/// Reflected totally from side to side, a ray ends where the cap is, or where no layer
/// shows what it meets; each has its own flag, and a body that bends weakly has no caps.
#[test]
fn a_ray_that_does_not_get_out_is_flagged_by_why() {
    let cube = |eta| {
        let shape = Shape::Box { half_extent_m: DVec3::splat(0.5) };
        scene_of(shape, eta, perspective(DVec3::new(2.0, 1.3, 2.4), SIZE_PX))
    };
    let share =
        |scene: &Scene, bit| share(scene, &asked(scene, "multi", &[("tir", "reflect")]), bit);
    let (strong, weak) = (cube(2.4), cube(1.01));
    let (capped, lost) = (share(&strong, flag::CAP), share(&strong, flag::LOST));
    assert!(capped > 0.005 && lost > 0.001, "{capped} {lost}");
    assert_eq!(share(&weak, flag::CAP), 0.0);
    assert!(share(&weak, flag::LOST) < 0.5 * lost);
}

#[test]
fn another_body_behind_is_flagged_by_methods_of_two_surfaces() {
    let mut scene = ball(1.5);
    let mut second = body(Shape::Sphere { radius_m: 0.4 });
    second.world_from_object = DAffine3::from_translation(DVec3::new(0.9, 0.0, -2.0));
    scene.objects.push(second);
    let found = share(&scene, &asked(&scene, "two-interface", &[]), flag::UNSUPPORTED);
    assert!((0.01..0.5).contains(&found), "{found}");
    let alone = ball(1.5);
    assert_eq!(share(&alone, &asked(&alone, "two-interface", &[]), flag::UNSUPPORTED), 0.0);
}

#[test]
fn what_is_no_number_is_flagged_and_does_not_spread() {
    let text = "fn trace(pixel: vec2i, v_ws: vec3f, surface: Surface) -> Trace {
        let nothing = surface.depth_m - surface.depth_m;
        let d_ws = v_ws / select(1.0, nothing, pixel.x > 32);
        return Trace(d_ws, d_ws, vec3f(0.0), 0.0, 1u, 0u);
    }";
    let folder = tempfile::tempdir().unwrap();
    let file = folder.path().join("nan.wgsl");
    std::fs::write(&file, text).unwrap();
    let scene = ball(1.5);
    let layers = [LayerName::Flags, LayerName::Coverage, LayerName::Radiance, LayerName::Exit];
    let request = request(&scene, file.to_str().unwrap(), &layers);
    let found = share(&scene, &request, flag::NON_FINITE);
    assert!((0.4..0.6).contains(&found), "{found}");
    let rendering = realtime::render(&GPU, &scene, &request).unwrap();
    for name in [LayerName::Radiance, LayerName::Exit] {
        let data = &rendering.layers.get(&name).unwrap().data;
        assert!(data.iter().all(|value| value.is_finite()), "{name}");
    }
}
