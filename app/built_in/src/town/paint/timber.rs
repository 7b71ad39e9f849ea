//! Storeys of house fronts: half-timber with its braces and windows, and plain plaster with shutters.
//!
//! A picture is a strip of six bays that repeats sideways. Every bay begins and ends in the middle of a post (or in
//! bare plaster), so that a front may be assembled from any bays in any order.

use glam::{Vec2, Vec3, vec2, vec3};

use super::masonry::plaster_at;
use super::openings::{PaintedWindow, window};
use crate::town::canvas::{Area, ENDLESS, PaintCanvas, chance, noise, smoothstep};

/// Number of bays in a strip.
pub(in crate::town) const BAYS: usize = 6;
/// Width of a bay and height of a storey, metres.
const BAY: f32 = 2.4;
const HEIGHT: f32 = 2.7;
/// Size of a strip, metres.
pub(in crate::town) const STRIP: Vec2 = vec2(BAY * BAYS as f32, HEIGHT);
/// Indices of bays with a window, and of bays without.
pub(in crate::town) const WINDOWS: [usize; 4] = [0, 1, 3, 4];
pub(in crate::town) const BLIND: [usize; 2] = [2, 5];

/// Colours and style of a front.
pub(in crate::town) struct Front {
    plaster: Vec3,
    /// Colour of the timber; `None` for a front that is plastered all over.
    timber: Option<Vec3>,
    frame: Vec3,
    shutter: Option<Vec3>,
    /// Number that selects the kind of braces.
    manner: u32,
}

const OAK: Vec3 = vec3(0.30, 0.20, 0.14);
const DARK: Vec3 = vec3(0.22, 0.16, 0.13);
const RED: Vec3 = vec3(0.47, 0.17, 0.13);
const GREY: Vec3 = vec3(0.40, 0.36, 0.33);
const WHITE: Vec3 = vec3(0.90, 0.88, 0.83);

/// Number of fronts that houses choose from; the town hall's comes after them.
pub(in crate::town) const HOUSE_FRONTS: usize = 8;
pub(in crate::town) const TOWN_HALL: usize = 8;
/// Width of a window with its frame in the second bay, and the heights of its lower and upper edge, metres.
pub(in crate::town) const WINDOW_OUTLINE: [f32; 3] = [1.34, 0.83, 2.32];

/// Fronts of the town.
pub(in crate::town) const FRONTS: [Front; 9] = [
    Front {
        plaster: vec3(0.91, 0.86, 0.74),
        timber: Some(OAK),
        frame: WHITE,
        shutter: Some(vec3(0.25, 0.38, 0.28)),
        manner: 0,
    },
    Front {
        plaster: vec3(0.92, 0.90, 0.85),
        timber: Some(RED),
        frame: WHITE,
        shutter: Some(vec3(0.46, 0.19, 0.15)),
        manner: 1,
    },
    Front {
        plaster: vec3(0.86, 0.69, 0.42),
        timber: Some(DARK),
        frame: WHITE,
        shutter: Some(vec3(0.35, 0.22, 0.15)),
        manner: 2,
    },
    Front {
        plaster: vec3(0.86, 0.66, 0.58),
        timber: Some(GREY),
        frame: WHITE,
        shutter: Some(vec3(0.42, 0.46, 0.48)),
        manner: 0,
    },
    Front {
        plaster: vec3(0.76, 0.82, 0.68),
        timber: Some(DARK),
        frame: WHITE,
        shutter: Some(vec3(0.22, 0.33, 0.24)),
        manner: 1,
    },
    Front {
        plaster: vec3(0.72, 0.80, 0.86),
        timber: Some(OAK),
        frame: WHITE,
        shutter: Some(vec3(0.24, 0.34, 0.46)),
        manner: 2,
    },
    Front {
        plaster: vec3(0.93, 0.88, 0.76),
        timber: None,
        frame: WHITE,
        shutter: Some(vec3(0.25, 0.42, 0.33)),
        manner: 0,
    },
    Front {
        plaster: vec3(0.92, 0.79, 0.55),
        timber: None,
        frame: WHITE,
        shutter: Some(vec3(0.45, 0.22, 0.17)),
        manner: 1,
    },
    Front { plaster: vec3(0.66, 0.34, 0.27), timber: None, frame: WHITE, shutter: None, manner: 2 },
];

impl Front {
    /// Colour of the plaster (sRGB), for walls that have no picture of their own.
    pub(in crate::town) fn plaster(&self) -> Vec3 {
        self.plaster
    }

    /// True if the front shows timber.
    pub(in crate::town) fn is_timbered(&self) -> bool {
        self.timber.is_some()
    }
}

/// Piece of timber.
#[derive(Clone, Copy)]
pub(super) struct Beam {
    from: Vec2,
    to: Vec2,
    width: f32,
    /// Distance by which its middle bends to the left of the way from `from` to `to`, metres.
    bow: f32,
}

pub(super) const fn beam(x0: f32, y0: f32, x1: f32, y1: f32, width: f32) -> Beam {
    Beam { from: vec2(x0, y0), to: vec2(x1, y1), width, bow: 0.0 }
}

