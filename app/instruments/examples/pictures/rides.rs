//! Rides for the pictures and the benchmark: steady motion, there and back, and a tour of the old town.

use std::sync::Arc;

use input::{BicycleConfig, DeskConfig, SECOND, VehicleKind};
use instruments::{PresentMoment, Trail};
use physics::glam::{DQuat, DVec3};
use physics::worldline::{Exact, Thrust, WorldlineState, travel};
use physics::{Beta, Event};
use ride::{LightSpeed, RideStart, Setup, Simulation, Tour, VehicleSettings};
use scene::Scene;
use scene::collision::Collision;

/// Frames of a ride per second.
const RATE: u64 = 30;

/// Moments of a ride under thrusts along x, each in rapidity per second and for so many seconds, from a speed on.
pub fn straight(beta: f64, light_m_s: f64, thrusts: &[(f64, f64)]) -> Vec<PresentMoment> {
    let light_speed = LightSpeed::new(light_m_s).unwrap();
    let celerity = Beta::new(DVec3::X * beta).unwrap().celerity();
    let nose = DQuat::from_rotation_y(-std::f64::consts::FRAC_PI_2);
    let mut state = WorldlineState::new(Event::default(), celerity, DQuat::IDENTITY);
    let (mut moments, mut frames, mut world_s) = (Vec::new(), 0_u64, 0.0);
    for &(per_s, seconds) in thrusts {
        let thrust = Thrust { acceleration: DVec3::X * per_s / light_m_s, turn_rate: DVec3::ZERO };
        for _ in 0..(seconds * RATE as f64) as u64 {
            let own_s = frames as f64 / RATE as f64;
            moments.push(PresentMoment {
                event: state.event(),
                celerity: state.celerity,
                observer_from_eye: nose,
                heading: DVec3::X,
                thrust,
                light_speed,
                own_s,
                world_s,
                real_s: own_s,
            });
            world_s += state.celerity.gamma() / RATE as f64;
            state = travel(&Exact, &state, light_m_s / RATE as f64, f64::MAX, &thrust).unwrap();
            frames += 1;
        }
    }
    moments
}

/// Moments of the scripted tour of a scene, for so many seconds.
pub fn tour(scene: &Scene, seconds: u64) -> Vec<PresentMoment> {
    let setup = Setup {
        light_speed: LightSpeed::OLD_TOWN,
        kind: VehicleKind::Bicycle,
        start: RideStart::at_rest(scene.circuit[0], scene.circuit[1] - scene.circuit[0], DVec3::Y),
        vehicle: VehicleSettings::default(),
        desk: DeskConfig::default(),
    };
    let mut tour = Tour::new(&scene.circuit, &BicycleConfig::default()).unwrap();
    let mut simulation = Simulation::new(setup, Arc::new(Collision::new(scene).unwrap())).unwrap();
    let moment = |frame: u64| {
        let at = frame * SECOND / RATE;
        let samples = tour.samples(simulation.vehicle(), at);
        PresentMoment::of(&simulation.frame(at, &samples))
    };
    (0..seconds * RATE).map(moment).collect()
}

/// Trail of some moments. `each` sees it after every one.
pub fn trail(moments: &[PresentMoment], mut each: impl FnMut(&Trail)) -> Trail {
    let mut trail = Trail::default();
    for moment in moments {
        trail.note_moment(*moment);
        each(&trail);
    }
    trail
}
