//! The desk: all devices' decoders, and the one set of controls that they make.
//!
//! Samples are fed in the order in which they were drained, and the controls are read once a frame. The result
//! depends on nothing else, so the samples and frame times of a recording give the same bits.
//!
//! Several devices may be used at once. Deflections add up and are clamped; the stronger brake wins; the wheel speed
//! is the fastest of the measured ones and the simulated one. Keys and sticks turn the handlebar only as far as a rider
//! would lean: at the speed v no further than tan δ = a L / v².
//!
//! Keys, the mouse and a gamepad's second stick turn the rider's look, unless a tracked head decides where it goes.
//! A flick of the stick of the hand that is not the wand turns a headset's rider in the vehicle by a step.
//!
//! A tracker's poses go to the one [`TrackedHead`], if one is configured.

use crate::action::{Action, VehicleKind};
use crate::bicycle::decoder::BicycleDecoder;
use crate::clock::Nanos;
use crate::config::DeskConfig;
use crate::config_error::ConfigError;
use crate::controls::Controls;
use crate::decoder::{Actions, Decoder};
use crate::dtrack::decoder::DtrackDecoder;
use crate::faults::Faults;
use crate::gamepad::GamepadDecoder;
use crate::head::heard::HeardSensor;
use crate::head::mouse::MouseDecoder;
use crate::head::rigid::Rigid;
use crate::head::state::HeadState;
use crate::head::tracked_head::TrackedHead;
use crate::head::tracked_pose::TrackedPose;
use crate::head::tracking_mode::TrackingMode;
use crate::head::url::TrackerUrl;
use crate::keyboard::KeyboardDecoder;
use crate::look::decoder::LookDecoder;
use crate::look::free_look::FreeLook;
use crate::opentrack::OpentrackDecoder;
use crate::openxr::OpenxrDecoder;
use crate::sample::{Sample, SampleSource, Signal};
use crate::settings::ActionDecoder;
use crate::spacemouse::SpaceMouseDecoder;
use crate::spacenavd::SpacenavdDecoder;
use crate::trainer::decoder::TrainerDecoder;
use crate::vrpn::decoder::VrpnDecoder;
use crate::wand::state::WandState;
use crate::wand::tracked_wand::TrackedWand;
use crate::wand::work::{self, WandPresses};
use glam::DVec3;

/// Decoders of all devices, and the state that they share.
#[derive(Debug)]
pub struct Desk {
    config: DeskConfig,
    keyboard: KeyboardDecoder,
    gamepad: GamepadDecoder,
    space_mouse: SpaceMouseDecoder,
    spacenavd: SpacenavdDecoder,
    bicycle: BicycleDecoder,
    trainer: TrainerDecoder,
    vrpn: VrpnDecoder,
    dtrack: DtrackDecoder,
    opentrack: OpentrackDecoder,
    openxr: OpenxrDecoder,
    mouse: MouseDecoder,
    look: LookDecoder,
    /// Vehicle that is ridden, on which the meaning of the gamepad's second stick depends.
    vehicle: VehicleKind,
    /// True if a handlebar, a stick or a SpaceMouse steers, false if keys do.
    by_hand: bool,
    head: Option<TrackedHead>,
    /// Thrust of a rider who is nobody: right, up, backward.
    pushed: [f64; 3],
    wand: Option<TrackedWand>,
    presses: WandPresses,
    /// Use of the tracked head, if there is one.
    tracking: Option<TrackingMode>,
    /// True if the present sample makes the pose of the head the straight one.
    recentres: bool,
    settings: ActionDecoder,
    actions: Actions,
}

