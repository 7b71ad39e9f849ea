//! Numbered pictures: their names, and which of them are there and whole.

use image::ImageReader;
use std::path::{Path, PathBuf};

/// Name of numbered pictures: a path whose file name has a place for the number, as `film.####.png` or
/// `film.%04d.exr`.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct SequenceName {
    folder: PathBuf,
    before: String,
    after: String,
    digits: usize,
}

impl SequenceName {
    /// Name of numbered pictures; `None` if the file name has no place for a number, or two.
    pub fn of(path: &Path) -> Option<Self> {
        let name = path.file_name()?.to_str()?;
        let (start, end, digits) = number_place(name)?;
        let (before, after) = (name[..start].to_owned(), name[end..].to_owned());
        if number_place(&after).is_some() {
            return None;
        }
        Some(Self { folder: path.parent().unwrap_or(Path::new("")).to_owned(), before, after, digits })
    }

    /// Path of the picture with this number.
    pub fn path(&self, number: u64) -> PathBuf {
        let Self { folder, before, after, digits } = self;
        folder.join(format!("{before}{number:0digits$}{after}"))
    }

    /// The name as it was given, with `#` for digits.
    pub fn pattern(&self) -> PathBuf {
        let Self { folder, before, after, digits } = self;
        folder.join(format!("{before}{}{after}", "#".repeat(*digits)))
    }

    /// The name for one of several pictures of each number: a word is put before the number.
    #[must_use]
    pub fn with_word(&self, word: &str) -> Self {
        Self { before: format!("{}{word}.", self.before), ..self.clone() }
    }
}

/// Place of a number in a name: its first byte, the byte after it, and its digits.
fn number_place(name: &str) -> Option<(usize, usize, usize)> {
    if let Some(start) = name.find('#') {
        let digits = name[start..].bytes().take_while(|byte| *byte == b'#').count();
        return Some((start, start + digits, digits));
    }
    name.match_indices('%').find_map(|(start, _)| {
        let digits: String = name[start + 1..].chars().take_while(char::is_ascii_digit).collect();
        let end = start + 1 + digits.len();
        let width: usize = digits.parse().unwrap_or(1);
        name[end..].starts_with('d').then_some((start, end + 1, width.clamp(1, 20)))
    })
}

/// True if a picture of this size is there and can be read to its end.
pub fn is_whole(path: &Path, size: [u32; 2]) -> bool {
    let read = ImageReader::open(path).ok().and_then(|reader| reader.with_guessed_format().ok());
    read.and_then(|reader| reader.decode().ok()).is_some_and(|picture| [picture.width(), picture.height()] == size)
}

#[cfg(test)]
mod tests {
    //! Law: a name's numbers are written as asked for, and a picture counts as whole only if all of it can be read. A
    //! wrong program would overwrite frames, or leave half a picture in a film.
    #![allow(clippy::unwrap_used, reason = "a folder that cannot be read is a failed test")]

    use super::*;
    use crate::exr;
    use crate::files::save;
    use image::{Rgb32FImage, RgbaImage};

    #[test]
    fn numbers_are_written_as_asked_for() {
        for (name, number, path) in [
            ("film.####.exr", 7, "film.0007.exr"),
            ("a/b#.png", 12, "a/b12.png"),
            ("film.%04d.png", 12345, "film.12345.png"),
            ("%d.png", 3, "3.png"),
            ("%4d.png", 3, "0003.png"),
            ("100%_%06d.exr", 3, "100%_000003.exr"),
        ] {
            assert_eq!(SequenceName::of(Path::new(name)).unwrap().path(number), Path::new(path), "{name}");
        }
        for wrong in ["film.png", "a#b#.png", "%04d%d.png", "a##/film.png", "50%.png"] {
            assert_eq!(SequenceName::of(Path::new(wrong)), None, "{wrong}");
        }
        let name = SequenceName::of(Path::new("f/film.%03d.png")).unwrap();
        assert_eq!(name.pattern(), Path::new("f/film.###.png"));
        assert_eq!(name.with_word("left").path(1), Path::new("f/film.left.001.png"));
    }

    #[test]
    fn half_a_picture_is_not_whole() {
        let folder = tempfile::tempdir().unwrap();
        let (png, light) = (folder.path().join("a.png"), folder.path().join("a.exr"));
        let noise = |column: u32, row: u32| (column * 7919 + row * 104_729) % 251;
        let noisy = RgbaImage::from_fn(40, 30, |x, y| image::Rgba([noise(x, y) as u8, 0, 9, 255]));
        save(noisy, &png).unwrap();
        exr::save(&Rgb32FImage::from_fn(40, 30, |x, y| image::Rgb([noise(x, y) as f32, 1.0, 0.5])), &light).unwrap();
        for path in [png, light] {
            assert!(is_whole(&path, [40, 30]) && !is_whole(&path, [30, 40]), "{}", path.display());
            let bytes = std::fs::read(&path).unwrap();
            for share in [0, 1, 2, 3] {
                std::fs::write(&path, &bytes[..bytes.len() * share / 4]).unwrap();
                assert!(!is_whole(&path, [40, 30]), "{} of {share}/4", path.display());
            }
        }
        assert!(!is_whole(&folder.path().join("none.png"), [40, 30]));
    }
}
