//! Decoder of the trainer's notifications.

use super::config::TrainerConfig;
use super::indoor_bike::IndoorBikeData;
use super::revolutions::{RevolutionsData, TurnRate, Turns};
use super::wire::{DirectConnectMessage, DirectConnectPieces, NOTIFICATION};
use super::wire::{INDOOR_BIKE_DATA, POWER_MEASUREMENT, SPEED_MEASUREMENT};
use crate::clock::{Nanos, seconds_between};
use crate::decoder::{Actions, Decoder};
use crate::faults::Faults;
use crate::glide::Glide;

/// Fastest possible turns of the crank, Hz: 300 a minute.
const FASTEST_CADENCE_HZ: f64 = 5.0;
/// Time after which a power is no longer true, seconds.
const POWER_HOLDS_S: f64 = 5.0;

/// Sensor of turns. Of two characteristics that count the same turns, each with a counter and a clock of its own, the
/// first that speaks is used.
#[derive(Debug, Default)]
struct TurnSensor(Option<(u16, TurnRate)>);

impl TurnSensor {
    /// Takes turns of that characteristic that arrived at `at`. Returns turns a second, `None` while they are not
    /// known.
    fn measure(&mut self, at: Nanos, characteristic: u16, turns: Turns) -> Option<f64> {
        let (used, rate) = self.0.get_or_insert((characteristic, TurnRate::default()));
        if *used == characteristic { rate.measure(at, turns) } else { None }
    }
}

/// Decoder of [`SampleSource::Trainer`](crate::SampleSource::Trainer).
#[derive(Debug)]
pub struct TrainerDecoder {
    config: TrainerConfig,
    pieces: DirectConnectPieces,
    faults: Faults,
    /// Speed, m/s.
    speed: Glide,
    /// Turns of the crank a second.
    cadence: Glide,
    /// Last power, watts, and its time.
    power: Option<(f64, Nanos)>,
    /// Turns of the wheel and the crank, for what the bike data do not tell.
    wheel: TurnSensor,
    crank: TurnSensor,
    /// True if the bike data tell the speed; the cadence.
    tells_speed: bool,
    tells_cadence: bool,
}

impl TrainerDecoder {
    /// Decoder without any notification yet.
    pub fn new(config: TrainerConfig) -> Self {
        Self {
            speed: Glide::new(config.stop_after_s),
            cadence: Glide::new(config.stop_after_s),
            config,
            pieces: DirectConnectPieces::default(),
            faults: Faults::default(),
            power: None,
            wheel: TurnSensor::default(),
            crank: TurnSensor::default(),
            tells_speed: false,
            tells_cadence: false,
        }
    }

    /// Speed of the wheel, m/s; `None` until a first notification.
    pub fn wheel_speed(&self, at: Nanos) -> Option<f64> {
        self.speed.speed(at)
    }

    /// Turns of the crank a second; `None` where the trainer does not tell them.
    pub fn cadence_hz(&self, at: Nanos) -> Option<f64> {
        self.cadence.speed(at)
    }

    /// Power of the rider, watts; `None` where the trainer does not tell it, or has not for some seconds.
    pub fn power_w(&self, at: Nanos) -> Option<f64> {
        self.power.filter(|(_, said_at)| seconds_between(*said_at, at) < POWER_HOLDS_S).map(|(power_w, _)| power_w)
    }

    /// Takes a message that arrived at `at`. Messages of other kinds and characteristics are passed over.
    fn message(&mut self, at: Nanos, message: DirectConnectMessage<'_>) -> Result<(), String> {
        match message.characteristic() {
            Some((INDOOR_BIKE_DATA, value)) if message.kind == NOTIFICATION => {
                let data = IndoorBikeData::parse(value).map_err(|error| error.to_string())?;
                self.tells_speed |= data.speed_m_s.is_some();
                self.tells_cadence |= data.cadence_hz.is_some();
                self.say_power(at, data.power_w);
                self.say_speed_and_cadence(at, data.speed_m_s, data.cadence_hz)
            }
            Some((POWER_MEASUREMENT, value)) if message.kind == NOTIFICATION => {
                let data = RevolutionsData::of_power(value).map_err(|error| error.to_string())?;
                self.revolutions(at, POWER_MEASUREMENT, data)
            }
            Some((SPEED_MEASUREMENT, value)) if message.kind == NOTIFICATION => {
                let data = RevolutionsData::of_speed(value).map_err(|error| error.to_string())?;
                self.revolutions(at, SPEED_MEASUREMENT, data)
            }
            _ => Ok(()),
        }
    }

