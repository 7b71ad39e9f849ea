//! Law: the first minutes of somebody who has read nothing go through: start, ride, menu, an effect, hold, look round,
//! photo, go on, view from outside, leave. Each step shows on the screen and is an action of the recording, in this
//! order; the recording replays to the bit. The same with a wand in a room of four walls for two eyes.
//!
//! Where `FIRST_TIME_PICTURES` names a folder, the screen after each step is kept there, to be looked at.

use crate::runner::{run, told};
use crate::virtual_display::{VirtualDisplay, wait_for};
use crate::wand_server::WandServer;
use glam::DVec3;
use image::RgbImage;
use input::recording::{Recording, RecordingEntry};
use input::{Action, Setting, Switch};
use std::path::Path;
use std::process::Child;
use std::time::Duration;

/// Mean difference of two pictures of the screen from which something has changed, of 255.
const CHANGED: f64 = 0.2;

/// A visit: the program on its display, and the screen after the last step.
struct Visit<'a> {
    display: &'a VirtualDisplay,
    name: &'static str,
    before: Option<RgbImage>,
    number: usize,
}

impl Visit<'_> {
    /// Waits until the screen has changed after a step, and keeps its picture.
    fn step(&mut self, what: &str) {
        let now = wait_for(what, || {
            std::thread::sleep(Duration::from_millis(700));
            let now = self.display.picture()?;
            let changed = self.before.as_ref().is_none_or(|before| difference(before, &now) > CHANGED);
            changed.then_some(now)
        });
        self.number += 1;
        if let Some(folder) = std::env::var_os("FIRST_TIME_PICTURES") {
            let file = format!("{}-{:02}-{}.png", self.name, self.number, what.replace(' ', "-"));
            now.save(Path::new(&folder).join(file)).unwrap();
        }
        self.before = Some(now);
    }

    fn key(&self, key: &str) {
        self.display.tool(&["key", key]);
    }
}

fn difference(one: &RgbImage, other: &RgbImage) -> f64 {
    let sum: u64 = one.as_raw().iter().zip(other.as_raw()).map(|(one, other)| u64::from(one.abs_diff(*other))).sum();
    sum as f64 / one.as_raw().len() as f64
}

/// Actions of a recording, in their order.
fn actions(path: &Path) -> Vec<Action> {
    let entries = Recording::open(path).unwrap().map(Result::unwrap);
    let of = |entry| match entry {
        RecordingEntry::Controls(record) => record.controls.actions,
        _ => Vec::new(),
    };
    entries.flat_map(of).collect()
}

/// Ends the visit as `leave` does it, and checks its recording.
fn end(folder: &Path, mut program: Child, mut leave: impl FnMut(), expected: &[Action]) {
    let status = wait_for("end", || {
        leave();
        std::thread::sleep(Duration::from_millis(300));
        program.try_wait().unwrap()
    });
    assert!(status.success());
    let acted = actions(&folder.join("r.mcap"));
    let mut acted_on = acted.iter();
    for action in expected {
        assert!(acted_on.any(|known| known == action), "no {action:?} in its place: {acted:?}");
    }
    let verified = run(folder, &["ride", "--replay", "r.mcap", "--verify"]);
    assert!(verified.status.success(), "{}", told(&verified));
}

#[test]
fn a_first_visit_in_a_window_goes_through() {
    let folder = tempfile::tempdir().unwrap();
    let display = VirtualDisplay::open([960, 540]);
    let arguments = ["ride", "--scene", "dice", "--size", "960x540", "--language", "en", "--record", "r.mcap"];
    let program = display.rapidity(folder.path(), &arguments).spawn().unwrap();
    let window = wait_for("window", || display.tool(&["search", "--name", "Rapidity"]).filter(|id| !id.is_empty()));
    wait_for("focus", || display.tool(&["windowfocus", "--sync", &window]));
    display.tool(&["windowmove", "--sync", &window, "0", "0"]);
    let mut visit = Visit { display: &display, name: "window", before: None, number: 0 };

    visit.step("start");
    display.tool(&["keydown", "w"]);
    visit.step("ride");
    display.tool(&["keyup", "w"]);
    visit.key("F3");
    visit.step("menu");
    // The mouse opens the page on the picture; its first switch is found along the row.
    for x in (470..940).step_by(35) {
        display.tool(&["mousemove", &x.to_string(), "62", "click", "1"]);
    }
    visit.step("pages of the menu");
    visit.key("x");
    visit.step("measured");
    visit.key("x");
    visit.key("x");
    visit.key("b");
    visit.step("effect");
    visit.key("p");
    visit.step("hold");
    for drag in [["600", "300"], ["500", "280"]] {
        display.tool(&["mousemove", "200", "300", "mousedown", "1", "mousemove", drag[0], drag[1], "mouseup", "1"]);
    }
    visit.step("look round");
    let photo = folder.path().join("photo-001.png");
    wait_for("photo", || {
        visit.key("c");
        std::thread::sleep(Duration::from_secs(1));
        photo.exists().then_some(())
    });
    visit.step("photo");
    visit.key("p");
    visit.key("y");
    visit.step("outside");
    let expected = [
        Action::Toggle(Switch::Menu),
        Action::NextView,
        Action::Toggle(Switch::Doppler),
        Action::TogglePause,
        Action::Photo,
        Action::TogglePause,
        Action::Toggle(Switch::Outside),
        Action::Leave,
    ];
    end(folder.path(), program, || drop(display.tool(&["key", "Escape"])), &expected);
}

