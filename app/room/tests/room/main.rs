//! Tests of the crate `room`, one module a subject.

mod built_in;
mod check;
mod dome;
mod file;
mod import;
mod projectors;
mod surfaces;
