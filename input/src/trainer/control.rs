//! Control of the trainer's motor brake: what is written to its control point, and when (FTMS 1.0, 4.16).
//!
//! A trainer obeys whoever has asked for control and got it, and answers one command before it takes the next. So the
//! commands form a small machine without a socket: ask for control, start, then tell the road whenever it has changed,
//! and once a second if it has not, so that a trainer that has forgotten it learns it again. A refusal is noted, told
//! to the rider, and asked again from time to time; the ride goes on without a felt slope.

use std::time::{Duration, Instant};

use thiserror::Error;

use super::wire::RequestRefusal;

/// Shortest time between two loads.
const LOAD_EVERY: Duration = Duration::from_millis(250);
/// Time after which an unchanged load is told again.
const REPEAT_EVERY: Duration = Duration::from_secs(1);
/// Longest wait for an answer to a command.
const ANSWER_WAIT: Duration = Duration::from_secs(2);
/// Time after which control that was refused is asked for again.
const ASK_AGAIN: Duration = Duration::from_secs(10);

/// Commands of the control point.
const REQUEST_CONTROL: u8 = 0x00;
const RESET: u8 = 0x01;
const START: u8 = 0x07;
const SIMULATION: u8 = 0x11;
/// First byte of an answer.
const ANSWER: u8 = 0x80;
/// Results in an answer.
const SUCCESS: u8 = 1;
const NOT_SUPPORTED: u8 = 2;
const NOT_PERMITTED: u8 = 5;

/// Steepest grade that a trainer is told, up or down.
const STEEPEST: f64 = 0.4;
/// Grade that a brake lever pulled through adds: about what a firm brake costs at a walking pace.
const BRAKE_GRADE: f64 = 0.15;
/// Coefficient of rolling resistance, in 0.0001: tyres on a road.
const ROLLING: u8 = 40;
/// Coefficient of wind resistance, in 0.01 kg/m: a rider upright.
const DRAG: u8 = 51;

/// Load that the ride puts on the rider.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct RoadLoad {
    /// Slope of the road along the motion: rise over run, positive uphill.
    pub slope: f64,
    /// Brake lever, 0 to 1.
    pub brake: f64,
}

impl RoadLoad {
    /// Grade that a trainer simulates, in 0.01 %: the share `felt` of the slope, and 15 % for a lever pulled through.
    /// The sum is limited to 40 % up and down; what is no number counts as level.
    pub fn grade(self, felt: f64) -> i16 {
        let finite = |number: f64| if number.is_finite() { number } else { 0.0 };
        let grade = finite(self.slope) * finite(felt) + finite(self.brake).clamp(0.0, 1.0) * BRAKE_GRADE;
        // The range fits: 40 % is 4000.
        (grade.clamp(-STEEPEST, STEEPEST) * 10_000.0).round() as i16
    }
}

/// Value of the command that simulates a road of this grade (0.01 %) without wind.
pub(crate) fn simulation(grade: i16) -> Vec<u8> {
    let [low, high] = grade.to_le_bytes();
    vec![SIMULATION, 0, 0, low, high, ROLLING, DRAG]
}

/// Values of the commands that release the brake and the control.
pub(crate) fn release() -> [Vec<u8>; 2] {
    [simulation(0), vec![RESET]]
}

/// Reason why a trainer does not obey.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Error)]
pub enum ControlRefusal {
    /// Control that another program has.
    #[error("another program has the control; close it")]
    Taken,
    /// A trainer without a motor brake.
    #[error("it cannot simulate a slope")]
    NoSlope,
    /// A result of the control point that has no other reason here.
    #[error("it answers with result {0}")]
    Result(u8),
    /// A refusal of the write itself.
    #[error("{0}")]
    Write(RequestRefusal),
}

/// Progress of the control.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum ControlPhase {
    /// Control is not asked for yet, or is to be asked for again.
    Ask,
    /// Control is there; the training has to be started.
    Start,
    /// The trainer obeys.
    Obeys,
    /// Control was refused at that time.
    Refused(Instant),
}

/// Machine of the commands to one trainer.
#[derive(Debug)]
pub(crate) struct TrainerControl {
    phase: ControlPhase,
    /// Command that waits for its answer, and its time.
    unanswered: Option<(u8, Instant)>,
    /// Last grade told, in 0.01 %, and its time.
    told: Option<(i16, Instant)>,
    /// Grade wanted, in 0.01 %.
    wanted: i16,
    /// True once a command was sent: even one that was refused, or not answered yet, may have been obeyed.
    engaged: bool,
    /// True if a load was not permitted, and none has been obeyed since.
    denied: bool,
    refusal: Option<ControlRefusal>,
}

impl TrainerControl {
    pub(crate) fn new() -> Self {
        Self {
            phase: ControlPhase::Ask,
            unanswered: None,
            told: None,
            wanted: 0,
            engaged: false,
            denied: false,
            refusal: None,
        }
    }

    /// Takes the grade that the ride wants, in 0.01 %.
    pub(crate) fn want(&mut self, grade: i16) {
        self.wanted = grade;
    }

