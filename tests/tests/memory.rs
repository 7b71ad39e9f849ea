//! The memory of the process must not grow with the number of pictures, so that a ride or a film may last.
//!
//! A wrong program has a condition in a shader that is equal for all pixels: for its every value lavapipe compiles
//! and keeps a shader (256 KiB a draw, it was). Or it holds on to buffers of old cuts.
//!
//! The test is a binary of its own: it measures the memory of its process, in which no other test may draw.
#![allow(clippy::unwrap_used, reason = "a failed construction is a failed test")]

use built_in::town;
use glam::DVec3;
use physics::Beta;
use scene::motion::Motion;
use system_tests::bodies::{passing, sphere};
use system_tests::photographer::{AS_GIVEN, DEFAULT_MAP, Photographer};
use system_tests::view::View;
use view::{Dial, Effects};

const SIZE: [u32; 2] = [64, 36];

/// Pictures until everything is compiled and every pool is filled, then pictures after that.
const FIRST: usize = 12;
const MORE: usize = 36;

/// Growth that pools may still have, MiB: a leak of one cut, map or shader a picture is some hundreds.
const SPREAD_MIB: f64 = 60.0;

/// Resident memory of the process, MiB.
fn resident() -> f64 {
    let status = std::fs::read_to_string("/proc/self/status").unwrap();
    let line = status.lines().find(|line| line.starts_with("VmRSS:")).unwrap();
    line.split_whitespace().nth(1).unwrap().parse::<f64>().unwrap() / 1024.0
}

#[test]
fn a_film_needs_no_more_memory_the_longer_it_is() {
    let mut scene = town::build(1);
    let (start, look) = (scene.start.position + DVec3::Y * 1.6, scene.start.look);
    // Add a moving body as well, which the map's method draws in another way.
    let place = start + 6.0 * look.normalize();
    let mut ball = sphere(place, 0.3).meshes.remove(0);
    ball.positions.iter_mut().for_each(|position| *position += (place - scene.origin).as_vec3());
    ball.motion = Some(scene.motions.len());
    scene.meshes.push(ball);
    scene.motions.push(Motion::Uniform(passing(DVec3::Y * 0.5, place, start)));
    let view = View { look, up: DVec3::Y, fov_degrees: 60.0, size: SIZE };
    let cut = Dial::tolerance(2.0);
    for (method, background) in [(cut, None), (AS_GIVEN, Some([0.1, 0.2, 0.3])), (DEFAULT_MAP, None)] {
        let mut photographer = Photographer::with(&scene, SIZE, 1, background, method);
        let mut film = |pictures: std::ops::Range<usize>| {
            for picture in pictures {
                let share = picture as f64 / (FIRST + MORE) as f64;
                let celerity = Beta::new(look.normalize() * 0.9 * share).unwrap().celerity();
                let _ = photographer.seen(&view, start + look.normalize() * share, celerity, Effects::ALL);
            }
            resident()
        };
        let before = film(0..FIRST);
        let after = film(FIRST..FIRST + MORE);
        println!("{method}: {before:.0} MiB after {FIRST} pictures, {after:.0} MiB after {MORE} more");
        assert!(after - before < SPREAD_MIB, "{method}: from {before:.0} to {after:.0} MiB");
    }
}
