//! Codes of Linux's `input-event-codes.h`.

/// Number of absolute axes in evdev.
pub(crate) const AXES: usize = 64;
/// Event type: a button.
pub const KEY: u16 = 1;
/// Event type: an axis.
pub const ABSOLUTE: u16 = 3;
pub(crate) const X: u16 = 0;
pub(crate) const Y: u16 = 1;
pub(crate) const Z: u16 = 2;
pub(crate) const RX: u16 = 3;
pub(crate) const RY: u16 = 4;
pub(crate) const RZ: u16 = 5;
pub(crate) const HAT_X: u16 = 16;
pub(crate) const HAT_Y: u16 = 17;
/// First button of a joystick.
pub const TRIGGER: u16 = 0x120;
pub(crate) const THUMB: u16 = 0x121;
/// First button of a gamepad.
pub const SOUTH: u16 = 0x130;
pub(crate) const EAST: u16 = 0x131;
pub(crate) const NORTH: u16 = 0x133;
pub(crate) const WEST: u16 = 0x134;
pub(crate) const LEFT_SHOULDER: u16 = 0x136;
pub(crate) const RIGHT_SHOULDER: u16 = 0x137;
pub(crate) const SELECT: u16 = 0x13a;
pub(crate) const START: u16 = 0x13b;
pub(crate) const RIGHT_STICK: u16 = 0x13e;
