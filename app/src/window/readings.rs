//! Readings of a ride for the head-up display and the panel.

use super::open::Open;
use crate::canvas::Canvas;
use crate::frame::RideInProgress;
use interface::{MenuComfort, MenuRide, Readings};
use room::EyeBehind;
use tours::TourPlan;
use words::{Language, Phrase};

/// Readings for the head-up display.
pub fn readings(ride: &RideInProgress, language: Language, kiosk: bool) -> Readings {
    let Some(frame) = &ride.frame else { return Readings::default() };
    let celerity = frame.gaze.observer.celerity;
    let odometer = frame.vehicle.odometer();
    let mut notices = ride.live.told();
    if ride.not_finite > 0 {
        notices.push(language.fill(Phrase::PointsLost, &[&ride.not_finite]));
    }
    notices.extend(ride.behind.as_ref().map(|(channel, EyeBehind { eye_m, distance_m })| {
        language.fill(Phrase::ChannelBlack, &[channel, eye_m, &format!("{:.3}", -distance_m)])
    }));
    notices.extend(interface::uncertainty(&ride.certainty, language));
    if frame.time_scale != 1.0 {
        notices.push(language.fill(Phrase::ClockRuns, &[&format!("{:.2}", frame.time_scale)]));
    }
    Readings {
        beta: celerity.beta().vector().length(),
        gamma: celerity.gamma(),
        rapidity: celerity.rapidity(),
        speed_of_light: frame.vehicle.light_speed().speed_of_light_m_s(),
        own_clock_s: odometer.own_s,
        world_clock_s: odometer.world_s,
        road_m: odometer.road_m,
        own_m: odometer.own_m,
        frame_rate: ride.times.frame_rate(),
        stages_ms: ride.times.stages_ms(language),
        certainty: accuracy(ride, language),
        notices,
        invitation: ride.live.invites().then(|| language.text(Phrase::Invitation).to_owned()),
        language,
        kiosk,
        // A tour that waits says itself what goes on.
        paused: frame.paused && !ride.live.caption().is_some_and(|caption| caption.waits),
        recording: ride.live.is_recording(),
    }
}

/// Error of directions in the picture, and its resolution if that is less than the window's.
fn accuracy(ride: &RideInProgress, language: Language) -> String {
    let error = interface::accuracy(&ride.certainty, language);
    let percent = format!("{:.0}", 100.0 * ride.share);
    if ride.share < 0.995 { language.fill(Phrase::DrawnAt, &[&error, &percent]) } else { error }
}

impl Open {
    /// Sentence on what draws.
    pub(super) fn drawing(&self) -> String {
        let renderer = &self.ride.renderer;
        let language = self.presentation.language;
        language.fill(Phrase::DrawnBy, &[&renderer.triangle_count(), &renderer.name(), &self.gpu.description()])
    }

    /// State of the ride that the menu shows.
    pub(super) fn menu(&self) -> MenuRide {
        let (ride, language) = (&self.ride, self.presentation.language);
        let vehicle = ride.frame.as_ref().map(|frame| &frame.vehicle);
        let drawing = self.drawing();
        let in_step = self.in_step.sentence(|values| language.fill(Phrase::InStep, values));
        let title = |plan: &TourPlan| plan.title.in_language(language.code()).to_owned();
        MenuRide {
            vehicle: vehicle.map_or_else(Default::default, |vehicle| vehicle.kind()),
            time_scale: ride.frame.as_ref().map_or(1.0, |frame| frame.time_scale),
            speed_of_light: vehicle.map_or(1.0, |vehicle| vehicle.light_speed().speed_of_light_m_s()),
            paused: ride.frame.as_ref().is_some_and(|frame| frame.paused),
            recording: ride.live.is_recording(),
            is_recorded: ride.live.is_recorded(),
            tracking: ride.live.tracking(),
            comfort: self.comfort(),
            has_lines: self.room_interface.is_some(),
            scene: self.options.world.scene().name(),
            tours: self.tours.iter().map(|(name, plan)| (title(plan), *name)).collect(),
            places: self.guide.places(language),
            dial: self.dial,
            drawn_by: self.drawn_by.renderer,
            devices: ride.live.devices(),
            drawing: [drawing].into_iter().chain(in_step).collect(),
            overlaps: ride.overlaps,
            is_flat: matches!(self.canvas, Canvas::Picture(_)),
        }
    }

    /// Comfort of whoever wears the headset: the rider, or who watches a recorded ride.
    fn comfort(&self) -> Option<MenuComfort> {
        let (worn, live) = (self.worn.as_ref()?, &self.ride.live);
        let head = if live.is_recorded() { worn.viewer.config() } else { live.head()?.config() };
        Some(MenuComfort { snap_turn_deg: head.snap_turn_deg, stance: head.stance })
    }
}
