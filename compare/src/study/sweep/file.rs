//! A study as a file: the same names as on the command line.

use super::values::{number, values};
use super::{Axes, External, Knob, Sweep};
use crate::Error;
use crate::results::Scalar;
use crate::support::files::FileError;
use serde::Deserialize;
use std::path::{Path, PathBuf};
use toml::{Spanned, Table, Value};

/// Keys of a sweep that are neither parameters nor numbers of the scene.
const OWN_KEYS: [&str; 4] = ["method", "scenes", "resolution", "supersampling"];
/// First steps of the paths to numbers in a scene file.
const SECTIONS: [&str; 9] = [
    "camera",
    "environment",
    "surroundings",
    "medium",
    "shape",
    "object",
    "light",
    "sequence",
    "judgement",
];

/// A study file, read and checked as far as it can be alone.
#[derive(Debug, Default)]
pub struct StudyFile {
    /// Scenes by name or path; paths are relative to the file's folder.
    pub scenes: Vec<String>,
    /// Methods by id; none: all.
    pub methods: Vec<String>,
    /// Methods in files.
    pub method_files: Vec<String>,
    /// What is varied everywhere.
    pub axes: Axes,
    /// What is varied of some.
    pub sweeps: Vec<Sweep>,
    /// Images of others.
    pub externals: Vec<External>,
    /// k of the k x k positions per pixel on both sides.
    pub positions: Option<u32>,
    /// Branches of the exact tree below this weight are cut.
    pub cut: Option<f64>,
    /// Seconds for which each method is timed.
    pub timing_s: Option<f64>,
    /// As `--quick`.
    pub quick: bool,
    /// Which method is best within this many milliseconds.
    pub budget_ms: Option<f64>,
}

#[derive(Debug, Deserialize)]
#[serde(deny_unknown_fields)]
struct Text {
    scenes: Vec<String>,
    #[serde(default)]
    methods: Vec<String>,
    #[serde(default)]
    method_files: Vec<String>,
    resolution: Option<Spanned<Value>>,
    supersampling: Option<Spanned<Value>>,
    positions: Option<u32>,
    cut: Option<f64>,
    timing_s: Option<f64>,
    #[serde(default)]
    quick: bool,
    budget_ms: Option<f64>,
    set: Option<Spanned<Table>>,
    param: Option<Spanned<Table>>,
    #[serde(default)]
    sweep: Vec<Spanned<Table>>,
    #[serde(default)]
    external: Vec<ExternalText>,
}

#[derive(Debug, Deserialize)]
#[serde(deny_unknown_fields)]
struct ExternalText {
    name: String,
    scene: Option<String>,
    image: PathBuf,
    milliseconds: Option<f64>,
    #[serde(default)]
    adapter: String,
}

/// True if a TOML file describes a study and not a scene: it lists scenes.
#[must_use]
pub fn is_study(path: &Path) -> bool {
    let is_toml = path.extension().is_some_and(|e| e.eq_ignore_ascii_case("toml"));
    let text = if is_toml { std::fs::read_to_string(path).ok() } else { None };
    let table = text.and_then(|text| text.parse::<Table>().ok());
    table.is_some_and(|table| table.contains_key("scenes") && !table.contains_key("camera"))
}

/// Reads a study file.
///
/// # Errors
/// If it is no TOML, a key is unknown, or a list of values is none.
pub fn read(path: &Path) -> Result<StudyFile, Error> {
    let text = std::fs::read_to_string(path).map_err(FileError::of(path, "cannot be read"))?;
    let folder = path.parent().unwrap_or(Path::new(""));
    parse(&text, &path.display().to_string(), folder).map_err(Error::Usage)
}

