//! Law: whatever its size, a model is in the first picture, whole and large, from outside; and who rides towards it
//! sees relativity within five seconds. A program for which every scene is a town opens on an empty sky, or takes an
//! hour to reach the model.

use crate::models::{Model, chair, city, house, ring};
use crate::runner::{run, told};
use image::RgbImage;
use std::path::Path;

/// Difference of a channel from which on two pixels look different, of 255.
const VISIBLE: u8 = 24;

fn models() -> [(&'static str, Model); 4] {
    [("ring", ring()), ("chair", chair()), ("house", house()), ("city", city())]
}

fn picture(folder: &Path, arguments: &[&str]) -> RgbImage {
    let picture = folder.join("picture.png");
    let size = ["--out", "picture.png", "--size", "320x180", "--samples", "1", "--exposure", "white"];
    let output = run(folder, &[&["render"], arguments, &size].concat());
    assert!(output.status.success(), "{}", told(&output));
    image::open(picture).unwrap().into_rgb8()
}

fn differ(a: &image::Rgb<u8>, b: &image::Rgb<u8>) -> bool {
    a.0.iter().zip(b.0).any(|(a, b)| a.abs_diff(b) > VISIBLE)
}

#[test]
fn the_first_picture_shows_the_model_whole_and_large() {
    let folder = tempfile::tempdir().unwrap();
    for (name, model) in models() {
        let file = format!("{name}.glb");
        std::fs::write(folder.path().join(&file), model.glb()).unwrap();
        let picture = picture(folder.path(), &["--scene", &file, "--background", "1,0,1"]);
        let sky = *picture.get_pixel(0, 0);
        let (mut left, mut right, mut top, mut bottom) = (320, 0, 180, 0);
        for (x, y, _) in picture.enumerate_pixels().filter(|(.., pixel)| differ(pixel, &sky)) {
            (left, right) = (left.min(x), right.max(x));
            (top, bottom) = (top.min(y), bottom.max(y));
        }
        assert!(right > left && bottom > top, "{name} is not in the picture");
        let large = (right - left) * 10 > 320 * 4 || (bottom - top) * 10 > 180 * 6;
        assert!(large, "{name} is {} × {} pixels of 320 × 180", right - left, bottom - top);
        // The lawn, on which one stands, goes on beyond the picture.
        assert!(name == "house" || left > 0 && right < 319 && top > 0 && bottom < 179, "{name} is cut off");
    }
}

#[test]
fn riding_towards_a_model_shows_relativity_within_seconds() {
    let folder = tempfile::tempdir().unwrap();
    for (name, model) in models() {
        let file = format!("{name}.glb");
        std::fs::write(folder.path().join(&file), model.glb()).unwrap();
        let ride =
            ["ride", "--scene", &file, "--seconds", "4", "--record", "r.mcap", "--out", "r.mp4", "--size", "64x36"];
        let output = run(folder.path(), &ride);
        assert!(output.status.success(), "{}", told(&output));
        assert!(told(&output).contains("which suits the scene"), "{}", told(&output));
        let replay = ["--replay", "r.mcap", "--seconds", "2"];
        let [with, without] =
            ["all", "none"].map(|effects| picture(folder.path(), &[&replay[..], &["--effects", effects]].concat()));
        let changed = with.pixels().zip(without.pixels()).filter(|(a, b)| differ(a, b)).count();
        assert!(changed * 5 > 320 * 180, "relativity changes {changed} of {} pixels of {name}", 320 * 180);
        std::fs::remove_file(folder.path().join("r.mcap")).unwrap();
    }
}
