//! Decoder of DTrack's datagrams: the poses of bodies, the wand's signals, and a list of all that is seen.

use super::bodies::{bodies, inertial_bodies};
use super::flysticks::{Flystick, flysticks, old_flysticks};
use super::wire::{DtrackError, DtrackStamp, lines, stamp, text};
use crate::clock::{Nanos, SECOND, seconds_between};
use crate::decoder::{Actions, Decoder};
use crate::faults::Faults;
use crate::head::config::HeadConfig;
use crate::head::heard::{HeardKind, HeardSensor, HeardSensors, enumerated};
use crate::head::tracked_pose::TrackedPose;
use crate::wand::signal::WandSignal;

/// Time in which a body may be out of sight before it is worth a sentence, and in which a first frame may come.
const PATIENCE: Nanos = 3 * SECOND;

/// Decoder of [`SampleSource::Dtrack`](crate::SampleSource::Dtrack): a datagram a sample.
#[derive(Debug, Default)]
pub struct DtrackDecoder {
    /// True if the head is an inertial body.
    inertial: bool,
    /// Number of the flystick that is the wand.
    flystick: Option<i32>,
    poses: Vec<TrackedPose>,
    wand_signals: Vec<WandSignal>,
    heard: HeardSensors,
    /// Time at which the socket was opened, and that of the first frame.
    opened_at: Option<Nanos>,
    first_frame_at: Option<Nanos>,
    faults: Faults,
}

impl DtrackDecoder {
    /// Decoder for this head, and its wand.
    pub fn of_head(config: &HeadConfig) -> Self {
        let flystick = config.wand.as_ref().map(|wand| wand.sensor);
        Self { inertial: config.inertial, flystick, ..Self::default() }
    }

    /// Poses of the datagram fed last: the bodies that were seen.
    pub fn take_poses(&mut self) -> Vec<TrackedPose> {
        std::mem::take(&mut self.poses)
    }

    /// Signals of the wand in the datagram fed last.
    pub fn take_wand_signals(&mut self) -> Vec<WandSignal> {
        std::mem::take(&mut self.wand_signals)
    }

    /// Bodies and flysticks that the controller has sent since the socket was opened.
    pub fn heard(&self) -> &[HeardSensor] {
        self.heard.sensors()
    }

    /// Sentence for a body or flystick that is not seen, naming those that are; `None` while all is well, and in the
    /// first seconds.
    pub fn advice(&self, at: Nanos, config: &HeadConfig) -> Option<String> {
        let is_late = |since: Nanos| at.saturating_sub(since) > PATIENCE;
        let Some(first_frame_at) = self.first_frame_at else {
            let none = "no frame of DTrack has come: is it measuring, and does it send to this machine and port?";
            return self.opened_at.filter(|opened_at| is_late(*opened_at)).map(|_| none.to_owned());
        };
        let kind = if config.inertial { HeardKind::InertialBody } else { HeardKind::Body };
        let wand = config.wand.as_ref().map(|wand| (HeardKind::Flystick, wand.sensor));
        let is_missing = |(kind, number): &(HeardKind, i32)| {
            let known = self.heard.sensors().iter().find(|heard| heard.is(*kind, "", *number));
            match known {
                // A flystick's buttons work out of sight.
                Some(heard) if *kind == HeardKind::Flystick => seconds_between(heard.last_at, at) > 3.0,
                Some(heard) => !heard.is_tracked(at) && is_late(heard.seen_at),
                None => is_late(first_frame_at),
            }
        };
        let missing = [(kind, config.sensor)].into_iter().chain(wand).filter(is_missing);
        let missing: Vec<String> = missing.map(|(kind, number)| kind.named("", number)).collect();
        if missing.is_empty() {
            return None;
        }
        let seen: Vec<String> =
            self.heard.sensors().iter().filter(|heard| heard.is_tracked(at)).map(HeardSensor::to_string).collect();
        let are = if missing.len() == 1 { "is" } else { "are" };
        let seen = match seen.len() {
            0 => "nothing is seen".to_owned(),
            1 => format!("{} is seen", seen[0]),
            _ => format!("{} are seen", enumerated(&seen)),
        };
        Some(format!("{} {are} not seen; {seen}", enumerated(&missing)))
    }

