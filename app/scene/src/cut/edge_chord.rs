//! Edges of animated bodies as drawn, and their errors, estimated from samples.

use glam::DVec3;
use physics::DirectionCone;

use crate::motion::SeenPoint;

/// Edge of an animated body as drawn: a straight line between its ends' apparent positions.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct EdgeChord {
    /// Largest angle by which a place of the edge, or of a triangle's inside, is drawn wrongly, radians, estimated
    /// from samples.
    pub error_rad: f64,
    /// Interpolation error of log2 D at the middle.
    pub error_log2_doppler: f64,
    /// Cone about the direction in which the middle is seen, observer's axes, that holds all triangles of which this is
    /// the longest edge.
    pub cone: DirectionCone,
    /// Angle between its ends, radians.
    pub length_rad: f64,
}

/// Bound of the error inside of a triangle, for an error of at most 1 on its edges: four ninths of three edges.
const INSIDE: f64 = 4.0 / 3.0;

/// Length in radians above which chords are sampled in their quarters too: the error of the middle alone may happen
/// to vanish.
const LONG_RAD: f64 = 0.02;

impl EdgeChord {
    /// EdgeChord of an edge; `seen` says how each of its places is seen. The result is the same from either end. `None`
    /// if an end or a sampled place is not seen. An edge seen under an angle of at most `small` is not sampled
    /// further.
    pub fn of(seen: impl Fn(DVec3) -> Option<SeenPoint>, [a, b]: [DVec3; 2], small: f64) -> Option<Self> {
        let middle = 0.5 * a + 0.5 * b;
        let (from, to) = (seen(a)?, seen(b)?);
        let straight = |share: f64| from.apparent * (1.0 - share) + to.apparent * share;
        let length_rad = angle(from.apparent, to.apparent);
        let mut chord = Self {
            error_rad: 0.0,
            error_log2_doppler: 0.0,
            cone: DirectionCone { axis: straight(0.5).normalize_or_zero(), radius_rad: length_rad },
            length_rad,
        };
        if length_rad <= small {
            return Some(chord);
        }
        let halfway = seen(middle)?;
        chord.cone.axis = halfway.apparent.normalize_or_zero();
        chord.error_rad = angle(halfway.apparent, straight(0.5));
        chord.error_log2_doppler = (halfway.doppler.log2() - 0.5 * (from.doppler.log2() + to.doppler.log2())).abs();
        let mut radius = angle(chord.cone.axis, from.apparent).max(angle(chord.cone.axis, to.apparent));
        if length_rad > LONG_RAD {
            for (share, place) in [(0.25, 0.5 * a + 0.5 * middle), (0.75, 0.5 * middle + 0.5 * b)] {
                let quarter = seen(place)?;
                chord.error_rad = chord.error_rad.max(angle(quarter.apparent, straight(share)));
                radius = radius.max(angle(chord.cone.axis, quarter.apparent));
            }
        }
        chord.error_rad *= INSIDE;
        chord.cone.radius_rad = 2.0 * radius;
        Some(chord)
    }
}

fn angle(a: DVec3, b: DVec3) -> f64 {
    a.cross(b).length().atan2(a.dot(b))
}
