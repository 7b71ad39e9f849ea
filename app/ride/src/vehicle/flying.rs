//! Steps of a flight, in strides in which no surface can be reached.

use physics::Celerity;
use scene::Surroundings;

use super::flight::FlightControl;
use super::hull::Hull;
use super::notice::Notice;
use super::safe_controls::SafeControls;
use super::vehicle::Vehicle;
use super::walls::{self, MOST_STRIDES};

impl Vehicle {
    /// Takes one piece of a step in flight, in strides in which no surface can be reached.
    pub(super) fn fly(&mut self, own_s: f64, controls: &SafeControls, surroundings: &dyn Surroundings) {
        self.resistance = 0.0;
        let hull = Hull { radius_m: self.settings.flight.hull_m };
        if hull.radius_m == 0.0 {
            return self.fly_on(own_s, controls);
        }
        let mut left_s = own_s;
        let mut surface = hull.nearest(surroundings, self.state.position, self.farthest_m(own_s));
        for stride in 1..=MOST_STRIDES {
            let celerity = self.state.celerity.vector();
            let slid = surface.map_or(celerity, |surface| hull.slid(&surface, celerity, self.light_speed));
            if slid != celerity {
                self.state.celerity = Celerity::new(slid).unwrap_or(Celerity::ZERO);
            }
            let farthest_m = self.farthest_m(left_s);
            let free_m = hull.stride_m(surface, farthest_m);
            let is_last = stride == MOST_STRIDES || farthest_m <= free_m;
            let span_s = if is_last { left_s } else { left_s * (free_m / farthest_m) };

            let before = self.state.position;
            self.fly_on(span_s, controls);
            if surface.is_none() {
                return;
            }
            let moved = self.state.position - before;
            if moved.length() > free_m {
                self.state.position = before + hull.held(surface, moved * (free_m / moved.length()));
                self.state.celerity = walls::slowed(self.state.celerity, free_m, span_s, self.light_speed);
                self.tell(Notice::HeldByWalls);
            }
            let end = self.state.position;
            match hull.landed(surroundings, surface, end, self.state.celerity, self.farthest_m(left_s)) {
                Some(landing) => {
                    self.state.position = landing.position;
                    if landing.celerity != self.state.celerity.vector() {
                        self.state.celerity = Celerity::new(landing.celerity).unwrap_or(Celerity::ZERO);
                    }
                    surface = landing.surface;
                }
                None => {
                    self.state.position = before;
                    self.state.celerity = Celerity::ZERO;
                }
            }
            if is_last {
                return;
            }
            left_s -= span_s;
        }
    }

    /// Largest distance that a flight may cover in a time, metres, whatever the controls do.
    fn farthest_m(&self, own_s: f64) -> f64 {
        /// Largest proper acceleration, in full thrusts: three thrusts, two of the brake, the rudder and its turn.
        const THRUSTS: f64 = 8.0;
        let gain = THRUSTS * self.settings.flight.thrust_per_s * own_s;
        let u = self.state.celerity.magnitude();
        let fastest = u * libm::cosh(gain) + libm::hypot(u, 1.0) * libm::sinh(gain);
        self.light_speed.metres(own_s) * fastest
    }

    /// Takes one stride through free space.
    fn fly_on(&mut self, own_s: f64, controls: &SafeControls) {
        let settings = self.settings;
        self.integrate(own_s, &FlightControl::new(&settings.flight, self.light_speed, controls, None));
    }
}
