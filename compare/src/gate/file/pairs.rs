//! A gate over image files, as people write it: anybody's renders beside their
//! references.

use super::expectation::Expectation;
use super::margin::Written;
use super::{beside, glob, read_toml};
use crate::gate::GateError;
use crate::gate::limit::Limit;
use crate::gate::verdict::Rule;
use crate::support::statistics::Correction;
use serde::Deserialize;
use std::collections::BTreeMap;
use std::path::{Path, PathBuf};

/// The file.
#[derive(Debug, Deserialize)]
#[serde(deny_unknown_fields)]
struct Document {
    baseline: Option<PathBuf>,
    gate_px: Option<u32>,
    level: Option<f64>,
    #[serde(default)]
    correction: Correction,
    #[serde(default)]
    margin: Written,
    #[serde(default)]
    limits: BTreeMap<String, f64>,
    pair: Vec<Entry>,
    #[serde(default)]
    expect: Vec<Expectation>,
}

/// One `[[pair]]`, or as many as its `*` stands for.
#[derive(Debug, Deserialize)]
#[serde(deny_unknown_fields)]
struct Entry {
    name: Option<String>,
    reference: PathBuf,
    test: PathBuf,
    mask: Option<PathBuf>,
    #[serde(default)]
    limits: BTreeMap<String, f64>,
}

/// A gate over image files.
#[derive(Debug)]
pub struct PairGate {
    /// The file it was read from.
    pub path: PathBuf,
    /// Where its baseline lies, written or not.
    pub baseline: PathBuf,
    /// How sure one has to be.
    pub rule: Rule,
    /// What may be worse.
    pub margins: Written,
    /// Failures that are known.
    pub expected: Vec<Expectation>,
    /// Longest side of the images that base and head are compared at, pixels.
    pub gate_px: u32,
    /// The pairs, in the order of the file.
    pub pairs: Vec<PairCell>,
}

/// A pair of image files.
#[derive(Clone, Debug, PartialEq)]
pub struct PairCell {
    /// Given, or the test's file name without its end.
    pub name: String,
    /// Taken as true.
    pub reference: PathBuf,
    /// Judged.
    pub test: PathBuf,
    /// Bright where it counts.
    pub mask: Option<PathBuf>,
    /// The file's limits, and over them its own.
    pub limits: Vec<Limit>,
}

impl PairGate {
    /// Reads a list of pairs.
    ///
    /// # Errors
    /// If the file cannot be read, a pattern names no file, or a limit is of no
    /// metric.
    pub fn read(path: &Path) -> Result<Self, GateError> {
        let document: Document = read_toml(path)?;
        let fail = |reason: String| GateError::file(path, reason);
        let gate_px = document.gate_px.unwrap_or(128);
        if !(16..=4096).contains(&gate_px) {
            return Err(fail(format!("gate_px = {gate_px} is not from 16 to 4096")));
        }
        let level = document.level.unwrap_or(Rule::default().level);
        if !(level > 0.0 && level <= 0.5) {
            return Err(fail(format!("level = {level} is not between 0 and 0.5")));
        }
        let mut pairs: Vec<PairCell> = Vec::new();
        for entry in &document.pair {
            pairs.extend(entry.pairs(path, &document.limits).map_err(fail)?);
        }
        for (i, pair) in pairs.iter().enumerate() {
            if pairs[..i].iter().any(|other| other.name == pair.name) {
                return Err(fail(format!(
                    "two pairs are called \"{}\"; give one of them `name = \"…\"`",
                    pair.name
                )));
            }
        }
        if let Some(unknown) =
            document.expect.iter().find(|e| pairs.iter().all(|p| p.name != e.cell))
        {
            return Err(fail(format!("[[expect]] names no pair: \"{}\"", unknown.cell)));
        }
        let own = || PathBuf::from(path.file_name().unwrap_or_default()).with_extension("baseline");
        Ok(Self {
            path: path.to_owned(),
            baseline: beside(path, &document.baseline.unwrap_or_else(own)),
            rule: Rule { level, correction: document.correction },
            margins: document.margin,
            expected: document.expect,
            gate_px,
            pairs,
        })
    }
}

impl Entry {
    fn pairs(&self, file: &Path, limits: &BTreeMap<String, f64>) -> Result<Vec<PairCell>, String> {
        let mut limits = limits.clone();
        limits.extend(self.limits.clone());
        let limits = Limit::all(&limits)?;
        let starred = |path: &Path| path.to_string_lossy().contains('*');
        // The references decide how many pairs there are: a render that is
        // missing must not take its pair away.
        let references = glob::files(&beside(file, &self.reference))?;
        if starred(&self.reference) != starred(&self.test) {
            return Err("write * in both `reference` and `test`, or in neither".to_owned());
        }
        let several = references.len() > 1;
        let pair = |(star, reference): (String, PathBuf)| {
            let test = glob::filled(&beside(file, &self.test), &star);
            let stem = test.file_stem().unwrap_or_default().to_string_lossy().into_owned();
            let name = match &self.name {
                Some(name) if several => format!("{name}/{star}"),
                Some(name) => name.clone(),
                None => stem,
            };
            let mask = self.mask.as_ref().map(|mask| glob::filled(&beside(file, mask), &star));
            PairCell { name, reference, test, mask, limits: limits.clone() }
        };
        Ok(references.into_iter().map(pair).collect())
    }
}
