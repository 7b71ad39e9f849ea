//! A wheel of known speed must read that speed in each of the three formats, across wrapping counters and lost
//! lines; a broken line must change nothing but the count of faults.
use super::*;
use crate::clock::SECOND;
use crate::line::sealed;

/// Rounding of a few operations, m/s.
const ROUNDING: f64 = 1e-9;

fn bicycle() -> BicycleDecoder {
    BicycleDecoder::new(BicycleConfig::default())
}

fn feed(bicycle: &mut BicycleDecoder, at: Nanos, text: &str) {
    bicycle.bytes(at, text.as_bytes(), &mut Actions::default());
}

fn pulses(sequence: u32, now_us: u32, wheel: (u32, u32), crank: (u32, u32), steer: i32, brake: i32) -> String {
    sealed(&format!("B1,{sequence},{now_us},{},{},{},{},{steer},{brake}", wheel.0, wheel.1, crank.0, crank.1))
}

/// Bicycle after four seconds at four turns a second (8.4 m/s) and one of the crank, with a line every 20 ms. The
/// box's clock and counter begin at the given readings. Lines for which `lose` is true are lost.
fn ride(first_us: u32, first_count: u32, lose: impl Fn(u32) -> bool) -> BicycleDecoder {
    let mut bicycle = bicycle();
    for n in (0..=200_u32).filter(|&n| !lose(n)) {
        let elapsed_us = n * 20_000;
        let (turns, cranks) = (elapsed_us / 250_000, elapsed_us / 1_000_000);
        let wheel = (first_count.wrapping_add(turns), first_us.wrapping_add(turns * 250_000));
        let crank = (first_count.wrapping_add(cranks), first_us.wrapping_add(cranks * 1_000_000));
        let line = pulses(n, first_us.wrapping_add(elapsed_us), wheel, crank, 512, 0);
        feed(&mut bicycle, u64::from(elapsed_us) * 1000, &line);
    }
    assert_eq!(bicycle.faults().last(), None);
    bicycle
}

#[test]
fn a_known_speed_is_read() {
    let bicycle = ride(0, 0, |_| false);
    assert!((bicycle.wheel_speed(4 * SECOND).unwrap() - 8.4).abs() < ROUNDING);
    assert!((bicycle.cadence_hz(4 * SECOND).unwrap() - 1.0).abs() < ROUNDING);
    assert_eq!((bicycle.steer_rad(), bicycle.brake()), (0.0, 0.0));
}

#[test]
fn clock_and_counter_may_wrap() {
    let speed = ride(0, 0, |_| false).wheel_speed(4 * SECOND);
    assert_eq!(ride(u32::MAX - 1_900_000, u32::MAX - 5, |_| false).wheel_speed(4 * SECOND), speed);
}

#[test]
fn lost_lines_lose_nothing() {
    let bicycle = ride(7, 7, |n| n % 200 != 0 && (31 * n * n + 17 * n) % 10 < 7);
    assert!((bicycle.wheel_speed(4 * SECOND).unwrap() - 8.4).abs() < ROUNDING);
}

#[test]
fn silence_runs_down_and_stops() {
    let bicycle = ride(0, 0, |_| false);
    // A second without a pulse, of which a line may be late.
    assert!((bicycle.wheel_speed(5 * SECOND).unwrap() - 2.1 / 0.94).abs() < ROUNDING);
    assert_eq!(bicycle.wheel_speed(6 * SECOND + 1), Some(0.0));
    assert_eq!(bicycle.cadence_hz(6 * SECOND + 1), Some(0.0));
}

