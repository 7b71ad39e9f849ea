//! Datagrams of a tracker that sends to a port of this machine: one sender is believed, and a flood is thinned.

use std::io::{self, ErrorKind};
use std::net::{SocketAddr, UdpSocket};
use std::time::{Duration, Instant};

use super::fault::DeviceFault;
use super::feed::DeviceConnection;
use super::flood_gate::{FloodGate, MessageKind};
use super::serial::passing;

/// Longest wait of a read.
const READ_WAIT: Duration = Duration::from_millis(100);
/// Silence after which another sender may take the place of the first.
const SENDER_SILENCE: Duration = Duration::from_secs(2);

/// Fault of a port of this machine that cannot be listened at; `program`: name of the sender.
pub(super) fn not_listening(program: &'static str, place: &str, error: io::Error) -> DeviceFault {
    let place = place.to_owned();
    match error.kind() {
        ErrorKind::AddrInUse => DeviceFault::PortTaken(program, place),
        ErrorKind::AddrNotAvailable => DeviceFault::NotOurAddress(place),
        _ => DeviceFault::Deaf(place, Box::new(error.into())),
    }
}

/// Open socket of a tracker's datagrams.
pub(super) struct DatagramLink {
    socket: UdpSocket,
    /// Buffer, longer by one than any datagram that is accepted, so that the decoder sees which are too long.
    buffer: Vec<u8>,
    /// Test of a datagram's form: only a sender whose datagrams pass it is believed.
    is_of_tracker: fn(&[u8]) -> bool,
    gate: FloodGate,
    /// Sender that is believed, and the time when it was heard last. Anybody may send to this port.
    sender: Option<(SocketAddr, Instant)>,
    /// Number of datagrams of others, and of empty ones.
    of_others: u64,
}

impl DatagramLink {
    /// Link over a socket that is bound. `longest`: length of the longest datagram that is accepted, bytes.
    ///
    /// # Errors
    /// A socket that cannot wait.
    pub(super) fn new(socket: UdpSocket, longest: usize, is_of_tracker: fn(&[u8]) -> bool) -> io::Result<Self> {
        socket.set_read_timeout(Some(READ_WAIT))?;
        let gate = FloodGate::new(Instant::now());
        Ok(Self { socket, buffer: vec![0; longest + 1], is_of_tracker, gate, sender: None, of_others: 0 })
    }

    /// True if a datagram comes from the sender that is believed, or may be that of a new one.
    fn believes(&mut self, sender: SocketAddr, is_of_tracker: bool, now: Instant) -> bool {
        match self.sender {
            Some((known, heard)) if known != sender && now.duration_since(heard) < SENDER_SILENCE => return false,
            _ if is_of_tracker => self.sender = Some((sender, now)),
            _ => {}
        }
        true
    }
}

impl DeviceConnection for DatagramLink {
    fn read(&mut self, bytes: &mut Vec<u8>) -> io::Result<()> {
        match self.socket.recv_from(&mut self.buffer) {
            Ok((length, sender)) => {
                let now = Instant::now();
                let is_of_tracker = (self.is_of_tracker)(&self.buffer[..length]);
                if length > 0 && self.believes(sender, is_of_tracker, now) {
                    // A datagram holds all bodies, so the newest says all, and a sample is one datagram.
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
    //! Law: one sender moves the head, and nobody else while it sends.
    use super::*;

    #[test]
    fn another_sender_is_passed_over_until_the_first_is_silent() {
        let socket = UdpSocket::bind("127.0.0.1:0").unwrap();
        let mut tracker = DatagramLink::new(socket, 48, |datagram| datagram.len() == 48).unwrap();
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
