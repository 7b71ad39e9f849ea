//! Law: an nDisplay file's screens stand where the engine has them. A wrong program would mirror the room (the file's
//! axes are left-handed), or make it a hundred times too large.
#![allow(clippy::unwrap_used, reason = "helpers of tests, too, may fail the test")]

use crate::containers::load;
use glam::{DVec2, DVec3};
use room::{Display, EyeSide, ScreenSurface};

/// Two walls of a room on two nodes, 3 m and 2 m wide, 2 m ahead and 1.5 m to the right of the head; the walls hang in
/// a tree that is 1 m above the floor and turned.
const ROOM: &str = r#"{ "nDisplay": { "description": "two walls", "version": "5.00",
  "scene": {
    "xforms": {
      "base": { "parentId": "", "location": { "x": 0, "y": 0, "z": 100 }, "rotation": { "pitch": 0, "yaw": 0, "roll": 0 } },
      "side": { "parentId": "base", "location": { "x": 0, "y": 0, "z": 0 }, "rotation": { "pitch": 0, "yaw": 90, "roll": 0 } }
    },
    "cameras": {
      "head": { "interpupillaryDistance": 6.0, "swapEyes": false, "stereoOffset": "none", "parentId": "base",
                "location": { "x": 0, "y": 0, "z": 60 }, "rotation": { "pitch": 0, "yaw": 0, "roll": 0 } },
      "head-left": { "interpupillaryDistance": 6.0, "swapEyes": false, "stereoOffset": "left", "parentId": "base",
                "location": { "x": 0, "y": 0, "z": 60 }, "rotation": { "pitch": 0, "yaw": 0, "roll": 0 } }
    },
    "screens": {
      "front": { "size": { "width": 300, "height": 200 }, "parentId": "base",
                 "location": { "x": 200, "y": 0, "z": 50 }, "rotation": { "pitch": 0, "yaw": 0, "roll": 0 } },
      "right": { "size": { "width": 200, "height": 100 }, "parentId": "side",
                 "location": { "x": 150, "y": 20, "z": 0 }, "rotation": { "pitch": 0, "yaw": 0, "roll": 0 } }
    } },
  "cluster": { "primaryNode": { "id": "n1" }, "nodes": {
    "n1": { "host": "10.0.0.1", "fullScreen": true, "window": { "x": 10, "y": -20, "w": 640, "h": 480 }, "viewports": {
      "a": { "camera": "", "region": { "x": 0, "y": 0, "w": 320, "h": 480 },
             "projectionPolicy": { "type": "Simple", "parameters": { "screen": "front" } } },
      "b": { "camera": "head-left", "region": { "x": 320, "y": 0, "w": 320, "h": 480 },
             "projectionPolicy": { "type": "simple", "parameters": { "screen": "front" } } } } },
    "n2": { "host": "10.0.0.2", "fullScreen": false, "window": { "x": 0, "y": 0, "w": 100, "h": 50 }, "viewports": {
      "c": { "camera": "head", "region": { "x": 0, "y": 0, "w": 100, "h": 50 },
             "projectionPolicy": { "type": "mesh", "parameters": { "mesh_component": "right" } } } } }
  } } } }"#;

fn read(text: &str) -> Display {
    load("cave.ndisplay", text.as_bytes()).unwrap()
}

fn notes(display: &Display, word: &str) -> usize {
    display.notices.iter().filter(|notice| notice.contains(word)).count()
}

#[test]
fn screens_stand_where_the_engine_has_them() {
    let display = read(ROOM);
    assert_eq!((display.name.as_str(), display.windows.len(), display.channels.len()), ("cave", 2, 3));
    assert!(display.viewer.head_m.distance(DVec3::new(0.0, 1.6, 0.0)) < 1e-12);
    assert!((display.viewer.eye_separation_m - 0.06).abs() < 1e-12);
    let window = &display.windows[0];
    assert_eq!((window.size, window.position, window.fullscreen), ([640, 480], Some([10, -20]), true));
    assert!(!display.windows[1].fullscreen);
    let eyes: Vec<_> =
        display.channels.iter().map(|channel| (channel.name.as_str(), channel.eye, channel.viewport)).collect();
    assert_eq!(
        eyes,
        [
            ("a", EyeSide::Centre, [0, 0, 320, 480]),
            ("b", EyeSide::Left, [320, 0, 320, 480]),
            ("c", EyeSide::Centre, [0, 0, 100, 50]),
        ]
    );
    let corner = |channel: usize, x, y| display.channels[channel].point(&display, DVec2::new(x, y)).unwrap();
    // Upper left and lower right of the wall ahead, then of the wall on the right, whose left edge is ahead.
    for (found, expected) in [
        (corner(0, 0.0, 0.0), [-1.5, 2.5, -2.0]),
        (corner(1, 1.0, 1.0), [1.5, 0.5, -2.0]),
        (corner(2, 0.0, 0.0), [1.5, 1.5, -0.8]),
        (corner(2, 1.0, 1.0), [1.5, 0.5, 1.2]),
    ] {
        assert!(found.distance(expected.into()) < 1e-12, "{found} {expected:?}");
    }
    assert_eq!(notes(&display, "2 hosts"), 1);
}

