//! View of the diagram: its frame, its axis of space and its scale, which follow the ride without haste.

use physics::glam::{DMat3, DVec3};

use crate::diagram_frame::DiagramFrame;
use crate::spacetime_map::SpacetimeMap;
use crate::trail::{PresentMoment, Trail};
use crate::trail_point::TrailPoint;
use physics::Observer;

/// Choice of the diagram's axis of space.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum DiagramAxis {
    /// Direction in which the recent way extends farthest.
    #[default]
    Extent,
    /// Direction of the present motion.
    Motion,
}

/// Time constant with which axis and scale follow, seconds of real time.
const FOLLOW_S: f64 = 0.8;
/// Longest time between two frames that counts, seconds of real time.
const LONGEST_FRAME_S: f64 = 0.25;
/// Speed below which a vehicle has no direction of motion.
const STANDING_BETA: f64 = 0.02;
/// Room round the farthest point, as a factor.
const MARGIN: f64 = 1.15;
/// Share of the diagram's height below the present event.
pub const PAST_SHARE: f64 = 0.64;
/// Largest half extent in the vehicle's frame, in lengths of the window of own time.
const FARTHEST: f64 = 1.6;

/// View of the diagram.
#[derive(Clone, Debug)]
pub struct DiagramView {
    /// Frame of reference.
    pub frame: DiagramFrame,
    /// Choice of the axis.
    pub choice: DiagramAxis,
    /// Own time of the past that is shown, seconds.
    pub window_s: f64,
    /// Unit vector of the axis, world axes.
    axis: DVec3,
    /// Half the width of the diagram, metres. 0 before the first frame.
    half_width_m: f64,
    /// Own and real time of the last frame, seconds.
    last_s: Option<[f64; 2]>,
}

impl Default for DiagramView {
    fn default() -> Self {
        Self {
            frame: DiagramFrame::default(),
            choice: DiagramAxis::default(),
            window_s: 20.0,
            axis: DVec3::NEG_Z,
            half_width_m: 0.0,
            last_s: None,
        }
    }
}

impl DiagramView {
    /// Follows the ride by one frame. The first frame after a restart is taken over at once.
    pub fn follow(&mut self, trail: &Trail) {
        let Some(now) = trail.present() else { return };
        let restarted = self.last_s.is_none_or(|[own_s, _]| now.own_s < own_s);
        let frame_s = self.last_s.map_or(0.0, |[_, real_s]| (now.real_s - real_s).clamp(0.0, LONGEST_FRAME_S));
        let share = if restarted { 1.0 } else { 1.0 - (-frame_s / FOLLOW_S).exp() };
        self.last_s = Some([now.own_s, now.real_s]);
        if restarted {
            self.axis = now.heading.normalize_or(DVec3::NEG_Z);
        }
        let points = trail.points_since(now.own_s - self.window_s);
        let wanted = self.wanted_axis(now, &points);
        self.axis = self.axis.lerp(wanted, share).normalize_or(wanted);
        let wanted_m = self.wanted_half_width_m(now, &points);
        self.half_width_m = match self.half_width_m {
            width if width > 0.0 && !restarted => width * (wanted_m / width).powf(share),
            _ => wanted_m,
        };
    }

    /// Unit vector of the axis of space, world axes.
    pub fn axis(&self) -> DVec3 {
        self.axis
    }

    /// Half the width of the diagram, metres.
    pub fn half_width_m(&self) -> f64 {
        self.half_width_m
    }

    /// Map of the diagram at a moment.
    pub fn map(&self, now: &PresentMoment) -> SpacetimeMap {
        SpacetimeMap::new(&Observer { event: now.event, celerity: now.celerity }, self.axis, self.frame)
    }

    /// Axis that suits the ride, on the same side as the present one, so that it never flips.
    fn wanted_axis(&self, now: &PresentMoment, points: &[TrailPoint]) -> DVec3 {
        let motion = now.celerity.beta().vector();
        if self.choice == DiagramAxis::Motion {
            let along = if motion.length() < STANDING_BETA { self.axis } else { motion.normalize() };
            return if along.dot(self.axis) < 0.0 { -along } else { along };
        }
        // The present motion counts as a way of one second, so that a straight start has an axis at once.
        let ways = points.iter().filter(|point| !point.begins).map(|point| point.event.position - now.event.position);
        let ways = ways.chain([motion * now.light_speed.speed_of_light_m_s()]);
        let spread = ways.fold(DMat3::ZERO, |sum, way| sum + DMat3::from_cols(way * way.x, way * way.y, way * way.z));
        let size = spread.col(0).length().max(spread.col(1).length()).max(spread.col(2).length());
        if size.is_normal() { main_axis(spread * size.recip(), self.axis) } else { self.axis }
    }

