//! pbrt-v4. Its camera space is left-handed (hence the mirrored x axis), its
//! field of view spans the shorter side of the image, and its environment is a
//! square equal-area map of the sphere (Clarberg, "Fast equal-area mapping of
//! the (hemi)sphere using SIMD", Journal of Graphics Tools 13(3), 2008).

use super::surface::{indexed, numbers, without_bounds};
use super::{ExportError, Format, opaque, write_text};
use crate::{Camera, Environment, Medium, Object, Projection, Scene, Shape, environment::Map};
use glam::{DMat4, DVec3};
use std::f64::consts::FRAC_PI_4;
use std::fmt::Write as _;
use std::path::Path;

pub(super) fn write(
    scene: &Scene,
    folder: &Path,
    notes: &mut Vec<String>,
) -> Result<&'static str, ExportError> {
    let absorbs = scene.media.iter().any(|medium| medium.absorbs());
    let integrator = if absorbs { "volpath" } else { "path" };
    let [width, height] = scene.camera.resolution_px;
    let mut text = format!(
        "# {}\nFilm \"rgb\" \"integer xresolution\" {width} \"integer yresolution\" {height} \
         \"string filename\" \"image.exr\"\nPixelFilter \"box\" \"float xradius\" 0.5 \"float yradius\" 0.5\n\
         Sampler \"independent\" \"integer pixelsamples\" 256\n\
         Integrator \"{integrator}\" \"integer maxdepth\" 256 \"bool regularize\" false\n",
        scene.title.replace('\n', " ")
    );
    text.push_str(&camera(&scene.camera));
    text.push_str("WorldBegin\n");
    text.push_str(&environment(scene, folder)?);
    for object in &scene.objects {
        text.push_str(&shape(scene, object, notes)?);
    }
    write_text(&folder.join("scene.pbrt"), &text)?;
    Ok("scene.pbrt")
}

fn camera(camera: &Camera) -> String {
    let [eye, target, up] =
        [camera.eye, camera.target, camera.basis().up].map(|v| numbers(v.to_array()));
    let half = camera.half_extent();
    let lens = match camera.projection {
        Projection::Perspective { .. } => {
            format!(
                "\"perspective\" \"float fov\" {}",
                2.0 * half.min_element().atan().to_degrees()
            )
        }
        Projection::Orthographic { .. } => {
            format!(
                "\"orthographic\" \"float screenwindow\" [ {} {} {} {} ]",
                -half.x, half.x, -half.y, half.y
            )
        }
    };
    format!("Scale -1 1 1\nLookAt {eye}  {target}  {up}\nCamera {lens}\n")
}

fn environment(scene: &Scene, folder: &Path) -> Result<String, ExportError> {
    match &scene.environment {
        Environment::Uniform(radiance) => {
            Ok(format!("LightSource \"infinite\" \"rgb L\" [ {} ]\n", numbers(radiance.to_array())))
        }
        Environment::Map(map) => {
            write_equal_area(map, &folder.join("environment.exr"))?;
            Ok("LightSource \"infinite\" \"string filename\" \"environment.exr\"\n".to_owned())
        }
    }
}

fn write_equal_area(map: &Map, path: &Path) -> Result<(), ExportError> {
    let size = map.lat_long.size_px[1] as usize * 2;
    let texel = |x: usize, y: usize| {
        let at = [x, y].map(|i| (i as f64 + 0.5) / size as f64);
        let value = map.lat_long.radiance(equal_area_direction(at), map.rotation_deg).as_vec3();
        (value.x, value.y, value.z)
    };
    exr::prelude::write_rgb_file(path, size, size, texel)
        .map_err(|source| ExportError::Image { path: path.to_owned(), source })
}

/// Direction for a position in the unit square.
fn equal_area_direction(at: [f64; 2]) -> DVec3 {
    let [u, v] = at.map(|t| 2.0 * t - 1.0);
    let (up, vp) = (u.abs(), v.abs());
    let signed_distance = 1.0 - (up + vp);
    let r = 1.0 - signed_distance.abs();
    let phi = if r == 0.0 { FRAC_PI_4 } else { ((vp - up) / r + 1.0) * FRAC_PI_4 };
    let z = (1.0 - r * r).copysign(signed_distance);
    let horizontal = r * (2.0 - r * r).sqrt();
    DVec3::new((phi.cos() * horizontal).copysign(u), (phi.sin() * horizontal).copysign(v), z)
}

