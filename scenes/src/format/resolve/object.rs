//! `[[object]]`: a shape, what it is made of, where it is and what it does.

use super::super::document::{AirText, Document, MotionText, NormalsText, ObjectText, SurfaceText};
use super::super::error::At;
use super::media::Media;
use super::shape::{Found, Shapes};
use super::{only_one, span_of};
use crate::scene::{Air, Bump, Crack, Motion, Normals, Wave};
use crate::{Medium, Object, Shape, Surface, box_corners};
use glam::{DAffine3, DMat3, DVec3, EulerRot};
use std::ops::Range;
use toml::Spanned;

/// Bubbles of the exact stand-in, as a share of the body's diagonal.
const BUBBLE_RADIUS: f64 = 0.01;

/// All objects, in the order of the file.
pub(super) fn resolve(
    document: &Document,
    media: &mut Media,
    shapes: &mut Shapes<'_>,
) -> Result<Vec<Object>, At> {
    let objects = document.object.iter().enumerate();
    objects.map(|(index, text)| object(index, text, media, shapes)).collect()
}

fn object(
    index: usize,
    text: &Spanned<ObjectText>,
    media: &mut Media,
    shapes: &mut Shapes<'_>,
) -> Result<Object, At> {
    let whole = text.span();
    let text = text.get_ref();
    let found = shapes.find(&text.shape)?;
    let surface = surface(&whole, text, &found, media)?;
    refuse_impossible(text, &found)?;
    Ok(Object {
        name: text.name.clone().unwrap_or_else(|| format!("{} {}", found.name, index + 1)),
        surface,
        world_from_object: world_from_object(text),
        normals: match text.normals {
            NormalsText::Smooth => Normals::Smooth,
            NormalsText::Flat => Normals::Flat,
        },
        motion: text.motion.as_ref().map(motion).transpose()?,
        deform: text.deform.as_ref().map(Spanned::get_ref).map(|wave| Wave {
            amplitude_m: wave.amplitude_m.0,
            wavelength_m: wave.wavelength_m.0,
            travel: wave.travel.0,
            direction: wave.direction.0,
            period_s: wave.period_s.0,
        }),
        bump: text.bump.as_ref().map(Spanned::get_ref).map(|bump| Bump {
            amplitude: bump.amplitude.0,
            frequency_per_m: bump.frequency_per_m.0,
            seed: u64::from(bump.seed),
        }),
        crack: text.crack.as_ref().map(Spanned::get_ref).map(|crack| Crack {
            count: crack.count.map_or(2, |count| count.0),
            grid: crack.grid.map_or(24, |grid| grid.0),
            seed: u64::from(crack.seed),
        }),
        air: text.air.as_ref().map(|air| enclosed_air(air.get_ref())),
        shape: found.shape,
    })
}

fn enclosed_air(text: &AirText) -> Air {
    Air {
        planes: text.planes.map_or(19, |planes| planes.0),
        bubbles: text.bubbles.map_or(0, |bubbles| bubbles.0),
        bubble_radius: text.bubble_radius.map_or(BUBBLE_RADIUS, |radius| radius.0),
        seed: u64::from(text.seed),
    }
}

/// Scale, then turns about x, y and z in this order, then translation.
fn world_from_object(text: &ObjectText) -> DAffine3 {
    let scale = text.scale.map_or(DVec3::ONE, |scale| scale.0);
    let angles = text.rotation_deg.map_or(DVec3::ZERO, |angles| angles.0);
    let [x, y, z] = angles.to_array().map(f64::to_radians);
    let rotation = match angles == DVec3::ZERO {
        true => DMat3::IDENTITY,
        false => DMat3::from_euler(EulerRot::ZYX, z, y, x),
    };
    let translation = text.translation_m.map_or(DVec3::ZERO, |offset| offset.0);
    DAffine3::from_mat3_translation(rotation * DMat3::from_diagonal(scale), translation)
}

fn surface(
    whole: &Range<usize>,
    text: &ObjectText,
    found: &Found,
    media: &mut Media,
) -> Result<Surface, At> {
    let kind = *text.surface.get_ref();
    let dielectric = kind == SurfaceText::Dielectric;
    for (key, span, fits) in [
        ("medium", span_of(&text.medium), dielectric),
        ("priority", span_of(&text.priority), dielectric),
        ("radiance", span_of(&text.radiance), kind == SurfaceText::Unlit),
        ("albedo", span_of(&text.albedo), kind == SurfaceText::Lambert),
        ("bump", span_of(&text.bump), dielectric),
        ("crack", span_of(&text.crack), dielectric),
        ("air", span_of(&text.air), dielectric),
    ] {
        if let Some(span) = span.filter(|_| !fits) {
            return Err(At::meaning(
                span,
                format!("{key} means nothing for this surface"),
                "dielectric has medium, priority, bump, crack and air; unlit has radiance; \
                 lambert has albedo",
            ));
        }
    }
    if dielectric && found.is_plane {
        return Err(At::meaning(
            text.shape.span(),
            "a plane has no inside to fill with a medium",
            "write half_space = {} for a medium below y = 0, or slab = { thickness_m = 0.01 }",
        ));
    }
    let missing = |key: &str, example: &str| {
        At::meaning(whole.clone(), format!("{key} is missing"), format!("add {key} = {example}"))
    };
    match kind {
        SurfaceText::Dielectric => {
            let medium = text.medium.as_ref().ok_or_else(|| missing("medium", "{ eta = 1.5 }"))?;
            let priority = text.priority.as_ref().map_or(0, |priority| *priority.get_ref());
            Ok(Surface::Dielectric { medium: media.id_of(medium)?, priority })
        }
        SurfaceText::Unlit => {
            let paint =
                text.radiance.as_ref().ok_or_else(|| missing("radiance", "[1.0, 1.0, 1.0]"))?;
            Ok(Surface::Unlit { radiance: paint.get_ref().paint() })
        }
        SurfaceText::Lambert => {
            let paint = text.albedo.as_ref().ok_or_else(|| missing("albedo", "[0.8, 0.8, 0.8]"))?;
            Ok(Surface::Lambert { albedo: paint.get_ref().paint() })
        }
    }
}

