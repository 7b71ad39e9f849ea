//! Search for devices on any machine: a missing or forbidden device must be no error, and its state must be told in a
//! sentence. A wrong program would panic where the system lacks a directory, or say nothing.

use std::path::PathBuf;

use super::frames::Loop;
use input::DevicesConfig;
use input::devices::{DeviceFault, DeviceState, plugged_in};

#[test]
fn a_machine_without_devices_is_no_error() {
    let mut looking = Loop::start(&DevicesConfig {
        bicycle: Some(String::new()),
        spacenavd_socket: Some(PathBuf::from("/nowhere/spnav.sock")),
        ..DevicesConfig::default()
    });
    looking.until("a word about every device", |it| {
        it.devices.status().iter().all(|status| match &status.state {
            DeviceState::Open => !status.path.is_empty(),
            DeviceState::Absent(why) => *why != DeviceFault::Sought && why.to_string().contains(' '),
        })
    });
}

#[test]
fn the_listing_names_what_it_lists() {
    for device in plugged_in() {
        assert!(!device.name.is_empty() && !device.path.is_empty(), "{device:?}");
        assert!(device.refused.is_none_or(|why| why.to_string().contains(' ')));
    }
}