#[test]
fn turns_are_those_of_a_left_handed_frame() {
    let turned = |pitch, yaw, roll| {
        let rotation = format!("\"rotation\": {{ \"pitch\": {pitch}, \"yaw\": {yaw}, \"roll\": {roll} }}");
        let (before, after) = ROOM.split_once("\"front\"").unwrap();
        let after = after.replacen("\"rotation\": { \"pitch\": 0, \"yaw\": 0, \"roll\": 0 }", &rotation, 1);
        let display = read(&format!("{before}\"front\"{after}"));
        let ScreenSurface::Flat(flat) = display.screens[0].surface else { panic!("not flat") };
        (flat.right.normalize(), flat.up.normalize())
    };
    let (sin, cos) = 10.0_f64.to_radians().sin_cos();
    let near = |found: (DVec3, DVec3), right: [f64; 3], up: [f64; 3]| {
        assert!(found.0.distance(right.into()) < 1e-12 && found.1.distance(up.into()) < 1e-12, "{found:?}");
    };
    // Yaw turns what is ahead to the right, so the right edge comes nearer; pitch leans the upper edge back; roll is
    // clockwise.
    near(turned(0, 10, 0), [cos, 0.0, sin], [0.0, 1.0, 0.0]);
    near(turned(10, 0, 0), [1.0, 0.0, 0.0], [0.0, cos, sin]);
    near(turned(0, 0, 10), [cos, -sin, 0.0], [sin, cos, 0.0]);
}

#[test]
fn lengths_are_metres_where_the_eyes_say_so() {
    let metres = ROOM.replace("6.0", "0.06");
    let display = read(&metres);
    assert!((display.viewer.eye_separation_m - 0.06).abs() < 1e-12);
    assert!((display.screens[0].surface.size_m() - DVec2::new(300.0, 200.0)).length() < 1e-9);
    assert_eq!(notes(&display, "taken to be metres"), 1);
}

#[test]
fn what_is_not_read_is_left_out_and_named() {
    let with = |policy: &str| {
        ROOM.replace("{ \"type\": \"mesh\", \"parameters\": { \"mesh_component\": \"right\" } }", policy)
    };
    for (policy, words) in [
        (
            r#"{ "type": "mesh", "parameters": { "component": "Dome" } }"#,
            "\"c\": its mesh \"Dome\" is in the engine's project",
        ),
        (r#"{ "type": "mpcdi", "parameters": { "file": "d/x.mpcdi" } }"#, "MPCDI file \"d/x.mpcdi\""),
        (r#"{ "type": "easyblend", "parameters": {} }"#, "policy \"easyblend\" is not read"),
    ] {
        let display = read(&with(policy));
        assert_eq!((display.channels.len(), display.windows.len(), notes(&display, words)), (2, 1, 1), "{policy}");
    }
    let display = read(&with(r#"{ "type": "camera", "parameters": {} }"#));
    let seen = display.channels[2].point(&display, DVec2::splat(0.5)).unwrap() - display.viewer.head_m;
    assert!(seen.normalize().distance(DVec3::NEG_Z) < 1e-12 && notes(&display, "ordinary view") == 1);
    for (from, to, words) in [
        ("{ \"nDisplay\"", "{{", "it is no JSON"),
        ("\"nodes\"", "\"knots\"", "no nDisplay.cluster.nodes"),
        ("\"screen\": \"front\"", "\"screen\": \"back\"", "there is no screen \"back\""),
        ("\"parentId\": \"\"", "\"parentId\": \"side\"", "hangs on itself"),
        ("\"parentId\": \"\"", "\"parentId\": \"none\"", "hangs on \"none\", which is not there"),
        ("\"w\": 640", "\"w\": 0", "0 × 480 pixels are no window"),
        ("\"width\": 300", "\"width\": -3", "screen \"front\""),
    ] {
        let message = load("x.ndisplay", ROOM.replacen(from, to, 1).as_bytes()).unwrap_err().to_string();
        assert!(message.contains("x.ndisplay") && message.contains(words), "{message:?} does not say {words:?}");
    }
    let outside = read(&ROOM.replacen("\"w\": 320, \"h\": 480", "\"w\": 900, \"h\": 480", 1));
    assert_eq!((outside.channels.len(), notes(&outside, "\"a\": its region")), (2, 1));
}
