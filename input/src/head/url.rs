//! Address of a tracker as one text: `vrpn://HOST[:PORT]/DEVICE` or, as VRPN's own tools say it,
//! `DEVICE@HOST[:PORT]`; `dtrack://[ADDRESS][:PORT]`; `opentrack://[ADDRESS][:PORT]`; `openxr://`; `mouse`.

use std::fmt;
use std::net::{IpAddr, Ipv4Addr, Ipv6Addr, SocketAddr};
use std::str::FromStr;

use serde::{Deserialize, Serialize};
use thiserror::Error;

use crate::dtrack::wire::PORT as DTRACK_PORT;
use crate::opentrack;
use crate::sample::SampleSource;
use crate::vrpn::wire::{self, LONGEST_NAME};

/// Address of a tracker.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(try_from = "String", into = "String")]
pub enum TrackerUrl {
    /// A VRPN server, reached over TCP.
    Vrpn {
        /// Name or address of the server.
        host: String,
        /// Port of the server.
        port: u16,
        /// Name of the tracker among the server's devices.
        device: String,
    },
    /// The datagrams of an ART DTrack controller.
    Dtrack {
        /// Address of this machine that the controller sends to, or the multicast group.
        address: IpAddr,
        /// Port that the controller sends to.
        port: u16,
    },
    /// The datagrams of opentrack.
    Opentrack {
        /// Address of this machine that opentrack sends to.
        address: IpAddr,
        /// Port that opentrack sends to.
        port: u16,
    },
    /// The headset of this machine's OpenXR runtime.
    Openxr,
    /// Mouse in the window, which moves the head without a tracker.
    Mouse,
}

/// Reason why a text is no tracker's address.
#[derive(Clone, Debug, PartialEq, Eq, Error)]
pub enum TrackerUrlError {
    /// A text of unknown form.
    #[error(
        "{0:?} is no tracker: expected vrpn://HOST/DEVICE or DEVICE@HOST, dtrack://ADDRESS:PORT, opentrack://:PORT, openxr:// or mouse, as in vrpn://192.168.0.10/Head"
    )]
    Unknown(String),
    /// An address of a headset, which has no parts.
    #[error("{0:?} names a place: expected openxr:// alone, which is the headset of this machine")]
    Place(String),
    /// An address without a host.
    #[error("{0:?} names no host: expected vrpn://HOST/DEVICE, as in vrpn://192.168.0.10/Head")]
    Host(String),
    /// An address without a device.
    #[error("{0:?} names no device of the server: expected vrpn://HOST/DEVICE, as in vrpn://192.168.0.10/Head")]
    Device(String),
    /// A port that is no number from 1 to 65535.
    #[error("{port:?} in {url:?} is no port: expected a number from 1 to 65535")]
    Port {
        /// Whole text of the address.
        url: String,
        /// Text in place of a port.
        port: String,
    },
    /// A text in place of an address.
    #[error(
        "{address:?} in {url:?} is no address: expected one of this machine, or for dtrack a multicast group, as in dtrack://225.1.1.1:5000, or none"
    )]
    Address {
        /// Whole text of the address.
        url: String,
        /// Text in place of an address.
        address: String,
    },
}

impl TrackerUrl {
    /// Source of the tracker's samples, and so its decoder.
    pub fn source(&self) -> SampleSource {
        match self {
            Self::Vrpn { .. } => SampleSource::Vrpn,
            Self::Dtrack { .. } => SampleSource::Dtrack,
            Self::Opentrack { .. } => SampleSource::Opentrack,
            Self::Openxr => SampleSource::Openxr,
            Self::Mouse => SampleSource::Mouse,
        }
    }
}

impl FromStr for TrackerUrl {
    type Err = TrackerUrlError;

