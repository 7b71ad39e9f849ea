//! Preferences: the way of drawing for rides whose command line does not name one. A small file in the user's
//! configuration directory, written by `rapidity measure`, holds them.
//!
//! ```toml
//! [ride]
//! renderer = "polygon"
//! tolerance = 2.0     # or edge = 0.5, and transform = "gpu"; for the image renderer, map-scale = 0.9
//! ```

use std::path::{Path, PathBuf};

use directories::ProjectDirs;
use serde::{Deserialize, Serialize};
use thiserror::Error;

use regular_file::FileFault;
use view::{Dial, RendererName, Transform};

use crate::command::{DialOptions, RideOptions};
use crate::output::say::tell;
use picture_files::files::whole;

/// Name of the file.
const FILE: &str = "rapidity.toml";

/// Largest size of the file, bytes.
const LONGEST: u64 = 1 << 20;

/// Contents of the file.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Preferences {
    /// Way of drawing for rides.
    pub ride: Dial,
}

/// Reason why the file cannot be used.
#[derive(Debug, Error)]
pub enum PreferencesError {
    /// A system that names no configuration directory.
    #[error("there is no place for {FILE}: the system names no configuration directory; set HOME or XDG_CONFIG_HOME")]
    NoPlace,
    /// A file that cannot be read.
    #[error("{}: it cannot be read: {reason}; mend it, or delete it to have the program choose how to draw", path.display())]
    Unreadable {
        /// Path of the file.
        path: PathBuf,
        /// Reason, as the system or the parser words it.
        reason: String,
    },
    /// A file that cannot be written.
    #[error("{}: it cannot be written: {reason}", path.display())]
    Unwritable {
        /// Path of the file.
        path: PathBuf,
        /// Reason, as the system words it.
        reason: String,
    },
}

impl Preferences {
    /// Path of the file, which need not exist.
    pub fn path() -> Option<PathBuf> {
        ProjectDirs::from("", "", "rapidity").map(|directories| directories.config_dir().join(FILE))
    }

    /// Contents and path of the file; `None` if there is no file.
    ///
    /// # Errors
    /// [`PreferencesError::Unreadable`].
    pub fn load() -> Result<Option<(Self, PathBuf)>, PreferencesError> {
        let Some(path) = Self::path() else { return Ok(None) };
        Ok(Self::read(&path)?.map(|preferences| (preferences, path)))
    }

    /// Contents of the file; `None` if there is no file.
    fn read(path: &Path) -> Result<Option<Self>, PreferencesError> {
        let unreadable = |reason: String| PreferencesError::Unreadable { path: path.to_owned(), reason };
        match regular_file::read(path, LONGEST) {
            Ok(bytes) => Self::from_toml(&String::from_utf8_lossy(&bytes)).map(Some).map_err(unreadable),
            Err(FileFault::System(error)) if error.kind() == std::io::ErrorKind::NotFound => Ok(None),
            Err(error) => Err(unreadable(error.to_string())),
        }
    }

    /// Writes the file with `note` at its head, and returns its path.
    ///
    /// # Errors
    /// [`PreferencesError::NoPlace`], [`PreferencesError::Unwritable`].
    pub fn save(&self, note: &str) -> Result<PathBuf, PreferencesError> {
        let path = Self::path().ok_or(PreferencesError::NoPlace)?;
        let text = toml::to_string(self).map_err(|error| error.to_string());
        let written = text.and_then(|text| {
            let text =
                format!("# {note}\n# Delete this file to have `rapidity ride` choose by itself again.\n\n{text}");
            let folder = path.parent().unwrap_or(Path::new("."));
            std::fs::create_dir_all(folder)
                .and_then(|()| whole(&path, |temporary| std::fs::write(temporary, &text)))
                .map_err(|error| error.to_string())
        });
        match written {
            Ok(()) => Ok(path),
            Err(reason) => Err(PreferencesError::Unwritable { path, reason }),
        }
    }

