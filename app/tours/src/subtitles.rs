//! Captions of a tour as subtitles in the SubRip form, for a film of it.

use crate::plan::TourText;
use std::fmt::Write;

/// Captions and the times from which each is shown, in the order of a film.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Subtitles {
    shown: Vec<(f64, TourText)>,
}

impl Subtitles {
    /// Notes the caption of a picture at `film_s` seconds of the film; `None` if it has none. Times must not descend.
    pub fn show(&mut self, film_s: f64, caption: Option<&TourText>) {
        let caption = caption.cloned().unwrap_or_default();
        if self.shown.last().is_none_or(|(_, before)| *before != caption) {
            self.shown.push((film_s, caption));
        }
    }

    /// Text of a subtitle file in one language, for a film that ends at `end_s` seconds.
    pub fn text(&self, code: &str, end_s: f64) -> String {
        let ends = self.shown.iter().skip(1).map(|(from_s, _)| *from_s).chain([end_s]);
        let captions = self
            .shown
            .iter()
            .zip(ends)
            .filter(|((from_s, caption), to_s)| !caption.in_language(code).is_empty() && to_s > from_s);
        let mut text = String::new();
        for (number, ((from_s, caption), to_s)) in captions.enumerate() {
            // An empty line would end the caption.
            let lines: Vec<&str> = caption.in_language(code).lines().filter(|line| !line.trim().is_empty()).collect();
            let [from, to] = [*from_s, to_s].map(stamp);
            let _ = writeln!(text, "{}\n{from} --> {to}\n{}\n", number + 1, lines.join("\n"));
        }
        text
    }
}

/// Time as hours, minutes, seconds and thousandths.
fn stamp(seconds: f64) -> String {
    let thousandths = (seconds.max(0.0) * 1000.0).round() as u64;
    let (seconds, rest) = (thousandths / 1000, thousandths % 1000);
    format!("{:02}:{:02}:{:02},{rest:03}", seconds / 3600, seconds / 60 % 60, seconds % 60)
}

#[cfg(test)]
mod tests {
    //! Law: each caption is shown from its first picture to that of the next, in the language asked for.

    use super::*;
    use std::collections::BTreeMap;

    fn caption(english: &str, german: &str) -> TourText {
        TourText(BTreeMap::from([("en".to_owned(), english.to_owned()), ("de".to_owned(), german.to_owned())]))
    }

    #[test]
    fn captions_follow_one_another_in_their_language() {
        let mut subtitles = Subtitles::default();
        let (first, second) = (caption("One\n\nmore", "Eins"), caption("Two", "Zwei"));
        let shown = [(0.0, Some(&first)), (0.5, Some(&first)), (3.25, None), (3725.0, Some(&second))];
        shown.into_iter().for_each(|(film_s, caption)| subtitles.show(film_s, caption));
        let german = "1\n00:00:00,000 --> 00:00:03,250\nEins\n\n2\n01:02:05,000 --> 01:02:06,000\nZwei\n\n";
        assert_eq!(subtitles.text("de", 3726.0), german);
        assert!(subtitles.text("en", 3726.0).starts_with("1\n00:00:00,000 --> 00:00:03,250\nOne\nmore\n\n2\n"));
        assert_eq!(Subtitles::default().text("en", 1.0), "");
    }
}
