//! `[camera]`: a place, a direction, one projection.

use super::super::document::CameraText;
use super::super::error::At;
use super::{only_one, span_of};
use crate::{Camera, Projection};
use glam::{DQuat, DVec3};
use toml::Spanned;

/// The camera of frame 0.
pub(super) fn resolve(camera: &Spanned<CameraText>) -> Result<Camera, At> {
    let text = camera.get_ref();
    let (written_eye, target) = (text.eye.0, text.target.get_ref().0);
    let up = text.up.as_ref().map_or(DVec3::Y, |up| up.get_ref().0);
    let eye = match text.orbit_deg {
        Some(turn) => {
            let turn = DQuat::from_axis_angle(up.normalize(), turn.0.to_radians());
            target + turn * (written_eye - target)
        }
        None => written_eye,
    };
    let view = target - eye;
    if view.length() <= 1e-12 * eye.length().max(target.length()) {
        return Err(At::meaning(
            text.target.span(),
            format!("the camera's eye and target are the same point {target}"),
            "move the target to what the camera looks at",
        ));
    }
    if view.normalize().cross(up).length() < 1e-9 {
        return Err(At::meaning(
            text.up.as_ref().map_or(text.target.span(), Spanned::span),
            "the camera looks along its own up vector",
            "write another up, such as up = [0.0, 0.0, -1.0] for a view from above",
        ));
    }
    let options = [
        ("vertical_fov_deg", span_of(&text.vertical_fov_deg)),
        ("orthographic_height_m", span_of(&text.orthographic_height_m)),
    ];
    only_one(&camera.span(), &options, "vertical_fov_deg = 35.0")?;
    let projection = match (&text.vertical_fov_deg, &text.orthographic_height_m) {
        (Some(fov), _) => Projection::Perspective { vertical_fov_deg: fov.get_ref().0 },
        (None, Some(height)) => Projection::Orthographic { height_m: height.get_ref().0 },
        (None, None) => unreachable!("only_one found a projection"),
    };
    Ok(Camera { eye, target, up, projection, resolution_px: text.resolution_px.0 })
}
