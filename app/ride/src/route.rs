//! Closed route on the ground: the nearest length along it, the points ahead, and its curvature. Heights are ignored.

use glam::DVec3;

/// Closed polyline, measured along its length.
#[derive(Clone, Debug)]
pub(super) struct Route {
    /// Corners, level; the first one is repeated at the end.
    points: Vec<DVec3>,
    /// Length of the route up to each corner, metres.
    along: Vec<f64>,
}

/// Distance from the expected place beyond which the whole route is searched, metres.
const LOST_M: f64 = 8.0;

impl Route {
    /// Closes the polyline. `None` if it has fewer than three different corners, or one that is not finite.
    pub(super) fn new(corners: &[DVec3]) -> Option<Self> {
        let mut points: Vec<DVec3> = corners.iter().map(|corner| DVec3 { y: 0.0, ..*corner }).collect();
        points.extend(points.first().copied());
        points.dedup();
        if points.len() < 4 || !points.iter().all(|point| point.is_finite()) {
            return None;
        }
        let mut length = 0.0;
        let lengths = points.windows(2).map(|pair| {
            length += pair[0].distance(pair[1]);
            length
        });
        let along: Vec<f64> = std::iter::once(0.0).chain(lengths).collect();
        length.is_finite().then_some(Self { points, along })
    }

    /// Length of one round, metres.
    pub(super) fn length(&self) -> f64 {
        self.along[self.along.len() - 1]
    }

    /// Point at this length, level. The length may count any number of rounds.
    pub(super) fn point(&self, along_m: f64) -> DVec3 {
        let along_m = along_m.rem_euclid(self.length());
        let next = self.along.partition_point(|&corner| corner <= along_m).clamp(1, self.points.len() - 1);
        let (from, to) = (self.along[next - 1], self.along[next]);
        self.points[next - 1].lerp(self.points[next], (along_m - from) / (to - from))
    }

    /// Length at which the route is nearest to `position`, metres. The search prefers lengths close to `before_m`; that
    /// is NaN if no earlier length is known.
    pub(super) fn nearest(&self, position: DVec3, before_m: f64) -> f64 {
        let position = DVec3 { y: 0.0, ..position };
        let near = self.nearest_where(position, |along_m| {
            let apart = (along_m - before_m).rem_euclid(self.length());
            apart.min(self.length() - apart) < LOST_M
        });
        match near {
            Some((along_m, distance_m)) if distance_m < LOST_M => along_m,
            _ => self.nearest_where(position, |_| true).map_or(0.0, |(along_m, _)| along_m),
        }
    }

    /// Length and distance of the nearest point among the admitted lengths.
    fn nearest_where(&self, position: DVec3, admitted: impl Fn(f64) -> bool) -> Option<(f64, f64)> {
        let segments = self.points.windows(2).zip(&self.along);
        let feet = segments.map(|(pair, along_m)| {
            let span = pair[1] - pair[0];
            let share = ((position - pair[0]).dot(span) / span.length_squared()).clamp(0.0, 1.0);
            (along_m + share * span.length(), position.distance(pair[0] + span * share))
        });
        feet.filter(|(along_m, _)| admitted(*along_m)).min_by(|(_, a), (_, b)| a.total_cmp(b))
    }

    /// Curvature of the route at this length, radians per metre: of the circle through this point and the points
    /// `spacing_m` before and after it.
    pub(super) fn curvature(&self, along_m: f64, spacing_m: f64) -> f64 {
        let [a, b, c] = [-spacing_m, 0.0, spacing_m].map(|shift| self.point(along_m + shift));
        let sides = a.distance(b) * b.distance(c) * c.distance(a);
        // Twice the sine of the angle at b, divided by the opposite side.
        if sides > 0.0 { 2.0 * (b - a).cross(c - b).length() / sides } else { 1.0 / spacing_m }
    }
}

#[cfg(test)]
mod tests {
    //! Law under test: a closed route has the length and the curvature of its curve, and the nearest point moves
    //! along it steadily. A wrong program jumps to the other branch at a crossing, or loses a round.
    use super::*;

    fn circle(radius: f64) -> Route {
        let corners: Vec<DVec3> = (0..720)
            .map(|n| {
                let (sine, cosine) = libm::sincos((f64::from(n) / 2.0).to_radians());
                DVec3::new(radius * sine, f64::from(n), radius * cosine)
            })
            .collect();
        Route::new(&corners).unwrap()
    }

    #[test]
    fn a_circle_has_its_length_and_curvature() {
        let route = circle(8.0);
        // A polygon of 720 corners is shorter by (π/720)²/6.
        assert!((route.length() / (std::f64::consts::TAU * 8.0) - 1.0).abs() < 4e-6);
        for along_m in [0.0, 13.0, 50.0] {
            assert!((route.curvature(along_m, 1.5) - 1.0 / 8.0).abs() < 1e-3);
            assert!((route.point(along_m).length() - 8.0).abs() < 1e-3);
        }
    }

    #[test]
    fn rounds_are_counted_on() {
        let route = circle(8.0);
        assert!(route.point(1.0).distance(route.point(1.0 + 3.0 * route.length())) < 1e-9);
        assert!(route.point(-1.0).distance(route.point(route.length() - 1.0)) < 1e-9);
    }

    #[test]
    fn at_a_crossing_the_nearest_point_stays_on_its_branch() {
        // A figure of eight: at the crossing both branches are equally near.
        let corners = [(-10.0, -10.0), (10.0, 10.0), (20.0, 0.0), (10.0, -10.0), (-10.0, 10.0), (-20.0, 0.0)];
        let corners = corners.map(|(x, z)| DVec3::new(x, 0.0, z));
        let route = Route::new(&corners).unwrap();
        let first = 200f64.sqrt();
        let second = 3.0 * first + 2.0 * first;
        for expected in [first, second] {
            let along_m = route.nearest(DVec3::new(0.0, 5.0, 0.0), expected - 1.0);
            assert!((along_m - expected).abs() < 1e-9, "{along_m} instead of {expected}");
        }
        // A position far from the expected one is still found.
        assert!((route.nearest(DVec3::new(21.0, 0.0, 0.0), 0.0) - 3.0 * first).abs() < 1e-9);
        assert!((route.nearest(DVec3::new(-10.0, 0.0, -10.0), f64::NAN)).abs() < 1e-9);
    }

    #[test]
    fn a_route_needs_three_finite_corners() {
        let (a, b) = (DVec3::X, DVec3::Z);
        assert!(Route::new(&[]).is_none());
        assert!(Route::new(&[a, b]).is_none());
        assert!(Route::new(&[a, a, b, b]).is_none());
        assert!(Route::new(&[a, b, DVec3::NAN]).is_none());
    }
}
