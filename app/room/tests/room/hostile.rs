//! Law: a display takes memory from its budget before it allocates, and time in proportion to its length. A wrong
//! program would be killed by a file of two kilobytes, or hang on one of two megabytes.
#![allow(clippy::unwrap_used, reason = "helpers of tests, too, may fail the test")]

use crate::containers::{pfm, png, zip};
use rand::{RngExt, SeedableRng};
use regular_file::Budget;
use room::{Display, DisplayError};
use std::fmt::Write;
use std::time::{Duration, Instant};

/// Number of machines, regions, viewports, channels.
const MANY: usize = 20_000;

/// Time that many may take, from opening to the report. Comparing all pairs takes minutes.
const SOON: Duration = Duration::from_secs(20);

fn within(name: &str, bytes: &[u8], limit: u64) -> Result<Display, DisplayError> {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join(name);
    std::fs::write(&path, bytes).unwrap();
    Display::load_within(&path, &Budget::new(limit))
}

/// Container whose regions have the alpha maps of these names, each 200 × 200.
fn maps(names: &[&str]) -> Vec<u8> {
    let mut xml = "<MPCDI profile='2d'><display><buffer id='b' xResolution='8' yResolution='8'>".to_owned();
    for index in 0..names.len() {
        write!(xml, "<region id='r{index}' x='0' y='0' xSize='1' ySize='1' xResolution='8' yResolution='8'/>").unwrap();
    }
    xml += "</buffer></display><files>";
    for (index, name) in names.iter().enumerate() {
        write!(xml, "<fileset region='r{index}'><alphaMap><path>{name}</path></alphaMap></fileset>").unwrap();
    }
    xml += "</files></MPCDI>";
    let picture = png(200, 200, &[9; 40_000]);
    let mut files = vec![("mpcdi.xml", xml.as_bytes())];
    for name in ["a.png", "b.png", "c.png"] {
        files.push((name, &picture));
    }
    zip(&files)
}

#[test]
fn maps_of_a_display_share_one_budget() {
    // Description and container take less than 400 kB; a map 200 kB, and 40 kB while it is decoded.
    let two = within("x.mpcdi", &maps(&["a.png", "b.png"]), 1_000_000);
    assert_eq!(two.unwrap().channels.len(), 2);
    let message = within("x.mpcdi", &maps(&["a.png", "b.png", "c.png"]), 700_000).unwrap_err().to_string();
    for words in ["x.mpcdi: region \"r", "alphaMap", ".png\"", "it would take", "--limit"] {
        assert!(message.contains(words), "{message:?} does not say {words:?}");
    }
    // A map that many regions name is there once.
    let shared = within("x.mpcdi", &maps(&["a.png"; 40]), 1_000_000).unwrap();
    assert_eq!(shared.channels.len(), 40);
    assert!(shared.channels.iter().all(|channel| channel.alpha == shared.channels[0].alpha && channel.alpha.is_some()));
}

#[test]
fn claims_are_refused_before_they_are_believed() {
    let huge = png(16_384, 16_384, &[0]);
    let alpha = "[[screen]]\nname = \"s\"\ncentre = [0, 1.6, -1]\nsize = [1, 1]\n[[window]]\nname = \"w\"\nsize = [8, 8]\n\
                 [[channel]]\nname = \"c\"\nscreen = \"s\"\nwindow = \"w\"\n";
    let folder = tempfile::tempdir().unwrap();
    std::fs::write(folder.path().join("m.png"), &huge).unwrap();
    let side: Vec<[f32; 3]> = vec![[0.0; 3]; 100];
    std::fs::write(folder.path().join("m.pfm"), pfm(&[&side[..]; 100], true)).unwrap();
    std::fs::write(folder.path().join("m.obj"), "v 0 0 0\n".repeat(1000)).unwrap();
    let path = folder.path().join("d.toml");
    for (text, limit, words) in [
        (format!("{alpha}alpha = \"m.png\"\n"), u64::MAX, "m.png: it has 16384 × 16384 samples"),
        (format!("{alpha}warp = \"m.pfm\"\n"), 300_000, "m.pfm: it would take"),
        (alpha.replace("centre = [0, 1.6, -1]\nsize = [1, 1]", "mesh = \"m.obj\""), 50_000, "m.obj: it would take"),
        (alpha.to_owned(), 1000, "d.toml: it would take"),
    ] {
        std::fs::write(&path, text).unwrap();
        let message = Display::load_within(&path, &Budget::new(limit)).unwrap_err().to_string();
        assert!(message.contains(words), "{message:?} does not say {words:?}");
    }
}

