//! Live devices on real terminals and sockets; the head of each file says which behaviour it tests.

mod dtrack;
mod frames;
mod listing;
mod opentrack;
#[cfg(target_os = "linux")]
mod serial;
#[cfg(unix)]
mod spacenavd;
mod trainer;
mod vrpn;
mod wand;