    /// Takes turns of that characteristic, as far as the bike data do not tell more.
    fn revolutions(&mut self, at: Nanos, characteristic: u16, data: RevolutionsData) -> Result<(), String> {
        let turn = |sensor: &mut TurnSensor, turns: Option<Turns>| {
            turns.and_then(|turns| sensor.measure(at, characteristic, turns))
        };
        let wheel_hz = turn(&mut self.wheel, data.wheel).filter(|_| !self.tells_speed);
        let crank_hz = turn(&mut self.crank, data.crank).filter(|_| !self.tells_cadence);
        self.say_power(at, data.power_w);
        self.say_speed_and_cadence(at, wheel_hz.map(|hz| hz * self.config.wheel_circumference_m), crank_hz)
    }

    /// Takes both of one message: a fault of one leaves the other as it is. The speed's fault is told first.
    fn say_speed_and_cadence(
        &mut self,
        at: Nanos,
        speed_m_s: Option<f64>,
        cadence_hz: Option<f64>,
    ) -> Result<(), String> {
        let speed = self.say_speed(at, speed_m_s);
        let cadence = self.say_cadence(at, cadence_hz);
        speed.and(cadence)
    }

    fn say_power(&mut self, at: Nanos, power_w: Option<f64>) {
        if let Some(power_w) = power_w {
            self.power = Some((power_w, at));
        }
    }

    fn say_speed(&mut self, at: Nanos, speed_m_s: Option<f64>) -> Result<(), String> {
        let fastest = self.config.fastest_m_s;
        match speed_m_s {
            Some(speed) if !(0.0..=fastest).contains(&speed) => {
                Err(format!("a speed of {speed:.1} m/s: expected {fastest} m/s at most"))
            }
            Some(speed) => {
                self.speed.read(at, speed);
                Ok(())
            }
            None => Ok(()),
        }
    }

    fn say_cadence(&mut self, at: Nanos, cadence_hz: Option<f64>) -> Result<(), String> {
        match cadence_hz {
            Some(cadence) if !(0.0..=FASTEST_CADENCE_HZ).contains(&cadence) => {
                Err(format!("a cadence of {:.0} turns a minute: expected 300 at most", cadence * 60.0))
            }
            Some(cadence) => {
                self.cadence.read(at, cadence);
                Ok(())
            }
            None => Ok(()),
        }
    }
}

impl Decoder for TrainerDecoder {
    fn reset(&mut self, _at: Nanos) {
        let faults = std::mem::take(&mut self.faults);
        *self = Self { faults, ..Self::new(self.config.clone()) };
    }

    fn bytes(&mut self, at: Nanos, bytes: &[u8], _actions: &mut Actions) {
        let mut pieces = std::mem::take(&mut self.pieces);
        pieces.push(bytes, |piece| {
            let taken = match piece {
                Ok((message, _)) => self.message(at, message),
                Err(error) => Err(error.to_string()),
            };
            if let Err(what) = taken {
                self.faults.count(what);
            }
        });
        self.pieces = pieces;
    }

    fn faults(&self) -> &Faults {
        &self.faults
    }
}

#[cfg(test)]
mod tests {
    //! Law: a trainer's notifications give its speed, cadence and power, however they are cut; what is damaged or
    //! impossible is counted and changes nothing.
    use super::super::wire::{CONTROL_POINT, uuid};
    use super::*;
    use crate::clock::SECOND;

    fn notification(characteristic: u16, value: &[u8]) -> Vec<u8> {
        let data = [&uuid(characteristic), value].concat();
        DirectConnectMessage { kind: NOTIFICATION, sequence: 0, response: 0, data: &data }.to_bytes()
    }

