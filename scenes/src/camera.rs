//! The camera both renderers share: rays for one, matrices for the other, from
//! the same numbers.
//!
//! World space is right-handed, metres, +Y up. View space looks down -Z. Clip
//! space is WebGPU's: x right, y up, z in [0, 1]. Pixel positions are
//! continuous: x from the left in [0, width], y from the top in [0, height];
//! pixel (i, j) covers [i, i+1) x [j, j+1).

use glam::{DMat4, DVec2, DVec3, DVec4};

/// A ray in world space.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Ray {
    /// Where it starts, metres.
    pub origin: DVec3,
    /// Unit direction of travel.
    pub direction: DVec3,
}

/// How the image plane relates to space.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Projection {
    /// Pinhole with a full vertical field of view in degrees.
    Perspective {
        /// Full vertical angle, degrees.
        vertical_fov_deg: f64,
    },
    /// Parallel rays; the image is this many metres high.
    Orthographic {
        /// Height of the image in the scene, metres.
        height_m: f64,
    },
}

/// A camera and the size of its image.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Camera {
    /// Position of the pinhole, or of the image plane's centre; metres.
    pub eye: DVec3,
    /// A point the camera looks at; metres.
    pub target: DVec3,
    /// Which way is up in the image; need not be perpendicular or unit.
    pub up: DVec3,
    /// Perspective or orthographic.
    pub projection: Projection,
    /// Width and height of the image, pixels.
    pub resolution_px: [u32; 2],
}

/// Orthonormal axes of a camera in world space.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Basis {
    /// Towards the right of the image.
    pub right: DVec3,
    /// Towards the top of the image.
    pub up: DVec3,
    /// Into the image.
    pub forward: DVec3,
}

impl Camera {
    /// A camera of 35 degrees that sees a box whole, from the front, the right
    /// and a little above; five per cent of the image's height stay free.
    #[must_use]
    pub fn fitted(bounds: [DVec3; 2], resolution_px: [u32; 2]) -> Self {
        let [low, high] = bounds;
        let centre = 0.5 * (low + high);
        let radius_m = (0.5 * (high - low).length()).max(f64::MIN_POSITIVE);
        let half_angle = 0.5 * 35f64.to_radians();
        let aspect = f64::from(resolution_px[0]) / f64::from(resolution_px[1]);
        // The narrower side of the image decides.
        let half_angle_across = (half_angle.tan() * aspect.min(1.0)).atan();
        let distance_m = 1.05 * radius_m / half_angle_across.sin();
        let towards_eye = DVec3::new(0.35, 0.3, 1.0).normalize();
        Self {
            eye: centre + distance_m * towards_eye,
            target: centre,
            up: DVec3::Y,
            projection: Projection::Perspective { vertical_fov_deg: 35.0 },
            resolution_px,
        }
    }

    /// The camera's axes in world space.
    #[must_use]
    pub fn basis(&self) -> Basis {
        let forward = (self.target - self.eye).normalize();
        let right = forward.cross(self.up).normalize();
        Basis { right, up: right.cross(forward), forward }
    }

    /// Half the image's width and height: tangents of the half angles for a
    /// perspective camera, metres for an orthographic one.
    #[must_use]
    pub fn half_extent(&self) -> DVec2 {
        let aspect = f64::from(self.resolution_px[0]) / f64::from(self.resolution_px[1]);
        let half_height = match self.projection {
            Projection::Perspective { vertical_fov_deg } => {
                (0.5 * vertical_fov_deg.to_radians()).tan()
            }
            Projection::Orthographic { height_m } => 0.5 * height_m,
        };
        DVec2::new(half_height * aspect, half_height)
    }

    /// The ray through a continuous image position in pixels.
    #[must_use]
    pub fn ray_through(&self, position_px: DVec2) -> Ray {
        let Basis { right, up, forward } = self.basis();
        let [width, height] = self.resolution_px.map(f64::from);
        let half = self.half_extent();
        let x = (2.0 * position_px.x / width - 1.0) * half.x;
        let y = (1.0 - 2.0 * position_px.y / height) * half.y;
        let offset = right * x + up * y;
        match self.projection {
            Projection::Perspective { .. } => {
                Ray { origin: self.eye, direction: (forward + offset).normalize() }
            }
            Projection::Orthographic { .. } => {
                Ray { origin: self.eye + offset, direction: forward }
            }
        }
    }

    /// View space from world space.
    #[must_use]
    pub fn view_from_world(&self) -> DMat4 {
        let Basis { right, up, forward } = self.basis();
        let row = |axis: DVec3| axis.extend(-axis.dot(self.eye));
        DMat4::from_cols(row(right), row(up), row(-forward), DVec4::W).transpose()
    }

    /// Clip space (z in [0, 1], y up) from view space, for planes at `near_m`
    /// and `far_m` metres in front of the eye.
    #[must_use]
    pub fn clip_from_view(&self, near_m: f64, far_m: f64) -> DMat4 {
        let half = self.half_extent();
        let depth = far_m - near_m;
        match self.projection {
            Projection::Perspective { .. } => DMat4::from_cols(
                DVec4::new(1.0 / half.x, 0.0, 0.0, 0.0),
                DVec4::new(0.0, 1.0 / half.y, 0.0, 0.0),
                DVec4::new(0.0, 0.0, -far_m / depth, -1.0),
                DVec4::new(0.0, 0.0, -near_m * far_m / depth, 0.0),
            ),
            Projection::Orthographic { .. } => DMat4::from_cols(
                DVec4::new(1.0 / half.x, 0.0, 0.0, 0.0),
                DVec4::new(0.0, 1.0 / half.y, 0.0, 0.0),
                DVec4::new(0.0, 0.0, -1.0 / depth, 0.0),
                DVec4::new(0.0, 0.0, -near_m / depth, 1.0),
            ),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A point on the ray through a pixel projects back onto that pixel.
    #[test]
    fn the_matrices_and_the_rays_are_the_same_camera() {
        let projections = [
            Projection::Perspective { vertical_fov_deg: 35.0 },
            Projection::Orthographic { height_m: 2.2 },
        ];
        for projection in projections {
            let camera = Camera {
                eye: DVec3::new(1.0, 1.4, 4.2),
                target: DVec3::new(0.0, 0.5, 0.1),
                up: DVec3::Y,
                projection,
                resolution_px: [640, 360],
            };
            let clip_from_world = camera.clip_from_view(0.5, 20.0) * camera.view_from_world();
            for position_px in [DVec2::new(3.25, 350.5), DVec2::new(611.0, 40.0)] {
                let ray = camera.ray_through(position_px);
                let clip = clip_from_world * (ray.origin + 3.0 * ray.direction).extend(1.0);
                let ndc = clip.truncate() / clip.w;
                let back = DVec2::new(320.0 * (1.0 + ndc.x), 180.0 * (1.0 - ndc.y));
                assert!((back - position_px).length() < 1e-10, "{back} {position_px}");
                assert!((0.0..=1.0).contains(&ndc.z));
            }
        }
    }
}
