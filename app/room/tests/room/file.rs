//! Law: display files mean what they say, and each flaw is named with its file, line, key and reason. A wrong program
//! would take a typing error for a default, or refuse without naming the place.
#![allow(clippy::unwrap_used, clippy::panic, reason = "helpers of tests, too, may fail the test")]

use glam::{DVec2, DVec3};
use room::{Combine, Display, DisplayError, EyeSide, Monitor, ScreenSurface, Warp, file};
use std::path::Path;

/// Core of the file format; it must remain readable.
const CORE: &str = r#"[viewer]
eye_separation = 0.064
[[screen]]
name = "front"
lower_left  = [-1.5, 0.0, -1.5]
lower_right = [ 1.5, 0.0, -1.5]
upper_left  = [-1.5, 3.0, -1.5]
[[window]]
name = "main"
size = [960, 480]
[[channel]]
name = "front-left"            # its picture's file name
screen = "front"
eye = "left"                   # left | right | centre
window = "main"
viewport = [0, 0, 480, 480]    # x, y, width, height in the window, pixels from its upper left
"#;

fn parse(text: &str) -> Result<Display, DisplayError> {
    file::parse(text, "d.toml", Path::new(""))
}

/// Display from the core with one thing changed.
fn changed(from: &str, to: &str) -> Result<Display, DisplayError> {
    assert!(CORE.contains(from), "{from}");
    parse(&CORE.replacen(from, to, 1))
}

/// Display from the core with something added at its end, which is within the channel's table.
fn added(tail: &str) -> Result<Display, DisplayError> {
    parse(&format!("{CORE}{tail}"))
}

fn flat(display: &Display) -> room::FlatSurface {
    let ScreenSurface::Flat(flat) = display.screens[0].surface else { panic!("not flat") };
    flat
}

#[test]
fn the_core_of_the_schema_is_read_as_written() {
    let display = parse(CORE).unwrap();
    assert_eq!(display.viewer.eye_separation_m, 0.064);
    assert_eq!(display.viewer.eye_scale, 1.0);
    let flat = flat(&display);
    assert_eq!(flat.lower_left, DVec3::new(-1.5, 0.0, -1.5));
    assert_eq!((flat.right, flat.up), (DVec3::X * 3.0, DVec3::Y * 3.0));
    assert_eq!((display.windows[0].name.as_str(), display.windows[0].size), ("main", [960, 480]));
    let channel = &display.channels[0];
    assert_eq!((channel.name.as_str(), channel.eye, channel.viewport), ("front-left", EyeSide::Left, [0, 0, 480, 480]));
    assert_eq!((channel.screen, channel.window), (0, 0));
    assert_eq!(channel.flat(&display), Some(flat));
    assert!(channel.gains(&display, [4, 4]).is_none() && display.notices.is_empty());
}

#[test]
fn pixels_run_right_and_down_and_the_surface_up() {
    let display = parse(CORE).unwrap();
    let point = |x, y| display.channels[0].point(&display, DVec2::new(x, y)).unwrap();
    assert_eq!(point(0.0, 0.0), DVec3::new(-1.5, 3.0, -1.5));
    assert_eq!(point(1.0, 1.0), DVec3::new(1.5, 0.0, -1.5));
    let points = display.channels[0].points(&display, [3, 2]);
    assert_eq!(points[5].unwrap().distance(point(5.0 / 6.0, 0.75)), 0.0, "pixel centres, row by row");
    // A part of the picture: its right upper quarter.
    let display = added("part = [0.5, 0.5, 1.0, 1.0]\n").unwrap();
    let point = |x, y| display.channels[0].point(&display, DVec2::new(x, y)).unwrap();
    assert_eq!(point(0.0, 1.0), DVec3::new(0.0, 1.5, -1.5));
    assert_eq!(display.channels[0].flat(&display).unwrap().lower_left, DVec3::new(0.0, 1.5, -1.5));
}

