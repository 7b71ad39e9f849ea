//! Tests of `input` from outside: whole rides, recordings and live devices. Each module says what it holds them to.
#![expect(clippy::unwrap_used, reason = "a test that cannot go on fails")]

mod head;
mod live;
mod recording;
