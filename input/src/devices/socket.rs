//! Connection to spacenavd through its socket.

use std::io::{self, ErrorKind, Read};
use std::os::unix::net::UnixStream;
use std::path::PathBuf;
use std::time::Duration;

use super::fault::DeviceFault;
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
    /// Connects to the daemon at the first of these places where it runs.
    ///
    /// # Errors
    /// Why not: a refusal if there is one, else that it does not run.
    pub(super) fn connect(paths: &[PathBuf]) -> Result<(OpenedDevice, Box<dyn DeviceConnection>), DeviceFault> {
        let mut refused = None;
        for path in paths {
            let place = path.display().to_string();
            let stream =
                UnixStream::connect(path).and_then(|stream| stream.set_read_timeout(Some(READ_WAIT)).map(|()| stream));
            match stream {
                Ok(stream) => {
                    let place = OpenedDevice {
                        source: SampleSource::Spacenavd,
                        name: "SpaceMouse through spacenavd".to_owned(),
                        path: place,
                    };
                    return Ok((place, Box::new(Self { stream, partial: Vec::new() })));
                }
                Err(error) if matches!(error.kind(), ErrorKind::NotFound | ErrorKind::ConnectionRefused) => {}
                Err(error) => refused = Some(DeviceFault::SpacenavdRefuses(place, error.to_string())),
            }
        }
        let places: Vec<String> = paths.iter().map(|path| path.display().to_string()).collect();
        Err(refused.unwrap_or_else(|| DeviceFault::NoSpacenavd(places.join(", "))))
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
