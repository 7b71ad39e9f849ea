//! Animated body: a chain of transforms from the file's frame down to the body's own, and its derivative.
//!
//! A point p of the body is at x = M p at each moment of the world, and moves at β = M' p, with M' from the product
//! rule along the chain. Both are exact functions of time, so the retarded event can be solved for to the last bits
//! ([`super::ObservedBody`]).
//!
//! The chain may begin in the frame of a uniformly moving object, its carrier, instead of the world's: the hands of a
//! clock on a train turn by the train's time. There the retarded event is solved for, so each point of a hand is seen
//! as the train's time at that point has it.

use glam::{DAffine3, DMat3, DQuat, DVec3};
use physics::retarded::Worldline;
use physics::{Beta, Event, compose};

use super::track::Track;
use super::uniform::Uniform;

/// Default speed of light, m/s: the real one, until a scene sets another.
const SPEED_OF_LIGHT_M_S: f64 = 299_792_458.0;

/// Animated body: its motion is given by keys.
#[derive(Clone, Debug, PartialEq)]
pub struct Animated {
    /// Name of the last node of the chain, for messages.
    pub name: String,
    /// Transforms from the root down; the last one's own frame is the body's.
    links: Vec<ChainLink>,
    pub(crate) speed_of_light_m_s: f64,
    /// Bounding ball of the whole body, in its own frame.
    pub(crate) ball: Ball,
    /// Motion of the frame in which the chain begins; `None` for the world.
    carrier: Option<Uniform>,
    /// True for clockwork, see [`Animated::as_clockwork`].
    is_clockwork: bool,
}

/// Transform of a chain.
#[derive(Clone, Debug, PartialEq)]
pub enum ChainLink {
    /// Constant transform.
    Fixed(DAffine3),
    /// Transform that changes with time.
    Keyed(Keyed),
}

/// Transform of an animated node: translation · rotation · scale.
#[derive(Clone, Debug, PartialEq)]
pub struct Keyed {
    /// Translation, metres.
    pub translation: Track<DVec3>,
    /// Rotation from the node's axes to its parent's.
    pub rotation: Track<DQuat>,
    /// Scale factors.
    pub scale: Track<DVec3>,
}

/// Ball given by centre and radius.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Ball {
    /// Centre of the ball, metres.
    pub centre: DVec3,
    /// Radius of the ball, metres.
    pub radius: f64,
}

/// Pose of a body at one moment, and its rate of change.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Pose {
    /// Transform from the body's frame to the world, metres.
    pub world_from_body: DAffine3,
    /// Change of the transform per metre of light travel.
    pub rate: DAffine3,
}

impl Pose {
    /// World position of a point of the body, metres.
    pub fn position(&self, place: DVec3) -> DVec3 {
        self.world_from_body.transform_point3(place)
    }

    /// Velocity of a point of the body as v/c, world axes.
    pub fn beta(&self, place: DVec3) -> DVec3 {
        self.rate.transform_point3(place)
    }

    /// Body's axes in the world, orthogonal, each of length 1, without scale or shear; mirrored if the body is
    /// mirrored.
    pub fn axes(&self) -> DMat3 {
        let DMat3 { x_axis, y_axis, z_axis } = self.world_from_body.matrix3;
        let x = x_axis.normalize_or(DVec3::X);
        let y = y_axis.reject_from_normalized(x).normalize_or(x.any_orthonormal_vector());
        let z = x.cross(y);
        DMat3::from_cols(x, y, if z.dot(z_axis) < 0.0 { -z } else { z })
    }
}

impl Keyed {
    /// Largest magnitude of each scale factor.
    fn largest_scale(&self) -> DVec3 {
        let [least, most] = self.scale.bounds();
        least.abs().max(most.abs())
    }

