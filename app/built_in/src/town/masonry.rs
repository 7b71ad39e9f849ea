//! Masonry that several buildings share: walls with arched openings, panels, round faces, stepped gables.

use glam::{Vec3, vec2, vec3};

use super::builder::{Builder, MeshCorner, SiteFrame, Tint};
use super::paint::timber;
use super::surface::TownSurface;
use crate::clock::ClockFace;
use crate::turn::circle;
use scene::LocalName;

/// Number of pieces of a half circle in an arch.
const VOUSSOIRS: u32 = 8;

/// Wall with one round-arched passage through it.
pub(super) struct Arch {
    /// Left and right ends and height of the wall, metres.
    pub(super) wall: [f32; 2],
    pub(super) top: f32,
    /// Middle, half width and springing height of the opening, metres.
    pub(super) middle: f32,
    pub(super) half: f32,
    pub(super) spring: f32,
    /// Depth of the passage behind the wall's face, metres.
    pub(super) depth: f32,
}

impl Arch {
    /// Points of the opening's edge from the right springer over the crown to the left one.
    fn crown(&self) -> Vec<(f32, f32)> {
        let point = |k: u32| {
            let c = circle(k as f32 / (2 * VOUSSOIRS) as f32);
            (self.middle + self.half * c.x, self.spring + self.half * c.y)
        };
        (0..=VOUSSOIRS).map(point).collect()
    }

    /// Builds the face of the wall, in the plane of `frame`.
    pub(super) fn face(&self, builder: &mut Builder, surface: TownSurface, tint: Tint, frame: &SiteFrame) {
        let p = |x: f32, y: f32| frame.point(x, y, 0.0);
        let [left, right] = self.wall;
        let (l, r) = (self.middle - self.half, self.middle + self.half);
        for [a, b] in [[left, l], [r, right]] {
            if b > a {
                let corners = [
                    (p(a, self.spring), 1.0),
                    (p(a, 0.0), 0.7),
                    (p(b, 0.0), 0.7),
                    (p(b, self.spring), 1.0),
                    (p(b, self.top), 1.0),
                    (p(a, self.top), 1.0),
                ];
                builder.lit(surface, tint, &corners);
            }
        }
        for pair in self.crown().windows(2) {
            let ((x0, y0), (x1, y1)) = (pair[0], pair[1]);
            builder.metric(surface, tint, &[p(x1, y1), p(x0, y0), p(x0, self.top), p(x1, self.top)]);
        }
    }

    /// Builds jambs and vault of the passage.
    pub(super) fn vault(&self, builder: &mut Builder, surface: TownSurface, tint: Tint, frame: &SiteFrame) {
        let p = |x: f32, y: f32, z: f32| frame.point(x, y, z);
        let (l, r) = (self.middle - self.half, self.middle + self.half);
        let d = -self.depth;
        let jamb = |builder: &mut Builder, corners: [Vec3; 4]| {
            builder.lit(surface, tint, &[(corners[0], 0.6), (corners[1], 0.6), (corners[2], 0.8), (corners[3], 0.8)]);
        };
        jamb(builder, [p(l, 0.0, 0.0), p(l, 0.0, d), p(l, self.spring, d), p(l, self.spring, 0.0)]);
        jamb(builder, [p(r, 0.0, d), p(r, 0.0, 0.0), p(r, self.spring, 0.0), p(r, self.spring, d)]);
        for pair in self.crown().windows(2) {
            let ((x0, y0), (x1, y1)) = (pair[0], pair[1]);
            let corners = [p(x0, y0, 0.0), p(x1, y1, 0.0), p(x1, y1, d), p(x0, y0, d)];
            builder.lit(surface, tint * 0.8, &corners.map(|corner| (corner, 0.8)));
        }
    }
}

/// Builds an upright rectangle that shows a whole picture; its lower left corner is at (x, y) in the frame.
pub(super) fn panel(
    builder: &mut Builder,
    surface: TownSurface,
    frame: &SiteFrame,
    [x, y]: [f32; 2],
    [width, height]: [f32; 2],
) {
    let corner = |u: f32, v: f32| MeshCorner::new(frame.point(x + u * width, y + v * height, 0.0), vec2(u, 1.0 - v));
    builder.face(surface, Vec3::ONE, &[corner(0.0, 0.0), corner(1.0, 0.0), corner(1.0, 1.0), corner(0.0, 1.0)]);
}

