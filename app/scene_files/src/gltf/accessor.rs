//! Accessors: numbers in buffers.
//!
//! An accessor gives the number, type and place of elements in a buffer view, and may replace some of them (sparse).
//! Every claim of it is compared with the bytes that are there before a single element is read or memory asked for.

use ::gltf::json;
use ::gltf::json::accessor::{ComponentType, Type};
use ::gltf::json::validation::Checked;
use bytemuck::Pod;

use super::container::range;
use super::document::Document;
use super::error::GltfError;
use scene::MAX_TRIANGLES;

/// Components of an accessor's elements, one after the other.
pub(super) struct AccessorNumbers<T> {
    pub(super) values: Vec<T>,
    /// Number of components of an element.
    pub(super) width: usize,
}

/// Purpose of an accessor, which limits the types it may have.
#[derive(Clone, Copy, PartialEq)]
pub(super) enum Purpose {
    /// Vectors of this type; integers are normalised if the accessor says so.
    Vectors(Type),
    /// Three or four components; integers are fractions of their largest value, even if the accessor does not say so
    /// (some exporters forget it).
    Colours,
    /// Indices: unsigned integers.
    Indices,
    /// Joints of a skin: four unsigned integers.
    Joints,
}

impl Purpose {
    /// Number of components of an element; `None` if it may have several.
    pub(super) fn width(self) -> Option<usize> {
        match self {
            Self::Vectors(vector) => Some(vector.multiplicity()),
            Self::Colours => None,
            Self::Indices => Some(1),
            Self::Joints => Some(4),
        }
    }

    fn allows(self, element: Type, component: ComponentType) -> bool {
        match self {
            Self::Vectors(vector) => element == vector && component != ComponentType::U32,
            Self::Colours => matches!(element, Type::Vec3 | Type::Vec4) && component != ComponentType::U32,
            Self::Indices => {
                use ComponentType::{U8, U16, U32};
                element == Type::Scalar && matches!(component, U8 | U16 | U32)
            }
            Self::Joints => {
                use ComponentType::{U8, U16, U32};
                element == Type::Vec4 && matches!(component, U8 | U16 | U32)
            }
        }
    }
}

/// Elements of an accessor that are read.
#[derive(Clone, Copy)]
pub(super) enum Elements<'a> {
    All,
    /// Elements with these indices, in rising order, each below the number of elements.
    Chosen(&'a [u32]),
}

impl Elements<'_> {
    /// Number of them in an accessor of `count` elements.
    fn number(self, count: usize) -> usize {
        match self {
            Self::All => count,
            Self::Chosen(chosen) => chosen.len(),
        }
    }

    /// Index of the element that is read as number `number`.
    fn index(self, number: usize) -> usize {
        match self {
            Self::All => number,
            Self::Chosen(chosen) => chosen[number] as usize,
        }
    }

    /// Number at which the element `index` is read; `None` if it is not.
    fn place(self, index: usize) -> Option<usize> {
        match self {
            Self::All => Some(index),
            Self::Chosen(chosen) => chosen.binary_search(&u32::try_from(index).ok()?).ok(),
        }
    }
}

/// Number of elements that an accessor claims to have, at most as many as any scene may have.
pub(super) fn count(document: &Document<'_>, index: usize, place: &str) -> Result<usize, GltfError> {
    let count = document.item(&document.json.accessors, index, place)?.count.0;
    let limit = 3 * MAX_TRIANGLES;
    usize::try_from(count)
        .ok()
        .filter(|&count| count <= limit)
        .ok_or_else(|| document.too_large(&format!("accessors[{index}]"), format!("{count} elements, above {limit}")))
}

