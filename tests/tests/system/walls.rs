//! A pixel of a wall must show what the viewer's eye sees in the direction from the eye to that pixel, in the axes of
//! the viewer's own frame. That frame is a pure boost of the vehicle's, by the motion of the head in it (W 6.3,
//! 6.4.1, B 4.1). Both eyes are at one moment of the viewer's time.
//!
//! The pictures are compared with boxes met by rays one by one. Wall pixels are projected back to directions by plain
//! geometry here, and taken to the world by multiplied-out Lorentz matrices, which share nothing with the program's
//! own composition of boosts.
//!
//! A wrong program shows walls that do not meet in their corners; eyes that are alike or exchanged; a head that
//! counts as at rest while it walks, or is added to the vehicle without the rotation that two boosts make.
#![allow(clippy::unwrap_used, reason = "a failed construction is a failed test")]

use built_in::lattice::Lattice;
use glam::{DQuat, DVec2, DVec3};
use image::RgbaImage;
use physics::worldline::{Thrust, WorldlineState};
use physics::{Celerity, Event};
use rayon::prelude::*;
use render::SceneRenderer;
use render::display::{Development, Gamut};
use room::{Channel, Display, Viewer, room_from_turned};
use scene::Scene;
use scene::refine::refine;
use std::sync::LazyLock;
use studio::{SCREEN_FORMAT, Studio};
use system_tests::exact::Boxes;
use system_tests::lorentz::{boost, four, parts, rotation, space};
use system_tests::occupants::EyeInWorld;
use system_tests::photographer::{AS_GIVEN, DEFAULT_MAP, gpu};
use system_tests::turns::turn;
use view::{Dial, Effects, Occasion};
use walls::{Occupant, Quality, RoomHead, Walls};

const BACKGROUND: [f32; 3] = [0.01, 0.02, 0.03];
const LATTICE: Lattice = Lattice { count: [6, 6, 6], spacing: 4.0, side: 1.0 };
/// Longest edge, metres, like in `lattice_pixels`.
const EDGE_M: f32 = 0.09;
/// Largest share of pixels that may differ: the project's promise for pixels of walls.
const SHARE_AT_MOST: f64 = 0.01;
/// The same for a curved screen whose pixels are looked up in the map.
const CURVED_AT_MOST: f64 = 0.003;
/// Largest distance of an outline from its exact place, pixels.
const REACH: f64 = 0.75;

static REFINED: LazyLock<Scene> = LazyLock::new(|| refine(&LATTICE.build(), EDGE_M).unwrap());

/// Built-in display with pixels `coarser` times as large.
fn display(name: &str, coarser: u32) -> Display {
    let mut display = Display::built_in(name).unwrap();
    for window in &mut display.windows {
        window.size = window.size.map(|side| side / coarser);
    }
    for channel in &mut display.channels {
        channel.viewport = channel.viewport.map(|side| side / coarser);
    }
    // Gains would change the colours, by which this test recognises surfaces.
    for projector in &mut display.projectors {
        (projector.even, projector.blend) = (false, false);
    }
    display
}

/// Vehicle between the boxes, turned arbitrarily, with this celerity.
fn vehicle(celerity: DVec3) -> WorldlineState {
    let orientation = DQuat::from_rotation_y(0.4) * DQuat::from_rotation_x(-0.3);
    let event = Event { ct: 0.7, position: DVec3::new(0.375, -1.81875, 0.53125) };
    WorldlineState::new(event, Celerity::new(celerity).unwrap(), orientation)
}

fn head(viewer: &Viewer, celerity: DVec3) -> RoomHead {
    RoomHead {
        place_m: viewer.head_m + DVec3::new(0.2, 0.1, -0.15),
        room_from_head: room_from_turned(20.0, -10.0, 5.0),
        celerity: Celerity::new(celerity).unwrap(),
        turn_rate: DVec3::ZERO,
    }
}

/// Pictures of all channels, for each occupant.
fn drawn(display: &Display, method: Dial, scene: &Scene, occupants: &[Occupant]) -> Vec<Vec<RgbaImage>> {
    let _turn = turn();
    let format = Studio::format(gpu());
    let quality = Quality { format, samples: 1, density: 3.0, smooth: false };
    let mut renderer =
        SceneRenderer::new(gpu(), scene.clone(), format, Some(BACKGROUND), method, Occasion::Still).unwrap();
    let mut walls = Walls::new(gpu(), display.clone(), quality, SCREEN_FORMAT);
    let development = Development { gamut: Gamut::Clamp, ..Default::default() };
    let mut pictures = Vec::new();
    for occupant in occupants {
        let submitted = walls.submit(gpu(), &mut renderer, occupant, Effects::GEOMETRY).unwrap();
        walls.draw(gpu(), &mut renderer, submitted).unwrap();
        walls.adapt(gpu(), &development, None);
        let channels = 0..display.channels.len();
        pictures.push(channels.map(|channel| walls.develop(gpu(), channel, &development).unwrap()).collect());
    }
    pictures
}

