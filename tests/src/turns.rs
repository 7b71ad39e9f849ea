//! Turns of the tests that need much memory.
//!
//! All tests of a binary run at once, on as many threads as there are cores, and share the memory of a software
//! device. A map of a large picture, or the town, takes up to a gibibyte: with sixteen threads it was seven.

use std::sync::{Mutex, MutexGuard, PoisonError};

/// Turn of a test with a large map or the town. It lasts until it is dropped.
pub fn turn() -> MutexGuard<'static, ()> {
    static TURN: Mutex<()> = Mutex::new(());
    // A test that failed in its turn leaves nothing behind that could harm the next.
    TURN.lock().unwrap_or_else(PoisonError::into_inner)
}
