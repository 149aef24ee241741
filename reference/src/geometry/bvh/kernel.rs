//! The two inner loops, and how they are done without vector instructions.
//!
//! For triangles all kernels do the operations of
//! [`Passage::new`](crate::geometry::triangle::Passage::new) in its order, so they answer
//! with its bits, and leave to it what passes through an edge. For boxes they
//! may round differently, because what is answered does not depend on boxes.

use super::box_ray::BoxRay;
use super::node::{Block, LANES, Node, WIDTH};
use super::stack::{Keys, LANE, NONE};
use crate::geometry::line::Line;
use crate::geometry::triangle::Passage;

/// What runs on a kernel, whichever it is.
pub(crate) trait Traversal {
    type Output;

    fn run<K: Kernel>(self, kernel: K) -> Self::Output;
}

/// One way to run the inner loops.
pub(crate) trait Kernel: Copy {
    /// A line prepared for boxes.
    type Boxes: Copy;
    /// A line prepared for triangles.
    type Lanes: Copy;
    /// A block's triangles as the line sees them.
    type Seen: Copy;
    /// [`Keys`] where the kernel works on them.
    type Order: Copy;

    fn boxes(self, ray: &BoxRay, low: f32) -> Self::Boxes;

    fn lanes(self, line: &Line) -> Self::Lanes;

    /// The children that the line meets between `low` and `limit`: one bit for
    /// each, and their keys.
    fn meet(self, ray: &Self::Boxes, node: &Node, limit: f32) -> (u32, Self::Order);

    /// The least key, and all keys without it.
    fn nearest(self, keys: Self::Order) -> (i32, Self::Order);

    fn load(self, keys: &Keys) -> Self::Order;

    fn store(self, keys: Self::Order, to: &mut Keys);

    /// One bit for each triangle that the line may pierce: none that it does is
    /// left out.
    fn candidates(self, line: &Self::Lanes, block: &Block) -> (u32, Self::Seen);

    /// One bit for each triangle that the line pierces inside its edges, and its
    /// passages through those, with the bits of [`Passage::new`].
    ///
    /// [`Passage::new`]: crate::geometry::triangle::Passage::new
    fn clear(self, line: &Self::Lanes, seen: &Self::Seen) -> (u32, Passages);
}

/// [`Passage`](crate::geometry::triangle::Passage)s through the triangles of a block.
#[derive(Clone, Copy, Debug)]
#[repr(C, align(32))]
pub(crate) struct Passages {
    pub(crate) t: [f64; LANES],
    pub(crate) areas: [[f64; LANES]; 3],
}

impl Passages {
    #[inline(always)]
    pub(crate) fn of(&self, lane: usize) -> Passage {
        let [u, v, w] = &self.areas;
        Passage { t: self.t[lane], areas: [u[lane], v[lane], w[lane]] }
    }
}

/// Plain Rust.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Portable;

impl Kernel for Portable {
    type Boxes = (BoxRay, f32);
    type Lanes = Line;
    type Seen = Seen;
    type Order = Keys;

    #[inline(always)]
    fn boxes(self, ray: &BoxRay, low: f32) -> Self::Boxes {
        (*ray, low)
    }

    #[inline(always)]
    fn lanes(self, line: &Line) -> Line {
        *line
    }

    #[inline(always)]
    fn meet(self, (ray, low): &Self::Boxes, node: &Node, limit: f32) -> (u32, Keys) {
        let (mut near, mut far) = ([*low; WIDTH], [limit; WIDTH]);
        for axis in 0..3 {
            let first = ray.first[axis] & 1;
            let (enter, leave) = (&node.planes[axis][first], &node.planes[axis][first ^ 1]);
            for i in 0..WIDTH {
                let t = enter[i] * ray.inverse[axis] + ray.enter[axis];
                near[i] = if t > near[i] { t } else { near[i] };
                let t = leave[i] * ray.inverse[axis] + ray.leave[axis];
                far[i] = if t < far[i] { t } else { far[i] };
            }
        }
        let (mut mask, mut keys) = (0, Keys::NONE);
        for i in 0..WIDTH {
            let met = near[i] <= far[i];
            mask |= u32::from(met) << i;
            let key = near[i].to_bits() as i32 & !LANE | i as i32;
            keys.0[i] = if met { key } else { NONE };
        }
        (mask, keys)
    }

    #[inline(always)]
    fn nearest(self, mut keys: Keys) -> (i32, Keys) {
        let least = keys.0.into_iter().fold(NONE, i32::min);
        for key in &mut keys.0 {
            *key = if *key == least { NONE } else { *key };
        }
        (least, keys)
    }

    #[inline(always)]
    fn load(self, keys: &Keys) -> Keys {
        *keys
    }

    #[inline(always)]
    fn store(self, keys: Keys, to: &mut Keys) {
        *to = keys;
    }

    #[inline(always)]
    fn candidates(self, line: &Line, block: &Block) -> (u32, Seen) {
        let [x, y, z] = line.axes;
        let mut depths = [[0.0; LANES]; 3];
        let mut across = [[[0.0; LANES]; 2]; 3];
        for ((corner, seen), depths) in block.corners.iter().zip(&mut across).zip(&mut depths) {
            for i in 0..LANES {
                let depth = corner[z][i] - line.origin[z];
                seen[0][i] = (corner[x][i] - line.origin[x]) - line.shear.x * depth;
                seen[1][i] = (corner[y][i] - line.origin[y]) - line.shear.y * depth;
                depths[i] = depth;
            }
        }
        let [a, b, c] = &across;
        let areas = [cross(c, b), cross(a, c), cross(b, a)];
        let mask = lanes(|i| {
            let all = areas.iter().all(|area| area[i] >= 0.0);
            all | areas.iter().all(|area| area[i] <= 0.0)
        });
        (mask, Seen { depths, areas })
    }

    #[inline(always)]
    fn clear(self, line: &Line, seen: &Seen) -> (u32, Passages) {
        let ([u, v, w], [a, b, c]) = (&seen.areas, &seen.depths);
        let clear = lanes(|i| {
            let all = seen.areas.iter().all(|area| area[i] > 0.0);
            all | seen.areas.iter().all(|area| area[i] < 0.0)
        });
        let t = std::array::from_fn(|i| {
            let [a_t, b_t, c_t] = [a[i], b[i], c[i]].map(|depth| depth * line.inverse_z);
            (u[i] * a_t + v[i] * b_t + w[i] * c_t) / (u[i] + v[i] + w[i])
        });
        (clear, Passages { t, areas: seen.areas })
    }
}

/// Corners' distances along the third axis, and twice the areas between pairs of
/// them as the line sees them.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Seen {
    depths: [[f64; LANES]; 3],
    areas: [[f64; LANES]; 3],
}

#[inline(always)]
fn cross(p: &[[f64; LANES]; 2], q: &[[f64; LANES]; 2]) -> [f64; LANES] {
    std::array::from_fn(|i| p[0][i] * q[1][i] - p[1][i] * q[0][i])
}

/// A bit for each lane.
#[inline(always)]
fn lanes(is: impl Fn(usize) -> bool) -> u32 {
    (0..LANES).fold(0, |mask, i| mask | u32::from(is(i)) << i)
}
