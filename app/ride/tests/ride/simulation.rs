//! Law: the ride is a function of setup, samples and frame times: equal input gives equal output, to the last bit.
//!
//! A program with a clock, a thread or an unordered map in the path would differ from run to run. One that summed
//! rounded intervals would depend on the frame rate. One that replayed decoded values instead of raw bytes would not
//! notice a changed decoder.

#![allow(clippy::unwrap_used, reason = "helpers of tests, too, may fail the test")]

use std::sync::Arc;

use glam::DVec3;
use input::head::{Recentring, Stance};
use input::openxr::{XrHand, XrPose, XrReport};
use input::recording::{FrameRecord, Recorder, Recording, RecordingEntry, RecordingError};
use input::{
    Action, DeskConfig, HeadConfig, KeyboardKey, MouseButton, MouseEvent, Nanos, SECOND, Sample, SampleSource,
    VehicleKind, WandConfig,
};
use ride::{
    LightSpeed, Notice, Replay, ReplayError, Replayed, RideFrame, RideStart, Setup, Simulation, VehicleSettings,
};
use scene::OpenPlane;

pub(super) fn setup(kind: VehicleKind) -> Setup {
    Setup {
        light_speed: LightSpeed::OLD_TOWN,
        kind,
        start: RideStart::at_rest(DVec3::new(3.0, 0.0, -2.0), DVec3::new(1.0, 0.0, -1.0), DVec3::Y),
        vehicle: VehicleSettings::default(),
        desk: DeskConfig::default(),
    }
}

pub(super) fn simulation(kind: VehicleKind) -> Simulation {
    Simulation::new(setup(kind), Arc::new(OpenPlane)).unwrap()
}

/// Samples of a ride by keys that brakes, switches to flying, slows time down and comes back.
pub(super) fn busy_ride() -> Vec<Sample> {
    let tenth = |n: u64| n * SECOND / 10;
    vec![
        Sample::key(tenth(1), KeyboardKey::W, true),
        Sample::key(tenth(15), KeyboardKey::A, true),
        Sample::key(tenth(23), KeyboardKey::A, false),
        Sample::key(tenth(40), KeyboardKey::Space, true),
        Sample::key(tenth(45), KeyboardKey::Space, false),
        Sample::action(tenth(50), &Action::Vehicle(VehicleKind::Fly)),
        Sample::key(tenth(51), KeyboardKey::R, true),
        Sample::key(tenth(55), KeyboardKey::Q, true),
        Sample::action(tenth(60), &Action::TimeScale(0.3)),
        Sample::key(tenth(63), KeyboardKey::P, true),
        Sample::key(tenth(64), KeyboardKey::Period, true),
        Sample::key(tenth(65), KeyboardKey::P, false),
        Sample::key(tenth(66), KeyboardKey::P, true),
        Sample::action(tenth(70), &Action::SpeedOfLight(3.0)),
        Sample::action(tenth(75), &Action::Vehicle(VehicleKind::Bicycle)),
    ]
}

/// Frames at these times, each given the samples up to then.
pub(super) fn frames(
    simulation: &mut Simulation,
    samples: &[Sample],
    times: impl IntoIterator<Item = Nanos>,
) -> Vec<RideFrame> {
    let mut samples = samples.iter().peekable();
    let mut ride = |at| {
        let mut due = Vec::new();
        while let Some(sample) = samples.next_if(|sample: &&Sample| sample.at <= at) {
            due.push(sample.clone());
        }
        simulation.frame(at, &due)
    };
    times.into_iter().map(&mut ride).collect()
}

/// Times of sixty frames a second for so many seconds, none of them quite regular.
pub(super) fn times(seconds: u64) -> impl Iterator<Item = Nanos> {
    (0..=60 * seconds).map(|n| n * SECOND / 60 + n * 7919 % 2_000_000)
}

fn records(frames: &[RideFrame]) -> Vec<FrameRecord> {
    frames.iter().map(|frame| frame.record.clone()).collect()
}

