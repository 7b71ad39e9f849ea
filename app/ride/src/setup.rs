//! Setup of a ride: everything that decides it besides samples and frame times, and how it is kept in a recording's
//! header.

use std::collections::BTreeMap;

use glam::{DQuat, DVec3};
use input::recording::RideHeader;
use input::{DeskConfig, VehicleKind};
use physics::worldline::WorldlineState;
use physics::{Celerity, CelerityError, Event};
use serde::{Deserialize, Serialize};
use thiserror::Error;

use crate::ticks::TICKS_PER_SECOND;
use crate::vehicle::{LightSpeed, LightSpeedError, SettingsError, VehicleSettings};

/// Initial data of a [`Simulation`](crate::Simulation), except for the scene itself.
#[derive(Clone, Debug, PartialEq)]
pub struct Setup {
    /// Speed of light in the world.
    pub light_speed: LightSpeed,
    /// Kind of vehicle: bicycle, drive or fly.
    pub kind: VehicleKind,
    /// Start of the ride, world axes.
    pub start: RideStart,
    /// Settings of the vehicles.
    pub vehicle: VehicleSettings,
    /// Settings of the devices.
    pub desk: DeskConfig,
}

/// Start of a ride, at world time 0.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct RideStart {
    /// Reference point, world axes, metres: on the ground for a bicycle and a car, the eye in flight.
    pub position: [f64; 3],
    /// Celerity, world axes.
    pub celerity: [f64; 3],
    /// Quaternion (x, y, z, w) from the pilot's axes (right, up, backward) to the world's.
    pub orientation: [f64; 4],
}

impl RideStart {
    /// Start at rest at `position`, with the nose along `look` (any length, not zero) and the roof as far towards `up`
    /// as that allows.
    pub fn at_rest(position: DVec3, look: DVec3, up: DVec3) -> Self {
        let nose = look.normalize_or(DVec3::NEG_Z);
        let up = up.normalize_or(DVec3::Y);
        let sideways = if nose.dot(up).abs() > 0.999 { nose.any_orthonormal_vector() } else { up };
        let right = nose.cross(sideways).normalize();
        let orientation = DQuat::from_mat3(&glam::DMat3::from_cols(right, right.cross(nose), -nose)).normalize();
        Self { position: position.to_array(), celerity: [0.0; 3], orientation: orientation.to_array() }
    }

    /// State of the vehicle at the start.
    ///
    /// # Errors
    /// [`SetupError`] if a number is not finite, the celerity is too large, or the orientation is not a rotation.
    pub fn state(&self) -> Result<WorldlineState, SetupError> {
        /// Largest deviation from length 1 of a quaternion that was written as a rotation.
        const LENGTH_TOLERANCE: f64 = 1e-6;
        let position = DVec3::from_array(self.position);
        if !position.is_finite() {
            return Err(SetupError::Position { position });
        }
        let celerity = Celerity::new(DVec3::from_array(self.celerity))?;
        let orientation = DQuat::from_array(self.orientation);
        let is_rotation = (orientation.length() - 1.0).abs() < LENGTH_TOLERANCE;
        if !is_rotation {
            return Err(SetupError::Orientation { orientation: self.orientation });
        }
        Ok(WorldlineState::new(Event { ct: 0.0, position }, celerity, orientation))
    }
}

/// Key of the header's setting that holds [`VehicleSettings`] as JSON.
const VEHICLE: &str = "vehicle";
/// Key of the header's setting that holds [`RideStart`] as JSON.
const START: &str = "start";

impl Setup {
    /// Header of a recording of this ride. The caller has to add what is needed to find the scene again.
    pub fn header(&self, build: &str, scene: &str) -> RideHeader {
        let json = |value: serde_json::Result<String>| value.expect("plain numbers and names are always JSON");
        RideHeader {
            build: build.to_owned(),
            scene: scene.to_owned(),
            speed_of_light_m_s: self.light_speed.speed_of_light_m_s(),
            vehicle: self.kind,
            integrator: self.vehicle.integrator.name().to_owned(),
            step_s: 1.0 / f64::from(TICKS_PER_SECOND),
            desk: self.desk.clone(),
            settings: BTreeMap::from([
                (VEHICLE.to_owned(), json(serde_json::to_string(&self.vehicle))),
                (START.to_owned(), json(serde_json::to_string(&self.start))),
            ]),
        }
    }

    /// Setup with which a recording was made.
    ///
    /// # Errors
    /// [`SetupError`] if something is missing, cannot be read or cannot be used, or if the ride was integrated in
    /// other steps than this program takes.
    pub fn from_header(header: &RideHeader) -> Result<Self, SetupError> {
        let vehicle: VehicleSettings = setting(header, VEHICLE)?;
        let step_s = 1.0 / f64::from(TICKS_PER_SECOND);
        if header.step_s != step_s || header.integrator != vehicle.integrator.name() {
            return Err(SetupError::Steps { integrator: header.integrator.clone(), step_s: header.step_s });
        }
        Ok(Self {
            light_speed: LightSpeed::new(header.speed_of_light_m_s)?,
            kind: header.vehicle,
            start: setting(header, START)?,
            vehicle,
            desk: header.desk.clone(),
        })
    }
}

