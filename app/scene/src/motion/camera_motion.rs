//! Motion of a camera that keys move.

use std::sync::Arc;

use glam::{DAffine3, DVec3};

use super::animated::{Animated, ChainLink};
use super::track::Track;

/// Motion of a camera whose node, or one above it, is animated.
#[derive(Clone, Debug, PartialEq)]
pub struct CameraMotion {
    animated: Arc<Animated>,
    /// Transform from the camera's axes to those of the animated body.
    body_from_camera: DAffine3,
}

/// Pose of a moving camera at one moment of the world's time.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct CameraPose {
    /// Place of the eye, world metres.
    pub position: DVec3,
    /// Velocity of the eye, m/s.
    pub velocity_m_s: DVec3,
    /// Direction of view, of length 1.
    pub look: DVec3,
    /// Direction of the picture's top, of length 1; not along `look`.
    pub up: DVec3,
}

impl CameraMotion {
    /// Motion of a camera that is fixed to an animated body.
    pub fn new(animated: Arc<Animated>, body_from_camera: DAffine3) -> Self {
        Self { animated, body_from_camera }
    }

    /// Pose at a time of the world, seconds.
    pub fn at(&self, time_s: f64) -> CameraPose {
        let metres_per_s = self.animated.speed_of_light_m_s();
        let pose = self.animated.in_carrier(time_s * metres_per_s);
        let place = self.body_from_camera.translation;
        let axes = pose.world_from_body.matrix3 * self.body_from_camera.matrix3;
        CameraPose {
            position: pose.position(place),
            velocity_m_s: pose.beta(place) * metres_per_s,
            look: (axes * DVec3::NEG_Z).normalize_or(DVec3::NEG_Z),
            up: (axes * DVec3::Y).normalize_or(DVec3::Y),
        }
    }

    /// Times of all keys that move the camera, seconds, ascending, each once.
    pub fn key_times_s(&self) -> Vec<f64> {
        fn times<V: Copy>(track: &Track<V>) -> &[f64] {
            match track {
                Track::Fixed(_) => &[],
                Track::Keyed(keys) => keys.times_s(),
            }
        }
        let of_link = |link: &ChainLink| match link {
            ChainLink::Fixed(_) => Vec::new(),
            ChainLink::Keyed(keyed) => {
                [times(&keyed.translation), times(&keyed.rotation), times(&keyed.scale)].concat()
            }
        };
        let mut all: Vec<f64> = self.animated.links().iter().flat_map(of_link).collect();
        all.sort_by(f64::total_cmp);
        all.dedup();
        all
    }
}
