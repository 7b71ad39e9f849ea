//! Pictures: decoded to 8-bit sRGB, each once, on all cores.
//!
//! A few kilobytes of PNG can claim gigabytes of pixels, so the memory of each picture, and of each of its copies for
//! drawing, is taken from the budget before it is decoded.

use std::collections::BTreeMap;
use std::sync::Arc;
use std::sync::atomic::{AtomicUsize, Ordering};

use ::gltf::json::texture::{MagFilter, Sampler, WrappingMode};
use ::gltf::json::validation::Checked;
use decoders::picture::{DecodedPicture, decode, size};
use rayon::prelude::*;
use serde_json::Value;

use super::document::Document;
use super::error::GltfError;
use super::material::textures_used;
use super::notices::{Notices, Part};
use super::progress::{LoadStage, Progress};
use scene::{Material, Texture, Wrap};

/// Extensions of a texture that name another picture, which is preferred.
const SOURCES: [&str; 2] = ["KHR_texture_basisu", "EXT_texture_webp"];

/// Memory of a pixel's mipmaps for drawing, in thirds of a byte. The pixel itself leaves memory when it is on
/// the device.
const MIPMAP_THIRDS: u64 = 4;

/// Place of a picture's bytes; pictures with the same place are one.
#[derive(Clone, Debug, PartialEq, Eq, PartialOrd, Ord)]
enum PictureKey {
    View(usize),
    Address(String),
}

/// Texture of the file before its picture is decoded.
struct TextureLook {
    /// Indices into the file's images, the preferred one first.
    images: Vec<usize>,
    name: String,
    wrap: [Wrap; 2],
    nearest: bool,
}

/// Pictures that were decoded, or the faults for which they were not.
type Decoded = BTreeMap<PictureKey, Result<DecodedPicture, GltfError>>;

/// Textures that materials draw; the materials' texture indices become indices into the result.
///
/// Textures of the file that differ in neither picture nor sampling become one.
pub(super) fn textures(
    document: &Document<'_>,
    materials: &mut [Material],
    notices: &mut Notices,
    progress: &(impl Fn(Progress) + Sync),
) -> Result<Vec<Texture>, GltfError> {
    let mut used: Vec<usize> = textures_used(materials).into_iter().collect();
    used.sort_unstable();
    let mut looks = BTreeMap::new();
    for index in used {
        match TextureLook::read(document, index, notices) {
            Ok(look) => {
                looks.insert(index, look);
            }
            Err(error) => notices.left_out(Part::Picture, &format!("textures[{index}]"), &error.part_fault()?),
        }
    }

    // Decode the pictures that are preferred, then those that take the place of one that cannot be read.
    let mut decoded = Decoded::new();
    loop {
        let mut wanted: Vec<(PictureKey, usize)> = Vec::new();
        for look in looks.values() {
            for &image in &look.images {
                let Ok(key) = key(document, image) else { continue };
                match decoded.get(&key) {
                    Some(Ok(_)) => break,
                    Some(Err(_)) => {}
                    None => {
                        wanted.push((key, image));
                        break;
                    }
                }
            }
        }
        wanted.sort_unstable();
        wanted.dedup_by(|a, b| a.0 == b.0);
        if wanted.is_empty() {
            break;
        }
        let (done, total) = (AtomicUsize::new(0), wanted.len());
        let read = |(key, image): (PictureKey, usize)| {
            let picture = read_picture(document, &key, &format!("images[{image}]"));
            progress(Progress { stage: LoadStage::Pictures, done: done.fetch_add(1, Ordering::Relaxed) + 1, total });
            (key, picture)
        };
        decoded.par_extend(wanted.into_par_iter().map(read));
    }

    // Make the textures, and note where the file's indices have gone.
    let mut pictures = BTreeMap::<PictureKey, ([u32; 2], Arc<Vec<u8>>)>::new();
    let mut textures: Vec<Texture> = Vec::new();
    let mut place_of_look = BTreeMap::new();
    let mut place_of_index = BTreeMap::new();
    for (index, look) in looks {
        let place = format!("textures[{index}]");
        let Some((key, image)) = look.found(document, &mut decoded, &mut pictures, notices)? else { continue };
        let known = (key.clone(), look.wrap.map(|wrap| wrap as u8), look.nearest);
        let at = match place_of_look.get(&known) {
            Some(at) => *at,
            None => {
                let ([width, height], rgba) = pictures[&key].clone();
                document.take(u64::from(width) * u64::from(height) * MIPMAP_THIRDS / 3, &place)?;
                let TextureLook { wrap, nearest, name, .. } = look;
                let name = if name.is_empty() { format!("picture {image}") } else { name };
                textures.push(Texture { name, width, height, rgba, wrap, nearest });
                place_of_look.insert(known, textures.len() - 1);
                textures.len() - 1
            }
        };
        place_of_index.insert(index, at);
    }
    for material in materials {
        for texture in [&mut material.base_colour_texture, &mut material.emissive_texture] {
            *texture = texture.and_then(|index| place_of_index.get(&index).copied());
        }
    }
    Ok(textures)
}

