//! Lines, markers and labels of a plot, as SVG text.

use std::fmt::Write;

pub(super) const WIDTH: f64 = 560.0;
pub(super) const HEIGHT: f64 = 380.0;
pub(super) const LEFT: f64 = 64.0;
pub(super) const RIGHT: f64 = 16.0;
pub(super) const TOP: f64 = 14.0;
pub(super) const BOTTOM: f64 = 48.0;
pub(super) const INK: &str = "var(--ink, #1b1f24)";
pub(super) const FAINT: &str = "var(--grid, #d8dce2)";
/// Okabe & Ito's colours that differ for every kind of colour vision, without
/// the yellow that is lost on white.
pub(super) const COLOURS: [&str; 7] =
    ["#0072b2", "#d55e00", "#009e73", "#cc79a7", "#e69f00", "#56b4e9", "#7f6a4f"];

/// Moves a label down until no other label lies there.
pub(super) fn free_height(labels: &[[f64; 3]], [from, to]: [f64; 2], wanted: f64) -> f64 {
    let mut height = wanted;
    for _ in 0..labels.len() {
        let hit = labels
            .iter()
            .find(|label| label[0] < to && from < label[1] && (label[2] - height).abs() < 12.0);
        match hit {
            Some(label) => height = label[2] + 12.5,
            None => break,
        }
    }
    height.min(HEIGHT - BOTTOM - 3.0)
}

/// Seven shapes, so that a print in black and white can be read.
pub(super) fn marker(style: usize, x: f64, y: f64) -> String {
    let polygon = |corners: &[(f64, f64)]| {
        let points: Vec<String> =
            corners.iter().map(|(dx, dy)| format!("{:.1},{:.1}", x + dx, y + dy)).collect();
        format!("<polygon points=\"{}\"/>", points.join(" "))
    };
    match style % 7 {
        0 => format!("<circle cx=\"{x:.1}\" cy=\"{y:.1}\" r=\"5\"/>"),
        1 => polygon(&[(-4.5, -4.5), (4.5, -4.5), (4.5, 4.5), (-4.5, 4.5)]),
        2 => polygon(&[(0.0, -6.0), (5.5, 4.5), (-5.5, 4.5)]),
        3 => polygon(&[(0.0, -6.5), (6.5, 0.0), (0.0, 6.5), (-6.5, 0.0)]),
        4 => polygon(&[(0.0, 6.0), (5.5, -4.5), (-5.5, -4.5)]),
        5 => polygon(&[(-6.0, -2.0), (6.0, -2.0), (6.0, 2.0), (-6.0, 2.0)]),
        _ => polygon(&[(-2.0, -6.0), (2.0, -6.0), (2.0, 6.0), (-2.0, 6.0)]),
    }
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
         stroke=\"var(--paper, #fff)\" stroke-width=\"3\" paint-order=\"stroke\">{}</text>",
        escape(content)
    );
}

/// A power of ten: plain from 0.01 to 1000, else with a raised exponent.
pub(super) fn power(decade: i32) -> String {
    const RAISED: [char; 10] = ['⁰', '¹', '²', '³', '⁴', '⁵', '⁶', '⁷', '⁸', '⁹'];
    match decade {
        -2 => "0.01".to_owned(),
        -1 => "0.1".to_owned(),
        0..=3 => 10i32.pow(decade as u32).to_string(),
        _ => {
            let sign = if decade < 0 { "⁻" } else { "" };
            let raised = decade.unsigned_abs().to_string();
            let raised: String =
                raised.bytes().map(|digit| RAISED[usize::from(digit - b'0')]).collect();
            format!("10{sign}{raised}")
        }
    }
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
    fn labels_of_equal_points_do_not_lie_on_each_other() {
        assert_eq!(free_height(&[[0.0, 50.0, 100.0]], [10.0, 60.0], 101.0), 112.5);
        assert_eq!(free_height(&[[0.0, 50.0, 100.0]], [60.0, 90.0], 101.0), 101.0);
    }

    #[test]
    fn decades_are_written_plainly_where_that_is_short() {
        assert_eq!([-2, 0, 3].map(power), ["0.01", "1", "1000"]);
        assert_eq!([-5, 12].map(power), ["10⁻⁵", "10¹²"]);
    }
}
