//! Laws of a session's life, played out by a layer over a real runtime: whatever happens to the headset, the ride goes
//! on, nothing stays held, no leap of the runtime's axes is a motion of the head, and the recording replays to the bit.

use crate::rides::{Worn, assert_replays};
use crate::virtual_display::wait_for;
use glam::DVec3;
use input::head::Tracking;
use input::openxr::XrReport;
use input::recording::{Recording, RecordingEntry};
use input::{Controls, HeadState, SampleSource, Signal};
use std::path::Path;
use xr_layer::LayerScript;

/// Frames of the headset that are a while.
const WHILE: usize = 8;
/// Fewest frames of the ride in such a while.
const FEW: usize = 4;
/// Time in which the ride in the window has a few frames, on a slow machine.
const IN_WINDOW_S: f64 = 3.0;

/// Ride in a headset to which something happens.
struct Lived {
    worn: Worn,
    script: LayerScript,
}

impl Lived {
    /// Ride whose headset has had the focus for a while.
    fn new() -> Self {
        let folder = tempfile::tempdir().unwrap();
        let script = LayerScript::new(folder.path());
        let worn = Worn::arranged(folder, |command| script.lead(command));
        let lived = Self { worn, script };
        lived.await_note("picture", 1);
        lived.happen(&[]);
        lived
    }

    /// Plays out what happens at once, and what follows for a while.
    fn happen(&self, commands: &[&str]) {
        let frames = self.count("frame");
        self.script.say(commands);
        self.await_note("frame", frames + WHILE);
    }

    fn count(&self, what: &str) -> usize {
        self.script.journal().iter().filter(|note| *note == what).count()
    }

    /// Waits until the journal holds a note so many times.
    fn await_note(&self, what: &str, times: usize) {
        wait_for(what, || (self.count(what) >= times).then_some(()));
    }

    /// Ends the ride, which must replay to the bit. What it said, and its frames.
    fn end(self) -> (String, Ridden) {
        let (told, folder) = self.worn.end();
        assert_replays(folder.path());
        assert!(!self.script.journal().contains(&"not understood:".to_owned()), "{:?}", self.script.journal());
        (told, Ridden::read(folder.path()))
    }
}

/// Frame with the reports that came before it.
struct Frame {
    controls: Controls,
    reports: Vec<XrReport>,
}

/// Frames of a recorded ride, and the number of those before the end of the session.
struct Ridden {
    frames: Vec<Frame>,
    closed: Option<usize>,
}

impl Ridden {
    fn read(folder: &Path) -> Self {
        let (mut ridden, mut reports) = (Self { frames: Vec::new(), closed: None }, Vec::new());
        for entry in Recording::open(&folder.join("r.mcap")).unwrap() {
            match entry.unwrap() {
                RecordingEntry::Controls(record) => {
                    ridden.frames.push(Frame { controls: record.controls, reports: std::mem::take(&mut reports) });
                }
                RecordingEntry::Sample(sample) if sample.source == SampleSource::Openxr => match sample.signal {
                    Signal::Bytes(bytes) => reports.push(XrReport::from_bytes(&bytes).unwrap()),
                    Signal::Closed => ridden.closed = Some(ridden.frames.len()),
                    Signal::Opened => {}
                },
                _ => {}
            }
        }
        ridden
    }

    /// Heads that are tracked.
    fn tracked(&self) -> impl Iterator<Item = HeadState> {
        let heads = self.frames.iter().filter_map(|frame| frame.controls.head);
        heads.filter(|head| head.tracked == Tracking::Tracked)
    }

    /// Lengths of the runs of frames that are alike in this.
    fn runs<T: PartialEq>(&self, of: impl Fn(&Frame) -> T) -> Vec<(T, usize)> {
        let mut runs: Vec<(T, usize)> = Vec::new();
        for frame in &self.frames {
            let now = of(frame);
            match runs.last_mut().filter(|(last, _)| *last == now) {
                Some((_, length)) => *length += 1,
                None => runs.push((now, 1)),
            }
        }
        runs
    }

    /// Runs of frames with and without a tracked head, from the first with one.
    fn heads(&self) -> Vec<(bool, usize)> {
        self.runs(is_tracked).into_iter().skip_while(|run| !run.0).collect()
    }

    /// Most frames in a row in which the stick was held though no report came.
    fn longest_silent_hold(&self) -> usize {
        let runs = self.runs(|frame| holds_stick(frame) && frame.reports.is_empty());
        runs.into_iter().filter(|(silent, _)| *silent).map(|(_, length)| length).max().unwrap_or(0)
    }
}

fn holds_stick(frame: &Frame) -> bool {
    frame.controls.wand.as_ref().is_some_and(|wand| wand.stick[1] > 0.5)
}

fn holds_button(frame: &Frame) -> bool {
    frame.controls.wand.as_ref().is_some_and(|wand| wand.buttons.numbers().next().is_some())
}

fn is_tracked(frame: &Frame) -> bool {
    frame.controls.head.is_some_and(|head| head.tracked == Tracking::Tracked)
}

#[test]
fn hands_rest_while_the_session_has_no_focus() {
    let lived = Lived::new();
    lived.happen(&["hold stick 0 1", "hold choose 1 0"]);
    lived.happen(&["visible"]);
    lived.happen(&["synchronized"]);
    lived.happen(&["visible", "focused"]);
    let (told, ridden) = lived.end();
    assert!(!told.contains("the ride goes on in the window"), "{told}");
    for runs in [ridden.runs(holds_stick), ridden.runs(holds_button)] {
        assert_eq!(runs.iter().map(|run| run.0).collect::<Vec<_>>(), [false, true, false, true], "{runs:?}");
        assert!(runs.iter().all(|run| run.1 > FEW), "{runs:?}");
    }
    // The head is seen all the while.
    assert_eq!(ridden.heads().len(), 1, "{:?}", ridden.heads());
}