    /// Takes a frame. A line that cannot be read is skipped whole, and counted.
    fn datagram(&mut self, at: Nanos, bytes: &[u8]) -> Result<(), DtrackError> {
        let text = text(bytes)?;
        let stamp = stamp(text)?;
        for (line, kind, thing) in [("6d", HeardKind::Body, "body"), ("6di", HeardKind::InertialBody, "inertial body")]
        {
            let is_wanted = self.inertial == (kind == HeardKind::InertialBody);
            for line in lines(text, line) {
                let seen = if kind == HeardKind::Body { bodies(line) } else { inertial_bodies(line) };
                // A line that is bad says nothing good of those behind it.
                let Some(seen) = self.sound(seen) else { break };
                for body in seen {
                    let Some(pose) = self.sound(body.pose(at, stamp, thing)) else { continue };
                    hear(&mut self.heard, at, kind, body.number, Some(&pose));
                    if is_wanted {
                        self.poses.push(pose);
                    }
                }
            }
            self.heard.unseen_but_at(at, kind);
        }
        // A controller that sends the newer line means that one.
        let mut newer = lines(text, "6df2").map(flysticks).peekable();
        let seen: Vec<_> =
            if newer.peek().is_some() { newer.collect() } else { lines(text, "6df").map(old_flysticks).collect() };
        for seen in seen {
            for flystick in self.sound(seen).unwrap_or_default() {
                self.flystick(at, stamp, flystick);
            }
        }
        if text.starts_with("fr ") {
            self.first_frame_at.get_or_insert(at);
        }
        Ok(())
    }

    fn flystick(&mut self, at: Nanos, stamp: DtrackStamp, flystick: Flystick) {
        let pose = flystick.body.map(|body| body.pose(at, stamp, "flystick")).and_then(|pose| self.sound(pose));
        if let Some(heard) = hear(&mut self.heard, at, HeardKind::Flystick, flystick.number, pose.as_ref()) {
            heard.buttons = Some(flystick.buttons);
            heard.axes.clone_from(&flystick.axes);
        }
        if self.flystick == Some(flystick.number) {
            self.wand_signals.extend(pose.map(WandSignal::Pose));
            self.wand_signals.push(WandSignal::Buttons(flystick.buttons));
            self.wand_signals.push(WandSignal::Axes(flystick.axes));
        }
    }

    /// Value of a result; an error is counted.
    fn sound<T>(&mut self, result: Result<T, DtrackError>) -> Option<T> {
        result.map_err(|error| self.faults.count(error.to_string())).ok()
    }
}

/// Lists a body or flystick; without a pose it is not seen.
fn hear<'a>(
    heard: &'a mut HeardSensors,
    at: Nanos,
    kind: HeardKind,
    number: i32,
    pose: Option<&TrackedPose>,
) -> Option<&'a mut HeardSensor> {
    let heard = heard.report(at, kind, "", number)?;
    heard.see(at, pose.map(|pose| (pose.position_m, pose.orientation)));
    Some(heard)
}

impl Decoder for DtrackDecoder {
    fn reset(&mut self, at: Nanos) {
        self.heard.forget();
        (self.opened_at, self.first_frame_at) = (Some(at), None);
    }

    fn bytes(&mut self, at: Nanos, bytes: &[u8], _actions: &mut Actions) {
        if let Err(error) = self.datagram(at, bytes) {
            self.faults.count(error.to_string());
        }
    }

    fn faults(&self) -> &Faults {
        &self.faults
    }
}

#[cfg(test)]
mod tests {
    //! A frame as ART's controllers send it must give the poses that the stock VRPN server made of it; a transposed
    //! matrix would turn the head the other way. A line that cannot be read is skipped whole.
    use super::*;
    use crate::dtrack::wire::LONGEST_DATAGRAM;
    use crate::wand::config::WandConfig;
    use crate::wand::held_buttons::HeldButtons;
    use glam::{DQuat, DVec3};

