//! Lines of the vehicle about its rider: a hoop below the eyes with marks, which rests in the vehicle and is something
//! to hold on to with the eyes while the world bends and turns.
//!
//! The hoop lies in a level plane, so all of it is one sheet ([`RoomSheet`]), which each eye sees where it is. Its lines
//! are drawn as wide as they are to look equally wide from the seat all around, and never finer than the screen's
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

/// Sheet with the lines, for a seat whose eyes are at `head_m`, room axes, metres. `pixels_per_rad`: those of the finest
/// screen.
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
    let ways = marks.iter().map(to_mark).chain([to_hoop]);
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
