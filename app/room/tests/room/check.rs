//! Law: the report of a display says what it comes to, or names the place of its flaw. A wrong program would pass a
//! display that shows nothing, or refuse one without naming the place.

#![allow(clippy::unwrap_used, reason = "helpers of tests, too, may fail the test")]

use room::{Display, built_in};
use std::path::Path;

#[test]
fn the_shipped_displays_are_good() {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("../displays");
    let files: Vec<_> = std::fs::read_dir(folder).unwrap().map(|entry| entry.unwrap().path()).collect();
    assert_eq!(files.len(), built_in::NAMES.len(), "every file is built in");
    for file in files {
        assert!(room::is_display(&file), "{file:?}");
        let report = Display::load(&file).unwrap().to_string();
        assert!(report.contains("pixels per degree"), "{report}");
    }
}

#[test]
fn a_display_with_a_flaw_is_named_with_its_line() {
    let folder = tempfile::tempdir().unwrap();
    for (name, text, words) in [
        (
            "a.toml",
            "[[screen]]\nname = \"s\"\nsize = [1, 1]\n",
            "a.toml, line 1, screen \"s\": it has a size or angles, but no centre",
        ),
        ("b.pvx", "<pvx><Machine UpperLeft='0 1 -1'/></pvx>", "b.pvx: line 1, <Machine>: it has no LowerLeft"),
        ("c.mpcdi", "PK", "c.mpcdi: it is no good zip"),
    ] {
        let path = folder.path().join(name);
        std::fs::write(&path, text).unwrap();
        assert!(room::is_display(&path), "{path:?}");
        let said = Display::load(&path).unwrap_err().to_string();
        assert!(said.contains(words), "{said:?} does not say {words:?}");
    }
}

#[test]
fn a_file_that_is_no_display_is_told_what_one_is() {
    let folder = tempfile::tempdir().unwrap();
    for (name, text) in [
        ("Cargo.toml", &b"[package]\nname = \"x\"\nversion = \"1.0.0\"\n"[..]),
        ("empty.toml", b""),
        ("photo.TOML", b"\xff\xd8\xff"),
        ("notes.txt", b"# Notes\n\nNo room.\n"),
    ] {
        let path = folder.path().join(name);
        std::fs::write(&path, text).unwrap();
        let said = Display::load(&path).unwrap_err().to_string();
        for words in [name, "it is no display", ".pvx, .mpcdi, .mpcdi.xml, .ndisplay", "cave4"] {
            assert!(said.contains(words), "{said:?} does not say {words:?}");
        }
    }
    // A display with a mistake stays a display, and its mistake is named; so does one without an ending.
    let text = "[[screen]]\nname = \"s\"\nsize = [1, 1]\n";
    for name in ["a.toml", "room"] {
        std::fs::write(folder.path().join(name), text).unwrap();
        let said = Display::load(&folder.path().join(name)).unwrap_err().to_string();
        assert!(said.contains("no centre"), "{said}");
    }
    std::fs::write(folder.path().join("b.toml"), "[[screen]\n").unwrap();
    assert!(Display::load(&folder.path().join("b.toml")).unwrap_err().to_string().contains("line 1"));
}

#[test]
fn display_files_are_known_by_their_endings_in_any_case() {
    for name in ["a.toml", "a.TOML", "a.Pvx", "a.MPCDI", "a.Mpcdi.XML", "mpcdi.xml", "a.nDisplay"] {
        assert!(room::is_display(Path::new(name)), "{name}");
    }
    for name in ["toml", "a.xml", "a.mpcdi.zip", "a.json", ""] {
        assert!(!room::is_display(Path::new(name)), "{name}");
    }
}
