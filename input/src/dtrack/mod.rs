//! ART DTrack: one UDP datagram of ASCII lines for every frame of the cameras.
//!
//! | line | holds |
//! |---|---|
//! | `ts2 S US LATENCY` | seconds since 1970 and microseconds of the measurement, and latency until sending, µs |
//! | `ts S` | the same by older controllers: seconds since midnight |
//! | `6d N [id q][x y z a b c][r0 … r8] …` | N bodies: number, quality, position in mm, angles, matrix by columns |
//! | `6di N [id s e][x y z][r0 … r8] …` | N inertial bodies: number, state, drift in degrees, position, matrix |
//! | `6df2 C N [id q b j][x y z][r0 … r8][bits … axes …] …` | N flysticks with b buttons, 32 a word, and j axes |
//! | `6df N [id q bits][x y z a b c][r0 … r8] …` | the same by older controllers: eight buttons, no axes |
//!
//! All other lines (`fr`, `6dcal`, `3d`, …) are passed over. A body that the cameras do not see is not in the
//! `6d` line, or has quality −1; an inertial one has state 0. The matrices are used, not the angles.
//!
//! ```
//! use input::decoder::{Actions, Decoder};
//! use input::dtrack::DtrackDecoder;
//!
//! let mut decoder = DtrackDecoder::default();
//! let frame = b"fr 1\r\n6d 1 [0 1.000][100.0 200.0 300.0 0 0 0][1 0 0 0 1 0 0 0 1]\r\n";
//! decoder.bytes(0, frame, &mut Actions::default());
//! assert_eq!(decoder.take_poses()[0].position_m.to_array(), [0.1, 0.2, 0.3]);
//! ```

mod bodies;
pub(crate) mod decoder;
mod flysticks;
pub mod wire;

pub use decoder::DtrackDecoder;
pub use wire::{DtrackError, LONGEST_DATAGRAM, PORT};
