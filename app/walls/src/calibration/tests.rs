//! Law under test: keys move the chosen corner and nothing else, and corners that form no picture are refused. A
//! wrong program would move another corner, lose a fraction of a pixel at each press, or turn a picture inside out.

use super::*;
use room::{CornerWarp, Warp};

/// Display with two channels: the built-in stereo wall.
fn wall() -> Display {
    Display::built_in("stereo-wall").unwrap()
}

/// Calibration of the stereo wall after the given keys; `true` means with Shift.
fn after(keys: &[(CornerKey, bool)]) -> Calibration {
    let mut calibration = Calibration::new(&wall());
    for (key, shift) in keys {
        calibration.press(*key, *shift).unwrap();
    }
    calibration
}

#[test]
fn tab_goes_round_all_corners_of_all_channels_and_back() {
    let mut calibration = after(&[]);
    let mut met = Vec::new();
    for _ in 0..8 {
        met.push(calibration.chosen());
        assert_eq!(calibration.press(CornerKey::Tab, false), Ok(None));
    }
    assert_eq!(met, [(0, 0), (0, 1), (0, 2), (0, 3), (1, 0), (1, 1), (1, 2), (1, 3)]);
    assert_eq!(calibration.chosen(), (0, 0));
    for expected in met.into_iter().rev() {
        calibration.press(CornerKey::Tab, true).unwrap();
        assert_eq!(calibration.chosen(), expected);
    }
}

#[test]
fn arrows_move_the_chosen_corner_by_one_and_ten_pixels() {
    let calibration = after(&[
        (CornerKey::Tab, false),
        (CornerKey::Left, true),
        (CornerKey::Left, false),
        (CornerKey::Down, true),
        (CornerKey::Up, false),
    ]);
    let expected = [DVec2::ZERO, DVec2::new(1013.0, 9.0), DVec2::new(1024.0, 768.0), DVec2::new(0.0, 768.0)];
    assert_eq!(calibration.changed(), [("left", Some(expected))]);
    let size = DVec2::new(1024.0, 768.0);
    assert_eq!(calibration.warp(0), Some(Warp::Corners(CornerWarp::new(expected.map(|place| place / size)).unwrap())));
    assert_eq!(calibration.warp(1), None);
}

#[test]
fn a_press_says_which_channel_has_moved() {
    let mut calibration = after(&[(CornerKey::Tab, true)]);
    assert_eq!(calibration.press(CornerKey::Up, false), Ok(Some(1)));
    assert_eq!(calibration.press(CornerKey::Back, false), Ok(Some(1)));
    assert_eq!(calibration.press(CornerKey::Back, false), Ok(None));
}

#[test]
fn there_and_back_is_nothing() {
    let calibration =
        after(&[(CornerKey::Right, false), (CornerKey::Left, false), (CornerKey::Up, true), (CornerKey::Down, true)]);
    assert_eq!(calibration, after(&[]));
    assert!(calibration.changed().is_empty());
}

#[test]
fn backspace_goes_to_where_the_file_has_it_and_with_shift_to_the_viewport() {
    // A third of a pixel is used so that rounding would show.
    let mut display = wall();
    let size = DVec2::new(1024.0, 768.0);
    let in_file = [DVec2::new(7.333_333, 5.1), DVec2::new(1024.0, 0.0), size, DVec2::new(0.0, 768.0)];
    display.channels[0].warp = Some(Warp::Corners(CornerWarp::new(in_file.map(|place| place / size)).unwrap()));
    let mut calibration = Calibration::new(&display);
    assert_eq!(calibration.warp(0), display.channels[0].warp);
    calibration.press(CornerKey::Right, true).unwrap();
    assert_eq!(calibration.changed().len(), 1);
    calibration.press(CornerKey::Back, false).unwrap();
    assert_eq!(calibration.warp(0), display.channels[0].warp);
    calibration.press(CornerKey::Back, true).unwrap();
    assert_eq!(calibration.warp(0), None);
    assert_eq!(calibration.changed(), [("left", None)]);
    calibration.saved();
    assert!(calibration.changed().is_empty());
    calibration.press(CornerKey::Back, false).unwrap();
    assert_eq!(calibration.warp(0), None);
}

#[test]
fn a_corner_beyond_the_others_is_refused_and_stays() {
    let mut display = wall();
    display.channels[0].viewport = [0, 0, 30, 30];
    let mut calibration = Calibration::new(&display);
    // The upper left corner may go down the diagonal to the line between its neighbours, x + y = 30.
    for key in [CornerKey::Right, CornerKey::Down] {
        calibration.press(key, true).unwrap();
    }
    let before = calibration.clone();
    calibration.press(CornerKey::Right, false).unwrap();
    let mut refused = None;
    for _ in 0..20 {
        refused = calibration.press(CornerKey::Right, false).err().or(refused);
    }
    assert!(matches!(refused, Some(CalibrationError::NotConvex { ref channel, .. }) if channel == "left"));
    assert!(calibration.warp(0).is_some());
    calibration.press(CornerKey::Back, false).unwrap();
    assert_ne!(calibration, before);
    assert_eq!(calibration.warp(0), None);
}

#[test]
fn corners_of_a_measured_warp_stay() {
    let mut display = wall();
    let places = vec![DVec2::ZERO, DVec2::X, DVec2::Y, DVec2::ONE];
    display.channels[0].warp = Some(Warp::Grid(room::MeasuredWarp::new(2, 2, places)));
    let mut calibration = Calibration::new(&display);
    let refused = calibration.press(CornerKey::Down, false);
    assert_eq!(refused, Err(CalibrationError::MeasuredWarp { channel: "left".into() }));
    assert!(calibration.changed().is_empty());
}