fn shape(scene: &Scene, object: &Object, notes: &mut Vec<String>) -> Result<String, ExportError> {
    let medium = scene.medium_of(object).ok_or_else(|| opaque(Format::Pbrt, object))?;
    let mut text = String::from("AttributeBegin\n");
    if medium.absorbs() {
        let sigma = numbers(medium.absorption_per_m.to_array());
        let _ = writeln!(
            text,
            "  MakeNamedMedium \"{0}\" \"string type\" \"homogeneous\" \"rgb sigma_a\" [ {sigma} ] \"rgb sigma_s\" [ 0 0 0 ]\n  MediumInterface \"{0}\" \"\"",
            medium.name
        );
    }
    let columns = DMat4::from(object.world_from_object).to_cols_array();
    let _ = writeln!(text, "  Transform [ {} ]", numbers(columns));
    let _ = writeln!(text, "  Material \"dielectric\" {}", eta(medium, notes));
    text.push_str(&geometry(object, notes)?);
    text.push_str("AttributeEnd\n");
    Ok(text)
}

/// The index: one number, or its values over the wavelengths that pbrt samples, in
/// nanometres, with straight lines between.
fn eta(medium: &Medium, notes: &mut Vec<String>) -> String {
    const STEP_NM: f64 = 5.0;
    if !medium.is_dispersive() {
        return format!("\"float eta\" {}", medium.eta.get());
    }
    let at = |nm: f64| medium.eta_at(nm * 1e-3);
    let steps: Vec<f64> = (0..=94).map(|i| 360.0 + STEP_NM * f64::from(i)).collect();
    let bend = |nm: &f64| (at(nm + 0.5 * STEP_NM) - 0.5 * (at(*nm) + at(nm + STEP_NM))).abs();
    let largest = steps.iter().map(bend).fold(0.0, f64::max);
    notes.push(format!(
        "the index of \"{}\" is written every {STEP_NM} nm: between, it is off by up to {largest:.1e}",
        medium.name
    ));
    let pairs = numbers(steps.iter().flat_map(|nm| [*nm, at(*nm)]));
    format!("\"spectrum eta\" [ {pairs} ]")
}

fn geometry(object: &Object, notes: &mut Vec<String>) -> Result<String, ExportError> {
    if let Shape::Sphere { radius_m } = *object.shape {
        return Ok(format!("  Shape \"sphere\" \"float radius\" {radius_m}\n"));
    }
    let mesh = indexed(object).ok_or_else(|| without_bounds(Format::Pbrt, object))?;
    notes.extend(mesh.told);
    let points = numbers(mesh.positions.iter().flat_map(|p| p.to_array()));
    let indices = numbers(mesh.triangles.iter().flatten().map(|i| f64::from(*i)));
    let normals = mesh.normals.map_or_else(String::new, |normals| {
        let values = numbers(normals.iter().flat_map(|n| n.to_array()));
        format!("\n    \"normal N\" [ {values} ]")
    });
    Ok(format!(
        "  Shape \"trianglemesh\" \"integer indices\" [ {indices} ]\n    \"point3 P\" [ {points} ]{normals}\n"
    ))
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Equal areas of the square see equal solid angles: the mean of x², y² and
    /// z² over the square is 1/3 each, and every direction is a unit vector.
    #[test]
    fn the_equal_area_map_is_one() {
        let size = 64;
        let mut sum = DVec3::ZERO;
        for i in 0..size * size {
            let at = [i % size, i / size].map(|k| (f64::from(k) + 0.5) / f64::from(size));
            let direction = equal_area_direction(at);
            assert!((direction.length() - 1.0).abs() < 1e-12);
            sum += direction * direction;
        }
        let mean = sum / f64::from(size * size);
        assert!((mean - DVec3::splat(1.0 / 3.0)).abs().max_element() < 1e-3, "{mean}");
    }
}
