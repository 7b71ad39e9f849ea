//! Hits of a ray of light: the first triangle on its way back.
//!
//! Each group of meshes with one motion is a body with its own frame, in which it rests. The observer's event and
//! celerity are taken to that frame once for each picture, a pixel's direction once for each ray. Along one sight
//! line the apparent distance is |x'| = r D, with r in the body's frame and D from that frame to the observer. For
//! every body it is the time since the light left, by the observer's clock, so the smallest one is seen.

mod onward;

use super::curve::{Chord, Curve, SLACK};
use super::surface::Surfaces;
use glam::{DMat3, DQuat, DVec3};
use parry3d_f64::bounding_volume::Aabb;
use parry3d_f64::math::Vector;
use parry3d_f64::partitioning::{Bvh, BvhBuildStrategy};
use parry3d_f64::query::Ray;
use physics::{Aberration, Beta, Boost, Celerity, FourVector, Observer};
use scene::falling::Falling;
use scene::motion::{Animated, Ball, Motion, SeenBy};
use scene::{Alpha, Scene};
use std::sync::Arc;
use view::Shot;

pub use onward::{Emission, Turn};

/// Relative margin of the boxes around triangles, in their coordinates, so that rounding misses no hit.
const MARGIN: f64 = 1e-9;

/// A point of a triangle that a ray meets.
#[derive(Clone, Copy, Debug)]
pub struct Hit {
    /// Index into the scene's meshes.
    pub mesh: usize,
    /// Indices of the corners into the mesh's vertices.
    pub corners: [usize; 3],
    /// Share of each corner at the point.
    pub weights: [f64; 3],
    /// Place in the body's frame, metres relative to the scene's origin.
    pub position: DVec3,
    /// Distance from the beginning of the ray, metres in the body's frame.
    pub distance: f64,
    /// Vector along the normal of the triangle's front, of any length.
    pub plane: DVec3,
    /// True if the ray meets the front.
    pub front: bool,
}

/// A hit, with its body.
pub struct Found {
    /// Point that the ray meets.
    pub hit: Hit,
    /// Doppler factor ν_observed / ν_emitted.
    pub doppler: f64,
    body: usize,
    apparent: f64,
}

/// Place in the scene that a pixel shows.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Place {
    /// Place in metres relative to the scene's origin; for a moving body, in its own frame.
    pub position: DVec3,
    /// Index into the scene's motions; `None` for what rests.
    pub motion: Option<usize>,
    /// Apparent position relative to the observer, in the observer's axes, metres.
    pub apparent: DVec3,
    /// Doppler factor ν_observed / ν_emitted.
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
    /// Bounds of the body in motion, if it is animated.
    swept: Option<Swept>,
}

/// Bounds of an animated body in motion, for rays that are followed through it.
struct Swept {
    animated: Arc<Animated>,
    /// Ball around the body's triangles, in its own frame.
    ball: Ball,
    /// Largest radius of that ball in the world, metres.
    world_radius: f64,
    /// Ball of the world that the body never leaves.
    reach: Ball,
}

struct Hierarchy {
    triangles: Vec<Triangle>,
    boxes: Bvh,
}

/// Bodies of a scene, which rays can meet.
pub struct Bodies {
    bodies: Vec<Body>,
    /// Triangles that cast shadows of the sun and of lamps.
    casters: Hierarchy,
    /// True if light goes through glass. Then glass has no shadow, and rays also meet its inner side.
    pub clear_glass: bool,
}

/// An observer in the frames of all bodies.
pub struct Sight {
    bodies: Vec<Seer>,
    world: Seer,
    observer: Observer,
    /// Light that falls on each of the scene's motions.
    pub falling: Vec<Falling>,
}

/// An observer in the frame of one body.
struct Seer {
    position: DVec3,
    /// Time of the observer in the body's frame, metres of light travel; for animated bodies, in the world's.
    ct: f64,
    group_from_observer: DQuat,
    bend: Bend,
}

enum Bend {
    /// Light takes its time.
    Light(Aberration),
    /// Light takes no time. An animated body is in the pose of that moment, and all of it moves like its middle.
    Pose { observer: Aberration, object: Aberration, body_from_world: DMat3 },
    /// Light takes no time. The observer sees the world at one moment, with the light shifted nevertheless.
    Moment { observer: Aberration, object: Aberration, object_from_world: Boost },
}

