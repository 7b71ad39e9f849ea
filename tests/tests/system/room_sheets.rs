//! Laws: a sheet that floats in the room is seen by each eye, on every screen, where the way from the eye through the
//! screen's point meets it; no speed bends, shifts or brightens it; a photo-surface behind it is as it was.
//!
//! A wrong program shows a menu that lies on the wall instead of in the room, that one eye sees elsewhere than the
//! other, that bends with the street, or that grows dark astern.
#![allow(clippy::unwrap_used, reason = "a failed construction is a failed test")]

use built_in::lattice::Lattice;
use glam::{DMat3, DQuat, DVec2, DVec3};
use image::{Rgba, RgbaImage};
use physics::worldline::{Thrust, WorldlineState};
use physics::{Celerity, Event};
use render::display::Development;
use render::target::Format;
use render::{SceneRenderer, view_from_rows};
use room::Display;
use studio::SCREEN_FORMAT;
use system_tests::photographer::gpu;
use system_tests::turns::turn;
use view::{Dial, Effects, Occasion};
use walls::{Occupant, Quality, RoomHead, RoomSheet, Walls};

/// Colour of the sheet, which no box has.
const MAGENTA: [u8; 4] = [255, 0, 255, 255];
/// Largest distance of a sheet's outline, where half of a pixel is covered, from its place, pixels.
const OUTLINE_PIXELS: f64 = 0.5;
/// Largest change of a value by a sheet that covers less than half of a pixel.
const HALF_COVERED: u8 = 128;
/// Distance from the outline, pixels, from which a sheet is opaque, however obliquely it is seen.
const OPAQUE_PIXELS: f64 = 3.0;

struct Room {
    walls: Walls,
    renderer: SceneRenderer,
}

impl Room {
    fn new(name: &str, coarser: u32) -> Self {
        let mut display = Display::built_in(name).unwrap();
        for window in &mut display.windows {
            window.size = window.size.map(|side| side / coarser);
        }
        for channel in &mut display.channels {
            channel.viewport = channel.viewport.map(|side| side / coarser);
        }
        let format = Format::fast(1);
        let quality = Quality { format, samples: 1, density: 1.0, smooth: true };
        let lattice = Lattice { count: [4, 4, 4], spacing: 4.0, side: 1.4 };
        let scene = lattice.build();
        let renderer = SceneRenderer::new(gpu(), scene, format, None, Dial::map(1.0), Occasion::Ride).unwrap();
        Self { walls: Walls::new(gpu(), display, quality, SCREEN_FORMAT), renderer }
    }

    /// Sheet before the viewer, turned and inclined, which reaches over the edges of several screens.
    fn sheet(&self) -> RoomSheet {
        let turn = DQuat::from_rotation_y(-0.6) * DQuat::from_rotation_x(0.3);
        let (right_m, up_m) = (turn * DVec3::X * 1.7, turn * DVec3::Y * 1.1);
        let middle = self.walls.display.viewer.head_m + DVec3::new(0.5, -0.2, -0.9);
        let pixels: Vec<u8> = MAGENTA.repeat(16);
        let picture = view_from_rows(gpu(), "sheet", [4, 4, 1], wgpu::TextureFormat::Rgba8Unorm, &pixels);
        RoomSheet { corner_m: middle - 0.5 * (right_m + up_m), right_m, up_m, picture }
    }

    fn head(&self) -> RoomHead {
        let place_m = self.walls.display.viewer.head_m + DVec3::new(-0.12, 0.07, 0.2);
        let room_from_head = DMat3::from_quat(DQuat::from_rotation_y(0.4) * DQuat::from_rotation_z(0.2));
        RoomHead { room_from_head, ..RoomHead::at_rest(place_m) }
    }