fn setting<T: for<'a> Deserialize<'a>>(header: &RideHeader, key: &'static str) -> Result<T, SetupError> {
    let text = header.settings.get(key).ok_or(SetupError::Missing { key })?;
    serde_json::from_str(text).map_err(|cause| SetupError::Unreadable { key, cause: cause.to_string() })
}

/// Reason why a ride cannot begin.
#[derive(Clone, Debug, Error, PartialEq)]
pub enum SetupError {
    /// A device setting that cannot be used.
    #[error(transparent)]
    Desk(#[from] input::ConfigError),
    /// A vehicle setting that cannot be used.
    #[error(transparent)]
    Vehicle(#[from] SettingsError),
    /// A speed of light out of range.
    #[error(transparent)]
    LightSpeed(#[from] LightSpeedError),
    /// A celerity at the start that cannot be used.
    #[error("start: {0}")]
    Celerity(#[from] CelerityError),
    /// A start at a place that is not finite.
    #[error("the ride starts at {position}: expected three finite numbers")]
    Position {
        /// Position that was given.
        position: DVec3,
    },
    /// An orientation that is not a rotation.
    #[error("the ride starts with the orientation {orientation:?}: expected a quaternion of length 1")]
    Orientation {
        /// Quaternion that was given.
        orientation: [f64; 4],
    },
    /// A setting that is missing in the header.
    #[error("the recording's header has no setting \"{key}\": it was not made by a ride of this program")]
    Missing {
        /// Key of the setting.
        key: &'static str,
    },
    /// A setting of the header that cannot be read.
    #[error("the recording's setting \"{key}\" cannot be read: {cause}")]
    Unreadable {
        /// Key of the setting.
        key: &'static str,
        /// Reason, as the reader words it.
        cause: String,
    },
    /// Steps that this program does not take.
    #[error(
        "the recording was integrated by {integrator} in steps of {step_s} s, which this program cannot repeat; \
         replay it with the program that recorded it"
    )]
    Steps {
        /// Name of the recording's integrator.
        integrator: String,
        /// Step of the recording, seconds.
        step_s: f64,
    },
}

#[cfg(test)]
mod tests {
    //! Law under test: a setup survives its header. If it did not, another ride would be replayed.
    use super::*;

    fn setup() -> Setup {
        Setup {
            light_speed: LightSpeed::OLD_TOWN,
            kind: VehicleKind::Drive,
            start: RideStart::at_rest(DVec3::new(0.1, 1.0 / 3.0, -7e6), DVec3::new(1.0, 0.2, 0.3), DVec3::Y),
            vehicle: VehicleSettings::default(),
            desk: DeskConfig::default(),
        }
    }

    #[test]
    fn a_setup_survives_its_header() {
        let header = setup().header("0.1.0", "town");
        assert_eq!(Setup::from_header(&header).unwrap(), setup());
    }

    #[test]
    fn a_header_of_another_program_says_what_is_missing() {
        let mut header = setup().header("0.1.0", "town");
        header.step_s = 0.01;
        assert!(matches!(Setup::from_header(&header), Err(SetupError::Steps { .. })));
        let mut header = setup().header("0.1.0", "town");
        header.settings.insert(START.to_owned(), "7".to_owned());
        assert!(matches!(Setup::from_header(&header), Err(SetupError::Unreadable { key: "start", .. })));
        header.settings.remove(START);
        assert_eq!(Setup::from_header(&header), Err(SetupError::Missing { key: "start" }));
    }

    #[test]
    fn the_nose_points_along_the_look() {
        for look in [DVec3::X, DVec3::NEG_Z, DVec3::Y, DVec3::NEG_Y, DVec3::new(3.0, -4.0, 0.5)] {
            let state = RideStart::at_rest(DVec3::ZERO, look, DVec3::Y).state().unwrap();
            assert!((state.orientation * DVec3::NEG_Z - look.normalize()).length() < 1e-15, "{look}");
        }
    }

    #[test]
    fn a_start_that_cannot_be_used_is_refused() {
        let good = setup().start;
        assert!(RideStart { position: [f64::NAN, 0.0, 0.0], ..good }.state().is_err());
        assert!(RideStart { celerity: [f64::INFINITY, 0.0, 0.0], ..good }.state().is_err());
        for orientation in [[0.0; 4], [1.0; 4], [f64::NAN; 4]] {
            assert!(RideStart { orientation, ..good }.state().is_err());
        }
    }
}
