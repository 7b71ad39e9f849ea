//! Sources of a primitive's data: accessors, or Draco's form.
//!
//! Positions decide: without them a primitive is left out. Any other attribute that cannot be read is replaced by its
//! default, and a triangle with a corner that does not exist is left out alone.

use ::gltf::json;
use ::gltf::json::accessor::{ComponentType, Type};
use ::gltf::json::mesh::{Mode, Semantic};
use ::gltf::json::validation::Checked;
use bytemuck::Pod;
use glam::Vec2;
use rayon::prelude::*;

use super::accessor::{self, Elements, Purpose};
use super::attribute::attribute;
use super::document::Document;
use super::draco::DracoData;
use super::error::GltfError;
use super::material::UvChannel;
use super::notices::{Notices, Part};

/// Data of a primitive that is being read: in accessors, or in Draco's form.
pub(super) struct Source<'a> {
    pub(super) document: &'a Document<'a>,
    pub(super) primitive: &'a json::mesh::Primitive,
    /// Place of the primitive in the file, for messages.
    pub(super) place: &'a str,
    draco: Option<DracoData>,
    /// Number of vertices in the file.
    count: usize,
    /// Indices of the vertices that triangles have, in rising order, if there are few such; otherwise all are read.
    chosen: Option<Vec<u32>>,
}

impl<'a> Source<'a> {
    /// Source of a primitive's data, which `place` names.
    pub(super) fn new(
        document: &'a Document<'_>,
        primitive: &'a json::mesh::Primitive,
        place: &'a str,
    ) -> Result<Self, GltfError> {
        let draco = DracoData::read(document, primitive, place)?;
        let decoded = draco.as_ref().and_then(DracoData::count);
        let count = match (decoded, attribute(primitive, Semantic::Positions)) {
            (Some(count), _) => count,
            (None, Some(positions)) => accessor::count(document, positions, place)?,
            (None, None) => return Err(document.damaged(&format!("{place}.attributes"), "POSITION is missing")),
        };
        Ok(Self { document, primitive, place, draco, count, chosen: None })
    }

