//! View of the map: what is up, how far it reaches, and how it follows the ride.

use physics::glam::{DVec2, DVec3};
use physics::{Aberration, Celerity};

use crate::plan_picture::PlanArea;
use crate::trail::{PresentMoment, Trail};

/// Direction that is up on the map.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum MapUp {
    /// North, the world's −z.
    #[default]
    North,
    /// The vehicle's nose.
    Vehicle,
}

/// Time constant with which middle, reach and turn follow, seconds of real time.
const FOLLOW_S: f64 = 0.6;
/// Longest time between two frames that counts, seconds of real time.
const LONGEST_FRAME_S: f64 = 0.25;
/// Room round the vehicle and the plan, as a factor.
const MARGIN: f64 = 1.04;
/// Reach where there is no plan and no way yet, metres.
const LEAST_REACH_M: f64 = 5.0;
/// Number of directions of the field of view, less one.
const RAYS: usize = 24;

/// View of the map.
#[derive(Clone, Debug)]
pub struct MiniatureView {
    /// Direction that is up.
    pub up: MapUp,
    /// Distance round the vehicle that is shown, metres; `None` for the whole plan and the vehicle.
    pub reach_m: Option<f64>,
    /// Horizontal field of view of the picture, radians, full angle.
    pub field_of_view_rad: f64,
    /// True if aberration is on in the picture: the field of view is then wider ahead than it seems.
    pub aberration: bool,
    /// Middle of the map, (x, z), world metres.
    middle: DVec2,
    /// Half the height of the map, metres. 0 before the first frame.
    half_m: f64,
    /// Unit vector that is up, (x, z).
    upward: DVec2,
    /// Own and real time of the last frame, seconds.
    last_s: Option<[f64; 2]>,
}

impl Default for MiniatureView {
    fn default() -> Self {
        Self {
            up: MapUp::default(),
            reach_m: None,
            field_of_view_rad: 90_f64.to_radians(),
            aberration: true,
            middle: DVec2::ZERO,
            half_m: 0.0,
            upward: DVec2::NEG_Y,
            last_s: None,
        }
    }
}

impl MiniatureView {
    /// Follows the ride by one frame over a plan, if there is one. The first frame is taken over at once.
    pub fn follow(&mut self, trail: &Trail, plan: Option<PlanArea>) {
        let Some(now) = trail.present() else { return };
        let restarted = self.last_s.is_none_or(|[own_s, _]| now.own_s < own_s);
        let frame_s = self.last_s.map_or(0.0, |[_, real_s]| (now.real_s - real_s).clamp(0.0, LONGEST_FRAME_S));
        let share = if restarted { 1.0 } else { 1.0 - (-frame_s / FOLLOW_S).exp() };
        self.last_s = Some([now.own_s, now.real_s]);
        let (middle, half_m) = self.wanted(now, trail, plan);
        self.middle = if self.reach_m.is_some() { middle } else { self.middle.lerp(middle, share) };
        let is_new = restarted || self.half_m <= 0.0;
        self.half_m = if is_new { half_m } else { self.half_m * (half_m / self.half_m).powf(share) };
        let upward = match self.up {
            MapUp::North => DVec2::NEG_Y,
            MapUp::Vehicle => in_plan(now.heading).normalize_or(DVec2::NEG_Y),
        };
        // A nose that points straight down the map turns by way of its right.
        let towards = if upward.dot(self.upward) < -0.999 { upward.perp() } else { upward };
        self.upward = self.upward.lerp(towards, share).normalize_or(upward);
    }

    /// Middle and half height that suit the moment.
    fn wanted(&self, now: &PresentMoment, trail: &Trail, plan: Option<PlanArea>) -> (DVec2, f64) {
        let here = in_plan(now.event.position);
        if let Some(reach_m) = self.reach_m {
            return (here, reach_m.max(f64::MIN_POSITIVE));
        }
        // Without a plan the way is the map.
        let way = trail.points().map(|point| in_plan(point.event.position));
        let of_way = || way.fold((here, here), |(least, most), place| (least.min(place), most.max(place)));
        let (least, most) = plan.map_or_else(of_way, |plan| (plan.least.min(here), plan.most.max(here)));
        let half = 0.5 * (most - least);
        let wide = match self.up {
            MapUp::North => half.max_element(),
            MapUp::Vehicle => half.length(),
        };
        (0.5 * (least + most), (MARGIN * wide).max(LEAST_REACH_M))
    }

    /// Middle of the map, (x, z), world metres.
    pub fn middle(&self) -> DVec2 {
        self.middle
    }

    /// Half the height of the map, metres.
    pub fn half_m(&self) -> f64 {
        self.half_m
    }

