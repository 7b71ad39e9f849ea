//! From the bytes to the mesh, within the budget.

use super::header::DracoHeader;
use super::mesh::{Attribute, DracoMesh};
use crate::DecodeError;
use crate::loan::Loan;
use draco_core::{DataType, DecodeLimits, DecoderBuffer, ErrorKind, Mesh, MeshDecoder, PointAttribute};
use regular_file::Budget;

/// Memory of a triangle while the connectivity is rebuilt, bytes.
const FACE: u64 = 160;
/// Memory of a triangle for each group of attributes with seams of its own, bytes.
const SEAMED_FACE: u64 = 64;
/// Memory of an attribute's value while it is decoded, in sizes of the value: residuals, integers, numbers.
const COPIES: u64 = 4;
/// Bytes of attributes that are lent for each point, one after the other until they suffice.
///
/// The attributes are named only after the triangles, and points on seams are counted only then.
const LENT: [u64; 3] = [128, 512, 2048];
/// Memory of a mesh of no size, bytes.
const LEAST: u64 = 1 << 18;

/// Decoded mesh. Its memory stays taken from the budget.
///
/// # Errors
/// [`DecodeError`]: the bytes are no Draco mesh, or what they decode to exceeds the budget.
pub fn decode(bytes: &[u8], budget: &Budget) -> Result<DracoMesh, DecodeError> {
    let header = DracoHeader::read(bytes)?;
    let _copy = Loan::new(budget, bytes.len() as u64)?;
    let bare = header.without_metadata(bytes);
    let bytes = bare.as_deref().unwrap_or(bytes);
    let connectivity = header.faces.saturating_mul(FACE + SEAMED_FACE * header.seamed);

    for lent in LENT {
        let values = header.points.saturating_mul(lent).saturating_add(LEAST);
        let memory = values.saturating_mul(COPIES).saturating_add(connectivity);
        let loan = Loan::new(budget, memory)?;
        let limits = DecodeLimits::permissive().with_max_faces(header.faces).with_max_decoded_bytes(values);
        let mut mesh = Mesh::new();
        let decoded = MeshDecoder::new().decode(&mut DecoderBuffer::new(bytes).with_limits(limits), &mut mesh);
        match decoded {
            Ok(()) => {
                let mesh = numbers(&mesh, budget)?;
                drop(loan);
                return Ok(mesh);
            }
            Err(error) if error.kind() == ErrorKind::LimitExceeded => {}
            Err(error) => return Err(DecodeError::Damaged(error.message().to_owned())),
        }
    }
    let most = LENT[LENT.len() - 1];
    Err(DecodeError::Unsupported(format!("Draco with more than {most} bytes of attributes for each point")))
}

/// Indices and numbers of a decoded mesh.
fn numbers(mesh: &Mesh, budget: &Budget) -> Result<DracoMesh, DecodeError> {
    let points = mesh.num_points();
    let attributes = || (0..mesh.num_attributes()).map(|index| mesh.attribute(index));
    let values: u64 = attributes().map(|attribute| 4 * points as u64 * u64::from(attribute.num_components())).sum();
    let kept = values + 12 * mesh.num_faces() as u64;
    let loan = Loan::new(budget, kept)?;
    let indices: Vec<u32> = mesh.faces().iter().flatten().map(|point| point.0).collect();
    if indices.iter().any(|&point| point as usize >= points) {
        return Err(DecodeError::Damaged("a triangle names a point that does not exist".to_owned()));
    }
    let attributes = attributes().map(|attribute| of_attribute(attribute, points)).collect();
    loan.keep(kept);
    Ok(DracoMesh { points, indices, attributes })
}

fn of_attribute(attribute: &PointAttribute, points: usize) -> Attribute {
    let components = usize::from(attribute.num_components());
    let mut values = attribute.read_f32s(points, components);
    let largest = match attribute.data_type() {
        DataType::Int8 => f32::from(i8::MAX),
        DataType::Uint8 => f32::from(u8::MAX),
        DataType::Int16 => f32::from(i16::MAX),
        DataType::Uint16 => f32::from(u16::MAX),
        _ => 1.0,
    };
    if attribute.normalized() {
        values.iter_mut().for_each(|value| *value = (*value / largest).max(-1.0));
    }
    Attribute { unique_id: attribute.unique_id(), components, values }
}
