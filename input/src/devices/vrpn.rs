//! Connection to a VRPN server over TCP alone.
//!
//! Both sides begin with their cookies. The server's is awaited here, to tell a tracker from a server that speaks
//! something else. Then this side names the device that it listens to and sends a ping once a second, as VRPN's own
//! clients do. The server's bytes are passed on as they come, in whole messages: a message that has to be dropped
//! then does not shift those behind it.
//!
//! The connection ends with a reset, however this side ends: the stock server cannot be started again as long as the
//! system remembers an ordinary end of a connection at its port, which is for a minute.

use std::io::{self, ErrorKind, Read, Write};
use std::net::{TcpStream, ToSocketAddrs};
use std::time::{Duration, Instant};

use socket2::SockRef;

use super::fault::DeviceFault;
use super::feed::{DeviceConnection, DevicePort, OpenedDevice};
use super::flood_gate::{FloodGate, MessageKind};
use super::serial::passing;
use crate::sample::SampleSource;
use crate::vrpn::numbers::VrpnNumbers;
use crate::vrpn::types::{PING, PONG};
use crate::vrpn::wire::{
    COOKIE, COOKIE_LENGTH, DESCRIBES_SENDER, DESCRIBES_TYPE, VrpnError, VrpnMessage, VrpnPiece, VrpnPieces, description,
};

/// Longest wait for the connection and the server's cookie.
const CONNECT_WAIT: Duration = Duration::from_secs(1);
/// Longest wait of a read.
const READ_WAIT: Duration = Duration::from_millis(100);
/// Longest wait of a write, for a server that does not read.
const WRITE_WAIT: Duration = Duration::from_millis(100);
/// Time between two pings.
const PING_EVERY: Duration = Duration::from_secs(1);
/// Silence after which a server counts as gone, as in VRPN itself.
const SILENCE: Duration = Duration::from_secs(10);
/// Most bytes taken at once.
const BUFFER: usize = 4096;
/// Most descriptions kept, for the samples after some had to be dropped.
const MOST_DESCRIPTIONS: usize = 256;

/// Numbers of this side for the two types of message; its numbers for the devices are 0, 1, ….
const OUR_PING: i32 = 0;
const OUR_PONG: i32 = 1;

/// Address of a server, and the devices on it: the head's, then those of the wand.
pub(super) struct VrpnPort {
    host: String,
    port: u16,
    devices: Vec<String>,
}

impl VrpnPort {
    pub(super) fn new(host: &str, port: u16, device: &str, others: &[String]) -> Self {
        let devices = [&[device.to_owned()], others].concat();
        Self { host: host.to_owned(), port, devices }
    }

    fn connect(&self) -> Result<TcpStream, DeviceFault> {
        let place = format!("{}:{}", self.host, self.port);
        let addresses = (self.host.as_str(), self.port)
            .to_socket_addrs()
            .map_err(|error| DeviceFault::NoHost(self.host.clone(), error.to_string()))?;
        let mut why = DeviceFault::NoAddress;
        for address in addresses {
            match TcpStream::connect_timeout(&address, CONNECT_WAIT) {
                // While no server listens, a port may be connected to itself.
                Ok(stream) if stream.local_addr().ok() == stream.peer_addr().ok() => {
                    why = DeviceFault::NoVrpnThere;
                }
                Ok(stream) => return Ok(stream),
                Err(error) if error.kind() == ErrorKind::ConnectionRefused => {
                    why = DeviceFault::NoVrpnThere;
                }
                Err(error) => why = error.into(),
            }
        }
        Err(DeviceFault::NoVrpnServer(place, Box::new(why)))
    }
}

impl DevicePort for VrpnPort {
    fn open(&mut self) -> Result<(OpenedDevice, Box<dyn DeviceConnection>), DeviceFault> {
        let path = format!("{}:{}", self.host, self.port);
        let stream = self.connect()?;
        let link = VrpnLink::begin(stream, &self.devices)
            .map_err(|error| DeviceFault::At(path.clone(), Box::new(error.into())))?;
        let place = OpenedDevice { source: SampleSource::Vrpn, name: self.devices[0].clone(), path };
        Ok((place, Box::new(link)))
    }
}

