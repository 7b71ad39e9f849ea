//! A file of light must hold the light to the bit, and say in which unit it is.
//!
//! A wrong program writes halves, exchanges channels, compresses with a loss, or leaves part of a file behind.
#![allow(clippy::unwrap_used, reason = "a failed construction is a failed test")]

use super::save;
use exr::prelude::{FlatImage, FlatSamples, read_all_flat_layers_from_file};
use image::Rgb32FImage;
use rand::rngs::StdRng;
use rand::{RngExt, SeedableRng};

#[test]
fn a_file_of_light_holds_it_to_the_bit() {
    let mut random = StdRng::seed_from_u64(12);
    let mut light = Rgb32FImage::new(37, 19);
    for pixel in light.pixels_mut() {
        pixel.0 =
            [(); 3].map(|()| random.random_range(-30.0..30.0_f32).exp2() * if random.random() { 1.0 } else { -1.0 });
    }
    light.get_pixel_mut(3, 2).0 = [1e9, f32::MAX, f32::MIN_POSITIVE];
    light.get_pixel_mut(36, 18).0 = [0.0, -1e9, 1.0];
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("light.exr");
    save(&light, &path).unwrap();

    let file: FlatImage = read_all_flat_layers_from_file(&path).unwrap();
    let layer = &file.layer_data[0];
    assert_eq!((layer.size.x(), layer.size.y()), (37, 19));
    assert_eq!(layer.attributes.white_luminance, Some(1.0));
    let channels = &layer.channel_data.list;
    assert_eq!(channels.iter().map(|channel| channel.name.to_string()).collect::<Vec<_>>(), ["B", "G", "R"]);
    for (channel, colour) in channels.iter().zip([2, 1, 0]) {
        let FlatSamples::F32(samples) = &channel.sample_data else { panic!("not 32-bit floats") };
        let written: Vec<u32> = light.pixels().map(|pixel| pixel.0[colour].to_bits()).collect();
        assert_eq!(samples.iter().map(|sample| sample.to_bits()).collect::<Vec<_>>(), written);
    }
}

#[test]
fn a_place_that_cannot_be_written_is_named() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("nowhere/light.exr");
    let error = save(&Rgb32FImage::new(2, 2), &path).unwrap_err();
    assert_eq!(error.path, path);
}
