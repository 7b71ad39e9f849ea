//! Law: whoever is in a vehicle that turns and accelerates moves with it, and each eye of a head that turns moves with
//! the head (W 6.3, B 3.4.3). The celerity of an eye is the direction of its own worldline.
//!
//! The worldlines are made here: the vehicle is integrated, places in it are taken to the world by multiplied-out
//! Lorentz matrices at neighbouring moments, and differences of these events give the celerity. A program that takes
//! an eye at rest in a turning room to be at rest is wrong by eleven degrees of aberration; one that uses one clock for
//! vehicle and head is wrong by γ.
#![allow(clippy::unwrap_used, reason = "a failed construction is a failed test")]

use glam::{DMat3, DMat4, DQuat, DVec3, DVec4};
use physics::worldline::{Exact, Integrator, Thrust, WorldlineState};
use physics::{Celerity, Event};
use room::{Display, EyeSide};
use system_tests::lorentz::{boost, four, parts, rotation, space};
use walls::{Occupant, RoomHead};

/// Step of differences, metres of own time.
const STEP: f64 = 1e-4;

/// Error of a symmetric difference with [`STEP`] of quantities that change within a metre.
const DIFFERENCE: f64 = 1e-7;

/// Speed of light of the old town, m/s.
const LIGHT_M_S: f64 = 30.0 / 3.6;

fn vehicle(celerity: DVec3) -> WorldlineState {
    let orientation = DQuat::from_rotation_y(0.4) * DQuat::from_rotation_x(-0.3);
    let event = Event { ct: 0.7, position: DVec3::new(0.375, -1.81875, 0.53125) };
    WorldlineState::new(event, Celerity::new(celerity).unwrap(), orientation)
}

/// Vehicle after `own` metres of its own time with a steady thrust.
fn later(vehicle: &WorldlineState, thrust: Thrust, own: f64) -> WorldlineState {
    Exact.step(vehicle, own, &move |_: &WorldlineState| thrust).unwrap()
}

fn world_from_room(vehicle: &WorldlineState) -> DMat4 {
    boost(-vehicle.celerity.vector()) * rotation(vehicle.orientation)
}

/// Event in the world at a place of the vehicle, at the vehicle's present.
fn event_at(vehicle: &WorldlineState, place: DVec3) -> DVec4 {
    four(vehicle.ct, vehicle.position) + world_from_room(vehicle) * four(0.0, place)
}

/// Minkowski length of a timelike difference.
fn own_time(difference: DVec4) -> f64 {
    (difference.x * difference.x - space(difference).length_squared()).sqrt()
}

/// Celerity along a difference of events.
fn along(difference: DVec4) -> DVec3 {
    space(difference) / own_time(difference)
}

/// Thrusts of rides and flights, up to one that is felt as four times that of a rocket here.
fn thrusts() -> [Thrust; 4] {
    let thrust =
        |acceleration: [f64; 3], turn: [f64; 3]| Thrust { acceleration: acceleration.into(), turn_rate: turn.into() };
    [
        thrust([0.0; 3], [0.0, 0.0, 1.0 / LIGHT_M_S]),
        thrust([0.0, 0.0, -0.1], [0.12, 0.0, 0.0]),
        thrust([0.2, -0.1, 0.05], [0.05, -0.2, 0.1]),
        thrust([0.0, 0.3, 0.0], [0.0, 0.3, 0.0]),
    ]
}

#[test]
fn a_head_at_rest_in_a_turning_vehicle_moves_along_its_own_worldline() {
    for thrust in thrusts() {
        for celerity in [DVec3::ZERO, DVec3::new(-0.9, 0.4, -1.5)] {
            let vehicle = vehicle(celerity);
            let place = DVec3::new(0.3, 1.6, -0.4);
            let event = |own| event_at(&later(&vehicle, thrust, own), place);
            let expected = along(event(STEP) - event(-STEP));
            let found = vehicle.aboard(place, Celerity::ZERO, &thrust);
            let error = (found.celerity.vector() - expected).length();
            assert!(error < DIFFERENCE * (1.0 + expected.length_squared()), "{thrust:?}: {error}");
            let moved = (expected - celerity).length();
            assert!(moved > 0.01, "{thrust:?}: the room has to carry the head along, {moved}");
            // Axes: those of the one boost from the world, after the rotation that two boosts make.
            let carried = thrust.carried(place, Celerity::ZERO).vector();
            let room_from_world = rotation(vehicle.orientation).inverse() * boost(vehicle.celerity.vector());
            let (_, head_from_boosted) = parts(boost(carried) * room_from_world);
            assert!(found.orientation.dot(head_from_boosted.inverse()).abs() > 1.0 - 1e-12, "{thrust:?}");
        }
    }
}

