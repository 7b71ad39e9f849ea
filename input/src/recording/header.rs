//! Header of a recording, and the names that mark a file of this program.

use std::collections::BTreeMap;

use serde::{Deserialize, Serialize};

use crate::action::VehicleKind;
use crate::config::DeskConfig;

/// MCAP profile of this program's files.
pub(super) const PROFILE: &str = "rapidity";
/// Name of the metadata record with the header.
pub(super) const METADATA: &str = "rapidity";
/// Version of the format; counts up when older programs could not read it.
pub(super) const VERSION: &str = "2";
/// Version in which samples were texts, and messages were told apart by MCAP's sequence numbers. It is read still.
pub(super) const FIRST_VERSION: &str = "1";
/// Key of the format's version in the metadata.
pub(super) const KEY_VERSION: &str = "format_version";
/// Key of the header, as JSON.
pub(super) const KEY_HEADER: &str = "header";
/// Key of the header's CRC-32, eight hexadecimal digits.
pub(super) const KEY_CHECKSUM: &str = "header_crc32";

/// Everything that a ride depends on besides its samples.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct RideHeader {
    /// Version of the program that recorded.
    pub build: String,
    /// Scene: a file or the name of a built-in one.
    pub scene: String,
    /// Speed of light in the world at the start, m/s.
    pub speed_of_light_m_s: f64,
    /// Vehicle at the start.
    pub vehicle: VehicleKind,
    /// Name of the integrator.
    pub integrator: String,
    /// Step of the integrator, seconds of proper time.
    pub step_s: f64,
    /// Settings of the decoders.
    pub desk: DeskConfig,
    /// Other settings that decide the ride, by name: the seed of a built-in scene, the place of the start.
    pub settings: BTreeMap<String, String>,
}
