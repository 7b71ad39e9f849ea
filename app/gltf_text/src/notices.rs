//! Notices: sentences about parts of a file that are left out, and about features that are not drawn.
//!
//! Parts come first, in the order of what matters to the picture, each kind in one sentence with its number and its
//! first places. Features follow in the order of their appearance, each once, with the number of its appearances.

use std::collections::BTreeMap;

/// Number of parts that a sentence names.
const NAMED: usize = 3;

/// Longest text of a fault, characters: a file's own names may be of any length.
const LONGEST: usize = 200;

/// Kind of a part that is left out; the first matters most.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub enum Part {
    /// Triangles, or the numbers that they are made of.
    Mesh,
    /// Node, with what hangs on it.
    Node,
    /// Bones of a mesh.
    Skin,
    /// Shape keys of a mesh.
    Morph,
    /// Texture or picture.
    Picture,
    /// Surface.
    Material,
    /// Channel of an animation.
    Animation,
    /// Light source.
    Light,
    /// Anything else.
    File,
}

impl Part {
    /// Beginning of the sentence about `count` parts.
    fn sentence(self, count: usize) -> String {
        let (one, many, fate) = match self {
            Self::Mesh => ("part of the geometry is", "parts of the geometry are", "not drawn"),
            Self::Node => ("node is", "nodes are", "not drawn"),
            Self::Skin => ("skin is", "skins are", "not applied"),
            Self::Morph => ("morph target is", "morph targets are", "not applied"),
            Self::Picture => ("picture is", "pictures are", "not drawn"),
            Self::Material => ("material is", "materials are", "drawn plainly"),
            Self::Animation => ("channel of an animation stands", "channels of animations stand", "still"),
            Self::Light => ("light does", "lights do", "not shine"),
            Self::File => ("part of the file is", "parts of the file are", "passed over"),
        };
        format!("{count} {} {fate}", if count == 1 { one } else { many })
    }
}

/// Sentences for `scene::Scene::notices`.
#[derive(Default)]
pub struct Notices {
    parts: BTreeMap<Part, LeftOut>,
    sentences: Vec<(String, usize)>,
    place_of: BTreeMap<String, usize>,
}

/// Parts of one kind that are left out.
#[derive(Default)]
struct LeftOut {
    count: usize,
    /// First parts with their faults.
    named: Vec<String>,
}

impl Notices {
    /// Adds a sentence about a feature.
    pub fn add(&mut self, sentence: String) {
        let place = *self.place_of.entry(sentence.clone()).or_insert(self.sentences.len());
        match self.sentences.get_mut(place) {
            Some((_, count)) => *count += 1,
            None => self.sentences.push((sentence, 1)),
        }
    }

    /// Adds a part of the file that is left out, with its place in the JSON and its fault.
    pub fn left_out(&mut self, part: Part, place: &str, fault: &str) {
        let parts = self.parts.entry(part).or_default();
        parts.count += 1;
        if parts.named.len() < NAMED {
            let fault = fault.strip_prefix(place).and_then(|rest| rest.strip_prefix(": ")).unwrap_or(fault);
            let fault: String = fault.chars().take(LONGEST).collect();
            let named = format!("{place} ({fault})");
            if !parts.named.contains(&named) {
                parts.named.push(named);
            }
        }
    }

    /// First fault of the geometry, if any of it is left out.
    pub fn first_fault(&self) -> Option<&str> {
        self.parts.values().next().and_then(|parts| parts.named.first()).map(String::as_str)
    }

    /// All notices, parts first.
    pub fn into_sentences(self) -> Vec<String> {
        let of_part = |(part, parts): (Part, LeftOut)| {
            let more = parts.count - parts.named.len().min(parts.count);
            let more = if more > 0 { format!(", and {more} more") } else { String::new() };
            format!("{}: {}{more}", part.sentence(parts.count), parts.named.join(", "))
        };
        let of_feature = |(sentence, count)| {
            if count > 1 { format!("{sentence} ({count})") } else { sentence }
        };
        self.parts.into_iter().map(of_part).chain(self.sentences.into_iter().map(of_feature)).collect()
    }
}
