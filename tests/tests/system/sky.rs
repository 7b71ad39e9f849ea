//! A pixel without a surface must show the world's sky in the direction that aberration assigns to it. Sky, haze and
//! sun are functions of a world direction; the shader takes each pixel's direction there in f32, this test by
//! `physics` in f64.
//!
//! In a wrong program, a boost the wrong way round stretches the sky where it should crowd ahead. A direction that is
//! not normalised makes bands towards the corners. The plain sky behind moving boxes keeps its horizon level.
#![allow(clippy::unwrap_used, reason = "a failed construction is a failed test")]

use glam::DVec3;
use physics::{Aberration, Beta, Celerity};
use scene::{Lighting, Scene};
use system_tests::colour::encoded;
use system_tests::photographer::Photographer;
use system_tests::view::{View, middle};

const SIZE: [u32; 2] = [160, 120];

/// Tolerance in steps of a byte: half for rounding, half for f32 where the sun's limb rises by 255 steps within 0.4°.
const TOLERANCE: f64 = 1.0;

/// Linear colour of the sky in a world direction: a gradient up to the zenith, haze below the horizon, a glow and a
/// disc at the sun.
fn sky(light: &Lighting, direction: DVec3) -> DVec3 {
    let colour = |rgb: [f32; 3]| DVec3::from_array(rgb.map(f64::from));
    let rise = |from: f64, to: f64, x: f64| {
        let t = ((x - from) / (to - from)).clamp(0.0, 1.0);
        t * t * (3.0 - 2.0 * t)
    };
    let height = direction.y;
    let clear = colour(light.horizon).lerp(colour(light.zenith), rise(0.0, 0.9, height.max(0.0).sqrt()));
    let haze = clear.lerp(2.0 * colour(light.ground), rise(0.0, -0.25, height));
    let cosine = direction.dot(light.sun_direction.as_dvec3()).max(0.0);
    haze + colour(light.sun) * (0.25 * cosine.powi(24) + 4.0 * rise(0.999_85, 0.999_95, cosine))
}

#[test]
fn each_pixel_shows_the_sky_of_its_world_direction() {
    let scene = Scene::default();
    let sun = scene.light.sun_direction.as_dvec3();
    let mut photographer = Photographer::new(&scene, SIZE, 1, None);
    for beta in [0.0, 0.5, 0.9, 0.99, 0.9999] {
        for along in [DVec3::NEG_Z, DVec3::new(1.0, -0.4, 0.3), DVec3::Y] {
            let motion = Beta::new(along.normalize() * beta).unwrap().celerity();
            let aberration = Aberration::new(motion);
            let (sun_seen, _) = aberration.observer_from_world(sun);
            for look in [along, -along, sun_seen, DVec3::new(0.3, 0.1, -1.0)] {
                let view = View { look, up: DVec3::new(0.2, 0.9, 0.1), fov_degrees: 75.0, size: SIZE };
                let drawn = photographer.moving(&view, DVec3::ZERO, motion);
                for (column, row, pixel) in drawn.enumerate_pixels() {
                    let (direction, _) = aberration.world_from_observer(view.direction(middle([column, row])));
                    let expected = sky(&scene.light, direction).to_array().map(encoded);
                    let error = (0..3).map(|i| (f64::from(pixel[i]) - expected[i]).abs()).fold(0.0, f64::max);
                    assert!(
                        error < TOLERANCE,
                        "{pixel:?} instead of {expected:?} at {column}, {row} of {view:?}, {beta} c along {along}"
                    );
                }
            }
        }
    }
}

#[test]
fn a_background_hides_the_sky_from_a_moving_eye_too() {
    let mut photographer = Photographer::new(&Scene::default(), SIZE, 1, Some([0.25, 0.5, 1.0]));
    let view = View { look: DVec3::X, up: DVec3::Y, fov_degrees: 60.0, size: SIZE };
    let motion = Celerity::new(DVec3::X * 3.0).unwrap();
    let expected = system_tests::colour::srgb_pixel([0.25, 0.5, 1.0]);
    for picture in [photographer.moving(&view, DVec3::ZERO, motion), photographer.plain(&view, DVec3::ZERO)] {
        assert!(picture.pixels().all(|pixel| pixel.0 == expected));
    }
}
