//! Trees, ivy and flowers, and the country round the town: meadows that rise to wooded hills.

use glam::{Vec2, Vec3, vec2, vec3};
use rand::RngExt;
use rand_chacha::ChaCha8Rng;

use super::builder::{Builder, Corner, Frame};
use super::canvas::{cloud, smoothstep};
use super::plan::ground;
use super::surface::Surface;
use super::turn::circle;

/// Middle of the town.
pub(super) const MIDDLE: Vec2 = vec2(48.0, -4.0);
/// Where the country begins to rise, metres from the middle.
const PLAIN: f32 = 150.0;

/// A lime tree: a trunk and sprays of leaves that face outwards from the crown's middle.
pub(super) fn tree(builder: &mut Builder, frame: &Frame, height: f32, dice: &mut ChaCha8Rng) {
    let radius = height * 0.30;
    let crown = frame.at(0.0, height * 0.62, 0.0).origin;
    builder.turned(
        Surface::Bark,
        Vec3::ONE,
        frame,
        6,
        &[(0.34, -0.2), (0.22, 0.5), (0.17, height * 0.35), (0.08, height * 0.7)],
    );
    let sprays = 22;
    for k in 0..sprays {
        // Points of a spiral on the sphere, evenly dense.
        let y = 1.0 - 2.0 * (k as f32 + 0.5) / sprays as f32;
        let c = circle(0.381_966 * k as f32 + dice.random_range(-0.04..0.04)) * (1.0 - y * y).sqrt();
        let out = vec3(c.x, y, c.y);
        let reach = radius * dice.random_range(0.62..0.86);
        let middle = crown + out * vec3(1.0, 1.2, 1.0) * reach;
        let facing = (out
            + 0.5 * vec3(dice.random_range(-1.0..1.0), dice.random_range(-0.4..0.6), dice.random_range(-1.0..1.0)))
        .normalize();
        let side = facing.any_orthonormal_vector();
        let up = facing.cross(side);
        let size = radius * dice.random_range(0.62..0.85);
        let corners = [(-1.0, -1.0), (1.0, -1.0), (1.0, 1.0), (-1.0, 1.0)].map(|(a, b): (f32, f32)| {
            let at = middle + (side * a + up * b) * size - facing * 0.25 * size;
            let light = 0.62 + 0.38 * smoothstep(-1.0, 0.8, (at.y - crown.y) / radius);
            Corner { at, uv: vec2(0.5 + 0.5 * a, 0.5 - 0.5 * b), light }
        });
        let normals = corners.map(|corner| (corner.at - crown + Vec3::Y * 0.5).normalize());
        let tint = Vec3::ONE.lerp(vec3(1.15, 1.1, 0.75), dice.random_range(0.0..1.0));
        builder.smooth_face(Surface::Leaves, tint, &corners, &normals);
    }
}

/// Ivy up a wall: a sheet in front of it, its lower left corner at (x, y) in the frame.
pub(super) fn ivy(builder: &mut Builder, frame: &Frame, x: f32, width: f32, height: f32) {
    let corner = |s: f32, t: f32| Corner {
        at: frame.point(x + s * width, t * height, 0.05 + 0.04 * (1.0 - t)),
        uv: vec2(s, 1.0 - t),
        light: 0.75 + 0.25 * t,
    };
    builder.face(Surface::Ivy, Vec3::ONE, &[corner(0.0, 0.0), corner(1.0, 0.0), corner(1.0, 1.0), corner(0.0, 1.0)]);
}

/// A window box with flowers; `frame` lies on the wall below the middle of the sill.
pub(super) fn flower_box(builder: &mut Builder, frame: &Frame, width: f32, dice: &mut ChaCha8Rng) {
    let half = width / 2.0;
    builder.beam(Surface::Planks, vec3(0.9, 0.75, 0.6), frame, vec3(-half, -0.02, 0.0), vec3(half, 0.16, 0.2));
    let start: f32 = dice.random_range(0.0..0.4);
    let corner = |s: f32, t: f32, z: f32| {
        Corner::new(frame.point((s - 0.5) * (width + 0.12), -0.02 + 0.44 * t, z), vec2(start + 0.6 * s, 0.95 - 0.9 * t))
    };
    builder.face(
        Surface::Flowers,
        Vec3::ONE,
        &[corner(0.0, 0.0, 0.26), corner(1.0, 0.0, 0.26), corner(1.0, 1.0, 0.12), corner(0.0, 1.0, 0.12)],
    );
    builder.face(
        Surface::Flowers,
        Vec3::splat(0.8),
        &[corner(0.0, 0.3, 0.12), corner(1.0, 0.3, 0.12), corner(1.0, 1.1, 0.04), corner(0.0, 1.1, 0.04)],
    );
}

/// Height of the country at a distance from the middle of the town.
fn rise(p: Vec2) -> f32 {
    let distance = p.distance(MIDDLE);
    let hills = 70.0 + 55.0 * cloud(p / 230.0, glam::IVec2::splat(64), 2, 5);
    hills * smoothstep(PLAIN, 520.0, distance)
}

/// Meadows under and round the town, hills beyond.
pub(super) fn country(builder: &mut Builder) {
    const RINGS: [f32; 14] =
        [0.0, 22.0, 40.0, 58.0, 76.0, 94.0, 112.0, 130.0, PLAIN, 205.0, 270.0, 350.0, 440.0, 560.0];
    const SPOKES: u32 = 36;
    builder.district("country");
    let at = |ring: usize, spoke: u32| {
        let p = MIDDLE + RINGS[ring] * circle((spoke % SPOKES) as f32 / SPOKES as f32);
        vec3(p.x, ground(p) + rise(p) - 0.22, p.y)
    };
    for ring in 0..RINGS.len() - 1 {
        let surface = if RINGS[ring] < PLAIN { Surface::Grass } else { Surface::Hills };
        // Distance pales the hills.
        let far = smoothstep(PLAIN, 560.0, RINGS[ring]);
        let tint = Vec3::ONE.lerp(vec3(0.95, 1.05, 1.30), far);
        for spoke in 0..SPOKES {
            let corners = [at(ring, spoke + 1), at(ring, spoke), at(ring + 1, spoke), at(ring + 1, spoke + 1)];
            let unique = if ring == 0 { &corners[1..] } else { &corners[..] };
            let faces: &[&[Vec3]] = if ring == 0 {
                &[unique]
            } else {
                &[&[corners[0], corners[1], corners[2]], &[corners[0], corners[2], corners[3]]]
            };
            for face in faces {
                let tile = surface.tile();
                let corners: Vec<Corner> = face.iter().map(|&at| Corner::new(at, vec2(at.x, at.z) / tile)).collect();
                let flat = builder_normal(face);
                let normals: Vec<Vec3> = face.iter().map(|_| flat).collect();
                if flat.y > 0.0 {
                    builder.smooth_face(surface, tint, &corners, &normals);
                } else {
                    let corners: Vec<Corner> = corners.into_iter().rev().collect();
                    builder.smooth_face(surface, tint, &corners, &normals.iter().map(|n| -*n).collect::<Vec<_>>());
                }
            }
        }
    }
}

fn builder_normal(face: &[Vec3]) -> Vec3 {
    (face[1] - face[0]).cross(face[2] - face[0]).normalize_or(Vec3::Y)
}
