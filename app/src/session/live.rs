//! Live ride without its picture: the source of samples, the simulation that they drive, and the log.
//!
//! Frames come from live devices and the window's keys as the clock runs, or from a recording at the pace at which it
//! was ridden. In both cases the caller asks once per frame and gets the observer.

use crate::output::say::tell;
use crate::session::gaps::ShownTimes;
use crate::session::lost_time::LostTime;
use crate::session::tour_ride::{TourMark, TourRide};
use hardware::heard::{self, DeviceReport};
use input::devices::{DeviceState, Devices};
use input::head::Tracking;
use input::{Action, Clock, Desk, DeskConfig, Nanos, RoadLoad, SECOND, Sample, SampleSource, TrackerUrl, TrackingMode};
use interface::Caption;
use kiosk::Kiosk;
use picture_files::files::unused;
use presentation::Presentation;
use ride::{LogError, Replay, ReplayError, Replayed, RideFrame, RideLog, Simulation};
use std::path::Path;
use words::{Language, Phrase};

/// Time for which a notice is shown.
const NOTICE_TIME: Nanos = 4 * SECOND;

/// Most things of a tracker that the settings panel lists.
const MOST_THINGS: usize = 6;

/// Ride in progress.
pub struct Live {
    clock: Clock,
    rider: Rider,
    end: Option<Nanos>,
    said: Vec<Sample>,
    told: Vec<(Nanos, String)>,
    /// Own time that was not ridden because frames came too late.
    lost: LostTime,
    /// Tour that rides, if there is one.
    tour: Option<Box<TourRide>>,
    /// Visitors, if the ride is for them.
    kiosk: Option<Box<Kiosk>>,
    /// True once another rider's turn has begun.
    turned: bool,
    /// Devices that were open at the last look.
    open: Vec<SampleSource>,
    /// Sentence on a head that its tracker does not see, while it does not.
    unseen: Option<String>,
    /// Sentences on devices that are open and do not do all that they should, and the next look for more.
    notes: (Vec<String>, Nanos),
    /// Language of the sentences for the rider.
    pub language: Language,
}

/// Source of the ride's frames.
enum Rider {
    /// Live devices, with a simulation and a log.
    Present { simulation: Box<Simulation>, devices: Box<Devices>, log: Box<RideLog> },
    /// Recorded ride that is replayed.
    Recorded {
        replay: Box<Replay>,
        next: Option<Box<(RideFrame, Nanos)>>,
        shown: Option<Box<RideFrame>>,
        differed: bool,
        times: ShownTimes,
    },
}

impl Live {
    /// Creates a live ride from `devices`, whose clock must be `clock`. The ride ends after `seconds`, if given.
    pub fn present(simulation: Simulation, devices: Devices, clock: Clock, log: RideLog, seconds: Option<f64>) -> Self {
        let rider = Rider::Present { simulation: Box::new(simulation), devices: Box::new(devices), log: Box::new(log) };
        Self::new(rider, clock, seconds)
    }

    /// Creates a replay of a recorded ride that starts now. The ride ends after `seconds`, if given.
    pub fn recorded(replay: Replay, seconds: Option<f64>) -> Self {
        let replay = Box::new(replay);
        Self::new(
            Rider::Recorded { replay, next: None, shown: None, differed: false, times: ShownTimes::default() },
            Clock::start(),
            seconds,
        )
    }

    fn new(rider: Rider, clock: Clock, seconds: Option<f64>) -> Self {
        let end = seconds.map(|seconds| (seconds * SECOND as f64) as Nanos);
        Self {
            clock,
            rider,
            end,
            said: Vec::new(),
            told: Vec::new(),
            lost: LostTime::default(),
            tour: None,
            kiosk: None,
            turned: false,
            open: Vec::new(),
            unseen: None,
            notes: (Vec::new(), 0),
            language: Language::default(),
        }
    }

    /// The same ride for visitors, one after the other.
    pub fn for_visitors(mut self, kiosk: Kiosk) -> Self {
        if let Rider::Present { log, .. } = &mut self.rider {
            // Nobody asks for a recording of the past.
            log.forget();
        }
        self.kiosk = Some(Box::new(kiosk));
        self
    }

    /// The same ride, on a tour.
    pub fn on_tour(mut self, tour: TourRide) -> Self {
        self.tour = Some(Box::new(tour));
        self
    }

    /// Caption of the tour; `None` without one, and once it is over.
    pub fn caption(&self) -> Option<Caption> {
        self.tour.as_ref()?.caption(self.language)
    }

