//! Common interface of all decoders: bytes in, state inside, faults counted.
//!
//! A decoder has no clock and no thread. It sees the samples of its device in order and holds the resulting state;
//! time enters only through the samples and through the moment at which the desk asks.

use crate::action::Action;
use crate::clock::Nanos;
use crate::faults::Faults;

/// Decoder of a device's bytes into state.
pub trait Decoder {
    /// Forgets half a message, held keys and deflections: the device came or went.
    fn reset(&mut self, at: Nanos);

    /// Takes bytes that arrived at `at`, cut anywhere, and pushes actions to `actions`.
    fn bytes(&mut self, at: Nanos, bytes: &[u8], actions: &mut Actions);

    /// Messages that could not be understood so far.
    fn faults(&self) -> &Faults;
}

/// Actions waiting for the next frame, in the order in which they happened.
#[derive(Debug, Default)]
pub struct Actions {
    waiting: Vec<Action>,
}

impl Actions {
    /// Most actions kept between two frames, more than a person can press; the rest of a flood is dropped.
    const MOST: usize = 256;

    /// Adds an action.
    pub fn push(&mut self, action: Action) {
        if self.waiting.len() < Self::MOST {
            self.waiting.push(action);
        }
    }

    /// Number of actions that wait.
    pub(crate) fn number(&self) -> usize {
        self.waiting.len()
    }

    /// Actions that wait, without the first `number`.
    pub(crate) fn after(&self, number: usize) -> &[Action] {
        self.waiting.get(number..).unwrap_or_default()
    }

    /// Returns the waiting actions and forgets them.
    pub fn take(&mut self) -> Vec<Action> {
        std::mem::take(&mut self.waiting)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_flood_of_actions_is_bounded() {
        let mut actions = Actions::default();
        for _ in 0..10 * Actions::MOST {
            actions.push(Action::Step);
        }
        assert_eq!(actions.take().len(), Actions::MOST);
        assert!(actions.take().is_empty());
    }
}
