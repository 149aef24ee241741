//! `snell caustics SCENE --receiver R -o FILE`: light through glass on a surface.

use crate::Error;
use crate::cli::arguments::scene::{SceneArgs, frame_is_there};
use crate::cli::arguments::values::{exr_path, resolution};
use crate::cli::output::Output;
use crate::cli::status::Status;
use crate::support::files;
use clap::value_parser;
use glam::DVec3;
use reference::{CausticMap, CausticsRequest};
use scenes::{LayerName, Layers, Scene};
use serde::Serialize;
use std::path::{Path, PathBuf};

/// Follow photons from a scene's lights, straight and through glass, to the face of an opaque
/// object, and write the irradiance there
#[derive(clap::Args, Debug)]
pub(in crate::cli) struct Args {
    #[command(flatten)]
    scene: SceneArgs,
    /// Diffuse object by name, or by its number in the file from 0: a box, whose upper face (+y)
    /// is the map, or two triangles that make a parallelogram
    #[arg(long, value_name = "NAME|INDEX")]
    receiver: String,
    /// Bins along the two sides of the face; of a box: +x, then +z
    #[arg(long, value_name = "WxH", value_parser = resolution, default_value = "512x512")]
    size: [u32; 2],
    /// Photons per light
    #[arg(long, value_name = "N", default_value_t = 16_000_000)]
    photons: u64,
    /// Independent batches, from which the variance is taken
    #[arg(long, value_name = "N", default_value_t = 16, value_parser = value_parser!(u32).range(2..))]
    batches: u32,
    /// Seed of the photons; the same seed gives the same map for any number of threads
    #[arg(long, value_name = "SEED", default_value_t = 0)]
    seed: u64,
    /// Frame of the scene's sequence; 0 is the still
    #[arg(long, value_name = "N", default_value_t = 0)]
    frame: u32,
    /// Map to write, with the layers `irradiance` and `irradiance_variance`, W/m² and its square in
    /// the units of the scene's lights
    #[arg(short, long, value_name = "FILE.exr", value_parser = exr_path)]
    out: PathBuf,
}

/// Layer of a map.
const IRRADIANCE: &str = "irradiance";
const VARIANCE: &str = "irradiance_variance";

#[derive(Serialize)]
struct Answer<'a> {
    image: &'a Path,
    receiver: &'a str,
    size_bins: [u32; 2],
    seconds: f64,
    emitted: [f64; 3],
    deposited: [f64; 3],
    absorbed: [f64; 3],
    escaped: [f64; 3],
    dropped: [f64; 3],
}

pub(in crate::cli) fn run(args: &Args, output: Output) -> Result<Status, Error> {
    let scene = args.scene.load_without_map(output)?;
    frame_is_there(&scene, args.frame)?;
    let receiver = find(&scene, &args.receiver)?;
    let request = CausticsRequest {
        receiver,
        size_bins: args.size,
        photons: args.photons,
        batches: args.batches,
        seed: args.seed,
        frame: args.frame,
    };
    let started = std::time::Instant::now();
    let map = reference::caustics(&scene, &request)?;
    files::make_folder_of(&args.out)?;
    scenes::image::write_exr(&args.out, &layers(&map))?;
    let balance = map.balance;
    let answer = Answer {
        image: &args.out,
        receiver: &scene.objects[receiver].name,
        size_bins: map.size_bins,
        seconds: started.elapsed().as_secs_f64(),
        emitted: balance.emitted.to_array(),
        deposited: balance.deposited.to_array(),
        absorbed: balance.absorbed.to_array(),
        escaped: balance.escaped.to_array(),
        dropped: balance.dropped.to_array(),
    };
    if output.json {
        output.object("snell.caustics/1", &answer)?;
    } else {
        output.line(&text(&answer))?;
    }
    Ok(Status::Done)
}

fn text(answer: &Answer<'_>) -> String {
    let Answer { image, receiver, size_bins: [columns, rows], seconds, .. } = answer;
    let mut lines =
        vec![format!("{}: {columns} x {rows} bins of {receiver}, {seconds:.2} s", image.display())];
    let power = [
        ("emitted", answer.emitted),
        ("deposited", answer.deposited),
        ("absorbed", answer.absorbed),
        ("escaped", answer.escaped),
        ("dropped", answer.dropped),
    ];
    for (name, [r, g, b]) in power {
        lines.push(format!("  {name}: {r:.6}, {g:.6}, {b:.6} W"));
    }
    lines.join("\n")
}

/// The object of that name or number.
fn find(scene: &Scene, receiver: &str) -> Result<usize, Error> {
    let named = scene.objects.iter().position(|object| object.name == receiver);
    let numbered = receiver.parse().ok().filter(|index| *index < scene.objects.len());
    named.or(numbered).ok_or_else(|| {
        let names = scene.objects.iter().enumerate();
        let names: Vec<String> = names.map(|(i, o)| format!("{i} ({})", o.name)).collect();
        Error::Usage(format!(
            "--receiver {receiver}: the scene has no such object\nwrite one of {}",
            names.join(", ")
        ))
    })
}

fn layers(map: &CausticMap) -> Layers {
    let mut layers = Layers::new(map.size_bins);
    for (name, values) in [(IRRADIANCE, &map.irradiance), (VARIANCE, &map.variance)] {
        let data = values.iter().flat_map(|value| value.to_array()).collect();
        layers.push(LayerName::Buffer(name.to_owned()), 3, data);
    }
    layers
}

/// Reads `RECEIVER=FILE.exr`: a map that `snell caustics` wrote for the scene.
pub(in crate::cli) fn read(scene: &Scene, text: &str, frame: u32) -> Result<CausticMap, Error> {
    let Some((receiver, path)) = text.rsplit_once('=') else {
        return Err(Error::Usage(format!(
            "--caustics {text}: write RECEIVER=FILE.exr, such as floor=floor.exr"
        )));
    };
    let path = Path::new(path);
    let layers = scenes::image::read(path)?;
    // A layer that was chosen by name is the radiance.
    let is_chosen = scenes::image::file_of(path) != path;
    let name =
        if is_chosen { LayerName::Radiance } else { LayerName::Buffer(IRRADIANCE.to_owned()) };
    let Some(layer) = layers.get(&name).filter(|layer| layer.channels == 3) else {
        let why = "it has no layer \"irradiance\"\nmake it with `snell caustics`".to_owned();
        return Err(Error::Image { path: path.to_owned(), why });
    };
    let irradiance = layer.data.chunks_exact(3).map(DVec3::from_slice).collect();
    let receiver = find(scene, receiver)?;
    let size_bins = layers.resolution_px;
    Ok(CausticMap::from_irradiance(scene, receiver, frame, size_bins, irradiance)?)
}
