//! What is measured: meshes, and the rays that an image of each sends into the
//! glass.

use glam::{DVec2, DVec3};
use reference::{Triangles, interface::refract};
use scenes::{Camera, Mesh, Ray, builtin, generate, obj};

/// Pixels of the image, each side.
pub const IMAGE_PX: u32 = 1024;
/// Index of the glass; 1 outside.
pub const ETA: f64 = 1.5;
/// Rays start this share of the mesh's diagonal beyond the surface, so that two
/// programs that round differently are asked for the same crossing.
pub const BEYOND: f64 = 1e-5;

/// Triangles and rays, both exact in f32, so that a program that knows only f32
/// is asked the same.
#[derive(Clone, Debug)]
pub struct Input {
    /// Name of the mesh.
    pub name: &'static str,
    /// Metres.
    pub corners: Vec<[DVec3; 3]>,
    /// In the order of the pixels, row by row. Directions have unit length to
    /// within f32.
    pub rays: Vec<Ray>,
}

impl Input {
    /// Sends a ray through the centre of every pixel of [`Camera::fitted`] and
    /// keeps those that meet the mesh, refracted once at its flat faces.
    #[must_use]
    pub fn new(name: &'static str, mesh: &Mesh) -> Self {
        let mesh = Mesh {
            positions: mesh.positions.iter().map(|p| single(*p)).collect(),
            triangles: mesh.triangles.clone(),
            normals: None,
        };
        let corners: Vec<_> = (0..mesh.triangles.len()).map(|i| mesh.corners(i)).collect();
        let [low, high] = mesh.bounds();
        let beyond_m = BEYOND * (high - low).length();
        let camera = Camera::fitted([low, high], [IMAGE_PX; 2]);
        let mut tree = Triangles::build(&corners);
        let pixels = (0..IMAGE_PX).flat_map(|y| (0..IMAGE_PX).map(move |x| (x, y)));
        let inside = |(x, y): (u32, u32)| {
            let ray = camera.ray_through(DVec2::new(x.into(), y.into()) + 0.5);
            let hit = tree.closest(&ray, u32::MAX, f64::INFINITY)?;
            let [a, b, c] = corners[hit.triangle as usize];
            let normal = (b - a).cross(c - a).try_normalize()?;
            let facing = if hit.entering { normal } else { -normal };
            let direction = refract(ray.direction, facing, 1.0, ETA)?;
            let [u, v, w] = hit.barycentric;
            let origin = a * u + b * v + c * w + direction * beyond_m;
            Some(Ray { origin: single(origin), direction: single(direction) })
        };
        let rays = pixels.filter_map(inside).collect();
        Self { name, corners, rays }
    }
}

/// The inputs whose files are there, and a sentence for each that is left out.
#[must_use]
pub fn inputs() -> (Vec<Input>, Vec<String>) {
    let (mut inputs, mut left_out) = (Vec::new(), Vec::new());
    let path = builtin::asset("bunny.obj");
    if path.exists() {
        match obj::read(&path) {
            Ok(model) => inputs.push(Input::new("bunny", &model.mesh)),
            Err(error) => left_out.push(format!("bunny is left out: {error}")),
        }
    } else {
        left_out.push(format!(
            "bunny is left out: {} is not there; ./setup.sh fetches it",
            path.display()
        ));
    }
    for name in ["cup", "noisy-ball"] {
        inputs.extend(generate::builtin(name).map(|mesh| Input::new(name, &mesh)));
    }
    (inputs, left_out)
}

fn single(point: DVec3) -> DVec3 {
    point.as_vec3().as_dvec3()
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Behind the surface of a convex body every ray finds its way out.
    #[test]
    fn rays_start_inside() {
        let input = Input::new("ball", &generate::geodesic(6));
        let mut tree = Triangles::build(&input.corners);
        assert!(input.rays.len() > 100_000);
        for ray in input.rays.iter().step_by(97) {
            let hit = tree.closest(ray, u32::MAX, f64::INFINITY);
            assert!(hit.is_some_and(|hit| !hit.entering), "{ray:?} {hit:?}");
            assert!((ray.direction.length() - 1.0).abs() < 1e-6);
            assert_eq!(single(ray.origin), ray.origin);
        }
    }
}
