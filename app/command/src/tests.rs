//! Law under test: a typed option reaches the program as the value it names, or is refused with a sentence that says
//! which option it was, what was typed, and what was expected. A wrong program would take a negative coordinate for
//! an option, let |beta| = 1 through, or ignore one of two options that contradict each other.

use super::line::Cli;
use ::render::display::{Development, Exposure, Gamut, Tone};
use ::ride::{AssistMode, IntegratorKind, Nose};
use clap::CommandFactory;
use glam::DVec3;
use view::{Effects, RendererName};

use super::*;
use filming::FrameFile;
use input::head::Stance;
use presentation::{Latency, Vignette};
use scene::Start;

/// Parses a line of words; an underscore stands for a space within a word.
fn parse(line: &str) -> Result<Command, Stop> {
    parse_from(format!("rapidity {line}").split_whitespace().map(|word| word.replace('_', " ")).collect::<Vec<_>>())
}

fn render(options: &str) -> RenderOptions {
    match parse(&format!("render --out a.png {options}")) {
        Ok(Command::Render(options)) => *options,
        other => panic!("{other:?}"),
    }
}

fn ride(options: &str) -> RideOptions {
    match parse(&format!("ride {options}")) {
        Ok(Command::Ride(options)) => *options,
        other => panic!("{other:?}"),
    }
}

#[test]
fn a_folder_for_a_display_may_have_a_dot_in_its_name() {
    for folder in ["walls", "walls-1.2", "walls.d/", "2026.05.01", ".hidden"] {
        let Ok(Command::Render(options)) = parse(&format!("render --display cave4 --out {folder}")) else {
            panic!("{folder} was refused")
        };
        assert_eq!(options.out, Output::Folder(folder.into()));
    }
}

/// Sentence with which a line is refused.
fn refusal(line: &str) -> String {
    match parse(line) {
        Err(Stop::Usage(sentence)) => sentence,
        other => panic!("{line} was not refused: {other:?}"),
    }
}

#[test]
fn clap_finds_no_fault_in_the_definitions() {
    Cli::command().debug_assert();
}

#[test]
fn hardware_smooths_edges_unless_one_sample_is_asked_for() {
    let samples = |options: &str| [true, false].map(|software| ride(options).samples(software));
    assert_eq!(samples(""), [1, 4]);
    assert_eq!(samples("--samples 1"), [1, 1]);
    assert_eq!(samples("--samples 16"), [1, 4]);
}

#[test]
fn a_bare_ride_is_a_bicycle_in_town_at_30_km_h() {
    let options = ride("");
    assert_eq!((&options.world.scene, options.world.scene()), (&None, SceneChoice::Town));
    assert_eq!((options.world.speed_of_light, options.world.camera.as_deref()), (None, None));
    assert_eq!(options.vehicle.vehicle, None);
    assert_eq!(options.vehicle.integrator, IntegratorKind::Rk4);
    assert_eq!(options.vehicle.time_scale, 1.0);
    assert_eq!(options.picture.size, [1280, 720]);
    assert_eq!(options.picture.effects, Effects::ALL);
    assert_eq!(options.picture.development(), Development::default());
    assert_eq!((options.record, options.replay, options.out, options.seconds), (None, None, None, None));
}

#[test]
fn a_ride_takes_all_its_options() {
    let options = ride(
        "--scene a/b.glb --vehicle fly --speed-of-light 1_c --set-up hall.toml --bicycle /dev/pts/3 --trainer tcp://[fe80::1] --slope-felt 50 --spacemouse --tracker vrpn://cave/Head --record r.mcap \
         --exposure -1.5 --tone filmic --gamut clamp \
         --seconds 2.5 --size 640x480 --edge 0.1 --latency low --effects none --renderer polygon --samples 1 \
         --threads 2 --integrator exact --transport gyroscopic --assist off --through-walls --time-scale 0.5 --out r.mp4 --realtime --fov 90",
    );
    assert_eq!(options.world.scene, Some(SceneChoice::File("a/b.glb".into())));
    assert_eq!(options.world.speed_of_light, Some(299_792_458.0));
    assert_eq!(options.dial.edge, Some(0.1));
    assert_eq!(
        options.devices,
        DeviceOptions {
            set_up: Some("hall.toml".into()),
            bicycle: Some("/dev/pts/3".to_owned()),
            trainer: Some("tcp://[fe80::1]:36866".parse().unwrap()),
            slope_felt: Some(50),
            spacemouse: true,
            tracker: Some("vrpn://cave:3883/Head".parse().unwrap()),
        }
    );
    assert_eq!(options.record, Some("r.mcap".into()));
    assert_eq!((options.seconds, options.latency, options.realtime), (Some(2.5), Latency::Low, true));
    assert_eq!(options.vehicle.vehicle, Some(VehicleName::Fly));
    assert_eq!(options.vehicle.integrator, IntegratorKind::Exact);
    assert_eq!(options.vehicle.transport, Nose::Gyroscopic);
    assert_eq!((options.vehicle.assist, options.vehicle.through_walls), (AssistMode::Off, true));
    assert_eq!(options.dial.renderer, RendererName::Polygon);
    assert_eq!((options.picture.samples, options.picture.threads, options.picture.fov), (1, Some(2), Some(90.0)));
    let developed = Development { exposure: Exposure::Stops(-1.5), tone: Tone::Filmic, gamut: Gamut::Clamp };
    assert_eq!(options.picture.development(), developed);
    assert!(ride("--replay r.mcap --verify").verify);
}

