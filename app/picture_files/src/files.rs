//! Output files: checks before long work, and names that overwrite nothing.

use image::DynamicImage;
use std::ffi::OsStr;
use std::io;
use std::path::{Path, PathBuf};
use thiserror::Error;

/// File that cannot be written.
#[derive(Debug, Error)]
#[error("{}: could not be written: {reason}; choose another place", path.display())]
pub struct WriteError {
    /// File to be written.
    pub path: PathBuf,
    /// Reason, in the system's words.
    pub reason: String,
}

impl WriteError {
    /// Error for a file, with its reason.
    pub fn new(path: &Path, reason: impl ToString) -> Self {
        Self { path: path.to_owned(), reason: reason.to_string() }
    }
}

/// Checks before long work that its result can be written to `path`.
///
/// # Errors
/// [`WriteError`] if a folder of that name is in the way, or if the folder that the file belongs in is missing.
pub fn writable(path: &Path) -> Result<(), WriteError> {
    let folder = path.parent().filter(|folder| !folder.as_os_str().is_empty()).unwrap_or(Path::new("."));
    if path.is_dir() {
        return Err(WriteError::new(path, "it is a folder"));
    }
    if !folder.is_dir() {
        return Err(WriteError::new(path, format!("there is no folder {}", folder.display())));
    }
    Ok(())
}

/// Writes a picture as PNG.
///
/// # Errors
/// [`WriteError`] with the path and the reason; no partial file is left then.
pub fn save(picture: impl Into<DynamicImage>, path: &Path) -> Result<(), WriteError> {
    let mut bytes = std::io::Cursor::new(Vec::new());
    picture.into().write_to(&mut bytes, image::ImageFormat::Png).map_err(|error| WriteError::new(path, error))?;
    let bytes = bytes.into_inner();
    whole(path, |temporary| std::fs::write(temporary, &bytes)).map_err(|error| WriteError::new(path, error))
}

/// Writes a file under a temporary name beside its place, and gives it its name once it is whole. What was there
/// before stays until then, and after an error. A device or a pipe is written to directly.
///
/// # Errors
/// The error of `write`, or of the system; no partial file is left then.
pub fn whole<T>(path: &Path, write: impl FnOnce(&Path) -> io::Result<T>) -> io::Result<T> {
    // A link stays a link.
    let place = std::fs::canonicalize(path).unwrap_or_else(|_| path.to_owned());
    if std::fs::metadata(&place).is_ok_and(|metadata| !metadata.is_file()) {
        return write(path);
    }
    let temporary = temporary(&place);
    let outcome = write(&temporary).and_then(|written| std::fs::rename(&temporary, &place).map(|()| written));
    if outcome.is_err() {
        // An error here means that there is nothing to remove.
        let _ = std::fs::remove_file(&temporary);
    }
    outcome
}

/// Name beside `path` for a file that is not whole yet, with the same extension.
pub fn temporary(path: &Path) -> PathBuf {
    let part = |part: Option<&OsStr>| part.unwrap_or_default().to_string_lossy().into_owned();
    let (stem, extension) = (part(path.file_stem()), part(path.extension()));
    path.with_file_name(format!(".{stem}.{}.part.{extension}", std::process::id()))
}

/// First of `stem-001.extension`, `stem-002.extension`, … that does not exist yet.
pub fn unused(stem: &str, extension: &str) -> PathBuf {
    (1_u32..)
        .map(|number| PathBuf::from(format!("{stem}-{number:03}.{extension}")))
        .find(|path| !path.exists())
        .expect("there are more numbers than files")
}

#[cfg(test)]
mod tests {
    //! Law: under its name a file is whole, or what it was before.
    #![allow(clippy::unwrap_used, reason = "a folder that cannot be read is a failed test")]

    use super::*;
    use std::fs;

    fn names(folder: &Path) -> Vec<String> {
        fs::read_dir(folder).unwrap().map(|entry| entry.unwrap().file_name().into_string().unwrap()).collect()
    }

    #[test]
    fn what_fails_half_way_leaves_the_old_file() {
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("a.png");
        for before in [None, Some("old")] {
            if let Some(before) = before {
                fs::write(&path, before).unwrap();
            }
            let half = |temporary: &Path| {
                assert_eq!(temporary.extension(), path.extension());
                fs::write(temporary, "ha")?;
                Err::<(), _>(io::Error::other("the disk is full"))
            };
            assert_eq!(whole(&path, half).unwrap_err().to_string(), "the disk is full");
            assert_eq!(fs::read_to_string(&path).ok().as_deref(), before);
            assert_eq!(names(folder.path()).len(), usize::from(before.is_some()));
        }
        whole(&path, |temporary| fs::write(temporary, "whole")).unwrap();
        assert_eq!(
            (fs::read_to_string(&path).unwrap(), names(folder.path())),
            ("whole".to_owned(), vec!["a.png".to_owned()])
        );
    }

    #[cfg(unix)]
    #[test]
    fn a_link_stays_and_a_device_is_written_to() {
        let folder = tempfile::tempdir().unwrap();
        let (file, link) = (folder.path().join("a.png"), folder.path().join("link.png"));
        fs::write(&file, "old").unwrap();
        std::os::unix::fs::symlink(&file, &link).unwrap();
        whole(&link, |temporary| fs::write(temporary, "new")).unwrap();
        assert_eq!(fs::read_to_string(&file).unwrap(), "new");
        assert!(fs::symlink_metadata(&link).unwrap().is_symlink());
        whole(Path::new("/dev/null"), |path| fs::write(path, "gone")).unwrap();
    }

    #[cfg(target_os = "linux")]
    #[test]
    fn a_full_disk_is_an_error() {
        let picture = DynamicImage::new_rgba8(3, 3);
        assert!(
            save(picture, Path::new("/dev/full"))
                .unwrap_err()
                .to_string()
                .starts_with("/dev/full: could not be written")
        );
    }
}