    fn from_str(text: &str) -> Result<Self, TrackerUrlError> {
        let url = text.trim();
        if url == "mouse" {
            return Ok(Self::Mouse);
        }
        if let Some((device, place)) = url.split_once('@').filter(|(device, _)| !device.contains("://")) {
            // Prefixes by which VRPN's own tools name the transport; this program uses TCP alone.
            let prefixes = ["tcp://", "tcp:", "x-vrpn://", "x-vrpn:"];
            let place = prefixes.iter().find_map(|prefix| place.strip_prefix(prefix)).unwrap_or(place);
            return vrpn(url, place.trim_end_matches('/'), device);
        }
        match url.split_once("://") {
            // VRPN's own name for a connection over TCP alone.
            Some(("vrpn" | "tcp", rest)) => {
                let (place, device) = rest.split_once('/').unwrap_or((rest, ""));
                vrpn(url, place, device)
            }
            Some(("dtrack", rest)) => {
                let (address, port) = address_and_port(url, rest, DTRACK_PORT)?;
                Ok(Self::Dtrack { address, port })
            }
            Some(("opentrack", rest)) => {
                let (address, port) = address_and_port(url, rest, opentrack::PORT)?;
                Ok(Self::Opentrack { address, port })
            }
            Some(("openxr", "")) => Ok(Self::Openxr),
            Some(("openxr", _)) => Err(TrackerUrlError::Place(url.to_owned())),
            _ => Err(TrackerUrlError::Unknown(url.to_owned())),
        }
    }
}

/// Device at a server's place, `HOST[:PORT]`.
fn vrpn(url: &str, place: &str, device: &str) -> Result<TrackerUrl, TrackerUrlError> {
    let (host, port) = host_and_port(url, place, wire::PORT)?;
    if host.is_empty() || host.contains(['@', '/']) {
        return Err(TrackerUrlError::Host(url.to_owned()));
    }
    if device.is_empty() || device.len() >= LONGEST_NAME {
        return Err(TrackerUrlError::Device(url.to_owned()));
    }
    Ok(TrackerUrl::Vrpn { host: host.to_owned(), port, device: device.to_owned() })
}

/// Splits `[ADDRESS][:PORT]`; without an address, all those of the machine are meant.
fn address_and_port(url: &str, place: &str, usual: u16) -> Result<(IpAddr, u16), TrackerUrlError> {
    let (host, port) = host_and_port(url, place.trim_end_matches('/'), usual)?;
    let bad = |_| TrackerUrlError::Address { url: url.to_owned(), address: host.to_owned() };
    let address = if host.is_empty() { Ipv4Addr::UNSPECIFIED.into() } else { host.parse().map_err(bad)? };
    Ok((address, port))
}

/// Splits `HOST[:PORT]`; an IPv6 address stands in brackets.
pub(crate) fn host_and_port<'a>(url: &str, place: &'a str, usual: u16) -> Result<(&'a str, u16), TrackerUrlError> {
    let (host, port) = match place.strip_prefix('[').and_then(|rest| rest.split_once(']')) {
        Some((host, "")) => (host, None),
        // A text without its colon is no port.
        Some((host, rest)) => (host, Some(rest.strip_prefix(':').unwrap_or(""))),
        None => match place.split_once(':') {
            Some((host, port)) => (host, Some(port)),
            None => (place, None),
        },
    };
    let Some(port) = port else {
        return Ok((host, usual));
    };
    let bad = || TrackerUrlError::Port { url: url.to_owned(), port: port.to_owned() };
    let number = port.parse().map_err(|_| bad())?;
    if number == 0 { Err(bad()) } else { Ok((host, number)) }
}

impl fmt::Display for TrackerUrl {
    fn fmt(&self, formatter: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Vrpn { host, port, device } if host.parse::<Ipv6Addr>().is_ok() => {
                write!(formatter, "vrpn://[{host}]:{port}/{device}")
            }
            Self::Vrpn { host, port, device } => write!(formatter, "vrpn://{host}:{port}/{device}"),
            Self::Dtrack { address, port } => write!(formatter, "dtrack://{}", SocketAddr::new(*address, *port)),
            Self::Opentrack { address, port } => {
                write!(formatter, "opentrack://{}", SocketAddr::new(*address, *port))
            }
            Self::Openxr => formatter.write_str("openxr://"),
            Self::Mouse => formatter.write_str("mouse"),
        }
    }
}

impl TryFrom<String> for TrackerUrl {
    type Error = TrackerUrlError;