#[test]
fn coordinates_may_be_negative_with_a_space_or_an_equals_sign() {
    let expected = Some(DVec3::new(-3.0, 1.6, 0.0));
    assert_eq!(render("--position -3,1.6,0").viewpoint.position, expected);
    assert_eq!(render("--position=-3,1.6,-0").viewpoint.position, expected);
    assert_eq!(render("--position -3,_1.6,_0").viewpoint.position, expected);
}

#[test]
fn directions_of_any_length_become_unit_vectors() {
    for text in ["0,-2,0", "0,-1e300,0", "0,-1e-300,0"] {
        let viewpoint = render(&format!("--look {text} --up -4e200,0,0")).viewpoint;
        assert_eq!((viewpoint.look, viewpoint.up), (Some(DVec3::NEG_Y), Some(DVec3::NEG_X)));
    }
}

#[test]
fn a_velocity_is_the_same_by_celerity_and_by_beta() {
    let expected = DVec3::new(0.0, 0.0, -0.75);
    assert_eq!(render("--celerity 0,0,-0.75").viewpoint.celerity().vector(), expected);
    assert_eq!(render("--beta 0,0,-0.6").viewpoint.celerity().vector(), expected);
    assert_eq!(render("").viewpoint.celerity(), physics::Celerity::ZERO);
    assert_eq!(render("--celerity 1e12,0,0").viewpoint.celerity().vector().x, 1e12);
}

#[test]
fn speeds_come_in_every_unit() {
    /// Bound on rounding: the conversion factors are rounded once, their product with the number once more.
    const ROUNDING: f64 = 4.0 * f64::EPSILON;
    for (text, expected) in [
        ("36_km/h", 10.0),
        ("36km/h", 10.0),
        ("299792458_m/s", 299_792_458.0),
        ("10_mph", 4.4704),
        ("3e2_km/s", 3e5),
        ("0.5_c", 149_896_229.0),
    ] {
        let speed = ride(&format!("--speed-of-light {text}")).world.speed_of_light.unwrap();
        assert!((speed / expected - 1.0).abs() <= ROUNDING, "{text}: {speed}");
    }
}

#[test]
fn the_ending_of_the_file_says_what_is_drawn() {
    assert_eq!(render("").out, Output::Picture("a.png".into()));
    let Ok(Command::Render(options)) = parse("render --out b/c.exr --tone histogram --exposure white") else {
        panic!()
    };
    assert_eq!(options.out, Output::Light("b/c.exr".into()));
    assert_eq!(options.picture.exposure, Exposure::WHITE);
    let Ok(Command::Render(options)) = parse("render --out b/c.MP4 --seconds 3 --fps 25") else { panic!() };
    assert_eq!(options.out, Output::Film("b/c.MP4".into()));
    assert_eq!((options.film.seconds, options.film.frames_per_second()), (Some(3.0), 25.0));
    assert_eq!(render("--replay r.mcap --seconds 3").film.seconds, Some(3.0));
}

