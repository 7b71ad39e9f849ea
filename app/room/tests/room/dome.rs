//! Law: a dome's pictures form one picture: a point of the dome is the same point for every projector that lights it,
//! and their light together is even.
//!
//! A wrong lens or pose would show doubled edges where pictures overlap; wrong gains would show seams or a bright
//! zone. The brightness is measured without the code that makes the gains: each pixel has the same share of the
//! projector's light, and spreads it over the patch between its corners.
#![allow(clippy::unwrap_used, reason = "helpers of tests, too, may fail the test")]

use glam::{DVec2, DVec3};
use rand::{RngExt, SeedableRng};
use room::{Channel, Display, Gains};

/// Largest disagreement between projectors, pixels: a larger one would be visible as doubling at the seam.
const AGREEMENT_PX: f64 = 0.5;

/// Largest deviation of the brightness, as a share of the mean.
const FLATNESS: f64 = 0.02;

/// Lowest height of test points, as a share of the radius: within the first quarter of a degree pixels are cut by the
/// rim.
const LOWEST: f64 = 0.005;

fn points(count: usize) -> Vec<DVec3> {
    let mut random = rand_chacha::ChaCha8Rng::seed_from_u64(7);
    let mut point = || {
        // Uniform over the sphere: its height is uniform, too (Archimedes).
        let (height, yaw): (f64, f64) =
            (random.random_range(LOWEST..1.0), random.random_range(0.0..std::f64::consts::TAU));
        let flat = (1.0 - height * height).sqrt();
        DVec3::new(7.0 * flat * yaw.sin(), 1.6 + 7.0 * height, 7.0 * flat * yaw.cos())
    };
    (0..count).map(|_| point()).collect()
}

#[test]
fn a_pixel_lights_the_point_that_the_thesis_gives() {
    // Expected directions are B eq. 4.6–4.8 as printed: along the axis, to the left, up; R_p from the dome's centre.
    let display = Display::built_in("dome6").unwrap();
    let centre = DVec3::new(0.0, 1.6, 0.0);
    for (channel, (yaw, pitch)) in display.channels.iter().zip([
        (0.0, 16.0),
        (72.0, 16.0),
        (144.0, 16.0),
        (-144.0, 16.0),
        (-72.0, 16.0),
        (180.0, 45.0_f64),
    ]) {
        let ((sin_yaw, cos_yaw), (sin_pitch, cos_pitch)) =
            (f64::to_radians(yaw).sin_cos(), pitch.to_radians().sin_cos());
        let axis = DVec3::new(-sin_yaw * cos_pitch, sin_pitch, -cos_yaw * cos_pitch);
        let left = DVec3::new(-cos_yaw, 0.0, sin_yaw);
        let up = DVec3::new(sin_yaw * sin_pitch, cos_pitch, cos_yaw * sin_pitch);
        let stands = -7.0 * DVec3::new(-sin_yaw, 0.0, -cos_yaw);
        for (x, y) in [(600.5, 100.5), (-639.5, 20.5), (-17.5, 383.5), (0.5, -0.5), (222.5, -99.5)] {
            let kappa = std::f64::consts::PI / 7200.0;
            let a = (1.0 - (kappa * x).cos().powi(2) * (kappa * y).cos().powi(2)).sqrt();
            let wide = 1.8 * a.asin();
            let phi = wide.cos() * axis - wide.sin() * (kappa * x).sin() / a * left
                + wide.sin() * (kappa * x).cos() * (kappa * y).sin() / a * up;
            let expected = centre + stands - 2.0 * phi.dot(stands) * phi;
            let place = DVec2::new(0.5 + x / 1280.0, 0.5 - y / 768.0);
            let found = channel.point(&display, place);
            if expected.y < 1.6 {
                assert_eq!(found, None, "below the rim");
                continue;
            }
            // The file gives the projectors' positions to a nanometre.
            assert!(found.unwrap().distance(expected) < 1e-7, "{} {x} {y}: {found:?} {expected}", channel.name);
        }
    }
}

fn pixel(channel: &Channel, place: DVec2) -> DVec2 {
    let [width, height] = channel.size().map(f64::from);
    place * DVec2::new(width, height)
}

#[test]
fn the_same_point_of_the_dome_is_the_same_for_all_projectors() {
    let display = Display::built_in("dome6").unwrap();
    let (mut pairs, mut worst, mut uncovered) = (0, 0.0_f64, 0);
    for point in points(20_000) {
        let lit: Vec<(&Channel, DVec2)> =
            display.channels.iter().filter_map(|channel| Some((channel, channel.place(&display, point)?))).collect();
        uncovered += usize::from(lit.is_empty());
        // A point goes from one projector's pixel to the dome, and from there to the other projector's expected
        // pixel.
        for (one, place) in &lit {
            let on_dome = one.point(&display, *place).unwrap();
            for (other, expected) in lit.iter().filter(|(other, _)| other.name != one.name) {
                let found = other.place(&display, on_dome).unwrap();
                worst = worst.max(pixel(other, found).distance(pixel(other, *expected)));
                pairs += 1;
            }
        }
    }
    println!("{pairs} pairs agree to {worst:.1e} px; {uncovered} of 20000 points unlit");
    assert!(worst < AGREEMENT_PX, "{worst} px");
    assert!(pairs > 20_000, "hardly any overlap: {pairs}");
    assert_eq!(uncovered, 0, "gaps");
}

