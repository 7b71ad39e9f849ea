//! Container: the file itself, its chunks, its JSON, and the bytes it refers to.
//!
//! A `.glb` is a header (magic, version, length) and chunks (length, kind, bytes). A `.gltf` is the JSON alone, with
//! buffers beside it or within it as base64. Only regular files are opened, as reading a pipe that a scene names
//! would never end.

use regular_file::FileFault;
use std::borrow::Cow;
use std::path::{Component, Path, PathBuf};

use ::gltf::json;
use serde::Deserialize;

use super::error::GltfError;
use super::extras::SceneExtras;
use super::file_json::GltfJson;
use super::notices::{EXTENSIONS, Notices};

/// Largest size of a file that is read, bytes: a `.glb` cannot count further.
const MAX_FILE: u64 = u32::MAX as u64;

/// File that has been opened and parsed as JSON; indices in it are not yet checked.
pub(super) struct Document {
    pub(super) path: PathBuf,
    pub(super) json: GltfJson,
    buffers: Vec<Vec<u8>>,
}

/// Part of the JSON that every version of the format has.
#[derive(Deserialize)]
struct VersionJson {
    asset: json::Asset,
}

impl Document {
    pub(super) fn open(path: &Path) -> Result<Self, GltfError> {
        let bytes = read_file(path)?;
        if bytes.is_empty() {
            return Err(GltfError::Empty { path: path.into() });
        }
        let not_gltf = |fault: String| GltfError::NotGltf { path: path.into(), fault };
        let (text, blob) = if bytes.starts_with(b"glTF") {
            chunks(&bytes).map_err(not_gltf)?
        } else {
            (bytes.strip_prefix(b"\xef\xbb\xbf").unwrap_or(&bytes), None)
        };
        if text.iter().find(|byte| !byte.is_ascii_whitespace()) != Some(&b'{') {
            return Err(not_gltf("it is neither a .glb nor JSON".into()));
        }

        let json: GltfJson = match serde_json::from_slice(text) {
            Ok(json) => json,
            Err(error) => {
                // With another version the parser's sentence is of no help.
                let head = serde_json::from_slice::<VersionJson>(text).ok();
                let fault = head.and_then(|head| version_fault(&head.asset)).unwrap_or_else(|| error.to_string());
                return Err(not_gltf(fault));
            }
        };
        if let Some(fault) = version_fault(&json.asset) {
            return Err(not_gltf(fault));
        }
        if let Some(name) = json.extensions_required.iter().find(|name| !EXTENSIONS.contains(&name.as_str())) {
            return Err(GltfError::Extension { path: path.into(), name: name.clone() });
        }
        let mut document = Self { path: path.into(), json, buffers: Vec::new() };
        document.buffers = document.read_buffers(blob)?;
        Ok(document)
    }

    fn read_buffers(&self, blob: Option<&[u8]>) -> Result<Vec<Vec<u8>>, GltfError> {
        let read = |(index, buffer): (usize, &json::Buffer)| {
            let place = format!("buffers[{index}]");
            let bytes = match (&buffer.uri, blob) {
                (Some(uri), _) => self.fetch(uri, &place)?,
                (None, Some(blob)) if index == 0 => blob.to_vec(),
                (None, _) => {
                    return Err(self.damaged(&place, "it has neither an address nor a binary chunk"));
                }
            };
            if (bytes.len() as u64) < buffer.byte_length.0 {
                let fault = format!("{} bytes of {} are there: it is cut short", bytes.len(), buffer.byte_length.0);
                return Err(self.damaged(&place, fault));
            }
            Ok(bytes)
        };
        self.json.buffers.iter().enumerate().map(read).collect()
    }

    /// Bytes behind a URI: base64 in the URI itself, or a file beside the scene.
    pub(super) fn fetch(&self, uri: &str, place: &str) -> Result<Vec<u8>, GltfError> {
        if let Some(data) = uri.strip_prefix("data:") {
            let (_, text) =
                data.split_once(";base64,").ok_or_else(|| self.damaged(place, "its data: address is not base64"))?;
            return base64::decode(text).map_err(|error| self.damaged(place, format!("its base64 is wrong: {error}")));
        }
        if uri.contains("://") {
            return Err(self.damaged(place, format!("{uri} is not a file beside the scene")));
        }
        let name = urlencoding::decode(uri).unwrap_or(Cow::Borrowed(uri));
        read_file(&self.path.parent().unwrap_or(Path::new("")).join(name.as_ref()))
    }

    /// Bytes of a file that must lie in the scene's own folder or below it.
    pub(super) fn beside(&self, uri: &str, place: &str) -> Result<Vec<u8>, GltfError> {
        let name = urlencoding::decode(uri).unwrap_or(Cow::Borrowed(uri));
        if !stays_below(Path::new(name.as_ref())) {
            return Err(self.damaged(place, format!("{uri} is not a file beside the scene")));
        }
        self.fetch(uri, place)
    }

