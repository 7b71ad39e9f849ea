//! Law: a film or its numbered pictures are the same whoever draws which part of them, however often it was broken
//! off, and players are told what they show. A wrong program leaves holes or half pictures in a film, shows a 360° film
//! as a flat one, or shifts its colours.

use crate::runner::{rapidity, told};
use serde_json::Value;
use std::collections::BTreeMap;
use std::fs;
use std::path::Path;
use std::process::{Command, Output};

const SMALL: [&str; 9] = ["render", "--scene", "lattice", "--size", "96x64", "--samples", "1", "--beta", "0.3,0,-0.6"];
const PIXELS: usize = 96 * 64;
/// Largest mean difference of a colour after a codec that loses something, codes: edges share colours among pixels.
const CODED: f64 = 12.0;

/// Runs the program with the small options and these; says what it told if it fails.
#[track_caller]
fn render(folder: &Path, more: &[&str], variables: &[(&str, &str)]) -> String {
    let output = rapidity(folder, &[&SMALL, more].concat()).envs(variables.iter().copied()).output().unwrap();
    assert!(output.status.success(), "{more:?}: {}", told(&output));
    told(&output)
}

/// Files of a folder, with their bytes.
fn files(folder: &Path) -> BTreeMap<String, Vec<u8>> {
    let entries = fs::read_dir(folder).unwrap().map(Result::unwrap).filter(|entry| entry.path().is_file());
    let file = |entry: fs::DirEntry| (entry.file_name().into_string().unwrap(), fs::read(entry.path()).unwrap());
    entries.map(file).collect()
}

fn tool(name: &str, arguments: &[&str], folder: &Path) -> Output {
    Command::new(name).args(["-v", "error"]).args(arguments).current_dir(folder).output().unwrap()
}

/// The film's only stream, as ffprobe reads it.
fn stream(folder: &Path, film: &str) -> Value {
    let output = tool("ffprobe", &["-count_frames", "-show_streams", "-of", "json", film], folder);
    let read: Value = serde_json::from_slice(&output.stdout).unwrap();
    assert_eq!(read["streams"].as_array().unwrap().len(), 1, "{read}");
    read["streams"][0].clone()
}

#[test]
fn parts_of_a_farm_together_make_every_picture_to_the_bit() {
    let [one, many] = [(); 2].map(|()| tempfile::tempdir().unwrap());
    let frames = ["--frames", "2-12:2,5", "--fps", "5", "--out", "film.####.png"];
    render(one.path(), &frames, &[]);
    let whole = files(one.path());
    let names: Vec<&str> = whole.keys().map(String::as_str).collect();
    let numbers = [2, 4, 5, 6, 8, 10, 12];
    assert_eq!(names, numbers.map(|number| format!("film.{number:04}.png")));
    assert!(whole.values().collect::<std::collections::BTreeSet<_>>().len() == 7, "pictures are alike");

    render(many.path(), &[&frames[..], &["--part", "1/3"]].concat(), &[]);
    let part = [&frames[..], &["--part", "env"]].concat();
    render(many.path(), &part, &[("SLURM_PROCID", "1"), ("SLURM_NTASKS", "3")]);
    assert_eq!(files(many.path()).len(), 5);
    render(many.path(), &part, &[("OMPI_COMM_WORLD_RANK", "2"), ("OMPI_COMM_WORLD_SIZE", "3")]);
    assert!(files(many.path()) == whole, "parts differ from the whole");
    // A step takes every third of the same pictures.
    let few = tempfile::tempdir().unwrap();
    render(few.path(), &[&frames[..], &["--step", "3"]].concat(), &[]);
    assert_eq!(
        files(few.path()).into_keys().collect::<Vec<_>>(),
        ["film.0002.png", "film.0008.png", "film.0005.png"]
            .into_iter()
            .collect::<std::collections::BTreeSet<_>>()
            .into_iter()
            .map(str::to_owned)
            .collect::<Vec<_>>()
    );
}

