//! Errors in WGSL, told in the files and lines that they come from.

use super::source::Source;
use naga::Span;
use std::error::Error;

/// Files one after the other, and the text that they make.
pub(super) struct Joined<'a> {
    pub(super) sources: &'a [Source],
    pub(super) text: &'a str,
}

impl Joined<'_> {
    /// An error with its places. The most exact one comes first: of those in a
    /// user's file, or else of all, the one that spans the least.
    pub(super) fn told(&self, message: &str, mut places: Vec<(Span, String)>) -> String {
        places.retain(|(span, _)| span.is_defined() && span.to_range().is_some());
        places.sort_by_key(|(span, label)| {
            let of_user = self.place(*span).is_some_and(|(source, _)| source.is_path());
            (!of_user, vagueness(label), span.to_range().map_or(0, |range| range.len()))
        });
        let is_function = |(_, label): &(Span, String)| vagueness(label) == 2;
        if !places.iter().all(is_function) {
            places.retain(|place| !is_function(place));
        }
        let line = |(span, label): &(Span, String)| {
            let (source, line) = self.place(*span)?;
            let range = span.to_range()?;
            let code = self.text.get(range)?.lines().next().unwrap_or_default().trim();
            let is_told = !label.is_empty() && vagueness(label) == 0;
            let label = if is_told { format!(": {label}") } else { String::new() };
            Some((format!("{}:{line}", source.file_name()), format!("`{code}`{label}")))
        };
        let mut lines: Vec<(String, String)> = places.iter().filter_map(line).collect();
        lines.dedup();
        let Some((place, _)) = lines.first() else {
            return format!("{}: {message}", self.whole());
        };
        let mut told = format!("{place}: {message}");
        for (place, code) in &lines {
            told.push_str(&format!("\n  {place}: {code}"));
        }
        if let Some(hint) = self.hint(&places) {
            told.push_str(&format!("\n  {hint}"));
        }
        told
    }

    /// Where nothing in a user's file is to blame by itself, its `trace` does not fit
    /// what calls it.
    fn hint(&self, places: &[(Span, String)]) -> Option<String> {
        let user = self.sources.iter().find(|source| source.is_path())?;
        let at_user = |(span, _): &(Span, String)| {
            self.place(*span).is_some_and(|(source, _)| source.is_path())
        };
        if places.iter().any(at_user) {
            return None;
        }
        let line = user.text.lines().position(|line| line.contains("fn trace("))? + 1;
        let wanted = "fn trace(pixel: vec2i, v_ws: vec3f, surface: Surface) -> Trace";
        Some(format!(
            "{}:{line}: it calls what is defined here; write `{wanted}`",
            user.file_name()
        ))
    }

    /// The file of a span, and its line there.
    fn place(&self, span: Span) -> Option<(&Source, usize)> {
        let mut offset = span.to_range()?.start;
        for source in self.sources {
            // One more for the end of line that joins them.
            if offset <= source.text.len() {
                let before = source.text.get(..offset)?;
                return Some((source, before.matches('\n').count() + 1));
            }
            offset -= source.text.len() + 1;
        }
        None
    }

    /// What is said where there is no place: a user's file, or the last one.
    fn whole(&self) -> String {
        let user = self.sources.iter().find(|source| source.is_path());
        let source = user.or(self.sources.last());
        source.map_or_else(String::new, |source| source.file_name().into_owned())
    }
}

/// What a label says of its place: 0, what is wrong there; 1, that an expression is
/// part of it, which may be a parameter far away; 2, that it is in a function.
fn vagueness(label: &str) -> u8 {
    match label.strip_prefix("naga::ir::") {
        None => 0,
        Some(rest) => 1 + u8::from(rest.starts_with("Function")),
    }
}

/// An error and what caused it, the deepest last.
pub(super) fn causes(error: &dyn Error) -> String {
    let mut told = error.to_string();
    let mut next = error.source();
    while let Some(cause) = next {
        told.push_str(&format!(": {cause}"));
        next = cause.source();
    }
    told
}

#[cfg(test)]
mod tests {
    #![allow(clippy::unwrap_used, reason = "a failing test may panic")]
    use crate::wgsl::{Shader, Source};

    const GOOD: &str = "struct Trace { d: vec3f }\nfn bend(d: vec3f) -> vec3f { return d; }\n";

    fn told(user: &str) -> String {
        let caller = "fn shade() -> Trace { return trace(1.0); }\n";
        let sources = [
            Source::new("core", GOOD),
            Source::new("mine/bad.wgsl", user.to_owned()),
            Source::new("shade", caller),
        ];
        Shader::link(&sources).err().map(|error| error.to_string()).unwrap_or_default()
    }

    #[test]
    fn a_users_mistake_is_told_in_the_users_file_and_line() {
        let good = "// mine\nfn trace(x: f32) -> Trace {\n    return Trace(bend(vec3f(x)));\n}\n";
        assert_eq!(told(good), "");
        for (right, wrong, line) in [
            ("vec3f(x)", "x", 3),
            ("vec3f(x)", "vec3f(y)", 3),
            ("bend(vec3f(x))", "1u", 3),
            ("return Trace(bend(vec3f(x)));", "let n: f32 = 1u; return Trace(vec3f(n));", 3),
            ("return Trace(bend(vec3f(x)));", "return vec3f(x);", 3),
            ("(x: f32) -> Trace {", "(x: f32) -> Trace", 3),
        ] {
            let told = told(&good.replace(right, wrong));
            assert!(told.starts_with(&format!("mine/bad.wgsl:{line}: ")), "{wrong}: {told}");
            assert!(!told.contains("wgsl:559") && !told.contains("\u{2500}"), "{told}");
        }
        // What only its caller can notice names both.
        let told = told(&good.replace("x: f32", "x: vec2f").replace("vec3f(x)", "vec3f(x, 1.0)"));
        assert!(told.starts_with("shade.wgsl:1: ") && told.contains("bad.wgsl:2: "), "{told}");
    }
}