fn assert_same(a: &[FrameRecord], b: &[FrameRecord]) {
    assert_eq!(a.len(), b.len());
    for (a, b) in a.iter().zip(b) {
        assert_eq!(a.first_difference(b), None, "frame {}", a.frame);
    }
}

#[test]
fn the_vehicles_clock_runs_faster_than_that_of_a_head_that_moves_in_it() {
    // Real time is the head's own: while it moves at u, the vehicle ages by γ = √(1 + u²). Old recordings keep one
    // clock.
    let own_m = |edition| {
        let head = HeadConfig { edition, ..HeadConfig::new("mouse".parse().unwrap()) };
        let desk = DeskConfig { head: Some(head), ..DeskConfig::default() };
        let mut ride = Simulation::new(Setup { desk, ..setup(VehicleKind::Fly) }, Arc::new(OpenPlane)).unwrap();
        let c = LightSpeed::OLD_TOWN.speed_of_light_m_s();
        let (mut expected, mut end) = (0.0, 0.0);
        for tick in 1..=240_u64 {
            let at = (tick * SECOND).div_ceil(240);
            let wheel = [Sample::mouse(at, MouseEvent::Wheel(40.0))];
            let frame = ride.frame(at, if tick == 10 { &wheel } else { &[] });
            let u = frame.controls.head.unwrap().velocity_m_s / c;
            expected += (1.0 + u.length_squared()).sqrt() * c / 240.0;
            end = frame.record.proper_time;
        }
        (end, expected, c)
    };
    let (found, expected, c) = own_m(2);
    assert!((found - expected).abs() < 1e-9 * expected, "{found} m for {expected} m");
    assert!(found > 1.05 * c, "the head has to move, or nothing is tested: {found} m of {c} m");
    let (found, _, c) = own_m(1);
    assert!((found - c).abs() < 1e-9 * c, "{found} m for {c} m");
}

#[test]
fn the_same_ride_has_the_same_bits() {
    let ride = || records(&frames(&mut simulation(VehicleKind::Bicycle), &busy_ride(), times(9)));
    let first = ride();
    assert_same(&first, &ride());
    let end = &first[first.len() - 1];
    assert!(end.road > 20.0 && end.rapidity > 0.1, "something happens: {end:?}");
}

/// The busy ride, of a rider who looks round with keys and the mouse.
pub(super) fn looking_ride() -> Vec<Sample> {
    let tenth = |n: u64| n * SECOND / 10;
    let drag = MouseEvent::Button { button: MouseButton::Left, pressed: true };
    let looks = [
        Sample::key(tenth(5), KeyboardKey::J, true),
        Sample::key(tenth(12), KeyboardKey::J, false),
        Sample::mouse(tenth(20), drag),
        Sample::mouse(tenth(21), MouseEvent::Moved { right: 70.0, down: -33.0 }),
        Sample::key(tenth(40), KeyboardKey::M, true),
        Sample::key(tenth(47), KeyboardKey::M, false),
        Sample::action(tenth(70), &Action::LookAhead),
    ];
    let mut samples: Vec<Sample> = busy_ride().into_iter().chain(looks).collect();
    samples.sort_by_key(|sample| sample.at);
    samples
}

#[test]
fn looking_round_turns_the_gaze_and_no_bit_of_the_worldline() {
    for kind in [VehicleKind::Bicycle, VehicleKind::Drive, VehicleKind::Fly] {
        let ahead = frames(&mut simulation(kind), &busy_ride(), times(9));
        let round = frames(&mut simulation(kind), &looking_ride(), times(9));
        assert_same(&records(&ahead), &records(&round));
        let turns = ahead.iter().zip(&round).map(|(ahead, round)| {
            assert_eq!(ahead.gaze.observer, round.gaze.observer);
            let forward = |frame: &RideFrame| frame.gaze.observer_from_eye * DVec3::NEG_Z;
            forward(ahead).angle_between(forward(round)).to_degrees()
        });
        let turns: Vec<f64> = turns.collect();
        // A key at 90° a second, then a drag, then the look back, and ahead again.
        for (second, expected) in [(0.4, 0.0), (1.0, 45.0), (1.8, 63.0), (4.5, 180.0), (8.0, 0.0)] {
            let found = turns[(second * 60.0) as usize];
            assert!((found - expected).abs() < 2.5, "{kind:?}: {found}° after {second} s");
        }
        assert_eq!(turns[8 * 60], 0.0);
    }
}

