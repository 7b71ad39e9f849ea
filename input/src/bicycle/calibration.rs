//! Calibration of a bicycle: readings in known positions, and the settings that they give.
//!
//! The rider holds the handlebar straight, then turned by a known angle to either side, pulls the brake, and turns the
//! wheel and the crank. [`RawReadings`] collects what the box sends meanwhile; [`BicyclePositions`] makes the settings
//! of it.

use std::collections::VecDeque;

use thiserror::Error;

use super::config::{BicycleConfig, SpeedSource};
use super::protocol::{BicycleLine, PulseCount};
use crate::line::Lines;

/// Number of newest readings whose median counts.
const KEPT: usize = 50;
/// Share of the way to one side that the way to the other may differ by.
const ASYMMETRY: f64 = 0.3;
/// Largest dead zone that noise may ask for, radians.
const WIDEST_DEAD_RAD: f64 = 0.035;

/// Kind of line that a box sends.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum BicycleLineKind {
    /// Lines `B1`: counts of pulses, readings of converters.
    Pulses,
    /// Lines of four fields.
    Interval,
    /// Lines of a single number.
    Bare,
}

/// Reading of a converter, from its newest values.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct SteadyReading {
    /// Median of the values.
    pub median: f64,
    /// Distance from the least to the largest value.
    pub spread: f64,
}

/// Readings of a box as they come.
#[derive(Debug, Default)]
pub struct RawReadings {
    lines: Lines,
    kind: Option<BicycleLineKind>,
    steer: VecDeque<f64>,
    brake: VecDeque<f64>,
    counts: Option<(u32, u32)>,
    wheel_pulses: u64,
    crank_pulses: u64,
    last_fault: Option<String>,
}

impl RawReadings {
    /// Takes bytes of the box, cut anywhere.
    pub fn bytes(&mut self, bytes: &[u8]) {
        let mut lines = std::mem::take(&mut self.lines);
        lines.push(bytes, |line| match line.and_then(BicycleLine::parse) {
            Ok(line) => self.line(line),
            Err(error) => self.last_fault = Some(error.to_string()),
        });
        self.lines = lines;
    }

    fn line(&mut self, line: BicycleLine) {
        let (kind, steer, brake) = match line {
            BicycleLine::Pulses { wheel, crank, steer, brake, .. } => {
                self.count(wheel, crank);
                (BicycleLineKind::Pulses, steer, brake)
            }
            BicycleLine::Interval { steer, brake, .. } => (BicycleLineKind::Interval, steer, brake),
            BicycleLine::Bare(_) => {
                self.kind = Some(BicycleLineKind::Bare);
                return;
            }
        };
        self.kind = Some(kind);
        for (values, value) in [(&mut self.steer, steer), (&mut self.brake, brake)] {
            values.push_back(value);
            if values.len() > KEPT {
                values.pop_front();
            }
        }
    }

    fn count(&mut self, wheel: PulseCount, crank: PulseCount) {
        if let Some((wheel_before, crank_before)) = self.counts {
            // A box that restarts counts from zero: its jump backward is no turn.
            let turned = |now: u32, before: u32| u64::from(now.wrapping_sub(before)).min(u64::from(u32::MAX / 2) + 1);
            let [wheel, crank] = [turned(wheel.pulses, wheel_before), turned(crank.pulses, crank_before)];
            if wheel <= u64::from(u32::MAX / 2) && crank <= u64::from(u32::MAX / 2) {
                self.wheel_pulses += wheel;
                self.crank_pulses += crank;
            }
        }
        self.counts = Some((wheel.pulses, crank.pulses));
    }

    /// Kind of the last line; `None` before the first good one.
    pub fn kind(&self) -> Option<BicycleLineKind> {
        self.kind
    }

    /// Fault of the last bad line.
    pub fn last_fault(&self) -> Option<&str> {
        self.last_fault.as_deref()
    }

    /// Reading of the steering sensor.
    pub fn steer(&self) -> Option<SteadyReading> {
        steady(&self.steer)
    }

    /// Reading of the brake sensor.
    pub fn brake(&self) -> Option<SteadyReading> {
        steady(&self.brake)
    }

    /// Number of pulses of the wheel and of the crank so far.
    pub fn pulses(&self) -> [u64; 2] {
        [self.wheel_pulses, self.crank_pulses]
    }

    /// Forgets the readings of converters, so that those of the position before do not count for the next.
    pub fn settle(&mut self) {
        self.steer.clear();
        self.brake.clear();
    }
}

fn steady(values: &VecDeque<f64>) -> Option<SteadyReading> {
    let mut sorted: Vec<f64> = values.iter().copied().collect();
    sorted.sort_by(f64::total_cmp);
    let (least, most) = (*sorted.first()?, *sorted.last()?);
    Some(SteadyReading { median: sorted[sorted.len() / 2], spread: most - least })
}