#[test]
fn a_head_that_walks_in_a_turning_vehicle_has_its_own_clock() {
    for thrust in thrusts() {
        let vehicle = vehicle(DVec3::new(-0.9, 0.4, -1.5));
        let place = DVec3::new(0.3, 1.6, -0.4);
        // Metres of the room for each metre of the vehicle's own time.
        let way = DVec3::new(0.3, -0.1, 0.5);
        let event = |own: f64| event_at(&later(&vehicle, thrust, own), place + way * own);
        let difference = event(STEP) - event(-STEP);
        let of_head = own_time(difference) / (2.0 * STEP);
        let celerity = Celerity::new(way / of_head).unwrap();
        let found = vehicle.aboard(place, celerity, &thrust).celerity.vector();
        let expected = along(difference);
        let error = (found - expected).length();
        assert!(error < DIFFERENCE * (1.0 + expected.length_squared()), "{thrust:?}: {error}");
        let ratio = thrust.time_ratio(place, celerity);
        assert!((ratio * of_head - 1.0).abs() < DIFFERENCE, "{thrust:?}: {ratio} for {}", 1.0 / of_head);
    }
}

/// Event of an eye `own` metres of the vehicle's own time later, of a head that rests at its place in the room and
/// turns by `turn` for each metre of the vehicle's own time.
fn eye_event(occupant: &Occupant, offset: DVec3, turn: DVec3, own: f64) -> DVec4 {
    let vehicle = later(&occupant.vehicle, occupant.thrust, own);
    // The head's celerity in the room: from its worldline, too.
    let place = occupant.head.place_m;
    let head = |own: f64| event_at(&later(&occupant.vehicle, occupant.thrust, own), place);
    let carried = boost(vehicle.celerity.vector()) * (head(own + STEP) - head(own - STEP));
    let carried = vehicle.orientation.inverse() * along(carried);
    let world_from_head = world_from_room(&vehicle) * boost(-carried);
    head(own) + world_from_head * four(0.0, DQuat::from_scaled_axis(turn * own) * offset)
}

#[test]
fn the_eyes_of_a_turning_head_move_along_their_own_worldlines() {
    let viewer = Display::built_in("cave4").unwrap().viewer;
    let head = RoomHead { turn_rate: DVec3::new(0.1, 2.0, -0.3) / LIGHT_M_S, ..RoomHead::at_rest(viewer.head_m) };
    let turning = Thrust { turn_rate: DVec3::new(0.02, -0.05, 0.01), acceleration: DVec3::new(0.0, 0.0, -0.05) };
    for (thrust, precision) in [(Thrust::default(), 1e-6), (turning, 2e-4)] {
        let occupant = Occupant { vehicle: vehicle(DVec3::new(-0.9, 0.4, -1.5)), thrust, head };
        for side in [EyeSide::Left, EyeSide::Right] {
            let offset = viewer.world_offset_m(side);
            assert!(offset.length() > 0.03);
            // The head's clock is not the vehicle's where the room turns.
            let turn = head.turn_rate / thrust.time_ratio(head.place_m, Celerity::ZERO);
            let event = |own| eye_event(&occupant, offset, turn, own);
            // A wider step: differences of differences.
            let wide = 10.0 * STEP;
            let expected = along(event(wide) - event(-wide));
            let found = occupant.eye(&viewer, side).observer.celerity.vector();
            let carried = (expected - occupant.vehicle.celerity.vector()).length();
            let error = (found - expected).length();
            assert!(error < precision && carried > 0.005, "{side:?}: {error} of {carried}, {thrust:?}");
        }
    }
}