/// A ray in a body's frame.
struct Line {
    direction: DVec3,
    doppler: f64,
    /// Apparent metres for each metre of the ray.
    apparent: f64,
}

impl Line {
    /// Line along a vector of the body's frame that stands for one apparent metre.
    fn stretched(vector: DVec3, doppler: f64) -> Self {
        let length = vector.length();
        Self { direction: vector / length, doppler, apparent: 1.0 / length }
    }
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
                Line::stretched(object_from_world.apply(FourVector { t: 0.0, r: seen }).r, doppler)
            }
            Bend::Pose { observer, object, body_from_world } => {
                let doppler = observer.observer_from_world(seen).1 / object.observer_from_world(seen).1;
                Line::stretched(*body_from_world * seen, doppler)
            }
        }
    }
}

impl Sight {
    /// World direction of what is seen in a direction, and its Doppler factor.
    pub fn world(&self, seen: DVec3) -> (DVec3, f64) {
        let line = self.world.line(seen);
        (line.direction, line.doppler)
    }

    /// Distances at which the rays of all bodies begin: 0, at the eye.
    pub fn start(&self) -> Vec<f64> {
        vec![0.0; self.bodies.len()]
    }
}

impl Bodies {
    /// Sorts a scene's triangles. Triangles with a vertex that is not finite are left out.
    pub fn of(scene: &Scene) -> Self {
        let motions = std::iter::once(None).chain((0..scene.motions.len()).map(Some));
        let body = |motion: Option<usize>| {
            let animated = motion.and_then(|motion| scene.motions[motion].animated());
            let swept = animated.map(|animated| Swept::of(scene, motion, animated));
            let margin = swept.as_ref().map_or(0.0, |swept| SLACK * swept.ball.radius);
            let surfaces = Hierarchy::of(scene, margin, |mesh| scene.meshes[mesh].motion == motion);
            Body { motion, surfaces, swept }
        };
        let bodies = motions.map(body).filter(|body| !body.surfaces.triangles.is_empty()).collect();
        let casts = |mesh: usize| {
            let material = &scene.materials[scene.meshes[mesh].material];
            scene.meshes[mesh].motion.is_none() && !material.unlit && material.alpha != Alpha::Blend
        };
        let casters = Hierarchy::of(scene, 0.0, |mesh| scene.light.shadows && casts(mesh));
        Self { bodies, casters, clear_glass: false }
    }

    /// Sight of the shot's observer.
    pub fn sight(&self, surfaces: &Surfaces, shot: &Shot) -> Sight {
        self.sight_of(surfaces, &shot.observer, shot.effects.geometry)
    }

    /// Sight of any observer, with the light that falls on each of the scene's motions. `geometry` is true if light
    /// takes its time.
    pub fn sight_of(&self, surfaces: &Surfaces, observer: &Observer, geometry: bool) -> Sight {
        let seer = |motion| seer(&surfaces.scene, observer, geometry, motion);
        let bodies = self.bodies.iter().map(|body| seer(body.motion)).collect();
        let falling = surfaces.falling(observer, geometry);
        Sight { bodies, world: seer(None), observer: *observer, falling }
    }

    /// First hit in a direction, beyond the given distance in each body's frame, among the hits for which `is_there`
    /// is true.
    pub fn first(&self, sight: &Sight, seen: DVec3, beyond: &[f64], is_there: impl Fn(&Hit) -> bool) -> Option<Found> {
        let mut first: Option<Found> = None;
        for (index, ((body, seer), &after)) in self.bodies.iter().zip(&sight.bodies).zip(beyond).enumerate() {
            let line = seer.line(seen);
            let found = match (&body.swept, &seer.bend) {
                (Some(swept), Bend::Light(_)) => body.surfaces.first_on_curve(swept, sight, &line, after, &is_there),
                _ => {
                    // Animated bodies turn no rays.
                    let clear_glass = self.clear_glass && body.swept.is_none();
                    let hit = body.surfaces.first(seer.position, line.direction, after, clear_glass, &is_there);
                    hit.map(|hit| (hit, line.doppler))
                }
            };
            let Some((hit, doppler)) = found else { continue };
            let apparent = hit.distance * line.apparent;
            if first.as_ref().is_none_or(|first| apparent < first.apparent) {
                first = Some(Found { hit, doppler, body: index, apparent });
            }
        }
        first
    }

