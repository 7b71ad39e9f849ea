//! Tests of the crate `room`, one module a subject.

mod built_in;
mod check;
mod containers;
mod dome;
mod file;
mod hostile;
mod import;
mod mpcdi_poses;
mod ndisplay;
mod paraview;
mod projectors;
mod surfaces;
mod window_sizes;
