//! What an image is traced from, for everyone who traces a part of it.

use super::layers::RequestedLayers;
use crate::request::Request;
use crate::transport::tracer::Tracer;
use scenes::Camera;
use std::sync::atomic::{AtomicBool, Ordering};

/// How a long rendering is observed and stopped.
#[derive(Clone, Copy, Default)]
pub struct Watch<'a> {
    /// Called with the share that is done, 0 to 1, from any thread.
    pub progress: Option<&'a (dyn Fn(f64) + Sync)>,
    /// Set to true to stop; the rendering then ends in [`crate::Error::Cancelled`].
    pub cancel: Option<&'a AtomicBool>,
}

impl Watch<'_> {
    /// The rendering is to end.
    pub(crate) fn is_cancelled(&self) -> bool {
        self.cancel.is_some_and(|flag| flag.load(Ordering::Relaxed))
    }
}

/// Everything a row of pixels needs.
pub(crate) struct ImageRun<'a> {
    pub(crate) tracer: &'a Tracer<'a>,
    pub(crate) camera: Camera,
    pub(crate) request: &'a Request,
    pub(crate) layers: &'a RequestedLayers,
    pub(crate) watch: Watch<'a>,
}
