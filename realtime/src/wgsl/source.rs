//! A file of WGSL and what its head says: the comment lines before anything else.
//!
//! | line | meaning |
//! |---|---|
//! | `// needs: layers march` | files, or choices between files, that it calls |
//! | `// title:`, `// alias:` | of a method |
//! | `// citation: @misc{…` | BibTeX, until its braces close |
//! | `// at vertices: FILE` | makes `vertex_vector()`: the method works at vertices |
//! | `// parameter: NAME = DEFAULT [MIN to MAX UNIT]: MEANING` | what can be set, of a user's method; `whole MIN to MAX` for whole numbers |
//! | `// bends at equal index` | the method changes the image even where indices are equal |
//! | `// follows rays` | the method meets the bodies by rays: nothing is drawn for it |
//! | `// one way for all colours` | the method does not trace red and blue on their own |
//!
//! All other lines are the description.

use std::borrow::Cow;

/// One file of WGSL.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(crate) struct Source {
    /// Name without the ending, or the path of a user's file.
    pub(crate) name: String,
    pub(crate) text: Cow<'static, str>,
}

/// What the head of a file says.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub(crate) struct Head {
    pub(crate) title: String,
    pub(crate) alias: String,
    pub(crate) citation: String,
    pub(crate) about: String,
    /// `None` if the file has no such line.
    pub(crate) needs: Option<Vec<String>>,
    pub(crate) at_vertices: Option<String>,
    /// Line and text of each.
    pub(crate) parameters: Vec<(usize, String)>,
    pub(crate) bends_at_equal_index: bool,
    pub(crate) one_way_for_all_colours: bool,
    pub(crate) follows_rays: bool,
}

impl Source {
    pub(crate) fn new(name: &str, text: impl Into<Cow<'static, str>>) -> Self {
        Self { name: name.to_owned(), text: text.into() }
    }

    /// A user's file.
    pub(crate) fn is_path(&self) -> bool {
        self.name.ends_with(".wgsl")
    }

    /// What error messages call it.
    pub(crate) fn file_name(&self) -> Cow<'_, str> {
        if self.is_path() {
            Cow::Borrowed(&self.name)
        } else {
            Cow::Owned(format!("{}.wgsl", self.name))
        }
    }

    pub(crate) fn head(&self) -> Head {
        let mut head = Head::default();
        let mut about: Vec<&str> = Vec::new();
        let numbered = self.text.lines().enumerate();
        let mut lines =
            numbered.map_while(|(index, line)| Some((index + 1, line.strip_prefix("//")?)));
        while let Some((number, line)) = lines.next() {
            let line = line.strip_prefix(' ').unwrap_or(line);
            match line.split_once(": ").map_or((line, ""), |(key, value)| (key, value.trim())) {
                ("title", value) => value.clone_into(&mut head.title),
                ("alias", value) => value.clone_into(&mut head.alias),
                ("citation", value) => {
                    head.citation = citation(value, &mut lines.by_ref().map(|(_, line)| line));
                }
                ("needs", value) => {
                    let needs = head.needs.get_or_insert_default();
                    needs.extend(value.split_whitespace().map(str::to_owned));
                }
                ("parameter", value) => head.parameters.push((number, value.to_owned())),
                ("at vertices", value) => head.at_vertices = Some(value.to_owned()),
                ("bends at equal index", _) => head.bends_at_equal_index = true,
                ("follows rays", _) => head.follows_rays = true,
                ("one way for all colours", _) => head.one_way_for_all_colours = true,
                _ => about.push(line.trim()),
            }
        }
        head.about = about.join(" ");
        if let (Some(needs), false) = (&mut head.needs, head.parameters.is_empty()) {
            needs.push("parameters".to_owned());
        }
        head
    }
}

/// A BibTeX entry: the lines until its braces close.
fn citation<'a>(first: &str, lines: &mut impl Iterator<Item = &'a str>) -> String {
    let mut text = first.to_owned();
    let open = |text: &str| text.matches('{').count() > text.matches('}').count();
    while open(&text) {
        let Some(line) = lines.next() else { break };
        text.push('\n');
        text.push_str(line.strip_prefix(' ').unwrap_or(line));
    }
    text
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_head_is_read_and_the_rest_is_not() {
        let text = "// title: a method\n// needs: a b\n// citation: @misc{X,\n//   year = {1},\n\
                    // }\n// needs: c\n// bends at equal index\n// It bends\n// light: much.\n\n\
                    // title: not this\nfn f() {}\n";
        let head = Source::new("test", text).head();
        assert_eq!(head.title, "a method");
        assert_eq!(head.needs, Some(["a", "b", "c"].map(str::to_owned).to_vec()));
        assert_eq!(head.citation, "@misc{X,\n  year = {1},\n}");
        assert_eq!(head.about, "It bends light: much.");
        assert!(head.bends_at_equal_index && !head.one_way_for_all_colours);
        assert_eq!(Source::new("test", "fn f() {}").head(), Head::default());
    }
}
