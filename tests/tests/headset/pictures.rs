//! Laws: each pixel of the picture that the runtime is handed for an eye shows what that eye sees in the direction of
//! the pixel, at rest, near light, and while the head moves in the vehicle, by both methods, in one pass for both eyes
//! and in one for each; what no lens shows is black; and the depth of each pixel is the distance at which the eye sees
//! it.
//!
//! Directions come from the runtime's own angles, by plain geometry here; they are taken to the world by multiplied-out
//! matrices, and meet boxes one by one. A wrong program exchanges the eyes, mirrors an angle, counts the head as at
//! rest, encodes twice, draws both eyes into one layer, takes the distance in the world for that in the eye's frame, or
//! hands over the picture of another moment.

use built_in::lattice::Lattice;
use glam::{DMat3, DQuat, DVec2, DVec3};
use headset::{DEPTH_NEAR_M, Headset, HeadsetDevice, HeadsetTurn};
use input::openxr::{XrRuntime, XrUse};
use physics::worldline::{Thrust, WorldlineState};
use physics::{Celerity, Event};
use render::display::{Development, Gamut};
use render::target::Format;
use render::{Gpu, SceneRenderer};
use room::{Display, HeadsetEye};
use scene::Scene;
use scene::refine::refine;
use std::collections::HashSet;
use std::process::Command;
use std::time::{Duration, Instant};
use studio::Sheet;
use system_tests::exact::Boxes;
use system_tests::occupants::EyeInWorld;
use system_tests::photographer::{AS_GIVEN, DEFAULT_MAP};
use view::{Dial, Effects, Occasion};
use walls::{Occupant, PictureShares, Quality, RoomHead, Walls};
use xr_layer::LayerScript;

const BACKGROUND: [f32; 3] = [0.01, 0.02, 0.03];
const LATTICE: Lattice = Lattice { count: [6, 6, 6], spacing: 4.0, side: 1.0 };
/// Longest edge, metres.
const EDGE_M: f32 = 0.09;
/// Largest share of pixels that may differ.
const SHARE_AT_MOST: f64 = 0.005;
/// Largest error of a depth, as a share of it: edges are bent between their ends.
const DEPTH_ERROR: f64 = 0.005;
/// The same for the nearest of a pixel's samples, which lie beside its middle.
const NEAREST_ERROR: f64 = 0.05;
/// Time in which a session begins.
const PATIENCE: Duration = Duration::from_secs(20);