#[test]
fn a_replay_looks_where_the_rider_looked() {
    let setup = setup(VehicleKind::Bicycle);
    let ridden = frames(&mut simulation(VehicleKind::Bicycle), &looking_ride(), times(9));
    let entries = entries(&setup, &looking_ride()).into_iter().map(Ok);
    let mut replay = Replay::of(entries, setup, Arc::new(OpenPlane)).unwrap();
    for before in &ridden {
        let Replayed { frame, difference } = replay.next_frame().unwrap().unwrap();
        assert_eq!(difference, None);
        assert_eq!(frame.gaze, before.gaze);
    }
}

#[test]
fn the_ride_does_not_depend_on_the_number_of_threads() {
    let ride = |threads| {
        let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build().unwrap();
        pool.install(|| records(&frames(&mut simulation(VehicleKind::Bicycle), &busy_ride(), times(9))))
    };
    assert_same(&ride(1), &ride(2));
}

#[test]
fn the_ticks_do_not_depend_on_the_frame_rate() {
    let end = 9 * SECOND;
    let states: Vec<_> = [30, 60, 144, 1000]
        .map(|rate| {
            let mut simulation = simulation(VehicleKind::Bicycle);
            frames(&mut simulation, &busy_ride(), (0..=9 * rate).map(|n| n * SECOND / rate).chain([end]));
            *simulation.vehicle().state()
        })
        .to_vec();
    assert!(states.windows(2).all(|pair| pair[0] == pair[1]), "{states:?}");
}

#[test]
fn samples_that_come_early_or_out_of_order_wait_their_turn() {
    let ride = busy_ride();
    let punctual = frames(&mut simulation(VehicleKind::Bicycle), &ride, times(9));
    let mut early = simulation(VehicleKind::Bicycle);
    let shuffled: Vec<Sample> = ride.iter().rev().cloned().collect();
    let mut all_at_once = times(9).enumerate();
    let early: Vec<FrameRecord> =
        all_at_once.by_ref().map(|(n, at)| early.frame(at, if n == 0 { &shuffled } else { &[] }).record).collect();
    assert_same(&records(&punctual), &early);
}

#[test]
fn own_time_is_real_time_times_the_scale() {
    let mut simulation = simulation(VehicleKind::Fly);
    let samples =
        [Sample::action(2 * SECOND, &Action::TimeScale(0.25)), Sample::action(4 * SECOND, &Action::ScaleTime(4.0))];
    let ride = frames(&mut simulation, &samples, times(6));
    // Two seconds at the full rate, two at a quarter, two at the full rate again; a tick is 1/240 s.
    let own_s = ride[ride.len() - 1].vehicle.odometer().own_s;
    assert!((own_s - 4.5).abs() < 2.0 / 240.0, "{own_s}");
    assert_eq!(ride[180].time_scale, 0.25);
    // The time scale is limited.
    let faster = [Sample::action(6 * SECOND, &Action::TimeScale(1e300))];
    assert_eq!(simulation.frame(7 * SECOND, &faster).time_scale, 16.0);
}

#[test]
fn the_shown_vehicle_moves_on_between_ticks() {
    let mut simulation = simulation(VehicleKind::Bicycle);
    frames(&mut simulation, &[Sample::key(0, KeyboardKey::W, true)], times(3));
    let (at, tick) = (4 * SECOND, SECOND / 240);
    frames(&mut simulation, &[], (3..=4).map(|n| n * SECOND).chain([at]));
    let shown: Vec<f64> = (0..=6).map(|n| simulation.frame(at + n * tick / 3, &[]).record.road).collect();
    let strides: Vec<f64> = shown.windows(2).map(|pair| pair[1] - pair[0]).collect();
    // Each stride is a third of a tick, at a steadily growing speed.
    let mean = (shown[6] - shown[0]) / 6.0;
    assert!(mean > 0.0);
    assert!(strides.iter().all(|stride| (stride / mean - 1.0).abs() < 0.01), "{strides:?}");
}

