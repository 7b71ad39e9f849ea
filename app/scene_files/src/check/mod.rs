//! Scene check: a report on the contents of a scene, with warnings about likely mistakes.
//!
//! Notices come from the file (features that are not drawn). Warnings are found here, in the scene as it is drawn.
//! Neither keeps a scene from being shown.

mod descriptions;
mod report;
mod survey;
mod warnings;

pub use report::{CheckError, Report, check};
