//! Laws that hold for the whole system, from a scene to a pixel: a module each, in one binary.

mod aberration_twin;
mod adaptive;
mod animated;
mod camera;
mod colour;
mod display;
mod lamps;
mod lattice_pixels;
mod mirrors;
mod moving;
mod radiance;
mod raytrace;
mod sky;
mod sphere;
mod stereo;
mod textures;
mod vertex_stage;
mod walls;

// TODO: add `mod directions; mod three_scenes;` when `measure` compiles, and `mod exr_files;` when `rapidity` does.