#[test]
fn a_pause_stands_and_a_step_steps() {
    let mut simulation = simulation(VehicleKind::Bicycle);
    let samples = [
        Sample::key(0, KeyboardKey::W, true),
        Sample::key(2 * SECOND, KeyboardKey::P, true),
        Sample::key(3 * SECOND, KeyboardKey::Period, true),
        Sample::key(4 * SECOND, KeyboardKey::P, false),
        Sample::key(4 * SECOND, KeyboardKey::P, true),
    ];
    let ride = frames(&mut simulation, &samples, (0..300).map(|n| n * SECOND / 60));
    let proper_time = |second: usize| ride[60 * second - 5].record.proper_time;
    let tick = LightSpeed::OLD_TOWN.metres(1.0 / 240.0);
    assert!(ride[150].paused && !ride[100].paused && !ride[290].paused);
    assert_eq!(
        ride[125].record.first_difference(&FrameRecord {
            frame: 125,
            at: ride[125].record.at,
            ..ride[170].record.clone()
        }),
        None
    );
    assert!((proper_time(4) - ride[150].record.proper_time - tick).abs() < 1e-12, "one step");
    assert!((proper_time(5) - proper_time(4)) > 0.8 * LightSpeed::OLD_TOWN.metres(1.0) - 30.0 * tick, "it runs again");
    assert_eq!(ride.iter().map(|frame| frame.controls.actions.len()).sum::<usize>(), 3, "each action is told once");
}

#[test]
fn a_restart_is_a_new_ride_in_the_same_world() {
    let mut simulation = simulation(VehicleKind::Fly);
    let begin = simulation.vehicle().gaze();
    let samples = [
        Sample::key(0, KeyboardKey::R, true),
        Sample::action(SECOND, &Action::SpeedOfLight(2.0)),
        Sample::key(2 * SECOND, KeyboardKey::R, false),
        Sample::key(3 * SECOND, KeyboardKey::Backspace, true),
    ];
    let ride = frames(&mut simulation, &samples, times(2));
    assert!(ride[100].record.position[1] > 0.1);
    let ride = frames(&mut simulation, &samples[2..], (20..=32).map(|n| n * SECOND / 10));
    let end = &ride[ride.len() - 1];
    assert_eq!(end.gaze.observer.event.position, begin.observer.event.position);
    assert!(end.vehicle.odometer().own_s < 0.6 && end.vehicle.odometer().road_m == 0.0);
    assert_eq!(end.vehicle.light_speed().speed_of_light_m_s(), 2.0);
}

#[test]
fn a_change_of_the_speed_of_light_changes_no_clock() {
    let change = [Sample::key(0, KeyboardKey::R, true), Sample::action(2 * SECOND, &Action::SpeedOfLight(2.0))];
    for keeps_seconds in [true, false] {
        let mut setup = simulation(VehicleKind::Fly).setup().clone();
        setup.vehicle.keeps_seconds = keeps_seconds;
        let mut ride = Simulation::new(setup, Arc::new(OpenPlane)).unwrap();
        let ride = frames(&mut ride, &change, times(3));
        let last = &ride[ride.len() - 1];
        let light = last.vehicle.light_speed();
        let (state, odometer) = (last.vehicle.state(), last.vehicle.odometer());
        let seconds = [state.ct, state.proper_time].map(|metres| light.seconds(metres));
        let agrees = (seconds[0] - odometer.world_s).abs() < 1e-3 && (seconds[1] - odometer.own_s).abs() < 1e-9;
        assert_eq!(agrees, keeps_seconds, "{seconds:?} {odometer:?}");
    }
}

