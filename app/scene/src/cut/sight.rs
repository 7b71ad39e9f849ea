//! Sights: how an observer sees the resting scene, a uniformly moving frame or an animated body.

use glam::{DQuat, DVec3};
use physics::interpolation_error::TriangleInterpolation;
use physics::{Celerity, Observer};

use crate::motion::{Course, Motion, Seen};
use crate::scene::Scene;

/// Sight: how one observer sees meshes that rest in one frame, or an animated body.
#[derive(Clone, Debug)]
pub struct Sight {
    /// Bending of directions by aberration.
    pub bend: TriangleInterpolation,
    /// Position of the observer relative to the scene's origin, metres, in the meshes' rest frame; for animated
    /// bodies in the world.
    pub place: DVec3,
    /// Rotation from the axes of apparent positions in that frame to the observer's own.
    pub observer_from_group: DQuat,
    /// Animated body and its observer; `None` for resting and uniformly moving meshes.
    pub course: Option<Course>,
}

/// Edge of an animated body as drawn: a straight line between its ends' apparent positions.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Chord {
    /// Largest angle by which a place of the edge, or of a triangle's inside, is drawn wrongly, radians, estimated
    /// from samples.
    pub error_rad: f64,
    /// Interpolation error of log2 D at the middle.
    pub error_log2_doppler: f64,
    /// Direction in which the middle is seen: unit vector, observer's axes.
    pub direction: DVec3,
    /// Half-angle, radians, of a cone about that direction that holds all triangles of which this is the longest
    /// edge.
    pub radius_rad: f64,
    /// Angle between its ends, radians.
    pub length_rad: f64,
}

/// Bound of the error inside of a triangle, for an error of at most 1 on its edges: four ninths of three edges.
const INSIDE: f64 = 4.0 / 3.0;

/// Length in radians above which chords are sampled in their quarters too: the error of the middle alone may happen
/// to vanish.
const LONG_RAD: f64 = 0.02;

impl Sight {
    /// View of the resting scene (`None`) or of motion `motion`.
    pub fn new(scene: &Scene, observer: &Observer, motion: Option<usize>) -> Self {
        Self::of(scene.origin, &scene.motions, observer, motion)
    }

    /// View of the resting scene (`None`) or of a motion, from the scene's origin and its motions alone.
    pub fn of(origin: DVec3, motions: &[Motion], observer: &Observer, motion: Option<usize>) -> Self {
        let rest = |position: DVec3, celerity: Celerity, turn| Self {
            bend: TriangleInterpolation::new(celerity),
            place: position - origin,
            observer_from_group: turn,
            course: None,
        };
        match motion.map(|motion| &motions[motion]) {
            Some(Motion::Uniform(uniform)) => {
                let seen = uniform.seen_by(observer);
                rest(seen.position, seen.celerity, seen.observer_from_group)
            }
            Some(Motion::Animated(animated)) => Self {
                course: Some(Course::new(animated, observer)),
                ..rest(observer.event.position, observer.celerity, DQuat::IDENTITY)
            },
            None => rest(observer.event.position, observer.celerity, DQuat::IDENTITY),
        }
    }

    /// Position of a mesh's place relative to the observer, metres, in the frame in which the mesh rests. For an
    /// animated body: its retarded position in the world, or NaN if there is none.
    pub fn towards(&self, place: DVec3) -> DVec3 {
        match &self.course {
            None => place - self.place,
            Some(course) => {
                let nowhere = DVec3::splat(f64::NAN);
                course.seen(place).map_or(nowhere, |seen| seen.event.position - course.observer().event.position)
            }
        }
    }

    /// Apparent position of a mesh's place relative to the observer, observer's axes, metres; not finite if there is
    /// none.
    pub fn apparent(&self, place: DVec3) -> DVec3 {
        self.observer_from_group * self.bend.apparent(self.towards(place))
    }
}

impl Chord {
    /// Chord of an edge; `seen` says how each of its places is seen. The result is the same from either end. `None`
    /// if an end or a sampled place is not seen. An edge seen under an angle of at most `small` is not sampled
    /// further.
    pub fn of(seen: impl Fn(DVec3) -> Option<Seen>, [a, b]: [DVec3; 2], small: f64) -> Option<Self> {
        let middle = 0.5 * a + 0.5 * b;
        let (from, to) = (seen(a)?, seen(b)?);
        let straight = |share: f64| from.apparent * (1.0 - share) + to.apparent * share;
        let length_rad = angle(from.apparent, to.apparent);
        let mut chord = Self {
            error_rad: 0.0,
            error_log2_doppler: 0.0,
            direction: straight(0.5).normalize_or_zero(),
            radius_rad: length_rad,
            length_rad,
        };
        if length_rad <= small {
            return Some(chord);
        }
        let halfway = seen(middle)?;
        chord.direction = halfway.apparent.normalize_or_zero();
        chord.error_rad = angle(halfway.apparent, straight(0.5));
        chord.error_log2_doppler = (halfway.doppler.log2() - 0.5 * (from.doppler.log2() + to.doppler.log2())).abs();
        let mut radius = angle(chord.direction, from.apparent).max(angle(chord.direction, to.apparent));
        if length_rad > LONG_RAD {
            for (share, place) in [(0.25, 0.5 * a + 0.5 * middle), (0.75, 0.5 * middle + 0.5 * b)] {
                let quarter = seen(place)?;
                chord.error_rad = chord.error_rad.max(angle(quarter.apparent, straight(share)));
                radius = radius.max(angle(chord.direction, quarter.apparent));
            }
        }
        chord.error_rad *= INSIDE;
        chord.radius_rad = 2.0 * radius;
        Some(chord)
    }
}

fn angle(a: DVec3, b: DVec3) -> f64 {
    a.cross(b).length().atan2(a.dot(b))
}