/// Exact picture of a channel, by textbook formulas.
struct ExactChannel<'a> {
    boxes: &'a Boxes,
    display: &'a Display,
    channel: &'a Channel,
    eye: EyeInWorld,
    eye_m: DVec3,
}

impl<'a> ExactChannel<'a> {
    fn new(boxes: &'a Boxes, display: &'a Display, channel: &'a Channel, occupant: &Occupant) -> Self {
        let aside_m = 0.5 * channel.eye.side() * display.viewer.eye_separation_m;
        let eye = EyeInWorld::of(occupant, aside_m * display.viewer.eye_scale);
        let eye_m = occupant.head.place_m + occupant.head.room_from_head.x_axis * aside_m;
        Self { boxes, display, channel, eye, eye_m }
    }

    /// Exact colour at a place of the viewport, in pixels; black where no surface is lit.
    fn colour(&self, at: DVec2) -> [u8; 4] {
        let [width, height] = self.channel.size().map(f64::from);
        let Some(point) = self.channel.point(self.display, at / DVec2::new(width, height)) else {
            return [0, 0, 0, 255];
        };
        self.boxes.first(self.eye.place, self.eye.origin(point - self.eye_m))
    }

    fn shows_near(&self, middle: DVec2, colour: [u8; 4]) -> bool {
        let steps = || (-16..=16).map(|step| f64::from(step) / 16.0 * REACH);
        steps().any(|down| steps().any(|right| self.colour(middle + DVec2::new(right, down)) == colour))
    }
}

/// Share of pixels of a channel that differ, and share of those that show a colour found nowhere near.
fn compare(picture: &RgbaImage, exact: &ExactChannel<'_>) -> (f64, f64) {
    let pixels: Vec<_> = picture.enumerate_pixels().collect();
    let middle = |column: u32, row: u32| DVec2::new(f64::from(column), f64::from(row)) + 0.5;
    let wrong: Vec<_> = pixels.par_iter().filter(|(x, y, pixel)| exact.colour(middle(*x, *y)) != pixel.0).collect();
    let stray = wrong.par_iter().filter(|(x, y, pixel)| !exact.shows_near(middle(*x, *y), pixel.0)).count();
    let share = |count: usize| count as f64 / pixels.len() as f64;
    (share(wrong.len()), share(stray))
}

fn assert_walls(name: &str, coarser: u32, method: Dial, scene: &Scene, most: f64) {
    let boxes = Boxes::of(&LATTICE, BACKGROUND);
    let display = display(name, coarser);
    let fast = DVec3::new(-0.6, 0.2, -1.0).normalize() * (0.9 / (1.0 - 0.81_f64).sqrt());
    let thrust = Thrust::default();
    // Rates in radians per metre: of a flight that rolls and noses up, and of a head that is shaken, near light.
    let turning = Thrust { turn_rate: DVec3::new(0.09, -0.05, 0.12), ..thrust };
    let turning_head = head(&display.viewer, DVec3::new(0.5, -0.1, 0.3));
    let turning_head = RoomHead { turn_rate: DVec3::new(0.5, 3.0, -0.4), ..turning_head };
    let occupants = [
        Occupant { vehicle: vehicle(DVec3::ZERO), thrust, head: head(&display.viewer, DVec3::ZERO) },
        Occupant { vehicle: vehicle(fast), thrust, head: head(&display.viewer, DVec3::ZERO) },
        Occupant { vehicle: vehicle(fast), thrust, head: head(&display.viewer, DVec3::new(0.5, -0.1, 0.3)) },
        Occupant { vehicle: vehicle(fast), thrust: turning, head: turning_head },
    ];
    let pictures = drawn(&display, method, scene, &occupants);
    for (occupant, pictures) in occupants.iter().zip(&pictures) {
        let mut colours = std::collections::HashSet::new();
        for (channel, picture) in display.channels.iter().zip(pictures) {
            let exact = ExactChannel::new(&boxes, &display, channel, occupant);
            let (share, stray) = compare(picture, &exact);
            let what = format!("{name} {} by {method}, head {}", channel.name, occupant.head.celerity.vector());
            println!("{what}: {share:.5} differ, {stray:.6} stray");
            assert!(share < most, "{what}: {share} of the pixels differ");
            assert!(stray < 1e-4, "{what}: {stray} of the pixels show what is nowhere near");
            colours.extend(picture.pixels().map(|pixel| pixel.0));
        }
        assert!(colours.len() >= 4, "{name}: {} colours are too few to compare", colours.len());
    }
}

