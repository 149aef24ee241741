//! `[medium.NAME]` and media written in place.

use super::super::choice::NameOr;
use super::super::document::{Document, MediumText};
use super::super::error::{At, Problem};
use super::{only_one, span_of};
use crate::medium::RGB_WAVELENGTH_UM;
use crate::{Dispersion, Eta, Medium, MediumId, materials};
use glam::DVec3;
use std::collections::BTreeMap;
use std::ops::Range;
use toml::Spanned;

const VACUUM: &str = "vacuum";

/// Media by name, and those that are used by number.
pub(super) struct Media {
    declared: BTreeMap<String, Medium>,
    used: Vec<Medium>,
    doubts: Vec<String>,
}

impl Media {
    /// Reads every declared medium; the surroundings get number 0.
    pub(super) fn new(document: &Document) -> Result<Self, At> {
        let declared = BTreeMap::from([(VACUUM.to_owned(), Medium::vacuum())]);
        let mut media = Self { declared, used: Vec::new(), doubts: Vec::new() };
        for (name, text) in &document.medium {
            if name == VACUUM {
                return Err(At::meaning(
                    text.span(),
                    "vacuum is defined already: index 1, no absorption",
                    "choose another name, such as [medium.air]",
                ));
            }
            let medium = media.read(name, text.span(), text.get_ref())?;
            media.declared.insert(name.clone(), medium);
        }
        match &document.surroundings {
            Some(text) => media.id_of(&text.medium)?,
            None => media.id_of_medium(Medium::vacuum()),
        };
        Ok(media)
    }

    /// Number of a medium that is named or written in place.
    pub(super) fn id_of(&mut self, medium: &Spanned<NameOr<MediumText>>) -> Result<MediumId, At> {
        let medium = match medium.get_ref() {
            NameOr::Inline(text) => {
                let material = text.material.as_ref().map(|name| name.get_ref().clone());
                let name = material.unwrap_or_else(|| "inline".to_owned());
                self.read(&name, medium.span(), text)?
            }
            NameOr::Name(name) => match self.declared.get(name) {
                Some(medium) => medium.clone(),
                None => return Err(self.unknown(name, medium.span())),
            },
        };
        Ok(self.id_of_medium(medium))
    }

    fn unknown(&self, name: &str, span: Range<usize>) -> At {
        let known = self.declared.keys().cloned().collect::<Vec<_>>().join(", ");
        let material = match materials::find(name) {
            Some(_) => format!(", or {{ material = \"{name}\" }} from the table of materials"),
            None => String::new(),
        };
        At::meaning(
            span,
            format!("no medium is called \"{name}\""),
            format!(
                "write one of {known}, add [medium.{name}], or write one in place: \
                 {{ eta = 1.5 }}{material}"
            ),
        )
    }

    /// The same medium gets the same number; a name is given once.
    fn id_of_medium(&mut self, mut medium: Medium) -> MediumId {
        let base = medium.name.clone();
        let mut copy = 1;
        loop {
            let taken = self.used.iter().position(|other| other.name == medium.name);
            match taken {
                Some(index) if self.used[index] == medium => return MediumId(index as u16),
                Some(_) => {
                    copy += 1;
                    medium.name = format!("{base}-{copy}");
                }
                None => break,
            }
        }
        self.used.push(medium);
        MediumId((self.used.len() - 1) as u16)
    }

    fn read(&mut self, name: &str, whole: Range<usize>, text: &MediumText) -> Result<Medium, At> {
        let options = [
            ("eta", span_of(&text.eta)),
            ("material", span_of(&text.material)),
            ("cauchy", span_of(&text.cauchy)),
            ("sellmeier", span_of(&text.sellmeier)),
        ];
        only_one(&whole, &options, "eta = 1.5")?;
        let absorption_per_m = text.absorption_per_m.map_or(DVec3::ZERO, |a| a.0);
        let mut medium = Medium { absorption_per_m, ..Medium::plain(name, Eta::VACUUM) };
        if let Some(law) = law(text) {
            medium.dispersion = law;
            medium.eta = eta_of_law(&medium, whole.clone())?;
        }
        if let Some(eta) = &text.eta {
            medium.eta = *eta.get_ref();
        }
        if let Some(material) = &text.material {
            medium.eta = self.material(material)?;
        }
        if let Some(dispersion) = &text.dispersion {
            if medium.dispersion != Dispersion::None {
                return Err(At::meaning(
                    dispersion.span(),
                    "dispersion is given twice: as a law and as a number",
                    "take out dispersion, or write eta or material instead of the law",
                ));
            }
            if dispersion.get_ref().0 > 0.0 {
                medium.dispersion = Dispersion::Gltf { dispersion: dispersion.get_ref().0 };
            }
        }
        medium
            .check_at(RGB_WAVELENGTH_UM)
            .map_err(|error| At { span: whole, problem: Problem::Value(error.to_string()) })?;
        Ok(medium)
    }

    fn material(&mut self, name: &Spanned<String>) -> Result<Eta, At> {
        let Some(material) = materials::find(name.get_ref()) else {
            let known: Vec<_> = materials::MATERIALS.iter().map(|m| m.name).collect();
            return Err(At::meaning(
                name.span(),
                format!("no material is called \"{}\"", name.get_ref()),
                format!("write one of {}, or eta = 1.5", known.join(", ")),
            ));
        };
        if let Some(doubt) = material.doubt {
            self.doubts.push(format!("material \"{}\": {doubt}", material.name));
        }
        Ok(material.eta())
    }

    /// The media that are used, surroundings first.
    pub(super) fn finish(self, warnings: &mut Vec<String>) -> Vec<Medium> {
        warnings.extend(self.doubts);
        warnings.extend(self.used.iter().filter_map(Medium::doubt));
        for name in self.declared.keys().filter(|name| *name != VACUUM) {
            if !self.used.iter().any(|medium| medium.name == *name) {
                warnings.push(format!("medium \"{name}\" is not used"));
            }
        }
        self.used
    }
}

fn law(text: &MediumText) -> Option<Dispersion> {
    let cauchy = text.cauchy.as_ref().map(Spanned::get_ref);
    let sellmeier = text.sellmeier.as_ref().map(Spanned::get_ref);
    cauchy.map(|law| Dispersion::Cauchy { a: law.a.0, b_um2: law.b_um2.0 }).or_else(|| {
        sellmeier.map(|law| Dispersion::Sellmeier {
            b: law.b.0.to_array(),
            c_um2: law.c_um2.0.to_array(),
        })
    })
}

/// The law's index at the d line, which is an index like any other. Those of red
/// and blue may lie below 1: anomalous media exist.
fn eta_of_law(medium: &Medium, whole: Range<usize>) -> Result<Eta, At> {
    let eta = medium.eta_at(RGB_WAVELENGTH_UM[1]);
    Eta::try_from(eta).map_err(|error| {
        At::meaning(
            whole,
            format!("the law gives, at the d line: {error}"),
            "write coefficients for micrometres, such as cauchy = { a = 1.5046, b_um2 = 0.0042 }",
        )
    })
}
