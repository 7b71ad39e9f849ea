//! Law under test: a picture of a part of the sphere is seen where its metadata says, and all else is black. A wrong
//! reader would stretch it over the whole sphere, or refuse it.

use super::super::gpano::{SpherePart, part};
use super::pictures::*;
use glam::Vec3;
use image::codecs::jpeg::JpegEncoder;
use image::codecs::png::PngEncoder;
use image::{ExtendedColorType, ImageEncoder, RgbImage};

const NAMESPACES: &str = "xmlns:rdf=\"http://www.w3.org/1999/02/22-rdf-syntax-ns#\" \
     xmlns:GPano=\"http://ns.google.com/photos/1.0/panorama/\"";

/// Metadata with these values, as attributes or as elements.
fn xmp(values: &[(&str, u32)], as_elements: bool) -> String {
    let (mut attributes, mut elements) = (String::new(), String::new());
    for (name, value) in values {
        if as_elements {
            elements += &format!("<GPano:{name}>{value}</GPano:{name}>");
        } else {
            attributes += &format!(" GPano:{name}=\"{value}\"");
        }
    }
    format!(
        "<?xpacket begin=\"\" id=\"W5M0MpCehiHzreSzNTczkc9d\"?><x:xmpmeta xmlns:x=\"adobe:ns:meta/\"><rdf:RDF {NAMESPACES}>\
         <rdf:Description rdf:about=\"\"{attributes}>{elements}</rdf:Description></rdf:RDF></x:xmpmeta>\
         <?xpacket end=\"w\"?>"
    )
}

/// Values for a picture of 32 × 16 pixels in the middle of a sphere of 64 × 32.
const MIDDLE: [(&str, u32); 6] = [
    ("FullPanoWidthPixels", 64),
    ("FullPanoHeightPixels", 32),
    ("CroppedAreaImageWidthPixels", 32),
    ("CroppedAreaImageHeightPixels", 16),
    ("CroppedAreaLeftPixels", 16),
    ("CroppedAreaTopPixels", 8),
];

fn red() -> RgbImage {
    RgbImage::from_pixel(32, 16, image::Rgb([255, 0, 0]))
}

fn jpeg_with(xmp: &str) -> Vec<u8> {
    let mut picture = Vec::new();
    JpegEncoder::new_with_quality(&mut picture, 100).encode_image(&red()).unwrap();
    let name = b"http://ns.adobe.com/xap/1.0/\0";
    let length = (2 + name.len() + xmp.len()) as u16;
    let mut bytes = vec![0xff, 0xd8, 0xff, 0xe1];
    bytes.extend(length.to_be_bytes());
    bytes.extend(name);
    bytes.extend(xmp.as_bytes());
    bytes.extend(&picture[2..]);
    bytes
}

fn png_with(xmp: &str) -> Vec<u8> {
    let mut picture = Vec::new();
    PngEncoder::new(&mut picture).write_image(&red(), 32, 16, ExtendedColorType::Rgb8).unwrap();
    let mut chunk = b"iTXtXML:com.adobe.xmp\0\0\0\0\0".to_vec();
    chunk.extend(xmp.as_bytes());
    // PNG's checksum: CRC-32 of the chunk's kind and content.
    let crc = !chunk.iter().fold(!0_u32, |crc, byte| {
        (0..8).fold(crc ^ u32::from(*byte), |crc, _| if crc & 1 == 1 { crc >> 1 ^ 0xedb8_8320 } else { crc >> 1 })
    });
    let mut bytes = picture[..33].to_vec();
    bytes.extend((chunk.len() as u32 - 4).to_be_bytes());
    bytes.extend(&chunk);
    bytes.extend(crc.to_be_bytes());
    bytes.extend(&picture[33..]);
    bytes
}

#[test]
fn a_part_of_the_sphere_is_seen_in_its_place() {
    for as_elements in [false, true] {
        let xmp = xmp(&MIDDLE, as_elements);
        for (bytes, kind) in [(jpeg_with(&xmp), "JPEG"), (png_with(&xmp), "PNG")] {
            let (panorama, notices) = read(&bytes);
            assert_eq!((panorama.width, panorama.height), (64, 32), "{kind}");
            for y in 0..32 {
                for x in 0..64 {
                    let inside = (16..48).contains(&x) && (8..24).contains(&y);
                    let expected = [f32::from(u8::from(inside)), 0.0, 0.0];
                    let seen = panorama.pixel(x, y);
                    assert!(difference(seen, expected) < 0.03, "{kind}, {x}, {y}: {seen:?}");
                }
            }
            assert!(notices[0].contains("covers 180° × 90° of the sphere"), "{notices:?}");
        }
    }
}

#[test]
fn a_whole_sphere_needs_no_place() {
    let whole = [("FullPanoWidthPixels", 32), ("FullPanoHeightPixels", 16)];
    let (panorama, notices) = read(&jpeg_with(&xmp(&whole, false)));
    assert!(notices.is_empty() && difference(along(&panorama, Vec3::Z), [1.0, 0.0, 0.0]) < 0.03);
}

#[test]
fn places_follow_a_picture_that_was_scaled() {
    let larger = MIDDLE.map(|(name, value)| (name, value * 10));
    let expected = SpherePart { whole: [64, 32], place: [16, 8], degrees: [180.0, 90.0] };
    assert_eq!(part(xmp(&larger, false).as_bytes(), [32, 16]), Some(expected));
}

#[test]
fn senseless_places_are_no_places() {
    let mut values = MIDDLE;
    for (name, value) in [(0, 0), (0, 16), (0, u32::MAX), (2, 0), (3, u32::MAX), (4, 64), (5, 90)] {
        values[name].1 = value;
        let place = part(xmp(&values, true).as_bytes(), [32, 16]);
        assert!(place.is_none(), "{value} as {}: {place:?}", values[name].0);
        values = MIDDLE;
    }
    assert!(part(b"<not xml", [32, 16]).is_none() && part(&[0xff, 0xfe, 0], [32, 16]).is_none());
}
