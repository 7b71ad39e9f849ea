//! `rapidity devices`: lists the devices that are plugged in, and their present values.

use crate::commands::calibrate::calibrate;
use crate::error::Error;
use crate::session::interrupt::interrupted;
use command::DevicesOptions;
use glam::EulerRot;
use hardware::heard;
use hardware::{BicyclePort, SetUp};
use hardware::{DESK, usual_display};
use hardware::{TrackerError, head_config};
use input::devices::{DeviceState, DeviceStatus, Devices, DevicesConfig, PluggedDevice, plugged_in};
use input::head::{TrackedHead, Tracking};
use input::{Clock, Controls, Desk, DeskConfig, HeadConfig, HeadState, Nanos, SECOND, WandState};
use regular_file::Budget;
use room::Display;
use std::fmt::Write as _;
use std::io::{IsTerminal, Write};
use std::sync::atomic::Ordering;
use std::time::Duration;
use words::Language;

/// Language of the terminal.
const LANGUAGE: Language = Language::English;
/// Time between two readings of the devices.
const INTERVAL: Duration = Duration::from_millis(200);
/// Number of bytes shown of a device's last sample.
const SHOWN_BYTES: usize = 16;
/// Time for which devices are watched if the output is not a terminal, seconds.
const UNATTENDED_SECONDS: f64 = 2.0;

/// Runs `rapidity devices`. On a terminal the listing stays in place and follows the devices until Ctrl-C.
///
/// # Errors
/// [`Error`] of a thread that cannot be started, or of a closed output.
pub fn devices(options: &DevicesOptions) -> Result<(), Error> {
    let file = options.set_up.as_deref().or(options.calibrate.as_deref().filter(|file| file.exists()));
    let named = |name: &String| Display::named_or_file_within(name, &Budget::default());
    let display = options.display.as_ref().map(named).transpose()?;
    let set_up = SetUp::of(display.as_ref(), file)?;
    // opentrack's poses count from the middle of a desk's display; other trackers' are shown as they come.
    let url = options.tracker.clone().or_else(|| set_up.tracker_url());
    let is_at_desk = url.is_some_and(|url| usual_display(&url) == DESK);
    let display = match display {
        None if is_at_desk => Display::built_in(DESK),
        display => display,
    };
    let of_file = set_up.port()?;
    let port = BicyclePort { port: options.bicycle.clone().or(of_file.port), ..of_file };
    if let Some(file) = &options.calibrate {
        return calibrate(file, &set_up, port);
    }
    let mut out = std::io::stdout();
    let terminal = out.is_terminal();
    writeln!(out, "{}", plugged(&plugged_in()))?;

    let clock = Clock::start();
    let head = head_of(options, display.as_ref(), &set_up)?;
    let tracker = head.as_ref().map(|head| head.url.clone());
    let wand_devices = head.as_ref().map(HeadConfig::wand_devices).unwrap_or_default();
    let mut desk = Desk::new(DeskConfig { head, ..set_up.desk()? })?;
    let usual = DevicesConfig::default();
    let baud = port.baud.unwrap_or(usual.baud);
    let trainer = options.trainer.clone().or(set_up.trainer()?.url);
    let has_trainer = trainer.is_some();
    let config = DevicesConfig { bicycle: port.port, baud, trainer, tracker, wand_devices, ..usual };
    let live = Devices::open(&config, clock)?;
    let stop = interrupted();
    let seconds = options.seconds.or((!terminal).then_some(UNATTENDED_SECONDS));
    let mut shown = 0;
    loop {
        std::thread::sleep(INTERVAL);
        for sample in live.drain() {
            desk.feed(&sample);
        }
        let now = clock.now();
        let over = stop.load(Ordering::Relaxed) || seconds.is_some_and(|seconds| now as f64 >= seconds * SECOND as f64);
        if terminal || over {
            let controls = desk.controls(now);
            let mut text = listing(&live.status(), &desk, &controls, now);
            if has_trainer {
                let _ = writeln!(text, "{}", heard::trainer(desk.trainer(), now, LANGUAGE));
            }
            if shown > 0 {
                // The cursor moves back to the beginning of the last listing.
                write!(out, "\x1b[{shown}A\x1b[J")?;
            }
            write!(out, "{text}")?;
            out.flush()?;
            shown = text.lines().count();
        }
        if over {
            return Ok(());
        }
    }
}

/// Tracking of the head by the set-up, or by the tracker that the options name.
fn head_of(options: &DevicesOptions, display: Option<&Display>, set_up: &SetUp) -> Result<Option<HeadConfig>, Error> {
    let mut head = head_config(display, set_up, options.tracker.as_ref())?;
    if let (None, Some(display), false) = (&head, display, set_up.names_a_ride()?) {
        return Err(TrackerError::Untracked(display.name.clone()).into());
    }
    match (&mut head, options.sensor) {
        (Some(head), Some(sensor)) => head.sensor = sensor,
        (None, Some(_)) => return Err(TrackerError::Sensor.into()),
        (_, None) => {}
    }
    Ok(head)
}