    /// Transform at `time_s`, and its change per second.
    fn at(&self, time_s: f64) -> (DAffine3, DAffine3) {
        let (translation, velocity) = self.translation.at(time_s);
        let (rotation, turn) = self.rotation.at(time_s);
        let rotation = DMat3::from_quat(rotation);
        let (scale, growth) = self.scale.at(time_s);
        let [scale, growth] = [scale, growth].map(DMat3::from_diagonal);
        // Matrix [ω]×, column by column.
        let spin = DMat3::from_cols(turn.cross(DVec3::X), turn.cross(DVec3::Y), turn.cross(DVec3::Z));
        (
            DAffine3 { matrix3: rotation * scale, translation },
            DAffine3 { matrix3: rotation * (spin * scale + growth), translation: velocity },
        )
    }
}

impl Animated {
    /// Makes a body of this name at the end of a chain.
    pub fn new(name: impl Into<String>, links: Vec<ChainLink>) -> Self {
        let (speed_of_light_m_s, ball) = (SPEED_OF_LIGHT_M_S, Ball::default());
        Self { name: name.into(), links, speed_of_light_m_s, ball, carrier: None, is_clockwork: false }
    }

    /// Body whose chain begins in the frame of a uniformly moving object. Keys are then times of that frame, which
    /// shows the world's time at the anchor.
    pub fn aboard(self, carrier: Uniform) -> Self {
        Self { carrier: Some(carrier), ..self }
    }

    /// Small, slow, luminous body that shows its side +z, as the hand of a clock on a wall.
    ///
    /// A map of the world then holds it, in the pose that fits what is shown ([`Animated::pose_shown`]), so it costs
    /// next to nothing. What is left out there is the shift of its light by its own speed; other ways of
    /// drawing have it.
    pub fn as_clockwork(self) -> Self {
        Self { is_clockwork: true, ..self }
    }

    /// True for a small, slow, luminous body that shows its side +z.
    pub fn is_clockwork(&self) -> bool {
        self.is_clockwork
    }

    /// True for clockwork that no carrier takes along: a map of the world holds it.
    pub fn stands_in_maps(&self) -> bool {
        self.is_clockwork && self.carrier.is_none()
    }

    /// Motion of the frame in which the chain begins; `None` for the world.
    pub fn carrier(&self) -> Option<&Uniform> {
        self.carrier.as_ref()
    }

    /// Transforms of the chain, from the root down.
    pub fn links(&self) -> &[ChainLink] {
        &self.links
    }

    /// Bounding ball of the whole body in its own frame, as last set by the scene.
    pub fn ball(&self) -> Ball {
        self.ball
    }

    /// Speed of light in the body's world, m/s.
    pub fn speed_of_light_m_s(&self) -> f64 {
        self.speed_of_light_m_s
    }

    /// Pose in the world at world time `ct`, metres of light travel.
    ///
    /// *Accuracy:* exact without a carrier. With one, the whole body is in the pose that it has by the carrier's time
    /// at the middle of its ball, contracted along the motion; other points are earlier or later by β·x'.
    pub fn at(&self, ct: f64) -> Pose {
        match &self.carrier {
            None => self.in_carrier(ct),
            Some(carrier) => self.world_pose(carrier, self.own_ct(carrier, ct)),
        }
    }

    /// Time of the carrier's frame at the middle of the ball at world time `ct`, metres: the root of
    /// γ (t' − a + β·(x'(t') − x_a)) = ct − a.
    fn own_ct(&self, carrier: &Uniform, ct: f64) -> f64 {
        /// Steps that double precision takes, however fast the middle moves.
        const STEPS: usize = 30;
        let (beta, gamma) = (carrier.celerity.beta().vector(), carrier.celerity.gamma());
        let anchor = carrier.anchor;
        let mut own = anchor.ct + (ct - anchor.ct) / gamma;
        for _ in 0..STEPS {
            let pose = self.in_carrier(own);
            let away = pose.position(self.ball.centre) - anchor.position;
            let late = (own - anchor.ct) + beta.dot(away) - (ct - anchor.ct) / gamma;
            let next = own - late / (1.0 + beta.dot(pose.beta(self.ball.centre)));
            if next == own || !next.is_finite() {
                break;
            }
            own = next;
        }
        own
    }