#[test]
fn a_headset_that_is_put_down_leaves_the_ride_in_the_window_until_it_is_put_on() {
    let lived = Lived::new();
    lived.happen(&["hold stick 0 1"]);
    lived.script.say(&["visible", "synchronized", "stopping"]);
    lived.await_note("session ended", 1);
    lived.worn.drive(IN_WINDOW_S);
    lived.happen(&["hold stick 0 0", "ready"]);
    lived.await_note("session begun", 2);
    lived.await_note("picture", 2);
    lived.happen(&[]);
    let (told, ridden) = lived.end();
    assert!(!told.contains("the ride goes on in the window"), "{told}");
    assert_eq!(ridden.closed, None);
    let heads = ridden.heads();
    assert_eq!(heads.len(), 3, "{heads:?}");
    assert!(heads.iter().all(|run| run.1 >= 2), "{heads:?}");
    // The stick is let go at once.
    assert_eq!(ridden.runs(holds_stick).iter().filter(|run| run.0).count(), 1, "{:?}", ridden.runs(holds_stick));
    assert!(ridden.longest_silent_hold() <= 1, "held for {} frames", ridden.longest_silent_hold());
}

#[test]
fn every_end_of_a_session_is_one_sentence_and_costs_the_headset_alone() {
    for end in [
        &["visible", "synchronized", "stopping", "loss_pending"][..],
        &["visible", "synchronized", "stopping", "exiting"],
        &["instance_loss"],
        &["session_lost"],
    ] {
        let lived = Lived::new();
        lived.happen(&["hold stick 0 1"]);
        lived.script.say(end);
        lived.worn.drive(IN_WINDOW_S);
        let (told, ridden) = lived.end();
        let lost: Vec<&str> = told.lines().filter(|line| line.contains("the ride goes on in the window")).collect();
        assert!(lost.len() == 1 && lost[0].contains("has ended the session"), "{end:?}: {told}");
        let after = &ridden.frames[ridden.closed.unwrap()..];
        assert!(after.len() >= 2 && ridden.tracked().count() > FEW, "{end:?}: {} frames after", after.len());
        assert!(!after.iter().any(holds_stick) && ridden.longest_silent_hold() <= 1, "{end:?}: the stick is held");
    }
}

#[test]
fn a_head_that_is_out_of_sight_keeps_its_place_and_its_headset() {
    let lived = Lived::new();
    lived.happen(&["velocity 3 0 0"]);
    lived.happen(&["head off"]);
    lived.happen(&["head on"]);
    let (told, ridden) = lived.end();
    assert!(!told.contains("the ride goes on in the window"), "{told}");
    let heads = ridden.heads();
    assert_eq!(heads.len(), 3, "{heads:?}");
    assert!(heads.iter().all(|run| run.1 > FEW), "{heads:?}");
    let lost = ridden.frames.iter().position(is_tracked).unwrap() + heads[0].1;
    let place = |number: usize| ridden.frames[number].controls.head.unwrap().position_m;
    assert!((lost..lost + heads[1].1).all(|number| place(number) == place(lost - 1)));
    // The runtime's velocity is kept, and the head's is made from its places.
    let said = |frame: &Frame| frame.reports.iter().any(|report| report.head.velocity_m_s == Some([3.0, 0.0, 0.0]));
    assert!(ridden.frames.iter().filter(|frame| said(frame)).count() > FEW);
    assert!(ridden.tracked().all(|head| head.velocity_m_s.length() < 2.0));
}

#[test]
fn a_recentring_of_the_runtime_makes_the_present_place_the_seat_without_a_motion() {
    let lived = Lived::new();
    // A step that might be one of a head, one that could not, and one of another space.
    lived.happen(&["recentre 0.15 0 0.1 10"]);
    lived.happen(&["recentre 1 0 2 90"]);
    lived.happen(&["recentre local"]);
    let (told, ridden) = lived.end();
    assert!(!told.contains("the ride goes on in the window"), "{told}");

    let seat = ridden.tracked().next().unwrap();
    let before = |frame: &&Frame| frame.reports.iter().all(|report| report.stage_moves == 0);
    let first = ridden.frames.iter().take_while(before).count();
    let reported = ridden.frames.iter().filter_map(|frame| Some((frame.reports.last()?.stage_moves, frame)));
    let (mut moved, mut count) = (Vec::new(), 0);
    for (moves, frame) in reported {
        if std::mem::replace(&mut count, moves) != moves {
            moved.extend(frame.controls.head);
        }
    }
    assert_eq!(moved.len(), 3);
    for head in &moved {
        assert_eq!(head.position_m, seat.position_m);
        // The heading is ahead; the head nods and leans as it does.
        let ahead = head.orientation * DVec3::NEG_Z;
        assert!(ahead.x.abs() < 1e-9 && ahead.z < 0.0, "{ahead}");
    }
    // The head moves as it did before, and near its seat.
    let heads: Vec<HeadState> = ridden.frames.iter().filter_map(|frame| frame.controls.head).collect();
    let fastest = |heads: &[HeadState]| heads.iter().map(|head| head.velocity_m_s.length()).fold(0.0, f64::max);
    let usual = fastest(&heads[..first]);
    assert!(first > FEW, "{first} frames");
    assert!(fastest(&heads) < 2.0 * usual + 0.1, "{} m/s, before {usual} m/s", fastest(&heads));
    assert!(heads.iter().all(|head| head.position_m.distance(seat.position_m) < 0.5));
}