    /// Distances just beyond a hit, in each body's frame.
    pub fn beyond(&self, sight: &Sight, seen: DVec3, found: &Found) -> Vec<f64> {
        let after = |(index, seer): (usize, &Seer)| {
            if index == found.body { found.hit.distance } else { found.apparent / seer.line(seen).apparent }
        };
        sight.bodies.iter().enumerate().map(after).collect()
    }

    /// Place in the scene of a hit.
    pub fn place(&self, seen: DVec3, found: &Found) -> Place {
        Place {
            position: found.hit.position,
            motion: self.bodies[found.body].motion,
            apparent: seen * found.apparent,
            doppler: found.doppler,
        }
    }

    /// True if the sun's light reaches a point with this normal that rests in the world. The point is relative to the
    /// scene's origin.
    ///
    /// The ray begins off the surface, at the distance that the other renderers leave between a surface and its own
    /// shadow.
    pub fn sunlit(&self, position: DVec3, normal: DVec3, towards_sun: DVec3) -> bool {
        let from = position + f64::from(shaders::SHADOW_NORMAL_OFFSET_M) * normal;
        self.is_free(from, towards_sun, f64::INFINITY)
    }

    /// True if nothing is between a point at rest in the world and one of the lamps, `away` from it. `normal` is as
    /// for [`Bodies::sunlit`]; it is zero if the point moves, since its frame has another normal.
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
    let uniform = match motion.map(|motion| &scene.motions[motion]) {
        None => None,
        Some(Motion::Uniform(uniform)) => Some(*uniform),
        Some(Motion::Animated(animated)) => return seer_of_animated(observer, geometry, animated),
    };
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

/// Observer for an animated body. Light is followed in the world; if light takes no time, the body is in one pose.
fn seer_of_animated(observer: &Observer, geometry: bool, animated: &Animated) -> Seer {
    let ct = observer.event.ct;
    let (position, group_from_observer) = (observer.event.position, DQuat::IDENTITY);
    let of_observer = Aberration::new(observer.celerity);
    if geometry {
        return Seer { position, ct, group_from_observer, bend: Bend::Light(of_observer) };
    }
    let pose = animated.as_seen(observer, false);
    let body_from_world = pose.world_from_body.inverse();
    let object = Aberration::new(animated.celerity(&pose));
    let bend = Bend::Pose { observer: of_observer, object, body_from_world: body_from_world.matrix3 };
    Seer { position: body_from_world.transform_point3(position), ct, group_from_observer, bend }
}

impl Swept {
    fn of(scene: &Scene, motion: Option<usize>, animated: &Arc<Animated>) -> Self {
        let places = || {
            let meshes = scene.meshes.iter().filter(|mesh| mesh.motion == motion);
            meshes.flat_map(|mesh| &mesh.positions).filter(|place| place.is_finite()).map(|place| place.as_dvec3())
        };
        let bounds = (DVec3::INFINITY, DVec3::NEG_INFINITY);
        let (low, high) = places().fold(bounds, |(low, high), place| (low.min(place), high.max(place)));
        let centre = if low.is_finite() { 0.5 * (low + high) } else { DVec3::ZERO };
        let radius = places().map(|place| place.distance(centre)).fold(0.0, f64::max);
        let ball = Ball { centre, radius };
        // Only the radius matters, so the ball is taken about the body's own origin.
        let world_radius = animated.stretch() * radius;
        Self { animated: Arc::clone(animated), ball, world_radius, reach: animated.reach(ball) }
    }
}

impl Hierarchy {
    /// Sorts the triangles of the wanted meshes. `margin` is the width added to their boxes, metres.
    fn of(scene: &Scene, margin: f64, wanted: impl Fn(usize) -> bool) -> Self {
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
        let boxes: Vec<Aabb> = triangles.iter().map(|triangle| around(triangle.points, margin)).collect();
        Self { triangles, boxes: Bvh::from_leaves(BvhBuildStrategy::Binned, &boxes) }
    }

    /// Nearest hit beyond `after`. If `clear_glass` is true, the inner side of glass counts too.
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

