//! Law: a tour's file is read strictly, and each fault is named with its line, its key and what to do. A wrong program
//! would guess, or show a caption that nobody wrote.

#![allow(clippy::unwrap_used, reason = "helpers of tests, too, may fail the test")]

use input::VehicleKind;
use tours::{BUILT_IN, StationRide, TourError, TourView, built_in, parse, read};
use view::{Effects, Places};

const HEAD: &str = "title.en = \"A\"\nscene = \"town\"\n";

/// Sentence about a text that is no tour.
fn sentence(text: &str) -> String {
    parse("a.toml", text).unwrap_err().to_string()
}

#[test]
fn built_in_tours_speak_english_and_german_and_are_shorter_than_a_minute() {
    for (name, _) in BUILT_IN {
        let plan = built_in(name).unwrap();
        assert!(plan.longest_s() < 60.0, "{name} takes {} s", plan.longest_s());
        let of_station = plan.stations.iter().flat_map(|station| {
            let question = station.question.iter().flat_map(|question| {
                let answers = question.answers.iter().flat_map(|answer| [&answer.text, &answer.why]);
                std::iter::once(&question.ask).chain(answers)
            });
            std::iter::once(&station.caption).chain(question)
        });
        for text in std::iter::once(&plan.title).chain(of_station) {
            assert_eq!(text.0.keys().collect::<Vec<_>>(), ["de", "en"], "{name}: {text:?}");
            assert!(text.in_language("en") != text.in_language("de"), "{name}: {text:?}");
        }
        assert!(plan.stations.iter().any(|station| station.question.is_some()), "{name} asks nothing");
    }
}

#[test]
fn a_tour_with_all_keys_is_read() {
    let text = r#"
title = { en = "A", de = "B" }
scene = "my.glb"
speed_of_light = "7.2 km/h"
vehicle = "drive"
thrust = 0.5
start = { position = [1, 2, 3], look = [0, 0, -2] }
[[station]]
seconds = 2.5
thrust = [0, 1, -1]
effects = "geometry,doppler"
view = "measured"
show = ["diagram"]
caption.en = "C"
pause = true
"#;
    let plan = parse("a.toml", text).unwrap();
    assert_eq!((plan.title.in_language("de"), plan.title.in_language("fr")), ("B", "A"));
    assert_eq!((plan.scene.as_str(), plan.speed_of_light_m_s, plan.vehicle), ("my.glb", Some(2.0), VehicleKind::Drive));
    let [position, look] = plan.start.unwrap();
    assert_eq!((position.to_array(), look.to_array()), ([1.0, 2.0, 3.0], [0.0, 0.0, -1.0]));
    let station = &plan.stations[0];
    assert_eq!((station.seconds, station.ride, station.pause), (2.5, StationRide::Thrust([0, 1, -1]), true));
    assert_eq!(station.effects, Some(Effects { places: Places::Seen, doppler: true, searchlight: false }));
    assert_eq!(station.view, Some(TourView::Measured));
}

#[test]
fn the_example_of_the_documentation_is_a_tour() {
    let text = include_str!("../../../../docs/TOURS.md");
    let example = text.split("```toml\n").nth(1).unwrap().split("```").next().unwrap();
    let plan = parse("TOURS.md", example).unwrap();
    assert!(plan.stations.len() >= 3 && plan.stations.iter().any(|station| station.question.is_some()));
}

