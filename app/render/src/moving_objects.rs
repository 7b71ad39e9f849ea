//! Views of moving bodies, each drawn as a world of its own.
//!
//! Seen from a moving body, the observer has another place and another celerity, in axes that Wigner's rotation turns
//! into the observer's. So each motion has its own view of the same picture: light is shifted by the relative motion,
//! and a pixel's direction is taken in the body's axes (W 5.1.2). Animated bodies are seen in the observer's axes,
//! since the program solves for each of their places, with its Doppler factor. All share the same depth: along one
//! line of sight the nearer apparent position is the later emission.

use crate::view_matrix::matrix;
use glam::{DAffine3, DMat3, DMat4, DQuat, DVec3, DVec4, Vec4, Vec4Swizzles};
use physics::{Celerity, Contraction, Event, Observer};
use scene::motion::{Animated, Motion, SeenBy};
use view::Places;

/// Axes of the apparent positions of a moving body.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Axes {
    /// Axes of the observer, after the rotation.
    Observer,
    /// Axes of the pure boost out of the body's frame.
    Group,
}

/// The observer in the world, then in the frame of each motion.
pub fn observers(motions: &[Motion], observer: &Observer) -> Vec<Observer> {
    std::iter::once(*observer).chain(motions.iter().map(|motion| in_frame_of(motion, observer))).collect()
}

/// The observer in the frame of a body with this motion. Its time stays the world's: a body at rest in that frame is
/// seen alike at all times.
fn in_frame_of(motion: &Motion, observer: &Observer) -> Observer {
    let seen = seen_by(motion, observer);
    Observer { event: Event { position: seen.position, ..observer.event }, celerity: seen.celerity }
}

/// View of a moving body, for the picture whose view of the resting world is `at_rest`.
pub fn view(
    at_rest: &shaders::ViewUniforms,
    motion: &Motion,
    observer: &Observer,
    axes: Axes,
) -> shaders::ViewUniforms {
    let seen = seen_by(motion, observer);
    let group_from_observer = seen.observer_from_group.conjugate();
    let turned = |vector: Vec4| turn(group_from_observer, vector);
    let clip_from_observer = match axes {
        Axes::Observer => at_rest.clip_from_observer,
        Axes::Group => at_rest.clip_from_observer * matrix(&DMat4::from_quat(seen.observer_from_group)),
    };
    let along = along(seen.celerity);
    shaders::ViewUniforms {
        clip_from_observer,
        forward: turned(at_rest.forward),
        right: turned(at_rest.right),
        up: turned(at_rest.up),
        motion: along,
        shift: at_rest.shift.with_x(along.w),
        ..*at_rest
    }
}

/// View of a moving body in a picture of the plain world about the eye. The body's own positions are relative to
/// `origin`. It is drawn at its place at the observer's time, contracted along its motion.
///
/// *Equation:* r = a + q − (1 − 1/γ)(q·n) n + β (ct − ct_a), q from the anchor in the body's frame.
pub fn plain_view(
    at_eye: &shaders::ViewUniforms,
    motion: &Motion,
    observer: &Observer,
    origin: DVec3,
) -> shaders::ViewUniforms {
    let uniform = match motion {
        Motion::Uniform(uniform) => uniform,
        Motion::Animated(animated) => return plain_pose(at_eye, animated, observer),
    };
    let celerity = uniform.celerity;
    let n = celerity.direction().unwrap_or(DVec3::ZERO);
    let gamma = celerity.gamma();
    // 1 − 1/γ, computed without cancellation.
    let shorter = celerity.magnitude() / gamma * (celerity.magnitude() / (gamma + 1.0));
    let contraction = DMat3::IDENTITY - DMat3::from_cols(n * n.x, n * n.y, n * n.z) * shorter;
    let anchor = uniform.anchor;
    let moved = celerity.beta().vector() * (observer.event.ct - anchor.ct);
    let place = anchor.position - observer.event.position + moved + contraction * (origin - anchor.position);
    let eye_from_group = DMat4::from_cols(
        contraction.x_axis.extend(0.0),
        contraction.y_axis.extend(0.0),
        contraction.z_axis.extend(0.0),
        DVec4::from((place, 1.0)),
    );
    shaders::ViewUniforms {
        clip_from_observer: at_eye.clip_from_observer * matrix(&eye_from_group),
        source: along(celerity),
        ..*at_eye
    }
}

