//! What the lines of a file state, every number and index checked.

use super::Bad;
use super::lines::lines;
use glam::DVec3;
use std::collections::BTreeMap;

/// A corner of a face.
#[derive(Clone, Copy, Debug)]
pub(super) struct Corner {
    pub(super) position: u32,
    /// Index into the normals, if the corner names one.
    pub(super) normal: Option<u32>,
}

/// A file's vertices, normals and faces, as written.
#[derive(Default)]
pub(super) struct Statements {
    /// Finite.
    pub(super) positions: Vec<DVec3>,
    /// Any length, zero and NaN among them.
    pub(super) normals: Vec<DVec3>,
    textures: usize,
    /// Corners of all faces, one face after the other.
    pub(super) corners: Vec<Corner>,
    /// Where each face ends in `corners`.
    pub(super) ends: Vec<usize>,
    /// Faces of one or two corners.
    pub(super) too_small: usize,
    /// Statements that make surfaces and are not read, and how often each occurs.
    pub(super) unread: BTreeMap<&'static str, usize>,
}

/// Free-form geometry, which is not read.
const FREE_FORM: [&str; 6] = ["curv", "curv2", "surf", "bzp", "bsp", "cdp"];

impl Statements {
    pub(super) fn read(bytes: &[u8]) -> Result<Self, Bad> {
        let mut statements = Self::default();
        for (line, text) in lines(bytes) {
            statements.add(&text).map_err(|what| Bad { line: Some(line), what })?;
        }
        Ok(statements)
    }

    /// The faces, each as its corners.
    pub(super) fn faces(&self) -> impl Iterator<Item = &[Corner]> {
        let starts = std::iter::once(0).chain(self.ends.iter().copied());
        starts.zip(&self.ends).map(|(start, end)| &self.corners[start..*end])
    }

    fn add(&mut self, line: &str) -> Result<(), String> {
        let mut words = line.split_whitespace();
        match words.next() {
            Some("v") => {
                let position = numbers(words, "v x y z", number)?;
                if !position.is_finite() {
                    return Err(format!("{position} is not finite; write v x y z"));
                }
                self.positions.push(position);
            }
            Some("vn") => self.normals.push(numbers(words, "vn x y z", number_or_nan)?),
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

    fn add_face<'a>(&mut self, words: impl Iterator<Item = &'a str>) -> Result<(), String> {
        let start = self.corners.len();
        for word in words {
            let corner = self.corner(word)?;
            self.corners.push(corner);
        }
        if self.corners.len() < start + 3 {
            self.corners.truncate(start);
            self.too_small += 1;
        } else {
            self.ends.push(self.corners.len());
        }
        Ok(())
    }

    fn corner(&self, corner: &str) -> Result<Corner, String> {
        let mut parts = corner.split('/');
        let mut index = |count: usize, kind: &str| match parts.next() {
            None | Some("") => Ok(None),
            Some(text) => index_of(text, corner, count, kind).map(Some),
        };
        let position =
            index(self.positions.len(), "vertices (v)")?.ok_or_else(|| no_corner(corner))?;
        index(self.textures, "texture coordinates (vt)")?;
        let normal = index(self.normals.len(), "normals (vn)")?;
        Ok(Corner { position, normal })
    }
}

fn no_corner(corner: &str) -> String {
    format!("\"{corner}\" is not a corner; write v, v/vt, v//vn or v/vt/vn")
}

/// An index of the file, from 1 or backwards from -1, as one from 0.
fn index_of(text: &str, corner: &str, count: usize, kind: &str) -> Result<u32, String> {
    let number: i64 = text.parse().map_err(|_| no_corner(corner))?;
    let from_zero = if number > 0 { number - 1 } else { number.saturating_add(count as i64) };
    let exists = number != 0 && (0..count as i64).contains(&from_zero);
    u32::try_from(from_zero).ok().filter(|_| exists).ok_or_else(|| {
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
