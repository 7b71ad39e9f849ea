//! Lines of the vehicle about its rider: a hoop below the eyes with marks, which rests in the vehicle and is something
//! to hold on to with the eyes while the world bends and turns.
//!
//! The hoop lies in a level plane, so all of it is one sheet ([`RoomSheet`]), which each eye sees where it is. Its
//! lines are drawn so wide that they look equally wide from the seat all around, and never finer than the screen's
//! pixels, or they would break up where the plane is seen flat.

use glam::{DVec2, DVec3};
use render::Gpu;
use walls::RoomSheet;

/// Depth of the hoop's plane below the eyes of the seat, metres.
const BELOW_M: f64 = 0.58;
/// Reach of the hoop to each side, ahead and behind, metres: half of one ellipse ahead, and half of another behind.
const ASIDE_M: f64 = 0.78;
const AHEAD_M: f64 = 1.35;
const BEHIND_M: f64 = 0.72;
/// Free border of the sheet, metres.
const BORDER_M: f64 = 0.06;
/// Angle from one mark to the next as the ellipse is run through, degrees; each third one is long.
const MARK_DEG: usize = 10;
/// Share of the way from the hoop to its middle that short and long marks take.
const MARKS: [f64; 2] = [0.05, 0.1];
/// Half width of the lines as the seat sees them, radians, and of the dark seam about them, in half widths.
const HALF_WIDTH_RAD: f64 = 1.6e-3;
const SEAM: f64 = 2.4;
/// Least half width, pixels.
const LEAST_PIXELS: f64 = 0.7;
/// Colour of the lines, sRGB, and opacities of lines and seam.
const INK: [f64; 3] = [214.0, 226.0, 238.0];
const OPACITIES: [f64; 2] = [0.85, 0.4];
/// Most texels along the sheet.
const MOST_TEXELS: f64 = 1536.0;

/// Sheet with the lines, for a seat whose eyes are at `head_m`, room axes, metres. `pixels_per_rad`: those of the
/// finest screen.
pub fn cockpit(gpu: &Gpu, head_m: DVec3, pixels_per_rad: f64) -> RoomSheet {
    let size = DVec2::new(2.0 * ASIDE_M, AHEAD_M + BEHIND_M) + 2.0 * BORDER_M;
    // A pixel of the screen, and a texel of the sheet, where the hoop is nearest.
    let nearest_m = DVec2::new(ASIDE_M.min(BEHIND_M), BELOW_M).length();
    let texel_m = (nearest_m / pixels_per_rad).max(size.max_element() / MOST_TEXELS);
    let pixel_rad = texel_m / nearest_m;
    let texels = (size / texel_m).ceil().as_uvec2();
    let mut rows = Vec::with_capacity((texels.x * texels.y * 4) as usize);
    let marks = marks();
    for row in 0..texels.y {
        for column in 0..texels.x {
            let share = (DVec2::new(column.into(), row.into()) + 0.5) / texels.as_dvec2();
            let place = DVec2::new(size.x * (share.x - 0.5), AHEAD_M + BORDER_M - size.y * share.y);
            rows.extend(ink(off_rad(place, &marks), pixel_rad));
        }
    }
    let picture =
        render::view_from_rows(gpu, "cockpit", [texels.x, texels.y, 1], wgpu::TextureFormat::Rgba8Unorm, &rows);
    let corner_m = head_m + DVec3::new(-0.5 * size.x, -BELOW_M, BEHIND_M + BORDER_M);
    RoomSheet { corner_m, right_m: DVec3::X * size.x, up_m: DVec3::NEG_Z * size.y, picture }
}

/// Reach of the hoop along x and along y, on the half of the plane in which `ahead` is: metres.
fn reach(ahead: f64) -> DVec2 {
    DVec2::new(ASIDE_M, if ahead < 0.0 { BEHIND_M } else { AHEAD_M })
}

/// Point of the hoop at an angle of its ellipse to the right of straight ahead, radians: to the right and ahead of the
/// seat, metres.
fn hoop(angle_rad: f64) -> DVec2 {
    let towards = DVec2::new(angle_rad.sin(), angle_rad.cos());
    towards * reach(towards.y)
}

