//! A recording of a ride with a tracked head must give the same head to the last bit, whatever the tracker sent; no
//! sample may make a head that a replay could not read back; and recordings from before heads were tracked must open.

use std::collections::BTreeMap;
use std::path::Path;

use glam::{DQuat, DVec3};
use input::head::{FlipAxis, Recentring, Tracking, VelocityFilter};
use input::openxr::{XrPose, XrReport};
use input::recording::{ControlsRecord, FrameRecord, Recorder, Recording, RecordingEntry, RideHeader};
use input::vrpn::wire::{COOKIE, DESCRIBES_SENDER, DESCRIBES_TYPE, VrpnMessage, description};
use input::{
    Controls, Desk, DeskConfig, HeadConfig, KeyboardKey, MouseButton, MouseEvent, Nanos, SECOND, Sample, SampleSource,
    VehicleKind, vrpn,
};
use proptest::prelude::*;

const URLS: [&str; 5] = ["vrpn://tracker/Head", "dtrack://:5000", "opentrack://", "openxr://", "mouse"];
const SOURCES: [SampleSource; 5] =
    [SampleSource::Vrpn, SampleSource::Dtrack, SampleSource::Opentrack, SampleSource::Openxr, SampleSource::Mouse];

fn filters() -> [VelocityFilter; 4] {
    [VelocityFilter::default(), VelocityFilter::least_squares(), VelocityFilter::one_euro(), VelocityFilter::Off]
}

fn config(url: &str, velocity: VelocityFilter) -> DeskConfig {
    let mut head = HeadConfig { velocity, ..HeadConfig::new(url.parse().unwrap()) };
    if url != "mouse" {
        head.room_from_tracker.position = [0.1, 2.0, -1.0 / 3.0];
        head.room_from_tracker.yaw = 30.0;
        head.head_from_sensor.position = [0.0, 0.1, 0.07];
        head.head_from_sensor.pitch = -12.5;
        head.flip = vec![FlipAxis::X];
        head.recentre = Recentring::Key;
    }
    DeskConfig { head: Some(head), ..DeskConfig::default() }
}

fn header(desk: DeskConfig) -> RideHeader {
    RideHeader {
        build: "0.1.0 (test)".to_owned(),
        scene: "town".to_owned(),
        speed_of_light_m_s: 30.0 / 3.6,
        vehicle: VehicleKind::Bicycle,
        integrator: "rk4".to_owned(),
        step_s: 1.0 / 240.0,
        desk,
        settings: BTreeMap::new(),
    }
}

/// Feeds the samples, and reads and records the controls after each.
fn ride(path: &Path, config: &DeskConfig, samples: &[Sample]) -> Vec<Controls> {
    let mut desk = Desk::new(config.clone()).unwrap();
    let mut recorder = Recorder::create(path, &header(config.clone())).unwrap();
    let mut ridden = Vec::new();
    for (frame, sample) in (0..).zip(samples) {
        desk.feed(sample);
        recorder.sample(sample).unwrap();
        let controls = desk.controls(sample.at);
        recorder.controls(frame, sample.at, &controls).unwrap();
        ridden.push(controls);
    }
    recorder.finish().unwrap();
    ridden
}

/// Bits of every number of a head.
fn bits(controls: &Controls) -> Vec<u64> {
    let head = controls.head.unwrap();
    let numbers =
        [&head.position_m.to_array()[..], &head.orientation.to_array(), &head.velocity_m_s.to_array()].concat();
    numbers.into_iter().map(f64::to_bits).collect()
}

/// Replays a recording and compares.
fn assert_same_again(path: &Path, ridden: &[Controls]) {
    let recording = Recording::open(path).unwrap();
    let mut desk = Desk::new(recording.header().desk.clone()).unwrap();
    let mut frames = 0;
    for entry in recording {
        match entry.unwrap() {
            RecordingEntry::Sample(sample) => desk.feed(&sample),
            RecordingEntry::Controls(record) => {
                let again = desk.controls(record.at);
                assert_eq!(again, ridden[frames], "frame {frames}");
                assert_eq!((&record.controls, bits(&record.controls)), (&again, bits(&ridden[frames])));
                frames += 1;
            }
            RecordingEntry::Frame(_) => {}
        }
    }
    assert_eq!(frames, ridden.len());
}