#[test]
fn a_stall_is_not_caught_up_with() {
    let mut simulation = simulation(VehicleKind::Fly);
    let frame = simulation.frame(10 * SECOND, &[]);
    assert_eq!((frame.record.steps, frame.dropped_ticks), (60, 2340));
    let frame = simulation.frame(10 * SECOND + SECOND / 60 + 1, &[]);
    assert_eq!((frame.record.steps, frame.dropped_ticks), (4, 0));
}

#[test]
fn a_speed_of_light_out_of_range_is_refused() {
    let mut simulation = simulation(VehicleKind::Fly);
    let frame = simulation.frame(SECOND / 10, &[Sample::action(0, &Action::SpeedOfLight(1e-300))]);
    assert_eq!(frame.notices, [Notice::SpeedOfLightRefused]);
    assert_eq!(frame.vehicle.light_speed(), LightSpeed::OLD_TOWN);
}

#[test]
fn any_bytes_from_any_device_make_a_finite_ride() {
    use rand::{RngExt, SeedableRng};
    let mut random = rand_chacha::ChaCha8Rng::seed_from_u64(11);
    for kind in [VehicleKind::Bicycle, VehicleKind::Drive, VehicleKind::Fly] {
        let mut simulation = simulation(kind);
        for n in 0..300u64 {
            let at = n * SECOND / 60;
            let samples: Vec<Sample> = (0..random.random_range(0..8))
                .map(|_| {
                    let source = input::SampleSource::ALL[random.random_range(0..input::SampleSource::ALL.len())];
                    let bytes: Vec<u8> = (0..random.random_range(0..40)).map(|_| random.random()).collect();
                    Sample::bytes(random.random_range(0..2 * at + 1), source, bytes)
                })
                .collect();
            let record = simulation.frame(at, &samples).record;
            let numbers = [record.ct, record.proper_time, record.rapidity, record.road, record.odometer];
            assert!(numbers.iter().chain(&record.position).chain(&record.orientation).all(|value| value.is_finite()));
        }
    }
}

/// Recording of the ride in memory.
pub(super) fn entries(setup: &Setup, samples: &[Sample]) -> Vec<RecordingEntry> {
    let mut simulation = Simulation::new(setup.clone(), Arc::new(OpenPlane)).unwrap();
    let mut entries = Vec::new();
    let mut left = samples;
    for at in times(9) {
        let due = left.iter().take_while(|sample| sample.at <= at).count();
        entries.extend(left[..due].iter().cloned().map(RecordingEntry::Sample));
        entries.push(RecordingEntry::Frame(simulation.frame(at, &left[..due]).record));
        left = &left[due..];
    }
    entries
}

fn verify(setup: &Setup, entries: Vec<RecordingEntry>) -> Result<u64, ReplayError> {
    let entries = entries.into_iter().map(Ok::<_, RecordingError>);
    Replay::of(entries, setup.clone(), Arc::new(OpenPlane)).unwrap().verify()
}

#[test]
fn a_replay_is_the_ride() {
    let setup = setup(VehicleKind::Bicycle);
    assert_eq!(verify(&setup, entries(&setup, &busy_ride())).unwrap(), 541);
}

/// Reports of a headset that is worn, at 90 Hz: a head that moves, a right hand that drives ahead from the third second
/// on, and a left hand whose stick is flicked.
fn worn_ride() -> Vec<Sample> {
    let report = |number: u64| {
        let time = number as f32 / 90.0;
        let head = XrPose {
            position_m: Some([0.3 * time.sin(), 1.6 + 0.02 * (7.0 * time).cos(), 0.2 * (2.0 * time).sin()]),
            orientation: Some([0.0, (0.2 * time).sin(), 0.0, (0.2 * time).cos()]),
            ..XrPose::default()
        };
        let mut hands = [XrHand { pose: head, ..XrHand::default() }; 2];
        hands[0].axes[0] = if number % 90 < 45 { 0.0 } else { [-1.0, 1.0, -0.8][(number / 90 % 3) as usize] };
        hands[1].axes[1] = if number > 270 { 0.6 } else { 0.0 };
        let report = XrReport { time_ns: (number * SECOND / 90) as i64, head, hands, stage_moves: 0 };
        Sample::bytes(number * SECOND / 90, SampleSource::Openxr, report.to_bytes())
    };
    let mut samples: Vec<Sample> = (0..9 * 90).map(report).collect();
    samples.insert(400, Sample::action(400 * SECOND / 90, &Action::SnapTurn(45.0)));
    samples.insert(600, Sample::action(599 * SECOND / 90, &Action::Stance(Stance::Standing)));
    samples
}

