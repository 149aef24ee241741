//! Which channels belong together, and which of the layers is the image.
//!
//! OpenEXR's convention is `layer.component`. Others write `ViewLayer.Combined.R`
//! (Blender), `C.r`, `r`, or put the layer into the name of a part.

use super::header::Part;
use crate::LayerName;
use std::collections::{BTreeMap, BTreeSet};

/// Names that all mean the image, in the order in which they are preferred.
const IMAGE: [&str; 5] = ["", "radiance", "rgba", "RGBA", "Combined"];
/// Components by their place in a layer.
const COMPONENTS: [(&str, &[&str]); 9] = [
    ("R", &["R", "r", "Red", "red", "RED"]),
    ("G", &["G", "g", "Green", "green", "GREEN"]),
    ("B", &["B", "b", "Blue", "blue", "BLUE"]),
    ("X", &["X", "x"]),
    ("Y", &["Y", "y"]),
    ("Z", &["Z", "z"]),
    ("A", &["A", "a", "Alpha", "alpha", "ALPHA"]),
    ("RY", &["RY", "ry"]),
    ("BY", &["BY", "by"]),
];

/// What the channels of a layer are.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Content {
    /// R, G, B.
    Colour,
    /// RY, Y, BY: luminance and chroma.
    LuminanceChroma,
    /// Y alone.
    Grey,
    /// Some of R, G, B, X, Y, Z.
    Other,
}

/// Channels that belong together.
#[derive(Clone, Debug)]
pub(super) struct Group {
    /// The name of the layer; empty for the unnamed one.
    pub(super) name: String,
    pub(super) content: Content,
    /// Part and number of each channel, in the order of the components.
    pub(super) channels: Vec<(usize, usize)>,
    /// The names of the components, in the same order.
    components: Vec<&'static str>,
    /// Its opacity.
    pub(super) alpha: Option<(usize, usize)>,
}

impl Group {
    /// The name that chooses it.
    pub(super) fn label(&self) -> String {
        if self.name.is_empty() { self.components.concat() } else { self.name.clone() }
    }

    /// What to call it in a list: its name and its components.
    fn described(&self) -> String {
        format!("{} ({})", self.label(), self.components.join(","))
    }

    /// Whether it has this component.
    pub(super) fn has(&self, component: &str) -> bool {
        self.place(component).is_some()
    }

    /// The place of a component among its channels.
    pub(super) fn place(&self, component: &str) -> Option<usize> {
        self.components.iter().position(|name| *name == component)
    }

    fn is_colour(&self) -> bool {
        matches!(self.content, Content::Colour | Content::LuminanceChroma)
    }

    /// False for layers that carry numbers about an image of ours.
    fn can_be_image(&self) -> bool {
        matches!(LayerName::from(&*self.name), LayerName::Buffer(_) | LayerName::Radiance)
    }

