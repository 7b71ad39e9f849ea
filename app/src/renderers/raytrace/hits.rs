//! What a ray of light comes from: the first triangle on its way back.
//!
//! Each group of meshes with one motion is a body with a frame of its own, in which it rests. The observer's event and celerity are
//! taken there once for a picture, a pixel's direction once for a ray. Along one sight line the apparent distance |x'| = r D (r in the body's frame, D from it to
//! the observer) is how long ago by the observer's clock the light left, in every body's case: the smallest is seen.

mod onward;

use crate::renderers::Shot;
use crate::scene::motion::{Motion, SeenBy};
use crate::scene::{Alpha, Scene};
use glam::{DQuat, DVec3};
use parry3d_f64::bounding_volume::Aabb;
use parry3d_f64::math::Vector;
use parry3d_f64::partitioning::{Bvh, BvhBuildStrategy};
use parry3d_f64::query::Ray;
use physics::{Aberration, Boost, Celerity, FourVector, Observer};

pub use onward::{Emission, Turn};

/// By how much boxes are larger than what is in them, relative to its coordinates, so that rounding misses nothing.
const MARGIN: f64 = 1e-9;

/// A point of a triangle that a ray meets.
#[derive(Clone, Copy, Debug)]
pub struct Hit {
    /// Index into the scene's meshes.
    pub mesh: usize,
    /// Indices into its vertices.
    pub corners: [usize; 3],
    /// Share of each corner.
    pub weights: [f64; 3],
    /// Where, in metres relative to the scene's origin, in the body's frame.
    pub position: DVec3,
    /// From where the ray begins, metres in the body's frame.
    pub distance: f64,
    /// Along the normal of the triangle's front, of any length.
    pub plane: DVec3,
    /// Whether the ray meets its front.
    pub front: bool,
}

/// A hit, and in which body.
pub struct Found {
    /// Where.
    pub hit: Hit,
    /// ν_observed / ν_sent.
    pub doppler: f64,
    body: usize,
    apparent: f64,
}

/// What a pixel shows.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Place {
    /// Metres relative to the scene's origin; of what moves, in its own frame.
    pub position: DVec3,
    /// Index into the scene's motions.
    pub motion: Option<usize>,
    /// Relative to the observer, in his own axes, metres: the apparent position.
    pub apparent: DVec3,
    /// ν_observed / ν_sent.
    pub doppler: f64,
}

struct Triangle {
    mesh: usize,
    corners: [usize; 3],
    points: [DVec3; 3],
    double_sided: bool,
    glass: bool,
}

struct Body {
    motion: Option<usize>,
    surfaces: Hierarchy,
}

struct Hierarchy {
    triangles: Vec<Triangle>,
    boxes: Bvh,
}

/// All that can be met.
pub struct Bodies {
    bodies: Vec<Body>,
    /// What keeps the sun from others.
    casters: Hierarchy,
    /// Whether light goes through glass: then it has no shadow, and its inner side is met too.
    pub clear_glass: bool,
}

/// An observer as all bodies have him.
pub struct Sight {
    bodies: Vec<Seer>,
    world: Seer,
}

/// An observer as one body has him.
struct Seer {
    position: DVec3,
    /// His time in the body's frame.
    ct: f64,
    group_from_observer: DQuat,
    bend: Bend,
}

enum Bend {
    /// Light takes its time.
    Light(Aberration),
    /// It takes none: the world at one moment, seen by an observer whose light is shifted nevertheless.
    Moment { observer: Aberration, object: Aberration, object_from_world: Boost },
}

/// A ray in a body's frame.
struct Line {
    direction: DVec3,
    doppler: f64,
    /// Apparent metres to the metre.
    apparent: f64,
}

impl Seer {
    fn line(&self, seen: DVec3) -> Line {
        match &self.bend {
            Bend::Light(aberration) => {
                let (direction, doppler) = aberration.world_from_observer(self.group_from_observer * seen);
                Line { direction, doppler, apparent: doppler }
            }
            Bend::Moment { observer, object, object_from_world } => {
                let doppler = observer.observer_from_world(seen).1 / object.observer_from_world(seen).1;
                let stretched = object_from_world.apply(FourVector { t: 0.0, r: seen }).r;
                let length = stretched.length();
                Line { direction: stretched / length, doppler, apparent: 1.0 / length }
            }
        }
    }
}

impl Sight {
    /// The direction in the world of what is seen, and its Doppler factor.
    pub fn world(&self, seen: DVec3) -> (DVec3, f64) {
        let line = self.world.line(seen);
        (line.direction, line.doppler)
    }

    /// Where every ray begins: at the eye.
    pub fn start(&self) -> Vec<f64> {
        vec![0.0; self.bodies.len()]
    }
}