#[test]
fn the_small_commands_parse() {
    assert_eq!(parse("probe").unwrap(), Command::Probe);
    assert_eq!(parse("town --out t.glb").unwrap(), Command::Town(TownOptions { out: "t.glb".into() }));
    let files = vec!["a.glb".into(), "b.mcap".into()];
    let reading = ReadingOptions { limit: 3.0, trust: false };
    assert_eq!(parse("check a.glb b.mcap").unwrap(), Command::Check(CheckOptions { files, json: false, reading }));
    let tracker = Some("dtrack://0.0.0.0:5000".parse().unwrap());
    let trainer = Some("tcp://kickr:36867".parse().unwrap());
    let devices = DevicesOptions {
        set_up: Some("hall.toml".into()),
        calibrate: None,
        bicycle: Some("/dev/ttyUSB0".to_owned()),
        trainer,
        tracker,
        sensor: Some(2),
        display: Some("lab.toml".to_owned()),
        seconds: Some(1.0),
    };
    assert_eq!(
        parse("devices --set-up hall.toml --bicycle /dev/ttyUSB0 --trainer tcp://kickr:36867 --tracker dtrack:// --sensor 2 --display lab.toml --seconds 1").unwrap(),
        Command::Devices(devices)
    );
}

#[test]
fn a_value_that_cannot_be_is_refused_with_its_option_and_what_was_expected() {
    for (line, told) in [
        ("render --out a.png --projection dome", ["--projection", "fisheye:220"]),
        ("render --out a.mp4 --frames 9-3", ["--frames", "ends before it begins"]),
        ("render --out a.#.png --part 5/4", ["--part", "3/16"]),
        ("render --out a.mp4 --codec divx", ["--codec", "h264, h265, av1, prores, ffv1"]),
        ("render --out a.mp4 --path p.json", ["--path", ".toml"]),
        ("render --out a.png --size 1280", ["--size", "WIDTHxHEIGHT"]),
        ("render --out a.png --size 0x720", ["'0x720'", "1 to 16384"]),
        ("render --out a.png --size 16385x1", ["--size", "1 to 16384"]),
        ("render --out a.png --position 1,2", ["'1,2'", "three finite numbers"]),
        ("render --out a.png --position 1,2,3,4", ["--position", "three finite numbers"]),
        ("render --out a.png --position 1,2,1e999", ["--position", "three finite numbers"]),
        ("render --out a.png --position nan,2,3", ["--position", "three finite numbers"]),
        ("render --out a.png --position --look=0,0,1", ["'--look=0,0,1'", "three finite numbers"]),
        ("render --out a.png --look 0,0,0", ["--look", "must not be 0,0,0"]),
        ("render --out a.png --beta 0.6,0.8,0", ["--beta", "not slower than light"]),
        ("render --out a.png --beta 1,0,0", ["--beta", "not slower than light"]),
        ("render --out a.png --celerity 1e200,0,0", ["--celerity", "1e75"]),
        ("render --out a.png --fov 0.5", ["--fov", "from 1 to 170"]),
        ("render --out a.png --fov nan", ["--fov", "from 1 to 170"]),
        ("render --out a.png --samples 0", ["--samples", "1..=64"]),
        ("render --out a.png --samples 65", ["--samples", "1..=64"]),
        ("render --out a.png --background 0,0,1.5", ["--background", "from 0 to 1"]),
        ("render --out a.png --background -0.1,0,0", ["--background", "from 0 to 1"]),
        ("ride --renderer raytrace", ["raytrace", "polygon or image"]),
        ("render --out a.png --exact-light", ["--exact-light", "raytrace"]),
        ("render --out a.png --bounces 2", ["--bounces", "raytrace"]),
        ("render --out a.png --projection sphere --shutter 1/50", ["--shutter", "raytrace"]),
        ("render --out a.png --outside 1,2,3 --aperture 0.1 --focus 3", ["--aperture", "--outside"]),
        ("render --out a.png --renderer raytrace --aperture 0.1", ["--focus", "required"]),
        ("render --out a.png --renderer raytrace --shutter 1/0", ["--shutter", "1/50"]),
        ("render --out a.png --renderer raytrace --bounces 17", ["--bounces", "0..=16"]),
        ("render --out a.png --renderer vulkan", ["--renderer", "auto, polygon, image or raytrace"]),
        ("render --out a.png --effects colour", ["--effects", "geometry"]),
        ("render --out a.png --exposure bright", ["--exposure", "auto, white, or a number of stops"]),
        ("render --out a.png --exposure 1e9", ["--exposure", "from -60 to 60"]),
        ("render --out a.png --tone soft", ["--tone", "reinhard, linear, exponential, filmic, histogram"]),
        ("render --out a.png --gamut wide", ["--gamut", "desaturate, white, clamp"]),
        ("render --out a.png --edge 0", ["--edge", "from 0.00001"]),
        ("render --out a.png --threads 0", ["--threads", "1..=1024"]),
        ("render --out a.jpg", ["--out", ".exr"]),
        ("render --out walls-1.2", ["--out", ".exr"]),
        ("render --display cave4 --out walls.jpg", ["--out", ".exr"]),
        ("render --display cave4 --out walls.png", ["--out", "folder"]),
        ("render --out png", ["--out", ".png"]),
        ("render --out a.mp4 --seconds -1", ["--seconds", "0 or above"]),
        ("render --out a.mp4 --seconds inf", ["--seconds", "0 or above"]),
        ("render --out a.mp4 --fps 0", ["--fps", "from 0.1 to 1000"]),
        ("render --out a.mp4 --replay r.png", ["--replay", ".mcap"]),
        ("ride --speed-of-light 30", ["--speed-of-light", "km/h"]),
        ("ride --speed-of-light 30_furlongs", ["--speed-of-light", "km/h"]),
        ("ride --speed-of-light 0_m/s", ["--speed-of-light", "positive"]),
        ("ride --speed-of-light 1e308_c", ["--speed-of-light", "positive"]),
        ("ride --speed-of-light -30_km/h", ["--speed-of-light", "positive"]),
        ("ride --vehicle boat", ["--vehicle", "bicycle"]),
        ("ride --tracker vrpn://cave", ["--tracker", "names no device"]),
        ("devices --tracker cave", ["--tracker", "vrpn://HOST/DEVICE"]),
        ("ride --trainer kickr", ["--trainer", "tcp://HOST:PORT"]),
        ("ride --trainer tcp://kickr --slope-felt 101", ["--slope-felt", "101"]),
        ("ride --slope-felt 50", ["--trainer", "set-up file"]),
        ("ride --latency none", ["--latency", "overlap"]),
        ("ride --integrator euler", ["--integrator", "dopri5"]),
        ("ride --transport bus", ["--transport", "gyroscopic"]),
        ("ride --assist perhaps", ["--assist", "auto"]),
        ("ride --time-scale 0", ["--time-scale", "to 16"]),
        ("ride --kiosk --idle-s 0", ["--idle-s", "from 1 to 86400"]),
        ("ride --out ride.png", ["--out", ".mp4"]),
        ("ride --out ride.exr", ["--out", ".mp4"]),
        ("town --out town.gltf", ["--out", ".glb"]),
    ] {
        let sentence = refusal(line);
        for part in told {
            assert!(sentence.contains(part), "{line}\n{sentence}");
        }
        assert!(!sentence.contains('\n') && !sentence.starts_with("error"), "{sentence}");
    }
}