impl Desk {
    /// Desk without any sample yet.
    ///
    /// # Errors
    /// A setting that cannot be used.
    pub fn new(config: DeskConfig) -> Result<Self, ConfigError> {
        config.check()?;
        let device = match config.head.as_ref().map(|head| &head.url) {
            Some(TrackerUrl::Vrpn { device, .. }) => device,
            _ => "",
        };
        let wand = config.head.as_ref().and_then(|head| head.wand.as_ref());
        let home = config.head.as_ref().map_or(DVec3::ZERO, |head| DVec3::from_array(head.home));
        Ok(Self {
            vrpn: VrpnDecoder::with_wand(device, wand),
            dtrack: config.head.as_ref().map_or_else(DtrackDecoder::default, DtrackDecoder::of_head),
            opentrack: OpentrackDecoder::new(config.head.as_ref().map_or(&[], |head| &head.flip)),
            openxr: config.head.as_ref().map_or_else(OpenxrDecoder::default, OpenxrDecoder::of_head),
            mouse: MouseDecoder::new(home),
            look: LookDecoder::default(),
            vehicle: VehicleKind::default(),
            by_hand: false,
            head: config.head.clone().map(TrackedHead::new).transpose()?,
            pushed: [0.0; 3],
            wand: config.head.as_ref().map_or(Ok(None), TrackedWand::new)?,
            keyboard: KeyboardDecoder::new(config.rider.clone(), &config.keys, config.all_act),
            gamepad: GamepadDecoder::new(config.free_look, config.all_act, config.gamepad.clone()),
            space_mouse: SpaceMouseDecoder::new(config.space_mouse, config.many_buttons),
            spacenavd: SpacenavdDecoder::new(config.spacenavd),
            bicycle: BicycleDecoder::new(config.bicycle.clone()),
            trainer: TrainerDecoder::new(config.trainer.clone()),
            presses: WandPresses::default(),
            tracking: config.head.as_ref().map(|head| head.mode),
            recentres: false,
            settings: ActionDecoder::default(),
            actions: Actions::default(),
            config,
        })
    }

    /// Settings of all decoders, as they belong into a recording's header.
    pub fn config(&self) -> &DeskConfig {
        &self.config
    }

    /// Takes the next sample.
    pub fn feed(&mut self, sample: &Sample) {
        let decoder: &mut dyn Decoder = match sample.source {
            SampleSource::Keyboard => &mut self.keyboard,
            SampleSource::Gamepad => &mut self.gamepad,
            SampleSource::SpaceMouse => &mut self.space_mouse,
            SampleSource::Spacenavd => &mut self.spacenavd,
            SampleSource::Bicycle => &mut self.bicycle,
            SampleSource::Trainer => &mut self.trainer,
            SampleSource::Vrpn => &mut self.vrpn,
            SampleSource::Dtrack => &mut self.dtrack,
            SampleSource::Opentrack => &mut self.opentrack,
            SampleSource::Openxr => &mut self.openxr,
            SampleSource::Mouse if self.mouse_looks() => &mut self.look,
            SampleSource::Mouse => &mut self.mouse,
            SampleSource::Settings => &mut self.settings,
        };
        let waiting = self.actions.number();
        match &sample.signal {
            Signal::Opened | Signal::Closed => decoder.reset(sample.at),
            Signal::Bytes(bytes) => decoder.bytes(sample.at, bytes, &mut self.actions),
        }
        self.track(sample);
        for action in self.actions.after(waiting) {
            match action {
                Action::Recentre => self.recentres = true,
                Action::Tracking(mode) => self.tracking = self.tracking.map(|_| *mode),
                Action::NextTracking => self.tracking = self.tracking.map(TrackingMode::next),
                Action::Stance(stance) => self.head.iter_mut().for_each(|head| head.take_stance(*stance)),
                Action::SnapTurn(degrees) => self.head.iter_mut().for_each(|head| head.snap_by(*degrees)),
                _ => {}
            }
        }
        if std::mem::take(&mut self.recentres) {
            self.recentre(sample.at);
        }
        self.note_hand(sample);
        if matches!(sample.source, SampleSource::Keyboard) {
            self.look.hold(sample.at, self.keyboard.look(), self.keyboard.looks_back());
        }
    }

    /// Makes the present pose of the head the straight one.
    fn recentre(&mut self, at: Nanos) {
        self.mouse.go_home(at);
        if let Some(head) = &mut self.head {
            head.recentre();
        }
    }

    /// Notes the device that steers: a bicycle as long as it sends, else the one that was moved last.
    fn note_hand(&mut self, sample: &Sample) {
        let sends = matches!(sample.signal, Signal::Bytes(_));
        let pushed = |axes: &[f64]| sends && axes.iter().any(|axis| *axis != 0.0);
        match sample.source {
            SampleSource::Bicycle => self.by_hand = sends && self.config.bicycle.handlebar,
            SampleSource::Keyboard if sends => {
                self.by_hand = self.bicycle.wheel_speed(sample.at).is_some() && self.config.bicycle.handlebar;
            }
            SampleSource::Gamepad => self.by_hand |= pushed(&self.gamepad.deflection()),
            SampleSource::SpaceMouse => self.by_hand |= pushed(&self.space_mouse.deflection(sample.at)),
            SampleSource::Spacenavd => self.by_hand |= pushed(&self.spacenavd.deflection()),
            SampleSource::Vrpn | SampleSource::Dtrack | SampleSource::Openxr if self.config.all_act => {
                self.by_hand |= self.wand.as_ref().is_some_and(|wand| work::steer(&wand.state(sample.at)) != 0.0);
            }
            _ => {}
        }
    }

