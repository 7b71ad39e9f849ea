//! Connection to a trainer that speaks FTMS over Direct Connect.
//!
//! This side asks for the services, then for the fitness machine's characteristics, and switches notifications on; all
//! that is asked has to be answered within a time. Then notifications are passed on as they come, in whole messages,
//! and the trainer is told the road ([`TrainerControl`]). A trainer that is silent is asked for its services again, so
//! that one that rests is told from one that is gone. When the ride ends, brake and control are released.
//!
//! The socket is closed by a reset when the trainer has gone: a server that was killed can listen again at once,
//! instead of waiting for its half-closed connection.

use std::io::{self, ErrorKind, Read, Write};
use std::net::{TcpStream, ToSocketAddrs};
use std::sync::Arc;
use std::sync::atomic::{AtomicI16, Ordering};
use std::time::{Duration, Instant};

use socket2::SockRef;

use super::fault::{DeviceFault, DeviceNote};
use super::feed::{DeviceConnection, DevicePort, OpenedDevice};
use super::flood_gate::{FloodGate, MessageKind};
use super::serial::passing;
use super::trainer_error::{TrainerError, TrainerRequest};
use crate::sample::SampleSource;
use crate::trainer::control::{TrainerControl, release};
use crate::trainer::url::TrainerUrl;
use crate::trainer::wire::{
    CAN_NOTIFY, CAN_WRITE, CHARACTERISTICS, CONTROL_POINT, DirectConnectMessage, DirectConnectPieces, ENABLE,
    FITNESS_MACHINE, INDOOR_BIKE_DATA, NOTIFICATION, POWER_MEASUREMENT, RequestRefusal, SERVICES, SPEED_MEASUREMENT,
    UUID_LENGTH, WRITE, short, uuid,
};

/// Longest wait for the connection.
const CONNECT_WAIT: Duration = Duration::from_secs(1);
/// Longest wait for all answers that a connection begins with, together.
const ANSWER_WAIT: Duration = Duration::from_secs(2);
/// Longest wait for the answer to each command that releases the brake, and for that to the command before it.
const RELEASE_WAIT: Duration = Duration::from_millis(300);
/// Longest wait of a read, and so the delay of a command.
const READ_WAIT: Duration = Duration::from_millis(50);
/// Longest wait of a write, for a trainer that does not read.
const WRITE_WAIT: Duration = Duration::from_millis(100);
/// Silence after which a trainer is asked for a sign of life.
const ASK_AFTER: Duration = Duration::from_secs(3);
/// Silence after which a trainer counts as gone.
const SILENCE: Duration = Duration::from_secs(10);
/// Most bytes taken at once.
const BUFFER: usize = 4096;

/// Other services whose notifications a ride can use, and the characteristic of each.
const OTHER_SERVICES: [(u16, u16); 2] = [(0x1818, POWER_MEASUREMENT), (0x1816, SPEED_MEASUREMENT)];

/// Address of a trainer, and the road for it.
pub(super) struct TrainerPort {
    url: TrainerUrl,
    /// Grade to simulate, in 0.01 %.
    grade: Arc<AtomicI16>,
}

impl TrainerPort {
    pub(super) fn new(url: TrainerUrl, grade: Arc<AtomicI16>) -> Self {
        Self { url, grade }
    }

    fn connect(&self) -> Result<TcpStream, DeviceFault> {
        let TrainerUrl { host, port } = &self.url;
        let addresses = (host.as_str(), *port)
            .to_socket_addrs()
            .map_err(|error| DeviceFault::NoHost(host.clone(), error.to_string()))?;
        let mut why = DeviceFault::NoAddress;
        for address in addresses {
            match connected(TcpStream::connect_timeout(&address, CONNECT_WAIT)) {
                Ok(stream) => return Ok(stream),
                Err(reason) => why = reason,
            }
        }
        Err(DeviceFault::NoTrainer(self.url.to_string(), Box::new(why)))
    }
}

