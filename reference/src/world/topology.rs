//! Whether a mesh has an inside.

use scenes::Mesh;

/// Number of edges whose two directions do not occur equally often. Zero means
/// that the mesh is a cycle: every line enters it as often as it leaves.
pub(crate) fn unmatched_edges(mesh: &Mesh) -> usize {
    // An edge as (low, high) in one number, and whether it runs upwards.
    let mut edges: Vec<(u64, bool)> = Vec::with_capacity(3 * mesh.triangles.len());
    for [a, b, c] in &mesh.triangles {
        for (from, to) in [(a, b), (b, c), (c, a)] {
            let (low, high) = (from.min(to), from.max(to));
            if low != high {
                edges.push((u64::from(*low) << 32 | u64::from(*high), from < to));
            }
        }
    }
    edges.sort_unstable();
    let balanced = |group: &&[(u64, bool)]| {
        2 * group.iter().filter(|(_, upwards)| *upwards).count() != group.len()
    };
    edges.chunk_by(|a, b| a.0 == b.0).filter(balanced).count()
}
