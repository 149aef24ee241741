//! Children still to visit.

use super::node::Child;

/// Grows beyond its fixed part only in hostile trees. Kept between rays,
/// because clearing it would cost as much as a short walk.
#[derive(Clone, Debug)]
pub(crate) struct Stack {
    fixed: [Entry; 192],
    used: usize,
    spill: Vec<Entry>,
}

/// Where the line meets a child, in the high half as the bits of an f32, and
/// the child. Near ones compare less.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, PartialOrd, Ord)]
pub(crate) struct Entry(i64);

impl Entry {
    #[inline(always)]
    pub(crate) fn new(near: f32, child: Child) -> Self {
        Self(((near.to_bits() as i32 as i64) << 32) | i64::from(child.0))
    }

    #[inline(always)]
    pub(crate) fn near(self) -> f32 {
        f32::from_bits((self.0 >> 32) as u32)
    }

    #[inline(always)]
    pub(crate) fn child(self) -> Child {
        Child(self.0 as u32)
    }
}

impl Default for Stack {
    fn default() -> Self {
        Self { fixed: [Entry::default(); 192], used: 0, spill: Vec::new() }
    }
}

impl Stack {
    #[inline(always)]
    pub(crate) fn clear(&mut self) {
        self.used = 0;
        self.spill.clear();
    }

    #[inline(always)]
    pub(crate) fn push(&mut self, entry: Entry) {
        if let Some(slot) = self.fixed.get_mut(self.used) {
            *slot = entry;
            self.used += 1;
        } else {
            self.spill.push(entry);
        }
    }

    #[inline(always)]
    pub(crate) fn pop(&mut self) -> Option<Entry> {
        if let Some(entry) = self.spill.pop() {
            return Some(entry);
        }
        self.used = self.used.checked_sub(1)?;
        Some(self.fixed[self.used])
    }
}
