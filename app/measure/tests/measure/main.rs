//! Tests of the crate `measure`, one module a subject.

mod extremes;
