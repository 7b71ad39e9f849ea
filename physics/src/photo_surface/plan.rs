//! Constants of a frame for the kernel, computed once in f64.
//!
//! A boost scales the two light-cone coordinates of an emission event by κ = γ + |u| and 1/κ and leaves the part
//! across the motion alone ([`crate::light_cone`]). All that a frame needs is κ, the direction of motion e, and the
//! position of the eye relative to each mesh's origin.

use glam::DVec3;

use super::eye::PhotoSurfaceEye;
use super::sphere::BoundingSphere;
use crate::double_double::DoubleDoubleVec3;

/// Least D for which the f32 form serves: its direction error is a few roundings divided by D.
///
/// D = γ − |u| cos δ at an angle δ off astern. Over all directions the least D is 1/κ, so that a slow eye needs
/// nothing else; over all speeds it is sin δ, so that at any speed the f32 form serves outside a cone of 14.5° astern.
const LEAST_DOPPLER: f64 = 0.25;

/// Square of h / |d⊥| on the surface of that cone: 1 / sin² δ − 1.
pub(super) const REAR_CONE_COTANGENT_SQUARED: f32 = (1.0 / (LEAST_DOPPLER * LEAST_DOPPLER) - 1.0) as f32;

/// Formula for a chunk.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum FormulaChoice {
    /// A shift of the positions, exactly, for an eye at rest.
    AtRest,
    /// The light-cone form in f32.
    LightCone,
    /// The light-cone form with the part across the motion in f64 for vertices in the rear cone.
    ExactAstern,
}

/// Constants of a frame for one mesh.
#[derive(Clone, Copy, Debug)]
pub(super) struct FramePlan {
    /// Position of the eye relative to the mesh's origin, metres.
    pub(super) offset: DVec3,
    /// Remainder of the rounding of `offset`: it counts if the eye is near a vertex and both are far from the origin.
    pub(super) offset_rest: DVec3,
    /// Direction of motion e = u/|u|, zero at rest.
    pub(super) direction: DVec3,
    /// κ = γ + |u|.
    pub(super) kappa: f64,
}

impl FramePlan {
    /// Constants for a mesh whose coordinates are relative to `origin` (world frame, metres).
    pub(super) fn new(eye: &PhotoSurfaceEye, origin: DVec3) -> Self {
        let celerity = eye.celerity();
        let offset = DoubleDoubleVec3::difference(eye.position(), origin);
        Self {
            offset: offset.high,
            offset_rest: offset.low,
            direction: celerity.direction().unwrap_or(DVec3::ZERO),
            kappa: celerity.kappa(),
        }
    }

    /// The cheapest formula that is accurate everywhere in `sphere`.
    pub(super) fn form(&self, sphere: &BoundingSphere) -> FormulaChoice {
        if self.direction == DVec3::ZERO {
            FormulaChoice::AtRest
        } else if self.kappa * LEAST_DOPPLER > 1.0 && self.touches_rear_cone(sphere) {
            FormulaChoice::ExactAstern
        } else {
            FormulaChoice::LightCone
        }
    }

    /// True if the distance from the rear cone, whose tip is the eye, to the sphere's centre is within its radius.
    fn touches_rear_cone(&self, sphere: &BoundingSphere) -> bool {
        let centre = sphere.centre - self.offset;
        let astern = -centre.dot(self.direction);
        let across = centre.cross(self.direction).length();
        let cosine = (1.0 - LEAST_DOPPLER * LEAST_DOPPLER).sqrt();
        let tip_is_nearest = astern * cosine + across * LEAST_DOPPLER < 0.0;
        let distance = if tip_is_nearest { centre.length() } else { across * cosine - astern * LEAST_DOPPLER };
        distance <= sphere.radius
    }
}

#[cfg(test)]
mod tests {
    //! Law: each chunk gets the cheapest formula that keeps its directions. A wrong choice would spend f64 work on
    //! what lies ahead, or, worse, leave vertices astern to the form that loses their direction.

    use super::*;
    use crate::celerity::Celerity;
    use crate::observer::Observer;

    fn moving_along_x(celerity: f64) -> FramePlan {
        let observer = Observer { celerity: Celerity::from_finite(DVec3::X * celerity), ..Observer::default() };
        FramePlan::new(&PhotoSurfaceEye::from(&observer), DVec3::ZERO)
    }

    fn sphere(x: f64, y: f64, radius: f64) -> BoundingSphere {
        BoundingSphere { centre: DVec3::new(x, y, 0.0), radius }
    }

    #[test]
    fn three_four_five_gives_kappa_two() {
        let plan = moving_along_x(0.75);
        assert_eq!(plan.kappa, 2.0);
        assert_eq!(plan.direction, DVec3::X);
    }

    #[test]
    fn only_what_touches_the_rear_cone_is_taken_exactly() {
        let plan = moving_along_x(100.0);
        assert_eq!(plan.form(&sphere(10.0, 0.0, 9.0)), FormulaChoice::LightCone, "ahead");
        assert_eq!(plan.form(&sphere(10.0, 0.0, 11.0)), FormulaChoice::ExactAstern, "around the eye");
        assert_eq!(plan.form(&sphere(-10.0, 0.0, 0.0)), FormulaChoice::ExactAstern, "dead astern");
        let edge = 10.0 * LEAST_DOPPLER.asin().tan();
        assert_eq!(plan.form(&sphere(-10.0, edge * 0.999, 0.0)), FormulaChoice::ExactAstern, "inside the edge");
        assert_eq!(plan.form(&sphere(-10.0, edge * 1.001, 0.0)), FormulaChoice::LightCone, "outside the edge");
        assert_eq!(plan.form(&sphere(-10.0, edge + 2.0, 1.9)), FormulaChoice::LightCone, "beside the cone");
        assert_eq!(plan.form(&sphere(-10.0, edge + 2.0, 2.1)), FormulaChoice::ExactAstern, "reaching into the cone");
    }

    #[test]
    fn slow_eyes_and_resting_eyes_take_the_cheap_forms() {
        assert_eq!(moving_along_x(1.8).form(&sphere(-10.0, 0.0, 1.0)), FormulaChoice::LightCone);
        assert_eq!(moving_along_x(0.0).form(&sphere(-10.0, 0.0, 1.0)), FormulaChoice::AtRest);
    }

    #[test]
    fn celerities_of_any_size_have_a_direction() {
        // The largest is that of two celerities at their limit, one after the other.
        for size in [f64::MIN_POSITIVE * f64::EPSILON, 1e-200, Celerity::LIMIT, 2.0 * Celerity::LIMIT * Celerity::LIMIT]
        {
            let plan = moving_along_x(size);
            assert_eq!(plan.direction, DVec3::X, "|u| = {size:e}");
            assert!(plan.kappa >= 1.0, "|u| = {size:e}: kappa {}", plan.kappa);
        }
    }
}
