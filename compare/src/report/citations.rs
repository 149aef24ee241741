//! What a page says of the methods it shows: what each does, and whose it is.

use super::plot::marker_image;
use realtime::METHODS;

/// One method of a study.
#[derive(Clone, Debug, Default, PartialEq)]
pub(super) struct MethodAbout {
    /// Its marker, SVG.
    pub(super) marker: String,
    /// Id.
    pub(super) id: String,
    /// In a few words.
    pub(super) title: String,
    /// What it does and where it goes visibly wrong.
    pub(super) about: String,
    /// Authors and year of its source; empty if it has none.
    pub(super) source: String,
}

/// The methods of a study in the order of their styles; those that nobody described, such
/// as images of others, only by name.
pub(super) fn methods(styles: &[String]) -> Vec<MethodAbout> {
    let about = |(style, id): (usize, &String)| {
        let known = METHODS.iter().find(|method| method.id == *id);
        MethodAbout {
            marker: marker_image(style),
            id: id.clone(),
            title: known.map_or("an image from elsewhere", |m| m.title).to_owned(),
            about: known.map_or("", |m| m.about).to_owned(),
            source: known.map(|m| source(m.bibtex)).unwrap_or_default(),
        }
    };
    styles.iter().enumerate().map(about).collect()
}

/// `Seipel and Nivfors 2006` of a BibTeX entry.
fn source(bibtex: &str) -> String {
    let field = |name: &str| {
        let after = bibtex.lines().find_map(|line| line.trim().strip_prefix(name))?;
        let value = after.trim_start().strip_prefix('=')?.trim().trim_end_matches(',');
        Some(value.trim_matches(['{', '}', '"']))
    };
    let family = |author: &str| match author.split_once(", ") {
        Some((family, _)) => family.to_owned(),
        None => author.rsplit(' ').next().unwrap_or(author).to_owned(),
    };
    let authors: Vec<String> =
        field("author").map(|all| all.split(" and ").map(family).collect()).unwrap_or_default();
    let who = match authors.as_slice() {
        [] => return field("title").unwrap_or_default().to_owned(),
        [one] => one.clone(),
        [one, other] => format!("{one} and {other}"),
        [one, ..] => format!("{one} et al."),
    };
    format!("{who} {}", field("year").unwrap_or_default()).trim_end().to_owned()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_source_is_named_by_its_authors_and_year() {
        let entry =
            |authors: &str| format!("@x{{A,\n  author = {{{authors}}},\n  year = {{2005}}\n}}");
        assert_eq!(source(&entry("Chris Wyman")), "Wyman 2005");
        assert_eq!(source(&entry("Stefan Seipel and Nivfors, Anders")), "Seipel and Nivfors 2005");
        assert_eq!(source(&entry("A B and C D and E F")), "B et al. 2005");
        assert_eq!(source(""), "");
    }

    #[test]
    fn every_published_method_has_its_source() {
        let ids: Vec<String> = METHODS.iter().map(|method| method.id.to_owned()).collect();
        for method in methods(&ids) {
            assert!(!method.title.is_empty() && !method.about.is_empty(), "{}", method.id);
            let cites = METHODS.iter().any(|m| m.id == method.id && !m.bibtex.is_empty());
            assert_eq!(cites, !method.source.is_empty(), "{}: {}", method.id, method.source);
        }
    }
}