#[test]
fn what_is_whole_is_kept_and_the_rest_is_drawn() {
    for ending in ["png", "exr"] {
        let folder = tempfile::tempdir().unwrap();
        let name = |number: u32| folder.path().join(format!("a.{number}.{ending}"));
        let frames = ["--frames", "0-3", "--out", &format!("a.#.{ending}")];
        render(folder.path(), &frames, &[]);
        let whole = files(folder.path());
        let half = &whole[&format!("a.1.{ending}")];
        fs::write(name(1), &half[..half.len() / 2]).unwrap();
        fs::remove_file(name(2)).unwrap();
        let written = |number| fs::metadata(name(number)).unwrap().modified().unwrap();
        let before = [written(0), written(3)];
        let told = render(folder.path(), &[&frames[..], &["--resume"]].concat(), &[]);
        assert!(told.contains("2 pictures are there and whole, 2 are to be drawn"), "{told}");
        assert_eq!([written(0), written(3)], before);
        assert!(files(folder.path()) == whole, "{ending}");
        // Nothing is left to do, and no device is opened for that.
        let told = render(folder.path(), &[&frames[..], &["--resume"]].concat(), &[]);
        assert!(told.contains("4 pictures are there and whole, 0 are to be drawn"), "{told}");
    }
}

#[test]
fn a_film_of_no_length_is_its_first_picture() {
    let folder = tempfile::tempdir().unwrap();
    render(folder.path(), &["--seconds", "0", "--out", "a.####.png"], &[]);
    render(folder.path(), &["--seconds", "0", "--out", "a.mp4"], &[]);
    assert_eq!(files(folder.path()).into_keys().collect::<Vec<_>>(), ["a.0000.png", "a.mp4"]);
    assert_eq!(stream(folder.path(), "a.mp4")["nb_read_frames"], "1");
}

#[test]
fn every_codec_keeps_the_pictures_and_their_colours() {
    let folder = tempfile::tempdir().unwrap();
    let film = ["--seconds", "0.4", "--fps", "10", "--exposure", "white", "--tone", "exponential"];
    render(folder.path(), &[&film[..], &["--out", "a.#.png"]].concat(), &[]);
    for (codec, file, name) in [
        ("h264", "a.mp4", "h264"),
        ("h265", "b.mp4", "hevc"),
        ("av1", "c.mp4", "av1"),
        ("prores", "d.mov", "prores"),
        ("ffv1", "e.mkv", "ffv1"),
    ] {
        render(folder.path(), &[&film[..], &["--codec", codec, "--out", file]].concat(), &[]);
        let stream = stream(folder.path(), file);
        assert_eq!((stream["codec_name"].as_str(), stream["nb_read_frames"].as_str()), (Some(name), Some("4")));
        if codec != "ffv1" {
            assert_eq!(stream["color_space"], "bt709", "{codec}");
        }
        let pictures = tool("ffmpeg", &["-i", file, "-f", "rawvideo", "-pix_fmt", "rgb24", "-"], folder.path()).stdout;
        for (number, shown) in pictures.chunks_exact(PIXELS * 3).enumerate() {
            let drawn = image::open(folder.path().join(format!("a.{number}.png"))).unwrap().to_rgb8();
            let sum: f64 = shown.iter().zip(drawn.as_raw()).map(|(a, b)| f64::from(a.abs_diff(*b))).sum();
            let mean = sum / shown.len() as f64;
            let most = if codec == "ffv1" { 0.0 } else { CODED };
            assert!(mean <= most, "{codec}, picture {number}: {mean}");
        }
        // One saturated colour everywhere, which another matrix would shift by many codes.
        let plain = ["--position", "0,0,900", "--look", "0,0,1", "--effects", "none", "--background", "0.6,0.05,0.01"];
        let one = ["--seconds", "0", "--exposure", "white", "--tone", "linear", "--codec", codec, "--out", file];
        render(folder.path(), &[&plain[..], &one].concat(), &[]);
        let shown = tool("ffmpeg", &["-i", file, "-f", "rawvideo", "-pix_fmt", "rgb24", "-"], folder.path()).stdout;
        let middle = &shown[3 * (PIXELS / 2 + 48)..][..3];
        // sRGB of that colour, by its formula.
        let expected = [203, 63, 25];
        let near = middle.iter().zip(expected).all(|(shown, expected)| shown.abs_diff(expected) <= 3);
        assert!(near, "{codec}: {middle:?} for {expected:?}");
    }
    render(folder.path(), &[&film[..4], &["--hdr", "hlg", "--out", "f.mp4"]].concat(), &[]);
    let stream = stream(folder.path(), "f.mp4");
    let told = ["codec_name", "pix_fmt", "color_space", "color_transfer", "color_primaries"];
    assert_eq!(
        told.map(|key| stream[key].as_str().unwrap()),
        ["hevc", "yuv420p10le", "bt2020nc", "arib-std-b67", "bt2020"]
    );
}