    /// Pose in the world when the carrier's clocks at the middle of the ball show `own`.
    fn world_pose(&self, carrier: &Uniform, own: f64) -> Pose {
        let pose = self.in_carrier(own);
        let centre = pose.position(self.ball.centre);
        let there = carrier.world_from_own(Event { ct: own, position: centre });
        let along = carrier.celerity.direction().unwrap_or(DVec3::ZERO);
        let gamma = carrier.celerity.gamma();
        let shorter = DMat3::from_cols(along * along.x, along * along.y, along * along.z) * (1.0 - 1.0 / gamma);
        let contraction = DMat3::IDENTITY - shorter;
        let matrix3 = contraction * pose.world_from_body.matrix3;
        let translation = there.position - matrix3 * self.ball.centre;
        // Both velocities of the middle, and the turn about it, slower by the world's time for each of the carrier's.
        let own_beta = pose.beta(self.ball.centre);
        let pace = 1.0 / (gamma * (1.0 + carrier.celerity.beta().vector().dot(own_beta)));
        let turn = contraction * pose.rate.matrix3 * pace;
        let own_celerity = Beta::new(own_beta).map(Beta::celerity).unwrap_or_default();
        let middle = compose(carrier.celerity, own_celerity).celerity.beta().vector();
        Pose {
            world_from_body: DAffine3 { matrix3, translation },
            rate: DAffine3 { matrix3: turn, translation: middle - turn * self.ball.centre },
        }
    }

    /// Pose in the frame in which the chain begins, at that frame's time `ct`, metres of light travel.
    ///
    /// *Equation:* (A B)' = A' B + A B'.
    pub fn in_carrier(&self, ct: f64) -> Pose {
        let time_s = ct / self.speed_of_light_m_s;
        let mut whole = DAffine3::IDENTITY;
        let mut rate = DAffine3 { matrix3: DMat3::ZERO, translation: DVec3::ZERO };
        for link in &self.links {
            match link {
                ChainLink::Fixed(fixed) => {
                    rate = changed(&rate, fixed);
                    whole *= *fixed;
                }
                ChainLink::Keyed(keyed) => {
                    let (local, local_rate) = keyed.at(time_s);
                    let (of_rest, of_link) = (changed(&rate, &local), whole.matrix3 * local_rate.translation);
                    rate = DAffine3 {
                        matrix3: of_rest.matrix3 + whole.matrix3 * local_rate.matrix3,
                        translation: of_rest.translation + of_link,
                    };
                    whole *= local;
                }
            }
        }
        let per_metre = 1.0 / self.speed_of_light_m_s;
        let rate = DAffine3 { matrix3: rate.matrix3 * per_metre, translation: rate.translation * per_metre };
        Pose { world_from_body: whole, rate }
    }

    /// Worldline of a point of the body in the frame in which the chain begins.
    pub fn point(&self, place: DVec3) -> impl Worldline + use<'_> {
        Point { animated: self, place }
    }

    /// Largest factor by which a length of the body may be longer in the world.
    pub fn stretch(&self) -> f64 {
        let of_link = |link: &ChainLink| match link {
            ChainLink::Fixed(fixed) => stretch(fixed.matrix3),
            ChainLink::Keyed(keyed) => keyed.largest_scale().max_element(),
        };
        self.links.iter().map(of_link).product()
    }

    /// Ball in the frame in which the chain begins that a ball fixed to the body never leaves.
    pub fn reach(&self, ball: Ball) -> Ball {
        self.links.iter().rev().fold(ball, |ball, link| match link {
            ChainLink::Fixed(fixed) => {
                Ball { centre: fixed.transform_point3(ball.centre), radius: stretch(fixed.matrix3) * ball.radius }
            }
            ChainLink::Keyed(keyed) => {
                let [least, most] = keyed.translation.bounds();
                let scale = keyed.largest_scale();
                let out = (scale * ball.centre.abs()).length() + scale.max_element() * ball.radius;
                Ball { centre: 0.5 * (least + most), radius: 0.5 * least.distance(most) + out }
            }
        })
    }
}