#[test]
fn each_fault_is_named_with_its_line_and_what_to_do() {
    let station = "[[station]]\nseconds = 1\n";
    let drive = "title.en = \"A\"\nscene = \"town\"\nvehicle = \"drive\"\n[[station]]\nseconds = 1\n";
    let cases = [
        (HEAD.to_owned(), "line 3: it has no station: add a table [[station]]"),
        (format!("{HEAD}colour = 1\n{station}"), "line 3: unknown field `colour`"),
        (format!("{HEAD}[[station]]\n"), "line 3: missing field `seconds`"),
        (format!("{HEAD}[[station]]\nseconds = -1\n"), "line 4: seconds is -1: expected a number from 0.1 to 600"),
        (format!("{HEAD}[[station]]\nseconds = nan\n"), "line 4: seconds is NaN"),
        (format!("{HEAD}{station}effects = \"bright\"\n"), "line 5: effects is \"bright\": expected all, none"),
        (format!("{HEAD}{station}view = \"x\"\n"), "line 5: view is \"x\": expected seen, measured or instant"),
        (format!("{HEAD}{station}show = [\"x\"]\n"), "line 5: show is \"x\": expected diagram"),
        (format!("{HEAD}{station}speed = \"30\"\n"), "line 5: speed is \"30\": expected a number and m/s"),
        (format!("{HEAD}{station}thrust = [0, 0, 1]\n"), "line 5: thrust is for the vehicles drive and fly"),
        (format!("{drive}speed = \"1 m/s\"\n"), "line 6: speed is for a bicycle"),
        (
            format!("{HEAD}recording = \"r.mcap\"\n{station}thrust = [0, 0, 1]\n"),
            "line 6: the recording rides by itself",
        ),
        (format!("{HEAD}recording = \"r.mcap\"\n{station}speed = \"1 m/s\"\n"), "line 6: speed is for a bicycle"),
        (format!("{HEAD}{station}speed = \"0.8 c\"\n"), "line 5: speed is road per second"),
        (
            format!("{HEAD}{station}[[station.event]]\nname.en = \"a\"\nposition = [0, 0, inf]\n"),
            "line 5: position holds",
        ),
        (format!("{drive}thrust = [0, 0, 2]\n"), "line 6: thrust is [0, 0, 2]: expected −1, 0 or 1"),
        (format!("{drive}until = 3\n"), "until is a length along a bicycle's route"),
        (format!("{HEAD}{station}caption.english = \"x\"\n"), "line 5: caption has the language \"english\""),
        (format!("{HEAD}{station}caption.en = \"\"\n"), "line 5: caption has no text"),
        (
            format!("{HEAD}{station}question = {{ ask.en = \"x\", answer = [] }}\n"),
            "line 5: the question has 0 answers",
        ),
        (format!("{HEAD}vehicle = \"boat\"\n{station}"), "line 3: vehicle is \"boat\": expected bicycle, drive or fly"),
        (format!("{HEAD}route = \"x\"\n{station}"), "line 3: route is \"x\": expected \"circuit\" or a list"),
        (format!("{HEAD}route = [[0, 0, inf]]\n{station}"), "line 3: route holds [0, 0, inf]"),
        (format!("{HEAD}speed_of_light = \"0 m/s\"\n{station}"), "line 3: speed_of_light is \"0 m/s\""),
    ];
    for (text, expected) in cases {
        let said = sentence(&text);
        assert!(said.starts_with("a.toml, line ") && said.contains(expected), "{said}\ninstead of {expected}");
    }
}

#[test]
fn hostile_files_are_refused_at_once() {
    let deep = format!("title = {}", "[".repeat(200_000));
    let many = format!("{HEAD}{}", "[[station]]\nseconds = 1\n".repeat(201));
    let long = format!("{HEAD}[[station]]\nseconds = 1\ncaption.en = \"{}\"\n", "x".repeat(5000));
    let points = format!("{HEAD}route = [{}]\n[[station]]\nseconds = 1\n", "[0, 0, 0],".repeat(10_001));
    for text in [deep.as_str(), &many, &long, &points, "", "\0", "= = ="] {
        let started = std::time::Instant::now();
        assert!(parse("a.toml", text).is_err());
        assert!(started.elapsed().as_secs() < 5);
    }
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("a.toml");
    std::fs::write(&path, [0xff, 0xfe]).unwrap();
    assert!(matches!(read(&path), Err(TourError::NoText { .. })));
    std::fs::write(&path, vec![b'#'; (1 << 20) + 1]).unwrap();
    assert!(matches!(read(&path), Err(TourError::File { .. })));
    assert!(matches!(read(folder.path()), Err(TourError::File { .. })));
}

#[test]
fn an_unknown_name_is_answered_with_those_that_there_are() {
    let said = built_in("moon").unwrap_err().to_string();
    assert!(said.contains("\"searchlight\"") && said.contains("\"twins\""), "{said}");
}
