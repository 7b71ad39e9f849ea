//! Keys that do other work than their own: the table `[keys]` of a set-up file or of the settings.
//!
//! ```toml
//! [keys]
//! Enter = "W"                     # the enter key pedals
//! A = "D"                         # the keys to the sides change places
//! D = "A"
//! F12 = "photo"                   # an action
//! Five = '{"time_scale":0.5}'     # an action with its value
//! ```

use std::collections::BTreeMap;

use serde::{Deserialize, Serialize};

use crate::action::Action;
use crate::config_error::ConfigError;
use crate::key::KeyboardKey;

/// Keys that do other work than their own: the name of a key, and the name of the key whose work it does or the text of
/// an [`Action`]. All other keys keep their own.
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

    /// Actions of keys that do no key's work, with the numbers of the keys.
    pub(crate) fn actions(&self) -> Vec<(u8, Action)> {
        let named = |(key, work): (&String, &String)| {
            let action = Action::named(work).filter(|_| KeyboardKey::named(work).is_none());
            Some((KeyboardKey::named(key)? as u8, action?))
        };
        self.0.iter().filter_map(named).collect()
    }

    /// Checks the names.
    ///
    /// # Errors
    /// The first name that is no key's, and no action's.
    pub fn check(&self) -> Result<(), ConfigError> {
        let bad = |name: &str, expected| Err(ConfigError { key: "keys", value: format!("{name:?}"), expected });
        for (key, work) in &self.0 {
            if KeyboardKey::named(key).is_none() {
                return bad(
                    key,
                    "the name of a key: A to Z, Zero to Nine, F1 to F12, Left, Right, Up, Down, Space, Shift, Enter, \
                     Tab, Escape, Backspace, Home, End, PageUp, PageDown, Minus, Equal, BracketLeft, BracketRight, \
                     Comma, Period or Slash",
                );
            }
            if KeyboardKey::named(work).is_none() && Action::named(work).is_none() {
                return bad(work, "the name of a key, or an action such as \"photo\" or '{\"time_scale\":0.5}'");
            }
        }
        Ok(())
    }
}