impl Beam {
    fn bowed(self, bow: f32) -> Self {
        Self { bow, ..self }
    }

    fn moved(self, x: f32) -> Self {
        Self { from: self.from + vec2(x, 0.0), to: self.to + vec2(x, 0.0), ..self }
    }

    fn area(&self) -> Area {
        Area { low: self.from.min(self.to), high: self.from.max(self.to) }.grown(self.width + self.bow.abs())
    }

    /// Signed distance of a point from its outline, and the point's place along and across it, metres.
    fn locate(&self, p: Vec2) -> (f32, Vec2) {
        let axis = self.to - self.from;
        let length = axis.length();
        let along = (p - self.from).dot(axis) / length;
        let s = (along / length).clamp(0.0, 1.0);
        let across = (p - self.from).perp_dot(axis) / length + 4.0 * self.bow * s * (1.0 - s);
        let beyond = (-along).max(along - length);
        ((across.abs() - self.width / 2.0).max(beyond), vec2(along, across))
    }
}

/// Paints beams onto a wall: first their shade, then the wood.
pub(super) fn join(canvas: &mut PaintCanvas, beams: &[Beam], colour: Vec3, seed: u32) {
    for beam in beams {
        canvas.darken(beam.area().grown(0.06), |p| {
            let (distance, _) = beam.locate(p);
            1.0 - 0.20 * smoothstep(0.06, 0.0, distance)
        });
    }
    for (number, beam) in beams.iter().enumerate() {
        let number = number as i32;
        let own = 0.88 + 0.22 * chance(number, 1, seed);
        let wobbly = |p: Vec2| {
            let distance = beam.locate(p).0;
            // Far outside the outline nothing is painted, however the edge wobbles.
            if distance > 0.1 { distance } else { distance + 0.008 * noise(p * 3.0, ENDLESS, seed + 2) }
        };
        canvas.fill(beam.area(), wobbly, |p, distance| {
            let (_, place) = beam.locate(p);
            let start = number as f32 * 17.0;
            let grain = noise(vec2(place.x * 2.2 + start, place.y * 45.0), ENDLESS, seed)
                + 0.6 * noise(vec2(place.x * 6.0, place.y * 110.0), ENDLESS, seed + 1);
            let crack = smoothstep(0.55, 0.8, noise(vec2(place.x * 1.3 + start, place.y * 32.0), ENDLESS, seed + 4));
            let edge = 0.72 + 0.28 * smoothstep(0.0, 0.02, -distance);
            colour * own * (1.0 + 0.15 * grain) * (1.0 - 0.4 * crack) * edge
        });
    }
}

/// Paints one storey of a house front.
pub(in crate::town) fn front(style: &Front, seed: u32) -> PaintCanvas {
    let mut canvas = PaintCanvas::new([2048, 512], STRIP, |p| {
        let damp = 1.0 - 0.10 * smoothstep(HEIGHT - 0.5, HEIGHT, p.y);
        style.plaster * plaster_at(p, STRIP, seed) * damp
    });
    for bay in 0..BAYS {
        let left = bay as f32 * BAY;
        match style.timber {
            Some(timber) => {
                let beams: Vec<Beam> =
                    braces(bay, style.manner).into_iter().chain(skeleton(bay)).map(|beam| beam.moved(left)).collect();
                join(&mut canvas, &beams, timber, seed + bay as u32);
            }
            None => cornice(&mut canvas, left, style.plaster),
        }
        if WINDOWS.contains(&bay) {
            windows(&mut canvas, style, bay, left, seed + bay as u32);
        }
    }
    // The overhang above keeps light and rain away from the upper edge; the lower edge is soiled.
    let whole = Area { low: Vec2::ZERO, high: STRIP };
    canvas.darken(whole, |p| {
        (1.0 - 0.38 * smoothstep(HEIGHT - 0.55, HEIGHT, p.y)) * (1.0 - 0.10 * smoothstep(0.25, 0.0, p.y))
    });
    canvas
}

/// Heights of the rail under the windows and of the one above, metres.
const SILL: f32 = 0.92;
const HEAD: f32 = 2.22;

/// Sill, plate, posts and rails of a bay.
fn skeleton(bay: usize) -> Vec<Beam> {
    let mut beams = vec![];
    if WINDOWS.contains(&bay) {
        let half = if bay == 4 { 0.86 } else { 0.60 };
        for x in [BAY / 2.0 - half - 0.08, BAY / 2.0 + half + 0.08] {
            beams.push(beam(x, 0.1, x, HEIGHT - 0.1, 0.15));
        }
        beams.push(beam(0.0, SILL - 0.07, BAY, SILL - 0.07, 0.15));
        beams.push(beam(0.0, HEAD + 0.07, BAY, HEAD + 0.07, 0.14));
    } else {
        beams.push(beam(0.0, 1.35, BAY, 1.35, 0.14));
    }
    beams.push(beam(0.0, 0.0, 0.0, HEIGHT, 0.20));
    beams.push(beam(BAY, 0.0, BAY, HEIGHT, 0.20));
    beams.push(beam(0.0, 0.11, BAY, 0.11, 0.22));
    beams.push(beam(0.0, HEIGHT - 0.09, BAY, HEIGHT - 0.09, 0.20));
    beams
}

