//! Law: `rapidity measure` measures. On boxes seen at half the speed of light, errors of position stay within the
//! promised tolerance, finer settings are more accurate, and table, file and plot agree. A wrong program shows an
//! error above the tolerance, a colour further from the ray tracer's with a finer setting, or a choice that `ride`
//! does not use.

use crate::runner::{rapidity, told};
use std::path::Path;
use std::process::Output;

/// Result of a command, with the user's preferences in the folder.
fn run(command: &str, home: &Path, arguments: &[&str]) -> Output {
    let arguments = [&[command], arguments].concat();
    rapidity(home, &arguments).env("XDG_CONFIG_HOME", home).output().unwrap()
}

fn measure(home: &Path, arguments: &[&str]) -> Output {
    run("measure", home, arguments)
}

/// Options for one small picture of the boxes, quick to draw.
const SMALL: [&str; 8] = ["--scene", "lattice", "--size", "96x64", "--poses", "1", "--rounds", "1"];

/// Options for filming a short ride.
const FILMED: [&str; 8] = ["--scene", "lattice", "--out", "r.mp4", "--size", "64x48", "--seconds", "0.3"];

/// File of comma-separated values.
struct Csv(Vec<Vec<String>>);

impl Csv {
    fn read(path: &Path) -> Self {
        let text = std::fs::read_to_string(path).unwrap();
        Self(text.lines().map(|line| line.split(',').map(str::to_owned).collect()).collect())
    }

    fn of_dial(&self, dial: &str) -> Vec<&str> {
        self.0.iter().filter(|row| row[0] == dial).map(|row| row[1].as_str()).collect()
    }

    fn number(&self, setting: &str, column: &str) -> f64 {
        let column = self.0[0].iter().position(|name| name == column).unwrap();
        self.0.iter().find(|row| row[1] == setting).ok_or(setting).unwrap()[column].parse().unwrap()
    }
}

#[test]
fn a_tolerance_is_kept_and_written_down() {
    let folder = tempfile::tempdir().unwrap();
    let (csv, svg) = (folder.path().join("m.csv"), folder.path().join("m.svg"));
    let files = ["--out", csv.to_str().unwrap(), "--plot", svg.to_str().unwrap()];
    let output = measure(folder.path(), &[&SMALL[..], &files].concat());
    assert!(output.status.success(), "{}", told(&output));

    let csv = Csv::read(&csv);
    let number = |flags: &str, column: &str| csv.number(&format!("--renderer {flags}"), column);
    // A picture of 60° over 64 pixels has 56.25′ a pixel in the mean, and tan 30° · 2/64 rad = 62.0′ in the middle.
    let pixel_arcmin = 62.1;
    for tolerance in [4.0, 2.0, 1.0, 0.5, 0.25] {
        let error = number(&format!("polygon --tolerance {tolerance}"), "arcmin_most");
        assert!(error <= tolerance * pixel_arcmin, "{tolerance} px: {error}′");
    }
    // Finer settings are more accurate in direction, and therefore in colour and perceived difference.
    for column in ["arcmin_most", "delta_e_99", "flip"] {
        for [fine, coarse] in
            [["image --map-scale 8", "image --map-scale 0.9"], ["polygon --edge 0.5", "polygon --edge 2"]]
        {
            assert!(number(fine, column) < number(coarse, column), "{column}: {fine}");
        }
    }
    // The stages add up to the whole, and a map of 8 texels a pixel holds more than one of 0.9. Medians of one round
    // are the values themselves.
    let stages = ["bend_ms_median", "upload_ms_median", "draw_ms_median"];
    for flags in ["polygon --edge 1", "polygon --tolerance 1", "image --map-scale 2"] {
        let sum: f64 = stages.iter().map(|stage| number(flags, stage)).sum();
        assert!((sum / number(flags, "ms_median") - 1.0).abs() < 1e-5, "{flags}");
    }
    assert!(number("image --map-scale 8", "bytes") > number("image --map-scale 0.9", "bytes") + 1e5);

    let table = String::from_utf8(output.stdout).unwrap();
    for (dial, settings) in
        [("edge", 3), ("transform", 2), ("tolerance", 5), ("map-scale", 3), ("samples", 3), ("shift-table", 6)]
    {
        let of_dial = csv.of_dial(dial);
        assert!(of_dial.len() == settings && of_dial.iter().all(|setting| table.contains(setting)), "{dial}: {table}");
    }
    assert_eq!((csv.of_dial("integrator").len(), csv.of_dial("precision").len()), (12, 2));
    let plot = std::fs::read_to_string(&svg).unwrap();
    assert!(plot.starts_with("<svg") && plot.contains("one pixel") && plot.contains("0.25"));
}