    /// Reads and checks the text, with the same limits as on the command line.
    fn from_toml(text: &str) -> Result<Self, String> {
        let preferences: Self = toml::from_str(text).map_err(|error| {
            let line = error.span().map(|span| 1 + text[..span.start.min(text.len())].matches('\n').count());
            let place = line.map_or_else(String::new, |line| format!("line {line}: "));
            format!("{place}{}", error.message().lines().collect::<Vec<_>>().join(" "))
        })?;
        let Dial { renderer, edge, transform, tolerance, map_scale } = preferences.ride;
        if renderer == RendererName::Raytrace {
            return Err(
                "renderer is \"raytrace\", which is too slow for a ride: expected auto, polygon or image".to_owned()
            );
        }
        let limits = [
            ("edge", edge, f64::MIN_POSITIVE, f64::MAX),
            ("tolerance", tolerance, 0.01, 100.0),
            ("map-scale", map_scale, 0.1, 16.0),
        ];
        for (key, value, least, most) in limits {
            if let Some(value) = value.filter(|value| !(least..=most).contains(value)) {
                let expected = if key == "edge" {
                    "a finite number above 0".to_owned()
                } else {
                    format!("a number from {least} to {most}")
                };
                return Err(format!("{key} is {value}: expected {expected}"));
            }
        }
        if edge.is_some() && tolerance.is_some() {
            return Err("edge and tolerance exclude each other".to_owned());
        }
        if transform == Some(Transform::Gpu) && edge.is_none() {
            return Err("transform is \"gpu\", which needs edge, as on the command line".to_owned());
        }
        Ok(preferences)
    }
}

/// Options of a ride, with the file's way of drawing unless the command line has an option for it. Prints a line if
/// the file is used.
///
/// # Errors
/// A file that cannot be read.
pub fn applied(options: &RideOptions) -> Result<RideOptions, PreferencesError> {
    let mut options = options.clone();
    if options.drawing_is_given {
        return Ok(options);
    }
    if let Some((preferences, path)) = Preferences::load()? {
        options.dial = DialOptions::of(preferences.ride);
        tell(format_args!("{}: drawn with {}, unless options say otherwise", path.display(), preferences.ride));
    }
    Ok(options)
}

#[cfg(test)]
mod tests {
    //! Law under test: preferences that are written are read again as the same ones. A text that is no setting is
    //! refused with a sentence that names the line, or the key and its limits.

    use super::*;

    #[test]
    fn what_is_written_is_read() {
        for ride in [Dial::edge(0.5), Dial::vertex_stage(0.5), Dial::tolerance(2.0), Dial::map(0.9)] {
            let preferences = Preferences { ride };
            let text = toml::to_string(&preferences).unwrap();
            assert_eq!(Preferences::from_toml(&text), Ok(preferences), "{text}");
        }
    }

    #[cfg(unix)]
    #[test]
    fn a_pipe_and_an_endless_file_are_refused_and_not_waited_for() {
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join(FILE);
        assert!(Preferences::read(&path).unwrap().is_none());
        assert!(std::process::Command::new("mkfifo").arg(&path).status().unwrap().success());
        assert!(Preferences::read(&path).unwrap_err().to_string().contains("it is no file"));
        std::fs::remove_file(&path).unwrap();
        std::fs::File::create(&path).unwrap().set_len(1 << 40).unwrap();
        assert!(Preferences::read(&path).unwrap_err().to_string().contains("larger than"));
    }

    #[test]
    fn what_is_no_setting_is_refused() {
        for (text, told) in [
            ("[ride]\nrenderer = \"polygon\"\nedgee = 1", "line 3"),
            ("[ride]\nrenderer = \"raytrace\"", "expected auto, polygon or image"),
            ("[ride", "line 1"),
            ("", "ride"),
            ("[ride]\nrenderer = \"auto\"\ntolerance = 0.0", "tolerance is 0: expected a number from 0.01 to 100"),
            ("[ride]\nrenderer = \"auto\"\nedge = -1.0", "edge is -1: expected a finite number above 0"),
            ("[ride]\nrenderer = \"auto\"\nedge = inf", "edge is inf"),
            ("[ride]\nrenderer = \"auto\"\nmap-scale = nan", "map-scale is NaN"),
            ("[ride]\nrenderer = \"auto\"\nedge = 1.0\ntolerance = 1.0", "exclude"),
            ("[ride]\nrenderer = \"polygon\"\ntransform = \"gpu\"", "needs edge"),
            ("[ride]\nrenderer = \"polygon\"\nedge = 1.0\ntransform = \"tpu\"", "line 4"),
        ] {
            let refused = Preferences::from_toml(text).unwrap_err();
            assert!(refused.contains(told) && !refused.contains('\n'), "{text:?}: {refused}");
        }
    }
}
