//! Law: the shift table looks up what direct integration gives, for every kind of light and at every Doppler factor. A
//! wrong program would show bands of colour ahead, or a brightness that jumps where the table's nodes lie.

use exact_reference::random::seeded;
use physics::colour::difference::{delta_e_2000, lab_from_xyz};
use physics::colour::{Carrier, ShiftTable, Spectrum, xyz_from_rgb};
use physics::glam::{DMat3, DVec3};
use rand::RngExt;

use crate::support::relative_difference;

/// ΔE2000, of which 1 is just noticeable. Measured: 0.09 to 0.14, where a pure primary falls off steeply.
const LARGEST_DIFFERENCE: f64 = 0.5;

/// A leaf, green and bright beyond 700 nm, and a paint as green and dark there: wavelength in nm and reflectance, of
/// the shape that measured ones have.
const LEAF: [[f64; 2]; 16] = [
    [300.0, 0.04],
    [400.0, 0.05],
    [480.0, 0.06],
    [510.0, 0.10],
    [550.0, 0.22],
    [580.0, 0.14],
    [620.0, 0.09],
    [670.0, 0.05],
    [690.0, 0.09],
    [720.0, 0.42],
    [750.0, 0.62],
    [1300.0, 0.60],
    [1450.0, 0.28],
    [1650.0, 0.45],
    [1950.0, 0.08],
    [2500.0, 0.05],
];
const PAINT: [[f64; 2]; 9] = [
    [300.0, 0.03],
    [430.0, 0.05],
    [490.0, 0.14],
    [530.0, 0.24],
    [560.0, 0.17],
    [600.0, 0.07],
    [700.0, 0.05],
    [1200.0, 0.07],
    [12_000.0, 0.05],
];

fn planck(kelvin: f64) -> Spectrum {
    Spectrum::planck(kelvin).unwrap()
}

fn sampled(samples: &[[f64; 2]]) -> Spectrum {
    Spectrum::sampled(samples).unwrap()
}

/// ΔE2000 of a colour looked up, with the brightness of the true one as white: the strictest reading, as brightness
/// counts in full.
fn difference(looked_up: DVec3, direct: DVec3) -> f64 {
    let [looked_up, direct] = [looked_up, direct].map(|rgb| xyz_from_rgb() * rgb);
    let white = xyz_from_rgb() * DVec3::splat(direct.y);
    delta_e_2000(lab_from_xyz(looked_up, white), lab_from_xyz(direct, white))
}

/// The largest difference over D = 1/20 … 20, of each weight alone and of mixtures, and where.
fn largest_difference(carrier: Carrier) -> (f64, f64) {
    let table = ShiftTable::new(std::slice::from_ref(&carrier), ShiftTable::NODES);
    let mut random = seeded(91);
    let mut largest = (0.0, 0.0);
    for _ in 0..2000 {
        let doppler = 20_f64.powf(random.random_range(-1.0..=1.0));
        let [looked_up, direct] = [table.rgb_from_weights(0, doppler), carrier.rgb_from_weights(doppler)];
        for weights in [DVec3::ONE, DVec3::X, DVec3::Y, DVec3::Z, DVec3::new(0.2, 0.5, 0.1)] {
            let difference = difference(looked_up * weights, direct * weights);
            if difference > largest.0 {
                largest = (difference, doppler);
            }
        }
    }
    largest
}

#[test]
fn table_stays_within_half_a_just_noticeable_difference() {
    let daylight = Some(planck(5900.0));
    let lights = [
        ("white", Carrier::white()),
        ("1000 K", Carrier::emitted(planck(1000.0))),
        ("2800 K", Carrier::emitted(planck(2800.0))),
        ("5900 K", Carrier::emitted(planck(5900.0))),
        ("10000 K", Carrier::emitted(planck(10_000.0))),
        ("20000 K", Carrier::emitted(planck(20_000.0))),
        ("leaf", Carrier::reflected(Some(sampled(&LEAF)), None)),
        ("leaf in daylight", Carrier::reflected(Some(sampled(&LEAF)), daylight.clone())),
        ("paint", Carrier::reflected(Some(sampled(&PAINT)), None)),
        ("paint in daylight", Carrier::reflected(Some(sampled(&PAINT)), daylight)),
    ];
    for (name, carrier) in lights {
        let (difference, doppler) = largest_difference(carrier);
        assert!(difference < LARGEST_DIFFERENCE, "{name}: {difference} at D = {doppler}");
    }
}