    /// True if a handlebar, a stick or a SpaceMouse steers, false if keys do.
    pub fn is_steered_by_hand(&self) -> bool {
        self.by_hand
    }

    /// Takes the vehicle that is ridden.
    pub fn ride(&mut self, vehicle: VehicleKind) {
        self.vehicle = vehicle;
    }

    /// True if the window's mouse turns the look, false if it moves the head.
    fn mouse_looks(&self) -> bool {
        self.config.head.as_ref().is_none_or(|head| head.url != TrackerUrl::Mouse)
    }

    /// Turn of the gaze at the time `at`, after `actions`; none where the head is tracked, which decides.
    fn free_look(&mut self, at: Nanos, actions: &[Action]) -> FreeLook {
        if !self.config.free_look || self.config.head.is_some() {
            return FreeLook::default();
        }
        if actions.iter().any(|action| matches!(action, Action::LookAhead | Action::Restart)) {
            self.look.look_ahead(at);
        }
        self.look.push(self.gamepad.look(self.vehicle == VehicleKind::Bicycle));
        self.look.look(at)
    }

    /// Passes a tracker's poses to the head, if the head listens to that tracker.
    fn track(&mut self, sample: &Sample) {
        let (poses, signals): (Vec<TrackedPose>, _) = match sample.source {
            SampleSource::Vrpn => (self.vrpn.take_poses(), self.vrpn.take_wand_signals()),
            SampleSource::Dtrack => (self.dtrack.take_poses(), self.dtrack.take_wand_signals()),
            SampleSource::Opentrack => (self.opentrack.take_poses(), Vec::new()),
            SampleSource::Openxr => (self.openxr.take_poses(), self.openxr.take_wand_signals()),
            _ => return,
        };
        let flicks = self.openxr.take_flicks();
        let Some(head) = self.head.as_mut().filter(|head| head.config().url.source() == sample.source) else {
            return;
        };
        if sample.source == SampleSource::Openxr && self.openxr.take_moved() {
            head.axes_moved();
            self.wand.iter_mut().for_each(TrackedWand::axes_moved);
        }
        poses.iter().for_each(|pose| head.pose(pose));
        head.snap_turn(flicks);
        if !matches!(sample.signal, Signal::Bytes(_)) {
            head.gone(sample.at);
        }
        if let Some(wand) = &mut self.wand {
            for signal in signals {
                wand.signal(sample.at, signal);
                if self.config.all_act {
                    let pressed = self.presses.take(&wand.state(sample.at), &wand.config().actions);
                    pressed.into_iter().for_each(|action| self.actions.push(action));
                }
            }
            if !matches!(sample.signal, Signal::Bytes(_)) {
                wand.gone(sample.at);
            }
        }
    }

    /// Use of the tracked head; `None` if none is configured.
    pub fn tracking(&self) -> Option<TrackingMode> {
        self.tracking
    }

    /// Tracked head, if one is configured.
    pub fn head(&self) -> Option<&TrackedHead> {
        self.head.as_ref()
    }

    /// Decoder of the trainer, with the rider's power.
    pub fn trainer(&self) -> &TrainerDecoder {
        &self.trainer
    }

    /// Tracked wand, if one is configured.
    pub fn wand(&self) -> Option<&TrackedWand> {
        self.wand.as_ref()
    }

    /// Decoder of the VRPN server, with the server's descriptions.
    pub fn vrpn(&self) -> &VrpnDecoder {
        &self.vrpn
    }

    /// Things that the tracker of this source has been heard to send: sensors, bodies, buttons, axes.
    pub fn heard(&self, source: SampleSource) -> &[HeardSensor] {
        match source {
            SampleSource::Vrpn => self.vrpn.heard(),
            SampleSource::Dtrack => self.dtrack.heard(),
            SampleSource::Opentrack => self.opentrack.heard(),
            SampleSource::Openxr => self.openxr.heard(),
            _ => &[],
        }
    }

    /// Sentence about a tracker that is open at the time `at` but does not show what is wanted of it: names what it
    /// does show. `None` while all is well.
    pub fn tracker_advice(&self, at: Nanos) -> Option<String> {
        let head = self.head.as_ref()?;
        match head.config().url.source() {
            SampleSource::Vrpn => self.vrpn.advice(at, head.config()),
            SampleSource::Dtrack => self.dtrack.advice(at, head.config()),
            _ => None,
        }
    }

