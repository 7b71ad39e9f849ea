//! Notices: sentences about features of a file that are not drawn.

use std::collections::BTreeMap;

/// Extensions that are drawn.
pub(super) const EXTENSIONS: [&str; 8] = [
    "KHR_lights_punctual",
    "KHR_materials_emissive_strength",
    "KHR_materials_ior",
    "KHR_materials_transmission",
    "KHR_materials_unlit",
    "KHR_materials_volume",
    "KHR_mesh_quantization",
    "KHR_texture_transform",
];

/// Sentences for [`scene::Scene::notices`] in the order of their first appearance, each once, with the number of its
/// appearances.
#[derive(Default)]
pub(super) struct Notices {
    sentences: Vec<(String, usize)>,
    place_of: BTreeMap<String, usize>,
}

impl Notices {
    pub(super) fn add(&mut self, sentence: String) {
        let place = *self.place_of.entry(sentence.clone()).or_insert(self.sentences.len());
        match self.sentences.get_mut(place) {
            Some((_, count)) => *count += 1,
            None => self.sentences.push((sentence, 1)),
        }
    }

    pub(super) fn into_sentences(self) -> Vec<String> {
        let sentence = |(sentence, count)| {
            if count > 1 { format!("{sentence} ({count})") } else { sentence }
        };
        self.sentences.into_iter().map(sentence).collect()
    }
}