/// Next turn that will be seen.
fn next(headset: &mut Headset) -> HeadsetTurn {
    let began = Instant::now();
    while began.elapsed() < PATIENCE {
        match headset.wait().unwrap() {
            Some(turn) if turn.is_seen => return turn,
            Some(turn) => headset.show(&turn, |_| unreachable!("nothing is seen")).unwrap(),
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

/// One eye's picture, with what is to be seen in it.
struct EyePicture<'a> {
    boxes: &'a Boxes,
    occupant: &'a Occupant,
    eye: &'a HeadsetEye,
    /// Triangles that no lens shows, as tangents.
    hidden: &'a [[f32; 2]],
    size: [u32; 2],
}

impl EyePicture<'_> {
    /// Tangents to the right and up of the middle of a pixel.
    fn tangents(&self, [x, y]: [u32; 2]) -> DVec2 {
        let share = (DVec2::new(x.into(), y.into()) + 0.5) / DVec2::new(self.size[0].into(), self.size[1].into());
        DVec2::new(share.x, 1.0 - share.y) * (self.eye.high - self.eye.low) + self.eye.low
    }

    fn is_hidden(&self, tangents: DVec2) -> bool {
        self.hidden.chunks_exact(3).any(|of| {
            let corners = [0, 1, 2].map(|corner| DVec2::new(of[corner][0].into(), of[corner][1].into()));
            let side = |a: usize, b: usize| (corners[b] - corners[a]).perp_dot(tangents - corners[a]);
            let sides = [side(0, 1), side(1, 2), side(2, 0)];
            sides.iter().all(|side| *side >= 0.0) || sides.iter().all(|side| *side <= 0.0)
        })
    }

    /// Eye in the world, direction in the room's axes, and direction in the world.
    fn ray(&self, tangents: DVec2) -> (EyeInWorld, DVec3, DVec3) {
        let of_head = self.eye.orientation * DVec3::new(tangents.x, tangents.y, -1.0);
        let in_world = EyeInWorld::of(self.occupant, self.eye.position_m.x);
        let seen = self.occupant.head.room_from_head * of_head;
        let origin = in_world.origin(seen);
        (in_world, seen, origin)
    }

    /// Exact colour of a pixel.
    fn colour(&self, pixel: [u32; 2]) -> [u8; 4] {
        let tangents = self.tangents(pixel);
        if self.is_hidden(tangents) {
            return [0, 0, 0, 255];
        }
        let (in_world, _, origin) = self.ray(tangents);
        self.boxes.first(in_world.place, origin)
    }

    /// Exact depth of a pixel: its apparent place before the eye, metres; infinite for the sky.
    fn before_the_eye_m(&self, pixel: [u32; 2]) -> f64 {
        let tangents = self.tangents(pixel);
        let (in_world, seen, origin) = self.ray(tangents);
        let Some(distance) = self.boxes.distance(in_world.place, origin) else { return f64::INFINITY };
        in_world.apparent_m(seen, distance) / tangents.extend(-1.0).length()
    }
}

/// Layer of a picture that was handed over, read back and left as a target.
fn read_back(gpu: &Gpu, view: &wgpu::TextureView, layer: usize) -> Vec<u8> {
    let texture = view.texture();
    let sheet = Sheet::new(gpu, [texture.width(), texture.height()], texture.format());
    let encoder = gpu.device.create_command_encoder(&Default::default());
    let mut bytes = sheet.fetch_from(gpu, encoder, texture, layer as u32).unwrap();
    if texture.format().remove_srgb_suffix() == wgpu::TextureFormat::Bgra8Unorm {
        bytes.chunks_exact_mut(4).for_each(|pixel| pixel.swap(0, 2));
    }
    let mut encoder = gpu.device.create_command_encoder(&Default::default());
    if texture.format().is_depth_stencil_format() {
        drop(encoder.begin_render_pass(&wgpu::RenderPassDescriptor {
            depth_stencil_attachment: Some(wgpu::RenderPassDepthStencilAttachment {
                view,
                depth_ops: Some(wgpu::Operations { load: wgpu::LoadOp::Load, store: wgpu::StoreOp::Store }),
                stencil_ops: None,
            }),
            ..Default::default()
        }));
    } else {
        drop(render::display::over(&mut encoder, view));
    }
    gpu.queue.submit([encoder.finish()]);
    bytes
}

/// Ways in which a scene is drawn for a headset.
#[derive(Clone, Copy)]
struct Way {
    method: Dial,
    format: Format,
    in_one_pass: bool,
    /// Share of the pictures' width and height that is drawn.
    share: f64,
}

fn assert_pictures(headset: &mut Headset, gpu: &Gpu, way: Way, scene: &Scene) {
    let boxes = Boxes::of(&LATTICE, BACKGROUND);
    let fast = DVec3::new(-0.6, 0.2, -1.0).normalize() * (0.9 / (1.0 - 0.81_f64).sqrt());
    let moving = (DVec3::new(0.5, -0.1, 0.3), DVec3::new(0.5, 3.0, -0.4));
    let still = (DVec3::ZERO, DVec3::ZERO);
    let Way { method, format, in_one_pass, share } = way;
    headset.in_one_pass = in_one_pass;
    let mut renderer =
        SceneRenderer::new(gpu, scene.clone(), format, Some(BACKGROUND), method, Occasion::Still).unwrap();
    let quality = Quality { format, samples: 1, density: 1.0, smooth: false };
    let development = Development { gamut: Gamut::Clamp, ..Default::default() };
    let turn = next(headset);
    let display = Display::headset("headset", &turn.eyes, headset.sizes());
    headset.show(&turn, |_| false).unwrap();
    let mut walls = Walls::new(gpu, display, quality, headset.format());
    let hidden: Vec<_> = (0..headset.sizes().len()).map(|view| headset.hidden(view)).collect();
    hidden.iter().enumerate().for_each(|(view, corners)| walls.hide(gpu, view, corners));
    walls.keep_depth(gpu);
    walls.set_shares(PictureShares { moving: share, resting: share });
    for (celerity, (walks, turns)) in [(DVec3::ZERO, still), (fast, still), (fast, moving)] {
        let turn = next(headset);
        let head = head(&turn, walks, turns);
        let occupant = Occupant { vehicle: vehicle(celerity), thrust: Thrust::default(), head };
        walls.headset = Some(turn.eyes.clone());
        let submitted = walls.submit(gpu, &mut renderer, &occupant, Effects::GEOMETRY).unwrap();
        walls.draw(gpu, &mut renderer, submitted).unwrap();
        walls.adapt(gpu, &development, None);
        let (mut pictures, mut depths) = (Vec::new(), Vec::new());
        headset
            .show(&turn, |lent| {
                assert_eq!(lent.both.is_some(), in_one_pass);
                let has_depth = lent.show(gpu, &mut walls, &development);
                assert_eq!(has_depth, method == AS_GIVEN, "the runtime takes the depth of polygons");
                pictures.extend(lent.layers.iter().enumerate().map(|(layer, view)| read_back(gpu, view, layer)));
                let of = lent.depths.iter().enumerate().filter(|_| has_depth);
                depths.extend(of.map(|(layer, view)| read_back(gpu, view, layer)));
                has_depth
            })
            .unwrap();
        assert!(pictures[0] != pictures[1], "both eyes see the same");
        let what = format!(
            "{method}, {} pass, u = {:.2}, head u = {:.2}",
            if in_one_pass { "one" } else { "each its" },
            celerity.length(),
            walks.length()
        );
        for (number, eye) in turn.eyes.iter().enumerate() {
            let size = headset.sizes()[number];
            let seen = EyePicture { boxes: &boxes, occupant: &occupant, eye, hidden: &hidden[number], size };
            let pixels = (0..size[1]).flat_map(|y| (0..size[0]).map(move |x| [x, y]));
            let all = f64::from(size[0] * size[1]);
            let wrong =
                pixels.clone().zip(pictures[number].chunks_exact(4)).filter(|(at, pixel)| seen.colour(*at) != **pixel);
            let differ = wrong.count() as f64 / all;
            let colours: HashSet<&[u8]> = pictures[number].chunks_exact(4).collect();
            println!("{what}, eye at {:+.4} m: {differ:.5} differ", eye.position_m.x);
            // Smoothed edges have colours of their own.
            assert!(differ <= SHARE_AT_MOST || format.samples > 1, "{what}: {differ} of the pixels differ");
            assert!(colours.len() >= 4, "{} colours are too few to compare", colours.len());
            let Some(depth) = depths.get(number) else { continue };
            let error = if format.samples == 1 { DEPTH_ERROR } else { NEAREST_ERROR };
            let found = depth.chunks_exact(4).map(|bytes| f64::from(f32::from_le_bytes(bytes.try_into().unwrap())));
            let colours = pictures[number].chunks_exact(4);
            let is_wrong = |((at, colour), found): &(([u32; 2], &[u8]), f64)| {
                let expected = DEPTH_NEAR_M / seen.before_the_eye_m(*at);
                let counts =
                    !seen.is_hidden(seen.tangents(*at)) && (format.samples == 1 || seen.colour(*at) == **colour);
                counts && (found - expected).abs() > error * expected
            };
            let wrong = pixels.zip(colours).zip(found).filter(is_wrong).count() as f64 / all;
            println!("{what}, eye at {:+.4} m: depth of {wrong:.5} differs", eye.position_m.x);
            assert!(wrong <= SHARE_AT_MOST, "{what}: the depth of {wrong} of the pixels differs");
        }
    }
}

#[test]
fn each_pixel_that_is_handed_over_shows_what_its_eye_sees() {
    let runtime = XrRuntime::new(XrUse::Pictures).unwrap();
    let device = HeadsetDevice::open(&runtime).unwrap();
    let mut headset = Headset::new(runtime, &device).unwrap();
    let gpu = &device.gpu;
    println!("{:?} on {}", headset.names(), gpu.description());
    assert!(headset.in_one_pass, "this driver draws both eyes in one pass");
    println!("{} views", headset.sizes().len());
    assert!((0..2).all(|view| !headset.hidden(view).is_empty()), "this runtime knows what no lens shows");
    let (plain, refined) = (LATTICE.build(), refine(&LATTICE.build(), EDGE_M).unwrap());
    let exact = Format::exact(gpu);
    for in_one_pass in [true, false] {
        assert_pictures(&mut headset, gpu, Way { method: AS_GIVEN, format: exact, in_one_pass, share: 1.0 }, &refined);
        assert_pictures(&mut headset, gpu, Way { method: DEFAULT_MAP, format: exact, in_one_pass, share: 1.0 }, &plain);
    }
    // As rides are drawn: the depth is that of the nearest of several samples, and of fewer pixels on slow machines.
    for share in [1.0, 0.8] {
        let smoothed = Way { method: AS_GIVEN, format: Format::fast(4), in_one_pass: true, share };
        assert_pictures(&mut headset, gpu, smoothed, &refined);
    }
    drop(headset);
    device.gpu.wait().unwrap();
}

#[test]
fn each_pixel_of_a_headset_with_finer_views_within_shows_what_its_eye_sees() {
    let folder = tempfile::tempdir().unwrap();
    let script = LayerScript::new(folder.path());
    script.say(&["insets"]);
    let mut itself = Command::new(std::env::current_exe().unwrap());
    let name = "pictures::each_pixel_that_is_handed_over_shows_what_its_eye_sees";
    script.lead(itself.args(["--exact", name, "--nocapture"]));
    let output = itself.output().unwrap();
    let said = String::from_utf8_lossy(&output.stdout);
    println!("{said}");
    assert!(output.status.success() && said.contains("4 views"), "{}", String::from_utf8_lossy(&output.stderr));
}
