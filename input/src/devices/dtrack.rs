//! Datagrams of an ART controller. Nothing is sent to it; the controller is configured to send here.

use std::io;
use std::net::{IpAddr, SocketAddr, UdpSocket};

use super::datagrams::{DatagramLink, not_listening};
use super::fault::DeviceFault;
use super::feed::{DeviceConnection, DevicePort, OpenedDevice};
use super::multicast::{GroupLink, Membership};
use crate::dtrack::wire::LONGEST_DATAGRAM;
use crate::sample::SampleSource;

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

    fn link(&self) -> io::Result<Box<dyn DeviceConnection>> {
        let link = |socket| DatagramLink::new(socket, LONGEST_DATAGRAM, |frame| frame.starts_with(BEGINNING));
        if self.address.is_multicast() {
            let (socket, membership) = Membership::bind(self.address, self.port)?;
            return Ok(Box::new(GroupLink { link: link(socket)?, membership }));
        }
        Ok(Box::new(link(UdpSocket::bind((self.address, self.port))?)?))
    }
}

impl DevicePort for DtrackPort {
    fn open(&mut self) -> Result<(OpenedDevice, Box<dyn DeviceConnection>), DeviceFault> {
        let path = SocketAddr::new(self.address, self.port).to_string();
        let link = self.link().map_err(|error| not_listening("DTrack", &path, error))?;
        let place = OpenedDevice { source: SampleSource::Dtrack, name: "DTrack".to_owned(), path };
        Ok((place, link))
    }
}