    /// Nearest hit beyond `after` on the curve of a ray in an animated body's frame, and D from there. The distance
    /// is that in the world.
    fn first_on_curve(
        &self,
        swept: &Swept,
        sight: &Sight,
        line: &Line,
        after: f64,
        is_there: impl Fn(&Hit) -> bool,
    ) -> Option<(Hit, f64)> {
        let Swept { animated, ball, world_radius, reach } = swept;
        let curve = Curve { animated, observer: &sight.observer, direction: line.direction };
        let hit = curve.first(after, ball, *world_radius, reach, |chord| {
            let [from, to] = chord.ends;
            let [first, last] = chord.span;
            let share = (to - from).length() / (last - first);
            let meet = |index: u32| {
                let triangle = &self.triangles[index as usize];
                let hit = triangle.meet_curve(&curve, chord)?;
                (hit.distance > after && (hit.front || triangle.double_sided) && is_there(&hit)).then_some(hit)
            };
            let direction = (to - from).try_normalize()?;
            let (index, _) =
                self.cast(from, direction, |index| meet(index).map(|hit| ((hit.distance - first) * share).max(0.0)))?;
            meet(index)
        })?;
        let pose = animated.at(sight.observer.event.ct - hit.distance);
        let sent = Beta::new(pose.beta(hit.position)).map(Beta::celerity).unwrap_or_default();
        let doppler = line.doppler / Aberration::new(sent).observer_from_world(line.direction).1;
        Some((hit, doppler))
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
    /// Hit of a ray with the triangle. Triangles that share an edge agree to the last bit on the side of it on which
    /// the ray passes.
    ///
    /// *Equation:* the signed volumes of the direction with each edge, seen from the beginning of the ray, d·(b × c)
    /// and so on, are the shares of the corners.
    fn meet(&self, from: DVec3, direction: DVec3) -> Option<Hit> {
        let (weights, away, front) = self.shares(from, direction)?;
        let distance = away.dot(direction);
        let hit = Hit {
            mesh: self.mesh,
            corners: self.corners,
            weights,
            position: from + away,
            distance,
            plane: self.plane(),
            front,
        };
        (distance > 0.0).then_some(hit)
    }

    /// Hit of a piece of a curve with the triangle, computed by the tangent at the point of contact.
    fn meet_curve(&self, curve: &Curve<'_>, chord: &Chord) -> Option<Hit> {
        let distance = curve.crosses(chord, self.points)?;
        let (position, rate) = curve.at(distance);
        let direction = rate.normalize_or_zero();
        let size = self.points[0].distance(self.points[1]).max(self.points[0].distance(self.points[2]));
        let (weights, _, front) = self.shares(position - direction * size, direction)?;
        let plane = self.plane();
        Some(Hit { mesh: self.mesh, corners: self.corners, weights, position, distance, plane, front })
    }

    fn plane(&self) -> DVec3 {
        let [a, b, c] = self.points;
        (b - a).cross(c - a)
    }

    /// Shares of the corners where a line passes, the vector from its beginning to that point, and true if the line
    /// comes from the front.
    fn shares(&self, from: DVec3, direction: DVec3) -> Option<([f64; 3], DVec3, bool)> {
        let [a, b, c] = self.points.map(|point| point - from);
        let volumes = [b.cross(c), c.cross(a), a.cross(b)].map(|area| area.dot(direction));
        let within = volumes.iter().all(|&volume| volume >= 0.0) || volumes.iter().all(|&volume| volume <= 0.0);
        let sum: f64 = volumes.iter().sum();
        if !within || sum == 0.0 {
            return None;
        }
        let weights = volumes.map(|volume| volume / sum);
        let away = a * weights[0] + b * weights[1] + c * weights[2];
        Some((weights, away, sum < 0.0))
    }
}

fn around([a, b, c]: [DVec3; 3], margin: f64) -> Aabb {
    let (low, high) = (a.min(b).min(c), a.max(b).max(c));
    let margin = DVec3::splat(margin + MARGIN * (1.0 + low.abs().max(high.abs()).max_element()));
    Aabb::new(vector(low - margin), vector(high + margin))
}

fn vector(v: DVec3) -> Vector {
    Vector::new(v.x, v.y, v.z)
}
