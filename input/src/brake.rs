//! Brake commands that the program sends to the bicycle.
//!
//! The ergometer's brake is driven by the lever and by the forces of the simulation (B 5.6.1). The line is
//! `K1,<seq>,<brake 0..1>*HH`, with the same checksum as the lines that come in; the box may check `seq` to find lost
//! ones.

use crate::line::{LineError, sealed, unseal};

/// Brake command with its number.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct BrakeCommand {
    /// Number of the command; counts up by one, wraps.
    pub sequence: u32,
    /// Braking torque as a fraction of the brake's strongest, 0 to 1.
    pub brake: f64,
}

impl BrakeCommand {
    /// Line of the command, with its line feed. The brake is clamped to 0 to 1 and rounded to a thousandth; NaN gives
    /// 0.
    pub fn to_line(self) -> String {
        let brake = if self.brake.is_nan() { 0.0 } else { self.brake.clamp(0.0, 1.0) };
        sealed(&format!("K1,{},{brake:.3}", self.sequence))
    }

    /// Parses a line without its end, as the box does.
    ///
    /// # Errors
    /// A wrong checksum or field.
    pub fn parse(line: &str) -> Result<Self, LineError> {
        let text = unseal(line)?;
        let fields: Vec<&str> = text.split(',').collect();
        let ["K1", sequence, brake] = fields[..] else {
            return Err(LineError::Fields {
                line: line.to_owned(),
                found: fields.len(),
                expected: "3, the first `K1`",
            });
        };
        let wrong = |field, text: &str, expected| LineError::Field { field, text: text.to_owned(), expected };
        let sequence = sequence.parse().map_err(|_| wrong("seq", sequence, "a whole number"))?;
        match brake.parse::<f64>() {
            Ok(brake) if (0.0..=1.0).contains(&brake) => Ok(Self { sequence, brake }),
            _ => Err(wrong("brake", brake, "a number from 0 to 1")),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_command_survives_its_line() {
        for brake in [0.0, 0.25, 0.999, 1.0] {
            let command = BrakeCommand { sequence: u32::MAX, brake };
            assert_eq!(BrakeCommand::parse(command.to_line().trim_end()), Ok(command));
        }
        assert_eq!(BrakeCommand { sequence: 7, brake: 0.5 }.to_line(), "K1,7,0.500*66\n");
    }

    #[test]
    fn a_brake_out_of_range_is_clamped_and_one_that_is_no_number_lets_go() {
        for (brake, clamped) in [(-1.0, 0.0), (7.0, 1.0), (f64::NAN, 0.0), (f64::INFINITY, 1.0)] {
            let line = BrakeCommand { sequence: 0, brake }.to_line();
            assert_eq!(BrakeCommand::parse(line.trim_end()).unwrap().brake, clamped);
        }
    }

    #[test]
    fn other_lines_are_no_commands() {
        for text in ["K1,1", "K2,1,0.5", "K1,x,0.5", "K1,1,1.5", "K1,1,nan"] {
            assert!(BrakeCommand::parse(sealed(text).trim_end()).is_err(), "{text}");
        }
    }
}