#[test]
fn any_three_corners_and_the_centre_say_the_same() {
    let corners = flat(&parse(CORE).unwrap());
    let ll = "lower_left  = [-1.5, 0.0, -1.5]\n";
    let lr = "lower_right = [ 1.5, 0.0, -1.5]\n";
    let ul = "upper_left  = [-1.5, 3.0, -1.5]\n";
    for left_out in [ll, lr, ul] {
        let three = changed(left_out, "upper_right = [1.5, 3.0, -1.5]\n").unwrap();
        assert_eq!(flat(&three), corners, "without {left_out}");
    }
    let centre = CORE.replace(lr, "").replace(ul, "").replace(ll, "centre = [0.0, 1.5, -1.5]\nsize = [3, 3]\n");
    assert_eq!(flat(&parse(&centre).unwrap()), corners);

    // Turns go to the left, down, and on its side: yaw is to the left, pitch up, roll counter-clockwise.
    let centre = centre.replace("[viewer]", "[viewer]\nhead = [5, 5, 5]");
    let turned = |angles: &str| flat(&parse(&centre.replacen("size", &format!("{angles}\nsize"), 1)).unwrap());
    assert_eq!(turned("yaw = 90").normal(), DVec3::X);
    assert_eq!(turned("pitch = -90").normal(), DVec3::Y);
    assert_eq!(turned("yaw = 90").right, DVec3::NEG_Z * 3.0);
    assert_eq!(turned("roll = 90").right, DVec3::Y * 3.0);
    assert_eq!(turned("yaw = 90\npitch = -90").up, DVec3::NEG_X * 3.0);
}

#[test]
fn everything_else_that_can_be_written_is_kept() {
    let display = parse(
        r#"
        name = "lab"
        [viewer]
        eye_separation = 0.07
        eye_scale = 10
        head = [0.1, 1.7, 0.2]
        [tracker]
        source = "dtrack"
        bodies = [{ port = 5000 }]
        [[screen]]
        name = "s"
        centre = [0, 1, -2]
        size = [2, 2]
        [[window]]
        name = "w"
        size = [100, 50]
        monitor = "DP-1"
        position = [-20, 10]
        fullscreen = true
        combine = "anaglyph-dubois"
        swap_eyes = true
        [[window]]
        name = "v"
        monitor = 1
        size = [100, 50]
        combine = "checker"
        [[channel]]
        name = "l"
        screen = "s"
        eye = "left"
        window = "w"
        [[channel]]
        name = "r"
        screen = "s"
        eye = "right"
        window = "w"
        [channel.corners]
        upper_left = [10, 5]
        "#,
    )
    .unwrap();
    assert_eq!((display.name.as_str(), display.viewer.eye_scale), ("lab", 10.0));
    assert_eq!(display.viewer.head_m, DVec3::new(0.1, 1.7, 0.2));
    assert_eq!(display.set_up["tracker"]["bodies"][0]["port"].as_integer(), Some(5000));
    let window = &display.windows[0];
    assert_eq!(window.monitor, Some(Monitor::Name("DP-1".into())));
    assert_eq!((window.position, window.fullscreen, window.swap_eyes), (Some([-20, 10]), true, true));
    assert_eq!((window.combine, display.windows[1].combine), (Combine::AnaglyphDubois, Combine::Checker));
    assert_eq!(display.windows[1].monitor, Some(Monitor::Index(1)));
    let warp = display.channels[1].warp.as_ref();
    assert!(matches!(warp, Some(Warp::Corners(corners)) if corners.places[0] == DVec2::splat(0.1)));
    // Colours cannot both tell the eyes apart and show the Doppler shift; and one window is unused.
    assert_eq!(display.notices.len(), 2, "{:?}", display.notices);
    assert!(display.notices[0].contains("Doppler") && display.notices[1].contains("\"v\""));
}

/// Asserts that the error names its line and contains these words.
fn says(result: Result<Display, DisplayError>, line: usize, words: &[&str]) {
    let message = result.expect_err(&format!("{words:?} was taken")).to_string();
    for word in words.iter().map(ToString::to_string).chain([format!("d.toml, line {line}")]) {
        assert!(message.contains(&word), "{message:?} does not say {word:?}");
    }
}

