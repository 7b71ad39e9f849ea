//! Roofs with overhanging eaves, dormers and chimneys.

use glam::{Vec3, vec2, vec3};

use super::builder::{Builder, MeshCorner, SiteFrame, Tint};
use super::paint::timber;
use super::surface::TownSurface;

/// Thickness of a roof, metres.
const THICKNESS: f32 = 0.15;

/// Roof with a gable over its first and third side.
pub(super) struct Roof {
    /// Upper corners of the walls, counter-clockwise from above, beginning at the left of the first gable.
    pub(super) walls: [Vec3; 4],
    /// Height of the ridge above the walls, metres.
    pub(super) height: f32,
    /// Overhang at the eaves, at the first gable and at the other, metres.
    pub(super) overhang: [f32; 3],
    /// Share of the gable's height from which a hip leans back, at the first gable and at the other.
    pub(super) hips: [Option<f32>; 2],
    pub(super) surface: TownSurface,
    /// Region seen from so near that underside and edges matter: a point, the direction out of it, and the depth
    /// behind it, metres.
    pub(super) near: Option<(Vec3, Vec3, f32)>,
    pub(super) tint: Tint,
}

impl Roof {
    /// Middles of the two gables at the ridge.
    pub(super) fn ridge(&self) -> [Vec3; 2] {
        let [a, b, c, d] = self.walls;
        [(a + b) / 2.0 + Vec3::Y * self.height, (c + d) / 2.0 + Vec3::Y * self.height]
    }

    /// Builds the slopes and hips; the gable walls belong to the house.
    pub(super) fn build(&self, builder: &mut Builder) {
        let raised = Vec3::Y * 0.1;
        let [a, b, c, d] = self.walls.map(|corner| corner + raised);
        let [front, back] = self.ridge().map(|end| end + raised);
        let along = (front - back).normalize();
        let [eaves, at_front, at_back] = self.overhang;
        let lowered = |wall: Vec3, ridge: Vec3| {
            let run = vec2(wall.x - ridge.x, wall.z - ridge.z).length();
            ridge + (wall - ridge) * (1.0 + eaves / run)
        };
        // Outline of one end of the roof: the ridge steps back at a hip, and the slopes are cut off there.
        let end = |wall: Vec3, ridge: Vec3, out: Vec3, overhang: f32, hip: Option<f32>| -> Vec<Vec3> {
            let low = lowered(wall, ridge) + out * overhang;
            match hip {
                None => vec![low, ridge + out * overhang],
                Some(share) => {
                    let cut = wall.lerp(ridge, share) + out * overhang;
                    let back = (1.0 - share) * self.height * 0.75;
                    vec![low, cut, ridge - out * back]
                }
            }
        };
        for (near, far) in [(a, d), (b, c)] {
            let mut slope = end(near, front, along, at_front, self.hips[0]);
            slope.extend(end(far, back, -along, at_back, self.hips[1]).into_iter().rev());
            self.slab(builder, &slope, 1);
        }
        for (walls, ridge, out, overhang, hip) in
            [([a, b], front, along, at_front, self.hips[0]), ([c, d], back, -along, at_back, self.hips[1])]
        {
            if hip.is_some() {
                let left = end(walls[0], ridge, out, overhang, hip);
                let right = end(walls[1], ridge, out, overhang, hip);
                self.slab(builder, &[left[1], right[1], left[2]], 2);
            }
        }
    }

    /// Builds a flat piece of roof with its underside and its edges, except those at the ridge.
    fn slab(&self, builder: &mut Builder, top: &[Vec3], ridge_edges: usize) {
        let mut top = top.to_vec();
        let normal = (top[1] - top[0]).cross(top[top.len() - 1] - top[0]);
        if normal.y < 0.0 {
            top.reverse();
        }
        let drop = Vec3::Y * THICKNESS;
        builder.metric(self.surface, self.tint, &top);
        let Some((origin, out, reach)) = self.near else { return };
        if top.iter().any(|corner| (*corner - origin).dot(out) > -1.5) {
            let below: Vec<_> = top.iter().rev().map(|&corner| (corner - drop, 0.5)).collect();
            builder.lit(TownSurface::Planks, Vec3::splat(0.8), &below);
        }
        let high = top.iter().map(|corner| corner.y).fold(f32::MIN, f32::max);
        let count = top.len();
        for k in 0..count {
            let (p, q) = (top[k], top[(k + 1) % count]);
            let at_ridge = p.y.min(q.y) > high - 0.02 || (ridge_edges == 2 && p.y.max(q.y) > high - 0.02);
            let hidden = ((p + q) / 2.0 - origin).dot(out) < -reach;
            if !(at_ridge || hidden) {
                builder.metric(TownSurface::Planks, Vec3::splat(0.75), &[p - drop, q - drop, q, p]);
            }
        }
    }
}

/// Builds a dormer with a window on a slope that rises by `slope` per metre behind `frame`'s origin, which lies on
/// it.
pub(super) fn dormer(builder: &mut Builder, frame: &SiteFrame, slope: f32, front: usize, tint: Tint) {
    let (half, height, rise) = (0.68, 1.35, 0.62);
    let p = |x: f32, y: f32, z: f32| frame.point(x, y, z);
    let reach = |y: f32| -y / slope;
    let bay = timber::WINDOWS[0] as f32;
    let uv = |x: f32, y: f32| {
        vec2(
            (bay + 0.5 + x * 0.5 / timber::STRIP.x * timber::BAYS as f32) / timber::BAYS as f32,
            1.0 - y / timber::STRIP.y,
        )
    };
    let corner = |x: f32, y: f32, s: f32, t: f32| MeshCorner::new(p(x, y, 0.0), uv(s, t));
    builder.face(
        TownSurface::Front(front),
        Vec3::splat(0.95),
        &[
            corner(-half, -0.05, -1.1, 0.84),
            corner(half, -0.05, 1.1, 0.84),
            corner(half, height, 1.1, 2.34),
            corner(-half, height, -1.1, 2.34),
        ],
    );
    let planks = Vec3::splat(0.9);
    builder.metric(
        TownSurface::Planks,
        planks,
        &[p(-half, height, 0.0), p(half, height, 0.0), p(0.0, height + rise, 0.0)],
    );
    for side in [-1.0, 1.0] {
        let cheek = [p(side * half, 0.0, 0.0), p(side * half, height, 0.0), p(side * half, height, reach(height))];
        builder.facing(TownSurface::Planks, planks, &cheek, frame.right * side);
        let eaves = height - 0.14 * rise / half;
        let x = side * (half + 0.14);
        let top = height + rise;
        let roof = [p(x, eaves, 0.18), p(x, eaves, reach(eaves)), p(0.0, top, reach(top)), p(0.0, top, 0.18)];
        builder.facing(TownSurface::Tiles, tint, &roof, Vec3::Y);
    }
}

/// Builds a chimney through the roof; `frame`'s origin lies at its foot.
pub(super) fn chimney(builder: &mut Builder, frame: &SiteFrame, height: f32, tint: Tint) {
    builder.walls(TownSurface::Rubble, tint, frame, vec3(-0.33, 0.0, -0.28), vec3(0.33, height, 0.28));
    builder.block(TownSurface::Ashlar, tint * 0.9, frame, vec3(-0.4, height, -0.35), vec3(0.4, height + 0.12, 0.35));
    if height > 2.35 {
        builder.prism(TownSurface::Paint, vec3(0.5, 0.24, 0.15), frame, 4, [0.16, 0.12], [height + 0.12, height + 0.5]);
    }
}
