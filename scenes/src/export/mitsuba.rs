//! Mitsuba 3 XML, with the conventions under which it agrees with snell: box
//! filter, exact indices on both sides, flat normals unless the mesh has its
//! own, roulette off, and the environment's rows doubled because Mitsuba puts
//! row y at y / (height - 1).

use super::surface::{indexed, numbers, without_bounds, write_obj};
use super::{ExportError, Format, opaque, write_text};
use crate::{Camera, Environment, Object, Projection, Scene, Shape, environment::LatLong};
use glam::{DAffine3, DVec3};
use std::fmt::Write as _;
use std::path::Path;

pub(super) fn write(
    scene: &Scene,
    folder: &Path,
    notes: &mut Vec<String>,
) -> Result<&'static str, ExportError> {
    let mut xml = String::from("<scene version=\"3.0.0\">\n");
    let _ = writeln!(xml, "  <!-- {} -->", scene.title.replace("--", "- -"));
    let absorbs = scene.media.iter().any(|medium| medium.absorbs());
    xml.push_str(&INTEGRATOR.replace("KIND", if absorbs { "volpath" } else { "path" }));
    xml.push_str(&sensor(&scene.camera));
    xml.push_str(&environment(scene, folder)?);
    for (index, object) in scene.objects.iter().enumerate() {
        xml.push_str(&shape(scene, object, index, folder, notes)?);
    }
    xml.push_str("</scene>\n");
    write_text(&folder.join("scene.xml"), &xml)?;
    Ok("scene.xml")
}

const INTEGRATOR: &str = "  <default name=\"spp\" value=\"256\"/>
  <default name=\"max_depth\" value=\"256\"/>
  <integrator type=\"KIND\">
    <integer name=\"max_depth\" value=\"$max_depth\"/>
    <integer name=\"rr_depth\" value=\"1000000\"/>
  </integrator>
";

fn sensor(camera: &Camera) -> String {
    let [width, height] = camera.resolution_px;
    let [eye, target, up] = [camera.eye, camera.target, camera.basis().up]
        .map(|v| numbers(v.to_array()).replace(' ', ", "));
    let (kind, lens, scale) = match camera.projection {
        Projection::Perspective { vertical_fov_deg } => (
            "perspective",
            format!(
                "\n    <string name=\"fov_axis\" value=\"y\"/>\n    <float name=\"fov\" value=\"{vertical_fov_deg}\"/>"
            ),
            String::new(),
        ),
        // Mitsuba's orthographic image is 2 wide; its height follows the aspect.
        Projection::Orthographic { .. } => {
            let half = camera.half_extent().x;
            ("orthographic", String::new(), format!("<scale x=\"{half}\" y=\"{half}\"/>"))
        }
    };
    format!(
        "  <sensor type=\"{kind}\">{lens}
    <float name=\"near_clip\" value=\"1e-4\"/>
    <transform name=\"to_world\">{scale}<lookat origin=\"{eye}\" target=\"{target}\" up=\"{up}\"/></transform>
    <sampler type=\"independent\"><integer name=\"sample_count\" value=\"$spp\"/></sampler>
    <film type=\"hdrfilm\">
      <integer name=\"width\" value=\"{width}\"/><integer name=\"height\" value=\"{height}\"/>
      <string name=\"pixel_format\" value=\"rgb\"/><string name=\"component_format\" value=\"float32\"/>
      <rfilter type=\"box\"/>
    </film>
  </sensor>
"
    )
}

fn environment(scene: &Scene, folder: &Path) -> Result<String, ExportError> {
    let map = match &scene.environment {
        Environment::Uniform(radiance) => {
            let rgb = numbers(radiance.to_array()).replace(' ', ", ");
            return Ok(format!(
                "  <emitter type=\"constant\"><rgb name=\"radiance\" value=\"{rgb}\"/></emitter>\n"
            ));
        }
        Environment::Map(map) => map,
    };
    write_doubled_rows(&map.lat_long, &folder.join("environment.exr"))?;
    Ok(format!(
        "  <emitter type=\"envmap\"><string name=\"filename\" value=\"environment.exr\"/>\
         <transform name=\"to_world\"><rotate y=\"1\" angle=\"{}\"/></transform></emitter>\n",
        -map.rotation_deg
    ))
}

