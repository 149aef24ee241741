//! Rows as comma-separated values, one number a line or one run a line.

use crate::results::{Columns, Mask, ResultRow, Scalar};
use serde::Serialize;
use std::collections::{BTreeMap, BTreeSet};

/// Name of a column, and what stands in it.
type Column = (&'static str, fn(&ResultRow) -> String);

/// What every row has; what only some have stands between the two.
const FIRST: [Column; 5] = [
    ("schema", |row| row.schema.clone()),
    ("kind", |row| word(&row.kind)),
    ("id", |row| row.id.clone()),
    ("scene", |row| row.scene.clone()),
    ("method", |row| row.method.clone()),
];
const LAST: [Column; 18] = [
    ("positions", |row| row.positions.to_string()),
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
    ("ci_of", |row| row.ci_of.clone()),
    ("n", |row| row.n.to_string()),
    ("status", |row| word(&row.status)),
    ("reason", |row| row.reason.clone()),
];

/// A head and one line per row; what only some rows have is empty elsewhere.
pub(super) fn csv(rows: &[ResultRow]) -> Vec<u8> {
    let own = own_columns(rows);
    let head = FIRST.iter().map(|(name, _)| *name).chain(own.iter().copied());
    let head: Vec<&str> = head.chain(LAST.iter().map(|(name, _)| *name)).collect();
    let line = |row: &ResultRow| {
        let mut line: Vec<String> = FIRST.iter().map(|(_, cell)| cell(row)).collect();
        line.extend(own_cells(&row.columns, &own));
        line.extend(LAST.iter().map(|(_, cell)| cell(row)));
        line
    };
    written(&head, rows.iter().map(line))
}

/// One line per run and number of positions, one column per metric. A metric of the
/// object only ends in `.object`.
pub(super) fn wide(rows: &[ResultRow]) -> Vec<u8> {
    let own = own_columns(rows);
    let mut metrics: Vec<String> = Vec::new();
    let mut seen = BTreeSet::new();
    let mut lines: Vec<(&ResultRow, BTreeMap<String, String>)> = Vec::new();
    let mut places: BTreeMap<(&str, &str, u32), usize> = BTreeMap::new();
    for row in rows {
        let name = metric(row);
        if seen.insert(name.clone()) {
            metrics.push(name.clone());
        }
        let place = *places.entry((&row.scene, &row.id, row.positions)).or_insert(lines.len());
        if place == lines.len() {
            lines.push((row, BTreeMap::new()));
        }
        lines[place].1.entry(name).or_insert_with(|| or_empty(row.value));
    }
    let head = ["id", "scene", "method"].into_iter().chain(own.iter().copied());
    let head = head.chain(["positions", "width_px", "height_px", "adapter", "software"]);
    let head: Vec<&str> = head.chain(metrics.iter().map(String::as_str)).collect();
    let lines = lines.iter().map(|(row, values)| {
        let mut line = vec![row.id.clone(), row.scene.clone(), row.method.clone()];
        line.extend(own_cells(&row.columns, &own));
        line.extend([row.positions, row.width_px, row.height_px].map(|n| n.to_string()));
        line.extend([row.adapter.clone(), row.software.to_string()]);
        line.extend(metrics.iter().map(|name| values.get(name).cloned().unwrap_or_default()));
        line
    });
    written(&head, lines)
}

fn metric(row: &ResultRow) -> String {
    match row.mask {
        Mask::All => row.metric.clone(),
        Mask::Object => format!("{}.object", row.metric),
    }
}

/// Names of what only some rows have.
fn own_columns(rows: &[ResultRow]) -> Vec<&str> {
    let names: BTreeSet<&str> =
        rows.iter().flat_map(|row| row.columns.0.keys().map(String::as_str)).collect();
    names.into_iter().collect()
}

fn own_cells(columns: &Columns, names: &[&str]) -> Vec<String> {
    let cell = |name: &&str| columns.0.get(*name).map(Scalar::to_string).unwrap_or_default();
    names.iter().map(cell).collect()
}

/// The word that stands for it in `results.jsonl` too.
fn word(value: &impl Serialize) -> String {
    serde_json::json!(value).as_str().unwrap_or_default().to_owned()
}

fn or_empty(value: Option<impl ToString>) -> String {
    value.map(|value| value.to_string()).unwrap_or_default()
}

fn written(head: &[&str], lines: impl Iterator<Item = Vec<String>>) -> Vec<u8> {
    let mut writer = csv::Writer::from_writer(Vec::new());
    // Writing into memory does not fail.
    let _ = writer.write_record(head);
    for line in lines {
        let _ = writer.write_record(line);
    }
    writer.into_inner().unwrap_or_default()
}

#[cfg(test)]
mod tests {
    use super::*;

    /// What is added to a row gets a column, under the same name, whether every row
    /// has it or only some.
    #[test]
    fn the_columns_are_the_fields_of_a_row() {
        let mut row = ResultRow::default();
        row.columns.0.insert("param.a".to_owned(), Scalar::Number(0.5));
        let value = serde_json::json!(row);
        let fields: Vec<&str> =
            value.as_object().into_iter().flatten().map(|(name, _)| name.as_str()).collect();
        let text = String::from_utf8(csv(&[row])).unwrap_or_default();
        let head: Vec<&str> = text.lines().next().into_iter().flat_map(|l| l.split(',')).collect();
        assert_eq!(head, fields);
    }
}