    /// Frame that gave position 0.1 0.2 0.3 and quaternion 0 0 0.258819 0.965926 in the stock server.
    const FRAME: &str = concat!(
        "fr 21753\r\nts2 1795325065 643615 4200\r\n6dcal 2\r\n",
        "6d 1 [0 1.000][100.000 200.000 300.000 0.0 0.0 30.0]",
        "[0.866025 0.500000 0.000000 -0.500000 0.866025 0.000000 0.000000 0.000000 1.000000]\r\n",
        "6df2 0 0 \r\n3d 1 [1 1.000][210.730 -90.669 -108.554]\r\n",
    );
    /// Tolerance of six printed decimals.
    const PRINTED: f64 = 1e-6;

    fn decode(datagram: &[u8]) -> (Vec<TrackedPose>, u64) {
        let mut decoder = DtrackDecoder::default();
        decoder.bytes(7, datagram, &mut Actions::default());
        (decoder.take_poses(), decoder.faults().number())
    }

    #[test]
    fn a_frame_gives_what_the_stock_server_made_of_it() {
        let (poses, faults) = decode(FRAME.as_bytes());
        assert_eq!((poses.len(), faults), (1, 0));
        let pose = &poses[0];
        assert_eq!((pose.sensor, pose.at), (0, 7));
        assert_eq!((pose.measured_s, pose.latency_s), (Some(1_795_325_065.643_615), Some(0.0042)));
        assert_eq!(pose.position_m, DVec3::new(0.1, 0.2, 0.3));
        let expected = DQuat::from_xyzw(0.0, 0.0, 0.258_819, 0.965_926);
        assert!(pose.orientation.abs_diff_eq(expected, PRINTED), "{}", pose.orientation);
    }

    #[test]
    fn older_controllers_stamp_seconds_of_the_day_and_the_oldest_nothing() {
        let (poses, _) = decode(FRAME.replace("ts2 1795325065 643615 4200", "ts 39596.024831").as_bytes());
        assert_eq!((poses[0].measured_s, poses[0].latency_s), (Some(39_596.024_831), None));
        let (poses, faults) = decode(FRAME.replace("ts2 1795325065 643615 4200\r\n", "").as_bytes());
        assert_eq!((poses[0].measured_s, poses[0].latency_s, faults), (None, None, 0));
    }

    #[test]
    fn bodies_that_are_not_seen_are_not_given() {
        assert_eq!(decode(b"fr 1\r\n6dcal 2\r\n6d 0 \r\n"), (vec![], 0));
        assert_eq!(decode(b"fr 1\r\n6dcal 2\r\n"), (vec![], 0));
        assert_eq!(decode(FRAME.replace("[0 1.000]", "[0 -1.000]").as_bytes()), (vec![], 0));
    }

    #[test]
    fn several_bodies_come_in_their_order() {
        let (before, bodies) = FRAME.split_once("6d 1 ").unwrap();
        let (body, _) = bodies.split_once("\r\n").unwrap();
        let two = format!("{before}6d 2 {body} {}\r\n", body.replace("[0 1.000]", "[7 0.9]"));
        let sensors: Vec<i32> = decode(two.as_bytes()).0.iter().map(|pose| pose.sensor).collect();
        assert_eq!(sensors, [0, 7]);
    }

    #[test]
    fn of_a_frame_cut_anywhere_nothing_false_is_read() {
        let whole = decode(FRAME.as_bytes()).0;
        for length in 0..FRAME.len() {
            let (poses, _) = decode(&FRAME.as_bytes()[..length]);
            assert!(poses.is_empty() || poses == whole, "cut at {length}: {poses:?}");
        }
    }

    #[test]
    fn what_cannot_be_right_is_counted() {
        let bad = [
            ("6d 1 ", "6d 2 "),
            ("6d 1 ", "6d x "),
            ("[0 1.000]", "[0]"),
            ("[0 1.000]", ""),
            ("100.000", "nan"),
            ("100.000", "1e999"),
            ("0.866025 0.500000", "0.866025 0.700000"),
            ("0.000000 1.000000]", "0.000000 -1.000000]"),
            ("0.000000 1.000000]", "0.000000]"),
            ("1795325065", "-1"),
            ("fr 21753", "fr 2175\u{fc}"),
        ];
        for (good, bad) in bad {
            assert_eq!(decode(FRAME.replace(good, bad).as_bytes()), (vec![], 1), "{bad}");
        }
        assert_eq!(decode(&vec![b' '; LONGEST_DATAGRAM + 1]), (vec![], 1));
        assert_eq!(decode(&vec![b'['; LONGEST_DATAGRAM]), (vec![], 0));
        assert_eq!(decode(&[b"6d 9 ", &vec![b'['; 9000][..]].concat()), (vec![], 1));
    }

