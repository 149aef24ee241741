//! From files to a shader: a file names what it needs, and what those need comes
//! with it. A need is a file, or a choice that was made between files.

use super::files::FILES;
use super::source::Source;
use crate::error::Error;
use std::collections::BTreeMap;

/// The files that stand for needs which are no files themselves.
#[derive(Clone, Debug, Default)]
pub(crate) struct Choices(BTreeMap<String, Source>);

impl Choices {
    /// Lets a file of this crate stand for a need.
    ///
    /// # Panics
    /// If there is no such file: our mistake.
    pub(crate) fn choose(&mut self, need: &str, file: &str) {
        self.give(need, named(file).unwrap_or_else(|| panic!("there is no file {file}.wgsl")));
    }

    /// Lets some source stand for a need.
    pub(crate) fn give(&mut self, need: &str, source: Source) {
        self.0.insert(need.to_owned(), source);
    }

    /// The same with another file for a need.
    pub(crate) fn with(&self, need: &str, file: &str) -> Self {
        let mut changed = self.clone();
        changed.choose(need, file);
        changed
    }

    /// What is stood for.
    #[cfg(test)]
    pub(crate) fn needs(&self) -> impl Iterator<Item = &str> {
        self.0.keys().map(String::as_str)
    }

    /// Files and everything that they need, what is needed first.
    pub(crate) fn closure(&self, roots: &[&str]) -> Result<Vec<Source>, Error> {
        let mut found = Vec::new();
        let mut seen = Vec::new();
        for root in roots {
            self.add(root, "what is composed", &mut seen, &mut found)?;
        }
        Ok(found)
    }

    fn add(
        &self,
        need: &str,
        needed_by: &str,
        seen: &mut Vec<String>,
        found: &mut Vec<Source>,
    ) -> Result<(), Error> {
        let source = self.0.get(need).cloned().or_else(|| named(need));
        let source = source.ok_or_else(|| {
            Error::Shader(format!("{needed_by} needs \"{need}\", which is no file of this program"))
        })?;
        if seen.contains(&source.name) {
            return Ok(());
        }
        seen.push(source.name.clone());
        for next in source.head().needs.unwrap_or_default() {
            self.add(&next, &source.file_name(), seen, found)?;
        }
        found.push(source);
        Ok(())
    }
}

/// A file of this crate.
pub(crate) fn named(name: &str) -> Option<Source> {
    let index = FILES.binary_search_by_key(&name, |(file, _)| file).ok()?;
    let (name, text) = FILES[index];
    Some(Source::new(name, text))
}

#[cfg(test)]
mod tests {
    #![allow(clippy::unwrap_used, reason = "a failing test may panic")]
    use super::*;

    #[test]
    fn what_is_needed_comes_along_once_and_first() {
        let mut choices = Choices::default();
        choices.choose("camera", "camera_perspective");
        choices.give("a", Source::new("a", "// needs: b camera\n"));
        choices.give("b", Source::new("b", "// needs: a camera\n"));
        let files = choices.closure(&["a", "b"]).unwrap();
        let names: Vec<_> = files.iter().map(|file| file.name.as_str()).collect();
        assert_eq!(names, ["frame", "camera_perspective", "b", "a"]);
        choices.give("c", Source::new("c", "// needs: nothing_like_it\n"));
        let error = choices.closure(&["c"]).unwrap_err().to_string();
        assert!(error.contains("c.wgsl") && error.contains("nothing_like_it"), "{error}");
    }
}