    /// Place on the map of a place in the world: to the right of the middle and above it, metres.
    pub fn place(&self, position: DVec3) -> DVec2 {
        self.turned(in_plan(position) - self.middle)
    }

    /// Direction on the map, to the right and upward, of a direction (x, z) of the world.
    pub fn turned(&self, way: DVec2) -> DVec2 {
        let right = DVec2::new(-self.upward.y, self.upward.x);
        DVec2::new(way.dot(right), way.dot(self.upward))
    }

    /// Directions in the world, in plan, from which the light in the rider's picture comes, from its left to its right.
    pub fn seen_directions(&self, now: &PresentMoment) -> Vec<DVec2> {
        let half = 0.5 * self.field_of_view_rad.clamp(0.0, 359_f64.to_radians());
        let aberration = Aberration::new(if self.aberration { now.celerity } else { Celerity::ZERO });
        let ray = |index: usize| {
            let angle = half * (2.0 * index as f64 / RAYS as f64 - 1.0);
            let seen = now.observer_from_eye * DVec3::new(angle.sin(), 0.0, -angle.cos());
            in_plan(aberration.world_from_observer(seen).0).normalize_or_zero()
        };
        (0..=RAYS).map(ray).filter(|direction| *direction != DVec2::ZERO).collect()
    }
}

/// Place in plan, (x, z).
pub fn in_plan(position: DVec3) -> DVec2 {
    DVec2::new(position.x, position.z)
}

#[cfg(test)]
mod tests {
    //! Law: north is −z and up, east is +x and right; the sector of a moving observer is that of aberration. A wrong
    //! program mirrors the town.

    use super::*;
    use physics::Event;
    use physics::glam::DQuat;
    use physics::worldline::Thrust;
    use ride::LightSpeed;

    fn moment(heading: DVec3, u: f64) -> PresentMoment {
        PresentMoment {
            event: Event { ct: 0.0, position: DVec3::new(10.0, 1.0, 20.0) },
            celerity: Celerity::new(heading * u).unwrap(),
            observer_from_eye: DQuat::from_rotation_arc(DVec3::NEG_Z, heading),
            heading,
            thrust: Thrust::default(),
            light_speed: LightSpeed::OLD_TOWN,
            own_s: 0.0,
            world_s: 0.0,
            real_s: 0.0,
        }
    }

    fn followed(up: MapUp, now: PresentMoment) -> MiniatureView {
        let mut trail = Trail::default();
        trail.note_moment(now);
        let mut view = MiniatureView { up, reach_m: Some(50.0), ..MiniatureView::default() };
        view.follow(&trail, None);
        view
    }

    #[test]
    fn north_is_up_or_the_nose_is() {
        let north = followed(MapUp::North, moment(DVec3::X, 0.0));
        assert_eq!(north.place(DVec3::new(13.0, 5.0, 16.0)), DVec2::new(3.0, 4.0));
        let nose = followed(MapUp::Vehicle, moment(DVec3::X, 0.0));
        // East is ahead, north to the left.
        assert_eq!(nose.place(DVec3::new(13.0, 5.0, 16.0)), DVec2::new(-4.0, 3.0));
    }

    #[test]
    fn the_sector_is_that_of_aberration() {
        // At β = 0.6, κ = 2: tan θ'/2 = tan θ/2 / 2. What is seen at 45° comes from 2 atan(2 tan 22.5°) = 79.28°.
        let now = moment(DVec3::NEG_Z, 0.75);
        let view = followed(MapUp::North, now);
        let directions = view.seen_directions(&now);
        let angle = |direction: DVec2| direction.x.atan2(-direction.y).to_degrees();
        let expected = (2.0 * (2.0 * 22.5_f64.to_radians().tan()).atan()).to_degrees();
        assert!((angle(directions[0]) + expected).abs() < 1e-9, "{}", angle(directions[0]));
        assert!((angle(directions[RAYS]) - expected).abs() < 1e-9);
        let still = MiniatureView { aberration: false, ..view }.seen_directions(&now);
        assert!((angle(still[RAYS]) - 45.0).abs() < 1e-9);
    }

    #[test]
    fn the_whole_plan_and_the_vehicle_are_on_the_map() {
        let mut trail = Trail::default();
        trail.note_moment(moment(DVec3::X, 1e6));
        let area = PlanArea { least: DVec2::splat(-100.0), most: DVec2::new(5.0, 100.0) };
        let mut view = MiniatureView::default();
        view.follow(&trail, Some(area));
        for place in [DVec3::new(-100.0, 0.0, -100.0), DVec3::new(5.0, 0.0, 100.0), DVec3::new(10.0, 1.0, 20.0)] {
            assert!(view.place(place).abs().max_element() <= view.half_m(), "{place}");
        }
    }
}