/// Braces of a bay.
fn braces(bay: usize, manner: u32) -> Vec<Beam> {
    let (low, rail) = (0.2, SILL - 0.1);
    let (left, right) = (BAY / 2.0 - 0.62, BAY / 2.0 + 0.62);
    let outer = [beam(0.05, low, 0.50, HEIGHT - 0.2, 0.13), beam(BAY - 0.05, low, BAY - 0.50, HEIGHT - 0.2, 0.13)];
    match (bay, manner) {
        // Saint Andrew's crosses below the windows.
        (0, 0) | (3, 1) => vec![beam(left, low, right, rail, 0.12), beam(left, rail, right, low, 0.12)],
        // Bowed crosses.
        (0, 1) | (3, 0) => {
            vec![beam(left, low, right, rail, 0.12).bowed(0.12), beam(left, rail, right, low, 0.12).bowed(0.12)]
        }
        // A lozenge.
        (0, 2) | (1, 2) => {
            let (x, y) = (BAY / 2.0, (low + rail) / 2.0);
            vec![
                beam(left, y, x, rail, 0.10),
                beam(x, rail, right, y, 0.10),
                beam(right, y, x, low, 0.10),
                beam(x, low, left, y, 0.10),
            ]
        }
        // Leaning struts at the sides.
        (1, 0) | (3, 2) => outer.to_vec(),
        (1, _) => vec![
            beam(left, low, BAY / 2.0, rail, 0.12).bowed(0.10),
            beam(right, low, BAY / 2.0, rail, 0.12).bowed(-0.10),
        ],
        // Wild man: long struts from the foot of a post and short ones to its head.
        (2, 0) | (5, 1) => vec![
            beam(BAY / 2.0, 0.1, BAY / 2.0, HEIGHT - 0.1, 0.18),
            beam(0.25, low, BAY / 2.0, 1.9, 0.14).bowed(0.08),
            beam(BAY - 0.25, low, BAY / 2.0, 1.9, 0.14).bowed(-0.08),
            beam(BAY / 2.0, 1.75, 0.55, HEIGHT - 0.2, 0.13),
            beam(BAY / 2.0, 1.75, BAY - 0.55, HEIGHT - 0.2, 0.13),
        ],
        // A great cross through the storey.
        (2, 1) | (5, 2) => vec![
            beam(0.1, low, BAY - 0.1, HEIGHT - 0.2, 0.14).bowed(0.14),
            beam(0.1, HEIGHT - 0.2, BAY - 0.1, low, 0.14).bowed(0.14),
            beam(BAY / 2.0, 0.1, BAY / 2.0, 1.3, 0.14),
        ],
        // Struts to both sides of a middle post.
        (2, 2) | (5, 0) => vec![
            beam(BAY / 2.0, 0.1, BAY / 2.0, HEIGHT - 0.1, 0.17),
            beam(0.08, HEIGHT - 0.2, BAY / 2.0 - 0.1, low, 0.14),
            beam(BAY - 0.08, HEIGHT - 0.2, BAY / 2.0 + 0.1, low, 0.14),
        ],
        _ => vec![
            beam(BAY / 2.0 - 0.4, low, BAY / 2.0 - 0.4, rail, 0.11),
            beam(BAY / 2.0 + 0.4, low, BAY / 2.0 + 0.4, rail, 0.11),
        ],
    }
}

/// Paints a moulding at the lower edge of a plastered storey.
fn cornice(canvas: &mut PaintCanvas, left: f32, plaster: Vec3) {
    let band = Area::new(left, 0.0, BAY, 0.16);
    canvas.darken(band.grown(0.05), |p| 1.0 - 0.22 * smoothstep(0.05, 0.0, band.distance(p)));
    canvas.fill(
        band,
        |p| band.distance(p),
        |p, _| {
            let relief = 0.88 + 0.14 * smoothstep(0.02, 0.13, p.y) - 0.1 * smoothstep(0.13, 0.16, p.y);
            plaster.lerp(WHITE, 0.5) * relief
        },
    );
}

/// Paints the windows of a bay.
fn windows(canvas: &mut PaintCanvas, style: &Front, bay: usize, left: f32, seed: u32) {
    let centre = left + BAY / 2.0;
    let plastered = style.timber.is_none();
    let kind = |x: f32, width: f32, shutter: Option<Vec3>| PaintedWindow {
        opening: Area::new(x - width / 2.0, SILL, width, HEAD - SILL),
        frame: style.frame,
        surround: plastered.then_some(vec3(0.70, 0.62, 0.52)),
        shutter,
        casements: 2,
        rows: 3,
        arched: false,
    };
    if bay == 4 && !plastered {
        window(canvas, &kind(centre - 0.43, 0.80, None), seed);
        window(canvas, &kind(centre + 0.43, 0.80, None), seed + 1);
    } else {
        let shutter = (plastered || bay != 1).then_some(style.shutter).flatten();
        window(canvas, &kind(centre, if plastered { 1.0 } else { 1.12 }, shutter), seed);
    }
}
