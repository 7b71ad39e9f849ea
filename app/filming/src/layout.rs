//! Arrangement of both eyes' pictures.

use image::{GenericImage, ImageBuffer, Pixel, Rgba, RgbaImage};
use picture_files::FilmEyes;

/// Arrangement of the pictures of a left and a right eye.
#[derive(Clone, Copy, Debug, PartialEq, Eq, clap::ValueEnum)]
pub enum StereoLayout {
    /// Left eye's picture on the left, in one twice as wide.
    SideBySide,
    /// Left eye's picture above, in one twice as high.
    TopBottom,
    /// Both in one picture for red–cyan glasses; colours are lost, and with them the Doppler shift's.
    Anaglyph,
    /// A file for each eye: a word, left or right, is put into the file's name.
    LeftRightFiles,
}

/// Words that tell the files of both eyes apart.
pub const EYE_WORDS: [&str; 2] = ["left", "right"];

impl StereoLayout {
    /// Number of pictures that go into files for each moment.
    pub fn files(self) -> usize {
        if self == Self::LeftRightFiles { 2 } else { 1 }
    }

    /// Width and height of a file's picture, from those of an eye's, pixels.
    pub fn size(self, [width, height]: [u32; 2]) -> [u32; 2] {
        match self {
            Self::SideBySide => [2 * width, height],
            Self::TopBottom => [width, 2 * height],
            Self::Anaglyph | Self::LeftRightFiles => [width, height],
        }
    }

    /// Arrangement as players are told of it.
    pub fn eyes(self) -> FilmEyes {
        match self {
            Self::SideBySide => FilmEyes::SideBySide,
            Self::TopBottom => FilmEyes::TopBottom,
            Self::Anaglyph | Self::LeftRightFiles => FilmEyes::One,
        }
    }

    /// Pictures for the files, from those of the left and the right eye.
    pub fn arranged(self, left: RgbaImage, right: RgbaImage) -> Vec<RgbaImage> {
        match self {
            Self::LeftRightFiles => vec![left, right],
            Self::Anaglyph => vec![anaglyph(&left, &right)],
            Self::SideBySide | Self::TopBottom => vec![self.joined(&left, &right)],
        }
    }

    /// One picture of any kind, from those of both eyes; an anaglyph has none but on a screen.
    pub fn joined<P: Pixel>(
        self,
        left: &ImageBuffer<P, Vec<P::Subpixel>>,
        right: &ImageBuffer<P, Vec<P::Subpixel>>,
    ) -> ImageBuffer<P, Vec<P::Subpixel>> {
        let (width, height) = left.dimensions();
        let [whole_width, whole_height] = self.size([width, height]);
        let mut whole = ImageBuffer::new(whole_width, whole_height);
        let places = [(0, 0), (whole_width - width, whole_height - height)];
        for (picture, (x, y)) in [left, right].into_iter().zip(places) {
            whole.copy_from(picture, x, y).expect("the whole has room for both");
        }
        whole
    }
}

/// Red–cyan anaglyph by least squares (E. Dubois), worked out in linear light.
fn anaglyph(left: &RgbaImage, right: &RgbaImage) -> RgbaImage {
    let linear: Vec<f32> = (0..=255_u16).map(|code| decoded(f32::from(code) / 255.0)).collect();
    let light = |pixel: &Rgba<u8>| [0, 1, 2].map(|channel| linear[usize::from(pixel.0[channel])]);
    let mut both = left.clone();
    for (pixel, other) in both.pixels_mut().zip(right.pixels()) {
        let (left, right) = (light(pixel), light(other));
        for channel in 0..3 {
            let sum = |matrix: &[[f32; 3]; 3], light: &[f32; 3]| -> f32 {
                matrix[channel].iter().zip(light).map(|(weight, light)| weight * light).sum()
            };
            let value = sum(&shaders::DUBOIS_LEFT, &left) + sum(&shaders::DUBOIS_RIGHT, &right);
            pixel.0[channel] = (255.0 * encoded(value.clamp(0.0, 1.0))).round() as u8;
        }
    }
    both
}

/// Linear light of an sRGB value (IEC 61966-2-1).
fn decoded(value: f32) -> f32 {
    if value <= 0.04045 { value / 12.92 } else { ((value + 0.055) / 1.055).powf(2.4) }
}

/// sRGB value of linear light.
fn encoded(light: f32) -> f32 {
    if light <= 0.003_130_8 { 12.92 * light } else { 1.055 * light.powf(1.0 / 2.4) - 0.055 }
}

#[cfg(test)]
mod tests {
    //! Law: each eye's picture is where players look for it, and what both eyes see alike and grey stays as it is in
    //! an anaglyph. A wrong program turns depth inside out.

    use super::*;

    fn plain(code: [u8; 4]) -> RgbaImage {
        RgbaImage::from_pixel(3, 2, Rgba(code))
    }

    #[test]
    fn eyes_are_where_players_look_for_them() {
        let (left, right) = (plain([200, 0, 0, 255]), plain([0, 0, 200, 255]));
        let side = &StereoLayout::SideBySide.arranged(left.clone(), right.clone())[0];
        assert_eq!((side.dimensions(), side.get_pixel(2, 1)[0], side.get_pixel(3, 0)[2]), ((6, 2), 200, 200));
        let over = &StereoLayout::TopBottom.arranged(left.clone(), right.clone())[0];
        assert_eq!((over.dimensions(), over.get_pixel(2, 1)[0], over.get_pixel(0, 2)[2]), ((3, 4), 200, 200));
        let files = StereoLayout::LeftRightFiles.arranged(left.clone(), right.clone());
        assert_eq!(files, [left, right]);
    }

    #[test]
    fn grey_stays_grey_in_an_anaglyph() {
        for code in [0, 1, 90, 200, 255] {
            let grey = plain([code, code, code, 255]);
            let both = &StereoLayout::Anaglyph.arranged(grey.clone(), grey)[0];
            assert!(both.get_pixel(1, 1).0[..3].iter().all(|value| value.abs_diff(code) <= 1), "{code}");
        }
        // What the left eye alone sees is red, what the right eye alone sees is cyan.
        let (white, black) = (plain([255; 4]), plain([0, 0, 0, 255]));
        let left = StereoLayout::Anaglyph.arranged(white.clone(), black.clone())[0].get_pixel(0, 0).0;
        let right = StereoLayout::Anaglyph.arranged(black, white)[0].get_pixel(0, 0).0;
        assert!(left[0] > 200 && left[1] < 60 && left[2] < 60, "{left:?}");
        assert!(right[0] < 60 && right[1] > 200 && right[2] > 200, "{right:?}");
    }
}
