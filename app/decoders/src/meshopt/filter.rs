//! Filters: roundings that were made before packing, reversed in place.

use super::kind::{Codec, Filter};
use crate::DecodeError;

/// Refuses a filter that does not go with the codec or the stride.
pub(super) fn check(filter: Filter, mode: Codec, stride: usize) -> Result<(), DecodeError> {
    let fits = match filter {
        Filter::None => return Ok(()),
        Filter::Octahedral | Filter::Colour => stride == 4 || stride == 8,
        Filter::Quaternion => stride == 8,
        Filter::Exponential => stride.is_multiple_of(4),
    };
    match (mode, fits) {
        (Codec::Attributes, true) => Ok(()),
        (Codec::Attributes, false) => {
            Err(DecodeError::Damaged(format!("a filter is named that does not go with {stride} bytes each")))
        }
        _ => Err(DecodeError::Damaged("a filter is named, and indices have none".to_owned())),
    }
}

/// Reverses a filter on decoded vertices.
pub(super) fn apply(filter: Filter, stride: usize, decoded: &mut [u8]) {
    match filter {
        Filter::None => {}
        Filter::Octahedral if stride == 4 => {
            for vertex in decoded.as_chunks_mut::<4>().0 {
                let [x, y, one, _] = vertex.map(|byte| f32::from(byte as i8));
                let unit = octahedral(x, y, one, f32::from(i8::MAX));
                vertex[..3].copy_from_slice(&unit.map(|value| value as i8 as u8));
            }
        }
        Filter::Octahedral => {
            for vertex in decoded.as_chunks_mut::<8>().0 {
                let [x, y, one, _] = shorts(vertex).map(f32::from);
                let unit = octahedral(x, y, one, f32::from(i16::MAX));
                for (place, value) in vertex.as_chunks_mut::<2>().0.iter_mut().zip(unit) {
                    *place = (value as i16).to_le_bytes();
                }
            }
        }
        Filter::Colour if stride == 4 => {
            for vertex in decoded.as_chunks_mut::<4>().0 {
                let [y, _, _, a] = vertex.map(i32::from);
                let [_, co, cg, _] = vertex.map(|byte| i32::from(byte as i8));
                *vertex = colour([y, co, cg, a], f32::from(u8::MAX)).map(|value| value as u8);
            }
        }
        Filter::Colour => {
            for vertex in decoded.as_chunks_mut::<8>().0 {
                let [y, co, cg, a] = shorts(vertex);
                let [y, a] = [y, a].map(|number| i32::from(number as u16));
                let rgba = colour([y, co.into(), cg.into(), a], f32::from(u16::MAX));
                for (place, value) in vertex.as_chunks_mut::<2>().0.iter_mut().zip(rgba) {
                    *place = (value as u16).to_le_bytes();
                }
            }
        }
        Filter::Quaternion => {
            for vertex in decoded.as_chunks_mut::<8>().0 {
                let unit = quaternion(shorts(vertex));
                for (place, value) in vertex.as_chunks_mut::<2>().0.iter_mut().zip(unit) {
                    *place = value.to_le_bytes();
                }
            }
        }
        Filter::Exponential => {
            for word in decoded.as_chunks_mut::<4>().0 {
                let bits = i32::from_le_bytes(*word);
                let (mantissa, exponent) = (f64::from(bits << 8 >> 8), bits >> 24);
                *word = ((mantissa * f64::from(exponent).exp2()) as f32).to_le_bytes();
            }
        }
    }
}

/// Red, green, blue and opacity in parts of `largest`, from brightness, two differences, and an opacity whose highest
/// bit tells the number of bits.
fn colour([y, co, cg, a]: [i32; 4], largest: f32) -> [f32; 4] {
    let all = [1, 2, 4, 8].iter().fold(a, |bits, shift| bits | bits >> shift);
    let one = all.max(1) as f32;
    let opacity = a << 1 & all | a & 1;
    [y + co - cg, y + cg, y - co - cg, opacity].map(|value| (value as f32 * (largest / one) + 0.5).clamp(0.0, largest))
}

fn shorts(bytes: &[u8; 8]) -> [i16; 4] {
    let [a, b, c, d, e, f, g, h] = *bytes;
    [[a, b], [c, d], [e, f], [g, h]].map(i16::from_le_bytes)
}

/// Unit vector of a place on the octahedron that is `one` high, in whole parts of `largest`.
fn octahedral(x: f32, y: f32, one: f32, largest: f32) -> [f32; 3] {
    let z = one - x.abs() - y.abs();
    // The lower half is folded outwards.
    let fold = z.min(0.0);
    let outwards = |value: f32| if value >= 0.0 { value + fold } else { value - fold };
    let vector = [outwards(x), outwards(y), z];
    let length = vector.iter().map(|value| value * value).sum::<f32>().sqrt();
    vector.map(|value| (value * (largest / length)).round())
}

/// Unit quaternion in parts of 32767 of its three smaller components. The fourth number names the largest one in its
/// two lowest bits, and in the others the scale of the three.
fn quaternion(packed: [i16; 4]) -> [i16; 4] {
    let [x, y, z, scale] = packed;
    let one = f32::from(scale | 3) * std::f32::consts::SQRT_2;
    let smaller = [x, y, z].map(|value| f32::from(value) / one);
    let rest = 1.0 - smaller.iter().map(|value| value * value).sum::<f32>();
    let parts = [rest.max(0.0).sqrt(), smaller[0], smaller[1], smaller[2]];
    let mut unit = [0; 4];
    for (index, part) in parts.into_iter().enumerate() {
        unit[((scale & 3) as usize + index) & 3] = (part * f32::from(i16::MAX)).round() as i16;
    }
    unit
}
