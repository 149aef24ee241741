//! The camera that layers are collected with: the image's, or one of their own
//! that holds all of the bodies, whatever the image shows.

use crate::Error;
use crate::composition::chosen::piece;
use crate::composition::inputs::Order;
use crate::wgsl::Piece;
use scenes::{Camera, Projection};

/// Room around the ball that holds the bodies.
const MARGIN: f64 = 1.05;

/// A camera fitted to the bodies, if the method asks for one. It looks from the
/// image's eye, or along the image's axis, and its image is square.
pub(super) fn fitted(order: &Order<'_>) -> Result<Option<Camera>, Error> {
    if order.settings.word_if_any("peel_camera") != Some("fitted") {
        return Ok(None);
    }
    let refuse = |what: &str| {
        let what = format!("peel_camera = fitted: {what}; write peel_camera = screen");
        Err(Error::Parameter { method: order.method.id.to_owned(), what })
    };
    if super::asked_for(order.request) {
        return refuse("its layers are not those of the image and cannot be shown as such");
    }
    let (centre, radius_m) = (order.geometry.centre, MARGIN * order.geometry.radius_m);
    let basis = order.camera.basis();
    let away = centre - order.camera.eye;
    let edge_px = match order.settings.number("peel_px") as u32 {
        0 => order.resolution_px[0].max(order.resolution_px[1]),
        edge_px => edge_px,
    };
    let camera =
        Camera { target: centre, up: basis.up, resolution_px: [edge_px; 2], ..*order.camera };
    Ok(Some(match camera.projection {
        Projection::Orthographic { .. } => {
            let eye = centre - away.dot(basis.forward) * basis.forward;
            // The centre may be in the plane of the eye.
            let target = eye + basis.forward;
            let projection = Projection::Orthographic { height_m: 2.0 * radius_m };
            Camera { eye, target, projection, ..camera }
        }
        Projection::Perspective { .. } => {
            let sine = radius_m / away.length();
            if sine >= 1.0 {
                return refuse("the eye is among the bodies");
            }
            let vertical_fov_deg = 2.0 * sine.asin().to_degrees();
            // Any direction that is not the axis will do.
            let steep = away.normalize().dot(basis.up).abs() > 0.99;
            let up = if steep { basis.forward } else { basis.up };
            Camera { projection: Projection::Perspective { vertical_fov_deg }, up, ..camera }
        }
    }))
}

/// How shaders find their way in the layers.
pub(crate) fn pieces(order: &Order<'_>) -> Vec<Piece> {
    if order.settings.word_if_any("peel_camera") != Some("fitted") {
        return vec![piece!("layers/peel_camera_screen.wgsl")];
    }
    let perspective = matches!(order.camera.projection, Projection::Perspective { .. });
    let constant = format!("const PEEL_PERSPECTIVE: bool = {perspective};\n");
    vec![Piece::new("projection of the layers", constant), piece!("layers/peel_camera_fitted.wgsl")]
}
