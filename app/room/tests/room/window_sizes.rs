//! Law: a window of another size shows all of its channels, to the same scale; and windows fill the monitors that they
//! have to themselves.
#![allow(clippy::unwrap_used, reason = "helpers of tests, too, may fail the test")]

use glam::DVec2;
use room::{Display, Monitor, WindowPlace};

#[test]
fn a_window_beyond_the_device_keeps_all_of_its_channels() {
    let mut display = Display::built_in("cave4").unwrap();
    let whole = display.clone();
    assert_eq!((display.shrink_to(2560).len(), &display), (0, &whole), "it fits");
    let notices = display.shrink_to(1000);
    assert_eq!(notices.len(), 2, "{notices:?}");
    assert!(notices[0].contains("2560 × 640") && notices[0].contains("1000 × 640"), "{notices:?}");
    let viewports: Vec<_> = display.channels.iter().map(|channel| channel.viewport).collect();
    for (viewport, before) in viewports.iter().zip(&whole.channels) {
        assert_eq!(*viewport, [before.viewport[0] * 1000 / 2560, 0, 250, 640]);
    }
}

#[test]
fn a_window_that_is_enlarged_is_filled_by_its_channels() {
    let mut display = Display::built_in("cave4").unwrap();
    let whole = display.clone();
    display.resize_window(1, [3841, 1080]);
    assert_eq!((display.windows[0].size, display.windows[1].size), ([2560, 640], [3841, 1080]));
    let of_window = |window| display.channels.iter().filter(move |channel| channel.window == window);
    let mut edges = of_window(1).map(|channel| (channel.viewport[0], channel.viewport[0] + channel.viewport[2]));
    let mut edges: Vec<_> = std::iter::from_fn(|| edges.next()).collect();
    edges.sort_unstable();
    assert_eq!((edges[0].0, edges.last().unwrap().1), (0, 3841));
    assert!(edges.windows(2).all(|pair| pair[0].1 == pair[1].0), "{edges:?}");
    assert!(of_window(1).all(|channel| channel.viewport[1] == 0 && channel.viewport[3] == 1080));
    for channel in of_window(0) {
        assert!(whole.channels.contains(channel), "the other window stays as it is");
    }
}

/// Full-screen windows of a display with windows at these monitors and positions.
fn filled(places: &[(Option<usize>, Option<[i32; 2]>)]) -> Vec<bool> {
    let mut display = Display::built_in("window").unwrap();
    let window = display.windows.remove(0);
    let place = |&(monitor, position): &(Option<usize>, _)| WindowPlace {
        monitor: monitor.map(Monitor::Index),
        position,
        ..window.clone()
    };
    display.windows = places.iter().map(place).collect();
    display.fill_monitors();
    display.windows.iter().map(|window| window.fullscreen).collect()
}

#[test]
fn windows_fill_the_monitors_that_they_have_to_themselves() {
    assert_eq!(filled(&[(None, None)]), [true]);
    assert_eq!(filled(&[(Some(1), None), (Some(0), None)]), [true, true]);
    assert_eq!(filled(&[(Some(1), None), (Some(0), None), (Some(1), None)]), [false, true, false]);
    assert_eq!(filled(&[(None, None), (None, None)]), [false, false]);
    assert_eq!(filled(&[(None, Some([0, 0]))]), [false], "it may span monitors");
}

#[test]
fn a_screen_that_nobody_has_measured_takes_its_windows_shape() {
    let mut display = Display::built_in("window").unwrap();
    let before = display.screens[0].surface.clone();
    display.shape_screens_as_windows();
    assert!((display.screens[0].surface.size_m() - before.size_m()).length() < 0.001, "both are 16:9");
    display.resize_window(0, [1024, 768]);
    display.shape_screens_as_windows();
    let after = &display.screens[0].surface;
    assert!((after.size_m() - before.size_m().y * DVec2::new(4.0 / 3.0, 1.0)).length() < 1e-12, "{}", after.size_m());
    let middle = DVec2::splat(0.5);
    assert!(after.point(middle).unwrap().distance(before.point(middle).unwrap()) < 1e-12);
}
