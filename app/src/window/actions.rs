//! Actions that concern the program: what is shown, pictures, recordings, windows, the end.

use super::open::Open;
use super::photo;
use crate::canvas::Canvas;
use crate::error::Error;
use crate::session::preferences::Preferences;
use cabin::RoomInterface;
use egui::Key;
use input::{Action, FocusStep, Sample, Switch};
use words::Phrase;

impl Open {
    /// Carries out the rider's actions that concern the program. Those of the ride itself have been performed already.
    pub(super) fn carry_out(&mut self, actions: Vec<Action>) {
        if self.ride.live.has_turned() {
            self.presentation = self.fresh;
        }
        let kiosk = self.kiosk;
        self.perform(actions.into_iter().filter(|action| !kiosk || is_for_visitors(action)).collect());
    }

    /// Passes the operator's actions on to the ride. What visitors of a kiosk may not do, the operator may.
    pub(super) fn operate(&mut self, actions: Vec<Action>) {
        let kiosk = self.kiosk;
        let (of_ride, own): (Vec<_>, Vec<_>) =
            actions.into_iter().partition(|action| !kiosk || is_for_visitors(action));
        for action in of_ride {
            self.ride.live.say(|at| Sample::action(at, &action));
        }
        self.perform(own);
    }

    fn perform(&mut self, actions: Vec<Action>) {
        for action in actions {
            match action {
                Action::GoOn | Action::Answer(_) => self.ride.live.act_on_tour(&action),
                Action::ToggleRecording => self.ride.live.toggle_recording(),
                Action::Recentre if !self.ride.live.is_recorded() => {
                    let told = self.ride.live.straightened();
                    self.ride.live.tell(told);
                }
                Action::NextTracking | Action::Tracking(_) => {
                    let told = self.ride.live.tracking_told();
                    self.ride.live.tell(told);
                }
                // The desk has turned the head of a rider, and knows nothing of whoever watches.
                Action::Stance(_) | Action::SnapTurn(_) | Action::Recentre => {
                    if let Some(worn) = self.worn.as_mut().filter(|_| self.ride.live.is_recorded()) {
                        worn.viewer.act(&action);
                    }
                }
                Action::Photo => {
                    // A photo shows the world, also where no lens does.
                    self.draw_for_window();
                    let development = self.presentation.development;
                    let taken = photo::take(&self.gpu, &mut self.ride.renderer, &mut self.canvas, &development);
                    self.tell_photo(taken);
                }
                Action::PhotoSphere => {
                    let Some(gaze) = self.ride.frame.as_ref().map(|frame| frame.gaze) else { continue };
                    let renderer = &mut self.ride.renderer;
                    let taken = photo::take_sphere(&self.gpu, renderer, self.format, &gaze, &self.presentation);
                    self.tell_photo(taken);
                }
                Action::Focus(step) if self.presentation.menu => self.menu_keys.push(match step {
                    FocusStep::Left => Key::ArrowLeft,
                    FocusStep::Right => Key::ArrowRight,
                    FocusStep::Up => Key::ArrowUp,
                    FocusStep::Down => Key::ArrowDown,
                }),
                // A pointer on a sheet has chosen there already, and the panels of a window see its enter key.
                Action::Choose if self.points_at_sheet() => {}
                Action::Choose if self.presentation.menu => {
                    if !self.entered {
                        self.menu_keys.push(Key::Enter);
                    }
                }
                Action::Choose => self.ride.live.act_on_tour(&Action::GoOn),
                Action::Orbit { turn_rad, closer } => self.ride.outside.orbit(turn_rad, closer),
                Action::Scene(_) | Action::Tour(_) => self.go_to(&action),
                Action::ToggleFullScreen => self.fill_monitors(),
                Action::ToggleCalibration => self.calibrate(),
                Action::Leave => self.leaves = true,
                Action::Toggle(Switch::Outside | Switch::Frozen) if !matches!(self.canvas, Canvas::Picture(_)) => {
                    let told = self.presentation.language.text(Phrase::OnlyFlat);
                    self.ride.live.tell(told);
                }
                _ => {
                    let language = self.presentation.language;
                    if let Some(told) = self.presentation.act(&action) {
                        self.ride.live.tell(told);
                    }
                    if self.presentation.language != language {
                        self.keep_language();
                    }
                }
            }
        }
        self.entered = false;
    }
}

impl Open {
    /// True if a pointer is on a sheet of the room.
    fn points_at_sheet(&self) -> bool {
        self.room_interface.as_ref().is_some_and(RoomInterface::is_pointed_at)
    }

    /// Keeps the language that the rider has chosen for the rides to come.
    fn keep_language(&mut self) {
        if let (false, Err(error)) = (self.kiosk, Preferences::save_language(self.presentation.language)) {
            let told = self.presentation.language.fill(Phrase::LanguageNotKept, &[&error]);
            self.ride.live.tell(told);
        }
    }

    /// Tells the rider the names of a photo's files, or why there is none.
    fn tell_photo(&mut self, taken: Result<String, Error>) {
        let language = self.presentation.language;
        self.ride.live.tell(match taken {
            Ok(files) => language.fill(Phrase::PhotoSaved, &[&files]),
            Err(error) => language.fill(Phrase::PhotoFailed, &[&error]),
        });
    }
}

/// True for an action that visitors of a kiosk have. They keep no files, change no settings and do not leave.
fn is_for_visitors(action: &Action) -> bool {
    !matches!(
        action,
        Action::ToggleRecording
            | Action::Photo
            | Action::PhotoSphere
            | Action::Toggle(Switch::Menu)
            | Action::ToggleFullScreen
            | Action::ToggleCalibration
            | Action::Scene(_)
            | Action::Tour(_)
            | Action::Leave
    )
}
