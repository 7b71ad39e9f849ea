//! Clocks in a scene, and what a dial shows: as it is seen, as it is now for the observer, as it is now for the world.
//!
//! The three differ because "now" does. Light shows the dial as it was. The observer's own simultaneity reads it on
//! the plane of all events at the observer's time in the observer's frame. The world reads it at the world's time. A
//! clock shows the time of the frame in which it rests, so clocks on a train agree with each other aboard, and not in
//! the world.

use glam::DVec3;
use physics::Observer;

use crate::motion::Uniform;
use crate::place::LocalName;

/// Clock: a place that shows the time of the frame in which it rests.
#[derive(Clone, Debug, PartialEq)]
pub struct SceneClock {
    /// Name, for captions.
    pub name: LocalName,
    /// Middle of the dial, metres, in the frame in which the clock rests.
    pub position: DVec3,
    /// Motion of that frame; `None` for the world. At the motion's anchor the clock's frame shows the world's time.
    pub motion: Option<Uniform>,
    /// Time that the dial shows when its frame's time is 0, seconds.
    pub ahead_s: f64,
}

/// Three readings of one dial, seconds.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct ClockReading {
    /// Time on the dial as the observer sees it.
    pub seen_s: f64,
    /// Time on the dial at the event that is simultaneous for the observer.
    pub measured_s: f64,
    /// Time on the dial at the event that is simultaneous in the world.
    pub world_s: f64,
}

impl SceneClock {
    /// Readings of the dial for an observer.
    ///
    /// *Equation:* in the clock's frame, with the observer at the event (t, x) and the velocity β there, and d = p − x:
    /// seen t − |d|; measured t + β·d, the event at which u·(e − o) = 0; in the world, whose clocks move with −β_K past
    /// this one, the event of its worldline at the world's time.
    pub fn reading(&self, observer: &Observer, speed_of_light_m_s: f64) -> ClockReading {
        let (event, celerity) = match &self.motion {
            None => (observer.event, observer.celerity),
            Some(motion) => (motion.own_from_world(observer.event), motion.seen_by(observer).celerity),
        };
        let away = self.position - event.position;
        let world = match &self.motion {
            None => event.ct,
            Some(Uniform { celerity, anchor }) => {
                let from_anchor = self.position - anchor.position;
                let late = celerity.beta().vector().dot(from_anchor);
                anchor.ct + (observer.event.ct - anchor.ct) / celerity.gamma() - late
            }
        };
        let shown = |ct: f64| ct / speed_of_light_m_s + self.ahead_s;
        ClockReading {
            seen_s: shown(event.ct - away.length()),
            measured_s: shown(event.ct + celerity.beta().vector().dot(away)),
            world_s: shown(world),
        }
    }

    /// Angle of a hand that goes round once in `period_s`, radians clockwise from the top of the dial, when the dial
    /// shows `shown_s`.
    pub fn hand_rad(shown_s: f64, period_s: f64) -> f64 {
        std::f64::consts::TAU * (shown_s / period_s).rem_euclid(1.0)
    }
}

#[cfg(test)]
mod tests {
    //! Law under test: a dial is read at the event that each "now" names. Exact cases at β = 0.6: γ = 1.25, D = 2 ahead
    //! and 1/2 astern. A wrong program takes one simultaneity for another, or a delay of the wrong frame.

    use super::*;
    use physics::{Beta, Event};

    const SPEED_OF_LIGHT_M_S: f64 = 10.0;

    fn clock(position: DVec3, motion: Option<Uniform>) -> SceneClock {
        SceneClock { name: LocalName::default(), position, motion, ahead_s: 0.0 }
    }

    fn riding(beta: DVec3, ct: f64, position: DVec3) -> Observer {
        Observer { event: Event { ct, position }, celerity: Beta::new(beta).unwrap().celerity() }
    }

    fn close(reading: ClockReading, expected: [f64; 3]) {
        let ClockReading { seen_s, measured_s, world_s } = reading;
        for (got, wanted) in [seen_s, measured_s, world_s].into_iter().zip(expected) {
            assert!((got - wanted).abs() < 1e-12, "{reading:?} instead of {expected:?}");
        }
    }

    #[test]
    fn a_clock_ahead_is_seen_late_and_measured_early() {
        // 30 m ahead at world time 50 m: light left at 20 m; for the rider that clock is at 50 + 0.6 · 30 now.
        let tower = clock(DVec3::NEG_Z * 30.0, None);
        close(tower.reading(&riding(DVec3::NEG_Z * 0.6, 50.0, DVec3::ZERO), SPEED_OF_LIGHT_M_S), [2.0, 6.8, 5.0]);
        close(tower.reading(&riding(DVec3::Z * 0.6, 50.0, DVec3::ZERO), SPEED_OF_LIGHT_M_S), [2.0, 3.2, 5.0]);
        close(tower.reading(&riding(DVec3::ZERO, 50.0, DVec3::ZERO), SPEED_OF_LIGHT_M_S), [2.0, 5.0, 5.0]);
    }

    #[test]
    fn on_approach_a_clock_runs_d_times_as_fast_as_the_riders_and_astern_1_over_d() {
        // One second of the rider's clock: 12.5 m of world time and 7.5 m of way.
        for (beta, doppler) in [(DVec3::NEG_Z * 0.6, 2.0), (DVec3::Z * 0.6, 0.5)] {
            let tower = clock(DVec3::NEG_Z * 100.0, None);
            let [before, after] = [0.0, 1.0].map(|own_s| {
                let ct = 12.5 * own_s;
                tower.reading(&riding(beta, ct, beta * ct), SPEED_OF_LIGHT_M_S)
            });
            assert!((after.seen_s - before.seen_s - doppler).abs() < 1e-12);
            // Measured, a moving clock runs slow by γ whichever way it goes.
            assert!((after.measured_s - before.measured_s - 0.8).abs() < 1e-12);
            assert!((after.world_s - before.world_s - 1.25).abs() < 1e-12);
        }
    }

    #[test]
    fn clocks_along_a_train_are_behind_by_beta_times_their_distance_for_the_platform() {
        let celerity = Beta::new(DVec3::X * 0.6).unwrap().celerity();
        let motion = Uniform { celerity, anchor: Event::default() };
        let platform = riding(DVec3::ZERO, 100.0, DVec3::new(60.0, 0.0, 5.0));
        let [rear, front] = [0.0, 25.0].map(|x| clock(DVec3::X * x, Some(motion)));
        let [rear, front] = [rear, front].map(|clock| clock.reading(&platform, SPEED_OF_LIGHT_M_S));
        // Slow by γ: 100 m of the platform's time are 80 m aboard; 25 m further ahead it is 15 m of light earlier.
        assert!((rear.world_s - 8.0).abs() < 1e-12 && (front.world_s - 6.5).abs() < 1e-12);
        assert_eq!(rear.world_s, rear.measured_s);
        // For a passenger all of them agree.
        let passenger = Observer { celerity, ..platform };
        let [rear, front] = [0.0, 25.0].map(|x| clock(DVec3::X * x, Some(motion)).reading(&passenger, 10.0));
        assert!((rear.measured_s - front.measured_s).abs() < 1e-12);
    }

    #[test]
    fn a_hand_stands_where_the_time_says() {
        for (shown_s, turns) in [(3.0, 0.25), (15.0, 0.25), (-3.0, 0.75)] {
            assert!((SceneClock::hand_rad(shown_s, 12.0) / std::f64::consts::TAU - turns).abs() < 1e-15);
        }
    }
}
