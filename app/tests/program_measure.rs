//! Law: `rapidity measure` measures. On boxes seen at half the speed of light it finds what must hold anywhere: nothing is further from its place than
//! was promised, finer dials are closer, and table, file and plot say the same.
#![allow(clippy::unwrap_used, reason = "a failed construction is a failed test")]

use std::process::{Command, Output};

fn measure(arguments: &[&str]) -> Output {
    Command::new(env!("CARGO_BIN_EXE_rapidity")).arg("measure").args(arguments).output().unwrap()
}

#[test]
fn a_tolerance_is_kept_and_written_down() {
    let folder = tempfile::tempdir().unwrap();
    let (csv, svg) = (folder.path().join("m.csv"), folder.path().join("m.svg"));
    let size = ["--scene", "lattice", "--size", "96x64", "--poses", "1", "--rounds", "1"];
    let files = ["--out", csv.to_str().unwrap(), "--plot", svg.to_str().unwrap()];
    let output = measure(&[&size[..], &files].concat());
    assert!(output.status.success(), "{}", String::from_utf8_lossy(&output.stderr));

    let text = std::fs::read_to_string(&csv).unwrap();
    let rows: Vec<Vec<&str>> = text.lines().skip(1).map(|line| line.split(',').collect()).collect();
    let most = |flags: &str| {
        let row = rows.iter().find(|row| row[0] == flags).unwrap_or_else(|| panic!("{flags} in {text}"));
        row[5].parse::<f64>().unwrap()
    };
    // 60° over 64 pixels make 56.25′ a pixel in the mean, and tan 30° · 2/64 rad = 62.0′ in the middle.
    let pixel_arcmin = 62.1;
    for tolerance in [4.0, 2.0, 1.0, 0.5, 0.25] {
        let error = most(&format!("--renderer polygon --tolerance {tolerance}"));
        assert!(error <= tolerance * pixel_arcmin, "{tolerance} px: {error}′");
    }
    assert!(most("--renderer image --map-scale 8") < most("--renderer image --map-scale 0.9"));
    assert!(most("--renderer polygon --edge 0.5") < most("--renderer polygon --edge 2"));

    let table = String::from_utf8(output.stdout).unwrap();
    assert!(rows.len() == 11 && rows.iter().all(|row| table.contains(row[0])), "{table}");
    let plot = std::fs::read_to_string(&svg).unwrap();
    assert!(plot.starts_with("<svg") && plot.contains("one pixel") && plot.contains("0.25"));
}

#[test]
fn files_that_cannot_be_written_are_refused_before_anything_is_measured() {
    for (arguments, told) in [
        (["--out", "table.txt"], ".csv"),
        (["--plot", "plot.pdf"], ".svg or .png"),
        (["--plot", "no/such/folder/plot.png"], "no/such/folder"),
        (["--poses", "0"], "1..=1000"),
    ] {
        let output = measure(&arguments);
        let message = String::from_utf8_lossy(&output.stderr);
        assert!(!output.status.success() && message.contains(told), "{arguments:?}: {message}");
    }
}
