//! Painted pictures of the town, and the edition of their painting: what a store of pictures has to know.

use std::sync::Arc;

/// Pixels of one picture.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct TownPicture {
    /// Width, pixels.
    pub width: u32,
    /// Height, pixels.
    pub height: u32,
    /// Pixels: `width * height` times four bytes, R, G, B, A, sRGB-encoded, rows from the top.
    pub rgba: Arc<Vec<u8>>,
}

/// Text of everything that decides which pixels a seed gives.
const SOURCES: [&str; 13] = [
    include_str!("canvas.rs"),
    include_str!("paint/dial.rs"),
    include_str!("paint/ground_floors.rs"),
    include_str!("paint/masonry.rs"),
    include_str!("paint/mod.rs"),
    include_str!("paint/nature.rs"),
    include_str!("paint/openings.rs"),
    include_str!("paint/signs.rs"),
    include_str!("paint/timber.rs"),
    include_str!("paint/tracery.rs"),
    include_str!("pictures.rs"),
    include_str!("surface.rs"),
    include_str!("../turn.rs"),
];

/// Edition of the painting: another number wherever the painting code is another, so that pictures painted by another
/// program are not taken for this one's.
pub const EDITION: u64 = edition();

/// FNV-1a over the sources.
const fn edition() -> u64 {
    let mut hash = 0xcbf2_9ce4_8422_2325_u64;
    let mut number = 0;
    while number < SOURCES.len() {
        let text = SOURCES[number].as_bytes();
        let mut place = 0;
        while place < text.len() {
            hash = (hash ^ text[place] as u64).wrapping_mul(0x0100_0000_01b3);
            place += 1;
        }
        number += 1;
    }
    hash
}

#[cfg(test)]
mod tests {
    //! Law: the edition hears of every change of the painting code.
    #![allow(clippy::unwrap_used, reason = "a folder that cannot be read is a failed test")]

    use super::*;
    use std::fs;
    use std::path::Path;

    #[test]
    fn every_file_that_paints_is_part_of_the_edition() {
        let town = Path::new(env!("CARGO_MANIFEST_DIR")).join("src/town");
        let brushes = fs::read_dir(town.join("paint")).unwrap().map(|entry| entry.unwrap().path());
        let others = ["canvas.rs", "surface.rs", "pictures.rs", "../turn.rs"].map(|name| town.join(name));
        let files: Vec<_> = brushes.chain(others).collect();
        assert_eq!(files.len(), SOURCES.len());
        for file in files {
            let text = fs::read_to_string(&file).unwrap();
            assert!(SOURCES.contains(&text.as_str()), "{} is missing", file.display());
        }
    }
}
