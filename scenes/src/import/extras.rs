//! What the core format has no place for and the scene's extras tell: the
//! environment and the size of the image.

use super::{ImportError, hex};
use crate::environment::{Environment, Map, Repair};
use crate::image;
use glam::DVec3;
use serde::Deserialize;
use sha2::{Digest, Sha256};
use std::path::Path;
use std::sync::Arc;

/// Keys of the extras, as they are written.
#[derive(Deserialize, Default)]
#[serde(rename_all = "camelCase", default)]
struct Text {
    environment_radiance: Option<[f64; 3]>,
    environment_map: Option<String>,
    environment_rotation_deg: f64,
    resolution_px: Option<[u32; 2]>,
}

/// What the extras say.
#[derive(Default)]
pub(super) struct Extras {
    pub(super) environment: Option<Environment>,
    pub(super) resolution_px: Option<[u32; 2]>,
    /// SHA-256 of the map, empty without one.
    pub(super) sha256: String,
    pub(super) warnings: Vec<String>,
}

impl Extras {
    /// Extras of the default scene. Those that others wrote are left alone.
    pub(super) fn of(document: &gltf::Document, path: &Path) -> Result<Self, ImportError> {
        let scene = document.default_scene().or_else(|| document.scenes().next());
        let raw = scene.and_then(|scene| scene.extras().clone());
        let text: Option<Text> = raw.and_then(|raw| serde_json::from_str(raw.get()).ok());
        let text = text.unwrap_or_default();
        let is_side = |side: &u32| (1..=65_536).contains(side);
        let mut extras = Self {
            resolution_px: text.resolution_px.filter(|size| size.iter().all(is_side)),
            ..Self::default()
        };
        let is_light = |value: &f64| value.is_finite() && *value >= 0.0;
        if let Some(radiance) = text.environment_radiance.filter(|r| r.iter().all(is_light)) {
            extras.environment = Some(Environment::Uniform(DVec3::from_array(radiance)));
        }
        if let Some(name) = &text.environment_map {
            let file = path.parent().unwrap_or(Path::new("")).join(name);
            let (lat_long, said) = image::read_lat_long(&file)?;
            extras.warnings.extend(said);
            let mut hash = Sha256::new();
            for value in lat_long.texels.iter().flatten() {
                hash.update(value.to_le_bytes());
            }
            extras.sha256 = hex(&hash.finalize());
            let turn = text.environment_rotation_deg;
            let map = Map::from_lat_long(name, lat_long, turn, None, Repair::default());
            extras.warnings.extend(map.warnings());
            extras.environment = Some(Environment::Map(Arc::new(map)));
        }
        Ok(extras)
    }
}