#[test]
fn rides_are_drawn_by_what_was_chosen_until_told_otherwise() {
    let folder = tempfile::tempdir().unwrap();
    let file = folder.path().join("rapidity/rapidity.toml");
    let ride = |options: &[&str]| run("ride", folder.path(), &[&FILMED[..], options].concat());

    // The budget cannot be met: the closest setting is named, and nothing is written.
    let output = measure(folder.path(), &[&SMALL[..], &["--budget", "0.001ms"]].concat());
    assert!(!output.status.success() && told(&output).contains("comes closest"), "{}", told(&output));
    assert!(!file.exists());
    // Any setting meets this budget: the most accurate one is chosen.
    let csv = folder.path().join("m.csv");
    let output = measure(folder.path(), &[&SMALL[..], &["--budget", "100s", "--out", csv.to_str().unwrap()]].concat());
    assert!(output.status.success(), "{}", told(&output));
    let text = std::fs::read_to_string(&file).unwrap();
    assert!(told(&output).contains(file.to_str().unwrap()) && text.contains("--budget 100000ms"), "{text}");
    let csv = Csv::read(&csv);
    let error = |setting: &&str| csv.number(setting, "arcmin_99");
    let settings = ["edge", "transform", "tolerance", "map-scale"].map(|dial| csv.of_dial(dial)).concat();
    let least = settings.iter().map(error).min_by(f64::total_cmp).unwrap();
    let closest = settings.iter().find(|setting| told(&output).contains(&format!("{setting} is best"))).unwrap();
    assert_eq!(error(closest), least, "{closest}: {}", told(&output));

    // A ride says that it reads the choice, and from which file; any option on how to draw leaves the file unread.
    let output = ride(&[]);
    assert!(output.status.success(), "{}", told(&output));
    assert!(told(&output).contains(&format!("{}: drawn with {closest}", file.display())), "{}", told(&output));
    assert!(!told(&ride(&["--renderer", "auto"])).contains("rapidity.toml"));

    for (said, text) in [
        ("--renderer polygon --edge 0.3,", "[ride]\nrenderer = \"polygon\"\nedge = 0.3\n"),
        ("--edge 0.3 --transform gpu,", "[ride]\nrenderer = \"polygon\"\nedge = 0.3\ntransform = \"gpu\"\n"),
    ] {
        std::fs::write(&file, text).unwrap();
        let output = ride(&[]);
        assert!(output.status.success() && told(&output).contains(said), "{said}: {}", told(&output));
    }
    assert!(!told(&ride(&["--transform", "cpu"])).contains("rapidity.toml"));
    for (broken, said) in [("[ride]\nrender = 1", "line 2"), ("[ride]\nrenderer = \"auto\"\nedge = 0.0", "edge is 0")] {
        std::fs::write(&file, broken).unwrap();
        let output = ride(&[]);
        let message = told(&output);
        // The ride goes on, and nothing that was written is lost.
        assert!(output.status.success() && message.contains(said) && message.contains("set aside as"), "{message}");
        let aside = |number: u32| file.with_extension(format!("toml.broken-{number}"));
        let kept = (1..3).filter_map(|number| std::fs::read_to_string(aside(number)).ok()).next_back();
        assert_eq!((kept.as_deref(), file.exists()), (Some(broken), false));
    }
}

#[test]
fn poses_come_from_a_recorded_ride() {
    let folder = tempfile::tempdir().unwrap();
    let output = run("ride", folder.path(), &[&FILMED[..], &["--record", "r.mcap", "--vehicle", "fly"]].concat());
    assert!(output.status.success(), "{}", told(&output));
    // The recording contains the name of its scene.
    let options = ["--replay", "r.mcap", "--size", "96x64", "--poses", "2", "--rounds", "1", "--tolerance", "50px"];
    let output = measure(folder.path(), &options);
    assert!(output.status.success(), "{}", told(&output));
    assert!(told(&output).contains("lattice: 2 poses"), "{}", told(&output));
}

#[test]
fn what_cannot_be_measured_is_refused_before_anything_is() {
    let folder = tempfile::tempdir().unwrap();
    for (arguments, said) in [
        (["--out", "table.txt"], ".csv"),
        (["--plot", "plot.pdf"], ".svg or .png"),
        (["--plot", "no/such/folder/plot.png"], "no/such/folder"),
        (["--poses", "0"], "1..=1000"),
        (["--budget", "16.7"], "as in 16.7ms"),
        (["--budget", "-3ms"], "as in 16.7ms"),
        (["--budget", "infs"], "as in 16.7ms"),
        (["--tolerance", "1"], "as in 1px"),
        (["--tolerance", "0px"], "as in 1px"),
        (["--speed-of-light", "30"], "km/h"),
        (["--replay", "ride.txt"], ".mcap"),
        (["--replay", "nowhere.mcap"], "nowhere.mcap"),
    ] {
        let output = measure(folder.path(), &arguments);
        assert!(!output.status.success() && told(&output).contains(said), "{arguments:?}: {}", told(&output));
    }
    let both = measure(folder.path(), &["--budget", "16.7ms", "--tolerance", "1px"]);
    assert!(!both.status.success() && told(&both).contains("cannot be used with"), "{}", told(&both));
}