    /// Pictures of all channels for a vehicle at this celerity, with these sheets.
    fn pictures(&mut self, celerity: f64, sheets: Vec<RoomSheet>) -> Vec<RgbaImage> {
        let event = Event { ct: 0.0, position: DVec3::new(0.4, -1.1, 11.0) };
        let vehicle = WorldlineState::new(event, Celerity::new(DVec3::NEG_Z * celerity).unwrap(), DQuat::IDENTITY);
        let occupant = Occupant { vehicle, thrust: Thrust::default(), head: self.head() };
        // A method plans by the frame before, so the light compared is that of frames that nothing sets apart.
        for _ in 0..4 {
            let submitted = self.walls.submit(gpu(), &mut self.renderer, &occupant, Effects::ALL).unwrap();
            self.walls.draw(gpu(), &mut self.renderer, submitted).unwrap();
            self.renderer.settle();
        }
        self.walls.sheets = sheets;
        let development = Development::default();
        self.walls.adapt(gpu(), &development, None);
        let channels = 0..self.walls.display.channels.len();
        channels.map(|channel| self.walls.develop(gpu(), channel, &development).unwrap()).collect()
    }

    /// True if the way from the eye of a channel through the point that a place of its viewport lights meets the sheet.
    /// `None` where the place lights nothing.
    fn meets(&self, channel: usize, place: DVec2, sheet: &RoomSheet) -> Option<bool> {
        let channel = &self.walls.display.channels[channel];
        let point = channel.point(&self.walls.display, place)?;
        let head = self.head();
        let eye = self.walls.display.viewer.eye_m(channel.eye, head.place_m, head.room_from_head);
        // Cramer's rule for eye + t (point − eye) = corner + a right + b up.
        let matrix = DMat3::from_cols(point - eye, -sheet.right_m, -sheet.up_m);
        let [t, a, b] = (matrix.inverse() * (sheet.corner_m - eye)).to_array();
        Some(t > 0.0 && (0.0..=1.0).contains(&a) && (0.0..=1.0).contains(&b))
    }
}

fn assert_a_sheet_is_in_its_place(name: &str, coarser: u32, least_seen: usize) {
    let _turn = turn();
    let mut room = Room::new(name, coarser);
    let sheet = room.sheet();
    let without = room.pictures(0.0, Vec::new());
    let with = room.pictures(0.0, vec![sheet.clone()]);
    let fast = room.pictures(7.0, vec![sheet.clone()]);
    let mut seen = 0;
    for (channel, ((with, without), fast)) in with.iter().zip(&without).zip(&fast).enumerate() {
        let size = DVec2::new(f64::from(with.width()), f64::from(with.height()));
        let (mut inside, mut outside) = (0, 0);
        for (x, y, pixel) in with.enumerate_pixels() {
            let centre = DVec2::new(f64::from(x) + 0.5, f64::from(y) + 0.5);
            let around = |reach: f64| {
                let steps = [-reach, 0.0, reach];
                let places = steps.into_iter().flat_map(|x| steps.map(|y| centre + DVec2::new(x, y)));
                places.map(|place| room.meets(channel, place / size, &sheet)).collect::<Vec<_>>()
            };
            let Rgba([red, green, blue, _]) = *pixel;
            if around(OPAQUE_PIXELS).iter().all(|met| *met == Some(true)) {
                assert!(green == 0 && red == blue, "{name}, channel {channel}, pixel {x}, {y}: {pixel:?}");
                assert_eq!(fast.get_pixel(x, y), pixel, "{name}, channel {channel}, pixel {x}, {y}: at 0.99 c");
                inside += 1;
            } else if around(OUTLINE_PIXELS).iter().all(|met| *met == Some(false)) {
                let before = without.get_pixel(x, y);
                let changed = (0..3).map(|part| pixel.0[part].abs_diff(before.0[part])).max().unwrap();
                assert!(changed <= HALF_COVERED, "{name}, channel {channel}, pixel {x}, {y}: {pixel:?}, {before:?}");
                outside += 1;
            }
        }
        assert!(outside > 0, "{name}, channel {channel}");
        seen += usize::from(inside > 50);
    }
    assert!(seen >= least_seen, "{name}: only {seen} channels show the sheet");
}

#[test]
fn a_sheet_floats_in_the_room_for_both_eyes_on_flat_walls() {
    assert_a_sheet_is_in_its_place("cave4", 5, 4);
}

#[test]
fn a_sheet_floats_in_the_room_through_the_projectors_of_a_dome() {
    assert_a_sheet_is_in_its_place("dome6", 6, 2);
}
