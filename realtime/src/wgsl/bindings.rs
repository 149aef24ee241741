//! Binding numbers of group 0, all of them. Globals of one number never meet in a
//! shader.

/// Number, and the globals that have it.
#[cfg(test)]
const BINDINGS: &[(u32, &[&str])] = &[
    (0, &["frame"]),
    (1, &["bodies"]),
    (2, &["environment_cube", "environment_faces", "uniform_radiance"]),
    (3, &["environment_linear"]),
    (4, &["front_normal"]),
    (5, &["front_depth"]),
    (6, &["front_geometric"]),
    (7, &["back_normal"]),
    (8, &["back_depth"]),
    (9, &["front_vector"]),
    (10, &["analytic"]),
    (11, &["front_thickness"]),
    (12, &["slot_counts"]),
    (13, &["slot_depths"]),
    (14, &["slot_normals"]),
    (16, &["bumps"]),
    (17, &["surroundings"]),
    (18, &["background_light"]),
    (19, &["background_depth"]),
    (20, &["cracks"]),
    (21, &["air"]),
    (22, &["interior"]),
    (23, &["clip_front"]),
    (24, &["clip_back"]),
    (25, &["dual_extremes", "normal_faces", "peeled"]),
    (26, &["cascade", "dual_bounds"]),
    (27, &["dual_normals"]),
    (28, &["peel_frame"]),
    (29, &["ray_nodes"]),
    (30, &["ray_triangles"]),
    (31, &["ray_analytic"]),
    (32, &["out_radiance"]),
    (33, &["out_exit"]),
    (34, &["out_first"]),
    (35, &["out_hit2"]),
    (36, &["out_count"]),
    (38, &["ray_normals"]),
    (39, &["ray_bodies"]),
];

#[cfg(test)]
mod tests {
    #![allow(clippy::unwrap_used, reason = "a failing test may panic")]
    use super::BINDINGS;
    use crate::wgsl::FILES;
    use std::collections::{BTreeMap, BTreeSet};

    /// Numbers and names of the globals that a text declares.
    fn declared(text: &str) -> Vec<(u32, &str)> {
        let declarations = text.split("@binding(").skip(1);
        let read = declarations.map(|rest| {
            let (number, rest) = rest.split_once(')').unwrap();
            let (_, rest) = rest.split_once("var").unwrap();
            let (before, _) = rest.split_once(':').unwrap();
            (number.parse().unwrap(), before.rsplit([' ', '>']).next().unwrap())
        });
        read.collect()
    }

    #[test]
    fn the_files_bind_what_is_listed_and_nothing_else() {
        let mut found: BTreeMap<u32, BTreeSet<&str>> = BTreeMap::new();
        for (number, name) in FILES.iter().flat_map(|(_, text)| declared(text)) {
            found.entry(number).or_default().insert(name);
        }
        let listed =
            BINDINGS.iter().map(|(number, names)| (*number, names.iter().copied().collect()));
        assert_eq!(found, listed.collect());
        let text = "@group(0) @binding(3) var<storage, read> a: array<u32>;";
        assert_eq!(declared(text), [(3, "a")]);
    }
}
