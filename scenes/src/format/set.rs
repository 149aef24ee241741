//! Numbers of a scene that are set from outside its file, as sweeps do.

use super::{Error, parse};
use crate::Scene;
use std::collections::BTreeMap;
use toml::Value;

impl Scene {
    /// The scene with other numbers at some keys, such as `medium.glass.eta`.
    ///
    /// A key is the path to a number in the scene file, with dots: tables by name,
    /// objects by `name`, arrays by place from 0 (`camera.eye.1`, `light.0.…`).
    /// A key that the table could have and has not is added. `medium.NAME` is the
    /// table of that name or, where there is none, every medium that is written in
    /// place with `material = "NAME"`; an index takes the place of a material.
    ///
    /// The result has a source text and a content id of its own.
    ///
    /// # Errors
    /// If the scene has no text, a key leads nowhere, or the scene makes no sense
    /// with the numbers.
    pub fn with(&self, settings: &BTreeMap<String, f64>) -> Result<Self, Error> {
        if settings.is_empty() {
            return Ok(self.clone());
        }
        let fail = |key: &str, why: String| Error::Setting {
            scene: self.name.clone(),
            key: key.to_owned(),
            why,
        };
        let first = settings.keys().next().map_or("", String::as_str);
        let Some(folder) = &self.source.folder else {
            let why = "the scene is no scene file, and only those have keys; write one around \
                       the mesh";
            return Err(fail(first, why.to_owned()));
        };
        let table: toml::Table = toml::from_str(&self.source.text)
            .map_err(|error| fail(first, error.message().to_owned()))?;
        let mut tables = Value::Table(table);
        let mut described = Vec::new();
        for (key, value) in settings {
            set(&mut tables, key, *value).map_err(|why| fail(key, why))?;
            described.push(format!("{key} = {value}"));
        }
        let text = toml::to_string(&tables).map_err(|error| fail(first, error.to_string()))?;
        let label = format!("{} with {}", self.name, described.join(", "));
        let mut scene = parse(&text, &label, folder)?;
        scene.name.clone_from(&self.name);
        scene.title.clone_from(&self.title);
        Ok(scene)
    }
}

/// Writes a number at the end of a path.
fn set(scene: &mut Value, key: &str, value: f64) -> Result<(), String> {
    let path: Vec<&str> = key.split('.').collect();
    if path.len() < 2 || path.iter().any(|step| step.is_empty()) {
        return Err("write the path to a number, such as medium.glass.eta".to_owned());
    }
    let declared = scene.get("medium").and_then(|media| media.get(path[1]));
    if path[0] != "medium" || declared.is_some() {
        return step(scene, &path, value);
    }
    let (mut found, mut known) = (0, Vec::new());
    media_in_place(scene, &mut |medium| {
        let material = medium.get("material").and_then(Value::as_str).map(str::to_owned);
        if material.as_deref() == Some(path[1]) {
            found += 1;
            return step(medium, &path[2..], value);
        }
        known.extend(material);
        Ok(())
    })?;
    if found > 0 {
        return Ok(());
    }
    let tables = scene.get("medium").and_then(Value::as_table);
    known.extend(tables.iter().flat_map(|tables| tables.keys().cloned()));
    known.dedup();
    let known = if known.is_empty() { "none with a name".to_owned() } else { known.join(", ") };
    Err(format!(
        "the scene has no medium `{}`; it has {known}. A medium without a name is reached \
         through its object, such as object.0.medium.eta",
        path[1]
    ))
}

type Visit<'a> = dyn FnMut(&mut Value) -> Result<(), String> + 'a;

/// Every medium that is written where it is used.
fn media_in_place(scene: &mut Value, visit: &mut Visit) -> Result<(), String> {
    let mut of = |place: Option<&mut Value>| match place.and_then(|place| place.get_mut("medium")) {
        Some(medium) if medium.is_table() => visit(medium),
        _ => Ok(()),
    };
    of(scene.get_mut("surroundings"))?;
    let objects = scene.get_mut("object").and_then(Value::as_array_mut);
    objects.into_iter().flatten().try_for_each(|object| of(Some(object)))
}

