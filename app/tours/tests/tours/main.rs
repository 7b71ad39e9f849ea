//! Tests of the tours from outside: their files and their rides.

mod files;
mod rides;
