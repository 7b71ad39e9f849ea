//! Cost of a step along a worldline, by integrator: per step, and for the same error.
//!
//! The first group answers whether an integrator can run at 240 Hz or faster in real time; the second which one is
//! cheapest for a given accuracy: one unit of proper time at 10 units of thrust, in as few steps as keep the rapidity
//! within 1e-7, each integrator at the step that it needs.

use std::hint::black_box;

use criterion::{Criterion, criterion_group, criterion_main};
use physics::glam::{DQuat, DVec3};
use physics::worldline::{
    Control, DormandPrince, Exact, FacingMotion, Integrator, Rk4, Thrust, Transport, WorldlineState, travel,
};
use physics::{Celerity, Event};

/// A rider's step, 1/240 s at 30 km/h for light: 35 mm of light time.
const STEP: f64 = 0.035;

fn cruising() -> WorldlineState {
    let celerity = Celerity::new(DVec3::new(0.3, 0.1, -1.2)).expect("a finite celerity");
    WorldlineState::new(Event::default(), celerity, DQuat::from_rotation_y(0.4))
}

fn one_step(criterion: &mut Criterion) {
    let thrust = Thrust { acceleration: DVec3::new(0.5, 0.1, -1.0), turn_rate: DVec3::new(0.2, -0.7, 0.1) };
    let facing = Transport::FacingMotion(FacingMotion { softening: 0.05, alignment: 5.0 });
    let following = move |state: &WorldlineState| facing.thrust(state, DVec3::new(0.5, 0.0, -1.0));
    let controls: [(&str, &dyn Control); 3] =
        [("coasting", &Thrust::default()), ("constant", &thrust), ("facing", &following)];
    let integrators: [(&str, &dyn Integrator); 3] =
        [("rk4", &Rk4), ("exact", &Exact), ("dopri5", &DormandPrince::default())];
    let mut group = criterion.benchmark_group("worldline/step");
    for (control_name, control) in controls {
        for (name, integrator) in integrators {
            let state = cruising();
            group.bench_function(format!("{name}/{control_name}"), |bencher| {
                bencher.iter(|| integrator.step(black_box(&state), black_box(STEP), control));
            });
        }
    }
    group.finish();
}

fn equal_error(criterion: &mut Criterion) {
    /// Largest error of the rapidity, which should be 10.
    const LARGEST_ERROR: f64 = 1e-7;
    let thrust = Thrust { acceleration: DVec3::new(6.0, 0.0, 8.0), turn_rate: DVec3::ZERO };
    let strict = DormandPrince::new(1e-9).expect("a tolerance within bounds");
    let integrators: [(&str, &dyn Integrator); 3] = [("rk4", &Rk4), ("exact", &Exact), ("dopri5", &strict)];
    let mut group = criterion.benchmark_group("worldline/unit-at-error-1e-7");
    for (name, integrator) in integrators {
        let journey = |steps: u32| travel(integrator, &WorldlineState::default(), 1.0, 1.0 / f64::from(steps), &thrust);
        let within =
            |steps: &u32| journey(*steps).is_ok_and(|end| (end.celerity.rapidity() - 10.0).abs() < LARGEST_ERROR);
        let steps = (1..1000).find(within).expect("every integrator gets there in 1000 steps");
        group.bench_function(format!("{name}/{steps}-steps"), |bencher| {
            bencher.iter(|| journey(black_box(steps)));
        });
    }
    group.finish();
}

criterion_group!(benches, one_step, equal_error);
criterion_main!(benches);
