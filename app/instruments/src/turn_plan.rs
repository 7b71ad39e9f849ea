//! Plan of a journey at constant felt acceleration: when to turn round, and how long it takes on which clock.
//!
//! Motion under a constant proper acceleration a along a line is hyperbolic. With c = 1, lengths in metres and a in
//! 1/m, the celerity u, the Lorentz factor γ and the rapidity η change by
//!
//! ```text
//! Δγ = a Δx      Δu = a Δt      Δη = a Δτ
//! ```
//!
//! (Misner, Thorne, Wheeler, *Gravitation*, § 6.2; W 4.7 for a straight line.) A journey that ends at rest at the
//! distance d, begun with γ₀, thrusts towards the destination over x₁ and against the motion over d − x₁. Both
//! stretches meet at the same γ₁: γ₁ = γ₀ + a x₁ = 1 + a (d − x₁). With b = (γ₀ − 1)/a, the way to stop from the
//! present speed, x₁ = (d − b)/2 and γ₁ − 1 = a (d + b)/2, whether the present motion leads towards the destination or
//! away from it. From rest the turn is half way.

use physics::worldline::Thrust;
use ride::LightSpeed;

/// Standard acceleration of free fall, m/s².
const STANDARD_GRAVITY_M_S2: f64 = 9.806_65;

/// Acceleration that the rider feels, in units of the standard acceleration of free fall: the proper acceleration of
/// the vehicle by the world's metres and the rider's own seconds.
pub fn felt_g(thrust: &Thrust, light_speed: LightSpeed) -> f64 {
    let c = light_speed.speed_of_light_m_s();
    thrust.acceleration.length() * c * c / STANDARD_GRAVITY_M_S2
}

/// Journey that ends at rest, from the present moment on.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct PlannedJourney {
    /// Distance to the destination along the line of flight, metres of the world, positive ahead.
    pub distance_m: f64,
    /// Present celerity towards the destination; negative away from it.
    pub celerity: f64,
    /// Felt acceleration that is kept up, m/s².
    pub acceleration_m_s2: f64,
    /// Speed of light in the world.
    pub light_speed: LightSpeed,
}

/// Answer of the planner.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum TurnPlan {
    /// Thrust on, turn round, and arrive at rest.
    Turn {
        /// World's distance until the turn, metres; negative if the turn lies behind, after a flight away.
        turn_m: f64,
        /// Own time until the turn, seconds.
        turn_own_s: f64,
        /// Own time until arrival, seconds.
        own_s: f64,
        /// World's time until arrival, seconds.
        world_s: f64,
        /// Lorentz factor at the turn, the largest of the journey.
        gamma: f64,
    },
    /// Too fast to stop there, even if thrust is reversed now.
    Overshoot {
        /// Distance beyond the destination at which the vehicle stops, metres.
        beyond_m: f64,
        /// Own time until it stops, seconds.
        own_s: f64,
        /// World's time until it stops, seconds.
        world_s: f64,
    },
}

impl PlannedJourney {
    /// Plan of the journey; `None` if a number is not finite, or there is no acceleration.
    pub fn plan(&self) -> Option<TurnPlan> {
        let c = self.light_speed.speed_of_light_m_s();
        // Proper acceleration in 1/m; all lengths are metres, all times metres of light travel.
        let a = self.acceleration_m_s2 / (c * c);
        let is_sound = self.distance_m.is_finite() && self.celerity.is_finite() && a.is_finite() && a > 0.0;
        if !is_sound {
            return None;
        }
        // A destination behind is one ahead for a flight the other way.
        let (d, u) =
            if self.distance_m < 0.0 { (-self.distance_m, -self.celerity) } else { (self.distance_m, self.celerity) };
        // γ − 1 without cancellation.
        let excess = u * u / (1.0 + u.hypot(1.0));
        let stop_m = excess / a;
        let rapidity = u.asinh();
        let seconds = |metres: f64| self.light_speed.seconds(metres);
        let plan = if u > 0.0 && stop_m > d {
            let (own_s, world_s) = (seconds(rapidity / a), seconds(u / a));
            TurnPlan::Overshoot { beyond_m: stop_m - d, own_s, world_s }
        } else {
            let excess_at_turn = 0.5 * a * (d + stop_m);
            let u_at_turn = (excess_at_turn * (excess_at_turn + 2.0)).sqrt();
            let rapidity_at_turn = u_at_turn.asinh();
            TurnPlan::Turn {
                turn_m: 0.5 * (d - stop_m),
                turn_own_s: seconds((rapidity_at_turn - rapidity) / a),
                own_s: seconds((2.0 * rapidity_at_turn - rapidity) / a),
                world_s: seconds((2.0 * u_at_turn - u) / a),
                gamma: 1.0 + excess_at_turn,
            }
        };
        plan.is_finite().then_some(plan)
    }
}

impl TurnPlan {
    fn is_finite(&self) -> bool {
        match *self {
            Self::Turn { turn_m, turn_own_s, own_s, world_s, gamma } => {
                [turn_m, turn_own_s, own_s, world_s, gamma].iter().all(|number| number.is_finite())
            }
            Self::Overshoot { beyond_m, own_s, world_s } => {
                [beyond_m, own_s, world_s].iter().all(|number| number.is_finite())
            }
        }
    }
}

#[cfg(test)]
mod tests {
    //! Law: a vehicle that is integrated along the plan arrives at rest, there and then. A wrong program plans with
    //! Newton's formulas, or turns half way although it has been moving already.