    /// Half the width that shows the window's worldline, metres.
    fn wanted_half_width_m(&self, now: &PresentMoment, points: &[TrailPoint]) -> f64 {
        let map = self.map(now);
        let least_m = now.light_speed.metres(0.25 * self.window_s);
        let farthest_m = points
            .iter()
            .map(|point| map.place(point.event))
            .fold(least_m, |farthest: f64, place| farthest.max(place.x.abs()).max(place.t.abs() / (2.0 * PAST_SHARE)));
        let wanted_m = MARGIN * farthest_m;
        match self.frame {
            DiagramFrame::World => wanted_m,
            DiagramFrame::Vehicle => wanted_m.min(FARTHEST * now.light_speed.metres(self.window_s)),
        }
    }
}

/// Direction of the largest spread, found from `near` by repeated multiplication, and on its side.
fn main_axis(spread: DMat3, near: DVec3) -> DVec3 {
    /// Number of multiplications; what is left of a second direction of nine tenths of the spread is small.
    const ROUNDS: usize = 24;
    // A way exactly across the present axis has to be found, too.
    let tilted = near + 1e-3 * DVec3::new(1.0, 0.7, 0.4);
    let axis = (0..ROUNDS).fold(tilted, |axis, _| (spread * axis).normalize_or(axis));
    let axis = axis.normalize_or(near);
    if axis.dot(near) < 0.0 { -axis } else { axis }
}

#[cfg(test)]
mod tests {
    //! Law: axis and scale follow the ride, never jump, and are finite at rest and at γ = 1e6. A wrong program turns
    //! its picture over when the rider turns round.

    use super::*;
    use physics::glam::DQuat;
    use physics::worldline::Thrust;
    use physics::{Celerity, Event};
    use ride::LightSpeed;

    /// Straight ride along `along` with the celerity `u`, there for a time and back, 30 frames a second.
    fn there_and_back(along: DVec3, u: f64, seconds: f64, mut each: impl FnMut(&Trail)) {
        let mut trail = Trail::default();
        let light_speed = LightSpeed::new(8.0).unwrap();
        let frames = (30.0 * seconds) as u32;
        for frame in 0..frames {
            let own_s = f64::from(frame) / 30.0;
            let is_out = 2 * frame < frames;
            let celerity = Celerity::new(along * if is_out { u } else { -u }).unwrap();
            let way_s = if is_out { own_s } else { seconds - own_s };
            let event = Event {
                ct: celerity.gamma() * light_speed.metres(own_s),
                position: along * u * light_speed.metres(way_s),
            };
            let now = PresentMoment {
                event,
                celerity,
                observer_from_eye: DQuat::IDENTITY,
                heading: DVec3::NEG_Z,
                thrust: Thrust::default(),
                light_speed,
                own_s,
                world_s: own_s * celerity.gamma(),
                real_s: own_s,
            };
            trail.note_moment(now);
            each(&trail);
        }
    }

    #[test]
    fn the_axis_turns_to_the_way_and_stays_when_the_rider_turns_round() {
        let along = DVec3::new(0.6, 0.0, 0.8);
        for choice in [DiagramAxis::Extent, DiagramAxis::Motion] {
            let mut view = DiagramView { choice, ..DiagramView::default() };
            let mut before = None;
            there_and_back(along, 1.0, 20.0, |trail| {
                view.follow(trail);
                if let Some(before) = before.replace(view.axis()) {
                    assert!(view.axis().dot(before) > 0.99, "the axis jumps");
                }
            });
            assert!(view.axis().dot(along).abs() > 0.9999, "{choice:?}: {}", view.axis());
        }
    }

    #[test]
    fn the_scale_follows_smoothly_and_is_finite_at_any_speed() {
        for frame in [DiagramFrame::World, DiagramFrame::Vehicle] {
            for u in [0.0, 1e-12, 0.75, 1e6, 1e11] {
                let mut view = DiagramView { frame, ..DiagramView::default() };
                let mut before = None;
                there_and_back(DVec3::X, u, 6.0, |trail| {
                    view.follow(trail);
                    let width = view.half_width_m();
                    assert!(width.is_normal() && view.axis().is_finite(), "u = {u}: {width}");
                    if let Some(before) = before.replace(width) {
                        let ratio: f64 = width / before;
                        assert!(u > 1.0 || (ratio.ln()).abs() < 0.2, "u = {u}: the scale jumps by {ratio}");
                    }
                });
            }
        }
    }
}
