//! Sentences on the tracked head: whether its tracker sees it, and what became of the wish to be straight.

use input::head::{TrackedHead, Tracking};
use input::{Desk, TrackerUrl, TrackingMode};
use words::{Language, Phrase};

/// Tracked head that its tracker does not see.
#[derive(Clone, Debug, PartialEq)]
pub struct UnseenHead {
    /// True if it was seen before.
    pub was_seen: bool,
    /// Number of poses rejected so far, and the reason for the last one, if there is one.
    pub rejected: Option<(u64, String)>,
}

impl UnseenHead {
    /// Head in this state; `None` if the tracker sees it.
    pub fn of(head: &TrackedHead, tracked: Tracking) -> Option<Self> {
        // A head that fades may be back with the next pose.
        let was_seen = match tracked {
            Tracking::Tracked | Tracking::Fading => return None,
            Tracking::Never => false,
            Tracking::Lost => true,
        };
        let rejected = head.rejected();
        Some(Self { was_seen, rejected: rejected.last().map(|last| (rejected.number(), last.to_owned())) })
    }

    /// Sentence on the head, with the reason.
    pub fn sentence(&self, language: Language) -> String {
        let how = language.text(if self.was_seen { Phrase::HeadLost } else { Phrase::HeadNeverSeen });
        match &self.rejected {
            None => how.to_owned(),
            Some((number, last)) => language.fill(Phrase::PosesRejected, &[&how, number, last]),
        }
    }
}

/// Line on the head, seen or not, with the number of its rejected poses.
pub fn head_line(head: &TrackedHead, unseen: Option<&UnseenHead>, language: Language) -> String {
    let tracked = || language.text(Phrase::HeadTracked).to_owned();
    let seen = unseen.map_or_else(tracked, |unseen| unseen.sentence(language));
    language.fill(Phrase::HeadLine, &[&seen, &head.rejected().number()])
}

/// Sentence on the use of the tracked head; `None`: none is tracked.
pub fn tracking_told(mode: Option<TrackingMode>, language: Language) -> String {
    let mode = match mode {
        None => return language.text(Phrase::NoHead).to_owned(),
        Some(TrackingMode::PositionAndVelocity) => Phrase::HeadBoth,
        Some(TrackingMode::Position) => Phrase::HeadPlace,
        Some(TrackingMode::None) => Phrase::HeadOff,
    };
    language.fill(Phrase::HeadIs, &[&language.text(mode)])
}

/// Outcome for a rider who has asked to be straight.
pub fn straightened(desk: &Desk) -> Phrase {
    match desk.head() {
        None => Phrase::NoHeadToStraighten,
        Some(head) if head.config().url == TrackerUrl::Mouse || head.recentres() => Phrase::HeadIsStraight,
        Some(_) => Phrase::HeadIsCalibrated,
    }
}
