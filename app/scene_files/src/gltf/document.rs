//! Document: the file itself, its JSON, and the bytes it refers to.
//!
//! Buffers are read once each, and only from regular files, as reading a pipe that a scene names would never end. A
//! buffer that is missing or short is no reason to refuse the file: what lies beyond its end is left out.

use std::collections::BTreeMap;
use std::path::{Path, PathBuf};
use std::sync::{Arc, OnceLock};

use ::gltf::json;
use decoders::meshopt;
use gltf_text::address::{Address, address};
use gltf_text::repair::{may_wrap, repaired};
use regular_file::{Budget, FileFault};
use serde::Deserialize;
use serde_json::Value;

use super::container::{chunks, range};
use super::error::GltfError;
use super::extras::SceneExtras;
use super::file_json::GltfJson;
use super::notices::{Notices, Part};

/// Largest size of a file that is read, bytes: a `.glb` cannot count further.
const MAX_FILE: u64 = u32::MAX as u64;

/// Extension of compressed buffer views, and its name before it was ratified.
const MESHOPT: [&str; 2] = ["EXT_meshopt_compression", "KHR_meshopt_compression"];

/// File that has been opened and parsed as JSON; indices in it are not yet checked.
pub(super) struct Document<'a> {
    pub(super) path: PathBuf,
    pub(super) json: GltfJson,
    pub(super) budget: &'a Budget,
    trust: bool,
    buffers: Vec<SharedBytes>,
    /// Decoded bytes of compressed views, or the fault, once they were asked for.
    unpacked: Vec<OnceLock<Result<Vec<u8>, GltfError>>>,
}

/// Part of a file, shared by the buffers that lie in it.
#[derive(Clone, Default)]
struct SharedBytes {
    file: Arc<Vec<u8>>,
    start: usize,
    end: usize,
}

impl SharedBytes {
    fn whole(file: Arc<Vec<u8>>) -> Self {
        let end = file.len();
        Self { file, start: 0, end }
    }

    fn bytes(&self) -> &[u8] {
        &self.file[self.start..self.end]
    }
}

/// Part of the JSON that every version of the format has.
#[derive(Deserialize)]
struct VersionJson {
    asset: json::Asset,
}

impl<'a> Document<'a> {
    /// Opens a file. With `trust`, it may refer to files outside its folder.
    pub(super) fn open(path: &Path, budget: &'a Budget, trust: bool, notices: &mut Notices) -> Result<Self, GltfError> {
        let bytes = Arc::new(read_file(path, budget)?);
        if bytes.is_empty() {
            return Err(GltfError::Empty { path: path.into() });
        }
        let not_gltf = |fault: String| GltfError::NotGltf { path: path.into(), fault };
        let found = chunks(&bytes).map_err(not_gltf)?;
        if found.missing > 0 {
            let fault = format!("{} bytes are missing at its end", found.missing);
            notices.left_out(Part::File, "the file is cut short", &fault);
        }
        let text = &bytes[found.json];

        let parsed = if may_wrap(text) {
            Err("an index is larger than 32 bits hold".to_owned())
        } else {
            serde_json::from_slice::<GltfJson>(text).map_err(|error| error.to_string())
        };
        let json = match parsed {
            Ok(json) => json,
            Err(fault) => {
                // With another version the parser's sentence is of no help.
                let head = serde_json::from_slice::<VersionJson>(text).ok();
                if let Some(fault) = head.and_then(|head| version_fault(&head.asset)) {
                    return Err(not_gltf(fault));
                }
                repaired(text, notices).ok_or_else(|| not_gltf(fault))?
            }
        };
        if let Some(fault) = version_fault(&json.asset) {
            return Err(not_gltf(fault));
        }
        let unpacked = json.buffer_views.iter().map(|_| OnceLock::new()).collect();
        let mut document = Self { path: path.into(), json, budget, trust, buffers: Vec::new(), unpacked };
        let blob = found.blob.map(|blob| SharedBytes { file: Arc::clone(&bytes), start: blob.start, end: blob.end });
        document.buffers = document.read_buffers(blob, notices)?;
        Ok(document)
    }