    /// Events that the tour has named since the last call.
    pub fn take_marks(&mut self) -> Vec<TourMark> {
        self.tour.as_mut().map_or_else(Vec::new, |tour| tour.take_marks())
    }

    /// Carries out an action that concerns the tour, if there is one.
    pub fn act_on_tour(&mut self, action: &Action) {
        if let Some(tour) = &mut self.tour {
            tour.act(action);
        }
    }

    /// True while passers-by are invited: the attract ride is shown.
    pub fn invites(&self) -> bool {
        self.kiosk.as_ref().is_some_and(|kiosk| kiosk.attracts())
    }

    /// Use of the tracked head, if one is tracked.
    pub fn tracking(&self) -> Option<TrackingMode> {
        let desk = match &self.rider {
            Rider::Present { simulation, .. } => simulation.desk(),
            Rider::Recorded { replay, .. } => replay.simulation().desk(),
        };
        desk.tracking()
    }

    /// Sentence on the use of the tracked head.
    pub fn tracking_told(&self, language: Language) -> String {
        let mode = match self.tracking() {
            None => return language.text(Phrase::NoHead).to_owned(),
            Some(TrackingMode::PositionAndVelocity) => Phrase::HeadBoth,
            Some(TrackingMode::Position) => Phrase::HeadPlace,
            Some(TrackingMode::None) => Phrase::HeadOff,
        };
        language.fill(Phrase::HeadIs, &[&language.text(mode)])
    }

    /// Notes a touch of something that is no device of the ride, in a kiosk.
    pub fn touch(&mut self) {
        if let Some(kiosk) = &mut self.kiosk {
            kiosk.touch();
        }
    }

    /// True once after another rider's turn has begun.
    pub fn has_turned(&mut self) -> bool {
        std::mem::take(&mut self.turned)
    }

    /// Notes a fault in the day's log of a kiosk.
    pub fn fault(&mut self, sentence: &str) {
        if let Some(kiosk) = &mut self.kiosk {
            kiosk.fault(sentence);
        }
    }

    /// Present time of the ride.
    pub fn now(&self) -> Nanos {
        self.clock.now()
    }

    /// Tells the rider, once, of devices that are open and do not do all that they should. Looks once a second.
    fn tell_notes(&mut self, now: Nanos) {
        let Rider::Present { devices, .. } = &self.rider else {
            return;
        };
        if now < self.notes.1 {
            return;
        }
        let notes: Vec<String> = devices.status().into_iter().filter_map(|status| status.note).collect();
        let before = std::mem::replace(&mut self.notes, (notes.clone(), now + SECOND)).0;
        for note in notes.iter().filter(|note| !before.contains(note)) {
            tell(note);
            self.tell(note.clone());
            self.fault(note);
        }
    }

    /// Adds a sample of the window or the panel, stamped with the present time.
    pub fn say(&mut self, sample: impl FnOnce(Nanos) -> Sample) {
        self.said.push(sample(self.clock.now()));
    }

    /// Shows a sentence to the rider.
    pub fn tell(&mut self, sentence: impl Into<String>) {
        let sentence = sentence.into();
        self.told.retain(|(_, told)| *told != sentence);
        self.told.push((self.clock.now() + NOTICE_TIME, sentence));
    }