#[test]
fn corners_that_are_no_rectangle_are_refused() {
    says(changed("[-1.5, 3.0, -1.5]", "[-1.0, 3.0, -1.5]"), 3, &["screen \"front\"", "no rectangle", "80.5"]);
    says(changed("[-1.5, 3.0, -1.5]", "[-1.5, 0.0, -1.5]"), 3, &["screen \"front\"", "length"]);
    let fourth = "upper_left  = [-1.5, 3.0, -1.5]\nupper_right = [1.5, 3.0, -1.4]";
    says(changed("upper_left  = [-1.5, 3.0, -1.5]", fourth), 3, &["upper_right", "0.1000 m"]);
    // An error of a millimetre in a measured corner is accepted, and is corrected.
    let flat = flat(&changed("[-1.5, 3.0, -1.5]", "[-1.501, 3.0, -1.5]").unwrap());
    assert!(flat.right.dot(flat.up).abs() < 1e-15);
}

#[test]
fn screens_without_a_place_or_with_two_are_refused() {
    says(changed("upper_left  = [-1.5, 3.0, -1.5]\n", ""), 3, &["needs three of"]);
    says(changed("upper_left", "centre = [0, 0, 0]\nupper_left"), 3, &["more than once"]);
    says(added("[[screen]]\nname = \"b\"\n"), 17, &["screen \"b\"", "nowhere"]);
    says(added("[[screen]]\nname = \"b\"\ncentre = [0, 0, 0]\n"), 19, &["key centre", "no size"]);
    says(added("[[screen]]\nname = \"b\"\ncentre = [0, 0, 0]\nsize = [1, 0]\n"), 20, &["key size", "length"]);
    let cylinder =
        |keys: &str| added(&format!("[[screen]]\nname = \"b\"\ncylinder = {{ {keys}, bottom = 0, top = 2 }}\n"));
    says(cylinder("radius = 0, left = 10, right = -10"), 19, &["radius"]);
    says(cylinder("radius = 1, left = -10, right = 10"), 19, &["left = -10", "to the left"]);
    says(cylinder("radius = nan, left = 10, right = -10"), 19, &["not a finite number"]);
    says(added("[[screen]]\nname = \"b\"\nsphere = { radius = 1, top = 91 }\n"), 19, &["pitches"]);
    let sweep = "[[screen]]\nname = \"b\"\nsweep = { width = 1, profile = [[0, 1], [0, 0], [1, 0]], bend = 2 }\n";
    says(added(sweep), 19, &["bend = 2", "corner 2"]);
    // A table of its own, with a key of that name further below: the line is that of the screen itself.
    let below = "[[screen]]\nname = \"b\"\n[screen.sweep]\nwidth = 0\nprofile = []\n[[screen]]\nname = \"c\"\nsweep = { width = 1, profile = [] }\n";
    says(added(below), 17, &["screen \"b\", key sweep", "width = 0"]);
    let missing = added("[[screen]]\nname = \"b\"\nmesh = \"nowhere.obj\"\n").unwrap_err().to_string();
    assert!(missing.contains("nowhere.obj: cannot be read"), "{missing}");
}

#[test]
fn numbers_that_are_none_are_refused() {
    says(changed("[-1.5, 3.0, -1.5]", "[-1.5, inf, -1.5]"), 7, &["key upper_left", "not a finite number"]);
    says(changed("0.064", "nan"), 2, &["viewer, key eye_separation"]);
    says(changed("0.064", "64"), 2, &["64 m"]);
    says(changed("0.064", "0.064\nhead = [0, nan, 0]"), 3, &["viewer, key head"]);
    says(changed("0.064", "0.064\neye_scale = -1"), 3, &["viewer, key eye_scale"]);
    says(changed("[960, 480]", "[960, 0]"), 10, &["window \"main\", key size"]);
    says(changed("[960, 480]", "[960, 480]\nmonitor = -1"), 11, &["key monitor"]);
    says(changed("[0, 0, 480, 480]", "[0, 0, 0, 480]"), 16, &["channel \"front-left\", key viewport", "at least one"]);
    says(changed("[0, 0, 480, 480]", "[0, 0, 480, -480]"), 16, &["invalid value"]);
    says(added("part = [0.5, 0, 0.5, 1]\n"), 17, &["key part"]);
    says(added("corners = { upper_left = [600, 0] }\n"), 17, &["key corners", "convex"]);
    says(added("alpha_gamma = 0\nalpha = \"a.png\"\n"), 17, &["key alpha_gamma"]);
}

