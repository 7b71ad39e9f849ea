//! The vehicle: it turns the rider's controls into a worldline.
//!
//! # How it works
//!
//! There is one controller for three kinds of vehicle ([`input::VehicleKind`]). Each turns the rider's
//! [`input::Controls`] into a thrust and a turn rate in the pilot's own axes. An integrator of
//! [`physics::worldline`] makes a worldline of them, in proper time, which is the user's own time (B 2.7, 5.6.1):
//!
//! | kind | controls | keeps to |
//! |---|---|---|
//! | bicycle | wheel speed, handlebar, brake (`bicycle`) | the ground, the street |
//! | drive | two thrusts, rudder, brake (`flight`) | the ground, the street |
//! | fly | three thrusts, roll, rudder, brake (`flight`) | free space, if its hull has a radius (`hull`) |
//!
//! The celerity is never set directly, except by named constraints: wheels do not slip (`bicycle::roll`), walls hold
//! (`walls`, `hull`), the ground keeps what is on it (`footing`), the rapidity is capped at [`RAPIDITY_CAP`]. Motion
//! therefore never jumps, at rest, in reverse or at extreme speed; only a change of kind and a restart may make it
//! jump.
//!
//! A step depends only on the vehicle, the controls and the [`scene::Surroundings`]; the same calls give the same bits.
//!
//! # Example
//!
//! ```
//! use input::{Controls, VehicleKind};
//! use ride::{LightSpeed, Vehicle, VehicleSettings};
//! use scene::OpenPlane;
//!
//! let mut bicycle =
//!     Vehicle::new(LightSpeed::OLD_TOWN, VehicleKind::Bicycle, Default::default(), VehicleSettings::default())?;
//! let pedalling = Controls { wheel_speed: Some(25.0 / 3.0), ..Default::default() };
//! for _ in 0..20 * 240 {
//!     bicycle.step(1.0 / 240.0, &pedalling, &OpenPlane);
//! }
//! // A wheel at the speed of light on the rider's clock is a celerity of 1: 0.71 of the speed of light.
//! assert!((bicycle.state().celerity.magnitude() - 1.0).abs() < 1e-9);
//! # Ok::<(), ride::SettingsError>(())
//! ```

mod bicycle;
mod flight;
mod flying;
mod footing;
mod ground;
mod hull;
mod integration;
mod light_speed;
mod notice;
mod odometer;
mod riding;
mod safe_controls;
mod settings;
#[expect(clippy::module_inception, reason = "the type that the folder is named after")]
mod vehicle;
mod walls;

pub use light_speed::{LightSpeed, LightSpeedError};
pub use notice::{Notice, RAPIDITY_CAP};
pub use odometer::Odometer;
pub use settings::{BicycleSettings, FlightSettings, IntegratorKind, Nose, SettingsError, VehicleSettings};
pub use vehicle::Vehicle;
