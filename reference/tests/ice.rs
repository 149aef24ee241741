//! What is in ice and on it: cracks, bubbles, bumps; and bodies that change.
#![allow(clippy::unwrap_used, reason = "a test may fail by panicking")]

mod common;

use common::{cube, furnace, icosphere, object, torus};
use glam::DVec3;
use reference::{Error, Level, Request, render};
use scenes::scene::{Air, Bump, Crack, Motion, Normals, Wave};
use scenes::topology::{NotABody, NotSolid};
use scenes::{LayerName, Mesh, Rendering, Scene, Shape};
use test_support::view;

fn ice(mesh: Mesh, normals: Normals) -> Scene {
    furnace(vec![object(Shape::Mesh(mesh), 1, normals)], 1.309)
}

fn white(scene: &Scene, frame: u32) -> Rendering {
    let layers = [LayerName::Radiance, LayerName::Truncated, LayerName::Coverage];
    let mut request = Request::new(view(40, 2, &layers), Level::R1);
    request.view.frame = frame;
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

#[test]
fn cracks_bubbles_and_bumps_lose_no_light() {
    for mesh in [cube(4), icosphere(3), torus()] {
        let plain = white(&ice(mesh.clone(), Normals::Flat), 0).counters["events"];
        let mut scene = ice(mesh, Normals::Flat);
        scene.objects[0].crack = Some(Crack { count: 3, grid: 24, seed: 5 });
        let cracked = white(&scene, 0).counters["events"];
        assert!(cracked > plain, "{cracked} {plain}");
        scene.objects[0].air = Some(Air { planes: 0, bubbles: 8, bubble_radius: 0.03, seed: 2 });
        let bubbly = white(&scene, 0).counters["events"];
        assert!(bubbly > cracked, "{bubbly} {cracked}");
        scene.objects[0].bump = Some(Bump { amplitude: 0.3, frequency_per_m: 4.0, seed: 9 });
        white(&scene, 0);
    }
}

#[test]
fn the_crack_mask_is_where_cracks_are_inside() {
    let mask = |scene: &Scene| {
        let layers = [LayerName::Buffer("crack_mask".to_owned()), LayerName::Events];
        render(scene, &Request::new(view(64, 1, &layers), Level::R0)).unwrap().layers
    };
    let mut scene = ice(icosphere(3), Normals::Flat);
    assert!(mask(&scene).list[0].data.iter().all(|m| *m == 0.0));
    scene.objects[0].crack = Some(Crack { count: 2, grid: 24, seed: 5 });
    let layers = mask(&scene);
    let (mask, events) = (&layers.list[0].data, &layers.list[1].data);
    // A crack reaches out of the body; the mask does not.
    assert!(mask.iter().zip(events).all(|(mask, events)| *mask == 0.0 || *events > 0.0));
    assert!(mask.iter().filter(|m| **m == 1.0).count() > 200);
}

#[test]
fn a_bump_of_no_height_changes_nothing() {
    let image = |bump| {
        let mut scene = ice(torus(), Normals::Smooth);
        scene.objects[0].bump = bump;
        let layers = [LayerName::Exit, LayerName::Radiance];
        render(&scene, &Request::new(view(40, 1, &layers), Level::R0)).unwrap().layers
    };
    let bump = |amplitude| Some(Bump { amplitude, frequency_per_m: 4.0, seed: 9 });
    let (none, flat, high) = (image(None), image(bump(0.0)), image(bump(0.3)));
    let worst = |a: &scenes::Layers, b: &scenes::Layers| {
        let pairs = a.list[0].data.iter().zip(&b.list[0].data);
        let mut sizes: Vec<f64> = pairs.map(|(a, b)| (a - b).abs()).collect();
        sizes.sort_by(f64::total_cmp);
        sizes[sizes.len() * 98 / 100]
    };
    // Through object space and back costs a rounding, nothing more.
    assert!(worst(&none, &flat) < 1e-9, "{}", worst(&none, &flat));
    assert!(worst(&none, &high) > 1e-2);
}

#[test]
fn bodies_that_move_and_deform_stay_whole() {
    let mut scene = ice(torus(), Normals::Smooth);
    scene.sequence.frames = 8;
    scene.objects[0].motion = Some(Motion::Spin { axis: DVec3::Z, deg_per_s: 90.0 });
    scene.objects[0].deform = Some(Wave {
        amplitude_m: 0.1,
        wavelength_m: 0.8,
        travel: DVec3::X,
        direction: DVec3::Y,
        period_s: 1.0,
    });
    let frames = [0, 3, 7].map(|frame| white(&scene, frame));
    let coverage = |r: &Rendering| r.layers.get(&LayerName::Coverage).unwrap().data.clone();
    assert_ne!(coverage(&frames[0]), coverage(&frames[1]));
    assert_ne!(coverage(&frames[1]), coverage(&frames[2]));
}

#[test]
fn bodies_without_an_inside_are_refused() {
    let ask = Request::new(view(4, 1, &[LayerName::Radiance]), Level::R1);
    let mut open = cube(1);
    open.triangles.pop();
    let answer = render(&ice(open, Normals::Flat), &ask).unwrap_err();
    let reason = NotSolid::Open { boundary_edges: 3, wrong_way: 0 };
    assert_eq!(answer, Error::NotABody(NotABody { object: "body".to_owned(), reason }));
    let mut inside_out = cube(1);
    inside_out.triangles.iter_mut().for_each(|t| t.swap(0, 1));
    let answer = render(&ice(inside_out, Normals::Flat), &ask).unwrap_err();
    let Error::NotABody(NotABody { reason: NotSolid::Inverted { signed_volume_m3 }, .. }) = answer
    else {
        panic!("{answer}");
    };
    assert!((signed_volume_m3 + 8.0).abs() < 1e-12);
    // Nothing at all is a scene too.
    assert!(render(&ice(Mesh::default(), Normals::Flat), &ask).is_ok());
}
