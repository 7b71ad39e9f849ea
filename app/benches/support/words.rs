//! Words on a benchmark's command line, after `--`.

use std::str::FromStr;

/// Words that nothing has asked for yet.
pub struct Words(Vec<String>);

impl Words {
    /// Words of the command line, without those that cargo adds.
    pub fn given() -> Self {
        Self(std::env::args().skip(1).filter(|word| word != "--bench").collect())
    }

    /// True if the word is there.
    pub fn has(&mut self, wanted: &str) -> bool {
        let before = self.0.len();
        self.0.retain(|word| word != wanted);
        self.0.len() < before
    }

    /// First word of which `meaning` makes a value.
    pub fn find<T>(&mut self, meaning: impl Fn(&str) -> Option<T>) -> Option<T> {
        let (place, value) = self.0.iter().enumerate().find_map(|(place, word)| Some((place, meaning(word)?)))?;
        self.0.remove(place);
        Some(value)
    }

    /// Values of `key=value,value…`; empty without that key.
    pub fn list<T: FromStr>(&mut self, key: &str) -> Result<Vec<T>, String> {
        let wanted =
            |word: &str| word.split_once('=').filter(|(name, _)| *name == key).map(|(_, list)| list.to_owned());
        let Some(list) = self.find(wanted) else { return Ok(Vec::new()) };
        let value = |text: &str| text.parse().map_err(|_| format!("{key}={list}: \"{text}\" is no value for {key}"));
        list.split(',').map(value).collect()
    }

    /// Seconds, written `12s`.
    pub fn seconds(&mut self) -> Option<f64> {
        let positive = |seconds: &f64| seconds.is_finite() && *seconds > 0.0;
        self.find(|word| word.strip_suffix('s')?.parse().ok().filter(positive))
    }

    /// Width and height, pixels, written `640x360`.
    pub fn size(&mut self) -> Option<[u32; 2]> {
        let side = |text: &str| text.parse().ok().filter(|side| (1..=16_384).contains(side));
        self.find(|word| {
            let (width, height) = word.split_once('x')?;
            Some([side(width)?, side(height)?])
        })
    }

    /// Speeds of `beta=…`, fractions of c; `usual` if none are given.
    pub fn speeds(&mut self, usual: &[f64]) -> Result<Vec<f64>, String> {
        let speeds = self.list("beta")?;
        match speeds.iter().find(|speed| !(0.0..1.0).contains(*speed)) {
            Some(speed) => Err(format!("beta={speed}: a speed is at least 0 and below 1, that of light")),
            None if speeds.is_empty() => Ok(usual.to_vec()),
            None => Ok(speeds),
        }
    }

    /// Refuses words that nothing has asked for; `known`: all that there are.
    pub fn end(self, known: &str) -> Result<(), String> {
        match self.0.first() {
            Some(word) => Err(format!("{word} is no word of this benchmark, which has {known}")),
            None => Ok(()),
        }
    }
}
