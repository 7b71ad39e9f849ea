//! The bicycle's serial port: lines in, brake commands out.

use std::io::{self, ErrorKind, Read, Write};
use std::sync::Arc;
use std::sync::atomic::{AtomicU64, Ordering};
use std::time::{Duration, Instant};

use super::fault::DeviceFault;
use super::feed::{DeviceConnection, DevicePort, OpenedDevice};
use crate::brake::BrakeCommand;
use crate::sample::SampleSource;

/// Longest wait of a read, and so the delay of a brake command on a silent line.
const READ_WAIT: Duration = Duration::from_millis(20);
/// Shortest time between brake commands.
const COMMAND_EVERY: Duration = Duration::from_millis(20);
/// Most bytes taken at once.
const BUFFER: usize = 1024;

/// Newest brake command not yet sent.
#[derive(Debug)]
pub(super) struct BrakeSlot(AtomicU64);

/// Bits of a NaN, for nothing to send.
const EMPTY: u64 = u64::MAX;

impl Default for BrakeSlot {
    fn default() -> Self {
        Self(AtomicU64::new(EMPTY))
    }
}

impl BrakeSlot {
    pub(super) fn set(&self, brake: f64) {
        self.0.store(brake.to_bits(), Ordering::Relaxed);
    }

    fn take(&self) -> Option<f64> {
        let bits = self.0.swap(EMPTY, Ordering::Relaxed);
        (bits != EMPTY).then(|| f64::from_bits(bits))
    }
}

/// Serial port of the bicycle, not yet open.
pub(super) struct SerialPort {
    path: String,
    baud: u32,
    brake: Arc<BrakeSlot>,
}

impl SerialPort {
    pub(super) fn new(path: &str, baud: u32, brake: Arc<BrakeSlot>) -> Self {
        Self { path: path.to_owned(), baud, brake }
    }
}

impl DevicePort for SerialPort {
    fn open(&mut self) -> Result<(OpenedDevice, Box<dyn DeviceConnection>), DeviceFault> {
        // The control lines are left alone: pseudo-terminals have none, and touching DTR resets many boards.
        let port = serialport::new(&self.path, self.baud).timeout(READ_WAIT).open().map_err(|error| {
            let path = self.path.clone();
            match error.kind() {
                serialport::ErrorKind::Io(ErrorKind::NotFound) => DeviceFault::NoSerialPort(path),
                serialport::ErrorKind::Io(ErrorKind::PermissionDenied) => DeviceFault::SerialPortForbidden(path),
                _ => DeviceFault::SerialPort(path, error.to_string()),
            }
        })?;
        let place = OpenedDevice { source: SampleSource::Bicycle, name: "bicycle".to_owned(), path: self.path.clone() };
        let wire = SerialLink { port, brake: self.brake.clone(), sequence: 0, last_command: None };
        Ok((place, Box::new(wire)))
    }
}

/// An open serial port.
struct SerialLink {
    port: Box<dyn serialport::SerialPort>,
    brake: Arc<BrakeSlot>,
    sequence: u32,
    last_command: Option<Instant>,
}

impl SerialLink {
    /// Sends the newest brake command, unless one has just been sent.
    fn command(&mut self) -> io::Result<()> {
        if self.last_command.is_some_and(|last| last.elapsed() < COMMAND_EVERY) {
            return Ok(());
        }
        match self.brake.take() {
            Some(brake) => self.send(brake),
            None => Ok(()),
        }
    }

    fn send(&mut self, brake: f64) -> io::Result<()> {
        let line = BrakeCommand { sequence: self.sequence, brake }.to_line();
        self.sequence = self.sequence.wrapping_add(1);
        self.last_command = Some(Instant::now());
        // A box that does not listen misses a command; the checksum reveals half of one.
        passing(self.port.write_all(line.as_bytes()))
    }
}

impl Drop for SerialLink {
    /// Releases the brake.
    fn drop(&mut self) {
        if self.last_command.is_some() {
            let _ = self.send(0.0);
        }
    }
}

impl DeviceConnection for SerialLink {
    fn read(&mut self, bytes: &mut Vec<u8>) -> io::Result<()> {
        self.command()?;
        let mut buffer = [0; BUFFER];
        match self.port.read(&mut buffer) {
            Ok(0) => Err(ErrorKind::UnexpectedEof.into()),
            Ok(length) => {
                bytes.extend_from_slice(&buffer[..length]);
                Ok(())
            }
            Err(error) => passing(Err(error)),
        }
    }
}

/// Turns a timeout or an interruption into success.
pub(super) fn passing(outcome: io::Result<()>) -> io::Result<()> {
    match outcome {
        Err(error) if matches!(error.kind(), ErrorKind::TimedOut | ErrorKind::WouldBlock | ErrorKind::Interrupted) => {
            Ok(())
        }
        outcome => outcome,
    }
}

/// All serial ports of the machine: path, and name of the device.
pub(super) fn ports() -> Vec<(String, String)> {
    // The serialport crate takes this directory for granted.
    if cfg!(target_os = "linux") && !std::path::Path::new("/sys/class/tty").is_dir() {
        return Vec::new();
    }
    let ports = serialport::available_ports().unwrap_or_default();
    ports
        .into_iter()
        .map(|port| {
            let name = match port.port_type {
                serialport::SerialPortType::UsbPort(usb) => {
                    usb.product.unwrap_or_else(|| format!("USB {:04x}:{:04x}", usb.vid, usb.pid))
                }
                _ => "serial port".to_owned(),
            };
            (port.port_name, name)
        })
        .collect()
}
