//! What players read of a film of all directions: boxes in an MP4 file that say how its pictures are projected, and
//! where each eye's picture is.
//!
//! Both forms of Google's spatial-media documents are written: of the second, `st3d` and `sv3d` beside the codec's
//! settings (Spherical Video V2), and of the first, a line of XML in a `uuid` box of the track (Spherical Video V1),
//! which older players read. Boxes are added to the index `moov` alone, so pictures are copied as they are; where they
//! lie behind the index, its table of their places is moved along.

use std::fs::File;
use std::io::{self, BufReader, BufWriter, Read, Seek, SeekFrom, Write};
use std::path::Path;

/// Projection of a film, as far as players know it.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum FilmProjection {
    /// All directions, equirectangular.
    Sphere,
    /// Directions ahead, equirectangular.
    HalfSphere,
    /// Faces of a cube.
    Cube,
    /// Flat, in stereo.
    Flat,
}

/// Arrangement of the eyes' pictures in one.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum FilmEyes {
    /// One eye.
    One,
    /// Left eye above, right eye below.
    TopBottom,
    /// Left eye on the left.
    SideBySide,
}

/// Projection and arrangement of a film's pictures.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct SphericalTags {
    /// Projection of each eye's picture.
    pub projection: FilmProjection,
    /// Arrangement of the eyes.
    pub eyes: FilmEyes,
}

/// Identifier of the box that holds Spherical Video V1's XML.
const V1_UUID: [u8; 16] =
    [0xff, 0xcc, 0x82, 0x63, 0xf8, 0x55, 0x4a, 0x93, 0x88, 0x14, 0x58, 0x7a, 0x02, 0x52, 0x1f, 0xdd];
/// Name of this program in films.
const MADE_BY: &str = "Rapidity";
/// Bytes of a video sample entry before its boxes: the box's head, 8 of every sample entry, 70 of a video's.
const VISUAL_ENTRY: usize = 8 + 8 + 70;
/// Largest index that is believed, bytes.
const LARGEST_INDEX: u64 = 1 << 28;

/// Writes the film `from` with these tags to the file `to`.
///
/// # Errors
/// The system's, or [`io::ErrorKind::InvalidData`] if `from` is no film that ffmpeg writes.
pub fn tag(from: &Path, to: &Path, tags: &SphericalTags) -> io::Result<()> {
    let mut film = BufReader::new(File::open(from)?);
    let mut tagged = BufWriter::new(File::create(to)?);
    let length = film.seek(SeekFrom::End(0))?;
    // Find the boxes of the file, and read the index.
    let mut boxes = Vec::new();
    let mut place = 0;
    while place < length {
        let (kind, size) = head(&mut film, place, length)?;
        boxes.push((kind, place, size));
        place += size;
    }
    let found = boxes.iter().position(|(kind, ..)| kind == b"moov").ok_or_else(|| invalid("no index"))?;
    let (_, start, size) = boxes[found];
    if size > LARGEST_INDEX {
        return Err(invalid("an index that is too large"));
    }
    let mut index = vec![0; size as usize];
    film.seek(SeekFrom::Start(start))?;
    film.read_exact(&mut index)?;
    // Add the tags, and move the places of pictures that lie behind the index.
    let mut moved = with_tags(&index, tags)?;
    let grown = (moved.len() - index.len()) as u64;
    if boxes[found..].iter().any(|(kind, ..)| kind == b"mdat") {
        move_chunks(&mut moved, start + size, grown)?;
    }
    for (number, (_, start, size)) in boxes.into_iter().enumerate() {
        if number == found {
            tagged.write_all(&moved)?;
        } else {
            film.seek(SeekFrom::Start(start))?;
            io::copy(&mut film.by_ref().take(size), &mut tagged)?;
        }
    }
    tagged.flush()
}

/// Kind and size of the box at a place in a file.
fn head(film: &mut (impl Read + Seek), place: u64, length: u64) -> io::Result<([u8; 4], u64)> {
    film.seek(SeekFrom::Start(place))?;
    let mut bytes = [0; 8];
    film.read_exact(&mut bytes)?;
    let [a, b, c, d, kind @ ..] = bytes;
    let size = match u32::from_be_bytes([a, b, c, d]) {
        0 => length - place,
        1 => {
            let mut long = [0; 8];
            film.read_exact(&mut long)?;
            u64::from_be_bytes(long)
        }
        short => u64::from(short),
    };
    if size < 8 || size > length - place { Err(invalid("a damaged box")) } else { Ok((kind, size)) }
}