#[test]
fn every_wall_of_a_cave_shows_what_each_eye_sees() {
    assert_walls("cave4", 8, AS_GIVEN, &REFINED, SHARE_AT_MOST);
}

#[test]
fn every_wall_of_a_cave_shows_what_each_eye_sees_by_maps() {
    assert_walls("cave4", 8, DEFAULT_MAP, &LATTICE.build(), SHARE_AT_MOST);
}

#[test]
fn a_curved_screen_shows_what_the_eye_sees() {
    assert_walls("curved", 6, AS_GIVEN, &REFINED, SHARE_AT_MOST);
}

#[test]
fn a_curved_screen_shows_what_the_eye_sees_by_maps() {
    assert_walls("curved", 6, DEFAULT_MAP, &LATTICE.build(), CURVED_AT_MOST);
}

#[test]
fn every_projector_of_a_dome_shows_what_the_eye_sees() {
    // Six pictures must agree where they overlap, if each is in its place.
    assert_walls("dome6", 4, AS_GIVEN, &REFINED, SHARE_AT_MOST);
}

#[test]
fn the_walls_for_both_eyes_draw_little_more_than_the_world_around_them() {
    // Four walls see less than the whole world, and each draws what its own pyramid holds. Without that, eight channels
    // draw everything eight times.
    let display = display("cave4", 8);
    let fast = DVec3::new(-0.6, 0.2, -1.0).normalize() * (0.9 / (1.0 - 0.81_f64).sqrt());
    let plain = Effects::NONE;
    for method in [AS_GIVEN, Dial::tolerance(0.25)] {
        for (celerity, effects) in [(DVec3::ZERO, plain), (DVec3::ZERO, Effects::GEOMETRY), (fast, Effects::GEOMETRY)] {
            let _turn = turn();
            let quality = Quality { format: Studio::format(gpu()), samples: 1, density: 1.0, smooth: false };
            let occasion = Occasion::Still;
            let mut renderer =
                SceneRenderer::new(gpu(), REFINED.clone(), quality.format, None, method, occasion).unwrap();
            let mut walls = Walls::new(gpu(), display.clone(), quality, SCREEN_FORMAT);
            let head = head(&display.viewer, DVec3::ZERO);
            let occupant = Occupant { vehicle: vehicle(celerity), thrust: Thrust::default(), head };
            let submitted = walls.submit(gpu(), &mut renderer, &occupant, effects).unwrap();
            walls.draw(gpu(), &mut renderer, submitted).unwrap();
            let (drawn, all) = (renderer.take_drawn().triangles, renderer.triangle_count());
            println!("{method} at u = {}: {drawn} triangles of {all}", celerity.length());
            assert_eq!(display.channels.len(), 8);
            assert!(drawn > all, "{drawn} triangles are too few for two eyes");
            assert!(drawn <= 2 * all, "eight channels draw {drawn} triangles of {all}");
        }
    }
}

#[test]
fn vehicle_and_head_together_are_one_boost_and_one_rotation() {
    let display = display("cave4", 8);
    let fast = DVec3::new(-0.9, 0.4, -1.5);
    let thrust = Thrust::default();
    let walking = Occupant { vehicle: vehicle(fast), thrust, head: head(&display.viewer, DVec3::new(0.7, -0.2, 0.5)) };

    // Reference: one boost, at the same event.
    let Occupant { vehicle, head, .. } = walking;
    let room_from_world = rotation(vehicle.orientation).inverse() * boost(fast);
    let head_from_world = boost(head.celerity.vector()) * room_from_world;
    let (celerity, room_from_boosted) = parts(head_from_world);
    let orientation = room_from_boosted.inverse();
    let event = four(vehicle.ct, vehicle.position) + room_from_world.inverse() * four(0.0, head.place_m);
    let reference = event - boost(-celerity) * rotation(orientation) * four(0.0, head.place_m);
    let reference = Event { ct: reference.x, position: space(reference) };
    let at_rest = RoomHead { celerity: Celerity::ZERO, ..head };
    let one = Occupant {
        vehicle: WorldlineState::new(reference, Celerity::new(celerity).unwrap(), orientation),
        thrust,
        head: at_rest,
    };

    let pictures = drawn(&display, AS_GIVEN, &REFINED, &[walking, one]);
    for (channel, (walking, one)) in display.channels.iter().zip(pictures[0].iter().zip(&pictures[1])) {
        let differing = walking.pixels().zip(one.pixels()).filter(|(a, b)| a != b).count();
        let share = differing as f64 / f64::from(walking.width() * walking.height());
        println!("{}: {share:.6}", channel.name);
        // A rounding of a sixteenth of a bit may move an outline across a pixel's middle in a few places.
        assert!(share < 2e-4, "{}: {share} of the pixels differ", channel.name);
    }
}
