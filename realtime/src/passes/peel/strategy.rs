//! The strategies of depth peeling, and what each asks of an adapter.

use crate::error::Error;
use crate::gpu::Gpu;
use crate::methods::Settings;
use crate::plan::counted::Counted;

use wgpu::Features;

/// How the layers of a view are found. All leave the same layers behind.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Strategy {
    /// In one pass into the next free slot, and sorted afterwards.
    Slots,
    /// One layer per pass.
    Everitt,
    /// The nearest and the farthest in one pass.
    Dual,
    /// In one pass, inserted where they belong.
    Cascade,
}

impl Strategy {
    /// What a method's parameter says; slots for methods without one.
    pub(crate) fn of(settings: &Settings) -> Self {
        match settings.word_if_any("peel") {
            Some("everitt") => Self::Everitt,
            Some("dual") => Self::Dual,
            Some("cascade") => Self::Cascade,
            _ => Self::Slots,
        }
    }

    pub(crate) fn word(self) -> &'static str {
        match self {
            Self::Slots => "slots",
            Self::Everitt => "everitt",
            Self::Dual => "dual",
            Self::Cascade => "cascade",
        }
    }

    /// True if the bodies are drawn once per layer or pair of layers.
    pub(crate) fn repeats(self) -> bool {
        matches!(self, Self::Everitt | Self::Dual)
    }

    /// How often the bodies are drawn. One layer more than there is room for
    /// tells which pixels have more; of a pair, normals come one pass later.
    pub(crate) fn draws(self, counted: Counted) -> u32 {
        match self {
            Self::Slots | Self::Cascade => 1,
            Self::Everitt => counted.capacity + u32::from(counted.overflows),
            Self::Dual => counted.capacity.div_ceil(2) + 1,
        }
    }

    /// Bytes per pixel of the buffer that only this strategy has, and its name.
    pub(crate) fn own_buffer(self, capacity: u32) -> Option<(&'static str, u64)> {
        match self {
            Self::Slots | Self::Everitt => None,
            Self::Dual => Some(("dual_bounds", 8)),
            Self::Cascade => Some(("cascade", 8 * u64::from(capacity))),
        }
    }

    /// What `auto` means on an adapter: the one pass that keeps the nearest of
    /// too many layers where 64-bit atomics allow it, else slots.
    pub(crate) fn automatic(available: Features) -> Self {
        let (needed, _) = Self::Cascade.features();
        if available.contains(needed) { Self::Cascade } else { Self::Slots }
    }

    fn features(self) -> (Features, &'static str) {
        match self {
            Self::Slots | Self::Everitt => (Features::empty(), ""),
            Self::Dual => (Features::FLOAT32_BLENDABLE, "FLOAT32_BLENDABLE"),
            Self::Cascade => (
                Features::SHADER_INT64.union(Features::SHADER_INT64_ATOMIC_ALL_OPS),
                "SHADER_INT64 and SHADER_INT64_ATOMIC_ALL_OPS",
            ),
        }
    }

    /// Refuses a strategy that the adapter cannot follow.
    pub(crate) fn check(self, gpu: &Gpu) -> Result<(), Error> {
        self.check_features(gpu.device.features(), &gpu.info().name)
    }

    fn check_features(self, available: Features, adapter: &str) -> Result<(), Error> {
        let (features, names) = self.features();
        if available.contains(features) {
            return Ok(());
        }
        Err(Error::Feature {
            what: format!("peel = {}", self.word()),
            feature: names.to_owned(),
            adapter: adapter.to_owned(),
            instead: "write peel = slots or peel = everitt, which every adapter can".to_owned(),
        })
    }
}

#[cfg(test)]
mod tests {
    #![allow(clippy::unwrap_used, reason = "a failing test may panic")]
    use super::*;

    #[test]
    fn a_missing_feature_is_named_with_what_to_write_instead() {
        for (strategy, name) in [
            (Strategy::Dual, "FLOAT32_BLENDABLE"),
            (Strategy::Cascade, "SHADER_INT64_ATOMIC_ALL_OPS"),
        ] {
            let error =
                strategy.check_features(Features::empty(), "plain").unwrap_err().to_string();
            for part in [name, strategy.word(), "plain", "peel = slots"] {
                assert!(error.contains(part), "{error}");
            }
            strategy.check_features(Features::all(), "rich").unwrap();
        }
        assert_eq!(Strategy::automatic(Features::empty()), Strategy::Slots);
        assert_eq!(Strategy::automatic(Features::all()), Strategy::Cascade);
        Strategy::Slots.check_features(Features::empty(), "plain").unwrap();
        Strategy::Everitt.check_features(Features::empty(), "plain").unwrap();
    }

    #[test]
    fn passes_follow_the_number_of_layers() {
        let six = Counted::new(6, 32, 1);
        let [slots, everitt, dual, cascade] =
            [Strategy::Slots, Strategy::Everitt, Strategy::Dual, Strategy::Cascade]
                .map(|strategy| strategy.draws(six));
        assert_eq!([slots, everitt, dual, cascade], [1, 6, 4, 1]);
        let cut = Counted::new(6, 5, 1);
        assert_eq!(cut, Counted { capacity: 5, overflows: true, pixels: 1 });
        assert_eq!([Strategy::Everitt, Strategy::Dual].map(|strategy| strategy.draws(cut)), [6, 4]);
        assert_eq!(Counted::new(0, 32, 1), Counted { capacity: 2, overflows: false, pixels: 1 });
    }
}