/// Reads the components of an accessor's elements. Time and memory are in proportion to those that are read.
pub(super) fn read<T: Copy>(
    document: &Document<'_>,
    (index, elements): (usize, Elements<'_>),
    place: &str,
    purpose: Purpose,
    convert: impl Fn(f64) -> T,
) -> Result<AccessorNumbers<T>, GltfError> {
    let count = count(document, index, place)?;
    let accessor = document.item(&document.json.accessors, index, place)?;
    let place = format!("accessors[{index}]");
    let (Checked::Valid(json::accessor::GenericComponentType(component)), Checked::Valid(element)) =
        (accessor.component_type, accessor.type_)
    else {
        return Err(document.damaged(&place, "its type is unknown"));
    };
    if !purpose.allows(element, component) {
        return Err(document.damaged(&place, format!("{element:?} of {component:?} does not belong there")));
    }
    let width = element.multiplicity();
    let normalized = match purpose {
        Purpose::Vectors(_) => accessor.normalized,
        Purpose::Colours => true,
        Purpose::Indices | Purpose::Joints => false,
    };
    let decode = |bytes: &[u8]| convert(decode(bytes, component, normalized));

    // Read the elements themselves; without a buffer view they are zeros, to be replaced.
    let mut values = match accessor.buffer_view {
        Some(view) => {
            let offset = accessor.byte_offset.map_or(0, |offset| offset.0);
            let layout = Layout { offset, count, size: width * component.size() };
            let mut values = Vec::with_capacity(elements.number(count) * width);
            for element in layout.elements(document, view.value(), &place, elements)? {
                values.extend(element.chunks_exact(component.size()).map(&decode));
            }
            values
        }
        None => {
            let number = elements.number(count) * width;
            document.take((number * size_of::<T>()) as u64, &place)?;
            vec![convert(0.0); number]
        }
    };

    // Apply the sparse replacements.
    if let Some(sparse) = &accessor.sparse {
        let place = format!("{place}.sparse");
        let replaced = usize::try_from(sparse.count.0).ok().filter(|&replaced| replaced <= count);
        let replaced = replaced.ok_or_else(|| document.damaged(&place, "it replaces more elements than there are"))?;
        let Checked::Valid(json::accessor::IndexComponentType(number)) = sparse.indices.component_type else {
            return Err(document.damaged(&place, "the type of its indices is unknown"));
        };
        let indices = Layout { offset: sparse.indices.byte_offset.0, count: replaced, size: number.size() };
        let with = Layout { offset: sparse.values.byte_offset.0, count: replaced, size: width * component.size() };
        let indices = indices.elements(document, sparse.indices.buffer_view.value(), &place, Elements::All)?;
        let with = with.elements(document, sparse.values.buffer_view.value(), &place, Elements::All)?;
        for (index, element) in indices.zip(with) {
            let index = self::decode(index, number, false) as usize;
            if index >= count {
                return Err(document.damaged(&place, format!("it replaces element {index} of {count}")));
            }
            let Some(number) = elements.place(index) else { continue };
            let values = &mut values[number * width..][..width];
            for (value, bytes) in values.iter_mut().zip(element.chunks_exact(component.size())) {
                *value = decode(bytes);
            }
        }
    }
    Ok(AccessorNumbers { values, width })
}

/// Elements of an accessor that lie in the file as they lie in memory, with this type; `None` if they have to be
/// converted one by one, or are faulty.
pub(super) fn as_stored<T: Pod>(
    document: &Document<'_>,
    (index, elements): (usize, Elements<'_>),
    (element, component): (Type, ComponentType),
) -> Option<Vec<T>> {
    let accessor = document.json.accessors.get(index)?;
    let known = matches!(accessor.component_type, Checked::Valid(stored) if stored.0 == component)
        && matches!(accessor.type_, Checked::Valid(stored) if stored == element);
    let converted = accessor.sparse.is_some() || accessor.normalized || cfg!(target_endian = "big");
    if !known || converted || size_of::<T>() != element.multiplicity() * component.size() {
        return None;
    }
    let place = format!("accessors[{index}]");
    let count = count(document, index, &place).ok()?;
    let offset = accessor.byte_offset.map_or(0, |offset| offset.0);
    let layout = Layout { offset, count, size: size_of::<T>() };
    let (bytes, stride) = layout.range(document, accessor.buffer_view?.value(), &place).ok()?;
    let element = |number| bytemuck::pod_read_unaligned(&bytes[elements.index(number) * stride..][..size_of::<T>()]);
    Some(match elements {
        Elements::All if stride == size_of::<T>() => bytemuck::pod_collect_to_vec(&bytes[..count * stride]),
        _ => (0..elements.number(count)).map(element).collect(),
    })
}

/// Layout of elements in a buffer view.
struct Layout {
    offset: u64,
    count: usize,
    /// Size of an element, bytes.
    size: usize,
}

impl Layout {
    /// Bytes of each element that is read; all of them exist.
    fn elements<'a>(
        &self,
        document: &'a Document<'_>,
        view: usize,
        place: &str,
        elements: Elements<'a>,
    ) -> Result<impl Iterator<Item = &'a [u8]> + use<'a>, GltfError> {
        let (bytes, stride) = self.range(document, view, place)?;
        let size = self.size;
        Ok((0..elements.number(self.count)).map(move |number| &bytes[elements.index(number) * stride..][..size]))
    }

    /// Bytes of all elements, and the number of bytes from one to the next.
    fn range<'a>(&self, document: &'a Document<'_>, view: usize, place: &str) -> Result<(&'a [u8], usize), GltfError> {
        let (bytes, stride) = document.view(view, &format!("{place}.bufferView"))?;
        let (count, size) = (self.count, self.size);
        let stride = stride.unwrap_or(size);
        if stride < size {
            return Err(
                document.damaged(place, format!("elements of {size} bytes follow each other every {stride} bytes"))
            );
        }
        let length = (stride as u64).checked_mul((count as u64).saturating_sub(1));
        let length = length.and_then(|length| length.checked_add(if count == 0 { 0 } else { size as u64 }));
        let bytes = length.and_then(|length| range(bytes, self.offset, length)).ok_or_else(|| {
            let (offset, there) = (self.offset, bytes.len());
            document.damaged(place, format!("{count} elements from byte {offset} on, in a view of {there} bytes"))
        })?;
        Ok((bytes, stride))
    }
}

/// Value of one component, little-endian; normalised integers by the rules of glTF 2.0, 3.6.2.2.
fn decode(bytes: &[u8], component: ComponentType, normalized: bool) -> f64 {
    let byte = |index: usize| bytes[index];
    let (value, largest) = match component {
        ComponentType::I8 => (f64::from(byte(0) as i8), 127.0),
        ComponentType::U8 => (f64::from(byte(0)), 255.0),
        ComponentType::I16 => (f64::from(i16::from_le_bytes([byte(0), byte(1)])), 32767.0),
        ComponentType::U16 => (f64::from(u16::from_le_bytes([byte(0), byte(1)])), 65535.0),
        ComponentType::U32 => return f64::from(u32::from_le_bytes([0, 1, 2, 3].map(byte))),
        ComponentType::F32 => return f64::from(f32::from_le_bytes([0, 1, 2, 3].map(byte))),
    };
    if normalized { (value / largest).max(-1.0) } else { value }
}