    fn try_from(text: String) -> Result<Self, TrackerUrlError> {
        text.parse()
    }
}

impl From<TrackerUrl> for String {
    fn from(url: TrackerUrl) -> Self {
        url.to_string()
    }
}

#[cfg(test)]
mod tests {
    //! An address must survive its text, because a recording carries it; a wrong one must be refused with a reason.
    use super::*;

    #[test]
    fn places_are_read_and_written() {
        for (text, whole) in [
            ("vrpn://tracker/Head", "vrpn://tracker:3883/Head"),
            ("vrpn://192.168.0.10:4000/Head 0", "vrpn://192.168.0.10:4000/Head 0"),
            ("tcp://tracker:3883/a/b", "vrpn://tracker:3883/a/b"),
            ("vrpn://[::1]/Head", "vrpn://[::1]:3883/Head"),
            ("Tracker0@tracker", "vrpn://tracker:3883/Tracker0"),
            ("Tracker0@tracker:3884", "vrpn://tracker:3884/Tracker0"),
            ("Tracker0@tcp://tracker:3884", "vrpn://tracker:3884/Tracker0"),
            ("Tracker0@tcp:tracker", "vrpn://tracker:3883/Tracker0"),
            ("Tracker0@x-vrpn://tracker:3884/", "vrpn://tracker:3884/Tracker0"),
            ("Head 0@[::1]:4000", "vrpn://[::1]:4000/Head 0"),
            ("dtrack://", "dtrack://0.0.0.0:5000"),
            ("dtrack://:5001", "dtrack://0.0.0.0:5001"),
            ("dtrack://225.1.1.1:5000/", "dtrack://225.1.1.1:5000"),
            ("dtrack://[::]:5000", "dtrack://[::]:5000"),
            ("opentrack://", "opentrack://0.0.0.0:4242"),
            ("opentrack://:4242", "opentrack://0.0.0.0:4242"),
            ("opentrack://127.0.0.1:4243/", "opentrack://127.0.0.1:4243"),
            ("opentrack://[::1]", "opentrack://[::1]:4242"),
            ("openxr://", "openxr://"),
            (" mouse ", "mouse"),
        ] {
            let url: TrackerUrl = text.parse().unwrap();
            assert_eq!(url.to_string(), whole);
            assert_eq!(whole.parse(), Ok(url.clone()));
            assert_eq!(serde_json::from_str::<TrackerUrl>(&serde_json::to_string(&url).unwrap()).unwrap(), url);
        }
    }

    #[test]
    fn a_wrong_place_is_told_in_a_sentence() {
        for (text, expected) in [
            ("", "is no tracker"),
            ("Head@", "names no host"),
            ("Head@:3883", "names no host"),
            ("Head@tracker/Tail", "names no host"),
            ("Head@a@b", "names no host"),
            ("@tracker", "names no device"),
            ("Head@tracker:0", "\"0\" in \"Head@tracker:0\" is no port"),
            ("Head@http://tracker", "is no port"),
            ("http://tracker/Head", "is no tracker"),
            ("vrpn:///Head", "names no host"),
            ("vrpn://Head@tracker/", "names no host"),
            ("vrpn://tracker", "names no device"),
            ("vrpn://tracker:3883/", "names no device"),
            ("vrpn://tracker:0/Head", "\"0\" in \"vrpn://tracker:0/Head\" is no port"),
            ("vrpn://tracker:99999/Head", "is no port"),
            ("vrpn://[::1]3883/Head", "is no port"),
            ("dtrack://controller:5000", "\"controller\" in"),
            ("dtrack://:port", "is no port"),
            ("opentrack://desk:4242", "\"desk\" in"),
            ("opentrack://:0", "is no port"),
            ("openxr://headset", "expected openxr:// alone"),
        ] {
            let error = text.parse::<TrackerUrl>().unwrap_err().to_string();
            assert!(error.contains(expected), "{text}: {error}");
        }
        let long = format!("vrpn://tracker/{}", "x".repeat(LONGEST_NAME));
        assert!(matches!(long.parse::<TrackerUrl>(), Err(TrackerUrlError::Device(_))));
    }
}
