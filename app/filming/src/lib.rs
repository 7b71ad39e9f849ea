//! Stills and films without a window: moments in, pictures out.
//!
//! A [`PictureMaker`] draws one moment by one method, for one projection and one eye or two. Its work is in two steps,
//! so that the device draws on while the picture before is fetched: [`PictureMaker::begin`] and [`Taking::finish`]. A
//! [`Shooting`] leads all pictures of a film through these, and a [`PictureSink`] writes them beside that.

mod high_range;
mod layout;
mod maker;
mod moment;
mod outside_look;
mod reel;
mod shoot;
mod sink;

pub use high_range::{DeepPicture, signal};
pub use layout::StereoLayout;
pub use maker::{MakerError, MakerOptions, PictureMaker, Taking, TracedPart};
pub use moment::{FilmView, Look, Moment};
pub use outside_look::OutsideLook;
pub use reel::Reel;
pub use shoot::{DueFrame, Onlooker, Shooting};
pub use sink::{FrameFile, FramePictures, PictureSink, SinkError, eye_names, eye_paths, film_tags};
