//! What a live ride tells its rider, in the rider's language; the recording that the rider starts and ends.

use super::live::{Live, Rider};
use crate::output::say::tell;
use hardware::heard::{self, DeviceReport};
use hardware::{head_line, straightened, tracking_told};
use input::head::TrackedHead;
use input::{Desk, Nanos, SECOND, TrackingMode};
use picture_files::files::unused;
use ride::{LogError, RideLog};
use std::path::Path;
use words::Phrase;

/// Time for which a notice is shown.
const NOTICE_TIME: Nanos = 4 * SECOND;

/// Most things of a tracker that the settings panel lists.
const MOST_THINGS: usize = 6;

impl Live {
    fn desk(&self) -> &Desk {
        match &self.rider {
            Rider::Present { simulation, .. } => simulation.desk(),
            Rider::Recorded(ride) => ride.replay.simulation().desk(),
        }
    }

    /// Use of the tracked head, if one is tracked.
    pub fn tracking(&self) -> Option<TrackingMode> {
        self.desk().tracking()
    }

    /// Head that is tracked, if one is.
    pub fn head(&self) -> Option<&TrackedHead> {
        self.desk().head()
    }

    /// Sentence on the use of the tracked head.
    pub fn tracking_told(&self) -> String {
        tracking_told(self.tracking(), self.language)
    }

    /// Sentence for a rider who has asked to be straight: the outcome.
    pub fn straightened(&self) -> &'static str {
        let recorded = self.is_recorded();
        self.language.text(if recorded { Phrase::RecordedHeadStays } else { straightened(self.desk()) })
    }

    /// Shows a sentence to the rider.
    pub fn tell(&mut self, sentence: impl Into<String>) {
        let sentence = sentence.into();
        self.told.retain(|(_, told)| *told != sentence);
        self.told.push((self.now() + NOTICE_TIME, sentence));
    }

    /// Tells the rider, once, of devices that are open and do not do all that they should. Looks once a second.
    pub(super) fn tell_notes(&mut self, now: Nanos) {
        let Rider::Present { devices, .. } = &self.rider else {
            return;
        };
        if now < self.notes.1 {
            return;
        }
        let notes: Vec<_> = devices.status().into_iter().filter_map(|status| status.note).collect();
        let before = std::mem::replace(&mut self.notes, (notes.clone(), now + SECOND)).0;
        for note in notes.into_iter().filter(|note| !before.contains(note)) {
            tell(note);
            self.tell(heard::note(note, self.language));
            self.fault(&note.to_string());
        }
    }

    /// Sentences for the rider, the newest last.
    pub fn told(&self) -> Vec<String> {
        let mut told: Vec<String> = self.told.iter().map(|(_, sentence)| sentence.clone()).collect();
        told.extend(self.unseen.as_ref().map(|unseen| unseen.sentence(self.language)));
        if self.kiosk.is_none() {
            told.extend(self.lost.notice(self.now(), self.language));
        }
        told
    }

    /// Reports on the devices, and on the tracked head.
    pub fn devices(&self) -> Vec<DeviceReport> {
        let plain = |line| DeviceReport { line, details: Vec::new() };
        let language = self.language;
        let Rider::Present { simulation, devices, .. } = &self.rider else {
            return vec![plain(language.text(Phrase::RecordedRide).to_owned())];
        };
        let (desk, now) = (simulation.desk(), self.now());
        let report = |status| heard::report(status, desk, now, MOST_THINGS, language);
        let mut reports: Vec<DeviceReport> = devices.status().iter().map(report).collect();
        reports.extend(desk.head().map(|head| plain(head_line(head, self.unseen.as_ref(), language))));
        reports
    }

    fn log(&self) -> Option<&RideLog> {
        match &self.rider {
            Rider::Present { log, .. } => Some(log),
            Rider::Recorded(_) => None,
        }
    }

    /// True if a recording is being written.
    pub fn is_recording(&self) -> bool {
        self.log().is_some_and(RideLog::is_recording)
    }

    /// Records the ride from its beginning into `path`.
    ///
    /// # Errors
    /// [`LogError`] if the file cannot be written.
    pub fn record(&mut self, path: &Path) -> Result<(), LogError> {
        match &mut self.rider {
            Rider::Present { log, .. } => log.record(path),
            Rider::Recorded(_) => Ok(()),
        }
    }

    /// Starts or ends a recording, and tells the rider.
    pub fn toggle_recording(&mut self) {
        let language = self.language;
        let told = if self.is_recording() {
            match self.stop_recording() {
                // What has ended may still be completed on the disk.
                Ok(()) if self.log().is_some_and(RideLog::is_completing) => {
                    language.text(Phrase::RecordingEnds).to_owned()
                }
                Ok(()) => language.text(Phrase::RecordingComplete).to_owned(),
                Err(error) => {
                    tell(&error);
                    interface::log_fault(&error, language)
                }
            }
        } else {
            let path = unused("ride", "mcap");
            match self.record(&path) {
                Ok(()) => language.fill(Phrase::RecordingInto, &[&path.display()]),
                Err(error) => interface::log_fault(&error, language),
            }
        };
        self.tell(told);
    }

    /// Completes the recording, while the ride goes on.
    fn stop_recording(&mut self) -> Result<(), LogError> {
        match &mut self.rider {
            Rider::Present { log, .. } => log.stop(),
            Rider::Recorded(_) => Ok(()),
        }
    }
}
