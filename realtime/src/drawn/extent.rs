//! Where the bodies are, and the point that f32 positions are counted from.

use glam::DVec3;
use scenes::{Camera, Object, Projection, Scene, box_corners};

/// Where the bodies are at the time of one frame.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Extent {
    /// Local origin in world space: the point of the bodies' bounds that is nearest to
    /// the eye. A position's error in f32 is then a share of its distance from the eye
    /// and of the bodies' size, however far something else is.
    pub(crate) origin: DVec3,
    /// Middle of the bodies' bounds, world space.
    pub(crate) middle: DVec3,
    /// Radius about the middle that holds every bounded body, metres.
    pub(crate) radius_m: f64,
    /// The same for everything in the scene, opaque surfaces too.
    pub(crate) reach_m: f64,
}

impl Extent {
    /// Of a scene without bounds: about what the camera looks at.
    pub(crate) fn new(scene: &Scene, solids: &[&Object], time_s: f64) -> Self {
        let camera = &scene.camera;
        let all = bounded(scene.bounds());
        let bodies = bounded(bounds(solids, time_s)).or(all);
        let away_m = (camera.target - camera.eye).length();
        let around = DVec3::splat(10.0 * away_m / 3f64.sqrt());
        let unbounded = [camera.target - around, camera.target + around];
        let [low, high] = bodies.unwrap_or(unbounded);
        let middle = 0.5 * (low + high);
        let radius_m = radius_m_of([low, high]);
        let reach_m = all.map_or(radius_m, radius_m_of);
        let origin = match bodies {
            Some(_) => viewpoint(camera, middle).clamp(low, high),
            None => camera.target,
        };
        Self { origin, middle, radius_m, reach_m }
    }
}

fn radius_m_of([low, high]: [DVec3; 2]) -> f64 {
    (0.5 * (high - low).length()).max(f64::MIN_POSITIVE)
}

/// The eye, or of parallel rays the middle one beside a point.
fn viewpoint(camera: &Camera, point: DVec3) -> DVec3 {
    match camera.projection {
        Projection::Perspective { .. } => camera.eye,
        Projection::Orthographic { .. } => {
            let forward = camera.basis().forward;
            camera.eye + (point - camera.eye).dot(forward) * forward
        }
    }
}

fn bounded([low, high]: [DVec3; 2]) -> Option<[DVec3; 2]> {
    (low.is_finite() && high.is_finite()).then_some([low, high])
}

/// Box around every bounded object, world space; inverted infinities if there is none.
fn bounds(objects: &[&Object], time_s: f64) -> [DVec3; 2] {
    let corners = objects.iter().flat_map(|object| {
        let placed = object.world_from_object_at(time_s);
        box_corners(object.shape_at(time_s).bounds()).map(|corner| placed.transform_point3(corner))
    });
    let bounded = corners.filter(|corner| corner.is_finite());
    bounded.fold([DVec3::INFINITY, DVec3::NEG_INFINITY], |[low, high], p| [low.min(p), high.max(p)])
}