/// View of the resting scene (`None`) or of a moving body in a picture of what the observer measures about the eye. Its
/// own positions are relative to `origin`. Clockwork is in one pose, exact at four of its points; not for other
/// animated bodies, each of whose points is at its own event.
///
/// *Equation:* in the body's frame, in which it rests, x' = d − (1 − 1/γ)(d·n) n with the observer's place and motion
/// there ([`Contraction`]), turned into the observer's axes.
pub fn measured_view(
    at_eye: &shaders::ViewUniforms,
    motion: Option<&Motion>,
    observer: &Observer,
    origin: DVec3,
) -> shaders::ViewUniforms {
    if let Some(animated) = motion.and_then(Motion::animated) {
        return measured_pose(at_eye, animated, observer);
    }
    let seen = motion.map_or_else(|| by_axes_of(observer), |motion| seen_by(motion, observer));
    let contraction = Contraction::new(seen.celerity);
    let observer_from_group = DMat3::from_quat(seen.observer_from_group) * contraction.matrix();
    let place = observer_from_group * (origin - seen.position);
    let mut eye_from_group = DMat4::from_mat3(observer_from_group);
    eye_from_group.w_axis = place.extend(1.0);
    shaders::ViewUniforms { clip_from_observer: at_eye.clip_from_observer * matrix(&eye_from_group), ..*at_eye }
}

/// View of an animated body in a picture of what the observer measures: all of it in one pose. A body that is nowhere
/// at the observer's present has shrunk to nothing.
fn measured_pose(at_eye: &shaders::ViewUniforms, animated: &Animated, observer: &Observer) -> shaders::ViewUniforms {
    let nowhere = DAffine3 { matrix3: DMat3::ZERO, translation: DVec3::ZERO };
    let pose = animated.pose_shown(observer, Places::Measured).unwrap_or(nowhere);
    let contraction = DMat4::from_mat3(Contraction::new(observer.celerity).matrix());
    let eye_from_world = contraction * DMat4::from_translation(-observer.event.position);
    shaders::ViewUniforms {
        clip_from_observer: at_eye.clip_from_observer * matrix(&(eye_from_world * DMat4::from(pose))),
        ..*at_eye
    }
}

/// View of an animated body in a picture of the plain world: the body at the observer's time. The velocity of its
/// middle shifts the light of the whole body.
fn plain_pose(at_eye: &shaders::ViewUniforms, animated: &Animated, observer: &Observer) -> shaders::ViewUniforms {
    let pose = animated.as_shown(observer, Places::Instant);
    let eye_from_world = DMat4::from_translation(-observer.event.position);
    shaders::ViewUniforms {
        clip_from_observer: at_eye.clip_from_observer * matrix(&(eye_from_world * DMat4::from(pose.world_from_body))),
        source: along(animated.celerity(&pose)),
        ..*at_eye
    }
}

/// View of a motion by the observer. Animated bodies are solved for in the world frame, and appear in the observer's
/// axes.
fn seen_by(motion: &Motion, observer: &Observer) -> SeenBy {
    match motion {
        Motion::Uniform(uniform) => uniform.seen_by(observer),
        Motion::Animated(_) => by_axes_of(observer),
    }
}

/// View of what rests in the world.
fn by_axes_of(observer: &Observer) -> SeenBy {
    SeenBy { position: observer.event.position, celerity: observer.celerity, observer_from_group: DQuat::IDENTITY }
}

/// Unit vector along a motion, and κ = γ + |u|.
fn along(celerity: Celerity) -> Vec4 {
    let direction = celerity.vector().normalize_or(DVec3::NEG_Z);
    direction.as_vec3().extend((celerity.kappa()) as f32)
}

fn turn(rotation: DQuat, vector: Vec4) -> Vec4 {
    (rotation * vector.xyz().as_dvec3()).as_vec3().extend(vector.w)
}
