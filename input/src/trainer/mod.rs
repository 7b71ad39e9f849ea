//! The trainer: a motor-braked bicycle stand that speaks FTMS, Bluetooth's Fitness Machine Service, over TCP.
//!
//! The transport is Wahoo's Direct Connect: the requests and notifications of Bluetooth in messages with a header of
//! six bytes (`wire`). The trainer notifies its speed, cadence and power one to four times a second (`indoor_bike`),
//! and is told the slope of the road at its control point (`control`). Wheel and crank revolutions of the services for
//! power meters and speed sensors are understood as well (`revolutions`), for trainers whose bike data lack them.
//!
//! Notifications alone are samples; requests and answers decide nothing of a ride. Between two notifications the speed
//! glides, as a bicycle's bare numbers do.

pub(crate) mod config;
pub(crate) mod control;
pub(crate) mod decoder;
mod indoor_bike;
mod revolutions;
pub(crate) mod url;
pub mod wire;

pub use config::TrainerConfig;
pub use control::{ControlRefusal, RoadLoad};
pub use decoder::TrainerDecoder;
pub use url::{TrainerUrl, TrainerUrlError};