/// Place of an image's bytes.
fn key(document: &Document<'_>, image: usize) -> Result<PictureKey, GltfError> {
    let place = format!("images[{image}]");
    let image = document.item(&document.json.images, image, &place)?;
    match (image.buffer_view, &image.uri) {
        (Some(view), _) => Ok(PictureKey::View(view.value())),
        (None, Some(uri)) => Ok(PictureKey::Address(uri.clone())),
        (None, None) => Err(document.damaged(&place, "it has neither an address nor a buffer view")),
    }
}

fn read_picture(document: &Document<'_>, key: &PictureKey, place: &str) -> Result<DecodedPicture, GltfError> {
    let fetched;
    let bytes = match key {
        PictureKey::View(view) => document.view(*view, place)?.0,
        PictureKey::Address(uri) => {
            fetched = document.fetch(uri, place)?;
            &fetched
        }
    };
    let whole = size(bytes).and_then(|_| decode(bytes, document.budget));
    let decoded = whole.map_err(|fault| document.undecodable(place, fault));
    if let PictureKey::Address(_) = key {
        document.budget.give_back(bytes.len() as u64);
    }
    decoded
}

impl TextureLook {
    fn read(document: &Document<'_>, index: usize, notices: &mut Notices) -> Result<Self, GltfError> {
        let place = format!("textures[{index}]");
        let texture = document.item(&document.json.textures, index, &place)?;
        let others = texture.extensions.as_ref().map(|extensions| &extensions.others);
        let preferred = SOURCES.iter().filter_map(|name| {
            let source = others?.get(*name)?.get("source").and_then(Value::as_u64)?;
            usize::try_from(source).ok()
        });
        let plain = Some(texture.source.value()).filter(|&source| source != u32::MAX as usize);
        let images: Vec<usize> = preferred.chain(plain).collect();
        let Some(first) = images.first() else {
            let kinds: Vec<&str> = others.into_iter().flatten().map(|(name, _)| name.as_str()).collect();
            let fault = if kinds.is_empty() { "it names no picture".to_owned() } else { kinds.join(", ") };
            return Err(document.damaged(&place, fault));
        };
        let default = Sampler::default();
        let sampler = match texture.sampler.map(|sampler| document.json.samplers.get(sampler.value())) {
            Some(Some(sampler)) => sampler,
            Some(None) => {
                notices.add(format!("{place} has a sampler that does not exist: it repeats"));
                &default
            }
            None => &default,
        };
        let wrap = |mode| match mode {
            Checked::Valid(WrappingMode::Repeat) | Checked::Invalid => Wrap::Repeat,
            Checked::Valid(WrappingMode::MirroredRepeat) => Wrap::Mirror,
            Checked::Valid(WrappingMode::ClampToEdge) => Wrap::Clamp,
        };
        let wrap = [wrap(sampler.wrap_s), wrap(sampler.wrap_t)];
        let nearest = sampler.mag_filter == Some(Checked::Valid(MagFilter::Nearest));
        let of_image = || document.json.images.get(*first).and_then(|image| image.name.clone());
        let name = texture.name.clone().or_else(of_image).unwrap_or_default();
        Ok(Self { images, name, wrap, nearest })
    }

    /// First picture that could be read, and its image's index; else all faults are noted.
    fn found(
        &self,
        document: &Document<'_>,
        decoded: &mut Decoded,
        pictures: &mut BTreeMap<PictureKey, ([u32; 2], Arc<Vec<u8>>)>,
        notices: &mut Notices,
    ) -> Result<Option<(PictureKey, usize)>, GltfError> {
        let mut faults = Vec::new();
        for &image in &self.images {
            let key = match key(document, image) {
                Ok(key) => key,
                Err(error) => {
                    faults.push((image, error));
                    continue;
                }
            };
            if pictures.contains_key(&key) {
                return Ok(Some((key, image)));
            }
            match decoded.get_mut(&key) {
                Some(Ok(picture)) => {
                    if let Some(notice) = picture.notice.take() {
                        notices.add(format!("of the picture images[{image}]: {notice}"));
                    }
                    let rgba = Arc::new(std::mem::take(&mut picture.rgba));
                    pictures.insert(key.clone(), ([picture.width, picture.height], rgba));
                    return Ok(Some((key, image)));
                }
                Some(Err(error)) => faults.push((image, error.clone())),
                None => {}
            }
        }
        for (image, error) in faults {
            notices.left_out(Part::Picture, &format!("images[{image}]"), &error.part_fault()?);
        }
        Ok(None)
    }
}