/// 2 H + 1 rows: the odd ones are the originals, the even ones their midpoints,
/// the poles copies. Read with rows at y / (rows - 1), this is the texel-centred
/// bilinear lookup of the original.
fn write_doubled_rows(lat_long: &LatLong, path: &Path) -> Result<(), ExportError> {
    let [width, height] = lat_long.size_px.map(|n| n as usize);
    let row = |y: usize, x: usize| DVec3::from_array(lat_long.texels[y * width + x].map(f64::from));
    let texel = |x: usize, y: usize| {
        let (above, below) = ((y.max(1) - 1) / 2, (y / 2).min(height - 1));
        let value = row(above, x).lerp(row(below, x), 0.5).as_vec3();
        (value.x, value.y, value.z)
    };
    exr::prelude::write_rgb_file(path, width, 2 * height + 1, texel)
        .map_err(|source| ExportError::Image { path: path.to_owned(), source })
}

fn shape(
    scene: &Scene,
    object: &Object,
    index: usize,
    folder: &Path,
    notes: &mut Vec<String>,
) -> Result<String, ExportError> {
    let (kind, detail) = match &*object.shape {
        Shape::Sphere { radius_m } => {
            ("sphere", format!("<float name=\"radius\" value=\"{radius_m}\"/>"))
        }
        _ => {
            let mesh = indexed(object).ok_or_else(|| without_bounds(Format::Mitsuba, object))?;
            notes.extend(mesh.told.clone());
            let file = format!("object{index}.obj");
            write_obj(&mesh, &folder.join(&file))?;
            let flat = mesh.normals.is_none();
            (
                "obj",
                format!(
                    "<string name=\"filename\" value=\"{file}\"/><boolean name=\"face_normals\" value=\"{flat}\"/>"
                ),
            )
        }
    };
    Ok(format!(
        "  <shape type=\"{kind}\">{detail}\n    <transform name=\"to_world\"><matrix value=\"{}\"/></transform>\n{}  </shape>\n",
        matrix(&object.world_from_object),
        material(scene, object)?
    ))
}

fn material(scene: &Scene, object: &Object) -> Result<String, ExportError> {
    let Some(medium) = scene.medium_of(object) else {
        return Err(opaque(Format::Mitsuba, object));
    };
    if medium.is_dispersive() {
        return Err(ExportError::Inexpressible {
            format: Format::Mitsuba,
            what: "the dispersion".to_owned(),
            object: object.name.clone(),
            advice: "pbrt can (--to pbrt), and glTF nearly (--to gltf); or give the medium a constant eta"
                .to_owned(),
        });
    }
    let outside = scene.media[0].eta.get();
    let mut text = format!(
        "    <bsdf type=\"dielectric\"><float name=\"int_ior\" value=\"{}\"/><float name=\"ext_ior\" value=\"{outside}\"/></bsdf>\n",
        medium.eta.get()
    );
    if medium.absorbs() {
        let sigma = numbers(medium.absorption_per_m.to_array()).replace(' ', ", ");
        let _ = writeln!(
            text,
            "    <medium name=\"interior\" type=\"homogeneous\"><rgb name=\"sigma_t\" value=\"{sigma}\"/><rgb name=\"albedo\" value=\"0\"/></medium>"
        );
    }
    Ok(text)
}

/// Rows of the 4 x 4 matrix.
fn matrix(placed: &DAffine3) -> String {
    let m = glam::DMat4::from(*placed).transpose();
    numbers(m.to_cols_array())
}
