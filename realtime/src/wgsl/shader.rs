//! WGSL is put together from files and read back with naga: which globals an
//! entry point really uses decides which passes run, which memory exists and
//! what is bound. Nothing about bindings is written in Rust.

use super::composer::Choices;
use super::source::Source;
use super::told::{Joined, causes};
use crate::error::Error;
use naga::valid::{Capabilities, ValidationFlags, Validator};

/// A shader put together, parsed and validated.
pub(crate) struct Shader {
    /// The joined text.
    pub(crate) text: String,
    module: naga::Module,
    info: naga::valid::ModuleInfo,
}

/// A global that an entry point uses.
#[derive(Clone, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub(crate) struct Used {
    pub(crate) binding: u32,
    pub(crate) name: String,
}

impl Shader {
    /// Files, or choices, with everything that they need.
    pub(crate) fn compose(roots: &[&str], choices: &Choices) -> Result<Self, Error> {
        Self::link(&choices.closure(roots)?)
    }

    /// Joins files in order and validates the whole.
    pub(super) fn link(sources: &[Source]) -> Result<Self, Error> {
        let mut text = String::new();
        for source in sources {
            text.push_str(&source.text);
            text.push('\n');
        }
        let joined = Joined { sources, text: &text };
        let module = naga::front::wgsl::parse_str(&text).map_err(|error| {
            let places = error.labels().map(|(span, label)| (span, label.to_owned()));
            Error::Shader(joined.told(error.message(), places.collect()))
        })?;
        let info = Validator::new(ValidationFlags::all(), Capabilities::all())
            .validate(&module)
            .map_err(|error| {
                let places = error.spans().cloned().collect();
                Error::Shader(joined.told(&causes(error.as_inner()), places))
            })?;
        Ok(Self { text, module, info })
    }

    /// The bound globals that an entry point, or anything it calls, uses.
    pub(crate) fn used(&self, entry_point: &str) -> Vec<Used> {
        let entries = self.module.entry_points.iter();
        let Some(index) = entries.clone().position(|entry| entry.name == entry_point) else {
            return Vec::new();
        };
        let info = self.info.get_entry_point(index);
        let mut used: Vec<Used> = self
            .module
            .global_variables
            .iter()
            .filter(|(handle, _)| !info[*handle].is_empty())
            .filter_map(|(_, variable)| {
                let binding = variable.binding.as_ref()?.binding;
                Some(Used { binding, name: variable.name.clone()? })
            })
            .collect();
        used.sort();
        used
    }

    /// True if any of the entry points uses the global.
    pub(crate) fn uses(&self, entry_points: &[&str], name: &str) -> bool {
        entry_points.iter().any(|entry| self.used(entry).iter().any(|used| used.name == name))
    }
}

#[cfg(test)]
mod tests {
    #![allow(clippy::unwrap_used, reason = "a failing test may panic")]
    use super::*;

    const TEXT: &str = "@group(0) @binding(3) var<uniform> a: vec4f;
@group(0) @binding(5) var<uniform> b: vec4f;
fn read_b() -> vec4f { return b; }
@compute @workgroup_size(1) fn with_b() { _ = a + read_b(); }
@compute @workgroup_size(1) fn without_b() { _ = a; }
";

    #[test]
    fn a_global_that_is_not_read_is_not_bound() {
        let shader = Shader::link(&[Source::new("test", TEXT)]).unwrap();
        assert!(shader.uses(&["with_b"], "b"));
        assert!(!shader.uses(&["without_b"], "b"));
        assert_eq!(shader.used("without_b"), [Used { binding: 3, name: "a".to_owned() }]);
    }

    #[test]
    fn an_error_names_the_file_and_its_line() {
        let sources = [
            Source::new("good", TEXT),
            Source::new("bad.wgsl", "\nfn f() -> f32 { return 1u; }\n"),
        ];
        let error = Shader::link(&sources).err().unwrap().to_string();
        assert!(error.starts_with("bad.wgsl:2:"), "{error}");
    }
}
