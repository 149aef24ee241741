//! Parameters that a user's file declares in its head, as `snell methods` prints them:
//! `// parameter: strength = 0.5 [0 to 2 m]: how strongly it bends`.

use super::{Kind, Parameter};

const FORM: &str = "write `// parameter: NAME = DEFAULT [MIN to MAX UNIT]: MEANING`, or `[whole MIN \
                    to MAX UNIT]` for whole numbers";

/// What one line declares.
pub(super) fn parameter(text: &str) -> Result<Parameter, String> {
    let wrong = |what: &str| format!("`// parameter: {text}`: {what}; {FORM}");
    let (name, rest) = text.split_once('=').ok_or_else(|| wrong("there is no `=`"))?;
    let (default, rest) = rest.split_once('[').ok_or_else(|| wrong("there is no range"))?;
    let (range, help) = rest.split_once(']').ok_or_else(|| wrong("the range does not end"))?;
    let name = checked(name.trim()).map_err(|what| wrong(&what))?;
    let (whole, range) = match range.trim().strip_prefix("whole ") {
        Some(range) => (true, range),
        None => (false, range.trim()),
    };
    let mut words = range.split_whitespace();
    let number = |word: Option<&str>, what: &str| {
        let number = word.and_then(|word| word.parse::<f64>().ok()).filter(|n| n.is_finite());
        number.ok_or_else(|| wrong(&format!("{what} is no number")))
    };
    let min = number(words.next(), "the smallest value")?;
    if words.next() != Some("to") {
        return Err(wrong("`to` does not stand between smallest and largest"));
    }
    let max = number(words.next(), "the largest value")?;
    let default = number(Some(default.trim()), "the default")?;
    let unit = words.collect::<Vec<_>>().join(" ");
    let is_whole = |n: f64| n.fract() == 0.0 && (0.0..=f64::from(u32::MAX)).contains(&n);
    if whole && ![default, min, max].into_iter().all(is_whole) {
        return Err(wrong("a whole number is none, or is negative"));
    }
    if !(min..=max).contains(&default) {
        return Err(wrong("the default is outside of the range"));
    }
    let help = help.trim().trim_start_matches(':').trim();
    if help.is_empty() {
        return Err(wrong("it does not say what it means"));
    }
    let kind = Kind::Number { default, min, max, whole };
    Ok(Parameter {
        name: name.to_owned().leak(),
        kind,
        unit: unit.leak(),
        help: help.to_owned().leak(),
    })
}

/// A name that can be a constant of WGSL.
fn checked(name: &str) -> Result<&str, String> {
    let allowed = |c: char| c.is_ascii_lowercase() || c.is_ascii_digit() || c == '_';
    let begins = name.starts_with(|c: char| c.is_ascii_lowercase());
    if begins && name.chars().all(allowed) {
        return Ok(name);
    }
    Err(format!("\"{name}\" is no name of small letters, digits and `_`"))
}

#[cfg(test)]
mod tests {
    #![allow(clippy::unwrap_used, reason = "a failing test may panic")]
    use super::*;

    #[test]
    fn a_line_declares_name_default_range_unit_and_meaning() {
        let found = parameter("strength = 0.5 [0 to 2 m]: how strongly it bends").unwrap();
        assert_eq!(
            (found.name, found.unit, found.help),
            ("strength", "m", "how strongly it bends")
        );
        let kind = |default, min, max, whole| Kind::Number { default, min, max, whole };
        assert_eq!(found.kind, kind(0.5, 0.0, 2.0, false));
        let found = parameter("steps=8 [whole 1 to 64] steps between two walls").unwrap();
        assert_eq!((found.kind, found.unit), (kind(8.0, 1.0, 64.0, true), ""));
    }

    #[test]
    fn what_is_wrong_with_a_line_is_said_with_how_to_write_it() {
        for (line, what) in [
            ("strength", "no `=`"),
            ("strength = 1: x", "no range"),
            ("Strength = 1 [0 to 2]: x", "small letters"),
            ("strength = 3 [0 to 2]: x", "outside"),
            ("strength = a [0 to 2]: x", "default is no number"),
            ("strength = 1 [0 2]: x", "`to`"),
            ("strength = 1.5 [whole 0 to 2]: x", "whole"),
            ("strength = 1 [0 to 2]", "means"),
        ] {
            let told = parameter(line).unwrap_err();
            assert!(told.contains(what) && told.contains("NAME = DEFAULT"), "{line}: {told}");
        }
    }
}