    /// Elements of the accessors that are read.
    pub(super) fn elements(&self) -> Elements<'_> {
        self.chosen.as_deref().map_or(Elements::All, Elements::Chosen)
    }

    /// Fault of an attribute, named by its place, that has another number of elements than there are vertices.
    pub(super) fn check_count(&self, place: &str, count: usize) -> Result<(), GltfError> {
        if count == self.count {
            return Ok(());
        }
        Err(self.document.damaged(place, format!("{count} entries for {} positions", self.count)))
    }

    /// Indices of the vertices that are read, three for each triangle.
    ///
    /// Many primitives may share one large set of vertices. Each reads only those that it needs, so that time and
    /// memory stay in proportion to the triangles.
    pub(super) fn triangles(&mut self, notices: &mut Notices) -> Result<Vec<u32>, GltfError> {
        let (document, place) = (self.document, self.place);
        let corners = match (&self.draco, self.primitive.indices) {
            (Some(draco), _) => draco.indices(),
            (None, Some(index)) => {
                let scalar = |component| (Type::Scalar, component);
                let all = (index.value(), Elements::All);
                if let Some(stored) = accessor::as_stored::<u32>(document, all, scalar(ComponentType::U32)) {
                    stored
                } else if let Some(stored) = accessor::as_stored::<u16>(document, all, scalar(ComponentType::U16)) {
                    stored.into_iter().map(u32::from).collect()
                } else {
                    let place = format!("{place}.indices");
                    accessor::read(document, all, &place, Purpose::Indices, |value| value as u32)?.values
                }
            }
            (None, None) => (0..self.count as u32).collect(),
        };
        let mut indices = match self.primitive.mode {
            Checked::Valid(Mode::TriangleStrip) if self.draco.is_none() => strip(&corners),
            Checked::Valid(Mode::TriangleFan) if self.draco.is_none() => fan(&corners),
            _ => corners,
        };
        if !indices.len().is_multiple_of(3) {
            notices.add(format!("{place} ends in an incomplete triangle, which is left out"));
            indices.truncate(indices.len() / 3 * 3);
        }
        self.keep_whole(&mut indices, notices);
        if self.draco.is_none() && indices.len() < self.count {
            let mut chosen = indices.clone();
            chosen.par_sort_unstable();
            chosen.dedup();
            for index in &mut indices {
                *index = chosen.partition_point(|vertex| vertex < index) as u32;
            }
            self.chosen = Some(chosen);
        }
        Ok(indices)
    }

    /// Leaves out the triangles with a corner that does not exist.
    fn keep_whole(&self, indices: &mut Vec<u32>, notices: &mut Notices) {
        let count = self.count;
        let Some(beyond) = indices.iter().copied().find(|&corner| corner as usize >= count) else { return };
        let before = indices.len() / 3;
        let whole = |corners: &&[u32; 3]| corners.iter().all(|&corner| (corner as usize) < count);
        let kept: Vec<[u32; 3]> = indices.as_chunks::<3>().0.iter().filter(whole).copied().collect();
        let fault = format!("vertex {beyond} of {count}; {} of {before} triangles", before - kept.len());
        notices.left_out(Part::Mesh, &format!("{}.indices", self.place), &fault);
        *indices = kept.into_flattened();
    }

    /// Components of an attribute and their number in an element; `None` if the primitive has no such attribute.
    pub(super) fn attribute(
        &self,
        semantic: Semantic,
        name: &str,
        purpose: Purpose,
    ) -> Result<Option<(Vec<f32>, usize)>, GltfError> {
        let place = format!("{}.attributes.{name}", self.place);
        if let Some(found) = self.draco.as_ref().and_then(|draco| draco.attribute(name)) {
            let (values, width) = found;
            if let Some(expected) = purpose.width().filter(|expected| *expected != width) {
                return Err(self.document.damaged(&place, format!("{width} components instead of {expected}")));
            }
            self.check_count(&place, values.len() / width)?;
            return Ok(Some((values, width)));
        }
        let Some(index) = attribute(self.primitive, semantic) else { return Ok(None) };
        self.check_count(&place, accessor::count(self.document, index, &place)?)?;
        let elements = (index, self.elements());
        let numbers = accessor::read(self.document, elements, &place, purpose, |value| value as f32)?;
        Ok(Some((numbers.values, numbers.width)))
    }

    /// Vectors of an attribute; `None` if the primitive has no such attribute.
    pub(super) fn vectors<T: Pod>(
        &self,
        semantic: Semantic,
        name: &str,
        element: Type,
    ) -> Result<Option<Vec<T>>, GltfError> {
        if let Some(index) = attribute(self.primitive, semantic.clone()).filter(|_| self.draco.is_none()) {
            let place = format!("{}.attributes.{name}", self.place);
            self.check_count(&place, accessor::count(self.document, index, &place)?)?;
            let as_it_is = (element, ComponentType::F32);
            let stored = accessor::as_stored(self.document, (index, self.elements()), as_it_is);
            if stored.is_some() {
                return Ok(stored);
            }
        }
        let found = self.attribute(semantic, name, Purpose::Vectors(element))?;
        Ok(found.map(|(values, _)| bytemuck::pod_collect_to_vec(&values)))
    }

    /// Colours of the vertices; `None` if the primitive has none.
    pub(super) fn colours(&self, semantic: Semantic, name: &str) -> Result<Option<Vec<[f32; 4]>>, GltfError> {
        let found = self.attribute(semantic, name, Purpose::Colours)?;
        Ok(found.map(|(values, width)| {
            let colour = |c: &[f32]| [c[0], c[1], c[2], c.get(3).copied().unwrap_or(1.0)];
            values.chunks_exact(width).map(colour).collect()
        }))
    }

    /// Elements of an attribute that has a default: one that could not be read is `None`, and named.
    pub(super) fn optional<T>(
        &self,
        name: &str,
        found: Result<Option<Vec<T>>, GltfError>,
        notices: &mut Notices,
    ) -> Result<Option<Vec<T>>, GltfError> {
        found.or_else(|error| {
            notices.left_out(Part::Mesh, &format!("{}.attributes.{name}", self.place), &error.part_fault()?);
            Ok(None)
        })
    }

    /// Number of vertices that are read.
    fn number(&self) -> usize {
        self.chosen.as_ref().map_or(self.count, Vec::len)
    }

    /// Texture coordinates of a set as a surface takes them; empty if they are 0, for want of others.
    pub(super) fn uvs(&self, of: UvChannel, notices: &mut Notices) -> Result<Vec<Vec2>, GltfError> {
        let name = format!("TEXCOORD_{}", of.set);
        let found = self.vectors(Semantic::TexCoords(of.set), &name, Type::Vec2);
        Ok(match self.optional(&name, found, notices)? {
            Some(mut uvs) => {
                uvs.iter_mut().for_each(|uv| *uv = of.apply(*uv));
                uvs
            }
            None if of.apply(Vec2::ZERO) == Vec2::ZERO => Vec::new(),
            None => vec![of.apply(Vec2::ZERO); self.number()],
        })
    }
}

/// Triangles of a strip: each vertex with the two before it; every other triangle is reversed.
fn strip(corners: &[u32]) -> Vec<u32> {
    let triangle = |(index, corner): (usize, &[u32])| {
        if index % 2 == 0 { [corner[0], corner[1], corner[2]] } else { [corner[0], corner[2], corner[1]] }
    };
    corners.windows(3).enumerate().flat_map(triangle).collect()
}

/// Triangles of a fan: each vertex with the one before it and the first (glTF 2.0, 3.7.2.1: the first comes last).
fn fan(corners: &[u32]) -> Vec<u32> {
    let first = corners.first().copied().unwrap_or_default();
    corners.get(1..).unwrap_or_default().windows(2).flat_map(|pair| [pair[0], pair[1], first]).collect()
}
