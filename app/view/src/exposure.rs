//! The worldline of an eye while a shutter is open.

use crate::shot::{Gaze, Shot};
use glam::{DQuat, DVec3};
use physics::{Event, Observer};

/// Gazes while a shutter is open, evenly spaced in own time; the picture's own moment is in the middle. Without any,
/// the shutter is open for no time.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct OpenShutter(Vec<Gaze>);

impl OpenShutter {
    /// OpenShutter along these gazes.
    pub fn along(gazes: Vec<Gaze>) -> Self {
        Self(gazes)
    }

    /// OpenShutter of an eye in uniform motion, for a length of own time in metres of light travel.
    pub fn straight(gaze: &Gaze, length_m: f64) -> Self {
        if length_m == 0.0 {
            return Self::default();
        }
        let celerity = gaze.observer.celerity;
        let at = |tau: f64| {
            let Event { ct, position } = gaze.observer.event;
            let event = Event { ct: ct + celerity.gamma() * tau, position: position + celerity.vector() * tau };
            Gaze { observer: Observer { event, celerity }, ..*gaze }
        };
        Self(vec![at(-0.5 * length_m), at(0.5 * length_m)])
    }

    /// OpenShutter of an eye beside this one, at the same own times; its place in the axes of the gaze, metres.
    #[must_use]
    pub fn aside(mut self, place_m: DVec3) -> Self {
        for gaze in &mut self.0 {
            gaze.observer = gaze.observer.at_offset(gaze.observer_from_eye * place_m);
        }
        self
    }

    /// OpenShutter with all gazes turned alike, in their own axes.
    #[must_use]
    pub fn turned(mut self, turn: DQuat) -> Self {
        self.0.iter_mut().for_each(|gaze| gaze.observer_from_eye *= turn);
        self
    }

    /// True if the shutter is open for no time.
    pub fn is_instant(&self) -> bool {
        self.0.is_empty()
    }

    /// Gaze at a share of the exposure, −½ to ½; that of the shot if the shutter is open for no time.
    ///
    /// *Accuracy:* between two gazes, events and celerities go in a straight line and directions turn evenly.
    pub fn of_shot(&self, shot: &Shot, share: f64) -> Gaze {
        let own = Gaze { observer: shot.observer, observer_from_eye: shot.camera.observer_from_eye };
        let Some(last) = self.0.len().checked_sub(1) else { return own };
        let place = (share + 0.5).clamp(0.0, 1.0) * last as f64;
        let first = (place.floor() as usize).min(last.saturating_sub(1));
        self.0[first].towards(&self.0[(first + 1).min(last)], place - first as f64)
    }
}
