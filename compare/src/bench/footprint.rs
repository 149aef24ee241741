//! How long a large scene takes to build, and how much memory.

use super::BenchError;
use reference::{Level, Request, Watch, render_watched};
use scenes::{
    Camera, Eta, LayerName, Medium, MediumId, Mesh, Object, Scene, Shape, View, generate,
};
use serde::Serialize;
use std::sync::OnceLock;

/// Pixels of the image, each side: enough to touch the tree.
const IMAGE_PX: u32 = 64;

/// What a displaced ball takes.
#[derive(Clone, Copy, Debug, Serialize)]
pub struct Footprint {
    /// How many, as many as asked for or a few more.
    pub triangles: usize,
    /// Making the mesh, seconds on the wall. Not part of the renderer.
    pub mesh_s: f64,
    /// From the scene to the first row of pixels, on the wall: checking that the
    /// mesh is closed, smooth normals, the tree.
    pub build_s: f64,
    /// Memory held while tracing, per triangle: scene, normals and tree.
    pub resident_bytes_per_triangle: f64,
    /// Most memory held until then, per triangle.
    pub peak_bytes_per_triangle: f64,
}

/// Builds a ball with bumps and smooth normals of at least so many triangles
/// and traces a small image of it.
///
/// # Errors
/// The system does not tell how much memory is held, or the scene is too large.
pub fn footprint(triangles: u32) -> Result<Footprint, BenchError> {
    let before = Memory::now()?;
    let start = std::time::Instant::now();
    let frequency = (f64::from(triangles) / 20.0).sqrt().ceil() as u32;
    let scene = scene(generate::noisy_ball(frequency, 0.15, 1));
    let mesh_s = start.elapsed().as_secs_f64();
    let view = View {
        resolution_px: [IMAGE_PX; 2],
        positions_per_axis: 1,
        frame: 0,
        layers: vec![LayerName::Radiance],
    };
    let (traced, start) = (OnceLock::new(), std::time::Instant::now());
    let look = |_| {
        traced.get_or_init(|| (start.elapsed().as_secs_f64(), Memory::now()));
    };
    let watch = Watch { progress: Some(&look), ..Watch::default() };
    render_watched(&scene, &Request::new(view, Level::R1), watch)?;
    let (build_s, during) = traced.into_inner().unwrap_or((f64::NAN, Memory::now()));
    let during = during?;
    let triangles = scene.objects[0].shape.mesh().map_or(0, |mesh| mesh.triangles.len());
    let each = |bytes: u64| bytes.saturating_sub(before.resident) as f64 / triangles as f64;
    Ok(Footprint {
        triangles,
        mesh_s,
        build_s,
        resident_bytes_per_triangle: each(during.resident),
        peak_bytes_per_triangle: each(during.peak),
    })
}

/// A glass body in a white world.
fn scene(mesh: Mesh) -> Scene {
    let camera = Camera::fitted(mesh.bounds(), [IMAGE_PX; 2]);
    let body = Object::solid("body", Shape::Mesh(mesh), MediumId(1));
    let glass = Medium::plain("glass", Eta::try_from(super::ETA).unwrap_or(Eta::VACUUM));
    Scene::in_white_light("a ball with bumps", camera, vec![Medium::vacuum(), glass], vec![body])
}

/// Memory of this process, bytes.
#[derive(Clone, Copy, Debug, PartialEq)]
struct Memory {
    /// Held now (`VmRSS`).
    resident: u64,
    /// Most that was held at any time (`VmHWM`).
    peak: u64,
}

impl Memory {
    fn now() -> Result<Self, BenchError> {
        Self::read(&std::fs::read_to_string("/proc/self/status").unwrap_or_default())
    }

    /// From the text of `/proc/self/status`; source: proc_pid_status(5).
    fn read(status: &str) -> Result<Self, BenchError> {
        let bytes = |name: &'static str| {
            let line = status.lines().find_map(|line| line.strip_prefix(name)?.strip_prefix(':'));
            let number = line.and_then(|line| line.trim().strip_suffix("kB")?.trim().parse().ok());
            number.map(|kib: u64| kib * 1024).ok_or(BenchError::NoMemoryFigures(name))
        };
        Ok(Self { resident: bytes("VmRSS")?, peak: bytes("VmHWM")? })
    }
}

#[cfg(test)]
mod tests {
    #![allow(clippy::unwrap_used, reason = "a failing test may panic")]
    use super::*;

    #[test]
    fn the_system_s_figures_are_read() {
        let status = "Name:\tsnell\nVmHWM:\t    3000 kB\nVmRSS:\t    2000 kB\n";
        let memory = Memory { resident: 2_048_000, peak: 3_072_000 };
        assert_eq!(Memory::read(status).unwrap(), memory);
        let error = Memory::read("VmHWM:\t1 kB\n").unwrap_err();
        assert!(error.to_string().contains("VmRSS"), "{error}");
    }

    #[cfg(target_os = "linux")]
    #[test]
    fn a_small_ball_has_a_footprint() {
        let found = footprint(1_000).unwrap();
        assert_eq!(found.triangles, 1_280);
        assert!(found.build_s > 0.0 && found.peak_bytes_per_triangle.is_finite());
    }
}
