//! Lines, markers and labels of a plot, as SVG text.

use std::fmt::Write;

pub(super) const WIDTH: f64 = 560.0;
pub(super) const HEIGHT: f64 = 380.0;
pub(super) const LEFT: f64 = 64.0;
pub(super) const RIGHT: f64 = 24.0;
pub(super) const TOP: f64 = 14.0;
pub(super) const BOTTOM: f64 = 48.0;
pub(super) const INK: &str = "var(--ink, #1b1f24)";
const PAPER: &str = "var(--paper, #fff)";
pub(super) const FAINT: &str = "var(--grid, #d8dce2)";
/// Okabe & Ito's colours that differ for every kind of colour vision, without
/// the yellow that is lost on white.
pub(super) const COLOURS: [&str; 7] =
    ["#0072b2", "#d55e00", "#009e73", "#cc79a7", "#e69f00", "#56b4e9", "#7f6a4f"];

/// Shapes of markers; filled for the first ten methods, hollow for the next.
const SHAPES: usize = 10;

/// The colour of a method.
pub(super) fn colour(style: usize) -> &'static str {
    COLOURS[style % COLOURS.len()]
}

/// The marker of a method: ten shapes, filled and hollow, so that twenty methods can be
/// told apart in grey; with seven colours besides, seventy.
pub(super) fn marker(style: usize, x: f64, y: f64) -> String {
    let polygon = |corners: &[(f64, f64)]| {
        let points: Vec<String> =
            corners.iter().map(|(dx, dy)| format!("{:.1},{:.1}", x + dx, y + dy)).collect();
        format!("<polygon points=\"{}\"/>", points.join(" "))
    };
    let turned = |count: usize, inner: f64, outer: f64| {
        let corner = |i: usize| {
            let (sin, cos) = (std::f64::consts::PI * i as f64 / count as f64).sin_cos();
            let radius = if i.is_multiple_of(2) { outer } else { inner };
            (radius * sin, -radius * cos)
        };
        polygon(&(0..2 * count).map(corner).collect::<Vec<_>>())
    };
    let shape = match style % SHAPES {
        0 => format!("<circle cx=\"{x:.1}\" cy=\"{y:.1}\" r=\"5\"/>"),
        1 => polygon(&[(-4.5, -4.5), (4.5, -4.5), (4.5, 4.5), (-4.5, 4.5)]),
        2 => polygon(&[(0.0, -6.0), (5.5, 4.5), (-5.5, 4.5)]),
        3 => polygon(&[(0.0, -6.5), (6.5, 0.0), (0.0, 6.5), (-6.5, 0.0)]),
        4 => polygon(&[(0.0, 6.0), (5.5, -4.5), (-5.5, -4.5)]),
        5 => polygon(&[(-6.5, -2.2), (6.5, -2.2), (6.5, 2.2), (-6.5, 2.2)]),
        6 => polygon(&[(-2.2, -6.5), (2.2, -6.5), (2.2, 6.5), (-2.2, 6.5)]),
        7 => turned(5, 2.6, 6.8),
        8 => turned(4, 1.9, 7.0),
        _ => turned(3, 2.2, 7.0),
    };
    let colour = colour(style);
    let (fill, stroke) = match style / SHAPES % 2 {
        0 => (colour, PAPER),
        _ => (PAPER, colour),
    };
    let width = if fill == PAPER { 1.8 } else { 1.0 };
    format!("<g fill=\"{fill}\" stroke=\"{stroke}\" stroke-width=\"{width}\">{shape}</g>")
}

/// The marker as an image of its own, for tables.
#[must_use]
pub fn marker_image(style: usize) -> String {
    format!(
        "<svg class=\"marker\" viewBox=\"-8 -8 16 16\" aria-hidden=\"true\">{}</svg>",
        marker(style, 0.0, 0.0)
    )
}

pub(super) fn line(svg: &mut String, [x1, y1, x2, y2]: [f64; 4], colour: &str, more: &str) {
    let _ = write!(
        svg,
        "<line x1=\"{x1:.1}\" y1=\"{y1:.1}\" x2=\"{x2:.1}\" y2=\"{y2:.1}\" \
         stroke=\"{colour}\"{more}/>"
    );
}

pub(super) fn text(svg: &mut String, [x, y]: [f64; 2], anchor: &str, content: &str) {
    let _ = write!(
        svg,
        "<text x=\"{x:.1}\" y=\"{y:.1}\" text-anchor=\"{anchor}\" fill=\"{INK}\" \
         stroke=\"{PAPER}\" stroke-width=\"3\" paint-order=\"stroke\">{}</text>",
        escape(content)
    );
}

/// The same drawing with its colours written out, black on white, for programs that
/// know no CSS variables.
#[must_use]
pub fn literal(svg: &str) -> String {
    let mut literal = String::with_capacity(svg.len());
    let mut rest = svg;
    while let Some(start) = rest.find("var(--") {
        let variable = &rest[start..];
        let (Some(comma), Some(end)) = (variable.find(", "), variable.find(')')) else { break };
        literal.push_str(&rest[..start]);
        literal.push_str(&variable[comma + 2..end]);
        rest = &variable[end + 1..];
    }
    literal.push_str(rest);
    literal
}

/// A power of ten with a raised exponent.
pub(super) fn power(decade: i32) -> String {
    const RAISED: [char; 10] = ['⁰', '¹', '²', '³', '⁴', '⁵', '⁶', '⁷', '⁸', '⁹'];
    let sign = if decade < 0 { "⁻" } else { "" };
    let raised = decade.unsigned_abs().to_string();
    let raised: String = raised.bytes().map(|digit| RAISED[usize::from(digit - b'0')]).collect();
    format!("10{sign}{raised}")
}

/// Text inside SVG or HTML.
#[must_use]
pub fn escape(text: &str) -> String {
    text.replace('&', "&amp;")
        .replace('<', "&lt;")
        .replace('>', "&gt;")
        .replace('"', "&quot;")
        .replace('\'', "&#39;")
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn twenty_methods_differ_in_grey() {
        let grey = |style: usize| {
            let shape = marker(style, 0.0, 0.0);
            COLOURS.iter().fold(shape, |shape, colour| shape.replace(colour, "grey"))
        };
        let all: std::collections::BTreeSet<String> = (0..20).map(grey).collect();
        assert_eq!(all.len(), 20);
    }

    #[test]
    fn a_drawing_of_its_own_has_literal_colours() {
        let drawn = format!("<g stroke=\"{INK}\" fill=\"{PAPER}\"><text>a, b)</text></g>");
        let plain = "<g stroke=\"#1b1f24\" fill=\"#fff\"><text>a, b)</text></g>";
        assert_eq!(literal(&drawn), plain);
    }

    #[test]
    fn exponents_are_raised() {
        assert_eq!([-5, 12].map(power), ["10⁻⁵", "10¹²"]);
    }
}
