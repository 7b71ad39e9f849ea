//! Live devices on real terminals and sockets; each file says what it holds them to.

mod dtrack;
mod frames;
mod listing;
#[cfg(target_os = "linux")]
mod serial;
#[cfg(unix)]
mod spacenavd;
mod vrpn;
