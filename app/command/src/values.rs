//! Parsers of one option's text: vectors, velocities, sizes, speeds, files by their extension.
//!
//! A parser refuses any value that the rest of the program could not use, and says what it expected. clap puts the
//! option's name and the text in front.

use std::path::{Path, PathBuf};
use std::str::FromStr;

use super::frame_rate::FrameRate;
use clap::builder::{PathBufValueParser, TypedValueParser};
use filming::FrameFile;
use glam::DVec3;
use physics::{Beta, Celerity, CelerityError};
use picture_files::SequenceName;
use thiserror::Error;

/// Reason why an option's text has no value.
#[derive(Clone, Debug, Error, PartialEq)]
pub enum ValueError {
    /// A text that is no vector.
    #[error("expected three finite numbers with commas between them, as in -3,1.6,0")]
    Vector,
    /// A vector whose square no number holds.
    #[error("expected numbers up to 1e100")]
    Farthest,
    /// A direction of length zero.
    #[error("expected a direction, which must not be 0,0,0")]
    Direction,
    /// A text that is no velocity.
    #[error(transparent)]
    Velocity(#[from] CelerityError),
    /// A text that is no colour.
    #[error("expected three numbers from 0 to 1 with commas between them: linear red, green, blue, as in 0.2,0.3,0.5")]
    Colour,
    /// A text that is no size of a picture.
    #[error("expected WIDTHxHEIGHT in pixels, each from 1 to {MAXIMAL_SIZE}, as in 1280x720")]
    Size,
    /// A text that is no speed.
    #[error("expected a positive number and a unit (m/s, km/h, mph, km/s or c), as in \"30 km/h\"")]
    Speed,
    /// A text that is no time with a unit.
    #[error("expected a time above 0 and its unit, ms or s, as in 16.7ms")]
    Time,
    /// A text that is no length in pixels.
    #[error("expected a number of pixels above 0, as in 1px")]
    Pixels,
    /// A text that is no finite number above zero.
    #[error("expected a finite number above 0")]
    Positive,
    /// A number below zero, or a text that is no finite number.
    #[error("expected a finite number, 0 or above")]
    NotNegative,
    /// A text that is no time in seconds.
    #[error("expected seconds, 0 or more, as in 0.02 or 1/50")]
    ShareOfTime,
    /// A number outside its range.
    #[error("expected a number from {least} to {most}")]
    Range {
        /// Smallest value allowed.
        least: f64,
        /// Largest value allowed.
        most: f64,
    },
    /// A file name whose extension is not supported here.
    #[error("the file's name must end in {allowed}")]
    Extension {
        /// Extensions that are allowed.
        allowed: &'static str,
    },
    /// A text that is no state of a switch.
    #[error("expected on or off")]
    Switch,
    /// A text that is no frame rate.
    #[error("expected 1 to 1000 frames per second, or off, as in 30")]
    FrameRate,
    /// A text that names no vehicle.
    #[error("expected bicycle, drive or fly")]
    Vehicle,
}

/// Largest coordinate: the square of a longer way overflows.
const FARTHEST: f64 = 1e100;

/// Largest side of a picture, pixels: that of a graphics device's texture.
const MAXIMAL_SIZE: u32 = 16_384;

/// Endings of files that are no folders, though this program does not write them: a name that has one is a mistake.
const OTHER_FILES: [&str; 14] =
    ["jpg", "jpeg", "bmp", "tif", "tiff", "gif", "webp", "hdr", "ppm", "tga", "avi", "webm", "gltf", "glb"];

/// File endings that `--out` takes, for messages.
pub(super) const ENDINGS: &str = ".png (a picture), .exr (a picture as light), or .mp4, .mov or .mkv (a film)";

/// Units in which a speed may be given, with their values in m/s.
const SPEED_UNITS: [(&str, f64); 5] =
    [("km/h", 1.0 / 3.6), ("km/s", 1000.0), ("m/s", 1.0), ("mph", 0.447_04), ("c", 299_792_458.0)];

/// Output file, its kind chosen by the ending of its name.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum Output {
    /// A PNG picture.
    Picture(PathBuf),
    /// A picture of light as OpenEXR.
    Light(PathBuf),
    /// A film.
    Film(PathBuf),
    /// Numbered pictures.
    Sequence(SequenceName, FrameFile),
    /// A folder with a picture for every channel of a display.
    Folder(PathBuf),
}

