//! Scenes to binary glTF 2.0, for other programs and for [`crate::gltf::load`], which gives back the same scene.
//!
//! Every mesh becomes a node with a mesh of its own that stands at the scene's origin. Pictures are embedded as PNG,
//! a panorama as EXR. Data that glTF cannot express (light, white, start, circuit, solid meshes) go into
//! `extras.rapidity`, spectra into `extras.spectrum`. Emission above 1 is written as a factor and a power of two as
//! `KHR_materials_emissive_strength`, so that their product is exact. Vertex colours above 1, which glTF forbids, are
//! clamped for other programs and kept in an attribute of this program's own.

use std::io::Cursor;
use std::path::{Path, PathBuf};

use glam::{DMat4, Vec2, Vec3};
use image::codecs::openexr::OpenExrEncoder;
use image::codecs::png::PngEncoder;
use image::{ExtendedColorType, ImageEncoder};
use rayon::prelude::*;
use serde_json::{Map, Value, json};

use crate::gltf::extras::{COLOURS, LightExtras, NodeExtras, SceneExtras};
use crate::gltf::spectrum;
use crate::panorama::is_equirectangular;
use scene::motion::{Motion, Uniform};
use scene::{Alpha, Lamp, Material, Mesh, Panorama, Scene, SceneFault, Texture, Wrap};

/// Code of `componentType` for 32-bit floats.
const FLOAT: u32 = 5126;
/// Code of `componentType` for 32-bit indices.
const UNSIGNED_INT: u32 = 5125;
/// Code of `target` for vertex attributes.
const ARRAY_BUFFER: u32 = 34962;
/// Code of `target` for indices.
const ELEMENT_ARRAY_BUFFER: u32 = 34963;