    /// Bike data with a speed in 0.01 km/h, a cadence in half turns a minute and a power in watts.
    fn bike(speed: u16, cadence: u16, power: i16) -> Vec<u8> {
        let value = [0x44_u16.to_le_bytes(), speed.to_le_bytes(), cadence.to_le_bytes(), power.to_le_bytes()].concat();
        notification(INDOOR_BIKE_DATA, &value)
    }

    fn trainer() -> TrainerDecoder {
        TrainerDecoder::new(TrainerConfig::default())
    }

    fn feed(trainer: &mut TrainerDecoder, at: Nanos, bytes: &[u8]) {
        trainer.bytes(at, bytes, &mut Actions::default());
    }

    #[test]
    fn a_steady_ride_is_steady_between_the_notifications() {
        for gap in [2 * SECOND, SECOND, SECOND / 4] {
            let mut trainer = trainer();
            for n in 0..20 {
                let bytes = bike(3600, 180, 250);
                // The stream is cut anywhere.
                let (first, second) = bytes.split_at(n as usize % bytes.len());
                feed(&mut trainer, n * gap, first);
                feed(&mut trainer, n * gap, second);
                for look in 0..100 {
                    let at = n * gap + look * gap / 100;
                    assert!((trainer.wheel_speed(at).unwrap() - 10.0).abs() < 1e-9, "at {at}, gap {gap}");
                    assert!((trainer.cadence_hz(at).unwrap() - 1.5).abs() < 1e-9);
                    assert_eq!(trainer.power_w(at), Some(250.0));
                }
            }
            assert_eq!(trainer.faults().number(), 0);
            assert_eq!(trainer.wheel_speed(60 * SECOND), Some(0.0));
            assert_eq!(trainer.power_w(60 * SECOND), None);
        }
    }

    #[test]
    fn divided_data_are_joined() {
        let mut trainer = trainer();
        // "More data": the power comes first, the speed in a notification of its own.
        for n in 0..4 {
            feed(&mut trainer, n * SECOND, &notification(INDOOR_BIKE_DATA, &[0x41, 0, 200, 0]));
            feed(&mut trainer, n * SECOND, &notification(INDOOR_BIKE_DATA, &[0x04, 0, 0x10, 0x0e, 120, 0]));
        }
        let at = 3 * SECOND;
        assert!((trainer.wheel_speed(at).unwrap() - 10.0).abs() < 1e-9);
        assert_eq!((trainer.cadence_hz(at), trainer.power_w(at)), (Some(1.0), Some(200.0)));
    }

    #[test]
    fn what_is_impossible_or_cut_is_counted_and_changes_nothing() {
        let mut trainer = trainer();
        feed(&mut trainer, 0, &bike(3600, 180, 250));
        for (number, bad) in (1..).zip([
            notification(INDOOR_BIKE_DATA, &[]),
            notification(INDOOR_BIKE_DATA, &[0x44, 0, 0x10, 0x0e, 180]),
            bike(65_535, 180, 250),
            bike(3600, 65_535, 250),
            notification(SPEED_MEASUREMENT, &[3, 0]),
            notification(POWER_MEASUREMENT, &[0]),
        ]) {
            feed(&mut trainer, 1, &bad);
            assert_eq!(trainer.faults().number(), number, "{bad:?}");
        }
        assert!(trainer.faults().last().is_some());
        assert!((trainer.wheel_speed(1).unwrap() - 10.0).abs() < 1e-9);
        // Other notifications and answers are nobody's fault.
        feed(&mut trainer, 1, &notification(CONTROL_POINT, &[0x80, 0, 1]));
        feed(&mut trainer, 1, &notification(0x2ada, &[4]));
        assert_eq!(trainer.faults().number(), 6);
    }