#[test]
fn at_rest_nothing_is_interpolated() {
    /// A texel's ratio and logarithm, each rounded to f32.
    const ROUNDING: f64 = 1e-6;
    for nodes in [0, 3, 64, 65, ShiftTable::NODES] {
        let table = ShiftTable::new(&[Carrier::emitted(planck(2800.0)), Carrier::white()], nodes);
        assert_eq!(table.texels().len(), 6 * table.nodes(), "a row for each weight of each carrier");
        let seen = table.rgb_from_weights(1, 1.0);
        assert!(seen.abs_diff_eq(DMat3::IDENTITY, ROUNDING), "{nodes} nodes: {seen}");
    }
}

/// Every texel is one node's own colour, whichever row it lies in.
#[test]
fn texels_are_the_colours_of_their_nodes() {
    let carriers = [Carrier::white(), Carrier::emitted(planck(2800.0))];
    let table = ShiftTable::new(&carriers, 13);
    for (index, texel) in table.texels().iter().enumerate() {
        let (row, node) = (index / table.nodes(), index % table.nodes());
        let doppler = 10_f64.powf(node as f64 - 6.0);
        let direct = carriers[row / 3].rgb_from_weights(doppler).col(row % 3);
        let [red, green, blue, log2_luminance] = texel.map(f64::from);
        let stored = DVec3::new(red, green, blue) * log2_luminance.exp2();
        // A logarithm of 64 is rounded by 4e-6.
        assert!(relative_difference(stored, direct) < 1e-5, "row {row}, D = {doppler}: {stored}, not {direct}");
    }
}

#[test]
fn beyond_the_ends_the_colour_stays_and_brightness_goes_on_straight() {
    let table = ShiftTable::new(&[Carrier::emitted(planck(5900.0))], 3);
    let [middle, end] = [1, 2].map(|node| table.texels()[node].map(f64::from));
    let seen = table.rgb_from_weights(0, 1e12).x_axis;
    // Look as far beyond the last node, in ln D, as that is from the one before.
    let luminance = (2.0 * end[3] - middle[3]).exp2();
    let expected = DVec3::new(end[0], end[1], end[2]) * luminance;
    assert!(relative_difference(seen, expected) < 1e-12, "{seen}, not {expected}");
}

#[test]
fn no_light_is_dark_and_finite() {
    let green_line = [[500.0, 0.0], [520.0, 1e9], [540.0, 0.0]];
    let table =
        ShiftTable::new(&[Carrier::emitted(sampled(&green_line)), Carrier::emitted(sampled(&[[500.0, 0.0]]))], 65);
    assert!(table.texels().iter().flatten().all(|number| number.is_finite()));
    assert!((table.rgb_from_weights(0, 1.0) * DVec3::ONE).y > 1e3, "the line is bright at rest");
    for (carrier, doppler) in [(0, 10.0), (0, 1e-9), (0, 1e12), (1, 1.0)] {
        assert_eq!(table.rgb_from_weights(carrier, doppler).to_cols_array().map(|light| light as f32), [0.0; 9]);
    }
}

#[test]
fn any_number_of_threads_gives_the_same_bits() {
    let table = |threads: usize| {
        let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build().unwrap();
        pool.install(|| ShiftTable::new(&[Carrier::white(), Carrier::emitted(planck(5900.0))], 257))
    };
    let alone = table(1);
    for threads in [2, 8] {
        assert_eq!(table(threads), alone, "{threads} threads");
    }
}
