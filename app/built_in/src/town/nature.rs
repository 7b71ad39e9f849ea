//! Nature: trees, ivy and flowers, and the country round the town with meadows that rise to wooded hills.

use glam::{IVec2, Vec2, Vec3, vec2, vec3};
use rand::RngExt;
use rand_chacha::ChaCha8Rng;

use super::builder::{Builder, MeshCorner, SiteFrame};
use super::canvas::{cloud, smoothstep};
use super::plan::ground;
use super::surface::TownSurface;
use crate::turn::circle;
use scene::Lighting;

/// Middle of the town in plan (x, z), metres.
pub(super) const MIDDLE: Vec2 = vec2(48.0, -4.0);
/// Distance from the middle at which the country begins to rise, metres.
const PLAIN: f32 = 150.0;
/// Distance from the middle at which the hills are highest and the country ends, metres.
const HORIZON: f32 = 340.0;

/// Builds a lime tree: a trunk and `sprays` of leaves that face outwards from the middles of three lobes.
pub(super) fn tree(builder: &mut Builder, frame: &SiteFrame, height: f32, sprays: u32, dice: &mut ChaCha8Rng) {
    let radius = height * 0.30;
    let crown = frame.point(0.0, height * 0.62, 0.0);
    builder.turned(TownSurface::Bark, Vec3::ONE, frame, 6, &[(0.34, -0.2), (0.2, 0.6), (0.12, height * 0.6)]);
    let start: f32 = dice.random_range(0.0..1.0);
    let size = radius * 3.3 / (sprays as f32).sqrt();
    for k in 0..sprays {
        // Lobes stand round the crown's axis at different heights, each with points of a spiral, evenly dense.
        let lobe = k % 3;
        let c = circle(start + lobe as f32 / 3.0) * 0.38 * radius;
        let middle = crown + vec3(c.x, (lobe as f32 - 0.8) * 0.34 * radius, c.y);
        let y = 1.0 - 2.0 * (k as f32 + 0.5) / sprays as f32;
        let c = circle(0.381_966 * (k / 3) as f32 + start + dice.random_range(-0.05..0.05)) * (1.0 - y * y).sqrt();
        let out = vec3(c.x, y, c.y);
        let at = middle + out * radius * dice.random_range(0.48..0.72);
        let stray = vec3(dice.random_range(-0.5..0.5), dice.random_range(-0.2..0.3), dice.random_range(-0.5..0.5));
        let facing = (out + stray).normalize();
        let (side, up) = facing.any_orthonormal_pair();
        let size = size * dice.random_range(0.85..1.15);
        let corners = [(-1.0, -1.0), (1.0, -1.0), (1.0, 1.0), (-1.0, 1.0)].map(|(a, b): (f32, f32)| {
            let at = at + (side * a + up * b) * size - facing * 0.2 * size;
            let light = 0.55 + 0.45 * smoothstep(-1.1, 0.8, (at.y - crown.y) / radius);
            MeshCorner { at, uv: vec2(0.5 + 0.5 * a, 0.5 - 0.5 * b), light }
        });
        let normals = corners.map(|corner| (corner.at - middle + Vec3::Y * 0.4).normalize());
        let tint = Vec3::ONE.lerp(vec3(1.15, 1.1, 0.75), dice.random_range(0.0..1.0));
        builder.smooth_face(TownSurface::Leaves, tint, &corners, &normals);
    }
}

/// Builds ivy up a wall: a sheet in front of it, its lower left corner at (x, 0) in the frame.
pub(super) fn ivy(builder: &mut Builder, frame: &SiteFrame, x: f32, width: f32, height: f32) {
    let corner = |s: f32, t: f32| MeshCorner {
        at: frame.point(x + s * width, t * height, 0.05 + 0.04 * (1.0 - t)),
        uv: vec2(s, 1.0 - t),
        light: 0.75 + 0.25 * t,
    };
    builder.face(
        TownSurface::Ivy,
        Vec3::ONE,
        &[corner(0.0, 0.0), corner(1.0, 0.0), corner(1.0, 1.0), corner(0.0, 1.0)],
    );
}

/// Builds a window box with flowers; `frame` lies on the wall below the middle of the sill.
pub(super) fn flower_box(builder: &mut Builder, frame: &SiteFrame, width: f32, dice: &mut ChaCha8Rng) {
    let half = width / 2.0;
    let p = |x: f32, y: f32, z: f32| frame.point(x, y, z);
    let wood = vec3(0.9, 0.75, 0.6);
    let (low, high, deep) = (-0.02, 0.16, 0.2);
    builder.metric(
        TownSurface::Planks,
        wood,
        &[p(-half, low, deep), p(half, low, deep), p(half, high, deep), p(-half, high, deep)],
    );
    builder.metric(
        TownSurface::Planks,
        wood * 0.6,
        &[p(-half, low, 0.0), p(half, low, 0.0), p(half, low, deep), p(-half, low, deep)],
    );
    for side in [-1.0, 1.0] {
        let x = side * half;
        builder.facing(
            TownSurface::Planks,
            wood,
            &[p(x, low, 0.0), p(x, low, deep), p(x, high, deep), p(x, high, 0.0)],
            frame.right * side,
        );
    }
    let start: f32 = dice.random_range(0.0..0.4);
    let corner = |s: f32, t: f32, z: f32| {
        MeshCorner::new(
            frame.point((s - 0.5) * (width + 0.12), -0.02 + 0.44 * t, z),
            vec2(start + 0.6 * s, 0.95 - 0.9 * t),
        )
    };
    builder.face(
        TownSurface::Flowers,
        Vec3::ONE,
        &[corner(0.0, 0.0, 0.26), corner(1.0, 0.0, 0.26), corner(1.0, 1.0, 0.12), corner(0.0, 1.0, 0.12)],
    );
    builder.face(
        TownSurface::Flowers,
        Vec3::splat(0.8),
        &[corner(0.0, 0.3, 0.12), corner(1.0, 0.3, 0.12), corner(1.0, 1.1, 0.04), corner(0.0, 1.1, 0.04)],
    );
}