/// Pose of a 100 Hz tracker as a VRPN server sends it, number 5 of sender 3.
fn vrpn_pose(frame: u32, x: f64) -> Vec<u8> {
    let mut payload = vec![0; 8];
    let turn = 0.01 * f64::from(frame);
    for value in [x, 1.7, -x / 3.0, 0.0, turn.sin(), 0.0, turn.cos()] {
        payload.extend_from_slice(&value.to_be_bytes());
    }
    VrpnMessage {
        seconds: 1000 + frame / 100,
        microseconds: frame % 100 * 10_000,
        sender: 3,
        kind: 5,
        payload: &payload,
    }
    .to_bytes()
}

/// Samples of a walk of three seconds for this source.
fn walk(source: SampleSource) -> Vec<Sample> {
    let step = SECOND / 100;
    let mut samples = vec![Sample::opened(0, source)];
    let sway = |frame: u32| 0.3 * (0.05 * f64::from(frame)).sin();
    match source {
        SampleSource::Vrpn => {
            let mut stream = COOKIE.to_vec();
            stream.extend(description(DESCRIBES_SENDER, 3, "Head"));
            stream.extend(description(DESCRIBES_TYPE, 5, vrpn::POSE));
            (0..300).for_each(|frame| stream.extend(vrpn_pose(frame, sway(frame))));
            // The stream is cut without regard to the messages.
            samples
                .extend((1..).zip(stream.chunks(61)).map(|(chunk, bytes)| Sample::bytes(chunk * step, source, bytes)));
        }
        SampleSource::Dtrack => samples.extend((0..300_u32).map(|frame| {
            let text = format!(
                "fr {frame}\r\nts2 {} {} 4000\r\n6d 1 [0 1.0][{} 170.0 -99.0 0 0 0][1 0 0 0 1 0 0 0 1]\r\n",
                1000 + frame / 100,
                frame % 100 * 10_000,
                1000.0 * sway(frame)
            );
            Sample::bytes(u64::from(frame) * step, source, text.into_bytes())
        })),
        SampleSource::Opentrack => samples.extend((0..300_u32).map(|frame| {
            let numbers = [100.0 * sway(frame), 3.0, -20.0, 0.1 * f64::from(frame), 7.0, -3.0];
            let bytes: Vec<u8> = numbers.iter().flat_map(|number| number.to_le_bytes()).collect();
            Sample::bytes(u64::from(frame) * step, source, bytes)
        })),
        SampleSource::Openxr => samples.extend((0..300_u32).map(|frame| {
            let angle = 0.01 * f64::from(frame);
            let head = XrPose {
                position_m: Some([sway(frame) as f32, 1.7, -0.2]),
                orientation: Some(DQuat::from_rotation_y(angle).to_array().map(|part| part as f32)),
                ..XrPose::default()
            };
            let report = XrReport { time_ns: i64::from(frame) * 11_111_111, head, ..XrReport::default() };
            Sample::bytes(u64::from(frame) * step, source, report.to_bytes())
        })),
        _ => {
            samples.push(Sample::mouse(0, MouseEvent::Button { button: MouseButton::Left, pressed: true }));
            samples.extend((1..300).map(|frame| {
                let event = match frame % 3 {
                    0 => MouseEvent::Wheel(0.7),
                    1 => MouseEvent::Moved { right: -3.3, down: 1.1 },
                    _ => MouseEvent::Shift(frame % 2 == 0),
                };
                Sample::mouse(frame * step, event)
            }));
        }
    }
    let middle = samples.len() / 2;
    samples.insert(middle, Sample::key(samples[middle - 1].at, KeyboardKey::U, true));
    let end = samples.last().unwrap().at;
    samples.push(Sample::closed(end, source));
    samples.extend((1..50).map(|frame| Sample::closed(end + frame * step, SampleSource::Keyboard)));
    samples
}