#[test]
fn a_contact_that_bounces_at_every_turn_reads_the_true_speed() {
    let mut bicycle = bicycle();
    for turn in 0..12_u32 {
        for (bounce, late_us) in [(0, 0), (1, 5000)] {
            let pulse_us = turn * 250_000 + late_us;
            let line = pulses(0, pulse_us, (2 * turn + bounce, pulse_us), (0, 0), 512, 0);
            feed(&mut bicycle, u64::from(pulse_us) * 1000, &line);
        }
    }
    let speed = bicycle.wheel_speed(11 * SECOND / 4).unwrap();
    assert!((speed - 8.4).abs() < ROUNDING, "{speed}");
}

#[test]
fn a_box_that_restarts_is_no_speed() {
    let mut bicycle = ride(0, 5000, |_| false);
    feed(&mut bicycle, 4 * SECOND, &pulses(0, 10, (0, 0), (0, 0), 512, 0));
    feed(&mut bicycle, 4 * SECOND + 1, &pulses(1, 20, (0, 0), (0, 0), 512, 0));
    assert_eq!(bicycle.wheel_speed(4 * SECOND + 1), Some(0.0));
    assert_eq!(bicycle.faults().number(), 0);
}

#[test]
fn handlebar_and_lever_are_scaled_and_bounded() {
    let mut bicycle = bicycle();
    feed(&mut bicycle, 0, &pulses(0, 0, (0, 0), (0, 0), 612, 1023));
    assert!((bicycle.steer_rad() + (100.0 * 270.0 / 1023.0_f64).to_radians()).abs() < ROUNDING);
    assert_eq!(bicycle.brake(), 1.0);
    feed(&mut bicycle, 0, &pulses(0, 0, (0, 0), (0, 0), i32::MIN, i32::MAX));
    assert_eq!(bicycle.steer_rad(), std::f64::consts::FRAC_PI_2);
    assert_eq!(bicycle.brake(), 1.0);
}

#[test]
fn four_fields_read_the_same_speed() {
    let mut bicycle = bicycle();
    // A line every 60 ms, each up to 8 ms late, for a wheel that turns four times a second.
    for n in 0..=66_u64 {
        let at_us = n * 60_000;
        let late_us = n * 7919 % 8000;
        let line = format!("250000,{},0.5,0.25\n", at_us % 250_000);
        feed(&mut bicycle, (at_us + late_us) * 1000, &line);
    }
    let speed = bicycle.wheel_speed(66 * 60_000_000).unwrap();
    assert!((speed - 8.4).abs() < ROUNDING, "{speed}");
    assert_eq!((bicycle.steer_rad(), bicycle.brake()), (-0.3, 0.25));
    assert_eq!(bicycle.wheel_speed(9 * SECOND), Some(0.0));
}

#[test]
fn an_interval_that_four_fields_repeat_counts_once() {
    let mut bicycle = bicycle();
    for pulse in 0..8_u64 {
        feed(&mut bicycle, pulse * SECOND / 4, "250000,0,0,0\n");
    }
    // One false pulse, repeated in five lines, each later. Counted once, it is an outlier.
    for line in 0..5_u64 {
        let age_us = line * 20_000;
        let at = 7 * SECOND / 4 + (100_000 + age_us + 1500 * line) * 1000;
        feed(&mut bicycle, at, &format!("100000,{age_us},0,0\n"));
        let speed = bicycle.wheel_speed(at).unwrap();
        assert!((speed - 8.4).abs() < ROUNDING, "{speed}");
    }
}

#[test]
fn a_bare_number_once_a_second_is_a_steady_speed() {
    for gap in [2 * SECOND, SECOND, SECOND / 4] {
        let mut bicycle = bicycle();
        for n in 0..20 {
            feed(&mut bicycle, n * gap, "36\r\n");
            for look in 0..100 {
                let speed = bicycle.wheel_speed(n * gap + look * gap / 100).unwrap();
                assert!((speed - 10.0).abs() < 0.1, "{speed} after number {n}");
            }
        }
        assert_eq!(bicycle.wheel_speed(25 * gap + 4 * SECOND), Some(0.0));
    }
}