/// Stream to another program, or the reason why there is none.
fn connected(outcome: io::Result<TcpStream>) -> Result<TcpStream, DeviceFault> {
    match outcome {
        // While no trainer listens, a port of this machine may be connected to itself.
        Ok(stream) if stream.local_addr().ok() == stream.peer_addr().ok() => Err(DeviceFault::NoTrainerThere),
        Ok(stream) => Ok(stream),
        Err(error) if error.kind() == ErrorKind::ConnectionRefused => Err(DeviceFault::NoTrainerThere),
        Err(error) if error.kind() == ErrorKind::TimedOut => Err(DeviceFault::NothingThere),
        Err(error) => Err(error.into()),
    }
}

impl DevicePort for TrainerPort {
    fn open(&mut self) -> Result<(OpenedDevice, Box<dyn DeviceConnection>), DeviceFault> {
        let stream = self.connect()?;
        let path = self.url.to_string();
        let link = TrainerLink::begin(stream, self.grade.clone())
            .map_err(|error| DeviceFault::NoTrainer(path.clone(), Box::new(DeviceFault::Trainer(error))))?;
        Ok((OpenedDevice { source: SampleSource::Trainer, name: "trainer".to_owned(), path }, Box::new(link)))
    }
}

/// Answer that is waited for: kind and number of its request, and what has come.
#[derive(Debug, Default)]
struct AwaitedAnswer {
    kind: u8,
    sequence: u8,
    /// Response code and data.
    came: Option<(u8, Vec<u8>)>,
}

/// Open connection to a trainer.
struct TrainerLink {
    stream: TcpStream,
    pieces: DirectConnectPieces,
    gate: FloodGate,
    sequence: u8,
    awaited: AwaitedAnswer,
    /// Number of the last command's write, until it is answered.
    writing: Option<u8>,
    /// Control of the brake; `None` where the trainer has no control point.
    control: Option<TrainerControl>,
    grade: Arc<AtomicI16>,
    /// Notifications that came before the trainer was open.
    early: Vec<u8>,
    last_heard: Instant,
    last_asked: Instant,
    /// True once the connection is broken: nothing can be released any more.
    broken: bool,
}

impl TrainerLink {
    /// Finds the fitness machine and switches its notifications on.
    fn begin(stream: TcpStream, grade: Arc<AtomicI16>) -> Result<Self, TrainerError> {
        stream.set_nodelay(true)?;
        stream.set_write_timeout(Some(WRITE_WAIT))?;
        stream.set_read_timeout(Some(READ_WAIT))?;
        SockRef::from(&stream).set_linger(Some(Duration::ZERO))?;
        let now = Instant::now();
        let mut link = Self {
            stream,
            pieces: DirectConnectPieces::default(),
            gate: FloodGate::new(now),
            sequence: 0,
            awaited: AwaitedAnswer::default(),
            writing: None,
            control: None,
            grade,
            early: Vec::new(),
            last_heard: now,
            last_asked: now,
            broken: false,
        };
        let deadline = now + ANSWER_WAIT;
        let services = link.ask(TrainerRequest::Services, SERVICES, &[], deadline)?;
        let services: Vec<Option<u16>> = services.as_chunks::<UUID_LENGTH>().0.iter().map(short).collect();
        if !services.contains(&Some(FITNESS_MACHINE)) {
            return Err(TrainerError::NoFitnessMachine(services));
        }
        let listed = link.ask(TrainerRequest::Characteristics, CHARACTERISTICS, &uuid(FITNESS_MACHINE), deadline)?;
        let records = listed.get(UUID_LENGTH..).unwrap_or_default().as_chunks::<{ UUID_LENGTH + 1 }>().0;
        let characteristics: Vec<(Option<u16>, u8)> = records.iter().map(characteristic).collect();
        let has = |number, property| characteristics.iter().any(|(n, can)| *n == Some(number) && can & property != 0);
        if !has(INDOOR_BIKE_DATA, CAN_NOTIFY) {
            let numbers: Vec<Option<u16>> = characteristics.iter().map(|(number, _)| *number).collect();
            return Err(TrainerError::NoBikeData(numbers));
        }
        link.ask(TrainerRequest::BikeData, ENABLE, &enabling(INDOOR_BIKE_DATA), deadline)?;
        // What follows is good to have: its answers are not waited for.
        for (_, measurement) in OTHER_SERVICES.iter().filter(|(service, _)| services.contains(&Some(*service))) {
            link.say(ENABLE, &enabling(*measurement))?;
        }
        if has(CONTROL_POINT, CAN_WRITE) {
            link.say(ENABLE, &enabling(CONTROL_POINT))?;
            link.control = Some(TrainerControl::new());
        }
        Ok(link)
    }