/// Boxes inside of another, with their kinds; `bytes` are its contents.
fn children(bytes: &[u8]) -> io::Result<Vec<([u8; 4], std::ops::Range<usize>)>> {
    let mut found = Vec::new();
    let mut place = 0;
    while place + 8 <= bytes.len() {
        let size = be32(bytes, place)? as usize;
        let kind = bytes[place + 4..place + 8].try_into().map_err(|_| invalid("a damaged box"))?;
        if size < 8 || size > bytes.len() - place {
            return Err(invalid("a damaged box"));
        }
        found.push((kind, place..place + size));
        place += size;
    }
    Ok(found)
}

/// The index with the tags in its video track.
fn with_tags(index: &[u8], tags: &SphericalTags) -> io::Result<Vec<u8>> {
    let mut tracks = 0;
    let tagged = rebuilt(index, 8, &mut |kind, track| {
        if kind != b"trak" || !is_video(track)? {
            return Ok(None);
        }
        tracks += 1;
        let mut track = deeper(track, &[b"mdia", b"minf", b"stbl", b"stsd"], tags)?;
        if let Some(xml) = first_form(tags) {
            append(&mut track, &full_box(b"uuid", &[V1_UUID.as_slice(), xml.as_bytes()].concat()));
        }
        Ok(Some(track))
    })?;
    if tracks == 1 { Ok(tagged) } else { Err(invalid("no single video track")) }
}

/// Replacement of a box of a kind, with its head; `None` keeps it.
type BoxChange<'a> = dyn FnMut(&[u8; 4], &[u8]) -> io::Result<Option<Vec<u8>>> + 'a;

/// A box whose children are replaced where `change` says so; `skip`: bytes before the children.
fn rebuilt(parent: &[u8], skip: usize, change: &mut BoxChange<'_>) -> io::Result<Vec<u8>> {
    let inner = parent.get(skip..).ok_or_else(|| invalid("a damaged box"))?;
    let mut made = parent[..skip].to_vec();
    for (kind, range) in children(inner)? {
        let child = &inner[range];
        made.extend(change(&kind, child)?.unwrap_or_else(|| child.to_vec()));
    }
    set_size(&mut made);
    Ok(made)
}

/// A box with the second form's boxes at the end of the sample entry that a path of boxes leads to.
fn deeper(parent: &[u8], path: &[&[u8; 4]], tags: &SphericalTags) -> io::Result<Vec<u8>> {
    let Some((next, rest)) = path.split_first() else {
        // The description of the samples: version, flags and a count before its entries.
        return rebuilt(parent, 16, &mut |_, entry| {
            if entry.len() < VISUAL_ENTRY {
                return Err(invalid("a damaged sample entry"));
            }
            let mut entry = entry.to_vec();
            append(&mut entry, &second_form(tags));
            Ok(Some(entry))
        });
    };
    rebuilt(parent, 8, &mut |kind, child| if kind == *next { deeper(child, rest, tags).map(Some) } else { Ok(None) })
}

/// True if a track shows pictures: its handler is `vide`.
fn is_video(track: &[u8]) -> io::Result<bool> {
    let mut found = false;
    for (kind, range) in children(&track[8..])? {
        let media = &track[8..][range];
        if &kind == b"mdia" {
            for (kind, range) in children(&media[8..])? {
                found |= &kind == b"hdlr" && media[8..][range].get(16..20) == Some(b"vide");
            }
        }
    }
    Ok(found)
}