/// Reason why a scene cannot be written.
#[derive(Debug, thiserror::Error)]
pub enum ExportError {
    /// A file that the operating system cannot write.
    #[error("cannot write {path}: {error}; check the folder, its permissions and the space left")]
    Write {
        /// Path of the file.
        path: PathBuf,
        /// Error of the operating system.
        error: std::io::Error,
    },
    /// A scene without triangles, which glTF does not allow.
    #[error("scene \"{scene}\" has no triangles to write")]
    Nothing {
        /// Name of the scene.
        scene: String,
    },
    /// A scene that breaks a promise of its types.
    #[error(transparent)]
    Damaged(#[from] SceneFault),
    /// A value that glTF cannot express.
    #[error("glTF cannot express {what} of \"{name}\": {fault}")]
    Value {
        /// Name of the property.
        what: &'static str,
        /// Name of its mesh, material or scene.
        name: String,
        /// Reason why it cannot be expressed.
        fault: &'static str,
    },
    /// A file beyond 4 GiB: a `.glb` counts bytes with 32 bits.
    #[error("{path} would have {bytes} bytes, and a .glb holds {} at most; write fewer meshes at a time", u32::MAX)]
    TooLarge {
        /// Path of the file.
        path: PathBuf,
        /// Size of the file, bytes.
        bytes: u64,
    },
}

/// Writes a scene as `.glb`.
///
/// The complete file appears at once, or not at all. Meshes without triangles, [`Scene::notices`] and the keys of
/// animations are left out.
///
/// # Errors
/// [`ExportError`], for example for non-finite values or base colours outside 0…1.
pub fn write_glb(scene: &Scene, path: &Path) -> Result<(), ExportError> {
    scene.validate()?;
    check_values(scene)?;
    let mut file = File::default();
    file.textures(&scene.textures)?;
    let materials: Vec<Value> = scene.materials.iter().map(material).collect();
    let drawn: Vec<&Mesh> = scene.meshes.iter().filter(|mesh| !mesh.indices.is_empty()).collect();
    if drawn.is_empty() {
        return Err(ExportError::Nothing { scene: scene.name.clone() });
    }
    let (mut roots, mut nodes, mut meshes) = (Vec::new(), Vec::new(), Vec::new());
    for mesh in drawn {
        let mut node = json!({
            "name": mesh.name,
            "mesh": meshes.len(),
            "translation": scene.origin.to_array(),
            "extras": NodeExtras { solid: Some(mesh.solid) }.to_json(),
        });
        // A moving mesh is the child of a node at its motion's anchor.
        roots.push(nodes.len());
        if let Some(motion) = mesh.motion {
            let above = match &scene.motions[motion] {
                Motion::Uniform(Uniform { celerity, anchor }) => {
                    node["translation"] = json!((scene.origin - anchor.position).to_array());
                    json!({
                        "translation": anchor.position.to_array(),
                        "extras": { "celerity": celerity.vector().to_array(), "at": anchor.ct },
                    })
                }
                // Keys are left out: the mesh is placed by its pose at time 0.
                Motion::Animated(animated) => {
                    node["translation"] = json!([0.0, 0.0, 0.0]);
                    let pose = DMat4::from(animated.at(0.0).world_from_body);
                    json!({ "matrix": pose.to_cols_array() })
                }
            };
            nodes.push(above);
            let (last, child) = (nodes.len() - 1, nodes.len());
            nodes[last]["children"] = json!([child]);
        }
        nodes.push(node);
        meshes.push(file.mesh(mesh));
    }
    for (number, lamp) in scene.lamps.iter().enumerate() {
        roots.push(nodes.len());
        nodes.push(lamp_node(number, lamp));
    }
    let extras = SceneExtras {
        origin: Some(scene.origin.to_array()),
        light: LightExtras::of(scene.light, scene.illuminant.as_ref().map(spectrum::to_json)),
        white: scene.white,
        panorama: scene.panorama.as_ref().map(|panorama| file.panorama(panorama, &scene.name)).transpose()?,
        start: Some(scene.start),
        circuit: scene.circuit.iter().map(|point| point.to_array()).collect(),
    };
    let mut root = json!({
        "asset": { "version": "2.0", "generator": concat!("Rapidity ", env!("CARGO_PKG_VERSION")) },
        "scene": 0,
        "scenes": [{ "name": scene.name, "nodes": roots, "extras": extras.into_json() }],
        "nodes": nodes,
        "meshes": meshes,
        "materials": materials,
        "accessors": file.accessors,
        "bufferViews": file.views,
        "buffers": [{ "byteLength": file.blob.len() }],
    });
    // glTF does not allow empty lists, so these are written only if they have entries.
    let lists = [("images", file.images), ("textures", file.textures), ("samplers", file.samplers)];
    for (name, list) in lists.into_iter().filter(|(_, list)| !list.is_empty()) {
        root[name] = json!(list);
    }
    if !scene.lamps.is_empty() {
        let lights: Vec<Value> = scene.lamps.iter().map(lamp).collect();
        root["extensions"] = json!({ "KHR_lights_punctual": { "lights": lights } });
    }
    let extensions = extensions_used(scene);
    if !extensions.is_empty() {
        root["extensionsUsed"] = json!(extensions);
    }
    write(path, root.to_string().into_bytes(), file.blob)
}

fn check_values(scene: &Scene) -> Result<(), ExportError> {
    let ensure = |holds: bool, what, name: &str, fault| {
        if holds { Ok(()) } else { Err(ExportError::Value { what, name: name.into(), fault }) }
    };
    const FINITE: &str = "it is not finite";
    let name = &scene.name;
    ensure(scene.origin.is_finite(), "the origin", name, FINITE)?;
    ensure(scene.start.position.is_finite() && scene.start.look.is_finite(), "the start", name, FINITE)?;
    ensure(scene.circuit.iter().all(|point| point.is_finite()), "the circuit", name, FINITE)?;
    let light = &scene.light;
    let light = [light.sun_direction.to_array(), light.sun, light.sky, light.ground, light.zenith, light.horizon];
    ensure(light.as_flattened().iter().all(|value| value.is_finite()), "the light", name, FINITE)?;
    if let Some(panorama) = &scene.panorama {
        let light = panorama.rgb.as_flattened().iter().all(|value| value.is_finite() && *value >= 0.0);
        ensure(light, "the panorama", name, "it has a radiance that is negative or not finite")?;
        let around = is_equirectangular(panorama.width, panorama.height);
        ensure(around, "the panorama", name, "it is not twice as wide as high")?;
    }
    for texture in &scene.textures {
        ensure(!texture.rgba.is_empty(), "a picture", &texture.name, "it has no pixels")?;
    }
    for material in &scene.materials {
        let fraction = |value: &f32| (0.0..=1.0).contains(value);
        let name = &material.name;
        ensure(material.base_colour.iter().all(fraction), "the base colour", name, "it is not within 0…1")?;
        // The limit is half the largest f32, so that there is a power of two above it.
        let emissive = (material.emissive.iter()).all(|value| (0.0..=f32::MAX / 2.0).contains(value));
        ensure(emissive, "the emission", name, "it is negative or too large")?;
        let cutoff = !matches!(material.alpha, Alpha::Mask(cutoff) if !(cutoff.is_finite() && cutoff >= 0.0));
        ensure(cutoff, "the opacity threshold", name, "it is negative or not finite")?;
    }
    for lamp in &scene.lamps {
        let colour = lamp.colour.iter().all(|value| value.is_finite() && *value >= 0.0);
        ensure(lamp.position.is_finite() && colour, "a lamp", &lamp.name, "it is not finite")?;
    }
    for mesh in &scene.meshes {
        ensure(mesh.positions.iter().all(|position| position.is_finite()), "a position", &mesh.name, FINITE)?;
        ensure(mesh.normals.iter().all(|normal| normal.is_finite()), "a normal", &mesh.name, FINITE)?;
        ensure(mesh.uvs.iter().all(|uv| uv.is_finite()), "a texture coordinate", &mesh.name, FINITE)?;
        let colours = mesh.colours.as_flattened().iter().all(|value| value.is_finite() && *value >= 0.0);
        ensure(colours, "a vertex colour", &mesh.name, "it is negative or not finite")?;
    }
    Ok(())
}

/// Growing lists of a glTF file, and its binary chunk.
#[derive(Default)]
struct File {
    blob: Vec<u8>,
    views: Vec<Value>,
    accessors: Vec<Value>,
    images: Vec<Value>,
    textures: Vec<Value>,
    samplers: Vec<Value>,
}

impl File {
    fn view(&mut self, bytes: &[u8], target: Option<u32>) -> usize {
        self.blob.resize(self.blob.len().next_multiple_of(4), 0);
        let mut view = json!({ "buffer": 0, "byteOffset": self.blob.len(), "byteLength": bytes.len() });
        if let Some(target) = target {
            view["target"] = json!(target);
        }
        self.blob.extend_from_slice(bytes);
        push(&mut self.views, view)
    }

