//! How far and how long a ride was, by the road and its clocks and by the rider's own.

use physics::Celerity;

use super::world::World;

/// Sums since the start of the ride.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Odometer {
    /// Distance along the road, metres of the world: ∫ |u| c dτ.
    pub road_m: f64,
    /// Distance on the rider's own odometer, metres: the road that went by as he measures it, contracted, ∫ β c dτ.
    pub own_m: f64,
    /// Time on the rider's own clock, seconds.
    pub own_s: f64,
    /// Time on the world's clocks as he passes them, seconds: ∫ γ dτ.
    pub world_s: f64,
}

impl Odometer {
    /// Adds a step by the trapezoidal rule. Places and times themselves would not do: on a far journey they no longer tell one step from the next.
    pub(super) fn count(&mut self, world: World, own_s: f64, from: Celerity, to: Celerity) {
        let mean = |value: fn(Celerity) -> f64| 0.5 * (value(from) + value(to));
        let own_m = world.metres(own_s);
        self.road_m += own_m * mean(Celerity::magnitude);
        self.own_m += own_m * mean(|celerity| celerity.magnitude() / celerity.gamma());
        self.own_s += own_s;
        self.world_s += own_s * mean(Celerity::gamma);
    }
}
