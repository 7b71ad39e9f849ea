//! Growing lists of a glTF file, and its binary chunk.

use std::collections::BTreeMap;
use std::io::Cursor;

use ::gltf::json::accessor::{ComponentType, GenericComponentType, Type};
use ::gltf::json::buffer::{Buffer, Target, View};
use ::gltf::json::image::MimeType;
use ::gltf::json::mesh::{Mode, Primitive, Semantic};
use ::gltf::json::texture::{MagFilter, MinFilter, Sampler, WrappingMode};
use ::gltf::json::validation::{Checked, USize64};
use ::gltf::json::{self, Accessor, Index};
use glam::{Vec2, Vec3};
use half::f16;
use image::codecs::openexr::OpenExrEncoder;
use image::codecs::png::PngEncoder;
use image::{ExtendedColorType, ImageEncoder};
use rayon::prelude::*;
use serde_json::{Value, json};

use super::error::ExportError;
use crate::gltf::extras::COLOURS;
use crate::gltf::file_json::GltfJson;
use scene::{Mesh, Panorama, Texture, Wrap};

/// Growing lists of a glTF file, and its binary chunk.
#[derive(Default)]
pub struct GlbLists {
    /// JSON of the file.
    pub json: GltfJson,
    /// Binary chunk.
    pub blob: Vec<u8>,
}

impl GlbLists {
    /// Adds bytes to the binary chunk.
    fn view(&mut self, bytes: &[u8], target: Option<Target>) -> Index<View> {
        self.blob.resize(self.blob.len().next_multiple_of(4), 0);
        let view = View {
            buffer: Index::new(0),
            byte_offset: Some(USize64::from(self.blob.len())),
            byte_length: USize64::from(bytes.len()),
            byte_stride: None,
            target: target.map(Checked::Valid),
            name: None,
            extensions: None,
            extras: None,
        };
        self.blob.extend_from_slice(bytes);
        Index::push(&mut self.json.buffer_views, view)
    }

    /// Adds values that stand for `count` elements.
    fn accessor(
        &mut self,
        bytes: &[u8],
        target: Target,
        component: ComponentType,
        element: Type,
        count: usize,
    ) -> Index<Accessor> {
        let view = self.view(bytes, Some(target));
        let accessor = Accessor {
            buffer_view: Some(view),
            byte_offset: None,
            count: USize64::from(count),
            component_type: Checked::Valid(GenericComponentType(component)),
            type_: Checked::Valid(element),
            min: None,
            max: None,
            normalized: false,
            sparse: None,
            name: None,
            extensions: None,
            extras: None,
        };
        Index::push(&mut self.json.accessors, accessor)
    }

    fn attribute<T: bytemuck::NoUninit>(&mut self, element: Type, values: &[T]) -> Index<Accessor> {
        let bytes = bytemuck::cast_slice(values);
        self.accessor(bytes, Target::ArrayBuffer, ComponentType::F32, element, values.len())
    }

    /// Adds a mesh. Attributes with default values only are left out.
    pub fn mesh(&mut self, mesh: &Mesh) -> Index<json::Mesh> {
        let mut attributes = BTreeMap::new();
        let mut add = |semantic, accessor| attributes.insert(Checked::Valid(semantic), accessor);

        // Positions come with their bounds, as glTF demands.
        let positions = self.attribute(Type::Vec3, &mesh.positions);
        let least = mesh.positions.iter().copied().fold(Vec3::INFINITY, Vec3::min);
        let most = mesh.positions.iter().copied().fold(Vec3::NEG_INFINITY, Vec3::max);
        let accessor = &mut self.json.accessors[positions.value()];
        (accessor.min, accessor.max) = (Some(json!(least.to_array())), Some(json!(most.to_array())));
        add(Semantic::Positions, positions);
        add(Semantic::Normals, self.attribute(Type::Vec3, &mesh.normals));
        if mesh.uvs.iter().any(|uv| *uv != Vec2::ZERO) {
            add(Semantic::TexCoords(0), self.attribute(Type::Vec2, &mesh.uvs));
        }
        if mesh.colours.iter().any(|colour| *colour != [1.0; 4]) {
            let clamped: Vec<_> = mesh.colours.iter().map(|colour| colour.map(|value| value.min(1.0))).collect();
            add(Semantic::Colors(0), self.attribute(Type::Vec4, &clamped));
            if clamped != mesh.colours {
                add(Semantic::Extras(COLOURS.into()), self.attribute(Type::Vec4, &mesh.colours));
            }
        }

        let bytes = bytemuck::cast_slice(&mesh.indices);
        let (component, count) = (ComponentType::U32, mesh.indices.len());
        let indices = self.accessor(bytes, Target::ElementArrayBuffer, component, Type::Scalar, count);
        let primitive = Primitive {
            attributes,
            indices: Some(indices),
            material: Some(Index::new(mesh.material as u32)),
            mode: Checked::Valid(Mode::Triangles),
            targets: None,
            extensions: None,
            extras: None,
        };
        let name = Some(mesh.name.clone());
        let mesh = json::Mesh { name, primitives: vec![primitive], weights: None, extensions: None, extras: None };
        Index::push(&mut self.json.meshes, mesh)
    }