#[test]
fn a_walk_is_the_same_again_to_the_last_bit() {
    for url in URLS {
        for filter in filters() {
            let directory = tempfile::tempdir().unwrap();
            let path = directory.path().join("walk.mcap");
            let config = config(url, filter);
            let samples = walk(config.head.as_ref().unwrap().url.source());
            let ridden = ride(&path, &config, &samples);
            // The rider has declared a pose to be the straight one, and the head has moved, so something was compared.
            let home = DVec3::from_array(config.head.as_ref().unwrap().home);
            let heads = ridden.iter().map(|controls| controls.head.unwrap());
            let straight = heads.into_iter().any(|head| head.tracked == Tracking::Tracked && head.position_m == home);
            assert!(straight || url == "mouse", "{url}");
            let fastest =
                ridden.iter().map(|controls| controls.head.unwrap().velocity_m_s.length()).fold(0.0, f64::max);
            assert!(fastest > 0.3, "{url}, {filter:?}: {fastest}");
            assert_same_again(&path, &ridden);
        }
    }
}

#[test]
fn every_source_tracks_and_a_tracker_that_goes_loses_the_head() {
    for url in URLS {
        let config = config(url, VelocityFilter::default());
        let source = config.head.as_ref().unwrap().url.source();
        let mut desk = Desk::new(config).unwrap();
        assert_eq!(desk.controls(0).head.unwrap().tracked == Tracking::Never, source != SampleSource::Mouse);
        let samples = walk(source);
        let closed = samples.iter().position(|sample| *sample == Sample::closed(sample.at, source)).unwrap();
        samples[..closed].iter().for_each(|sample| desk.feed(sample));
        let at = samples[closed].at;
        let before = desk.controls(at).head.unwrap();
        assert_eq!(before.tracked, Tracking::Tracked, "{url}");
        desk.feed(&samples[closed]);
        let lost = desk.controls(at).head.unwrap().tracked == Tracking::Fading;
        assert_eq!(lost, source != SampleSource::Mouse, "{url}");
        let after = desk.controls(at + SECOND).head.unwrap();
        if source != SampleSource::Mouse {
            assert_eq!((after.tracked, after.position_m), (Tracking::Lost, before.position_m));
        }
        assert!(after.velocity_m_s.length() < 2e-3, "{url}: {after:?}");
    }
}

#[test]
fn a_head_listens_to_its_own_tracker_alone() {
    for url in URLS {
        let config = config(url, VelocityFilter::default());
        let own = config.head.as_ref().unwrap().url.source();
        let mut desk = Desk::new(config).unwrap();
        for other in SOURCES {
            let before = desk.controls(0).head;
            if other != own {
                walk(other).iter().for_each(|sample| desk.feed(sample));
                assert_eq!(desk.controls(0).head, before, "{other} for {url}");
            }
        }
    }
}

#[test]
fn without_a_tracker_there_is_no_head() {
    let mut desk = Desk::new(DeskConfig::default()).unwrap();
    for source in SOURCES {
        walk(source).iter().for_each(|sample| desk.feed(sample));
        assert_eq!(desk.controls(10 * SECOND).head, None);
    }
}

/// Record from a recording that was made before heads were tracked.
#[test]
fn recordings_of_before_the_head_open() {
    let mut desk = serde_json::to_value(DeskConfig::default()).unwrap();
    assert_eq!(desk.as_object_mut().unwrap().remove("head"), None, "a desk without a head says nothing of it");
    assert_eq!(serde_json::from_value::<DeskConfig>(desk).unwrap(), DeskConfig::default());
    let controls = r#"{"frame":7,"at":9,"wheel_speed":2.5,"cadence_hz":null,"steer_rad":0.1,"brake":0.0,
        "thrust":[0.0,0.0,0.0],"turn":[0.0,0.0,0.0],"actions":["step"]}"#;
    let record: ControlsRecord = serde_json::from_str(controls).unwrap();
    assert_eq!((record.frame, record.controls.wheel_speed, record.controls.head), (7, Some(2.5), None));
}

#[test]
fn a_tracker_that_cannot_be_is_refused_at_the_door() {
    let mut config = config(URLS[1], VelocityFilter::default());
    config.head.as_mut().unwrap().fade_s = 0.0;
    let error = Desk::new(config).unwrap_err().to_string();
    assert_eq!(error, "tracker.fade_s is 0: expected a positive number from 1e-6 to 1e6");
}

/// Number as a tracker may send it, sound or not.
fn any_number() -> impl Strategy<Value = f64> {
    prop_oneof![4 => -3.0..3.0, 1 => any::<f64>(), 1 => Just(0.0), 1 => Just(1.0)]
}

