//! Languages of the interface.

use std::fmt::{self, Display, Formatter};
use std::str::FromStr;

use serde::{Deserialize, Serialize};
use thiserror::Error;

use crate::phrase::Phrase;
use crate::{english, german};

/// Language of the interface.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
pub enum Language {
    /// English.
    #[default]
    #[serde(rename = "en")]
    English,
    /// German.
    #[serde(rename = "de")]
    German,
}

/// Error for a text that names no language.
#[derive(Clone, Debug, PartialEq, Eq, Error)]
#[error("expected en or de")]
pub struct LanguageError;

impl Language {
    /// All languages.
    pub const ALL: [Self; 2] = [Self::English, Self::German];

    /// Language of the user's system; English if that is none of these.
    pub fn of_system() -> Self {
        sys_locale::get_locales().find_map(|locale| Self::of_locale(&locale)).unwrap_or_default()
    }

    /// Language of a locale such as de-AT or en_GB.UTF-8.
    fn of_locale(locale: &str) -> Option<Self> {
        locale.split(['-', '_', '.']).next()?.to_ascii_lowercase().parse().ok()
    }

    /// Code of the language, as in ISO 639.
    pub fn code(self) -> &'static str {
        match self {
            Self::English => "en",
            Self::German => "de",
        }
    }

    /// Name of the language in itself.
    pub fn name(self) -> &'static str {
        match self {
            Self::English => "English",
            Self::German => "Deutsch",
        }
    }

    /// Next language in order; the first one follows the last.
    pub fn next(self) -> Self {
        match self {
            Self::English => Self::German,
            Self::German => Self::English,
        }
    }

    /// Text with its decimals written as in this language.
    pub fn decimals(self, text: &str) -> String {
        if self == Self::English {
            return text.to_owned();
        }
        let of_digits: Vec<char> = text.chars().collect();
        let is_digit = |place: usize| of_digits.get(place).is_some_and(char::is_ascii_digit);
        let between = |place: usize| place > 0 && is_digit(place - 1) && is_digit(place + 1);
        let written = |(place, letter): (usize, &char)| if *letter == '.' && between(place) { ',' } else { *letter };
        of_digits.iter().enumerate().map(written).collect()
    }

    /// Number whose decimals are written as in this language, or as in English.
    pub fn number(self, text: &str) -> Option<f64> {
        let text = if self == Self::English { text.to_owned() } else { text.replace(',', ".") };
        text.trim().parse().ok().filter(|number: &f64| number.is_finite())
    }

    /// Text of a phrase, with its numbers in braces as they are.
    pub fn text(self, phrase: Phrase) -> &'static str {
        match self {
            Self::English => english::text(phrase),
            Self::German => german::text(phrase),
        }
    }

    /// Text of a phrase with values in the place of its numbers in braces.
    pub fn fill(self, phrase: Phrase, values: &[&dyn Display]) -> String {
        let mut text = String::new();
        let mut rest = self.text(phrase);
        while let Some((before, after)) = rest.split_once('{') {
            text.push_str(before);
            let (number, after) = after.split_once('}').unwrap_or((after, ""));
            if let Some(value) = number.parse::<usize>().ok().and_then(|number| values.get(number)) {
                text.push_str(&value.to_string());
            }
            rest = after;
        }
        text + rest
    }
}

impl Display for Language {
    fn fmt(&self, formatter: &mut Formatter<'_>) -> fmt::Result {
        formatter.write_str(self.code())
    }
}

impl FromStr for Language {
    type Err = LanguageError;

    fn from_str(text: &str) -> Result<Self, LanguageError> {
        Self::ALL.into_iter().find(|language| language.code() == text).ok_or(LanguageError)
    }
}

#[cfg(test)]
mod tests {
    //! Law: every language says every phrase, with the same values. A forgotten value would be lost to the reader.

    use super::*;
    use std::collections::BTreeSet;

    fn values(text: &str) -> BTreeSet<&str> {
        text.split('{').skip(1).filter_map(|rest| rest.split_once('}')).map(|(number, _)| number).collect()
    }

    #[test]
    fn decimals_are_written_as_in_the_language() {
        for (english, german) in
            [("β 0.640", "β 0,640"), ("00:59.9", "00:59,9"), ("1. Halt.", "1. Halt."), (".5", ".5")]
        {
            assert_eq!(Language::German.decimals(english), german);
            assert_eq!(Language::English.decimals(english), english);
        }
        for (text, english, german) in [("1.5", Some(1.5), Some(1.5)), (" 0,25", None, Some(0.25)), ("c", None, None)] {
            assert_eq!([Language::English, Language::German].map(|language| language.number(text)), [english, german]);
        }
    }

    #[test]
    fn every_language_says_every_phrase_with_the_same_values() {
        for phrase in Phrase::ALL {
            let english = Language::English.text(*phrase);
            for language in Language::ALL {
                let text = language.text(*phrase);
                assert!(!text.trim().is_empty() && !text.contains("  ") && text.trim() == text, "{phrase:?}: {text:?}");
                assert_eq!(values(text), values(english), "{phrase:?} in {language}");
            }
        }
    }

    /// Phrases that are the same in both languages: names, signs, and words that German has taken over.
    const SAME: [Phrase; 1] = [Phrase::Doppler];

    #[test]
    fn german_is_not_english() {
        let same = |phrase: &Phrase| Language::German.text(*phrase) == Language::English.text(*phrase);
        let found: Vec<Phrase> = Phrase::ALL.iter().copied().filter(same).collect();
        assert_eq!(found, SAME);
    }

    #[test]
    fn values_stand_where_their_numbers_are() {
        assert_eq!(Language::German.fill(Phrase::Light, &[&"30 km/h"]), "Licht: 30 km/h");
        assert_eq!(Language::English.fill(Phrase::ClockRuns, &[&0.5]), "your clock runs × 0.5");
        assert_eq!(Language::English.fill(Phrase::Light, &[]), "light: ");
    }

    #[test]
    fn locales_name_their_language() {
        for (locale, language) in [
            ("de-AT", Some(Language::German)),
            ("de_DE.UTF-8", Some(Language::German)),
            ("en_GB", Some(Language::English)),
            ("EN", Some(Language::English)),
            ("fr-FR", None),
            ("C", None),
            ("", None),
        ] {
            assert_eq!(Language::of_locale(locale), language, "{locale}");
        }
        for language in Language::ALL {
            assert_eq!(language.code().parse(), Ok(language));
        }
    }
}
