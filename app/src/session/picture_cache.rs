//! Pictures of the old town that were painted once, kept in the user's cache folder. Painting them takes seconds,
//! reading them a fraction of one.
//!
//! A file holds the pictures of one edition: a head, the packed planes of each picture, and a checksum of all that.
//! It is written beside its place and renamed, so that any number of programs may start at once. A file that is
//! missing, damaged or foreign means that the pictures are painted and kept anew; a folder that cannot be written
//! means that nothing is kept. Neither is a fault.

use built_in::town::{EDITION, TownPicture};
use directories::ProjectDirs;
use rayon::prelude::*;
use std::ffi::OsStr;
use std::fs::{self, File};
use std::io::{self, Write};
use std::path::{Path, PathBuf};
use std::sync::Arc;
use std::time::{Duration, SystemTime};

/// First bytes of a file, with the number of its form.
const MAGIC: &[u8; 8] = b"rapipic1";
/// Extension of the files.
const EXTENSION: &str = "pictures";
/// Extension of files that are not whole yet.
const PART: &str = "part";
/// Number of files that are kept: the newest, for programs that take turns.
const KEPT: usize = 2;
/// Age at which a file that is not whole is what a program that was killed has left behind.
const ABANDONED: Duration = Duration::from_secs(600);
/// Largest size of a file, bytes.
const LARGEST: u64 = 1 << 28;
/// Largest side of a picture, pixels.
const LARGEST_SIDE: u32 = 1 << 13;
/// Bytes of all pictures together that are believed.
const LARGEST_CONTENTS: u64 = 1 << 29;

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
    fn path(&self, seed: u64) -> PathBuf {
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

/// File of pictures: magic, edition, seed, number of pictures; of each width, height and packed length; then what is
/// packed, and a checksum. Numbers are little-endian.
fn packed(pictures: &[TownPicture], seed: u64) -> Vec<u8> {
    let blocks: Vec<Vec<u8>> = pictures.par_iter().map(|picture| lz4_flex::compress(&planes(&picture.rgba))).collect();
    let mut file = MAGIC.to_vec();
    file.extend(EDITION.to_le_bytes());
    file.extend(seed.to_le_bytes());
    file.extend((pictures.len() as u32).to_le_bytes());
    for (picture, block) in pictures.iter().zip(&blocks) {
        for number in [picture.width, picture.height, block.len() as u32] {
            file.extend(number.to_le_bytes());
        }
    }
    blocks.iter().for_each(|block| file.extend(block));
    file.extend(crc32fast::hash(&file).to_le_bytes());
    file
}

/// Pictures in a file; `None` if anything about it is not as [`packed`] writes it.
fn unpacked(file: &[u8], seed: u64) -> Option<Vec<TownPicture>> {
    // Check what the file says of itself before any of it is believed.
    let (contents, checksum) = file.split_last_chunk::<4>()?;
    let mut rest = contents.strip_prefix(MAGIC)?;
    let mut number = |bytes: usize| {
        let (taken, left) = rest.split_at_checked(bytes)?;
        rest = left;
        Some(taken.iter().rev().fold(0_u64, |number, &byte| number << 8 | u64::from(byte)))
    };
    if number(8)? != EDITION || number(8)? != seed || crc32fast::hash(contents) != u32::from_le_bytes(*checksum) {
        return None;
    }
    let count = number(4)?;
    let mut sizes = Vec::new();
    let mut total = 0;
    for _ in 0..count {
        let [width, height, length] = [number(4)? as u32, number(4)? as u32, number(4)? as u32];
        let sides = 1..=LARGEST_SIDE;
        total += 4 * u64::from(width) * u64::from(height);
        if !sides.contains(&width) || !sides.contains(&height) || total > LARGEST_CONTENTS {
            return None;
        }
        sizes.push((width, height, length as usize));
    }
    let mut blocks = Vec::new();
    for (width, height, length) in sizes {
        let (block, left) = rest.split_at_checked(length)?;
        rest = left;
        blocks.push((width, height, block));
    }
    if !rest.is_empty() {
        return None;
    }

    let picture = |(width, height, block): (u32, u32, &[u8])| {
        let mut planes = vec![0; 4 * width as usize * height as usize];
        let whole = lz4_flex::decompress_into(block, &mut planes).is_ok_and(|length| length == planes.len());
        whole.then(|| TownPicture { width, height, rgba: Arc::new(pixels(&planes)) })
    };
    blocks.into_par_iter().map(picture).collect()
}

/// Planes of a picture, which pack better than its pixels: red, green less red, blue less green, opacity.
fn planes(rgba: &[u8]) -> Vec<u8> {
    let count = rgba.len() / 4;
    let mut planes = vec![0; 4 * count];
    let (red, rest) = planes.split_at_mut(count);
    let (green, rest) = rest.split_at_mut(count);
    let (blue, opacity) = rest.split_at_mut(count);
    for (number, pixel) in rgba.chunks_exact(4).enumerate() {
        red[number] = pixel[0];
        green[number] = pixel[1].wrapping_sub(pixel[0]);
        blue[number] = pixel[2].wrapping_sub(pixel[1]);
        opacity[number] = pixel[3];
    }
    planes
}

/// Pixels of the picture with these [`planes`].
fn pixels(planes: &[u8]) -> Vec<u8> {
    let count = planes.len() / 4;
    let (red, rest) = planes.split_at(count);
    let (green, rest) = rest.split_at(count);
    let (blue, opacity) = rest.split_at(count);
    let mut rgba = vec![0; 4 * count];
    for ((((pixel, &red), &green), &blue), &opacity) in
        rgba.chunks_exact_mut(4).zip(red).zip(green).zip(blue).zip(opacity)
    {
        let green = green.wrapping_add(red);
        pixel.copy_from_slice(&[red, green, blue.wrapping_add(green), opacity]);
    }
    rgba
}

#[cfg(test)]
mod tests {
    //! Law: what is kept is read again to the byte, or it is not read at all. A wrong program would show torn pictures
    //! after a crash or a full disk, fail where no folder can be written, or fill the folder.
    #![allow(clippy::unwrap_used, reason = "a folder that cannot be used is a failed test")]

    use super::*;

    const SEED: u64 = 7;

    fn painted() -> Vec<TownPicture> {
        let picture = |width: u32, height: u32| {
            let rgba = (0..4 * width * height).map(|n| (n * n / 7 + n % 5) as u8).collect();
            TownPicture { width, height, rgba: Arc::new(rgba) }
        };
        vec![picture(16, 8), picture(1, 1), picture(64, 32)]
    }

    fn names(folder: &Path) -> Vec<String> {
        fs::read_dir(folder).unwrap().map(|entry| entry.unwrap().file_name().into_string().unwrap()).collect()
    }

    #[test]
    fn what_is_kept_is_read_to_the_byte_and_for_its_seed_only() {
        let folder = tempfile::tempdir().unwrap();
        let cache = PictureCache::at(&folder.path().join("new/rapidity"));
        assert_eq!(cache.load(SEED), None);
        cache.keep(SEED, &painted()).unwrap();
        assert_eq!(cache.load(SEED), Some(painted()));
        assert_eq!(cache.load(SEED + 1), None);
        fs::rename(cache.path(SEED), cache.path(SEED + 1)).unwrap();
        assert_eq!(cache.load(SEED + 1), None, "a file under another's name");
    }

    #[test]
    fn every_cut_and_every_flipped_bit_is_noticed() {
        let whole = packed(&painted(), SEED);
        assert_eq!(unpacked(&whole, SEED), Some(painted()));
        for length in 0..whole.len() {
            assert_eq!(unpacked(&whole[..length], SEED), None, "{length} bytes");
        }
        for place in 0..whole.len() {
            let mut flipped = whole.clone();
            flipped[place] ^= 1 << (place % 8);
            assert_eq!(unpacked(&flipped, SEED), None, "byte {place}");
        }
        let longer = [whole.as_slice(), &[0]].concat();
        assert_eq!(unpacked(&longer, SEED), None);
    }

    #[test]
    fn a_forged_size_takes_no_memory() {
        let mut forged = packed(&[], SEED);
        forged.truncate(24);
        forged.extend(1_u32.to_le_bytes());
        forged.extend([u32::MAX.to_le_bytes(), u32::MAX.to_le_bytes(), 0_u32.to_le_bytes()].concat());
        forged.extend(crc32fast::hash(&forged).to_le_bytes());
        assert_eq!(unpacked(&forged, SEED), None);
    }

    #[test]
    fn many_writers_at_once_leave_one_whole_file() {
        let folder = tempfile::tempdir().unwrap();
        let cache = PictureCache::at(folder.path());
        std::thread::scope(|scope| {
            for _ in 0..8 {
                scope.spawn(|| {
                    cache.keep(SEED, &painted()).unwrap();
                    assert_eq!(cache.load(SEED), Some(painted()));
                });
            }
        });
        assert_eq!(names(folder.path()).len(), 1);
    }

    #[test]
    fn old_editions_do_not_pile_up_and_foreign_files_stay() {
        let folder = tempfile::tempdir().unwrap();
        let cache = PictureCache::at(folder.path());
        fs::write(folder.path().join("notes.txt"), "mine").unwrap();
        for number in 0..9 {
            fs::write(folder.path().join(format!("town-1-{number:016x}.{EXTENSION}")), "old").unwrap();
        }
        cache.keep(SEED, &painted()).unwrap();
        assert_eq!(cache.load(SEED), Some(painted()));
        assert_eq!(names(folder.path()).len(), KEPT + 1);
        assert!(folder.path().join("notes.txt").exists());
    }

    #[test]
    fn a_place_that_is_no_folder_keeps_nothing() {
        let folder = tempfile::tempdir().unwrap();
        let file = folder.path().join("file");
        fs::write(&file, "").unwrap();
        let cache = PictureCache::at(&file.join("below"));
        assert!(cache.keep(SEED, &painted()).is_err());
        assert_eq!(cache.load(SEED), None);
    }
}
