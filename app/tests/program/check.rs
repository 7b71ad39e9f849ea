//! Law: `rapidity check` describes a display, or names its flaw and its line; the exit status tells which of the two. A
//! program that passes a flawed file, or does not say where the flaw is, fails here.

use crate::runner::{run, said};
use std::path::Path;
use std::process::Output;

fn check(file: &Path) -> Output {
    run(Path::new("."), &["check", &file.to_string_lossy()])
}

#[test]
fn the_shipped_displays_are_good() {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("displays");
    let files: Vec<_> = std::fs::read_dir(folder).unwrap().map(|entry| entry.unwrap().path()).collect();
    assert_eq!(files.len(), room::built_in::NAMES.len(), "every file is built in");
    for file in files {
        let output = check(&file);
        let said = said(&output);
        assert!(output.status.success() && said.contains(": good\n") && said.contains("pixels per degree"), "{said}");
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
        ("d.toml", "[package]\nname = \"d\"\n", "d.toml: it is no display; a display is a file (.toml, .pvx,"),
        ("e.txt", "a room", "a display (.toml, .pvx, .mpcdi, .mpcdi.xml, .ndisplay)"),
    ] {
        let path = folder.path().join(name);
        std::fs::write(&path, text).unwrap();
        let output = check(&path);
        let said = said(&output);
        assert!(!output.status.success() && said.contains(words), "{said:?} does not say {words:?}");
    }
}