impl Output {
    /// Path of the file or folder; of numbered pictures the pattern.
    pub fn path(&self) -> PathBuf {
        match self {
            Self::Picture(path) | Self::Light(path) | Self::Film(path) | Self::Folder(path) => path.clone(),
            Self::Sequence(name, _) => name.pattern(),
        }
    }
}

impl TryFrom<PathBuf> for Output {
    type Error = ValueError;
    fn try_from(path: PathBuf) -> Result<Self, ValueError> {
        let numbered = SequenceName::of(&path);
        if let (Some(name), true) = (&numbered, has_extension(&path, &["png"])) {
            Ok(Self::Sequence(name.clone(), FrameFile::Png))
        } else if let (Some(name), true) = (&numbered, has_extension(&path, &["exr"])) {
            Ok(Self::Sequence(name.clone(), FrameFile::Exr))
        } else if has_extension(&path, &["png"]) {
            Ok(Self::Picture(path))
        } else if has_extension(&path, &["exr"]) {
            Ok(Self::Light(path))
        } else if has_extension(&path, &["mp4", "mov", "mkv"]) {
            Ok(Self::Film(path))
        } else if path.is_dir() || !has_extension(&path, &OTHER_FILES) {
            // A folder's name may have a dot in it. Whether a folder is wanted is known when all options are.
            Ok(Self::Folder(path))
        } else {
            Err(ValueError::Extension { allowed: ENDINGS })
        }
    }
}

/// Parser of an output: a picture, light, a film or a folder.
pub(super) fn output() -> impl TypedValueParser<Value = Output> {
    PathBufValueParser::new().try_map(Output::try_from)
}

/// Parser of a film's file name.
pub(super) fn film() -> impl TypedValueParser<Value = PathBuf> {
    file(&["mp4"], ".mp4")
}

/// Parser of a camera path's file name, or of the word for the scene's own camera.
pub(super) fn camera_path() -> impl TypedValueParser<Value = PathBuf> {
    PathBufValueParser::new().try_map(|path| {
        let known = has_extension(&path, &["toml"]) || path == Path::new("camera");
        if known { Ok(path) } else { Err(ValueError::Extension { allowed: ".toml, or be the word camera" }) }
    })
}

/// Parser of a recording's file name.
pub(super) fn recording() -> impl TypedValueParser<Value = PathBuf> {
    file(&["mcap"], ".mcap")
}

/// Parser of a file name for a scene to write.
pub(super) fn glb() -> impl TypedValueParser<Value = PathBuf> {
    file(&["glb"], ".glb")
}

/// Parser of a file name for a plot to write.
pub(super) fn plot() -> impl TypedValueParser<Value = PathBuf> {
    file(&["svg", "png"], ".svg or .png")
}

/// Parser of a file name for a table to write.
pub(super) fn table() -> impl TypedValueParser<Value = PathBuf> {
    file(&["csv"], ".csv")
}

fn file(extensions: &'static [&'static str], allowed: &'static str) -> impl TypedValueParser<Value = PathBuf> {
    PathBufValueParser::new().try_map(move |path| {
        if has_extension(&path, extensions) { Ok(path) } else { Err(ValueError::Extension { allowed }) }
    })
}

/// True if a path ends in one of these (lower-case) extensions, in upper or lower case.
pub(super) fn has_extension(path: &Path, extensions: &[&str]) -> bool {
    let extension = path.extension().map(|extension| extension.to_ascii_lowercase());
    extension.is_some_and(|extension| extensions.iter().any(|allowed| extension == *allowed))
}

/// Place: three numbers whose squares can be added.
pub(super) fn vector(text: &str) -> Result<DVec3, ValueError> {
    let vector = finite(text)?;
    if vector.abs().max_element() <= FARTHEST { Ok(vector) } else { Err(ValueError::Farthest) }
}

/// Vector of three finite numbers.
fn finite(text: &str) -> Result<DVec3, ValueError> {
    numbers(text).map(DVec3::from_array).ok_or(ValueError::Vector)
}

/// Unit vector along a vector of any length but zero.
pub(super) fn direction(text: &str) -> Result<DVec3, ValueError> {
    let vector = finite(text)?;
    // The vector is scaled first, because its square may overflow or vanish.
    (vector / vector.abs().max_element()).try_normalize().ok_or(ValueError::Direction)
}

/// Velocity given as γβ.
pub(super) fn celerity(text: &str) -> Result<Celerity, ValueError> {
    Ok(Celerity::new(finite(text)?)?)
}

/// Velocity given as v/c.
pub(super) fn beta(text: &str) -> Result<Celerity, ValueError> {
    Ok(Beta::new(finite(text)?)?.celerity())
}