fn plugged(devices: &[PluggedDevice]) -> String {
    if devices.is_empty() {
        return "No serial port, SpaceMouse or gamepad is plugged in; the keyboard rides, too.".to_owned();
    }
    let mut text = "Plugged in:".to_owned();
    for device in devices {
        let _ = write!(text, "\n  {:<11} {}  {}", device.source.name(), device.path, device.name);
        if let Some(reason) = &device.refused {
            let _ = write!(text, "\n              {reason}");
        }
    }
    text
}

fn listing(statuses: &[DeviceStatus], desk: &Desk, controls: &Controls, now: Nanos) -> String {
    let mut text = String::new();
    for status in statuses {
        let source = status.source;
        let _ = match &status.state {
            DeviceState::Open => {
                let bytes: Vec<String> =
                    status.last.iter().take(SHOWN_BYTES).map(|byte| format!("{byte:02x}")).collect();
                writeln!(
                    text,
                    "{:<11} {} {}: {:.0} a second, {} in all, {} bad, {} dropped; last {}",
                    source.name(),
                    status.name,
                    status.path,
                    status.rate_hz,
                    status.samples,
                    desk.faults(source).number(),
                    status.dropped,
                    bytes.join(" ")
                )
            }
            DeviceState::Absent(why) => writeln!(text, "{:<11} {why}", source.name()),
        };
        let note = status.note.map(|note| note.to_string());
        let heard = heard::bad(desk, source, LANGUAGE).into_iter().chain(heard::things(desk, source, now, LANGUAGE));
        for line in note.into_iter().chain(heard) {
            let _ = writeln!(text, "{:<11} {line}", "");
        }
    }
    let wheel = controls.wheel_speed.map_or("none".to_owned(), |speed| format!("{:.2} m/s", speed));
    let axes = |axes: [f64; 3]| format!("{:+.2} {:+.2} {:+.2}", axes[0], axes[1], axes[2]);
    let _ = writeln!(
        text,
        "wheel {wheel} · handlebar {:+.1}° · brake {:.2} · thrust {} · turn {}",
        controls.steer_rad.to_degrees(),
        controls.brake,
        axes(controls.thrust),
        axes(controls.turn)
    );
    if let (Some(head), Some(state)) = (desk.head(), &controls.head) {
        let _ = writeln!(text, "{}", head_line(head, state, desk, now));
    }
    if let Some(wand) = &controls.wand {
        let _ = writeln!(text, "{}", wand_line(wand));
    }
    text
}

/// Line about the wand: its pose, and what is held.
fn wand_line(wand: &WandState) -> String {
    let tracked = tracked(wand.tracked);
    let [x, y, z] = wand.position_m.to_array();
    let held: Vec<String> = wand.buttons.numbers().map(|button| button.to_string()).collect();
    let held = if held.is_empty() { "no button".to_owned() } else { format!("button {}", held.join(", ")) };
    let ([right, ahead], trigger) = (wand.stick, wand.trigger);
    format!(
        "wand {tracked} · {x:+.3} {y:+.3} {z:+.3} m · {held} · stick {right:+.2} {ahead:+.2} · trigger {trigger:.2}"
    )
}

/// Words for the reliability of a pose.
fn tracked(tracked: Tracking) -> &'static str {
    match tracked {
        Tracking::Never => "not seen yet",
        Tracking::Tracked => "tracked",
        Tracking::Fading | Tracking::Lost => "lost",
    }
}

/// Line about the head: its pose, and reasons why it is not tracked.
fn head_line(head: &TrackedHead, state: &HeadState, desk: &Desk, now: Nanos) -> String {
    let tracked = tracked(state.tracked);
    let [x, y, z] = state.position_m.to_array();
    let (yaw, pitch, roll) = state.orientation.to_euler(EulerRot::YXZ);
    let mut text = format!(
        "head {tracked} · {x:+.3} {y:+.3} {z:+.3} m · yaw {:+.1}° pitch {:+.1}° roll {:+.1}° · {:.2} m/s · {} rejected",
        yaw.to_degrees(),
        pitch.to_degrees(),
        roll.to_degrees(),
        state.velocity_m_s.length(),
        head.rejected().number()
    );
    if let Some(why) = head.rejected().last() {
        let _ = write!(text, " ({why})");
    }
    if let Some(advice) = desk.tracker_advice(now) {
        let _ = write!(text, "; {advice}");
    }
    text
}
