//! Refractive indices by name.

use crate::Eta;

/// A material of the table.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Material {
    /// Name in scene files.
    pub name: &'static str,
    /// Absolute index as printed.
    pub index: f64,
    /// Where it was printed.
    pub source: &'static str,
    /// What is doubtful about it, if anything.
    pub doubt: Option<&'static str>,
}

const DX7: &str = "Fake Refraction in DX7 (2000), table of indices";

const fn printed(name: &'static str, index: f64) -> Material {
    Material { name, index, source: DX7, doubt: None }
}

/// The table of the text that introduced cube-map refraction, as printed.
pub const MATERIALS: [Material; 18] = [
    printed("vacuum", 1.0),
    printed("air", 1.000_29),
    printed("alcohol", 1.329),
    printed("crown-glass", 1.53),
    printed("crystal", 2.0),
    printed("diamond", 2.417),
    printed("emerald", 1.57),
    printed("fused-quartz", 1.46),
    printed("heavy-flint-glass", 1.65),
    printed("glass", 1.5),
    printed("ice", 1.309),
    Material {
        name: "quartz",
        index: 1.644,
        source: DX7,
        doubt: Some(
            "1.644 is suspect: crystalline quartz has 1.544 (ordinary ray, sodium light), which \
             the same table prints for salt; write eta = 1.544 unless you repeat the text",
        ),
    },
    printed("sapphire", 1.77),
    printed("salt", 1.544),
    printed("sugar-solution-80", 1.49),
    printed("sugar-solution-30", 1.38),
    printed("topaz", 1.61),
    printed("water", 1.333_33),
];

/// The material of that name; `ruby` is another name of `sapphire`.
#[must_use]
pub fn find(name: &str) -> Option<&'static Material> {
    let name = if name == "ruby" { "sapphire" } else { name };
    MATERIALS.iter().find(|material| material.name == name)
}

impl Material {
    /// The index, checked.
    #[must_use]
    pub fn eta(&self) -> Eta {
        // Every row is from 1 to 2.417; a test holds that.
        Eta::try_from(self.index).unwrap_or(Eta::VACUUM)
    }
}

#[cfg(test)]
mod tests {
    #![allow(clippy::unwrap_used, reason = "a failing test may panic")]
    use super::*;

    #[test]
    fn every_row_is_an_index_and_the_suspect_one_is_marked() {
        for material in MATERIALS {
            assert_eq!(material.eta().get(), material.index);
        }
        assert_eq!(find("ice").unwrap().index, 1.309);
        let doubtful: Vec<_> =
            MATERIALS.iter().filter(|m| m.doubt.is_some()).map(|m| m.name).collect();
        assert_eq!(doubtful, ["quartz"]);
        assert!(find("unobtainium").is_none());
    }
}