#[test]
fn viewports_outside_their_window_are_refused() {
    says(changed("[0, 0, 480, 480]", "[481, 0, 480, 480]"), 16, &["[481, 0, 480, 480]", "\"main\"", "960 × 480"]);
    says(changed("[0, 0, 480, 480]", "[4294967295, 0, 480, 480]"), 16, &["not inside"]);
}

#[test]
fn only_two_eyes_may_share_pixels() {
    let second = |eye: &str, viewport: &str| {
        format!(
            "[[channel]]\nname = \"b\"\nscreen = \"front\"\neye = \"{eye}\"\nwindow = \"main\"\nviewport = {viewport}\n"
        )
    };
    says(
        added(&second("right", "[479, 479, 2, 1]")),
        22,
        &["channel \"b\"", "overlaps that of channel \"front-left\""],
    );
    assert!(added(&second("right", "[480, 0, 480, 480]")).is_ok());
    // A window that combines eyes accepts the other eye on the same pixels, and nothing else.
    let combined = CORE.replace("size = [960, 480]", "size = [960, 480]\ncombine = \"rows\"");
    let pair = parse(&format!("{combined}{}", second("right", "[0, 0, 480, 480]"))).unwrap();
    assert_eq!((pair.partner(0), pair.partner(1), pair.notices.len()), (Some(1), Some(0), 0));
    let alone = parse(&combined).unwrap();
    assert!(alone.partner(0).is_none() && alone.notices[0].contains("the other eye"), "{:?}", alone.notices);
    says(parse(&format!("{combined}{}", second("left", "[0, 0, 480, 480]"))), 23, &["overlaps"]);
    says(parse(&format!("{combined}{}", second("centre", "[0, 0, 480, 480]"))), 23, &["overlaps"]);
    says(parse(&format!("{combined}{}", second("right", "[0, 0, 480, 479]"))), 23, &["overlaps"]);
}

#[test]
fn eyes_behind_their_screen_are_refused() {
    let message = changed("eye_separation = 0.064", "head = [0, 1.6, -1.75]");
    says(message, 11, &["channel \"front-left\"", "screen \"front\"", "left eye", "0.250 m behind"]);
    // One eye may be behind a wall at the side, and the other in front of it.
    let side = |eye: &str| {
        let wall =
            CORE.replace("[-1.5, 0.0, -1.5]", "[-1.5, 0.0, 1.5]").replace("[ 1.5, 0.0, -1.5]", "[-1.5, 0.0, -1.5]");
        let wall = wall.replace("[-1.5, 3.0, -1.5]", "[-1.5, 3.0, 1.5]").replace("\"left\"", eye);
        parse(&wall.replace("[viewer]", "[viewer]\nhead = [-1.49, 1.6, 0]"))
    };
    says(side("\"left\""), 12, &["left eye", "behind"]);
    assert!(side("\"right\"").is_ok());
}

#[test]
fn names_must_stand_for_something() {
    says(changed("screen = \"front\"", "screen = \"frnt\""), 13, &["no screen \"frnt\"", "did you mean \"front\"?"]);
    says(changed("window = \"main\"", "window = \"other\""), 15, &["no window \"other\"", "there is main"]);
    says(changed("\"left\" ", "\"middle\""), 14, &["no eye \"middle\"", "left, right, centre"]);
    says(added("projector = \"p\"\n"), 17, &["no projector \"p\"", "there is none"]);
    says(changed("[960, 480]", "[960, 480]\ncombine = \"anaglyph-dubios\""), 11, &["did you mean \"anaglyph-dubois\""]);
}

