//! Every file of WGSL in this crate, by its name. A name is unique, whatever
//! folder it is in.

/// A file: its name without the ending, and its text.
pub(crate) type File = (&'static str, &'static str);

/// All of them, sorted by name; found by the build script.
pub(crate) static FILES: &[File] = include!(concat!(env!("OUT_DIR"), "/shaders.rs"));
