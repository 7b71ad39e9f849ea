//! Law: every form of a machine that ParaView has written is read, and what is not followed is said. A wrong program
//! would refuse an ordinary window, or turn a wall over.
#![allow(clippy::unwrap_used, reason = "helpers of tests, too, may fail the test")]

use crate::containers::load;
use glam::{DVec2, DVec3};
use room::{Display, ScreenSurface};

const CORNERS: &str = "LowerLeft='-2 -1 -3' LowerRight='2 -1 -3'";

fn read(inside: &str) -> Display {
    load("x.pvx", format!("<pvx>{inside}</pvx>").as_bytes()).unwrap()
}

fn notes(display: &Display, word: &str) -> usize {
    display.notices.iter().filter(|notice| notice.contains(word)).count()
}

#[test]
fn a_machine_without_corners_is_an_ordinary_window() {
    for setting in ["", "<UseOffAxisProjection Value='0'/>", "<UseOffAxisProjection Value='False'/>"] {
        let display = read(&format!("<Machine Name='m' Geometry='80x40'/>{setting}"));
        let tan = 30.0_f64.to_radians().tan();
        let seen = |x, y| display.channels[0].point(&display, DVec2::new(x, y)).unwrap() - display.viewer.head_m;
        let upper_left = seen(0.0, 0.0) / -seen(0.0, 0.0).z;
        assert!(upper_left.distance(DVec3::new(-2.0 * tan, tan, -1.0)) < 1e-12, "{upper_left}");
        assert!(seen(0.5, 0.5).normalize().distance(DVec3::NEG_Z) < 1e-12);
        assert_eq!((notes(&display, "\"m\" has no corners"), notes(&display, "UseOffAxisProjection")), (1, 0));
    }
    let wanted = load("x.pvx", b"<pvx><Machine/><UseOffAxisProjection Value='1'/></pvx>").unwrap_err().to_string();
    assert!(wanted.contains("it has no LowerLeft"), "{wanted}");
}

#[test]
fn the_third_corner_may_be_the_upper_left() {
    for third in ["UpperLeft='-2 1 -3'", "UpperRight='2 1 -3'", "UpperLeft='-2 1 -3' UpperRight='2 1 -3'"] {
        let display = read(&format!("<Process Type='server'><Machine {CORNERS} {third}/></Process>"));
        let ScreenSurface::Flat(wall) = display.screens[0].surface else { panic!("not flat") };
        assert_eq!((wall.lower_left, wall.size_m()), (DVec3::new(-2.0, -1.0, -3.0), DVec2::new(4.0, 2.0)), "{third}");
    }
    for (third, word) in
        [("UpperLeft='-2 1 -3' UpperRight='3 1 -3'", "upper_right is 1.0000 m"), ("UpperLeft='1'", "three numbers")]
    {
        let text = format!("<pvx><Machine {CORNERS} {third}/></pvx>");
        let message = load("x.pvx", text.as_bytes()).unwrap_err().to_string();
        assert!(message.contains("line 1, <Machine>") && message.contains(word), "{message}");
    }
}

#[test]
fn what_is_not_followed_is_said_once() {
    let wall = format!("{CORNERS} UpperRight='2 1 -3'");
    for (value, count) in [("false", 1), ("FALSE", 1), ("0", 1), ("true", 0), ("1", 0)] {
        let display = read(&format!("<Machine {wall}/><Machine {wall}/><UseOffAxisProjection Value='{value}'/>"));
        assert_eq!(notes(&display, "UseOffAxisProjection"), count, "{value}");
    }
    let display = read(&format!("<Machine ViewerId='0' {wall}/><Machine ViewerId='1' {wall}/>"));
    assert_eq!((notes(&display, "ViewerId"), display.channels.len()), (1, 2));
    assert_eq!(notes(&read(&format!("<Machine {wall}/>")), "ViewerId"), 0);
}
