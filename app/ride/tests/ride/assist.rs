//! Law: whoever only holds W rides round the town, and comes free from wherever the ride begins; whoever steers is not
//! disturbed; and without the setting nothing is assisted.
//!
//! A wrong program rides into the wall of the first bend and stays there, turns round in a lane, or fights the rider.

#![allow(clippy::unwrap_used, reason = "helpers of tests, too, may fail the test")]

use std::f64::consts::TAU;
use std::sync::Arc;

use glam::{DQuat, DVec3};
use input::{DeskConfig, KeyboardKey, SECOND, Sample, SampleSource, VehicleKind};
use ride::{AssistMode, LightSpeed, RideFrame, RideStart, Setup, Simulation, VehicleSettings};
use scene::{Ground, Surroundings, Wall};

use crate::town::TOWN;

/// Frames per second.
const RATE: u64 = 60;

fn setup(kind: VehicleKind, speed_of_light_m_s: f64, start: RideStart, assist: AssistMode) -> Setup {
    Setup {
        light_speed: LightSpeed::new(speed_of_light_m_s).unwrap(),
        kind,
        start,
        vehicle: VehicleSettings { assist, ..VehicleSettings::default() },
        desk: DeskConfig::default(),
    }
}

/// Frames of a ride with these samples.
fn ridden(setup: Setup, place: Arc<dyn Surroundings>, samples: &[Sample], seconds: u64) -> Vec<RideFrame> {
    let mut simulation = Simulation::new(setup, place).unwrap();
    let frame = |n: u64| simulation.frame(n * SECOND / RATE, if n == 0 { samples } else { &[] });
    (0..=RATE * seconds).map(frame).collect()
}

fn pedalling() -> Vec<Sample> {
    vec![Sample::key(0, KeyboardKey::W, true)]
}

fn speed_m_s(frame: &RideFrame) -> f64 {
    frame.vehicle.light_speed().metres_per_own_second(frame.vehicle.state().celerity.magnitude())
}

/// Longest time without a break below a speed, seconds, after the start.
fn longest_below(frames: &[RideFrame], least_m_s: f64) -> f64 {
    let (mut longest, mut now) = (0_u64, 0);
    for frame in &frames[4 * RATE as usize..] {
        now = if speed_m_s(frame) < least_m_s { now + 1 } else { 0 };
        longest = longest.max(now);
    }
    longest as f64 / RATE as f64
}

/// Start at a corner of the town's circuit, with the nose turned to the left of it.
fn in_town(corner: usize, turned: f64) -> RideStart {
    let circuit = &TOWN.0.circuit;
    let along = circuit[(corner + 1) % circuit.len()] - circuit[corner];
    RideStart::at_rest(circuit[corner], DQuat::from_rotation_y(turned) * along, DVec3::Y)
}

#[test]
fn a_held_key_rides_round_the_town() {
    let (scene, town) = &*TOWN;
    for (kind, speed_of_light) in [VehicleKind::Bicycle, VehicleKind::Drive]
        .into_iter()
        .flat_map(|kind| [(kind, 30.0 / 3.6), (kind, 10.0), (kind, 3e8)])
    {
        let setup = setup(kind, speed_of_light, in_town(0, 0.0), AssistMode::Auto);
        let frames = ridden(setup, town.clone(), &pedalling(), 120);
        let slow_s = longest_below(&frames, 1.5);
        assert!(slow_s < 2.0, "{kind:?} at {speed_of_light} m/s: slow for {slow_s} s");
        let passed = |point: &&DVec3| frames.iter().any(|frame| frame.vehicle.state().position.distance(**point) < 4.0);
        let missed = scene.circuit.iter().filter(|point| !passed(point)).count();
        let road = frames.last().unwrap().vehicle.odometer().road_m;
        assert_eq!(missed, 0, "{kind:?} at {speed_of_light} m/s: {road} m of road, of {} corners", scene.circuit.len());
    }
}

