//! Membership of a multicast group on every interface of this machine.
//!
//! Without a word about the interface, the system joins a group on that of its default route alone, which is seldom
//! the network of the cameras.

use std::collections::BTreeSet;
use std::io;
use std::net::{IpAddr, Ipv4Addr, Ipv6Addr, SocketAddr, UdpSocket};
use std::time::{Duration, Instant};

use if_addrs::get_if_addrs;
use socket2::{Domain, Protocol, Socket, Type};

use super::fault::DeviceFault;
use super::feed::DeviceConnection;

/// Time after which interfaces are looked for again: a network may come up after this program.
const LOOK_AGAIN: Duration = Duration::from_secs(5);

/// Interface in the form in which a group is joined: its address, or its number for IPv6.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
enum MulticastInterface {
    Address(Ipv4Addr),
    Number(u32),
}

/// Interfaces of this machine on which this group can be joined.
fn interfaces(group: IpAddr) -> io::Result<BTreeSet<MulticastInterface>> {
    let found = get_if_addrs()?.into_iter().filter_map(|interface| match (group, interface.ip()) {
        (IpAddr::V4(_), IpAddr::V4(address)) => Some(MulticastInterface::Address(address)),
        (IpAddr::V6(_), IpAddr::V6(_)) => interface.index.map(MulticastInterface::Number),
        _ => None,
    });
    Ok(found.collect())
}

/// Membership of a socket in a group.
pub(super) struct Membership {
    socket: UdpSocket,
    group: IpAddr,
    looked_at: Instant,
}

impl Membership {
    /// Binds a socket that other programs may share, and joins the group on every interface that allows it.
    ///
    /// # Errors
    /// A port that cannot be bound, or the last reason if no interface allows it.
    pub(super) fn bind(group: IpAddr, port: u16) -> io::Result<(UdpSocket, Self)> {
        let (domain, any): (_, IpAddr) = match group {
            IpAddr::V4(_) => (Domain::IPV4, Ipv4Addr::UNSPECIFIED.into()),
            IpAddr::V6(_) => (Domain::IPV6, Ipv6Addr::UNSPECIFIED.into()),
        };
        let socket = Socket::new(domain, Type::DGRAM, Some(Protocol::UDP))?;
        socket.set_reuse_address(true)?;
        socket.bind(&SocketAddr::new(any, port).into())?;
        let socket = UdpSocket::from(socket);
        let membership = Self { socket: socket.try_clone()?, group, looked_at: Instant::now() };
        let (joined, refused) = membership.join(&interfaces(group)?);
        if joined.is_empty() {
            let none = || DeviceFault::NoInterface.io(io::ErrorKind::NotFound);
            return Err(refused.unwrap_or_else(none));
        }
        Ok((socket, membership))
    }

    /// Joins the group on these interfaces and leaves out those that refuse; returns those on which it is joined, and
    /// the last refusal.
    ///
    /// What was joined before is joined again: an interface that went and came back has lost its membership, and may
    /// have done so between two looks.
    fn join(&self, interfaces: &BTreeSet<MulticastInterface>) -> (BTreeSet<MulticastInterface>, Option<io::Error>) {
        let (mut joined, mut refused) = (BTreeSet::new(), None);
        for interface in interfaces {
            let outcome = match (self.group, interface) {
                (IpAddr::V4(group), MulticastInterface::Address(address)) => {
                    self.socket.join_multicast_v4(&group, address)
                }
                (IpAddr::V6(group), MulticastInterface::Number(number)) => {
                    self.socket.join_multicast_v6(&group, *number)
                }
                _ => continue,
            };
            match outcome {
                // It is joined already, or two addresses of one interface are one membership.
                Err(error) if error.kind() != io::ErrorKind::AddrInUse => refused = Some(error),
                _ => {
                    joined.insert(*interface);
                }
            }
        }
        (joined, refused)
    }

    /// Looks for interfaces that are new or have come back, when it is time.
    fn keep(&mut self) {
        if self.looked_at.elapsed() < LOOK_AGAIN {
            return;
        }
        self.looked_at = Instant::now();
        if let Ok(interfaces) = interfaces(self.group) {
            // One that refuses is tried again the next time.
            let _ = self.join(&interfaces);
        }
    }
}

/// Connection whose socket keeps its membership.
pub(super) struct GroupLink<L> {
    pub(super) link: L,
    pub(super) membership: Membership,
}

impl<L: DeviceConnection> DeviceConnection for GroupLink<L> {
    fn read(&mut self, bytes: &mut Vec<u8>) -> io::Result<()> {
        self.membership.keep();
        self.link.read(bytes)
    }

    fn passed_over(&mut self) -> u64 {
        self.link.passed_over()
    }

    fn report_all(&mut self) {
        self.link.report_all();
    }
}

#[cfg(test)]
mod tests {
    //! Law: a group is heard on every interface, the loopback's included, and on one that comes later.
    use super::*;
    use socket2::SockRef;

    const GROUP: Ipv4Addr = Ipv4Addr::new(239, 193, 7, 77);

    fn sender() -> UdpSocket {
        let sender = UdpSocket::bind("127.0.0.1:0").unwrap();
        SockRef::from(&sender).set_multicast_if_v4(&Ipv4Addr::LOCALHOST).unwrap();
        sender
    }

    #[test]
    fn a_group_is_heard_on_the_loopback_and_shared() {
        let port = UdpSocket::bind("0.0.0.0:0").unwrap().local_addr().unwrap().port();
        let sockets = [Membership::bind(GROUP.into(), port).unwrap(), Membership::bind(GROUP.into(), port).unwrap()];
        sender().send_to(b"fr 1", (GROUP, port)).unwrap();
        for (socket, membership) in &sockets {
            let loopback = BTreeSet::from([MulticastInterface::Address(Ipv4Addr::LOCALHOST)]);
            assert_eq!(membership.join(&loopback).0, loopback);
            socket.set_read_timeout(Some(Duration::from_secs(2))).unwrap();
            assert_eq!(socket.recv_from(&mut [0; 8]).unwrap().0, 4);
        }
    }

    #[test]
    fn an_interface_that_came_back_between_two_looks_is_joined_and_one_that_refuses_is_left_out() {
        let (socket, mut membership) = Membership::bind(GROUP.into(), 0).unwrap();
        let port = socket.local_addr().unwrap().port();
        // So a membership is lost with its interface, which is there again before the next look.
        socket.leave_multicast_v4(&GROUP, &Ipv4Addr::LOCALHOST).unwrap();
        // An address that is reserved for documents, so that no interface has it.
        let nowhere = MulticastInterface::Address(Ipv4Addr::new(192, 0, 2, 1));
        let (joined, refused) = membership.join(&BTreeSet::from([nowhere]));
        assert!(joined.is_empty() && refused.is_some());
        socket.set_read_timeout(Some(Duration::from_millis(100))).unwrap();
        sender().send_to(b"fr 1", (GROUP, port)).unwrap();
        assert!(socket.recv_from(&mut [0; 8]).is_err());
        membership.looked_at = Instant::now().checked_sub(LOOK_AGAIN).unwrap();
        membership.keep();
        sender().send_to(b"fr 1", (GROUP, port)).unwrap();
        socket.set_read_timeout(Some(Duration::from_secs(2))).unwrap();
        assert_eq!(socket.recv_from(&mut [0; 8]).unwrap().0, 4);
    }
}
