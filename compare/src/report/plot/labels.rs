//! Names beside their markers, where they cover nothing.

use super::marks::{BOTTOM, HEIGHT, LEFT, RIGHT, TOP, WIDTH};

/// Height of a line of text.
const LINE: f64 = 12.5;
/// Distance between a marker's centre and its label.
const GAP: f64 = 9.0;

/// A rectangle that something covers.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Area {
    x: [f64; 2],
    y: [f64; 2],
}

impl Area {
    pub(super) fn of_marker([x, y]: [f64; 2]) -> Self {
        Self { x: [x - 6.0, x + 6.0], y: [y - 6.0, y + 6.0] }
    }

    fn overlaps(&self, other: &Self) -> bool {
        let apart = |a: [f64; 2], b: [f64; 2]| a[1] <= b[0] || b[1] <= a[0];
        !apart(self.x, other.x) && !apart(self.y, other.y)
    }

    fn is_inside_the_axes(&self) -> bool {
        self.x[0] > LEFT
            && self.x[1] < WIDTH - RIGHT + 8.0
            && self.y[0] > TOP - 10.0
            && self.y[1] < HEIGHT - BOTTOM
    }
}

/// Where a name goes.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Label {
    /// Position of the text.
    pub(super) at: [f64; 2],
    /// SVG's text anchor.
    pub(super) anchor: &'static str,
    /// What the text covers.
    pub(super) area: Area,
    /// Near end of the text, where it is too far away to need no line.
    pub(super) leader: Option<[f64; 2]>,
}

/// The nearest free place for a name: beside its marker, else above or below
/// in steps of a line, to the right before to the left.
pub(super) fn free_label(name: &str, marker: [f64; 2], taken: &[Area]) -> Label {
    let width = name.chars().count() as f64 * 6.6;
    let steps = [0.0, -1.0, 1.0, -2.0, 2.0, -3.0, 3.0, -4.0, 4.0, -5.0, 5.0, 6.0, -6.0];
    let candidates = steps.into_iter().flat_map(|step| {
        let reach = if step == 0.0 { GAP } else { GAP + 5.0 };
        [("start", reach), ("end", -reach)]
            .map(|(anchor, dx)| label(marker, step, anchor, dx, width))
    });
    let mut first = None;
    for candidate in candidates {
        let free = candidate.area.is_inside_the_axes()
            && taken.iter().all(|area| !area.overlaps(&candidate.area));
        if free {
            return candidate;
        }
        first.get_or_insert(candidate);
    }
    first.unwrap_or_else(|| label(marker, 0.0, "start", GAP, width))
}

fn label([x, y]: [f64; 2], step: f64, anchor: &'static str, dx: f64, width: f64) -> Label {
    let at = [x + dx, y + step * LINE + 4.0];
    let span = if anchor == "start" { [at[0], at[0] + width] } else { [at[0] - width, at[0]] };
    let area = Area { x: span, y: [at[1] - 10.0, at[1] + 2.0] };
    let leader = (step != 0.0).then(|| [at[0] - dx.signum() * 2.0, at[1] - 4.0]);
    Label { at, anchor, area, leader }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn names_of_a_crowd_cover_neither_each_other_nor_a_marker() {
        let markers: Vec<[f64; 2]> =
            (0..7).map(|i| [250.0 + 4.0 * f64::from(i), 150.0 + 3.0 * f64::from(i % 3)]).collect();
        let mut taken: Vec<Area> = markers.iter().map(|m| Area::of_marker(*m)).collect();
        for marker in &markers {
            let label = free_label("one-interface-vertex", *marker, &taken);
            assert!(taken.iter().all(|area| !area.overlaps(&label.area)), "{label:?}");
            assert!(label.area.is_inside_the_axes());
            taken.push(label.area);
        }
    }

    #[test]
    fn a_name_alone_stands_right_of_its_marker_and_left_of_it_at_the_border() {
        let label = free_label("dx7", [200.0, 100.0], &[]);
        assert_eq!((label.at, label.anchor, label.leader), ([209.0, 104.0], "start", None));
        assert_eq!(free_label("dx7", [540.0, 100.0], &[]).anchor, "end");
    }
}