#[test]
fn a_ride_comes_free_from_any_heading() {
    let town = &TOWN.1;
    for kind in [VehicleKind::Bicycle, VehicleKind::Drive] {
        for corner in (0..TOWN.0.circuit.len()).step_by(37) {
            for turned in [0.25, 0.5, 0.75] {
                let setup = setup(kind, 30.0 / 3.6, in_town(corner, turned * TAU), AssistMode::Auto);
                let frames = ridden(setup, town.clone(), &pedalling(), 20);
                let road = frames.last().unwrap().vehicle.odometer().road_m;
                let slow_s = longest_below(&frames[5 * RATE as usize..], 1.0);
                assert!(
                    slow_s < 2.0 && road > 30.0,
                    "{kind:?} at corner {corner}, {turned} turns: {slow_s} s, {road} m"
                );
            }
        }
    }
}

/// Streets round a square block of this half width, metres, between walls 7 m apart, with no circuit.
struct Block(f64);

/// Width of the streets round a block, metres.
const WIDTH_M: f64 = 7.0;

impl Surroundings for Block {
    fn height_below(&self, _: DVec3) -> Option<Ground> {
        Some(Ground { height: 0.0, normal: DVec3::Y })
    }

    fn nearest_wall(&self, position: DVec3, reach: f64) -> Option<Wall> {
        let on_square = |half: f64| {
            let clamped = |value: f64| value.clamp(-half, half);
            let [x, z] = [clamped(position.x), clamped(position.z)];
            [DVec3::new(half, 0.0, z), DVec3::new(-half, 0.0, z), DVec3::new(x, 0.0, half), DVec3::new(x, 0.0, -half)]
        };
        let foot = DVec3 { y: 0.0, ..position };
        let places = on_square(self.0).into_iter().chain(on_square(self.0 + WIDTH_M));
        let nearest = places.min_by(|a, b| foot.distance(*a).total_cmp(&foot.distance(*b)))?;
        let distance = foot.distance(nearest);
        (distance <= reach).then(|| Wall { distance, normal: (foot - nearest).normalize_or(DVec3::X) })
    }
}

#[test]
fn walls_alone_show_the_way_round_a_block() {
    for kind in [VehicleKind::Bicycle, VehicleKind::Drive] {
        for (heading, off_m) in [(0.0, 0.0), (0.4, 1.0), (0.25 * TAU, -2.0), (-0.25 * TAU, 2.5), (0.5 * TAU, 0.0)] {
            let half = 20.0;
            let place = DVec3::new(half + 0.5 * WIDTH_M + off_m, 0.0, 3.0);
            let start = RideStart::at_rest(place, DQuat::from_rotation_y(heading) * DVec3::NEG_Z, DVec3::Y);
            let frames =
                ridden(setup(kind, 30.0 / 3.6, start, AssistMode::Auto), Arc::new(Block(half)), &pedalling(), 120);
            let bearing = |frame: &RideFrame| {
                let position = frame.vehicle.state().position;
                position.z.atan2(position.x)
            };
            let turned: f64 = frames
                .windows(2)
                .map(|pair| (bearing(&pair[1]) - bearing(&pair[0]) + 0.5 * TAU).rem_euclid(TAU) - 0.5 * TAU)
                .sum();
            let slow_s = longest_below(&frames, 1.0);
            let rounds = turned.abs() / TAU;
            assert!(
                slow_s < 2.5 && rounds > 1.0,
                "{kind:?} from {heading}, {off_m} m: {slow_s} s slow, {rounds} rounds"
            );
        }
    }
}

#[test]
fn a_vehicle_that_stands_before_a_wall_comes_free() {
    for kind in [VehicleKind::Bicycle, VehicleKind::Drive] {
        for beside_m in [0.41, 0.45, 0.6] {
            let half = 20.0;
            let in_corner = half + WIDTH_M - beside_m;
            let places = [
                (DVec3::new(half + beside_m, 0.0, 3.0), DVec3::NEG_X),
                (DVec3::new(in_corner, 0.0, in_corner), DVec3::new(1.0, 0.0, 1.0)),
                (DVec3::new(in_corner, 0.0, in_corner), DVec3::Z),
            ];
            for (place, nose) in places {
                let start = RideStart::at_rest(place, nose, DVec3::Y);
                let setup = setup(kind, 30.0 / 3.6, start, AssistMode::Auto);
                let frames = ridden(setup, Arc::new(Block(half)), &pedalling(), 20);
                let road = frames.last().unwrap().vehicle.odometer().road_m;
                let slow_s = longest_below(&frames[6 * RATE as usize..], 1.0);
                assert!(slow_s < 2.0 && road > 30.0, "{kind:?} at {place}, nose {nose}: {slow_s} s slow, {road} m");
            }
        }
    }
}