/// Bytes that a tracker might send, good or bad.
fn any_bytes() -> impl Strategy<Value = Vec<u8>> {
    let vrpn = (any::<u32>(), any::<u32>(), proptest::array::uniform7(any_number()), 0..2_i32).prop_map(
        |(seconds, microseconds, numbers, sensor)| {
            let mut payload = [sensor.to_be_bytes(), [0; 4]].concat();
            numbers.iter().for_each(|number| payload.extend_from_slice(&number.to_be_bytes()));
            let pose = VrpnMessage { seconds: seconds % 3, microseconds, sender: 3, kind: 5, payload: &payload };
            let begin =
                [&COOKIE[..], &description(DESCRIBES_SENDER, 3, "Head"), &description(DESCRIBES_TYPE, 5, vrpn::POSE)];
            [begin.concat(), pose.to_bytes()].concat()
        },
    );
    let dtrack = (any::<u32>(), proptest::array::uniform3(any_number())).prop_map(|(time, [x, y, z])| {
        format!("ts2 {} {} 0\n6d 1 [0 1.0][{x} {y} {z} 0 0 0][1 0 0 0 1 0 0 0 1]\n", time % 3, time % 1_000_000)
            .into_bytes()
    });
    let opentrack = proptest::array::uniform6(any_number())
        .prop_map(|numbers| numbers.iter().flat_map(|number| number.to_le_bytes()).collect::<Vec<u8>>());
    let mouse = (any::<f32>(), any::<f32>()).prop_map(|(right, down)| MouseEvent::Moved { right, down }.to_bytes());
    let wheel = any::<f32>().prop_map(|ahead| MouseEvent::Wheel(ahead).to_bytes());
    prop_oneof![vrpn, dtrack, opentrack, mouse, wheel, proptest::collection::vec(any::<u8>(), 0..80)]
}

fn any_sample(source: SampleSource) -> impl Strategy<Value = Sample> {
    (any::<Nanos>(), any_bytes(), 0..20_u8).prop_map(move |(at, bytes, kind)| match kind {
        0 => Sample::opened(at % (5 * SECOND), source),
        1 => Sample::closed(at % (5 * SECOND), source),
        _ => Sample::bytes(at % (5 * SECOND), source, bytes),
    })
}

/// Address of a tracker, a filter, and samples.
fn any_track() -> impl Strategy<Value = (&'static str, VelocityFilter, Vec<Sample>)> {
    (proptest::sample::select(URLS.to_vec()), proptest::sample::select(filters().to_vec())).prop_flat_map(
        |(url, filter)| {
            let source = config(url, filter).head.unwrap().url.source();
            (Just(url), Just(filter), proptest::collection::vec(any_sample(source), 1..60))
        },
    )
}

proptest! {
    #![proptest_config(ProptestConfig { cases: 192, failure_persistence: None, ..ProptestConfig::default() })]

    /// Any samples of a tracker must give a head with finite place, turn and velocity, and the same again in a
    /// replay.
    #[test]
    fn any_noise_gives_a_sound_head_and_the_same_again((url, filter, samples) in any_track()) {
        let directory = tempfile::tempdir().unwrap();
        let path = directory.path().join("noise.mcap");
        let ridden = ride(&path, &config(url, filter), &samples);
        for controls in &ridden {
            let head = controls.head.unwrap();
            prop_assert!(head.position_m.is_finite() && head.position_m.abs().max_element() < 4000.0, "{head:?}");
            prop_assert!(head.velocity_m_s.is_finite() && head.orientation.is_normalized(), "{head:?}");
        }
        assert_same_again(&path, &ridden);
    }
}

/// Noise in −1 to 1, the same in every run.
fn noise(state: &mut u64) -> f64 {
    *state = state.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
    (*state >> 11) as f64 / (1_u64 << 52) as f64 - 1.0
}

