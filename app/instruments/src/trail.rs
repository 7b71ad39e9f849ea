//! Trail of a ride: its worldline so far, and events on and off it.

use physics::glam::{DQuat, DVec3};
use physics::worldline::Thrust;
use physics::{Celerity, Event};
use ride::{LightSpeed, RideFrame};

use crate::trail_levels::TrailLevels;
use crate::trail_point::TrailPoint;

/// Least own time between two points, seconds.
const SPACING_S: f64 = 0.05;
/// Largest number of events that are kept; the oldest give way.
const MOST_EVENTS: usize = 32;
/// Distance by which a vehicle may seem to outrun light before that counts as a jump, metres, and as a share of the
/// coordinates, whose rounding it allows for.
const JUMP_M: f64 = 0.05;
const JUMP_SHARE: f64 = 1e-9;

/// Named event of a ride or a tour.
#[derive(Clone, Debug, PartialEq)]
pub struct TrailEvent {
    /// Short name for the diagram, in the interface's language.
    pub name: String,
    /// Place and time, world frame.
    pub event: Event,
}

/// Clock at rest in the world, of which the diagram shows the event whose light arrives now.
#[derive(Clone, Debug, PartialEq)]
pub struct WatchedClock {
    /// Short name for the diagram, in the interface's language.
    pub name: String,
    /// Place of the clock, world metres.
    pub position: DVec3,
}

/// Present state of the rider, as the newest frame shows it.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct PresentMoment {
    /// Event of the vehicle's reference point, world frame.
    pub event: Event,
    /// Celerity of the vehicle, measured in the world.
    pub celerity: Celerity,
    /// Rotation from the axes of the rider's gaze to those of the pure boost from the world.
    pub observer_from_eye: DQuat,
    /// Level unit vector along which the vehicle's nose points, world axes.
    pub heading: DVec3,
    /// Thrust and turn that the rider feels, pilot's axes.
    pub thrust: Thrust,
    /// Speed of light in the world.
    pub light_speed: LightSpeed,
    /// Time on the rider's clock since the start, seconds.
    pub own_s: f64,
    /// Time on the world's clocks since the start, seconds.
    pub world_s: f64,
    /// Real time of the frame, seconds.
    pub real_s: f64,
}

impl PresentMoment {
    /// Moment of a frame.
    pub fn of(frame: &RideFrame) -> Self {
        let (state, odometer) = (frame.vehicle.state(), frame.vehicle.odometer());
        Self {
            event: state.event(),
            celerity: state.celerity,
            observer_from_eye: frame.gaze.observer_from_eye,
            heading: frame.vehicle.heading(),
            thrust: *frame.vehicle.thrust(),
            light_speed: frame.vehicle.light_speed(),
            own_s: odometer.own_s,
            world_s: odometer.world_s,
            real_s: frame.record.at as f64 * 1e-9,
        }
    }
}

/// Worldline of a ride so far, in bounded memory, with the events that belong to it.
#[derive(Clone, Debug, Default)]
pub struct Trail {
    points: TrailLevels,
    events: Vec<TrailEvent>,
    clocks: Vec<WatchedClock>,
    present: Option<PresentMoment>,
    start: Option<Event>,
}

impl Trail {
    /// Adds a frame of the ride. A restart, seen by the own clock that goes back, begins a new trail, and so does
    /// another speed of light, which makes it another world; the clocks that are watched stay. A jump begins a new
    /// line.
    pub fn note(&mut self, frame: &RideFrame) {
        self.note_moment(PresentMoment::of(frame));
    }

    /// Adds a moment of the ride, as [`Trail::note`] does.
    pub fn note_moment(&mut self, now: PresentMoment) {
        if self.present.is_some_and(|before| now.own_s < before.own_s || now.light_speed != before.light_speed) {
            *self = Self { clocks: std::mem::take(&mut self.clocks), ..Self::default() };
        }
        let jumped = self.present.is_some_and(|before| is_jump(before.event, now.event));
        let is_due = self.points.last().is_none_or(|last| now.own_s - last.own_s >= SPACING_S);
        if is_due || jumped {
            let begins = jumped || self.points.len() == 0;
            self.points.push(TrailPoint { event: now.event, own_s: now.own_s, begins });
        }
        self.start.get_or_insert(now.event);
        self.present = Some(now);
    }

    /// Adds a named event; of more than a few dozen the oldest are forgotten.
    pub fn mark(&mut self, name: impl Into<String>, event: Event) {
        if self.events.len() >= MOST_EVENTS {
            self.events.remove(0);
        }
        self.events.push(TrailEvent { name: name.into(), event });
    }

    /// Forgets all named events, as at the beginning of a tour.
    pub fn clear_marks(&mut self) {
        self.events.clear();
    }

    /// Sets the clocks whose light is watched.
    pub fn watch(&mut self, clocks: Vec<WatchedClock>) {
        self.clocks = clocks;
    }

    /// Present moment; `None` before the first frame.
    pub fn present(&self) -> Option<&PresentMoment> {
        self.present.as_ref()
    }

    /// First event of the ride.
    pub fn start(&self) -> Option<Event> {
        self.start
    }

    /// Named events, the oldest first.
    pub fn events(&self) -> &[TrailEvent] {
        &self.events
    }

