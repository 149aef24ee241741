//! Error against time as SVG: log-log axes, markers that differ in shape and
//! colour, intervals, the Pareto front, the exact renderer's own curve.
//!
//! Colours are CSS variables with a fallback, so that the same text works in
//! the page (light and dark) and as a file of its own (black on white).

mod axis;
mod labels;
mod marks;

pub use marks::{escape, literal, marker_image};

use crate::report::number::digits;
use axis::Axis;
use labels::{Area, free_label};
use marks::{BOTTOM, FAINT, HEIGHT, INK, LEFT, RIGHT, TOP, WIDTH, colour, line, marker, text};
use std::fmt::Write;

/// One method in a plot.
#[derive(Clone, Debug, PartialEq)]
pub struct Point {
    /// Name, shown on hover.
    pub name: String,
    /// True if the name stands beside the marker.
    pub labelled: bool,
    /// Milliseconds.
    pub time_ms: f64,
    /// Error.
    pub error: f64,
    /// 95 % interval of the error, where known.
    pub interval: Option<(f64, f64)>,
    /// Which marker and colour; the same number means the same method.
    pub style: usize,
}

/// Settings of one method that no other of it beats.
#[derive(Clone, Debug, PartialEq)]
pub struct Front {
    /// Milliseconds and error, ascending in time.
    pub points: Vec<(f64, f64)>,
    /// The method's colour.
    pub style: usize,
}

/// Error against time of one scene.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Plot {
    /// What the plot shows, for those who cannot see it.
    pub title: String,
    /// Name and unit of the error.
    pub error_label: String,
    /// Name of the clock.
    pub time_label: String,
    /// Methods, each with all its settings.
    pub points: Vec<Point>,
    /// Fronts of methods that have several settings.
    pub fronts: Vec<Front>,
    /// The exact renderer's own curve: milliseconds and error, ascending.
    pub curve: Vec<(f64, f64)>,
}

impl Plot {
    /// Points that a logarithmic axis can show.
    fn shown(&self) -> impl Iterator<Item = &Point> {
        self.points.iter().filter(|p| p.error > 0.0 && p.time_ms > 0.0)
    }

    /// Names of the methods whose error or time is zero: a logarithmic axis
    /// has no place for them.
    #[must_use]
    pub fn not_shown(&self) -> Vec<&str> {
        self.points
            .iter()
            .filter(|p| p.error <= 0.0 || p.time_ms <= 0.0)
            .map(|p| p.name.as_str())
            .collect()
    }

    /// Indices of the methods than which none is both faster and better.
    #[must_use]
    pub fn pareto(&self) -> Vec<usize> {
        let beaten = |p: &Point| {
            self.points.iter().any(|q| {
                q.time_ms <= p.time_ms
                    && q.error <= p.error
                    && (q.time_ms < p.time_ms || q.error < p.error)
            })
        };
        (0..self.points.len()).filter(|&i| !beaten(&self.points[i])).collect()
    }

    /// The plot as one `<svg>` element; empty when nothing can be shown.
    #[must_use]
    pub fn svg(&self) -> String {
        let times = self.shown().map(|p| p.time_ms).chain(self.curve.iter().map(|c| c.0));
        let errors = self.shown().map(|p| p.error).chain(self.curve.iter().map(|c| c.1));
        let (Some(x), Some(y)) =
            (Axis::new(times, LEFT, WIDTH - RIGHT), Axis::new(errors, HEIGHT - BOTTOM, TOP))
        else {
            return String::new();
        };
        let mut svg = format!(
            "<svg xmlns=\"http://www.w3.org/2000/svg\" viewBox=\"0 0 {WIDTH} {HEIGHT}\" \
             role=\"img\" font-family=\"system-ui, sans-serif\" font-size=\"12\">\
             <title>{}</title>",
            escape(&self.title)
        );
        self.draw_axes(&mut svg, &x, &y);
        self.draw_curve(&mut svg, &x, &y);
        self.draw_front(&mut svg, &x, &y);
        self.draw_fronts(&mut svg, &x, &y);
        self.draw_points(&mut svg, &x, &y);
        svg.push_str("</svg>");
        svg
    }

    fn draw_axes(&self, svg: &mut String, x: &Axis, y: &Axis) {
        let (bottom, right) = (HEIGHT - BOTTOM, WIDTH - RIGHT);
        for (value, label) in x.labelled() {
            let at = x.place(value);
            line(svg, [at, TOP, at, bottom], FAINT, "");
            text(svg, [at, bottom + 16.0], "middle", &label);
        }
        for (value, label) in y.labelled() {
            let at = y.place(value);
            line(svg, [LEFT, at, right, at], FAINT, "");
            text(svg, [LEFT - 6.0, at + 4.0], "end", &label);
        }
        for at in x.marked().map(|value| x.place(value)) {
            line(svg, [at, bottom, at, bottom - 4.0], INK, "");
        }
        for at in y.marked().map(|value| y.place(value)) {
            line(svg, [LEFT, at, LEFT + 4.0, at], INK, "");
        }
        line(svg, [LEFT, bottom, right, bottom], INK, "");
        line(svg, [LEFT, TOP, LEFT, bottom], INK, "");
        text(svg, [(LEFT + right) / 2.0, HEIGHT - 10.0], "middle", &self.time_label);
        let middle = (TOP + bottom) / 2.0;
        let _ = write!(
            svg,
            "<text transform=\"translate(14 {middle}) rotate(-90)\" text-anchor=\"middle\" \
             fill=\"{INK}\">{}</text>",
            escape(&self.error_label)
        );
    }

