//! Import of displays described by other programs: MPCDI, ParaView's `.pvx`, Unreal's `.ndisplay`.

mod blank;
mod file_name;
mod letters;
pub(crate) mod mpcdi;
mod mpcdi_files;
mod mpcdi_frame;
pub(crate) mod ndisplay;
mod ndisplay_scene;
pub(crate) mod pvx;
mod xml;