/// Direction in which an eye sees a star that is in this direction of the world, in the axes of the room.
fn seen(occupant: &Occupant, side: EyeSide, star: DVec3) -> DVec3 {
    let viewer = Display::built_in("cave4").unwrap().viewer;
    let eye = occupant.eye(&viewer, side);
    let light = boost(eye.observer.celerity.vector()) * four(-1.0, star);
    (eye.observer_from_room.inverse() * space(light)).normalize()
}

#[test]
fn a_turning_head_has_the_disparity_of_the_thesis() {
    // 2 rad/s at 30 km/h: the eyes move at ±.0077 c, one ahead and one back, which is .44° thirty degrees off the gaze.
    let viewer = Display::built_in("cave4").unwrap().viewer;
    let still = RoomHead::at_rest(viewer.head_m);
    let turning = RoomHead { turn_rate: DVec3::Y * 2.0 / LIGHT_M_S, ..still };
    let star = DMat3::from_rotation_y(30_f64.to_radians()) * DVec3::NEG_Z;
    let disparity = |head| {
        let vehicle = WorldlineState::new(Event::default(), Celerity::ZERO, DQuat::IDENTITY);
        let occupant = Occupant { vehicle, thrust: Thrust::default(), head };
        seen(&occupant, EyeSide::Left, star).angle_between(seen(&occupant, EyeSide::Right, star)).to_degrees()
    };
    assert!(disparity(still) < 1e-6, "{}", disparity(still));
    assert!((disparity(turning) - 0.44).abs() < 0.01, "{}", disparity(turning));
}

#[test]
fn a_room_that_turns_shows_the_aberration_of_its_turn() {
    // 1 rad/s at 1.6 m is .19 c at 30 km/h: eleven degrees aside.
    let head = RoomHead::at_rest(DVec3::new(0.0, 1.6, 0.0));
    let vehicle = WorldlineState::new(Event::default(), Celerity::ZERO, DQuat::IDENTITY);
    let direction = |turn_rate| {
        let thrust = Thrust { turn_rate, ..Thrust::default() };
        seen(&Occupant { vehicle, thrust, head }, EyeSide::Centre, DVec3::NEG_Z)
    };
    let aside = direction(DVec3::ZERO).angle_between(direction(DVec3::Z / LIGHT_M_S)).to_degrees();
    let expected = (1.6 / LIGHT_M_S).asin().to_degrees();
    assert!((aside - expected).abs() < 1e-6, "{aside} for {expected}");
    assert!(aside > 11.0);
}

#[test]
fn a_still_head_in_a_straight_ride_has_the_bits_of_the_vehicle() {
    let straight = Thrust { acceleration: DVec3::new(0.0, 0.0, -0.3), ..Thrust::default() };
    for celerity in [DVec3::ZERO, DVec3::new(-0.9, 0.4, -1.5), DVec3::new(0.0, 0.0, -1e6)] {
        let vehicle = vehicle(celerity);
        let place = DVec3::new(0.3, 1.6, -0.4);
        let found = vehicle.aboard(place, Celerity::ZERO, &straight);
        assert_eq!(found.observer(), vehicle.observer_at(place));
        assert_eq!(found.orientation, vehicle.orientation);
        assert_eq!(straight.time_ratio(DVec3::Y, Celerity::ZERO), 1.0);
    }
}

#[test]
fn no_turn_and_no_thrust_takes_a_head_to_light() {
    let fast = Thrust { acceleration: DVec3::splat(-1e3), turn_rate: DVec3::splat(1e9) };
    for place in [DVec3::X, DVec3::splat(-1e30), DVec3::new(f64::MAX, 1.0, 0.0)] {
        let walking = Celerity::new(DVec3::new(5.0, 0.0, 1.0)).unwrap();
        let carried = fast.carried(place, walking);
        assert!(carried.vector().is_finite(), "{place}");
        assert!(fast.time_ratio(place, walking).is_finite(), "{place}");
        assert!(vehicle(DVec3::X).aboard(DVec3::X, walking, &fast).celerity.vector().is_finite());
    }
}