/// Builds a tub with a flowering shrub.
pub(super) fn tub(builder: &mut Builder, frame: &SiteFrame, dice: &mut ChaCha8Rng) {
    builder.prism(TownSurface::Paint, vec3(0.42, 0.19, 0.11), frame, 6, [0.26, 0.33], [-0.02, 0.5]);
    for turn in [0.05, 0.22, 0.38] {
        let leaf = frame.rotated(turn);
        let start: f32 = dice.random_range(0.0..0.3);
        let corner = |s: f32, t: f32| MeshCorner {
            at: leaf.point(s - 0.5, 0.38 + 0.85 * t, 0.0),
            uv: vec2(start + 0.7 * s, 0.9 - 0.9 * t),
            light: 0.7 + 0.3 * t,
        };
        builder.face(
            TownSurface::Flowers,
            Vec3::ONE,
            &[corner(0.0, 0.0), corner(1.0, 0.0), corner(1.0, 1.0), corner(0.0, 1.0)],
        );
    }
}

/// Height of the country, metres, below the streets so that it never shows through them.
fn country_height(p: Vec2) -> f32 {
    let hills = 62.0 + 40.0 * cloud(p / 150.0, IVec2::splat(64), 2, 5);
    ground(p) - 0.22 + hills * smoothstep(PLAIN, HORIZON, p.distance(MIDDLE))
}

/// Point of the country and its normal.
fn country_point(p: Vec2) -> (Vec3, Vec3) {
    let slope = |step: Vec2| (country_height(p + step) - country_height(p - step)) / 8.0;
    (vec3(p.x, country_height(p), p.y), vec3(-slope(vec2(4.0, 0.0)), 1.0, -slope(vec2(0.0, 4.0))).normalize())
}

/// Builds meadows under and round the town, woods and clearings on the hills beyond.
///
/// The hills send out the light of `daylight` as if they were unlit: they are beyond the reach of any shadow, and the
/// sun's depth map need not cover them.
pub(super) fn country(builder: &mut Builder, daylight: &Lighting) {
    const RINGS: [f32; 13] = [0.0, 22.0, 40.0, 58.0, 76.0, 94.0, 112.0, 130.0, PLAIN, 185.0, 225.0, 275.0, HORIZON];
    const SPOKES: u32 = 27;
    builder.district("country");
    let irradiance = |normal: Vec3| {
        let [sun, sky, ground] = [daylight.sun, daylight.sky, daylight.ground].map(Vec3::from);
        sun * normal.dot(daylight.sun_direction).max(0.0) + ground.lerp(sky, 0.5 + 0.5 * normal.y)
    };
    let level = irradiance(Vec3::Y);
    for pair in RINGS.windows(2) {
        let (near, far) = (pair[0], pair[1]);
        for spoke in 0..SPOKES {
            let at =
                |radius: f32, step: u32| MIDDLE + radius * circle(((spoke + step) % SPOKES) as f32 / SPOKES as f32);
            let places = [at(near, 1), at(near, 0), at(far, 0), at(far, 1)];
            let places = if near > 0.0 { &places[..] } else { &places[1..] };
            let hill = near >= PLAIN;
            let surface = if hill { TownSurface::Hills } else { TownSurface::Grass };
            // Clearings are lighter; colours fade with distance.
            let clearing = cloud(places[0] / 70.0, IVec2::splat(64), 2, 8) > 0.10;
            let wood = if clearing { vec3(0.72, 0.66, 0.66) } else { vec3(0.36, 0.40, 0.50) };
            let pale = wood.lerp(vec3(0.55, 0.62, 0.85), 0.6 * smoothstep(PLAIN, HORIZON, near));
            let tint = if hill { pale * level } else { Vec3::ONE };
            let (corners, normals): (Vec<MeshCorner>, Vec<Vec3>) = places
                .iter()
                .map(|&p| {
                    let (at, normal) = country_point(p);
                    let light = if hill { irradiance(normal).y / level.y } else { 1.0 };
                    (MeshCorner { at, uv: p / surface.tile(), light }, normal)
                })
                .rev()
                .unzip();
            builder.smooth_face(surface, tint, &corners, &normals);
        }
    }
}
