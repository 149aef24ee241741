//! Single rays through the code that renders: images of one pixel.
#![allow(dead_code, reason = "each test file uses its part")]
#![allow(unreachable_pub, reason = "shared by test files")]

use glam::DVec3;
use reference::{Estimator, Level, Request, render};
use scenes::{Environment, LayerName, Rendering, Scene};
use test_support::view;

/// What the primary chain of a ray did.
#[derive(Clone, Copy, Debug)]
pub struct Shot {
    /// The direction that was sent.
    pub sent: DVec3,
    pub exit: DVec3,
    pub exit_position: DVec3,
    pub first: DVec3,
    pub hit2: DVec3,
    pub events: u32,
    pub total_reflections: u32,
}

fn aimed(scene: &Scene, origin: DVec3, direction: DVec3) -> (Scene, DVec3) {
    let camera = test_support::ray(origin, direction);
    (Scene { camera, ..scene.clone() }, camera.basis().forward)
}

fn vector(rendering: &Rendering, name: LayerName) -> DVec3 {
    DVec3::from_slice(&rendering.layers.get(&name).expect("asked for").data)
}

/// The chain of one ray.
pub fn shoot(scene: &Scene, origin: DVec3, direction: DVec3) -> Shot {
    let (scene, sent) = aimed(scene, origin, direction);
    let layers = [
        LayerName::Exit,
        LayerName::ExitPosition,
        LayerName::First,
        LayerName::Hit2,
        LayerName::Events,
        LayerName::TotalReflections,
    ];
    let rendering =
        render(&scene, &Request::new(view(1, 1, &layers), Level::R0)).expect("a valid scene");
    let count = |name| rendering.layers.get(&name).expect("asked for").data[0] as u32;
    Shot {
        sent,
        exit: vector(&rendering, LayerName::Exit),
        exit_position: vector(&rendering, LayerName::ExitPosition),
        first: vector(&rendering, LayerName::First),
        hit2: vector(&rendering, LayerName::Hit2),
        events: count(LayerName::Events),
        total_reflections: count(LayerName::TotalReflections),
    }
}

/// Radiance that the whole tree of one ray brings.
pub fn gather(scene: &Scene, origin: DVec3, direction: DVec3, cut: f64) -> DVec3 {
    let (scene, _) = aimed(scene, origin, direction);
    let mut request = Request::new(view(1, 1, &[LayerName::Radiance]), Level::R1);
    request.estimator = Estimator::Tree { cut };
    vector(&render(&scene, &request).expect("a valid scene"), LayerName::Radiance)
}

/// Radiance of one ray by the number of interfaces, 0 to `orders` - 1.
pub fn gather_by_order(scene: &Scene, origin: DVec3, direction: DVec3, orders: u16) -> Vec<f64> {
    let (scene, _) = aimed(scene, origin, direction);
    let layers: Vec<LayerName> = (0..orders).map(LayerName::Bounce).collect();
    let mut request = Request::new(view(1, 1, &layers), Level::R1);
    request.estimator = Estimator::Tree { cut: 1e-15 };
    let rendering = render(&scene, &request).expect("a valid scene");
    layers.into_iter().map(|name| vector(&rendering, name).x).collect()
}

/// Radiance `below` from directions with negative z, `above` from others: tells
/// what a slab transmits from what it reflects.
pub fn two_halves(below: f64, above: f64) -> Environment {
    use scenes::environment::{LatLong, Map, Repair};
    use std::sync::Arc;
    // u = 0 is -Z and u = 1/2 is +Z: a quarter of the columns on either side.
    let texel = |x: u32| if (64..192).contains(&x) { above } else { below };
    let texels = (0..256 * 128).map(|i| [texel(i % 256) as f32; 3]).collect();
    let map = LatLong { size_px: [256, 128], texels };
    Environment::Map(Arc::new(Map::from_lat_long("halves", map, 0.0, Some(64), Repair::default())))
}
