//! The inner loops in AVX2, chosen when the program runs.
#![allow(unsafe_code, reason = "vector instructions; every use is behind a check of the CPU")]

use super::box_ray::BoxRay;
use super::kernel::{Kernel, Passages, Traversal};
use super::node::{Block, LANES, Node};
use super::stack::{Keys, LANE, NONE};
use crate::geometry::line::Line;
use std::arch::x86_64::*;

/// 256-bit vectors. Made only where the CPU has AVX2 and FMA.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Avx2(());

#[derive(Clone, Copy)]
pub(crate) struct Boxes {
    inverse: [__m256; 3],
    enter: [__m256; 3],
    leave: [__m256; 3],
    first: [usize; 3],
    low: __m256,
}

#[derive(Clone, Copy)]
pub(crate) struct Lanes {
    origin: [__m256d; 3],
    shear: [__m256d; 2],
    inverse_z: __m256d,
    axes: [usize; 3],
}

/// What [`super::kernel::Seen`] says, vector by vector.
#[derive(Clone, Copy)]
pub(crate) struct Seen {
    depths: [__m256d; 3],
    areas: [__m256d; 3],
}

impl Kernel for Avx2 {
    type Boxes = Boxes;
    type Lanes = Lanes;
    type Seen = Seen;
    type Order = __m256i;

    #[inline(always)]
    fn boxes(self, ray: &BoxRay, low: f32) -> Boxes {
        // SAFETY: `self` exists, so the CPU has AVX2 and FMA.
        unsafe {
            Boxes {
                inverse: splat3(ray.inverse),
                enter: splat3(ray.enter),
                leave: splat3(ray.leave),
                first: ray.first,
                low: _mm256_set1_ps(low),
            }
        }
    }

    #[inline(always)]
    fn lanes(self, line: &Line) -> Lanes {
        let [x, y, z] = line.axes;
        // SAFETY: `self` exists, so the CPU has AVX2 and FMA.
        unsafe {
            Lanes {
                origin: [
                    _mm256_set1_pd(line.origin[x]),
                    _mm256_set1_pd(line.origin[y]),
                    _mm256_set1_pd(line.origin[z]),
                ],
                shear: [_mm256_set1_pd(line.shear.x), _mm256_set1_pd(line.shear.y)],
                inverse_z: _mm256_set1_pd(line.inverse_z),
                axes: line.axes,
            }
        }
    }

    #[inline(always)]
    fn meet(self, ray: &Boxes, node: &Node, limit: f32) -> (u32, __m256i) {
        // SAFETY: `self` exists, so the CPU has AVX2 and FMA.
        unsafe {
            let (x0, x1) = passages(ray, node, 0);
            let (y0, y1) = passages(ray, node, 1);
            let (z0, z1) = passages(ray, node, 2);
            let near = _mm256_max_ps(_mm256_max_ps(x0, y0), _mm256_max_ps(z0, ray.low));
            let limit = _mm256_set1_ps(limit);
            let far = _mm256_min_ps(_mm256_min_ps(x1, y1), _mm256_min_ps(z1, limit));
            let met = _mm256_cmp_ps::<_CMP_LE_OQ>(near, far);
            let bits = _mm256_andnot_si256(_mm256_set1_epi32(LANE), _mm256_castps_si256(near));
            let keys = _mm256_or_si256(bits, _mm256_setr_epi32(0, 1, 2, 3, 4, 5, 6, 7));
            let none = _mm256_set1_epi32(NONE);
            let keys = _mm256_blendv_epi8(none, keys, _mm256_castps_si256(met));
            (_mm256_movemask_ps(met) as u32, keys)
        }
    }

    #[inline(always)]
    fn nearest(self, keys: __m256i) -> (i32, __m256i) {
        // SAFETY: `self` exists, so the CPU has AVX2 and FMA.
        unsafe {
            let high = _mm256_extracti128_si256::<1>(keys);
            let four = _mm_min_epi32(_mm256_castsi256_si128(keys), high);
            let two = _mm_min_epi32(four, _mm_shuffle_epi32::<0b01_00_11_10>(four));
            let least = _mm_min_epi32(two, _mm_shuffle_epi32::<0b10_11_00_01>(two));
            let taken = _mm256_cmpeq_epi32(keys, _mm256_broadcastd_epi32(least));
            let others = _mm256_blendv_epi8(keys, _mm256_set1_epi32(NONE), taken);
            (_mm_cvtsi128_si32(least), others)
        }
    }

    #[inline(always)]
    fn load(self, keys: &Keys) -> __m256i {
        // SAFETY: `self` exists, so the CPU has AVX2; keys are aligned.
        unsafe { _mm256_load_si256(keys.0.as_ptr().cast()) }
    }

    #[inline(always)]
    fn store(self, keys: __m256i, to: &mut Keys) {
        // SAFETY: `self` exists, so the CPU has AVX2; keys are aligned.
        unsafe { _mm256_store_si256(to.0.as_mut_ptr().cast(), keys) }
    }

