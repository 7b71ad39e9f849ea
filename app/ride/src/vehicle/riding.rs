//! Steps of a bicycle and a car on the ground, in strides shorter than any wall is thick.

use glam::DVec3;
use input::VehicleKind;
use physics::Celerity;
use scene::{Surroundings, Wall};

use super::bicycle::BicycleControl;
use super::flight::FlightControl;
use super::footing::Footing;
use super::ground::{GroundCourse, heading, upright};
use super::notice::Notice;
use super::safe_controls::SafeControls;
use super::vehicle::Vehicle;
use super::walls::{self, MOST_STRIDES};

/// Sine of a slope steeper than any road.
const STEEPEST_ROAD: f64 = 0.9;

/// Stride before its end is made clear of walls.
struct StrideWay {
    /// Place of its beginning.
    before: DVec3,
    /// Wall nearest to that.
    wall: Option<Wall>,
    /// Length that is free, metres.
    free_m: f64,
    /// Time of the step from there on, seconds.
    left_s: f64,
}

impl Vehicle {
    /// Takes one piece of a step on the ground, in strides shorter than any wall is thick.
    pub(super) fn ride(&mut self, own_s: f64, controls: &SafeControls, surroundings: &dyn Surroundings) {
        let mut left_s = own_s;
        let mut wall = walls::nearest(surroundings, self.state.position, self.distance_m(own_s));
        for stride in 1.. {
            self.keep_clear(wall, left_s);
            // The stride goes as far as the space is free, or to the end of the step.
            let free_m = walls::stride_m(wall, self.distance_m(left_s));
            if stride == MOST_STRIDES && self.distance_m(left_s) > free_m {
                self.state.celerity = walls::slowed(self.state.celerity, free_m, left_s, self.light_speed);
                self.tell(Notice::HeldByWalls);
            }
            let distance_m = self.distance_m(left_s);
            let span_s = if distance_m > free_m { left_s * (free_m / distance_m) } else { left_s };

            let before = self.state.position;
            self.drive_on(span_s, controls, surroundings);
            self.hold_back(before, wall, free_m, span_s);
            let way = StrideWay { before, wall, free_m, left_s };
            match self.ended(&way, surroundings) {
                Some(wall_there) => wall = wall_there,
                None => {
                    self.state.position = before;
                    self.state.celerity = Celerity::ZERO;
                }
            }
            if span_s >= left_s || stride == MOST_STRIDES {
                return;
            }
            left_s -= span_s;
        }
    }

    /// Ends a stride clear of walls and on the ground, and returns the nearest wall there. `None` if no such end is
    /// found to which the stride leads through no wall.
    fn ended(&mut self, way: &StrideWay, surroundings: &dyn Surroundings) -> Option<Option<Wall>> {
        let wall = self.cleared(way, surroundings)?;
        if self.settings.keeps_to_ground && self.keep_footing(way.before, surroundings) {
            // At another height, there are other walls.
            let wall = walls::nearest(surroundings, self.state.position, self.distance_m(way.left_s));
            return if walls::is_too_near(way.wall, wall) { self.cleared(way, surroundings) } else { Some(wall) };
        }
        Some(wall)
    }

    /// Moves the end of a stride clear of walls, and returns the nearest wall there.
    fn cleared(&mut self, way: &StrideWay, surroundings: &dyn Surroundings) -> Option<Option<Wall>> {
        let reach_m = self.distance_m(way.left_s);
        let (end, wall) = walls::settled(surroundings, way.wall, self.state.position, reach_m)?;
        if self.settings.keeps_to_ground && !walls::leads_through_none(way.wall, end - way.before, way.free_m) {
            return None;
        }
        self.state.position = end;
        Some(wall)
    }

    /// Holds the vehicle to the ground that it was on before a stride. True if that has moved it.
    fn keep_footing(&mut self, before: DVec3, surroundings: &dyn Surroundings) -> bool {
        let footing = Footing::of(surroundings, before, self.state.position);
        self.at_edge = matches!(footing, Footing::Edge(_));
        match footing {
            Footing::Free => return false,
            Footing::Level(position) => {
                let celerity = self.state.celerity.vector();
                let level = DVec3 { y: 0.0, ..celerity }.normalize_or_zero() * celerity.length();
                self.state.position = position;
                self.state.celerity = Celerity::new(level).unwrap_or(Celerity::ZERO);
                self.state.orientation = upright(heading(self.state.orientation));
                self.constrain();
            }
            Footing::Edge(position) => {
                self.state.position = position;
                self.state.celerity = Celerity::ZERO;
            }
        }
        true
    }

