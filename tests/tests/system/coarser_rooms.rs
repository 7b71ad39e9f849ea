//! Laws: a room that is drawn with fewer pixels shows the same picture, blurred and in its place, on flat and on bent
//! screens; drawn with all of them again, it shows the same bits as ever. At rest it has all of them, and any change
//! ends that. A photo has them all.
//!
//! A wrong program shows pictures that are shifted or cut off, screens that keep the size of an earlier share, or
//! light of an earlier frame.
#![allow(clippy::unwrap_used, reason = "a failed construction is a failed test")]

use built_in::lattice::Lattice;
use glam::{DQuat, DVec3};
use image::RgbaImage;
use image::imageops::blur;
use physics::worldline::{Thrust, WorldlineState};
use physics::{Celerity, Event};
use render::SceneRenderer;
use render::display::Development;
use render::target::Format;
use room::Display;
use std::time::Duration;
use studio::SCREEN_FORMAT;
use system_tests::photographer::{AS_GIVEN, gpu};
use system_tests::turns::turn;
use view::{Dial, Effects, Occasion};
use walls::{Drawing, Occupant, PictureShares, Quality, RoomHead, Walls};

/// Few boxes, large in the picture.
const LATTICE: Lattice = Lattice { count: [4, 4, 4], spacing: 4.0, side: 1.4 };
const MAP: Dial = Dial::map(1.0);
/// Share of width and height in these tests.
const HALF: PictureShares = PictureShares { moving: 0.5, resting: 1.0 };
/// Standard deviation of the blur in which both pictures are compared, pixels: outlines alone differ otherwise.
const BLUR: f32 = 2.0;
/// Largest mean difference of blurred pictures, of 255: with single samples, outlines are a pixel off at random.
const ALIKE: f64 = 9.0;
/// Smallest ratio by which pictures differ more when one of them is moved by a pixel. Half a pixel would make it 1.
const MOVED: f64 = 1.05;
/// Time after which a room is certainly at rest.
const REST: Duration = Duration::from_millis(300);

/// Room in windows, and its renderer.
struct Ride {
    walls: Walls,
    renderer: SceneRenderer,
}

impl Ride {
    /// Built-in display with pixels `coarser` times as large, drawn as windows draw it.
    fn new(name: &str, coarser: u32, method: Dial, format: Format) -> Self {
        let mut display = Display::built_in(name).unwrap();
        for window in &mut display.windows {
            window.size = window.size.map(|side| side / coarser);
        }
        for channel in &mut display.channels {
            channel.viewport = channel.viewport.map(|side| side / coarser);
        }
        let quality = Quality { format, samples: 1, density: 1.0, smooth: true };
        let renderer = SceneRenderer::new(gpu(), LATTICE.build(), format, None, method, Occasion::Ride).unwrap();
        Self { walls: Walls::new(gpu(), display, quality, SCREEN_FORMAT), renderer }
    }

    fn in_windows(name: &str, coarser: u32, method: Dial) -> Self {
        Self::new(name, coarser, method, Format::fast(1))
    }

    /// Occupant whose vehicle has ridden this far.
    fn occupant(&self, ahead_m: f64) -> Occupant {
        let event = Event { ct: ahead_m, position: DVec3::new(0.4, -1.1, 11.0 - ahead_m) };
        let celerity = Celerity::new(DVec3::new(-0.1, 0.0, -0.75)).unwrap();
        let vehicle = WorldlineState::new(event, celerity, DQuat::from_rotation_y(0.2));
        Occupant { vehicle, thrust: Thrust::default(), head: RoomHead::at_rest(self.walls.display.viewer.head_m) }
    }

    fn draw(&mut self, occupant: &Occupant) {
        let submitted = self.walls.submit(gpu(), &mut self.renderer, occupant, Effects::GEOMETRY).unwrap();
        self.walls.draw(gpu(), &mut self.renderer, submitted).unwrap();
        self.renderer.settle();
    }

    /// Pictures of all channels, to an eye that is adapted to them.
    fn pictures(&mut self) -> Vec<RgbaImage> {
        let development = Development::default();
        self.walls.adapt(gpu(), &development, None);
        let channels = 0..self.walls.display.channels.len();
        channels.map(|channel| self.walls.develop(gpu(), channel, &development).unwrap()).collect()
    }

    /// Pictures of all channels, drawn with these shares from a place that nothing was drawn from before.
    fn seen_with(&mut self, shares: PictureShares, ahead_m: f64) -> Vec<RgbaImage> {
        self.walls.set_shares(shares);
        // A method may draw a frame behind, and plan by the frame before.
        for behind_m in [1.0, 0.2, 0.1, 0.0] {
            let occupant = self.occupant(ahead_m - behind_m);
            self.draw(&occupant);
        }
        self.pictures()
    }
}

