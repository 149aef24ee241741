//! `snell schema`: what the answers and files of this program hold.

use crate::Error;
use crate::cli::judge::compare;
use crate::cli::output::{Line, Output};
use crate::cli::status::Status;
use crate::results::{RESULT_SCHEMA, ResultRow, STUDY_SCHEMA, Study};
use clap::ValueEnum;
use schemars::generate::SchemaSettings;
use schemars::{JsonSchema, Schema};
use serde_json::json;

/// Print the JSON Schema of what this program writes
///
/// Within a major version, the number in the field `schema`, fields are only added.
#[derive(clap::Args, Debug)]
pub(in crate::cli) struct Args {
    /// What is described
    of: Described,
}

#[derive(Clone, Copy, Debug, ValueEnum)]
enum Described {
    /// A line of results.jsonl
    Result,
    /// study.json
    Study,
    /// A line of `snell compare --json`
    Measurement,
}

pub(in crate::cli) fn run(args: &Args, output: Output) -> Result<Status, Error> {
    let text = match output.json {
        true => schema(args.of).to_value().to_string(),
        false => text(args.of),
    };
    output.line(&text)?;
    Ok(Status::Done)
}

/// The schema as it is printed and kept in `compare/schemas`.
fn text(of: Described) -> String {
    serde_json::to_string_pretty(schema(of).as_value()).unwrap_or_default()
}

fn schema(of: Described) -> Schema {
    match of {
        Described::Result => named::<ResultRow>(RESULT_SCHEMA),
        Described::Study => named::<Study>(STUDY_SCHEMA),
        Described::Measurement => named::<Line<compare::Line>>(compare::SCHEMA),
    }
}

/// The schema of a type as it is written, in which the field `schema` has one value.
fn named<T: JsonSchema>(name: &str) -> Schema {
    let settings = SchemaSettings::draft2020_12().for_serialize();
    let mut schema = settings.into_generator().into_root_schema_for::<T>();
    schema.insert("title".to_owned(), json!(name));
    if let Some(own) = schema.pointer_mut("/properties/schema") {
        *own = json!({ "const": name, "description": "Name and major version of this form." });
    }
    schema
}

#[cfg(test)]
mod tests {
    #![allow(clippy::unwrap_used, reason = "a schema that cannot be read must fail its test")]
    use super::*;
    use crate::results::Scalar;
    use serde_json::Value;
    use std::path::Path;

    /// What is kept is what is printed. Where it differs because a field was added,
    /// print it again: `snell schema result > compare/schemas/result.json`.
    #[test]
    fn the_kept_schemas_are_those_of_the_types() {
        for of in Described::value_variants() {
            let name = format!("{of:?}.json").to_lowercase();
            let path = Path::new(env!("CARGO_MANIFEST_DIR")).join("schemas").join(&name);
            let kept = std::fs::read_to_string(path).unwrap();
            assert!(kept.trim_end() == text(*of), "print compare/schemas/{name} again");
        }
    }

    /// Fields of an object that a schema does not name, and those that it asks for
    /// and the object lacks.
    fn strange(schema: &Value, object: &Value) -> Vec<String> {
        let object = object.as_object().unwrap();
        let named = |name: &str| {
            let starts = ["param.", "scene.", "flip_exposures."];
            schema["properties"].get(name).is_some() || starts.iter().any(|s| name.starts_with(s))
        };
        let unnamed = object.keys().filter(|name| !named(name)).cloned();
        let required = schema["required"].as_array().unwrap().iter();
        let required = required.map(|name| name.as_str().unwrap().to_owned());
        unnamed.chain(required.filter(|name| !object.contains_key(name))).collect()
    }

    #[test]
    fn a_schema_names_every_field_and_asks_for_each() {
        let mut row = ResultRow::default();
        row.columns.0.insert("param.a".to_owned(), Scalar::Number(0.5));
        let schema = schema(Described::Result).to_value();
        assert_eq!(strange(&schema, &json!(row)), [""; 0]);
        // The controls: one field more, and one less.
        let mut other = json!(row);
        other["invented"] = json!(1);
        other.as_object_mut().unwrap().remove("metric");
        assert_eq!(strange(&schema, &other), ["invented", "metric"]);
        assert_eq!(schema["properties"]["schema"]["const"], RESULT_SCHEMA);
    }
}
