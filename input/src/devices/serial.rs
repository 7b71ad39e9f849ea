//! The bicycle's serial port: lines in, brake commands out.

use std::io::{self, ErrorKind, Read, Write};
use std::sync::Arc;
use std::sync::atomic::{AtomicU64, Ordering};
use std::time::{Duration, Instant};

use super::feed::{DeviceConnection, DevicePort, OpenedDevice};
use crate::brake::BrakeCommand;
use crate::sample::SampleSource;

/// How long a read waits, and so how late a brake command may be on a silent line.
const READ_WAIT: Duration = Duration::from_millis(20);
/// Brake commands are at least this far apart.
const COMMAND_EVERY: Duration = Duration::from_millis(20);
/// Bytes taken at once.
const BUFFER: usize = 1024;

/// The newest brake command that has not been sent.
#[derive(Debug)]
pub(super) struct BrakeSlot(AtomicU64);

/// Nothing to send: the bits of a number that is none.
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

/// Where the bicycle is plugged in.
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
    fn open(&mut self) -> Result<(OpenedDevice, Box<dyn DeviceConnection>), String> {
        // The control lines are left alone: pseudo-terminals have none, and touching DTR resets
        // many a board.
        let port = serialport::new(&self.path, self.baud).timeout(READ_WAIT).open().map_err(|error| {
            let path = &self.path;
            match error.kind() {
                serialport::ErrorKind::Io(ErrorKind::NotFound) => {
                    format!("there is no {path}: plug the bicycle in, or name another port")
                }
                serialport::ErrorKind::Io(ErrorKind::PermissionDenied) => {
                    format!("{path} may not be opened: `sudo usermod -aG dialout $USER`, then log in again")
                }
                _ => format!("{path} cannot be opened as a serial port: {error}"),
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
        // A box that does not listen misses a command; the checksum tells it of half a one.
        passing(self.port.write_all(line.as_bytes()))
    }
}

impl Drop for SerialLink {
    /// Nobody is left to brake for.
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

/// Takes what will pass for no error.
pub(super) fn passing(outcome: io::Result<()>) -> io::Result<()> {
    match outcome {
        Err(error) if matches!(error.kind(), ErrorKind::TimedOut | ErrorKind::WouldBlock | ErrorKind::Interrupted) => {
            Ok(())
        }
        outcome => outcome,
    }
}

/// Every serial port of the machine: path, and what is plugged into it.
pub(super) fn ports() -> Vec<(String, String)> {
    // The crate takes this directory for granted.
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