/// Open connection to a server.
struct VrpnLink {
    stream: TcpStream,
    pieces: VrpnPieces,
    /// Names of the devices that are listened to.
    devices: Vec<String>,
    numbers: VrpnNumbers,
    /// Cookie of the server, then its descriptions, as they came.
    descriptions: Vec<Vec<u8>>,
    /// Bytes that the next sample begins with.
    first: Vec<u8>,
    gate: FloodGate,
    last_ping: Option<Instant>,
    last_heard: Instant,
}

impl VrpnLink {
    /// Exchanges the cookies and names the devices.
    fn begin(mut stream: TcpStream, devices: &[String]) -> io::Result<Self> {
        // The end of this side, a crash included, is then a reset.
        SockRef::from(&stream).set_linger(Some(Duration::ZERO))?;
        stream.set_nodelay(true)?;
        stream.set_write_timeout(Some(WRITE_WAIT))?;
        stream.set_read_timeout(Some(CONNECT_WAIT))?;
        stream.write_all(&COOKIE)?;

        let cookie = cookie_of(&mut stream)?;
        let mut pieces = VrpnPieces::default();
        let mut outcome = Ok(());
        pieces.push(&cookie, |piece| outcome = piece.map(|_| ()));
        outcome.map_err(invalid)?;

        stream.set_read_timeout(Some(READ_WAIT))?;
        let senders = (0..).zip(devices).map(|(number, device)| description(DESCRIBES_SENDER, number, device));
        let types = [(OUR_PING, PING), (OUR_PONG, PONG)];
        let types = types.map(|(number, name)| description(DESCRIBES_TYPE, number, name));
        stream.write_all(&senders.chain(types).collect::<Vec<_>>().concat())?;
        Ok(Self {
            stream,
            pieces,
            devices: devices.to_vec(),
            numbers: VrpnNumbers::of_devices(devices.iter().map(String::as_str)),
            descriptions: vec![cookie.to_vec()],
            first: cookie.to_vec(),
            gate: FloodGate::new(Instant::now()),
            last_ping: None,
            last_heard: Instant::now(),
        })
    }

    fn say(&mut self, sender: i32, kind: i32) -> io::Result<()> {
        let message = VrpnMessage { seconds: 0, microseconds: 0, sender, kind, payload: &[] };
        self.stream.write_all(&message.to_bytes())
    }

    /// Sends a ping to each device when it is time, upon which buttons also report anew; an error after too long a
    /// silence.
    fn ping(&mut self) -> io::Result<()> {
        if self.last_heard.elapsed() > SILENCE {
            let is_missing = self.numbers.missing().any(|name| name == self.devices[0]);
            // A server repeats the descriptions of its clients.
            let mut others = self.numbers.senders();
            others.retain(|name| !self.devices.contains(name));
            let fault = match others.join(", ") {
                _ if !is_missing => DeviceFault::Silent(SILENCE.as_secs()),
                none if none.is_empty() => DeviceFault::SilentWithoutDevices(SILENCE.as_secs()),
                others => DeviceFault::SilentWithOthers(SILENCE.as_secs(), others),
            };
            return Err(fault.io(ErrorKind::TimedOut));
        }
        if self.last_ping.is_some_and(|last| last.elapsed() < PING_EVERY) {
            return Ok(());
        }
        self.last_ping = Some(Instant::now());
        (0..).take(self.devices.len()).try_for_each(|sender| self.say(sender, OUR_PING))
    }

    /// Passes on the whole messages of these bytes, and answers a ping.
    fn take(&mut self, received: &[u8], bytes: &mut Vec<u8>) -> io::Result<()> {
        let mut outcome = Ok(());
        let mut asked = Vec::new();
        let (numbers, descriptions, gate) = (&mut self.numbers, &mut self.descriptions, &mut self.gate);
        let devices = &self.devices;
        let now = Instant::now();
        self.pieces.push(received, |piece| match piece {
            Ok(VrpnPiece::Cookie(_)) if outcome.is_ok() => {
                outcome = Err(invalid(VrpnError::NotVrpn("a second cookie".to_owned())));
            }
            Ok(VrpnPiece::Message(message, raw)) if outcome.is_ok() => {
                gate.take(now, kind_of(&message), raw, bytes);
                // The decoder counts descriptions that cannot be read.
                if numbers.describe(&message) == Ok(true) {
                    keep(descriptions, raw);
                }
                if numbers.kind(&message) == Some(PING) {
                    let name = numbers.sender(&message);
                    let ours = (0..).zip(devices).find(|(_, device)| name == Some(device)).map(|(sender, _)| sender);
                    asked.extend(ours.filter(|sender| !asked.contains(sender)));
                }
            }
            Ok(_) => {}
            Err(error) => outcome = Err(invalid(error)),
        });
        outcome.and_then(|()| asked.into_iter().try_for_each(|sender| self.say(sender, OUR_PONG)))
    }
}