    fn attribute<T: bytemuck::NoUninit>(&mut self, kind: &str, values: &[T]) -> usize {
        let view = self.view(bytemuck::cast_slice(values), Some(ARRAY_BUFFER));
        let accessor = json!({ "bufferView": view, "componentType": FLOAT, "type": kind, "count": values.len() });
        push(&mut self.accessors, accessor)
    }

    /// Adds the data of a mesh. Attributes with default values only are left out.
    fn mesh(&mut self, mesh: &Mesh) -> Value {
        let positions = self.attribute("VEC3", &mesh.positions);
        let least = mesh.positions.iter().copied().fold(Vec3::INFINITY, Vec3::min);
        let most = mesh.positions.iter().copied().fold(Vec3::NEG_INFINITY, Vec3::max);
        self.accessors[positions]["min"] = json!(least.to_array());
        self.accessors[positions]["max"] = json!(most.to_array());
        let mut attributes = Map::new();
        attributes.insert("POSITION".into(), json!(positions));
        attributes.insert("NORMAL".into(), json!(self.attribute("VEC3", &mesh.normals)));
        if mesh.uvs.iter().any(|uv| *uv != Vec2::ZERO) {
            attributes.insert("TEXCOORD_0".into(), json!(self.attribute("VEC2", &mesh.uvs)));
        }
        if mesh.colours.iter().any(|colour| *colour != [1.0; 4]) {
            let clamped: Vec<_> = mesh.colours.iter().map(|colour| colour.map(|value| value.min(1.0))).collect();
            attributes.insert("COLOR_0".into(), json!(self.attribute("VEC4", &clamped)));
            if clamped != mesh.colours {
                attributes.insert(format!("_{COLOURS}"), json!(self.attribute("VEC4", &mesh.colours)));
            }
        }
        let view = self.view(bytemuck::cast_slice(&mesh.indices), Some(ELEMENT_ARRAY_BUFFER));
        let count = mesh.indices.len();
        let indices = json!({ "bufferView": view, "componentType": UNSIGNED_INT, "type": "SCALAR", "count": count });
        let indices = push(&mut self.accessors, indices);
        let primitive = json!({ "attributes": attributes, "indices": indices, "material": mesh.material });
        json!({ "name": mesh.name, "primitives": [primitive] })
    }

