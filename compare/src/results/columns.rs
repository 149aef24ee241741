//! Columns that only some rows have: what was set, with its own name and type.

use schemars::{JsonSchema, Schema, SchemaGenerator, json_schema};
use serde::{Deserialize, Deserializer, Serialize};
use std::borrow::Cow;
use std::collections::BTreeMap;
use std::fmt;

/// Before the name of a method's parameter: `param.a`.
pub const PARAM: &str = "param.";
/// Before the path of a number in the scene file: `scene.medium.glass.eta`.
pub const SCENE: &str = "scene.";
/// Before the parts of the exposures at which HDR-FLIP compares: start and stop in
/// stops, and how many.
pub const FLIP_EXPOSURES: &str = "flip_exposures.";

/// A number or a word.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(untagged)]
pub enum Scalar {
    /// A number.
    Number(f64),
    /// A word, such as one of a parameter's choices.
    Word(String),
}

impl Scalar {
    /// A number where the text is one.
    #[must_use]
    pub fn read(text: &str) -> Self {
        let number = text.parse::<f64>().ok().filter(|number| number.is_finite());
        number.map_or_else(|| Self::Word(text.to_owned()), Self::Number)
    }
}

impl fmt::Display for Scalar {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Number(number) => write!(f, "{number}"),
            Self::Word(word) => f.write_str(word),
        }
    }
}

/// Values by the full name of their column, each a field of its own in a row.
#[derive(Clone, Debug, Default, PartialEq, Serialize)]
#[serde(transparent)]
pub struct Columns(pub BTreeMap<String, Scalar>);

impl Columns {
    /// Columns of parameters and of numbers set in the scene.
    #[must_use]
    pub fn new(param: &BTreeMap<String, Scalar>, scene: &BTreeMap<String, f64>) -> Self {
        let param = param.iter().map(|(name, value)| (format!("{PARAM}{name}"), value.clone()));
        let scene =
            scene.iter().map(|(key, value)| (format!("{SCENE}{key}"), Scalar::Number(*value)));
        Self(param.chain(scene).collect())
    }

    /// The columns whose names start so, without that start.
    pub fn under<'a>(&'a self, start: &'a str) -> impl Iterator<Item = (&'a str, &'a Scalar)> {
        self.0.iter().filter_map(move |(name, value)| Some((name.strip_prefix(start)?, value)))
    }
}

/// Fields of other names belong to a later version and are passed over.
impl<'de> Deserialize<'de> for Columns {
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
        let fields = BTreeMap::<String, serde_json::Value>::deserialize(deserializer)?;
        let ours =
            |name: &String| [PARAM, SCENE, FLIP_EXPOSURES].iter().any(|s| name.starts_with(s));
        let read = |(name, value): (String, serde_json::Value)| {
            Some((name, serde_json::from_value(value).ok()?))
        };
        Ok(Self(fields.into_iter().filter(|(name, _)| ours(name)).filter_map(read).collect()))
    }
}

/// Any number of fields whose names start as these do.
impl JsonSchema for Columns {
    fn schema_name() -> Cow<'static, str> {
        "Columns".into()
    }

    fn inline_schema() -> bool {
        true
    }

    fn json_schema(generator: &mut SchemaGenerator) -> Schema {
        let scalar = generator.subschema_for::<Scalar>();
        let number = generator.subschema_for::<f64>();
        json_schema!({
            "type": "object",
            "patternProperties": {
                r"^param\.": scalar,
                r"^(scene|flip_exposures)\.": number,
            },
        })
    }
}