    /// Sends a request; returns its number.
    fn say(&mut self, kind: u8, data: &[u8]) -> io::Result<u8> {
        let sequence = self.sequence;
        self.sequence = sequence.wrapping_add(1);
        self.stream.write_all(&DirectConnectMessage { kind, sequence, response: 0, data }.to_bytes())?;
        Ok(sequence)
    }

    /// Sends a request and waits for the answer: its data.
    fn ask(&mut self, what: TrainerRequest, kind: u8, data: &[u8], deadline: Instant) -> Result<Vec<u8>, TrainerError> {
        match self.answer(kind, data, deadline)? {
            Some((0, data)) => Ok(data),
            Some((response, _)) => Err(TrainerError::Refused(what, RequestRefusal::of(response))),
            None => Err(TrainerError::Silent),
        }
    }

    /// Sends a request and waits for its answer, response code and data; `None` if none comes in time.
    fn answer(&mut self, kind: u8, data: &[u8], deadline: Instant) -> Result<Option<(u8, Vec<u8>)>, TrainerError> {
        let sequence = self.say(kind, data)?;
        self.awaited = AwaitedAnswer { kind, sequence, came: None };
        let mut early = std::mem::take(&mut self.early);
        while self.awaited.came.is_none() && Instant::now() < deadline {
            self.receive(&mut early)?;
        }
        self.early = early;
        Ok(std::mem::take(&mut self.awaited).came)
    }

    /// Waits a moment for bytes, and passes notifications on.
    fn receive(&mut self, bytes: &mut Vec<u8>) -> Result<(), TrainerError> {
        let mut buffer = [0; BUFFER];
        match self.stream.read(&mut buffer) {
            Ok(0) => Err(TrainerError::Closed),
            Ok(length) => self.take(&buffer[..length], bytes),
            Err(error) => {
                passing(Err(error))?;
                self.gate.release(Instant::now(), bytes);
                Ok(())
            }
        }
    }

    /// Takes the whole messages of these bytes: notifications of the ride go on to `bytes`.
    fn take(&mut self, received: &[u8], bytes: &mut Vec<u8>) -> Result<(), TrainerError> {
        let now = Instant::now();
        let mut outcome = Ok(());
        let (gate, control, awaited, writing, heard) =
            (&mut self.gate, &mut self.control, &mut self.awaited, &mut self.writing, &mut self.last_heard);
        self.pieces.push(received, |piece| match piece {
            Ok((message, raw)) => {
                *heard = now;
                match (message.kind, message.characteristic()) {
                    (NOTIFICATION, Some((CONTROL_POINT, value))) => {
                        control.iter_mut().for_each(|control| control.answered(now, value));
                    }
                    (NOTIFICATION, Some((INDOOR_BIKE_DATA | POWER_MEASUREMENT | SPEED_MEASUREMENT, value))) => {
                        gate.take(now, kind_of(message, value), raw, bytes);
                    }
                    (NOTIFICATION, _) => {}
                    (kind, _)
                        if (kind, message.sequence) == (awaited.kind, awaited.sequence) && awaited.came.is_none() =>
                    {
                        awaited.came = Some((message.response, message.data.to_vec()));
                    }
                    (WRITE, _) if *writing == Some(message.sequence) => {
                        *writing = None;
                        control.iter_mut().for_each(|control| control.written(now, message.response));
                    }
                    _ => {}
                }
            }
            Err(error) => outcome = Err(error.into()),
        });
        outcome
    }

