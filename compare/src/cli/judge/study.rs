//! `snell study`: every method on every scene, against the exact answer.

use crate::Error;
use crate::cli::arguments::values::resolution;
use crate::cli::arguments::{adapter::AdapterArg, scene};
use crate::cli::output::{Output, table};
use crate::cli::status::Status;
use crate::results::NotDone;
use crate::study::cache::{self, Store};
use crate::study::{self, Estimate, Spec, summary};
use realtime::Method;
use scenes::{Builtin, Scene};
use std::path::PathBuf;

/// Render scenes exactly and approximately, and report how far apart they are and what each costs
#[derive(clap::Args, Debug)]
pub(in crate::cli) struct Args {
    /// Built-in names (see `snell scenes`) or scene files [default: the default scenes]
    scenes: Vec<String>,
    /// Approximation to judge; repeat for several [default: all]
    #[arg(short, long = "method", value_name = "METHOD")]
    methods: Vec<String>,
    /// Judge the method in this file of WGSL too; repeat for several
    #[arg(long = "method-file", value_name = "FILE.wgsl", value_parser = method_file)]
    method_files: Vec<String>,
    /// Judge this closed mesh instead of a scene, with the camera fitted to it
    #[arg(long, value_name = "FILE.obj", conflicts_with = "scenes")]
    obj: Option<PathBuf>,
    /// Environment of the mesh, lat-long .exr or .hdr [default: a procedural sky]
    #[arg(long, value_name = "FILE", requires = "obj")]
    map: Option<PathBuf>,
    /// Absolute refractive index of the mesh
    #[arg(long, value_name = "INDEX", requires = "obj", default_value_t = 1.5)]
    eta: f64,
    /// Folder for the report, the results and the images
    #[arg(short, long, value_name = "DIR", default_value = "out")]
    out: PathBuf,
    /// 256 x 256, four scenes, 0.2 s of timing, a shorter curve of the exact renderer, and no second
    /// frame with everything kept that tells how much time leaving out saves: what CI runs
    #[arg(long)]
    quick: bool,
    /// Width x height in pixels, such as 640x360 [default: each scene's]
    #[arg(long, value_name = "WxH", value_parser = resolution)]
    resolution: Option<[u32; 2]>,
    /// K: both sides take the mean over K x K positions in each pixel
    #[arg(long, value_name = "K", default_value_t = 4,
        value_parser = clap::value_parser!(u32).range(1..=16))]
    positions: u32,
    /// Weight, of 1 per camera ray, below which a branch of the exact tree is cut
    #[arg(long, value_name = "WEIGHT", default_value_t = 1e-4)]
    cut: f64,
    /// Time each method for this many seconds [default: 0.5, or 0.2 with --quick]
    #[arg(long, value_name = "SECONDS")]
    timing: Option<f64>,
    /// Folder of exact images that were traced before [default: target/snell-cache in a checkout,
    /// else the user's cache folder]
    #[arg(long, value_name = "DIR")]
    cache: Option<PathBuf>,
    #[command(flatten)]
    adapter: AdapterArg,
}

pub(in crate::cli) fn run(args: &Args, output: Output) -> Result<Status, Error> {
    let mut left_out = Vec::new();
    let scenes = scenes(args, &mut left_out)?;
    let methods = methods(&args.methods, &args.method_files)?;
    let gpu = args.adapter.open()?;
    let store = Store::new(args.cache.clone().unwrap_or_else(cache::default_folder));
    let spec = Spec {
        scenes,
        methods,
        left_out,
        resolution_px: args.resolution.or(args.quick.then_some([256, 256])),
        positions_per_axis: args.positions,
        cut: args.cut,
        timing_s: args.timing.unwrap_or(if args.quick { 0.2 } else { 0.5 }),
        thorough: !args.quick,
        out: args.out.clone(),
        command: command_line(std::env::args()),
    };
    let announce = |estimate: &Estimate| Output::note(&format!("snell study: {estimate}"));
    let (study, rows) = study::run(&spec, &gpu, &store, announce)?;
    if output.json {
        for row in &rows {
            output.own_object(row)?;
        }
        return Ok(Status::Done);
    }
    output.line(&table(&summary(&study, &rows)))?;
    for NotDone { what, reason } in &study.left_out {
        output.line(&format!("left out: {what}: {}", reason.replace('\n', "; ")))?;
    }
    output.line(&format!("{} in {:.0} s", study.adapter, study.elapsed_s))?;
    output.line(&format!("report: {}", args.out.join("report.html").display()))?;
    Ok(Status::Done)
}

/// The scenes asked for. Of the default ones, those that this machine cannot
/// load, for want of a file that set-up fetches, are left out.
fn scenes(args: &Args, left_out: &mut Vec<NotDone>) -> Result<Vec<Scene>, Error> {
    if let Some(obj) = &args.obj {
        return Ok(vec![Scene::from_obj(obj, args.map.as_deref(), args.eta)?]);
    }
    if !args.scenes.is_empty() {
        return args.scenes.iter().map(|name| scene(name)).collect();
    }
    let mut list = Vec::new();
    let wanted = |b: &&Builtin| if args.quick { b.in_quick_study } else { b.in_default_study };
    for builtin in scenes::builtins().iter().filter(wanted) {
        match builtin.load() {
            Ok(scene) => list.push(scene),
            Err(reason) => {
                left_out
                    .push(NotDone { what: builtin.name.to_owned(), reason: reason.to_string() });
            }
        }
    }
    Ok(list)
}

/// A method's file is known by its name's end.
fn method_file(text: &str) -> Result<String, String> {
    match text.ends_with(".wgsl") {
        true => Ok(text.to_owned()),
        false => Err("a method's file is WGSL and is called NAME.wgsl".to_owned()),
    }
}

/// Ids of the methods asked for, or of all, and of those in files.
fn methods(asked: &[String], files: &[String]) -> Result<Vec<String>, Error> {
    let all: Vec<String> = realtime::METHODS.iter().map(|method| method.id.to_owned()).collect();
    let asked = if asked.is_empty() { &all } else { asked };
    asked.iter().chain(files).map(|name| Ok(Method::find(name)?.id.to_owned())).collect()
}

/// The command of this process as it can be typed again.
fn command_line(arguments: impl Iterator<Item = String>) -> String {
    let quoted = |argument: String| {
        let plain = |c: char| c.is_ascii_alphanumeric() || "-_./=,:".contains(c);
        match !argument.is_empty() && argument.chars().all(plain) {
            true => argument,
            false => format!("'{}'", argument.replace('\'', "'\\''")),
        }
    };
    let typed = arguments.skip(1).map(quoted);
    std::iter::once("snell".to_owned()).chain(typed).collect::<Vec<_>>().join(" ")
}