    /// Events whose light arrives now from the clocks that are watched, with their names.
    pub fn seen_now(&self) -> impl Iterator<Item = (&str, Event)> {
        let now = self.present.map(|present| present.event);
        self.clocks.iter().filter_map(move |clock| {
            let now = now?;
            let event = Event { ct: now.ct - now.position.distance(clock.position), position: clock.position };
            Some((clock.name.as_str(), event))
        })
    }

    /// Points of the worldline, the oldest first, and the present one.
    pub fn points(&self) -> impl Iterator<Item = TrailPoint> {
        let now = self.present.map(|now| TrailPoint { event: now.event, own_s: now.own_s, begins: false });
        self.points.iter().copied().chain(now)
    }

    /// Points since the own time `from_s`, the oldest first, and the present one. The first lies before that time,
    /// where there is such a point.
    pub fn points_since(&self, from_s: f64) -> Vec<TrailPoint> {
        let mut recent = Vec::new();
        for point in self.points.iter().rev() {
            recent.push(*point);
            if point.own_s < from_s {
                break;
            }
        }
        recent.reverse();
        recent.extend(self.present.map(|now| TrailPoint { event: now.event, own_s: now.own_s, begins: false }));
        recent
    }

    /// Number of points that are kept.
    pub fn point_count(&self) -> usize {
        self.points.len()
    }
}

/// True if no vehicle can come from one event to the other.
fn is_jump(from: Event, to: Event) -> bool {
    let way = to - from;
    let coordinates = from.ct.abs() + from.position.abs().max_element();
    let rounding = JUMP_M + JUMP_SHARE * coordinates;
    way.t < -rounding || way.r.length() > way.t.max(0.0) + rounding
}

#[cfg(test)]
mod tests {
    //! Law: a trail is the worldline, whatever its length: its ends are exact, its corners are kept, its memory is
    //! bounded, and a jump is not drawn as a line. A wrong program grows by the hour, or cuts the corners of the path.

    use super::*;

    /// Moment of a ride at rest at `position`, at the own and world time `at_s`, at a speed of light of 1 m/s.
    fn moment(at_s: f64, position: DVec3) -> PresentMoment {
        PresentMoment {
            event: Event { ct: at_s, position },
            celerity: Celerity::ZERO,
            observer_from_eye: DQuat::IDENTITY,
            heading: DVec3::NEG_Z,
            thrust: Thrust::default(),
            light_speed: LightSpeed::new(1.0).unwrap(),
            own_s: at_s,
            world_s: at_s,
            real_s: at_s,
        }
    }

    #[test]
    fn hours_of_a_ride_keep_their_corners_in_bounded_memory() {
        let mut trail = Trail::default();
        // Four hours at 60 frames a second: one straight way out and one back, with a corner at two hours.
        let frames = 4 * 3600 * 60;
        for frame in 0..=frames {
            let at_s = f64::from(frame) / 60.0;
            let x = 0.5 * (7200.0 - (at_s - 7200.0).abs());
            trail.note_moment(moment(at_s, DVec3::X * x));
        }
        assert!(trail.point_count() < 12_000, "{} points", trail.point_count());
        let points: Vec<TrailPoint> = trail.points().collect();
        assert_eq!((points[0].event.ct, points[points.len() - 1].event.ct), (0.0, 14_400.0));
        assert!(points.windows(2).all(|pair| pair[0].event.ct <= pair[1].event.ct), "in order");
        let farthest = points.iter().map(|point| point.event.position.x).fold(0.0, f64::max);
        assert!(farthest > 3600.0 - 0.1, "the corner is cut at {farthest}");
        assert_eq!(points.iter().filter(|point| point.begins).count(), 1);
    }

    #[test]
    fn a_restart_begins_anew_and_a_jump_begins_a_line() {
        let mut trail = Trail::default();
        for frame in 0..10 {
            trail.note_moment(moment(f64::from(frame), DVec3::ZERO));
        }
        trail.note_moment(moment(10.0, DVec3::X * 50.0));
        let begins: Vec<f64> = trail.points().filter(|point| point.begins).map(|point| point.own_s).collect();
        assert_eq!(begins, [0.0, 10.0]);
        trail.mark("bell", Event::default());
        trail.watch(vec![WatchedClock { name: "tower".to_owned(), position: DVec3::X }]);
        trail.note_moment(moment(0.0, DVec3::Y));
        assert_eq!((trail.point_count(), trail.start().unwrap().position), (1, DVec3::Y));
        assert_eq!((trail.events().len(), trail.seen_now().count()), (0, 1));
    }

    #[test]
    fn light_of_a_clock_left_it_when_it_had_to() {
        let mut trail = Trail::default();
        trail.note_moment(moment(7.0, DVec3::ZERO));
        trail.watch(vec![WatchedClock { name: "gate".to_owned(), position: DVec3::new(3.0, 0.0, 4.0) }]);
        let seen: Vec<(&str, Event)> = trail.seen_now().collect();
        assert_eq!(seen, [("gate", Event { ct: 2.0, position: DVec3::new(3.0, 0.0, 4.0) })]);
        assert_eq!((seen[0].1 - trail.present().unwrap().event).interval(), 0.0);
    }

    #[test]
    fn the_points_since_a_time_reach_back_to_it() {
        let mut trail = Trail::default();
        for frame in 0..100 {
            trail.note_moment(moment(f64::from(frame), DVec3::ZERO));
        }
        let recent = trail.points_since(90.5);
        assert_eq!((recent[0].own_s, recent[1].own_s, recent.len()), (90.0, 91.0, 11));
    }
}