    fn read_buffers(&self, blob: Option<SharedBytes>, notices: &mut Notices) -> Result<Vec<SharedBytes>, GltfError> {
        let mut files = BTreeMap::<&str, Arc<Vec<u8>>>::new();
        let mut buffers = Vec::with_capacity(self.json.buffers.len());
        for (index, buffer) in self.json.buffers.iter().enumerate() {
            let place = format!("buffers[{index}]");
            let fallback = buffer.extensions.as_ref().is_some_and(|extensions| {
                MESHOPT.iter().any(|name| extensions.others.get(*name).is_some_and(|of| of["fallback"] == true))
            });
            let read = match (&buffer.uri, &blob) {
                (Some(uri), _) => match files.get(uri.as_str()) {
                    Some(file) => Ok(SharedBytes::whole(Arc::clone(file))),
                    None => self.fetch(uri, &place).map(|bytes| {
                        let file = Arc::new(bytes);
                        files.insert(uri, Arc::clone(&file));
                        SharedBytes::whole(file)
                    }),
                },
                (None, Some(blob)) if index == 0 => Ok(blob.clone()),
                // The buffer stands for data that are there in compressed form.
                (None, _) if fallback || self.stands_for_packed(index) => Ok(SharedBytes::default()),
                (None, _) => Err(self.damaged(&place, "it has neither an address nor a binary chunk")),
            };
            let bytes = match read {
                Ok(bytes) => bytes,
                Err(error) => {
                    notices.left_out(Part::Mesh, &place, &error.part_fault()?);
                    SharedBytes::default()
                }
            };
            let there = bytes.bytes().len() as u64;
            if there < buffer.byte_length.0 && there > 0 {
                let fault = format!("{there} bytes of {} are there: it is cut short", buffer.byte_length.0);
                notices.left_out(Part::Mesh, &place, &fault);
            }
            buffers.push(bytes);
        }
        Ok(buffers)
    }

    /// True if all views of a buffer are there in compressed form, too.
    fn stands_for_packed(&self, buffer: usize) -> bool {
        let packed = |view: &json::buffer::View| {
            let extensions = view.extensions.as_ref();
            extensions.is_some_and(|extensions| MESHOPT.iter().any(|name| extensions.others.contains_key(*name)))
        };
        let mut views = self.json.buffer_views.iter().filter(|view| view.buffer.value() == buffer).peekable();
        views.peek().is_some() && views.all(packed)
    }

    /// Bytes behind an address: data in the address itself, or a file beside the scene.
    pub(super) fn fetch(&self, uri: &str, place: &str) -> Result<Vec<u8>, GltfError> {
        match address(uri, self.trust).map_err(|fault| self.damaged(place, fault))? {
            Address::Data(bytes) => {
                self.take(bytes.len() as u64, place)?;
                Ok(bytes)
            }
            Address::File(names) => {
                let folder = self.path.parent().unwrap_or(Path::new(""));
                let paths: Vec<PathBuf> = names.iter().map(|name| folder.join(name)).collect();
                let path = paths.iter().find(|path| path.exists()).unwrap_or(&paths[0]);
                read_file(path, self.budget)
            }
        }
    }

    /// Item of one of the JSON's lists; `place` is where its index stands.
    pub(super) fn item<'b, T>(&self, list: &'b [T], index: usize, place: &str) -> Result<&'b T, GltfError> {
        list.get(index).ok_or_else(|| self.damaged(place, format!("there is no number {index} among {}", list.len())))
    }

    /// Bytes of a buffer view, and its stride if it has one. A compressed view is unpacked when it is first asked for.
    pub(super) fn view(&self, index: usize, place: &str) -> Result<(&[u8], Option<usize>), GltfError> {
        let view = self.item(&self.json.buffer_views, index, place)?;
        let place = format!("bufferViews[{index}]");
        let stride = view.byte_stride.map(|stride| stride.0).filter(|&stride| stride > 0);
        let packed = view
            .extensions
            .as_ref()
            .and_then(|extensions| MESHOPT.iter().find_map(|name| extensions.others.get(*name)).map(PackedView::read));
        if let Some(packed) = packed {
            let unpacked = self.unpacked[index].get_or_init(|| match &packed {
                Ok(packed) => self.unpack(packed, &place),
                Err(fault) => Err(self.damaged(&place, fault)),
            });
            if let (Ok(packed), Ok(bytes)) = (packed, unpacked) {
                return Ok((bytes, Some(packed.stride)));
            }
            let plain = self.plain_view(view, &place).map(|bytes| (bytes, stride));
            return match (plain, unpacked) {
                (Err(_), Err(error)) => Err(error.clone()),
                (plain, _) => plain,
            };
        }
        Ok((self.plain_view(view, &place)?, stride))
    }

    fn plain_view(&self, view: &json::buffer::View, place: &str) -> Result<&[u8], GltfError> {
        let offset = view.byte_offset.map_or(0, |offset| offset.0);
        let buffer = self.item(&self.buffers, view.buffer.value(), place)?.bytes();
        // What is missing at the end may be nothing that is needed.
        let length = view.byte_length.0.min((buffer.len() as u64).saturating_sub(offset));
        let length = if length == 0 { view.byte_length.0 } else { length };
        self.part(view.buffer.value(), offset, length, place)
    }

    fn part(&self, buffer: usize, offset: u64, length: u64, place: &str) -> Result<&[u8], GltfError> {
        let buffer = self.item(&self.buffers, buffer, place)?.bytes();
        range(buffer, offset, length).ok_or_else(|| {
            let fault = format!("{length} bytes from {offset} on, in a buffer of {}", buffer.len());
            self.damaged(place, fault)
        })
    }

    fn unpack(&self, packed: &PackedView, place: &str) -> Result<Vec<u8>, GltfError> {
        let bytes = self.part(packed.buffer, packed.offset, packed.length, place)?;
        meshopt::decode(bytes, packed.count, packed.stride, packed.mode, packed.filter, self.budget)
            .map_err(|fault| self.undecodable(place, fault))
    }

    /// Index of the scene to show: the default one, else the first; `None` if the file has none, so that all its
    /// nodes are shown.
    pub(super) fn scene_index(&self, notices: &mut Notices) -> Option<usize> {
        let scenes = self.json.scenes.len();
        if scenes > 1 {
            notices.add(format!("only one of the file's {scenes} scenes is drawn"));
        }
        let index = self.json.scene.map(|index| index.value());
        if let Some(index) = index.filter(|&index| index >= scenes) {
            notices.left_out(Part::File, "scene", &format!("there is no number {index} among {scenes}"));
        }
        index.filter(|&index| index < scenes).or((scenes > 0).then_some(0))
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

    /// Takes memory from the budget.
    pub(super) fn take(&self, bytes: u64, place: &str) -> Result<(), GltfError> {
        self.budget.take(bytes).map_err(|fault| GltfError::OverBudget {
            path: self.path.clone(),
            place: place.into(),
            fault,
        })
    }

    /// Error about data that a decoder refuses.
    pub(super) fn undecodable(&self, place: &str, fault: decoders::DecodeError) -> GltfError {
        match fault {
            decoders::DecodeError::OverBudget(fault) => {
                GltfError::OverBudget { path: self.path.clone(), place: place.into(), fault }
            }
            fault => self.damaged(place, fault.to_string()),
        }
    }

    pub(super) fn damaged(&self, place: &str, fault: impl Into<String>) -> GltfError {
        GltfError::Damaged { path: self.path.clone(), place: place.into(), fault: fault.into() }
    }

    pub(super) fn too_large(&self, place: &str, fault: impl Into<String>) -> GltfError {
        GltfError::TooLarge { path: self.path.clone(), place: place.into(), fault: fault.into() }
    }
}