/// Readings of a box in known positions of the bicycle.
#[derive(Clone, Debug, PartialEq)]
pub struct BicyclePositions {
    /// Kind of the box's lines.
    pub kind: BicycleLineKind,
    /// Steering sensor, straight ahead.
    pub straight: SteadyReading,
    /// Steering sensor and angle of the handlebar to the left, radians; `None` without a sensor.
    pub left: Option<(f64, f64)>,
    /// Steering sensor and angle of the handlebar to the right, radians.
    pub right: Option<(f64, f64)>,
    /// Brake sensor with the lever released, and pulled through; `None` without a sensor.
    pub brake: Option<[SteadyReading; 2]>,
    /// Pulses of the wheel, and of the crank, in one turn of each.
    pub pulses_per_turn: [u64; 2],
    /// Distance that the bicycle covers in one turn of the wheel, and of the crank, metres.
    pub metres_per_turn: [f64; 2],
}

/// Reason why readings give no settings.
#[derive(Clone, Debug, PartialEq, Error)]
pub enum CalibrationError {
    /// A steering sensor that does not follow the handlebar.
    #[error(
        "the steering sensor read {straight} straight ahead, {left} to the left and {right} to the right: it must rise \
         to one side and fall to the other; is it connected, and was the handlebar held still?"
    )]
    Steering {
        /// Reading straight ahead.
        straight: f64,
        /// Reading to the left.
        left: f64,
        /// Reading to the right.
        right: f64,
    },
    /// A brake sensor that does not follow the lever.
    #[error(
        "the brake sensor read {released} with the lever released and {full} with it pulled: it must differ by more than \
         its noise, and rise in lines of four fields; is it connected?"
    )]
    Brake {
        /// Reading with the lever released.
        released: f64,
        /// Reading with the lever pulled.
        full: f64,
    },
}

impl BicyclePositions {
    /// Settings of the bicycle that these readings give; what was not read stays as in `before`.
    ///
    /// # Errors
    /// [`CalibrationError`] of a sensor that does not follow.
    pub fn settings(&self, before: &BicycleConfig) -> Result<BicycleConfig, CalibrationError> {
        let mut config = before.clone();
        config.handlebar = self.left.is_some() && self.right.is_some();
        if let (Some(left), Some(right)) = (self.left, self.right) {
            self.steer(left, right, &mut config)?;
        }
        if let Some([released, full]) = self.brake {
            let noise = 2.0 * released.spread.max(full.spread);
            let (released, full) = (released.median, full.median);
            if (full - released).abs() <= noise || (self.kind == BicycleLineKind::Interval && full <= 0.0) {
                return Err(CalibrationError::Brake { released, full });
            }
            match self.kind {
                BicycleLineKind::Interval => config.four_field_brake_full = full,
                _ => (config.brake_released, config.brake_full) = (released, full),
            }
        }
        let [wheel, crank] = self.pulses_per_turn;
        let [metres_per_wheel_turn, metres_per_crank_turn] = self.metres_per_turn;
        config.wheel_circumference_m = metres_per_wheel_turn;
        config.metres_per_crank_turn = metres_per_crank_turn;
        if wheel > 0 {
            config.pulses_per_wheel_turn = wheel as f64;
        }
        if crank > 0 {
            config.pulses_per_crank_turn = crank as f64;
        }
        match (wheel, crank) {
            (0, 0) => {}
            (0, _) => config.speed_from = SpeedSource::Cadence,
            _ => config.speed_from = SpeedSource::Wheel,
        }
        Ok(config)
    }

    /// Sets the steering from a reading and an angle on either side.
    fn steer(&self, left: (f64, f64), right: (f64, f64), config: &mut BicycleConfig) -> Result<(), CalibrationError> {
        let straight = self.straight.median;
        let ways = [left.0 - straight, right.0 - straight];
        let beyond_noise = ways.iter().all(|way| way.abs() > 2.0 * self.straight.spread && *way != 0.0);
        if !beyond_noise || ways[0].signum() == ways[1].signum() {
            return Err(CalibrationError::Steering { straight, left: left.0, right: right.0 });
        }
        let per_unit = (left.1 + right.1) / (left.0 - right.0);
        if self.kind == BicycleLineKind::Interval {
            config.four_field_steer_rad = per_unit;
        } else {
            config.steer_straight = straight;
            config.steer_rad_per_unit = per_unit;
        }
        config.steer_dead_rad = (self.straight.spread * per_unit.abs()).min(WIDEST_DEAD_RAD);
        Ok(())
    }

    /// True if a line of four fields is not near 0 straight ahead, which no setting corrects.
    pub fn is_askew(&self) -> bool {
        let way = self.left.map_or(1.0, |(reading, _)| (reading - self.straight.median).abs());
        self.kind == BicycleLineKind::Interval && self.straight.median.abs() > 0.05 * way
    }

