//! Colours inside the gamut must pass unchanged. Exposure must take back on average the brightness that motion has
//! added, in proper time. Tone curves must be the published ones and keep hue. Gamut mapping must keep luminance and
//! hue.
//!
//! A wrong program shows a picture at rest that does not have the scene's own colours; a frame that flickers or stays
//! dark after a jump; hues that turn where a channel is clipped; black or garish pixels where radiance is beyond all
//! bounds.
#![allow(clippy::unwrap_used, reason = "a failed construction is a failed test")]

use built_in::lattice::Lattice;
use exact_reference::random::seeded;
use glam::DVec3;
use physics::{Beta, Celerity};
use rand::RngExt;
use render::display::adaptation::TIME_CONSTANT_S;
use render::display::{Development, Exposure, Gamut, Tone};
use studio::light;
use system_tests::colour::encoded;
use system_tests::display::{AdaptingEye, adapted, in_gamut, luminance, texture, toned};
use system_tests::photographer::{Photographer, gpu};
use system_tests::view::{View, middle};
use view::{Effects, Stored};

/// Relative error of a shader's result: powers and exponentials of graphics devices, there and back through the
/// screen's curve.
const SHADER: f64 = 5e-5;
/// Width of the light meter's bins, stops.
const BIN: f64 = 0.125;

const SHIFTED: Stored = Stored { white: 1.0, scale: 1.0, shifted: true };
const TONES: [Tone; 4] = [Tone::Reinhard, Tone::Linear, Tone::Exponential, Tone::Filmic];
const GAMUTS: [Gamut; 3] = [Gamut::Desaturate, Gamut::White, Gamut::Clamp];

fn fixed(stops: f32, tone: Tone) -> Development {
    Development { exposure: Exposure::Stops(stops), tone, gamut: Gamut::Clamp }
}

fn automatic(tone: Tone) -> Development {
    Development { exposure: Exposure::AUTO, ..fixed(0.0, tone) }
}

/// Greys with these luminances at rest and these gains.
fn greys(seen: impl IntoIterator<Item = (f64, f64)>) -> Vec<[f32; 4]> {
    seen.into_iter()
        .map(|(at_rest, gain)| {
            let grey = (at_rest * gain) as f32;
            [grey, grey, grey, at_rest as f32]
        })
        .collect()
}

fn relative(a: f64, b: f64) -> f64 {
    (a / b - 1.0).abs()
}

/// Colours inside the gamut, the ends of its range among them.
fn colours(seed: u64) -> Vec<[f32; 4]> {
    let mut random = seeded(seed);
    let mut colours: Vec<_> = (0..1022).map(|_| [random.random(), random.random(), random.random(), 0.5]).collect();
    colours.extend([[0.0, 0.0, 0.0, 1.0], [1.0; 4]]);
    colours
}

#[test]
fn at_rest_the_screen_shows_the_colours_themselves() {
    let colours = colours(1);
    let mut eye = AdaptingEye::new();
    let mut show = |development| eye.encoded(32, &colours, Stored::UNSHIFTED, development, None);
    let first = show(fixed(0.0, Tone::Linear));
    for (colour, shown) in colours.iter().zip(&first) {
        for (value, shown) in colour.iter().zip(shown) {
            let exact = encoded(f64::from(*value)) / 255.0;
            assert!((f64::from(*shown) - exact).abs() < SHADER, "{value}: {shown} instead of {exact}");
        }
    }
    for exposure in [Exposure::AUTO, Exposure::WHITE] {
        for tone in [Tone::Linear, Tone::Reinhard] {
            for gamut in GAMUTS {
                let development = Development { exposure, tone, gamut };
                assert!(show(development) == first, "{development:?} changes colours that the screen has");
            }
        }
    }
}

#[test]
fn a_stop_is_a_factor_of_two_whatever_the_scale() {
    let dim = |factor: f32| colours(2).iter().map(|c| c.map(|value| value * factor)).collect::<Vec<_>>();
    let mut eye = AdaptingEye::new();
    let mut show =
        |texels: &[[f32; 4]], stored, stops| eye.encoded(32, texels, stored, fixed(stops, Tone::Linear), None);
    let as_they_are = show(&dim(1.0), Stored::UNSHIFTED, 0.0);
    assert!(show(&dim(0.125), Stored::UNSHIFTED, 3.0) == as_they_are);
    assert!(show(&dim(2.0), Stored::UNSHIFTED, -1.0) == as_they_are);
    for (exponent, shifted) in [(-60, false), (40, false), (-60, true), (40, true)] {
        let scale = 2.0_f64.powi(exponent);
        let stored = Stored { scale, white: 1.0, shifted };
        assert!(show(&dim(scale as f32), stored, 0.0) == as_they_are, "scale 2^{exponent}");
    }
}

