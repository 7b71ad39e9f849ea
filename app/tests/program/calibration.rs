//! Law: F4 shows a grid whose frame lies at the corners. Keys move the corners, S writes them into the file and
//! changes nothing else, and a picture drawn from that file uses them. A program that steered the vehicle with the
//! arrow keys, or lost a comment, would fail here.

use crate::runner::{run, told};
use crate::virtual_display::{VirtualDisplay, wait_for};
use image::Rgb;
use input::recording::{Recording, RecordingEntry};
use input::{KeyboardKey, Sample};

const FILE: &str = r#"# Measured by hand.
[[screen]]
name = "front"
lower_left  = [-1.0, 0.9, -1.2]
lower_right = [ 1.0, 0.9, -1.2]
upper_left  = [-1.0, 2.4, -1.2]

[[window]]
name = "w"
position = [0, 0]
size = [640, 480]

[[channel]]   # the only one
name = "c"
screen = "front"
window = "w"
"#;

#[test]
fn corners_are_moved_on_the_screen_and_saved_in_the_file() {
    const WHITE: Rgb<u8> = Rgb([255; 3]);
    const BLACK: Rgb<u8> = Rgb([0; 3]);
    let folder = tempfile::tempdir().unwrap();
    let file = folder.path().join("room.toml");
    std::fs::write(&file, FILE).unwrap();
    let display = VirtualDisplay::open([640, 480]);
    let ride = [
        "ride",
        "--scene",
        "lattice",
        "--edge",
        "4",
        "--display",
        "room.toml",
        "--record",
        "r.mcap",
        "--size",
        "64x48",
    ];
    let mut program = display.rapidity(folder.path(), &ride).spawn().unwrap();
    let window = wait_for("window", || display.tool(&["search", "--name", "Rapidity"]).filter(|id| !id.is_empty()));
    wait_for("focus", || display.tool(&["windowfocus", "--sync", &window]));

    // At first the frame lies at the window's edge.
    let white = |at: [u32; 2], corner: [u32; 2]| {
        wait_for("the grid's frame", || {
            let screen = display.picture()?;
            let [x, y] = at;
            let outside = corner.map(|pixel| pixel.checked_sub(2));
            let outside = outside[0].zip(outside[1]).map(|(x, y)| *screen.get_pixel(x, y));
            (*screen.get_pixel(x, y) == WHITE && outside.is_none_or(|pixel| pixel == BLACK)).then_some(())
        });
    };
    display.tool(&["key", "F4"]);
    white([0, 240], [0, 0]);

    // Move the upper left corner by (13, 10).
    display.tool(&["key", "shift+Right"]);
    for key in ["Right", "Right", "Right"] {
        display.tool(&["key", key]);
    }
    display.tool(&["key", "shift+Down"]);
    white([14, 12], [13, 10]);
    display.tool(&["key", "s"]);
    let saved = wait_for("saved corners", || {
        let text = std::fs::read_to_string(&file).unwrap();
        (text != FILE).then_some(text)
    });
    let status = wait_for("end", || {
        display.tool(&["key", "Escape"]);
        program.try_wait().unwrap()
    });
    assert!(status.success());

    // The vehicle received no key presses but those that begin the calibration and end the ride.
    for entry in Recording::open(&folder.path().join("r.mcap")).unwrap() {
        if let RecordingEntry::Sample(sample) = entry.unwrap() {
            let mut others =
                KeyboardKey::ALL.iter().filter(|key| !matches!(key, KeyboardKey::F4 | KeyboardKey::Escape));
            assert!(others.all(|key| sample != Sample::key(sample.at, *key, true)), "{sample:?}");
        }
    }

    // The file has the corners, in one added line.
    let added: Vec<_> = saved.lines().filter(|line| !FILE.lines().any(|before| before == *line)).collect();
    assert_eq!(added.len(), 1, "{saved}");
    assert!(added[0].starts_with("corners = { upper_left = [13.0, 10.0],"), "{saved}");
    assert!(FILE.lines().all(|line| saved.lines().any(|after| after == line)), "{saved}");
    let checked = run(folder.path(), &["check", "room.toml"]);
    assert!(checked.status.success(), "{}", told(&checked));
}
