//! Scenes that are part of the program, so that an installed one has them.

use crate::{Error, Scene, format, import};
use std::path::{Path, PathBuf};

/// A scene that is part of the program.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Builtin {
    /// Name on the command line.
    pub name: &'static str,
    /// TOML text.
    pub text: &'static str,
    /// Part of the default study.
    pub in_default_study: bool,
    /// Part of the quick study.
    pub in_quick_study: bool,
    /// Files that set-up fetches and that are not part of the program.
    pub assets: &'static [&'static str],
}

/// Which studies a scene belongs to.
const QUICK: (bool, bool) = (true, true);
const DEFAULT: (bool, bool) = (true, false);
const MORE: (bool, bool) = (false, false);

macro_rules! builtins {
    ($(($name:literal, $studies:expr, $assets:expr)),* $(,)?) => {
        [$(Builtin {
            name: $name,
            text: include_str!(concat!("../builtin/", $name, ".toml")),
            in_default_study: $studies.0,
            in_quick_study: $studies.1,
            assets: &$assets,
        }),*]
    };
}

static BUILTINS: [Builtin; 23] = builtins![
    ("ball", QUICK, []),
    ("ice-cube", QUICK, []),
    ("teapot", QUICK, []),
    ("cup", QUICK, []),
    ("box", DEFAULT, []),
    ("bunny", DEFAULT, ["bunny.obj", "courtyard.exr"]),
    ("ball-orthographic", MORE, []),
    ("slab", MORE, []),
    ("shell", MORE, []),
    ("bubble", MORE, []),
    ("glass-of-water", MORE, []),
    ("ice-block", DEFAULT, []),
    ("mug", MORE, []),
    ("dispersion-ball", MORE, []),
    ("diamond", MORE, []),
    ("prism", MORE, []),
    ("caustic-ball", MORE, []),
    ("spinning-cup", MORE, []),
    ("wobbling-ball", MORE, []),
    ("absorbing-slab", MORE, []),
    ("uniform-ball", MORE, []),
    ("uniform-cup", MORE, []),
    ("uniform-nested", MORE, []),
];

/// All built-in scenes, those of the studies first.
#[must_use]
pub fn builtins() -> &'static [Builtin] {
    &BUILTINS
}

/// The built-in scene of that name.
///
/// # Errors
/// If there is none, or a file that set-up fetches is not there.
pub fn builtin(name: &str) -> Result<Scene, Error> {
    let Some(scene) = BUILTINS.iter().find(|scene| scene.name == name) else {
        let known: Vec<_> = BUILTINS.iter().map(|scene| scene.name).collect();
        return Err(Error::UnknownScene { name: name.to_owned(), known: known.join(", ") });
    };
    scene.load()
}

/// The built-in scene of that name or, if there is none, the file of that name.
///
/// # Errors
/// If there is neither, or the file is no scene.
pub fn find(name_or_path: &str) -> Result<Scene, Error> {
    let path = Path::new(name_or_path);
    let built_in = BUILTINS.iter().any(|scene| scene.name == name_or_path);
    let looks_like_a_path = path.extension().is_some() || path.components().count() > 1;
    if built_in || !(looks_like_a_path || path.exists()) {
        return builtin(name_or_path);
    }
    let is = |wanted: &str| path.extension().is_some_and(|e| e.eq_ignore_ascii_case(wanted));
    if is("gltf") || is("glb") {
        return Ok(import::load(path, crate::format::default_sky)?);
    }
    format::load(path)
}

impl Builtin {
    /// Reads the scene.
    ///
    /// # Errors
    /// If a file that set-up fetches is not there or broken.
    pub fn load(&self) -> Result<Scene, Error> {
        if let Some(path) = self.missing() {
            return Err(Error::MissingAsset { scene: self.name.to_owned(), path });
        }
        let name = format!("built-in {}", self.name);
        let mut scene = format::parse(self.text, &name, &assets_folder())?;
        scene.name = self.name.to_owned();
        Ok(scene)
    }

    /// The first file the scene needs that set-up has not fetched, if any.
    #[must_use]
    pub fn missing(&self) -> Option<PathBuf> {
        let assets = assets_folder();
        self.assets.iter().map(|name| assets.join(name)).find(|path| !path.exists())
    }

    /// The title in its text, without loading anything.
    #[must_use]
    pub fn title(&self) -> String {
        let table: Option<toml::Table> = toml::from_str(self.text).ok();
        let title = table.as_ref().and_then(|table| table.get("title")?.as_str());
        title.unwrap_or_default().to_owned()
    }
}

/// Where a file that set-up fetches is, or would be.
#[must_use]
pub fn asset(name: &str) -> PathBuf {
    assets_folder().join(name)
}

/// Where set-up puts files that are fetched: `SNELL_ASSETS`, or `target/assets`
/// in this folder or the nearest one above that has it.
fn assets_folder() -> PathBuf {
    const FOLDER: &str = "target/assets";
    if let Some(folder) = std::env::var_os("SNELL_ASSETS") {
        return folder.into();
    }
    let here = std::env::current_dir().unwrap_or_default();
    let found = here.ancestors().map(|folder| folder.join(FOLDER)).find(|folder| folder.is_dir());
    found.unwrap_or_else(|| FOLDER.into())
}

#[cfg(test)]
mod tests {
    #![allow(clippy::unwrap_used, reason = "a failing test may panic")]
    use super::*;

    /// Every scene loads without a warning, or says which file to fetch.
    #[test]
    fn every_built_in_scene_is_sound() {
        for scene in builtins() {
            match scene.load() {
                Ok(loaded) => {
                    assert_eq!(loaded.name, scene.name);
                    assert!(!loaded.title.is_empty() && !loaded.objects.is_empty());
                    // Compressed maps ring below zero; that they were repaired is no flaw.
                    let flaws =
                        loaded.warnings.iter().filter(|w| !w.contains("have been repaired"));
                    assert_eq!(flaws.count(), 0, "{}: {:?}", scene.name, loaded.warnings);
                }
                Err(Error::MissingAsset { path, .. }) => assert!(!path.exists()),
                Err(error) => panic!("{}: {error}", scene.name),
            }
        }
    }

    #[test]
    fn an_unknown_name_lists_the_known_ones() {
        let error = find("tea-pot").unwrap_err().to_string();
        assert!(error.contains("no built-in scene is called \"tea-pot\""), "{error}");
        assert!(error.contains("teapot, cup"), "{error}");
        let error = find("nowhere/scene.toml").unwrap_err().to_string();
        assert!(error.starts_with("cannot read the scene nowhere/scene.toml"), "{error}");
    }

    #[test]
    fn the_quick_study_has_four_scenes() {
        let quick: Vec<_> =
            builtins().iter().filter(|scene| scene.in_quick_study).map(|s| s.name).collect();
        assert_eq!(quick, ["ball", "ice-cube", "teapot", "cup"]);
    }
}