    /// Adds a panorama as EXR, which keeps every bit; the result refers to it in JSON.
    fn panorama(&mut self, panorama: &Panorama, scene: &str) -> Result<Value, ExportError> {
        let exr = exr(panorama, scene)?;
        Ok(json!({ "bufferView": self.view(&exr, None) }))
    }

    fn textures(&mut self, textures: &[Texture]) -> Result<(), ExportError> {
        let encoded: Vec<_> = textures.par_iter().map(png).collect::<Result<_, _>>()?;
        for (texture, png) in textures.iter().zip(encoded) {
            let view = self.view(&png, None);
            let image = json!({ "name": texture.name, "bufferView": view, "mimeType": "image/png" });
            let [wrap_s, wrap_t] = texture.wrap.map(|wrap| match wrap {
                Wrap::Repeat => 10497,
                Wrap::Mirror => 33648,
                Wrap::Clamp => 33071,
            });
            // Magnification is nearest or linear; minification is linear between mipmaps.
            let magnified = if texture.nearest { 9728 } else { 9729 };
            let sampler = json!({ "wrapS": wrap_s, "wrapT": wrap_t, "magFilter": magnified, "minFilter": 9987 });
            let image = push(&mut self.images, image);
            let sampler = push(&mut self.samplers, sampler);
            self.textures.push(json!({ "name": texture.name, "source": image, "sampler": sampler }));
        }
        Ok(())
    }
}

fn exr(panorama: &Panorama, scene: &str) -> Result<Vec<u8>, ExportError> {
    let Panorama { width, height, rgb } = panorama;
    let mut bytes = Cursor::new(Vec::new());
    let encoder = OpenExrEncoder::new(&mut bytes);
    let result = encoder.write_image(bytemuck::cast_slice(rgb), *width, *height, ExtendedColorType::Rgb32F);
    let fault = "it cannot be encoded as EXR";
    result.map_err(|_| ExportError::Value { what: "the panorama", name: scene.into(), fault })?;
    Ok(bytes.into_inner())
}

fn push(list: &mut Vec<Value>, item: Value) -> usize {
    list.push(item);
    list.len() - 1
}

fn png(texture: &Texture) -> Result<Vec<u8>, ExportError> {
    let mut bytes = Cursor::new(Vec::new());
    let encoder = PngEncoder::new(&mut bytes);
    let result = encoder.write_image(&texture.rgba, texture.width, texture.height, ExtendedColorType::Rgba8);
    let fault = "it cannot be encoded as PNG";
    result.map_err(|_| ExportError::Value { what: "a picture", name: texture.name.clone(), fault })?;
    Ok(bytes.into_inner())
}

/// Smallest power of two that is at least the emission and at least 1.
fn emissive_strength(material: &Material) -> f32 {
    let largest = material.emissive.into_iter().fold(1.0, f32::max);
    let power = largest.log2().ceil().exp2();
    if power < largest { 2.0 * power } else { power }
}

fn material(material: &Material) -> Value {
    let mut surface = json!({
        "baseColorFactor": material.base_colour,
        "metallicFactor": material.metallic,
        "roughnessFactor": material.roughness,
    });
    if let Some(texture) = material.base_colour_texture {
        surface["baseColorTexture"] = json!({ "index": texture });
    }
    let strength = emissive_strength(material);
    let mut value = json!({
        "name": material.name,
        "pbrMetallicRoughness": surface,
        "emissiveFactor": material.emissive.map(|value| value / strength),
        "doubleSided": material.double_sided,
    });
    if let Some(texture) = material.emissive_texture {
        value["emissiveTexture"] = json!({ "index": texture });
    }
    if let Some(spectrum) = &material.spectrum {
        value["extras"] = json!({ "spectrum": spectrum::to_json(spectrum) });
    }
    match material.alpha {
        Alpha::Opaque => {}
        Alpha::Mask(cutoff) => {
            value["alphaMode"] = json!("MASK");
            value["alphaCutoff"] = json!(cutoff);
        }
        Alpha::Blend => value["alphaMode"] = json!("BLEND"),
    }
    let mut extensions = Map::new();
    if material.unlit {
        extensions.insert("KHR_materials_unlit".into(), json!({}));
    }
    if strength > 1.0 {
        extensions.insert("KHR_materials_emissive_strength".into(), json!({ "emissiveStrength": strength }));
    }
    if material.transmission > 0.0 {
        let transmission = json!({ "transmissionFactor": material.transmission });
        extensions.insert("KHR_materials_transmission".into(), transmission);
    }
    if material.index_of_refraction != 1.5 {
        extensions.insert("KHR_materials_ior".into(), json!({ "ior": material.index_of_refraction }));
    }
    if material.solid_glass {
        extensions.insert("KHR_materials_volume".into(), json!({ "thicknessFactor": 1.0 }));
    }
    if !extensions.is_empty() {
        value["extensions"] = Value::Object(extensions);
    }
    value
}

/// Node of a lamp, which shines along the node's −z.
fn lamp_node(number: usize, lamp: &Lamp) -> Value {
    let mut node = json!({
        "name": lamp.name,
        "translation": lamp.position.to_array(),
        "extensions": { "KHR_lights_punctual": { "light": number } },
    });
    if let Some(spot) = lamp.spot {
        let turn = glam::DQuat::from_rotation_arc(glam::DVec3::NEG_Z, spot.direction);
        node["rotation"] = json!(turn.to_array());
    }
    node
}

/// Lamp as a glTF light in candela: its light at one metre, of which π lux show white as white.
fn lamp(lamp: &Lamp) -> Value {
    let mut light = json!({
        "name": lamp.name,
        "type": if lamp.spot.is_some() { "spot" } else { "point" },
        "color": lamp.colour,
        "intensity": std::f32::consts::PI,
    });
    if let Some(range) = lamp.range {
        light["range"] = json!(range);
    }
    if let Some(spot) = lamp.spot {
        light["spot"] = json!({ "innerConeAngle": spot.inner_rad, "outerConeAngle": spot.outer_rad });
    }
    if let Some(spectrum) = &lamp.spectrum {
        light["extras"] = json!({ "spectrum": spectrum::to_json(spectrum) });
    }
    light
}

fn extensions_used(scene: &Scene) -> Vec<&'static str> {
    let any = |has: fn(&Material) -> bool| scene.materials.iter().any(has);
    let names = [
        (!scene.lamps.is_empty(), "KHR_lights_punctual"),
        (any(|material| material.unlit), "KHR_materials_unlit"),
        (any(|material| emissive_strength(material) > 1.0), "KHR_materials_emissive_strength"),
        (any(|material| material.transmission > 0.0), "KHR_materials_transmission"),
        (any(|material| material.index_of_refraction != 1.5), "KHR_materials_ior"),
        (any(|material| material.solid_glass), "KHR_materials_volume"),
    ];
    names.into_iter().filter_map(|(used, name)| used.then_some(name)).collect()
}

