//! Law: `rapidity check` describes a display, or names the place of its flaw, and its exit status tells the two
//! apart.

#![allow(clippy::unwrap_used, reason = "helpers of tests, too, may fail the test")]

use std::path::Path;
use std::process::{Command, Output};

fn check(file: &Path) -> Output {
    Command::new(env!("CARGO_BIN_EXE_rapidity")).arg("check").arg(file).output().unwrap()
}

#[test]
fn the_shipped_displays_are_good() {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("displays");
    let files: Vec<_> = std::fs::read_dir(folder).unwrap().map(|entry| entry.unwrap().path()).collect();
    assert_eq!(files.len(), rapidity::room::built_in::NAMES.len(), "every file is built in");
    for file in files {
        let output = check(&file);
        let said = String::from_utf8(output.stdout).unwrap();
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
        ("b.pvx", "<pvx><Machine/></pvx>", "b.pvx: line 1, <Machine>: it has no LowerLeft"),
        ("c.mpcdi", "PK", "c.mpcdi: it is no good zip"),
    ] {
        let path = folder.path().join(name);
        std::fs::write(&path, text).unwrap();
        let output = check(&path);
        let said = String::from_utf8(output.stdout).unwrap();
        assert!(!output.status.success() && said.contains(words), "{said:?} does not say {words:?}");
    }
}
