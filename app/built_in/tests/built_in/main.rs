//! Tests of the crate `built_in`, one module a subject.

mod town;
