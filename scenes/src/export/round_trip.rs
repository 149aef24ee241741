//! What a file says when it is read back, beside the scene that was written.

use super::surface::{Indexed, indexed};
use crate::{Environment, Medium, Object, Scene, import};
use glam::{DVec2, DVec3};
use std::path::Path;

/// Largest differences between a scene and the one that is read back.
#[derive(Default)]
struct Difference {
    position_m: f64,
    normal_deg: f64,
    eta: f64,
    absorption_per_m: f64,
    ray_deg: f64,
    /// Bodies that have other triangles.
    changed: Vec<String>,
}

/// How far a glTF file is from the scene, a sentence each.
pub(super) fn told(scene: &Scene, file: &Path) -> Vec<String> {
    let size = scene.camera.resolution_px;
    let back = match import::read(file, Environment::Uniform(DVec3::ONE), size) {
        Ok(back) => back,
        Err(error) => return vec![format!("the file cannot be read back: {error}")],
    };
    let mut difference = Difference::default();
    for (sent, found) in scene.objects.iter().zip(&back.objects) {
        difference.look(sent, found);
        if let (Some(a), Some(b)) = (scene.medium_of(sent), back.medium_of(found)) {
            difference.look_at_media(a, b);
        }
    }
    let [width, height] = size.map(f64::from);
    for at in [DVec2::ZERO, DVec2::new(width, 0.0), DVec2::new(width, height)] {
        let rays = [&scene.camera, &back.camera].map(|camera| camera.ray_through(at).direction);
        difference.ray_deg = difference.ray_deg.max(angle_deg(rays[0], rays[1]));
    }
    difference.told()
}

fn angle_deg(a: DVec3, b: DVec3) -> f64 {
    a.cross(b).length().atan2(a.dot(b)).to_degrees()
}

impl Difference {
    fn look(&mut self, sent: &Object, found: &Object) {
        let (Some(ours), Some(theirs)) = (indexed(sent), indexed(found)) else { return };
        if ours.triangles.len() != theirs.triangles.len() {
            let (before, after) = (ours.triangles.len(), theirs.triangles.len());
            let name = &sent.name;
            self.changed.push(format!("\"{name}\" has {after} of its {before} triangles"));
            return;
        }
        for (a, b) in corners(&ours, sent).zip(corners(&theirs, found)) {
            self.position_m = self.position_m.max(a.0.distance(b.0));
            if let (Some(a), Some(b)) = (a.1, b.1) {
                self.normal_deg = self.normal_deg.max(angle_deg(a, b));
            }
        }
    }

    fn look_at_media(&mut self, sent: &Medium, found: &Medium) {
        for um in crate::medium::RGB_WAVELENGTH_UM {
            self.eta = self.eta.max((sent.eta_at(um) - found.eta_at(um)).abs());
        }
        let absorption = (sent.absorption_per_m - found.absorption_per_m).abs().max_element();
        self.absorption_per_m = self.absorption_per_m.max(absorption);
    }

    fn told(&self) -> Vec<String> {
        let Self { position_m, normal_deg, eta, absorption_per_m, ray_deg, changed } = self;
        let mut told = vec![format!(
            "read back, positions differ by up to {position_m:.1e} m, normals by {normal_deg:.1e}°, \
             indices (R, G, B) by {eta:.1e}, absorption by {absorption_per_m:.1e} per metre, camera \
             rays by {ray_deg:.1e}°: the format has 32 bits and one law of dispersion"
        )];
        told.extend(changed.iter().map(|change| format!("read back, {change}")));
        told
    }
}

/// Corners in world space with their normals, triangle by triangle.
fn corners<'a>(
    mesh: &'a Indexed,
    object: &'a Object,
) -> impl Iterator<Item = (DVec3, Option<DVec3>)> + 'a {
    let place = object.world_from_object;
    let turn = place.matrix3.inverse().transpose();
    mesh.triangles.iter().flatten().map(move |i| {
        let normal = mesh.normals.as_ref().map(|normals| turn * normals[*i as usize]);
        (place.transform_point3(mesh.positions[*i as usize]), normal)
    })
}
