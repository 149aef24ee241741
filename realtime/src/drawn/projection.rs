//! Where points of the world lie in the image.

use glam::{DVec2, DVec3};
use scenes::{Camera, Projection};

/// A point as the camera sees it.
struct Seen {
    /// To the right and up, metres.
    aside_m: DVec2,
    depth_m: f64,
    /// Half the width and height of what the image shows at that depth, metres.
    reach_m: DVec2,
}

impl Seen {
    fn new(camera: &Camera, point_ws: DVec3) -> Self {
        let (basis, half) = (camera.basis(), camera.half_extent());
        let from_eye = point_ws - camera.eye;
        let depth_m = from_eye.dot(basis.forward);
        let reach_m = match camera.projection {
            Projection::Perspective { .. } => depth_m * half,
            Projection::Orthographic { .. } => half,
        };
        let aside_m = DVec2::new(from_eye.dot(basis.right), from_eye.dot(basis.up));
        Self { aside_m, depth_m, reach_m }
    }
}

/// Some of the corners of a box (world space) may be in the image: they do not
/// all lie beyond the same side of the view.
pub(crate) fn in_view(camera: &Camera, corners: &[DVec3; 8]) -> bool {
    let mut beyond = [true; 5];
    for corner in corners {
        let Seen { aside_m: at, depth_m, reach_m: reach } = Seen::new(camera, *corner);
        let outside =
            [at.x > reach.x, at.x < -reach.x, at.y > reach.y, at.y < -reach.y, depth_m < 0.0];
        beyond.iter_mut().zip(outside).for_each(|(all, one)| *all &= one);
    }
    !beyond.contains(&true)
}

/// Continuous pixel position of a point (world space) in front of the eye.
pub(crate) fn projected_px(
    camera: &Camera,
    point: DVec3,
    resolution_px: [u32; 2],
) -> Option<DVec2> {
    let Seen { aside_m, depth_m, reach_m } = Seen::new(camera, point);
    let at = DVec2::new(aside_m.x, -aside_m.y) / reach_m;
    let size = DVec2::from_array(resolution_px.map(f64::from));
    (depth_m > 0.0 && at.is_finite()).then_some((0.5 * at + 0.5) * size)
}
