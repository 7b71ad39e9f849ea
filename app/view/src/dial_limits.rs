//! Limits of a dial by which a ride is drawn, whichever text it comes from.

use crate::dial::{Dial, RendererName, Transform};
use std::fmt::{self, Display, Formatter};

/// Setting of a dial by which no ride can be drawn.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct DialFault {
    /// Name of the setting.
    pub key: &'static str,
    /// Sentence on what is wrong and what was expected.
    pub told: String,
}

impl std::error::Error for DialFault {}

impl Display for DialFault {
    fn fmt(&self, formatter: &mut Formatter<'_>) -> fmt::Result {
        formatter.write_str(&self.told)
    }
}

impl Dial {
    /// Checks that a ride can be drawn by this dial, with the limits of the command line.
    ///
    /// # Errors
    /// [`DialFault`] of the first setting that is out of its limits.
    pub fn check_for_ride(&self) -> Result<(), DialFault> {
        let fault = |key, told| Err(DialFault { key, told });
        if self.renderer == RendererName::Raytrace {
            let told = "renderer is \"raytrace\", which is too slow for a ride: expected auto, polygon or image";
            return fault("renderer", told.to_owned());
        }
        let limits = [
            ("edge", self.edge, f64::MIN_POSITIVE, f64::MAX),
            ("tolerance", self.tolerance, 0.01, 100.0),
            ("map-scale", self.map_scale, 0.1, 16.0),
        ];
        for (key, value, least, most) in limits {
            if let Some(value) = value.filter(|value| !(least..=most).contains(value)) {
                let expected = if key == "edge" {
                    "a finite number above 0".to_owned()
                } else {
                    format!("a number from {least} to {most}")
                };
                return fault(key, format!("{key} is {value}: expected {expected}"));
            }
        }
        if self.edge.is_some() && self.tolerance.is_some() {
            return fault("tolerance", "edge and tolerance exclude each other".to_owned());
        }
        if self.transform == Some(Transform::Gpu) && self.edge.is_none() {
            let told = "transform is \"gpu\", which needs edge, as on the command line";
            return fault("transform", told.to_owned());
        }
        Ok(())
    }
}