    use super::*;
    use physics::glam::{DQuat, DVec3};
    use physics::worldline::{Exact, WorldlineState, travel};
    use physics::{Celerity, Event};

    fn journey(distance_m: f64, celerity: f64, acceleration_m_s2: f64, c: f64) -> PlannedJourney {
        PlannedJourney { distance_m, celerity, acceleration_m_s2, light_speed: LightSpeed::new(c).unwrap() }
    }

    /// State at the end of a journey that is flown as planned.
    fn flown(journey: &PlannedJourney) -> (WorldlineState, TurnPlan) {
        let plan = journey.plan().unwrap();
        let TurnPlan::Turn { turn_own_s, own_s, .. } = plan else { panic!("{plan:?}") };
        let c = journey.light_speed.speed_of_light_m_s();
        let thrust = |sign: f64| Thrust {
            acceleration: DVec3::X * sign * journey.acceleration_m_s2 / (c * c),
            turn_rate: DVec3::ZERO,
        };
        let celerity = Celerity::new(DVec3::X * journey.celerity).unwrap();
        let start = WorldlineState::new(Event::default(), celerity, DQuat::IDENTITY);
        let sign = if journey.distance_m < 0.0 { -1.0 } else { 1.0 };
        let turn = travel(&Exact, &start, turn_own_s * c, f64::MAX, &thrust(sign)).unwrap();
        (travel(&Exact, &turn, (own_s - turn_own_s) * c, f64::MAX, &thrust(-sign)).unwrap(), plan)
    }

    #[test]
    fn a_flight_by_the_plan_arrives_at_rest_on_time() {
        for (d, u, a, c) in [
            (100.0, 0.0, 2.0, 8.0),
            (100.0, 0.75, 2.0, 8.0),
            (40.0, -0.75, 2.0, 8.0),
            (-40.0, 0.75, 2.0, 8.0),
            (0.0, -2.0, 5.0, 30.0),
            (1e16, 0.0, 9.80665, 299_792_458.0),
            (1e3, 0.0, 1e3, 1.0),
        ] {
            let journey = journey(d, u, a, c);
            let (end, plan) = flown(&journey);
            let TurnPlan::Turn { world_s, gamma, .. } = plan else { unreachable!() };
            let scale = d.abs() + gamma * c * c / a;
            assert!((end.position.x - d).abs() < 1e-12 * scale, "{journey:?}: {} m", end.position.x - d);
            assert!(end.celerity.magnitude() < 1e-11 * gamma, "{journey:?}: {:?}", end.celerity);
            assert!((end.ct / c / world_s - 1.0).abs() < 1e-11, "{journey:?}");
        }
    }

    #[test]
    fn from_rest_the_turn_is_half_way_and_the_times_are_the_books() {
        // 1 g to a star at 4.3 light-years: 3.6 years on board, 6.0 years at home (Gibbs, Koks, The Relativistic
        // Rocket: 4.3 ly, stopping, 3.6 years).
        let year_s = 365.25 * 86_400.0;
        let c = 299_792_458.0;
        let plan = journey(4.3 * c * year_s, 0.0, 9.81, c).plan().unwrap();
        let TurnPlan::Turn { turn_m, turn_own_s, own_s, world_s, .. } = plan else { panic!("{plan:?}") };
        assert!((turn_m / (2.15 * c * year_s) - 1.0).abs() < 1e-14);
        assert!((own_s / (2.0 * turn_own_s) - 1.0).abs() < 1e-14);
        assert!((own_s / year_s - 3.6).abs() < 0.05, "{}", own_s / year_s);
        assert!((world_s / year_s - 6.0).abs() < 0.1, "{}", world_s / year_s);
    }

    #[test]
    fn at_little_speed_the_plan_is_newtons() {
        // d = 100 m at 2 m/s²: 2 √(d/a) = 14.142 s.
        let plan = journey(100.0, 0.0, 2.0, 1e9).plan().unwrap();
        let TurnPlan::Turn { own_s, world_s, .. } = plan else { panic!("{plan:?}") };
        assert!((own_s - 2.0 * 50_f64.sqrt()).abs() < 1e-9 && (world_s - own_s).abs() < 1e-9);
    }

    #[test]
    fn too_fast_a_vehicle_is_told_how_far_it_will_miss() {
        // γ = 1.25, a = 0.25/8 per metre of c² … the way to stop is (γ − 1) c²/a = 8 m.
        let plan = journey(5.0, 0.75, 2.0, 8.0).plan().unwrap();
        let TurnPlan::Overshoot { beyond_m, world_s, .. } = plan else { panic!("{plan:?}") };
        assert!((beyond_m - 3.0).abs() < 1e-14 && (world_s - 0.75 * 8.0 / 2.0).abs() < 1e-14);
    }

    #[test]
    fn nonsense_has_no_plan() {
        for (d, u, a) in [(f64::NAN, 0.0, 1.0), (1.0, f64::INFINITY, 1.0), (1.0, 0.0, 0.0), (1.0, 0.0, -1.0)] {
            assert_eq!(journey(d, u, a, 8.0).plan(), None);
        }
        assert_eq!(journey(1.0, 1e200, 1.0, 8.0).plan(), None);
    }

    #[test]
    fn felt_acceleration_is_in_g() {
        // One g at c = 10 m/s is 9.80665 / 100 per metre.
        let thrust = Thrust { acceleration: DVec3::new(0.0, 0.0980665, 0.0), turn_rate: DVec3::ONE };
        assert!((felt_g(&thrust, LightSpeed::new(10.0).unwrap()) - 1.0).abs() < 1e-15);
    }
}