#[test]
fn automatic_exposure_takes_a_common_gain_back() {
    let mut eye = AdaptingEye::new();
    let mut random = seeded(3);
    let at_rest: Vec<f64> = (0..900).map(|_| random.random_range(0.01..1.0)).collect();
    for gain in [1e-10, 0.03, 1.0, 7.0, 1e10] {
        for scale in [1.0, 1e-6, 1e6] {
            let mut texels = greys(at_rest.iter().map(|value| (*value, gain)));
            texels.iter_mut().flat_map(|texel| &mut texel[..3]).for_each(|value| *value *= scale as f32);
            let stored = Stored { scale, ..SHIFTED };
            for tone in [Tone::Linear, Tone::Reinhard] {
                let shown = eye.shown(30, &texels, stored, automatic(tone), None);
                for (value, shown) in at_rest.iter().zip(&shown) {
                    assert!(relative(shown[0], *value) < SHADER, "{value} is {shown:?} at gain {gain}, scale {scale}");
                }
            }
        }
    }
}

#[test]
fn automatic_exposure_is_the_trimmed_mean_of_gains_over_the_picture() {
    let mut eye = AdaptingEye::new();
    let mut random = seeded(4);
    for spread in [0.5, 5.0, 30.0] {
        let gains: Vec<f64> = (0..4000).map(|_| (spread * random.random_range(-1.0..1.0_f64).powi(3)).exp2()).collect();
        // The first pixel is dim enough never to be clipped.
        let mut texels = greys(gains.iter().map(|gain| (0.3, *gain)));
        let probe = (1e-12, gains[0]);
        texels[0] = greys([probe])[0];
        let shown = eye.shown(50, &texels, SHIFTED, automatic(Tone::Linear), None)[0][0];
        let exposure = (shown / (probe.0 * probe.1)).log2();
        let (mean, _) = adapted(&gains);
        assert!((exposure + mean).abs() < 0.1 * BIN, "{exposure} instead of {}", -mean);
    }
}

#[test]
fn pixels_that_are_dark_by_themselves_have_no_say() {
    let mut eye = AdaptingEye::new();
    let mut texels = greys((0..100).map(|_| (0.5, 8.0)));
    texels.extend(greys((0..400).map(|_| (0.0, 1.0))));
    texels.extend(greys((0..400).map(|_| (0.5, 0.0))));
    let shown = eye.shown(30, &texels, SHIFTED, automatic(Tone::Linear), None);
    assert!(relative(shown[0][0], 0.5) < SHADER, "{:?}", shown[0]);
    // If no gain is metered, the exposure stays.
    let dark = vec![[0.0; 4]; 64];
    assert!(eye.shown(8, &dark, SHIFTED, automatic(Tone::Reinhard), None).iter().all(|rgb| *rgb == [0.0; 3]));
}

/// Exposure, in stops, after these frames. Each frame has a gain, and the time before it.
fn exposure_after(frames: &[(f64, Option<f64>)]) -> f64 {
    let mut eye = AdaptingEye::new();
    let mut shown = f64::NAN;
    for (gain, elapsed_s) in frames {
        let texels = greys([(0.001, *gain); 64]);
        shown = eye.shown(8, &texels, SHIFTED, automatic(Tone::Linear), *elapsed_s)[0][0] / (0.001 * gain);
    }
    shown.log2()
}

#[test]
fn the_eye_adapts_by_1_less_e_to_the_minus_t_over_tau() {
    let gain = 16.0;
    for elapsed in [0.0, 0.01, 0.3, TIME_CONSTANT_S, 5.0] {
        let exposure = exposure_after(&[(1.0, None), (gain, Some(elapsed))]);
        let expected = 4.0 * (-elapsed / TIME_CONSTANT_S).exp_m1();
        assert!((exposure - expected).abs() < 1e-3, "{exposure} instead of {expected} after {elapsed} s");
        // The result must not depend on the frame rate.
        let halves = exposure_after(&[(1.0, None), (gain, Some(0.5 * elapsed)), (gain, Some(0.5 * elapsed))]);
        assert!((exposure - halves).abs() < 1e-3);
    }
    // A still adapts at once, and a clock that was set back not at all.
    assert!((exposure_after(&[(1.0, None), (gain, None)]) + 4.0).abs() < 1e-3);
    assert!(exposure_after(&[(1.0, None), (gain, Some(-3.0))]).abs() < 1e-3);
}

