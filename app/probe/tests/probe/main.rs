//! Tests of the crate `probe`, one module a subject.

mod answers;
mod lines;