#[test]
fn a_bare_number_of_an_old_recording_is_a_speed_that_fades() {
    let mut bicycle = BicycleDecoder::new(BicycleConfig { bare_number_glides: false, ..Default::default() });
    assert_eq!(bicycle.wheel_speed(0), None);
    feed(&mut bicycle, SECOND, "36\r\n");
    assert_eq!(bicycle.wheel_speed(SECOND), Some(10.0));
    assert_eq!(bicycle.wheel_speed(3 * SECOND / 2), Some(10.0));
    assert!((bicycle.wheel_speed(9 * SECOND / 4).unwrap() - 5.0).abs() < ROUNDING);
    assert_eq!(bicycle.wheel_speed(3 * SECOND), Some(0.0));
}

#[test]
fn noise_among_bare_numbers_is_counted_and_is_no_speed() {
    let mut bicycle = bicycle();
    for n in 0..40_u64 {
        let at = n * SECOND / 20;
        feed(&mut bicycle, at, "18\n");
        // Digits by chance, of a speed that could be ridden, and others.
        feed(&mut bicycle, at, ["9\n", "~x\n", "77\n", "1,2\n", "3\n"][n as usize % 5]);
        assert_eq!(bicycle.wheel_speed(at), Some(5.0), "after line {n}");
    }
    assert_eq!(bicycle.faults().number(), 40);
    assert!(bicycle.faults().last().is_some_and(|last| last.contains("a rider reaches")));
}

#[test]
fn a_bare_number_may_be_turns_a_minute() {
    let config = BicycleConfig { bare_number: BareNumber::WheelTurnsPerMinute, ..Default::default() };
    let mut bicycle = BicycleDecoder::new(config);
    feed(&mut bicycle, 0, "120\n");
    assert_eq!(bicycle.wheel_speed(0), Some(4.2));
}

#[test]
fn bad_lines_are_counted_and_leave_no_trace() {
    let bad = [
        "B1,1,2,3,4,5,6,7,8\n".to_owned(),
        "B1,1,2,3,4,5,6,7,8*00\n".to_owned(),
        sealed("B1,1,2,3,4,5,6,7"),
        sealed("B1,1,2,3,4,5,6,7,8,9"),
        sealed("B1,1,2,-3,4,5,6,7,8"),
        sealed("B1,1,2,3,4294967296,5,6,7,8"),
        sealed("B1,1,2,3,4,5,6,nan,8"),
        "1,2,3\n".to_owned(),
        "1,2,inf,0\n".to_owned(),
        "1.5,2,0,0\n".to_owned(),
        "fast\n".to_owned(),
        "-5\n".to_owned(),
        "1e300\n".to_owned(),
        "NaN\n".to_owned(),
        "\u{fffd}\u{fffd}\n".to_owned(),
        format!("{}\n", "9".repeat(5000)),
    ];
    let mut bicycle = ride(0, 0, |_| false);
    let before = bicycle.wheel_speed(4 * SECOND);
    for (n, line) in (1..).zip(&bad) {
        feed(&mut bicycle, 4 * SECOND, line);
        assert_eq!(bicycle.faults().number(), n, "{line}");
        assert!(bicycle.faults().last().is_some());
        assert_eq!(bicycle.wheel_speed(4 * SECOND), before, "{line}");
    }
    assert_eq!((bicycle.steer_rad(), bicycle.brake()), (0.0, 0.0));
}

#[test]
fn unplugging_lets_go_of_everything() {
    let mut bicycle = ride(0, 0, |_| false);
    feed(&mut bicycle, 4 * SECOND, "B1,half a line");
    bicycle.reset(4 * SECOND);
    assert_eq!((bicycle.wheel_speed(4 * SECOND), bicycle.cadence_hz(4 * SECOND)), (None, None));
    feed(&mut bicycle, 4 * SECOND, "36\n");
    assert_eq!(bicycle.wheel_speed(4 * SECOND), Some(10.0));
    assert_eq!(bicycle.faults().number(), 0);
}

