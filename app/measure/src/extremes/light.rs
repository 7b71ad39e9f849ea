//! Direction and Doppler factor of light at extreme speeds, angles and distances, against the textbook's formulas.
//!
//! The textbook form of aberration, x' = d + u (r + u·d/(1 + γ)), loses ε γ² astern; at 180 digits that loss does not
//! matter. The reference starts from the same f64 numbers that the program is given, so that the difference is the
//! program's own rounding.

use exact_reference::light::{boosted_light, retarded};
use exact_reference::random::direction;
use exact_reference::real::{RealVec, angle, gamma, real, relative, to_f64};
use glam::DVec3;
use physics::{Aberration, Celerity, Event, Observer, PointSource, apparent};
use rand::{RngExt, SeedableRng};
use rand_chacha::ChaCha8Rng;

use super::row::{ExtremesRow, Worst};

const DIRECTION: &str = "direction, rad";
const DISTANCE: &str = "distance, share";
const DOPPLER: &str = "Doppler factor, share";
const EMISSION: &str = "time of emission, share of the light's way and the clock";

/// |u| at γ = 1 + 1e-12 and at γ = 1e12, as powers of ten.
const CELERITY_DECADES: std::ops::RangeInclusive<f64> = -5.849..=12.0;

/// Largest angle of close directions from the line of motion, radians.
const CLOSE_RAD: f64 = 1e-12;

/// Distances from the eye, metres, with their names.
const DISTANCES: [(f64, &str); 4] =
    [(0.0, "at the eye"), (1e-9, "1e-9 m away"), (1.0, "1 m away"), (1e15, "1e15 m away")];

/// Distance of the eye from a far world origin, metres.
const FAR_ORIGIN: f64 = 1e9;

/// Direction of the light's origin in the world, relative to the observer's motion.
#[derive(Clone, Copy)]
enum From {
    Ahead,
    Astern,
    CloseToAstern,
    CloseToAhead,
    Anywhere,
}

const DIRECTIONS: [(From, &str); 5] = [
    (From::Ahead, "straight ahead"),
    (From::Astern, "straight behind"),
    (From::CloseToAhead, "within 1e-12 rad of straight ahead"),
    (From::CloseToAstern, "within 1e-12 rad of straight behind"),
    (From::Anywhere, "from anywhere"),
];

/// Rows of errors; each covers this number of cases.
pub fn rows(cases: u32) -> Vec<ExtremesRow> {
    let mut random = ChaCha8Rng::seed_from_u64(31);
    let mut rows = speeds(&mut random, cases).rows();
    for (from, name) in DIRECTIONS {
        rows.extend(aberration(&mut random, cases, from, name).rows());
    }
    for (metres, name) in DISTANCES {
        rows.extend(at_rest(&mut random, cases, metres, 0.0, name).rows());
        if metres > 0.0 {
            let name = format!("{name}, the world's origin 1e9 m away");
            rows.extend(at_rest(&mut random, cases, metres, FAR_ORIGIN, &name).rows());
        }
    }
    rows.extend(moving(&mut random, cases).rows());
    rows
}

fn speeds(random: &mut ChaCha8Rng, cases: u32) -> Worst {
    let mut worst = Worst::new("speed: γ from 1 + 1e-12 to 1e12");
    for case in 0..cases {
        let celerity = celerity(random, case);
        let u = RealVec::new(celerity.vector());
        let exact = gamma(&u);
        let rapidity = (&exact + u.length()).ln();
        let beta = RealVec::new(celerity.vector()).length() / &exact;
        worst.meet([
            ("γ, share", relative(celerity.gamma(), &exact)),
            ("rapidity, share", relative(celerity.rapidity(), &rapidity)),
            ("β, share", relative(celerity.beta().vector().length(), &beta)),
        ]);
    }
    worst
}

fn aberration(random: &mut ChaCha8Rng, cases: u32, from: From, name: &str) -> Worst {
    let mut worst = Worst::new(format!("aberration of light {name}, there and back"));
    for case in 0..cases {
        let celerity = celerity(random, case);
        let n = displacement(random, celerity, from);
        let aberration = Aberration::new(celerity);
        let seen = [(1.0, aberration.observer_from_world(n)), (-1.0, aberration.world_from_observer(n))];
        for (sign, (direction, doppler)) in seen {
            let (image, stretch) = boosted_light(&RealVec::new(sign * celerity.vector()), &RealVec::new(n));
            let exact = if sign > 0.0 { stretch } else { real(1.0) / stretch };
            worst.meet([(DIRECTION, angle(direction, &image)), (DOPPLER, relative(doppler, &exact))]);
        }
    }
    worst
}

