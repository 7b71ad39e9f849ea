//! Regular files only: reading a pipe or a device that a display names would never end.

use std::fs::File;
use std::io::{Error, Read, Result};
use std::path::Path;

/// Bytes of a regular file that has at most `most` of them.
///
/// # Errors
/// Error of the operating system, or the reason why the file is refused.
pub(crate) fn read(path: &Path, most: u64) -> Result<Vec<u8>> {
    // A pipe is refused before it is opened: opening would wait for a writer.
    let regular = |metadata: std::fs::Metadata| {
        if metadata.is_file() { Ok(metadata.len()) } else { Err(Error::other("it is no file")) }
    };
    regular(std::fs::metadata(path)?)?;
    let file = File::open(path)?;
    let length = regular(file.metadata()?)?;

    // The file may grow while it is read, so the bound holds for the bytes that come, too.
    let mut bytes = Vec::with_capacity(length.min(most) as usize);
    if length <= most {
        file.take(most + 1).read_to_end(&mut bytes)?;
    }
    if length > most || bytes.len() as u64 > most {
        return Err(Error::other(format!("it is larger than {most} bytes")));
    }
    Ok(bytes)
}

#[cfg(test)]
mod tests {
    //! Law under test: only a regular file within the bound is read. A wrong program would wait for a pipe for ever,
    //! or fill the memory.
    #![allow(clippy::unwrap_used, reason = "a failed construction is a failed test")]

    use super::*;

    #[test]
    fn a_file_is_read_up_to_the_bound_and_not_beyond() {
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("five");
        std::fs::write(&path, b"12345").unwrap();
        assert_eq!(read(&path, 5).unwrap(), b"12345");
        assert!(read(&path, 4).unwrap_err().to_string().contains("larger than 4 bytes"));
    }

    #[test]
    fn folders_and_devices_are_refused() {
        let folder = tempfile::tempdir().unwrap();
        for path in [folder.path(), Path::new("/dev/zero")] {
            assert!(read(path, 5).is_err(), "{path:?}");
        }
    }
}
