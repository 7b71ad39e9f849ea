//! Options of films and numbered pictures.

use clap::Args;
use picture_files::{FarmPart, FilmCodec, FrameNumbers, HdrCurve};
use std::path::Path;
use std::str::FromStr;

use super::values::{self, Output};

/// Pictures per second of a film without `--fps`.
const FRAMES_PER_SECOND: f64 = 30.0;

/// Options of films and numbered pictures.
#[derive(Args, Clone, Debug, Default, PartialEq)]
#[command(next_help_heading = "Film")]
pub struct FilmOptions {
    /// Length of a film, seconds of the observer's own time [default: 10, or the whole recording].
    ///
    /// With 0, a film has its first picture alone. For a picture of a recording, the moment to draw [default: its end].
    #[arg(long, value_name = "N", value_parser = values::not_negative)]
    pub seconds: Option<f64>,
    /// Pictures per second of a film [default: 30].
    #[arg(long, value_name = "N", value_parser = values::within(0.1, 1000.0))]
    pub fps: Option<f64>,
    /// Numbers of the pictures to draw, the first of a film being 0: as in 12, 1-100, 3,5-10 or 7-20:2.
    #[arg(long, value_name = "NUMBERS")]
    pub frames: Option<FrameNumbers>,
    /// Draw only every Nth of the pictures.
    #[arg(long, value_name = "N", value_parser = clap::value_parser!(u64).range(1..=1_000_000))]
    pub step: Option<u64>,
    /// Keep the numbered pictures that are there and whole, and draw the others.
    #[arg(long)]
    pub resume: bool,
    /// Part of the numbered pictures to draw, for many machines that draw together: as in 3/16, or env for the part
    /// that Slurm, Open MPI or a PMI launcher has given this program.
    #[arg(long, value_name = "K/N")]
    pub part: Option<PartChoice>,
    /// FilmCodec of a film [default: h264; prores in a .mov file].
    #[arg(long, value_enum, value_name = "CODEC")]
    pub codec: Option<FilmCodec>,
    /// Write a film of a high dynamic range, in the colours of Rec. 2020: white is 203 cd/m², and what is brighter
    /// shines; by h265 without --codec.
    ///
    /// Light is exposed as --exposure says; --tone and --gamut are for screens without that range.
    #[arg(long, value_enum, value_name = "SIGNAL")]
    pub hdr: Option<HdrCurve>,
}

/// Part of the pictures that a program is to draw.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum PartChoice {
    /// A part that is named.
    Named(FarmPart),
    /// The part that the environment names.
    Environment,
}

impl FromStr for PartChoice {
    type Err = String;
    fn from_str(text: &str) -> Result<Self, String> {
        match text {
            "env" => Ok(Self::Environment),
            text => FarmPart::numbered(text)
                .map(Self::Named)
                .ok_or_else(|| "expected a part and the number of parts, as in 3/16, or env".to_owned()),
        }
    }
}

impl FilmOptions {
    /// Pictures per second of the film.
    pub fn frames_per_second(&self) -> f64 {
        self.fps.unwrap_or(FRAMES_PER_SECOND)
    }

    /// Number of pictures in a film of `seconds`.
    pub fn count(&self, seconds: f64) -> u64 {
        (seconds * self.frames_per_second()).round().max(1.0) as u64
    }

    /// FilmCodec of a film of this name.
    pub fn film_codec(&self, path: &Path) -> FilmCodec {
        let usual = match FilmCodec::usual(path) {
            usual if self.hdr.is_some() && !usual.is_deep() => FilmCodec::H265,
            usual => usual,
        };
        self.codec.unwrap_or(usual)
    }

    /// Checks rules between the options. `replays`: the film is that of a recording.
    pub(super) fn check(&self, out: &Output, replays: bool) -> Result<(), String> {
        let numbered = matches!(out, Output::Sequence(..));
        let moving = numbered || matches!(out, Output::Film(_));
        if !moving {
            if self.fps.is_some() {
                return Err("--fps is for films: name an .mp4 file with --out, or leave --fps out".to_owned());
            }
            if self.seconds.is_some() && !replays {
                return Err("--seconds is for films and recordings: name an .mp4 file with --out, or a recording \
                     with --replay, or leave --seconds out"
                    .to_owned());
            }
            if self.frames.is_some() || self.step.is_some() {
                return Err("--frames and --step are for films: name numbered pictures with --out, as in \
                     film.####.png, or an .mp4 file"
                    .to_owned());
            }
        }
        if !numbered && (self.resume || self.part.is_some()) {
            return Err(
                "--resume and --part are for numbered pictures: name them with --out, as in film.####.png".to_owned()
            );
        }
        if self.hdr.is_some() {
            if !matches!(out, Output::Film(_)) {
                return Err("--hdr is for films; light itself goes into .exr files".to_owned());
            }
            if !self.film_codec(&out.path()).is_deep() {
                return Err("--hdr needs a codec with more than 8 bits: --codec h265, av1, prores or ffv1".to_owned());
            }
        }
        match (self.codec, out) {
            (None, _) => Ok(()),
            (Some(codec), Output::Film(path)) if codec.fits(path) => Ok(()),
            (Some(codec), Output::Film(_)) => {
                let name = clap::ValueEnum::to_possible_value(&codec);
                let name = name.as_ref().map_or("it", |name| name.get_name());
                Err(format!("--codec {name} goes into {} files; name one with --out", codec.endings()))
            }
            (Some(_), _) => Err("--codec is for films: name an .mp4, .mov or .mkv file with --out".to_owned()),
        }
    }
}
