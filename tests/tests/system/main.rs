//! Laws that hold for the whole system, from a scene to a pixel: a module each, in one binary.
#![allow(clippy::print_stdout, reason = "a test prints what it measured")]

mod aberration_twin;
mod adaptive;
mod animated;
mod camera;
mod clocks;
mod coarser_rooms;
mod colour;
mod directions;
mod display;
mod exposure;
mod footprints;
mod hidden;
mod house;
mod lamps;
mod lattice_pixels;
mod measured;
mod mirrors;
mod moving;
mod outside;
mod projections;
mod radiance;
mod raytrace;
mod resting;
mod room_sheets;
mod shadows;
mod sky;
mod sphere;
mod stereo;
mod textures;
mod three_scenes;
mod turning_room;
mod vertex_stage;
mod walls;
