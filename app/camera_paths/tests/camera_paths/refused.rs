//! Law: what cannot be flown is refused in one sentence that names the file, the place and what to do. A wrong program
//! shows a camera faster than light, or passes over a word that it does not know.
#![allow(clippy::unwrap_used, reason = "a failed construction is a failed test")]

use crate::support::try_path;
use camera_paths::{CameraPath, PathFile, PathScene};
use std::path::Path;

/// Checks that a text is refused where light has 10 m/s, in a sentence with these words.
#[track_caller]
fn assert_refused(text: &str, words: &[&str]) {
    let error = try_path(text, 10.0).expect_err(text).to_string();
    for word in ["path.toml"].iter().chain(words) {
        assert!(error.contains(word), "{word} is missing in: {error}");
    }
    assert!(!error.contains('\n'), "{error}");
}

fn keys(time: &str, keys: &[(f64, f64)]) -> String {
    let key = |(at, x): &(f64, f64)| format!("[[key]]\nat = {at:?}\nposition = [{x:?}, 0, 0]\n");
    format!("time = \"{time}\"\n{}", keys.iter().map(key).collect::<String>())
}

#[test]
fn what_is_faster_than_light_is_refused_and_named() {
    assert_refused(
        &keys("world", &[(0.0, 0.0), (1.0, 5.0), (2.0, 17.0)]),
        &["between key 2 and key 3", "light at 10.0000 m/s"],
    );
    // As fast as light is too fast; a whisker below is not.
    assert_refused(&keys("world", &[(0.0, 0.0), (1.0, 10.0)]), &["between key 1 and key 2", "moves at 10.0000"]);
    assert!(try_path(&keys("world", &[(0.0, 0.0), (1.0, 9.9999999)]), 10.0).is_ok());
    // By the camera's own clock there is no limit.
    assert!(try_path(&keys("own", &[(0.0, 0.0), (1.0, 1e4)]), 10.0).is_ok());
    // Faster between two keys only, where the spline overshoots.
    let swing = keys("world", &[(0.0, 0.0), (1.0, 0.0), (2.0, 9.5), (3.0, 9.5)]);
    assert_refused(&swing, &["between key 2 and key 3"]);
    assert_refused("[circle]\ncentre = [0, 0, 0]\nradius = 1\nspeed = 12", &["on the circle", "12.0000 m/s"]);
    let parts = "[[part]]\n[part.circle]\ncentre = [0, 0, 0]\nradius = 1\nspeed = 1\n[[part]]\n[part.circle]\ncentre = [0, 0, 0]\nradius = 1\nperiod = 0.1";
    assert_refused(parts, &["in part 2 on the circle"]);
    let far = "[start]\nposition = [0, 0, 0]\n[[leg]]\nseconds = 1\n[[leg]]\nseconds = 1\nthrust = [30, 0, 0]";
    assert_refused(far, &["leg 2", "rapidity", "27"]);
}

#[test]
fn keys_out_of_order_are_refused_with_their_line() {
    for second in [0.5, 1.0] {
        let text = keys("own", &[(1.0, 0.0), (second, 1.0)]);
        assert_refused(&text, &["line 5", "key 2", "in order"]);
    }
}

#[test]
fn unknown_words_are_refused() {
    let good = keys("own", &[(0.0, 0.0), (1.0, 1.0)]);
    assert!(try_path(&good, 10.0).is_ok());
    assert_refused(&format!("{good}speed = 3\n"), &["line 8", "speed"]);
    assert_refused(&format!("loop = true\n{good}"), &["line 1", "loop"]);
    assert_refused(&format!("[[part]]\nspan = 3\n{}", good.replace("time", "#")), &["line"]);
    assert_refused(&good.replace("own", "mine"), &["line 1", "mine", "world"]);
    assert_refused("[circle]\ncentre = [0, 0, 0]\nradius = 1\nspeed = \"3 mph\"", &["mph", "km/h"]);
}