#[test]
fn names_are_unique_and_fit_for_files() {
    says(
        added("[[screen]]\nname = \"front\"\ncentre = [0, 0, -1]\nsize = [1, 1]\n"),
        18,
        &["another screen", "\"front\""],
    );
    says(added("[[window]]\nname = \"main\"\nsize = [1, 1]\n"), 18, &["another window"]);
    says(added("[[window]]\nname = \" \"\nsize = [1, 1]\n"), 18, &["empty"]);
    let again = CORE.split_once("[[channel]]").unwrap().1;
    says(added(&format!("[[channel]]{again}")), 18, &["another channel"]);
    for name in ["../x", "a\\\\b", ".x", "a:b", "a\\u0000b"] {
        says(changed("\"front-left\"", &format!("\"{name}\"")), 12, &["cannot be a name", "picture is a file"]);
    }
}

#[test]
fn keys_that_are_unknown_are_refused_with_the_one_that_was_meant() {
    says(changed("lower_left ", "lower_lef"), 5, &["unknown field `lower_lef`", "did you mean `lower_left`?"]);
    says(changed("eye_separation", "eye_seperation"), 2, &["did you mean `eye_separation`?"]);
    says(changed("[viewer]", "[viewers]"), 1, &["did you mean `viewer`?"]);
    says(changed("name = \"front\"\n", ""), 3, &["missing field `name`"]);
    says(changed("[960, 480]", "[960, 480"), 11, &[]);
    says(changed("[960, 480]", "\"big\""), 10, &["invalid type"]);
    says(added("[[screen]]\nname = \"b\"\nsphere = 3\n"), 19, &["expected a table"]);
    let message = parse("").unwrap_err().to_string();
    assert_eq!(message, "d.toml: it has no [[channel]], so nothing would be seen");
}

#[test]
fn projectors_are_checked_as_well() {
    let projector =
        |keys: &str| added(&format!("projector = \"p\"\n[[projector]]\nname = \"p\"\nposition = [0, 1, 0]\n{keys}"));
    let display = projector("throw_ratio = 1\nsize = [4, 3]\n").unwrap();
    assert!(display.channels[0].flat(&display).is_none(), "a projector's pixels lie where its light falls");
    says(projector(""), 18, &["projector \"p\"", "throw_ratio and size, or tangents"]);
    says(projector("throw_ratio = 0\nsize = [4, 3]\n"), 21, &["key throw_ratio"]);
    says(projector("throw_ratio = 1\n"), 18, &["size in pixels"]);
    says(projector("tangents = [1, -1, -1, 1]\n"), 21, &["left < right"]);
    says(projector("lens = \"fisheye\"\n"), 21, &["no lens \"fisheye\"", "pinhole, scan, table"]);
    says(projector("lens = \"scan\"\nthrow_ratio = 1\n"), 22, &["belongs to lens = \"pinhole\""]);
    says(projector("lens = \"scan\"\nsize = [1280, 768]\nstep = 0.2\n"), 23, &["wider than a scanner"]);
    says(projector("tangents = [-1, 1, -1, 1]\nlight = -1\n"), 22, &["key light"]);
    says(projector("tangents = [-1, 1, -1, 1]\npitch = inf\n"), 22, &["key pitch"]);
}

#[test]
fn displays_are_found_by_name_or_by_path() {
    assert_eq!(Display::named_or_file("cave4").unwrap().name, "cave4");
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("lab.toml");
    std::fs::write(&path, CORE).unwrap();
    assert_eq!(Display::named_or_file(path.to_str().unwrap()).unwrap().name, "lab");
    let message = Display::named_or_file("cave5").unwrap_err().to_string();
    assert!(message.contains("\"cave5\"") && message.contains("cave4, cave6, curved, dome6"), "{message}");
    assert!(matches!(Display::named_or_file("none.toml"), Err(DisplayError::Read { .. })));
}

#[test]
fn eyes_are_apart_along_the_heads_own_x() {
    let viewer = parse(CORE).unwrap().viewer;
    let turned = room::room_from_turned(90.0, 0.0, 0.0);
    let eye = |eye| viewer.eye_m(eye, DVec3::new(0.0, 1.6, 0.0), turned);
    assert_eq!(eye(EyeSide::Right) - eye(EyeSide::Left), DVec3::NEG_Z * 0.064);
    assert_eq!(eye(EyeSide::Centre), DVec3::new(0.0, 1.6, 0.0));
}
