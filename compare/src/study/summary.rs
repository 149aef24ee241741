//! The table a study ends with: scene x method, error, time, what was left out.

use crate::results::{REFERENCE, ResultRow, Run, Study, Validity, saved_ms};

/// Heading, metric, digits after the point.
const ERRORS: [(&str, &str, usize); 4] = [
    ("median exit", "exit_angle_median_deg", 2),
    ("p95 exit", "exit_angle_p95_deg", 2),
    ("relmse_e1e-2", "relmse_e1e-2", 4),
    ("FLIP", "flip_hdr", 4),
];

/// Most lines of the table.
const MOST: usize = 100;

/// Rows of text, headings first: one row per scene and method.
#[must_use]
pub fn summary(study: &Study, rows: &[ResultRow]) -> Vec<Vec<String>> {
    let mut table = vec![vec!["scene".to_owned(), "method".to_owned()]];
    table[0].extend(ERRORS.map(|(heading, ..)| heading.to_owned()));
    table[0].extend([clock(study), "left out"].map(str::to_owned));
    let runs: Vec<&Run> = study.runs.iter().filter(|run| run.method != REFERENCE).collect();
    for run in runs.iter().take(MOST) {
        let value = |metric: &str, digits: usize| {
            let of_run = |row: &&ResultRow| row.id == run.id && row.metric == metric;
            cell(rows.iter().find(of_run), digits)
        };
        let mut line = vec![run.scene.clone(), study.name_of(run)];
        line.extend(ERRORS.map(|(_, metric, digits)| value(metric, digits)));
        line.push(value(&study.time_metric, 2));
        let of_run = || rows.iter().filter(|row| row.id == run.id);
        line.push(left_out(&run.plan, saved_ms(of_run(), &study.time_metric)));
        table.push(line);
    }
    if runs.len() > MOST {
        table.push(vec![format!("and {} more in wide.csv", runs.len() - MOST)]);
    }
    table
}

/// What the times are of. A software adapter's frames are drawn by the processor:
/// their wall time is shown, and says nothing about a GPU.
const fn clock(study: &Study) -> &'static str {
    if study.software { "CPU ms (software adapter)" } else { "GPU ms" }
}

fn cell(row: Option<&ResultRow>, digits: usize) -> String {
    let Some(row) = row else { return "-".to_owned() };
    match (row.status, row.value) {
        (Validity::Ok | Validity::Identical, Some(value)) => format!("{value:.digits$}"),
        (Validity::Invalid, _) => "invalid".to_owned(),
        _ => "-".to_owned(),
    }
}

/// How much of the program a scene did not need, and what that saves.
fn left_out(plan: &scenes::Plan, saved_ms: Option<f64>) -> String {
    use scenes::plan::Kind;
    let count = |kind| plan.left_out.iter().filter(|left| left.kind == kind).count();
    let bytes: u64 = plan.left_out.iter().map(|left| left.saves_bytes).sum();
    let passes = count(Kind::Pass);
    let plural = if passes == 1 { "pass" } else { "passes" };
    let time = saved_ms.map(|saved| format!(", {saved:.2} ms")).unwrap_or_default();
    format!("{passes} {plural}, {:.1} MB{time}", bytes as f64 / 1e6)
}
