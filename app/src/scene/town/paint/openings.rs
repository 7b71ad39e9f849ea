//! Windows, doors and ground floors.

use glam::{Vec2, Vec3, Vec4, ivec2, vec2, vec3};

use super::masonry::{ashlar_at, plaster_at, rubble_at};
use crate::scene::town::canvas::{Area, Canvas, ENDLESS, chance, cloud, noise, smoothstep};
use crate::scene::town::turn::circle;

/// A window to be painted.
pub(super) struct Window {
    pub(super) opening: Area,
    /// Colour of frame and glazing bars.
    pub(super) frame: Vec3,
    /// Colour of a stone surround.
    pub(super) surround: Option<Vec3>,
    /// Colour of open shutters on both sides.
    pub(super) shutter: Option<Vec3>,
    pub(super) casements: u32,
    /// Panes above one another.
    pub(super) rows: u32,
    pub(super) arched: bool,
}

impl Window {
    fn distance(&self, area: Area, p: Vec2) -> f32 {
        if self.arched { area.arch_distance(p) } else { area.distance(p) }
    }
}

/// Paints a window with its shutters, surround, frame, bars and what glass shows by day.
pub(super) fn window(canvas: &mut Canvas, window: &Window, seed: u32) {
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
    canvas.fill(around, |p| {
        let d = window.distance(around, p);
        let grit = 1.0 + 0.05 * noise(p * 40.0, ENDLESS, seed) + 0.06 * noise(p * 9.0, ENDLESS, seed + 1);
        (d, stone * grit * (0.86 + 0.14 * smoothstep(0.0, 0.02, -d)))
    });
    // The reveal lies in shade, most of all under the lintel.
    canvas.fill(opening, |p| {
        (window.distance(opening, p), stone * if p.y > opening.high.y - 0.06 { 0.42 } else { 0.62 })
    });
    let glass = opening.grown(-0.025);
    let glazing = |p: Vec2| {
        // What lies behind: a dark room, pale curtains at the sides, the sky mirrored above.
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
    canvas.fill(glass, |p| {
        let shade =
            1.0 - 0.5 * smoothstep(0.16, 0.0, glass.high.y - p.y) - 0.2 * smoothstep(0.08, 0.0, p.x - glass.low.x);
        (window.distance(glass, p), glazing(p) * shade)
    });
    // Frame and glazing bars, as the distance from the nearest of them.
    let size = glass.extent();
    let bars = |p: Vec2| {
        let q = p - glass.low;
        let casement = size.x / window.casements as f32;
        let post = ((q.x / casement).round() * casement - q.x).abs() - 0.034;
        let pane = size.y / window.rows as f32;
        let bar = ((q.y / pane).round() * pane - q.y).abs() - 0.014;
        post.min(bar).min(-window.distance(glass, p) - 0.05)
    };
    canvas.fill(glass, |p| {
        let d = bars(p).max(window.distance(glass, p));
        (
            d,
            window.frame
                * (0.80 + 0.20 * smoothstep(0.0, 0.014, -d))
                * (1.0 - 0.3 * smoothstep(0.12, 0.0, glass.high.y - p.y)),
        )
    });
    // The sill throws a little shade.
    let sill = Area::new(opening.low.x - 0.1, opening.low.y - 0.09, extent.x + 0.2, 0.07);
    canvas.halo(sill, 0.05, 0.3);
    canvas.fill(sill, |p| (sill.distance(p), stone * (0.85 + 0.2 * smoothstep(sill.low.y, sill.high.y, p.y))));
}

/// A louvred shutter.
fn shutter(canvas: &mut Canvas, area: Area, colour: Vec3) {
    canvas.halo(area, 0.05, 0.35);
    canvas.fill(area, |p| {
        let d = area.distance(p);
        let middle = (p.y - area.centre().y).abs();
        let rail = d > -0.055 || middle < 0.035;
        let slat = ((p.y - area.low.y) / 0.045).fract();
        let relief = if rail {
            0.92 + 0.12 * smoothstep(0.0, 0.012, -d) - 0.16 * smoothstep(-0.045, -0.055, d)
        } else {
            0.62 + 0.40 * slat
        };
        let worn = 1.0 + 0.08 * noise(p * 14.0, ENDLESS, 5) + 0.05 * noise(vec2(p.x * 50.0, p.y * 4.0), ENDLESS, 6);
        (d, colour * relief * worn)
    });
}

/// Width of a bay and height of a ground floor, metres.
const BAY: f32 = 2.4;
const HEIGHT: f32 = 3.1;
/// What a strip of ground floor covers.
pub(in crate::scene::town) const STRIP: Vec2 = vec2(6.0 * BAY, HEIGHT);
/// The bays of a ground floor.
pub(in crate::scene::town) const DOOR: usize = 0;
pub(in crate::scene::town) const GROUND_WINDOWS: [usize; 2] = [1, 4];
pub(in crate::scene::town) const SHOP: usize = 2;
pub(in crate::scene::town) const ARCH: usize = 3;
pub(in crate::scene::town) const BARE: usize = 5;

/// What a ground floor is made of.
#[derive(Clone, Copy, PartialEq)]
enum Wall {
    Ashlar,
    Rubble,
    Plaster(Vec3),
}

/// Materials and colours of a ground floor.
pub(in crate::scene::town) struct GroundFloor {
    wall: Wall,
    stone: Vec3,
    door: Vec3,
    shutter: Vec3,
}

/// The ground floors of the town.
pub(in crate::scene::town) const GROUND_FLOORS: [GroundFloor; 4] = [
    GroundFloor {
        wall: Wall::Ashlar,
        stone: vec3(0.66, 0.55, 0.45),
        door: vec3(0.33, 0.21, 0.13),
        shutter: vec3(0.26, 0.36, 0.28),
    },
    GroundFloor {
        wall: Wall::Plaster(vec3(0.90, 0.85, 0.74)),
        stone: vec3(0.68, 0.58, 0.47),
        door: vec3(0.20, 0.32, 0.26),
        shutter: vec3(0.23, 0.37, 0.30),
    },
    GroundFloor {
        wall: Wall::Rubble,
        stone: vec3(0.62, 0.57, 0.50),
        door: vec3(0.40, 0.20, 0.14),
        shutter: vec3(0.36, 0.24, 0.17),
    },
    GroundFloor {
        wall: Wall::Plaster(vec3(0.84, 0.80, 0.75)),
        stone: vec3(0.55, 0.51, 0.47),
        door: vec3(0.22, 0.29, 0.40),
        shutter: vec3(0.45, 0.20, 0.16),
    },
];

/// Paints a ground floor: a strip of six bays, bare wall where they meet.
pub(in crate::scene::town) fn ground_floor(style: &GroundFloor, seed: u32) -> Canvas {
    let courses = ivec2(20, 9);
    let mut canvas = Canvas::new([2048, 512], STRIP, |p| {
        let base = match style.wall {
            Wall::Ashlar => ashlar_at(p, STRIP, courses, seed),
            Wall::Rubble => rubble_at(p, STRIP, seed),
            Wall::Plaster(colour) => {
                // Plaster comes off above the damp plinth.
                let edge = 0.55 + 0.10 * noise(p * vec2(2.5, 1.0), ivec2(36, 40), seed + 2);
                let plinth = ashlar_at(p, STRIP, courses, seed) * 0.92;
                let damp = 1.0 - 0.14 * smoothstep(1.3, 0.5, p.y + 0.3 * cloud(p * 2.0, ivec2(29, 40), 2, seed + 1));
                plinth.lerp(colour * plaster_at(p, STRIP, seed) * damp, smoothstep(edge - 0.01, edge + 0.01, p.y))
            }
        };
        base * (1.0 - 0.34 * smoothstep(0.35, 0.0, p.y)) * (1.0 - 0.42 * smoothstep(HEIGHT - 0.6, HEIGHT, p.y))
    });
    let paned = |opening: Area, arched: bool, shutter: Option<Vec3>, casements: u32, rows: u32| Window {
        opening,
        frame: vec3(0.88, 0.86, 0.80),
        surround: Some(style.stone),
        shutter,
        casements,
        rows,
        arched,
    };
    let middle = |bay: usize| (bay as f32 + 0.5) * BAY;
    let x = middle(DOOR);
    door(&mut canvas, Area::new(x - 0.52, 0.0, 1.04, 2.15), style, false, seed + 10);
    window(&mut canvas, &paned(Area::new(x - 0.45, 2.30, 0.90, 0.38), false, None, 3, 1), seed + 11);
    let x = middle(GROUND_WINDOWS[0]);
    window(&mut canvas, &paned(Area::new(x - 0.52, 1.05, 1.04, 1.35), false, Some(style.shutter), 2, 3), seed + 12);
    let x = middle(SHOP);
    window(&mut canvas, &paned(Area::new(x - 0.95, 0.75, 1.90, 1.75), false, None, 3, 2), seed + 13);
    let board = Area::new(x - 1.05, 2.60, 2.10, 0.30);
    canvas.halo(board, 0.05, 0.35);
    canvas.fill(board, |p| {
        let d = board.distance(p);
        let scroll = (p.x - x).abs() < 0.8
            && (p.y - 2.75).abs() < 0.05
            && noise(p * vec2(16.0, 12.0), ENDLESS, seed + 14) > -0.1;
        let gilt = if scroll { vec3(0.80, 0.66, 0.36) } else { style.door };
        (d, gilt * (0.8 + 0.2 * smoothstep(0.0, 0.03, -d)))
    });
    let x = middle(ARCH);
    door(&mut canvas, Area::new(x - 0.95, 0.0, 1.90, 2.55), style, true, seed + 15);
    let x = middle(GROUND_WINDOWS[1]);
    window(&mut canvas, &paned(Area::new(x - 0.48, 1.05, 0.96, 1.45), true, None, 2, 3), seed + 16);
    let x = middle(BARE);
    window(&mut canvas, &paned(Area::new(x - 0.27, 1.45, 0.54, 0.62), false, None, 2, 2), seed + 17);
    canvas
}

/// A door of boards and panels in a stone surround.
fn door(canvas: &mut Canvas, opening: Area, style: &GroundFloor, arched: bool, seed: u32) {
    let outline = |area: Area, p: Vec2| {
        if arched { area.arch_distance(p) } else { area.distance(p) }
    };
    let around = Area { low: opening.low - vec2(0.2, 0.0), high: opening.high + 0.2 };
    canvas.darken(around.grown(0.06), |p| 1.0 - 0.25 * smoothstep(0.06, 0.0, outline(around, p)));
    let courses = 0.42;
    canvas.fill(around, |p| {
        let d = outline(around, p);
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
        (d, style.stone * grit * mortar * foot * (0.84 + 0.16 * smoothstep(0.0, 0.03, -d)))
    });
    canvas.fill(opening, |p| (outline(opening, p), style.stone * 0.40));
    let leaf = Area { low: opening.low + vec2(0.04, 0.0), high: opening.high - 0.05 };
    let width = leaf.extent().x;
    canvas.fill(leaf, |p| {
        let d = outline(leaf, p);
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
        (d, style.door * relief * shade)
    });
    let handle = Area::new(leaf.high.x - if arched { width / 2.0 + 0.12 } else { 0.14 }, 1.02, 0.045, 0.14);
    canvas.fill(handle, |p| (handle.distance(p), vec3(0.62, 0.50, 0.28)));
}

/// What a church window covers.
pub(in crate::scene::town) const LANCET: Vec2 = vec2(1.6, 4.2);

/// A pointed church window with tracery; outside its outline there is nothing.
pub(in crate::scene::town) fn lancet(pixels: [usize; 2], size: Vec2, seed: u32) -> Canvas {
    let half = size.x / 2.0;
    let pointed = move |p: Vec2, inset: f32| {
        // Two circles about the opposite springers.
        let x = (p.x - half).abs();
        let radius = 2.0 * half;
        let spring = size.y - radius * 0.866;
        if p.y > spring { vec2(x + half, p.y - spring).length() - radius + inset } else { (x - half).max(-p.y) + inset }
    };
    let mut canvas = Canvas::new(pixels, size, |p| {
        let d = pointed(p, 0.0);
        let stone = ashlar_at(p, size, ivec2(2, 12), seed) * (0.8 + 0.2 * smoothstep(0.0, 0.03, -d));
        let inner = pointed(p, 0.2);
        let reveal = stone * if p.y > 0.4 * size.y { 0.55 } else { 0.68 };
        let q = p * 6.5;
        let diamond = vec2((q.x + q.y).fract() - 0.5, (q.x - q.y).fract() - 0.5).abs();
        let lead = smoothstep(0.42, 0.47, diamond.max_element());
        let pane = chance((q.x + q.y).floor() as i32, (q.x - q.y).floor() as i32, seed + 1);
        let hue = chance((q.x + q.y).floor() as i32, (q.x - q.y).floor() as i32, seed + 2);
        let tinted =
            vec3(0.22, 0.27, 0.33).lerp(vec3(0.33, 0.22, 0.24), smoothstep(0.79, 0.81, hue)) * (0.75 + 0.6 * pane);
        let glass = tinted.lerp(vec3(0.10, 0.10, 0.11), lead);
        let mullion = ((p.x - half).abs() - 0.06).min(((p.y - 0.45 * size.y).abs() - 0.05).max(-1.0));
        let eye = ((p - vec2(half, size.y - 1.05)).length() - 0.27).abs() - 0.05;
        let tracery = mullion.min(eye);
        let glass = glass * (0.65 + 0.35 * smoothstep(0.0, 0.2, -inner));
        let filled = glass.lerp(stone * 0.92, smoothstep(0.012, -0.012, tracery));
        stone.lerp(reveal, smoothstep(0.0, -0.01, pointed(p, 0.14))).lerp(filled, smoothstep(0.0, -0.01, inner))
    });
    canvas.keep(|p| pointed(p, 0.01));
    canvas
}

/// What the church's portal covers.
pub(in crate::scene::town) const PORTAL: Vec2 = vec2(3.6, 4.4);

/// A stepped round portal with a double door.
pub(in crate::scene::town) fn portal(pixels: [usize; 2], size: Vec2, seed: u32) -> Canvas {
    let opening = Area::new(0.8, 0.0, 2.0, 3.1);
    let mut canvas = Canvas::new(pixels, size, |p| {
        let wall = ashlar_at(p, size, ivec2(5, 12), seed);
        // Archivolts: rings of stone, each set back behind the one before.
        let d = opening.arch_distance(p);
        let ring = (d / 0.2).clamp(0.0, 3.0);
        let relief = 0.62 + 0.14 * ring.floor() + 0.16 * (ring.fract() * (1.0 - ring.fract()) * 4.0);
        if d < 0.6 { wall * relief.min(1.0) } else { wall }
    });
    let style = GroundFloor {
        wall: Wall::Ashlar,
        stone: vec3(0.62, 0.54, 0.44),
        door: vec3(0.36, 0.20, 0.13),
        shutter: Vec3::ZERO,
    };
    door(&mut canvas, opening.grown(-0.2), &style, true, seed + 1);
    canvas.darken(Area { low: Vec2::ZERO, high: vec2(size.x, 0.3) }, |p| 0.72 + 0.28 * smoothstep(0.0, 0.3, p.y));
    canvas
}

/// A clock face that fills a unit square: gilt hours on blue, hands at twenty to eleven.
pub(in crate::scene::town) fn clock(pixels: [usize; 2], size: Vec2, seed: u32) -> Canvas {
    let hand = |p: Vec2, turns: f32, length: f32, width: f32| {
        let c = circle(turns);
        let axis = vec2(c.y, c.x);
        let along = p.dot(axis);
        (p.perp_dot(axis).abs() - width * (1.0 - 0.6 * (along / length).clamp(0.0, 1.0)))
            .max(along - length)
            .max(-0.06 - along)
    };
    Canvas::new(pixels, size, |at| {
        let p = at - size / 2.0;
        let r = p.length();
        let gold = vec3(0.86, 0.68, 0.28) * (0.92 + 0.1 * noise(at * 60.0, ENDLESS, seed));
        let mut colour = vec3(0.12, 0.17, 0.33) * (0.95 + 0.08 * cloud(at * 8.0, ENDLESS, 2, seed + 1));
        let mut put = |d: f32| colour = colour.lerp(gold, smoothstep(0.003, -0.003, d));
        put((r - 0.465).abs() - 0.02);
        put((r - 0.30).abs() - 0.006);
        for hour in 0..12 {
            let c = circle(hour as f32 / 12.0);
            let axis = vec2(c.y, c.x);
            let along = p.dot(axis);
            put((p.perp_dot(axis).abs() - if hour % 3 == 0 { 0.022 } else { 0.013 }).max((along - 0.375).abs() - 0.05));
        }
        put(hand(p, 10.667 / 12.0, 0.25, 0.024));
        put(hand(p, 40.0 / 60.0, 0.38, 0.018));
        put(r - 0.035);
        colour
    })
}

/// Striped cloth, four kinds above one another, two stripes of each per metre.
pub(in crate::scene::town) fn awning(pixels: [usize; 2], size: Vec2, seed: u32) -> Canvas {
    const STRIPES: [Vec3; 4] =
        [vec3(0.66, 0.17, 0.14), vec3(0.20, 0.40, 0.27), vec3(0.22, 0.33, 0.55), vec3(0.80, 0.58, 0.20)];
    Canvas::new(pixels, size, |p| {
        let along = (p.x * 2.0).fract();
        let stripe = smoothstep(-0.01, 0.01, 0.25 - (along - 0.5).abs());
        let kind = ((size.y - p.y) / size.y * 4.0) as usize % 4;
        let weave = 1.0 + 0.05 * noise(p * 90.0, ivec2(90, 90), seed) + 0.08 * cloud(p * 4.0, ivec2(4, 4), 3, seed + 1);
        vec3(0.90, 0.87, 0.80).lerp(STRIPES[kind], stripe) * weave
    })
}

/// Guild signs, four by four in a unit square.
pub(in crate::scene::town) fn signs(pixels: [usize; 2], size: Vec2, seed: u32) -> Canvas {
    const GROUNDS: [Vec3; 4] =
        [vec3(0.14, 0.26, 0.19), vec3(0.42, 0.12, 0.10), vec3(0.13, 0.19, 0.36), vec3(0.86, 0.80, 0.66)];
    Canvas::with_opacity(pixels, size, |at| -> Vec4 {
        let cell = (at / size * 4.0).floor().as_ivec2();
        let p = (at / size * 4.0).fract() * 2.0 - 1.0;
        let kind = (cell.x + 4 * cell.y).rem_euclid(8);
        let ground = GROUNDS[((cell.x + 3 * cell.y).rem_euclid(4)) as usize];
        let ink = if ground.x > 0.6 { vec3(0.25, 0.14, 0.08) } else { vec3(0.88, 0.70, 0.32) };
        let worn = 1.0 + 0.07 * noise(at * 50.0, ENDLESS, seed) + 0.08 * cloud(at * 9.0, ENDLESS, 2, seed + 1);
        let border = p.abs().max_element();
        let mut colour = ground.lerp(ink, smoothstep(0.84, 0.86, border) * smoothstep(0.93, 0.91, border));
        colour = colour.lerp(ink, smoothstep(0.02, -0.02, emblem(p, kind)));
        (colour * worn).extend(1.0)
    })
}

/// Signed distance from the outline of an emblem in −1…1.
fn emblem(p: Vec2, kind: i32) -> f32 {
    let disc = |x: f32, y: f32, r: f32| (p - vec2(x, y)).length() - r;
    let bar = |x: f32, y: f32, w: f32, h: f32| Area::new(x - w / 2.0, y - h / 2.0, w, h).distance(p);
    match kind {
        // A pretzel.
        0 => {
            let loops =
                (disc(-0.26, 0.08, 0.30).abs().min(disc(0.26, 0.08, 0.30).abs())).min(disc(0.0, -0.2, 0.34).abs());
            loops - 0.075
        }
        // A key.
        1 => (disc(0.0, 0.40, 0.20).abs() - 0.07)
            .min(bar(0.0, -0.15, 0.11, 0.80))
            .min(bar(0.13, -0.46, 0.22, 0.1))
            .min(bar(0.11, -0.28, 0.18, 0.1)),
        // A boot.
        2 => bar(-0.12, 0.16, 0.34, 0.80).min(bar(0.08, -0.38, 0.74, 0.26)).min(disc(0.40, -0.36, 0.15)),
        // A bunch of grapes.
        3 => {
            let mut d = bar(0.0, 0.52, 0.07, 0.24);
            for row in 0..4 {
                for k in 0..(4 - row) {
                    d = d.min(disc((k as f32 - (3 - row) as f32 / 2.0) * 0.27, 0.28 - 0.24 * row as f32, 0.125));
                }
            }
            d
        }
        // A mug.
        4 => bar(-0.08, -0.05, 0.62, 0.84).min((disc(0.30, -0.04, 0.24).abs() - 0.06).max(0.2 - p.x)),
        // An anvil.
        5 => bar(0.0, 0.28, 1.0, 0.22).min(bar(0.0, 0.0, 0.34, 0.5)).min(bar(0.0, -0.36, 0.74, 0.2)),
        // Shears.
        6 => {
            let blade = |s: f32| {
                let axis = vec2(0.35 * s, 0.94);
                (p.perp_dot(axis).abs() - 0.06).max(p.dot(axis).abs() - 0.6)
            };
            blade(1.0)
                .min(blade(-1.0))
                .min(disc(0.26, -0.5, 0.17).abs() - 0.06)
                .min(disc(-0.26, -0.5, 0.17).abs() - 0.06)
        }
        // A star.
        _ => {
            let mut d = 9.0_f32;
            for k in 0..3 {
                let c = circle(k as f32 / 6.0);
                d = d.min((p.dot(c).abs() - 0.6).max(p.perp_dot(c).abs() - 0.14));
            }
            d
        }
    }
}
