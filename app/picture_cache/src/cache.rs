//! Folder of the files: what is read, written, and removed.

use crate::packed::{packed, unpacked};
use built_in::town::{EDITION, TownPicture};
use directories::ProjectDirs;
use std::ffi::OsStr;
use std::fs::{self, File};
use std::io::{self, Write};
use std::path::{Path, PathBuf};
use std::time::{Duration, SystemTime};

/// Extension of the files.
pub(crate) const EXTENSION: &str = "pictures";
/// Extension of files that are not whole yet.
const PART: &str = "part";
/// Number of files that are kept: the newest, for programs that take turns.
pub(crate) const KEPT: usize = 2;
/// Age at which a file that is not whole is what a program that was killed has left behind.
const ABANDONED: Duration = Duration::from_secs(600);
/// Largest size of a file, bytes.
const LARGEST: u64 = 1 << 28;

/// Folder of kept pictures.
pub struct PictureCache {
    folder: PathBuf,
}

impl PictureCache {
    /// Cache in the user's folder for caches; `None` if the system names none.
    pub fn of_user() -> Option<Self> {
        ProjectDirs::from("", "", "rapidity").map(|directories| Self::at(directories.cache_dir()))
    }

    /// Cache in a folder, which need not exist.
    pub fn at(folder: &Path) -> Self {
        Self { folder: folder.to_owned() }
    }

    /// Pictures of the town of this seed, if they are kept and whole.
    pub fn load(&self, seed: u64) -> Option<Vec<TownPicture>> {
        unpacked(&regular_file::read(&self.path(seed), LARGEST).ok()?, seed)
    }

    /// Keeps pictures of the town of this seed, and removes those of other editions beyond a few.
    ///
    /// # Errors
    /// Refusal of the system; nothing partial is left then, and what was kept before stays.
    pub fn keep(&self, seed: u64, pictures: &[TownPicture]) -> io::Result<()> {
        fs::create_dir_all(&self.folder)?;
        self.tidy(KEPT);
        let path = self.path(seed);
        let nanoseconds = SystemTime::UNIX_EPOCH.elapsed().map_or(0, |since| since.as_nanos());
        let part = path.with_extension(format!("{}-{nanoseconds}.{PART}", std::process::id()));
        let written = File::create_new(&part).and_then(|mut file| {
            file.write_all(&packed(pictures, seed))?;
            file.sync_all()?;
            fs::rename(&part, &path)
        });
        if written.is_err() {
            // An error here means that there is nothing to remove.
            let _ = fs::remove_file(&part);
        }
        self.tidy(KEPT);
        written
    }

    /// Place of the file for a seed, painted by this edition of the program.
    pub(crate) fn path(&self, seed: u64) -> PathBuf {
        self.folder.join(format!("town-{seed}-{EDITION:016x}.{EXTENSION}"))
    }

    /// Removes all files of this cache but the newest `kept`, and parts that nobody writes any more.
    fn tidy(&self, kept: usize) {
        let Ok(entries) = fs::read_dir(&self.folder) else { return };
        let ours = entries.flatten().filter(|entry| entry.file_name().to_string_lossy().starts_with("town-"));
        let mut whole = Vec::new();
        for entry in ours {
            let path = entry.path();
            let Ok(written) = entry.metadata().and_then(|metadata| metadata.modified()) else { continue };
            let extension = path.extension().and_then(OsStr::to_str);
            if extension == Some(EXTENSION) {
                whole.push((written, path));
            } else if extension == Some(PART) && written.elapsed().is_ok_and(|age| age > ABANDONED) {
                // An error means that somebody else removes it.
                let _ = fs::remove_file(path);
            }
        }
        whole.sort_by(|a, b| b.cmp(a));
        for (_, path) in whole.into_iter().skip(kept) {
            let _ = fs::remove_file(path);
        }
    }
}
