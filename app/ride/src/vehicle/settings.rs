//! Settings of the vehicles. Each of them affects the ride, so all of them are kept in a recording.

use clap::ValueEnum;
use serde::{Deserialize, Serialize};
use thiserror::Error;

use crate::assist::AssistMode;

/// Settings of a vehicle's response.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[serde(default, deny_unknown_fields)]
pub struct VehicleSettings {
    /// Settings of the bicycle.
    pub bicycle: BicycleSettings,
    /// Settings of driving and flying.
    pub flight: FlightSettings,
    /// Integrator of the worldline.
    pub integrator: IntegratorKind,
    /// Offset of the rider's or driver's eye from the reference point on the ground, metres: right, up, backward.
    pub eye_m: [f64; 3],
    /// Condition for assisted steering on the ground.
    pub assist: AssistMode,
    /// True if the ground keeps a bicycle and a car on it at any speed, and stops them where it ends; false in
    /// recordings made before it did.
    #[serde(default = "not_in_old_recordings")]
    pub keeps_to_ground: bool,
    /// True if clocks show the same time after a change of the speed of light as before; false in recordings made
    /// before they did.
    #[serde(default = "not_in_old_recordings")]
    pub keeps_seconds: bool,
    /// True if RK4 takes a step that would last longer for the chosen integrator than for the rider; false in
    /// recordings made before it did.
    #[serde(default = "not_in_old_recordings")]
    pub keeps_time: bool,
}

fn not_in_old_recordings() -> bool {
    false
}

impl Default for VehicleSettings {
    /// Default settings, with eyes at the height of a standing visitor.
    fn default() -> Self {
        Self {
            bicycle: BicycleSettings::default(),
            flight: FlightSettings::default(),
            integrator: IntegratorKind::default(),
            eye_m: [0.0, view::EYE_HEIGHT_M, 0.0],
            assist: AssistMode::Off,
            keeps_to_ground: true,
            keeps_seconds: true,
            keeps_time: true,
        }
    }
}

impl VehicleSettings {
    /// Checks every setting.
    ///
    /// # Errors
    /// [`SettingsError`] for the first setting that cannot be used.
    pub fn check(&self) -> Result<(), SettingsError> {
        let Self {
            bicycle,
            flight,
            integrator: _,
            eye_m,
            assist: _,
            keeps_to_ground: _,
            keeps_seconds: _,
            keeps_time: _,
        } = self;
        let positive = [
            ("bicycle.wheelbase_m", bicycle.wheelbase_m),
            ("bicycle.pedal_response_s", bicycle.pedal_response_s),
            ("bicycle.coast_response_s", bicycle.coast_response_s),
            ("bicycle.drag_m_s2", bicycle.drag_m_s2),
            ("bicycle.stop_m_s2", bicycle.stop_m_s2),
            ("flight.thrust_per_s", flight.thrust_per_s),
            ("flight.turn_rad_s", flight.turn_rad_s),
        ];
        for (key, value) in positive {
            if !(MODEST.contains(&value)) {
                return Err(SettingsError { key, value, expected: "a number from 0.001 to 1000" });
            }
        }
        if !(0.0..=LARGEST_HULL_M).contains(&flight.hull_m) {
            let (key, value) = ("flight.hull_m", flight.hull_m);
            return Err(SettingsError { key, value, expected: "a number of metres from 0 to 1000" });
        }
        match eye_m.iter().find(|offset| !(-FARTHEST_EYE_M..=FARTHEST_EYE_M).contains(*offset)) {
            Some(&value) => Err(SettingsError { key: "eye_m", value, expected: "three numbers from -1000 to 1000" }),
            None => Ok(()),
        }
    }
}

/// Range allowed for every positive setting. A vehicle outside it could not be ridden.
const MODEST: std::ops::RangeInclusive<f64> = 1e-3..=1e3;
/// Largest radius of a hull, metres.
const LARGEST_HULL_M: f64 = 1e3;
/// Largest offset of an eye from its vehicle along each axis, metres.
const FARTHEST_EYE_M: f64 = 1e3;

/// Setting that cannot be used.
#[derive(Clone, Debug, Error, PartialEq)]
#[error("vehicle setting {key} is {value}: expected {expected}")]
pub struct SettingsError {
    /// Full name of the setting.
    pub key: &'static str,
    /// Value of the setting.
    pub value: f64,
    /// Description of the values that are allowed.
    pub expected: &'static str,
}