    /// Head at the time `at`, reduced to the parts that its mode uses.
    fn head_state(&self, at: Nanos) -> Option<HeadState> {
        let head = self.head.as_ref()?;
        let url = &head.config().url;
        self.tracking?.of(if *url == TrackerUrl::Mouse { self.mouse.state(at) } else { head.state(at) })
    }

    /// Wand at the time `at`, in the room that the head's straight pose makes.
    fn wand_state(&self, at: Nanos) -> Option<Box<WandState>> {
        let room_from_straight = self.head.as_ref().map_or(Rigid::IDENTITY, TrackedHead::room_from_straight);
        self.wand.as_ref().map(|wand| Box::new(wand.state(at).placed(room_from_straight)))
    }

    /// Controls at the time `at`, with the actions since the last call.
    pub fn controls(&mut self, at: Nanos) -> Controls {
        let rider = &self.config.rider;
        let wand = self.wand_state(at);
        let driven = wand.as_deref().filter(|_| self.config.all_act);
        let wheel_speed = [
            self.bicycle.wheel_speed(at),
            self.trainer.wheel_speed(at),
            self.keyboard.wheel_speed(at),
            self.gamepad.pedal().map(|pedal| pedal * rider.cruise_m_s),
            driven.and_then(|wand| self.presses.pedal(wand)).map(|pedal| pedal * rider.cruise_m_s),
        ]
        .into_iter()
        .flatten()
        .max_by(|a, b| a.abs().total_cmp(&b.abs()));

        let speed = wheel_speed.unwrap_or(0.0);
        let leaning_rad = libm::atan2(rider.lateral_m_s2 * rider.wheelbase_m, speed * speed);
        let by_wand = driven.map_or(0.0, work::steer);
        let pretended = (self.keyboard.steer(at) + self.gamepad.steer() + by_wand).clamp(-1.0, 1.0);
        let steer_rad = self.bicycle.steer_rad() + pretended * rider.steer_rad.min(leaning_rad);

        let deflections = [
            self.keyboard.deflection(at),
            self.gamepad.deflection(),
            self.space_mouse.deflection(at),
            self.spacenavd.deflection(),
            driven.map_or([0.0; 6], work::deflection),
        ];
        let actions = self.actions.take();
        for action in &actions {
            if let Action::Thrust(axes) = action {
                self.pushed = *axes;
            }
        }
        let pushed = |axis: usize| self.pushed.get(axis).copied().unwrap_or(0.0);
        let deflection = |axis: usize| {
            let sum = deflections.iter().map(|device| device[axis]).sum::<f64>();
            (sum + pushed(axis)).clamp(-1.0, 1.0)
        };
        Controls {
            wheel_speed,
            cadence_hz: self.bicycle.cadence_hz(at).or_else(|| self.trainer.cadence_hz(at)),
            steer_rad,
            brake: [self.keyboard.brake(at), self.gamepad.brake(), driven.map_or(0.0, work::brake)]
                .into_iter()
                .fold(self.bicycle.brake(), f64::max),
            thrust: [deflection(0), deflection(1), deflection(2)],
            turn: [deflection(3), deflection(4), deflection(5)],
            head: self.head_state(at),
            wand,
            look: self.free_look(at, &actions),
            actions,
        }
    }

    /// Messages of a device that could not be understood so far.
    pub fn faults(&self, source: SampleSource) -> &Faults {
        match source {
            SampleSource::Keyboard => self.keyboard.faults(),
            SampleSource::Gamepad => self.gamepad.faults(),
            SampleSource::SpaceMouse => self.space_mouse.faults(),
            SampleSource::Spacenavd => self.spacenavd.faults(),
            SampleSource::Bicycle => self.bicycle.faults(),
            SampleSource::Trainer => self.trainer.faults(),
            SampleSource::Vrpn => self.vrpn.faults(),
            SampleSource::Dtrack => self.dtrack.faults(),
            SampleSource::Opentrack => self.opentrack.faults(),
            SampleSource::Openxr => self.openxr.faults(),
            SampleSource::Mouse if self.mouse_looks() => self.look.faults(),
            SampleSource::Mouse => self.mouse.faults(),
            SampleSource::Settings => self.settings.faults(),
        }
    }
}

#[cfg(test)]
#[path = "desk_tests.rs"]
mod tests;
