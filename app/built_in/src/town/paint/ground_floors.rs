//! Ground floors: strips of six bays with doors, windows, shops and gateways in walls of stone, plaster or timber.

use glam::{Vec2, Vec3, ivec2, vec2, vec3};

use super::masonry::{ashlar_at, plaster_at, rubble_at};
use super::openings::{Door, PaintedWindow, door, window};
use super::timber::{beam, join};
use crate::town::canvas::{Area, PaintCanvas, chance, cloud, noise, smoothstep};

/// Width of a bay and height of a ground floor, metres.
const BAY: f32 = 2.4;
const HEIGHT: f32 = 3.1;
/// Size of a strip of ground floor, metres.
pub(in crate::town) const STRIP: Vec2 = vec2(6.0 * BAY, HEIGHT);
/// Indices of the bays of a ground floor.
pub(in crate::town) const DOOR: usize = 0;
pub(in crate::town) const GROUND_WINDOWS: [usize; 2] = [1, 4];
pub(in crate::town) const SHOP: usize = 2;
pub(in crate::town) const ARCH: usize = 3;
pub(in crate::town) const BARE: usize = 5;

/// Material of a ground floor's wall.
#[derive(Clone, Copy, PartialEq)]
enum GroundFloorWall {
    Ashlar,
    Rubble,
    Plaster(Vec3),
    /// Plaster between posts and beams.
    Timbered(Vec3),
}

/// Materials and colours of a ground floor.
pub(in crate::town) struct GroundFloor {
    wall: GroundFloorWall,
    stone: Vec3,
    door: Vec3,
    shutter: Vec3,
}

/// Ground floors of the town.
pub(in crate::town) const GROUND_FLOORS: [GroundFloor; 5] = [
    GroundFloor {
        wall: GroundFloorWall::Ashlar,
        stone: vec3(0.66, 0.55, 0.45),
        door: vec3(0.33, 0.21, 0.13),
        shutter: vec3(0.26, 0.36, 0.28),
    },
    GroundFloor {
        wall: GroundFloorWall::Plaster(vec3(0.90, 0.85, 0.74)),
        stone: vec3(0.68, 0.58, 0.47),
        door: vec3(0.20, 0.32, 0.26),
        shutter: vec3(0.23, 0.37, 0.30),
    },
    GroundFloor {
        wall: GroundFloorWall::Rubble,
        stone: vec3(0.62, 0.57, 0.50),
        door: vec3(0.40, 0.20, 0.14),
        shutter: vec3(0.36, 0.24, 0.17),
    },
    GroundFloor {
        wall: GroundFloorWall::Plaster(vec3(0.84, 0.80, 0.75)),
        stone: vec3(0.55, 0.51, 0.47),
        door: vec3(0.22, 0.29, 0.40),
        shutter: vec3(0.45, 0.20, 0.16),
    },
    GroundFloor {
        wall: GroundFloorWall::Timbered(vec3(0.88, 0.80, 0.64)),
        stone: vec3(0.34, 0.23, 0.16),
        door: vec3(0.44, 0.27, 0.14),
        shutter: vec3(0.30, 0.22, 0.16),
    },
];

