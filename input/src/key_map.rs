//! Keys that do the work of others: the table `[keys]` of a set-up file.
//!
//! ```toml
//! [keys]
//! Enter = "W"     # the enter key pedals
//! A = "D"         # the keys to the sides change places
//! D = "A"
//! ```

use std::collections::BTreeMap;

use serde::{Deserialize, Serialize};

use crate::config_error::ConfigError;
use crate::key::KeyboardKey;

/// Keys that do the work of others: the name of a key, and the name of the key whose work it does. All other keys keep
/// their own.
#[derive(Clone, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
#[serde(transparent)]
pub struct KeyMap(pub BTreeMap<String, String>);

impl KeyMap {
    /// True if every key does its own work.
    pub fn is_empty(&self) -> bool {
        self.0.is_empty()
    }

    /// Key that does this work, the key itself if it may; `None` if none does.
    pub fn key_for(&self, work: KeyboardKey) -> Option<KeyboardKey> {
        let works = self.works();
        let does = |key: &KeyboardKey| works[usize::from(*key as u8)] == work as u8;
        [work].iter().chain(KeyboardKey::ALL).copied().find(does)
    }

    /// Key whose work each key does, by the numbers of the keys.
    pub(crate) fn works(&self) -> [u8; 256] {
        let mut works = std::array::from_fn(|code| u8::try_from(code).unwrap_or(0));
        for (key, work) in &self.0 {
            if let (Some(key), Some(work)) = (KeyboardKey::named(key), KeyboardKey::named(work)) {
                works[usize::from(key as u8)] = work as u8;
            }
        }
        works
    }

    pub(crate) fn check(&self) -> Result<(), ConfigError> {
        match self.0.iter().flat_map(|(key, work)| [key, work]).find(|name| KeyboardKey::named(name).is_none()) {
            None => Ok(()),
            Some(name) => Err(ConfigError {
                key: "keys",
                value: format!("{name:?}"),
                expected: "the name of a key: A to Z, One, Two, Three, Left, Right, Up, Down, Space, Shift, Enter, \
                           Tab, Backspace, Minus, Equal, Period or F1",
            }),
        }
    }
}
