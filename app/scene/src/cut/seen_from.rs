//! Views of a scene's parts: how an observer sees the resting scene, a uniformly moving frame or an animated body.

use glam::{DAffine3, DQuat, DVec3};
use physics::interpolation_error::TriangleInterpolation;
use physics::{Celerity, Observer};

use crate::motion::{Motion, ObservedBody};
use crate::scene::Scene;

/// View of one part of a scene: how one observer sees meshes that rest in one frame, or an animated body.
#[derive(Clone, Debug)]
pub struct SeenFrom {
    /// Bending of directions by aberration.
    pub bend: TriangleInterpolation,
    /// Position of the observer relative to the scene's origin, metres, in the meshes' rest frame; for animated
    /// bodies in the world.
    pub place: DVec3,
    /// Rotation from the axes of apparent positions in that frame to the observer's own.
    pub observer_from_group: DQuat,
    /// Animated body and its observer; `None` for resting and uniformly moving meshes.
    pub body: Option<ObservedBody>,
    /// Transform of the meshes' places to the frame of `place`, for bodies that are drawn in the pose in which they are
    /// seen; `None` for all others.
    pub pose: Option<DAffine3>,
}

impl SeenFrom {
    /// View of the resting scene (`None`) or of motion `motion`.
    pub fn new(scene: &Scene, observer: &Observer, motion: Option<usize>) -> Self {
        Self::of(scene.origin, &scene.motions, observer, motion)
    }

    /// View of the resting scene (`None`) or of a motion, from the scene's origin and its motions alone.
    pub fn of(origin: DVec3, motions: &[Motion], observer: &Observer, motion: Option<usize>) -> Self {
        let rest = |position: DVec3, celerity: Celerity, turn| Self {
            bend: TriangleInterpolation::new(celerity),
            place: position - origin,
            observer_from_group: turn,
            body: None,
            pose: None,
        };
        match motion.map(|motion| &motions[motion]) {
            Some(Motion::Uniform(uniform)) => {
                let seen = uniform.seen_by(observer);
                rest(seen.position, seen.celerity, seen.observer_from_group)
            }
            Some(Motion::Animated(animated)) => Self {
                body: Some(ObservedBody::new(animated, observer)),
                ..rest(observer.event.position, observer.celerity, DQuat::IDENTITY)
            },
            None => rest(observer.event.position, observer.celerity, DQuat::IDENTITY),
        }
    }

    /// Position of a mesh's place relative to the observer, metres, in the frame in which the mesh rests. For an
    /// animated body: its retarded position in the world, or NaN if there is none.
    pub fn towards(&self, place: DVec3) -> DVec3 {
        match &self.body {
            None => self.pose.map_or(place, |pose| pose.transform_point3(place)) - self.place,
            Some(body) => {
                let nowhere = DVec3::splat(f64::NAN);
                body.seen(place).map_or(nowhere, |seen| seen.event.position - body.observer().event.position)
            }
        }
    }

    /// Apparent position of a mesh's place relative to the observer, observer's axes, metres; not finite if there is
    /// none.
    pub fn apparent(&self, place: DVec3) -> DVec3 {
        self.observer_from_group * self.bend.apparent(self.towards(place))
    }
}
