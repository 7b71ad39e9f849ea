//! Laws: a recorded ride that is held stands still and goes on where it was, for whoever has given the hold a key of
//! their own; a tour that tells of a recording holds it where it waits.
#![allow(clippy::unwrap_used, reason = "a failed construction is a failed test")]

use super::recorded_ride::RecordedRide;
use super::tour_ride::TourRide;
use glam::DVec3;
use input::recording::Recording;
use input::{Action, DeskConfig, KeyMap, KeyboardKey, Nanos, SECOND, Sample, VehicleKind};
use ride::{LightSpeed, Replay, RideFrame, RideLog, RideStart, Setup, Simulation, VehicleSettings};
use scene::OpenPlane;
use std::sync::Arc;
use tours::TourPlayer;

/// Flight of three seconds with full thrust, 60 frames a second, recorded.
fn recorded() -> (tempfile::TempDir, Replay) {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("r.mcap");
    let setup = Setup {
        light_speed: LightSpeed::OLD_TOWN,
        kind: VehicleKind::Fly,
        start: RideStart::at_rest(DVec3::Y * 2.0, DVec3::NEG_Z, DVec3::Y),
        vehicle: VehicleSettings::default(),
        desk: DeskConfig::default(),
    };
    let mut log = RideLog::new(setup.header("test", "plane"));
    log.record(&path).unwrap();
    let mut ride = Simulation::new(setup, Arc::new(OpenPlane)).unwrap();
    for number in 0..=180 {
        let at = number * SECOND / 60;
        let samples = if number == 0 { vec![Sample::key(0, KeyboardKey::W, true)] } else { Vec::new() };
        let frame = ride.frame(at, &samples);
        log.frame(&samples, &frame).unwrap();
    }
    log.finish().unwrap();
    let replay = Replay::new(Recording::open(&path).unwrap(), Arc::new(OpenPlane)).unwrap();
    (folder, replay)
}

fn frame(ride: &mut RecordedRide, now: Nanos, said: &[Sample]) -> RideFrame {
    ride.frame(now, said).unwrap().frame.unwrap()
}

#[test]
fn a_ride_that_is_held_goes_on_where_it_was() {
    let (_folder, replay) = recorded();
    let own = KeyMap([("F12".to_owned(), "toggle_pause".to_owned())].into());
    let mut ride = RecordedRide::new(replay, own);
    frame(&mut ride, 0, &[]);
    let before = frame(&mut ride, SECOND, &[Sample::key(SECOND, KeyboardKey::F12, true)]);
    for now in 2..5 {
        let held = frame(&mut ride, now * SECOND, &[]);
        assert!(held.paused && held.record.frame == before.record.frame, "{} {}", held.record.at, before.record.at);
    }
    let on = [Sample::key(5 * SECOND, KeyboardKey::F12, true)];
    frame(&mut ride, 5 * SECOND, &on);
    let after = frame(&mut ride, 6 * SECOND, &[]);
    assert!(!after.paused);
    assert_eq!(after.record.at, 2 * SECOND);
}

#[test]
fn a_tour_holds_the_recording_that_it_tells_of() {
    let (_folder, replay) = recorded();
    let text = "title.en = \"A\"\nscene = \"dice\"\nvehicle = \"fly\"\nrecording = \"r.mcap\"\n\
                [[station]]\nseconds = 1\npause = true\ncaption.en = \"one\"\neffects = \"none\"\n[[station]]\nseconds = 1\n";
    let plan = Arc::new(tours::parse("a.toml", text).unwrap());
    let mut tour = TourRide::new(TourPlayer::new(plan, &[], &DeskConfig::default()).unwrap());
    let mut ride = RecordedRide::new(replay, KeyMap::default());
    let mut held = None;
    let mut acted = Vec::new();
    for number in 0..60 * 5 {
        let now = number * SECOND / 60;
        let said = tour.samples(now, ride.replay.simulation());
        let shown = frame(&mut ride, now, &said);
        acted.extend(shown.controls.actions);
        if number == 120 {
            held = Some(shown.record.frame);
        }
        if number == 180 {
            assert_eq!(Some(shown.record.frame), held, "it rides on while the tour waits");
            assert!(shown.paused && (55..66).contains(&shown.record.frame), "{}", shown.record.frame);
            tour.act(&Action::GoOn);
        }
        if number == 200 {
            assert!(!shown.paused && Some(shown.record.frame) > held);
        }
        if tour.has_ended() {
            assert!(number > 180);
            assert!(acted.contains(&Action::Set(input::Setting::Effects, "none".to_owned())), "{acted:?}");
            return;
        }
    }
    panic!("the tour does not end");
}
