//! Live devices on real terminals and sockets; each file says what it holds them to.
#![expect(clippy::unwrap_used, reason = "a test that cannot go on fails")]

mod dtrack;
mod frames;
mod listing;
#[cfg(target_os = "linux")]
mod serial;
#[cfg(unix)]
mod spacenavd;
mod vrpn;
