//! A scene file as it is written: tables and keys, each value checked alone.
//! What values mean together is decided by `resolve`.

use super::choice::{NameOr, PaintText};
use super::number::{
    AirPlanes, Albedo, Angle, Angles, Bubbles, CrackGrid, Cracks, CubeSize, Direction,
    ExposureCount, FieldOfView, Frames, Length, Lengths, Light, NonNegative, Number, Position,
    Resolution, Scale, Seconds, Share, Triple,
};
use super::sky::SkyText;
use crate::Eta;
use serde::Deserialize;
use std::collections::BTreeMap;
use toml::Spanned;

/// The whole file.
#[derive(Debug, Deserialize)]
#[serde(deny_unknown_fields)]
pub(super) struct Document {
    pub(super) title: Option<String>,
    pub(super) camera: Spanned<CameraText>,
    pub(super) environment: Spanned<EnvironmentText>,
    pub(super) surroundings: Option<SurroundingsText>,
    #[serde(default)]
    pub(super) medium: BTreeMap<String, Spanned<MediumText>>,
    #[serde(default)]
    pub(super) shape: BTreeMap<String, Spanned<ShapeText>>,
    #[serde(default)]
    pub(super) object: Vec<Spanned<ObjectText>>,
    #[serde(default)]
    pub(super) light: Vec<Spanned<LightText>>,
    pub(super) sequence: Option<SequenceText>,
    pub(super) judgement: Option<JudgementText>,
}

#[derive(Debug, Deserialize)]
#[serde(deny_unknown_fields)]
pub(super) struct CameraText {
    pub(super) eye: Position,
    pub(super) target: Spanned<Position>,
    pub(super) up: Option<Spanned<Direction>>,
    pub(super) orbit_deg: Option<Angle>,
    pub(super) vertical_fov_deg: Option<Spanned<FieldOfView>>,
    pub(super) orthographic_height_m: Option<Spanned<Length>>,
    pub(super) resolution_px: Resolution,
}

#[derive(Debug, Deserialize)]
#[serde(deny_unknown_fields)]
pub(super) struct EnvironmentText {
    pub(super) radiance: Option<Spanned<Light>>,
    pub(super) map: Option<Spanned<String>>,
    pub(super) sky: Option<Spanned<SkyText>>,
    pub(super) rotation_deg: Option<Angle>,
    pub(super) cube_size_px: Option<CubeSize>,
    #[serde(default)]
    pub(super) keep_negative: bool,
}

#[derive(Debug, Deserialize)]
#[serde(deny_unknown_fields)]
pub(super) struct SurroundingsText {
    pub(super) medium: Spanned<NameOr<MediumText>>,
}

#[derive(Clone, Debug, Deserialize)]
#[serde(deny_unknown_fields)]
pub(super) struct MediumText {
    pub(super) eta: Option<Spanned<Eta>>,
    pub(super) material: Option<Spanned<String>>,
    pub(super) cauchy: Option<Spanned<CauchyText>>,
    pub(super) sellmeier: Option<Spanned<SellmeierText>>,
    pub(super) dispersion: Option<Spanned<NonNegative>>,
    pub(super) absorption_per_m: Option<AbsorptionText>,
}

/// Absorption per metre for R, G, B.
#[derive(Clone, Copy, Debug, Deserialize)]
#[serde(try_from = "Triple")]
pub(super) struct AbsorptionText(pub(super) glam::DVec3);

impl TryFrom<Triple> for AbsorptionText {
    type Error = String;

    fn try_from(Triple(value): Triple) -> Result<Self, String> {
        let accepted = value.min_element() >= 0.0 && value.max_element() <= 1e12;
        accepted.then_some(Self(value)).ok_or_else(|| {
            format!("{value} is not an absorption from 0 to 1e12 per metre; write such as [2.0, 0.5, 0.1]")
        })
    }
}

#[derive(Clone, Debug, Deserialize)]
#[serde(deny_unknown_fields)]
pub(super) struct CauchyText {
    pub(super) a: Number,
    pub(super) b_um2: Number,
}

#[derive(Clone, Debug, Deserialize)]
#[serde(deny_unknown_fields)]
pub(super) struct SellmeierText {
    pub(super) b: Triple,
    pub(super) c_um2: Triple,
}

#[derive(Clone, Debug, Deserialize)]
#[serde(deny_unknown_fields)]
pub(super) struct ShapeText {
    pub(super) obj: Option<Spanned<String>>,
    pub(super) builtin: Option<Spanned<String>>,
    pub(super) sphere: Option<Spanned<SphereText>>,
    pub(super) slab: Option<Spanned<SlabText>>,
    #[serde(rename = "box")]
    pub(super) cuboid: Option<Spanned<BoxText>>,
    pub(super) cylinder: Option<Spanned<CylinderText>>,
    pub(super) half_space: Option<Spanned<NothingText>>,
    pub(super) plane: Option<Spanned<NothingText>>,
}

#[derive(Clone, Copy, Debug, Deserialize)]
#[serde(deny_unknown_fields)]
pub(super) struct SphereText {
    pub(super) radius_m: Length,
}

#[derive(Clone, Copy, Debug, Deserialize)]
#[serde(deny_unknown_fields)]
pub(super) struct SlabText {
    pub(super) thickness_m: Length,
}

