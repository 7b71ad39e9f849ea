//! The user's settings: a small file in the configuration directory.
//!
//! ```toml
//! language = "de"
//!
//! [keys]                # keys that do other work than their own
//! F12 = "photo"
//!
//! [ride]                # the way of drawing, written by `rapidity measure`
//! renderer = "polygon"
//! tolerance = 2.0       # or edge = 0.5, and transform = "gpu"; for the image renderer, map-scale = 0.9
//! ```
//!
//! What is written into it keeps all that the user wrote. A file that cannot be understood is set aside under another
//! name, and the program goes on.

use std::path::{Path, PathBuf};

use directories::ProjectDirs;
use serde::{Deserialize, Serialize};
use thiserror::Error;

use input::KeyMap;
use regular_file::FileFault;
use view::Dial;
use words::Language;

use toml_edit::{DocumentMut, Item, Table, value};

use crate::output::say::tell;
use command::{DialOptions, RideOptions};
use picture_files::files::whole;

/// Name of the file.
const FILE: &str = "rapidity.toml";

/// Largest size of the file, bytes.
const LONGEST: u64 = 1 << 20;

/// Contents of the file.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
#[serde(default, deny_unknown_fields)]
pub struct Preferences {
    /// Language of the interface; that of the system if `None`.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub language: Option<Language>,
    /// Keys that do other work than their own, unless a set-up file has a table of its own.
    #[serde(skip_serializing_if = "KeyMap::is_empty")]
    pub keys: KeyMap,
    /// Way of drawing for rides; the program's choice if `None`.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub ride: Option<Dial>,
}

/// Reason why the file cannot be used.
#[derive(Debug, Error)]
pub enum PreferencesError {
    /// A system that names no configuration directory.
    #[error("there is no place for {FILE}: the system names no configuration directory; set HOME or XDG_CONFIG_HOME")]
    NoPlace,
    /// A file that cannot be read.
    #[error("{}: the settings cannot be read: {reason}; mend the file, or delete it to have the usual settings", path.display())]
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

    /// Contents of the file, and its path if there is one. A file that cannot be understood is set aside, and one that
    /// cannot be read is passed over; each is told.
    pub fn load() -> (Self, Option<PathBuf>) {
        let Some(path) = Self::path() else { return (Self::default(), None) };
        match Self::read(&path) {
            Ok(Some(preferences)) => (preferences, Some(path)),
            Ok(None) => (Self::default(), None),
            Err(error) => {
                tell(&error);
                // A file that only cannot be read now stays where it is.
                let is_text = regular_file::read(&path, LONGEST).is_ok();
                if let Some(aside) = is_text.then(|| set_aside(&path)).flatten() {
                    tell(format_args!("{}: set aside as {}; the usual settings hold", path.display(), aside.display()));
                }
                (Self::default(), None)
            }
        }
    }

    /// Contents of the file; `None` if there is no file.
    fn read(path: &Path) -> Result<Option<Self>, PreferencesError> {
        let unreadable = |reason: String| PreferencesError::Unreadable { path: path.to_owned(), reason };
        match regular_file::read(path, LONGEST) {
            Ok(bytes) => {
                let text = String::from_utf8(bytes).map_err(|_| unreadable("it is no text in UTF-8".to_owned()))?;
                Self::from_toml(&text).map(Some).map_err(unreadable)
            }
            Err(FileFault::System(error)) if error.kind() == std::io::ErrorKind::NotFound => Ok(None),
            Err(error) => Err(unreadable(error.to_string())),
        }
    }

    /// Writes the way of drawing into the file, with `note` above it, and returns the file's path.
    ///
    /// # Errors
    /// [`PreferencesError::NoPlace`], [`PreferencesError::Unwritable`].
    pub fn save_dial(dial: Dial, note: &str) -> Result<PathBuf, PreferencesError> {
        let path = Self::path().ok_or(PreferencesError::NoPlace)?;
        change(&path, |document| {
            let mut table: Table = match toml_edit::ser::to_document(&dial) {
                Ok(document) => document.as_table().clone(),
                Err(_) => return,
            };
            let note = format!("# {note}\n# Delete this table to have `rapidity ride` choose by itself again.\n");
            table.decor_mut().set_prefix(note);
            document["ride"] = Item::Table(table);
        })?;
        Ok(path)
    }

    /// Writes the language into the file.
    ///
    /// # Errors
    /// [`PreferencesError::NoPlace`], [`PreferencesError::Unwritable`].
    pub fn save_language(language: Language) -> Result<(), PreferencesError> {
        let path = Self::path().ok_or(PreferencesError::NoPlace)?;
        change(&path, |document| document["language"] = value(language.code()))
    }

    /// Reads and checks the text, with the same limits as on the command line.
    fn from_toml(text: &str) -> Result<Self, String> {
        let preferences: Self = toml::from_str(text).map_err(|error| {
            let line = error.span().map(|span| 1 + text[..span.start.min(text.len())].matches('\n').count());
            let place = line.map_or_else(String::new, |line| format!("line {line}: "));
            format!("{place}{}", error.message().lines().collect::<Vec<_>>().join(" "))
        })?;
        preferences.keys.check().map_err(|error| error.to_string())?;
        if let Some(dial) = &preferences.ride {
            dial.check_for_ride().map_err(|fault| fault.to_string())?;
        }
        Ok(preferences)
    }
}