/// Settings of the bicycle of B 5.6.1. Speeds and accelerations are as the rider measures them: road by the rider's
/// own clock.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[serde(default, deny_unknown_fields)]
pub struct BicycleSettings {
    /// Distance between the axles, metres.
    pub wheelbase_m: f64,
    /// Time constant with which the bicycle follows faster pedalling, seconds.
    pub pedal_response_s: f64,
    /// Time constant with which the bicycle follows slower pedalling, seconds: it rolls on.
    pub coast_response_s: f64,
    /// Deceleration with the brake lever half pulled, at the end of its first stage, m/s².
    pub drag_m_s2: f64,
    /// Deceleration with the lever fully pulled, at the end of its second stage, m/s².
    pub stop_m_s2: f64,
}

impl Default for BicycleSettings {
    /// Default settings: a heavy bicycle.
    fn default() -> Self {
        Self { wheelbase_m: 1.1, pedal_response_s: 0.7, coast_response_s: 3.0, drag_m_s2: 1.0, stop_m_s2: 6.0 }
    }
}

/// Settings of driving and flying (W 6.2, 6.3).
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[serde(default, deny_unknown_fields)]
pub struct FlightSettings {
    /// Proper acceleration at full deflection, as rapidity gained per second of own time.
    pub thrust_per_s: f64,
    /// Turn rate at full deflection, radians per second of own time.
    pub turn_rad_s: f64,
    /// Direction of the nose.
    pub nose: Nose,
    /// Radius of the sphere round the pilot's eye that passes through no surface, metres; 0 for a flight through
    /// everything, and in recordings made before flights had a hull.
    pub hull_m: f64,
}

impl Default for FlightSettings {
    /// Default settings: u = 1, that is β = 0.71, is reached after three seconds (asinh 1 / 3 s).
    fn default() -> Self {
        Self { thrust_per_s: 0.294, turn_rad_s: 1.0, nose: Nose::default(), hull_m: 0.0 }
    }
}

/// Turning of the nose of a driven or flown vehicle.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize, ValueEnum)]
#[serde(rename_all = "snake_case")]
pub enum Nose {
    /// The nose is turned to face the motion by lateral acceleration (W 6.2).
    #[default]
    #[value(name = "facing")]
    FacesMotion,
    /// The nose is held by gyroscopes: it turns only when told to, and by Thomas precession (Fermi–Walker transport).
    Gyroscopic,
}

/// Method of integrating the worldline.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize, ValueEnum)]
#[serde(rename_all = "snake_case")]
pub enum IntegratorKind {
    /// Classical Runge–Kutta method of fourth order.
    #[default]
    Rk4,
    /// The exact method for constant controls, the midpoint rule for others.
    Exact,
    /// Adaptive Dormand–Prince method (DOPRI5).
    #[value(name = "dopri5")]
    DormandPrince,
}

impl IntegratorKind {
    /// Integrator of that name.
    pub fn from_name(name: &str) -> Option<Self> {
        Self::value_variants().iter().copied().find(|kind| kind.name() == name)
    }

    /// Name in recordings and on the command line.
    pub fn name(self) -> &'static str {
        match self {
            Self::Rk4 => "rk4",
            Self::Exact => "exact",
            Self::DormandPrince => "dopri5",
        }
    }
}

#[cfg(test)]
mod tests {
    //! Law under test: settings survive a recording's header, and a setting that cannot be used is named. A wrong
    //! program replays another vehicle, or begins a ride that ends in numbers that are not finite.
    use super::*;

    #[test]
    fn the_defaults_are_sound_and_survive_their_text() {
        let settings = VehicleSettings::default();
        assert_eq!(settings.check(), Ok(()));
        let text = serde_json::to_string(&settings).unwrap();
        assert_eq!(serde_json::from_str::<VehicleSettings>(&text).unwrap(), settings);
    }

    #[test]
    fn a_setting_that_cannot_be_used_is_named() {
        for bad in [0.0, -1.0, f64::NAN, f64::INFINITY] {
            let mut settings = VehicleSettings::default();
            settings.bicycle.wheelbase_m = bad;
            assert_eq!(settings.check().unwrap_err().key, "bicycle.wheelbase_m");
            let mut settings = VehicleSettings::default();
            settings.flight.turn_rad_s = bad;
            assert_eq!(settings.check().unwrap_err().key, "flight.turn_rad_s");
        }
        let mut settings = VehicleSettings::default();
        settings.flight.hull_m = -1.0;
        assert_eq!(settings.check().unwrap_err().key, "flight.hull_m");
        let mut settings = VehicleSettings::default();
        settings.eye_m[2] = f64::NAN;
        assert_eq!(settings.check().unwrap_err().key, "eye_m");
    }
}
