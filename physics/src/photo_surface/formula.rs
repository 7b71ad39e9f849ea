//! The equations, written once for every vector width.
//!
//! Each form takes the offsets p of as many vertices as a register holds and gives the apparent positions and Doppler
//! factors. With d = p − o the displacement from the eye to the vertex, h and d⊥ its parts along and across the motion,
//! these are the equations of [`crate::light_cone`] in f32, with q = |d⊥|², A = κ ahead / 2, C = behind / (2κ):
//!
//! ```text
//! x' = d⊥ + (A − C) e    D = (A + C) / r
//! ```
//!
//! No difference in them cancels, so only d⊥ = d − h e can lose digits. Near astern, where x' is so short that they
//! matter, [`ExactAstern`] takes d⊥ = e × (d × e) with d and d × e in f64. It asks each register for vertices that lie
//! there: neighbours in a mesh mostly are neighbours in space, so that few registers have any.

use super::lanes::{Lanes, WideLanes, each};
use super::plan::{FramePlan, REAR_CONE_COTANGENT_SQUARED};

/// Length or squared length above which a result counts as not finite: the next operation might overflow.
const LARGEST: f32 = 1e38;

/// Lower limit of r (r + |h|), so that a vertex at the eye divides by something.
const SMALLEST: f32 = f32::MIN_POSITIVE;

/// Apparent positions of a register's worth of vertices.
pub(super) struct ApparentLanes<L> {
    /// Apparent position x', observer's rest frame, axes of the world after a pure boost; metres.
    pub(super) position: [L; 3],
    /// Doppler factor D.
    pub(super) doppler: L,
    /// Bits of the vertices whose numbers above are finite.
    pub(super) finite: u32,
}

impl<L: Lanes> ApparentLanes<L> {
    /// The result with zeros for vertices that are not finite.
    #[inline(always)]
    pub(super) fn collapsed(self) -> Self {
        let zero = L::splat(0.0);
        let [x, y, z] = self.position;
        Self {
            position: [zero.replaced(self.finite, x), zero.replaced(self.finite, y), zero.replaced(self.finite, z)],
            doppler: zero.replaced(self.finite, self.doppler),
            finite: self.finite,
        }
    }
}

/// A formula with its constants spread over registers.
pub(super) trait Formula<L: Lanes> {
    fn new(plan: &FramePlan) -> Self;
    fn seen(&self, vertex: [L; 3]) -> ApparentLanes<L>;
}

/// Offset of the eye from the mesh's origin, as f32 high and low parts, 48 bits together.
struct LaneOffset<L> {
    high: [L; 3],
    low: [L; 3],
}

impl<L: Lanes> LaneOffset<L> {
    #[inline(always)]
    fn new(plan: &FramePlan) -> Self {
        let high = plan.offset.as_vec3();
        let low = (plan.offset - high.as_dvec3() + plan.offset_rest).as_vec3();
        Self { high: each!(L::splat, high.to_array()), low: each!(L::splat, low.to_array()) }
    }

    /// Displacement d = (p − o_high) − o_low.
    #[inline(always)]
    fn displacement(&self, [x, y, z]: [L; 3]) -> [L; 3] {
        [x - self.high[0] - self.low[0], y - self.high[1] - self.low[1], z - self.high[2] - self.low[2]]
    }
}

/// The formula for an eye at rest: x' = d and D = 1.
pub(super) struct AtRest<L>(LaneOffset<L>);

impl<L: Lanes> Formula<L> for AtRest<L> {
    #[inline(always)]
    fn new(plan: &FramePlan) -> Self {
        Self(LaneOffset::new(plan))
    }

    #[inline(always)]
    fn seen(&self, vertex: [L; 3]) -> ApparentLanes<L> {
        let position = self.0.displacement(vertex);
        let size = position[0].abs() + position[1].abs() + position[2].abs();
        ApparentLanes { position, doppler: L::splat(1.0), finite: size.below(L::splat(LARGEST)) }
    }
}

/// Direction of motion and κ, and the steps that both moving forms share.
struct LaneBoost<L> {
    direction: [L; 3],
    half_kappa: L,
    half_over_kappa: L,
}

impl<L: Lanes> LaneBoost<L> {
    #[inline(always)]
    fn new(plan: &FramePlan) -> Self {
        Self {
            direction: each!(L::splat, plan.direction.as_vec3().to_array()),
            half_kappa: L::splat((plan.kappa / 2.0) as f32),
            half_over_kappa: L::splat((0.5 / plan.kappa) as f32),
        }
    }

    /// Part along the motion, h = e·d.
    #[inline(always)]
    fn along(&self, [x, y, z]: [L; 3]) -> L {
        let [ex, ey, ez] = self.direction;
        z.mul_add(ez, y.mul_add(ey, x * ex))
    }

