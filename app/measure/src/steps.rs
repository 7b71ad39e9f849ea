//! Integrator and step: the error of a worldline in steps of frames, against a ride of which every point is known.
//!
//! The built-in rider goes round the scene's circuit, or round a circle if the scene has none. Its celerity is taken
//! at every fifth of a second, where steps of all lengths end. Cubic polynomials of proper time join these
//! celerities. Their integral is the exact place of the ride, and their slope gives the thrust that keeps the rider
//! there,
//!
//! ```text
//! a = u̇ − u (u·u̇) / (γ (1 + γ))
//! ```
//!
//! (the inverse of u̇ = a + u (u·a)/(1 + γ), W 4.7). Each integrator is given that thrust, as a function of proper
//! time, and nothing else.

use std::sync::Arc;
use std::time::Instant;

use glam::DVec3;
use input::{BicycleConfig, DeskConfig, SECOND, VehicleKind};
use physics::worldline::{DormandPrince, Exact, Integrator, Rk4, Thrust, WorldlineError, WorldlineState};
use physics::{Celerity, Event};

use super::table::{Line, Markdown};
use super::views::Views;
use crate::error::MeasureError;
use ride::{LightSpeed, RideStart, Setup, SetupError, Simulation, Tour, VehicleSettings};
use scene::OpenPlane;

/// Rates of the steps, steps per second.
const RATES: [u32; 4] = [240, 60, 30, 15];
/// Length of the ride, seconds; then the number of knots per second.
const SECONDS: u32 = 20;
const KNOTS_PER_SECOND: u32 = 5;
/// Time until the rider is under way, and time of the comparison after that, seconds. Slopes at the end need a knot
/// beyond.
const BEGINNING_S: u32 = 5;
const FOLLOWED_S: u32 = 14;
/// Corners of the circle, and its radius, metres.
const CORNERS: u32 = 32;
const RADIUS_M: f64 = 15.0;

/// Measures all integrators at all rates.
///
/// # Errors
/// A worldline that cannot be integrated.
pub fn measure(Views { scene, light_speed, .. }: &Views) -> Result<(String, Vec<Line>), MeasureError> {
    let ride = Ride::of(&scene.circuit, *light_speed)?;
    let strict = DormandPrince::default();
    let integrators: [(&str, &dyn Integrator); 3] = [("rk4", &Rk4), ("exact", &Exact), ("dopri5", &strict)];
    let mut table = Markdown::new(&["integrator", "step", "ns a step", "off by, m", "rapidity"]);
    let mut lines = Vec::new();
    for (name, integrator) in integrators {
        for rate in RATES {
            let steps = FOLLOWED_S * rate;
            let began = Instant::now();
            let states = ride.follow(integrator, light_speed.metres(1.0 / f64::from(rate)), steps)?;
            let ns = began.elapsed().as_secs_f64() * 1e9 / f64::from(steps);
            let errors = states.iter().map(|state| ride.strayed(state));
            let [position_m, rapidity] = errors.fold([0.0_f64; 2], |[a, b], [c, d]| [a.max(c), b.max(d)]);
            table.add(vec![
                format!("--integrator {name}"),
                format!("1/{rate} s"),
                format!("{ns:.0}"),
                format!("{position_m:.1e}"),
                format!("{rapidity:.1e}"),
            ]);
            let numbers = vec![("ns", ns), ("position_m", position_m), ("rapidity", rapidity)];
            lines.push(Line {
                dial: "integrator",
                setting: format!("--integrator {name} in steps of 1/{rate} s"),
                numbers,
            });
        }
    }
    Ok((table.text(), lines))
}

/// A ride: celerity as a function of proper time.
struct Ride {
    /// Proper time between knots, metres of light travel.
    spacing: f64,
    celerities: Vec<DVec3>,
}

impl Ride {
    /// Ride of the built-in rider, once it is under way.
    fn of(circuit: &[DVec3], light_speed: LightSpeed) -> Result<Self, SetupError> {
        let angle = |corner: u32| std::f64::consts::TAU * f64::from(corner) / f64::from(CORNERS);
        let ring: Vec<DVec3> =
            (0..CORNERS).map(|corner| RADIUS_M * DVec3::new(angle(corner).cos(), 0.0, -angle(corner).sin())).collect();
        let (circuit, mut tour) = match Tour::new(circuit, &BicycleConfig::default()) {
            Some(tour) => (circuit, tour),
            None => {
                (ring.as_slice(), Tour::new(&ring, &BicycleConfig::default()).expect("a circle has corners enough"))
            }
        };
        let setup = Setup {
            light_speed,
            kind: VehicleKind::Bicycle,
            start: RideStart::at_rest(circuit[0], circuit[1] - circuit[0], DVec3::Y),
            vehicle: VehicleSettings::default(),
            desk: DeskConfig::default(),
        };
        let mut simulation = Simulation::new(setup, Arc::new(OpenPlane))?;
        let mut celerities = Vec::new();
        for frame in 0..=u64::from(SECONDS * 60) {
            let at = frame * SECOND / 60;
            let samples = tour.samples(simulation.vehicle(), at);
            let shown = simulation.frame(at, &samples);
            if frame.is_multiple_of(u64::from(60 / KNOTS_PER_SECOND)) {
                celerities.push(shown.vehicle.state().celerity.vector());
            }
        }
        celerities.drain(..(BEGINNING_S * KNOTS_PER_SECOND) as usize);
        Ok(Self { spacing: light_speed.metres(1.0 / f64::from(KNOTS_PER_SECOND)), celerities })
    }