    const EYE: &str = "[1 0 0 0 1 0 0 0 1]";

    fn head(text: &str) -> HeadConfig {
        let config = HeadConfig::new("dtrack://".parse().unwrap());
        let wand = text
            .strip_prefix("wand ")
            .map(|number| WandConfig { sensor: number.parse().unwrap(), ..Default::default() });
        HeadConfig { wand, inertial: text == "inertial", ..config }
    }

    #[test]
    fn the_wand_is_the_flystick_of_its_number() {
        let mut decoder = DtrackDecoder::of_head(&head("wand 1"));
        let sticks =
            format!("6df2 2 2 [0 1.000 1 0][9 9 9]{EYE}[1][1 0.9 8 2][400 1000 -100]{EYE}[130 0.25 -1.00]\r\n");
        let old = format!("6df 2 [0 1.000 3][9 9 9 0 0 0]{EYE} [1 1.000 3][9 9 9 0 0 0]{EYE}\r\n");
        decoder.bytes(7, format!("fr 1\r\n{old}{sticks}").as_bytes(), &mut Actions::default());
        let signals = decoder.take_wand_signals();
        let [WandSignal::Pose(pose), buttons, axes] = &signals[..] else { panic!("{signals:?}") };
        assert_eq!((pose.sensor, pose.position_m), (1, DVec3::new(0.4, 1.0, -0.1)));
        assert_eq!((buttons, axes), (&WandSignal::Buttons(HeldButtons(130)), &WandSignal::Axes(vec![0.25, -1.0])));
        assert_eq!((decoder.take_poses(), decoder.faults().number()), (vec![], 0));
        // The older line counts where there is no newer one.
        decoder.bytes(8, old.as_bytes(), &mut Actions::default());
        assert_eq!(decoder.take_wand_signals()[1], WandSignal::Buttons(HeldButtons(3)));
        // Without sight there are buttons, and no pose.
        let unseen = sticks.replace("[1 0.9 8 2]", "[1 -1.000 8 2]").replace("130", "128");
        decoder.bytes(9, unseen.as_bytes(), &mut Actions::default());
        let signals = decoder.take_wand_signals();
        assert_eq!((signals.len(), &signals[0]), (2, &WandSignal::Buttons(HeldButtons(128))));
        let flystick = decoder.heard().iter().find(|heard| heard.to_string() == "flystick 1").unwrap();
        assert_eq!((flystick.tracked, flystick.count, flystick.buttons), (false, 3, Some(HeldButtons(128))));
    }

    /// As recordings were read from the first on.
    #[test]
    fn bodies_behind_a_bad_line_of_bodies_do_not_count() {
        let good = "6d 1 [0 1.000][1 2 3 0 0 0][1 0 0 0 1 0 0 0 1]";
        for bad in ["6d 2 [0 1.000][1 2 3 0 0 0][1 0 0 0 1 0 0 0 1]", &good.replace("6d 1 [", "6d 1[")] {
            assert_eq!(decode(format!("fr 1\r\n{bad}\r\n{good}\r\n").as_bytes()), (vec![], 1), "{bad}");
        }
    }

    #[test]
    fn a_bad_line_harms_no_other() {
        let mut decoder = DtrackDecoder::default();
        decoder.bytes(
            0,
            FRAME.replace("6df2 0 0 ", "6df2 1 1 [0 1.0 999999999 2]").as_bytes(),
            &mut Actions::default(),
        );
        assert_eq!(decoder.take_poses().len(), 1);
        assert!(decoder.faults().last().unwrap().starts_with("a `6df2` line: expected two numbers"));
        decoder.bytes(0, FRAME.replace("0.866025 0.500000", "0.866025 0.700000").as_bytes(), &mut Actions::default());
        let expected = (2, Some("body 0: its matrix is no rotation"));
        assert_eq!((decoder.faults().number(), decoder.faults().last()), expected);
    }