    /// Scales the light-cone coordinates, and puts x' and D together from them.
    #[inline(always)]
    fn seen(&self, along: L, across: [L; 3]) -> ApparentLanes<L> {
        let [ax, ay, az] = across;
        let across_squared = length_squared(across);
        let distance = along.mul_add(along, across_squared).sqrt();

        // One division serves both q / (r + |h|) and 1 / r.
        let big = distance + along.abs();
        let product = big * distance;
        let inverse = L::splat(1.0) / product.or_at_least(L::splat(SMALLEST));
        let small = across_squared * (distance * inverse);

        let advanced = along.if_negative(small, big) * self.half_kappa;
        let retarded = along.if_negative(big, small) * self.half_over_kappa;
        let lengthened = advanced - retarded;
        let apparent_distance = advanced + retarded;
        let [ex, ey, ez] = self.direction;
        ApparentLanes {
            position: [lengthened.mul_add(ex, ax), lengthened.mul_add(ey, ay), lengthened.mul_add(ez, az)],
            doppler: apparent_distance * (big * inverse),
            finite: (apparent_distance + product).below(L::splat(LARGEST)),
        }
    }
}

/// The light-cone form in f32.
pub(super) struct LightCone<L> {
    offset: LaneOffset<L>,
    boost: LaneBoost<L>,
}

impl<L: Lanes> LightCone<L> {
    /// Parts along and across the motion, h and d⊥ = d − h e.
    #[inline(always)]
    fn along_and_across(&self, vertex: [L; 3]) -> (L, [L; 3]) {
        let displacement = self.offset.displacement(vertex);
        let along = self.boost.along(displacement);
        let [x, y, z] = displacement;
        let [ex, ey, ez] = self.boost.direction;
        let across = [along.negated_mul_add(ex, x), along.negated_mul_add(ey, y), along.negated_mul_add(ez, z)];
        (along, across)
    }
}

impl<L: Lanes> Formula<L> for LightCone<L> {
    #[inline(always)]
    fn new(plan: &FramePlan) -> Self {
        Self { offset: LaneOffset::new(plan), boost: LaneBoost::new(plan) }
    }

    #[inline(always)]
    fn seen(&self, vertex: [L; 3]) -> ApparentLanes<L> {
        let (along, across) = self.along_and_across(vertex);
        self.boost.seen(along, across)
    }
}

/// The light-cone form, accurate in every direction.
pub(super) struct ExactAstern<L: Lanes> {
    light_cone: LightCone<L>,
    offset: [L::Wide; 3],
    offset_rest: [L::Wide; 3],
    direction: [L::Wide; 3],
}

impl<L: Lanes> ExactAstern<L> {
    /// Bits of the vertices in the rear cone.
    #[inline(always)]
    fn astern(along: L, across: [L; 3]) -> u32 {
        let steepness = L::splat(REAR_CONE_COTANGENT_SQUARED);
        length_squared(across).mul_add(steepness, along * along.abs()).below(L::splat(0.0))
    }

    /// Part across the motion, d⊥ = e × (d × e), with d and d × e in f64.
    #[inline(always)]
    fn across(&self, vertex: [L; 3]) -> [L; 3] {
        let [x, y, z] = each!(L::widen, vertex);
        let [ox, oy, oz] = self.offset;
        let [rx, ry, rz] = self.offset_rest;
        let displacement = [x - ox - rx, y - oy - ry, z - oz - rz];
        let moment = cross_wide::<L>(displacement, self.direction);
        cross(self.light_cone.boost.direction, moment)
    }
}

impl<L: Lanes> Formula<L> for ExactAstern<L> {
    #[inline(always)]
    fn new(plan: &FramePlan) -> Self {
        Self {
            light_cone: LightCone::new(plan),
            offset: each!(L::Wide::splat, plan.offset.to_array()),
            offset_rest: each!(L::Wide::splat, plan.offset_rest.to_array()),
            direction: each!(L::Wide::splat, plan.direction.to_array()),
        }
    }

    #[inline(always)]
    fn seen(&self, vertex: [L; 3]) -> ApparentLanes<L> {
        let (along, mut across) = self.light_cone.along_and_across(vertex);
        let astern = Self::astern(along, across);
        if astern != 0 {
            let ([x, y, z], [exact_x, exact_y, exact_z]) = (across, self.across(vertex));
            across = [x.replaced(astern, exact_x), y.replaced(astern, exact_y), z.replaced(astern, exact_z)];
        }
        self.light_cone.boost.seen(along, across)
    }
}

/// Squared length |a|².
#[inline(always)]
fn length_squared<L: Lanes>([x, y, z]: [L; 3]) -> L {
    z.mul_add(z, y.mul_add(y, x * x))
}

/// Cross product a × b in f64, rounded to f32 at the end.
#[inline(always)]
fn cross_wide<L: Lanes>([ax, ay, az]: [L::Wide; 3], [bx, by, bz]: [L::Wide; 3]) -> [L; 3] {
    [L::narrow(ay.mul_sub(bz, az * by)), L::narrow(az.mul_sub(bx, ax * bz)), L::narrow(ax.mul_sub(by, ay * bx))]
}

/// Cross product a × b in f32.
#[inline(always)]
fn cross<L: Lanes>([ax, ay, az]: [L; 3], [bx, by, bz]: [L; 3]) -> [L; 3] {
    [az.negated_mul_add(by, ay * bz), ax.negated_mul_add(bz, az * bx), ay.negated_mul_add(bx, ax * by)]
}
