//! Triangles of the observer's marks: a ball with its axes, and the edges of its field of view.

use glam::{DMat4, DVec2, DVec3, DVec4, Vec4};
use view::OutsideCamera;

/// Corner of a triangle, put into the picture, with its colour.
#[repr(C)]
#[derive(Clone, Copy, Debug, bytemuck::Pod, bytemuck::Zeroable)]
pub struct MarkCorner {
    /// Place in clip space.
    pub clip: Vec4,
    /// Linear colour, relative to white; opaque.
    pub colour: Vec4,
}

/// Radius of the ball, as a share of the camera's distance.
const BALL: f64 = 0.025;
/// Length of the axes, radii of the ball.
const AXES: f64 = 7.0;
/// Length of the edges of the field of view, as a share of the camera's distance.
const FIELD: f64 = 0.8;
/// Width of lines in pictures of 720 rows, pixels.
const LINE_PX: f64 = 2.5;
/// Pieces of a line, so that its width is right along it.
const PIECES: u32 = 24;
/// Parts of each edge of the octahedron that becomes the ball.
const PARTS: u32 = 8;

/// Colours of the axes to the right, up and ahead, and of the field of view.
const RIGHT: DVec3 = DVec3::new(0.9, 0.06, 0.05);
const UP: DVec3 = DVec3::new(0.1, 0.75, 0.1);
const AHEAD: DVec3 = DVec3::new(0.1, 0.25, 1.0);
const LINES: DVec3 = DVec3::new(0.9, 0.75, 0.3);
const SKIN: DVec3 = DVec3::new(0.9, 0.9, 0.9);

/// Triangles for a picture of `size` pixels. `clip_from_observer`: of the camera outside, for places relative to the
/// eye. `scale`: factor of radiance.
pub fn outline(outside: &OutsideCamera, size: [u32; 2], clip_from_observer: &DMat4, scale: f64) -> Vec<MarkCorner> {
    let mut drawing = OutlineDrawing { corners: Vec::new(), size, clip_from_observer, scale };
    let distance = outside.place.length();
    let radius = BALL * distance;
    drawing.ball(radius, outside.place);
    let eye = |axis: DVec3| outside.eye.observer_from_eye * axis * (AXES * radius);
    for (axis, colour) in [(DVec3::X, RIGHT), (DVec3::Y, UP), (DVec3::NEG_Z, AHEAD)] {
        drawing.line(DVec3::ZERO, eye(axis), 2.0 * LINE_PX, colour);
    }
    let corners = outside.corners(size).map(|corner| corner * (FIELD * distance));
    for (number, corner) in corners.into_iter().enumerate() {
        drawing.line(DVec3::ZERO, corner, LINE_PX, LINES);
        drawing.line(corner, corners[(number + 1) % 4], LINE_PX, LINES);
    }
    drawing.corners
}

struct OutlineDrawing<'a> {
    corners: Vec<MarkCorner>,
    size: [u32; 2],
    clip_from_observer: &'a DMat4,
    scale: f64,
}

impl OutlineDrawing<'_> {
    fn corner(&mut self, clip: DVec4, colour: DVec3) {
        let scaled = (colour * self.scale).as_vec3();
        // Alpha is the luminance at rest, which the display asks for.
        let luminance = physics::colour::luminance(colour) as f32;
        self.corners.push(MarkCorner { clip: clip.as_vec4(), colour: scaled.extend(luminance) });
    }

    /// Ball about the eye, lit by a lamp at the camera.
    fn ball(&mut self, radius: f64, camera: DVec3) {
        let towards = camera.normalize_or(DVec3::Y);
        let parts = f64::from(PARTS);
        for sign in 0..8 {
            let side = |axis: u32| if sign >> axis & 1 == 0 { 1.0 } else { -1.0 };
            let signs = DVec3::new(side(0), side(1), side(2));
            let at = |i: u32, j: u32| {
                let (i, j) = (f64::from(i) / parts, f64::from(j) / parts);
                (signs * DVec3::new(i, j, 1.0 - i - j)).normalize()
            };
            let triangles = (0..PARTS).flat_map(|i| (0..PARTS - i).map(move |j| (i, j)));
            for (i, j) in triangles {
                let mut faces = vec![[at(i, j), at(i + 1, j), at(i, j + 1)]];
                if i + j + 1 < PARTS {
                    faces.push([at(i + 1, j), at(i + 1, j + 1), at(i, j + 1)]);
                }
                for normal in faces.into_iter().flatten() {
                    let clip = *self.clip_from_observer * (normal * radius).extend(1.0);
                    self.corner(clip, SKIN * (0.3 + 0.7 * normal.dot(towards).max(0.0)));
                }
            }
        }
    }

    /// Line of a width in pixels, of as many pieces as its perspective needs.
    fn line(&mut self, from: DVec3, to: DVec3, width_px: f64, colour: DVec3) {
        let half = DVec2::from_array(self.size.map(f64::from)) * 0.5;
        let width = width_px * (half.y / 360.0).max(0.6);
        let at = |step: u32| *self.clip_from_observer * from.lerp(to, f64::from(step) / f64::from(PIECES)).extend(1.0);
        for step in 0..PIECES {
            let (mut a, mut b) = (at(step), at(step + 1));
            // Nothing is drawn behind the camera.
            let nearest = 1e-3 * a.w.abs().max(b.w.abs());
            if a.w < nearest && b.w < nearest {
                continue;
            }
            let crossing = a.lerp(b, (nearest - a.w) / (b.w - a.w));
            if a.w < nearest {
                a = crossing;
            } else if b.w < nearest {
                b = crossing;
            }
            let [first, last] = [a, b].map(|end| DVec2::new(end.x, end.y) / end.w * half);
            let Some(along) = (last - first).try_normalize() else { continue };
            let across = along.perp() * (0.5 * width) / half;
            let moved = |end: DVec4, side: f64| end + (across * (side * end.w)).extend(0.0).extend(0.0);
            for clip in [moved(a, -1.0), moved(b, -1.0), moved(b, 1.0), moved(a, -1.0), moved(b, 1.0), moved(a, 1.0)] {
                self.corner(clip, colour);
            }
        }
    }
}
