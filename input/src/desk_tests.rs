//! Devices used together must add up to one rider; a device that goes must release what it held.
use super::*;
use crate::clock::SECOND;
use crate::gamepad::GamepadItem;
use crate::head::config::{HeadConfig, Recentring};
use crate::head::mouse_event::{MouseButton, MouseEvent};
use crate::key::KeyboardKey;
use crate::openxr::{XrHand, XrPose, XrReport};
use crate::wand::config::WandConfig;

fn desk() -> Desk {
    Desk::new(DeskConfig::default()).unwrap()
}

fn push_right(at: Nanos) -> Sample {
    Sample::bytes(at, SampleSource::SpaceMouse, [1, 0x5e, 1, 0, 0, 0, 0])
}

#[test]
fn nobody_wants_nothing() {
    let controls = desk().controls(SECOND);
    assert_eq!(controls.wheel_speed, None);
    assert_eq!((controls.steer_rad, controls.brake), (0.0, 0.0));
    assert_eq!((controls.thrust, controls.turn), ([0.0; 3], [0.0; 3]));
}

#[test]
fn deflections_add_up_and_stay_in_range() {
    let mut desk = desk();
    desk.feed(&Sample::key(0, KeyboardKey::A, true));
    desk.feed(&push_right(SECOND));
    assert_eq!(desk.controls(SECOND).thrust[0], 0.0);
    desk.feed(&Sample::key(SECOND, KeyboardKey::A, false));
    desk.feed(&Sample::key(SECOND, KeyboardKey::D, true));
    desk.feed(&push_right(3 * SECOND));
    assert_eq!(desk.controls(3 * SECOND).thrust[0], 1.0);
}

#[test]
fn a_trainer_pedals_and_its_crank_counts_where_no_other_sensor_does() {
    use crate::trainer::wire::{DirectConnectMessage, INDOOR_BIKE_DATA, NOTIFICATION, uuid};
    let mut desk = desk();
    // 36 km/h and 90 turns a minute.
    let data = [&uuid(INDOOR_BIKE_DATA)[..], &[4, 0, 0x10, 0x0e, 180, 0]].concat();
    let message = DirectConnectMessage { kind: NOTIFICATION, sequence: 0, response: 0, data: &data };
    desk.feed(&Sample::bytes(SECOND, SampleSource::Trainer, message.to_bytes()));
    desk.feed(&Sample::bytes(SECOND, SampleSource::Bicycle, *b"18\n"));
    let controls = desk.controls(SECOND);
    assert!((controls.wheel_speed.unwrap() - 10.0).abs() < 1e-9);
    assert_eq!(controls.cadence_hz, Some(1.5));
    // It has no handlebar: whoever steers by keys is still helped.
    desk.feed(&Sample::closed(SECOND, SampleSource::Bicycle));
    assert!(!desk.is_steered_by_hand());
    desk.feed(&Sample::closed(SECOND, SampleSource::Trainer));
    assert_eq!(desk.controls(SECOND).wheel_speed, None);
}

#[test]
fn the_faster_wheel_counts() {
    let mut desk = desk();
    desk.feed(&Sample::key(0, KeyboardKey::W, true));
    desk.feed(&Sample::bytes(SECOND, SampleSource::Bicycle, *b"3.6\n"));
    assert_eq!(desk.controls(SECOND).wheel_speed, Some(2.0));
    desk.feed(&Sample::bytes(SECOND, SampleSource::Bicycle, *b"36\n36\n36\n"));
    assert_eq!(desk.controls(SECOND).wheel_speed, Some(10.0));
    desk.feed(&Sample::closed(SECOND, SampleSource::Bicycle));
    assert_eq!(desk.controls(SECOND).wheel_speed, Some(2.0));
}