/// Mean difference of two pictures, of 255, the second moved by pixels right and down.
fn apart(one: &RgbaImage, other: &RgbaImage, [right, down]: [i32; 2]) -> f64 {
    let inside = |at: u32, step: i32, side: u32| at.checked_add_signed(step).filter(|at| *at < side);
    let mut sum = 0.0;
    let mut count = 0.0;
    for (x, y, pixel) in one.enumerate_pixels() {
        if let (Some(x), Some(y)) = (inside(x, right, one.width()), inside(y, down, one.height())) {
            let other = other.get_pixel(x, y);
            sum += (0..3).map(|c| f64::from(pixel.0[c].abs_diff(other.0[c]))).sum::<f64>() / 3.0;
            count += 1.0;
        }
    }
    sum / count
}

fn assert_coarser_is_the_same(name: &str, coarser: u32, method: Dial) {
    let _turn = turn();
    let mut ride = Ride::in_windows(name, coarser, method);
    let whole = ride.seen_with(PictureShares::default(), 1.0);
    let half = ride.seen_with(HALF, 1.0);
    assert_eq!(ride.walls.share(), 0.5);
    assert!(half != whole, "{name} by {method}");
    for ((whole, half), channel) in whole.iter().zip(&half).zip(&ride.walls.display.channels) {
        let what = format!("{name} {} by {method}", channel.name);
        assert_eq!(half.dimensions(), whole.dimensions());
        let [whole, half] = [whole, half].map(|picture| blur(picture, BLUR));
        let here = apart(&whole, &half, [0, 0]);
        println!("{what}: {here:.2} apart");
        assert!(here < ALIKE, "{what}: {here}");
        // Outlines are in their place, where there are any.
        for step in [[1, 0], [-1, 0], [0, 1], [0, -1]] {
            let there = apart(&whole, &half, step);
            assert!(there >= MOVED * here, "{what}: {here} here, {there} at {step:?}");
        }
    }
    let again = ride.seen_with(PictureShares::default(), 1.0);
    // All of them again: the same bits as if there had never been fewer. A map is planned by the one before it.
    let differs = whole.iter().zip(&again).map(|(whole, again)| apart(whole, again, [0, 0])).fold(0.0, f64::max);
    assert!(differs <= if method == MAP { ALIKE } else { 0.0 }, "{name} by {method}: {differs}");
    assert!(Ride::in_windows(name, coarser, method).seen_with(PictureShares::default(), 1.0) == whole);
}

#[test]
fn a_room_of_flat_screens_with_fewer_pixels_shows_the_same_picture() {
    assert_coarser_is_the_same("window", 4, AS_GIVEN);
    assert_coarser_is_the_same("cave4", 4, MAP);
}

#[test]
fn a_bent_screen_with_fewer_pixels_shows_the_same_picture() {
    // By flat pictures that are resampled, and by one look-up for each pixel.
    assert_coarser_is_the_same("curved", 6, AS_GIVEN);
    assert_coarser_is_the_same("curved", 6, MAP);
}

#[test]
fn projectors_with_fewer_pixels_show_the_same_picture() {
    assert_coarser_is_the_same("dome6", 6, AS_GIVEN);
}

#[test]
fn light_that_is_kept_exactly_is_always_drawn_to_the_full() {
    if !gpu().has_full_precision() {
        return;
    }
    let _turn = turn();
    let mut ride = Ride::new("window", 4, AS_GIVEN, Format::exact(gpu()));
    let whole = ride.seen_with(PictureShares::default(), 1.0);
    assert!(ride.seen_with(HALF, 1.0) == whole);
    assert_eq!(ride.walls.share(), 1.0);
}

#[test]
fn a_room_at_rest_and_its_photo_have_every_pixel() {
    let mut ride = Ride::in_windows("window", 4, AS_GIVEN);
    let whole = ride.seen_with(PictureShares::default(), 2.0);
    let half = ride.seen_with(HALF, 2.0);
    assert!(half != whole);
    assert_eq!(ride.walls.drawing(), Drawing::Moving);
    ride.walls.draw_whole(gpu(), &mut ride.renderer).unwrap();
    assert!(ride.pictures() == whole);

    std::thread::sleep(REST);
    let still = ride.occupant(2.0);
    ride.draw(&still);
    assert_eq!((ride.walls.drawing(), ride.walls.share()), (Drawing::Resting, 1.0));
    assert!(ride.pictures() == whole);
    let moved = ride.occupant(2.1);
    ride.draw(&moved);
    assert_eq!((ride.walls.drawing(), ride.walls.share()), (Drawing::Moving, 0.5));
}

#[test]
fn a_screen_seen_from_behind_is_black_with_fewer_pixels_as_well() {
    let mut ride = Ride::in_windows("window", 4, AS_GIVEN);
    let seen = ride.seen_with(HALF, 1.0);
    assert!(seen[0].pixels().any(|pixel| pixel.0 != [0, 0, 0, 255]));
    let mut behind = ride.occupant(1.0);
    behind.head.place_m.z = -50.0;
    ride.draw(&behind);
    assert!(ride.pictures()[0].pixels().all(|pixel| pixel.0 == [0, 0, 0, 255]));
}
