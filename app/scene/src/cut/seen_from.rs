//! Views of a scene's parts: how an observer sees or measures the resting scene, a uniformly moving frame or an
//! animated body.

use glam::{DAffine3, DQuat, DVec3};
use physics::interpolation_error::TriangleInterpolation;
use physics::{Celerity, Contraction, DirectionCone, Observer};

use crate::motion::{Motion, ObservedBody};
use crate::scene::Scene;
use view::Places;

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
    /// Contraction of what is measured at the observer's present; `None` for what is seen.
    pub contraction: Option<Contraction>,
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
            contraction: None,
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

    /// View by which edges are cut: clockwork that is seen in one pose counts as resting in it. Its corners are sought
    /// one by one all the same. Sought for every edge, they would take all the triangles that bodies may have.
    pub fn for_cutting(scene: &Scene, observer: &Observer, motion: Option<usize>) -> Self {
        let sight = Self::new(scene, observer, motion);
        let animated = motion.and_then(|motion| scene.motions[motion].animated());
        let clockwork = animated.filter(|body| body.is_clockwork());
        match clockwork.and_then(|body| body.pose_shown(observer, Places::Seen)) {
            Some(pose) => {
                let pose = DAffine3 { translation: pose.translation - scene.origin, ..pose };
                Self { body: None, pose: Some(pose), ..sight }
            }
            None => sight,
        }
    }

    /// Measured part of a scene, from the scene's origin and its motions alone: everything at the observer's present.
    pub fn measured(origin: DVec3, motions: &[Motion], observer: &Observer, motion: Option<usize>) -> Self {
        let celerity = match motion.map(|motion| &motions[motion]) {
            Some(Motion::Uniform(uniform)) => uniform.seen_by(observer).celerity,
            Some(Motion::Animated(_)) | None => observer.celerity,
        };
        Self { contraction: Some(Contraction::new(celerity)), ..Self::of(origin, motions, observer, motion) }
    }

    /// True if each place is sought on its worldline.
    pub fn is_sought(&self) -> bool {
        self.body.is_some()
    }

    /// Position of a mesh's place relative to the observer, metres, in the frame in which the mesh rests. For an
    /// animated body: its position in the world at the event that is shown, or NaN if there is none.
    pub fn towards(&self, place: DVec3) -> DVec3 {
        match &self.body {
            None => self.pose.map_or(place, |pose| pose.transform_point3(place)) - self.place,
            Some(body) => {
                let shown = if self.contraction.is_some() { body.measured(place) } else { body.seen(place) };
                let nowhere = DVec3::splat(f64::NAN);
                shown.map_or(nowhere, |shown| shown.event.position - body.observer().event.position)
            }
        }
    }

    /// Apparent position of a mesh's place relative to the observer, or its measured one; observer's axes, metres; not
    /// finite if there is none.
    pub fn apparent(&self, place: DVec3) -> DVec3 {
        let towards = self.towards(place);
        let in_group = match &self.contraction {
            None => self.bend.apparent(towards),
            Some(contraction) => contraction.observer_from_world(towards),
        };
        self.observer_from_group * in_group
    }

    /// Cone in which a ball of a mesh's places is shown, observer's axes; `None` if the observer is in the ball or it
    /// has no finite size. Not for animated bodies. `centre` and `radius`: metres.
    pub fn cone(&self, centre: DVec3, radius: f64) -> Option<DirectionCone> {
        let cone = match &self.contraction {
            None => self.bend.cone(self.towards(centre), radius)?,
            // Contraction makes nothing longer, so what is measured of a ball lies in a ball of that radius.
            Some(contraction) => {
                let middle = contraction.observer_from_world(self.towards(centre));
                ball_cone(middle, radius)?
            }
        };
        Some(cone.turned(self.observer_from_group))
    }

    /// Cone in which a ball of a mesh's places is shown to a camera at `place` relative to the eye, observer's axes,
    /// metres; else as [`SeenFrom::cone`].
    pub fn cone_from(&self, place: DVec3, centre: DVec3, radius: f64) -> Option<DirectionCone> {
        let stretch = if self.contraction.is_some() { 1.0 } else { self.bend.stretch() };
        ball_cone(self.apparent(centre) - place, stretch * radius)
    }
}

/// Cone in which a ball lies; `None` if the ball holds the place from which it is looked at, or has no finite size.
fn ball_cone(middle: DVec3, radius: f64) -> Option<DirectionCone> {
    let distance = middle.length();
    let share = radius / distance;
    (share < 1.0).then(|| DirectionCone { axis: middle / distance, radius_rad: share.asin() })
}
