//! How far and how long a ride was, by the road and its clocks and by the rider's own.

/// Sums since the start of the ride.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Odometer {
    /// Distance along the road, metres of the world: ∫ |dx|.
    pub road_m: f64,
    /// Distance on the rider's own odometer, metres: the road that went by as he measures it, contracted, ∫ β c dτ.
    pub own_m: f64,
    /// Time on the rider's own clock, seconds.
    pub own_s: f64,
    /// Time on the world's clocks as he passes them, seconds: ∫ γ dτ.
    pub world_s: f64,
}