/// Ends of the marks, which lead from the hoop inward.
fn marks() -> Vec<[DVec2; 2]> {
    let angles = (0..360).step_by(MARK_DEG).enumerate();
    let mark = |(number, degrees): (usize, i32)| {
        let outer = hoop(f64::from(degrees).to_radians());
        [outer, outer * (1.0 - MARKS[usize::from(number % 3 == 0)])]
    };
    angles.map(mark).collect()
}

/// Angle between a place of the plane and the line that is next to it, as the seat sees them, radians; infinite where
/// no line is near.
fn off_rad(place: DVec2, marks: &[[DVec2; 2]]) -> f64 {
    /// Values of the ellipse's equation between which hoop and marks lie.
    const NEAR: std::ops::Range<f64> = -0.3..0.2;
    /// Square of the distance from a mark's outer end, in lengths of the mark, within which it can be near.
    const MARK_REACH: f64 = 4.0;
    let reach = reach(place.y);
    let value = (place / reach).length_squared() - 1.0;
    if !NEAR.contains(&value) {
        return f64::INFINITY;
    }
    let slope = 2.0 * place / (reach * reach);
    let to_hoop = slope * (value / slope.length_squared());
    let to_mark = |[from, to]: &[DVec2; 2]| {
        let along = *to - *from;
        let share = ((place - *from).dot(along) / along.length_squared()).clamp(0.0, 1.0);
        place - (*from + share * along)
    };
    // A mark that is farther away than it is long is not the next one, or not near.
    let is_near =
        |[from, to]: &&[DVec2; 2]| (place - *from).length_squared() <= MARK_REACH * (*to - *from).length_squared();
    let ways = marks.iter().filter(is_near).map(to_mark).chain([to_hoop]);
    ways.map(|way| seen_rad(place, way)).fold(f64::INFINITY, f64::min)
}

/// Angle at which the seat sees a short way in the plane, radians: a way outward is foreshortened, one across is not.
fn seen_rad(place: DVec2, way: DVec2) -> f64 {
    let distance = DVec2::new(place.length(), BELOW_M).length();
    let outward = place.normalize_or_zero();
    DVec2::new(way.dot(outward) * BELOW_M / distance, way.perp_dot(outward)).length() / distance
}

/// Texel at an angle from a line, whose edge is as soft as a pixel: sRGB in 8 bits, times its opacity.
fn ink(off_rad: f64, pixel_rad: f64) -> [u8; 4] {
    let half_rad = HALF_WIDTH_RAD.max(LEAST_PIXELS * pixel_rad);
    let cover = |half_rad: f64| ((half_rad - off_rad) / pixel_rad + 0.5).clamp(0.0, 1.0);
    let line = OPACITIES[0] * cover(half_rad);
    let seam = OPACITIES[1] * cover(SEAM * half_rad);
    let [red, green, blue] = INK.map(|part| (part * line).round() as u8);
    [red, green, blue, (255.0 * (line + seam * (1.0 - line))).round() as u8]
}

#[cfg(test)]
mod tests {
    //! Laws: each eye of a headset sees each point of the hoop where plain geometry says, wherever the head is and
    //! looks; a vignette darkens the light by its angle and leaves the lines; a fade takes both; without any of them a
    //! picture is as it was. A wrong program nails the lines to the head, or shows each eye the other's.
    #![allow(clippy::unwrap_used, reason = "a failed construction is a failed test")]

    use super::*;
    use built_in::lattice::Lattice;
    use glam::{DMat3, DQuat};
    use image::RgbaImage;
    use physics::worldline::{Thrust, WorldlineState};
    use physics::{Celerity, Event};
    use render::SceneRenderer;
    use render::display::Development;
    use render::target::Format;
    use room::{Display, HeadsetEye};
    use studio::SCREEN_FORMAT;
    use view::{Dial, Effects, Occasion};
    use walls::{Occupant, Quality, RoomHead, Veil, Walls};

    /// Width and height of an eye's picture, pixels.
    const SIDE: u32 = 400;
    /// Largest distance of a line from its place, pixels.
    const PLACE_PIXELS: f64 = 0.6;
    /// Pixels about a line's place in which it is looked for.
    const REACH: i32 = 4;

    struct Seat {
        gpu: Gpu,
        walls: Walls,
        renderer: SceneRenderer,
        lines: RoomSheet,
    }