/// Gain at a place, bilinear between pixel centres as a texture is read.
fn gain(gains: &Gains, place: DVec2) -> f64 {
    let size = DVec2::new(f64::from(gains.size[0]), f64::from(gains.size[1]));
    let at = (place * size - 0.5).clamp(DVec2::ZERO, size - 1.0);
    let (low, part) = (at.floor(), at.fract());
    let value = |x: f64, y: f64| {
        let (x, y) = (x.min(size.x - 1.0) as usize, y.min(size.y - 1.0) as usize);
        f64::from(gains.factors[y * gains.size[0] as usize + x])
    };
    let row = |y: f64| value(low.x, y) * (1.0 - part.x) + value(low.x + 1.0, y) * part.x;
    row(low.y) * (1.0 - part.y) + row(low.y + 1.0) * part.y
}

/// Light per square metre of a pixel-sized patch round a place.
fn density(channel: &Channel, display: &Display, place: DVec2) -> f64 {
    let half = 0.5 / DVec2::new(1280.0, 768.0);
    let inner = place.clamp(half, 1.0 - half);
    let corner = |x: f64, y: f64| channel.point(display, inner + DVec2::new(x, y) * half);
    let corners = [corner(-1.0, -1.0), corner(1.0, -1.0), corner(1.0, 1.0), corner(-1.0, 1.0)];
    let [a, b, c, d] = corners.map(|corner| corner.expect("the pixel is above the rim"));
    1.0 / (0.5 * (c - a).cross(d - b).length() * 1280.0 * 768.0)
}

/// Brightness at dome points, with the pixels' factors or without: mean, and distance of the brightest and the
/// darkest from it.
fn evenness(display: &Display, corrected: bool) -> (f64, f64, f64) {
    // The factors are smooth: a texture of a quarter of the size is enough.
    let factors = |channel: &Channel| channel.gains(display, channel.size().map(|side| side / 4)).filter(|_| corrected);
    let gains: Vec<Option<Gains>> = display.channels.iter().map(factors).collect();
    let brightness = |point: DVec3| -> f64 {
        let lit = display.channels.iter().zip(&gains).filter_map(|(channel, gains)| {
            let place = channel.place(display, point)?;
            let factor = gains.as_ref().map_or(1.0, |gains| gain(gains, place));
            Some(factor * density(channel, display, place))
        });
        lit.sum()
    };
    let all: Vec<f64> = points(20_000).into_iter().map(brightness).collect();
    let mean = all.iter().sum::<f64>() / all.len() as f64;
    let most = all.iter().copied().fold(0.0, f64::max) / mean - 1.0;
    let least = 1.0 - all.iter().copied().fold(f64::INFINITY, f64::min) / mean;
    (mean, most, least)
}

#[test]
fn blended_brightness_is_even_all_over_the_dome() {
    let display = Display::built_in("dome6").unwrap();
    let (mean, most, least) = evenness(&display, true);
    let (raw, raw_most, raw_least) = evenness(&display, false);
    println!("corrected: mean {mean:.5}, +{:.2} % −{:.2} %", 100.0 * most, 100.0 * least);
    println!("as it is: mean {raw:.5}, +{:.0} % −{:.0} %", 100.0 * raw_most, 100.0 * raw_least);
    assert!(most < FLATNESS && least < FLATNESS, "+{most} −{least}");
    assert!(raw_most > 0.5, "without correction it would be uneven, or this test measures nothing");
}

#[test]
fn gains_are_factors_and_use_the_whole_range() {
    let display = Display::built_in("dome6").unwrap();
    let all: Vec<Gains> = display.channels.iter().map(|channel| channel.gains(&display, [160, 96]).unwrap()).collect();
    assert!(
        all.iter()
            .all(|gains| gains.factors.iter().all(|factor| (0.0..=1.0).contains(factor)) && gains.lifts.is_none())
    );
    let most = all.iter().flat_map(|gains| &gains.factors).copied().fold(0.0, f32::max);
    assert!(most > 0.95, "the dome is darker than it need be: {most}");
    // On the edge of each picture, other projectors have taken over; the lower edge is the dome's own, and stays lit.
    for gains in &all[..5] {
        let row = |y: usize| &gains.factors[160 * y..160 * (y + 1)];
        assert!(row(0).iter().all(|factor| *factor < 0.05), "{:?}", row(0));
        assert!(row(48)[0] < 0.05 && row(48)[159] < 0.05);
    }
}

#[test]
fn a_weaker_projector_is_met_by_the_others() {
    let mut display = Display::built_in("dome6").unwrap();
    display.projectors[2].light = 0.5;
    let full = Display::built_in("dome6").unwrap();
    let factors = |display: &Display| display.channels[0].gains(display, [32, 32]).unwrap().factors;
    let ratio = f64::from(factors(&display)[16 * 32 + 16] / factors(&full)[16 * 32 + 16]);
    assert!((0.5..0.75).contains(&ratio), "{ratio}");
}

#[test]
fn a_glossy_dome_is_corrected_for_the_viewers_place() {
    let mut display = Display::built_in("dome6").unwrap();
    let matt = display.channels[0].gains(&display, [32, 32]).unwrap();
    display.screens[0].reflection.gloss = 0.3;
    display.screens[0].reflection.exponent = 10.0;
    let glossy = display.channels[0].gains(&display, [32, 32]).unwrap();
    assert_ne!(matt, glossy);
    display.viewer.head_m.x += 3.0;
    assert_ne!(display.channels[0].gains(&display, [32, 32]).unwrap(), glossy);
}