    #[test]
    fn revolutions_count_where_the_bike_data_have_no_speed() {
        let mut trainer = trainer();
        for s in 0..6_u8 {
            let ticks = (u16::from(s) * 1024).to_le_bytes();
            let value = [1, 4 * s, 0, 0, 0, ticks[0], ticks[1]];
            feed(&mut trainer, u64::from(s) * SECOND, &notification(SPEED_MEASUREMENT, &value));
        }
        assert!((trainer.wheel_speed(5 * SECOND).unwrap() - 4.0 * 2.096).abs() < 1e-9);
        // From here on the bike data count.
        for s in 6..10 {
            feed(&mut trainer, s * SECOND, &bike(1800, 0, 0));
            feed(&mut trainer, s * SECOND, &notification(SPEED_MEASUREMENT, &[1, 200, 1, 0, 0, 0, s as u8]));
        }
        assert!((trainer.wheel_speed(10 * SECOND).unwrap() - 5.0).abs() < 1e-9);
    }

    #[test]
    fn two_services_that_count_the_same_turns_are_not_mixed() {
        for power_first in [true, false] {
            let mut trainer = trainer();
            for s in 0..8_u16 {
                // 4 turns of the wheel and 1 of the crank a second; counters and clocks of the two are far apart.
                let turns = |wheel: u16, ticks: u16, crank: u16, crank_ticks: u16| {
                    [
                        &u32::from(wheel + 4 * s).to_le_bytes()[..],
                        &ticks.to_le_bytes(),
                        &(crank + s).to_le_bytes(),
                        &crank_ticks.wrapping_add(s * 1024).to_le_bytes(),
                    ]
                    .concat()
                };
                let power = [&[0x30, 0, 200, 0][..], &turns(50, (s * 2048).wrapping_add(7), 900, 60_000)].concat();
                let speed = [&[3][..], &turns(7000, (s * 1024).wrapping_add(30_000), 5, 100)].concat();
                let both = [notification(POWER_MEASUREMENT, &power), notification(SPEED_MEASUREMENT, &speed)];
                let at = u64::from(s) * SECOND;
                feed(&mut trainer, at, &both[usize::from(!power_first)]);
                feed(&mut trainer, at + SECOND / 10, &both[usize::from(power_first)]);
                if s > 1 {
                    let speed = trainer.wheel_speed(at + SECOND / 5).unwrap();
                    assert!((speed - 4.0 * 2.096).abs() < 1e-9, "{speed} m/s after {s} s");
                    assert_eq!(trainer.cadence_hz(at + SECOND / 5), Some(1.0), "after {s} s");
                }
            }
            assert_eq!((trainer.faults().number(), trainer.power_w(7 * SECOND)), (0, Some(200.0)));
        }
    }

    #[test]
    fn an_impossible_cadence_does_not_cost_the_speed_nor_the_other_way() {
        let mut trainer = trainer();
        feed(&mut trainer, 0, &bike(3600, 65_535, 250));
        assert!((trainer.wheel_speed(0).unwrap() - 10.0).abs() < 1e-9);
        assert_eq!((trainer.cadence_hz(0), trainer.faults().number()), (None, 1));
        assert!(trainer.faults().last().is_some_and(|fault| format!("{fault:?}").contains("a cadence of 32768")));
        feed(&mut trainer, SECOND, &bike(65_535, 120, 250));
        assert_eq!((trainer.cadence_hz(SECOND), trainer.faults().number()), (Some(1.0), 2));
    }

    #[test]
    fn a_trainer_that_goes_lets_go_and_one_that_comes_begins_anew() {
        let mut trainer = trainer();
        feed(&mut trainer, 0, &bike(3600, 180, 250));
        feed(&mut trainer, 0, b"HTTP/1.1");
        feed(&mut trainer, 0, &bike(3600, 180, 250));
        assert_eq!(trainer.faults().number(), 1);
        trainer.reset(SECOND);
        assert_eq!(
            (trainer.wheel_speed(SECOND), trainer.cadence_hz(SECOND), trainer.power_w(SECOND)),
            (None, None, None)
        );
        feed(&mut trainer, SECOND, &bike(1800, 180, 250));
        assert!((trainer.wheel_speed(SECOND).unwrap() - 5.0).abs() < 1e-9);
    }
}