    impl Seat {
        fn new() -> Self {
            let gpu = Gpu::new().unwrap();
            let display = Display::headset("headset", &HeadsetEye::usual(2), &[[SIDE; 2]; 2]);
            let lines = cockpit(&gpu, display.viewer.head_m, f64::from(SIDE) / 2.0);
            let format = Format::fast(1);
            let scene = Lattice { count: [3, 3, 3], spacing: 4.0, side: 1.4 }.build();
            let renderer = SceneRenderer::new(&gpu, scene, format, None, Dial::map(1.0), Occasion::Ride).unwrap();
            let quality = Quality { format, samples: 1, density: 1.0, smooth: true };
            let mut walls = Walls::new(&gpu, display, quality, SCREEN_FORMAT);
            walls.headset = Some(HeadsetEye::usual(2));
            Self { gpu, walls, renderer, lines }
        }

        /// Draws the light that this head sees.
        fn look(&mut self, head: RoomHead) {
            let event = Event { ct: 0.0, position: DVec3::new(0.4, -1.1, 9.0) };
            let vehicle = WorldlineState::new(event, Celerity::ZERO, DQuat::IDENTITY);
            let occupant = Occupant { vehicle, thrust: Thrust::default(), head };
            let Self { gpu, walls, renderer, .. } = self;
            for _ in 0..3 {
                let submitted = walls.submit(gpu, renderer, &occupant, Effects::ALL).unwrap();
                walls.draw(gpu, renderer, submitted).unwrap();
                renderer.settle();
            }
            walls.adapt(gpu, &Development::default(), None);
        }

        /// Pictures of both eyes with these lines and veils.
        fn pictures(&mut self, lines: bool, vignette: Veil, fade: Veil) -> [RgbaImage; 2] {
            let Self { gpu, walls, lines: sheet, .. } = self;
            walls.sheets = if lines { vec![sheet.clone()] } else { Vec::new() };
            (walls.vignette, walls.fade) = (vignette, fade);
            [0, 1].map(|eye| walls.develop(gpu, eye, &Development::default()).unwrap())
        }
    }

    /// Place of a point of the room in the picture of an eye, pixels; `None` where it does not show it with all that
    /// is about it.
    fn place(point: DVec3, head: &RoomHead, eye: &HeadsetEye) -> Option<DVec2> {
        let of_eye = head.room_from_head.transpose() * (point - head.place_m) - eye.position_m;
        let tangents = DVec2::new(of_eye.x, -of_eye.y) / -of_eye.z;
        let pixel = (tangents + 1.0) * 0.5 * f64::from(SIDE);
        let inside = f64::from(REACH + 2)..f64::from(SIDE as i32 - REACH - 2);
        (of_eye.z < -0.1 && inside.contains(&pixel.x) && inside.contains(&pixel.y)).then_some(pixel)
    }

    fn heads() -> [RoomHead; 4] {
        let seat = RoomHead::at_rest(Display::headset("headset", &HeadsetEye::usual(2), &[[1; 2]; 2]).viewer.head_m);
        let looks =
            |yaw: f64, pitch: f64| DMat3::from_quat(DQuat::from_rotation_y(yaw) * DQuat::from_rotation_x(pitch));
        [
            seat,
            RoomHead { room_from_head: looks(0.0, -0.5), ..seat },
            RoomHead {
                room_from_head: looks(0.9, -0.4),
                place_m: seat.place_m + DVec3::new(-0.1, 0.05, -0.15),
                ..seat
            },
            RoomHead { room_from_head: looks(-1.4, -0.3), place_m: seat.place_m + DVec3::new(0.15, -0.1, 0.1), ..seat },
        ]
    }

