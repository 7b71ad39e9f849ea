//! Law: the built-in displays have the geometry that the theses describe, and their files are valid. A wrong display
//! would otherwise be noticed only on the real wall.
#![allow(clippy::unwrap_used, reason = "helpers of tests, too, may fail the test")]

use glam::{DMat3, DVec2};
use room::{Display, EyeSide, ScreenSurface, built_in, frustum};

#[test]
fn each_is_read_and_says_what_it_is() {
    for name in built_in::NAMES {
        let display = Display::built_in(name).unwrap();
        println!("{name}\n{display}");
        assert_eq!(display.name, name);
        assert!(display.notices.is_empty(), "{name}: {:?}", display.notices);
    }
}

#[test]
fn the_walls_of_the_caves_close_without_a_gap() {
    for (name, count) in [("cave4", 4), ("cave6", 6)] {
        let display = Display::built_in(name).unwrap();
        assert_eq!(display.screens.len(), count);
        let corners = |screen: usize| {
            [DVec2::ZERO, DVec2::X, DVec2::Y, DVec2::ONE].map(|uv| display.screens[screen].surface.point(uv).unwrap())
        };
        // Every corner of a closed cube belongs to three walls; without ceiling and back, to at least two.
        for screen in 0..count {
            for corner in corners(screen) {
                let shared = (0..count).filter(|&other| corners(other).contains(&corner)).count();
                let open = corner.y == 3.0 || corner.z == 1.5;
                assert!(shared == 3 || count == 4 && open, "{name} {corner}: {shared}");
            }
        }
    }
}

#[test]
fn each_eye_sees_every_flat_wall_from_the_front() {
    for name in built_in::NAMES {
        let display = Display::built_in(name).unwrap();
        for channel in &display.channels {
            let eye = display.viewer.eye_m(channel.eye, display.viewer.head_m, DMat3::IDENTITY);
            if let Some(flat) = channel.flat(&display) {
                frustum(&flat, eye).unwrap();
            }
        }
    }
}

#[test]
fn the_dome_is_fourteen_metres_and_its_projectors_stand_on_the_rim() {
    let display = Display::built_in("dome6").unwrap();
    let ScreenSurface::Sphere(sphere) = &display.screens[0].surface else { panic!("no sphere") };
    assert_eq!((sphere.radius_m, display.projectors.len()), (7.0, 6));
    for projector in &display.projectors {
        let offset = projector.position_m - sphere.centre;
        assert!((offset.length() - 7.0).abs() < 1e-8 && offset.y == 0.0, "{}", projector.name);
    }
    assert!(display.channels.iter().all(|channel| channel.eye == EyeSide::Centre));
}

#[test]
fn the_sheet_is_four_and_a_half_by_three_metres_and_wholly_lit() {
    let display = Display::built_in("curved").unwrap();
    let surface = &display.screens[0].surface;
    // Measure along the profile, in steps of a millimetre.
    let steps = 3000;
    let along: Vec<_> =
        (0..=steps).map(|step| surface.point(DVec2::new(0.5, f64::from(step) / f64::from(steps))).unwrap()).collect();
    let length: f64 = along.windows(2).map(|pair| pair[0].distance(pair[1])).sum();
    assert!((length - 3.0).abs() < 2e-3, "{length}");
    let width = surface.point(DVec2::X).unwrap().distance(surface.point(DVec2::ZERO).unwrap());
    assert!((width - 4.5).abs() < 1e-12);
    for uv in [[0.0, 0.0], [1.0, 0.0], [0.0, 1.0], [1.0, 1.0], [0.5, 0.3]] {
        let point = surface.point(uv.into()).unwrap();
        assert!(display.channels.iter().all(|channel| channel.place(&display, point).is_some()), "{point}");
    }
}