fn refuse_impossible(text: &ObjectText, found: &Found) -> Result<(), At> {
    if let Some(span) = span_of(&text.deform).filter(|_| found.shape.mesh().is_none()) {
        return Err(At::meaning(
            span,
            "only meshes can be deformed: this shape has no vertices",
            "write shape = { builtin = \"sphere-960\" } or a file, or take out deform",
        ));
    }
    let unbounded = matches!(*found.shape, Shape::Slab { .. } | Shape::HalfSpace);
    let inside = [("crack", span_of(&text.crack)), ("air", span_of(&text.air))];
    match inside.into_iter().find_map(|(key, span)| span.filter(|_| unbounded).map(|s| (key, s))) {
        Some((key, span)) => Err(At::meaning(
            span,
            format!("{key} is placed within a body's bounds, and this shape has none"),
            "write a bounded shape such as box = { half_extent_m = [1.0, 1.0, 0.1] }",
        )),
        None => Ok(()),
    }
}

fn motion(text: &Spanned<MotionText>) -> Result<Motion, At> {
    let motion = text.get_ref();
    let options = [("spin", span_of(&motion.spin)), ("path", span_of(&motion.path))];
    only_one(&text.span(), &options, "spin = { axis = [0.0, 1.0, 0.0], deg_per_s = 30.0 }")?;
    match (&motion.spin, &motion.path) {
        (Some(spin), _) => {
            let spin = spin.get_ref();
            Ok(Motion::Spin { axis: spin.axis.0, deg_per_s: spin.deg_per_s.0 })
        }
        (None, Some(path)) => {
            let points = &path.get_ref().points_m;
            if points.get_ref().len() < 2 {
                return Err(At::meaning(
                    points.span(),
                    "a path needs at least two points",
                    "write such as points_m = [[0.0, 0.0, 0.0], [1.0, 0.0, 0.0]]",
                ));
            }
            Ok(Motion::Path {
                points_m: points.get_ref().iter().map(|point| point.0).collect(),
                seconds_per_point: path.get_ref().seconds_per_point.0,
            })
        }
        (None, None) => unreachable!("only_one found a motion"),
    }
}

/// Solids of different media whose boxes meet at the same priority: which one
/// wins is the format's choice, not the author's.
pub(super) fn warn_of_ties(objects: &[Object], media: &[Medium], warnings: &mut Vec<String>) {
    let solids: Vec<_> = objects
        .iter()
        .filter_map(|object| match object.surface {
            Surface::Dielectric { medium, priority } => {
                Some((object, medium, priority, world_bounds(object)))
            }
            _ => None,
        })
        .collect();
    for (i, (first, medium_1, priority_1, [low_1, high_1])) in solids.iter().enumerate().take(256) {
        for (second, medium_2, priority_2, [low_2, high_2]) in &solids[i + 1..] {
            let apart = low_1.cmpgt(*high_2).any() || low_2.cmpgt(*high_1).any();
            if medium_1 == medium_2 || priority_1 != priority_2 || apart {
                continue;
            }
            let winner = &media[usize::from((*medium_1).min(*medium_2).0)].name;
            warnings.push(format!(
                "\"{}\" and \"{}\" may overlap at the same priority {priority_1}: \"{winner}\" \
                 wins there; write priority to decide",
                first.name, second.name
            ));
        }
    }
}

/// Corners of the object's box in world space; infinite if the shape is.
fn world_bounds(object: &Object) -> [DVec3; 2] {
    let bounds @ [low, high] = object.shape.bounds();
    if !(low.is_finite() && high.is_finite()) {
        return [DVec3::NEG_INFINITY, DVec3::INFINITY];
    }
    box_corners(bounds)
        .map(|corner| object.world_from_object.transform_point3(corner))
        .into_iter()
        .fold([DVec3::INFINITY, DVec3::NEG_INFINITY], |[low, high], p| [low.min(p), high.max(p)])
}