/// Ride of a minute, sixty frames a second, with a head that a tracker reports a thousand times a second. The
/// tracker's numbers have the noise of a tenth of a millimetre, and as many bits as floats have (`is_f32`) or all.
fn tracked_minute(path: &Path, is_f32: bool) {
    const MILLISECOND: Nanos = SECOND / 1000;
    let config = config(URLS[0], VelocityFilter::default());
    let mut desk = Desk::new(config.clone()).unwrap();
    let mut recorder = Recorder::create(path, &header(config)).unwrap();
    let mut state = 1;
    let mut number = |value: f64, by: f64| {
        let value = value + by * noise(&mut state);
        if is_f32 { f64::from(value as f32) } else { value }
    };
    let mut first = COOKIE.to_vec();
    first.extend(description(DESCRIBES_SENDER, 3, "Head"));
    first.extend(description(DESCRIBES_TYPE, 5, vrpn::POSE));
    let give = |recorder: &mut Recorder, desk: &mut Desk, sample: Sample| {
        desk.feed(&sample);
        recorder.sample(&sample).unwrap();
    };
    give(&mut recorder, &mut desk, Sample::opened(0, SampleSource::Vrpn));
    give(&mut recorder, &mut desk, Sample::bytes(0, SampleSource::Vrpn, first));
    let mut frame = 0;
    for millisecond in 0..60_000_u32 {
        let time = f64::from(millisecond) * 1e-3;
        let at = (Nanos::from(millisecond) * MILLISECOND).saturating_add_signed((2e5 * number(0.0, 1.0)) as i64);
        let mut payload = vec![0; 8];
        let turn = glam::DQuat::from_euler(glam::EulerRot::YXZ, 0.4 * time.sin(), 0.2 * (0.3 * time).cos(), 0.1);
        for value in [
            number(0.3 * time.sin(), 1e-4),
            number(1.7 + 0.02 * (9.0 * time).sin(), 1e-4),
            number(0.2 * (0.7 * time).cos(), 1e-4),
            number(turn.x, 1e-4),
            number(turn.y, 1e-4),
            number(turn.z, 1e-4),
            number(turn.w, 1e-4),
        ] {
            payload.extend_from_slice(&value.to_be_bytes());
        }
        let microseconds = millisecond % 1000 * 1000 + (50.0 + 49.0 * number(0.0, 1.0)) as u32;
        let message = VrpnMessage {
            seconds: 1_700_000_000 + millisecond / 1000,
            microseconds,
            sender: 3,
            kind: 5,
            payload: &payload,
        };
        give(&mut recorder, &mut desk, Sample::bytes(at, SampleSource::Vrpn, message.to_bytes()));
        if u64::from(millisecond) * 60 / 1000 >= frame {
            let at = Nanos::from(millisecond) * MILLISECOND + (1e5 * (1.0 + number(0.0, 1.0))) as Nanos;
            recorder.controls(frame, at, &desk.controls(at)).unwrap();
            let three = |scale: f64| [1.0, 2.0, 3.0].map(|axis| scale * (axis * time).sin());
            let record = FrameRecord {
                frame,
                at,
                steps: 4,
                proper_time: 8.3 * time,
                ct: 9.1 * time,
                position: three(20.0),
                celerity: three(0.5),
                orientation: [0.1 * time.sin(), 0.7 * time.cos(), 0.0, 0.7],
                rapidity: 0.4 + 0.1 * time.sin(),
                doppler_ahead: 1.5 + 0.1 * time.cos(),
                road: 5.0 * time,
                odometer: 5.3 * time,
            };
            recorder.frame(&record).unwrap();
            frame += 1;
            // The writer is not to be flooded: a minute is written in a second or two.
            std::thread::sleep(std::time::Duration::from_micros(500));
        }
    }
    recorder.finish().unwrap();
    let head = desk.controls(60 * SECOND).head.unwrap();
    assert_eq!((frame, head.tracked), (3600, Tracking::Tracked));
}

/// A long ride must fit on a disk: an hour in 300 MB.
#[test]
fn an_hour_of_a_tracked_ride_is_less_than_300_megabytes() {
    const MOST_BYTES_PER_MINUTE: u64 = 300_000_000 / 60;
    for is_f32 in [true, false] {
        let directory = tempfile::tempdir().unwrap();
        let path = directory.path().join("ride.mcap");
        tracked_minute(&path, is_f32);
        let bytes = std::fs::metadata(&path).unwrap().len();
        println!("{:.0} MB an hour (floats: {is_f32})", bytes as f64 * 60e-6);
        assert!(bytes < MOST_BYTES_PER_MINUTE, "{} MB an hour", bytes as f64 * 60e-6);
        let samples = Recording::open(&path).unwrap().filter(|entry| matches!(entry, Ok(RecordingEntry::Sample(_))));
        assert_eq!(samples.count(), 60_002);
    }
}
