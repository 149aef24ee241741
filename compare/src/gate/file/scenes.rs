//! A gate over scenes, as people write it: which methods are watched on which
//! scenes, and how.

use super::expectation::Expectation;
use super::margin::Written;
use super::{beside, read_toml};
use crate::Error;
use crate::gate::GateError;
use crate::gate::verdict::Rule;
use crate::support::statistics::Correction;
use ::scenes::Scene;
use realtime::Method;
use serde::Deserialize;
use std::collections::BTreeMap;
use std::path::{Path, PathBuf};
use std::sync::Arc;

/// How the exact image is made.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum Estimator {
    /// The whole tree at the positions of the method: it has no noise.
    #[default]
    Tree,
    /// 16 independent batches of random paths through the same positions, and the
    /// standard error that they show.
    Paths,
}

/// The file.
#[derive(Debug, Deserialize)]
#[serde(deny_unknown_fields)]
struct Document {
    baseline: Option<PathBuf>,
    resolution_px: Option<u32>,
    positions: Option<u32>,
    level: Option<f64>,
    #[serde(default)]
    correction: Correction,
    #[serde(default)]
    margin: Written,
    cells: Vec<Group>,
    #[serde(default)]
    expect: Vec<Expectation>,
}

/// Every method on every scene of one `[[cells]]`.
#[derive(Debug, Deserialize)]
#[serde(deny_unknown_fields)]
struct Group {
    scenes: Vec<String>,
    methods: Vec<String>,
    #[serde(default)]
    parameters: BTreeMap<String, String>,
    #[serde(default)]
    exact: Estimator,
    /// False leaves it to checks without `--quick`.
    #[serde(default = "yes")]
    quick: bool,
}

fn yes() -> bool {
    true
}

/// A gate over scenes.
#[derive(Debug)]
pub struct SceneGate {
    /// The file it was read from.
    pub path: PathBuf,
    /// Where its baseline lies.
    pub baseline: PathBuf,
    /// How sure one has to be.
    pub rule: Rule,
    /// What may be worse.
    pub margins: Written,
    /// Failures that are known.
    pub expected: Vec<Expectation>,
    /// Width and height of every image, pixels.
    pub resolution_px: [u32; 2],
    /// K of the K x K positions per pixel.
    pub positions: u32,
    /// What is watched.
    pub cells: Vec<SceneCell>,
}

/// A method on a scene.
#[derive(Clone, Debug)]
pub struct SceneCell {
    /// `scene/method`, with the parameters that are not the method's own.
    pub name: String,
    /// The scene.
    pub scene: Arc<Scene>,
    /// Id of the method.
    pub method: String,
    /// Parameters that differ from the method's own.
    pub parameters: BTreeMap<String, String>,
    /// How the exact image is made.
    pub exact: Estimator,
    /// True if `--quick` looks at it.
    pub quick: bool,
}

impl SceneGate {
    /// Reads a gate and the scenes that it names.
    ///
    /// # Errors
    /// If the file or a scene cannot be read, or a number is out of range.
    pub fn read(path: &Path) -> Result<Self, Error> {
        let document: Document = read_toml(path)?;
        let fail = |reason: String| Err(Error::Gate(GateError::file(path, reason)));
        let side_px = document.resolution_px.unwrap_or(128);
        if !(16..=1024).contains(&side_px) {
            return fail(format!("resolution_px = {side_px} is not from 16 to 1024"));
        }
        let positions = document.positions.unwrap_or(4);
        if !(1..=16).contains(&positions) {
            return fail(format!("positions = {positions} is not from 1 to 16"));
        }
        let level = document.level.unwrap_or(Rule::default().level);
        if !(level > 0.0 && level <= 0.5) {
            return fail(format!("level = {level} is not between 0 and 0.5"));
        }
        let cells = cells(path, &document.cells)?;
        let mut names: Vec<&str> = cells.iter().map(|cell| cell.name.as_str()).collect();
        names.sort_unstable();
        if let Some(twice) = names.windows(2).find(|pair| pair[0] == pair[1]) {
            return fail(format!("the cell {} is written twice", twice[0]));
        }
        if let Some(unknown) = document.expect.iter().find(|e| !names.contains(&&*e.cell)) {
            let known = names.join(", ");
            return fail(format!(
                "[[expect]] names no cell: \"{}\"; there are: {known}",
                unknown.cell
            ));
        }
        let named = document.baseline.unwrap_or_else(|| {
            PathBuf::from(path.file_name().unwrap_or_default()).with_extension("baseline")
        });
        Ok(Self {
            path: path.to_owned(),
            baseline: beside(path, &named),
            rule: Rule { level, correction: document.correction },
            margins: document.margin,
            expected: document.expect,
            resolution_px: [side_px; 2],
            positions,
            cells,
        })
    }
}

fn cells(path: &Path, groups: &[Group]) -> Result<Vec<SceneCell>, Error> {
    let mut loaded: BTreeMap<&str, Arc<Scene>> = BTreeMap::new();
    let mut cells = Vec::new();
    for group in groups {
        for name in &group.scenes {
            if !loaded.contains_key(name.as_str()) {
                // A file's name is meant from the folder of the gate.
                let file = name.ends_with(".toml").then(|| beside(path, Path::new(name)));
                let found = file.map_or_else(|| name.clone(), |f| f.display().to_string());
                loaded.insert(name, Arc::new(::scenes::find(&found)?));
            }
            let scene = &loaded[name.as_str()];
            for method in &group.methods {
                let method = Method::find(method)?.id.to_owned();
                let own: Vec<String> = group
                    .parameters
                    .iter()
                    .map(|(name, value)| format!(",{name}={value}"))
                    .collect();
                cells.push(SceneCell {
                    name: format!("{}/{method}{}", scene.name, own.concat()),
                    scene: Arc::clone(scene),
                    method,
                    parameters: group.parameters.clone(),
                    exact: group.exact,
                    quick: group.quick,
                });
            }
        }
    }
    match cells.is_empty() {
        true => Err(GateError::file(path, "no cell is watched: name scenes and methods").into()),
        false => Ok(cells),
    }
}
