//! Law: `scripts/measure-gpu` makes one table of what its benchmarks print, names what was not measured, and refuses
//! words that it does not know. A script that swallowed a failed benchmark would publish half a table as a whole one.
//!
//! Its benchmarks are replaced by short scripts here. `scripts/measure-gpu quick` runs the real ones.

use std::fs;
use std::os::unix::fs::PermissionsExt;
use std::path::Path;
use std::process::{Command, Output};

use crate::runner::{said, told};

fn measure_gpu(words: &[&str]) -> Output {
    let script = Path::new(env!("CARGO_MANIFEST_DIR")).join("../scripts/measure-gpu");
    Command::new(script).args(words).output().expect("the script starts")
}

/// Writes programs in the place of the benchmarks.
fn stand_ins(folder: &Path, walls: &str) {
    let windows = r#"echo "commit x, A Processor, 8 cores"; echo "A Device (Vulkan, 1.2)"; echo "prose"
        for speed in 0 .8 .99; do echo "| ${4#scene=} | one window | $2 | $speed | plain | 60.0 | 59.0 | 1.00 |"; done"#;
    for (name, text) in [("windows", windows), ("walls", walls), ("large_scenes", "touch $1/$2.glb")] {
        let path = folder.join(name);
        fs::write(&path, format!("#!/bin/sh\n{text}\n")).unwrap();
        fs::set_permissions(&path, fs::Permissions::from_mode(0o755)).unwrap();
    }
    fs::write(folder.join("commit"), "abc123\n").unwrap();
}

#[test]
fn the_table_has_every_row_that_the_benchmarks_print() {
    let folder = tempfile::tempdir().unwrap();
    stand_ins(folder.path(), r#"echo "prose"; echo "| a | $2, $3, $4 | b | c | d | 1 | 2 | 3 |""#);
    let output = measure_gpu(&["quick", "from", folder.path().to_str().unwrap()]);
    assert!(output.status.success(), "{}", told(&output));
    let text = said(&output);
    for part in ["Commit abc123. A Processor, 8 cores", "Drawn by A Device (Vulkan, 1.2)"] {
        assert!(text.contains(part), "{part}: {text}");
    }
    let rows: Vec<&str> = text.lines().filter(|line| line.starts_with('|')).collect();
    let columns: Vec<usize> = rows.iter().map(|row| row.matches('|').count()).collect();
    // A header, a rule, and for two scenes three speeds and two rooms.
    assert_eq!(columns, vec![9; 2 + 2 * (3 + 2)], "{text}");
    assert!(text.contains("| town | one window | 320x180 | .99 | plain |"), "{text}");
    assert!(text.contains("triangles-1e5.glb | one window") && text.contains("walls=6, side=64, beta=.9"), "{text}");
    assert!(!text.contains("prose") && !text.contains("Not measured"), "{text}");
}

#[test]
fn what_was_not_measured_is_named() {
    let folder = tempfile::tempdir().unwrap();
    stand_ins(folder.path(), r#"echo "the device was lost" >&2; exit 1"#);
    let output = measure_gpu(&["quick", "from", folder.path().to_str().unwrap()]);
    assert_eq!(output.status.code(), Some(1));
    let text = said(&output);
    assert!(text.contains("Not measured:\n- 4 walls, town failed: the device was lost\n"), "{text}");
    assert_eq!(text.matches("the device was lost").count(), 4, "{text}");
    assert_eq!(text.matches("one window").count(), 6, "{text}");
}

#[test]
fn words_are_told_and_others_refused() {
    let help = measure_gpu(&["--help"]);
    assert!(help.status.success() && said(&help).contains("measure-gpu quick"), "{}", said(&help));
    for (words, sentence) in [
        (&["quickly"][..], "unknown word: quickly"),
        (&["from"], "from needs a folder"),
        (&["from", "/nowhere"], "/nowhere holds no benchmarks"),
    ] {
        let refused = measure_gpu(words);
        assert_eq!(refused.status.code(), Some(2), "{words:?}");
        assert!(told(&refused).contains(sentence) && told(&refused).lines().count() == 1, "{}", told(&refused));
    }
}
