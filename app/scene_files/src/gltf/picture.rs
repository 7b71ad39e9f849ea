//! Pictures: PNG and JPEG, decoded to 8-bit sRGB.
//!
//! A few kilobytes of PNG can claim gigabytes of pixels, so sizes are read and added up before any picture is
//! decoded.

use std::collections::{BTreeMap, BTreeSet};
use std::io::Cursor;
use std::sync::atomic::{AtomicUsize, Ordering};

use ::gltf::json::texture::{MagFilter, Sampler, WrappingMode};
use ::gltf::json::validation::Checked;
use image::{ImageFormat, ImageReader, RgbaImage};
use rayon::prelude::*;

use super::container::Document;
use super::error::GltfError;
use super::material::textures_used;
use super::notices::Notices;
use super::progress::{LoadStage, Progress};
use scene::{Material, Texture, Wrap};

/// Longest side of a picture, pixels: the limit of graphics processors.
const MAX_SIDE: u32 = 16384;

/// Largest number of bytes that all decoded pictures of a scene may have.
const MAX_BYTES: u64 = 4 << 30;

/// Textures that materials draw; the materials' texture indices become indices into the result.
///
/// Textures of the file that differ in neither picture nor sampling become one.
pub(super) fn textures(
    document: &Document,
    materials: &mut [Material],
    notices: &mut Notices,
    progress: &(impl Fn(Progress) + Sync),
) -> Result<Vec<Texture>, GltfError> {
    let mut used: Vec<usize> = textures_used(materials).into_iter().collect();
    used.sort_unstable();

    // Find the picture and the sampling of each texture.
    let mut looks = BTreeMap::new();
    for index in used {
        let place = format!("textures[{index}]");
        let texture = document.item(&document.json.textures, index, &place)?;
        let source = texture.source.value();
        if source == u32::MAX as usize {
            notices.add(format!("{place} is neither PNG nor JPEG and is not drawn"));
            continue;
        }
        let image = document.item(&document.json.images, source, &format!("{place}.source"))?;
        let sampler = match texture.sampler {
            Some(sampler) => document.item(&document.json.samplers, sampler.value(), &format!("{place}.sampler"))?,
            None => &Sampler::default(),
        };
        let wrap = |mode| match mode {
            Checked::Valid(WrappingMode::Repeat) => Ok(Wrap::Repeat),
            Checked::Valid(WrappingMode::MirroredRepeat) => Ok(Wrap::Mirror),
            Checked::Valid(WrappingMode::ClampToEdge) => Ok(Wrap::Clamp),
            Checked::Invalid => Err(document.damaged(&place, "its sampler repeats in a way that does not exist")),
        };
        let wrap = [wrap(sampler.wrap_s)?, wrap(sampler.wrap_t)?];
        let nearest = sampler.mag_filter == Some(Checked::Valid(MagFilter::Nearest));
        let name = texture.name.clone().or_else(|| image.name.clone()).unwrap_or_else(|| format!("picture {source}"));
        looks.insert(index, TextureLook { source, name, wrap, nearest });
    }

    // Decode each picture once.
    let sources: BTreeSet<usize> = looks.values().map(|look| look.source).collect();
    let mut encoded = Vec::new();
    let mut bytes = 0;
    for source in sources {
        let place = format!("images[{source}]");
        match Encoded::read(document, source, &place) {
            Ok(picture) => {
                bytes += picture.decoded_bytes();
                encoded.push(picture);
            }
            Err(GltfError::Read { path, error }) => {
                notices.add(format!("the picture {} is missing and not drawn ({error})", path.display()));
            }
            Err(error) => return Err(error),
        }
        if bytes > MAX_BYTES {
            return Err(document.too_large(&place, format!("pictures of more than {MAX_BYTES} bytes in all")));
        }
    }
    let (done, total) = (AtomicUsize::new(0), encoded.len());
    let decode = |picture: &Encoded| {
        let pixels = picture.decode(document)?;
        progress(Progress { stage: LoadStage::Pictures, done: done.fetch_add(1, Ordering::Relaxed) + 1, total });
        Ok((picture.source, pixels))
    };
    let pictures: BTreeMap<usize, RgbaImage> = encoded.par_iter().map(decode).collect::<Result<_, GltfError>>()?;

    // Make the textures, and note where the file's indices have gone.
    let mut textures: Vec<Texture> = Vec::new();
    let mut place_of_look = BTreeMap::new();
    let mut place_of_index = BTreeMap::new();
    for (index, look) in looks {
        let Some(picture) = pictures.get(&look.source) else {
            continue;
        };
        let place = *place_of_look
            .entry((look.source, look.wrap.map(|wrap| wrap as u8), look.nearest))
            .or_insert(textures.len());
        if place == textures.len() {
            let (width, height) = picture.dimensions();
            let TextureLook { name, wrap, nearest, .. } = look;
            textures.push(Texture { name, width, height, rgba: picture.as_raw().clone(), wrap, nearest });
        }
        place_of_index.insert(index, place);
    }
    for material in materials {
        for texture in [&mut material.base_colour_texture, &mut material.emissive_texture] {
            *texture = texture.and_then(|index| place_of_index.get(&index).copied());
        }
    }
    Ok(textures)
}

/// Texture of the file before its picture is decoded.
struct TextureLook {
    /// Index into the file's images.
    source: usize,
    name: String,
    wrap: [Wrap; 2],
    nearest: bool,
}

/// Picture as it stands in the file, and its size.
struct Encoded {
    /// Index into the file's images.
    source: usize,
    bytes: Vec<u8>,
    format: ImageFormat,
    width: u32,
    height: u32,
}

impl Encoded {
    fn read(document: &Document, source: usize, place: &str) -> Result<Self, GltfError> {
        let image = &document.json.images[source];
        let bytes = match (image.buffer_view, &image.uri) {
            (Some(view), _) => document.view(view.value(), place)?.0.to_vec(),
            (None, Some(uri)) => document.fetch(uri, place)?,
            (None, None) => {
                return Err(document.damaged(place, "it has neither an address nor a buffer view"));
            }
        };
        let format = match image::guess_format(&bytes) {
            Ok(format @ (ImageFormat::Png | ImageFormat::Jpeg)) => format,
            _ => return Err(document.damaged(place, "it is neither PNG nor JPEG")),
        };
        let size = ImageReader::with_format(Cursor::new(&bytes), format).into_dimensions();
        let (width, height) = size.map_err(|error| document.damaged(place, error.to_string()))?;
        if width.max(height) > MAX_SIDE || width.min(height) == 0 {
            let fault = format!("a picture of {width} × {height} pixels, where sides of 1 to {MAX_SIDE} are possible");
            return Err(document.too_large(place, fault));
        }
        Ok(Self { source, bytes, format, width, height })
    }

    fn decoded_bytes(&self) -> u64 {
        u64::from(self.width) * u64::from(self.height) * 4
    }

    fn decode(&self, document: &Document) -> Result<RgbaImage, GltfError> {
        let mut reader = ImageReader::with_format(Cursor::new(&self.bytes), self.format);
        let mut limits = image::Limits::default();
        // 16 bits a channel, and the decoder's own buffers.
        limits.max_alloc = Some(4 * self.decoded_bytes() + (1 << 20));
        reader.limits(limits);
        let damaged =
            |error: image::ImageError| document.damaged(&format!("images[{}]", self.source), error.to_string());
        Ok(reader.decode().map_err(damaged)?.into_rgba8())
    }
}
