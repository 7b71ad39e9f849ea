//! Law: each pixel of the picture that the runtime is handed for an eye shows what that eye sees in the direction of
//! the pixel, at rest, near light, and while the head moves in the vehicle; by both methods.
//!
//! Directions come from the runtime's own angles, by plain geometry here; they are taken to the world by multiplied-out
//! matrices, and meet boxes one by one. A wrong program exchanges the eyes, mirrors an angle, counts the head as at
//! rest, encodes twice, or hands over the picture of another moment.

use built_in::lattice::Lattice;
use glam::{DMat3, DQuat, DVec2, DVec3};
use headset::{Headset, HeadsetDevice, HeadsetTurn};
use image::RgbaImage;
use input::openxr::{XrRuntime, XrUse};
use physics::worldline::{Thrust, WorldlineState};
use physics::{Celerity, Event};
use render::display::{Development, Gamut};
use render::picture::Sheet;
use render::target::Format;
use render::{Gpu, SceneRenderer};
use room::{Display, HeadsetEye};
use scene::Scene;
use scene::refine::refine;
use std::time::{Duration, Instant};
use system_tests::exact::Boxes;
use system_tests::occupants::EyeInWorld;
use system_tests::photographer::{AS_GIVEN, DEFAULT_MAP};
use view::{Dial, Effects, Occasion};
use walls::{Occupant, Quality, RoomHead, Walls};

const BACKGROUND: [f32; 3] = [0.01, 0.02, 0.03];
const LATTICE: Lattice = Lattice { count: [6, 6, 6], spacing: 4.0, side: 1.0 };
/// Longest edge, metres.
const EDGE_M: f32 = 0.09;
/// Largest share of pixels that may differ.
const SHARE_AT_MOST: f64 = 0.005;
/// Time in which a session begins.
const PATIENCE: Duration = Duration::from_secs(20);

/// Next turn that will be seen.
fn next(headset: &mut Headset) -> HeadsetTurn {
    let began = Instant::now();
    while began.elapsed() < PATIENCE {
        match headset.wait().unwrap() {
            Some(turn) if turn.is_seen => return turn,
            Some(turn) => headset.show(&turn, |_, _| unreachable!("nothing is seen")).unwrap(),
            None => {}
        }
    }
    panic!("the session does not begin")
}

fn vehicle(celerity: DVec3) -> WorldlineState {
    let orientation = DQuat::from_rotation_y(0.4) * DQuat::from_rotation_x(-0.3);
    let event = Event { ct: 0.7, position: DVec3::new(0.375, -1.81875, 0.53125) };
    WorldlineState::new(event, Celerity::new(celerity).unwrap(), orientation)
}

/// Head where the runtime saw it, with this celerity and turn.
fn head(turn: &HeadsetTurn, celerity: DVec3, turn_rate: DVec3) -> RoomHead {
    let pose = turn.report.head;
    let place = pose.position_m.expect("the head is seen").map(f64::from);
    let orientation = DQuat::from_array(pose.orientation.expect("the head is seen").map(f64::from));
    RoomHead {
        place_m: DVec3::from_array(place),
        room_from_head: DMat3::from_quat(orientation.normalize()),
        celerity: Celerity::new(celerity).unwrap(),
        turn_rate,
    }
}

/// Exact colour at a place of an eye's picture, pixels.
fn exact(boxes: &Boxes, occupant: &Occupant, (eye, size): (&HeadsetEye, [u32; 2]), at: DVec2) -> [u8; 4] {
    let share = at / DVec2::new(size[0].into(), size[1].into());
    let tangents = DVec2::new(share.x, 1.0 - share.y) * (eye.high - eye.low) + eye.low;
    let of_head = eye.orientation * DVec3::new(tangents.x, tangents.y, -1.0);
    let in_world = EyeInWorld::of(occupant, eye.position_m.x);
    boxes.first(in_world.place, in_world.origin(occupant.head.room_from_head * of_head))
}