/// Settings of a ride in a headset.
fn worn(snap_turn_deg: f64) -> Setup {
    let wand = Some(WandConfig { sensor: 2, ..WandConfig::default() });
    let recentre = Recentring::Start;
    let head = HeadConfig { snap_turn_deg, wand, recentre, ..HeadConfig::new("openxr://".parse().unwrap()) };
    Setup { desk: DeskConfig { head: Some(head), ..Default::default() }, ..setup(VehicleKind::Drive) }
}

#[test]
fn turns_in_steps_and_stances_replay_to_the_bit_and_are_none_where_they_are_off() {
    let setup = worn(30.0);
    let samples = worn_ride();
    let ridden = frames(&mut Simulation::new(setup.clone(), Arc::new(OpenPlane)).unwrap(), &samples, times(9));
    let recorded = entries(&setup, &samples).into_iter().map(Ok);
    let mut replay = Replay::of(recorded, setup, Arc::new(OpenPlane)).unwrap();
    for before in &ridden {
        let Replayed { frame, difference } = replay.next_frame().unwrap().unwrap();
        assert_eq!(difference, None);
        assert_eq!(frame.controls, before.controls);
    }
    // Heading of the head, degrees to the left, less that of the same ride without turns.
    let off: Vec<Sample> = samples.iter().filter(|sample| sample.source == SampleSource::Openxr).cloned().collect();
    let plain = frames(&mut Simulation::new(worn(0.0), Arc::new(OpenPlane)).unwrap(), &off, times(9));
    let turned_deg = |second: f64| {
        let frame = (second * 60.0) as usize;
        let [turned, plain] = [&ridden, &plain].map(|frames| frames[frame].controls.head.unwrap().orientation);
        let nose = |turn: glam::DQuat| turn * DVec3::NEG_Z;
        let (sine, cosine) = (nose(plain).cross(nose(turned)).y, nose(plain).dot(nose(turned)));
        sine.atan2(cosine).to_degrees().round()
    };
    // To the left, to the right, to the left, each at half of its second; from 4.4 s on by 45°.
    let expected =
        [(0.3, 0.0), (0.8, 30.0), (1.3, 30.0), (1.8, 0.0), (2.8, 30.0), (3.8, 60.0), (4.8, 15.0), (5.8, 60.0)];
    for (second, expected) in expected {
        assert_eq!(turned_deg(second), expected, "{second} s");
    }
    // A flick moves nobody: the fastest head is as fast as without.
    let fastest = |frames: &[RideFrame]| {
        let speeds = frames.iter().filter_map(|frame| frame.controls.head).map(|head| head.velocity_m_s.length());
        speeds.fold(0.0, f64::max)
    };
    let [turned, plain] = [&ridden, &plain].map(|frames| fastest(&frames[..6 * 60]));
    assert!((turned / plain - 1.0).abs() < 1e-9, "{turned} m/s, {plain} m/s");
}

#[test]
fn the_last_bit_of_any_frame_shows_with_its_number() {
    let setup = setup(VehicleKind::Bicycle);
    let mut entries = entries(&setup, &busy_ride());
    let changed = entries
        .iter_mut()
        .find_map(|entry| match entry {
            RecordingEntry::Frame(record) if record.frame == 300 => Some(record),
            _ => None,
        })
        .unwrap();
    changed.celerity[2] = f64::from_bits(changed.celerity[2].to_bits() ^ 1);
    match verify(&setup, entries) {
        Err(ReplayError::Differs { frame: 300, difference }) => assert_eq!(difference.field, "celerity[2]"),
        other => panic!("{other:?}"),
    }
}