    /// Last knot before a proper time, and the share of the interval to the next knot that has passed.
    fn place(&self, proper_time: f64) -> (usize, f64) {
        let place = (proper_time / self.spacing).clamp(0.0, (self.celerities.len() - 2) as f64);
        let knot = (place.floor() as usize).min(self.celerities.len() - 2);
        (knot, place - knot as f64)
    }

    /// Celerity, and the displacement since the beginning.
    fn at(&self, proper_time: f64) -> [DVec3; 2] {
        let (knot, t) = self.place(proper_time);
        let whole = (0..knot).map(|knot| self.polynomial(knot).way(1.0)).sum::<DVec3>();
        let polynomial = self.polynomial(knot);
        [polynomial.value(t), (whole + polynomial.way(t)) * self.spacing]
    }

    /// Polynomial from one knot to the next, with the slopes of the chords about them.
    fn polynomial(&self, knot: usize) -> Cubic {
        let at = |knot: usize| self.celerities[knot.min(self.celerities.len() - 1)];
        let slope = |knot: usize| 0.5 * (at(knot + 1) - at(knot.saturating_sub(1)));
        let [from, to, leaving, arriving] = [at(knot), at(knot + 1), slope(knot), slope(knot + 1)];
        Cubic([from, leaving, 3.0 * (to - from) - 2.0 * leaving - arriving, 2.0 * (from - to) + leaving + arriving])
    }

    /// Thrust at a proper time, in the axes of the boost.
    fn acceleration(&self, proper_time: f64) -> DVec3 {
        let (knot, t) = self.place(proper_time);
        let polynomial = self.polynomial(knot);
        let (celerity, rate) = (polynomial.value(t), polynomial.slope(t) / self.spacing);
        let gamma = (1.0 + celerity.length_squared()).sqrt();
        rate - celerity * (celerity.dot(rate) / (gamma * (1.0 + gamma)))
    }

    /// States after each step.
    fn follow(
        &self,
        integrator: &dyn Integrator,
        step: f64,
        steps: u32,
    ) -> Result<Vec<WorldlineState>, WorldlineError> {
        let start = Celerity::new(self.celerities[0]).unwrap_or_default();
        let mut state = WorldlineState::new(Event::default(), start, glam::DQuat::IDENTITY);
        let control = |state: &WorldlineState| Thrust::in_boost_axes(state, self.acceleration(state.proper_time));
        let mut states = Vec::with_capacity(steps as usize);
        for _ in 0..steps {
            state = integrator.step(&state, step, &control)?;
            states.push(state);
        }
        Ok(states)
    }

    /// Distance of a state from the place of the ride at its proper time, metres, and the rapidity of their relative
    /// motion.
    fn strayed(&self, state: &WorldlineState) -> [f64; 2] {
        let [celerity, way] = self.at(state.proper_time);
        let gamma = |celerity: DVec3| (1.0 + celerity.length_squared()).sqrt();
        let found = state.celerity.vector();
        // |relative celerity|² = |Δu|² − (Δγ)²; Δγ is computed by its quotient, without cancellation.
        let apart = found - celerity;
        let slower = apart.dot(found + celerity) / (gamma(found) + gamma(celerity));
        let relative = (apart.length_squared() - slower * slower).max(0.0).sqrt();
        [state.position.distance(way), relative.asinh()]
    }
}

/// Polynomial c₀ + c₁ t + c₂ t² + c₃ t³.
struct Cubic([DVec3; 4]);

impl Cubic {
    fn value(&self, t: f64) -> DVec3 {
        let [c0, c1, c2, c3] = self.0;
        c0 + t * (c1 + t * (c2 + t * c3))
    }

    fn slope(&self, t: f64) -> DVec3 {
        let [_, c1, c2, c3] = self.0;
        c1 + t * (2.0 * c2 + t * 3.0 * c3)
    }

    /// Integral of the polynomial from 0.
    fn way(&self, t: f64) -> DVec3 {
        let [c0, c1, c2, c3] = self.0;
        t * (c0 + t * (c1 / 2.0 + t * (c2 / 3.0 + t * c3 / 4.0)))
    }
}

#[cfg(test)]
mod tests {
    //! The ride solves the equation of motion, so finer steps come closer to it, by the order of their integrator as
    //! far as the polynomials are smooth. A wrong thrust or a wrong integral leaves an error that no step removes.

    use super::*;
    use scene::Scene;

    #[test]
    fn finer_steps_come_closer_to_the_ride() {
        let views = Views { scene: Scene::default(), light_speed: LightSpeed::OLD_TOWN, shots: Vec::new() };
        let (_, lines) = measure(&views).unwrap();
        let error = |name: &str, rate: u32| {
            let setting = format!("--integrator {name} in steps of 1/{rate} s");
            let line = lines.iter().find(|line| line.setting == setting).unwrap();
            [1, 2].map(|column: usize| line.numbers[column].1)
        };
        for name in ["rk4", "exact"] {
            let ([fine_m, fine], [coarse_m, coarse]) = (error(name, 240), error(name, 15));
            // 16 times finer steps are 256 times closer by the midpoint's second order.
            assert!(fine_m < coarse_m / 100.0 && fine < coarse / 100.0, "{name}: {fine_m} {coarse_m} {fine} {coarse}");
            assert!(coarse_m < 0.1 && fine_m > 0.0, "{name}: {coarse_m}");
        }
        assert!(error("rk4", 60)[0] < error("exact", 60)[0]);
    }
}
