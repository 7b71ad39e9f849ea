//! Motion of the vehicle that its rider sees and does not feel, and the veil that hides what of it makes ill.
//!
//! Eyes feel motion most where they see least: at the edge of what they see. So it is the edge that a vignette hides,
//! and only while the vehicle accelerates or turns, since a steady ride is not felt in a real vehicle either.

use presentation::Vignette;
use ride::RideFrame;
use walls::Veil;

/// Acceleration, m/s², and rate of turn, rad/s, of the rider's own time, each of which alone makes half of the effect.
const HALF_M_S2: f64 = 1.2;
const HALF_RAD_S: f64 = 0.3;
/// Times in which the effect follows motion that begins, and motion that ends, seconds.
const RISE_S: f64 = 0.25;
const FALL_S: f64 = 0.6;
/// Longest time that counts from one picture to the next, seconds.
const LONGEST_S: f64 = 0.25;

/// Angles from straight ahead up to which nothing is hidden, and from which on all is, degrees, and the share of the
/// signal that is taken there: of the weak and of the strong vignette at their fullest.
const WEAK: ([f64; 2], f64) = ([26.0, 52.0], 0.75);
const STRONG: ([f64; 2], f64) = ([16.0, 40.0], 1.0);

/// Motion that is not felt, smoothed over time.
#[derive(Clone, Copy, Debug, Default)]
pub struct UnfeltMotion {
    /// Level of the effect, 0 to 1.
    level: f64,
    /// Time of the last frame, nanoseconds.
    last_at: Option<u64>,
}

impl UnfeltMotion {
    /// Takes the next frame of a ride.
    pub fn follow(&mut self, frame: &RideFrame) {
        let at = frame.record.at;
        let passed_s = self.last_at.replace(at).map_or(0.0, |last| at.saturating_sub(last) as f64 * 1e-9);
        let c = frame.vehicle.light_speed().speed_of_light_m_s();
        // What is seen goes at the pace of real time.
        let pace = if frame.paused { 0.0 } else { frame.time_scale };
        let thrust = frame.vehicle.thrust();
        let acceleration_m_s2 = thrust.acceleration.length() * c * c * pace * pace;
        self.step(passed_s, acceleration_m_s2, thrust.turn_rate.length() * c * pace);
    }

    /// Takes an acceleration and a rate of turn for some time, seconds.
    ///
    /// *Equation*: the level follows s² / (1 + s²), s² being the sum of the squares of both in their halves, as a
    /// low-pass of first order does.
    fn step(&mut self, passed_s: f64, acceleration_m_s2: f64, turn_rad_s: f64) {
        let square = (acceleration_m_s2 / HALF_M_S2).powi(2) + (turn_rad_s / HALF_RAD_S).powi(2);
        let wanted = if square.is_finite() { square / (1.0 + square) } else { 1.0 };
        let time_s = if wanted > self.level { RISE_S } else { FALL_S };
        let passed_s = passed_s.clamp(0.0, LONGEST_S);
        self.level += (wanted - self.level) * -(-passed_s / time_s).exp_m1();
    }

    /// Veil that a vignette is at present.
    pub fn veil(&self, vignette: Vignette) -> Veil {
        /// Level below which nothing would be seen of a veil.
        const LEAST: f64 = 0.01;
        let (angles_deg, opacity) = match vignette {
            Vignette::Off => return Veil::NONE,
            Vignette::Weak => WEAK,
            Vignette::Strong => STRONG,
        };
        let level = if self.level < LEAST { 0.0 } else { self.level };
        Veil { angles_rad: angles_deg.map(f64::to_radians), opacity: opacity * level }
    }
}

#[cfg(test)]
mod tests {
    //! Laws: a vignette is as dark as the motion is strong, comes and goes without a leap at every frame rate, is none
    //! at rest and while the ride is held, and none at all where it is off.
    use super::*;

    /// Levels after each frame at this rate for a second of this motion, from this level on.
    fn levels(mut motion: UnfeltMotion, rate: u32, acceleration: f64, turn: f64) -> Vec<f64> {
        let step = |_| {
            motion.step(1.0 / f64::from(rate), acceleration, turn);
            motion.level
        };
        (0..rate).map(step).collect()
    }

    #[test]
    fn a_motion_brings_its_level_with_its_time_constant_at_every_rate() {
        for (acceleration, turn, wanted) in
            [(HALF_M_S2, 0.0, 0.5), (0.0, HALF_RAD_S, 0.5), (1.2, 0.3, 2.0 / 3.0), (0.0, 0.0, 0.0)]
        {
            for rate in [20, 72, 144] {
                let rise = levels(UnfeltMotion::default(), rate, acceleration, turn);
                let time_s = f64::from(rate / 4) / f64::from(rate);
                let expected = wanted * (1.0 - (-time_s / RISE_S).exp());
                assert!((rise[rate as usize / 4 - 1] - expected).abs() < 1e-9, "{rise:?}");
                let full = UnfeltMotion { level: 1.0, last_at: None };
                let fall = levels(full, rate, acceleration, turn);
                let expected = wanted + (1.0 - wanted) * (-1.0 / FALL_S).exp();
                assert!((fall[rate as usize - 1] - expected).abs() < 1e-9, "{fall:?}");
            }
        }
        let wild = levels(UnfeltMotion::default(), 60, f64::INFINITY, f64::NAN);
        assert!(wild.iter().all(|level| (0.0..=1.0).contains(level)));
    }

    #[test]
    fn a_vignette_is_none_when_off_or_at_rest_and_hides_more_the_stronger_it_is() {
        let full = UnfeltMotion { level: 1.0, last_at: None };
        assert!(full.veil(Vignette::Off).is_none());
        assert!([Vignette::Weak, Vignette::Strong].iter().all(|some| UnfeltMotion::default().veil(*some).is_none()));
        let taken =
            |motion: UnfeltMotion, vignette, degrees: f64| motion.veil(vignette).opacity_at(degrees.to_radians());
        for degrees in [0.0, 10.0, 20.0, 30.0, 45.0, 60.0, 100.0] {
            let weak = taken(full, Vignette::Weak, degrees);
            let strong = taken(full, Vignette::Strong, degrees);
            assert!(weak <= strong && (weak < strong || weak == 0.0), "{degrees}°: {weak} and {strong}");
            let half = taken(UnfeltMotion { level: 0.5, last_at: None }, Vignette::Strong, degrees);
            assert!((half - 0.5 * strong).abs() < 1e-12);
        }
        // The middle is never hidden, and the edge of a usual headset is.
        assert_eq!(taken(full, Vignette::Strong, 15.0), 0.0);
        assert!(taken(full, Vignette::Strong, 45.0) == 1.0 && taken(full, Vignette::Weak, 45.0) > 0.5);
    }
}
