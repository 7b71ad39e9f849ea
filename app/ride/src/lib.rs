//! Samples in, observers out: the vehicle that a rider drives, the ticks of its simulation, replays, what a film shows
//! between two frames, the scripted tour, and the log of a ride.

mod assist;
mod between_reports;
mod frame;
mod log;
mod past;
mod replay;
mod route;
mod setup;
mod shown_times;
mod simulation;
mod taker;
mod ticks;
mod tour;
pub mod vehicle;

pub use assist::AssistMode;
pub use frame::RideFrame;
pub use log::{LogError, RideLog};
pub use replay::{Replay, ReplayError, Replayed};
pub use setup::{RideStart, Setup, SetupError};
pub use shown_times::ShownTimes;
pub use simulation::{FASTEST_TIME_SCALE, Simulation};
pub use taker::FrameTaker;
pub use ticks::TICKS_PER_SECOND;
pub use tour::Tour;
pub use vehicle::{
    BicycleSettings, FlightSettings, IntegratorKind, LightSpeed, LightSpeedError, Nose, Notice, Odometer, RAPIDITY_CAP,
    SettingsError, Vehicle, VehicleSettings,
};
