//! Laws of the pictures that a headset's runtime is handed, tried on a real runtime whose headset is simulated:
//! `make test-headset`.
#![allow(clippy::unwrap_used, clippy::panic, reason = "a failed construction is a failed test")]

mod pictures;
