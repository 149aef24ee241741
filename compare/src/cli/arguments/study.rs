//! What a study is asked: the same words for `study`, `jobs` and `run`, and the same
//! names in a study file.

use super::external::ExternalArgs;
use super::scene::OverrideArgs;
use super::values;
use crate::Error;
use crate::cli::output::Output;
use crate::results::NotDone;
use crate::study::Spec;
use crate::study::sweep::{Axes, Knob, file, values::numbers, values::values as list};
use realtime::Method;
use scenes::{Builtin, Scene};
use std::path::{Path, PathBuf};

/// What is studied.
#[derive(clap::Args, Debug)]
pub(in crate::cli) struct StudyArgs {
    /// Built-in names (see `snell scenes`) or scene files, or one study file, which says all that the
    /// options below say [default: the default scenes]
    scenes: Vec<String>,
    /// Approximation to judge; repeat for several [default: all]
    #[arg(short, long = "method", value_name = "METHOD")]
    methods: Vec<String>,
    /// Judge the method in this file of WGSL too; repeat for several
    #[arg(long = "method-file", value_name = "FILE.wgsl", value_parser = method_file)]
    method_files: Vec<String>,
    /// Judge this closed mesh instead of a scene, with the camera fitted to it: of index 1.5, under
    /// a procedural sky, unless --eta and --map say otherwise
    #[arg(long, value_name = "FILE.obj", conflicts_with = "scenes")]
    obj: Option<PathBuf>,
    #[command(flatten)]
    in_place: OverrideArgs,
    /// 256 x 256, four scenes, 0.2 s of timing, a shorter curve of the exact renderer, and no second
    /// frame with everything kept that tells how much time leaving out saves: what CI runs
    #[arg(long)]
    quick: bool,
    /// K: both sides take the mean over K x K positions in each pixel [default: 4]
    #[arg(long, value_name = "K", value_parser = clap::value_parser!(u32).range(1..=16))]
    positions: Option<u32>,
    /// Weight, of 1 per camera ray, below which a branch of the exact tree is cut [default: 1e-4]
    #[arg(long, value_name = "WEIGHT")]
    cut: Option<f64>,
    /// Time each method for this many seconds [default: 0.5, or 0.2 with --quick]
    #[arg(long, value_name = "SECONDS")]
    timing: Option<f64>,
    /// Say which method is best within this many milliseconds per frame
    #[arg(long, value_name = "MS", allow_negative_numbers = true)]
    budget_ms: Option<f64>,
    #[command(flatten)]
    axes: AxisArgs,
    #[command(flatten)]
    externals: ExternalArgs,
}

/// What varies: all combinations are studied.
#[derive(clap::Args, Debug)]
#[command(next_help_heading = "Sweeps: values are lists A,B,C and ranges START:STOP:STEP")]
struct AxisArgs {
    /// Parameter of a method, [METHOD.]NAME=VALUES, such as a=0:1:0.1; repeat for several
    #[arg(short, long = "param", value_name = "NAME=VALUES", value_parser = param)]
    params: Vec<Knob>,
    /// Number in the scene file, such as medium.glass.eta=1.05:2.4:0.15; repeat for several
    #[arg(long = "set", value_name = "KEY=VALUES", value_parser = set)]
    set: Vec<(String, Vec<f64>)>,
    /// Width x height in pixels, such as 256x256,640x360 [default: each scene's]
    #[arg(long, value_name = "WxH", value_delimiter = ',', value_parser = file::resolution)]
    resolution: Vec<[u32; 2]>,
    /// K of the K x K positions per pixel that a timed frame draws; its error counts what the pixels
    /// then still miss [default: 1]
    #[arg(long, value_name = "K", value_delimiter = ',',
        value_parser = clap::value_parser!(u32).range(1..=16))]
    supersampling: Vec<u32>,
}

impl StudyArgs {
    /// What is asked, from a study file or from the words of the command line.
    pub(in crate::cli) fn spec(&self, output: Output) -> Result<Spec, Error> {
        let study = self.scenes.iter().find(|name| file::is_study(Path::new(name)));
        let spec = match study {
            Some(path) => self.of_file(Path::new(path), output),
            None => self.of_words(output),
        }?;
        // Said before anything is made, though both renderers would refuse too.
        spec.scenes.iter().try_for_each(scenes::Scene::must_have_bodies)?;
        Ok(spec)
    }

    fn of_words(&self, output: Output) -> Result<Spec, Error> {
        let mut left_out = Vec::new();
        let mut axes = Axes {
            resolution_px: self.axes.resolution.clone(),
            supersampling: self.axes.supersampling.clone(),
            scene: self.axes.set.iter().cloned().collect(),
            param: self.axes.params.clone(),
        };
        if self.axes.set.len() != axes.scene.len() {
            return Err(Error::Usage(
                "one key is given twice after --set; write it once".to_owned(),
            ));
        }
        if self.in_place.is_some() && self.obj.is_none() && !axes.scene.is_empty() {
            return Err(Error::Usage(
                "--set changes a scene's text, and --map and --eta what comes of it\nwrite the map and \
                 the index in the scene's file"
                    .to_owned(),
            ));
        }
        if axes.resolution_px.is_empty() && self.quick {
            axes.resolution_px.push([256, 256]);
        }
        Ok(Spec {
            scenes: self.scenes(output, &mut left_out)?,
            methods: methods(&self.methods, &self.method_files)?,
            left_out,
            axes,
            sweeps: Vec::new(),
            externals: self.externals.list()?,
            positions_per_axis: self.positions.unwrap_or(4),
            cut: self.cut.unwrap_or(1e-4),
            timing_s: self.timing.unwrap_or(if self.quick { 0.2 } else { 0.5 }),
            thorough: !self.quick,
            budget_ms: positive("--budget-ms", self.budget_ms)?,
        })
    }

