//! Tests of `input` from outside: whole rides, recordings and live devices. The head of each module says what it
//! tests.
#![expect(clippy::unwrap_used, reason = "a test that cannot go on fails")]

mod head;
mod live;
mod recording;
mod recording_copies;
mod recording_damage;
mod recordings;
