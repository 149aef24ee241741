//! What is to be traced, for everyone who traces a part of it.

use crate::image::layers::Columns;
use crate::request::Request;
use crate::transport::tracer::Tracer;
use scenes::Camera;
use std::sync::atomic::AtomicBool;

/// How a long rendering is observed and stopped.
#[derive(Clone, Copy, Default)]
pub struct Watch<'a> {
    /// Called with the share that is done, 0 to 1, from any thread.
    pub progress: Option<&'a (dyn Fn(f64) + Sync)>,
    /// Set to true to stop; the rendering then ends in [`crate::Error::Cancelled`].
    pub cancel: Option<&'a AtomicBool>,
}

/// Everything a row needs.
pub(crate) struct Job<'a> {
    pub(crate) tracer: &'a Tracer<'a>,
    pub(crate) camera: Camera,
    pub(crate) request: &'a Request,
    pub(crate) columns: &'a Columns,
    pub(crate) watch: Watch<'a>,
}
