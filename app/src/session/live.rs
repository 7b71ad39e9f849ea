//! Live ride without its picture: the source of samples, the simulation that they drive, and the log.
//!
//! Frames come from live devices and the window's keys as the clock runs, or from a recording at the pace at which it
//! was ridden. In both cases the caller asks once per frame and gets the observer.

use crate::output::say::tell;
use crate::session::lost_time::LostTime;
use crate::session::recorded_ride::RecordedRide;
use crate::session::tour_ride::{TourMark, TourRide};
use hardware::UnseenHead;
use input::devices::{DeviceNote, DeviceState, Devices};
use input::{Action, Clock, KeyMap, Nanos, RoadLoad, SECOND, Sample, SampleSource};
use interface::Caption;
use kiosk::Kiosk;
use ride::{FrameTaker, LogError, Replay, ReplayError, RideFrame, RideLog, Simulation};
use words::{Language, Phrase};

/// Ride in progress.
pub struct Live {
    clock: Clock,
    pub(super) rider: Rider,
    end: Option<Nanos>,
    said: Vec<Sample>,
    /// Sentences for the rider, each with its end.
    pub(super) told: Vec<(Nanos, String)>,
    /// Own time that was not ridden because frames came too late.
    pub(super) lost: LostTime,
    /// Tour that rides, if there is one.
    tour: Option<Box<TourRide>>,
    /// Visitors, if the ride is for them.
    pub(super) kiosk: Option<Box<Kiosk>>,
    /// True once another rider's turn has begun.
    turned: bool,
    /// Devices that were open at the last look.
    open: Vec<SampleSource>,
    /// Head that its tracker does not see, while it does not.
    pub(super) unseen: Option<UnseenHead>,
    /// Notes on devices that are open and do not do all that they should, and the next look for more.
    pub(super) notes: (Vec<DeviceNote>, Nanos),
    /// Language of the sentences for the rider.
    pub language: Language,
}

/// Source of the ride's frames.
pub(super) enum Rider {
    /// Live devices, with a simulation and a log.
    Present { simulation: Box<Simulation>, devices: Box<Devices>, log: Box<RideLog> },
    /// Recorded ride that is replayed.
    Recorded(Box<RecordedRide>),
}

impl Live {
    /// Creates a live ride from `devices`, whose clock must be `clock`. The ride ends after `seconds`, if given.
    pub fn present(simulation: Simulation, devices: Devices, clock: Clock, log: RideLog, seconds: Option<f64>) -> Self {
        let rider = Rider::Present { simulation: Box::new(simulation), devices: Box::new(devices), log: Box::new(log) };
        Self::new(rider, clock, seconds)
    }

    /// Creates a replay of a recorded ride that starts now, for an onlooker with these keys. The ride ends after
    /// `seconds`, if given.
    pub fn recorded(replay: Replay, keys: KeyMap, seconds: Option<f64>) -> Self {
        Self::new(Rider::Recorded(Box::new(RecordedRide::new(replay, keys))), Clock::start(), seconds)
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

    /// Adds a sample of the window or the panel, stamped with the present time.
    pub fn say(&mut self, sample: impl FnOnce(Nanos) -> Sample) {
        self.said.push(sample(self.clock.now()));
    }

    /// Present frame of the ride; `None` at its end.
    ///
    /// # Errors
    /// [`ReplayError`] of a recording that is damaged before its first frame.
    pub fn frame(&mut self) -> Result<Option<RideFrame>, ReplayError> {
        self.frame_for(None)
    }

    /// Present frame of the ride, and on the way to it those that `taker` wants, if devices are live.
    ///
    /// # Errors
    /// Those of [`Live::frame`].
    pub fn frame_for(&mut self, taker: Option<&mut dyn FrameTaker>) -> Result<Option<RideFrame>, ReplayError> {
        let now = self.clock.now();
        self.told.retain(|(until, _)| *until > now);
        if self.end.is_some_and(|end| now >= end) {
            return Ok(None);
        }
        let mut tour_ended = false;
        let frame = match &mut self.rider {
            Rider::Present { simulation, devices, log } => {
                let mut samples = devices.drain();
                samples.append(&mut self.said);
                if let Some(tour) = &mut self.tour {
                    samples.retain(|sample| !tour.replaces(sample.source));
                    samples.append(&mut tour.samples(now, simulation));
                    tour_ended = tour.has_ended();
                }
                samples.sort_by_key(|sample| sample.at);
                if let Some(kiosk) = &mut self.kiosk {
                    note_devices(kiosk, devices, &mut self.open);
                    let (passed, turn) = kiosk.samples(now, samples, simulation.vehicle());
                    samples = passed;
                    self.turned |= turn.is_some();
                }
                let frame = simulation.frame_for(now, &samples, taker);
                if let Some(kiosk) = &mut self.kiosk {
                    kiosk.shown(now, &frame);
                    kiosk.take_fault().iter().for_each(tell);
                }
                devices.brake(frame.vehicle.resistance());
                devices.load(RoadLoad { slope: frame.vehicle.slope(), brake: frame.controls.brake });
                self.lost.add(frame.dropped_ticks, now);
                let head = simulation.desk().head().zip(frame.controls.head.as_ref());
                let unseen = head.and_then(|(head, state)| UnseenHead::of(head, state.tracked));
                // Terminal and log are in English.
                let sentence = unseen.as_ref().map(|unseen| unseen.sentence(Language::English));
                if let Some(kiosk) = &mut self.kiosk {
                    kiosk.head(now, sentence.as_deref());
                }
                if unseen.is_some() != self.unseen.is_some() {
                    tell(sentence.as_deref().unwrap_or("the head is tracked"));
                }
                self.unseen = unseen;
                if let Err(error) = log.frame(&samples, &frame) {
                    // The ride goes on, and the notice stays: nobody should believe that the rest is recorded.
                    tell(&error);
                    if let Some(kiosk) = &mut self.kiosk {
                        kiosk.fault(&error.to_string());
                    }
                    self.told.push((Nanos::MAX, interface::log_fault(&error, self.language)));
                }
                Some(frame)
            }
            Rider::Recorded(ride) => {
                let mut said = std::mem::take(&mut self.said);
                if let Some(tour) = &mut self.tour {
                    said.append(&mut tour.samples(now, ride.replay.simulation()));
                    tour_ended = tour.has_ended();
                }
                let step = ride.frame(now, &said)?;
                let difference = step.difference.map(|difference| interface::replay_fault(&difference, self.language));
                self.told.extend(difference.map(|sentence| (Nanos::MAX, sentence)));
                step.frame
            }
        };
        self.tell_notes(now);
        if tour_ended {
            self.tell(self.language.text(Phrase::TourOver));
        }
        if let Some(frame) = &frame {
            for notice in &frame.notices {
                self.tell(interface::notice(*notice, self.language));
            }
        }
        Ok(frame)
    }

    /// True if the ride is a recorded one.
    pub fn is_recorded(&self) -> bool {
        matches!(self.rider, Rider::Recorded(_))
    }

    /// Completes the recording at the end of the ride.
    ///
    /// # Errors
    /// [`LogError`] if the rest cannot be written, or if a recording has failed during the ride.
    pub fn finish(&mut self) -> Result<(), LogError> {
        self.lost.sentence(Language::English).iter().for_each(tell);
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
            Rider::Recorded(_) => Ok(()),
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
