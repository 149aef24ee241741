//! The camera that layers are collected with: the image's, or one of their own
//! that holds all of the bodies, whatever the image shows.

use crate::composition::inputs::Inputs;
use crate::composition::layer_images::asked_for;
use crate::error::Error;
use scenes::{Camera, Projection};

/// Room around the ball that holds the bodies.
const MARGIN: f64 = 1.05;

/// A camera fitted to the bodies, if the method asks for one. It looks from the
/// image's eye, or along the image's axis, and its image is square.
pub(super) fn fitted(inputs: &Inputs<'_>) -> Result<Option<Camera>, Error> {
    if inputs.settings.word_if_any("peel_camera") != Some("fitted") {
        return Ok(None);
    }
    let refuse = |what: &str| {
        let what = format!("peel_camera = fitted: {what}; write peel_camera = screen");
        Err(Error::Parameter { method: inputs.method.id.to_owned(), what })
    };
    if asked_for(inputs.request) {
        return refuse("its layers are not those of the image and cannot be shown as such");
    }
    let extent = inputs.geometry.extent;
    let (centre, radius_m) = (extent.middle, MARGIN * extent.radius_m);
    let basis = inputs.camera.basis();
    let away = centre - inputs.camera.eye;
    let edge_px = match inputs.settings.number("peel_px") as u32 {
        0 => inputs.resolution_px[0].max(inputs.resolution_px[1]),
        edge_px => edge_px,
    };
    let camera =
        Camera { target: centre, up: basis.up, resolution_px: [edge_px; 2], ..*inputs.camera };
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
