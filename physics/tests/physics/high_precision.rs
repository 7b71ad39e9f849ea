//! Law: the plain textbook formulas, evaluated in 600-bit arithmetic, where what cancels has bits to spare. A program
//! that computes them in f64 would be off by ε γ² in direction astern, which is everything from γ = 1e8 on.

use exact_reference::light::{boosted_light, retarded};
use exact_reference::random::{direction, direction_off, seeded, size, vector};
use exact_reference::real::{RealVec, angle, gamma, real, relative, to_f64};
use physics::glam::DVec3;
use physics::{Aberration, Beta, Boost, Celerity, Event, FourVector, Observer, PointSource, apparent, compose};
use rand::RngExt;
use rand_chacha::ChaCha8Rng;

use crate::support::{EPSILON, celerity};

/// Largest errors met.
#[derive(Debug, Default)]
struct Worst {
    direction: f64,
    distance: f64,
    doppler: f64,
    emission: f64,
}

impl Worst {
    fn meet(&mut self, other: &Self) {
        self.direction = self.direction.max(other.direction);
        self.distance = self.distance.max(other.distance);
        self.doppler = self.doppler.max(other.doppler);
        self.emission = self.emission.max(other.emission);
    }

    fn check(&self, what: &str) {
        /// Angle of the rounding of the three components, of the split and of the last sum; radians.
        const DIRECTION: f64 = 1e-15;
        /// Relative error of some ten roundings.
        const RELATIVE: f64 = 12.0 * EPSILON;
        println!("{what}: {self:?}");
        assert!(self.direction < DIRECTION, "{what}: {self:?}");
        assert!(self.distance.max(self.doppler).max(self.emission) < RELATIVE, "{what}: {self:?}");
    }
}

/// A displacement in any direction, dead ahead, dead astern, or 1e-12 to 1 rad off astern, by turns.
fn displacement(random: &mut ChaCha8Rng, u: Celerity, case: u32) -> DVec3 {
    let distance = size(random, -6.0..9.0);
    let astern = -u.vector().normalize();
    distance
        * match case % 4 {
            0 => direction(random),
            1 => -astern,
            2 => astern,
            _ => {
                let angle = size(random, -12.0..0.0);
                direction_off(random, astern, angle)
            }
        }
}

#[test]
fn point_at_rest_appears_where_600_bits_put_it() {
    let mut random = seeded(21);
    for decade in [-8.0, 0.0, 1.0, 3.0, 6.0, 9.0, 11.0] {
        let mut worst = Worst::default();
        for case in 0..200 {
            let u = celerity(&mut random, decade..decade + 1.0);
            // Half of the observers far from the origin: the displacement is then no f64 vector.
            let offset = if case % 8 < 4 { DVec3::ZERO } else { vector(&mut random, 0.0..6.0) };
            let observer = Observer { event: Event { ct: 0.0, position: offset }, celerity: u };
            let point = offset + displacement(&mut random, u, case);
            let d = &RealVec::new(point) - &RealVec::new(offset);
            if to_f64(&d.length()) == 0.0 {
                continue;
            }
            let seen = apparent::at_rest(&observer, point);
            let (image, doppler) = boosted_light(&RealVec::new(u.vector()), &d);
            worst.meet(&Worst {
                direction: angle(seen.position, &image),
                distance: relative(seen.position.length(), &image.length()),
                doppler: relative(seen.doppler, &doppler),
                emission: relative(-seen.emitted_at, &d.length()),
            });
        }
        worst.check(&format!("at rest, |u| from 1e{decade}"));
    }
}

#[test]
fn light_is_aberrated_to_where_600_bits_put_it_and_back() {
    let mut random = seeded(22);
    for decade in [-8.0, 0.0, 3.0, 6.0, 9.0, 11.0] {
        let mut worst = Worst::default();
        for case in 0..200 {
            let u = celerity(&mut random, decade..decade + 1.0);
            let n = displacement(&mut random, u, case);
            let aberration = Aberration::new(u);
            for (sign, (seen, doppler)) in
                [(1.0, aberration.observer_from_world(n)), (-1.0, aberration.world_from_observer(n))]
            {
                let (image, stretch) = boosted_light(&RealVec::new(sign * u.vector()), &RealVec::new(n));
                let exact = if sign > 0.0 { stretch } else { real(1.0) / stretch };
                worst.meet(&Worst {
                    direction: angle(seen, &image),
                    distance: (seen.length() - 1.0).abs(),
                    doppler: relative(doppler, &exact),
                    emission: 0.0,
                });
            }
        }
        worst.check(&format!("aberration, |u| from 1e{decade}"));
    }
}

