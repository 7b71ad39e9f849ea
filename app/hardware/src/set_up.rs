//! Set-up of a rider's hardware: the tables of a set-up file, or of a display's file.
//!
//! ```toml
//! [bicycle]
//! port = "/dev/ttyACM0"
//! wheel_circumference_m = 2.1
//!
//! [axes]
//! space_mouse = [1, -3, 2, 4, -6, 5]
//!
//! [tracker]
//! url = "vrpn://192.168.0.10/Head"
//! ```
//!
//! A table of the set-up file replaces the display's table of the same name as a whole; the command line names other
//! ports and trackers.

use input::{AxisTable, ConfigError, DeskConfig, HeadConfig, TrackerUrl, TrainerUrl};
use regular_file::FileFault;
use room::Display;
use serde::de::DeserializeOwned;
use serde::{Deserialize, Serialize};
use std::path::{Path, PathBuf};
use thiserror::Error;
use toml::{Table, Value};

/// Largest size of a set-up file, bytes.
const LONGEST: u64 = 1 << 20;

/// Names of the tables.
const TABLES: [&str; 7] = ["bicycle", "trainer", "rider", "axes", "gamepad", "keys", "tracker"];

/// Reason why a set-up cannot be used.
#[derive(Debug, Error)]
pub enum SetUpError {
    /// A file that cannot be read.
    #[error("{}: the set-up cannot be read: {fault}; check the name and the permissions", path.display())]
    Unreadable {
        /// Path of the file.
        path: PathBuf,
        /// Reason, as the system words it.
        fault: FileFault,
    },
    /// A text that is no TOML, or has a table that is none of a set-up.
    #[error("{place}: {reason}")]
    Text {
        /// File and line.
        place: String,
        /// Reason, as the reader of the text words it.
        reason: String,
    },
    /// A table that cannot be understood.
    #[error("{place}, [{table}]: {reason}")]
    Table {
        /// File of the table.
        place: String,
        /// Name of the table.
        table: &'static str,
        /// Reason, as the reader of the table words it.
        reason: String,
    },
    /// A setting with a value that is not allowed.
    #[error("{place}: {source}")]
    Setting {
        /// File of the setting.
        place: String,
        /// Setting, and the reason.
        source: ConfigError,
    },
}

/// Tables of a set-up, each with the name of its file.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct SetUp {
    tables: Vec<(&'static str, String, Value)>,
}

/// Port of the bicycle, which is no setting of its decoder.
#[derive(Clone, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
#[serde(default)]
pub struct BicyclePort {
    /// Serial port, such as /dev/ttyACM0.
    pub port: Option<String>,
    /// Speed of the port, baud.
    pub baud: Option<u32>,
}

/// Place of the trainer, and the slope that it makes felt, which are no settings of its decoder.
#[derive(Clone, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
#[serde(default)]
pub struct TrainerPlace {
    /// Address of the trainer.
    pub url: Option<TrainerUrl>,
    /// Share of the slope that is felt, percent.
    pub slope_felt_percent: Option<u8>,
}

/// Axes of the SpaceMouse, by the way in which it is read.
#[derive(Serialize, Deserialize)]
#[serde(default, deny_unknown_fields)]
struct SpaceMouseAxes {
    space_mouse: AxisTable,
    spacenavd: AxisTable,
}

impl Default for SpaceMouseAxes {
    fn default() -> Self {
        Self { space_mouse: AxisTable::RAW, spacenavd: AxisTable::SPACENAVD }
    }
}

impl SetUp {
    /// Set-up of a display's file, if there is one, and of a set-up file, whose tables go before.
    ///
    /// # Errors
    /// [`SetUpError`] of a file that cannot be read.
    pub fn of(display: Option<&Display>, file: Option<&Path>) -> Result<Self, SetUpError> {
        let mut set_up = Self::default();
        if let Some(display) = display {
            set_up.add(&format!("display {}", display.name), display.set_up.clone())?;
        }
        if let Some(path) = file {
            let fault = |fault| SetUpError::Unreadable { path: path.to_owned(), fault };
            let bytes = regular_file::read(path, LONGEST).map_err(fault)?;
            let place = path.display().to_string();
            let text = String::from_utf8(bytes).map_err(|error| SetUpError::Text {
                place: place.clone(),
                reason: format!("it is not UTF-8 text from byte {} on", error.utf8_error().valid_up_to()),
            })?;
            set_up.add_text(&place, &text)?;
        }
        Ok(set_up)
    }

