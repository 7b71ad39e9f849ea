//! Log of a kiosk's days: a file a day (UTC) of JSON lines in a folder, of bounded size and number. A log that cannot
//! be written is told of once, and the rides go on.

use serde::Serialize;
use std::fs::{self, File, OpenOptions};
use std::io::Write;
use std::path::{Path, PathBuf};
use std::time::{SystemTime, UNIX_EPOCH};
use thiserror::Error;

/// Largest size of a day's file, bytes: that of a day of rides of a few seconds.
const LARGEST: u64 = 16 << 20;
/// Number of days that are kept.
const DAYS: usize = 62;
/// Beginning and ending of the files' names.
const NAME: [&str; 2] = ["kiosk-", ".jsonl"];

/// Entry of the log.
#[derive(Debug, Serialize)]
#[serde(tag = "event", rename_all = "snake_case")]
pub enum DayEvent<'a> {
    /// Start of the program.
    Start {
        /// Version of the program.
        version: &'a str,
    },
    /// Begin of an attract ride.
    Attract,
    /// Ride that a visitor has ended.
    Ride {
        /// Time from the first to the last touch, seconds.
        seconds: f64,
        /// Length of road, metres of the world.
        metres: f64,
        /// Largest speed as a fraction of the speed of light.
        top_beta: f64,
    },
    /// Ride that has left the scene behind, and goes back to its start.
    Strayed {
        /// Distance from the scene's middle, metres.
        metres: f64,
    },
    /// Fault that staff should know of.
    Fault {
        /// Sentence on the fault.
        sentence: &'a str,
    },
    /// Frames since the last entry of this kind.
    Frames {
        /// Number of frames.
        frames: u64,
        /// Mean time of a frame, milliseconds.
        mean_ms: f64,
        /// Longest time of a frame, milliseconds.
        longest_ms: f64,
        /// Number of frames longer than a twentieth of a second.
        late: u64,
    },
    /// End of the program.
    End,
}

/// Log that cannot be written.
#[derive(Debug, Error)]
#[error("{}: the day's log cannot be written: {reason}; the rides go on without", path.display())]
pub struct DayLogError {
    path: PathBuf,
    reason: String,
}

/// Log in a folder.
pub struct DayLog {
    folder: PathBuf,
    /// Day of the open file, and its size so far.
    open: Option<(String, File, u64)>,
    /// True once a fault has been told.
    told: bool,
}

#[derive(Serialize)]
struct Line<'a> {
    at: String,
    #[serde(flatten)]
    event: &'a DayEvent<'a>,
}

impl DayLog {
    /// Log in a folder, which is made if need be.
    ///
    /// # Errors
    /// [`DayLogError`] if there can be no such folder.
    pub fn in_folder(folder: &Path) -> Result<Self, DayLogError> {
        let refused = |reason: std::io::Error| DayLogError { path: folder.to_owned(), reason: reason.to_string() };
        fs::create_dir_all(folder).map_err(refused)?;
        Ok(Self { folder: folder.to_owned(), open: None, told: false })
    }

    /// Writes an entry with the present time.
    ///
    /// # Errors
    /// [`DayLogError`] at the first fault; those that follow are silent, until something is written again.
    pub fn note(&mut self, event: &DayEvent<'_>) -> Result<(), DayLogError> {
        let now = SystemTime::now().duration_since(UNIX_EPOCH).map_or(0, |since| since.as_secs());
        match self.write(now, event) {
            Ok(()) => {
                self.told = false;
                Ok(())
            }
            Err(_) if std::mem::replace(&mut self.told, true) => Ok(()),
            Err(reason) => Err(DayLogError { path: self.folder.clone(), reason: reason.to_string() }),
        }
    }

    /// Writes an entry of the time `now`, seconds since 1970.
    fn write(&mut self, now: u64, event: &DayEvent<'_>) -> std::io::Result<()> {
        let [year, month, day] = date(now / 86_400);
        let today = format!("{year:04}-{month:02}-{day:02}");
        if self.open.as_ref().is_none_or(|(day, ..)| *day != today) {
            let path = self.folder.join(format!("{}{today}{}", NAME[0], NAME[1]));
            let file = OpenOptions::new().create(true).append(true).open(path)?;
            let size = file.metadata()?.len();
            self.open = Some((today.clone(), file, size));
            self.tidy();
        }
        let Some((_, file, size)) = &mut self.open else { return Ok(()) };
        let second = now % 86_400;
        let at = format!("{today}T{:02}:{:02}:{:02}Z", second / 3600, second / 60 % 60, second % 60);
        let line = serde_json::to_string(&Line { at, event })? + "\n";
        if *size + line.len() as u64 > LARGEST {
            return Ok(());
        }
        *size += line.len() as u64;
        let written = file.write_all(line.as_bytes());
        if written.is_err() {
            // The next entry opens the file again.
            self.open = None;
        }
        written
    }