/// Colour as linear red, green and blue, each 0 to 1.
pub(super) fn colour(text: &str) -> Result<[f32; 3], ValueError> {
    let colour = numbers(text).ok_or(ValueError::Colour)?;
    if colour.iter().all(|channel| (0.0..=1.0).contains(channel)) {
        Ok(colour.map(|channel| channel as f32))
    } else {
        Err(ValueError::Colour)
    }
}

/// Width and height, pixels.
pub(super) fn size(text: &str) -> Result<[u32; 2], ValueError> {
    let (width, height) = text.split_once(['x', 'X', '×']).ok_or(ValueError::Size)?;
    let side = |text: &str| match text.trim().parse() {
        Ok(side @ 1..=MAXIMAL_SIZE) => Ok(side),
        _ => Err(ValueError::Size),
    };
    Ok([side(width)?, side(height)?])
}

/// Speed in m/s, from a number and its unit.
pub(super) fn speed(text: &str) -> Result<f64, ValueError> {
    let text = text.trim();
    let (number, factor) = SPEED_UNITS
        .iter()
        .find_map(|(unit, factor)| Some((text.strip_suffix(unit)?, factor)))
        .ok_or(ValueError::Speed)?;
    let speed = number.trim().parse::<f64>().map_err(|_| ValueError::Speed)? * factor;
    if speed.is_finite() && speed > 0.0 { Ok(speed) } else { Err(ValueError::Speed) }
}

/// Time in milliseconds, from a number and its unit.
pub(super) fn milliseconds(text: &str) -> Result<f64, ValueError> {
    let text = text.trim();
    let (number, factor) = match text.strip_suffix("ms") {
        Some(number) => (number, 1.0),
        None => (text.strip_suffix('s').ok_or(ValueError::Time)?, 1e3),
    };
    positive(number).map(|number| number * factor).ok().filter(|ms| ms.is_finite()).ok_or(ValueError::Time)
}

/// Length in pixels, from a number and its unit.
pub(super) fn pixels(text: &str) -> Result<f64, ValueError> {
    let number = text.trim().strip_suffix("px").ok_or(ValueError::Pixels)?;
    positive(number).map_err(|_| ValueError::Pixels)
}

/// Frames per second from 1 to 1000, or `off`.
///
/// # Errors
/// [`ValueError::FrameRate`].
pub fn frame_rate(text: &str) -> Result<FrameRate, ValueError> {
    match text.parse::<f64>() {
        Ok(rate) if (1.0..=1000.0).contains(&rate) => Ok(FrameRate::Held(rate)),
        Err(_) if text == "off" => Ok(FrameRate::Any),
        _ => Err(ValueError::FrameRate),
    }
}

/// State of a switch: `on` or `off`.
///
/// # Errors
/// [`ValueError::Switch`].
pub fn on_off(text: &str) -> Result<bool, ValueError> {
    match text {
        "on" => Ok(true),
        "off" => Ok(false),
        _ => Err(ValueError::Switch),
    }
}

/// Finite number above zero.
pub(super) fn positive(text: &str) -> Result<f64, ValueError> {
    number(text).filter(|number| *number > 0.0).ok_or(ValueError::Positive)
}

/// Finite number, zero or above.
pub(super) fn not_negative(text: &str) -> Result<f64, ValueError> {
    number(text).filter(|number| *number >= 0.0).ok_or(ValueError::NotNegative)
}

/// Time in seconds, also as a fraction such as 1/50.
pub(super) fn share_of_time(text: &str) -> Result<f64, ValueError> {
    let (above, below) = text.split_once('/').unwrap_or((text, "1"));
    let quotient = number(above).zip(number(below)).map(|(above, below)| above / below);
    quotient.filter(|seconds| seconds.is_finite() && *seconds >= 0.0).ok_or(ValueError::ShareOfTime)
}

/// Parser of a number from `least` to `most`.
pub(super) fn within(
    least: f64,
    most: f64,
) -> impl Fn(&str) -> Result<f64, ValueError> + Clone + Send + Sync + 'static {
    move |text| number(text).filter(|number| (least..=most).contains(number)).ok_or(ValueError::Range { least, most })
}

fn numbers(text: &str) -> Option<[f64; 3]> {
    let mut parts = text.split(',').map(number);
    let numbers = [parts.next()??, parts.next()??, parts.next()??];
    parts.next().is_none().then_some(numbers)
}

fn number(text: &str) -> Option<f64> {
    f64::from_str(text.trim()).ok().filter(|number| number.is_finite())
}