#[test]
fn players_are_told_how_a_film_is_projected() {
    let folder = tempfile::tempdir().unwrap();
    for (file, projection, size, stereo, mapped, eyes) in [
        ("a.mp4", "sphere", "64x32", None, Some("equirectangular"), None),
        ("b.mp4", "sphere", "64x32", Some("top-bottom"), Some("equirectangular"), Some("top and bottom")),
        ("c.mov", "sphere", "64x32", Some("side-by-side"), Some("equirectangular"), Some("side by side")),
        ("d.mp4", "vr180", "32x32", Some("side-by-side"), Some("tiled equirectangular"), Some("side by side")),
        ("e.mp4", "cube", "48x32", None, Some("cubemap"), None),
        ("f.mp4", "flat", "64x36", Some("side-by-side"), None, Some("side by side")),
        ("g.mp4", "fisheye", "32x32", None, None, None),
    ] {
        let film = ["--seconds", "0.1", "--projection", projection, "--size", size, "--codec", "h264", "--out", file];
        let stereo = stereo.map_or(vec![], |stereo| vec!["--stereo", stereo]);
        let arguments = ["render", "--scene", "lattice", "--samples", "1"];
        let output = rapidity(folder.path(), &[&arguments[..], &film, &stereo].concat()).output().unwrap();
        assert!(output.status.success(), "{file}: {}", told(&output));
        let stream = stream(folder.path(), file);
        assert_eq!(stream["nb_read_frames"], "3", "{file}");
        let side = stream["side_data_list"].as_array().cloned().unwrap_or_default();
        let of_kind = |kind: &str| side.iter().find(|data| data["side_data_type"] == kind).cloned();
        let projected = of_kind("Spherical Mapping").map(|data| data["projection"].as_str().unwrap().to_owned());
        assert_eq!(projected.as_deref(), mapped, "{file}: {side:?}");
        let seen = of_kind("Stereo 3D").map(|data| data["type"].as_str().unwrap().to_owned());
        assert_eq!(seen.filter(|eyes| eyes != "2D").as_deref(), eyes, "{file}: {side:?}");
        // The index comes first, so that a film plays before all of it is there; its pictures are whole.
        let bytes = fs::read(folder.path().join(file)).unwrap();
        let place = |kind: &[u8]| bytes.windows(4).position(|four| four == kind).unwrap();
        assert!(place(b"moov") < place(b"mdat"), "{file}");
        let decoded = tool("ffmpeg", &["-xerror", "-i", file, "-f", "null", "-"], folder.path());
        assert!(decoded.status.success() && decoded.stderr.is_empty(), "{file}: {}", told(&decoded));
        let first_form = bytes.windows(16).any(|text| text == b"GSpherical:Spher");
        assert_eq!(first_form, projection == "sphere", "{file}");
    }
}

