//! Odometer: distances and times of a ride, by the world's measure and by the rider's own.

use physics::Celerity;

use super::light_speed::LightSpeed;

/// Distances and times since the start of the ride.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Odometer {
    /// Distance along the road, metres of the world: ∫ |u| c dτ.
    pub road_m: f64,
    /// Distance on the rider's own odometer, metres: the contracted road that went by, ∫ β c dτ.
    pub own_m: f64,
    /// Time on the rider's own clock, seconds.
    pub own_s: f64,
    /// Time on the world's clocks at the rider's place, seconds: ∫ γ dτ.
    pub world_s: f64,
}

impl Odometer {
    /// Adds a step by the trapezoidal rule. Differences of places and times would not do: far from the start, they no
    /// longer resolve a single step.
    pub(super) fn count(&mut self, light_speed: LightSpeed, own_s: f64, from: Celerity, to: Celerity) {
        let mean = |value: fn(Celerity) -> f64| 0.5 * (value(from) + value(to));
        let own_m = light_speed.metres(own_s);
        self.road_m += own_m * mean(Celerity::magnitude);
        self.own_m += own_m * mean(|celerity| celerity.magnitude() / celerity.gamma());
        self.own_s += own_s;
        self.world_s += own_s * mean(Celerity::gamma);
    }
}