    #[test]
    fn each_eye_sees_the_hoop_where_it_is() {
        let mut seat = Seat::new();
        let seat_m = seat.walls.display.viewer.head_m;
        let mut seen = [0, 0];
        for head in heads() {
            seat.look(head);
            let without = seat.pictures(false, Veil::NONE, Veil::NONE);
            // Before black, a line is all that is bright.
            let black = Veil::everywhere(1.0);
            let with = seat.pictures(true, black, Veil::NONE);
            for ((number, eye), (with, without)) in
                HeadsetEye::usual(2).iter().enumerate().zip(with.iter().zip(&without))
            {
                // Between the marks, which are 10° apart.
                for degrees in (5..360).step_by(10) {
                    let angle = f64::from(degrees).to_radians();
                    let (right, ahead) = (ASIDE_M * angle.sin(), angle.cos());
                    let ahead = ahead * if ahead < 0.0 { BEHIND_M } else { AHEAD_M };
                    let point = seat_m + DVec3::new(right, -BELOW_M, -ahead);
                    let Some(at) = place(point, &head, eye) else { continue };
                    // The line's direction in the picture, from a point close by.
                    let near = angle + 0.01;
                    let (right, ahead) = (ASIDE_M * near.sin(), near.cos());
                    let ahead = ahead * if ahead < 0.0 { BEHIND_M } else { AHEAD_M };
                    let Some(next) = place(seat_m + DVec3::new(right, -BELOW_M, -ahead), &head, eye) else { continue };
                    let across = (next - at).normalize().perp();
                    // The middle of the brightness across the line is its place.
                    let (mut sum, mut moment) = (0.0, 0.0);
                    for (x, y) in (-REACH..=REACH).flat_map(|x| (-REACH..=REACH).map(move |y| (x, y))) {
                        let pixel = (at.floor().as_ivec2() + glam::IVec2::new(x, y)).as_uvec2();
                        let bright = f64::from(with.get_pixel(pixel.x, pixel.y).0[1]);
                        let off = pixel.as_dvec2() + 0.5 - at;
                        if off.length() <= f64::from(REACH) {
                            sum += bright;
                            moment += bright * off.dot(across);
                        }
                    }
                    assert!(sum > 500.0, "eye {number}, {degrees}°: nothing at {at}");
                    let off = moment / sum;
                    assert!(off.abs() < PLACE_PIXELS, "eye {number}, {degrees}°: {off} pixels from {at}");
                    seen[number] += 1;
                }
                // A line hides little.
                let lit = with.pixels().filter(|pixel| pixel.0[1] > 8).count();
                assert!(lit * 25 < without.pixels().len(), "{lit} pixels");
            }
        }
        assert!(seen.iter().all(|seen| *seen > 30), "{seen:?}");
    }

    #[test]
    fn a_vignette_darkens_the_light_and_leaves_the_lines_and_a_fade_takes_all() {
        let mut seat = Seat::new();
        seat.look(heads()[1]);
        let plain = seat.pictures(false, Veil::NONE, Veil::NONE);
        let veil = Veil { angles_rad: [0.25, 0.6], opacity: 1.0 };
        let veiled = seat.pictures(false, veil, Veil::NONE);
        let lined = seat.pictures(true, veil, Veil::NONE);
        let (mut dimmed, mut kept) = (0, 0);
        for (eye, (plain, veiled)) in plain.iter().zip(&veiled).enumerate() {
            for (x, y, before) in plain.enumerate_pixels() {
                let tangents = (DVec2::new(x.into(), y.into()) + 0.5) / f64::from(SIDE) * 2.0 - 1.0;
                let share = 1.0 - veil.opacity_at(tangents.length().atan());
                for (before, after) in before.0[..3].iter().zip(&veiled.get_pixel(x, y).0[..3]) {
                    let (expected, after) = (f64::from(*before) * share, f64::from(*after));
                    assert!((expected - after).abs() <= 1.5, "eye {eye}, pixel {x}, {y}: {after} for {expected}");
                    assert!(share < 1.0 || expected == after, "eye {eye}, pixel {x}, {y}");
                }
                dimmed += usize::from(before.0[1] > 40 && share < 0.2);
                kept += usize::from(share == 0.0 && lined[eye].get_pixel(x, y).0[1] > 150);
            }
        }
        assert!(dimmed > 1000 && kept > 50, "{dimmed} pixels are dimmed, {kept} show lines in the dark");
        for picture in seat.pictures(true, Veil::NONE, Veil::everywhere(1.0)) {
            assert!(picture.pixels().all(|pixel| pixel.0[..3] == [0; 3]));
        }
        assert_eq!(seat.pictures(false, Veil::NONE, Veil::NONE), plain);
    }
}
