//! Options of comfort in a headset.

use clap::Args;
use input::head::Stance;
use presentation::Vignette;

use super::values;

/// Options of comfort in a headset, for the rider or for whoever watches a recorded ride.
#[derive(Args, Clone, Copy, Debug, Default, PartialEq)]
#[command(next_help_heading = "Comfort")]
pub struct ComfortOptions {
    /// Darkening of the edges of a headset's pictures while the vehicle accelerates or turns, which its rider sees and
    /// does not feel.
    #[arg(long, value_enum, default_value = "off", value_name = "STRENGTH")]
    pub vignette: Vignette,
    /// Step by which a flick of the other hand's stick turns the rider in the vehicle, degrees up to 180; 0 for none
    /// [default: 30, or that of the set-up].
    #[arg(long, value_name = "DEGREES", value_parser = values::within(0.0, 180.0))]
    pub snap_turn: Option<f64>,
    /// Stance of the rider: seated, where the first place of the head is the driver's seat at its height, or standing,
    /// where the vehicle's floor is the room's and heights stay [default: seated, or that of the set-up].
    #[arg(long, value_name = "STANCE")]
    pub stance: Option<Stance>,
    /// Lines that rest in the vehicle about the rider, in a headset or a room of several screens: on or off [default:
    /// on in a headset, else off].
    #[arg(long, value_name = "SWITCH", value_parser = values::on_off)]
    pub cockpit: Option<bool>,
}