    fn add_text(&mut self, place: &str, text: &str) -> Result<(), SetUpError> {
        let tables = toml::from_str(text).map_err(|error| {
            let line = error.span().map(|span| 1 + text[..span.start.min(text.len())].matches('\n').count());
            let place = line.map_or_else(|| place.to_owned(), |line| format!("{place}, line {line}"));
            SetUpError::Text { place, reason: one_line(error.message()) }
        })?;
        self.add(place, tables)
    }

    /// Adds the tables of a file, in place of those of the same name.
    fn add(&mut self, place: &str, tables: Table) -> Result<(), SetUpError> {
        for (name, table) in tables {
            let Some(known) = TABLES.into_iter().find(|known| *known == name) else {
                let tables = TABLES.map(|name| format!("[{name}]")).join(", ");
                let reason = format!("{name:?} is no table of a set-up: expected {tables}");
                return Err(SetUpError::Text { place: place.to_owned(), reason });
            };
            self.tables.retain(|(other, ..)| *other != known);
            self.tables.push((known, place.to_owned(), table));
        }
        Ok(())
    }

    fn find(&self, name: &str) -> Option<&(&'static str, String, Value)> {
        self.tables.iter().find(|(known, ..)| *known == name)
    }

    /// Table as its settings; the usual ones if it is missing.
    fn table<T: DeserializeOwned + Default + Serialize>(&self, name: &str) -> Result<T, SetUpError> {
        let Some((table, place, value)) = self.find(name) else { return Ok(T::default()) };
        settings(table, place, value.clone())
    }

    /// Table as its settings, without keys that are none of them.
    fn table_without<T: DeserializeOwned + Default + Serialize>(
        &self,
        name: &str,
        others: &[&str],
    ) -> Result<T, SetUpError> {
        let Some((table, place, value)) = self.find(name) else { return Ok(T::default()) };
        let mut value = value.clone();
        if let Some(table) = value.as_table_mut() {
            others.iter().for_each(|key| drop(table.remove(*key)));
        }
        settings(table, place, value)
    }

    /// Table of the tracker, if there is one.
    pub fn tracker(&self) -> Option<&Value> {
        self.find("tracker").map(|(_, _, value)| value)
    }

    /// Tracker that the set-up names, if it names one that exists.
    pub fn tracker_url(&self) -> Option<TrackerUrl> {
        self.tracker()?.get("url")?.as_str()?.parse().ok()
    }

    /// Settings of the tracker, if there is its table; `url` replaces the tracker that it names.
    ///
    /// # Errors
    /// A table that cannot be understood.
    pub fn head(&self, url: Option<&TrackerUrl>) -> Result<Option<HeadConfig>, SetUpError> {
        let Some((table, place, value)) = self.find("tracker") else { return Ok(None) };
        let mut value = value.clone();
        if let (Some(table), Some(url)) = (value.as_table_mut(), url) {
            table.insert("url".to_owned(), Value::String(url.to_string()));
        }
        understood(table, place, value).map(Some)
    }

    /// True if the set-up has no table.
    pub fn is_empty(&self) -> bool {
        self.tables.is_empty()
    }

    /// True if it names a bicycle or a trainer that is ridden.
    ///
    /// # Errors
    /// A table that cannot be understood.
    pub fn names_a_ride(&self) -> Result<bool, SetUpError> {
        Ok(self.port()?.port.is_some() || self.trainer()?.url.is_some())
    }

    /// Checks every table, before a display if there is one.
    ///
    /// # Errors
    /// The first table that cannot be understood, or setting that cannot be used.
    pub fn check(&self) -> Result<(), SetUpError> {
        self.port()?;
        self.trainer()?;
        self.desk()?;
        self.head(None)?.map_or(Ok(()), |head| head.check().map_err(|source| self.refused(source)))
    }

    /// Error of a setting that cannot be used, with the place of its table.
    pub fn refused(&self, source: ConfigError) -> SetUpError {
        let table = source.key.split('.').next().unwrap_or_default();
        let place = self.find(table).map_or_else(|| "the set-up".to_owned(), |(_, place, _)| place.clone());
        SetUpError::Setting { place, source }
    }