    #[inline(always)]
    fn candidates(self, line: &Lanes, block: &Block) -> (u32, Seen) {
        // SAFETY: `self` exists, so the CPU has AVX2 and FMA.
        unsafe {
            let (a, b, c) = (see(line, block, 0), see(line, block, 1), see(line, block, 2));
            let areas @ [u, v, w] = [cross(c, b), cross(a, c), cross(b, a)];
            let zero = _mm256_setzero_pd();
            let least = _mm256_min_pd(_mm256_min_pd(u, v), w);
            let most = _mm256_max_pd(_mm256_max_pd(u, v), w);
            let all = _mm256_cmp_pd::<_CMP_GE_OQ>(least, zero);
            let none = _mm256_cmp_pd::<_CMP_LE_OQ>(most, zero);
            let mask = _mm256_movemask_pd(_mm256_or_pd(all, none)) as u32;
            (mask, Seen { depths: [a.2, b.2, c.2], areas })
        }
    }

    #[inline(always)]
    fn clear(self, line: &Lanes, seen: &Seen) -> (u32, Passages) {
        let [u, v, w] = seen.areas;
        // SAFETY: `self` exists, so the CPU has AVX2 and FMA.
        unsafe {
            let zero = _mm256_setzero_pd();
            let least = _mm256_min_pd(_mm256_min_pd(u, v), w);
            let most = _mm256_max_pd(_mm256_max_pd(u, v), w);
            let all = _mm256_cmp_pd::<_CMP_GT_OQ>(least, zero);
            let none = _mm256_cmp_pd::<_CMP_LT_OQ>(most, zero);
            let [a_t, b_t, c_t] = seen.depths.map(|depth| _mm256_mul_pd(depth, line.inverse_z));
            let of_two = _mm256_add_pd(_mm256_mul_pd(u, a_t), _mm256_mul_pd(v, b_t));
            let of_all = _mm256_add_pd(of_two, _mm256_mul_pd(w, c_t));
            let sum = _mm256_add_pd(_mm256_add_pd(u, v), w);
            let passages = Passages {
                t: to_array(_mm256_div_pd(of_all, sum)),
                areas: [to_array(u), to_array(v), to_array(w)],
            };
            (_mm256_movemask_pd(_mm256_or_pd(all, none)) as u32, passages)
        }
    }
}

#[inline(always)]
unsafe fn splat3([x, y, z]: [f32; 3]) -> [__m256; 3] {
    unsafe { [_mm256_set1_ps(x), _mm256_set1_ps(y), _mm256_set1_ps(z)] }
}

/// Where the line enters and leaves the children's slabs of one axis. Boxes only
/// prune, so they may be rounded once instead of twice; triangles may not.
#[inline(always)]
unsafe fn passages(ray: &Boxes, node: &Node, axis: usize) -> (__m256, __m256) {
    let first = ray.first[axis] & 1;
    let planes = &node.planes[axis];
    unsafe {
        let enter = _mm256_load_ps(planes[first].as_ptr());
        let leave = _mm256_load_ps(planes[first ^ 1].as_ptr());
        (
            _mm256_fmadd_ps(enter, ray.inverse[axis], ray.enter[axis]),
            _mm256_fmadd_ps(leave, ray.inverse[axis], ray.leave[axis]),
        )
    }
}

/// [`Line::see`], with the depth in place of t.
#[inline(always)]
unsafe fn see(line: &Lanes, block: &Block, corner: usize) -> (__m256d, __m256d, __m256d) {
    let corner = &block.corners[corner];
    let [x, y, z] = line.axes;
    unsafe {
        let depth = _mm256_sub_pd(_mm256_load_pd(corner[z].as_ptr()), line.origin[2]);
        let across = _mm256_sub_pd(_mm256_load_pd(corner[x].as_ptr()), line.origin[0]);
        let along = _mm256_sub_pd(_mm256_load_pd(corner[y].as_ptr()), line.origin[1]);
        (
            _mm256_sub_pd(across, _mm256_mul_pd(line.shear[0], depth)),
            _mm256_sub_pd(along, _mm256_mul_pd(line.shear[1], depth)),
            depth,
        )
    }
}

#[inline(always)]
unsafe fn to_array(lanes: __m256d) -> [f64; LANES] {
    let mut array = [0.0; LANES];
    unsafe { _mm256_storeu_pd(array.as_mut_ptr(), lanes) };
    array
}

#[inline(always)]
unsafe fn cross(p: (__m256d, __m256d, __m256d), q: (__m256d, __m256d, __m256d)) -> __m256d {
    unsafe { _mm256_sub_pd(_mm256_mul_pd(p.0, q.1), _mm256_mul_pd(p.1, q.0)) }
}

impl Avx2 {
    pub(crate) fn detect() -> Option<Self> {
        let has = is_x86_feature_detected!("avx2") && is_x86_feature_detected!("fma");
        has.then_some(Self(()))
    }

    #[inline(always)]
    pub(crate) fn run<J: Traversal>(self, traversal: J) -> J::Output {
        // SAFETY: `self` exists, so the CPU has AVX2 and FMA.
        unsafe { avx2(self, traversal) }
    }
}

#[target_feature(enable = "avx2,fma")]
unsafe fn avx2<J: Traversal>(kernel: Avx2, traversal: J) -> J::Output {
    traversal.run(kernel)
}
