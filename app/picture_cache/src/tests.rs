//! Law: what is kept is read again to the byte, or it is not read at all. A wrong program would show torn pictures
//! after a crash or a full disk, fail where no folder can be written, or fill the folder.
#![allow(clippy::unwrap_used, reason = "a folder that cannot be used is a failed test")]

use crate::PictureCache;
use crate::cache::{EXTENSION, KEPT};
use crate::packed::{packed, unpacked};
use built_in::town::TownPicture;
use std::fs;
use std::path::Path;
use std::sync::Arc;

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
