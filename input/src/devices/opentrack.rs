//! Datagrams of opentrack, which is told this machine's address and port. Nothing is sent to it.

use std::net::{IpAddr, SocketAddr, UdpSocket};

use super::datagrams::{DatagramLink, not_listening};
use super::fault::DeviceFault;
use super::feed::{DeviceConnection, DevicePort, OpenedDevice};
use crate::opentrack::DATAGRAM_LENGTH;
use crate::sample::SampleSource;

/// Longest datagram that is read whole, so that its length can be told, bytes.
const LONGEST: usize = 2048;

/// Address and port that opentrack sends to.
pub(super) struct OpentrackPort {
    place: SocketAddr,
}

impl OpentrackPort {
    pub(super) fn new(address: IpAddr, port: u16) -> Self {
        Self { place: SocketAddr::new(address, port) }
    }
}

impl DevicePort for OpentrackPort {
    fn open(&mut self) -> Result<(OpenedDevice, Box<dyn DeviceConnection>), DeviceFault> {
        let path = self.place.to_string();
        let link = UdpSocket::bind(self.place)
            .and_then(|socket| DatagramLink::new(socket, LONGEST, |datagram| datagram.len() == DATAGRAM_LENGTH))
            .map_err(|error| not_listening("opentrack", &path, error))?;
        let place = OpenedDevice { source: SampleSource::Opentrack, name: "opentrack".to_owned(), path };
        Ok((place, Box::new(link)))
    }
}