    /// Present frame of the ride; `None` at its end.
    ///
    /// # Errors
    /// [`ReplayError`] of a recording that is damaged before its first frame.
    pub fn frame(&mut self) -> Result<Option<RideFrame>, ReplayError> {
        let now = self.clock.now();
        self.told.retain(|(until, _)| *until > now);
        if self.end.is_some_and(|end| now >= end) {
            return Ok(None);
        }
        let frame = match &mut self.rider {
            Rider::Present { simulation, devices, log } => {
                let mut samples = devices.drain();
                samples.append(&mut self.said);
                if let Some(tour) = &mut self.tour {
                    samples.retain(|sample| !tour.replaces(sample.source));
                    samples.append(&mut tour.samples(now, simulation));
                }
                samples.sort_by_key(|sample| sample.at);
                if let Some(kiosk) = &mut self.kiosk {
                    note_devices(kiosk, devices, &mut self.open);
                    let (passed, turn) = kiosk.samples(now, samples, simulation.vehicle());
                    samples = passed;
                    self.turned |= turn.is_some();
                }
                let frame = simulation.frame(now, &samples);
                if let Some(kiosk) = &mut self.kiosk {
                    kiosk.shown(now, &frame);
                    kiosk.take_fault().iter().for_each(tell);
                }
                devices.brake(frame.vehicle.resistance());
                devices.load(RoadLoad { slope: frame.vehicle.slope(), brake: frame.controls.brake });
                self.lost.add(frame.dropped_ticks, now);
                let unseen = unseen(simulation.desk(), &frame);
                if let Some(kiosk) = &mut self.kiosk {
                    kiosk.head(now, unseen.as_deref());
                }
                if unseen.is_some() != self.unseen.is_some() {
                    tell(unseen.as_deref().unwrap_or("the head is tracked"));
                }
                self.unseen = unseen;
                if let Err(error) = log.frame(&samples, &frame) {
                    // The ride goes on, and the notice stays: nobody should believe that the rest is recorded.
                    tell(&error);
                    if let Some(kiosk) = &mut self.kiosk {
                        kiosk.fault(&error.to_string());
                    }
                    self.told.push((Nanos::MAX, error.to_string()));
                }
                Some(frame)
            }
            Rider::Recorded { replay, next, shown, differed, times } => {
                let said = std::mem::take(&mut self.said);
                let mut repeated = Vec::new();
                // The frames that were ridden since the last call are simulated, and the last of them is shown.
                let ended = loop {
                    let (frame, due_at) = match next.take() {
                        Some(next) => *next,
                        None => match replay.next_frame() {
                            Ok(Some(Replayed { frame, difference })) => {
                                if let (Some(difference), false) = (difference, *differed) {
                                    *differed = true;
                                    let frame = frame.record.frame;
                                    let sentence = ReplayError::Differs { frame, difference }.to_string();
                                    self.told.push((Nanos::MAX, sentence));
                                }
                                let due_at = times.shown(frame.record.at);
                                (frame, due_at)
                            }
                            Ok(None) => break true,
                            Err(error) if shown.is_none() => return Err(error),
                            Err(error) => {
                                tell(error);
                                break true;
                            }
                        },
                    };
                    let due = due_at <= now;
                    if due || shown.is_none() {
                        let actions = frame.controls.actions.iter().filter(|action| Presentation::repeats(action));
                        repeated.extend(actions.cloned());
                        *shown = Some(Box::new(frame));
                    } else {
                        *next = Some(Box::new((frame, due_at)));
                    }
                    if !due {
                        break false;
                    }
                };
                // Of the recorded rider's actions, those are performed again that decide what is shown. Actions that
                // the onlooker asks for now follow.
                let mut frame = if ended && next.is_none() { None } else { shown.as_deref().cloned() };
                if let Some(frame) = &mut frame {
                    repeated.extend(onlooker(&said));
                    frame.controls.actions = repeated;
                }
                frame
            }
        };
        self.tell_notes(now);
        if let Some(frame) = &frame {
            for notice in &frame.notices {
                self.tell(interface::notice(*notice, self.language));
            }
        }
        Ok(frame)
    }

    /// Sentences for the rider, the newest last.
    pub fn told(&self) -> Vec<String> {
        let mut told: Vec<String> = self.told.iter().map(|(_, sentence)| sentence.clone()).collect();
        told.extend(self.unseen.clone());
        if self.kiosk.is_none() {
            told.extend(self.lost.notice(self.clock.now()));
        }
        told
    }

    /// Reports on the devices, and on the tracked head.
    pub fn devices(&self) -> Vec<DeviceReport> {
        let plain = |line| DeviceReport { line, details: Vec::new() };
        let Rider::Present { simulation, devices, .. } = &self.rider else {
            return vec![plain("a recorded ride".to_owned())];
        };
        let (desk, now) = (simulation.desk(), self.clock.now());
        let mut reports: Vec<DeviceReport> =
            devices.status().iter().map(|status| heard::report(status, desk, now, MOST_THINGS)).collect();
        reports.extend(desk.head().map(|head| {
            let seen = self.unseen.as_deref().unwrap_or("the head is tracked");
            plain(format!("{seen}; {} poses rejected", head.rejected().number()))
        }));
        reports
    }

