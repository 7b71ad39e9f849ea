//! Openings: windows, shutters and doors.

use glam::{Vec2, Vec3, vec2, vec3};

use crate::town::canvas::{Area, ENDLESS, PaintCanvas, chance, noise, smoothstep};

/// Style and place of a window.
pub(super) struct PaintedWindow {
    pub(super) opening: Area,
    /// Colour of frame and glazing bars.
    pub(super) frame: Vec3,
    /// Colour of a stone surround; `None` for no surround.
    pub(super) surround: Option<Vec3>,
    /// Colour of open shutters on both sides; `None` for no shutters.
    pub(super) shutter: Option<Vec3>,
    pub(super) casements: u32,
    /// Number of panes above one another.
    pub(super) rows: u32,
    pub(super) arched: bool,
}

impl PaintedWindow {
    fn distance(&self, area: Area, p: Vec2) -> f32 {
        if self.arched { area.arch_distance(p) } else { area.distance(p) }
    }
}

/// Paints a window with its shutters, surround, frame, bars and the look of its glass by day.
pub(super) fn window(canvas: &mut PaintCanvas, window: &PaintedWindow, seed: u32) {
    let opening = window.opening;
    let extent = opening.extent();
    if let Some(colour) = window.shutter {
        let leaf = extent.x / 2.0 + 0.02;
        shutter(canvas, Area::new(opening.low.x - leaf - 0.05, opening.low.y - 0.02, leaf, extent.y + 0.04), colour);
        shutter(canvas, Area::new(opening.high.x + 0.05, opening.low.y - 0.02, leaf, extent.y + 0.04), colour);
    }
    let around = opening.grown(if window.surround.is_some() { 0.13 } else { 0.07 });
    canvas.darken(around.grown(0.06), |p| 1.0 - 0.25 * smoothstep(0.06, 0.0, window.distance(around, p)));
    let stone = window.surround.unwrap_or(window.frame * 0.93);
    canvas.fill(
        around,
        |p| window.distance(around, p),
        |p, d| {
            let grit = 1.0 + 0.05 * noise(p * 40.0, ENDLESS, seed) + 0.06 * noise(p * 9.0, ENDLESS, seed + 1);
            stone * grit * (0.86 + 0.14 * smoothstep(0.0, 0.02, -d))
        },
    );
    // The reveal lies in shade, deepest under the lintel.
    canvas.fill(
        opening,
        |p| window.distance(opening, p),
        |p, _| stone * if p.y > opening.high.y - 0.06 { 0.42 } else { 0.62 },
    );
    let glass = opening.grown(-0.025);
    let glazing = |p: Vec2| {
        // Behind the glass: a dark room, pale curtains at the sides; the sky is mirrored above.
        let q = (p - glass.low) / glass.extent();
        let tilt = chance((q.x * window.casements as f32) as i32, (q.y * window.rows as f32) as i32, seed + 3);
        let room = vec3(0.13, 0.15, 0.18) * (0.9 + 0.3 * tilt);
        let sky =
            smoothstep(0.25, 1.1, q.y + 0.35 * q.x + 0.25 * noise(p * 1.6, ENDLESS, seed + 4) - 0.15 + 0.16 * tilt);
        let mirrored = room.lerp(vec3(0.50, 0.58, 0.66), 0.62 * sky);
        let drape = (q.x - 0.5).abs() - 0.27 - 0.10 * (q.y - 0.6).abs() - 0.04 * chance(seed as i32, 7, 3);
        let fold = 0.86 + 0.14 * noise(vec2(p.x * 26.0, p.y), ENDLESS, seed + 5);
        let curtain = vec3(0.72, 0.70, 0.66) * fold * (0.65 + 0.2 * q.y);
        mirrored.lerp(curtain, 0.75 * smoothstep(0.0, 0.012, drape))
    };
    canvas.fill(
        glass,
        |p| window.distance(glass, p),
        |p, _| {
            let shade =
                1.0 - 0.5 * smoothstep(0.16, 0.0, glass.high.y - p.y) - 0.2 * smoothstep(0.08, 0.0, p.x - glass.low.x);
            glazing(p) * shade
        },
    );
    // Distance from the nearest of frame and glazing bars.
    let size = glass.extent();
    let bars = |p: Vec2| {
        let q = p - glass.low;
        let casement = size.x / window.casements as f32;
        let post = ((q.x / casement).round() * casement - q.x).abs() - 0.034;
        let pane = size.y / window.rows as f32;
        let bar = ((q.y / pane).round() * pane - q.y).abs() - 0.014;
        post.min(bar).min(-window.distance(glass, p) - 0.05)
    };
    canvas.fill(
        glass,
        |p| bars(p).max(window.distance(glass, p)),
        |p, d| {
            let lintel = 1.0 - 0.3 * smoothstep(0.12, 0.0, glass.high.y - p.y);
            window.frame * (0.80 + 0.20 * smoothstep(0.0, 0.014, -d)) * lintel
        },
    );
    // The sill casts a little shade.
    let sill = Area::new(opening.low.x - 0.1, opening.low.y - 0.09, extent.x + 0.2, 0.07);
    canvas.halo(sill, 0.05, 0.3);
    canvas.fill(sill, |p| sill.distance(p), |p, _| stone * (0.85 + 0.2 * smoothstep(sill.low.y, sill.high.y, p.y)));
}

