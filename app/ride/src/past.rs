//! Past of a ride: in memory as long as it is short, then in a temporary recording on the disk.

use input::recording::{Recorder, RecordingEntry, RecordingError, RideHeader};
use std::fs::File;
use std::path::{Path, PathBuf};
use std::sync::atomic::{AtomicU32, Ordering};
use std::time::Duration;

/// Largest memory of the entries that are kept, bytes: some ten minutes of a ride.
const MOST_REMEMBERED: usize = 64 << 20;
/// Beginning of the name of a temporary recording.
const PREFIX: &str = "past-ride-";
/// Number of names that are tried.
const MOST_NAMES: u32 = 1000;
/// Age from which a temporary recording that nobody holds is a remnant.
const REMNANT: Duration = Duration::from_secs(60);

/// Past of a ride.
pub(crate) enum Past {
    /// Entries since the beginning, and their memory, bytes.
    Memory { entries: Vec<RecordingEntry>, bytes: usize },
    /// Temporary recording, with everything so far.
    Disk(Box<PastOnDisk>),
    /// Nothing, with the reason.
    Gone(String),
}

/// Temporary recording of a ride's past. Its file goes with it.
pub(crate) struct PastOnDisk {
    pub(crate) recorder: Recorder,
    pub(crate) path: PathBuf,
    /// Handle whose lock says that the file is in use.
    _held: Option<File>,
}

impl Past {
    /// Past of a ride that has not begun.
    pub(crate) fn new() -> Self {
        Self::Memory { entries: Vec::new(), bytes: 0 }
    }

    /// Adds the entries of a frame. A past that has become long goes to a temporary file in `folder`.
    pub(crate) fn add(&mut self, new: Vec<RecordingEntry>, header: &RideHeader, began: Option<u64>, folder: &Path) {
        match self {
            Self::Memory { entries, bytes } => {
                *bytes += new.iter().map(RecordingEntry::memory).sum::<usize>();
                entries.extend(new);
                if *bytes > MOST_REMEMBERED {
                    let entries = std::mem::take(entries);
                    *self = match PastOnDisk::begin(folder, header, began, entries) {
                        Ok(disk) => Self::Disk(Box::new(disk)),
                        Err(error) => Self::Gone(error.to_string()),
                    };
                }
            }
            Self::Disk(disk) => {
                if let Err(error) = new.into_iter().try_for_each(|entry| disk.recorder.entry(entry)) {
                    *self = Self::Gone(error.to_string());
                }
            }
            Self::Gone(_) => {}
        }
    }
}

impl PastOnDisk {
    fn begin(
        folder: &Path,
        header: &RideHeader,
        began: Option<u64>,
        entries: Vec<RecordingEntry>,
    ) -> Result<Self, RecordingError> {
        let io = |path: &Path, action, cause| RecordingError::Io { path: path.to_owned(), action, cause };
        std::fs::create_dir_all(folder).map_err(|cause| io(folder, "create", cause))?;
        remove_remnants(folder);
        let (path, recorder) = unused(folder, header)?;
        // The file goes with this value, whatever happens from here on.
        let mut disk = Self { recorder, path, _held: None };
        if let Ok(held) = File::open(&disk.path) {
            // Where files cannot be locked, their age alone says whether they are in use.
            let _ = held.lock_shared();
            disk._held = Some(held);
        }
        if let Some(began) = began {
            disk.recorder.began(began)?;
        }
        disk.recorder.past(entries)?;
        Ok(disk)
    }
}

impl Drop for PastOnDisk {
    fn drop(&mut self) {
        // A file that is gone already is as it should be.
        let _ = std::fs::remove_file(&self.path);
    }
}

/// Temporary recording under a name that nobody has: programs on other machines may share the folder.
fn unused(folder: &Path, header: &RideHeader) -> Result<(PathBuf, Recorder), RecordingError> {
    static NUMBER: AtomicU32 = AtomicU32::new(0);
    loop {
        let number = NUMBER.fetch_add(1, Ordering::Relaxed);
        let path = folder.join(format!("{PREFIX}{}-{number}.mcap", std::process::id()));
        match Recorder::create(&path, header) {
            Err(RecordingError::Exists { .. }) if number < MOST_NAMES => {}
            outcome => return outcome.map(|recorder| (path, recorder)),
        }
    }
}

/// Removes the temporary recordings of programs that did not end in order.
fn remove_remnants(folder: &Path) {
    for file in std::fs::read_dir(folder).into_iter().flatten().flatten() {
        let metadata = file.metadata().ok().filter(std::fs::Metadata::is_file);
        let is_past = file.file_name().to_string_lossy().starts_with(PREFIX);
        let age = metadata.and_then(|metadata| metadata.modified().ok()?.elapsed().ok());
        let is_old = age.is_some_and(|age| age > REMNANT);
        if is_past && is_old && File::open(file.path()).is_ok_and(|remnant| remnant.try_lock().is_ok()) {
            // Another program may have been faster.
            let _ = std::fs::remove_file(file.path());
        }
    }
}