    /// Port of the bicycle.
    ///
    /// # Errors
    /// A table that cannot be understood.
    pub fn port(&self) -> Result<BicyclePort, SetUpError> {
        self.table("bicycle")
    }

    /// Place of the trainer.
    ///
    /// # Errors
    /// A table that cannot be understood, or a slope beyond all of it.
    pub fn trainer(&self) -> Result<TrainerPlace, SetUpError> {
        let place: TrainerPlace = self.table("trainer")?;
        match place.slope_felt_percent {
            Some(percent @ 101..) => Err(self.refused(ConfigError {
                key: "trainer.slope_felt_percent",
                value: percent.to_string(),
                expected: "a share from 0 to 100 percent",
            })),
            _ => Ok(place),
        }
    }

    /// Settings of the decoders but for the tracker, checked.
    ///
    /// # Errors
    /// A table that cannot be understood, or a setting that cannot be used.
    pub fn desk(&self) -> Result<DeskConfig, SetUpError> {
        let SpaceMouseAxes { space_mouse, spacenavd } = self.table("axes")?;
        let desk = DeskConfig {
            bicycle: self.table_without("bicycle", &["port", "baud"])?,
            trainer: self.table_without("trainer", &["url", "slope_felt_percent"])?,
            rider: self.table("rider")?,
            space_mouse,
            spacenavd,
            gamepad: self.table("gamepad")?,
            keys: self.table("keys")?,
            ..DeskConfig::default()
        };
        desk.check().map_err(|source| self.refused(source))?;
        Ok(desk)
    }
}

/// Value of a table as its settings. A missing key has its present usual value, not that of old recordings.
fn settings<T: DeserializeOwned + Default + Serialize>(
    table: &'static str,
    place: &str,
    value: Value,
) -> Result<T, SetUpError> {
    let whole = match (Table::try_from(T::default()), value) {
        (Ok(mut usual), Value::Table(given)) => {
            for (key, value) in given {
                // People write 2 for 2.0.
                let value = match (usual.get(&key), value) {
                    (Some(Value::Float(_)), Value::Integer(whole)) => Value::Float(whole as f64),
                    (_, value) => value,
                };
                usual.insert(key, value);
            }
            Value::Table(usual)
        }
        (_, value) => value,
    };
    understood(table, place, whole)
}

/// Value of a table as its settings, as they are written.
fn understood<T: DeserializeOwned>(table: &'static str, place: &str, value: Value) -> Result<T, SetUpError> {
    T::deserialize(value).map_err(|error| SetUpError::Table {
        place: place.to_owned(),
        table,
        reason: one_line(&error.to_string()),
    })
}

/// Report of several lines as a single line.
fn one_line(report: &str) -> String {
    report.split_whitespace().collect::<Vec<_>>().join(" ")
}

#[cfg(test)]
mod tests {
    //! Law under test: a set-up file says how devices are read, before what the display says; what cannot be used is
    //! told with file, table and key.
    #![allow(clippy::unwrap_used, reason = "a failed construction is a failed test")]

    use super::*;
    use input::{GamepadMap, SpeedSource};

    fn file(text: &str) -> Result<SetUp, SetUpError> {
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("museum.toml");
        std::fs::write(&path, text).unwrap();
        SetUp::of(None, Some(&path))
    }

