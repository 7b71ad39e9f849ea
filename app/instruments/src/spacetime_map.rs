//! Map from events to the diagram's plane: across, one direction of space; upward, time; both in metres of light
//! travel.

use physics::glam::DVec3;
use physics::{Boost, Event, FourVector, Observer};

use crate::diagram_frame::DiagramFrame;

/// Place in the diagram relative to the present event, metres.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct DiagramPlace {
    /// Distance along the diagram's axis of space.
    pub x: f64,
    /// Time ct.
    pub t: f64,
}

/// Map from events to the diagram, for one present event.
///
/// In the world's frame a displacement (t, r) from the present event has the place (r·n, t), n being the unit vector of
/// the axis. In the vehicle's frame it is boosted first. Light along the axis goes at 45° in either.
#[derive(Clone, Copy, Debug)]
pub struct SpacetimeMap {
    present: Event,
    axis: DVec3,
    /// Part of β along the axis.
    beta: f64,
    frame: DiagramFrame,
    vehicle_from_world: Boost,
}

impl SpacetimeMap {
    /// Map about the present event of an observer, along the unit vector `axis`, in the axes of the world; those of the
    /// vehicle's frame are a pure boost's.
    pub fn new(observer: &Observer, axis: DVec3, frame: DiagramFrame) -> Self {
        let beta = observer.celerity.beta().vector().dot(axis);
        Self { present: observer.event, axis, beta, frame, vehicle_from_world: observer.observer_from_world() }
    }

    /// Place of an event.
    pub fn place(&self, event: Event) -> DiagramPlace {
        self.place_of(event - self.present)
    }

    /// Place of a displacement from the present event, given in the world's frame.
    pub fn place_of(&self, displacement: FourVector) -> DiagramPlace {
        let FourVector { t, r } = match self.frame {
            DiagramFrame::World => displacement,
            DiagramFrame::Vehicle => self.vehicle_from_world.apply(displacement),
        };
        DiagramPlace { x: r.dot(self.axis), t }
    }

    /// Slope dt/dx of the rider's simultaneity: the part of β along the axis in the world's frame, 0 in the vehicle's.
    pub fn now_slope(&self) -> f64 {
        match self.frame {
            DiagramFrame::World => self.beta,
            DiagramFrame::Vehicle => 0.0,
        }
    }

    /// Slope dt/dx of the world's simultaneity: 0 in the world's frame, −β in the vehicle's.
    pub fn world_now_slope(&self) -> f64 {
        match self.frame {
            DiagramFrame::World => 0.0,
            DiagramFrame::Vehicle => -self.beta,
        }
    }

    /// Direction dx/dt in which the rider goes on: β along the axis in the world's frame, 0 in the vehicle's.
    pub fn motion(&self) -> f64 {
        self.now_slope()
    }

    /// Direction dx/dt of what rests in the world: 0 in the world's frame, −β in the vehicle's.
    pub fn world_rest(&self) -> f64 {
        self.world_now_slope()
    }
}

#[cfg(test)]
mod tests {
    //! Law: the diagram is the Lorentz transformation, drawn. At β = 0.6 all numbers are exact. A wrong program draws
    //! light at another angle, or the line of simultaneity with the slope of the worldline.

    use super::*;
    use physics::Celerity;

    fn observer(u: f64) -> Observer {
        let event = Event { ct: 7.0, position: DVec3::new(1.0, 2.0, 3.0) };
        Observer { event, celerity: Celerity::new(DVec3::X * u).unwrap() }
    }

    fn map(u: f64, frame: DiagramFrame) -> SpacetimeMap {
        SpacetimeMap::new(&observer(u), DVec3::X, frame)
    }

    #[test]
    fn events_go_where_the_lorentz_matrix_puts_them() {
        // γ = 1.25, γβ = 0.75: t' = 1.25 t − 0.75 x, x' = 1.25 x − 0.75 t.
        for (t, x) in [(4.0, 0.0), (0.0, 4.0), (-8.0, 3.0), (5.0, 3.0), (-4.0, -4.0)] {
            let displacement = FourVector { t, r: DVec3::new(x, 5.0, -6.0) };
            let world = map(0.75, DiagramFrame::World).place_of(displacement);
            assert_eq!(world, DiagramPlace { x, t });
            let vehicle = map(0.75, DiagramFrame::Vehicle).place_of(displacement);
            assert!((vehicle.t - (1.25 * t - 0.75 * x)).abs() < 1e-14, "{t} {x}: {vehicle:?}");
            assert!((vehicle.x - (1.25 * x - 0.75 * t)).abs() < 1e-14, "{t} {x}: {vehicle:?}");
        }
        let present = observer(0.75).event;
        assert_eq!(map(0.75, DiagramFrame::Vehicle).place(present), DiagramPlace::default());
    }

    #[test]
    fn light_goes_at_45_degrees_in_both_frames_at_any_speed() {
        for u in [0.0, 0.75, -0.75, 7.0, 1e3, 1e6] {
            for frame in [DiagramFrame::World, DiagramFrame::Vehicle] {
                for (t, x) in [(1.0, 1.0), (-1.0, 1.0), (-3.0, -3.0), (2.0, -2.0)] {
                    let place = map(u, frame).place_of(FourVector { t, r: DVec3::X * x });
                    assert!((place.t.abs() / place.x.abs() - 1.0).abs() < 1e-15, "u = {u}: {place:?}");
                    assert!(place.t * t > 0.0, "past stays past");
                }
            }
        }
    }

    #[test]
    fn the_line_of_simultaneity_has_the_slope_beta() {
        let world = map(0.75, DiagramFrame::World);
        assert_eq!((world.now_slope(), world.world_now_slope()), (0.6, 0.0));
        let vehicle = map(0.75, DiagramFrame::Vehicle);
        assert_eq!((vehicle.now_slope(), vehicle.world_now_slope()), (0.0, -0.6));
        // An event on that line is at the time 0 of the vehicle, and the other way round.
        let on_line = FourVector { t: 0.6 * 5.0, r: DVec3::X * 5.0 };
        assert!(vehicle.place_of(on_line).t.abs() < 1e-15);
        let world_now = vehicle.place_of(FourVector { t: 0.0, r: DVec3::X * 4.0 });
        assert_eq!(world_now.t / world_now.x, vehicle.world_now_slope());
    }

    #[test]
    fn the_own_time_of_what_rests_in_the_vehicle_is_upright_there() {
        for u in [0.0, 0.75, 1e3, 1e6] {
            let celerity = observer(u).celerity;
            let tick = FourVector { t: celerity.gamma(), r: celerity.vector() };
            let place = map(u, DiagramFrame::Vehicle).place_of(tick);
            // The own rounding of γ and u is multiplied by γ.
            let tolerance = 4.0 * f64::EPSILON * celerity.gamma() * celerity.gamma();
            assert!((place.t - 1.0).abs() <= tolerance && place.x.abs() <= tolerance, "u = {u}: {place:?}");
        }
    }

    #[test]
    fn motion_across_the_axis_tilts_nothing() {
        let observer = Observer { celerity: Celerity::new(DVec3::Z * 0.75).unwrap(), ..observer(0.0) };
        let map = SpacetimeMap::new(&observer, DVec3::X, DiagramFrame::Vehicle);
        assert_eq!((map.now_slope(), map.world_now_slope()), (0.0, 0.0));
        let place = map.place_of(FourVector { t: 0.0, r: DVec3::X });
        assert_eq!(place, DiagramPlace { x: 1.0, t: 0.0 });
    }
}