impl Bodies {
    /// Sorts a scene's triangles. Those with a vertex that is not finite are left out.
    pub fn of(scene: &Scene) -> Self {
        let motions = std::iter::once(None).chain((0..scene.motions.len()).map(Some));
        let body = |motion| Body { motion, surfaces: Hierarchy::of(scene, |mesh| scene.meshes[mesh].motion == motion) };
        let bodies = motions.map(body).filter(|body| !body.surfaces.triangles.is_empty()).collect();
        let casts = |mesh: usize| {
            let material = &scene.materials[scene.meshes[mesh].material];
            scene.meshes[mesh].motion.is_none() && !material.unlit && material.alpha != Alpha::Blend
        };
        let casters = Hierarchy::of(scene, |mesh| scene.light.shadows && casts(mesh));
        Self { bodies, casters, clear_glass: false }
    }

    /// The observer of a shot.
    pub fn sight(&self, scene: &Scene, shot: &Shot) -> Sight {
        self.sight_of(scene, &shot.observer(), shot.effects.geometry)
    }

    /// The same of any observer. `geometry`: whether light takes its time.
    pub fn sight_of(&self, scene: &Scene, observer: &Observer, geometry: bool) -> Sight {
        let seer = |motion| seer(scene, observer, geometry, motion);
        Sight { bodies: self.bodies.iter().map(|body| seer(body.motion)).collect(), world: seer(None) }
    }

    /// What is seen first in a direction, beyond the given distance in each body's frame, of what `is_there`.
    pub fn first(&self, sight: &Sight, seen: DVec3, beyond: &[f64], is_there: impl Fn(&Hit) -> bool) -> Option<Found> {
        let mut first: Option<Found> = None;
        for (index, ((body, seer), &after)) in self.bodies.iter().zip(&sight.bodies).zip(beyond).enumerate() {
            let line = seer.line(seen);
            let Some(hit) = body.surfaces.first(seer.position, line.direction, after, self.clear_glass, &is_there)
            else {
                continue;
            };
            let apparent = hit.distance * line.apparent;
            if first.as_ref().is_none_or(|first| apparent < first.apparent) {
                first = Some(Found { hit, doppler: line.doppler, body: index, apparent });
            }
        }
        first
    }

    /// Beyond what was found: distances in each body's frame.
    pub fn beyond(&self, sight: &Sight, seen: DVec3, found: &Found) -> Vec<f64> {
        let after = |(index, seer): (usize, &Seer)| {
            if index == found.body { found.hit.distance } else { found.apparent / seer.line(seen).apparent }
        };
        sight.bodies.iter().enumerate().map(after).collect()
    }

    /// What was found, for those who ask where it is.
    pub fn place(&self, seen: DVec3, found: &Found) -> Place {
        Place {
            position: found.hit.position,
            motion: self.bodies[found.body].motion,
            apparent: seen * found.apparent,
            doppler: found.doppler,
        }
    }

    /// Whether the sun's light reaches a point (relative to the scene's origin) of what rests in the world, with this normal.
    ///
    /// The ray begins off the surface by what the other renderers leave between a surface and its own shadow.
    pub fn sunlit(&self, position: DVec3, normal: DVec3, towards_sun: DVec3) -> bool {
        let from = position + f64::from(shaders::SHADOW_NORMAL_OFFSET_M) * normal;
        self.is_free(from, towards_sun, f64::INFINITY)
    }

    /// Whether nothing is between a point of what rests in the world and one of its lamps, `away` from it. `normal`: as for
    /// [`Bodies::sunlit`]; zero where the point is of something that moves, in whose frame the normal is another.
    pub fn lamplit(&self, position: DVec3, normal: DVec3, away: DVec3) -> bool {
        let offset = f64::from(shaders::SHADOW_NORMAL_OFFSET_M) * normal;
        let distance = (away - offset).length();
        self.is_free(position + offset, (away - offset) / distance, distance)
    }

    fn is_free(&self, from: DVec3, direction: DVec3, until: f64) -> bool {
        let after = f64::from(shaders::SHADOW_BIAS_M);
        let meet = |index: u32| {
            let triangle = &self.casters.triangles[index as usize];
            let distance = triangle.meet(from, direction)?.distance;
            (distance > after && distance < until && !(self.clear_glass && triangle.glass)).then_some(distance)
        };
        self.casters.cast(from, direction, meet).is_none()
    }
}

