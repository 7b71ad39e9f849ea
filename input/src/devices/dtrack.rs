//! Datagrams of an ART controller. Nothing is sent to it; the controller is configured to send here.

use std::io;
use std::net::{IpAddr, Ipv4Addr, Ipv6Addr, SocketAddr, UdpSocket};

use super::datagrams::{DatagramLink, not_listening};
use super::feed::{DeviceConnection, DevicePort, OpenedDevice};
use crate::dtrack::LONGEST_DATAGRAM;
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
        Ok(socket)
    }
}

impl DevicePort for DtrackPort {
    fn open(&mut self) -> Result<(OpenedDevice, Box<dyn DeviceConnection>), String> {
        let path = SocketAddr::new(self.address, self.port).to_string();
        let link = self
            .bind()
            .and_then(|socket| DatagramLink::new(socket, LONGEST_DATAGRAM, |frame| frame.starts_with(BEGINNING)))
            .map_err(|error| not_listening("DTrack", &path, &error))?;
        let place = OpenedDevice { source: SampleSource::Dtrack, name: "DTrack".to_owned(), path };
        Ok((place, Box::new(link)))
    }
}
