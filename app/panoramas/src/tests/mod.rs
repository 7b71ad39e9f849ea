//! Tests of panoramas. Each file says which law it tests.

mod broken;
mod common_kinds;
mod cubes;
mod exr_file;
mod exr_kinds;
mod memory;
mod pictures;
mod radiance_kinds;
mod sphere_parts;