#[test]
fn two_eyes_have_two_files() {
    let folder = tempfile::tempdir().unwrap();
    let eyes = ["--stereo", "left-right-files", "--eye-separation", "1"];
    render(folder.path(), &[&eyes[..], &["--out", "a.png"]].concat(), &[]);
    render(folder.path(), &[&eyes[..], &["--frames", "3", "--out", "a.#.png"]].concat(), &[]);
    render(folder.path(), &[&eyes[..], &["--seconds", "0.1", "--out", "a.mp4"]].concat(), &[]);
    let files = files(folder.path());
    let names: Vec<&str> = files.keys().map(String::as_str).collect();
    let expected = ["a.left.3.png", "a.left.mp4", "a.left.png", "a.right.3.png", "a.right.mp4", "a.right.png"];
    assert_eq!(names, expected);
    assert!(files["a.left.png"] != files["a.right.png"], "both eyes see the same");
}

#[test]
fn a_killed_program_leaves_no_half_picture() {
    let folder = tempfile::tempdir().unwrap();
    let frames = ["--frames", "0-2999", "--out", "a.####.png"];
    let mut program = rapidity(folder.path(), &[&SMALL, &frames[..]].concat()).spawn().unwrap();
    let named = || files(folder.path()).into_keys().filter(|name| !name.starts_with('.')).collect::<Vec<_>>();
    while named().len() < 3 {
        assert!(program.try_wait().unwrap().is_none(), "the program has ended");
        std::thread::sleep(std::time::Duration::from_millis(5));
    }
    program.kill().unwrap();
    program.wait().unwrap();
    let names = named();
    assert!(names.len() < 3000);
    for name in names {
        assert!(image::open(folder.path().join(&name)).is_ok(), "{name} is not whole");
    }
}

#[test]
fn a_camera_flies_through_one_scene_after_the_other() {
    let folder = tempfile::tempdir().unwrap();
    let path = "speed_of_light = 5\n[circle]\ncentre = [0, 0, 0]\nradius = 3\nspeed = 4\n";
    fs::write(folder.path().join("circle.toml"), path).unwrap();
    let two = "[[part]]\nscene = \"lattice\"\nspeed_of_light = 5\n[part.start]\nposition = [0, 0, 0]\n[[part.leg]]\nseconds = 0.5\nthrust = [0, 0, -1]\n\
               [[part]]\nscene = \"dice\"\nspeed_of_light = 5\n[part.start]\nposition = [0, 2, 8]\n[[part.leg]]\nseconds = 0.5\n";
    fs::write(folder.path().join("two.toml"), two).unwrap();
    let flown = |file: &str, out: &str| {
        let arguments = ["render", "--size", "64x36", "--samples", "1", "--fps", "8", "--path", file, "--out", out];
        rapidity(folder.path(), &arguments).output().unwrap()
    };
    let output = flown("two.toml", "two.mp4");
    assert!(output.status.success(), "{}", told(&output));
    assert!(told(&output).contains("lattice: drawn") && told(&output).contains("dice: drawn"), "{}", told(&output));
    assert_eq!(stream(folder.path(), "two.mp4")["nb_read_frames"], "8");
    let output = flown("circle.toml", "circle.#.png");
    assert!(output.status.success(), "{}", told(&output));
    // One turn of 6π metres at 4 m/s, by the camera's own clock, which runs slower by γ = 5/3: 2.83 s.
    let numbered = files(folder.path()).into_keys().filter(|name| name.starts_with("circle.") && name.ends_with("png"));
    assert_eq!(numbered.count(), 23);
    fs::write(folder.path().join("fast.toml"), path.replace("speed = 4", "speed = 6")).unwrap();
    let output = flown("fast.toml", "fast.mp4");
    assert_eq!(output.status.code(), Some(1));
    assert!(
        told(&output).starts_with("rapidity: fast.toml: ") && told(&output).contains("light at"),
        "{}",
        told(&output)
    );
    assert!(!folder.path().join("fast.mp4").exists());
}
