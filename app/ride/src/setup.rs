//! What decides a ride besides its samples and frame times, and how it is kept in a recording's header.

use std::collections::BTreeMap;

use glam::{DQuat, DVec3};
use input::recording::Header;
use input::{DeskConfig, VehicleKind};
use physics::worldline::State;
use physics::{Celerity, CelerityError, Event};
use serde::{Deserialize, Serialize};
use thiserror::Error;

use super::ticks::TICKS_PER_SECOND;
use crate::vehicle::{SettingsError, VehicleSettings, World, WorldError};

/// All that a [`Simulation`](super::Simulation) starts from, save for the place itself.
#[derive(Clone, Debug, PartialEq)]
pub struct Setup {
    /// Speed of light.
    pub world: World,
    /// Bicycle, drive or fly.
    pub kind: VehicleKind,
    /// Where it begins, world axes.
    pub start: Start,
    /// How the vehicles respond.
    pub vehicle: VehicleSettings,
    /// How the devices are read.
    pub desk: DeskConfig,
}

/// Where a ride begins, at world time 0.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Start {
    /// The reference point, world metres: on the ground for a bicycle and a car, the eye for one who flies.
    pub position: [f64; 3],
    /// Celerity in the world.
    pub celerity: [f64; 3],
    /// Quaternion (x, y, z, w) from the pilot's axes (right, up, backward) to the world's.
    pub orientation: [f64; 4],
}

impl Start {
    /// At rest at `position`, the nose along `look` (any length, not zero) and the roof as far up as that allows.
    pub fn at_rest(position: DVec3, look: DVec3) -> Self {
        let nose = look.normalize_or(DVec3::NEG_Z);
        let sideways = if nose.y.abs() > 0.999 { DVec3::NEG_Z } else { DVec3::Y };
        let right = nose.cross(sideways).normalize();
        let orientation = DQuat::from_mat3(&glam::DMat3::from_cols(right, right.cross(nose), -nose)).normalize();
        Self { position: position.to_array(), celerity: [0.0; 3], orientation: orientation.to_array() }
    }

    /// The state there.
    ///
    /// # Errors
    /// A number is not finite, the celerity is too large, or the orientation is not a rotation.
    pub fn state(&self) -> Result<State, SetupError> {
        /// A quaternion further than this from length 1 is none that was written as one.
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
        Ok(State::new(Event { ct: 0.0, position }, celerity, orientation))
    }
}

/// Key of the header's setting that holds [`VehicleSettings`] as JSON.
const VEHICLE: &str = "vehicle";
/// Key of the header's setting that holds [`Start`] as JSON.
const START: &str = "start";

impl Setup {
    /// The header of a recording of this ride. What the scene needs to be found again is the caller's to add.
    pub fn header(&self, build: &str, scene: &str) -> Header {
        let json = |value: serde_json::Result<String>| value.expect("plain numbers and names are always JSON");
        Header {
            build: build.to_owned(),
            scene: scene.to_owned(),
            speed_of_light_m_s: self.world.speed_of_light_m_s(),
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

    /// The setup that a recording was made with.
    ///
    /// # Errors
    /// Something is missing, cannot be read or cannot be used, or the ride was integrated in other steps than this program takes.
    pub fn from_header(header: &Header) -> Result<Self, SetupError> {
        let vehicle: VehicleSettings = setting(header, VEHICLE)?;
        let step_s = 1.0 / f64::from(TICKS_PER_SECOND);
        if header.step_s != step_s || header.integrator != vehicle.integrator.name() {
            return Err(SetupError::Steps { integrator: header.integrator.clone(), step_s: header.step_s });
        }
        Ok(Self {
            world: World::new(header.speed_of_light_m_s)?,
            kind: header.vehicle,
            start: setting(header, START)?,
            vehicle,
            desk: header.desk.clone(),
        })
    }
}

fn setting<T: for<'a> Deserialize<'a>>(header: &Header, key: &'static str) -> Result<T, SetupError> {
    let text = header.settings.get(key).ok_or(SetupError::Missing { key })?;
    serde_json::from_str(text).map_err(|cause| SetupError::Unreadable { key, cause: cause.to_string() })
}

/// Why a ride cannot begin.
#[derive(Clone, Debug, Error, PartialEq)]
pub enum SetupError {
    /// A device setting.
    #[error(transparent)]
    Desk(#[from] input::ConfigError),
    /// A vehicle setting.
    #[error(transparent)]
    Vehicle(#[from] SettingsError),
    /// The speed of light.
    #[error(transparent)]
    World(#[from] WorldError),
    /// The celerity at the start.
    #[error("start: {0}")]
    Celerity(#[from] CelerityError),
    /// A place that is none.
    #[error("the ride starts at {position}: expected three finite numbers")]
    Position {
        /// What was given.
        position: DVec3,
    },
    /// An orientation that is none.
    #[error("the ride starts with the orientation {orientation:?}: expected a quaternion of length 1")]
    Orientation {
        /// What was given.
        orientation: [f64; 4],
    },
    /// The header lacks something.
    #[error("the recording's header has no setting \"{key}\": it was not made by a ride of this program")]
    Missing {
        /// The key.
        key: &'static str,
    },
    /// The header holds something else.
    #[error("the recording's setting \"{key}\" cannot be read: {cause}")]
    Unreadable {
        /// The key.
        key: &'static str,
        /// What is wrong.
        cause: String,
    },
    /// Other steps.
    #[error(
        "the recording was integrated by {integrator} in steps of {step_s} s, which this program cannot repeat; \
         replay it with the program that recorded it"
    )]
    Steps {
        /// Name of its integrator.
        integrator: String,
        /// Its step, seconds.
        step_s: f64,
    },
}

#[cfg(test)]
mod tests {
    //! A setup that does not survive its header replays another ride.
    use super::*;

    fn setup() -> Setup {
        Setup {
            world: World::OLD_TOWN,
            kind: VehicleKind::Drive,
            start: Start::at_rest(DVec3::new(0.1, 1.0 / 3.0, -7e6), DVec3::new(1.0, 0.2, 0.3)),
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
    fn the_nose_points_where_one_looks() {
        for look in [DVec3::X, DVec3::NEG_Z, DVec3::Y, DVec3::NEG_Y, DVec3::new(3.0, -4.0, 0.5)] {
            let state = Start::at_rest(DVec3::ZERO, look).state().unwrap();
            assert!((state.orientation * DVec3::NEG_Z - look.normalize()).length() < 1e-15, "{look}");
        }
    }

    #[test]
    fn a_start_that_is_none_is_refused() {
        let good = setup().start;
        assert!(Start { position: [f64::NAN, 0.0, 0.0], ..good }.state().is_err());
        assert!(Start { celerity: [f64::INFINITY, 0.0, 0.0], ..good }.state().is_err());
        for orientation in [[0.0; 4], [1.0; 4], [f64::NAN; 4]] {
            assert!(Start { orientation, ..good }.state().is_err());
        }
    }
}
