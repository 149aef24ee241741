//! Boxes of a tree whose triangles have moved: each node again from its children, the
//! topology and the order of the triangles as they are.

use obvhs::aabb::Aabb;
use obvhs::cwbvh::node::CwBvhNode;

/// Steps along an axis that a child's bounds are stored in.
const STEPS: f64 = 255.0;

/// Fits all nodes to boxes of the triangles, in the order of the leaves. Children come
/// after their parents, as obvhs builds them.
pub(crate) fn refit(nodes: &mut [CwBvhNode], triangles: &[Aabb]) {
    let mut whole = vec![Aabb::empty(); nodes.len()];
    for index in (0..nodes.len()).rev() {
        let node = &mut nodes[index];
        let children: Vec<(usize, Aabb)> = (0..8)
            .filter(|child| !node.is_child_empty(*child))
            .map(|child| (child, child_box(node, child, &whole, triangles)))
            .collect();
        whole[index] = union(children.iter().map(|(_, bounds)| *bounds));
        store(node, &children, &whole[index]);
    }
}

fn child_box(node: &CwBvhNode, child: usize, whole: &[Aabb], triangles: &[Aabb]) -> Aabb {
    if node.is_leaf(child) {
        let (first, count) = node.child_primitives(child);
        return union(triangles[first as usize..(first + count) as usize].iter().copied());
    }
    whole[node.child_node_index(child) as usize]
}

fn union(boxes: impl Iterator<Item = Aabb>) -> Aabb {
    boxes.fold(Aabb::empty(), |all, one| Aabb::new(all.min.min(one.min), all.max.max(one.max)))
}

/// Writes the bounds in steps of a power of two, downwards and upwards.
fn store(node: &mut CwBvhNode, children: &[(usize, Aabb)], whole: &Aabb) {
    node.p = whole.min.into();
    for axis in 0..3 {
        let low = f64::from(whole.min[axis]);
        let extent = f64::from(whole.max[axis]) - low;
        let exponent = (extent / STEPS).log2().ceil().clamp(-126.0, 127.0) as i32;
        let fits = |exponent: i32| 2.0_f64.powi(exponent) * STEPS >= extent;
        let exponent = if fits(exponent) { exponent } else { exponent + 1 };
        node.e[axis] = (exponent + 127) as u8;
        let step = 2.0_f64.powi(exponent);
        for (child, bounds) in children {
            let at = |edge: f32| (f64::from(edge) - low) / step;
            let least = at(bounds.min[axis]).floor() as u8;
            let most = at(bounds.max[axis]).ceil() as u8;
            let (lows, highs) = match axis {
                0 => (&mut node.child_min_x, &mut node.child_max_x),
                1 => (&mut node.child_min_y, &mut node.child_max_y),
                _ => (&mut node.child_min_z, &mut node.child_max_z),
            };
            (lows[*child], highs[*child]) = (least, most);
        }
    }
}

#[cfg(test)]
mod tests {
    #![allow(clippy::unwrap_used, reason = "a failing test may panic")]
    use super::*;
    use glam::Vec3A;
    use obvhs::BvhBuildParams;
    use obvhs::cwbvh::builder::build_cwbvh;
    use std::time::Duration;

    fn boxes(turn: f32) -> Vec<Aabb> {
        let at = |i: u32| {
            let i = i as f32;
            Vec3A::new((0.7 * i + turn).sin(), (1.3 * i - turn).cos(), 0.01 * i * turn)
        };
        (0..500).map(|i| Aabb::new(at(i) - 0.01, at(i) + 0.02)).collect()
    }

    /// Share of boxes that some leaf does not hold.
    fn outside(nodes: &[CwBvhNode], triangles: &[Aabb]) -> usize {
        let mut count = 0;
        for node in nodes {
            for child in (0..8).filter(|c| !node.is_child_empty(*c) && node.is_leaf(*c)) {
                let (first, number) = node.child_primitives(child);
                let held = node.child_aabb(child);
                for one in &triangles[first as usize..(first + number) as usize] {
                    let holds = held.min.cmple(one.min).all() && held.max.cmpge(one.max).all();
                    count += usize::from(!holds);
                }
            }
        }
        count
    }

    /// After a refit every leaf holds its triangles where they are now; before it, not.
    #[test]
    fn leaves_hold_their_triangles_where_they_have_moved() {
        struct Held(Aabb);
        impl obvhs::Boundable for Held {
            fn aabb(&self) -> Aabb {
                self.0
            }
        }
        let held: Vec<Held> = boxes(0.0).into_iter().map(Held).collect();
        let mut tree = build_cwbvh(&held, BvhBuildParams::medium_build(), &mut Duration::default());
        let moved = boxes(1.0);
        let order = &tree.primitive_indices;
        let moved: Vec<Aabb> = order.iter().map(|i| moved[*i as usize]).collect();
        assert!(outside(&tree.nodes, &moved) > 100);
        refit(&mut tree.nodes, &moved);
        assert_eq!(outside(&tree.nodes, &moved), 0);
    }
}
