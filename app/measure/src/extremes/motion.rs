//! Motion under constant thrust and turn rate in closed form: one matrix exponential, at 180 digits.
//!
//! The tetrad, a Lorentz matrix from the pilot's frame to the world's, obeys dΛ/dτ = Λ G, with a constant G of the
//! proper acceleration and the turn rate. The place obeys dX/dτ = Λ e₀. Together they are one linear equation for
//! five-by-five matrices. The quaternions, celerities and Wigner rotations of the program's own steps do not occur.

use glam::{DQuat, DVec3};
use physics::worldline::{Thrust, WorldlineState};

use exact_reference::real::{Real, RealVec, gamma, real, to_f64};

/// Matrix on (t, x, y, z, 1): a tetrad with its event.
#[derive(Clone, Debug)]
pub struct Motion([[Real; 5]; 5]);

impl Motion {
    fn from_fn(f: impl Fn(usize, usize) -> Real) -> Self {
        Self(std::array::from_fn(|row| std::array::from_fn(|column| f(row, column))))
    }

    fn identity() -> Self {
        Self::from_fn(|row, column| real(if row == column { 1.0 } else { 0.0 }))
    }

    /// Tetrad and event of a state, with its quaternion normalised.
    pub fn at(state: &WorldlineState) -> Self {
        let u = RealVec::new(state.celerity.vector());
        let gamma = gamma(&u);
        let boost = boost(&u, &gamma);
        let turn = rotation(state.orientation);
        let turn = Self::from_fn(|row, column| match (row, column) {
            (1..=3, 1..=3) => turn[row - 1][column - 1].clone(),
            _ => real(if row == column { 1.0 } else { 0.0 }),
        });
        let mut motion = boost.then(&turn);
        motion.0[0][4] = real(state.ct);
        for (axis, place) in state.position.to_array().into_iter().enumerate() {
            motion.0[axis + 1][4] = real(place);
        }
        motion
    }

    /// Motion exp(τ G), in the frame in which it starts. A Taylor series covers a part of τ so short that 100 terms
    /// are more than enough; the result is then squared.
    pub fn under(thrust: &Thrust, tau: &Real) -> Self {
        const TERMS: u32 = 100;
        const SHORT: f64 = 0.25;
        let (a, [x, y, z]) = (thrust.acceleration.to_array(), thrust.turn_rate.to_array());
        let generator = Self::from_fn(|row, column| {
            real(match (row, column) {
                (0, 1..=3) => a[column - 1],
                (1..=3, 0) => a[row - 1],
                (2, 3) => -x,
                (3, 2) => x,
                (3, 1) => -y,
                (1, 3) => y,
                (1, 2) => -z,
                (2, 1) => z,
                (0, 4) => 1.0,
                _ => 0.0,
            })
        });
        let rate = 1.0 + thrust.acceleration.length() + thrust.turn_rate.length();
        let halvings = (to_f64(tau).abs() * rate / SHORT).max(1.0).log2().ceil() as u32;
        let part = tau / real(2.0_f64.powi(halvings as i32));

        let (mut sum, mut term) = (Self::identity(), Self::identity());
        for order in 1..=TERMS {
            let factor = &part / real(f64::from(order));
            let next = term.then(&generator);
            term = Self::from_fn(|row, column| &next.0[row][column] * &factor);
            sum = Self::from_fn(|row, column| &sum.0[row][column] + &term.0[row][column]);
        }
        for _ in 0..halvings {
            sum = sum.then(&sum);
        }
        sum
    }

    /// This motion followed by another, which is given in the frame in which this one ends.
    pub fn then(&self, next: &Self) -> Self {
        Self::from_fn(|row, column| {
            (0..5).fold(real(0.0), |sum, inner| sum + &self.0[row][inner] * &next.0[inner][column])
        })
    }

    /// Celerity u.
    pub fn celerity(&self) -> RealVec {
        RealVec([1, 2, 3].map(|axis| self.0[axis][0].clone()))
    }

    /// Time ct, metres of light travel.
    pub fn ct(&self) -> &Real {
        &self.0[0][4]
    }

    /// Place in the world.
    pub fn position(&self) -> RealVec {
        RealVec([1, 2, 3].map(|axis| self.0[axis][4].clone()))
    }

    /// Angle between this motion's orientation and a computed one, radians.
    pub fn turn_from(&self, computed: DQuat) -> f64 {
        let u = self.celerity();
        let rest = &u * &real(-1.0);
        let exact = boost(&rest, &gamma(&u)).then(self);
        let computed = rotation(computed);
        // The remaining rotation is exactᵀ computed; twice the sine of its angle is the length of its antisymmetric
        // part.
        let left = |row: usize, column: usize| {
            (0..3).fold(real(0.0), |sum, inner| sum + &exact.0[inner + 1][row + 1] * &computed[inner][column])
        };
        let sine = RealVec([left(2, 1) - left(1, 2), left(0, 2) - left(2, 0), left(1, 0) - left(0, 1)]).length();
        let trace = left(0, 0) + left(1, 1) + left(2, 2);
        (0.5 * to_f64(&sine)).atan2(0.5 * (to_f64(&trace) - 1.0))
    }
}

fn boost(u: &RealVec, gamma: &Real) -> Motion {
    let inverse = real(1.0) / (real(1.0) + gamma);
    Motion::from_fn(|row, column| match (row, column) {
        (0, 0) => gamma.clone(),
        (0, 1..=3) => u.0[column - 1].clone(),
        (1..=3, 0) => u.0[row - 1].clone(),
        (1..=3, 1..=3) => {
            let one = real(if row == column { 1.0 } else { 0.0 });
            one + &u.0[row - 1] * &u.0[column - 1] * &inverse
        }
        _ => real(if row == column { 1.0 } else { 0.0 }),
    })
}

/// Rotation matrix of a quaternion of any length.
fn rotation(quaternion: DQuat) -> [[Real; 3]; 3] {
    let vector = RealVec::new(quaternion.xyz());
    let scalar = real(quaternion.w);
    let squared = &scalar * &scalar + vector.dot(&vector);
    let columns = [DVec3::X, DVec3::Y, DVec3::Z].map(|axis| {
        // Rotation of a vector: v + 2 (w q × v + q × (q × v)) / |quaternion|².
        let axis = RealVec::new(axis);
        let across = vector.cross(&axis);
        let sum = &(&across * &scalar) + &vector.cross(&across);
        &axis + &(&sum * &(real(2.0) / &squared))
    });
    std::array::from_fn(|row| std::array::from_fn(|column| columns[column].0[row].clone()))
}