#[test]
fn light_that_is_not_shifted_is_exposed_by_1_at_once_and_shifted_light_after_it_adapted_to_at_once() {
    let mut eye = AdaptingEye::new();
    let colours = colours(5);
    let at_rest = AdaptingEye::new().encoded(32, &colours, Stored::UNSHIFTED, Development::default(), None);
    for _ in 0..2 {
        let shown = eye.shown(8, &greys([(0.25, 1e6); 64]), SHIFTED, Development::default(), Some(0.01));
        assert!(relative(shown[0][0], 0.25) < SHADER);
        assert!(eye.encoded(32, &colours, Stored::UNSHIFTED, Development::default(), Some(0.01)) == at_rest);
    }
}

#[test]
fn reinhards_white_is_the_brightest_gain_but_for_one_in_a_hundred() {
    let mut random = seeded(6);
    let gains: Vec<f64> = (0..5000).map(|_| random.random_range(-8.0..8.0_f64).exp2()).collect();
    let (_, bright) = adapted(&gains);
    let texels = greys(gains.iter().map(|gain| (1.0, *gain)));
    let shown = AdaptingEye::new().shown(50, &texels, SHIFTED, fixed(0.0, Tone::Reinhard), None);
    for (gain, shown) in gains.iter().zip(&shown) {
        // Gains clearly above the limit are white, gains clearly below it are not.
        let white = shown[0] > 1.0 - SHADER;
        assert!(gain.log2() < bright + BIN || white, "{gain}: {shown:?}");
        assert!(gain.log2() > bright - BIN || !white, "{gain}: {shown:?}");
    }
}

#[test]
fn tone_curves_are_the_published_ones_and_keep_hue() {
    let mut eye = AdaptingEye::new();
    let mut random = seeded(7);
    for tone in TONES {
        // At a fixed exposure of unshifted light, every gain is 2^stops, and so is white.
        for stops in [0.0, 4.0, 10.0] {
            let texels: Vec<[f32; 4]> = (0..1024)
                .map(|_| {
                    let bright = 10.0_f64.powf(random.random_range(-10.0..3.0));
                    [(); 3].map(|()| (bright * random.random_range(0.2..1.0)) as f32)
                })
                .map(|[r, g, b]| [r, g, b, 1.0])
                .collect();
            let shown = eye.shown(32, &texels, Stored::UNSHIFTED, fixed(stops, tone), None);
            for ([r, g, b, _], shown) in texels.iter().zip(&shown) {
                let exposed = [r, g, b].map(|value| f64::from(*value) * f64::from(stops).exp2());
                let exact = in_gamut(Gamut::Clamp, toned(tone, exposed, f64::from(stops).exp2()));
                for (shown, exact) in shown.iter().zip(exact) {
                    assert!(relative(*shown, exact) < SHADER, "{tone:?}: {exposed:?} is {shown} instead of {exact}");
                }
            }
        }
    }
}

#[test]
fn tone_curves_rise_from_black_to_white_over_twenty_decades() {
    let mut eye = AdaptingEye::new();
    let ramp: Vec<f64> = (0..1024).map(|step| 10.0_f64.powf(-10.0 + 20.0 * f64::from(step) / 1023.0)).collect();
    let texels = greys(ramp.iter().map(|gain| (1.0, *gain)));
    for exposure in [Exposure::AUTO, Exposure::WHITE, Exposure::Stops(60.0), Exposure::Stops(-60.0)] {
        for tone in TONES.into_iter().chain([Tone::Histogram]) {
            let development = Development { exposure, tone, gamut: Gamut::Desaturate };
            let shown = eye.shown(32, &texels, SHIFTED, development, None);
            assert!(shown.iter().flatten().all(|value| (0.0..=1.0).contains(value)));
            for pair in shown.windows(2) {
                assert!(
                    pair[1][0] >= pair[0][0] * (1.0 - SHADER),
                    "{development:?}: {} after {}",
                    pair[1][0],
                    pair[0][0]
                );
            }
        }
    }
}

