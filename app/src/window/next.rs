//! What is shown next in the open windows: another ride, or the present one drawn in another way.

use super::open::{Open, has_clockwork, map_scale, title, unseen, upload};
use crate::error::Error;
use crate::frame::RideInProgress;
use crate::output::say::tell;
use crate::session::making::{Made, Making};
use crate::session::waiting::WaitingRide;
use cabin::Guide;
use command::{DialOptions, RideOptions, SceneChoice, map_scale_of_windows};
use input::{Action, Sample, Setting};
use presentation::Presentation;
use render::choice::Choice;
use view::{Dial, Occasion};
use words::Phrase;

/// Settings of the picture that a rider keeps for the next ride.
const KEPT: [Setting; 6] =
    [Setting::Exposure, Setting::Tone, Setting::Gamut, Setting::Latency, Setting::Renderer, Setting::Vignette];

impl Open {
    /// Begins to make another ride ready: in a scene, or on a tour.
    pub(super) fn go_to(&mut self, action: &Action) {
        let language = self.presentation.language;
        if self.ride.live.is_recorded() {
            return self.ride.live.tell(language.text(Phrase::StaysRecorded));
        }
        let (what, options) = match action {
            Action::Scene(name) => (name, self.options.in_scene(SceneChoice::from_name(name))),
            Action::Tour(name) => (name, self.options.on_tour(name)),
            _ => return,
        };
        let options = RideOptions { language: Some(language), ..options };
        // The rider stays as comfortable as before.
        let mut room = self.room.clone();
        if let Some((next, present)) = room.head.as_mut().zip(self.ride.live.head()) {
            (next.stance, next.snap_turn_deg) = (present.config().stance, present.config().snap_turn_deg);
        }
        self.making = Some(Making::ride(what.clone(), options, room, self.dial));
    }

    /// Keeps the way of drawing that is asked for, and tells of what is being made ready.
    pub(super) fn look_ahead(&mut self) {
        if let Some(making) = &self.making {
            if making.is_told {
                let told = self.presentation.language.fill(Phrase::Loading, &[&making.what]);
                self.ride.live.tell(told);
            }
            return;
        }
        // What moves in the scene is driven by clocks that count seconds.
        let light = self.ride.frame.as_ref().map(|frame| frame.vehicle.light_speed().speed_of_light_m_s());
        if self.has_clockwork && light.is_some() && light != self.options.world.speed_of_light {
            self.options.world.speed_of_light = light;
            self.making = Some(Making::method(self.options.world.clone(), self.dial));
            return;
        }
        let software = self.gpu.is_software();
        let asked = self.presentation.dial.map(DialOptions::of);
        let dial = asked.map(|dial| dial.dial(Occasion::Ride, map_scale_of_windows(software)));
        let dial = dial.unwrap_or_else(|| self.options.dial(software));
        if dial != self.dial {
            self.making = Some(Making::method(self.options.world.clone(), dial).told());
            self.dial = dial;
        }
    }

    /// True once something is ready to be shown.
    pub(super) fn has_next(&self) -> bool {
        self.making.as_ref().is_some_and(Making::is_done)
    }

    /// The windows with what is ready to be shown in them. What cannot be shown is told, and the ride goes on.
    ///
    /// # Errors
    /// A lost device, or devices that cannot be opened again.
    pub(super) fn with_next(mut self) -> Result<Self, Error> {
        let is_told = self.making.as_ref().is_some_and(|making| making.is_told);
        match self.making.take().map(Making::outcome) {
            None => Ok(self),
            Some(Ok(Made::Ride(waiting, choice))) => self.with_ride(*waiting, *choice),
            Some(Ok(Made::Method(choice))) => {
                self.draw_by(*choice, is_told)?;
                Ok(self)
            }
            Some(Err(error)) => {
                let told = self.presentation.language.fill(Phrase::CannotLoad, &[&error]);
                tell(&told);
                self.ride.live.tell(told);
                // The way of drawing stays the one that draws.
                if self.presentation.dial.is_some() {
                    self.presentation.dial = Some(self.drawn_by);
                    self.dial =
                        DialOptions::of(self.drawn_by).dial(Occasion::Ride, map_scale(&self.gpu, self.drawn_by));
                }
                Ok(self)
            }
        }
    }

    /// Draws the present ride by another choice from now on.
    fn draw_by(&mut self, choice: Choice, is_told: bool) -> Result<(), Error> {
        tell(&choice.because);
        self.set_map_scale(choice.dial);
        self.ride.draw_by(upload(&self.gpu, choice, &self.options, self.format)?);
        if is_told {
            let told = self.drawing();
            self.ride.live.tell(told);
        }
        Ok(())
    }

    /// Ends the present ride, and begins another in the same windows.
    fn with_ride(mut self, waiting: WaitingRide, choice: Choice) -> Result<Self, Error> {
        let WaitingRide { options, presentation, begin, .. } = waiting;
        tell(format_args!("{}, on {}", choice.because, self.gpu.description()));
        self.windows.iter().for_each(|surface| surface.window.set_title(&title(&choice.scene.name)));
        self.guide = Guide::new(&choice.scene);
        self.has_clockwork = has_clockwork(&choice.scene);
        let start = choice.scene.start;
        self.set_map_scale(choice.dial);
        let shown = (presentation.effects, presentation.fov_deg, &presentation.development);
        let unseen = unseen(&self.gpu, &self.windows, &self.canvas);
        let ready = upload(&self.gpu, choice, &options, self.format).and_then(|mut renderer| {
            let took = self.canvas.warm_up(&self.gpu, &mut renderer, &start, shown, &unseen)?;
            Ok((renderer, took))
        });

        // Whatever comes of it, the recording of the ride before is whole. Devices are opened by one ride at a time.
        if let Err(error) = self.ride.live.finish() {
            tell(error);
        }
        let (renderer, took) = ready?;
        drop(self.ride);
        self.ride = RideInProgress::new(renderer, begin()?, options.frame_rate.unwrap_or_default().governor());
        self.ride.begin(&mut self.canvas, took);
        let kept = KEPT.map(|setting| (setting, self.presentation.text(setting)));
        for (setting, text) in kept {
            if text != presentation.text(setting) {
                self.ride.live.say(|at| Sample::action(at, &Action::Set(setting, text)));
            }
        }
        let cockpit = self.presentation.cockpit;
        self.presentation = Presentation { cockpit, ..presentation };
        (self.fresh, self.options) = (presentation, options);
        Ok(self)
    }

    fn set_map_scale(&mut self, dial: Dial) {
        self.drawn_by = dial;
        self.canvas.begin_anew(map_scale(&self.gpu, dial));
    }
}