/// Picture that was handed over, read back and left as a target.
fn read_back(gpu: &Gpu, view: &wgpu::TextureView) -> RgbaImage {
    let texture = view.texture();
    let [width, height] = [texture.width(), texture.height()];
    let sheet = Sheet::new(gpu, [width, height], texture.format());
    let encoder = gpu.device.create_command_encoder(&Default::default());
    let mut bytes = sheet.fetch_from(gpu, encoder, texture).unwrap();
    if texture.format().remove_srgb_suffix() == wgpu::TextureFormat::Bgra8Unorm {
        bytes.chunks_exact_mut(4).for_each(|pixel| pixel.swap(0, 2));
    }
    let mut encoder = gpu.device.create_command_encoder(&Default::default());
    drop(render::display::over(&mut encoder, view));
    gpu.queue.submit([encoder.finish()]);
    RgbaImage::from_raw(width, height, bytes).unwrap()
}

fn assert_pictures(headset: &mut Headset, gpu: &Gpu, method: Dial, scene: &Scene) {
    let boxes = Boxes::of(&LATTICE, BACKGROUND);
    let fast = DVec3::new(-0.6, 0.2, -1.0).normalize() * (0.9 / (1.0 - 0.81_f64).sqrt());
    let moving = (DVec3::new(0.5, -0.1, 0.3), DVec3::new(0.5, 3.0, -0.4));
    let still = (DVec3::ZERO, DVec3::ZERO);
    let format = Format::exact(gpu);
    let mut renderer =
        SceneRenderer::new(gpu, scene.clone(), format, Some(BACKGROUND), method, Occasion::Still).unwrap();
    let quality = Quality { format, samples: 1, density: 1.0, smooth: false };
    let development = Development { gamut: Gamut::Clamp, ..Default::default() };
    let turn = next(headset);
    let display = Display::headset("headset", &turn.eyes, headset.sizes());
    headset.show(&turn, |_, _| {}).unwrap();
    let mut walls = Walls::new(gpu, display, quality, headset.format());
    for (celerity, (walks, turns)) in [(DVec3::ZERO, still), (fast, still), (fast, moving)] {
        let turn = next(headset);
        let head = head(&turn, walks, turns);
        let occupant = Occupant { vehicle: vehicle(celerity), thrust: Thrust::default(), head };
        walls.headset = Some(turn.eyes);
        let submitted = walls.submit(gpu, &mut renderer, &occupant, Effects::GEOMETRY).unwrap();
        walls.draw(gpu, &mut renderer, submitted).unwrap();
        walls.adapt(gpu, &development, None);
        let mut pictures = Vec::new();
        headset
            .show(&turn, |eye, view| {
                let mut encoder = gpu.device.create_command_encoder(&Default::default());
                walls.show_window(gpu, &mut encoder, eye, &development, view, [0, 0]);
                gpu.queue.submit([encoder.finish()]);
                pictures.push(read_back(gpu, view));
            })
            .unwrap();
        for (picture, eye) in pictures.iter().zip(&turn.eyes) {
            let size = [picture.width(), picture.height()];
            let (mut wrong, mut colours) = (0_u32, std::collections::HashSet::new());
            for (x, y, pixel) in picture.enumerate_pixels() {
                let middle = DVec2::new(x.into(), y.into()) + 0.5;
                let expected = exact(&boxes, &occupant, (eye, size), middle);
                wrong += u32::from(pixel.0 != expected);
                colours.insert(pixel.0);
            }
            let share = f64::from(wrong) / f64::from(size[0] * size[1]);
            let what = format!("{method}, u = {:.2}, head u = {:.2}", celerity.length(), walks.length());
            println!("{what}, eye at {:+.4} m: {share:.5} differ", eye.position_m.x);
            assert!(share <= SHARE_AT_MOST, "{what}: {share} of the pixels differ");
            assert!(colours.len() >= 4, "{} colours are too few to compare", colours.len());
        }
        assert!(pictures[0] != pictures[1], "both eyes see the same");
    }
}

#[test]
fn each_pixel_that_is_handed_over_shows_what_its_eye_sees() {
    let runtime = XrRuntime::new(XrUse::Pictures).unwrap();
    let device = HeadsetDevice::open(&runtime).unwrap();
    let mut headset = Headset::new(runtime, &device).unwrap();
    println!("{:?} on {}", headset.names(), device.gpu.description());
    let refined = refine(&LATTICE.build(), EDGE_M).unwrap();
    let polygon = AS_GIVEN;
    let image = DEFAULT_MAP;
    assert_pictures(&mut headset, &device.gpu, polygon, &refined);
    assert_pictures(&mut headset, &device.gpu, image, &LATTICE.build());
    drop(headset);
    device.gpu.wait().unwrap();
}