#[test]
fn what_is_infinite_is_white_and_what_is_no_number_black() {
    let mut eye = AdaptingEye::new();
    let infinity = f32::INFINITY;
    let texels = [
        [infinity, infinity, infinity, 1.0],
        [f32::NAN, 0.5, 0.5, 1.0],
        [-infinity, -infinity, -infinity, 1.0],
        [f32::MAX, f32::MAX, f32::MAX, infinity],
        [infinity, 1.0, 1.0, f32::NAN],
        [0.25, 0.25, 0.25, 0.25],
    ];
    let mut frame = texels.to_vec();
    frame.extend([[0.25; 4]; 58]);
    for stored in [Stored::UNSHIFTED, SHIFTED, Stored { scale: 1e-200, ..SHIFTED }, Stored { scale: 1e200, ..SHIFTED }]
    {
        for exposure in [Exposure::AUTO, Exposure::WHITE] {
            for tone in TONES.into_iter().chain([Tone::Histogram]) {
                for gamut in GAMUTS {
                    let development = Development { exposure, tone, gamut };
                    let shown = eye.encoded(8, &frame, stored, development, None);
                    assert!(shown.iter().flatten().all(|value| (0.0..=1.0).contains(value)), "{development:?}");
                    assert_eq!(shown[1], [0.0; 3], "{development:?}: not a number");
                    assert_eq!(shown[2], [0.0; 3], "{development:?}: less than nothing");
                    if exposure == Exposure::WHITE && stored.scale == 1.0 {
                        assert!(
                            shown[0].iter().all(|value| *value > 0.999),
                            "{development:?}: infinite, {:?}",
                            shown[0]
                        );
                        assert!(
                            shown[3].iter().all(|value| *value > 0.999),
                            "{development:?}: immense, {:?}",
                            shown[3]
                        );
                    }
                }
            }
        }
    }
}

#[test]
fn gamut_mapping_is_the_published_one() {
    let mut eye = AdaptingEye::new();
    let mut random = seeded(8);
    let texels: Vec<[f32; 4]> = (0..4096).map(|_| [(); 4].map(|()| random.random_range(-1.0..2.5))).collect();
    for gamut in GAMUTS {
        let development = Development { gamut, ..fixed(0.0, Tone::Linear) };
        let shown = eye.shown(64, &texels, Stored::UNSHIFTED, development, None);
        for ([r, g, b, _], shown) in texels.iter().zip(&shown) {
            let colour = [r, g, b].map(|value| f64::from(*value));
            for (shown, exact) in shown.iter().zip(in_gamut(gamut, colour)) {
                assert!((shown - exact).abs() < SHADER, "{gamut:?}: {colour:?} is {shown} instead of {exact}");
            }
        }
    }
}

#[test]
fn desaturation_keeps_luminance_and_hue_and_loses_no_more_colour_than_it_must() {
    let mut random = seeded(9);
    let texels: Vec<[f32; 4]> = (0..4096).map(|_| [(); 4].map(|()| random.random_range(-0.5..1.5))).collect();
    let shown = AdaptingEye::new().shown(64, &texels, Stored::UNSHIFTED, Development::default(), None);
    for ([r, g, b, _], shown) in texels.iter().zip(shown) {
        let colour = [r, g, b].map(|value| f64::from(*value));
        let (before, after) = (luminance(colour), luminance(shown));
        assert!((before.clamp(0.0, 1.0) - after).abs() < SHADER, "{colour:?} is {shown:?}");
        // Differences from grey keep their proportions and their signs.
        let cross =
            |a: usize, b: usize| (colour[a] - before) * (shown[b] - after) - (colour[b] - before) * (shown[a] - after);
        if (0.0..=1.0).contains(&before) {
            assert!(cross(0, 1).abs() + cross(1, 2).abs() < 2.0 * SHADER, "{colour:?} is {shown:?}");
            let touches = shown.iter().any(|value| value.min(1.0 - value) < SHADER);
            assert!(
                touches || colour.iter().zip(shown).all(|(a, b)| (a - b).abs() < SHADER),
                "{colour:?} is {shown:?}"
            );
        }
    }
}

/// Base-2 logarithms of scene and screen for greys, by the histogram's curve.
fn equalised(scene: &[f64]) -> Vec<(f64, f64)> {
    let texels = greys(scene.iter().map(|value| (value.exp2(), 1.0)));
    let shown = AdaptingEye::new().shown(64, &texels, Stored::UNSHIFTED, fixed(0.0, Tone::Histogram), None);
    let mut curve: Vec<_> = scene.iter().zip(shown).map(|(scene, shown)| (*scene, shown[0].log2())).collect();
    curve.sort_by(|a, b| a.0.total_cmp(&b.0));
    curve
}

#[test]
fn a_histogram_without_peaks_gives_a_straight_curve_over_the_screens_range() {
    let octaves = f64::from(shaders::SCREEN_OCTAVES);
    let scene: Vec<f64> = (0..4096).map(|step| -15.0 + 30.0 * f64::from(step) / 4096.0).collect();
    for (scene, screen) in equalised(&scene) {
        let expected = (scene - 15.0) / 30.0 * octaves;
        assert!((screen - expected).abs() < BIN, "{scene}: {screen} instead of {expected}");
    }
}

