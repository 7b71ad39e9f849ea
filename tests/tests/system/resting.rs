//! Laws: a picture in which nothing changes comes closer and closer to one of many samples, whatever the clock says;
//! any change ends that at once; a photo has every pixel of the window, however few were drawn.
#![allow(clippy::unwrap_used, reason = "a failed construction is a failed test")]

use built_in::lattice::Lattice;
use glam::DVec3;
use image::Rgb32FImage;
use physics::{Beta, Event, Observer};
use render::target::Format;
use render::{Gpu, Pending, SceneRenderer};
use std::time::Duration;
use studio::{SCREEN_FORMAT, Studio, light};
use system_tests::photographer::{AS_GIVEN, gpu};
use view::{Camera, Dial, Effects, Occasion, Shot};
use walls::{Drawing, FlatPicture, PictureShares};

const SIZE: [u32; 2] = [320, 180];

/// Few boxes, large in the picture: its outlines are what single samples get wrong.
const LATTICE: Lattice = Lattice { count: [3, 3, 3], spacing: 4.0, side: 1.6 };

/// Time after which a picture is certainly at rest.
const REST: Duration = Duration::from_millis(300);

/// Number of frames in which a picture at rest certainly gets all of its samples.
const FRAMES: u32 = 20;

fn shot(ct: f64) -> Shot {
    let observer = Observer {
        event: Event { ct, position: DVec3::new(0.4, 0.7, 14.0) },
        celerity: Beta::new(DVec3::NEG_Z * 0.6).unwrap().celerity(),
    };
    let camera = Camera::looking(DVec3::NEG_Z, DVec3::Y, 60.0_f64.to_radians());
    Shot { camera, observer, effects: Effects::ALL, stored_scale: None, outside: None }
}

/// Picture and its renderer, in the way in which a window draws the lattice.
fn window(gpu: &Gpu, dial: Dial) -> (FlatPicture, SceneRenderer) {
    let format = Format::fast(1);
    let scene = LATTICE.build();
    let renderer = SceneRenderer::new(gpu, scene, format, None, dial, Occasion::Ride).unwrap();
    (FlatPicture::new(gpu, SIZE, format, SCREEN_FORMAT, 0.9), renderer)
}

fn draw(gpu: &Gpu, (picture, renderer): &mut (FlatPicture, SceneRenderer), shot: &Shot) {
    let pending = renderer.submit(gpu, &shot.observer, shot.effects).unwrap();
    picture.draw(gpu, renderer, shot, pending).unwrap();
}

/// Light of the whole picture, linear sRGB in cd/m².
fn seen(gpu: &Gpu, (picture, renderer): &mut (FlatPicture, SceneRenderer)) -> Rgb32FImage {
    let stored = renderer.stored(&shot(0.0));
    light(gpu, picture.whole(gpu, renderer).0, &stored).unwrap()
}

/// Mean difference of two pictures, as a share of the mean light of the first.
fn apart(one: &Rgb32FImage, other: &Rgb32FImage) -> f32 {
    let sum = |image: &Rgb32FImage| image.iter().sum::<f32>();
    one.iter().zip(other.iter()).map(|(one, other)| (one - other).abs()).sum::<f32>() / sum(one)
}

#[test]
fn a_picture_at_rest_comes_close_to_one_of_many_samples() {
    let gpu = gpu();
    let scene = LATTICE.build();
    let exact = Studio::format(gpu);
    let mut renderer = SceneRenderer::new(gpu, scene, exact, None, Dial::tolerance(0.25), Occasion::Still).unwrap();
    let many = Studio::new(gpu, SIZE, 64).expose(gpu, &mut renderer, &shot(0.0), Pending::default()).unwrap();

    let mut window = window(gpu, Dial::map(0.9));
    draw(gpu, &mut window, &shot(0.0));
    let first = apart(&many, &seen(gpu, &mut window));
    std::thread::sleep(REST);
    for frame in 0..FRAMES {
        // The clock runs on, and nothing in the scene moves with it.
        draw(gpu, &mut window, &shot(f64::from(frame)));
        assert_eq!(window.0.drawing(), Drawing::Resting);
    }
    let last = apart(&many, &seen(gpu, &mut window));
    assert!(last < 0.65 * first && last > 0.0, "{first} at first, {last} at last");

    let turned = Camera::looking(DVec3::X, DVec3::Y, 1.0);
    draw(gpu, &mut window, &Shot { camera: turned, ..shot(0.0) });
    assert_eq!(window.0.drawing(), Drawing::Moving);
}

#[test]
fn a_photo_has_every_pixel_of_the_window() {
    let gpu = gpu();
    let mut window = window(gpu, AS_GIVEN);
    draw(gpu, &mut window, &shot(0.0));
    let whole = seen(gpu, &mut window);
    window.0.set_shares(PictureShares { moving: 0.5, resting: 0.5 });
    draw(gpu, &mut window, &shot(1.0));
    assert!((window.0.share() - 0.5).abs() < 0.01);
    assert_eq!(apart(&whole, &seen(gpu, &mut window)), 0.0);
    // The same after samples at rest of half the size, and the next of them begin anew.
    std::thread::sleep(REST);
    draw(gpu, &mut window, &shot(2.0));
    draw(gpu, &mut window, &shot(3.0));
    assert_eq!(seen(gpu, &mut window).dimensions(), (SIZE[0], SIZE[1]));
    draw(gpu, &mut window, &shot(4.0));
    assert!((window.0.share() - 0.5).abs() < 0.01);
}
