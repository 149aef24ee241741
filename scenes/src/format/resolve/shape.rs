//! Shapes, each made or read once however often it appears.

use super::super::choice::NameOr;
use super::super::document::{Document, ShapeText};
use super::super::error::{At, Problem};
use super::{only_one, span_of};
use crate::{Shape, generate};
use std::collections::BTreeMap;
use std::path::{Path, PathBuf};
use std::sync::Arc;
use toml::Spanned;

/// A shape with the name it has in messages.
#[derive(Clone)]
pub(super) struct Found {
    pub(super) shape: Arc<Shape>,
    pub(super) name: String,
    /// An infinite sheet without an inside.
    pub(super) is_plane: bool,
}

/// Named shapes and those that were read so far.
pub(super) struct Shapes<'a> {
    named: &'a BTreeMap<String, Spanned<ShapeText>>,
    base: &'a Path,
    made: BTreeMap<(&'static str, String), Arc<Shape>>,
    instances: BTreeMap<String, Found>,
    /// What the readers of files want the user to know.
    pub(super) warnings: Vec<String>,
}

impl<'a> Shapes<'a> {
    pub(super) fn new(document: &'a Document, base: &'a Path) -> Self {
        let (made, instances) = (BTreeMap::new(), BTreeMap::new());
        Self { named: &document.shape, base, made, instances, warnings: Vec::new() }
    }

    /// Files that were read.
    pub(super) fn files(&self) -> impl Iterator<Item = PathBuf> + '_ {
        self.made.keys().filter(|(kind, _)| *kind == "obj").map(|(_, name)| self.base.join(name))
    }

    /// The shape that is named or written in place.
    pub(super) fn find(&mut self, shape: &Spanned<NameOr<ShapeText>>) -> Result<Found, At> {
        match shape.get_ref() {
            NameOr::Inline(text) => self.make(shape.span(), text),
            NameOr::Name(name) => {
                if let Some(found) = self.instances.get(name) {
                    return Ok(found.clone());
                }
                let Some(text) = self.named.get(name) else {
                    return Err(self.unknown(name, shape));
                };
                let mut found = self.make(text.span(), text.get_ref())?;
                found.name.clone_from(name);
                self.instances.insert(name.clone(), found.clone());
                Ok(found)
            }
        }
    }

    fn unknown(&self, name: &str, shape: &Spanned<NameOr<ShapeText>>) -> At {
        let known = self.named.keys().cloned().collect::<Vec<_>>().join(", ");
        let known = if known.is_empty() { String::new() } else { format!("one of {known}, ") };
        let builtin = match generate::NAMES.iter().any(|(known, _)| *known == name) {
            true => format!(", or {{ builtin = \"{name}\" }}"),
            false => String::new(),
        };
        At::meaning(
            shape.span(),
            format!("no shape is called \"{name}\""),
            format!(
                "write {known}add [shape.{name}], or write it in place: \
                 {{ sphere = {{ radius_m = 1.0 }} }}{builtin}"
            ),
        )
    }

    fn make(&mut self, whole: std::ops::Range<usize>, text: &ShapeText) -> Result<Found, At> {
        let options = [
            ("obj", span_of(&text.obj)),
            ("builtin", span_of(&text.builtin)),
            ("sphere", span_of(&text.sphere)),
            ("slab", span_of(&text.slab)),
            ("box", span_of(&text.cuboid)),
            ("cylinder", span_of(&text.cylinder)),
            ("half_space", span_of(&text.half_space)),
            ("plane", span_of(&text.plane)),
        ];
        let kind = only_one(&whole, &options, "sphere = { radius_m = 1.0 }")?;
        let is_plane = kind == "plane";
        if let Some(path) = &text.obj {
            let name = Path::new(path.get_ref()).file_stem().unwrap_or_default();
            let name = name.to_string_lossy().into_owned();
            return Ok(Found { shape: self.read(path)?, name, is_plane });
        }
        if let Some(builtin) = &text.builtin {
            let name = builtin.get_ref().clone();
            return Ok(Found { shape: self.generate(builtin)?, name, is_plane });
        }
        Ok(Found { shape: Arc::new(analytic(text)), name: kind.to_owned(), is_plane })
    }

    fn read(&mut self, path: &Spanned<String>) -> Result<Arc<Shape>, At> {
        let key = ("obj", path.get_ref().clone());
        if let Some(shape) = self.made.get(&key) {
            return Ok(Arc::clone(shape));
        }
        let model = crate::obj::read(&self.base.join(path.get_ref()))
            .map_err(|error| At { span: path.span(), problem: Problem::Mesh(error) })?;
        let of_file = |warning: &String| format!("{}: {warning}", path.get_ref());
        self.warnings.extend(model.warnings.iter().map(of_file));
        let shape = Arc::new(Shape::Mesh(model.mesh));
        self.made.insert(key, Arc::clone(&shape));
        Ok(shape)
    }

    fn generate(&mut self, name: &Spanned<String>) -> Result<Arc<Shape>, At> {
        let key = ("builtin", name.get_ref().clone());
        if let Some(shape) = self.made.get(&key) {
            return Ok(Arc::clone(shape));
        }
        let mesh = generate::builtin(name.get_ref()).ok_or_else(|| {
            let known: Vec<&str> = generate::NAMES.iter().map(|(name, _)| *name).collect();
            At::meaning(
                name.span(),
                format!("no built-in shape is called \"{}\"", name.get_ref()),
                format!("write one of {}", known.join(", ")),
            )
        })?;
        let shape = Arc::new(Shape::Mesh(mesh));
        self.made.insert(key, Arc::clone(&shape));
        Ok(shape)
    }
}

/// The shapes that need no mesh.
fn analytic(text: &ShapeText) -> Shape {
    if let Some(sphere) = &text.sphere {
        return Shape::Sphere { radius_m: sphere.get_ref().radius_m.0 };
    }
    if let Some(slab) = &text.slab {
        return Shape::Slab { thickness_m: slab.get_ref().thickness_m.0 };
    }
    if let Some(cuboid) = &text.cuboid {
        return Shape::Box { half_extent_m: cuboid.get_ref().half_extent_m.0 };
    }
    if let Some(cylinder) = text.cylinder.as_ref().map(Spanned::get_ref) {
        let (radius_m, half_height_m) = (cylinder.radius_m.0, cylinder.half_height_m.0);
        return Shape::Cylinder { radius_m, half_height_m };
    }
    Shape::HalfSpace
}
