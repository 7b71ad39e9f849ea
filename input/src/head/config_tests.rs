//! Each key of a table must be read as documented; a table that cannot be used must be reported with key and
//! reason.
use super::*;
use crate::head::rigid::Rigid;
use glam::DQuat;

fn parse(text: &str) -> Result<HeadConfig, String> {
    let config: HeadConfig = toml::from_str(text).map_err(|error| error.to_string())?;
    config.check().map_err(|error| error.to_string()).map(|()| config)
}

#[test]
fn a_url_is_enough() {
    let config = parse("url = \"dtrack://:5000\"").unwrap();
    // The header of a ride without wand has no word of one.
    let header = serde_json::to_value(&config).unwrap();
    assert!(header.get("wand").is_none() && header.get("inertial").is_none());
    // Recordings without an edition are of the first; a display's table gets the present one.
    assert_eq!(config, HeadConfig { edition: 1, ..HeadConfig::new("dtrack://:5000".parse().unwrap()) });
    assert_eq!(config.velocity, VelocityFilter::Mean { frames: 4 });
    assert_eq!(config.room_from_tracker.rigid(), Rigid::IDENTITY);
}

#[test]
fn every_key_is_read() {
    let config = parse(
        r#"
        url = "vrpn://tracker/Head"
        sensor = 3
        room_from_tracker = { position = [1, 2.5, -3], yaw = 90, pitch = 10, roll = -5 }
        head_from_sensor = { quaternion = [0, 1, 0, 0] }
        mode = "position"
        velocity = { filter = "least-squares", window_s = 0.1 }
        fade_s = 0.5
        home = [0, 1.2, 0.4]
        scale = "cm"
        flip = ["z"]
        recentre = "start"
        [wand]
        sensor = 1
        buttons = "Wand"
        axes = "Stick"
        wand_from_sensor = { pitch = 15 }
        stick = [1, 0]
        trigger = 2
        "#,
    )
    .unwrap();
    assert_eq!((config.scale.unwrap().metres(), config.flip.as_slice()), (0.01, &[FlipAxis::Z][..]));
    assert_eq!(config.recentre, Recentring::Start);
    assert_eq!((config.sensor, config.mode, config.fade_s), (3, TrackingMode::Position, 0.5));
    assert_eq!(config.room_from_tracker.position, [1.0, 2.5, -3.0]);
    assert_eq!(config.head_from_sensor.rigid().orientation, DQuat::from_xyzw(0.0, 1.0, 0.0, 0.0));
    assert_eq!(config.velocity, VelocityFilter::LeastSquares { window_s: 0.1 });
    assert_eq!(config.wand_devices(), ["Wand", "Stick"]);
    let wand = config.wand.as_ref().unwrap();
    assert_eq!((wand.sensor, wand.stick.0, wand.trigger, wand.wand_from_sensor.pitch), (1, [1, 0], Some(2), 15.0));
    // The settings survive the recording's header.
    let json = serde_json::to_string(&config).unwrap();
    assert_eq!(serde_json::from_str::<HeadConfig>(&json).unwrap(), config);
    assert_eq!(parse(&toml::to_string(&config).unwrap()), Ok(config));
}

#[test]
fn filters_have_their_names() {
    for (text, filter) in [
        ("filter = \"mean\"", VelocityFilter::Mean { frames: 4 }),
        ("filter = \"mean\", frames = 8", VelocityFilter::Mean { frames: 8 }),
        ("filter = \"least-squares\"", VelocityFilter::least_squares()),
        ("filter = \"one-euro\"", VelocityFilter::one_euro()),
        ("filter = \"off\"", VelocityFilter::Off),
    ] {
        let config = parse(&format!("url = \"mouse\"\nvelocity = {{ {text} }}")).unwrap();
        assert_eq!(config.velocity, filter);
    }
}