    /// Reason why the trainer does not obey.
    pub(crate) fn refusal(&self) -> Option<ControlRefusal> {
        self.refusal
    }

    /// True if the trainer has got commands that have to be taken back, whatever it has answered.
    pub(crate) fn is_engaged(&self) -> bool {
        self.engaged
    }

    /// True if a command waits for its answer.
    pub(crate) fn is_waiting(&self) -> bool {
        self.unanswered.is_some()
    }

    /// Takes note of a command of the [`release`], whose answer is waited for like any other's.
    pub(crate) fn releases(&mut self, now: Instant, command: u8) {
        self.unanswered = Some((command, now));
    }

    /// Value of the next command, if one is due.
    pub(crate) fn next(&mut self, now: Instant) -> Option<Vec<u8>> {
        if self.unanswered.is_some_and(|(_, sent)| now.saturating_duration_since(sent) < ANSWER_WAIT) {
            return None;
        }
        // Some trainers answer the write alone: a command without an answer counts as done.
        if let Some((command, _)) = self.unanswered.take() {
            self.done(command);
        }
        let command = match self.phase {
            ControlPhase::Refused(since) if now.saturating_duration_since(since) < ASK_AGAIN => return None,
            ControlPhase::Ask | ControlPhase::Refused(_) => vec![REQUEST_CONTROL],
            ControlPhase::Start => vec![START],
            ControlPhase::Obeys => {
                if let Some((grade, sent)) = self.told {
                    let since = now.saturating_duration_since(sent);
                    if since < if grade == self.wanted { REPEAT_EVERY } else { LOAD_EVERY } {
                        return None;
                    }
                }
                self.told = Some((self.wanted, now));
                simulation(self.wanted)
            }
        };
        self.unanswered = Some((command[0], now));
        self.engaged = true;
        Some(command)
    }

    /// Takes the answer to the write itself: its response code.
    pub(crate) fn written(&mut self, now: Instant, response: u8) {
        if response != 0 && self.unanswered.take().is_some() {
            self.refuse(now, ControlRefusal::Write(RequestRefusal::of(response)));
        }
    }

    /// Takes an indication of the control point.
    pub(crate) fn answered(&mut self, now: Instant, value: &[u8]) {
        let &[ANSWER, command, result, ..] = value else {
            return;
        };
        if self.unanswered.is_some_and(|(waiting, _)| waiting == command) {
            self.unanswered = None;
        }
        match result {
            SUCCESS => self.done(command),
            // Another program has taken the control, or none was given: ask for it, but once.
            NOT_PERMITTED if command != REQUEST_CONTROL && self.phase == ControlPhase::Obeys && !self.denied => {
                (self.phase, self.denied) = (ControlPhase::Ask, true);
            }
            NOT_PERMITTED => self.refuse(now, ControlRefusal::Taken),
            NOT_SUPPORTED if command == SIMULATION => self.refuse(now, ControlRefusal::NoSlope),
            // A trainer that needs no start, and a load that comes again in a second.
            _ if command != REQUEST_CONTROL => self.done(command),
            _ => self.refuse(now, ControlRefusal::Result(result)),
        }
    }

    /// Goes on after a command was obeyed.
    fn done(&mut self, command: u8) {
        match command {
            // The last load stays told: loads are as few for a trainer that grants control again and again.
            REQUEST_CONTROL => self.phase = ControlPhase::Start,
            START => self.phase = ControlPhase::Obeys,
            _ => (self.refusal, self.denied) = (None, false),
        }
    }

    fn refuse(&mut self, now: Instant, why: ControlRefusal) {
        self.phase = ControlPhase::Refused(now);
        self.refusal = Some(why);
    }
}

#[cfg(test)]
mod tests {
    //! Law: the bytes are those of FTMS; a command waits for the answer before it; loads are few; a refusal is told and
    //! asked again later.
    use super::*;

    /// Machine that has been given control at `now`.
    fn obeying(now: Instant) -> TrainerControl {
        let mut control = TrainerControl::new();
        assert_eq!(control.next(now), Some(vec![0]));
        assert_eq!(control.next(now), None);
        control.answered(now, &[0x80, 0, 1]);
        assert_eq!(control.next(now), Some(vec![7]));
        control.answered(now, &[0x80, 7, 1]);
        control
    }

    #[test]
    fn grades_are_written_to_the_byte() {
        assert_eq!(simulation(-300), [0x11, 0, 0, 0xd4, 0xfe, 40, 51]);
        assert_eq!(simulation(1234), [0x11, 0, 0, 0xd2, 0x04, 40, 51]);
        assert_eq!(RoadLoad { slope: 0.1234, brake: 0.0 }.grade(1.0), 1234);
        assert_eq!(RoadLoad { slope: -0.06, brake: 0.0 }.grade(0.5), -300);
        assert_eq!(RoadLoad { slope: 0.02, brake: 1.0 }.grade(1.0), 1700);
        assert_eq!(RoadLoad { slope: 9.0, brake: 7.0 }.grade(1.0), 4000);
        assert_eq!(RoadLoad { slope: f64::NAN, brake: f64::NAN }.grade(1.0), 0);
    }

