//! Error against time: a method's settings are points, the best of them its front.

use super::{Mask, PARAM, REFERENCE, ResultRow, RowKind, SceneEntry, Study, Validity};
use std::collections::BTreeMap;

/// One setting of a method at one place.
#[derive(Clone, Debug, PartialEq)]
pub struct Point {
    /// Id of the run.
    pub id: String,
    /// What is set, as people read it; empty where nothing varies.
    pub setting: String,
    /// k of the k x k positions per pixel that are drawn in that time.
    pub supersampling: u32,
    /// Milliseconds of a frame.
    pub time_ms: f64,
    /// Error against the pixel integral.
    pub error: f64,
    /// 95 % interval of the error, where one is known.
    pub interval: Option<(f64, f64)>,
}

/// All settings of a method at one place, by time.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Curve {
    /// Method, or [`REFERENCE`].
    pub method: String,
    /// Points in ascending order of their time.
    pub points: Vec<Point>,
}

impl Curve {
    /// The points than which no other is both faster and better.
    #[must_use]
    pub fn front(&self) -> Vec<&Point> {
        let mut front: Vec<&Point> = Vec::new();
        for point in &self.points {
            if front.last().is_none_or(|last| point.error < last.error) {
                front.push(point);
            }
        }
        front
    }

    /// Milliseconds in which the curve reaches an error, on straight lines between
    /// points of its front in a plot with logarithmic axes; `None` beyond its last.
    #[must_use]
    pub fn time_at_error(&self, error: f64) -> Option<f64> {
        let front = self.front();
        let reached = front.iter().position(|point| point.error <= error)?;
        let Some(before) = reached.checked_sub(1) else { return Some(front[0].time_ms) };
        let (a, b) = (front[before], front[reached]);
        if b.error <= 0.0 {
            return Some(b.time_ms);
        }
        let along = (a.error.ln() - error.ln()) / (a.error.ln() - b.error.ln());
        Some((a.time_ms.ln() + along * (b.time_ms / a.time_ms).ln()).exp())
    }

    /// The error that the curve comes to in a time; `None` before its first point.
    #[must_use]
    pub fn error_at_time(&self, time_ms: f64) -> Option<f64> {
        let front = self.front();
        let past = front.iter().position(|point| point.time_ms > time_ms).unwrap_or(front.len());
        let before = past.checked_sub(1)?;
        let a = front[before];
        let Some(b) = front.get(past).filter(|b| b.error > 0.0) else { return Some(a.error) };
        let along = (time_ms / a.time_ms).ln() / (b.time_ms / a.time_ms).ln();
        Some((a.error.ln() + along * (b.error / a.error).ln()).exp())
    }
}

/// The curves of a metric at one place, methods in the order of the rows.
///
/// A method's error is that of the image which its timed frame draws: the mean over
/// as many positions in each pixel, against the mean over all of the truth's.
#[must_use]
pub fn curves(study: &Study, entry: &SceneEntry, rows: &[ResultRow], metric: &str) -> Vec<Curve> {
    let here: Vec<&ResultRow> = rows.iter().filter(|row| entry.holds(row)).collect();
    let mut order: Vec<&str> = Vec::new();
    let mut runs: BTreeMap<&str, BTreeMap<(&str, u32), Found>> = BTreeMap::new();
    for row in here {
        if !order.contains(&row.method.as_str()) {
            order.push(&row.method);
        }
        let found = runs.entry(&row.method).or_default();
        let found = found.entry((&row.id, row.positions)).or_default();
        found.take(row, metric, &study.time_metric);
    }
    // Directions belong to pixel centres, whatever the light is averaged over.
    let of_centres = metric.starts_with("exit_");
    let curve = |method: &str| {
        let runs = runs.get(method)?;
        let varied = varied(runs.values());
        let of_run = |id: &str| {
            runs.iter().filter(|((other, _), _)| *other == id).find_map(|(_, found)| found.error)
        };
        let points = runs.iter().filter_map(|((id, k), found)| {
            let error = if of_centres { of_run(id) } else { found.error };
            found.point(id, *k, error?, &varied)
        });
        let mut points: Vec<Point> = points.collect();
        points.sort_by(|a, b| a.time_ms.total_cmp(&b.time_ms).then(a.error.total_cmp(&b.error)));
        (!points.is_empty()).then(|| Curve { method: method.to_owned(), points })
    };
    order.into_iter().filter_map(curve).collect()
}

/// What rows say of one run at one number of positions.
#[derive(Default)]
struct Found<'a> {
    error: Option<&'a ResultRow>,
    time: Option<&'a ResultRow>,
    any: Option<&'a ResultRow>,
}

