//! Images of others as jobs of a study.

use super::{External, Grid, Place, Task};
use crate::Error;
use crate::results::REFERENCE;
use crate::study::Spec;
use crate::study::cache::hex;
use crate::support::files::FileError;
use realtime::Method;
use scenes::image::Alpha;
use sha2::{Digest, Sha256};

/// Images of others belong to the place of their scene that is as large as they.
pub(super) fn add_externals(spec: &Spec, grid: &mut Grid) -> Result<(), Error> {
    for (index, external) in spec.externals.iter().enumerate() {
        let refuse = |what: String| Error::Usage(format!("{}: {what}", external.name));
        check_name(external, spec, index).map_err(refuse)?;
        let bytes = std::fs::read(&external.image)
            .map_err(FileError::of(&external.image, "cannot be read"))?;
        let size = scenes::image::open(&external.image, Alpha::OverBlack)?.layers.resolution_px;
        let of_scene = |place: &&mut Place| {
            let name = &spec.scenes[place.scene].name;
            external.scene.as_ref().is_none_or(|wanted| wanted == name)
        };
        if external.scene.is_none() && spec.scenes.len() > 1 {
            return Err(refuse("the study has several scenes; say which one it shows".to_owned()));
        }
        let mut of_scene: Vec<&mut Place> = grid.places.iter_mut().filter(of_scene).collect();
        let sizes: Vec<String> = of_scene
            .iter()
            .map(|place| place.resolution_px.map(|n| n.to_string()).join("x"))
            .collect();
        let [width, height] = size;
        let fits = |place: &&mut &mut Place| place.resolution_px == size && place.set.is_empty();
        let place = of_scene.iter_mut().find(fits).ok_or_else(|| {
            refuse(format!(
                "the image is {width}x{height}, and the study has that scene at {}; add \
                 --resolution {width}x{height}",
                if sizes.is_empty() { "no size".to_owned() } else { sizes.join(", ") }
            ))
        })?;
        let hash = hex(&Sha256::digest(&bytes));
        let job = super::job::job(spec, place, Task::External(index), Some(&hash));
        place.jobs.push(job);
    }
    Ok(())
}

fn check_name(external: &External, spec: &Spec, index: usize) -> Result<(), String> {
    let name = &external.name;
    let plain = |c: char| c.is_ascii_alphanumeric() || "-_.".contains(c);
    if name.is_empty() || !name.chars().all(plain) {
        return Err("a name is letters, digits, `-`, `_` and `.`".to_owned());
    }
    let taken = name == REFERENCE || Method::find(name).is_ok();
    let twice =
        spec.externals[..index].iter().any(|e| e.name == *name && e.scene == external.scene);
    if taken || twice {
        return Err("the name is taken; choose another".to_owned());
    }
    match external.milliseconds {
        Some(ms) if !(ms.is_finite() && ms > 0.0) => Err(format!("{ms} ms is no time of a frame")),
        _ => Ok(()),
    }
}