    fn from_components(name: String, found: &BTreeMap<&'static str, (usize, usize)>) -> Self {
        let all = |names: &[&str]| names.iter().all(|name| found.contains_key(name));
        let (content, wanted): (_, &[&'static str]) = if all(&["R", "G", "B"]) {
            (Content::Colour, &["R", "G", "B"])
        } else if all(&["RY", "Y", "BY"]) {
            (Content::LuminanceChroma, &["RY", "Y", "BY"])
        } else if all(&["Y"]) && !all(&["X"]) && !all(&["Z"]) && !all(&["R"]) {
            (Content::Grey, &["Y"])
        } else {
            (Content::Other, &["R", "G", "B", "X", "Y", "Z"])
        };
        let chosen = wanted.iter().filter_map(|name| Some((*name, *found.get(name)?)));
        let (components, channels) = chosen.unzip();
        Self { name, content, channels, components, alpha: found.get("A").copied() }
    }
}

/// The layers of a file.
pub(super) fn groups(parts: &[Part]) -> Vec<Group> {
    let mut found: BTreeMap<String, BTreeMap<&'static str, (usize, usize)>> = BTreeMap::new();
    let shared = shared_prefixes(parts);
    for (part_number, part) in parts.iter().enumerate() {
        for (number, channel) in part.channels.iter().enumerate() {
            let (prefix, component) = split(&channel.name);
            let Some((component, spellings)) =
                COMPONENTS.iter().find(|(_, spellings)| spellings.contains(&component))
            else {
                continue;
            };
            let name = match prefix {
                "" => part.name.clone(),
                prefix if shared.contains(prefix) && !prefix.starts_with(&part.name) => {
                    format!("{}.{prefix}", part.name)
                }
                prefix => prefix.to_owned(),
            };
            let place = (part_number, number);
            let of_group = found.entry(name).or_default();
            // `R` goes before `r` where a layer has both.
            if split(&channel.name).1 == spellings[0] {
                of_group.insert(component, place);
            } else {
                of_group.entry(component).or_insert(place);
            }
        }
    }
    let groups = found.into_iter().map(|(name, found)| Group::from_components(name, &found));
    groups.filter(|group| !group.channels.is_empty()).collect()
}

fn split(name: &str) -> (&str, &str) {
    name.rsplit_once('.').unwrap_or(("", name))
}

/// Prefixes that channels of several parts have: only the part tells them apart.
fn shared_prefixes(parts: &[Part]) -> BTreeSet<String> {
    let mut owners: BTreeMap<&str, BTreeSet<usize>> = BTreeMap::new();
    for (number, part) in parts.iter().enumerate() {
        for channel in &part.channels {
            owners.entry(split(&channel.name).0).or_default().insert(number);
        }
    }
    let shared = owners.into_iter().filter(|(_, owners)| owners.len() > 1);
    shared.map(|(prefix, _)| prefix.to_owned()).collect()
}

/// Layers and channels for an error's list.
pub(super) fn described(groups: &[Group], parts: &[Part]) -> Vec<String> {
    let mut list: Vec<String> = groups.iter().map(Group::described).collect();
    if list.is_empty() {
        let channels = parts.iter().flat_map(|part| &part.channels);
        list = channels.map(|channel| channel.name.clone()).collect();
    }
    list
}

/// The image among several layers that could be it.
#[derive(Debug, PartialEq, Eq)]
pub(super) enum Choice {
    /// This one.
    Group(usize),
    /// None can be it.
    None,
    /// Nothing tells which.
    Ambiguous(Vec<String>),
}

/// The layer that has no name other than one of the image.
pub(super) fn unnamed(groups: &[Group]) -> Option<usize> {
    let fitting = |name: &str| {
        let is_named = |group: &Group| group.name == name && group.content != Content::Other;
        groups.iter().position(is_named)
    };
    IMAGE.iter().find_map(|name| fitting(name))
}

/// The layer that is the image: the unnamed one, or one with a name for it, or
/// the only one with colours, or the only grey one.
pub(super) fn image(groups: &[Group]) -> Choice {
    let candidates = |wanted: &dyn Fn(&Group) -> bool| -> Vec<usize> {
        let numbered = groups.iter().enumerate();
        let fitting = numbered.filter(|(_, group)| group.can_be_image() && wanted(group));
        fitting.map(|(number, _)| number).collect()
    };
    let colours = candidates(&Group::is_colour);
    let greys = candidates(&|group| group.content == Content::Grey);
    for list in [&colours, &greys] {
        if colours.len() > 1 && !std::ptr::eq(list, &colours) {
            break;
        }
        let is_named = |name: &str| list.iter().find(|i| groups[**i].name == name);
        if let Some(found) = IMAGE.iter().find_map(|name| is_named(name)) {
            return Choice::Group(*found);
        }
        let combined = |i: &&usize| split(&groups[**i].name).1 == "Combined";
        let mut combined = list.iter().filter(combined);
        if let (Some(one), None) = (combined.next(), combined.next()) {
            return Choice::Group(*one);
        }
        if let [one] = list[..] {
            return Choice::Group(one);
        }
    }
    if colours.len() > 1 {
        return Choice::Ambiguous(colours.iter().map(|i| groups[*i].label()).collect());
    }
    // Some of R, G and B without a name: the others are 0.
    let unnamed = candidates(&|group| group.name.is_empty() && group.components[0] < "X");
    unnamed.first().map_or(Choice::None, |found| Choice::Group(*found))
}

/// The layer of that name, of its last words, or the channel of that name.
pub(super) fn chosen(groups: &mut Vec<Group>, parts: &[Part], wanted: &str) -> Option<usize> {
    let exact = groups.iter().position(|group| group.label() == wanted || group.name == wanted);
    let ending = format!(".{}", wanted.to_lowercase());
    let mut similar = groups.iter().enumerate().filter(|(_, group)| {
        let name = group.label().to_lowercase();
        name == ending[1..] || name.ends_with(&ending)
    });
    let similar = match (similar.next(), similar.next()) {
        (Some((number, _)), None) => Some(number),
        _ => None,
    };
    exact.or(similar).or_else(|| {
        let channels = parts.iter().enumerate().find_map(|(number, part)| {
            let channel = part.channels.iter().position(|channel| channel.name == wanted)?;
            Some(vec![(number, channel)])
        })?;
        let (content, components) = (Content::Grey, vec!["Y"]);
        groups.push(Group { name: wanted.to_owned(), content, channels, components, alpha: None });
        Some(groups.len() - 1)
    })
}