/// Term of a product's rate that comes from its first factor: A' B.
fn changed(rate: &DAffine3, second: &DAffine3) -> DAffine3 {
    DAffine3 {
        matrix3: rate.matrix3 * second.matrix3,
        translation: rate.matrix3 * second.translation + rate.translation,
    }
}

/// Upper bound of the factor by which a matrix lengthens a vector: ‖A‖² is at most the largest sum of a column of |Aᵀ
/// A|. 1 for a rotation.
fn stretch(matrix: DMat3) -> f64 {
    let square = matrix.transpose() * matrix;
    [square.x_axis, square.y_axis, square.z_axis]
        .map(|column| column.abs().element_sum())
        .into_iter()
        .fold(0.0, f64::max)
        .sqrt()
}

struct Point<'a> {
    animated: &'a Animated,
    place: DVec3,
}

impl Worldline for Point<'_> {
    fn at(&self, ct: f64) -> (DVec3, DVec3) {
        let pose = self.animated.in_carrier(ct);
        (pose.position(self.place), pose.beta(self.place))
    }
}

#[cfg(test)]
mod tests {
    //! Law under test: a pose's rate is its derivative, through scaled and turned links. A product rule applied the
    //! wrong way round differs from finite differences.

    use super::super::track::TrackKeys;
    use super::*;

    #[test]
    fn a_rate_is_the_derivative_of_the_pose() {
        let turn = TrackKeys::slerp(vec![0.0, 1.0], vec![DQuat::IDENTITY, DQuat::from_rotation_z(2.0)]).unwrap();
        let way = TrackKeys::linear(vec![-1.0, 2.0], vec![DVec3::ZERO, DVec3::new(1.0, 2.0, 3.0)]).unwrap();
        let spin = TrackKeys::slerp(vec![0.0, 2.0], vec![DQuat::IDENTITY, DQuat::from_rotation_x(-1.0)]).unwrap();
        let fixed = DAffine3::from_scale_rotation_translation(
            DVec3::new(1.0, -2.0, 0.5),
            DQuat::from_rotation_y(0.4),
            DVec3::new(3.0, 0.0, 1.0),
        );
        let sizes = vec![DVec3::new(1.5, 1.0, 2.0), DVec3::new(0.5, -1.2, 2.5)];
        let growth = TrackKeys::linear(vec![0.0, 1.0], sizes).unwrap();
        let keyed = |translation, rotation, scale| ChainLink::Keyed(Keyed { translation, rotation, scale });
        let mut body = Animated::new(
            "body",
            vec![
                ChainLink::Fixed(fixed),
                keyed(Track::Keyed(way), Track::Keyed(turn), Track::Keyed(growth)),
                ChainLink::Fixed(fixed),
                keyed(Track::Fixed(DVec3::Y), Track::Keyed(spin), Track::Fixed(DVec3::new(1.5, 1.0, 2.0))),
            ],
        );
        body.speed_of_light_m_s = 4.0;
        let ball = Ball { centre: DVec3::new(0.1, 0.2, 0.3), radius: 0.7 };
        let reach = body.reach(ball);
        for place in [DVec3::ZERO, DVec3::new(0.1, 0.2, 1.0), DVec3::new(-0.6, 0.2, 0.3)] {
            for ct in [0.5, 1.0, 2.3, 3.7] {
                let [before, after] = [-1e-6, 1e-6].map(|step| body.at(ct + step).position(place));
                let (position, beta) = (body.at(ct).position(place), body.at(ct).beta(place));
                assert!(beta.distance((after - before) / 2e-6) < 1e-8, "{beta} at {ct}");
                assert!(position.distance(reach.centre) <= reach.radius);
            }
        }
        // Axes are orthogonal, and mirrored if the chain mirrors.
        let axes = body.at(1.0).axes();
        assert!(((axes.transpose() * axes) - DMat3::IDENTITY).to_cols_array().iter().all(|value| value.abs() < 1e-14));
        assert!((axes.determinant() - body.at(1.0).world_from_body.matrix3.determinant().signum()).abs() < 1e-12);
    }
}