#[derive(Clone, Copy, Debug, Deserialize)]
#[serde(deny_unknown_fields)]
pub(super) struct BoxText {
    pub(super) half_extent_m: Lengths,
}

#[derive(Clone, Copy, Debug, Deserialize)]
#[serde(deny_unknown_fields)]
pub(super) struct CylinderText {
    pub(super) radius_m: Length,
    pub(super) half_height_m: Length,
}

/// An empty table.
#[derive(Clone, Copy, Debug, Deserialize)]
#[serde(deny_unknown_fields)]
pub(super) struct NothingText {}

#[derive(Debug, Deserialize)]
#[serde(deny_unknown_fields)]
pub(super) struct ObjectText {
    pub(super) name: Option<String>,
    pub(super) shape: Spanned<NameOr<ShapeText>>,
    pub(super) surface: Spanned<SurfaceText>,
    pub(super) medium: Option<Spanned<NameOr<MediumText>>>,
    pub(super) priority: Option<Spanned<i32>>,
    pub(super) radiance: Option<Spanned<PaintText<Light>>>,
    pub(super) albedo: Option<Spanned<PaintText<Albedo>>>,
    #[serde(default)]
    pub(super) normals: NormalsText,
    pub(super) scale: Option<Scale>,
    pub(super) rotation_deg: Option<Angles>,
    pub(super) translation_m: Option<Position>,
    pub(super) motion: Option<Spanned<MotionText>>,
    pub(super) deform: Option<Spanned<WaveText>>,
    pub(super) bump: Option<Spanned<BumpText>>,
    pub(super) crack: Option<Spanned<CrackText>>,
    pub(super) air: Option<Spanned<AirText>>,
}

#[derive(Clone, Copy, Debug, PartialEq, Eq, Deserialize)]
#[serde(rename_all = "lowercase")]
pub(super) enum SurfaceText {
    Dielectric,
    Unlit,
    Lambert,
}

#[derive(Clone, Copy, Debug, Default, Deserialize)]
#[serde(rename_all = "lowercase")]
pub(super) enum NormalsText {
    #[default]
    Smooth,
    Flat,
}

#[derive(Debug, Deserialize)]
#[serde(deny_unknown_fields)]
pub(super) struct MotionText {
    pub(super) spin: Option<Spanned<SpinText>>,
    pub(super) path: Option<Spanned<PathText>>,
}

#[derive(Debug, Deserialize)]
#[serde(deny_unknown_fields)]
pub(super) struct SpinText {
    pub(super) axis: Direction,
    pub(super) deg_per_s: Angle,
}

#[derive(Debug, Deserialize)]
#[serde(deny_unknown_fields)]
pub(super) struct PathText {
    pub(super) points_m: Spanned<Vec<Position>>,
    pub(super) seconds_per_point: Seconds,
}

#[derive(Debug, Deserialize)]
#[serde(deny_unknown_fields)]
pub(super) struct WaveText {
    pub(super) amplitude_m: NonNegative,
    pub(super) wavelength_m: Length,
    pub(super) travel: Direction,
    pub(super) direction: Direction,
    pub(super) period_s: Seconds,
}

#[derive(Debug, Deserialize)]
#[serde(deny_unknown_fields)]
pub(super) struct BumpText {
    pub(super) amplitude: Share,
    pub(super) frequency_per_m: Length,
    #[serde(default)]
    pub(super) seed: u32,
}

#[derive(Debug, Deserialize)]
#[serde(deny_unknown_fields)]
pub(super) struct CrackText {
    pub(super) count: Option<Cracks>,
    pub(super) grid: Option<CrackGrid>,
    #[serde(default)]
    pub(super) seed: u32,
}

#[derive(Debug, Deserialize)]
#[serde(deny_unknown_fields)]
pub(super) struct AirText {
    pub(super) planes: Option<AirPlanes>,
    pub(super) bubbles: Option<Bubbles>,
    pub(super) bubble_radius: Option<Share>,
    #[serde(default)]
    pub(super) seed: u32,
}

#[derive(Debug, Deserialize)]
#[serde(deny_unknown_fields)]
pub(super) struct LightText {
    pub(super) point: Option<Spanned<PointText>>,
    pub(super) directional: Option<Spanned<DirectionalText>>,
    pub(super) sun: Option<Spanned<NothingText>>,
}

#[derive(Debug, Deserialize)]
#[serde(deny_unknown_fields)]
pub(super) struct PointText {
    pub(super) position_m: Position,
    pub(super) intensity: Light,
}

#[derive(Debug, Deserialize)]
#[serde(deny_unknown_fields)]
pub(super) struct DirectionalText {
    pub(super) direction: Direction,
    pub(super) irradiance: Light,
}

#[derive(Debug, Deserialize)]
#[serde(deny_unknown_fields)]
pub(super) struct SequenceText {
    pub(super) frames: Frames,
    pub(super) seconds_per_frame: Option<Seconds>,
}

#[derive(Debug, Deserialize)]
#[serde(deny_unknown_fields)]
pub(super) struct JudgementText {
    pub(super) flip_exposures: Option<Spanned<ExposuresText>>,
}

/// Exposures of the perceptual metric, in stops.
#[derive(Clone, Copy, Debug, Deserialize)]
#[serde(deny_unknown_fields)]
pub(super) struct ExposuresText {
    pub(super) start: Number,
    pub(super) stop: Number,
    pub(super) count: ExposureCount,
}
