//! Where a ray is: winding counts per kind of solid, and which medium they make.
//!
//! A class is a pair (medium, priority); all objects of one class share a
//! count, so overlapping parts of one glass are one glass. Classes are sorted
//! by precedence: the first with a positive count says what is there.

use scenes::MediumId;

/// What a ray is inside of, between surfaces.
pub(crate) trait Winding: Clone {
    /// There is one body and it is convex: outside of it nothing can be hit
    /// again.
    const CONVEX: bool;
    /// Outside everything.
    fn outside() -> Self;
    /// Count of a class.
    fn get(&self, class: usize) -> i16;
    /// Replaces the count of a class.
    fn set(&mut self, class: usize, count: i16);
    /// The class that fills the place; `None` in the surroundings.
    fn top(&self) -> Option<usize>;
    /// True when every count is zero.
    fn is_outside(&self) -> bool;

    /// Passes a surface of a class.
    fn cross(&mut self, class: usize, entering: bool) {
        self.set(class, self.get(class).saturating_add(if entering { 1 } else { -1 }));
    }
}

/// One convex body: in it or not.
#[derive(Clone, Copy, Debug)]
pub(crate) struct InOrOut(bool);

impl Winding for InOrOut {
    const CONVEX: bool = true;

    fn outside() -> Self {
        Self(false)
    }

    fn get(&self, _class: usize) -> i16 {
        i16::from(self.0)
    }

    fn set(&mut self, _class: usize, count: i16) {
        self.0 = count > 0;
    }

    fn top(&self) -> Option<usize> {
        self.0.then_some(0)
    }

    fn is_outside(&self) -> bool {
        !self.0
    }
}

/// Up to N classes.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Counts<const N: usize>([i16; N]);

impl<const N: usize> Winding for Counts<N> {
    const CONVEX: bool = false;

    fn outside() -> Self {
        Self([0; N])
    }

    fn get(&self, class: usize) -> i16 {
        self.0[class]
    }

    fn set(&mut self, class: usize, count: i16) {
        self.0[class] = count;
    }

    fn top(&self) -> Option<usize> {
        self.0.iter().position(|count| *count > 0)
    }

    fn is_outside(&self) -> bool {
        self.0.iter().all(|count| *count == 0)
    }
}

/// Indices of refraction by class, the surroundings last.
#[derive(Clone, Debug)]
pub(crate) struct Indices {
    pub(crate) eta: Vec<f64>,
    pub(crate) medium: Vec<MediumId>,
}

impl Indices {
    /// Where in the lists a place is.
    fn of<W: Winding>(&self, winding: &W) -> usize {
        winding.top().unwrap_or(self.eta.len() - 1)
    }

    /// The absolute index of refraction of a place.
    pub(crate) fn eta<W: Winding>(&self, winding: &W) -> f64 {
        self.eta[self.of(winding)]
    }

    /// What a place is made of.
    pub(crate) fn medium<W: Winding>(&self, winding: &W) -> MediumId {
        self.medium[self.of(winding)]
    }
}