#[test]
fn a_fast_rider_steers_no_further_than_he_leans() {
    let mut desk = desk();
    desk.feed(&Sample::key(0, KeyboardKey::Left, true));
    assert_eq!(desk.controls(SECOND).steer_rad, 0.6);
    desk.feed(&Sample::bytes(SECOND, SampleSource::Bicycle, *b"36\n"));
    let controls = desk.controls(SECOND);
    // v² tan δ / L is the lateral acceleration.
    let lateral = libm::pow(controls.wheel_speed.unwrap(), 2.0) * libm::tan(controls.steer_rad) / 1.1;
    assert!((lateral - 5.0).abs() < 1e-12, "{lateral}");
}

#[test]
fn keys_mouse_and_stick_turn_one_look_and_nothing_else() {
    let mut desk = desk();
    let still = desk.controls(0);
    desk.feed(&Sample::key(0, KeyboardKey::J, true));
    desk.feed(&Sample::key(SECOND, KeyboardKey::J, false));
    desk.feed(&Sample::mouse(SECOND, MouseEvent::Button { button: MouseButton::Left, pressed: true }));
    desk.feed(&Sample::mouse(SECOND, MouseEvent::Moved { right: 200.0, down: 0.0 }));
    let look = desk.controls(2 * SECOND);
    assert!((look.look.yaw_rad - 60_f64.to_radians()).abs() < 1e-12, "{:?}", look.look);
    assert_eq!(Controls { look: still.look, ..look }, still);
    for action in [Action::LookAhead, Action::Restart] {
        desk.feed(&Sample::mouse(2 * SECOND, MouseEvent::Moved { right: 200.0, down: 10.0 }));
        desk.feed(&Sample::action(3 * SECOND, &action));
        assert!(!desk.controls(3 * SECOND).look.is_ahead());
        assert!(desk.controls(4 * SECOND).look.is_ahead());
    }
}

#[test]
fn the_second_stick_looks_from_a_bicycle_and_turns_the_nose_of_others() {
    let mut desk = desk();
    let mut bytes = Vec::new();
    let axis = GamepadItem::Axis { code: 3, value: -100, least: -100, most: 100 };
    [GamepadItem::Gamepad, axis].iter().for_each(|item| item.encode(&mut bytes));
    desk.feed(&Sample::bytes(0, SampleSource::Gamepad, bytes));
    assert_eq!(desk.controls(0).look.yaw_rad, std::f64::consts::PI);
    desk.ride(VehicleKind::Fly);
    let flying = desk.controls(0);
    assert_eq!((flying.look.is_ahead(), flying.turn[1]), (true, 1.0));
}

#[test]
fn recordings_made_before_have_no_look_and_a_tracked_head_decides_itself() {
    let mouse = HeadConfig::new(TrackerUrl::Mouse);
    for config in [
        DeskConfig { free_look: false, ..DeskConfig::default() },
        DeskConfig { head: Some(mouse), ..DeskConfig::default() },
    ] {
        let mut desk = Desk::new(config).unwrap();
        desk.feed(&Sample::key(0, KeyboardKey::J, true));
        assert!(desk.controls(SECOND).look.is_ahead());
    }
    let header = serde_json::to_value(DeskConfig::default()).unwrap();
    let mut old = header.clone();
    old.as_object_mut().unwrap().remove("free_look");
    assert_eq!(serde_json::from_value::<DeskConfig>(header).unwrap(), DeskConfig::default());
    assert!(!serde_json::from_value::<DeskConfig>(old).unwrap().free_look);
}

#[test]
fn the_device_that_was_moved_last_steers_and_a_bicycle_always_does() {
    let mut desk = desk();
    let key = Sample::key(0, KeyboardKey::W, true);
    desk.feed(&key);
    assert!(!desk.is_steered_by_hand());
    desk.feed(&push_right(1));
    assert!(desk.is_steered_by_hand());
    desk.feed(&key);
    assert!(!desk.is_steered_by_hand());
    desk.feed(&Sample::bytes(2, SampleSource::Bicycle, *b"3.6\n"));
    desk.feed(&key);
    assert!(desk.is_steered_by_hand());
    desk.feed(&Sample::closed(3, SampleSource::Bicycle));
    assert!(!desk.is_steered_by_hand());
}

