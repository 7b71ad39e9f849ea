//! Decoder of the reports on a headset: the head's pose, and the signals of the hand that is the wand.

use glam::{DQuat, DVec3};

use super::report::{RIGHT_HAND, XrPose, XrReport};
use crate::clock::Nanos;
use crate::decoder::{Actions, Decoder};
use crate::faults::Faults;
use crate::head::config::HeadConfig;
use crate::head::heard::{HeardKind, HeardSensor, HeardSensors};
use crate::head::tracked_pose::TrackedPose;
use crate::wand::held_buttons::HeldButtons;
use crate::wand::signal::WandSignal;
use crate::wand::stick_flick::StickFlick;

/// Decoder of [`SampleSource::Openxr`](crate::SampleSource::Openxr): a report a sample.
#[derive(Debug, Default)]
pub struct OpenxrDecoder {
    /// Number of the hand that is the wand.
    wand: Option<i32>,
    /// Number of moves of the runtime's stage in the report fed last; `None` before the first.
    stage_moves: Option<u8>,
    /// True if the stage has moved before the poses.
    moved: bool,
    poses: Vec<TrackedPose>,
    wand_signals: Vec<WandSignal>,
    flick: StickFlick,
    /// Flicks of the other hand's stick: those to the left less those to the right.
    flicks: i32,
    heard: HeardSensors,
    faults: Faults,
}

impl OpenxrDecoder {
    /// Decoder for this head, and its wand.
    pub fn of_head(config: &HeadConfig) -> Self {
        Self { wand: config.wand.as_ref().map(|wand| wand.sensor), ..Self::default() }
    }

    /// Poses of the report fed last: those of head and hands that are known.
    pub fn take_poses(&mut self) -> Vec<TrackedPose> {
        std::mem::take(&mut self.poses)
    }

    /// True if the runtime's stage has moved since the poses before. They are then in other axes.
    pub fn take_moved(&mut self) -> bool {
        std::mem::take(&mut self.moved)
    }

    /// Signals of the wand in the report fed last.
    pub fn take_wand_signals(&mut self) -> Vec<WandSignal> {
        std::mem::take(&mut self.wand_signals)
    }

    /// Flicks of the stick of the hand that is not the wand, in the report fed last: those to the left less those to
    /// the right.
    pub fn take_flicks(&mut self) -> i32 {
        std::mem::take(&mut self.flicks)
    }

    /// Head and hands that have been heard of since the runtime was reached.
    pub fn heard(&self) -> &[HeardSensor] {
        self.heard.sensors()
    }

    fn report(&mut self, at: Nanos, report: &XrReport) {
        self.moved |= self.stage_moves.replace(report.stage_moves).is_some_and(|before| before != report.stage_moves);
        let [left, right] = &report.hands;
        for (sensor, pose, hand) in
            [(0, &report.head, None), (1, &left.pose, Some(left)), (2, &right.pose, Some(right))]
        {
            let pose = pose_of(at, report.time_ns, sensor, pose);
            let Some(heard) = self.heard.report(at, HeardKind::Sensor, "openxr", sensor) else { continue };
            heard.see(at, pose.map(|pose| (pose.position_m, pose.orientation)));
            if let Some(hand) = hand {
                heard.buttons = Some(HeldButtons(hand.buttons.into()));
                heard.axes = hand.axes.map(f64::from).to_vec();
            }
            if self.wand == Some(sensor) {
                self.wand_signals.extend(heard.buttons.map(WandSignal::Buttons));
                self.wand_signals.push(WandSignal::Axes(heard.axes.clone()));
                self.wand_signals.extend(pose.map(WandSignal::Pose));
            }
            self.poses.extend(pose);
        }
        let other = match self.wand {
            Some(RIGHT_HAND) => left,
            Some(_) => right,
            None => return,
        };
        if other.axes == [0.0; 4] && other.pose == XrPose::default() {
            self.flick.let_go();
        } else {
            self.flicks += self.flick.take(other.axes[0].into(), other.axes[1].into());
        }
    }
}

/// Pose of a sensor whose place and turn are known.
fn pose_of(at: Nanos, time_ns: i64, sensor: i32, pose: &XrPose) -> Option<TrackedPose> {
    let vector = |numbers: [f32; 3]| DVec3::from_array(numbers.map(f64::from));
    Some(TrackedPose {
        sensor,
        at,
        measured_s: Some(time_ns as f64 * 1e-9),
        latency_s: None,
        position_m: vector(pose.position_m?),
        orientation: DQuat::from_array(pose.orientation?.map(f64::from)),
        velocity_m_s: pose.velocity_m_s.map(vector),
    })
}

impl Decoder for OpenxrDecoder {
    fn reset(&mut self, _at: Nanos) {
        // The next session counts anew.
        self.stage_moves = None;
        self.heard.forget();
        self.flick = StickFlick::default();
    }

    fn bytes(&mut self, at: Nanos, bytes: &[u8], _actions: &mut Actions) {
        match XrReport::from_bytes(bytes) {
            Ok(report) => self.report(at, &report),
            Err(error) => self.faults.count(error.to_string()),
        }
    }

