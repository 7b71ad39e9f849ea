//! How an observer sees what rests in one frame, or what is animated.

use glam::{DQuat, DVec3};
use physics::bend::Bend;
use physics::{Celerity, Observer};

use crate::scene::Scene;
use crate::motion::{Course, Motion, Seen};

/// How an observer sees what rests in one frame, or what is animated.
#[derive(Clone, Debug)]
pub struct Sight {
    /// Which directions bend.
    pub bend: Bend,
    /// The observer, relative to the scene's origin; in the world, of what is animated.
    pub place: DVec3,
    /// From the axes in which apparent positions are to the observer's own.
    pub observer_from_group: DQuat,
    /// Of what is animated.
    pub course: Option<Course>,
}

/// How an edge of an animated body is drawn: straight between its ends' apparent positions.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Chord {
    /// By what angle any of its places is drawn wrongly, as far as looks at some of them tell; and inside of triangles.
    pub error_rad: f64,
    /// By how much log2 D is interpolated wrongly.
    pub error_log2_doppler: f64,
    /// Where its middle is seen: unit vector, observer's axes.
    pub direction: DVec3,
    /// Half the angle of a cone about that, in which all triangles lie of which it is the longest edge.
    pub radius_rad: f64,
    /// The angle between its ends.
    pub length_rad: f64,
}

/// Inside of a triangle of which no edge is off by more than 1 a place is off by no more than this: four ninths of three edges.
const INSIDE: f64 = 4.0 / 3.0;

/// Chords longer than this, in radians, are looked at in their quarters too: the error of the middle alone may happen to vanish.
const LONG_RAD: f64 = 0.02;

impl Sight {
    /// Of what rests in the world, or moves as said.
    pub fn new(scene: &Scene, observer: &Observer, motion: Option<usize>) -> Self {
        Self::of(scene.origin, &scene.motions, observer, motion)
    }

    /// The same by what of the scene counts.
    pub fn of(origin: DVec3, motions: &[Motion], observer: &Observer, motion: Option<usize>) -> Self {
        let rest = |position: DVec3, celerity: Celerity, turn| Self {
            bend: Bend::new(celerity),
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

    /// Where a place of a mesh is from the observer, in the frame in which it rests; of what is animated, in the world, when its light leaves.
    pub fn towards(&self, place: DVec3) -> DVec3 {
        match &self.course {
            None => place - self.place,
            Some(course) => {
                let nowhere = DVec3::splat(f64::NAN);
                course.seen(place).map_or(nowhere, |seen| seen.event.position - course.observer().event.position)
            }
        }
    }

    /// Where a place of a mesh appears, relative to the observer, in his axes; not finite where that is nowhere.
    pub fn apparent(&self, place: DVec3) -> DVec3 {
        self.observer_from_group * self.bend.apparent(self.towards(place))
    }
}

impl Chord {
    /// Of an edge whose ends, middle and quarters are seen as said; the same from either end. `None` where one of them is not seen. `small`: an
    /// edge that is seen under no larger angle is not looked at further.
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