/// Reads a study from text; paths in it are relative to a folder.
fn parse(text: &str, name: &str, folder: &Path) -> Result<StudyFile, String> {
    let file = |place: String, what: String| format!("{place}: {what}");
    let at = |offset: usize| {
        format!("{name}:{}", text[..offset.min(text.len())].matches('\n').count() + 1)
    };
    let read: Text =
        toml::from_str(text).map_err(|error| file(name.to_owned(), error.to_string()))?;
    let mut axes = Axes::default();
    if let Some(value) = &read.resolution {
        axes.resolution_px =
            resolutions(value.get_ref()).map_err(|e| file(at(value.span().start), e))?;
    }
    if let Some(value) = &read.supersampling {
        axes.supersampling = whole(value.get_ref()).map_err(|e| file(at(value.span().start), e))?;
    }
    if let Some(set) = &read.set {
        flat("", set.get_ref(), &mut |key, value| {
            axes.scene.insert(key.to_owned(), numbers_of(value)?);
            Ok(())
        })
        .map_err(|e| file(at(set.span().start), e))?;
    }
    if let Some(param) = &read.param {
        flat("", param.get_ref(), &mut |key, value| {
            axes.param.push(knob(key, scalars(value)?));
            Ok(())
        })
        .map_err(|e| file(at(param.span().start), e))?;
    }
    let sweeps = read.sweep.iter().map(|table| {
        sweep(table.get_ref()).map_err(|e| file(at(table.span().start), format!("[[sweep]]: {e}")))
    });
    let sweeps = sweeps.collect::<Result<_, _>>()?;
    let beside = |path: &str| {
        let beside = folder.join(path);
        if beside.exists() { beside.display().to_string() } else { path.to_owned() }
    };
    let externals = read.external.into_iter().map(|e| External {
        name: e.name,
        scene: e.scene,
        image: folder.join(e.image),
        milliseconds: e.milliseconds,
        adapter: e.adapter,
    });
    Ok(StudyFile {
        scenes: read.scenes.iter().map(|scene| beside(scene)).collect(),
        methods: read.methods,
        method_files: read.method_files.iter().map(|path| beside(path)).collect(),
        axes,
        sweeps,
        externals: externals.collect(),
        positions: read.positions,
        cut: read.cut,
        timing_s: read.timing_s,
        quick: read.quick,
        budget_ms: read.budget_ms,
    })
}

fn sweep(table: &Table) -> Result<Sweep, String> {
    let mut sweep = Sweep::default();
    let text = |value: &Value| value.as_str().map(str::to_owned);
    for (key, value) in table {
        match key.as_str() {
            "method" => {
                sweep.method = Some(text(value).ok_or("method is the id of a method in quotes")?);
            }
            "scenes" => {
                let names = value.as_array().map(|list| list.iter().filter_map(text).collect());
                sweep.scenes = names.ok_or("scenes is a list such as [\"ball\"]")?;
            }
            "resolution" => sweep.axes.resolution_px = resolutions(value)?,
            "supersampling" => sweep.axes.supersampling = whole(value)?,
            _ => {
                let start = Table::from_iter([(key.clone(), value.clone())]);
                flat("", &start, &mut |key, value| {
                    let section = key.split('.').next().unwrap_or_default();
                    if key.contains('.') && SECTIONS.contains(&section) {
                        sweep.axes.scene.insert(key.to_owned(), numbers_of(value)?);
                    } else {
                        sweep.axes.param.push(knob(key, scalars(value)?));
                    }
                    Ok(())
                })?;
            }
        }
    }
    if sweep.axes == Axes::default() {
        let own = OWN_KEYS.join(", ");
        return Err(format!(
            "nothing varies; write a parameter such as a = \"0:1:0.1\", a number of the scene such \
             as medium.glass.eta = [1.3, 1.5], or one of {own}"
        ));
    }
    Ok(sweep)
}

/// A parameter's values, `METHOD.NAME` or `NAME`.
pub fn knob(key: &str, values: Vec<Scalar>) -> Knob {
    let (method, name) = match key.rsplit_once('.') {
        Some((method, name)) => (Some(method.to_owned()), name.to_owned()),
        None => (None, key.to_owned()),
    };
    Knob { method, name, values }
}

type Take<'a> = dyn FnMut(&str, &Value) -> Result<(), String> + 'a;

/// Every value of nested tables by its path: `a.b = 1` and `[a] b = 1` alike.
fn flat(before: &str, table: &Table, take: &mut Take) -> Result<(), String> {
    for (key, value) in table {
        let path = if before.is_empty() { key.clone() } else { format!("{before}.{key}") };
        match value {
            Value::Table(inner) => flat(&path, inner, take)?,
            value => take(&path, value).map_err(|error| format!("{path}: {error}"))?,
        }
    }
    Ok(())
}

/// A value, a list of values, or a text as on the command line.
fn scalars(value: &Value) -> Result<Vec<Scalar>, String> {
    match value {
        Value::Integer(number) => Ok(vec![Scalar::Number(*number as f64)]),
        Value::Float(number) if number.is_finite() => Ok(vec![Scalar::Number(*number)]),
        Value::String(text) => values(text),
        Value::Array(items) if !items.is_empty() => {
            let lists: Result<Vec<_>, String> = items.iter().map(scalars).collect();
            Ok(lists?.into_iter().flatten().collect())
        }
        _ => {
            Err("write a value, a list such as [0.1, 0.2], or a range such as \"0:1:0.1\""
                .to_owned())
        }
    }
}