#[test]
fn numbers_that_are_none_are_refused() {
    for (text, word) in [
        (keys("own", &[(0.0, 0.0), (f64::NAN, 1.0)]).replace("NaN", "nan"), "key 2"),
        (keys("own", &[(0.0, 0.0), (1.0, 1.0)]).replace("1.0, 0, 0", "nan, 0, 0"), "key 2: position"),
        (keys("own", &[(0.0, 0.0), (1.0, 1.0)]).replace("1.0, 0, 0", "inf, 0, 0"), "key 2: position"),
        ("[start]\nposition = [0, 0, 0]\ncelerity = [inf, 0, 0]\n[[leg]]\nseconds = 1".to_owned(), "celerity"),
        ("[start]\nposition = [0, 0, 0]\n[[leg]]\nseconds = nan".to_owned(), "seconds"),
        ("[start]\nposition = [0, 0, 0]\n[[leg]]\nseconds = 1\nthrust = [nan, 0, 0]".to_owned(), "thrust"),
        ("[circle]\ncentre = [0, 0, 0]\nradius = nan\nspeed = 1".to_owned(), "radius"),
        ("[circle]\ncentre = [0, 0, 0]\nradius = 1\nspeed = nan".to_owned(), "speed"),
        ("[circle]\ncentre = [0, 0, 0]\nradius = 1\nspeed = 1\nfov = 0".to_owned(), "fov"),
        ("[circle]\ncentre = [0, 0, 0]\nradius = 1\nspeed = 1\nlook = [0, 0, 0]".to_owned(), "look"),
        ("[circle]\ncentre = [0, 0, 0]\nradius = 1\nspeed = 1\nfrom = [0, 3, 0]".to_owned(), "from"),
        ("watch = [nan, 0, 0]\n[circle]\ncentre = [0, 0, 0]\nradius = 1\nspeed = 1".to_owned(), "watch"),
    ] {
        assert_refused(&text, &[word]);
    }
}

#[test]
fn ways_that_are_none_or_two_are_refused() {
    assert_refused("", &["no way", "[[key]]"]);
    assert_refused("part = []", &["0 parts"]);
    assert_refused(&keys("own", &[(0.0, 0.0)]), &["one key"]);
    assert_refused("[[leg]]\nseconds = 1", &["begin nowhere", "[start]"]);
    let both = "[circle]\ncentre = [0, 0, 0]\nradius = 1\nspeed = 1\nperiod = 2";
    assert_refused(both, &["either a speed or a period"]);
    let both = format!("{}[circle]\ncentre = [0, 0, 0]\nradius = 1\nspeed = 1", keys("own", &[(0.0, 0.0), (1.0, 0.0)]));
    assert_refused(&both, &["at once"]);
    let two = "[start]\nposition = [0, 0, 0]\n[[leg]]\nseconds = 1\nthrust = [1, 0, 0]\nacceleration = [1, 0, 0]";
    assert_refused(two, &["leg 1", "one of them"]);
}

#[test]
fn files_that_are_none_are_refused() {
    let usual = PathScene { scene: None, speed_of_light_m_s: Some(10.0) };
    let read = |path: &Path| CameraPath::read(path, &usual).unwrap_err().to_string();
    let folder = tempfile::tempdir().unwrap();
    assert!(read(folder.path()).contains("no file"));
    assert!(read(&folder.path().join("nothing.toml")).contains("nothing.toml"));
    let file = folder.path().join("path.toml");
    std::fs::write(&file, [0xff, 0xfe, 0x00]).unwrap();
    assert!(read(&file).contains("UTF-8"));
    let file = PathFile::parse("path.toml", "[circle]\ncentre = [0, 0, 0]\nradius = 1\nspeed = 1").unwrap();
    assert!(file.path(&[]).unwrap_err().to_string().contains("1 parts"));
    assert!(file.path(&[-1.0]).unwrap_err().to_string().contains("speed of light"));
}