/// Cookie of the server, which must come as a whole before the wait is over, in whatever pieces.
fn cookie_of(stream: &mut TcpStream) -> io::Result<[u8; COOKIE_LENGTH]> {
    let silent = || DeviceFault::NoGreeting.io(ErrorKind::TimedOut);
    let deadline = Instant::now() + CONNECT_WAIT;
    let mut cookie = [0; COOKIE_LENGTH];
    let mut length = 0;
    while length < COOKIE_LENGTH {
        let left = deadline.saturating_duration_since(Instant::now());
        if left.is_zero() {
            return Err(silent());
        }
        stream.set_read_timeout(Some(left))?;
        match stream.read(&mut cookie[length..]) {
            Ok(0) => return Err(ErrorKind::UnexpectedEof.into()),
            Ok(more) => length += more,
            Err(error) => match error.kind() {
                ErrorKind::TimedOut | ErrorKind::WouldBlock => return Err(silent()),
                ErrorKind::Interrupted => {}
                _ => return Err(error),
            },
        }
    }
    Ok(cookie)
}

/// Kind of a message: its sender and type, and the number of the sensor, with which messages of trackers begin.
fn kind_of(message: &VrpnMessage<'_>) -> MessageKind {
    let mut kind = MessageKind::default();
    kind[..4].copy_from_slice(&message.sender.to_be_bytes());
    kind[4..8].copy_from_slice(&message.kind.to_be_bytes());
    let sensor = message.payload.len().min(4);
    kind[8..8 + sensor].copy_from_slice(&message.payload[..sensor]);
    // Of descriptions the sender is what is described, and the payload its name.
    if matches!(message.kind, DESCRIBES_SENDER | DESCRIBES_TYPE) {
        kind[8..].fill(0);
    }
    kind
}

/// Keeps a description, in place of an earlier one of the same number.
fn keep(descriptions: &mut Vec<Vec<u8>>, raw: &[u8]) {
    // Bytes of sender and type, which say what is described.
    let what = 12..20;
    let same = descriptions.iter().skip(1).position(|known| known[what.clone()] == raw[what.clone()]);
    match same {
        Some(index) => descriptions[1 + index] = raw.to_vec(),
        None if descriptions.len() < MOST_DESCRIPTIONS => descriptions.push(raw.to_vec()),
        None => {}
    }
}

fn invalid(error: VrpnError) -> io::Error {
    io::Error::new(ErrorKind::InvalidData, error)
}

impl DeviceConnection for VrpnLink {
    fn read(&mut self, bytes: &mut Vec<u8>) -> io::Result<()> {
        self.ping()?;
        let mut buffer = [0; BUFFER];
        let mut messages = Vec::new();
        match self.stream.read(&mut buffer) {
            Ok(0) => return Err(ErrorKind::UnexpectedEof.into()),
            Ok(length) => {
                self.last_heard = Instant::now();
                self.take(&buffer[..length], &mut messages)?;
            }
            Err(error) => {
                passing(Err(error))?;
                self.gate.release(Instant::now(), &mut messages);
            }
        }
        // They are no sample of their own: in a flood that would drop another one, and so on.
        if !messages.is_empty() {
            bytes.append(&mut self.first);
            bytes.append(&mut messages);
        }
        Ok(())
    }

    fn passed_over(&mut self) -> u64 {
        self.gate.passed_over()
    }

    /// Repeats the descriptions, since a dropped sample may have held some.
    fn report_all(&mut self) {
        self.first = self.descriptions.concat();
    }
}

#[cfg(test)]
mod tests {
    //! A server that dies without a word must be noticed, and a mistaken name of the device be reported.
    use std::net::TcpListener;

    use super::*;
    use crate::vrpn::golden;