/// Builds the window of a house front without the wall about it, its lower left corner at (x, y) in the frame.
pub(super) fn window_panel(
    builder: &mut Builder,
    front: usize,
    frame: &SiteFrame,
    [x, y]: [f32; 2],
    [width, height]: [f32; 2],
) {
    let bay = timber::WINDOWS[1] as f32 + 0.5;
    let [w, low, high] = timber::WINDOW_OUTLINE;
    let corner = |s: f32, t: f32| {
        let u = (bay + (s - 0.5) * w / timber::STRIP.x * timber::BAYS as f32) / timber::BAYS as f32;
        let v = 1.0 - (low + t * (high - low)) / timber::STRIP.y;
        MeshCorner::new(frame.point(x + s * width, y + t * height, 0.0), vec2(u, v))
    };
    builder.face(
        TownSurface::Front(front),
        Vec3::ONE,
        &[corner(0.0, 0.0), corner(1.0, 0.0), corner(1.0, 1.0), corner(0.0, 1.0)],
    );
}

/// Builds a round face about the frame's origin that shows its whole picture.
fn disc(builder: &mut Builder, surface: TownSurface, frame: &SiteFrame, radius: f32) {
    let corners: Vec<MeshCorner> = (0..16)
        .map(|k| {
            let c = circle(k as f32 / 16.0);
            MeshCorner::new(frame.point(radius * c.x, radius * c.y, 0.0), vec2(0.5 + 0.49 * c.x, 0.5 - 0.49 * c.y))
        })
        .collect();
    builder.face(surface, Vec3::ONE, &corners);
}

/// Builds the dial of a clock, for hands to turn before it. `frame` lies in its middle.
pub(super) fn clock(builder: &mut Builder, name: LocalName, frame: &SiteFrame, radius: f32) {
    disc(builder, TownSurface::Clock, frame, radius);
    let SiteFrame { origin: centre, right, out, .. } = *frame;
    builder.clocks.push(ClockFace { name, centre, right, out, radius, motion: None });
}

/// Builds a gable wall in steps about x = 0, from `half` its width at the foot to its top, each step capped with
/// stone.
pub(super) fn stepped_gable(
    builder: &mut Builder,
    surface: TownSurface,
    tint: Tint,
    frame: &SiteFrame,
    half: f32,
    height: f32,
    steps: u32,
) {
    let tread = half / (steps as f32 + 0.6);
    let rise = height / steps as f32;
    for k in 0..steps {
        let x = half - tread * k as f32;
        let (low, high) = (rise * k as f32, rise * (k + 1) as f32);
        builder.block(surface, tint, frame, vec3(-x, low, -0.45), vec3(x, high, 0.0));
        for side in [-1.0_f32, 1.0] {
            let [a, b] = [side * x, side * (x - tread)];
            let (low_x, high_x) = (a.min(b) - 0.06, a.max(b) + 0.06);
            builder.beam(
                TownSurface::Ashlar,
                Vec3::ONE,
                frame,
                vec3(low_x, high, -0.52),
                vec3(high_x, high + 0.14, 0.07),
            );
        }
    }
}

/// Builds a wall round a regular polygon with an inside, from `low` to `high`, and its rim.
pub(super) fn basin(
    builder: &mut Builder,
    surface: TownSurface,
    frame: &SiteFrame,
    sides: u32,
    [outer, inner]: [f32; 2],
    [low, high]: [f32; 2],
) {
    let at = |k: u32, radius: f32, y: f32| {
        let c = circle((k as f32 + 0.5) / sides as f32);
        frame.point(c.y * radius, y, c.x * radius)
    };
    for k in 0..sides {
        let n = k + 1;
        builder.lit(
            surface,
            Vec3::ONE,
            &[
                (at(k, outer, low), 0.65),
                (at(n, outer, low), 0.65),
                (at(n, outer, high), 1.0),
                (at(k, outer, high), 1.0),
            ],
        );
        builder.metric(
            surface,
            Vec3::ONE,
            &[at(k, outer, high), at(n, outer, high), at(n, inner, high), at(k, inner, high)],
        );
        builder.lit(
            surface,
            Vec3::ONE,
            &[(at(n, inner, low), 0.5), (at(k, inner, low), 0.5), (at(k, inner, high), 0.8), (at(n, inner, high), 0.8)],
        );
    }
}
