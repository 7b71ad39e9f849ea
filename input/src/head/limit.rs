//! A head slower than light.
//!
//! A walker's 1.5 m/s is nothing to light, but where light goes at 30 km/h it is a fifth of it, and
//! a stumble may be faster than it. What a tracker measures is the way that the head goes in the
//! vehicle, in the room's metres, for each second of the user's own clock: way in the vehicle's frame
//! over proper time is the **celerity** times c, exactly as the bicycle's wheel on the rider's clock.
//! So the program takes u = v / c, which is no less sound for any v, and no limit is ever met. The
//! velocity in the vehicle is then
//!
//! β = u / √(1 + u²),
//!
//! which [`limited`] computes for those who need a velocity, and for other limits than c.

use glam::DVec3;

/// Maps a speed from 0 … ∞ smoothly to 0 … `limit`, in the speed's units.
///
/// *Equation*: v ↦ v / √(1 + (v/limit)²): odd, monotone, slope 1 at rest, v − v³/(2 limit²) + … for
/// small v. With the limit c it is the velocity that belongs to the celerity v/c.
///
/// *Accuracy*: rounding; below the limit even where rounding would reach it.
pub fn limited(speed: f64, limit: f64) -> f64 {
    let celerity = (speed / limit).clamp(-f64::MAX, f64::MAX);
    let beta = celerity / celerity.hypot(1.0);
    (limit * beta).clamp(-limit.next_down(), limit.next_down())
}

/// The celerity (in units of c) of a head that a tracker sees go at this velocity, m/s; c in m/s.
///
/// *Equation*: u = v / c, because way over the user's own time is celerity.
pub fn celerity(velocity_m_s: DVec3, c_m_s: f64) -> DVec3 {
    velocity_m_s / c_m_s
}

#[cfg(test)]
mod tests {
    //! A head must stay slower than light without a jump anywhere, and a slow one must stay as it
    //! is.
    use super::*;

    /// 30 km/h.
    const C: f64 = 30.0 / 3.6;

    #[test]
    fn speeds_stay_below_the_limit_and_in_their_order() {
        let mut last = -1.0;
        for exponent in -400..=3000 {
            let speed = 10_f64.powf(f64::from(exponent) / 10.0);
            let below = limited(speed, C);
            assert!(below < C && below >= last, "{speed}: {below}");
            assert!(below > last || speed > 1e6, "{speed}: {below}");
            assert_eq!(limited(-speed, C), -below);
            last = below;
        }
        for (speed, limit) in [(f64::INFINITY, C), (f64::MAX, C), (f64::MAX, 1e-300)] {
            assert_eq!(limited(speed, limit), limit.next_down());
        }
        assert_eq!(limited(0.0, C), 0.0);
    }

    #[test]
    fn small_speeds_are_kept_to_second_order() {
        for share in [1e-1, 1e-2, 1e-3, 1e-4] {
            let difference = share - limited(share * C, C) / C;
            // The cubic term, and the one behind it.
            assert!((difference - share.powi(3) / 2.0).abs() < share.powi(5), "{share}: {difference}");
        }
    }

    #[test]
    fn the_limit_c_gives_the_velocity_of_the_celerity() {
        // β = 0.6: γβ = 0.75.
        assert!((limited(0.75 * C, C) - 0.6 * C).abs() < 1e-15);
        assert!((celerity(DVec3::new(0.0, 0.0, -0.75 * C), C).z + 0.75).abs() < 1e-15);
    }
}