/// Compressed buffer view, as its extension describes it.
struct PackedView {
    buffer: usize,
    offset: u64,
    length: u64,
    count: usize,
    stride: usize,
    mode: meshopt::Mode,
    filter: meshopt::Filter,
}

impl PackedView {
    /// Reads a description, or says what of it is unknown.
    fn read(extension: &Value) -> Result<Self, String> {
        let number = |key: &str| match extension.get(key) {
            None => Ok(0),
            Some(value) => value.as_u64().ok_or_else(|| format!("{key} of its compression is {value}")),
        };
        let size =
            |key: &str| number(key).and_then(|number| usize::try_from(number).map_err(|error| error.to_string()));
        Ok(Self {
            buffer: size("buffer")?,
            offset: number("byteOffset")?,
            length: number("byteLength")?,
            count: size("count")?,
            stride: size("byteStride")?,
            mode: match extension.get("mode").and_then(Value::as_str) {
                Some("ATTRIBUTES") => meshopt::Mode::Attributes,
                Some("TRIANGLES") => meshopt::Mode::Triangles,
                Some("INDICES") => meshopt::Mode::Indices,
                other => {
                    return Err(format!(
                        "the mode {} of its compression is unknown",
                        other.unwrap_or("without a name")
                    ));
                }
            },
            filter: match extension.get("filter").and_then(Value::as_str) {
                None | Some("NONE") => meshopt::Filter::None,
                Some("OCTAHEDRAL") => meshopt::Filter::Octahedral,
                Some("QUATERNION") => meshopt::Filter::Quaternion,
                Some("EXPONENTIAL") => meshopt::Filter::Exponential,
                Some("COLOR") => meshopt::Filter::Colour,
                Some(other) => return Err(format!("the filter {other} of its compression is unknown")),
            },
        })
    }
}

/// Refusal of a file's version, if it is not 2.0 or compatible.
fn version_fault(asset: &json::Asset) -> Option<String> {
    let needed = asset.min_version.as_deref().unwrap_or("2.0");
    let good = (asset.version.starts_with("2.") || asset.version == "2") && ["2.0", "2"].contains(&needed);
    (!good).then(|| format!("its version is {} (at least {needed})", asset.version))
}

fn read_file(path: &Path, budget: &Budget) -> Result<Vec<u8>, GltfError> {
    // The length is asked for first: a file of zeros takes no room on a disk, but all of it in memory.
    let length = std::fs::metadata(path).map_or(0, |metadata| if metadata.is_file() { metadata.len() } else { 0 });
    if length <= MAX_FILE {
        budget.take(length).map_err(|fault| GltfError::OverBudget {
            path: path.into(),
            place: "the file".into(),
            fault,
        })?;
    }
    regular_file::read(path, MAX_FILE).map_err(|fault| match fault {
        FileFault::System(error) => GltfError::Read { path: path.into(), error: Arc::new(error) },
        FileFault::NotAFile => GltfError::NotAFile { path: path.into() },
        FileFault::TooLarge { most } => {
            let fault = format!("more than {most} bytes");
            GltfError::TooLarge { path: path.into(), place: "the file".into(), fault }
        }
    })
}
