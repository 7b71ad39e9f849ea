//! Own time that was not ridden, because frames came too late.

use input::{Nanos, SECOND};
use ride::TICKS_PER_SECOND;
use words::{Language, Phrase};

/// Own time that may be lost without a word, seconds: that of a first picture.
const NOTICEABLE_S: f64 = 0.5;

/// Time for which a loss is shown. What is long past keeps nobody from looking at the street.
const SHOWN: Nanos = 10 * SECOND;

/// Sum of the own time that was not ridden, and the time of the newest loss.
#[derive(Clone, Copy, Debug, Default)]
pub struct LostTime {
    ticks: u64,
    newest: Nanos,
}

impl LostTime {
    /// Adds the ticks that a frame dropped.
    pub fn add(&mut self, dropped_ticks: u64, now: Nanos) {
        if dropped_ticks > 0 {
            self.ticks += dropped_ticks;
            self.newest = now;
        }
    }

    /// Sentence on all that was lost, if it is noticeable.
    pub fn sentence(&self, language: Language) -> Option<String> {
        let lost_s = self.ticks as f64 / f64::from(TICKS_PER_SECOND);
        (lost_s > NOTICEABLE_S).then(|| language.fill(Phrase::LostTime, &[&format!("{lost_s:.1}")]))
    }

    /// The same sentence, for a while after each loss.
    pub fn notice(&self, now: Nanos, language: Language) -> Option<String> {
        self.sentence(language).filter(|_| now < self.newest.saturating_add(SHOWN))
    }
}

#[cfg(test)]
mod tests {
    //! Law: whoever loses own time is told so when it happens, not for the rest of the ride, and of all of it at the
    //! end.

    use super::*;

    const LANGUAGE: Language = Language::English;

    #[test]
    fn a_loss_is_shown_for_a_while_and_told_in_all_at_the_end() {
        let mut lost = LostTime::default();
        lost.add(u64::from(TICKS_PER_SECOND) / 4, SECOND);
        assert_eq!((lost.notice(SECOND, LANGUAGE), lost.sentence(LANGUAGE)), (None, None));
        lost.add(u64::from(TICKS_PER_SECOND), 2 * SECOND);
        assert!(lost.notice(11 * SECOND, LANGUAGE).unwrap().starts_with("1.2 s of your own time"));
        for second in 12..20 {
            // Frames that lose nothing keep no notice alive.
            lost.add(0, second * SECOND);
            assert_eq!(lost.notice(second * SECOND, LANGUAGE), None);
        }
        lost.add(u64::from(TICKS_PER_SECOND), 20 * SECOND);
        assert!(lost.notice(20 * SECOND, LANGUAGE).unwrap().starts_with("2.2 s"));
        assert_eq!(lost.notice(30 * SECOND, LANGUAGE), None);
        assert!(lost.sentence(LANGUAGE).unwrap().starts_with("2.2 s"));
    }
}
