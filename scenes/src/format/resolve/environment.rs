//! `[environment]`: a constant, a map, or a sky.

use super::super::document::EnvironmentText;
use super::super::error::{At, Problem};
use super::{only_one, span_of};
use crate::Environment;
use crate::environment::{Map, Repair, Sky};
use crate::image;
use std::path::{Path, PathBuf};
use std::sync::Arc;
use toml::Spanned;

/// The environment, and the sky it is if it is one.
pub(super) fn resolve(
    environment: &Spanned<EnvironmentText>,
    base: &Path,
    warnings: &mut Vec<String>,
) -> Result<(Environment, Option<Sky>), At> {
    let text = environment.get_ref();
    let options = [
        ("radiance", span_of(&text.radiance)),
        ("map", span_of(&text.map)),
        ("sky", span_of(&text.sky)),
    ];
    only_one(&environment.span(), &options, "map = \"studio.exr\"")?;
    let rotation_deg = text.rotation_deg.map_or(0.0, |angle| angle.0);
    let cube_size_px = text.cube_size_px.map(|size| size.0);
    if let Some(radiance) = &text.radiance {
        return Ok((Environment::Uniform(radiance.get_ref().0), None));
    }
    if let Some(sky) = &text.sky {
        let mut sky = sky.get_ref().sky();
        let map = Map::from_sky(&sky, rotation_deg, cube_size_px);
        if let Some(sun) = &mut sky.sun {
            sun.direction =
                glam::DQuat::from_rotation_y(-rotation_deg.to_radians()) * sun.direction;
        }
        return Ok((Environment::Map(Arc::new(map)), Some(sky)));
    }
    let span = span_of(&text.map).unwrap_or_default();
    let name = text.map.as_ref().map_or("", |map| map.get_ref());
    let (lat_long, said) = image::read_lat_long(&base.join(name))
        .map_err(|error| At { span, problem: Problem::Image(error) })?;
    warnings.extend(said);
    let repair = Repair { keep_negative: text.keep_negative };
    let map = Map::from_lat_long(name, lat_long, rotation_deg, cube_size_px, repair);
    warnings.extend(map.warnings());
    Ok((Environment::Map(Arc::new(map)), None))
}

/// The file the environment is read from.
pub(super) fn file(environment: &Spanned<EnvironmentText>, base: &Path) -> Option<PathBuf> {
    environment.get_ref().map.as_ref().map(|map| image::file_of(&base.join(map.get_ref())))
}