    /// Adds textures, with their pictures as PNG.
    ///
    /// # Errors
    /// [`ExportError::Value`] for a picture that cannot be encoded.
    pub fn textures(&mut self, textures: &[Texture]) -> Result<(), ExportError> {
        let encoded: Vec<_> = textures.par_iter().map(png).collect::<Result<_, _>>()?;
        for (texture, png) in textures.iter().zip(encoded) {
            let name = || Some(texture.name.clone());
            let image = json::Image {
                name: name(),
                buffer_view: Some(self.view(&png, None)),
                mime_type: Some(MimeType("image/png".into())),
                uri: None,
                extensions: None,
                extras: None,
            };
            let source = Index::push(&mut self.json.images, image);
            let sampler = Some(Index::push(&mut self.json.samplers, sampler(texture)));
            let texture = json::Texture { name: name(), source, sampler, extensions: None, extras: None };
            self.json.textures.push(texture);
        }
        Ok(())
    }

    /// Adds a panorama as EXR, which keeps every bit; the result refers to it in JSON.
    ///
    /// # Errors
    /// [`ExportError::Value`] for a panorama that cannot be encoded.
    pub fn panorama(&mut self, panorama: &Panorama, scene: &str) -> Result<Value, ExportError> {
        let exr = exr(panorama, scene)?;
        Ok(json!({ "bufferView": self.view(&exr, None).value() }))
    }

    /// JSON and binary chunk of the finished file.
    pub fn finish(mut self) -> (GltfJson, Vec<u8>) {
        let byte_length = USize64::from(self.blob.len());
        self.json.buffers = vec![Buffer { byte_length, name: None, uri: None, extensions: None, extras: None }];
        (self.json, self.blob)
    }
}

/// Sampling of a texture. Minification is linear between mipmaps.
fn sampler(texture: &Texture) -> Sampler {
    let [wrap_s, wrap_t] = texture.wrap.map(|wrap| match wrap {
        Wrap::Repeat => Checked::Valid(WrappingMode::Repeat),
        Wrap::Mirror => Checked::Valid(WrappingMode::MirroredRepeat),
        Wrap::Clamp => Checked::Valid(WrappingMode::ClampToEdge),
    });
    let magnified = if texture.nearest { MagFilter::Nearest } else { MagFilter::Linear };
    Sampler {
        mag_filter: Some(Checked::Valid(magnified)),
        min_filter: Some(Checked::Valid(MinFilter::LinearMipmapLinear)),
        wrap_s,
        wrap_t,
        ..Sampler::default()
    }
}

fn exr(panorama: &Panorama, scene: &str) -> Result<Vec<u8>, ExportError> {
    let Panorama { width, height, rgb } = panorama;
    let mut bytes = Cursor::new(Vec::new());
    let encoder = OpenExrEncoder::new(&mut bytes);
    let rgb: Vec<[f32; 3]> = rgb.iter().map(|pixel| pixel.map(f16::to_f32)).collect();
    let result = encoder.write_image(bytemuck::cast_slice(&rgb), *width, *height, ExtendedColorType::Rgb32F);
    let fault = "it cannot be encoded as EXR";
    result.map_err(|_| ExportError::Value { what: "the panorama", name: scene.into(), fault })?;
    Ok(bytes.into_inner())
}

fn png(texture: &Texture) -> Result<Vec<u8>, ExportError> {
    let mut bytes = Cursor::new(Vec::new());
    let encoder = PngEncoder::new(&mut bytes);
    let result = encoder.write_image(&texture.rgba, texture.width, texture.height, ExtendedColorType::Rgba8);
    let fault = "it cannot be encoded as PNG";
    result.map_err(|_| ExportError::Value { what: "a picture", name: texture.name.clone(), fault })?;
    Ok(bytes.into_inner())
}