/// Bicycle of these settings after ten seconds of a box that counts the crank alone, once a second.
fn crank_only(config: BicycleConfig) -> BicycleDecoder {
    let mut bicycle = BicycleDecoder::new(config);
    for n in 0..=500_u32 {
        let elapsed_us = n * 20_000;
        let turns = elapsed_us / 1_000_000;
        let line = pulses(n, elapsed_us, (0, 0), (turns, turns * 1_000_000), 512, 0);
        feed(&mut bicycle, u64::from(elapsed_us) * 1000, &line);
    }
    bicycle
}

#[test]
fn the_pedals_alone_give_the_speed_where_the_set_up_says_so() {
    let cadence = BicycleConfig { speed_from: SpeedSource::Cadence, ..BicycleConfig::default() };
    let speed = crank_only(cadence.clone()).wheel_speed(10 * SECOND).unwrap();
    assert!((speed - 5.5).abs() < ROUNDING, "{speed}");
    let geared = BicycleConfig { metres_per_crank_turn: 3.0, pulses_per_crank_turn: 2.0, ..cadence.clone() };
    let speed = crank_only(geared).wheel_speed(10 * SECOND).unwrap();
    assert!((speed - 1.5).abs() < ROUNDING, "{speed}");
    // Pedals that rest let the bicycle stop; without the setting they drive nothing.
    assert_eq!(crank_only(cadence).wheel_speed(20 * SECOND), Some(0.0));
    assert_eq!(crank_only(BicycleConfig::default()).wheel_speed(10 * SECOND), Some(0.0));
}

#[test]
fn a_strange_converter_steers_and_brakes_by_its_set_up() {
    // 12 bits, growing to the left, 0.1 degrees for each unit; a brake lever that reads less when it is pulled.
    let config = BicycleConfig {
        steer_straight: 1900.0,
        steer_rad_per_unit: 0.1_f64.to_radians(),
        steer_dead_rad: 2_f64.to_radians(),
        brake_released: 3000.0,
        brake_full: 1000.0,
        brake_curve: 2.0,
        ..BicycleConfig::default()
    };
    for (steer, brake, degrees, braked) in
        [(1900, 3000, 0.0, 0.0), (1915, 3100, 0.0, 0.0), (2220, 2000, 30.0, 0.25), (1580, 900, -30.0, 1.0)]
    {
        let mut bicycle = BicycleDecoder::new(config.clone());
        feed(&mut bicycle, 0, &pulses(0, 0, (0, 0), (0, 0), steer, brake));
        let turned = bicycle.steer_rad().to_degrees();
        assert!((turned - degrees).abs() < 1e-9, "{turned} for {degrees}");
        assert!((bicycle.brake() - braked).abs() < 1e-12, "{} for {braked}", bicycle.brake());
    }
}

#[test]
fn a_header_from_before_cadence_and_curves_means_what_it_meant() {
    let mut header = serde_json::to_value(BicycleConfig::default()).unwrap();
    for key in ["speed_from", "metres_per_crank_turn", "steer_dead_rad", "brake_curve", "late_s"] {
        assert!(header.as_object_mut().unwrap().remove(key).is_some(), "{key}");
    }
    let old: BicycleConfig = serde_json::from_value(header).unwrap();
    assert_eq!(old.late_s, 0.0);
    let mut bicycle = BicycleDecoder::new(old);
    for (steer, brake) in [(513, 1), (500, 333), (200, 1000)] {
        feed(&mut bicycle, 0, &pulses(0, 0, (0, 0), (0, 0), steer, brake));
        let per_unit = -270.0_f64.to_radians() / 1023.0;
        assert_eq!(bicycle.steer_rad().to_bits(), ((f64::from(steer) - 512.0) * per_unit).to_bits());
        assert_eq!(bicycle.brake().to_bits(), (f64::from(brake) / 1023.0).to_bits());
    }
}