/// Errors for points `metres` from the eye, which is `origin` metres from the world's origin, as exactly as f64 can
/// give a place there.
fn at_rest(random: &mut ChaCha8Rng, cases: u32, metres: f64, origin: f64, name: &str) -> Worst {
    let mut worst = Worst::new(format!("point at rest, {name}"));
    for case in 0..cases {
        let celerity = celerity(random, case);
        let eye = origin * direction(random);
        let from = DIRECTIONS[case as usize % DIRECTIONS.len()].0;
        let point = eye + metres * displacement(random, celerity, from);
        let observer = Observer { event: Event { ct: 0.0, position: eye }, celerity };
        let seen = apparent::at_rest(&observer, point);

        let d = &RealVec::new(point) - &RealVec::new(eye);
        let r = d.length();
        let u = RealVec::new(celerity.vector());
        // At the eye itself there is no direction, and D is γ, the mean over all directions.
        let (image, doppler) =
            if r == real(0.0) { (RealVec::new(DVec3::ZERO), gamma(&u)) } else { boosted_light(&u, &d) };
        worst.meet([
            (DIRECTION, angle(seen.position, &image)),
            (DISTANCE, relative(seen.position.length(), &image.length())),
            (DOPPLER, relative(seen.doppler, &doppler)),
            (EMISSION, relative(-seen.emitted_at, &r)),
        ]);
    }
    worst
}

/// Errors for sources in motion at any speed, companions of the observer among them.
fn moving(random: &mut ChaCha8Rng, cases: u32) -> Worst {
    let mut worst = Worst::new("moving source, 1e-9 to 1e15 m away, companions included");
    for case in 0..cases {
        let celerity_of_observer = celerity(random, case);
        let from = DIRECTIONS[case as usize % DIRECTIONS.len()].0;
        let place = 1e3 * direction(random);
        let ct = random.random_range(-1e3..1e3);
        let observer = Observer { event: Event { ct, position: place }, celerity: celerity_of_observer };
        let companion = celerity_of_observer.vector() * (1.0 + 10.0_f64.powf(random.random_range(-12.0..0.0)));
        let source_celerity = match Celerity::new(companion) {
            Ok(companion) if case % 2 == 0 => companion,
            _ => celerity(random, case / 2),
        };
        let metres = 10.0_f64.powf(random.random_range(-9.0..15.0));
        let position = place + metres * displacement(random, celerity_of_observer, from);
        let seen = apparent::moving(&observer, &PointSource { position, celerity: source_celerity });

        let (u, v) = (RealVec::new(celerity_of_observer.vector()), RealVec::new(source_celerity.vector()));
        let time = real(ct);
        let now = &(&RealVec::new(position) - &RealVec::new(place)) + &(&v * &(&time / gamma(&v)));
        let (d, age) = retarded(&now, &v);
        let (image, observed) = boosted_light(&u, &d);
        let (_, sent) = boosted_light(&v, &d);
        let scale = to_f64(&age) + ct.abs();
        worst.meet([
            (DIRECTION, angle(seen.position, &image)),
            (DISTANCE, relative(seen.position.length(), &image.length())),
            (DOPPLER, relative(seen.doppler, &(observed / sent))),
            (EMISSION, to_f64(&(real(seen.emitted_at) - (time - age))).abs() / scale),
        ]);
    }
    worst
}

/// Celerity of a case. The first two cases lie at the ends of the range; the others are random, with all decades
/// equally likely.
fn celerity(random: &mut ChaCha8Rng, case: u32) -> Celerity {
    let power = match case {
        0 => *CELERITY_DECADES.start(),
        1 => *CELERITY_DECADES.end(),
        _ => random.random_range(CELERITY_DECADES),
    };
    Celerity::new(10.0_f64.powf(power) * direction(random)).expect("1e12 is within the limit")
}

/// Displacement of length 1, up to rounding.
fn displacement(random: &mut ChaCha8Rng, celerity: Celerity, from: From) -> DVec3 {
    let ahead = celerity.direction().unwrap_or(DVec3::X);
    let mut close = |axis: DVec3| {
        let across = axis.cross(direction(random)).normalize_or_zero();
        axis + across * random.random_range(0.0..=CLOSE_RAD)
    };
    match from {
        From::Ahead => ahead,
        From::Astern => -ahead,
        From::CloseToAhead => close(ahead),
        From::CloseToAstern => close(-ahead),
        From::Anywhere => direction(random),
    }
}
