//! The law: light from a point at rest reaches a moving eye from the aberrated direction, with the Doppler
//! factor D = γ + u·n, from r D away, at every speed and in every direction, dead astern included.
//!
//! A wrong program would show houses astern that tremble or fold over at high speed (f32 cancellation), or a
//! town far from the world's origin that jitters. The reference is computed here from the exact displacement,
//! carried as a sum of two f64, with cross products that do not cancel; where the textbook form is still
//! good, it must agree with that, too.

use exact_reference::random::{direction, direction_off, seeded, size};
use glam::DVec3;
use physics::photo_surface::accuracy::{DIRECTION_ERROR_RAD, EXTREME_DIRECTION_ERROR_RAD};
use physics::photo_surface::{Instructions, Kernel, PhotoSurfaceEye, PhotoSurfaceMesh, Vertices};
use rand::RngExt;
use rand_chacha::ChaCha8Rng;

/// Relative error of a few roundings of f32.
const RELATIVE: f64 = 2e-6;
/// Relative error of distance and D there: they suffer where they are least, dead astern.
const EXTREME_RELATIVE: f64 = 2e-4;
/// Relative error of the textbook form, which loses γ² roundings of f64; γ ≤ 10 here.
const TEXTBOOK: f64 = 1e-12;

/// a b − c d to 1.5 units in the last place (Kahan).
fn difference_of_products(a: f64, b: f64, c: f64, d: f64) -> f64 {
    let product = c * d;
    let error = (-c).mul_add(d, product);
    a.mul_add(b, -product) + error
}

fn cross(a: DVec3, b: DVec3) -> DVec3 {
    DVec3::new(
        difference_of_products(a.y, b.z, a.z, b.y),
        difference_of_products(a.z, b.x, a.x, b.z),
        difference_of_products(a.x, b.y, a.y, b.x),
    )
}

/// a − b and what its rounding lost.
fn exact_difference(a: DVec3, b: DVec3) -> (DVec3, DVec3) {
    let difference = a - b;
    let back = difference - a;
    (difference, (a - (difference - back)) - (b + back))
}

struct Reference {
    position: DVec3,
    doppler: f64,
}

/// The apparent position of `offset` (from `origin`) for an eye at `eye` with celerity `u`.
fn reference(offset: DVec3, origin: DVec3, eye: DVec3, u: DVec3) -> Reference {
    let (eye_high, eye_low) = exact_difference(eye, origin);
    let (d, rounding) = exact_difference(offset, eye_high);
    let rest = rounding - eye_low;

    let speed = u.length();
    let kappa = speed.hypot(1.0) + speed;
    let moment = (cross(d, u) + rest.cross(u)) / speed;
    let across = cross(u / speed, moment);
    let along = d.dot(u) / speed;
    let distance = along.hypot(moment.length());
    let big = distance + along.abs();
    let small = moment.length_squared() / big;
    let (sum, difference) = if along >= 0.0 { (big, small) } else { (small, big) };
    let (advanced, retarded) = (kappa * sum / 2.0, difference / (2.0 * kappa));
    Reference { position: across + (advanced - retarded) * (u / speed), doppler: (advanced + retarded) / distance }
}

fn textbook(d: DVec3, u: DVec3) -> Reference {
    let gamma = u.length().hypot(1.0);
    let position = d + u * (d.length() + u.dot(d) / (1.0 + gamma));
    Reference { position, doppler: gamma + u.dot(d.normalize()) }
}

fn angle(a: DVec3, b: DVec3) -> f64 {
    let (a, b) = (a.normalize(), b.normalize());
    cross(a, b).length().atan2(a.dot(b))
}

/// A direction: any, dead ahead, dead astern, or 1e-10 to 1 rad off astern, for a motion along `ahead`.
fn around(random: &mut ChaCha8Rng, ahead: DVec3) -> DVec3 {
    match random.random_range(0..8) {
        0 => ahead,
        1 => -ahead,
        2 | 3 => direction(random),
        _ => {
            let off = size(random, -10.0..0.0);
            direction_off(random, -ahead, off)
        }
    }
}

/// Result of the kernel for a mesh of one vertex, so that its own place alone chooses the formula.
fn seen(kernel: Kernel, vertices: &Vertices, eye: DVec3, u: DVec3) -> Reference {
    let (mut x, mut y, mut z, mut doppler) = ([0.0], [0.0], [0.0], [0.0]);
    let surface =
        PhotoSurfaceMesh::new(vertices, [&mut x, &mut y, &mut z]).unwrap().with_doppler(&mut doppler).unwrap();
    let stats = kernel.transform(&PhotoSurfaceEye::new(eye, u).unwrap(), vec![surface]);
    assert_eq!(stats.not_finite(), 0);
    Reference { position: DVec3::new(x[0].into(), y[0].into(), z[0].into()), doppler: doppler[0].into() }
}

