//! Laws that images and plans must obey, through the crate's own front door.
#![allow(clippy::unwrap_used, reason = "a test that cannot render must fail")]

mod built_in;
mod colour;
mod distance;
mod environment;
mod far_and_near;
mod first_event;
mod flags;
mod leaving_out;
mod limits;
mod plans;
mod positions;
mod requests;

use glam::{DAffine3, DVec3};
use realtime::{Filter, Gpu, Keep, Request};
use scenes::scene::{Normals, Object};
use scenes::{
    Camera, Environment, Eta, LayerName, Medium, MediumId, Projection, Rendering, Scene, Shape,
    Surface, View,
};
use std::sync::{Arc, LazyLock};
use test_support::{angle, body, centre_rays, parallel, parameters, vectors};

/// The adapter of this machine; a missing one fails every test that needs it.
static GPU: LazyLock<Gpu> = LazyLock::new(|| Gpu::open(None).unwrap());

fn perspective(eye: DVec3, resolution_px: [u32; 2]) -> Camera {
    let projection = Projection::Perspective { vertical_fov_deg: 35.0 };
    Camera { eye, target: DVec3::ZERO, up: DVec3::Y, projection, resolution_px }
}

fn scene_of(shape: Shape, eta: f64, camera: Camera) -> Scene {
    test_support::scene(vec![body(shape)], eta, camera)
}

fn request(scene: &Scene, method: &str, layers: &[LayerName]) -> Request {
    let (resolution_px, layers) = (scene.camera.resolution_px, layers.to_vec());
    let view = View { resolution_px, positions_per_axis: 1, frame: 0, layers };
    Request::new(view, method, Keep::Needed)
}

/// With parameters as `name=value`.
fn with(request: Request, list: &[(&str, &str)]) -> Request {
    Request { parameters: parameters(list), ..request }
}

/// Light met interfaces: a method's own shader ran, and not the one that lets
/// light go straight on. Needs the layer of events.
fn bends(rendering: &Rendering) -> bool {
    let events = &rendering.layers.get(&LayerName::Events).unwrap().data;
    events.iter().any(|events| *events > 0.0)
}

/// Snell's law in f64, written for these tests: cosines from the plane of
/// incidence, nothing shared with the shader.
fn snell(d: DVec3, n: DVec3, eta_i_over_t: f64) -> DVec3 {
    let tangent = d - d.dot(n) * n;
    let sine_t = eta_i_over_t * tangent.length();
    assert!(sine_t <= 1.0);
    let along = -(1.0 - sine_t * sine_t).sqrt() * n;
    tangent.normalize_or_zero() * sine_t + along
}