#[test]
fn a_histogram_exaggerates_no_contrast_and_wastes_no_range() {
    let mut random = seeded(10);
    // Nine pixels of ten have one brightness: without the ceiling they would get nine tenths of the screen's range.
    let scene: Vec<f64> = (0..4096)
        .map(|index| if index % 10 == 0 { random.random_range(-15.0..15.0) } else { random.random_range(0.0..0.5) })
        .collect();
    let curve = equalised(&scene);
    for pair in curve.windows(2) {
        let (scene, screen) = (pair[1].0 - pair[0].0, pair[1].1 - pair[0].1);
        assert!(screen <= scene + 1e-3, "{scene} octaves become {screen}");
    }
    assert!(curve[curve.len() - 1].1 > -BIN, "the brightest is white");
    assert!(curve[0].1 < -0.9 * f64::from(shaders::SCREEN_OCTAVES), "the darkest is at the lower end: {:?}", curve[0]);
}

#[test]
fn a_frame_whose_range_the_screen_has_is_left_as_it_is() {
    let scene: Vec<f64> = (0..4096).map(|step| -6.0 * f64::from(step) / 4096.0).collect();
    for (scene, screen) in equalised(&scene) {
        assert!((scene - screen).abs() < SHADER, "{scene} is {screen}");
    }
}

#[test]
fn the_same_frames_give_the_same_bits() {
    let mut random = seeded(11);
    let frame = |random: &mut rand_chacha::ChaCha8Rng| -> Vec<[f32; 4]> {
        (0..512 * 256).map(|_| [(); 4].map(|()| random.random_range(-20.0..20.0_f32).exp2())).collect()
    };
    let frames = [frame(&mut random), frame(&mut random)];
    for tone in [Tone::Reinhard, Tone::Histogram] {
        let show = || {
            let mut eye = AdaptingEye::new();
            frames.each_ref().map(|frame| eye.encoded(512, frame, SHIFTED, automatic(tone), Some(0.1)))
        };
        assert!(show() == show(), "{tone:?}");
    }
}

#[test]
fn light_is_fetched_in_candela_and_never_infinite() {
    let texels = [[0.5, 1.0, -0.25, 1.0], [1e30, 60000.0, 0.0, 1.0]];
    let radiance = texture(2, &texels);
    let fetch = |stored| {
        let picture = light(gpu(), &radiance, &stored).unwrap();
        picture.pixels().map(|pixel| pixel.0).collect::<Vec<_>>()
    };
    assert_eq!(fetch(Stored::UNSHIFTED), [[0.5, 1.0, -0.25], [1e30, 60000.0, 0.0]]);
    let bright = Stored { white: 1e9, scale: 0.125, shifted: true };
    assert_eq!(fetch(bright), [[4e9, 8e9, -2e9], [f32::MAX, 4.8e14, 0.0]]);
}

#[test]
fn light_of_a_scene_is_its_picture_before_the_screen_and_the_searchlight_effect_multiplies_it_by_d_to_the_4th() {
    let view = View { look: DVec3::new(0.2, 0.1, -1.0), up: DVec3::Y, fov_degrees: 70.0, size: [96, 64] };
    let scene = Lattice::default().build();
    let mut photographer = Photographer::new(&scene, view.size, 1, None);
    let eye = DVec3::new(0.3, 0.2, 0.1);
    let at_rest = photographer.light(&view, eye, Celerity::ZERO, Effects::ALL);
    for (light, pixel) in at_rest.pixels().zip(photographer.seen(&view, eye, Celerity::ZERO, Effects::ALL).pixels()) {
        for (light, byte) in light.0.iter().zip(pixel.0) {
            assert!((encoded(f64::from(*light)) - f64::from(byte)).abs() < 0.51, "{light} cd/m² is {byte}");
        }
    }
    // The searchlight effect alone changes only brightness, in the directions at rest: D = γ + u·n.
    let searchlight = Effects { searchlight: true, ..Effects::NONE };
    for beta in [0.6, 0.999] {
        let celerity = Beta::new(DVec3::NEG_Z * beta).unwrap().celerity();
        let light = photographer.light(&view, eye, celerity, searchlight);
        for (column, row, pixel) in light.enumerate_pixels() {
            let doppler = celerity.gamma() + celerity.vector().dot(view.direction(middle([column, row])));
            for (shifted, rest) in pixel.0.iter().zip(at_rest.get_pixel(column, row).0) {
                let expected = f64::from(rest) * doppler.powi(4);
                assert!(
                    (f64::from(*shifted) - expected).abs() <= 1e-3 * expected,
                    "{shifted} instead of {expected} at D = {doppler}"
                );
            }
        }
    }
}
