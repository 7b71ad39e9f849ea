//! Watch over a tracked head: when a visitor's head is lost for long, and when it is found again. A function of time
//! and of what the tracker sees alone.

use input::{Nanos, SECOND};

/// Time for which a lost head is no news: visitors hand their glasses on.
const PATIENCE: Nanos = 5 * SECOND;
/// Shortest time between two pieces of news, whatever a tracker does.
const BETWEEN: Nanos = 60 * SECOND;

/// News of a tracked head.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum HeadNews {
    /// Head that has been lost for this time, seconds.
    Lost(f64),
    /// Head that is seen again, after a loss of this time, seconds.
    Found(f64),
}

/// Watch over a tracked head.
#[derive(Clone, Copy, Debug, Default)]
pub struct HeadWatch {
    /// Beginning of the present loss.
    lost: Option<Nanos>,
    /// Length of the last loss that was told, while the end of it was not.
    told: Option<Nanos>,
    /// Time of the last piece of news.
    last: Option<Nanos>,
}

impl HeadWatch {
    /// News at the time `now`; `lost`: the tracker does not see the head.
    pub fn step(&mut self, now: Nanos, lost: bool) -> Option<HeadNews> {
        let news = self.news(now, lost)?;
        self.last = Some(now);
        Some(news)
    }

    /// News that have become due.
    fn news(&mut self, now: Nanos, lost: bool) -> Option<HeadNews> {
        let due = self.last.is_none_or(|last| now.saturating_sub(last) >= BETWEEN);
        if lost {
            let lasted = now.saturating_sub(*self.lost.get_or_insert(now));
            // A loss goes on in the next one as long as its end was not told.
            let told = self.told.is_some();
            if told || lasted < PATIENCE || !due {
                return None;
            }
            self.told = Some(lasted);
            return Some(HeadNews::Lost(seconds(lasted)));
        }
        if let (Some(began), Some(told)) = (self.lost.take(), &mut self.told) {
            *told = now.saturating_sub(began);
        }
        if !due {
            return None;
        }
        self.told.take().map(|lasted| HeadNews::Found(seconds(lasted)))
    }
}

fn seconds(time: Nanos) -> f64 {
    time as f64 / SECOND as f64
}

#[cfg(test)]
mod tests {
    //! Laws: a loss that lasts is told once, and so is its end, with its length; short losses are not; a tracker that
    //! flickers gives no more than a piece of news a minute.

    use super::*;

    /// News of ten steps a second, with their times, seconds; `lost` is a function of the time in tenths of a second.
    fn news(seconds: u64, lost: impl Fn(u64) -> bool) -> Vec<(f64, HeadNews)> {
        let mut watch = HeadWatch::default();
        let steps = (0..10 * seconds).map(|tenth| (tenth as f64 / 10.0, watch.step(tenth * SECOND / 10, lost(tenth))));
        steps.filter_map(|(at, news)| Some((at, news?))).collect()
    }

    #[test]
    fn a_loss_and_its_end_are_told_once() {
        let told = news(600, |tenth| (100..4000).contains(&tenth));
        assert_eq!(told, [(15.0, HeadNews::Lost(5.0)), (400.0, HeadNews::Found(390.0))]);
    }

    #[test]
    fn a_head_that_was_never_seen_is_told() {
        assert_eq!(news(600, |_| true), [(5.0, HeadNews::Lost(5.0))]);
    }

    #[test]
    fn a_short_loss_is_not_told() {
        assert_eq!(news(600, |tenth| tenth % 60 < 49), []);
    }

    #[test]
    fn the_end_of_a_loss_waits_for_its_minute_and_keeps_its_length() {
        let told = news(600, |tenth| (100..200).contains(&tenth));
        assert_eq!(told, [(15.0, HeadNews::Lost(5.0)), (75.0, HeadNews::Found(10.0))]);
    }

    #[test]
    fn a_tracker_that_flickers_gives_no_more_than_news_a_minute() {
        let told = news(3600, |tenth| tenth % 80 < 70);
        assert!(told.len() > 20, "{told:?}");
        for pair in told.windows(2) {
            assert!(pair[1].0 - pair[0].0 >= 60.0, "{pair:?}");
            assert_ne!(matches!(pair[0].1, HeadNews::Lost(_)), matches!(pair[1].1, HeadNews::Lost(_)), "{pair:?}");
        }
    }
}