/// Blind alley, open towards +z, and no wider than a bicycle can turn in.
struct Alley;

impl Surroundings for Alley {
    fn height_below(&self, _: DVec3) -> Option<Ground> {
        Some(Ground { height: 0.0, normal: DVec3::Y })
    }

    fn nearest_wall(&self, position: DVec3, reach: f64) -> Option<Wall> {
        let foot = DVec3 { y: 0.0, ..position };
        let along = foot.z.clamp(-1.0, 8.0);
        let end = DVec3::new(foot.x.clamp(-0.9, 0.9), 0.0, -1.0);
        let places = [DVec3::new(0.9, 0.0, along), DVec3::new(-0.9, 0.0, along), end];
        let nearest = places.into_iter().min_by(|a, b| foot.distance(*a).total_cmp(&foot.distance(*b)))?;
        let distance = foot.distance(nearest);
        (distance <= reach).then(|| Wall { distance, normal: (foot - nearest).normalize_or(DVec3::X) })
    }
}

#[test]
fn a_blind_alley_is_left_again() {
    for kind in [VehicleKind::Bicycle, VehicleKind::Drive] {
        let start = RideStart::at_rest(DVec3::new(0.1, 0.0, 4.0), DVec3::NEG_Z, DVec3::Y);
        let frames = ridden(setup(kind, 30.0 / 3.6, start, AssistMode::Auto), Arc::new(Alley), &pedalling(), 60);
        let end = frames.last().unwrap().vehicle.state().position;
        assert!(frames.iter().any(|frame| frame.vehicle.state().position.z > 8.5), "{kind:?} at {end}");
    }
}

#[test]
fn a_hand_that_steers_is_not_disturbed_and_the_assist_returns() {
    let town = &TOWN.1;
    for kind in [VehicleKind::Bicycle, VehicleKind::Drive] {
        let mut keys = pedalling();
        keys.push(Sample::key(4 * SECOND, KeyboardKey::Right, true));
        let with = ridden(setup(kind, 30.0 / 3.6, in_town(0, 0.0), AssistMode::Auto), town.clone(), &keys, 9);
        // While the key turns the handlebar, the vehicle turns as the rider wants it to: to the right.
        let turns = |frame: &RideFrame| frame.vehicle.thrust().turn_rate.y;
        assert!(with[45 * RATE as usize / 10..5 * RATE as usize].iter().all(|frame| turns(frame) < 0.0), "{kind:?}");
        keys.push(Sample::key(5 * SECOND, KeyboardKey::Right, false));
        let after = ridden(setup(kind, 30.0 / 3.6, in_town(0, 0.0), AssistMode::Auto), town.clone(), &keys, 40);
        assert!(longest_below(&after[6 * RATE as usize..], 1.0) < 2.0, "{kind:?}");
        assert!(after.last().unwrap().vehicle.odometer().road_m > 100.0, "{kind:?}");
    }
}

#[test]
fn only_what_is_set_and_only_keys_are_assisted() {
    let town = &TOWN.1;
    let at_wall = |assist, samples: &[Sample]| {
        let start = in_town(0, 0.25 * TAU);
        let frames = ridden(setup(VehicleKind::Bicycle, 30.0 / 3.6, start, assist), town.clone(), samples, 10);
        frames.last().unwrap().record.clone()
    };
    let by_bicycle: Vec<Sample> =
        (0..1000).map(|n| Sample::bytes(n * SECOND / 100, SampleSource::Bicycle, *b"15\n")).collect();
    let unassisted = at_wall(AssistMode::Off, &by_bicycle);
    assert_eq!(unassisted.first_difference(&at_wall(AssistMode::Auto, &by_bicycle)), None);
    assert!(unassisted.first_difference(&at_wall(AssistMode::On, &by_bicycle)).is_some());
    let by_key = at_wall(AssistMode::Off, &pedalling());
    assert!(by_key.first_difference(&at_wall(AssistMode::Auto, &pedalling())).is_some());
}