#[test]
fn moving_source_appears_where_600_bits_put_it() {
    let mut random = seeded(23);
    for decade in [-8.0, 0.0, 3.0, 6.0, 9.0, 11.0] {
        let mut worst = Worst::default();
        for case in 0..200 {
            let u = celerity(&mut random, decade..decade + 1.0);
            let place = vector(&mut random, -3.0..6.0);
            let observer =
                Observer { event: Event { ct: random.random_range(-1e3..1e3), position: place }, celerity: u };
            // Slow ones, ones of any direction, and companions almost as fast on almost the same course.
            let source_celerity = match case % 3 {
                0 => celerity(&mut random, -8.0..0.0),
                1 => celerity(&mut random, decade..decade + 1.0),
                _ => Celerity::new(u.vector() * (1.0 + size(&mut random, -12.0..0.0))).unwrap(),
            };
            let source =
                PointSource { position: place + displacement(&mut random, u, case / 3), celerity: source_celerity };
            let seen = apparent::moving(&observer, &source);

            let (u, v) = (RealVec::new(u.vector()), RealVec::new(source_celerity.vector()));
            let time = real(observer.event.ct);
            let now = &(&RealVec::new(source.position) - &RealVec::new(place)) + &(&v * &(&time / gamma(&v)));
            let (d, age) = retarded(&now, &v);
            let (image, observed) = boosted_light(&u, &d);
            let (_, sent) = boosted_light(&v, &d);
            let scale = to_f64(&age) + observer.event.ct.abs();
            worst.meet(&Worst {
                direction: angle(seen.position, &image),
                distance: relative(seen.position.length(), &image.length()),
                doppler: relative(seen.doppler, &(observed / sent)),
                emission: to_f64(&(real(seen.emitted_at) - (time - age))).abs() / scale,
            });
        }
        worst.check(&format!("moving, |u| from 1e{decade}"));
    }
}

#[test]
fn boosted_vector_is_that_of_600_bits() {
    /// A few roundings of the larger of time and place.
    const TOLERANCE: f64 = 8.0 * EPSILON;
    /// Loss of t − h at 106 bits, to be multiplied by κ.
    const SPLIT: f64 = EPSILON * EPSILON;
    let mut random = seeded(25);
    for case in 0..800 {
        let u = celerity(&mut random, -8.0..12.0);
        let r = displacement(&mut random, u, case);
        // Anywhere, or on the light cone up to rounding and beyond, where t − h is all that is left.
        let t = match case / 4 % 3 {
            0 => r.length() * random.random_range(-2.0..2.0),
            1 => r.length(),
            _ => r.length() * (1.0 + size(&mut random, -15.0..0.0)),
        };
        let seen = Boost::observer_from_world(u).apply(FourVector { t, r });

        let split = SPLIT * u.gamma() * r.length();
        let (u, r, t) = (RealVec::new(u.vector()), RealVec::new(r), real(t));
        let (gamma, along) = (gamma(&u), u.dot(&r));
        let place = &r + &(&u * &(&along / (real(1.0) + &gamma) - &t));
        let time = gamma * t - along;
        let error = to_f64(&(&RealVec::new(seen.r) - &place).length()) + to_f64(&(real(seen.t) - &time)).abs();
        let scale = to_f64(&place.length()).max(to_f64(&time).abs());
        assert!(error < TOLERANCE * scale + split, "{case} {u:?} {error:e} {scale:e}");
    }
}

#[test]
fn beta_gives_the_celerity_of_600_bits() {
    const TOLERANCE: f64 = 4.0 * EPSILON;
    let mut random = seeded(26);
    for _ in 0..400 {
        let beta = Beta::new(direction(&mut random) * (1.0 - size(&mut random, -15.0..0.0))).unwrap();
        let vector = RealVec::new(beta.vector());
        let exact = &vector * &(real(1.0) / (real(1.0) - vector.dot(&vector)).sqrt());
        let error = (&RealVec::new(beta.celerity().vector()) - &exact).length() / exact.length();
        assert!(to_f64(&error) < TOLERANCE, "{beta:?} {error}");
    }
}

#[test]
fn composed_celerity_is_that_of_600_bits() {
    /// A few roundings of the largest component, or of 1 where the two nearly cancel.
    const TOLERANCE: f64 = 8.0 * EPSILON;
    let mut random = seeded(24);
    for case in 0..600 {
        let vehicle = celerity(&mut random, -8.0..12.0);
        let head = match case % 3 {
            0 => celerity(&mut random, -8.0..12.0),
            1 => {
                let angle = size(&mut random, -14.0..0.0);
                let course = direction_off(&mut random, -vehicle.vector(), angle);
                Celerity::new(course * size(&mut random, -8.0..12.0)).unwrap()
            }
            _ => Celerity::new(vehicle.vector() * -(1.0 + size(&mut random, -15.0..0.0))).unwrap(),
        };
        let composition = compose(vehicle, head);
        let (u, v) = (RealVec::new(vehicle.vector()), RealVec::new(head.vector()));
        let (gamma_u, gamma_v) = (gamma(&u), gamma(&v));
        let dot = u.dot(&v);
        let sum = &(&u * &(&gamma_v + &dot / (real(1.0) + &gamma_u))) + &v;
        let difference = (&RealVec::new(composition.celerity.vector()) - &sum).length();
        let error = to_f64(&difference) / to_f64(&sum.length()).max(1.0);
        assert!(error < TOLERANCE, "{vehicle:?} {head:?} {error:e}");

        // The quaternion: ((1 + γ₁)(1 + γ₂) + u·v, u × v), normalised.
        let scalar = (real(1.0) + gamma_u) * (real(1.0) + gamma_v) + dot;
        let turn = u.cross(&v);
        let length = (&scalar * &scalar + turn.dot(&turn)).sqrt();
        let expected = DVec3::from_array(turn.0.map(|component| to_f64(&(component / &length))));
        let computed = composition.wigner;
        assert!(computed.xyz().distance(expected) < TOLERANCE, "{vehicle:?} {head:?} {computed:?} {expected:?}");
        assert!((computed.w - to_f64(&(scalar / length))).abs() < TOLERANCE);
    }
}
