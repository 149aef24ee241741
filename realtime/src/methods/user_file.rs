//! A method from a user's own file of WGSL, without compiling anything in Rust.
//!
//! The file defines `fn trace(pixel: vec2i, v_ws: vec3f, surface: Surface) -> Trace`
//! as the built-in methods do (see `shaders/shade/shade.wgsl`). It may call everything
//! they call; what it reads, directly or not, is what will be drawn before it.
//! Its head says what it is and what it needs, as theirs do (see `wgsl/source.rs`);
//! without a line of needs it may call everything in `shaders/methods/anything.wgsl`.
//! A parameter `strength` of its head is a constant `STRENGTH` in its WGSL.

use super::{METHODS, Method, Parameter, declared};
use crate::error::Error;
use crate::wgsl::{self, Source};
use std::collections::BTreeMap;
use std::path::Path;
use std::sync::{Mutex, PoisonError};

/// Files that were read, by path. A method lives as long as the program: they
/// are few and small.
static READ: Mutex<BTreeMap<String, &'static Method>> = Mutex::new(BTreeMap::new());

/// A method that was read before, by its id.
pub(super) fn known(id: &str) -> Option<&'static Method> {
    let read = READ.lock().unwrap_or_else(PoisonError::into_inner);
    read.values().find(|method| method.id == id).copied()
}

/// The method in a file.
pub(super) fn method(path: &str) -> Result<&'static Method, Error> {
    let mut read = READ.lock().unwrap_or_else(PoisonError::into_inner);
    if let Some(method) = read.get(path) {
        return Ok(method);
    }
    let fail = |why: String| Error::MethodFile { path: path.to_owned(), why };
    let text = std::fs::read_to_string(path).map_err(|error| fail(error.to_string()))?;
    if !text.contains("fn trace(") {
        let wanted = "fn trace(pixel: vec2i, v_ws: vec3f, surface: Surface) -> Trace";
        return Err(fail(format!("it does not define `{wanted}`")));
    }
    let stem = Path::new(path).file_stem().and_then(|stem| stem.to_str()).unwrap_or("method");
    let taken = METHODS.iter().map(|method| method.id).chain(read.values().map(|method| method.id));
    if taken.into_iter().any(|id| id == stem) {
        return Err(fail(format!("a method is called \"{stem}\" already; rename the file")));
    }
    let read_from = Method::from_source(stem.to_owned().leak(), Source::new(path, text));
    if let Some(file) = read_from.source.head().at_vertices
        && wgsl::named(&file).is_none()
    {
        return Err(fail(format!("`// at vertices: {file}`: there is no such file")));
    }
    let parameters = parameters(&read_from, fail)?;
    let title = if read_from.title.is_empty() { "a method from a file" } else { read_from.title };
    let method = Box::leak(Box::new(Method { title, parameters, from_user: true, ..read_from }));
    read.insert(path.to_owned(), method);
    Ok(method)
}

/// What its head declares.
fn parameters(
    method: &Method,
    fail: impl Fn(String) -> Error,
) -> Result<&'static [Parameter], Error> {
    let mut found: Vec<Parameter> = Vec::new();
    for (line, text) in method.source.head().parameters {
        let parameter =
            declared::parameter(&text).map_err(|why| fail(format!("line {line}: {why}")))?;
        if found.iter().any(|known| known.name == parameter.name) {
            return Err(fail(format!(
                "line {line}: there are two parameters \"{}\"",
                parameter.name
            )));
        }
        found.push(parameter);
    }
    Ok(found.leak())
}
