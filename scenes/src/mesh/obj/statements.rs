//! What the lines of a file state, every number and index checked.

use super::Bad;
use super::lines::lines;
use glam::DVec3;
use std::collections::BTreeMap;
use std::fmt::Write;
use std::path::Path;

/// A corner of a face.
#[derive(Clone, Copy, Debug)]
pub(super) struct Corner {
    /// Index into the positions.
    pub(super) position: u32,
    /// Index into the normals, if the corner names one.
    pub(super) normal: Option<u32>,
}

/// A file's vertices, normals and faces, as written.
#[derive(Default)]
pub(super) struct Statements {
    /// Finite; those that a face names.
    pub(super) positions: Vec<DVec3>,
    /// Any length, zero and NaN among them; those that a face names.
    pub(super) normals: Vec<DVec3>,
    /// Normals that the file writes, named or not.
    pub(super) normals_written: usize,
    /// Corners of all faces, one face after the other.
    pub(super) corners: Vec<Corner>,
    /// Where each face ends in `corners`.
    pub(super) ends: Vec<usize>,
    /// Faces of one or two corners.
    pub(super) too_small: usize,
    /// Statements that make surfaces and are not read, and how often each occurs.
    pub(super) unread: BTreeMap<&'static str, usize>,
}

impl Statements {
    /// Checks every line, then lets `tobj` read what was found good.
    pub(super) fn read(bytes: &[u8]) -> Result<Self, Bad> {
        let mut checked = Checked::default();
        for (line, text) in lines(bytes) {
            checked.add(&text).map_err(|what| Bad { line: Some(line), what })?;
        }
        read_checked(checked)
    }

    /// The faces, each as its corners.
    pub(super) fn faces(&self) -> impl Iterator<Item = &[Corner]> {
        let starts = std::iter::once(0).chain(self.ends.iter().copied());
        starts.zip(&self.ends).map(|(start, end)| &self.corners[start..*end])
    }
}

/// Free-form geometry, which is not read.
const FREE_FORM: [&str; 6] = ["curv", "curv2", "surf", "bzp", "bsp", "cdp"];

/// What corners without a normal name in the checked text. `tobj` would give
/// them the normal of the corner before. No normal of a file looks like it: those
/// that are not finite are handed on as NaN.
const NO_NORMAL: DVec3 = DVec3::NEG_INFINITY;

/// What lines state, in words that leave nothing to the reader's choice: indices
/// from 1, a normal at every corner, no groups, lines or points.
struct Checked {
    text: String,
    positions: usize,
    textures: usize,
    normals: usize,
    too_small: usize,
    unread: BTreeMap<&'static str, usize>,
}

impl Default for Checked {
    fn default() -> Self {
        Self {
            text: "vn -inf -inf -inf\n".to_owned(),
            positions: 0,
            textures: 0,
            normals: 0,
            too_small: 0,
            unread: BTreeMap::new(),
        }
    }
}

impl Checked {
    fn add(&mut self, line: &str) -> Result<(), String> {
        let mut words = line.split_whitespace();
        match words.next() {
            Some("v") => {
                let position = numbers(words, "v x y z", number)?;
                if !position.is_finite() {
                    return Err(format!("{position} is not finite; write v x y z"));
                }
                self.state("v", position);
                self.positions += 1;
            }
            Some("vn") => {
                let normal = numbers(words, "vn x y z", number_or_nan)?;
                self.state("vn", if normal.is_finite() { normal } else { DVec3::NAN });
                self.normals += 1;
            }
            Some("vt") => self.textures += 1,
            // `fo` is an old name of `f`; `l` and `p` are lines and points, which are no
            // part of a body.
            Some("f" | "fo") => self.add_face(words)?,
            Some(word) => {
                if let Some(known) = FREE_FORM.iter().find(|known| **known == word) {
                    *self.unread.entry(known).or_default() += 1;
                }
            }
            None => {}
        }
        Ok(())
    }

    /// Shortest digits that read back as the same numbers.
    fn state(&mut self, word: &str, DVec3 { x, y, z }: DVec3) {
        let _ = writeln!(self.text, "{word} {x} {y} {z}");
    }

