//! The command line: the program's commands and options, checked once and typed.
//!
//! Each subcommand is one plain struct of options. An option's text is turned into its type while it is parsed
//! (`values`), by a parser whose error says what was expected. The rest of the program then reads metres, celerities
//! and paths and checks nothing again. Rules between options stand beside the options: simple rules are given to clap
//! (`conflicts_with`, `requires`), others are in a struct's `check`.
//!
//! ```
//! use command::{Command, parse_from};
//! let Ok(Command::Render(options)) = parse_from(["rapidity", "render", "--beta", "0,0,-0.6", "--out", "street.png"])
//! else { panic!() };
//! assert_eq!(options.viewpoint.celerity().gamma(), 1.25);
//! ```

mod comfort;
mod dial;
mod film;
mod frame_rate;
mod kiosk;
mod line;
mod measure;
mod passed_over;
mod picture;
mod projection;
mod rays;
mod render;
mod ride;
mod room;
mod values;
mod world;

pub use comfort::ComfortOptions;
pub use dial::{DialOptions, map_scale_of_stills, map_scale_of_windows};
pub use film::{FilmOptions, PartChoice};
pub use frame_rate::FrameRate;
pub use kiosk::KioskOptions;
pub use line::{CheckOptions, Command, DevicesOptions, Stop, TownOptions, parse_from};
pub use measure::MeasureOptions;
pub use picture::PictureOptions;
pub use projection::ProjectionOptions;
pub use rays::RayOptions;
pub use render::{RenderOptions, Viewpoint};
pub use ride::{DeviceOptions, HEADSET, RideOptions, VehicleName, VehicleOptions};
pub use room::RoomOptions;
pub use values::{Output, ValueError};
pub use world::{ReadingOptions, SceneChoice, WorldOptions};

#[cfg(test)]
mod tests;