fn numbers_of(value: &Value) -> Result<Vec<f64>, String> {
    scalars(value)?.iter().map(number).collect()
}

fn whole(value: &Value) -> Result<Vec<u32>, String> {
    let read = |number: f64| {
        let fits = number.fract() == 0.0 && (1.0..=16.0).contains(&number);
        fits.then_some(number as u32).ok_or(format!("{number} is no whole number from 1 to 16"))
    };
    numbers_of(value)?.into_iter().map(read).collect()
}

/// `"256x256"`, a list of such, or a list of sides.
fn resolutions(value: &Value) -> Result<Vec<[u32; 2]>, String> {
    scalars(value)?.iter().map(|size| resolution(&size.to_string())).collect()
}

/// Reads `WIDTHxHEIGHT`, or one number for both.
///
/// # Errors
/// If it is neither.
pub fn resolution(text: &str) -> Result<[u32; 2], String> {
    let (width, height) = text.split_once(['x', 'X']).unwrap_or((text, text));
    let side = |text: &str| {
        let side = text.trim().parse().ok().filter(|side| (1..=16_384).contains(side));
        side.ok_or_else(|| {
            format!("`{text}` is no number of pixels from 1 to 16384; write 512x512")
        })
    };
    Ok([side(width)?, side(height)?])
}

#[cfg(test)]
mod tests {
    #![allow(clippy::unwrap_used, reason = "a failing test may panic")]
    use super::*;

    fn study(text: &str) -> Result<StudyFile, String> {
        parse(text, "s.toml", Path::new(""))
    }

    #[test]
    fn a_study_file_says_what_the_command_line_says() {
        let read = study(
            "scenes = [\"ball\"]\nresolution = [\"64x32\", 128]\nsupersampling = \"1,2\"\n\
             budget_ms = 4\nset = { medium.glass.eta = \"1.1:1.3:0.1\" }\n\
             [[sweep]]\nmethod = \"blended\"\na = [0, 0.5]\ncamera.orbit_deg = [0, 90]\n\
             [[sweep]]\nmulti.peel_px = 64\n\
             [[external]]\nname = \"engine\"\nimage = \"frame.exr\"\nmilliseconds = 4.2\n",
        )
        .unwrap();
        assert_eq!(read.axes.resolution_px, [[64, 32], [128, 128]]);
        assert_eq!(read.axes.supersampling, [1, 2]);
        assert_eq!(read.axes.scene["medium.glass.eta"], [1.1, 1.2, 1.3]);
        assert_eq!(
            read.sweeps[0].axes.param[0],
            knob("a", vec![Scalar::Number(0.0), Scalar::Number(0.5)])
        );
        assert_eq!(read.sweeps[0].axes.scene["camera.orbit_deg"], [0.0, 90.0]);
        assert_eq!(read.sweeps[1].axes.param[0].method.as_deref(), Some("multi"));
        assert_eq!(read.externals[0].milliseconds, Some(4.2));
        assert_eq!(read.budget_ms, Some(4.0));
    }

    #[test]
    fn a_wrong_file_says_where_and_what_instead() {
        for (text, words) in [
            ("scene = [\"ball\"]", "unknown field `scene`"),
            ("scenes = [\"ball\"]\nresolution = \"0x4\"", "s.toml:2: `0` is no number of pixels"),
            ("scenes = [\"ball\"]\nsupersampling = 0", "s.toml:2: 0 is no whole number"),
            (
                "scenes = [\"ball\"]\n\n[[sweep]]\nmethod = \"multi\"",
                "s.toml:3: [[sweep]]: nothing varies",
            ),
            (
                "scenes = [\"ball\"]\n[[sweep]]\na = \"0:1\"",
                "s.toml:2: [[sweep]]: a: \"0:1\" is no range",
            ),
            ("scenes = [\"ball\"]\nset = { medium.glass.eta = \"x\" }", "\"x\" is not a number"),
            ("scenes = 3", "s.toml: TOML parse error at line 1"),
        ] {
            let error = study(text).unwrap_err();
            assert!(error.contains(words), "{text}\n{error}");
        }
    }
}
