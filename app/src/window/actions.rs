//! Actions that concern the program: what is shown, pictures, recordings, windows, the end.

use super::open::Open;
use super::photo;
use crate::session::preferences::Preferences;
use input::{Action, Switch};

impl Open {
    /// Carries out the rider's actions that concern the program. Those of the ride itself have been performed already.
    pub(super) fn carry_out(&mut self, actions: Vec<Action>) {
        if self.ride.live.has_turned() {
            self.presentation = self.fresh;
        }
        let kiosk = self.kiosk;
        for action in actions.into_iter().filter(|action| !kiosk || is_for_visitors(action)) {
            match action {
                Action::ToggleRecording => self.ride.live.toggle_recording(),
                Action::Recentre => {
                    let told = self.ride.live.straightened();
                    self.ride.live.tell(told);
                }
                Action::NextTracking | Action::Tracking(_) => {
                    let told = self.ride.live.tracking_told(self.presentation.language);
                    self.ride.live.tell(told);
                }
                Action::Photo => {
                    let development = self.presentation.development;
                    let taken = photo::take(&self.gpu, &mut self.ride.renderer, &mut self.canvas, &development);
                    self.ride.live.tell(taken.unwrap_or_else(|error| error.to_string()));
                }
                Action::ToggleFullScreen => self.fill_monitors(),
                Action::ToggleCalibration => self.calibrate(),
                Action::Leave => self.leaves = true,
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
    }
}

impl Open {
    /// Keeps the language that the rider has chosen for the rides to come.
    fn keep_language(&mut self) {
        if let (false, Err(error)) = (self.kiosk, Preferences::save_language(self.presentation.language)) {
            self.ride.live.tell(error.to_string());
        }
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
            | Action::Leave
    )
}