    fn of_file(&self, path: &Path, output: Output) -> Result<Spec, Error> {
        let AxisArgs { params, set, resolution, supersampling } = &self.axes;
        let said_twice = [
            ("another scene", self.scenes.len() > 1),
            ("--method", !self.methods.is_empty() || !self.method_files.is_empty()),
            ("--map", self.in_place.map.is_some()),
            ("--eta", self.in_place.eta.is_some()),
            ("--quick", self.quick),
            ("--positions", self.positions.is_some()),
            ("--cut", self.cut.is_some()),
            ("--timing", self.timing.is_some()),
            ("--budget-ms", self.budget_ms.is_some()),
            ("--param", !params.is_empty()),
            ("--set", !set.is_empty()),
            ("--resolution", !resolution.is_empty()),
            ("--supersampling", !supersampling.is_empty()),
            ("--image", !self.externals.is_empty()),
        ];
        if let Some((word, _)) = said_twice.iter().find(|(_, said)| *said) {
            return Err(Error::Usage(format!(
                "{} is a study file, and says by itself what {word} would say\nwrite it there, or \
                 leave the file out",
                path.display()
            )));
        }
        let read = file::read(path)?;
        let mut axes = read.axes;
        if axes.resolution_px.is_empty() && read.quick {
            axes.resolution_px.push([256, 256]);
        }
        let positions = read.positions.unwrap_or(4);
        if !(1..=16).contains(&positions) {
            return Err(Error::Usage(format!("positions = {positions} is not from 1 to 16")));
        }
        let mut sweeps = read.sweeps;
        for method in sweeps.iter_mut().filter_map(|sweep| sweep.method.as_mut()) {
            *method = Method::find(method)?.id.to_owned();
        }
        let named = sweeps.iter().filter_map(|sweep| sweep.method.clone());
        let mut methods = methods(&read.methods, &read.method_files)?;
        let new: Vec<String> = named.filter(|method| !methods.contains(method)).collect();
        methods.extend(new);
        Ok(Spec {
            scenes: read
                .scenes
                .iter()
                .map(|name| self.in_place.load(name, output))
                .collect::<Result<_, _>>()?,
            methods,
            left_out: Vec::new(),
            axes,
            sweeps,
            externals: read.externals,
            positions_per_axis: positions,
            cut: read.cut.unwrap_or(1e-4),
            timing_s: read.timing_s.unwrap_or(if read.quick { 0.2 } else { 0.5 }),
            thorough: !read.quick,
            budget_ms: positive("budget_ms", read.budget_ms)?,
        })
    }

    /// The scenes asked for. Of the default ones, those that this machine cannot
    /// load, for want of a file that set-up fetches, are left out.
    fn scenes(&self, output: Output, left_out: &mut Vec<NotDone>) -> Result<Vec<Scene>, Error> {
        if let Some(obj) = &self.obj {
            let OverrideArgs { map, eta } = &self.in_place;
            let scene = Scene::from_obj(obj, map.as_deref(), eta.unwrap_or(1.5))?;
            output.warn(&obj.display().to_string(), &scene.warnings)?;
            return Ok(vec![scene]);
        }
        if !self.scenes.is_empty() {
            return self.scenes.iter().map(|name| self.in_place.load(name, output)).collect();
        }
        let mut list = Vec::new();
        let wanted = |b: &&Builtin| if self.quick { b.in_quick_study } else { b.in_default_study };
        for builtin in scenes::builtins().iter().filter(wanted) {
            match builtin.load() {
                Ok(scene) => list.push(self.in_place.put_into(scene, builtin.name, output)?),
                Err(reason) => {
                    let (what, reason) = (builtin.name.to_owned(), reason.to_string());
                    left_out.push(NotDone { what, reason });
                }
            }
        }
        Ok(list)
    }
}

/// Ids of the methods asked for, or of all, and of those in files.
fn methods(asked: &[String], files: &[String]) -> Result<Vec<String>, Error> {
    let all: Vec<String> = realtime::METHODS.iter().map(|method| method.id.to_owned()).collect();
    let asked = if asked.is_empty() { &all } else { asked };
    asked.iter().chain(files).map(|name| Ok(Method::find(name)?.id.to_owned())).collect()
}

/// A method's file is known by its name's end.
fn method_file(text: &str) -> Result<String, String> {
    match text.ends_with(".wgsl") {
        true => Ok(text.to_owned()),
        false => Err("a method's file is WGSL and is called NAME.wgsl".to_owned()),
    }
}

fn param(text: &str) -> Result<Knob, String> {
    let (name, values) = values::parameter(text)?;
    Ok(file::knob(&name, list(&values)?))
}

fn set(text: &str) -> Result<(String, Vec<f64>), String> {
    let (key, values) = values::parameter(text)?;
    Ok((key, numbers(&values)?))
}

fn positive(name: &str, value: Option<f64>) -> Result<Option<f64>, Error> {
    match value {
        Some(value) if !(value.is_finite() && value > 0.0) => {
            Err(Error::Usage(format!("{name} {value} is no time; write milliseconds such as 4")))
        }
        value => Ok(value),
    }
}