/// Paints a louvred shutter.
fn shutter(canvas: &mut PaintCanvas, area: Area, colour: Vec3) {
    canvas.halo(area, 0.05, 0.35);
    canvas.fill(
        area,
        |p| area.distance(p),
        |p, d| {
            let middle = (p.y - area.centre().y).abs();
            let rail = d > -0.055 || middle < 0.035;
            let slat = ((p.y - area.low.y) / 0.045).fract();
            let relief = if rail {
                0.92 + 0.12 * smoothstep(0.0, 0.012, -d) - 0.16 * smoothstep(-0.045, -0.055, d)
            } else {
                0.62 + 0.40 * slat
            };
            let worn = 1.0 + 0.08 * noise(p * 14.0, ENDLESS, 5) + 0.05 * noise(vec2(p.x * 50.0, p.y * 4.0), ENDLESS, 6);
            colour * relief * worn
        },
    );
}

/// Style and place of a door.
pub(super) struct Door {
    pub(super) opening: Area,
    /// Colours of the surround and of the leaves.
    pub(super) stone: Vec3,
    pub(super) colour: Vec3,
    /// True if the door is round-arched and has two leaves.
    pub(super) arched: bool,
}

/// Paints a door of boards and panels in a stone surround.
pub(super) fn door(canvas: &mut PaintCanvas, door: &Door, seed: u32) {
    let Door { opening, arched, .. } = *door;
    let outline = |area: Area, p: Vec2| {
        if arched { area.arch_distance(p) } else { area.distance(p) }
    };
    let around = Area { low: opening.low - vec2(0.2, 0.0), high: opening.high + 0.2 };
    canvas.darken(around.grown(0.06), |p| 1.0 - 0.25 * smoothstep(0.06, 0.0, outline(around, p)));
    let courses = 0.42;
    canvas.fill(
        around,
        |p| outline(around, p),
        |p, d| {
            // Joints run level on the jambs and towards the centre on the arch.
            let spring = vec2(around.centre().x, around.high.y - around.extent().x / 2.0);
            let joint = if arched && p.y > spring.y {
                let to = (p - spring).normalize_or(Vec2::X);
                ((to.x + 1.0) * 4.5).fract()
            } else {
                (p.y / courses).fract()
            };
            let mortar = 0.78 + 0.22 * smoothstep(0.0, 0.06, joint.min(1.0 - joint));
            let grit = 1.0 + 0.06 * noise(p * 40.0, ENDLESS, seed) + 0.08 * noise(p * 6.0, ENDLESS, seed + 1);
            let foot = 1.0 - 0.3 * smoothstep(0.3, 0.0, p.y);
            door.stone * grit * mortar * foot * (0.84 + 0.16 * smoothstep(0.0, 0.03, -d))
        },
    );
    canvas.fill(opening, |p| outline(opening, p), |_, _| door.stone * 0.40);
    let leaf = Area { low: opening.low + vec2(0.04, 0.0), high: opening.high - 0.05 };
    let width = leaf.extent().x;
    canvas.fill(
        leaf,
        |p| outline(leaf, p),
        |p, _| {
            let q = p - leaf.low;
            let grain = noise(vec2(p.x * 60.0, p.y * 2.5), ENDLESS, seed + 2)
                + 0.5 * noise(vec2(p.x * 130.0, p.y * 7.0), ENDLESS, seed + 3);
            let mut relief = 0.9 + 0.10 * grain;
            if arched {
                // Two leaves of boards with a herringbone above the middle rail.
                let side = (q.x - width / 2.0).abs();
                let board = ((side + if q.y > 1.15 { q.y } else { 0.0 }) / 0.16).fract();
                relief *= 0.62 + 0.38 * smoothstep(0.0, 0.12, board.min(1.0 - board));
                if side < 0.02 || (q.y - 1.15).abs() < 0.07 {
                    relief *= if side < 0.012 { 0.35 } else { 1.15 };
                }
            } else {
                // Six panels.
                let panel = vec2((q.x / width * 2.0).fract() - 0.5, (q.y / leaf.extent().y * 3.0).fract() - 0.5).abs();
                let inset = (panel.x - 0.36).max(panel.y - 0.38);
                relief *= 1.0 - 0.35 * smoothstep(0.03, 0.0, inset.abs()) + 0.06 * smoothstep(0.0, -0.1, inset);
            }
            let shade = 1.0 - 0.45 * smoothstep(0.18, 0.0, leaf.high.y - p.y) - 0.25 * smoothstep(0.25, 0.0, p.y);
            door.colour * relief * shade
        },
    );
    let handle = Area::new(leaf.high.x - if arched { width / 2.0 + 0.12 } else { 0.14 }, 1.02, 0.045, 0.14);
    canvas.fill(handle, |p| handle.distance(p), |_, _| vec3(0.62, 0.50, 0.28));
}
