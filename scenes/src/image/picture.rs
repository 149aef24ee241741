//! An image file as it was understood: layers, what their values mean, and what
//! the file says that was not obeyed.

use crate::Layers;

/// What the values of the radiance layer mean.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Encoding {
    /// Linear radiance, Rec. 709 primaries.
    #[default]
    Linear,
    /// sRGB code values, 0..1: what a PNG holds.
    Display,
}

/// What becomes of pixels that are partly transparent.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Alpha {
    /// They lie over black.
    #[default]
    OverBlack,
    /// They lie over white: 1, linear or as a code value.
    OverWhite,
    /// Colours are taken as they are stored.
    Ignore,
}

impl Alpha {
    /// Every treatment.
    pub const ALL: [Self; 3] = [Self::OverBlack, Self::OverWhite, Self::Ignore];

    /// The name as it is written on the command line.
    #[must_use]
    pub fn name(self) -> &'static str {
        match self {
            Self::OverBlack => "over-black",
            Self::OverWhite => "over-white",
            Self::Ignore => "ignore",
        }
    }

    /// Lays colours over a background. `colours`: three values per pixel, not
    /// multiplied by alpha; `alpha`: one.
    pub(super) fn lay(self, colours: &mut [f64], alpha: &[f64]) {
        self.each(colours, alpha, |colour, alpha, ground| alpha * colour + (1.0 - alpha) * ground);
    }

    /// As [`Alpha::lay`] for colours that are multiplied by alpha already, as
    /// those of OpenEXR are.
    pub(super) fn lay_multiplied(self, colours: &mut [f64], alpha: &[f64]) {
        self.each(colours, alpha, |colour, alpha, ground| colour + (1.0 - alpha) * ground);
    }

    fn each(self, colours: &mut [f64], alpha: &[f64], over: impl Fn(f64, f64, f64) -> f64) {
        let ground = match self {
            Self::OverBlack => 0.0,
            Self::OverWhite => 1.0,
            Self::Ignore => return,
        };
        for (pixel, &alpha) in colours.chunks_exact_mut(3).zip(alpha) {
            // What is opaque keeps its bits.
            if alpha != 1.0 {
                pixel.iter_mut().for_each(|colour| *colour = over(*colour, alpha, ground));
            }
        }
    }
}

/// An image file as it was understood.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Picture {
    /// Its layers; the one that is the image is the radiance, alpha laid as
    /// asked.
    pub layers: Layers,
    /// What the values of the radiance mean.
    pub encoding: Encoding,
    /// Opacity of the radiance, 0..1 per pixel, if the file has it.
    pub alpha: Option<Vec<f64>>,
    /// The layers that the file has, by the names that choose them.
    pub found: Vec<String>,
    /// What the file says and is not obeyed, a sentence each.
    pub warnings: Vec<String>,
}
