//! Connection to spacenavd through its socket.

use std::io::{self, ErrorKind, Read};
use std::os::unix::net::UnixStream;
use std::path::Path;
use std::time::Duration;

use super::feed::{DeviceConnection, OpenedDevice};
use super::serial::passing;
use crate::sample::SampleSource;
use crate::spacenavd::EVENT_LENGTH;

/// Longest wait of a read.
const READ_WAIT: Duration = Duration::from_millis(100);

/// Connection to the daemon.
pub(super) struct SpacenavdLink {
    stream: UnixStream,
    partial: Vec<u8>,
}

impl SpacenavdLink {
    /// Connects to the daemon.
    ///
    /// # Errors
    /// A sentence that says why not.
    pub(super) fn connect(path: &Path) -> Result<(OpenedDevice, Box<dyn DeviceConnection>), String> {
        let place = path.display().to_string();
        let stream = UnixStream::connect(path)
            .and_then(|stream| stream.set_read_timeout(Some(READ_WAIT)).map(|()| stream))
            .map_err(|error| match error.kind() {
                ErrorKind::NotFound | ErrorKind::ConnectionRefused => {
                    format!("spacenavd does not run ({place})")
                }
                _ => format!("spacenavd cannot be reached at {place}: {error}"),
            })?;
        let place = OpenedDevice {
            source: SampleSource::Spacenavd,
            name: "SpaceMouse through spacenavd".to_owned(),
            path: place,
        };
        Ok((place, Box::new(Self { stream, partial: Vec::new() })))
    }
}

impl DeviceConnection for SpacenavdLink {
    /// Reads whole events only, so that a dropped sample does not shift the events behind it.
    fn read(&mut self, bytes: &mut Vec<u8>) -> io::Result<()> {
        let mut buffer = [0; 32 * EVENT_LENGTH];
        match self.stream.read(&mut buffer) {
            Ok(0) => return Err(ErrorKind::UnexpectedEof.into()),
            Ok(length) => self.partial.extend_from_slice(&buffer[..length]),
            Err(error) => return passing(Err(error)),
        }
        let whole = self.partial.len() - self.partial.len() % EVENT_LENGTH;
        bytes.extend(self.partial.drain(..whole));
        Ok(())
    }
}

#[cfg(test)]
mod tests {
    use std::io::Write;

    use super::*;

    #[test]
    fn samples_are_whole_events() {
        let (mut daemon, stream) = UnixStream::pair().unwrap();
        stream.set_read_timeout(Some(READ_WAIT)).unwrap();
        let mut reader = SpacenavdLink { stream, partial: Vec::new() };
        let mut bytes = Vec::new();
        for (sent, given) in [(40, 32), (20, 32), (4, 64), (0, 64)] {
            daemon.write_all(&vec![7; sent]).unwrap();
            reader.read(&mut bytes).unwrap();
            assert_eq!(bytes.len(), given);
        }
        drop(daemon);
        assert!(reader.read(&mut bytes).is_err());
    }
}