    /// Removes the files of all days but the newest. An error means that another program does so.
    fn tidy(&self) {
        let Ok(entries) = fs::read_dir(&self.folder) else { return };
        let names = entries.flatten().filter_map(|entry| entry.file_name().into_string().ok());
        let mut days: Vec<_> =
            names.filter(|name| name.starts_with(NAME[0]) && name.ends_with(NAME[1]) && name.len() == 22).collect();
        days.sort_unstable();
        for old in days.iter().rev().skip(DAYS) {
            let _ = fs::remove_file(self.folder.join(old));
        }
    }
}

/// Year, month and day in the Gregorian calendar of a day counted from 1970-01-01.
fn date(days: u64) -> [u64; 3] {
    // Eras of 400 years that begin on the first of March, so that the leap day is the last of a year.
    let days = days + 719_468;
    let (era, of_era) = (days / 146_097, days % 146_097);
    let year = (of_era - of_era / 1460 + of_era / 36_524 - of_era / 146_096) / 365;
    let of_year = of_era - (365 * year + year / 4 - year / 100);
    let month = (5 * of_year + 2) / 153;
    let day = of_year - (153 * month + 2) / 5 + 1;
    let month = if month < 10 { month + 3 } else { month - 9 };
    [era * 400 + year + u64::from(month <= 2), month, day]
}

#[cfg(test)]
mod tests {
    //! Laws: an entry is one line of JSON in the file of its day; a file and their number are bounded; a log that
    //! cannot be written is told of once.
    #![allow(clippy::unwrap_used, reason = "a folder that cannot be used is a failed test")]

    use super::*;

    #[test]
    fn days_have_their_dates() {
        for (days, expected) in
            [(0, [1970, 1, 1]), (59, [1970, 3, 1]), (11_016, [2000, 2, 29]), (20_787, [2026, 11, 30])]
        {
            assert_eq!(date(days), expected);
        }
        for days in 1..200_000 {
            let ([y, m, d], [_, _, before]) = (date(days), date(days - 1));
            assert!(d == before + 1 || (d == 1 && (28..=31).contains(&before)), "{y}-{m}-{d}");
        }
    }

    #[test]
    fn entries_stand_in_the_file_of_their_day() {
        let folder = tempfile::tempdir().unwrap();
        let mut log = DayLog::in_folder(&folder.path().join("log")).unwrap();
        log.write(86_399, &DayEvent::Attract).unwrap();
        log.write(86_400, &DayEvent::Ride { seconds: 2.5, metres: 7.0, top_beta: 0.5 }).unwrap();
        let read = |day: &str| fs::read_to_string(folder.path().join("log").join(day)).unwrap();
        assert_eq!(read("kiosk-1970-01-01.jsonl"), "{\"at\":\"1970-01-01T23:59:59Z\",\"event\":\"attract\"}\n");
        let line: serde_json::Value = serde_json::from_str(read("kiosk-1970-01-02.jsonl").trim()).unwrap();
        assert_eq!((line["event"].as_str(), line["metres"].as_f64()), (Some("ride"), Some(7.0)));
    }

    #[test]
    fn neither_a_day_nor_their_number_grows_without_bound() {
        let folder = tempfile::tempdir().unwrap();
        let mut log = DayLog::in_folder(folder.path()).unwrap();
        let sentence = "x".repeat(1 << 20);
        for _ in 0..40 {
            log.write(0, &DayEvent::Fault { sentence: &sentence }).unwrap();
        }
        assert!(fs::metadata(folder.path().join("kiosk-1970-01-01.jsonl")).unwrap().len() <= LARGEST);
        for day in 0..2 * DAYS as u64 {
            log.write(86_400 * day, &DayEvent::Attract).unwrap();
        }
        assert_eq!(fs::read_dir(folder.path()).unwrap().count(), DAYS);
    }

    #[test]
    fn a_log_that_cannot_be_written_is_told_of_once() {
        let folder = tempfile::tempdir().unwrap();
        let mut log = DayLog::in_folder(&folder.path().join("log")).unwrap();
        fs::remove_dir(folder.path().join("log")).unwrap();
        assert!(log.note(&DayEvent::Attract).unwrap_err().to_string().contains("the rides go on"));
        assert!(log.note(&DayEvent::Attract).is_ok());
        assert!(DayLog::in_folder(Path::new("/dev/null/log")).is_err());
    }
}
