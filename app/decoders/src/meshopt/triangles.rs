//! Indices of triangles: each triangle shares an edge with one of the last, or begins anew.
//!
//! A triangle has a code of one byte. Those that share an edge name it by its age, and the third corner by its age
//! among the last vertices. The others name each corner by its age, in a byte that is taken from a table or from the
//! data behind the codes.

use super::varint::{difference, put, take};
use crate::DecodeError;

/// Upper half of the first byte.
const MARK: u8 = 0xe0;
/// Number of bytes of the table behind the data.
const TABLE: usize = 16;
/// Code of a corner that stands in the data.
const FREE: u8 = 15;

/// Fills the bytes with indices of 2 or 4 bytes each, three a triangle.
pub(super) fn decode(bytes: &[u8], stride: usize, decoded: &mut [u8]) -> Result<(), DecodeError> {
    let (&mark, rest) = bytes.split_first().ok_or(DecodeError::CutShort)?;
    let version = mark & 0x0f;
    if mark & 0xf0 != MARK || version > 1 {
        return Err(DecodeError::Damaged("they do not begin as triangles do".to_owned()));
    }
    let (rest, table) = rest.split_last_chunk::<TABLE>().ok_or(DecodeError::CutShort)?;
    let (codes, data) = rest.split_at_checked(decoded.len() / (3 * stride)).ok_or(DecodeError::CutShort)?;
    // Of version 1 two codes name the neighbours of the last free corner.
    let oldest = if version == 0 { 15 } else { 13 };
    let mut state = State { data, next: 0, last: 0, vertices: Recent::default(), edges: Recent::default() };

    for (&code, place) in codes.iter().zip(decoded.chunks_exact_mut(3 * stride)) {
        let [a, b, c] = match code {
            0xf0.. => {
                let (free_first, corners) = match code {
                    0xff => (true, state.byte()?),
                    0xfe => (false, state.byte()?),
                    _ => (false, table[usize::from(code & 15)]),
                };
                // A byte of zero in the data begins the count anew.
                if code >= 0xfe && corners == 0 {
                    state.next = 0;
                }
                let corners = [if free_first { FREE } else { 0 }, corners >> 4, corners & 15];
                state.apart(corners, code >= 0xfe)?
            }
            _ => state.along_edge(code >> 4, code & 15, oldest)?,
        };
        for (place, index) in place.chunks_exact_mut(stride).zip([a, b, c]) {
            put(place, index)?;
        }
    }
    if state.data.is_empty() {
        Ok(())
    } else {
        Err(DecodeError::Damaged("more triangles follow than are named".to_owned()))
    }
}

/// Memory of the decoder between triangles.
struct State<'a> {
    data: &'a [u8],
    /// Vertex that comes next if vertices are met in their order.
    next: u32,
    /// Vertex of the last free corner.
    last: u32,
    vertices: Recent<u32>,
    edges: Recent<[u32; 2]>,
}

impl State<'_> {
    fn byte(&mut self) -> Result<u8, DecodeError> {
        let (&byte, rest) = self.data.split_first().ok_or(DecodeError::CutShort)?;
        self.data = rest;
        Ok(byte)
    }

    fn next(&mut self) -> u32 {
        let next = self.next;
        self.next = next.wrapping_add(1);
        next
    }

    fn free(&mut self) -> Result<u32, DecodeError> {
        self.last = self.last.wrapping_add(difference(take(&mut self.data)?));
        Ok(self.last)
    }

    /// Triangle on an edge of a certain age.
    fn along_edge(&mut self, edge: u8, corner: u8, oldest: u8) -> Result<[u32; 3], DecodeError> {
        let [a, b] = self.edges.aged(edge);
        let c = match corner {
            0 => self.next(),
            _ if corner < oldest => self.vertices.aged(corner),
            13 | 14 => {
                self.last = if corner == 13 { self.last.wrapping_sub(1) } else { self.last.wrapping_add(1) };
                self.last
            }
            _ => self.free()?,
        };
        if corner == 0 || corner >= oldest {
            self.vertices.push(c);
        }
        self.edges.push([c, b]);
        self.edges.push([a, c]);
        Ok([a, b, c])
    }

    /// Triangle by its three corners.
    fn apart(&mut self, corners: [u8; 3], may_be_free: bool) -> Result<[u32; 3], DecodeError> {
        // The new vertices are counted first, and only then the free ones are read.
        let mut triangle = corners.map(|corner| match corner {
            0 => self.next(),
            _ => self.vertices.aged(corner - 1),
        });
        let is_free = |corner: u8| may_be_free && corner == FREE;
        for (index, corner) in triangle.iter_mut().zip(corners) {
            if is_free(corner) {
                *index = self.free()?;
            }
        }
        for (index, corner) in triangle.into_iter().zip(corners) {
            if corner == 0 || is_free(corner) {
                self.vertices.push(index);
            }
        }
        let [a, b, c] = triangle;
        self.edges.push([b, a]);
        self.edges.push([c, b]);
        self.edges.push([a, c]);
        Ok(triangle)
    }
}

/// Last sixteen things of a kind.
#[derive(Default)]
struct Recent<T> {
    ring: [T; 16],
    count: usize,
}

impl<T: Copy> Recent<T> {
    fn push(&mut self, thing: T) {
        self.ring[self.count & 15] = thing;
        self.count = self.count.wrapping_add(1);
    }

    /// Thing that came in before `age` others.
    fn aged(&self, age: u8) -> T {
        self.ring[self.count.wrapping_sub(1 + usize::from(age)) & 15]
    }
}