    /// Asks for a sign of life when it is time; an error after too long a silence.
    fn watch(&mut self) -> io::Result<()> {
        let silence = self.last_heard.elapsed();
        if silence > SILENCE {
            return Err(DeviceFault::Silent(SILENCE.as_secs()).io(ErrorKind::TimedOut));
        }
        if silence > ASK_AFTER && self.last_asked.elapsed() > ASK_AFTER {
            self.last_asked = Instant::now();
            self.say(SERVICES, &[])?;
        }
        Ok(())
    }

    /// Sends the next command to the control point, if one is due.
    fn command(&mut self) -> io::Result<()> {
        let Some(control) = &mut self.control else {
            return Ok(());
        };
        control.want(self.grade.load(Ordering::Relaxed));
        match control.next(Instant::now()) {
            Some(value) => {
                self.writing = Some(self.say(WRITE, &[&uuid(CONTROL_POINT), &value[..]].concat())?);
                Ok(())
            }
            None => Ok(()),
        }
    }

    /// Waits a moment for the answers to the last command: a trainer that is busy with it refuses the next.
    fn settle(&mut self) -> Result<(), TrainerError> {
        let deadline = Instant::now() + RELEASE_WAIT;
        let waits =
            |link: &Self| link.writing.is_some() || link.control.as_ref().is_some_and(TrainerControl::is_waiting);
        let mut passed_over = Vec::new();
        while waits(self) && Instant::now() < deadline {
            self.receive(&mut passed_over)?;
        }
        Ok(())
    }

    /// Takes the road and the control back. A write that is refused is repeated once.
    fn release(&mut self) -> Result<(), TrainerError> {
        for value in release() {
            for _ in 0..2 {
                self.settle()?;
                self.writing = None;
                let now = Instant::now();
                self.control.iter_mut().for_each(|control| control.releases(now, value[0]));
                let data = [&uuid(CONTROL_POINT), &value[..]].concat();
                if self.answer(WRITE, &data, now + RELEASE_WAIT)?.is_none_or(|(response, _)| response == 0) {
                    break;
                }
            }
        }
        // The trainer has read everything: an ordinary end of the connection.
        SockRef::from(&self.stream).set_linger(None)?;
        Ok(())
    }
}

impl Drop for TrainerLink {
    fn drop(&mut self) {
        if !self.broken && self.control.as_ref().is_some_and(TrainerControl::is_engaged) {
            let _ = self.release();
        }
    }
}

/// Data of the request that switches notifications of a characteristic on.
fn enabling(characteristic: u16) -> Vec<u8> {
    [&uuid(characteristic)[..], &[1]].concat()
}

/// Short number and properties of a characteristic in a list.
fn characteristic(record: &[u8; UUID_LENGTH + 1]) -> (Option<u16>, u8) {
    let (uuid, properties) = record.split_first_chunk().expect("a record holds a UUID");
    (short(uuid), properties[0])
}

/// Kind of a notification: its characteristic and its flags, because divided data have different ones.
fn kind_of(message: DirectConnectMessage<'_>, value: &[u8]) -> MessageKind {
    let mut kind = MessageKind::default();
    kind[..4].copy_from_slice(&message.data[..4]);
    let flags = value.len().min(2);
    kind[4..4 + flags].copy_from_slice(&value[..flags]);
    kind
}

impl DeviceConnection for TrainerLink {
    fn read(&mut self, bytes: &mut Vec<u8>) -> io::Result<()> {
        bytes.append(&mut self.early);
        let outcome =
            self.watch().and_then(|()| self.command()).and_then(|()| self.receive(bytes).map_err(io::Error::from));
        self.broken = outcome.is_err();
        outcome
    }

    fn passed_over(&mut self) -> u64 {
        self.gate.passed_over()
    }

    fn note(&self) -> Option<DeviceNote> {
        match &self.control {
            Some(control) => control.refusal().map(DeviceNote::NoControl),
            None => Some(DeviceNote::NoControlPoint),
        }
    }
}

#[cfg(test)]
#[path = "trainer_tests.rs"]
mod tests;