fn seer(scene: &Scene, observer: &Observer, geometry: bool, motion: Option<usize>) -> Seer {
    let rest =
        SeenBy { position: observer.event.position, celerity: observer.celerity, observer_from_group: DQuat::IDENTITY };
    let uniform = motion.map(|motion| {
        let Motion::Uniform(uniform) = &scene.motions[motion];
        *uniform
    });
    let seen_by = uniform.map_or(rest, |uniform| uniform.seen_by(observer));
    let bend = if geometry {
        Bend::Light(Aberration::new(seen_by.celerity))
    } else {
        let celerity = uniform.map_or(Celerity::ZERO, |uniform| uniform.celerity);
        Bend::Moment {
            observer: Aberration::new(observer.celerity),
            object: Aberration::new(celerity),
            object_from_world: Boost::observer_from_world(celerity),
        }
    };
    let group_from_observer = seen_by.observer_from_group.conjugate();
    let ct = uniform.map_or(observer.event.ct, |uniform| {
        let apart = observer.event - uniform.anchor;
        uniform.anchor.ct + Boost::observer_from_world(uniform.celerity).apply(apart).t
    });
    Seer { position: seen_by.position - scene.origin, ct, group_from_observer, bend }
}

impl Hierarchy {
    fn of(scene: &Scene, wanted: impl Fn(usize) -> bool) -> Self {
        let mut triangles = Vec::new();
        for (number, mesh) in scene.meshes.iter().enumerate().filter(|(number, _)| wanted(*number)) {
            let material = &scene.materials[mesh.material];
            let (double_sided, glass) = (material.double_sided, material.transmission > 0.0);
            for corners in mesh.indices.as_chunks::<3>().0 {
                let corners = corners.map(|corner| corner as usize);
                let points = corners.map(|corner| mesh.positions[corner].as_dvec3());
                if points.iter().all(|point| point.is_finite()) {
                    triangles.push(Triangle { mesh: number, corners, points, double_sided, glass });
                }
            }
        }
        let boxes: Vec<Aabb> = triangles.iter().map(|triangle| around(triangle.points)).collect();
        Self { triangles, boxes: Bvh::from_leaves(BvhBuildStrategy::Binned, &boxes) }
    }

    /// The nearest hit further than `after`. `clear_glass`: of glass the inner side too.
    fn first(
        &self,
        from: DVec3,
        direction: DVec3,
        after: f64,
        clear_glass: bool,
        is_there: impl Fn(&Hit) -> bool,
    ) -> Option<Hit> {
        let meet = |index: u32| {
            let triangle = &self.triangles[index as usize];
            let hit = triangle.meet(from, direction)?;
            let shown = hit.front || triangle.double_sided || (clear_glass && triangle.glass);
            (hit.distance > after && shown && is_there(&hit)).then_some(hit)
        };
        let (index, _) = self.cast(from, direction, |index| meet(index).map(|hit| hit.distance))?;
        meet(index)
    }

    fn cast(&self, from: DVec3, direction: DVec3, meet: impl Fn(u32) -> Option<f64>) -> Option<(u32, f64)> {
        if self.triangles.is_empty() || !from.is_finite() || !direction.is_finite() {
            return None;
        }
        let ray = Ray::new(vector(from), vector(direction));
        self.boxes.cast_ray(&ray, f64::MAX, |index, _| meet(index))
    }
}

impl Triangle {
    /// Where a ray meets the triangle. Triangles that share an edge agree on which side of it the ray passes, to the last bit.
    ///
    /// *Equation:* signed volumes of the direction with each edge seen from the ray's beginning, d·(b × c) and so on, are the shares of the
    /// corners.
    fn meet(&self, from: DVec3, direction: DVec3) -> Option<Hit> {
        let [a, b, c] = self.points.map(|point| point - from);
        let volumes = [b.cross(c), c.cross(a), a.cross(b)].map(|area| area.dot(direction));
        let within = volumes.iter().all(|&volume| volume >= 0.0) || volumes.iter().all(|&volume| volume <= 0.0);
        let sum: f64 = volumes.iter().sum();
        if !within || sum == 0.0 {
            return None;
        }
        let weights = volumes.map(|volume| volume / sum);
        let away = a * weights[0] + b * weights[1] + c * weights[2];
        let distance = away.dot(direction);
        let plane = (b - a).cross(c - a);
        let hit = Hit {
            mesh: self.mesh,
            corners: self.corners,
            weights,
            position: from + away,
            distance,
            plane,
            front: sum < 0.0,
        };
        (distance > 0.0).then_some(hit)
    }
}

fn around([a, b, c]: [DVec3; 3]) -> Aabb {
    let (low, high) = (a.min(b).min(c), a.max(b).max(c));
    let margin = DVec3::splat(MARGIN * (1.0 + low.abs().max(high.abs()).max_element()));
    Aabb::new(vector(low - margin), vector(high + margin))
}

fn vector(v: DVec3) -> Vector {
    Vector::new(v.x, v.y, v.z)
}
