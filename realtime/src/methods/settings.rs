//! Parameters with their defaults filled in and their ranges checked.

use super::{Kind, Method, Parameter};
use crate::error::Error;
use crate::wgsl;
use std::collections::BTreeMap;

/// A parameter's value.
#[derive(Clone, Debug, PartialEq)]
pub enum Value {
    /// A number.
    Number(f64),
    /// A whole number.
    Whole(u32),
    /// One of the parameter's words.
    Word(&'static str),
}

/// All parameters of one method.
#[derive(Clone, Debug, PartialEq)]
pub struct Settings(BTreeMap<&'static str, Value>);

impl Settings {
    /// Fills in defaults and checks what was given.
    ///
    /// # Errors
    /// If a name is unknown, or a value is out of range.
    pub fn new(method: &Method, given: &BTreeMap<String, String>) -> Result<Self, Error> {
        let fail = |what: String| Err(Error::Parameter { method: method.id.to_owned(), what });
        for name in given.keys() {
            if !method.parameters.iter().any(|parameter| parameter.name == name) {
                let known: Vec<_> = method.parameters.iter().map(|p| p.name).collect();
                let known = if known.is_empty() { "none".to_owned() } else { known.join(", ") };
                return fail(format!("there is no parameter \"{name}\"; there are: {known}"));
            }
        }
        let mut settings = BTreeMap::new();
        for parameter in method.parameters {
            let value = match parameter.read(given.get(parameter.name).map(String::as_str)) {
                Ok(value) => value,
                Err(what) => return fail(what),
            };
            settings.insert(parameter.name, value);
        }
        Ok(Self(settings))
    }

    /// Decides a choice that was left open.
    pub(crate) fn decide(&mut self, name: &'static str, word: &'static str) {
        self.0.insert(name, Value::Word(word));
    }

    /// A number.
    ///
    /// # Panics
    /// If the method has no such number: our mistake.
    pub(crate) fn number(&self, name: &str) -> f64 {
        match self.0.get(name) {
            Some(Value::Number(value)) => *value,
            Some(Value::Whole(value)) => f64::from(*value),
            other => panic!("parameter {name} is {other:?}, not a number"),
        }
    }

    /// A whole number that only some methods have.
    pub(crate) fn whole_if_any(&self, name: &str) -> Option<u32> {
        match self.0.get(name) {
            Some(Value::Whole(value)) => Some(*value),
            _ => None,
        }
    }

    /// The seed of the random numbers, if any are drawn.
    pub(crate) fn seed(&self) -> Option<u64> {
        let drawn = self.whole_if_any("samples").is_some_and(|samples| samples > 0);
        self.whole_if_any("seed").filter(|_| drawn).map(u64::from)
    }

    /// A word.
    ///
    /// # Panics
    /// If the method has no such choice: our mistake.
    pub(crate) fn word(&self, name: &str) -> &'static str {
        match self.0.get(name) {
            Some(Value::Word(value)) => value,
            other => panic!("parameter {name} is {other:?}, not a choice"),
        }
    }

    /// The word of a choice that only some methods have.
    pub(crate) fn word_if_any(&self, name: &str) -> Option<&'static str> {
        match self.0.get(name) {
            Some(Value::Word(value)) => Some(value),
            _ => None,
        }
    }

    /// Needs of the shaders that parameters decide, with the names of files: a word
    /// chooses `PARAMETER_WORD` and a number `PARAMETER_zero` or `PARAMETER_nonzero`,
    /// where there is such a file.
    pub(crate) fn files(&self) -> impl Iterator<Item = (&'static str, String)> {
        let named = self.0.iter().map(|(name, value)| {
            let kind = match value {
                Value::Word(word) => word.replace('-', "_"),
                Value::Number(0.0) | Value::Whole(0) => "zero".to_owned(),
                Value::Number(_) | Value::Whole(_) => "nonzero".to_owned(),
            };
            (*name, format!("{name}_{kind}"))
        });
        named.filter(|(_, file)| wgsl::named(file).is_some())
    }

    /// Every number as a constant of WGSL that is called like it.
    pub(crate) fn constants(&self) -> String {
        let constants = self.0.iter().filter_map(|(name, value)| {
            let name = name.to_uppercase();
            match value {
                Value::Number(number) => Some(format!("const {name}: f32 = {number:?};\n")),
                Value::Whole(number) => Some(format!("const {name}: u32 = {number}u;\n")),
                Value::Word(_) => None,
            }
        });
        constants.collect()
    }

    /// Every parameter as text, for provenance.
    #[must_use]
    pub fn describe(&self) -> BTreeMap<String, String> {
        let text = |value: &Value| match value {
            Value::Number(number) => number.to_string(),
            Value::Whole(number) => number.to_string(),
            Value::Word(word) => (*word).to_owned(),
        };
        self.0.iter().map(|(name, value)| ((*name).to_owned(), text(value))).collect()
    }
}

impl Parameter {
    fn read(&self, given: Option<&str>) -> Result<Value, String> {
        match self.kind {
            Kind::Number { default, min, max, whole } => {
                let value = |n: f64| if whole { Value::Whole(n as u32) } else { Value::Number(n) };
                let Some(text) = given else { return Ok(value(default)) };
                let fits = |n: &f64| (min..=max).contains(n) && (!whole || n.fract() == 0.0);
                let number = text.parse::<f64>().ok().filter(fits);
                let kind = if whole { "whole number" } else { "number" };
                number.map(value).ok_or_else(|| {
                    format!("{} = \"{text}\" is not a {kind} from {min} to {max}", self.name)
                })
            }
            Kind::Choice(words) => {
                let Some(text) = given else { return Ok(Value::Word(words[0])) };
                let word = words.iter().find(|word| **word == text);
                word.map(|word| Value::Word(word)).ok_or_else(|| {
                    format!("{} = \"{text}\" is none of: {}", self.name, words.join(", "))
                })
            }
        }
    }
}