#[test]
fn what_cannot_be_used_is_told_by_key_and_reason() {
    for (text, expected) in [
        ("", "missing field `url`"),
        ("url = \"vrpn://tracker\"", "names no device"),
        ("url = \"mouse\"\nsensors = 1", "unknown field `sensors`"),
        ("url = \"mouse\"\nmode = \"velocity\"", "unknown variant `velocity`"),
        ("url = \"mouse\"\nvelocity = { filter = \"kalman\" }", "unknown variant `kalman`"),
        ("url = \"mouse\"\nvelocity = { filter = \"mean\", n = 3 }", "unknown field `n`"),
        ("url = \"mouse\"\nvelocity = { filter = \"mean\", frames = 0 }", "tracker.velocity.frames is 0"),
        ("url = \"mouse\"\nvelocity = { filter = \"least-squares\", window_s = 0 }", "tracker.velocity.window_s is 0"),
        ("url = \"mouse\"\nvelocity = { filter = \"one-euro\", minimum_cutoff_hz = nan }", "minimum_cutoff_hz is NaN"),
        ("url = \"mouse\"\nfade_s = -1", "tracker.fade_s is -1"),
        ("url = \"mouse\"\nhome = [0, inf, 0]", "tracker.home is [0.0, inf, 0.0]"),
        ("url = \"mouse\"\nscale = \"mile\"", "scale is \"mile\": expected the length of the tracker's unit"),
        ("url = \"mouse\"\nscale = 0.0", "scale is 0: expected"),
        ("url = \"mouse\"\nscale = \"mm\"", "nothing with url = \"mouse\""),
        ("url = \"dtrack://\"\nflip = [\"w\"]", "unknown variant `w`"),
        ("url = \"dtrack://\"\nflip = [\"x\", \"x\"]", "each direction at most once"),
        ("url = \"dtrack://\"\nflip = [\"yaw\"]", "only with url = \"opentrack://\""),
        ("url = \"mouse\"\nroom_from_tracker = { position = [0, 0, 1] }", "nothing with url = \"mouse\""),
        ("url = \"mouse\"\n[wand]", "no wand but with a VRPN server, DTrack or OpenXR"),
        ("url = \"openxr://\"\n[wand]", "2, the right one"),
        ("url = \"openxr://\"\n[wand]\nsensor = 2\nbuttons = \"Wand\"", "elsewhere wands have numbers"),
        ("url = \"vrpn://x/Head\"\ninertial = true", "nothing but with DTrack"),
        ("url = \"vrpn://x/Head\"\n[wand]\nbutton = \"Wand\"", "unknown field `button`"),
        ("url = \"vrpn://x/Head\"\n[wand]\nbuttons = \"\"", "tracker.wand.buttons is \"\""),
        ("url = \"vrpn://x/Head\"\n[wand]\nstick = [0, 128]", "tracker.wand.stick is [0, 128]"),
        ("url = \"dtrack://\"\n[wand]\ndevice = \"Wand\"", "elsewhere wands have numbers"),
        ("url = \"dtrack://\"\n[wand]\nwand_from_sensor = { yaw = 1e3 }", "tracker.wand.wand_from_sensor.yaw"),
        ("url = \"dtrack://\"\nroom_from_tracker = { yaw = 1e3 }", "tracker.room_from_tracker.yaw is 1000"),
        ("url = \"dtrack://\"\nhead_from_sensor = { position = [2000, 0, 0] }", "tracker.head_from_sensor.position"),
        ("url = \"dtrack://\"\nhead_from_sensor = { quaternion = [0, 0, 0, 0] }", "length 1"),
        ("url = \"dtrack://\"\nhead_from_sensor = { quaternion = [0, 0, 0, nan] }", "length 1"),
        ("url = \"dtrack://\"\nhead_from_sensor = { quaternion = [0, 0, 0, 1], yaw = 3 }", "not both"),
    ] {
        let error = parse(text).unwrap_err();
        assert!(error.contains(expected), "{text}: {error}");
    }
}