    #[test]
    fn every_table_reaches_its_decoder() {
        let set_up = file(
            "[bicycle]\nport = \"/dev/ttyUSB7\"\nbaud = 9600\nspeed_from = \"cadence\"\nmetres_per_crank_turn = 4.5\n\
             [rider]\ncruise_m_s = 4.0\n[axes]\nspace_mouse = [2, 1, 3, 4, 5, 6]\n[gamepad]\naxes = { z = \"rx\" }\n\
             [keys]\nEnter = \"W\"\n[tracker]\nurl = \"mouse\"\n[trainer]\nurl = \"tcp://kickr\"\nfastest_m_s = 9.0\n",
        )
        .unwrap();
        let port = BicyclePort { port: Some("/dev/ttyUSB7".to_owned()), baud: Some(9600) };
        assert_eq!(set_up.port().unwrap(), port);
        let desk = set_up.desk().unwrap();
        // A key that the file lacks is as in a ride without a file, not as in an old recording.
        assert!(desk.bicycle.bare_number_glides && desk.bicycle.late_s > 0.0);
        assert_eq!((desk.bicycle.speed_from, desk.bicycle.metres_per_crank_turn), (SpeedSource::Cadence, 4.5));
        assert_eq!((desk.rider.cruise_m_s, desk.space_mouse), (4.0, AxisTable([2, 1, 3, 4, 5, 6])));
        assert_eq!(desk.spacenavd, AxisTable::SPACENAVD);
        assert!(desk.gamepad != GamepadMap::default() && !desk.keys.is_empty());
        assert_eq!(set_up.tracker().unwrap()["url"].as_str(), Some("mouse"));
        let url = set_up.trainer().unwrap().url.map(|url| url.to_string());
        assert_eq!((url.as_deref(), desk.trainer.fastest_m_s), (Some("tcp://kickr:36866"), 9.0));
        let nothing = SetUp::of(None, None).unwrap();
        assert_eq!((nothing.desk().unwrap(), nothing.port().unwrap()), Default::default());
    }

    #[test]
    fn a_table_of_the_file_replaces_the_display_s() {
        let mut display = Display::built_in("cave4").unwrap();
        display.set_up = toml::from_str("[bicycle]\nport = \"a\"\nbaud = 1200\n[rider]\ncruise_m_s = 3.0").unwrap();
        let of_display = SetUp::of(Some(&display), None).unwrap();
        assert_eq!(of_display.port().unwrap().baud, Some(1200));
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("mine.toml");
        std::fs::write(&path, "[bicycle]\nport = \"b\"").unwrap();
        let both = SetUp::of(Some(&display), Some(&path)).unwrap();
        assert_eq!(both.port().unwrap(), BicyclePort { port: Some("b".to_owned()), baud: None });
        assert_eq!(both.desk().unwrap().rider.cruise_m_s, 3.0);
    }

    #[test]
    fn what_cannot_be_used_is_told_with_file_table_and_key() {
        for (text, told) in [
            ("[bicycle]\nwheel = 2.1", "museum.toml, [bicycle]: unknown field `wheel`"),
            ("[bicycle]\nwheel_circumference_m = 0", "museum.toml: bicycle.wheel_circumference_m is 0"),
            ("[bicycle]\nwheel_circumference_m = \"2\"", "museum.toml, [bicycle]: invalid type: string \"2\""),
            ("[bicycle]\nwheel_circumference_m = 0.0", "museum.toml: bicycle.wheel_circumference_m is 0"),
            ("[bicycle]\nspeed_from = \"legs\"", "unknown variant `legs`, expected `wheel` or `cadence`"),
            ("[bicycle]\nbaud = -1", "[bicycle]: invalid value"),
            ("[axes]\nspace_mouse = [1, 2, 3]", "[axes]: "),
            ("[axes]\nspacenavd = [1, 2, 3, 4, 5, 9]", "museum.toml: axes.spacenavd is [1, 2, 3, 4, 5, 9]"),
            ("[trainer]\nurl = \"kickr\"", "[trainer]: "),
            ("[trainer]\nslope_felt_percent = 120", "trainer.slope_felt_percent is 120"),
            ("[trainer]\nfast = 1.0", "[trainer]: unknown field `fast`"),
            ("[keys]\nQwerty = \"W\"", "museum.toml: keys is \"Qwerty\""),
            ("[bike]\n", "museum.toml: \"bike\" is no table of a set-up: expected [bicycle], [trainer], [rider]"),
            ("bicycle = 3", "[bicycle]: invalid type: integer `3`"),
            ("[bicycle\n", "museum.toml, line 1: "),
        ] {
            let error = file(text)
                .and_then(|set_up| set_up.desk().and(set_up.port()).and(set_up.trainer()))
                .unwrap_err()
                .to_string();
            assert!(error.contains(told), "{text}: {error}");
        }
        let missing = SetUp::of(None, Some(Path::new("/nowhere/at all.toml"))).unwrap_err().to_string();
        assert!(missing.starts_with("/nowhere/at all.toml: the set-up cannot be read"), "{missing}");
    }
}