/// Adds `grown` to the places of all pictures at or behind `from`, in tables of every track.
fn move_chunks(index: &mut [u8], from: u64, grown: u64) -> io::Result<()> {
    const PARENTS: [&[u8; 4]; 4] = [b"trak", b"mdia", b"minf", b"stbl"];
    for (kind, range) in children(&index[8..])? {
        let part = &mut index[8..][range];
        if PARENTS.contains(&&kind) {
            move_chunks(part, from, grown)?;
        } else if &kind == b"stco" || &kind == b"co64" {
            let width = if &kind == b"stco" { 4 } else { 8 };
            for place in part.get_mut(16..).ok_or_else(|| invalid("a damaged table"))?.chunks_exact_mut(width) {
                let at = place.iter().fold(0, |at, byte| at << 8 | u64::from(*byte));
                let moved = if at >= from { at + grown } else { at };
                if width == 4 && moved > u64::from(u32::MAX) {
                    return Err(invalid("a film too large for its index"));
                }
                place.copy_from_slice(&moved.to_be_bytes()[8 - width..]);
            }
        }
    }
    Ok(())
}

/// Boxes of Spherical Video V2.
fn second_form(tags: &SphericalTags) -> Vec<u8> {
    let eyes = match tags.eyes {
        FilmEyes::One => 0,
        FilmEyes::TopBottom => 1,
        FilmEyes::SideBySide => 2,
    };
    let mut boxes = full_box(b"st3d", &[0, 0, 0, 0, eyes]);
    let bounds = |bounds: [u32; 4]| [0].into_iter().chain(bounds).flat_map(u32::to_be_bytes).collect::<Vec<u8>>();
    // Bounds are shares of the whole that is left out at the top, bottom, left and right, in units of 2⁻³².
    let (kind, contents): (&[u8; 4], Vec<u8>) = match tags.projection {
        FilmProjection::Flat => return boxes,
        FilmProjection::Sphere => (b"equi", bounds([0; 4])),
        FilmProjection::HalfSphere => (b"equi", bounds([0, 0, 1 << 30, 1 << 30])),
        FilmProjection::Cube => (b"cbmp", [0_u32; 3].into_iter().flat_map(u32::to_be_bytes).collect()),
    };
    let source = [&[0; 4], MADE_BY.as_bytes(), &[0]].concat();
    // The pose: yaw, pitch and roll are zero.
    let projection = [full_box(b"prhd", &[0; 16]), full_box(kind, &contents)].concat();
    let video = [full_box(b"svhd", &source), full_box(b"proj", &projection)].concat();
    boxes.extend(full_box(b"sv3d", &video));
    boxes
}

/// XML of Spherical Video V1, which knows whole spheres alone.
fn first_form(tags: &SphericalTags) -> Option<String> {
    if tags.projection != FilmProjection::Sphere {
        return None;
    }
    let stereo = match tags.eyes {
        FilmEyes::One => "mono",
        FilmEyes::TopBottom => "top-bottom",
        FilmEyes::SideBySide => "left-right",
    };
    Some(format!(
        "<?xml version=\"1.0\"?><rdf:SphericalVideo xmlns:rdf=\"http://www.w3.org/1999/02/22-rdf-syntax-ns#\" \
         xmlns:GSpherical=\"http://ns.google.com/videos/1.0/spherical/\">\
         <GSpherical:Spherical>true</GSpherical:Spherical><GSpherical:Stitched>true</GSpherical:Stitched>\
         <GSpherical:StitchingSoftware>{MADE_BY}</GSpherical:StitchingSoftware>\
         <GSpherical:ProjectionType>equirectangular</GSpherical:ProjectionType>\
         <GSpherical:StereoMode>{stereo}</GSpherical:StereoMode></rdf:SphericalVideo>"
    ))
}

/// Box of a kind with its contents.
fn full_box(kind: &[u8; 4], contents: &[u8]) -> Vec<u8> {
    let mut made = vec![0; 4];
    made.extend(kind);
    made.extend(contents);
    set_size(&mut made);
    made
}

/// Adds contents to the end of a box.
fn append(parent: &mut Vec<u8>, contents: &[u8]) {
    parent.extend(contents);
    set_size(parent);
}

/// Writes a box's length into its head.
fn set_size(made: &mut [u8]) {
    let size = made.len() as u32;
    made[..4].copy_from_slice(&size.to_be_bytes());
}

fn be32(bytes: &[u8], place: usize) -> io::Result<u32> {
    let four = bytes.get(place..place + 4).and_then(|four| four.try_into().ok());
    four.map(u32::from_be_bytes).ok_or_else(|| invalid("a damaged box"))
}

fn invalid(what: &str) -> io::Error {
    io::Error::new(io::ErrorKind::InvalidData, format!("the encoder's file has {what}"))
}