/// Changes the file at `path`, and keeps everything else in it. A file that is no TOML is set aside.
fn change(path: &Path, change: impl FnOnce(&mut DocumentMut)) -> Result<(), PreferencesError> {
    let unreadable = |reason: String| PreferencesError::Unreadable { path: path.to_owned(), reason };
    let text = match regular_file::read(path, LONGEST) {
        Ok(bytes) => String::from_utf8(bytes).ok(),
        Err(FileFault::System(error)) if error.kind() == std::io::ErrorKind::NotFound => Some(String::new()),
        Err(error) => return Err(unreadable(error.to_string())),
    };
    let mut document = match text.as_deref().map(str::parse::<DocumentMut>) {
        Some(Ok(document)) => document,
        Some(Err(_)) | None => {
            set_aside(path).ok_or_else(|| unreadable("it is no TOML, and cannot be set aside".to_owned()))?;
            DocumentMut::new()
        }
    };
    change(&mut document);
    let folder = path.parent().unwrap_or(Path::new("."));
    std::fs::create_dir_all(folder)
        .and_then(|()| whole(path, |temporary| std::fs::write(temporary, document.to_string())))
        .map_err(|error| PreferencesError::Unwritable { path: path.to_owned(), reason: error.to_string() })
}

/// Gives a file another name beside its own, one that no file has. `None` if that cannot be done.
fn set_aside(path: &Path) -> Option<PathBuf> {
    if !path.is_file() {
        return None;
    }
    let aside = |number: u32| path.with_extension(format!("toml.broken-{number}"));
    let free = (1..1000).map(aside).find(|aside| !aside.exists())?;
    std::fs::rename(path, &free).ok()?;
    Some(free)
}

/// Options of a ride, with the user's settings where the command line has no option for them. Prints a line if the way
/// of drawing is the file's.
pub fn applied(options: &RideOptions) -> RideOptions {
    let mut options = options.clone();
    let (preferences, path) = Preferences::load();
    options.language = options.language.or(preferences.language).or_else(|| Some(Language::of_system()));
    options.keys = preferences.keys;
    if let (Some(dial), Some(path), false) = (preferences.ride, path, options.drawing_is_given) {
        options.dial = DialOptions::of(dial);
        tell(format_args!("{}: drawn with {dial}, unless options say otherwise", path.display()));
    }
    options
}

#[cfg(test)]
mod tests {
    //! Law under test: preferences that are written are read again as the same ones. A text that is no setting is
    //! refused with a sentence that names the line, or the key and its limits.

    use super::*;

    #[test]
    fn what_is_written_is_read() {
        for ride in [Dial::edge(0.5), Dial::vertex_stage(0.5), Dial::tolerance(2.0), Dial::map(0.9)] {
            let keys = KeyMap([("F12".to_owned(), "photo".to_owned())].into());
            let preferences = Preferences { ride: Some(ride), keys, language: Some(Language::German) };
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
    fn a_change_keeps_what_the_user_wrote_and_sets_aside_what_is_no_settings() {
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("deeper").join(FILE);
        let german = |document: &mut DocumentMut| document["language"] = value("de");
        change(&path, german).unwrap();
        assert_eq!(Preferences::read(&path).unwrap().unwrap().language, Some(Language::German));
        let own = "# mine\n[keys]\nF12 = \"photo\" # with a flash\n";
        std::fs::write(&path, own).unwrap();
        change(&path, german).unwrap();
        let text = std::fs::read_to_string(&path).unwrap();
        assert!(text.contains("# mine") && text.contains("# with a flash"), "{text}");
        assert_eq!(Preferences::from_toml(&text).unwrap().language, Some(Language::German));
        for (number, broken) in [(1, &b"[keys"[..]), (2, b"# caf\xe9\n")] {
            std::fs::write(&path, broken).unwrap();
            change(&path, german).unwrap();
            let aside = path.with_extension(format!("toml.broken-{number}"));
            assert_eq!(std::fs::read(aside).unwrap(), broken);
        }
        // What cannot be read is not written over.
        std::fs::File::create(&path).unwrap().set_len(LONGEST + 1).unwrap();
        assert!(change(&path, german).unwrap_err().to_string().contains("larger than"));
        assert_eq!(std::fs::metadata(&path).unwrap().len(), LONGEST + 1);
    }

    #[test]
    fn what_is_no_setting_is_refused() {
        for (text, told) in [
            ("[ride]\nrenderer = \"polygon\"\nedgee = 1", "line 3"),
            ("[ride]\nrenderer = \"raytrace\"", "expected auto, polygon or image"),
            ("[ride", "line 1"),
            ("[keys]\nF12 = \"jump high\"", "keys is \"jump high\""),
            ("language = \"fr\"", "line 1"),
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