    /// True if the sensor goes much further to one side than to the other for the same angle: the handlebar was not
    /// straight, or the angles were others.
    pub fn is_lopsided(&self) -> bool {
        let (Some(left), Some(right)) = (self.left, self.right) else { return false };
        let [left, right] = [left, right].map(|(reading, angle)| ((reading - self.straight.median) / angle).abs());
        (left - right).abs() > ASYMMETRY * left.max(right)
    }
}

#[cfg(test)]
mod tests {
    //! A bicycle that was calibrated must steer to where it is turned, whatever its converter.
    use super::*;
    use crate::bicycle::BicycleDecoder;
    use crate::decoder::{Actions, Decoder};
    use crate::line::sealed;

    /// Reading of a twelve-bit converter, mounted upside down and askew, at this angle to the left, degrees.
    fn reading(degrees: f64) -> f64 {
        (2900.0 - 11.3 * degrees).round()
    }

    fn line(wheel: u32, crank: u32, degrees: f64, brake: u32) -> String {
        sealed(&format!("B1,0,0,{wheel},0,{crank},0,{},{brake}", reading(degrees)))
    }

    fn positions(kind: BicycleLineKind) -> BicyclePositions {
        BicyclePositions {
            kind,
            straight: SteadyReading { median: 2900.0, spread: 2.0 },
            left: Some((reading(45.0), 45_f64.to_radians())),
            right: Some((reading(-30.0), 30_f64.to_radians())),
            brake: Some([4000.0, 1200.0].map(|median| SteadyReading { median, spread: 3.0 })),
            pulses_per_turn: [3, 1],
            metres_per_turn: [2.1, 5.5],
        }
    }

    #[test]
    fn a_strange_converter_steers_right_afterwards() {
        let config = positions(BicycleLineKind::Pulses).settings(&BicycleConfig::default()).unwrap();
        let mut bicycle = BicycleDecoder::new(config.clone());
        for degrees in [-40.0, -5.0, 0.0, 12.0, 60.0] {
            bicycle.bytes(0, line(0, 0, degrees, 2600).as_bytes(), &mut Actions::default());
            let steered = bicycle.steer_rad().to_degrees();
            assert!((steered - degrees).abs() < 0.5, "{steered} for {degrees}");
            assert!((bicycle.brake() - 0.5).abs() < 1e-12);
        }
        assert_eq!((config.pulses_per_wheel_turn, config.speed_from), (3.0, SpeedSource::Wheel));
    }

    #[test]
    fn a_box_that_counts_the_crank_alone_rides_by_the_crank() {
        let crank = BicyclePositions { pulses_per_turn: [0, 2], ..positions(BicycleLineKind::Pulses) };
        let config = crank.settings(&BicycleConfig::default()).unwrap();
        assert_eq!((config.speed_from, config.pulses_per_crank_turn), (SpeedSource::Cadence, 2.0));
        // What sends no pulse at all changes nothing, and what has no handlebar leaves the steering to others.
        let still = BicyclePositions { pulses_per_turn: [0, 0], left: None, ..crank };
        let config = still.settings(&config).unwrap();
        assert_eq!((config.speed_from, config.handlebar), (SpeedSource::Cadence, false));
    }

    #[test]
    fn readings_are_collected_from_pieces_and_restarts() {
        let mut readings = RawReadings::default();
        let text = [line(10, 5, 0.0, 0), line(11, 5, 0.0, 0), line(0, 0, 0.0, 0), line(2, 1, 10.0, 7)].concat();
        text.as_bytes().chunks(3).for_each(|piece| readings.bytes(piece));
        assert_eq!((readings.kind(), readings.pulses()), (Some(BicycleLineKind::Pulses), [3, 1]));
        assert_eq!(readings.steer(), Some(SteadyReading { median: 2900.0, spread: 113.0 }));
        readings.settle();
        assert_eq!(readings.steer(), None);
        readings.bytes(b"nonsense\n");
        assert!(readings.last_fault().is_some_and(|fault| fault.contains("nonsense")));
    }

    #[test]
    fn a_sensor_that_does_not_follow_is_told() {
        let still = (2901.0, 0.7);
        for (left, right) in [(still, still), ((3000.0, 0.7), (3100.0, 0.7)), ((2900.0, 0.7), (2000.0, 0.7))] {
            let bad = BicyclePositions { left: Some(left), right: Some(right), ..positions(BicycleLineKind::Pulses) };
            let told = bad.settings(&BicycleConfig::default()).unwrap_err().to_string();
            assert!(told.contains("straight ahead") && told.contains("is it connected"), "{told}");
        }
        // Noise is no pull.
        let brake = [512.0, 513.0].map(|median| SteadyReading { median, spread: 2.0 });
        let bad = BicyclePositions { brake: Some(brake), ..positions(BicycleLineKind::Pulses) };
        assert!(bad.settings(&BicycleConfig::default()).unwrap_err().to_string().contains("lever released"));
        let askew = BicyclePositions { right: Some((3500.0, 0.2)), ..positions(BicycleLineKind::Pulses) };
        assert!(askew.is_lopsided() && !positions(BicycleLineKind::Pulses).is_lopsided());
    }
}
