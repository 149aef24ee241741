//! The images that a request comes to.

use super::layer_images::LayerImage;
use crate::error::Error;
use crate::methods::{LAYERS, Method};
use crate::request::Request;
use scenes::{Camera, LayerName, Scene, Surface};

/// Names of the intermediate buffers that were asked for.
pub(crate) fn buffers(request: &Request) -> Vec<&str> {
    let names = request.view.layers.iter().filter_map(|layer| match layer {
        LayerName::Buffer(name) => Some(name.as_str()),
        _ => None,
    });
    names.collect()
}

/// Most pixels along a side that any adapter is asked for.
const LARGEST_PX: u32 = 32_768;
/// Most positions along a pixel's side.
const MOST_POSITIONS: u32 = 64;

/// Refuses sizes that have no content, or that no adapter holds.
fn check_size(request: &Request) -> Result<(), Error> {
    let timed = request.timing.map(|timing| timing.positions_per_axis);
    for k in [Some(request.view.positions_per_axis), timed].into_iter().flatten() {
        check_positions(request, k)?;
    }
    Ok(())
}

fn check_positions(request: &Request, k: u32) -> Result<(), Error> {
    let [width, height] = request.view.resolution_px;
    let what = format!("an image of {width} x {height} pixels with {k} x {k} positions");
    if width == 0 || height == 0 || k == 0 {
        return Err(Error::Size(format!("{what} is empty; write at least 1 for each")));
    }
    if width.max(height) > LARGEST_PX {
        let advice = "lower the resolution";
        return Err(Error::Size(format!(
            "{what} has more than {LARGEST_PX} pixels along a side; {advice}"
        )));
    }
    if k > MOST_POSITIONS {
        return Err(Error::Size(format!(
            "{what} is drawn at more than {MOST_POSITIONS} x {MOST_POSITIONS}; lower their number"
        )));
    }
    Ok(())
}

/// Intermediate buffers that can be asked for as layers.
pub(crate) const BUFFERS: [&str; 7] = [
    "front_normal",
    "front_depth",
    "front_geometric",
    "back_normal",
    "back_depth",
    "thickness",
    "crack_mask",
];

/// The scene's camera at the resolution that was asked for.
pub(crate) fn camera(scene: &Scene, request: &Request) -> Camera {
    Camera { resolution_px: request.view.resolution_px, ..scene.camera }
}

/// Images that the shading pass must write.
///
/// # Errors
/// If there is no such image, or a path is asked for in what is not the medium of
/// every body: methods count metres inside bodies, whichever they are.
pub(crate) fn outputs(
    method: &Method,
    scene: &Scene,
    request: &Request,
) -> Result<Vec<&'static str>, Error> {
    check_size(request)?;
    let mut outputs = Vec::new();
    for layer in &request.view.layers {
        let row = SINGLE.iter().find(|row| (row.is)(layer));
        let output = match (layer, row) {
            (LayerName::Radiance | LayerName::Coverage, _) => "radiance",
            (LayerName::Path(medium), _) if !is_the_medium(scene, medium) => {
                return Err(unknown(method, layer));
            }
            (_, Some(row)) => row.output,
            (LayerName::Buffer(name), _)
                if BUFFERS.contains(&name.as_str()) || LayerImage::named(name).is_some() =>
            {
                continue;
            }
            (other, _) => return Err(unknown(method, other)),
        };
        if !outputs.contains(&output) {
            outputs.push(output);
        }
    }
    Ok(outputs)
}

/// All bodies are of that medium.
fn is_the_medium(scene: &Scene, name: &str) -> bool {
    let bodies =
        scene.objects.iter().filter(|object| matches!(object.surface, Surface::Dielectric { .. }));
    bodies.into_iter().all(|body| scene.medium_of(body).is_some_and(|medium| medium.name == name))
}

fn unknown(method: &Method, layer: &LayerName) -> Error {
    Error::UnknownLayer {
        method: method.id.to_owned(),
        layer: layer.to_string(),
        available: LAYERS
            .map(|(name, _)| name)
            .join(", ")
            .replace("path.<medium>", "path.<medium> (where all bodies are of it)"),
    }
}

/// A layer that shading writes at pixel centres.
pub(crate) struct Single {
    pub(crate) is: fn(&LayerName) -> bool,
    /// The image that holds it.
    pub(crate) output: &'static str,
    /// A single channel of it; else three make a vector, zero where the fourth is.
    pub(crate) channel: Option<usize>,
    /// Local space; else a direction in world axes.
    pub(crate) is_position: bool,
}

const fn vector(is: fn(&LayerName) -> bool, output: &'static str, is_position: bool) -> Single {
    Single { is, output, channel: None, is_position }
}

const fn count(is: fn(&LayerName) -> bool, channel: usize) -> Single {
    Single { is, output: "count", channel: Some(channel), is_position: false }
}

/// One row per layer.
pub(crate) const SINGLE: [Single; 6] = [
    vector(|layer| matches!(layer, LayerName::Exit), "exit", false),
    vector(|layer| matches!(layer, LayerName::First), "first", false),
    vector(|layer| matches!(layer, LayerName::Hit2), "hit2", true),
    count(|layer| matches!(layer, LayerName::Events), 0),
    count(|layer| matches!(layer, LayerName::Flags), 1),
    count(|layer| matches!(layer, LayerName::Path(_)), 2),
];