    #[test]
    fn loads_are_told_when_they_change_and_not_too_often() {
        let start = Instant::now();
        let mut control = obeying(start);
        let mut told = Vec::new();
        // A slope that changes in every frame, for two seconds, and then stays for two.
        for frame in 0..240_u16 {
            let now = start + Duration::from_secs(1) * u32::from(frame) / 60;
            control.want(frame.min(120).cast_signed());
            if let Some(command) = control.next(now) {
                told.push((frame, command));
                control.answered(now, &[0x80, 0x11, 1]);
            }
        }
        let frames: Vec<u16> = told.iter().map(|(frame, _)| *frame).collect();
        assert_eq!(frames, [0, 15, 30, 45, 60, 75, 90, 105, 120, 180]);
        assert_eq!(told[8].1, simulation(120));
    }

    #[test]
    fn a_command_waits_for_the_answer_and_a_silent_trainer_is_believed() {
        let start = Instant::now();
        let mut control = obeying(start);
        assert_eq!(control.next(start), Some(simulation(0)));
        control.want(500);
        assert_eq!(control.next(start + Duration::from_millis(1900)), None);
        assert_eq!(control.next(start + ANSWER_WAIT), Some(simulation(500)));
    }

    #[test]
    fn a_refusal_is_told_and_asked_again_later() {
        let start = Instant::now();
        let mut control = TrainerControl::new();
        control.next(start);
        control.answered(start, &[0x80, 0, 5]);
        assert_eq!(control.refusal(), Some(ControlRefusal::Taken));
        assert_eq!(control.next(start + Duration::from_secs(9)), None);
        let later = start + ASK_AGAIN;
        assert_eq!(control.next(later), Some(vec![0]));
        control.answered(later, &[0x80, 0, 1]);
        assert_eq!(control.next(later), Some(vec![7]));
        control.answered(later, &[0x80, 7, 4]);
        assert_eq!(control.next(later), Some(simulation(0)));
        control.answered(later, &[0x80, 0x11, 1]);
        assert_eq!(control.refusal(), None);
    }

    #[test]
    fn commands_are_taken_back_from_the_first_on_whatever_is_answered() {
        let start = Instant::now();
        let mut control = TrainerControl::new();
        assert!(!control.is_engaged());
        control.next(start);
        assert!(control.is_engaged(), "control may be granted after the end of the ride");
        control.answered(start, &[0x80, 0, 5]);
        assert!(control.is_engaged());
        let mut control = obeying(start);
        control.next(start);
        control.written(start, 6);
        assert!(control.is_engaged(), "the loads before the refused one are felt");
    }

    #[test]
    fn a_trainer_that_grants_control_and_permits_nothing_is_told_and_not_flooded() {
        let start = Instant::now();
        let mut control = TrainerControl::new();
        let (mut commands, mut refused) = (0, None);
        for ms in 0..9000 {
            let now = start + Duration::from_millis(ms);
            control.want(i16::try_from(ms).unwrap() % 300);
            if let Some(command) = control.next(now) {
                commands += 1;
                control.answered(now, &[0x80, command[0], if command[0] == SIMULATION { 5 } else { 1 }]);
                refused = control.refusal().or(refused);
            }
        }
        assert_eq!(commands, 6, "control, start and a load, twice");
        assert_eq!(refused, Some(ControlRefusal::Taken));
        // Control that was taken and given back is no refusal, however often, if loads are obeyed between.
        let mut control = obeying(start);
        for s in 0..20 {
            let now = start + Duration::from_secs(2 * s);
            for (command, result) in [(0x11, 5), (0, 1), (7, 1)] {
                assert_eq!(control.next(now).unwrap()[0], command);
                control.answered(now, &[0x80, command, result]);
            }
            assert_eq!(control.next(now + LOAD_EVERY), None);
            let later = now + REPEAT_EVERY;
            assert_eq!(control.next(later), Some(simulation(0)));
            control.answered(later, &[0x80, 0x11, 1]);
            assert_eq!(control.refusal(), None);
        }
    }

    #[test]
    fn a_trainer_without_slopes_and_one_that_refuses_the_write_are_told() {
        let start = Instant::now();
        let mut control = obeying(start);
        control.next(start);
        control.answered(start, &[0x80, 0x11, 2]);
        assert_eq!(control.refusal(), Some(ControlRefusal::NoSlope));
        let mut control = TrainerControl::new();
        control.next(start);
        control.written(start, 6);
        assert_eq!(control.refusal(), Some(ControlRefusal::Write(RequestRefusal::Value)));
    }

    #[test]
    fn a_trainer_whose_control_was_taken_is_asked_for_it_and_nonsense_is_no_answer() {
        let start = Instant::now();
        let mut control = obeying(start);
        control.next(start);
        [&[][..], &[0x80], &[0x80, 0x11], &[7, 0x11, 1]].iter().for_each(|value| control.answered(start, value));
        assert_eq!(control.next(start), None);
        control.answered(start, &[0x80, 0x11, 5]);
        assert_eq!(control.next(start), Some(vec![0]));
    }
}
