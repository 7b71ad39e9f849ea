//! The tests of the crate's public interface: a module a subject.
#![allow(clippy::print_stdout, reason = "a test prints what it measured")]
#![allow(clippy::unwrap_used, reason = "a failed construction is a failed test")]

mod apparent;
mod apparent_shape;
mod boost;
mod colour_difference;
mod colour_planck;
mod colour_rgb;
mod colour_sampled;
mod colour_table;
mod contraction;
mod eyes;
mod high_precision;
mod interpolation_error;
mod newton;
mod photo_surface;
mod photo_surface_accuracy;
mod retarded;
mod simultaneous;
mod stereo_perception;
mod support;
mod worldline;