#[test]
fn a_first_visit_with_a_wand_in_a_room_goes_through() {
    let folder = tempfile::tempdir().unwrap();
    let wand = WandServer::start();
    // The room of the program, with walls of few pixels; both eyes' windows on one screen.
    let cave = include_str!("../../displays/cave4.toml");
    let halved = |line: &str| {
        let of_pixels = line.starts_with("size") || line.starts_with("viewport");
        let half = |number: &str| number.parse::<u32>().map_or(number.to_owned(), |pixels| (pixels / 2).to_string());
        if of_pixels {
            let (key, list) = line.split_once('[').unwrap();
            let list: Vec<String> = list.trim_end_matches(']').split(", ").map(half).collect();
            format!("{key}[{}]\n", list.join(", "))
        } else {
            format!("{line}\n")
        }
    };
    let cave: String = cave.lines().map(halved).collect();
    std::fs::write(folder.path().join("cave.toml"), cave).unwrap();
    let set_up = format!(
        "[tracker]\nurl = \"{}\"\n[tracker.wand]\nsensor = 1\nactions = {{ 5 = \"photo\", 6 = \"leave\" }}\n",
        wand.url
    );
    std::fs::write(folder.path().join("set-up.toml"), set_up).unwrap();
    let display = VirtualDisplay::open([1280, 640]);
    let arguments = ["ride", "--scene", "dice", "--display", "cave.toml", "--set-up", "set-up.toml"];
    let arguments = [&arguments[..], &["--language", "en", "--record", "r.mcap"]].concat();
    let program = display.rapidity(folder.path(), &arguments).spawn().unwrap();
    wait_for("windows", || {
        let ids = display.tool(&["search", "--name", "Rapidity"])?;
        let ids: Vec<&str> = ids.lines().collect();
        (ids.len() == 2).then_some(())?;
        for (number, id) in ids.iter().enumerate() {
            display.tool(&["windowmove", "--sync", id, "0", &(320 * number).to_string()]);
        }
        Some(())
    });
    let mut visit = Visit { display: &display, name: "cave", before: None, number: 0 };

    visit.step("start");
    wand.push([0.0, 1.0]);
    visit.step("ride");
    wand.push([0.0, 0.0]);
    wand.press(1);
    visit.step("menu");
    // The beam goes along the menu's upper row, over its pages to the button that closes it. The menu is 1.5 m wide, at
    // 1.5 m from the head and 18° above.
    let middle =
        DVec3::new(0.0, 1.6, 0.0) + 1.5 * DVec3::new(0.0, 18_f64.to_radians().sin(), -18_f64.to_radians().cos());
    for share in 0..16 {
        wand.point(middle + DVec3::new(-0.6 + 0.08 * f64::from(share), 0.31, 0.1));
        wand.press(0);
        if share == 7 {
            visit.step("pages of the menu");
        }
    }
    wand.press(3);
    visit.step("measured");
    wand.press(3);
    wand.press(3);
    wand.press(2);
    visit.step("hold");
    wand.walk(0.4);
    visit.step("look round");
    let photo = folder.path().join("photo-001");
    wait_for("photo", || {
        wand.press(5);
        std::thread::sleep(Duration::from_secs(1));
        std::fs::read_dir(folder.path())
            .ok()?
            .flatten()
            .find(|entry| entry.path().to_string_lossy().starts_with(&*photo.to_string_lossy()))
    });
    wand.press(2);
    visit.step("on");
    let expected = [
        Action::Toggle(Switch::Menu),
        Action::Toggle(Switch::Menu),
        Action::NextView,
        Action::TogglePause,
        Action::Photo,
        Action::TogglePause,
        Action::Leave,
    ];
    end(folder.path(), program, || wand.press(6), &expected);
    let chosen = actions(&folder.path().join("r.mcap"));
    // Pages are no actions, and nothing else lies on the row.
    assert!(!chosen.iter().any(|action| matches!(action, Action::Set(Setting::Exposure, _))), "{chosen:?}");
}
