//! The layers that can be asked of a method, for people.

/// Names and meanings, the same for every method. What a method does not draw by
/// itself is drawn when it is asked for.
pub const LAYERS: [(&str, &str); 19] = [
    ("radiance", "linear radiance, mean over the positions in each pixel"),
    ("coverage", "share of the positions that meet a body"),
    ("exit", "unit direction in which light leaves the last body; 0: none"),
    ("first", "unit direction after the first interface"),
    ("hit2", "where light meets its second interface, metres"),
    ("events", "interfaces met"),
    ("flags", "bits, listed below, as a whole number"),
    ("path.<medium>", "metres inside the bodies, where all of them are of that medium"),
    ("front_normal", "unit normal of the surface in front"),
    ("front_depth", "its linear depth, metres"),
    ("front_geometric", "unit normal of its triangle"),
    ("back_normal", "unit normal of the surface behind"),
    ("back_depth", "its linear depth, metres"),
    ("thickness", "from front to back along the viewing axis, metres"),
    ("crack_mask", "1 where a crack is drawn"),
    ("layer_count", "surfaces one behind the other"),
    ("layer_depth.<n>", "linear depth of the n-th, counted from 0, metres"),
    ("layer_normal.<n>", "its unit normal"),
    ("layer_facing.<n>", "1: faces the eye, -1: faces away, 0: there is none"),
];
