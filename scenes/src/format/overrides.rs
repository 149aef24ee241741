//! What a user puts in the place of what a scene says: on the command line, for
//! any scene, wherever it came from.

use super::Error;
use crate::environment::{Map, Repair};
use crate::medium::RGB_WAVELENGTH_UM;
use crate::{Dispersion, Environment, Eta, Scene, Surface, image};
use sha2::{Digest, Sha256};
use std::collections::BTreeSet;
use std::path::PathBuf;
use std::sync::Arc;

/// Parts that take the place of a scene's own; nothing by default.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Overrides {
    /// Lat-long image in place of the environment.
    pub map: Option<PathBuf>,
    /// Absolute index of the medium that the scene's solids are made of.
    pub eta: Option<f64>,
}

impl Overrides {
    /// Puts the parts into a scene and notes them in its text and fingerprint. New
    /// doubts are added to the scene's warnings.
    ///
    /// # Errors
    /// If the map cannot be read, the index is none, or the scene has no medium,
    /// several, or one with a law of dispersion, so that the index has no place.
    pub fn apply(&self, scene: &mut Scene) -> Result<(), Error> {
        let mut told = Sha256::new();
        told.update(&scene.source.sha256);
        if let Some(file) = &self.map {
            let (lat_long, said) = image::read_lat_long(file)?;
            for value in lat_long.texels.iter().flatten() {
                told.update(value.to_le_bytes());
            }
            let name = file.display().to_string();
            let map = Map::from_lat_long(&name, lat_long, 0.0, None, Repair::default());
            scene.warnings.extend(said.into_iter().chain(map.warnings()));
            scene.environment = Environment::Map(Arc::new(map));
            scene.source.text.push_str(&format!("# environment: map {name:?}\n"));
        }
        if let Some(eta) = self.eta {
            let index = only_medium(scene)?;
            let medium = &mut scene.media[index];
            medium.eta = Eta::try_from(eta)?;
            medium.check_at(RGB_WAVELENGTH_UM).map_err(|e| Error::Override(e.to_string()))?;
            scene.warnings.extend(medium.doubt());
            told.update(eta.to_le_bytes());
            let name = &scene.media[index].name;
            scene.source.text.push_str(&format!("# medium {name:?}: eta {eta:?}\n"));
        }
        if *self != Self::default() {
            scene.source.sha256 =
                told.finalize().iter().map(|byte| format!("{byte:02x}")).collect();
        }
        Ok(())
    }
}

/// The one medium that an index can be meant for.
fn only_medium(scene: &Scene) -> Result<usize, Error> {
    let solids = scene.objects.iter().filter_map(|object| match object.surface {
        Surface::Dielectric { medium, .. } => Some(usize::from(medium.0)),
        _ => None,
    });
    let found: Vec<usize> = solids.collect::<BTreeSet<_>>().into_iter().collect();
    let refused = |what: String| Err(Error::Override(format!("scene {}: {what}", scene.name)));
    match found[..] {
        [] => refused("it has no transparent body, so an index has no place".to_owned()),
        [0] => refused(
            "its bodies are made of what surrounds them, so an index of their own has no place"
                .to_owned(),
        ),
        [index] => match scene.media[index].dispersion {
            Dispersion::None | Dispersion::Gltf { .. } => Ok(index),
            _ => refused(format!(
                "medium \"{}\" has a law of dispersion, which an index cannot replace\nwrite eta in \
                 place of the law in the scene's file",
                scene.media[index].name
            )),
        },
        _ => {
            let names: Vec<&str> = found.iter().map(|i| scene.media[*i].name.as_str()).collect();
            refused(format!(
                "its bodies are made of {}, and an index can be given for one\nwrite it in the scene's \
                 file",
                names.join(", ")
            ))
        }
    }
}

#[cfg(test)]
mod tests {
    #![allow(clippy::unwrap_used, reason = "a failing test may panic")]
    use super::*;

    fn with(name: &str, overrides: &Overrides) -> Result<Scene, Error> {
        let mut scene = crate::builtin(name).unwrap();
        overrides.apply(&mut scene).map(|()| scene)
    }

    fn eta(value: f64) -> Overrides {
        Overrides { eta: Some(value), ..Overrides::default() }
    }

    #[test]
    fn nothing_changes_nothing() {
        let (plain, same) = (crate::builtin("ball").unwrap(), Overrides::default());
        let same = with("ball", &same).unwrap();
        assert_eq!(plain.source, same.source);
        assert_eq!(plain.media, same.media);
    }

    #[test]
    fn an_index_takes_the_place_of_the_only_mediums() {
        let plain = crate::builtin("ball").unwrap();
        let scene = with("ball", &eta(2.0)).unwrap();
        assert_eq!(scene.medium_of(&scene.objects[0]).unwrap().eta.get(), 2.0);
        assert_ne!(plain.source.sha256, scene.source.sha256);
        assert_ne!(with("ball", &eta(2.1)).unwrap().source.sha256, scene.source.sha256);
        assert!(scene.source.text.ends_with("eta 2.0\n"), "{}", scene.source.text);
        assert!(with("ball", &eta(5.0)).unwrap().warnings[0].contains("index 5"));
    }

    #[test]
    fn an_index_without_a_place_is_refused() {
        let refused = |name: &str, value| with(name, &eta(value)).unwrap_err().to_string();
        assert!(refused("ball", 0.5).contains("below 1"));
        assert!(refused("uniform-nested", 1.5).contains("an index can be given for one"));
        assert!(refused("dispersion-ball", 1.5).contains("law of dispersion"));
    }

    #[test]
    fn a_map_takes_the_place_of_the_environment() {
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("grey.exr");
        let with_red = |red: f64| {
            let mut layers = crate::Layers::new([8, 4]);
            let data = [red, 0.5, 0.5].repeat(32);
            layers.push(crate::LayerName::Radiance, 3, data);
            image::write_exr(&path, &layers).unwrap();
            with("uniform-ball", &Overrides { map: Some(path.clone()), eta: None }).unwrap()
        };
        let (one, other) = (with_red(0.25), with_red(0.75));
        assert_eq!(one.environment.radiance(glam::DVec3::Y).x, 0.25);
        assert_ne!(one.source.sha256, other.source.sha256);
        let missing = Overrides { map: Some("missing.exr".into()), eta: None };
        assert!(with("ball", &missing).unwrap_err().to_string().contains("missing.exr"));
    }
}