    /// Both ends of a connection after the cookies: the client's and the server's.
    fn link() -> (VrpnLink, TcpStream) {
        let listener = TcpListener::bind("127.0.0.1:0").unwrap();
        let stream = TcpStream::connect(listener.local_addr().unwrap()).unwrap();
        let mut server = listener.accept().unwrap().0;
        server.write_all(&COOKIE).unwrap();
        (VrpnLink::begin(stream, &["Tail".to_owned(), "Wand".to_owned()]).unwrap(), server)
    }

    #[test]
    fn a_silent_server_is_gone_and_a_mistaken_name_told() {
        let (mut link, mut server) = link();
        let mut bytes = Vec::new();
        link.last_heard = Instant::now().checked_sub(SILENCE + READ_WAIT).unwrap();
        let text = link.read(&mut bytes).unwrap_err().to_string();
        assert_eq!(text, "silent for 10 s; it has described no device");

        server.write_all(&golden::bytes(golden::SENDER)).unwrap();
        link.last_heard = Instant::now();
        while bytes.is_empty() {
            link.read(&mut bytes).unwrap();
        }
        assert_eq!(bytes, [COOKIE.to_vec(), golden::bytes(golden::SENDER)].concat());
        link.last_heard = Instant::now().checked_sub(SILENCE + READ_WAIT).unwrap();
        let text = link.read(&mut bytes).unwrap_err().to_string();
        assert_eq!(text, "silent for 10 s; it has no such device, but Head");

        // The description of what this side has named is no device; its answer is.
        let [echo, pong] = [(DESCRIBES_SENDER, 5, "Tail"), (DESCRIBES_TYPE, 6, PONG)]
            .map(|(kind, number, name)| description(kind, number, name));
        let answer = VrpnMessage { seconds: 0, microseconds: 0, sender: 5, kind: 6, payload: &[] }.to_bytes();
        for (sent, expected) in
            [(echo, "silent for 10 s; it has no such device, but Head"), ([pong, answer].concat(), "silent for 10 s")]
        {
            server.write_all(&sent).unwrap();
            link.last_heard = Instant::now();
            bytes.clear();
            while bytes.len() < sent.len() {
                link.read(&mut bytes).unwrap();
            }
            link.last_heard = Instant::now().checked_sub(SILENCE + READ_WAIT).unwrap();
            assert_eq!(link.read(&mut bytes).unwrap_err().to_string(), expected);
        }
    }

    #[test]
    fn after_a_loss_the_stream_begins_anew_with_what_was_described() {
        let (mut link, mut server) = link();
        let mut bytes = Vec::new();
        let later = description(DESCRIBES_SENDER, 1, "Tail");
        let sent = [golden::bytes(golden::SENDER), golden::bytes(golden::TYPE), later.clone()].concat();
        server.write_all(&sent).unwrap();
        let expected = [COOKIE.to_vec(), sent].concat();
        while bytes.len() < expected.len() {
            link.read(&mut bytes).unwrap();
        }
        assert_eq!(bytes, expected);
        link.report_all();
        let pose = golden::bytes(golden::IDENTITY);
        server.write_all(&pose).unwrap();
        bytes.clear();
        while bytes.is_empty() {
            link.read(&mut bytes).unwrap();
        }
        assert_eq!(bytes, [COOKIE.to_vec(), later, golden::bytes(golden::TYPE), pose].concat());
    }

    #[test]
    fn a_cookie_that_dribbles_is_waited_for_no_longer_than_a_silent_server() {
        let listener = TcpListener::bind("127.0.0.1:0").unwrap();
        let stream = TcpStream::connect(listener.local_addr().unwrap()).unwrap();
        let mut server = listener.accept().unwrap().0;
        let dribble = std::thread::spawn(move || {
            for byte in COOKIE {
                std::thread::sleep(Duration::from_millis(300));
                if server.write_all(&[byte]).is_err() {
                    return;
                }
            }
        });
        let began = Instant::now();
        let told = VrpnLink::begin(stream, &["Head".to_owned()]).err().unwrap().to_string();
        assert!(told.contains("it says nothing"), "{told}");
        assert!(began.elapsed() < 3 * CONNECT_WAIT, "{:?}", began.elapsed());
        dribble.join().unwrap();
    }

    #[test]
    fn a_flood_of_descriptions_is_bounded() {
        let mut kept = vec![COOKIE.to_vec()];
        for number in 0..10_000 {
            keep(&mut kept, &description(DESCRIBES_TYPE, number, "type"));
        }
        assert_eq!(kept.len(), MOST_DESCRIPTIONS);
    }
}