    fn faults(&self) -> &Faults {
        &self.faults
    }
}

#[cfg(test)]
mod tests {
    //! Laws: the head is sensor 0, the hands are 1 and 2; a pose that the runtime does not know is no pose; the wand is
    //! one hand, with its buttons and axes, and the other hand's stick is flicked; a stage that moves is told; what is
    //! no report is counted.
    use super::*;
    use crate::openxr::report::XrHand;
    use crate::openxr::report::tests::report;
    use crate::wand::config::WandConfig;

    fn decoder(sensor: i32) -> OpenxrDecoder {
        let wand = Some(WandConfig { sensor, ..WandConfig::default() });
        OpenxrDecoder::of_head(&HeadConfig { wand, ..HeadConfig::new("openxr://".parse().unwrap()) })
    }

    #[test]
    fn head_and_hands_have_their_numbers_and_their_poses() {
        let mut decoder = decoder(2);
        decoder.bytes(7, &report().to_bytes(), &mut Actions::default());
        let poses = decoder.take_poses();
        assert_eq!(poses.iter().map(|pose| (pose.sensor, pose.at)).collect::<Vec<_>>(), [(0, 7), (1, 7), (2, 7)]);
        let head = report().head;
        assert_eq!(poses[0].position_m.as_vec3().to_array(), head.position_m.unwrap());
        assert_eq!(poses[0].orientation, DQuat::from_xyzw(0.0, f64::from(0.6_f32), 0.0, f64::from(0.8_f32)));
        assert_eq!(poses[0].velocity_m_s.unwrap().as_vec3().to_array(), head.velocity_m_s.unwrap());
        assert_eq!(poses[0].measured_s, Some(-7.000_000_001));
        let signals = decoder.take_wand_signals();
        assert_eq!(signals[..2], [WandSignal::Buttons(HeldButtons(2)), WandSignal::Axes(vec![0.25, -0.5, 0.75, 1.0])]);
        assert!(matches!(signals[2], WandSignal::Pose(pose) if pose.sensor == 2), "{signals:?}");
    }

    #[test]
    fn a_stage_that_moves_is_told_once() {
        let mut decoder = decoder(2);
        let mut moved = |stage_moves| {
            let report = XrReport { stage_moves, ..report() };
            decoder.bytes(7, &report.to_bytes(), &mut Actions::default());
            decoder.take_moved()
        };
        assert_eq!([250, 250, 251, 251, 0, 0].map(&mut moved), [false, false, true, false, true, false]);
        // Another session has moves of its own.
        decoder.reset(8);
        decoder.bytes(9, &report().to_bytes(), &mut Actions::default());
        assert!(!decoder.take_moved());
    }

    #[test]
    fn the_stick_of_the_hand_that_is_no_wand_is_flicked() {
        for (wand, other) in [(2, 0), (1, 1)] {
            let mut decoder = decoder(wand);
            for (hand, right, flicks) in [(other, 0.0, 0), (1 - other, -1.0, 0), (other, -1.0, 1), (other, -1.0, 0)] {
                let mut report = report();
                report.hands.iter_mut().for_each(|hand| hand.axes = [0.0; 4]);
                report.hands[hand].axes[0] = right;
                decoder.bytes(7, &report.to_bytes(), &mut Actions::default());
                assert_eq!(decoder.take_flicks(), flicks, "wand {wand}, hand {hand}");
            }
            // Nor has whoever holds it while another program has the hands.
            for (hand, flicks) in
                [(XrHand::default(), 0), (XrHand { axes: [1.0, 0.0, 0.0, 0.0], ..XrHand::default() }, 0)]
            {
                let mut report = report();
                report.hands[other] = hand;
                decoder.bytes(8, &report.to_bytes(), &mut Actions::default());
                assert_eq!(decoder.take_flicks(), flicks);
            }
            // Whoever holds the stick aside while the runtime comes has not flicked it.
            decoder.reset(8);
            let mut report = report();
            report.hands[other].axes = [1.0, 0.0, 0.0, 0.0];
            decoder.bytes(9, &report.to_bytes(), &mut Actions::default());
            assert_eq!(decoder.take_flicks(), 0);
        }
    }

    #[test]
    fn what_the_runtime_does_not_know_is_no_pose() {
        let mut lost = report();
        lost.head.position_m = None;
        lost.hands[0].pose.orientation = None;
        let mut decoder = decoder(1);
        decoder.bytes(7, &lost.to_bytes(), &mut Actions::default());
        assert_eq!(decoder.take_poses().iter().map(|pose| pose.sensor).collect::<Vec<_>>(), [2]);
        // The hand's buttons work out of sight.
        assert_eq!(decoder.take_wand_signals().len(), 2);
        assert_eq!(decoder.heard().iter().map(|heard| heard.tracked).collect::<Vec<_>>(), [false, false, true]);
        decoder.bytes(8, b"no report", &mut Actions::default());
        assert!(decoder.faults().number() == 1 && decoder.take_poses().is_empty());
    }
}
