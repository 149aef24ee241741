//! The sources of a crate as modules, and what each of them imports.
#![allow(dead_code, reason = "each test file uses its part")]

use std::collections::{BTreeMap, BTreeSet};
use std::path::Path;

/// Module path from the crate's root, such as `study`, `jobs`; of a `mod.rs`
/// the path of its folder.
pub(crate) type Module = Vec<String>;

/// What the modules of a crate import from each other.
pub(crate) struct Crate {
    /// Code of each module without comments and without its tests.
    code: BTreeMap<Module, String>,
    /// Names that a module hands on from one of its children.
    handed_on: BTreeMap<Module, BTreeMap<String, String>>,
}

impl Crate {
    /// Reads every module below a `src` folder.
    pub(crate) fn read(src: &Path) -> Self {
        let mut files = Vec::new();
        gather(src, &mut Vec::new(), &mut files);
        Self::new(files)
    }

    /// From modules and their text.
    pub(crate) fn new(files: Vec<(Module, String)>) -> Self {
        let code: BTreeMap<_, _> =
            files.into_iter().map(|(module, text)| (module, without_comments(&text))).collect();
        let mut handed_on = BTreeMap::new();
        for (module, text) in &code {
            let names: BTreeMap<String, String> = exports(text)
                .into_iter()
                .filter(|path| path.len() > 1)
                .filter(|path| code.contains_key(&joined(module, &path[0])))
                .map(|path| (path[path.len() - 1].clone(), path[0].clone()))
                .collect();
            handed_on.insert(module.clone(), names);
        }
        Self { code, handed_on }
    }

    /// Modules whose code holds a word.
    pub(crate) fn that_say(&self, word: &str) -> impl Iterator<Item = &Module> {
        self.code.iter().filter(move |(_, text)| text.contains(word)).map(|(module, _)| module)
    }

    /// The parents whose children could import from each other.
    pub(crate) fn rooms(&self) -> BTreeSet<Module> {
        self.code.keys().filter_map(|module| module.split_last()).map(|(_, up)| up.into()).collect()
    }

    /// Which children of a module import from which other ones, each with a file
    /// that does.
    pub(crate) fn imports(&self, parent: &Module) -> BTreeMap<String, BTreeMap<String, Module>> {
        let mut found: BTreeMap<String, BTreeMap<String, Module>> = BTreeMap::new();
        for (module, text) in self.code.iter().filter(|(m, _)| m.len() > parent.len()) {
            if !module.starts_with(parent) {
                continue;
            }
            let from = &module[parent.len()];
            for path in paths(text, module) {
                let Some(to) = self.child(parent, &path) else { continue };
                if to != *from {
                    found.entry(from.clone()).or_default().insert(to, module.clone());
                }
            }
        }
        found
    }

    /// The child of `parent` that a path from the crate's root leads to.
    fn child(&self, parent: &Module, path: &[String]) -> Option<String> {
        let name = path.strip_prefix(parent.as_slice())?.first()?;
        if self.code.contains_key(&joined(parent, name)) {
            return Some(name.clone());
        }
        self.handed_on.get(parent)?.get(name).cloned()
    }
}

fn joined(module: &Module, child: &str) -> Module {
    module.iter().cloned().chain([child.to_owned()]).collect()
}

fn gather(folder: &Path, module: &mut Module, files: &mut Vec<(Module, String)>) {
    for entry in std::fs::read_dir(folder).unwrap() {
        let path = entry.unwrap().path();
        let name = path.file_stem().unwrap().to_string_lossy().into_owned();
        if name == "tests" {
            continue;
        }
        if path.is_dir() {
            module.push(name);
            gather(&path, module, files);
            module.pop();
        } else if path.extension().is_some_and(|e| e == "rs") {
            let text = std::fs::read_to_string(&path).unwrap();
            let own = if name == "mod" || name == "lib" { None } else { Some(name) };
            files.push((module.iter().cloned().chain(own).collect(), text));
        }
    }
}

/// Code without comments and without the tests at its end.
fn without_comments(text: &str) -> String {
    let code = text.split("#[cfg(test)]\nmod ").next().unwrap_or_default();
    let line = |line: &str| line.split("//").next().unwrap_or_default().to_owned();
    code.lines().map(line).collect::<Vec<_>>().join("\n")
}

/// Every path in a module that begins with `crate` or `super`, from the root.
fn paths(text: &str, module: &Module) -> Vec<Vec<String>> {
    let mut found = Vec::new();
    for start in ["crate", "super"] {
        for (at, _) in text.match_indices(start) {
            let before = text[..at].chars().next_back();
            let whole = before.is_none_or(|c| !(c.is_alphanumeric() || c == '_' || c == ':'));
            // `pub(crate)` and `pub(super)` are no paths.
            if whole && text[at + start.len()..].starts_with("::") {
                tree(&text[at..], &mut Vec::new(), &mut found);
            }
        }
    }
    found.into_iter().map(|path| resolved(path, module)).collect()
}

/// Paths that a module hands on: `pub use child::Name`.
fn exports(text: &str) -> Vec<Vec<String>> {
    let mut found = Vec::new();
    for (at, _) in text.match_indices("use ") {
        let line_start = text[..at].rfind('\n').map_or(0, |place| place + 1);
        if text[line_start..at].trim_start().starts_with("pub") {
            tree(&text[at + 4..], &mut Vec::new(), &mut found);
        }
    }
    found
}

/// Reads `a::b::{c, d::e}` into one path each; returns what is left.
fn tree<'a>(text: &'a str, prefix: &mut Vec<String>, found: &mut Vec<Vec<String>>) -> &'a str {
    let text = text.trim_start();
    if let Some(mut rest) = text.strip_prefix('{') {
        loop {
            let depth = prefix.len();
            rest = tree(rest, prefix, found).trim_start();
            prefix.truncate(depth);
            match rest.strip_prefix(',') {
                Some(more) if !more.trim_start().starts_with('}') => rest = more,
                Some(more) => return more.trim_start().strip_prefix('}').unwrap_or_default(),
                None => return rest.strip_prefix('}').unwrap_or(rest),
            }
        }
    }
    let length = text.find(|c: char| !(c.is_alphanumeric() || c == '_')).unwrap_or(text.len());
    let (name, rest) = text.split_at(length);
    if name != "self" && !name.is_empty() {
        prefix.push(name.to_owned());
    }
    if let Some(rest) = rest.strip_prefix("::") {
        return tree(rest, prefix, found);
    }
    found.push(prefix.clone());
    // What `as` names is not needed.
    match rest.strip_prefix(" as ") {
        Some(alias) => {
            let end = alias.find(|c: char| !(c.is_alphanumeric() || c == '_'));
            &alias[end.unwrap_or(alias.len())..]
        }
        None => rest,
    }
}

/// From the crate's root: every leading `super` leaves the module once.
fn resolved(path: Vec<String>, module: &Module) -> Vec<String> {
    let ups = path.iter().take_while(|name| *name == "super").count();
    let root =
        if path[0] == "crate" { &[][..] } else { &module[..module.len().saturating_sub(ups)] };
    let rest = path.iter().skip(if path[0] == "crate" { 1 } else { ups });
    root.iter().chain(rest).cloned().collect()
}
