//! Named image layers: what a rendering carries beside its colour.

use std::fmt;

/// Names of layers, fixed once for the CLI, TOML, JSON, EXR and data frames.
#[derive(Clone, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub enum LayerName {
    /// Linear radiance `R,G,B`.
    Radiance,
    /// `coverage.Y`: share of the pixel's positions whose ray meets an object.
    Coverage,
    /// `exit.{X,Y,Z}`: unit direction in which the chain leaves, pixel centre;
    /// zero where no object is met or the chain does not leave.
    Exit,
    /// `exit_position.{X,Y,Z}`: where the chain leaves, metres.
    ExitPosition,
    /// `first.{X,Y,Z}`: unit direction after the first event, pixel centre.
    First,
    /// `hit2.{X,Y,Z}`: where the chain meets its second interface, metres.
    Hit2,
    /// `events.Y`: interfaces met by the chain, pixel centre.
    Events,
    /// `total_reflections.Y`: how many of the events were total reflections.
    TotalReflections,
    /// `flags.Y`: bits of [`flag`], as a whole number.
    Flags,
    /// `truncated.Y`: weight of paths that were cut off, mean over the pixel.
    Truncated,
    /// `variance.{R,G,B}`: variance of the radiance's mean.
    Variance,
    /// `samples.Y`: camera rays traced.
    Samples,
    /// `path.<medium>.Y`: metres travelled in a medium by the chain.
    Path(String),
    /// `bounce<k>.{R,G,B}`: radiance that arrived after k interfaces.
    Bounce(u16),
    /// An intermediate buffer of a method, by its own name and channels.
    Buffer(String),
}

/// Bits of the `flags` layer; `snell methods` prints them with their meanings.
pub mod flag {
    /// Total reflection was clamped to the tangent.
    pub const TIR_CLAMPED: u32 = 1 << 0;
    /// The second surface was missed and a fallback normal used.
    pub const FALLBACK: u32 = 1 << 1;
    /// A cap on events or steps was reached.
    pub const CAP: u32 = 1 << 2;
    /// The ray was still inside when its search ended.
    pub const LOST: u32 = 1 << 3;
    /// More layers than the buffer holds.
    pub const OVERFLOW: u32 = 1 << 4;
    /// Non-finite input was replaced.
    pub const NON_FINITE: u32 = 1 << 5;
    /// A shading normal was replaced by the geometric one.
    pub const GEOMETRIC_NORMAL: u32 = 1 << 6;
    /// The method does not support what this pixel shows.
    pub const UNSUPPORTED: u32 = 1 << 7;
    /// Name, bit and meaning of every flag.
    pub const ALL: [(&str, u32, &str); 8] = [
        ("tir_clamped", TIR_CLAMPED, "total reflection was clamped to the tangent"),
        ("fallback", FALLBACK, "the second surface was missed and a fallback normal used"),
        ("cap", CAP, "a cap on events or steps was reached"),
        ("lost", LOST, "the ray was still inside when its search ended"),
        ("overflow", OVERFLOW, "there are more layers than are kept"),
        ("non_finite", NON_FINITE, "what was not finite was replaced"),
        (
            "geometric_normal",
            GEOMETRIC_NORMAL,
            "a shading normal was replaced by the geometric one",
        ),
        ("unsupported", UNSUPPORTED, "the method does not support what this pixel shows"),
    ];
}

impl fmt::Display for LayerName {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Radiance => f.write_str("radiance"),
            Self::Coverage => f.write_str("coverage"),
            Self::Exit => f.write_str("exit"),
            Self::ExitPosition => f.write_str("exit_position"),
            Self::First => f.write_str("first"),
            Self::Hit2 => f.write_str("hit2"),
            Self::Events => f.write_str("events"),
            Self::TotalReflections => f.write_str("total_reflections"),
            Self::Flags => f.write_str("flags"),
            Self::Truncated => f.write_str("truncated"),
            Self::Variance => f.write_str("variance"),
            Self::Samples => f.write_str("samples"),
            Self::Path(medium) => write!(f, "path.{medium}"),
            Self::Bounce(order) => write!(f, "bounce{order}"),
            Self::Buffer(name) => f.write_str(name),
        }
    }
}

impl From<&str> for LayerName {
    /// Unknown names are taken as a method's own buffer; whether it exists is
    /// checked by the renderer that is asked for it.
    fn from(name: &str) -> Self {
        match name {
            "radiance" => Self::Radiance,
            "coverage" => Self::Coverage,
            "exit" => Self::Exit,
            "exit_position" => Self::ExitPosition,
            "first" => Self::First,
            "hit2" => Self::Hit2,
            "events" => Self::Events,
            "total_reflections" => Self::TotalReflections,
            "flags" => Self::Flags,
            "truncated" => Self::Truncated,
            "variance" => Self::Variance,
            "samples" => Self::Samples,
            other => match (other.strip_prefix("path."), bounce_order(other)) {
                (Some(medium), _) => Self::Path(medium.to_owned()),
                (None, Some(order)) => Self::Bounce(order),
                _ => Self::Buffer(other.to_owned()),
            },
        }
    }
}

/// The order in `bounce2`, or in `bounce.2` as it would stand beside `path.<medium>`.
fn bounce_order(name: &str) -> Option<u16> {
    let order = name.strip_prefix("bounce")?;
    order.strip_prefix('.').unwrap_or(order).parse().ok()
}

/// One layer: `channels` values per pixel, rows from the top, interleaved.
#[derive(Clone, Debug, PartialEq)]
pub struct Layer {
    /// Which layer.
    pub name: LayerName,
    /// Values per pixel: 1 (`Y`) or 3 (`R,G,B` or `X,Y,Z`).
    pub channels: usize,
    /// width · height · channels values.
    pub data: Vec<f64>,
}

/// The layers of one image.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Layers {
    /// Width and height, pixels.
    pub resolution_px: [u32; 2],
    /// In the order they were added; names are unique.
    pub list: Vec<Layer>,
}

impl Layers {
    /// An image of this size without layers.
    #[must_use]
    pub fn new(resolution_px: [u32; 2]) -> Self {
        Self { resolution_px, list: Vec::new() }
    }

    /// Number of pixels.
    #[must_use]
    pub fn pixels(&self) -> usize {
        self.resolution_px[0] as usize * self.resolution_px[1] as usize
    }

    /// Adds a layer.
    ///
    /// # Panics
    /// If the data does not fill the image or the name is taken: our mistake,
    /// never the user's.
    pub fn push(&mut self, name: LayerName, channels: usize, data: Vec<f64>) {
        assert_eq!(data.len(), self.pixels() * channels, "layer {name} does not fill the image");
        assert!(self.get(&name).is_none(), "layer {name} exists already");
        self.list.push(Layer { name, channels, data });
    }

    /// The layer of that name, if the image has it.
    #[must_use]
    pub fn get(&self, name: &LayerName) -> Option<&Layer> {
        self.list.iter().find(|layer| layer.name == *name)
    }
}
