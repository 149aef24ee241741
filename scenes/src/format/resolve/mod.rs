//! From what is written to what is meant: names are looked up, files are read,
//! and values that make no sense together are refused.

mod camera;
mod environment;
mod media;
mod object;
mod shape;

use super::document::{Document, JudgementText, LightText, SequenceText};
use super::error::At;
use crate::Scene;
use crate::environment::Sky;
use crate::scene::{Judgement, Light, Sequence, Source};
use media::Media;
use sha2::{Digest, Sha256};
use shape::Shapes;
use std::ops::Range;
use std::path::{Path, PathBuf};
use toml::Spanned;

/// Seconds between frames where the file does not say.
const SECONDS_PER_FRAME: f64 = 1.0 / 30.0;

/// Resolves a document whose paths are relative to a folder.
pub(super) fn resolve(document: &Document, text: &str, base: &Path) -> Result<Scene, At> {
    let mut warnings = Vec::new();
    let camera = camera::resolve(&document.camera)?;
    let (environment, sky) = environment::resolve(&document.environment, base, &mut warnings)?;
    let mut media = Media::new(document)?;
    let mut shapes = Shapes::new(document, base);
    let objects = object::resolve(document, &mut media, &mut shapes)?;
    warnings.append(&mut shapes.warnings);
    let media = media.finish(&mut warnings);
    object::warn_of_ties(&objects, &media, &mut warnings);
    let lights = document.light.iter().map(|light| resolve_light(light, sky.as_ref()));
    let files = environment::file(&document.environment, base).into_iter().chain(shapes.files());
    Ok(Scene {
        name: String::new(),
        title: document.title.clone().unwrap_or_default(),
        source: Source {
            path: None,
            folder: Some(base.to_owned()),
            text: text.to_owned(),
            sha256: fingerprint(text, files),
        },
        camera,
        environment,
        media,
        objects,
        lights: lights.collect::<Result<_, At>>()?,
        sequence: resolve_sequence(document.sequence.as_ref()),
        judgement: resolve_judgement(document.judgement.as_ref())?,
        warnings,
    })
}

/// Hash of the text and of every file it refers to. A file that vanished after
/// it was read adds nothing.
fn fingerprint(text: &str, files: impl Iterator<Item = PathBuf>) -> String {
    let mut hash = Sha256::new();
    hash.update(text);
    for path in files {
        let copied = std::fs::File::open(path).and_then(|mut file| {
            let mut bytes = std::io::BufWriter::new(Hasher(&mut hash));
            std::io::copy(&mut file, &mut bytes)
        });
        hash.update(copied.unwrap_or(0).to_le_bytes());
    }
    hash.finalize().iter().map(|byte| format!("{byte:02x}")).collect()
}

struct Hasher<'a>(&'a mut Sha256);

impl std::io::Write for Hasher<'_> {
    fn write(&mut self, bytes: &[u8]) -> std::io::Result<usize> {
        self.0.update(bytes);
        Ok(bytes.len())
    }

    fn flush(&mut self) -> std::io::Result<()> {
        Ok(())
    }
}

/// The one key of several that is given.
fn only_one<'a>(
    whole: &Range<usize>,
    options: &[(&'a str, Option<Range<usize>>)],
    example: &str,
) -> Result<&'a str, At> {
    let names = options.iter().map(|(name, _)| *name).collect::<Vec<_>>().join(", ");
    let instead = format!("write exactly one of {names}; for example {example}");
    let mut given = options.iter().filter_map(|(name, span)| span.clone().map(|s| (*name, s)));
    let Some((name, _)) = given.next() else {
        return Err(At::meaning(whole.clone(), format!("none of {names} is given"), instead));
    };
    match given.next() {
        Some((other, span)) => {
            Err(At::meaning(span, format!("{name} and {other} are both given"), instead))
        }
        None => Ok(name),
    }
}

/// Where an optional value stands.
fn span_of<T>(value: &Option<Spanned<T>>) -> Option<Range<usize>> {
    value.as_ref().map(Spanned::span)
}

fn resolve_light(light: &Spanned<LightText>, sky: Option<&Sky>) -> Result<Light, At> {
    let text = light.get_ref();
    let options = [
        ("point", span_of(&text.point)),
        ("directional", span_of(&text.directional)),
        ("sun", span_of(&text.sun)),
    ];
    let example = "point = { position_m = [0.0, 3.0, 0.0], intensity = [10.0, 10.0, 10.0] }";
    only_one(&light.span(), &options, example)?;
    if let Some(point) = text.point.as_ref().map(Spanned::get_ref) {
        let (position_m, intensity) = (point.position_m.0, point.intensity.0);
        return Ok(Light::Point { position_m, intensity });
    }
    if let Some(parallel) = text.directional.as_ref().map(Spanned::get_ref) {
        let (direction, irradiance) = (parallel.direction.0, parallel.irradiance.0);
        return Ok(Light::Directional { direction, irradiance });
    }
    let sun = sky.and_then(|sky| sky.sun).ok_or_else(|| {
        At::meaning(
            light.span(),
            "the light is the sky's sun, and the environment has no sky with a sun",
            "add sun = { direction = [1.0, 1.0, 0.0], radius_deg = 2.0, radiance = [300.0, 290.0, \
             270.0] } to the sky, or write directional = { direction, irradiance }",
        )
    })?;
    Ok(Light::Directional { direction: -sun.direction, irradiance: sun.irradiance() })
}

fn resolve_sequence(text: Option<&SequenceText>) -> Sequence {
    Sequence {
        frames: text.map_or(1, |sequence| sequence.frames.0),
        seconds_per_frame: text
            .and_then(|sequence| sequence.seconds_per_frame)
            .map_or(SECONDS_PER_FRAME, |seconds| seconds.0),
    }
}

fn resolve_judgement(text: Option<&JudgementText>) -> Result<Judgement, At> {
    let Some(exposures) = text.and_then(|judgement| judgement.flip_exposures.as_ref()) else {
        return Ok(Judgement::default());
    };
    let (start, stop) = (exposures.get_ref().start.0, exposures.get_ref().stop.0);
    let count = exposures.get_ref().count.0;
    let in_range = start.abs() <= 64.0 && stop.abs() <= 64.0;
    if !in_range || start > stop || (count == 1) != (start == stop) {
        return Err(At::meaning(
            exposures.span(),
            format!("{count} exposures from {start} to {stop} stops are no sequence"),
            "write stops from -64 to 64 that rise, such as { start = -4.0, stop = 2.0, count = 4 }",
        ));
    }
    Ok(Judgement { flip_exposures: Some((start, stop, count)) })
}
