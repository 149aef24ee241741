//! All rows as comma-separated values.

use crate::results::ResultRow;

/// A head and one line per row, parameters as `name=value` words.
pub(super) fn csv(rows: &[ResultRow]) -> Vec<u8> {
    let mut writer = csv::Writer::from_writer(Vec::new());
    // Writing into memory does not fail.
    let _ = writer.write_record([
        "schema",
        "kind",
        "id",
        "scene",
        "method",
        "parameters",
        "frame",
        "width_px",
        "height_px",
        "seed",
        "adapter",
        "software",
        "reference_id",
        "metric",
        "unit",
        "mask",
        "value",
        "ci_lo",
        "ci_hi",
        "n",
        "status",
        "reason",
    ]);
    let number = |value: Option<f64>| value.map(|v| v.to_string()).unwrap_or_default();
    let word = |value: serde_json::Value| value.as_str().unwrap_or_default().to_owned();
    for row in rows {
        let parameters: Vec<String> =
            row.parameters.iter().map(|(name, value)| format!("{name}={value}")).collect();
        let _ = writer.write_record([
            row.schema.clone(),
            word(serde_json::json!(row.kind)),
            row.id.clone(),
            row.scene.clone(),
            row.method.clone(),
            parameters.join(" "),
            row.frame.to_string(),
            row.width_px.to_string(),
            row.height_px.to_string(),
            row.seed.map(|seed| seed.to_string()).unwrap_or_default(),
            row.adapter.clone(),
            row.software.to_string(),
            row.reference_id.clone(),
            row.metric.clone(),
            row.unit.clone(),
            word(serde_json::json!(row.mask)),
            number(row.value),
            number(row.ci_lo),
            number(row.ci_hi),
            row.n.to_string(),
            word(serde_json::json!(row.status)),
            row.reason.clone(),
        ]);
    }
    writer.into_inner().unwrap_or_default()
}