/// Writes header and chunks, each padded to whole words, under a temporary name first.
fn write(path: &Path, mut text: Vec<u8>, mut blob: Vec<u8>) -> Result<(), ExportError> {
    text.resize(text.len().next_multiple_of(4), b' ');
    blob.resize(blob.len().next_multiple_of(4), 0);
    let bytes = (12 + 8 + text.len() + 8 + blob.len()) as u64;
    let Ok(length) = u32::try_from(bytes) else {
        return Err(ExportError::TooLarge { path: path.into(), bytes });
    };
    // The casts lose nothing: both values are less than `length`.
    let word = |value: usize| (value as u32).to_le_bytes();
    let header = [&b"glTF"[..], &2_u32.to_le_bytes(), &length.to_le_bytes(), &word(text.len()), b"JSON"].concat();
    let middle = [&word(blob.len()), &b"BIN\0"[..]].concat();
    let mut partial = path.as_os_str().to_owned();
    partial.push(".part");
    let partial = PathBuf::from(partial);
    let result = std::fs::File::create(&partial).and_then(|mut file| {
        for part in [&header, &text, &middle, &blob] {
            std::io::Write::write_all(&mut file, part)?;
        }
        file.sync_all()?;
        std::fs::rename(&partial, path)
    });
    result.map_err(|error| {
        // A failure to remove the partial file is ignored; the first error is the one to report.
        let _ = std::fs::remove_file(&partial);
        ExportError::Write { path: path.into(), error }
    })
}
