//! Law: a display's channels become pictures of their own, and windows that show the same pictures. A wrong display,
//! head or folder is refused in one sentence. A program that swapped the eyes, or showed both alike, would fail here.

use crate::runner::{run, told};
use crate::virtual_display::{VirtualDisplay, wait_for};
use image::RgbImage;
use std::path::Path;
use std::process::Output;
use std::time::Duration;

/// Display whose eyes are far apart, so that their pictures differ clearly.
const STEREO: &str = r#"
[viewer]
eye_separation = 0.064
eye_scale = 15.0

[[screen]]
name = "front"
lower_left  = [-1.0, 0.9, -1.2]
lower_right = [ 1.0, 0.9, -1.2]
upper_left  = [-1.0, 2.4, -1.2]

[[window]]
name = "for-left"
position = [0, 0]
size = [320, 240]
[[window]]
name = "for-right"
position = [320, 0]
size = [320, 240]

[[channel]]
name = "l"
screen = "front"
eye = "left"
window = "for-left"
viewport = [0, 0, 320, 240]
[[channel]]
name = "r"
screen = "front"
eye = "right"
window = "for-right"
viewport = [0, 0, 320, 240]
"#;

const SCENE: [&str; 6] = ["--scene", "lattice", "--edge", "0.5", "--renderer", "polygon"];

fn render(folder: &Path, arguments: &[&str]) -> Output {
    let scene = ["render"].iter().chain(&SCENE);
    run(folder, &scene.chain(arguments).copied().collect::<Vec<_>>())
}

fn picture(path: &Path) -> RgbImage {
    image::open(path).unwrap().into_rgb8()
}

/// Mean difference of two pictures, levels of 256.
fn difference(one: &RgbImage, other: &RgbImage) -> f64 {
    assert_eq!(one.dimensions(), other.dimensions());
    let sum: u64 = one.iter().zip(other.iter()).map(|(a, b)| u64::from(a.abs_diff(*b))).sum();
    sum as f64 / one.len() as f64
}

#[test]
fn two_windows_show_what_each_eye_sees() {
    let folder = tempfile::tempdir().unwrap();
    let file = folder.path().join("stereo.toml");
    std::fs::write(&file, STEREO).unwrap();
    let rendered = render(folder.path(), &["--display", "stereo.toml", "--out", "walls", "--samples", "1"]);
    assert!(rendered.status.success(), "{}", told(&rendered));
    let [left, right] = ["l", "r"].map(|name| picture(&folder.path().join(format!("walls/{name}.png"))));
    assert_eq!(left.dimensions(), (320, 240));
    let apart = difference(&left, &right);
    assert!(apart > 4.0, "both eyes see the same: {apart}");

    let display = VirtualDisplay::open([640, 240]);
    let ride = ["ride"].iter().chain(&SCENE).chain(&["--display", "stereo.toml"]).copied().collect::<Vec<_>>();
    let mut program = display.rapidity(folder.path(), &ride).spawn().unwrap();
    let windows = wait_for("two windows", || {
        let found = display.tool(&["search", "--name", "Rapidity"])?;
        let windows: Vec<String> = found.lines().map(str::to_owned).collect();
        (windows.len() == 2).then_some(windows)
    });
    let named = |name: &str| display.tool(&["search", "--name", name]).is_some_and(|found| windows.contains(&found));
    assert!(named("for-left") && named("for-right"));
    wait_for("focus", || display.tool(&["windowfocus", "--sync", &windows[0]]));
    display.tool(&["key", "F2"]);

    // Both windows show their own eye's picture, once the readings are hidden.
    let mut closest = f64::INFINITY;
    wait_for("pictures in both windows", || {
        std::thread::sleep(Duration::from_millis(500));
        let screen = display.picture()?;
        let half = |x: u32| image::imageops::crop_imm(&screen, x, 0, 320, 240).to_image();
        let off = difference(&half(0), &left).max(difference(&half(320), &right));
        closest = closest.min(off);
        (off < 0.25 * apart).then_some(())
    });
    let status = wait_for("end", || {
        display.tool(&["key", "Escape"]);
        program.try_wait().unwrap()
    });
    assert!(status.success(), "closest {closest}, apart {apart}");
}

#[test]
fn a_plain_window_turns_with_the_head() {
    let folder = tempfile::tempdir().unwrap();
    let seen = |name: &str, arguments: &[&str]| {
        let place = ["--display", "window", "--out", name, "--samples", "1", "--position", "0,0,3"];
        let rendered = render(folder.path(), &[&place, arguments].concat());
        assert!(rendered.status.success(), "{}", told(&rendered));
        picture(&folder.path().join(name).join("main.png"))
    };
    let [ahead, left, back] = ["0", "90", "180"].map(|yaw| seen(yaw, &["--head-yaw", yaw]));
    for (one, other) in [(&ahead, &left), (&left, &back), (&back, &ahead)] {
        assert!(difference(one, other) > 1.0, "the head turns, and the picture does not");
    }
    // A vehicle at rest that has turned shows the same as a head that has turned in it.
    let turned = seen("turned", &["--look", "-1,0,0"]);
    let off = difference(&left, &turned);
    assert!(off < 0.1 * difference(&left, &ahead), "{off}");
}

#[test]
fn what_cannot_be_drawn_is_refused_in_one_sentence() {
    let folder = tempfile::tempdir().unwrap();
    std::fs::write(folder.path().join("stereo.toml"), STEREO).unwrap();
    let cases: [(&[&str], &str); 6] = [
        (&["--display", "nowhere.toml", "--out", "walls"], "nowhere.toml"),
        (&["--display", "cave7", "--out", "walls"], "cave4"),
        (&["--display", "stereo.toml", "--out", "a.png"], "folder"),
        (&["--out", "walls"], ".png"),
        (&["--display", "stereo.toml", "--out", "walls", "--head", "0,1.6,-2"], "behind"),
        (&["--out", "a.png", "--head", "0,1.6,0"], "--display"),
    ];
    for (arguments, said) in cases {
        let output = render(folder.path(), arguments);
        let told = told(&output);
        assert!(!output.status.success(), "{arguments:?} passed");
        assert!(told.contains(said), "{arguments:?}: {told}");
    }
}
