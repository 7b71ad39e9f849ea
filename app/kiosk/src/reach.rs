//! Reach of a kiosk: the ball within which a visitor finds the scene again.

use glam::DVec3;

/// Largest distance from the scene's middle, in radii of the scene. From there the whole of it is less than four
/// degrees wide.
const RADII: f64 = 30.0;

/// Ball within which a visitor finds the scene again, and the visitor's way out of it.
#[derive(Clone, Copy, Debug)]
pub struct Reach {
    /// Middle of the scene, world metres.
    middle: DVec3,
    /// Radius of the ball, metres.
    radius_m: f64,
    /// True once the vehicle has been seen within it since the ride began. Until it is put to the start, it is where
    /// the ride before has left it.
    within: bool,
}

impl Reach {
    /// Reach round a scene, given by the middle and the radius of its extent; `None` for a scene without one. A
    /// start outside the scene widens it.
    pub fn new(middle: DVec3, radius_m: f64, start: DVec3) -> Option<Self> {
        let radius_m = RADII * radius_m.max(if radius_m > 0.0 { middle.distance(start) } else { 0.0 });
        (radius_m > 0.0 && radius_m.is_finite()).then_some(Self { middle, radius_m, within: false })
    }

    /// Notes that a ride begins.
    pub fn begin(&mut self) {
        self.within = false;
    }

    /// Distance from the scene's middle, metres, if the vehicle at `position` has just left the ball.
    pub fn left_at(&mut self, position: DVec3) -> Option<f64> {
        let distance_m = self.middle.distance(position);
        if distance_m <= self.radius_m {
            self.within = true;
            return None;
        }
        std::mem::take(&mut self.within).then_some(distance_m)
    }
}

#[cfg(test)]
mod tests {
    //! Law: whoever leaves the ball is told of once a ride; scenes of sky have no ball, and no start lies outside it.

    use super::*;

    #[test]
    fn a_vehicle_leaves_once_a_ride() {
        let mut reach = Reach::new(DVec3::X, 2.0, DVec3::ZERO).unwrap();
        // Where the ride before has ended.
        assert_eq!(reach.left_at(DVec3::X * 900.0), None);
        assert_eq!(reach.left_at(DVec3::ZERO), None);
        assert_eq!(reach.left_at(DVec3::X * 61.0), None);
        assert_eq!(reach.left_at(DVec3::X * 62.0), Some(61.0));
        assert_eq!(reach.left_at(DVec3::X * 63.0), None);
        reach.begin();
        assert_eq!(reach.left_at(DVec3::X * 64.0), None);
        assert_eq!(reach.left_at(DVec3::ZERO), None);
        assert_eq!(reach.left_at(DVec3::NEG_X * 60.0), Some(61.0));
    }

    #[test]
    fn a_start_far_from_a_small_scene_is_within_reach() {
        let start = DVec3::Z * 1e6;
        let mut reach = Reach::new(DVec3::ZERO, 1.0, start).unwrap();
        assert_eq!(reach.left_at(start), None);
        assert_eq!(reach.left_at(start * 31.0), Some(31e6));
    }

    #[test]
    fn sky_has_no_reach() {
        assert!(Reach::new(DVec3::ZERO, 0.0, DVec3::Z).is_none());
        assert!(Reach::new(DVec3::ZERO, f64::INFINITY, DVec3::Z).is_none());
    }
}