    /// Item of one of the JSON's lists; `place` is where its index stands.
    pub(super) fn item<'a, T>(&self, list: &'a [T], index: usize, place: &str) -> Result<&'a T, GltfError> {
        list.get(index).ok_or_else(|| self.damaged(place, format!("there is no number {index} among {}", list.len())))
    }

    /// Bytes of a buffer view, and its stride if it has one.
    pub(super) fn view(&self, index: usize, place: &str) -> Result<(&[u8], Option<usize>), GltfError> {
        let view = self.item(&self.json.buffer_views, index, place)?;
        let place = format!("bufferViews[{index}]");
        let buffer = self.item(&self.buffers, view.buffer.value(), &place)?;
        let offset = view.byte_offset.map_or(0, |offset| offset.0);
        let bytes = range(buffer, offset, view.byte_length.0).ok_or_else(|| {
            let fault = format!("{} bytes from {offset} on, in a buffer of {}", view.byte_length.0, buffer.len());
            self.damaged(&place, fault)
        })?;
        Ok((bytes, view.byte_stride.map(|stride| stride.0).filter(|&stride| stride > 0)))
    }

    /// Index of the scene to show: the default one, else the first; `None` if the file has none, so that all its
    /// nodes are shown.
    pub(super) fn scene_index(&self, notices: &mut Notices) -> Result<Option<usize>, GltfError> {
        let index = self.json.scene.map(|index| index.value());
        if let Some(index) = index {
            self.item(&self.json.scenes, index, "scene")?;
        }
        if self.json.scenes.len() > 1 {
            notices.add(format!("only one of the file's {} scenes is drawn", self.json.scenes.len()));
        }
        Ok(index.or((!self.json.scenes.is_empty()).then_some(0)))
    }

    pub(super) fn scene_name(&self, index: Option<usize>) -> String {
        let name = index.and_then(|index| self.json.scenes[index].name.clone());
        name.unwrap_or_else(|| self.path.file_stem().unwrap_or_default().to_string_lossy().into_owned())
    }

    pub(super) fn scene_extras(&self, index: Option<usize>) -> Result<SceneExtras, GltfError> {
        let Some(index) = index else {
            return Ok(SceneExtras::default());
        };
        let place = format!("scenes[{index}].extras.rapidity");
        SceneExtras::read(&self.json.scenes[index].extras).map_err(|fault| self.damaged(&place, fault))
    }

    pub(super) fn damaged(&self, place: &str, fault: impl Into<String>) -> GltfError {
        GltfError::Damaged { path: self.path.clone(), place: place.into(), fault: fault.into() }
    }

    pub(super) fn too_large(&self, place: &str, fault: impl Into<String>) -> GltfError {
        GltfError::TooLarge { path: self.path.clone(), place: place.into(), fault: fault.into() }
    }
}

/// Refusal of a file's version, if it is not 2.0 or compatible.
fn version_fault(asset: &json::Asset) -> Option<String> {
    let needed = asset.min_version.as_deref().unwrap_or("2.0");
    let good = asset.version.starts_with("2.") && needed == "2.0";
    (!good).then(|| format!("its version is {} (at least {needed})", asset.version))
}

/// Part of a slice, by numbers from a file; `None` if it does not exist.
pub(super) fn range(bytes: &[u8], offset: u64, length: u64) -> Option<&[u8]> {
    let start = usize::try_from(offset).ok()?;
    let end = usize::try_from(offset.checked_add(length)?).ok()?;
    bytes.get(start..end)
}

fn read_file(path: &Path) -> Result<Vec<u8>, GltfError> {
    regular_file::read(path, MAX_FILE).map_err(|fault| match fault {
        FileFault::System(error) => GltfError::Read { path: path.into(), error },
        FileFault::NotAFile => GltfError::NotAFile { path: path.into() },
        FileFault::TooLarge { most } => {
            let fault = format!("more than {most} bytes");
            GltfError::TooLarge { path: path.into(), place: "the file".into(), fault }
        }
    })
}

/// JSON chunk and binary chunk of a `.glb`.
fn chunks(bytes: &[u8]) -> Result<(&[u8], Option<&[u8]>), String> {
    let number = |offset: usize| Some(u32::from_le_bytes(bytes.get(offset..offset + 4)?.try_into().ok()?));
    let version = number(4).ok_or("its header is cut short")?;
    if version != 2 {
        return Err(format!("its container has version {version}, not 2"));
    }
    let length = number(8).ok_or("its header is cut short")?;
    if length as usize > bytes.len() {
        return Err(format!("{} bytes of {length} are there: it is cut short", bytes.len()));
    }
    let chunk = |offset: usize| {
        let size = u64::from(number(offset)?);
        Some((bytes.get(offset + 4..offset + 8)?, range(bytes, offset as u64 + 8, size)?))
    };
    let (kind, text) = chunk(12).ok_or("its first chunk is cut short")?;
    if kind != b"JSON" {
        return Err("its first chunk is not JSON".into());
    }
    let next = 12 + 8 + text.len();
    let used = text.iter().rposition(|&byte| byte != 0).map_or(0, |last| last + 1);
    let text = &text[..used]; // some exporters fill up with zeros instead of spaces
    if next >= length as usize {
        return Ok((text, None));
    }
    let (kind, blob) = chunk(next).ok_or("its second chunk is cut short")?;
    Ok((text, (kind == b"BIN\0").then_some(blob)))
}

/// True if a relative path stays in the folder that it starts from.
pub(super) fn stays_below(path: &Path) -> bool {
    path.components().all(|component| matches!(component, Component::Normal(_) | Component::CurDir))
}