    fn add_face<'a>(&mut self, words: impl Iterator<Item = &'a str>) -> Result<(), String> {
        let start = self.text.len();
        self.text.push('f');
        let mut count = 0;
        for word in words {
            let (position, normal) = self.corner(word)?;
            let _ = write!(self.text, " {position}//{}", normal + 1);
            count += 1;
        }
        self.text.push('\n');
        if count < 3 {
            self.text.truncate(start);
            self.too_small += 1;
        }
        Ok(())
    }

    /// Numbers of the position and the normal from 1; 0 for no normal.
    fn corner(&self, corner: &str) -> Result<(usize, usize), String> {
        let mut parts = corner.split('/');
        let mut index = |count: usize, kind: &str| match parts.next() {
            None | Some("") => Ok(None),
            Some(text) => index_of(text, corner, count, kind).map(Some),
        };
        let position = index(self.positions, "vertices (v)")?.ok_or_else(|| no_corner(corner))?;
        index(self.textures, "texture coordinates (vt)")?;
        let normal = index(self.normals, "normals (vn)")?;
        Ok((position, normal.unwrap_or(0)))
    }
}

/// Reads a text in which nothing is left to choose.
fn read_checked(checked: Checked) -> Result<Statements, Bad> {
    let options = tobj::LoadOptions::default();
    let no_materials = |_: &Path| Ok((Vec::new(), Default::default()));
    let (models, _) = tobj::load_obj_buf(&mut checked.text.as_bytes(), &options, no_materials)
        .map_err(|error| Bad { line: None, what: format!("not an OBJ file: {error}") })?;
    let mut statements = Statements {
        normals_written: checked.normals,
        too_small: checked.too_small,
        unread: checked.unread,
        ..Statements::default()
    };
    // Without groups there is one model, or none where there are no faces.
    let Some(tobj::Model { mesh, .. }) = models.into_iter().next() else {
        return Ok(statements);
    };
    let vectors = |numbers: &[f64]| -> Vec<DVec3> {
        numbers.as_chunks().0.iter().copied().map(DVec3::from_array).collect()
    };
    statements.positions = vectors(&mesh.positions);
    statements.normals = vectors(&mesh.normals);
    let normal =
        |index: u32| Some(index).filter(|_| statements.normals[index as usize] != NO_NORMAL);
    let corners = mesh.indices.iter().zip(&mesh.normal_indices);
    statements.corners = corners
        .map(|(position, index)| Corner { position: *position, normal: normal(*index) })
        .collect();
    // No arities where all faces are triangles.
    let arities = if mesh.face_arities.is_empty() {
        vec![3; mesh.indices.len() / 3]
    } else {
        mesh.face_arities
    };
    statements.ends = arities
        .iter()
        .scan(0, |end, corners| {
            *end += *corners as usize;
            Some(*end)
        })
        .collect();
    Ok(statements)
}

fn no_corner(corner: &str) -> String {
    format!("\"{corner}\" is not a corner; write v, v/vt, v//vn or v/vt/vn")
}

/// An index of the file, from 1 or backwards from -1, as one from 1.
fn index_of(text: &str, corner: &str, count: usize, kind: &str) -> Result<usize, String> {
    let number: i64 = text.parse().map_err(|_| no_corner(corner))?;
    let from_one = if number > 0 { number } else { number.saturating_add(count as i64 + 1) };
    let exists = number != 0 && (1..=count as i64).contains(&from_one);
    usize::try_from(from_one).ok().filter(|_| exists).ok_or_else(|| {
        format!(
            "index {number} in \"{corner}\" does not exist: {count} {kind} are defined so far; \
             count from 1 (or from -1 backwards)"
        )
    })
}

fn numbers<'a>(
    words: impl Iterator<Item = &'a str>,
    form: &str,
    number: impl Fn(&str) -> Option<f64>,
) -> Result<DVec3, String> {
    let mut values = [0.0; 3];
    let mut count = 0;
    for (value, word) in values.iter_mut().zip(words) {
        let no_number = || format!("\"{word}\" is not a number; write {form}");
        *value = number(word).ok_or_else(no_number)?;
        count += 1;
    }
    if count < 3 {
        return Err(format!("{count} numbers where 3 are needed; write {form}"));
    }
    Ok(DVec3::from_array(values))
}

fn number(word: &str) -> Option<f64> {
    word.parse().ok()
}

/// Some writers spell it `-nan(ind)` or `-1.#IND`.
fn number_or_nan(word: &str) -> Option<f64> {
    let is_nan = || word.to_ascii_lowercase().contains("nan") || word.contains(".#");
    number(word).or_else(|| is_nan().then_some(f64::NAN))
}
