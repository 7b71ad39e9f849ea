//! Tests of the crate `ride`, one module a subject.

mod assist;
mod frames_between;
mod log;
mod old_recordings;
mod random_rides;
mod simulation;
mod tour;
mod town;
mod vehicle_bicycle;
mod vehicle_flight;
mod vehicle_gaze;
mod vehicle_hull;
mod vehicle_walls;
