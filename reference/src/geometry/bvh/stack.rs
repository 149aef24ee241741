//! Children still to visit.

use super::node::{Links, WIDTH};

/// What no key is as large as.
pub(crate) const NONE: i32 = i32::MAX;
/// The bits of a key that say which child.
pub(crate) const LANE: i32 = WIDTH as i32 - 1;

/// For each child of a node that is still to visit, the bits of the f32 at which
/// the line meets it, its number in place of the last three: near ones are less.
#[derive(Clone, Copy, Debug)]
#[repr(C, align(32))]
pub(crate) struct Keys(pub(crate) [i32; WIDTH]);

impl Keys {
    pub(crate) const NONE: Self = Self([NONE; WIDTH]);
}

/// No less than the key of any child met before `limit`.
#[inline(always)]
pub(crate) fn latest(limit: f32) -> i32 {
    if limit > 0.0 { limit.to_bits() as i32 | LANE } else { LANE }
}

/// The children of a node, and which of them are still to visit.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Siblings {
    pub(crate) keys: Keys,
    pub(crate) links: Links,
}

/// Kept between rays, so that it seldom grows.
#[derive(Clone, Debug, Default)]
pub(crate) struct Stack {
    levels: Vec<Siblings>,
    used: usize,
}

impl Stack {
    #[inline(always)]
    pub(crate) fn clear(&mut self) {
        self.used = 0;
    }

    /// The children of one more node, on top.
    #[inline(always)]
    pub(crate) fn push(&mut self, links: Links) -> &mut Keys {
        if self.used == self.levels.len() {
            self.grow();
        }
        let siblings = &mut self.levels[self.used];
        siblings.links = links;
        self.used += 1;
        &mut siblings.keys
    }

    #[inline(always)]
    pub(crate) fn top(&mut self) -> Option<&mut Siblings> {
        self.levels[..self.used].last_mut()
    }

    #[inline(always)]
    pub(crate) fn pop(&mut self) {
        self.used = self.used.saturating_sub(1);
    }

    #[cold]
    fn grow(&mut self) {
        self.levels.resize(2 * self.used + 16, Siblings { keys: Keys::NONE, links: Links::ROOT });
    }
}
