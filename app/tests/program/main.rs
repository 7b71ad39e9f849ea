//! Tests of the program as a process, one module a subject.
#![allow(clippy::unwrap_used, reason = "what cannot be read or started is a failed test")]

#[cfg(unix)]
mod bicycle_set_up;
#[cfg(target_os = "linux")]
mod cache;
mod calibration;
mod check;
#[cfg(target_os = "linux")]
mod farm;
#[cfg(target_os = "linux")]
mod films;
#[cfg(target_os = "linux")]
mod first_time;
mod first_view;
mod kiosk;
mod measure;
#[cfg(target_os = "linux")]
mod measure_gpu;
mod models;
#[cfg(target_os = "linux")]
mod outputs;
#[cfg(all(target_os = "linux", target_env = "gnu"))]
mod portable;
mod probe;
mod recording;
#[cfg(unix)]
mod ride;
mod runner;
#[cfg(unix)]
mod trace;
mod tracker;
mod trainer;
mod turning_head;
#[cfg(target_os = "linux")]
mod virtual_display;
#[cfg(target_os = "linux")]
mod walls;
#[cfg(target_os = "linux")]
mod wand_server;
#[cfg(target_os = "linux")]
mod window;