    /// Sentence for a rider who has asked to be straight: the outcome.
    pub fn straightened(&self) -> &'static str {
        let Rider::Present { simulation, .. } = &self.rider else {
            return "a recorded head stays as it was";
        };
        match simulation.desk().head() {
            None => "no head is tracked, so there is nothing to straighten; name a tracker with --tracker",
            Some(head) if head.config().url == TrackerUrl::Mouse || head.recentres() => {
                "your head is straight: its place and direction are the middle ones"
            }
            Some(_) => {
                "this room's tracker is calibrated, so the head is not moved; recentre = \"key\" in [tracker] allows it"
            }
        }
    }

    /// True if the ride is a recorded one.
    pub fn is_recorded(&self) -> bool {
        matches!(self.rider, Rider::Recorded { .. })
    }

    /// True if a recording is being written.
    pub fn is_recording(&self) -> bool {
        matches!(&self.rider, Rider::Present { log, .. } if log.is_recording())
    }

    /// Records the ride from its beginning into `path`.
    ///
    /// # Errors
    /// [`LogError`] if the file cannot be written.
    pub fn record(&mut self, path: &Path) -> Result<(), LogError> {
        match &mut self.rider {
            Rider::Present { log, .. } => log.record(path),
            Rider::Recorded { .. } => Ok(()),
        }
    }

    /// Starts or ends a recording, and tells the rider.
    pub fn toggle_recording(&mut self) {
        let told = if self.is_recording() {
            match self.stop_recording() {
                Ok(()) if self.is_completing() => {
                    "the recording has ended, and is being completed on the disk".to_owned()
                }
                Ok(()) => "the recording is complete".to_owned(),
                Err(error) => {
                    tell(&error);
                    error.to_string()
                }
            }
        } else {
            let path = unused("ride", "mcap");
            match self.record(&path) {
                Ok(()) => format!("recording, from the ride's beginning, into {}", path.display()),
                Err(error) => error.to_string(),
            }
        };
        self.tell(told);
    }

    /// True while a recording that has ended is still being completed on the disk.
    fn is_completing(&self) -> bool {
        matches!(&self.rider, Rider::Present { log, .. } if log.is_completing())
    }

    /// Completes the recording, while the ride goes on.
    fn stop_recording(&mut self) -> Result<(), LogError> {
        match &mut self.rider {
            Rider::Present { log, .. } => log.stop(),
            Rider::Recorded { .. } => Ok(()),
        }
    }

    /// Completes the recording at the end of the ride.
    ///
    /// # Errors
    /// [`LogError`] if the rest cannot be written, or if a recording has failed during the ride.
    pub fn finish(&mut self) -> Result<(), LogError> {
        self.lost.sentence().iter().for_each(tell);
        if let Some(kiosk) = &mut self.kiosk {
            kiosk.finish(self.clock.now());
        }
        match &mut self.rider {
            Rider::Present { log, .. } => {
                if let Some(path) = log.awaited() {
                    let path = path.display();
                    tell(format_args!("{path}: the ride ended before its first frame, so there is no recording"));
                }
                log.finish()
            }
            Rider::Recorded { .. } => Ok(()),
        }
    }
}

/// Notes in the day's log which devices have come and gone.
fn note_devices(kiosk: &mut Kiosk, devices: &Devices, before: &mut Vec<SampleSource>) {
    let open = devices.status().into_iter().filter(|status| status.state == DeviceState::Open);
    let open: Vec<SampleSource> = open.map(|status| status.source).collect();
    for gone in before.iter().filter(|source| !open.contains(source)) {
        kiosk.fault(&format!("{gone}: the device is gone"));
    }
    for come in open.iter().filter(|source| !before.contains(source)) {
        kiosk.fault(&format!("{come}: the device is there"));
    }
    *before = open;
}

/// Sentence on a tracked head that is not seen, with the reason; `None` while it is seen, or if none is tracked.
fn unseen(desk: &Desk, frame: &RideFrame) -> Option<String> {
    let (head, state) = (desk.head()?, frame.controls.head.as_ref()?);
    let how = match state.tracked {
        // A head that fades may be back with the next pose.
        Tracking::Tracked | Tracking::Fading => return None,
        Tracking::Never => "has not been seen yet",
        Tracking::Lost => "is lost, and rests at its last place",
    };
    let rejected = head.rejected();
    let why = rejected
        .last()
        .map_or_else(String::new, |last| format!("; poses rejected: {}, the last: {last}", rejected.number()));
    Some(format!("the head {how}{why}"))
}

/// Actions of a recorded ride's onlooker that concern the window alone.
fn onlooker(said: &[Sample]) -> Vec<Action> {
    let mut desk = Desk::new(DeskConfig::default()).expect("the default settings are sound");
    said.iter().for_each(|sample| desk.feed(sample));
    let actions = desk.controls(said.last().map_or(0, |sample| sample.at)).actions;
    let of_window = |action: &Action| {
        matches!(
            action,
            Action::ToggleHelp
                | Action::Photo
                | Action::PhotoSphere
                | Action::ToggleFullScreen
                | Action::ToggleCalibration
                | Action::Leave
                | Action::Toggle(_)
                | Action::Set(..)
                | Action::Next(_)
        )
    };
    actions.into_iter().filter(|action| of_window(action) || Presentation::repeats(action)).collect()
}
