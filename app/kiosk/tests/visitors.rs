//! Laws: a visitor who has left the scene behind is brought back to the start, and the day's log says so; in a scene of
//! sky nobody is. A lost head stands in the day's log once, and so does its return.

#![allow(clippy::unwrap_used, reason = "what cannot be set up is a failed test")]

use glam::DVec3;
use input::{DeskConfig, KeyboardKey, SECOND, Sample, VehicleKind};
use kiosk::{DayLog, Kiosk};
use ride::{LightSpeed, RideStart, Setup, Simulation, VehicleSettings};
use scene::OpenSpace;
use serde_json::Value;
use std::path::Path;
use std::sync::Arc;

const START: DVec3 = DVec3::new(0.0, 2.0, 0.0);

fn setup() -> Setup {
    Setup {
        light_speed: LightSpeed::new(1.0).unwrap(),
        kind: VehicleKind::Fly,
        start: RideStart::at_rest(START, DVec3::NEG_Z, DVec3::Y),
        vehicle: VehicleSettings::default(),
        desk: DeskConfig::default(),
    }
}

fn kiosk(folder: &Path) -> Kiosk {
    Kiosk::new(3600.0, &setup(), 1.0, &[], Some(DayLog::in_folder(folder).unwrap())).unwrap()
}

/// Entries of the day's log, or of two if it is midnight.
fn log(folder: &Path) -> Vec<Value> {
    let mut days: Vec<_> = std::fs::read_dir(folder).unwrap().map(|day| day.unwrap().path()).collect();
    days.sort();
    let text: String = days.iter().map(|day| std::fs::read_to_string(day).unwrap()).collect();
    text.lines().map(|line| serde_json::from_str(line).unwrap()).collect()
}

/// Distances from the start in every frame of a flight straight ahead, metres.
fn flight(kiosk: &mut Kiosk, seconds: u64) -> Vec<f64> {
    let mut simulation = Simulation::new(setup(), Arc::new(OpenSpace)).unwrap();
    let mut distances = Vec::new();
    for number in 1..=60 * seconds {
        let now = number * SECOND / 60;
        let key = (number == 1).then(|| Sample::key(now, KeyboardKey::W, true));
        let (samples, _) = kiosk.samples(now, key.into_iter().collect(), simulation.vehicle());
        let frame = simulation.frame(now, &samples);
        kiosk.shown(now, &frame);
        distances.push(frame.gaze.observer.event.position.distance(START));
    }
    distances
}

#[test]
fn a_visitor_who_has_left_the_scene_behind_is_brought_back_to_the_start() {
    let folder = tempfile::tempdir().unwrap();
    let mut kiosk = kiosk(folder.path()).round_scene(START, 1.0, START);
    let distances = flight(&mut kiosk, 40);
    kiosk.finish(40 * SECOND);

    let back = distances.windows(2).filter(|pair| pair[1] < pair[0]).count();
    assert!(back >= 1, "nobody came back");
    // Thirty radii, and what is covered in the frames until the return.
    let farthest = distances.iter().copied().fold(0.0, f64::max);
    assert!((30.0..60.0).contains(&farthest), "{farthest}");
    let entries = log(folder.path());
    let strayed: Vec<_> = entries.iter().filter(|entry| entry["event"] == "strayed").collect();
    let rides: Vec<_> = entries.iter().filter(|entry| entry["event"] == "ride").collect();
    // The key that is still held begins the next ride, until the end.
    assert_eq!((strayed.len(), rides.len()), (back, back + 1), "{entries:?}");
    assert!(strayed.iter().all(|entry| (30.0..60.0).contains(&entry["metres"].as_f64().unwrap())), "{strayed:?}");
    assert!(rides.iter().all(|entry| entry["metres"].as_f64().unwrap() < 60.0), "{rides:?}");
}

#[test]
fn a_scene_of_sky_holds_nobody_back() {
    let folder = tempfile::tempdir().unwrap();
    for mut kiosk in [kiosk(folder.path()), kiosk(folder.path()).round_scene(START, 0.0, START)] {
        let distances = flight(&mut kiosk, 40);
        assert!(distances.is_sorted() && distances.last() > Some(&100.0), "{:?}", distances.last());
    }
    assert!(log(folder.path()).iter().all(|entry| entry["event"] != "strayed"));
}

#[test]
fn a_lost_head_and_its_return_stand_in_the_log_once() {
    let folder = tempfile::tempdir().unwrap();
    let mut kiosk = kiosk(folder.path());
    for tenth in 0..3000 {
        let lost = (100..2000).contains(&tenth).then_some("the head is lost");
        kiosk.head(tenth * SECOND / 10, lost);
    }
    let entries = log(folder.path());
    let faults: Vec<_> = entries.iter().filter(|entry| entry["event"] == "fault").collect();
    let sentences: Vec<_> = faults.iter().map(|fault| fault["sentence"].as_str().unwrap()).collect();
    let expected = ["for 5 s: the head is lost", "the head is tracked again; it was lost for 190 s"];
    assert_eq!(sentences, expected);
    assert!(faults.iter().all(|fault| fault["at"].as_str().unwrap().ends_with('Z')));
}