    /// The exact renderer at growing effort.
    fn draw_curve(&self, svg: &mut String, x: &Axis, y: &Axis) {
        let curve: Vec<_> = self.curve.iter().filter(|c| c.0 > 0.0 && c.1 > 0.0).collect();
        if curve.is_empty() {
            return;
        }
        let path: Vec<String> =
            curve.iter().map(|c| format!("{:.1},{:.1}", x.place(c.0), y.place(c.1))).collect();
        let _ = write!(
            svg,
            "<polyline points=\"{}\" fill=\"none\" stroke=\"{INK}\" stroke-width=\"1.5\"/>",
            path.join(" ")
        );
        for c in &curve {
            let _ = write!(
                svg,
                "<circle cx=\"{:.1}\" cy=\"{:.1}\" r=\"2.5\" fill=\"{INK}\"/>",
                x.place(c.0),
                y.place(c.1)
            );
        }
        let (x, y) = (x.place(curve[0].0), y.place(curve[0].1));
        let (anchor, dx) = if x > WIDTH - 130.0 { ("end", -8.0) } else { ("start", 8.0) };
        text(svg, [x + dx, y - 9.0], anchor, "exact renderer");
    }

    /// Steps through the methods that no other beats in both time and error.
    fn draw_front(&self, svg: &mut String, x: &Axis, y: &Axis) {
        let mut front: Vec<&Point> = self.pareto().into_iter().map(|i| &self.points[i]).collect();
        front.retain(|p| p.error > 0.0 && p.time_ms > 0.0);
        front.sort_by(|a, b| a.time_ms.total_cmp(&b.time_ms));
        let mut steps = String::new();
        let mut previous: Option<f64> = None;
        for point in front {
            let (px, py) = (x.place(point.time_ms), y.place(point.error));
            if let Some(above) = previous {
                let _ = write!(steps, "{px:.1},{above:.1} ");
            }
            let _ = write!(steps, "{px:.1},{py:.1} ");
            previous = Some(py);
        }
        let _ = write!(
            svg,
            "<polyline points=\"{}\" fill=\"none\" stroke=\"{INK}\" stroke-width=\"1\" \
             stroke-dasharray=\"2 4\" opacity=\"0.6\"/>",
            steps.trim_end()
        );
    }

    fn draw_fronts(&self, svg: &mut String, x: &Axis, y: &Axis) {
        for Front { points, style } in &self.fronts {
            let shown = points.iter().filter(|p| p.0 > 0.0 && p.1 > 0.0);
            let path: Vec<String> =
                shown.map(|p| format!("{:.1},{:.1}", x.place(p.0), y.place(p.1))).collect();
            let colour = colour(*style);
            let _ = write!(
                svg,
                "<polyline points=\"{}\" fill=\"none\" stroke=\"{colour}\" \
                 stroke-width=\"1.5\" opacity=\"0.7\"/>",
                path.join(" ")
            );
        }
    }

    fn draw_points(&self, svg: &mut String, x: &Axis, y: &Axis) {
        let place = |point: &Point| [x.place(point.time_ms), y.place(point.error)];
        let mut taken: Vec<Area> = self.shown().map(|p| Area::of_marker(place(p))).collect();
        taken.extend(self.curve.iter().map(|c| Area::of_marker([x.place(c.0), y.place(c.1)])));
        let mut order: Vec<&Point> = self.shown().collect();
        order.sort_by(|a, b| a.time_ms.total_cmp(&b.time_ms));
        for point in order {
            let at = place(point);
            let colour = colour(point.style);
            if let Some((low, high)) = point.interval.filter(|(low, _)| *low > 0.0) {
                let ends = [at[0], y.place(high), at[0], y.place(low)];
                line(svg, ends, colour, " stroke-width=\"1.5\"");
            }
            let label = point.labelled.then(|| free_label(&point.name, at, &taken));
            taken.extend(label.iter().map(|label| label.area));
            if let Some(from) = label.as_ref().and_then(|label| label.leader) {
                line(svg, [at[0], at[1], from[0], from[1]], INK, " opacity=\"0.4\"");
            }
            let name = escape(&point.name);
            let (error, time) =
                (digits(point.error), crate::report::number::duration(point.time_ms));
            let _ = write!(
                svg,
                "<g><title>{name}: {error}, {time}</title>{}</g>",
                marker(point.style, at[0], at[1])
            );
            if let Some(label) = label {
                text(svg, label.at, label.anchor, &point.name);
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn plot() -> Plot {
        let point = |name: &str, time_ms, error, style| Point {
            name: name.to_owned(),
            labelled: true,
            time_ms,
            error,
            interval: None,
            style,
        };
        Plot {
            title: "a < b".to_owned(),
            points: vec![
                point("fast", 1.0, 0.1, 0),
                point("good", 10.0, 0.001, 1),
                point("<beaten>", 20.0, 0.01, 2),
                point("exact", 30.0, 0.0, 3),
            ],
            curve: vec![(100.0, 0.1), (10_000.0, 0.001)],
            ..Plot::default()
        }
    }

    #[test]
    fn only_methods_that_nothing_beats_are_on_the_front() {
        assert_eq!(plot().pareto(), [0, 1, 3]);
        assert_eq!(plot().not_shown(), ["exact"]);
    }

    #[test]
    fn names_are_text_and_never_markup() {
        let svg = plot().svg();
        assert!(svg.contains("&lt;beaten&gt;") && !svg.contains("<beaten>"));
        assert!(svg.contains("<title>a &lt; b</title>"));
        assert_eq!(svg.matches("<svg").count(), svg.matches("</svg>").count());
    }
}
