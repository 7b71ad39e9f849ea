//! Place of a picture in the whole sphere, as cameras write it into XMP (Google's "Photo Sphere XMP Metadata").
//!
//! Values are attributes or elements of any `rdf:Description`; both forms are in use.

use roxmltree::{Document, ParsingOptions};

/// Namespace of the metadata.
const GPANO: &str = "http://ns.google.com/photos/1.0/panorama/";

/// Largest XMP that is read, bytes.
const MAX_XMP: usize = 1 << 20;

/// Largest ratio of the sphere to the part of it that is a picture, along each side.
const MAX_RATIO: f64 = 1000.0;

/// Place of a picture in the whole sphere.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct SpherePart {
    /// Size of the whole sphere, in pixels of the picture.
    pub(super) whole: [u32; 2],
    /// Column and row of the picture's first pixel.
    pub(super) place: [i64; 2],
    /// Width and height of the picture, degrees.
    pub(super) degrees: [f64; 2],
}

/// Place of a picture of this size, if its XMP says that it is a part of an equirectangular sphere.
pub(super) fn part(xmp: &[u8], [width, height]: [u32; 2]) -> Option<SpherePart> {
    let text = std::str::from_utf8(xmp.get(..MAX_XMP.min(xmp.len()))?).ok()?;
    // Packets end with padding, and some writers end them with zeros.
    let text = text.trim_matches(|character: char| character == '\0' || character.is_whitespace());
    regular_file::check_xml(text).ok()?;
    let options = ParsingOptions { nodes_limit: 100_000, ..ParsingOptions::default() };
    let document = Document::parse_with_options(text, options).ok()?;
    let value = |name: &str| {
        document.descendants().find_map(|node| {
            let element = || node.has_tag_name((GPANO, name)).then(|| node.text()).flatten();
            node.attribute((GPANO, name)).or_else(element).map(|value| value.trim().to_owned())
        })
    };
    let number = |name: &str| value(name)?.parse::<f64>().ok().filter(|number| number.is_finite());
    if value("ProjectionType").is_some_and(|kind| !kind.eq_ignore_ascii_case("equirectangular")) {
        return None;
    }
    let whole_width = number("FullPanoWidthPixels").filter(|side| *side > 0.0)?;
    let whole_height = number("FullPanoHeightPixels").filter(|side| *side > 0.0).unwrap_or(whole_width / 2.0);
    let part_width = number("CroppedAreaImageWidthPixels").unwrap_or(f64::from(width));
    let part_height = number("CroppedAreaImageHeightPixels").unwrap_or(f64::from(height));
    let ratios = [whole_width / part_width, whole_height / part_height];
    if !ratios.iter().all(|ratio| (1.0..=MAX_RATIO).contains(ratio)) || ratios == [1.0; 2] {
        return None;
    }
    // The picture may have been scaled since.
    let scale = [f64::from(width) / part_width, f64::from(height) / part_height];
    let left = number("CroppedAreaLeftPixels").unwrap_or((whole_width - part_width) / 2.0) * scale[0];
    let top = number("CroppedAreaTopPixels").unwrap_or((whole_height - part_height) / 2.0) * scale[1];
    let whole = [whole_width * scale[0], whole_height * scale[1]].map(|side| side.round() as u32);
    // A sphere that is not 2:1 has lost its poles.
    let poles = (i64::from(whole[0] / 2) - i64::from(whole[1])).max(0) / 2;
    let whole = if super::shape::is_equirectangular(whole[0], whole[1]) { whole } else { [whole[0], whole[0] / 2] };
    let fits = whole.iter().all(|side| *side > 0) && left.abs() < 1e9 && top.abs() < 1e9;
    let degrees = [360.0 * part_width / whole_width, 180.0 * f64::from(height) / f64::from(whole[1])];
    let place = [left.round() as i64, top.round() as i64 + poles];
    // A picture beside the sphere would not be seen at all.
    let overlaps =
        (0..2).all(|axis| place[axis] < whole[axis].into() && place[axis] + i64::from([width, height][axis]) > 0);
    (fits && overlaps).then_some(SpherePart { whole, place, degrees })
}
