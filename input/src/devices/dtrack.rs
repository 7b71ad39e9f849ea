//! Datagrams of an ART controller. Nothing is sent to it; the controller is configured to send here.

use std::io::{self, ErrorKind};
use std::net::{IpAddr, Ipv4Addr, Ipv6Addr, SocketAddr, UdpSocket};
use std::time::Duration;

use super::feed::{DeviceConnection, DevicePort, OpenedDevice};
use super::serial::passing;
use crate::dtrack::LONGEST_DATAGRAM;
use crate::sample::SampleSource;

/// Longest wait of a read.
const READ_WAIT: Duration = Duration::from_millis(100);

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
        Ok((place, Box::new(DtrackSocket { socket, buffer: vec![0; LONGEST_DATAGRAM + 1] })))
    }
}

/// Open socket of the controller's datagrams.
struct DtrackSocket {
    socket: UdpSocket,
    /// Buffer, longer by one than any datagram that is accepted, so that the decoder sees which are too long.
    buffer: Vec<u8>,
}

impl DeviceConnection for DtrackSocket {
    fn read(&mut self, bytes: &mut Vec<u8>) -> io::Result<()> {
        match self.socket.recv(&mut self.buffer) {
            Ok(length) => {
                bytes.extend_from_slice(&self.buffer[..length]);
                Ok(())
            }
            Err(error) => passing(Err(error)),
        }
    }
}