/// Follows a path from a value on and writes the number at its end.
fn step(at: &mut Value, path: &[&str], value: f64) -> Result<(), String> {
    let Some((name, rest)) = path.split_first() else {
        return match at {
            Value::Integer(_) | Value::Float(_) => {
                *at = number(value);
                Ok(())
            }
            other => Err(format!("there is {}, and only numbers can be set", kind(other))),
        };
    };
    match at {
        Value::Table(table) if rest.is_empty() && !table.contains_key(*name) => {
            if *name == "eta" {
                table.remove("material");
            }
            table.insert((*name).to_owned(), number(value));
            Ok(())
        }
        Value::Table(table) => match table.get_mut(*name) {
            Some(next) => step(next, rest, value),
            None => Err(format!("there is no `{name}`; there are {}", list(table.keys()))),
        },
        Value::Array(items) => {
            let called = |item: &Value| item.get("name").and_then(Value::as_str) == Some(*name);
            let place = items.iter().position(called).or_else(|| name.parse().ok());
            let count = items.len();
            match place.and_then(|place| items.get_mut(place)) {
                Some(next) => step(next, rest, value),
                None => Err(format!("there is no `{name}` among {count}; they count from 0")),
            }
        }
        other => Err(format!("`{name}` cannot be inside {}", kind(other))),
    }
}

/// A whole number where it is one: what counts things takes nothing else.
fn number(value: f64) -> Value {
    let whole = value.fract() == 0.0 && value.abs() < 9e15;
    if whole { Value::Integer(value as i64) } else { Value::Float(value) }
}

fn kind(value: &Value) -> &'static str {
    match value {
        Value::Table(_) => "a table",
        Value::Array(_) => "an array",
        Value::String(_) => "a text",
        Value::Boolean(_) => "true or false",
        Value::Integer(_) | Value::Float(_) => "a number",
        Value::Datetime(_) => "a date",
    }
}

fn list<'a>(names: impl Iterator<Item = &'a String>) -> String {
    names.map(String::as_str).collect::<Vec<_>>().join(", ")
}

#[cfg(test)]
mod tests {
    #![allow(clippy::unwrap_used, reason = "a failing test may panic")]
    use crate::builtin;
    use std::collections::BTreeMap;

    fn with(scene: &str, key: &str, value: f64) -> Result<crate::Scene, String> {
        let settings = BTreeMap::from([(key.to_owned(), value)]);
        builtin(scene).unwrap().with(&settings).map_err(|error| error.to_string())
    }

    /// The ball's glass is a material written in place; its index is set, and the
    /// rest of the scene stays what it was.
    #[test]
    fn an_index_replaces_a_material_that_is_written_in_place() {
        let before = builtin("ball").unwrap();
        let after = with("ball", "medium.glass.eta", 1.31).unwrap();
        assert_eq!(before.media[1].eta.get(), 1.5);
        assert_eq!(after.media[1].eta.get(), 1.31);
        assert_eq!((&after.name, &after.title), (&before.name, &before.title));
        assert_eq!(after.camera, before.camera);
        assert_ne!(after.source.sha256, before.source.sha256);
        // Nothing set, nothing changed: the passing twin.
        let same = before.with(&BTreeMap::new()).unwrap();
        assert_eq!(same.source, before.source);
    }

    #[test]
    fn numbers_are_reached_through_tables_names_and_places() {
        let scene = with("ball", "object.ball.shape.sphere.radius_m", 0.5).unwrap();
        assert_eq!(scene.bounds()[1].x, 0.5);
        let scene = with("ball", "object.0.shape.sphere.radius_m", 0.5).unwrap();
        assert_eq!(scene.bounds()[1].x, 0.5);
        assert_eq!(with("ball", "camera.eye.1", 2.0).unwrap().camera.eye.y, 2.0);
        // A key that the file does not have yet.
        let turned = with("ball", "environment.rotation_deg", 90.0).unwrap();
        assert!(turned.source.text.contains("rotation_deg = 90"), "{}", turned.source.text);
    }

    /// A quarter of a turn about +Y takes +Z to +X, four quarters take it home.
    #[test]
    fn the_eye_orbits_the_target() {
        let at = |turn: f64| with("ball", "camera.orbit_deg", turn).unwrap().camera.eye;
        let (start, quarter, round) = (at(0.0), at(90.0), at(360.0));
        assert_eq!(start, builtin("ball").unwrap().camera.eye);
        assert!(quarter.distance(glam::DVec3::new(start.z, start.y, -start.x)) < 1e-12);
        assert!(round.distance(start) < 1e-12 && quarter.distance(start) > 1.0);
    }

    #[test]
    fn a_path_that_leads_nowhere_says_what_there_is() {
        for (key, words) in [
            ("medium.water.eta", "no medium `water`; it has glass"),
            ("camra.eye.0", "no `camra`; there are camera"),
            ("camera", "such as medium.glass.eta"),
            ("object.cube.scale", "no `cube` among 1"),
            ("title.x", "inside a text"),
            ("camera.eye", "only numbers can be set"),
            ("camera.zoom", "unknown field `zoom`"),
            ("medium.glass.eta", "below 1"),
        ] {
            let error = with("ball", key, 0.5).unwrap_err();
            assert!(error.contains(words), "{key}: {error}");
        }
    }
}
