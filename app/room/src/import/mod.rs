//! Import of displays described by other programs: MPCDI and ParaView's `.pvx`.

mod file_name;
pub(crate) mod mpcdi;
pub(crate) mod pvx;
mod xml;