#[test]
fn a_bicycle_without_a_handlebar_leaves_the_steering_to_others() {
    let mut config = DeskConfig::default();
    config.bicycle.handlebar = false;
    let mut desk = Desk::new(config).unwrap();
    // The box sends 0 where there is no sensor, which would be full lock.
    let line = crate::line::sealed("B1,0,0,0,0,0,0,0,0");
    desk.feed(&Sample::bytes(0, SampleSource::Bicycle, line.into_bytes()));
    assert!(!desk.is_steered_by_hand());
    assert_eq!(desk.controls(0).steer_rad, 0.0);
    desk.feed(&Sample::key(0, KeyboardKey::Left, true));
    assert!(!desk.is_steered_by_hand());
    assert_eq!(desk.controls(SECOND).steer_rad, 0.6);
}

#[test]
fn actions_of_all_devices_come_once_and_in_order() {
    let mut desk = desk();
    desk.feed(&Sample::key(0, KeyboardKey::Three, true));
    desk.feed(&Sample::action(1, &Action::TimeScale(0.25)));
    desk.feed(&Sample::bytes(2, SampleSource::SpaceMouse, [3, 1]));
    let expected = [Action::Vehicle(VehicleKind::Fly), Action::TimeScale(0.25), Action::TogglePause];
    assert_eq!(desk.controls(3).actions, expected);
    assert_eq!(desk.controls(3).actions, []);
}

#[test]
fn a_device_that_goes_lets_go() {
    for source in SampleSource::ALL {
        let mut desk = desk();
        desk.feed(&Sample::key(0, KeyboardKey::Q, true));
        desk.feed(&push_right(SECOND));
        let (before, closed) = (desk.controls(SECOND), Sample::closed(SECOND, source));
        desk.feed(&closed);
        let after = desk.controls(SECOND + SECOND / 2);
        assert_eq!(after.thrust != before.thrust, source == SampleSource::SpaceMouse, "{source}");
        assert_eq!(after.turn != before.turn, source == SampleSource::Keyboard, "{source}");
    }
}

#[test]
fn a_headset_whose_runtime_recentres_is_in_its_seat_and_its_wand_with_it() {
    let wand = Some(WandConfig { sensor: 2, ..WandConfig::default() });
    let head = HeadConfig { wand, recentre: Recentring::Start, ..HeadConfig::new("openxr://".parse().unwrap()) };
    let home = DVec3::from_array(head.home);
    let mut desk = Desk::new(DeskConfig { head: Some(head), ..DeskConfig::default() }).unwrap();
    // The hand is half a metre ahead of the head; the stage is moved by what a head could move, and by more.
    for (number, place, stage_moves) in [(0, 1.0, 0), (1, 1.0, 0), (2, 1.125, 1), (3, -4.0, 2)] {
        let at = |z: f32| XrPose {
            position_m: Some([place, 1.5, z]),
            orientation: Some([0.0, 0.0, 0.0, 1.0]),
            ..XrPose::default()
        };
        let right = XrHand { pose: at(1.5), ..XrHand::default() };
        let hands = [XrHand::default(), right];
        let report = XrReport { time_ns: number * 50_000_000, head: at(2.0), hands, stage_moves };
        let now = number as Nanos * SECOND / 20;
        desk.feed(&Sample::bytes(now, SampleSource::Openxr, report.to_bytes()));
        let controls = desk.controls(now);
        let (head, wand) = (controls.head.unwrap(), controls.wand.unwrap());
        assert_eq!((head.position_m, head.velocity_m_s), (home, DVec3::ZERO), "{number}");
        assert!((wand.position_m - home - DVec3::NEG_Z * 0.5).length() < 1e-12, "{number}: {wand:?}");
    }
}

#[test]
fn a_setting_that_cannot_be_used_is_refused_at_the_door() {
    let mut config = DeskConfig::default();
    config.bicycle.stop_after_s = 0.0;
    assert_eq!(Desk::new(config).unwrap_err().key, "bicycle.stop_after_s");
}