#[test]
fn another_byte_is_another_ride() {
    let setup = setup(VehicleKind::Bicycle);
    let recorded = entries(&setup, &busy_ride());
    let changed = recorded.into_iter().map(|entry| match entry {
        // The changed sample steers to the right instead of to the left.
        RecordingEntry::Sample(sample) if sample.at == 15 * SECOND / 10 => {
            RecordingEntry::Sample(Sample::key(sample.at, KeyboardKey::D, true))
        }
        other => other,
    });
    assert!(matches!(verify(&setup, changed.collect()), Err(ReplayError::Differs { frame: 90..93, .. })));
}

#[test]
fn a_ride_replays_from_its_file() {
    let directory = tempfile::tempdir().unwrap();
    let path = directory.path().join("ride.mcap");
    let setup = setup(VehicleKind::Bicycle);
    let mut simulation = Simulation::new(setup.clone(), Arc::new(OpenPlane)).unwrap();
    let mut recorder = Recorder::create(&path, &setup.header("0.1.0", "plane")).unwrap();
    let (ride, mut given) = (busy_ride(), 0);
    for at in times(9) {
        let due = ride[given..].iter().take_while(|sample| sample.at <= at).count();
        let samples = &ride[given..given + due];
        samples.iter().for_each(|sample| recorder.sample(sample).unwrap());
        let frame = simulation.frame(at, samples);
        recorder.controls(frame.record.frame, at, &frame.controls).unwrap();
        recorder.frame(&frame.record).unwrap();
        given += due;
    }
    recorder.finish().unwrap();

    let mut replay = Replay::new(Recording::open(&path).unwrap(), Arc::new(OpenPlane)).unwrap();
    assert_eq!(replay.verify().unwrap(), 541);

    // The recording is cut off: the remaining part is the same ride, and the end is reported.
    let bytes = std::fs::read(&path).unwrap();
    let data = bytes.windows(9).position(|record| record == [0x0f, 4, 0, 0, 0, 0, 0, 0, 0]).unwrap();
    std::fs::write(&path, &bytes[..data * 2 / 3]).unwrap();
    let verify = || Replay::new(Recording::open(&path).unwrap(), Arc::new(OpenPlane)).unwrap().verify();
    let told = match verify() {
        Err(error @ ReplayError::Partial { frames: 1..541, .. }) => error.to_string(),
        Err(error @ ReplayError::Recording { frames: 0, .. }) => error.to_string(),
        other => panic!("{other:?}"),
    };
    assert!(told.contains("ends too early"), "{told}");
    // Whole chunks before the cut are identical, and that is told.
    std::fs::write(&path, &bytes[..data]).unwrap();
    let told = verify().unwrap_err().to_string();
    assert!(told.starts_with("all 541 frames that can be read are identical to the bit, but"), "{told}");
}

#[test]
fn samples_in_falling_order_are_taken_in_the_order_of_their_times_and_soon() {
    let count = 300_000;
    // Keys that are pressed and released in turn, all within the first second.
    let mut samples: Vec<Sample> = (0..count)
        .map(|n| Sample::key(n * SECOND / count, if n % 6 < 3 { KeyboardKey::W } else { KeyboardKey::A }, n % 2 == 0))
        .collect();
    let ride = |samples: &[Sample]| {
        let mut simulation = simulation(VehicleKind::Bicycle);
        let first = simulation.frame(0, samples);
        let rest = times(2).map(|at| simulation.frame(at, &[]));
        records(&std::iter::once(first).chain(rest).collect::<Vec<_>>())
    };
    let rising = ride(&samples);
    samples.reverse();
    let started = std::time::Instant::now();
    assert_same(&rising, &ride(&samples));
    // A search among all that wait, for each sample, takes a minute.
    assert!(started.elapsed().as_secs() < 15, "{:?}", started.elapsed());
    assert!(rising.last().unwrap().rapidity > 0.0, "the keys did nothing");
}
