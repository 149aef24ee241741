//! What the tests of every crate share: small scenes, single rays, angles, and
//! random numbers.
//!
//! It knows scenes and neither renderer, so that the tests of both may use it.

mod dice;

pub use dice::Dice;

use glam::{DVec2, DVec3};
use scenes::{
    Camera, Eta, LayerName, Layers, Medium, MediumId, Object, Projection, Ray, Scene, Shape, View,
};
use std::collections::BTreeMap;

/// A body of medium 1, glass in [`scene`], about the origin.
#[must_use]
pub fn body(shape: Shape) -> Object {
    Object::solid("body", shape, MediumId(1))
}

/// Objects in light of radiance 1 from everywhere; medium 0 is vacuum, medium 1
/// glass of absolute index `eta`.
///
/// # Panics
/// If there is no medium of that index.
#[must_use]
pub fn scene(objects: Vec<Object>, eta: f64, camera: Camera) -> Scene {
    #[expect(clippy::unwrap_used, reason = "a test that asks for nonsense must fail")]
    let glass = Medium::plain("glass", Eta::try_from(eta).unwrap());
    Scene::in_white_light("test", camera, vec![Medium::vacuum(), glass], objects)
}

/// A camera on the z axis that sees along parallel rays, so many metres high.
#[must_use]
pub fn parallel(height_m: f64, resolution_px: [u32; 2]) -> Camera {
    Camera {
        eye: DVec3::new(0.0, 0.0, 4.0),
        target: DVec3::ZERO,
        up: DVec3::Y,
        projection: Projection::Orthographic { height_m },
        resolution_px,
    }
}

/// The camera of one pixel whose only ray this is.
#[must_use]
pub fn ray(origin: DVec3, direction: DVec3) -> Camera {
    let up = if direction.y.abs() > 0.9 * direction.length() { DVec3::X } else { DVec3::Y };
    Camera { eye: origin, target: origin + direction, up, ..parallel(1e-300, [1, 1]) }
}

/// Rays through the centres of a camera's pixels, row by row.
#[must_use]
pub fn centre_rays(camera: &Camera) -> Vec<Ray> {
    let [width, height] = camera.resolution_px;
    let pixel = |i: u32| DVec2::new(f64::from(i % width), f64::from(i / width)) + 0.5;
    (0..width * height).map(|i| camera.ray_through(pixel(i))).collect()
}

/// The still in a square, at k x k positions in each pixel.
#[must_use]
pub fn view(size_px: u32, positions_per_axis: u32, layers: &[LayerName]) -> View {
    View { resolution_px: [size_px; 2], positions_per_axis, frame: 0, layers: layers.to_vec() }
}

/// Vectors of a layer, pixel by pixel.
///
/// # Panics
/// If there is no such layer.
#[must_use]
pub fn vectors(layers: &Layers, name: &LayerName) -> Vec<DVec3> {
    #[expect(clippy::unwrap_used, reason = "a test that lacks what it asked for must fail")]
    let layer = layers.get(name).unwrap();
    layer.data.chunks_exact(3).map(DVec3::from_slice).collect()
}

/// Parameters of a method, from names and values.
#[must_use]
pub fn parameters(list: &[(&str, &str)]) -> BTreeMap<String, String> {
    list.iter().map(|(name, value)| ((*name).to_owned(), (*value).to_owned())).collect()
}

/// Angle between two vectors, radians, without the cancellation of acos.
#[must_use]
pub fn angle(a: DVec3, b: DVec3) -> f64 {
    a.cross(b).length().atan2(a.dot(b))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn angles_are_exact_where_their_cosine_is_not() {
        for angle_rad in [1e-12, 0.3, 2.0, std::f64::consts::PI - 1e-9] {
            let turned = DVec3::new(angle_rad.cos(), angle_rad.sin(), 0.0);
            assert!((angle(DVec3::X, turned) - angle_rad).abs() < 1e-15 * 4.0, "{angle_rad}");
        }
    }

    #[test]
    fn a_camera_of_one_ray_has_that_ray() {
        let mut dice = Dice::new(1);
        for _ in 0..100 {
            let (origin, direction) = (dice.point(), dice.direction());
            let rays = centre_rays(&ray(origin, direction));
            assert_eq!(rays.len(), 1);
            assert!((rays[0].origin - origin).length() < 1e-15, "{rays:?} {origin}");
            assert!((rays[0].direction - direction).length() < 1e-15, "{rays:?} {direction}");
        }
    }
}
