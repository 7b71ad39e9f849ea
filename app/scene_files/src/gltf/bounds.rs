//! Bounds of a scene in its file's frame.

use glam::{DAffine3, DVec3};

use super::primitive::Primitive;

/// Distance from the file's origin, metres, up to which f32 keeps a quarter of a millimetre and positions stay as the
/// file has them.
const NEAR: f64 = 4096.0;

/// Bounding box of all finite vertices, in the file's frame.
pub(super) struct Bounds {
    least: DVec3,
    most: DVec3,
}

impl Default for Bounds {
    fn default() -> Self {
        Self { least: DVec3::INFINITY, most: DVec3::NEG_INFINITY }
    }
}

impl Bounds {
    pub(super) fn add(&mut self, primitive: &Primitive, transform: DAffine3) {
        for position in &primitive.positions {
            let position = transform.transform_point3(position.as_dvec3());
            if position.is_finite() {
                self.least = self.least.min(position);
                self.most = self.most.max(position);
            }
        }
    }

    fn is_empty(&self) -> bool {
        !self.least.cmple(self.most).all()
    }

    /// Origin for the scene: the file's own if f32 is fine enough there, else the middle of the box in whole metres.
    pub(super) fn origin(&self) -> DVec3 {
        if self.is_empty() || self.least.abs().max(self.most.abs()).max_element() <= NEAR {
            DVec3::ZERO
        } else {
            (0.5 * self.least + 0.5 * self.most).round()
        }
    }

    /// Least and greatest corner; `None` if there is no finite vertex.
    pub(super) fn corners(&self) -> Option<[DVec3; 2]> {
        (!self.is_empty()).then_some([self.least, self.most])
    }
}