#[test]
fn options_that_contradict_each_other_are_refused_by_name() {
    for (line, told) in [
        ("render --out a.png --celerity 1,0,0 --beta 0.5,0,0", ["--celerity", "--beta"]),
        ("render --out a.png --fps 25", ["--fps", ".mp4"]),
        ("render --out a.exr --fps 25", ["--fps", ".mp4"]),
        ("render --out a.exr --seconds 2", ["--seconds", "--replay"]),
        ("render --out a.png --seconds 2", ["--seconds", "--replay"]),
        ("render --out a.png --look 0,3,0 --up 0,-1,0", ["--up", "--look"]),
        ("render --out a.png --projection sphere --size 640x480", ["--size 640x480", "2 to 1"]),
        ("render --out a.exr --stereo anaglyph", ["anaglyph", ".exr"]),
        ("render --out a.png --stereo top-bottom --display cave4", ["--display", "--out"]),
        ("render --out walls --stereo top-bottom --display cave4", ["--stereo", "--display"]),
        ("render --out a.png --eye-separation 1", ["--stereo", "required"]),
        ("render --out a.png --outside 1,2,3 --projection sphere", ["--outside", "--projection"]),
        ("render --out a.png --frames 1-3", ["--frames", "film.####.png"]),
        ("render --out a.mp4 --resume", ["--resume", "film.####.png"]),
        ("render --out a.mp4 --part 1/2", ["--part", "film.####.png"]),
        ("render --out a.mp4 --codec prores", ["--codec prores", ".mov"]),
        ("render --out a.#.png --codec h264", ["--codec", ".mp4"]),
        ("render --out a.mp4 --path p.toml --look 0,0,1", ["--path", "--look"]),
        ("render --out a.mp4 --replay r.mcap --position 0,0,0", ["--replay", "--position"]),
        ("render --out a.mp4 --replay r.mcap --beta 0,0,0", ["--replay", "--beta"]),
        ("ride --verify", ["--verify", "--replay"]),
        ("ride --replay r.mcap --record s.mcap", ["--replay", "--record"]),
        ("ride --replay r.mcap --vehicle fly", ["--replay", "--vehicle"]),
        ("ride --replay r.mcap --spacemouse", ["--replay", "--spacemouse"]),
        ("ride --replay r.mcap --tracker mouse", ["--replay", "--tracker"]),
        ("ride --replay r.mcap --trainer tcp://kickr", ["--replay", "--trainer"]),
        ("ride --replay r.mcap --verify --out a.mp4", ["--verify", "--out"]),
        ("ride --kiosk --replay r.mcap", ["--kiosk", "--replay"]),
        ("ride --kiosk --out a.mp4", ["--kiosk", "--out"]),
        ("ride --kiosk --seconds 5", ["--kiosk", "--seconds"]),
        ("ride --kiosk --realtime", ["--kiosk", "--realtime"]),
        ("ride --display cave4 --preview --kiosk", ["--kiosk", "--preview"]),
        ("ride --idle-s 5", ["--kiosk", "required"]),
        ("ride --log days", ["--kiosk", "required"]),
        ("render", ["--out", "required"]),
        ("check", ["FILE", "required"]),
        ("ride --sped-of-light 1_c", ["--sped-of-light", "--speed-of-light"]),
        ("fly", ["fly", "subcommand"]),
    ] {
        let sentence = refusal(line);
        for part in told {
            assert!(sentence.contains(part), "{line}\n{sentence}");
        }
    }
}

