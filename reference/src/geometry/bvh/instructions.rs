//! Which instructions run the inner loops: decided by the CPU the program is on.

#[cfg(target_arch = "x86_64")]
use super::avx2::Avx2;
use super::kernel::{Portable, Traversal};

/// Sets of instructions that the tree knows. All answer with the same bits.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub enum Instructions {
    /// What every CPU of the target has.
    Portable,
    /// AVX2 and FMA.
    Avx2,
}

impl Instructions {
    /// Those that renderings use on this CPU.
    #[must_use]
    pub fn best() -> Self {
        match Detected::best() {
            Detected::Portable => Self::Portable,
            #[cfg(target_arch = "x86_64")]
            Detected::Avx2(_) => Self::Avx2,
        }
    }

    /// Those that this CPU has, the oldest first.
    #[must_use]
    pub fn available() -> Vec<Self> {
        let all = [Self::Portable, Self::Avx2];
        all.into_iter().filter(|kind| Detected::new(*kind).is_some()).collect()
    }
}

/// Instructions that this CPU has.
#[derive(Clone, Copy, Debug)]
pub(crate) enum Detected {
    Portable,
    #[cfg(target_arch = "x86_64")]
    Avx2(Avx2),
}

impl Detected {
    /// What the CPU has of a kind.
    pub(crate) fn new(kind: Instructions) -> Option<Self> {
        match kind {
            Instructions::Portable => Some(Self::Portable),
            #[cfg(target_arch = "x86_64")]
            Instructions::Avx2 => Avx2::detect().map(Self::Avx2),
            #[cfg(not(target_arch = "x86_64"))]
            _ => None,
        }
    }

    /// AVX2 where the CPU has it. AVX-512 was measured not to be faster, with
    /// vectors of 256 bits and of 512.
    pub(crate) fn best() -> Self {
        Self::new(Instructions::Avx2).unwrap_or(Self::Portable)
    }

    #[inline(always)]
    pub(crate) fn run<J: Traversal>(self, traversal: J) -> J::Output {
        match self {
            Self::Portable => traversal.run(Portable),
            #[cfg(target_arch = "x86_64")]
            Self::Avx2(kernel) => kernel.run(traversal),
        }
    }
}