/// Worst errors over `cases` random cases: direction in rad, distance and D relative.
fn worst(kernel: Kernel, seed: u64, cases: usize, gamma: (f64, f64), origin_distance: f64) -> [f64; 3] {
    let mut random = seeded(seed);
    let mut worst = [0.0_f64; 3];
    for _ in 0..cases {
        let ahead = if random.random_bool(0.2) { DVec3::NEG_Z } else { direction(&mut random) };
        let gamma = size(&mut random, gamma.0.log10()..gamma.1.log10());
        let u = ahead * ((gamma - 1.0) * (gamma + 1.0)).sqrt().max(1e-8);
        let distance = size(&mut random, -3.0..6.0);
        let d = distance * around(&mut random, ahead);
        let origin = origin_distance * direction(&mut random);
        let from_origin = distance * size(&mut random, -3.0..3.0);
        let offset = (from_origin * direction(&mut random)).as_vec3();
        // Put the eye where the vertex lies in the direction chosen, as well as f64 can.
        let eye = origin + (offset.as_dvec3() - d);

        let vertices = Vertices::from_offsets(origin, [offset]).unwrap();
        let got = seen(kernel, &vertices, eye, u);
        let want = reference(offset.as_dvec3(), origin, eye, u);
        let errors = [
            angle(got.position, want.position),
            (got.position.length() / want.position.length() - 1.0).abs(),
            (got.doppler / want.doppler - 1.0).abs(),
        ];
        for (worst, error) in worst.iter_mut().zip(errors) {
            assert!(error.is_finite());
            *worst = worst.max(error);
        }
    }
    worst
}

/// Number of random cases for every range of γ and distance of the origin.
const CASES: usize = 20_000;

fn assert_accurate(gamma: (f64, f64), direction_bound: f64, relative_bound: f64) {
    let kernels = Instructions::ALL.into_iter().filter_map(|instructions| Kernel::with_instructions(instructions).ok());
    let places = [(1, 0.0), (2, 1e6), (3, 1e9)];
    for (kernel, (seed, origin_distance)) in kernels.flat_map(|kernel| places.map(|place| (kernel, place))) {
        let [direction, distance, doppler] = worst(kernel, seed, CASES, gamma, origin_distance);
        let place = format!("{kernel:?}, gamma {gamma:?}, origin {origin_distance:e} m away");
        assert!(direction <= direction_bound, "{place}: direction off by {direction:.1e} rad");
        assert!(distance <= relative_bound, "{place}: distance off by {distance:.1e}");
        assert!(doppler <= relative_bound, "{place}: D off by {doppler:.1e}");
    }
}

#[test]
fn directions_hold_at_every_speed_of_a_ride() {
    assert_accurate((1.0, 4.0), DIRECTION_ERROR_RAD, RELATIVE);
    assert_accurate((4.0, 16.0), DIRECTION_ERROR_RAD, RELATIVE);
}

#[test]
fn directions_hold_at_extreme_speed() {
    assert_accurate((16.0, 1e3), DIRECTION_ERROR_RAD, RELATIVE);
    assert_accurate((1e3, 1e6), DIRECTION_ERROR_RAD, RELATIVE);
    assert_accurate((1e6, 1e9), DIRECTION_ERROR_RAD, RELATIVE);
    assert_accurate((1e9, 1e12), EXTREME_DIRECTION_ERROR_RAD, EXTREME_RELATIVE);
}

#[test]
fn reference_agrees_with_the_textbook_where_that_is_good() {
    let mut random = seeded(4);
    for _ in 0..1000 {
        let u = direction(&mut random) * size(&mut random, -3.0..1.0);
        let offset = (100.0 * direction(&mut random)).as_vec3();
        let eye = direction(&mut random);
        let exact = reference(offset.as_dvec3(), DVec3::ZERO, eye, u);
        let textbook = textbook(offset.as_dvec3() - eye, u);
        assert!(angle(exact.position, textbook.position) < TEXTBOOK, "u = {u}");
        assert!((exact.doppler / textbook.doppler - 1.0).abs() < TEXTBOOK, "u = {u}");
    }
}

#[test]
fn chunks_of_many_vertices_are_as_accurate_as_single_ones() {
    let mut random = seeded(5);
    let origin = DVec3::new(3e6, 0.0, -4e6);
    let eye = origin + DVec3::new(0.5, 1.7, -0.25);
    let offsets: Vec<_> =
        (0..20_000).map(|_| (direction(&mut random) * size(&mut random, 0.0..4.0)).as_vec3()).collect();
    let vertices = Vertices::from_offsets(origin, offsets.iter().copied()).unwrap();
    for speed in [0.75, 30.0, 1e5] {
        let u = speed * DVec3::new(2.0, -1.0, 2.0) / 3.0;
        let mut position = [const { Vec::new() }; 3];
        position.iter_mut().for_each(|stream| stream.resize(offsets.len(), 0.0));
        let [x, y, z] = &mut position;
        let surface = PhotoSurfaceMesh::new(&vertices, [x, y, z]).unwrap();
        Kernel::default().transform(&PhotoSurfaceEye::new(eye, u).unwrap(), vec![surface]);
        for (index, offset) in offsets.iter().enumerate() {
            let got = DVec3::from_array([0, 1, 2].map(|axis: usize| f64::from(position[axis][index])));
            let want = reference(offset.as_dvec3(), origin, eye, u).position;
            assert!(angle(got, want) <= DIRECTION_ERROR_RAD, "vertex {index} at |u| = {speed}");
        }
    }
}
