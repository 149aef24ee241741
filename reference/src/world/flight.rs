//! A ray in flight, and how it ends.

use super::crossing::{Crossing, Departed, Spot};
use glam::DVec3;

/// What a ray knows about its origin.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Start {
    /// In free space: at the camera.
    Free,
    /// On a surface, clearly.
    Surface(Departed),
    /// On or near surfaces that rounding cannot tell apart.
    Unclear,
}

/// A ray about to be traced.
#[derive(Clone, Debug)]
pub(crate) struct Flight<W> {
    pub(crate) origin: DVec3,
    pub(crate) direction: DVec3,
    pub(crate) start: Start,
    /// Where it is just after its origin.
    pub(crate) winding: W,
}

/// A boundary at which the index or the owner changes.
#[derive(Clone, Debug)]
pub(crate) struct Event<W> {
    pub(crate) id: u32,
    pub(crate) spot: Spot,
    /// The ray goes against the surface's outward side.
    pub(crate) entering: bool,
    /// No other surface coincides.
    pub(crate) single: bool,
    /// A gap of air without thickness: the same medium on both sides.
    pub(crate) gap: bool,
    pub(crate) before: W,
    pub(crate) after: W,
}

/// How a flight ends.
#[derive(Clone, Debug)]
pub(crate) enum End<W> {
    /// Nothing more in the way.
    Environment,
    /// A change of index.
    Event(Event<W>),
    /// An opaque surface.
    Opaque(Crossing),
}
