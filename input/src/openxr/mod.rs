//! OpenXR: headsets and hand controllers, through any runtime, with one interface.
//!
//! A sample is one report ([`XrReport`]): the poses of the head and of both hands at one moment, and what the hands
//! hold. It is this program's own format, because a runtime answers questions and sends nothing. Everything that a
//! ride takes from the runtime passes as such reports, so a recording replays without runtime and headset.
//!
//! The axes are those of the runtime's stage (x right, y up, z backward; the origin on the floor), metres.
//!
//! | sensor | is |
//! |---|---|
//! | 0 | the head |
//! | 1, 2 | the left and the right hand, where it aims |

mod decoder;
mod hands;
mod report;
mod runtime;

pub use decoder::OpenxrDecoder;
pub use hands::XrHands;
pub use report::{REPORT_LENGTH, RIGHT_HAND, TRIGGER_AXIS, XrHand, XrPose, XrReport, XrReportError};
pub use runtime::{XrFault, XrNews, XrRuntime, XrState, XrUse};
