//! Glide: what changes by leaps, from one report of a device to the next, as a film shows it in between.
//!
//! A tracker reports 60 times a second, and a film may have 120 pictures. A head that stayed where it was last seen
//! would go on in every second picture. So it is shown on its way: from where it was shown when the newest report came,
//! to what that report says, in a straight line and for as long as the interval between the last two reports took. It
//! has no leaps, uses nothing that was not known at its time, and comes an interval late. After a rest the way takes no
//! longer than [`LONGEST`].

use glam::DQuat;
use input::head::Tracking;
use input::{HeadState, Nanos, SECOND};

/// Longest way from one report to the next: three intervals of a 60 Hz tracker.
const LONGEST: Nanos = SECOND / 20;

/// Value on its way to the newest report.
#[derive(Clone, Copy, Debug)]
pub(super) struct BetweenReports<T> {
    from: T,
    to: T,
    /// Time of the newest report, and the length of the way to it.
    began: Nanos,
    span: Nanos,
}

/// Value that can glide.
pub(super) trait Reported: Copy + PartialEq {
    /// Value on the straight way from `self` to `end`, `share` from 0 to 1.
    fn towards(&self, end: &Self, share: f64) -> Self;

    /// True if there is no way from `self` to `end`.
    fn leaps_to(&self, _end: &Self) -> bool {
        false
    }
}

impl<T: Reported> BetweenReports<T> {
    /// BetweenReports that goes on with the value of a tick; it begins with it if there was none before.
    pub(super) fn on(before: Option<Self>, at: Nanos, value: T) -> Self {
        match before.filter(|before| !before.to.leaps_to(&value)) {
            None => Self { from: value, to: value, began: at, span: 1 },
            Some(before) if before.to == value => before,
            Some(before) => {
                let span = at.saturating_sub(before.began).clamp(1, LONGEST);
                Self { from: before.at(at), to: value, began: at, span }
            }
        }
    }

    /// Value at a time not before the newest report.
    pub(super) fn at(&self, at: Nanos) -> T {
        let passed = at.saturating_sub(self.began);
        if passed >= self.span { self.to } else { self.from.towards(&self.to, passed as f64 / self.span as f64) }
    }
}

impl Reported for DQuat {
    fn towards(&self, end: &Self, share: f64) -> Self {
        self.lerp(*end, share)
    }
}

impl Reported for HeadState {
    fn towards(&self, end: &Self, share: f64) -> Self {
        Self {
            position_m: self.position_m.lerp(end.position_m, share),
            orientation: self.orientation.towards(&end.orientation, share),
            velocity_m_s: self.velocity_m_s.lerp(end.velocity_m_s, share),
            turn_rad_s: self.turn_rad_s.lerp(end.turn_rad_s, share),
            tracked: end.tracked,
        }
    }

    fn leaps_to(&self, end: &Self) -> bool {
        (self.tracked == Tracking::Never) != (end.tracked == Tracking::Never)
    }
}

#[cfg(test)]
mod tests {
    //! Law: what moves evenly by reports moves evenly between them, an interval late; nothing leaps, and what rests is
    //! reached. A wrong program stands still in every second picture, or swings past the newest report.
    use super::*;
    use glam::DVec3;

    const INTERVAL: Nanos = SECOND / 60;

    fn head(x: f64) -> HeadState {
        HeadState {
            position_m: DVec3::X * x,
            orientation: DQuat::from_rotation_y(x),
            velocity_m_s: DVec3::ZERO,
            turn_rad_s: DVec3::ZERO,
            tracked: Tracking::Tracked,
        }
    }

    #[test]
    fn an_even_motion_stays_even_between_reports() {
        let mut glide = None;
        for report in 0..20_u64 {
            let at = report * INTERVAL;
            glide = Some(BetweenReports::on(glide, at, head(0.01 * report as f64)));
            let on_its_way = report.checked_sub(2).and(glide);
            for part in 0..8 {
                let Some(glide) = on_its_way else { break };
                let shown = glide.at(at + part * INTERVAL / 8);
                let expected = 0.01 * (report as f64 - 1.0 + part as f64 / 8.0);
                assert!((shown.position_m.x - expected).abs() < 1e-9, "{} for {expected}", shown.position_m.x);
                let turn = shown.orientation.angle_between(DQuat::from_rotation_y(expected));
                assert!(turn < 1e-7, "{turn} rad at {expected}");
            }
        }
    }

    #[test]
    fn uneven_reports_make_no_leap_and_a_rest_is_reached() {
        let mut glide = BetweenReports::on(None, 0, head(0.0));
        let (mut at, mut shown) = (0, 0.0);
        for report in 1..40_u64 {
            let next = at + INTERVAL / 2 + report * 7919 % INTERVAL;
            for part in 0..=16 {
                let now = glide.at(at + part * (next - at) / 16).position_m.x;
                assert!((now - shown).abs() < 0.004 && now < 0.01 * report as f64, "{shown} to {now}");
                shown = now;
            }
            at = next;
            glide = BetweenReports::on(Some(glide), at, head(0.01 * report as f64));
        }
        assert_eq!(glide.at(at + LONGEST), head(0.39));
        // A report that says nothing new changes nothing.
        let rested = BetweenReports::on(Some(glide), at + SECOND, head(0.39));
        assert_eq!(
            BetweenReports::on(Some(rested), at + 2 * SECOND, head(0.4)).at(at + 2 * SECOND + LONGEST),
            head(0.4)
        );
    }

    #[test]
    fn a_head_that_is_first_seen_is_there_at_once() {
        let unseen = HeadState { tracked: Tracking::Never, ..head(0.0) };
        assert_eq!(BetweenReports::on(Some(BetweenReports::on(None, 0, unseen)), 5, head(1.0)).at(5), head(1.0));
    }
}