#[test]
fn help_is_no_mistake() {
    for line in ["--help", "--version", "help ride", "render --help"] {
        assert!(matches!(parse(line), Err(Stop::Help(error)) if !error.use_stderr()), "{line}");
    }
    assert!(matches!(parse_from(["rapidity"]), Err(Stop::Help(_))));
}

#[test]
fn comfort_is_that_of_a_headset_unless_it_is_said_otherwise() {
    let start =
        Start { position: DVec3::ZERO, look: DVec3::NEG_Z, up: DVec3::Y, eye_height_m: 1.7, field_of_view_rad: None };
    let [desk, worn] = ["", "--headset"].map(|options| ride(options).presentation(&start));
    assert_eq!((desk.vignette, desk.cockpit, worn.vignette, worn.cockpit), (Vignette::Off, false, Vignette::Off, true));
    let asked = ride("--headset --vignette strong --cockpit off --snap-turn 0 --stance standing");
    let shown = asked.presentation(&start);
    assert_eq!((shown.vignette, shown.cockpit), (Vignette::Strong, false));
    assert_eq!((asked.comfort.snap_turn, asked.comfort.stance), (Some(0.0), Some(Stance::Standing)));
    assert_eq!(asked.passed_over(false), Vec::<String>::new());
    let vain = ride("--vignette weak --cockpit on --snap-turn 45 --stance seated").passed_over(false);
    assert_eq!(vain.len(), 4, "{vain:?}");
    assert_eq!(ride("--tracker openxr:// --snap-turn 45 --stance seated").passed_over(false), Vec::<String>::new());
    for (line, told) in [
        ("--snap-turn 181", "from 0 to 180"),
        ("--stance lying", "seated or standing"),
        ("--cockpit yes", "on or off"),
        ("--vignette black", "vignette"),
    ] {
        assert!(refusal(&format!("ride {line}")).contains(told), "{line}: {}", refusal(&format!("ride {line}")));
    }
}

#[test]
fn pictures_have_the_size_that_their_projection_needs() {
    for (options, size) in [
        ("", [1280, 720]),
        ("--projection sphere", [4096, 2048]),
        ("--projection fisheye:220", [2048, 2048]),
        ("--projection cube --size 30x20", [30, 20]),
        ("--stereo side-by-side", [1280, 720]),
    ] {
        assert_eq!(render(options).picture.size, size, "{options}");
    }
    let Ok(Command::Render(options)) = parse("render --out film.####.exr --frames 3,5-9:2 --part env --resume") else {
        panic!()
    };
    let Output::Sequence(name, FrameFile::Exr) = &options.out else { panic!("{:?}", options.out) };
    assert_eq!(name.path(7), std::path::Path::new("film.0007.exr"));
    assert_eq!(options.film.part, Some(PartChoice::Environment));
    assert_eq!(options.film.frames.as_ref().unwrap().iter().collect::<Vec<_>>(), [3, 5, 7, 9]);
    // Straight above, what is ahead is below in the picture, as on a dome.
    let start = scene::Start { look: glam::DVec3::NEG_Z, ..scene::Start::default() };
    assert_eq!(render("--look 0,2,0").viewpoint.up(&start), glam::DVec3::Z);
}