    /// Takes one stride on the ground, without regard to walls.
    fn drive_on(&mut self, own_s: f64, controls: &SafeControls, surroundings: &dyn Surroundings) {
        let (direction, backward) = self.road_direction();
        let course = GroundCourse::ahead(surroundings, self.state.position, direction, self.distance_m(own_s));
        let settings = self.settings;
        if self.kind == VehicleKind::Drive {
            self.resistance = 0.0;
            self.integrate(own_s, &FlightControl::new(&settings.flight, self.light_speed, controls, Some(course)));
        } else {
            let course = if backward { course.reversed() } else { course };
            let forward = self.forward();
            let control =
                BicycleControl::new(&settings.bicycle, self.light_speed, controls, course, self.blocked, forward);
            self.resistance = control.resistance(forward);
            self.integrate(own_s, &control);
        }
        self.constrain();
    }

    /// Removes the excess of celerity into the wall. A car slides along the wall. A bicycle's frame has to be turned
    /// first, and it turns while the bicycle rolls.
    fn keep_clear(&mut self, wall: Option<Wall>, own_s: f64) {
        let celerity = self.state.celerity.vector();
        let wall = wall.filter(|wall| walls::excess(wall, celerity, self.light_speed) > 0.0);
        self.blocked = wall.is_some() || self.at_edge;
        let Some(wall) = wall else { return };
        let slid = walls::slid(&wall, celerity, self.light_speed);
        let kept = if self.kind == VehicleKind::Bicycle {
            let rolled_m = self.light_speed.metres_per_own_second(slid.length()) * own_s;
            let angle_rad = (rolled_m / walls::DEFLECTION_RADIUS_M).min(walls::FASTEST_DEFLECTION_RAD_S * own_s);
            let motion = turned_towards(celerity, slid, angle_rad);
            self.state.orientation = upright(if self.forward() < 0.0 { -motion } else { motion });
            motion * walls::limited_along(&wall, motion, slid.length(), self.light_speed)
        } else {
            slid
        };
        self.state.celerity = Celerity::new(kept).unwrap_or(Celerity::ZERO);
    }

    /// Celerity along the nose.
    fn forward(&self) -> f64 {
        self.state.celerity.vector().dot(self.state.orientation * DVec3::NEG_Z)
    }

    /// Unit vector of the motion, or of the nose at rest or on a slope steeper than any road; and true if the motion
    /// is backward.
    fn road_direction(&self) -> (DVec3, bool) {
        let backward = self.forward() < 0.0;
        let nose = heading(self.state.orientation);
        let motion = self.state.celerity.direction().unwrap_or(nose);
        (if motion.y.abs() < STEEPEST_ROAD { motion } else { nose }, backward)
    }

    /// Takes back the part of a stride that thrust has made longer than the space that is free.
    fn hold_back(&mut self, before: DVec3, wall: Option<Wall>, free_m: f64, span_s: f64) {
        let free_m = if wall.is_some() { free_m } else { free_m.max(walls::FREE_M) };
        let moved = self.state.position - before;
        if self.settings.keeps_to_ground && moved.length() > free_m {
            self.state.position = before + moved * (free_m / moved.length());
            self.state.celerity = walls::slowed(self.state.celerity, free_m, span_s, self.light_speed);
            self.tell(Notice::HeldByWalls);
        }
    }

    /// Distance covered in a time at the present celerity, metres of road.
    fn distance_m(&self, own_s: f64) -> f64 {
        self.light_speed.metres(own_s) * self.state.celerity.magnitude()
    }
}

/// Unit vector along `from`, turned towards `to` by `angle_rad`, but not beyond it.
fn turned_towards(from: DVec3, to: DVec3, angle_rad: f64) -> DVec3 {
    let from = from.normalize_or_zero();
    let Some(to) = to.try_normalize() else { return from };
    let Some(across) = (to - from * from.dot(to)).try_normalize() else { return from };
    let angle_rad = angle_rad.min(from.angle_between(to));
    from * libm::cos(angle_rad) + across * libm::sin(angle_rad)
}