#[test]
fn xml_that_takes_too_long_to_parse_is_refused() {
    let attributes: String = (0..100_000).map(|n| format!(" a{n}='1'")).collect();
    let spaces: String = (0..60_000).map(|n| format!("<a xmlns:n{n}='u{n}'>")).collect();
    for (inside, words) in [
        (format!("<Machine{attributes}/>"), "more than 1000 attributes"),
        (format!("{spaces}{}", "</a>".repeat(60_000)), "more than 1000 namespaces"),
    ] {
        let begun = Instant::now();
        let text = format!("<pvx>{inside}</pvx>");
        let message = within("x.pvx", text.as_bytes(), Budget::DEFAULT).unwrap_err().to_string();
        assert!(message.contains(words) && begun.elapsed() < SOON, "{message} after {:?}", begun.elapsed());
    }
}

/// Checks that a file is read and described in time.
fn soon(name: &str, text: &str, channels: usize) {
    let begun = Instant::now();
    let display = within(name, text.as_bytes(), Budget::DEFAULT).unwrap();
    assert_eq!(display.channels.len(), channels, "{name}");
    let report = display.to_string();
    assert!(report.lines().count() > channels && begun.elapsed() < SOON, "{name} took {:?}", begun.elapsed());
}

#[test]
fn very_many_parts_take_time_in_proportion() {
    let machine = "<Machine Name='m' Geometry='8x8' LowerLeft='-1 -1 -1' LowerRight='1 -1 -1' UpperRight='1 1 -1'/>";
    soon("x.pvx", &format!("<pvx>{}</pvx>", machine.repeat(MANY)), MANY);

    let region = "<region id='r' x='0' y='0' xSize='1' ySize='1' xResolution='8' yResolution='8'/>";
    let regions = format!("<buffer id='b' xResolution='8' yResolution='8'>{}</buffer>", region.repeat(MANY));
    soon("x.mpcdi.xml", &format!("<MPCDI profile='2d'><display>{regions}</display></MPCDI>"), MANY);

    // Channels of one window, in rows of a hundred, each with a screen of its own.
    let mut text = format!("[[window]]\nname = \"w\"\nsize = [200, {}]\n", MANY / 50);
    for index in 0..MANY {
        let (x, y) = (2 * (index % 100), 2 * (index / 100));
        write!(
            text,
            "[[screen]]\nname = \"s{index}\"\ncentre = [0, 1.6, -1]\nsize = [1, 1]\n\
             [[channel]]\nname = \"c{index}\"\nscreen = \"s{index}\"\nwindow = \"w\"\nviewport = [{x}, {y}, 2, 2]\n"
        )
        .unwrap();
    }
    soon("x.toml", &text, MANY);

    let viewports: Vec<String> = (0..MANY)
        .map(|index| {
            let (x, y) = (2 * (index % 100), 2 * (index / 100));
            format!(
                "\"v{index}\":{{\"region\":{{\"x\":{x},\"y\":{y},\"w\":2,\"h\":2}},\
                 \"projectionPolicy\":{{\"type\":\"simple\",\"parameters\":{{\"screen\":\"s\"}}}}}}"
            )
        })
        .collect();
    let text = format!(
        "{{\"nDisplay\":{{\"scene\":{{\"screens\":{{\"s\":{{\"location\":{{\"x\":100}},\"size\":{{\"width\":100,\"height\":100}}}}}}}},\
         \"cluster\":{{\"nodes\":{{\"n\":{{\"window\":{{\"w\":200,\"h\":{}}},\"viewports\":{{{}}}}}}}}}}}}}",
        MANY / 50,
        viewports.join(",")
    );
    soon("x.ndisplay", &text, MANY);
}

#[test]
fn a_warp_of_noise_is_read_in_time() {
    let mut random = rand_chacha::ChaCha8Rng::seed_from_u64(3);
    let rows: Vec<Vec<[f32; 3]>> =
        (0..400).map(|_| (0..400).map(|_| [random.random(), random.random(), 0.0]).collect()).collect();
    let noise = pfm(&rows.iter().map(Vec::as_slice).collect::<Vec<_>>(), true);
    let xml = "<MPCDI profile='2d'><display><buffer id='b' xResolution='8' yResolution='8'><region id='r' x='0' y='0' \
               xSize='1' ySize='1' xResolution='8' yResolution='8'/></buffer></display><files><fileset region='r'>\
               <geometryWarpFile><path>w.pfm</path></geometryWarpFile></fileset></files></MPCDI>";
    let begun = Instant::now();
    let display =
        within("x.mpcdi", &zip(&[("mpcdi.xml", xml.as_bytes()), ("w.pfm", &noise)]), Budget::DEFAULT).unwrap();
    assert!(display.to_string().contains("pixels per degree"));
    assert!(begun.elapsed() < SOON, "{:?}", begun.elapsed());
}
