//! Regular files only, up to a bound. A path that a user or a file names may lead to a pipe, a device or a folder, and
//! reading one of these would never end.

mod budget;
mod xml_bounds;

pub use budget::{Budget, OverBudget};
pub use xml_bounds::{ExcessiveXml, check_xml};

use std::fs::{File, Metadata};
use std::io::{self, Read};
use std::path::Path;
use thiserror::Error;

/// Reason why a file is not read. The text is worded to follow the file's name.
#[derive(Debug, Error)]
pub enum FileFault {
    /// Refusal of the operating system.
    #[error(transparent)]
    System(#[from] io::Error),
    /// A folder, a pipe or a device.
    #[error("it is no file")]
    NotAFile,
    /// More bytes than are read.
    #[error("it is larger than {most} bytes")]
    TooLarge {
        /// Largest number of bytes that is read.
        most: u64,
    },
}

/// Opens a regular file for reading.
///
/// # Errors
/// [`FileFault`]: the path leads to nothing readable, or to something else than a regular file.
pub fn open(path: &Path) -> Result<File, FileFault> {
    let regular = |metadata: Metadata| if metadata.is_file() { Ok(()) } else { Err(FileFault::NotAFile) };
    // Asked before opening: opening a pipe would wait for a writer.
    regular(std::fs::metadata(path)?)?;
    let file = File::open(path)?;
    regular(file.metadata()?)?;
    Ok(file)
}

/// Bytes of a regular file that has at most `most` of them.
///
/// # Errors
/// [`FileFault`], if the file cannot be opened by [`open`], cannot be read, or is larger.
pub fn read(path: &Path, most: u64) -> Result<Vec<u8>, FileFault> {
    let file = open(path)?;
    let length = file.metadata()?.len();
    if length > most {
        return Err(FileFault::TooLarge { most });
    }
    // The file may grow while it is read, so the bound holds for the bytes that come, too.
    let mut bytes = Vec::with_capacity(length as usize);
    file.take(most.saturating_add(1)).read_to_end(&mut bytes)?;
    if bytes.len() as u64 > most {
        return Err(FileFault::TooLarge { most });
    }
    Ok(bytes)
}

#[cfg(test)]
mod tests {
    //! Law: only a regular file within the bound is read. A wrong program would wait for a pipe for ever, or fill the
    //! memory.
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
            assert!(matches!(open(path), Err(FileFault::NotAFile)), "{path:?}");
            assert!(matches!(read(path, 5), Err(FileFault::NotAFile)), "{path:?}");
        }
        assert!(matches!(open(&folder.path().join("nothing")), Err(FileFault::System(_))));
    }
}