/// Paints a ground floor: a strip of six bays, with bare wall where they meet.
pub(in crate::town) fn ground_floor(style: &GroundFloor, seed: u32) -> PaintCanvas {
    let courses = ivec2(20, 9);
    let mut canvas = PaintCanvas::new([2048, 512], STRIP, |p| {
        let base = match style.wall {
            GroundFloorWall::Ashlar => ashlar_at(p, STRIP, courses, seed),
            GroundFloorWall::Rubble => rubble_at(p, STRIP, seed),
            GroundFloorWall::Plaster(colour) | GroundFloorWall::Timbered(colour) => {
                // Plaster flakes off above the damp plinth.
                let edge = 0.55 + 0.10 * noise(p * vec2(2.5, 1.0), ivec2(36, 40), seed + 2);
                let plinth = ashlar_at(p, STRIP, courses, seed) * 0.92;
                let damp = 1.0 - 0.14 * smoothstep(1.3, 0.5, p.y + 0.3 * cloud(p * 2.0, ivec2(29, 40), 2, seed + 1));
                plinth.lerp(colour * plaster_at(p, STRIP, seed) * damp, smoothstep(edge - 0.01, edge + 0.01, p.y))
            }
        };
        base * (1.0 - 0.34 * smoothstep(0.35, 0.0, p.y)) * (1.0 - 0.42 * smoothstep(HEIGHT - 0.6, HEIGHT, p.y))
    });
    if let GroundFloorWall::Timbered(_) = style.wall {
        for bay in 0..6 {
            frame_bay(&mut canvas, bay, style.stone, seed + 20 + bay as u32);
        }
    }
    let paned = |opening: Area, arched: bool, shutter: Option<Vec3>, casements: u32, rows: u32| PaintedWindow {
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
    let leaves = |opening: Area, arched: bool| Door { opening, stone: style.stone, colour: style.door, arched };
    door(&mut canvas, &leaves(Area::new(x - 0.52, 0.0, 1.04, 2.15), false), seed + 10);
    window(&mut canvas, &paned(Area::new(x - 0.45, 2.30, 0.90, 0.38), false, None, 3, 1), seed + 11);
    let x = middle(GROUND_WINDOWS[0]);
    window(&mut canvas, &paned(Area::new(x - 0.52, 1.05, 1.04, 1.35), false, Some(style.shutter), 2, 3), seed + 12);
    let x = middle(SHOP);
    window(&mut canvas, &paned(Area::new(x - 0.95, 0.75, 1.90, 1.75), false, None, 3, 2), seed + 13);
    let board = Area::new(x - 1.05, 2.60, 2.10, 0.30);
    canvas.halo(board, 0.05, 0.35);
    canvas.fill(
        board,
        |p| board.distance(p),
        |p, d| {
            let inscribed = (p.x - x).abs() < 0.8 && lettering(vec2((p.x - x) / 0.115, (p.y - 2.69) / 0.13), seed + 14);
            let paint = if inscribed { vec3(0.80, 0.66, 0.36) } else { style.door };
            paint * (0.8 + 0.2 * smoothstep(0.0, 0.03, -d))
        },
    );
    let x = middle(ARCH);
    door(&mut canvas, &leaves(Area::new(x - 0.95, 0.0, 1.90, 2.55), true), seed + 15);
    let x = middle(GROUND_WINDOWS[1]);
    window(&mut canvas, &paned(Area::new(x - 0.48, 1.05, 0.96, 1.45), true, None, 2, 3), seed + 16);
    let x = middle(BARE);
    window(&mut canvas, &paned(Area::new(x - 0.27, 1.45, 0.54, 0.62), false, None, 2, 2), seed + 17);
    canvas
}

/// Paints posts and beams of a timbered ground floor, clear of doors and windows.
fn frame_bay(canvas: &mut PaintCanvas, bay: usize, timber: Vec3, seed: u32) {
    let left = bay as f32 * BAY;
    let mut beams = vec![
        beam(left, 0.5, left, HEIGHT, 0.22),
        beam(left + BAY, 0.5, left + BAY, HEIGHT, 0.22),
        beam(left, HEIGHT - 0.12, left + BAY, HEIGHT - 0.12, 0.24),
    ];
    if bay == BARE {
        beams.push(beam(left + 0.1, 0.6, left + 0.75, HEIGHT - 0.25, 0.14));
        beams.push(beam(left + BAY - 0.1, 0.6, left + BAY - 0.75, HEIGHT - 0.25, 0.14));
    }
    if bay == BARE || GROUND_WINDOWS.contains(&bay) {
        beams.push(beam(left, 0.62, left + BAY, 0.62, 0.22));
    }
    join(canvas, &beams, timber, seed);
}

/// True if a point lies on a stroke of an unreadable inscription in letters of unit height.
fn lettering(p: Vec2, seed: u32) -> bool {
    let letter = p.x.floor() as i32;
    let q = vec2(p.x - p.x.floor(), p.y);
    let has = |stroke: i32| chance(letter, stroke, seed) < 0.55;
    if !(0.0..1.0).contains(&q.y) || q.x > 0.78 || chance(letter, 9, seed) < 0.12 {
        return false;
    }
    let foot = q.y < 0.16;
    let top = q.y > 0.84;
    let middle = (q.y - 0.5).abs() < 0.08;
    q.x < 0.2 || (q.x > 0.58 && has(1)) || (top && has(2)) || (foot && has(3)) || (middle && has(4))
}
