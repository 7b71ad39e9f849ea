//! Datagrams of an ART controller. Nothing is sent to it; the controller is configured to send here.

use std::io::{self, ErrorKind};
use std::net::{IpAddr, Ipv4Addr, Ipv6Addr, SocketAddr, UdpSocket};
use std::time::{Duration, Instant};

use super::feed::{DeviceConnection, DevicePort, OpenedDevice};
use super::flood_gate::{FloodGate, MessageKind};
use super::serial::passing;
use crate::dtrack::wire::LONGEST_DATAGRAM;
use crate::sample::SampleSource;

/// Longest wait of a read.
const READ_WAIT: Duration = Duration::from_millis(100);

/// Silence after which another sender may take the place of the first.
const SENDER_SILENCE: Duration = Duration::from_secs(2);
/// Beginning of every datagram of a controller.
const BEGINNING: &[u8] = b"fr ";

/// Address and port that the controller sends to.
pub(super) struct DtrackPort {
    address: IpAddr,
    port: u16,
}

impl DtrackPort {
    pub(super) fn new(address: IpAddr, port: u16) -> Self {
        Self { address, port }
    }

    fn bind(&self) -> io::Result<UdpSocket> {
        let any = |port| -> SocketAddr {
            match self.address {
                IpAddr::V4(_) => (Ipv4Addr::UNSPECIFIED, port).into(),
                IpAddr::V6(_) => (Ipv6Addr::UNSPECIFIED, port).into(),
            }
        };
        let socket = if self.address.is_multicast() {
            let socket = UdpSocket::bind(any(self.port))?;
            match &self.address {
                IpAddr::V4(group) => socket.join_multicast_v4(group, &Ipv4Addr::UNSPECIFIED)?,
                IpAddr::V6(group) => socket.join_multicast_v6(group, 0)?,
            }
            socket
        } else {
            UdpSocket::bind((self.address, self.port))?
        };
        socket.set_read_timeout(Some(READ_WAIT))?;
        Ok(socket)
    }
}

impl DevicePort for DtrackPort {
    fn open(&mut self) -> Result<(OpenedDevice, Box<dyn DeviceConnection>), String> {
        let path = SocketAddr::new(self.address, self.port).to_string();
        let socket = self.bind().map_err(|error| match error.kind() {
            ErrorKind::AddrInUse => {
                format!("another program listens at {path}: end it, or have DTrack send to another port")
            }
            ErrorKind::AddrNotAvailable => {
                format!("{path} is no address of this machine: name one that is, or a multicast group, or none")
            }
            _ => format!("cannot listen at {path}: {error}"),
        })?;
        let place = OpenedDevice { source: SampleSource::Dtrack, name: "DTrack".to_owned(), path };
        Ok((place, Box::new(DtrackSocket::new(socket))))
    }
}

/// Open socket of the controller's datagrams.
struct DtrackSocket {
    socket: UdpSocket,
    /// Buffer, longer by one than any datagram that is accepted, so that the decoder sees which are too long.
    buffer: Vec<u8>,
    gate: FloodGate,
    /// Controller that is believed, and the time when it was heard last. Anybody may send to this port.
    sender: Option<(SocketAddr, Instant)>,
    /// Number of datagrams of others.
    of_others: u64,
}

impl DtrackSocket {
    fn new(socket: UdpSocket) -> Self {
        let gate = FloodGate::new(Instant::now());
        Self { socket, buffer: vec![0; LONGEST_DATAGRAM + 1], gate, sender: None, of_others: 0 }
    }

    /// True if a datagram comes from the controller that is believed, or may be that of a new one.
    fn believes(&mut self, sender: SocketAddr, begins_well: bool, now: Instant) -> bool {
        match self.sender {
            Some((known, heard)) if known != sender && now.duration_since(heard) < SENDER_SILENCE => return false,
            _ if begins_well => self.sender = Some((sender, now)),
            _ => {}
        }
        true
    }
}

impl DeviceConnection for DtrackSocket {
    fn read(&mut self, bytes: &mut Vec<u8>) -> io::Result<()> {
        match self.socket.recv_from(&mut self.buffer) {
            Ok((length, sender)) => {
                let (now, begins_well) = (Instant::now(), self.buffer[..length].starts_with(BEGINNING));
                if self.believes(sender, begins_well, now) {
                    // A frame holds all bodies, so the newest says all, and a sample is one frame.
                    let mut older = Vec::new();
                    self.gate.release(now, &mut older);
                    self.gate.take(now, MessageKind::default(), &self.buffer[..length], bytes);
                    if bytes.is_empty() {
                        bytes.append(&mut older);
                    }
                } else {
                    self.of_others += 1;
                }
            }
            Err(error) => {
                passing(Err(error))?;
                self.gate.release(Instant::now(), bytes);
            }
        }
        Ok(())
    }

    fn passed_over(&mut self) -> u64 {
        self.gate.passed_over() + std::mem::take(&mut self.of_others)
    }
}

#[cfg(test)]
mod tests {
    //! Law: one controller moves the head, and nobody else while it sends.
    use super::*;

    #[test]
    fn another_sender_is_passed_over_until_the_first_is_silent() {
        let socket = UdpSocket::bind("127.0.0.1:0").unwrap();
        let mut tracker = DtrackSocket::new(socket);
        let [first, second] = ["10.0.0.1:1", "10.0.0.2:1"].map(|address| address.parse().unwrap());
        let now = Instant::now();
        // What is no frame is passed on, to be counted, and pins nobody.
        assert!(tracker.believes(second, false, now));
        assert!(tracker.believes(first, true, now));
        assert!(!tracker.believes(second, true, now + SENDER_SILENCE / 2));
        assert!(tracker.believes(first, true, now + SENDER_SILENCE / 2));
        assert!(!tracker.believes(second, true, now + SENDER_SILENCE));
        assert!(tracker.believes(second, true, now + 2 * SENDER_SILENCE));
        assert!(!tracker.believes(first, true, now + 2 * SENDER_SILENCE));
    }
}
