//! All rows as comma-separated values.

use crate::results::ResultRow;
use serde::Serialize;

/// Name of a column, and what stands in it.
type Column = (&'static str, fn(&ResultRow) -> String);

const COLUMNS: [Column; 22] = [
    ("schema", |row| row.schema.clone()),
    ("kind", |row| word(&row.kind)),
    ("id", |row| row.id.clone()),
    ("scene", |row| row.scene.clone()),
    ("method", |row| row.method.clone()),
    ("parameters", parameters),
    ("frame", |row| row.frame.to_string()),
    ("width_px", |row| row.width_px.to_string()),
    ("height_px", |row| row.height_px.to_string()),
    ("seed", |row| or_empty(row.seed)),
    ("adapter", |row| row.adapter.clone()),
    ("software", |row| row.software.to_string()),
    ("reference_id", |row| row.reference_id.clone()),
    ("metric", |row| row.metric.clone()),
    ("unit", |row| row.unit.clone()),
    ("mask", |row| word(&row.mask)),
    ("value", |row| or_empty(row.value)),
    ("ci_lo", |row| or_empty(row.ci_lo)),
    ("ci_hi", |row| or_empty(row.ci_hi)),
    ("n", |row| row.n.to_string()),
    ("status", |row| word(&row.status)),
    ("reason", |row| row.reason.clone()),
];

/// A head and one line per row.
pub(super) fn csv(rows: &[ResultRow]) -> Vec<u8> {
    let mut writer = csv::Writer::from_writer(Vec::new());
    // Writing into memory does not fail.
    let _ = writer.write_record(COLUMNS.map(|(name, _)| name));
    for row in rows {
        let _ = writer.write_record(COLUMNS.map(|(_, cell)| cell(row)));
    }
    writer.into_inner().unwrap_or_default()
}

/// `name=value` words.
fn parameters(row: &ResultRow) -> String {
    let words: Vec<String> =
        row.parameters.iter().map(|(name, value)| format!("{name}={value}")).collect();
    words.join(" ")
}

/// The word that stands for it in `results.jsonl` too.
fn word(value: &impl Serialize) -> String {
    serde_json::json!(value).as_str().unwrap_or_default().to_owned()
}

fn or_empty(value: Option<impl ToString>) -> String {
    value.map(|value| value.to_string()).unwrap_or_default()
}

#[cfg(test)]
mod tests {
    use super::*;

    /// What is added to a row gets a column, under the same name.
    #[test]
    fn the_columns_are_the_fields_of_a_row() {
        let row = serde_json::json!(ResultRow::default());
        let fields: Vec<&str> =
            row.as_object().into_iter().flatten().map(|(name, _)| name.as_str()).collect();
        assert_eq!(COLUMNS.map(|(name, _)| name).as_slice(), fields);
    }
}
