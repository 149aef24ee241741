//! The images that a request comes to.

use crate::Error;
use crate::methods::Method;
use crate::passes::peel::LayerPart;
use crate::request::Request;
use scenes::{Camera, LayerName, Scene};

/// Names of the intermediate buffers that were asked for.
pub(crate) fn buffers(request: &Request) -> Vec<&str> {
    let names = request.view.layers.iter().filter_map(|layer| match layer {
        LayerName::Buffer(name) => Some(name.as_str()),
        _ => None,
    });
    names.collect()
}

/// Most texels along a side that any adapter is asked for.
const LARGEST_PX: u64 = 32_768;

/// Refuses sizes that have no content, or that no adapter holds.
fn check_size(request: &Request) -> Result<(), Error> {
    let [width, height] = request.view.resolution_px;
    let k = request.view.positions_per_axis;
    let what = format!("an image of {width} x {height} pixels with {k} x {k} positions");
    let needed = u64::from(width.max(height)) * u64::from(k);
    if width == 0 || height == 0 || k == 0 {
        return Err(Error::Size(format!("{what} is empty; write at least 1 for each")));
    }
    if needed > LARGEST_PX {
        let advice = "lower the resolution or the number of positions";
        return Err(Error::Size(format!(
            "{what} is {needed} texels along a side, more than {LARGEST_PX}; {advice}"
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
pub(crate) fn outputs(method: &Method, request: &Request) -> Result<Vec<&'static str>, Error> {
    check_size(request)?;
    let mut outputs = Vec::new();
    for layer in &request.view.layers {
        let output = match layer {
            LayerName::Radiance | LayerName::Coverage => "radiance",
            LayerName::Exit => "exit",
            LayerName::First => "first",
            LayerName::Hit2 => "hit2",
            LayerName::Events | LayerName::Flags | LayerName::Path(_) => "count",
            LayerName::Buffer(name)
                if BUFFERS.contains(&name.as_str()) || LayerPart::named(name).is_some() =>
            {
                continue;
            }
            other => {
                return Err(Error::UnknownLayer {
                    method: method.id.to_owned(),
                    layer: other.to_string(),
                    available: format!(
                        "radiance, coverage, exit, first, hit2, events, flags, path.<medium>, {}, \
                         layer_count, layer_depth.<n>, layer_normal.<n>, layer_facing.<n>",
                        BUFFERS.join(", ")
                    ),
                });
            }
        };
        if !outputs.contains(&output) {
            outputs.push(output);
        }
    }
    Ok(outputs)
}