impl<'a> Found<'a> {
    fn take(&mut self, row: &'a ResultRow, metric: &str, clock: &str) {
        self.any = self.any.or(Some(row));
        let usable =
            matches!(row.status, Validity::Ok | Validity::Identical) && row.value.is_some();
        if !usable || row.mask != Mask::All {
            return;
        }
        if row.kind == RowKind::Error && row.metric == metric {
            self.error = self.error.or(Some(row));
        }
        let own = [clock, "time_wall_ms", "time_given_ms"];
        let rank = |metric: &str| own.iter().position(|name| *name == metric);
        if let (RowKind::Time, Some(place)) = (row.kind, rank(&row.metric)) {
            let before = self.time.and_then(|time| rank(&time.metric));
            if before.is_none_or(|before| place < before) {
                self.time = Some(row);
            }
        }
    }

    fn point(
        &self,
        id: &str,
        supersampling: u32,
        error: &ResultRow,
        varied: &[String],
    ) -> Option<Point> {
        let time = self.time?;
        let set = error.columns.under(PARAM).filter(|(name, _)| varied.iter().any(|v| v == name));
        let mut setting: Vec<String> = set.map(|(name, value)| format!("{name}={value}")).collect();
        let drawn_by_us = time.metric != "time_given_ms" && error.method != REFERENCE;
        if supersampling > 1 && drawn_by_us {
            setting.push(format!("{supersampling}x{supersampling}"));
        }
        Some(Point {
            id: id.to_owned(),
            setting: setting.join(" "),
            supersampling,
            time_ms: time.value.filter(|ms| *ms > 0.0)?,
            error: error.value?,
            interval: error.ci_lo.zip(error.ci_hi),
        })
    }
}

/// Names of the parameters that differ among runs.
fn varied<'a>(runs: impl Iterator<Item = &'a Found<'a>>) -> Vec<String> {
    let mut values: BTreeMap<&str, Vec<String>> = BTreeMap::new();
    for row in runs.filter_map(|found| found.any) {
        for (name, value) in row.columns.under(PARAM) {
            let seen = values.entry(name).or_default();
            let value = value.to_string();
            if !seen.contains(&value) {
                seen.push(value);
            }
        }
    }
    values.into_iter().filter(|(_, seen)| seen.len() > 1).map(|(name, _)| name.to_owned()).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    fn curve(points: &[(f64, f64)]) -> Curve {
        let point = |&(time_ms, error): &(f64, f64)| Point {
            id: String::new(),
            setting: String::new(),
            supersampling: 1,
            time_ms,
            error,
            interval: None,
        };
        Curve { method: "m".to_owned(), points: points.iter().map(point).collect() }
    }

    /// On a line error = 1/time, time and error are read back; a slower and worse
    /// point is not on the front and changes nothing.
    #[test]
    fn the_front_is_read_both_ways() {
        let on_the_line = [(1.0, 1.0), (10.0, 0.1), (100.0, 0.01)];
        for curve in [
            curve(&on_the_line),
            curve(&[on_the_line[0], (5.0, 3.0), on_the_line[1], on_the_line[2]]),
        ] {
            assert_eq!(curve.front().len(), 3);
            for time in [1.0, 2.0, 10.0, 50.0, 100.0] {
                assert!((curve.error_at_time(time).unwrap_or(0.0) * time - 1.0).abs() < 1e-12);
                assert!(
                    (curve.time_at_error(1.0 / time).unwrap_or(0.0) / time - 1.0).abs() < 1e-12
                );
            }
            // Beyond the ends nothing is invented.
            assert_eq!(curve.time_at_error(0.001), None);
            assert_eq!(curve.error_at_time(0.5), None);
            assert_eq!(
                (curve.time_at_error(7.0), curve.error_at_time(1e3)),
                (Some(1.0), Some(0.01))
            );
        }
        // A better point that is slower bends the line: the control.
        let bent = curve(&[(1.0, 1.0), (10.0, 0.01), (100.0, 0.001)]);
        assert!((bent.error_at_time(2.0).unwrap_or(0.0) * 2.0 - 1.0).abs() > 0.1);
    }

    #[test]
    fn an_exact_point_ends_a_front() {
        let curve = curve(&[(1.0, 0.5), (2.0, 0.0)]);
        assert_eq!(curve.time_at_error(0.1), Some(2.0));
        assert_eq!((curve.error_at_time(1.5), curve.error_at_time(3.0)), (Some(0.5), Some(0.0)));
    }
}