    #[test]
    fn an_inertial_body_is_a_head_where_it_is_asked_for() {
        let line = format!("6di 3 [0 0 0.000][0 0 0]{EYE} [1 1 2.500][100 200 300]{EYE}[2 3 0.000][7 7 7]{EYE}\r\n");
        let frame = FRAME.replace("6df2 0 0 \r\n", &line);
        for (text, sensors) in [("optical", vec![0]), ("inertial", vec![1, 2])] {
            let mut decoder = DtrackDecoder::of_head(&head(text));
            decoder.bytes(0, frame.as_bytes(), &mut Actions::default());
            let poses = decoder.take_poses();
            assert_eq!(poses.iter().map(|pose| pose.sensor).collect::<Vec<_>>(), sensors);
            assert!(poses[0].position_m == DVec3::new(0.1, 0.2, 0.3) && poses[0].latency_s == Some(0.0042));
            let names: Vec<String> = decoder.heard().iter().map(HeardSensor::to_string).collect();
            assert_eq!(
                (names, decoder.faults().number()),
                (vec!["body 0".into(), "inertial body 1".into(), "inertial body 2".into()], 0)
            );
        }
        for bad in
            [line.replace("6di 3", "6di 2"), line.replace("[1 1 2.500]", "[1 1]"), line.replace("[7 7 7]", "[7 7]")]
        {
            let (poses, faults) = decode(FRAME.replace("6df2 0 0 \r\n", &bad).as_bytes());
            assert_eq!((poses.len(), faults), (1, 1), "{bad}");
        }
    }

    #[test]
    fn what_is_not_seen_is_told_with_what_is() {
        let (mut decoder, mut actions) = (DtrackDecoder::default(), Actions::default());
        let wanted = |sensor| HeadConfig { sensor, ..head("wand 1") };
        decoder.reset(SECOND);
        assert_eq!(decoder.advice(3 * SECOND, &wanted(0)), None);
        let told = decoder.advice(5 * SECOND, &wanted(0)).unwrap();
        assert!(told.starts_with("no frame of DTrack has come"), "{told}");
        let frame = FRAME.replace("6df2 0 0 ", &format!("6df2 2 1 [1 1.000 1 0][9 9 9]{EYE}[1]"));
        for second in 5..20 {
            decoder.bytes(second * SECOND, frame.as_bytes(), &mut actions);
        }
        assert_eq!(decoder.advice(19 * SECOND, &wanted(0)), None);
        let told = decoder.advice(19 * SECOND, &wanted(3)).unwrap();
        assert_eq!(told, "body 3 is not seen; body 0 and flystick 1 are seen");
        // The cameras lose the body, and the radio the flystick.
        for second in 20..30 {
            decoder.bytes(second * SECOND, b"fr 2\r\n6dcal 1\r\n6d 0 \r\n", &mut actions);
        }
        let told = decoder.advice(29 * SECOND, &wanted(0)).unwrap();
        assert_eq!(told, "body 0 and flystick 1 are not seen; nothing is seen");
        assert_eq!(decoder.faults().number(), 0);
    }

    #[test]
    fn of_a_frame_with_any_byte_changed_nothing_impossible_is_read() {
        let sticks =
            format!("6df2 1 1 [1 0.9 8 2][400 1000 -100]{EYE}[130 0.25 -1.00]\r\n6di 1 [1 1 2.5][1 2 3]{EYE}\r\n");
        let frame = FRAME.replace("6df2 0 0 \r\n", &sticks);
        for at in 0..frame.len() {
            for byte in [b'-', b'9', b'[', b']', b' ', b'e', b'\n', 0, 0xff] {
                let mut decoder = DtrackDecoder::of_head(&head("wand 1"));
                let mut bytes = frame.clone().into_bytes();
                bytes[at] = byte;
                decoder.bytes(0, &bytes, &mut Actions::default());
                assert!(decoder.take_poses().iter().all(|pose| pose.position_m.is_finite()), "{byte} at {at}");
                let signals = decoder.take_wand_signals();
                let finite = |signal: &WandSignal| match signal {
                    WandSignal::Axes(axes) => axes.iter().all(|axis| axis.is_finite()),
                    _ => true,
                };
                assert!(signals.len() <= 3 && signals.iter().all(finite), "{byte} at {at}: {signals:?}");
            }
        }
    }
}
