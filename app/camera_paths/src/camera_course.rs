//! Course of an animated camera of a glTF scene, over the world's time.

use crate::course_moment::CourseMoment;
use crate::error::CameraPathError;
use crate::eye::{celerity_of, looking};
use crate::fastest::fastest;
use crate::path_clock::PathClock;
use physics::{Event, Observer};
use scene::ViewCamera;
use scene::motion::CameraMotion;

/// Share of a course before its end at which its end is asked for: at the last key itself an animation rests.
const END: f64 = 1e-12;

/// Course of an animated camera.
#[derive(Clone, Debug)]
pub(crate) struct CameraCourse {
    motion: CameraMotion,
    /// Own time by the world's, seconds.
    clock: PathClock,
    /// Times of the first key and of the last, seconds.
    span_s: [f64; 2],
    fov_deg: Option<f64>,
    light_m_s: f64,
}

impl CameraCourse {
    /// Course of a camera that is animated.
    pub(crate) fn new(camera: &ViewCamera, light_m_s: f64) -> Result<Self, CameraPathError> {
        let name = || camera.name.clone();
        if !(light_m_s.is_finite() && light_m_s > 0.0) {
            return Err(CameraPathError::Light { name: name(), light_m_s });
        }
        let motion = camera.motion.clone().ok_or_else(|| CameraPathError::NotAnimated { name: name() })?;
        let keys = motion.key_times_s();
        let (Some(first), Some(last)) = (keys.first().copied(), keys.last().copied()) else {
            return Err(CameraPathError::NotAnimated { name: name() });
        };
        if first == last {
            return Err(CameraPathError::NotAnimated { name: name() });
        }
        for ends in keys.windows(2) {
            // The speed at a key is that of what follows; within, it is that of the interval.
            let inner = [ends[0], ends[1] - END * (last - first)];
            let speed_m_s = fastest(inner, &|time| motion.at(time).velocity_m_s.length());
            if speed_m_s >= light_m_s {
                let place = format!("from {:.3} s to {:.3} s", ends[0], ends[1]);
                return Err(CameraPathError::TooFast { name: name(), place, speed_m_s, light_m_s });
            }
        }
        let clock = PathClock::new(&keys, &rate(&motion, light_m_s));
        let fov_deg = camera.start.field_of_view_rad.map(f64::to_degrees);
        Ok(Self { motion, clock, span_s: [first, last], fov_deg, light_m_s })
    }

    /// Length, seconds of own time.
    pub(crate) fn length_s(&self) -> f64 {
        self.clock.end()
    }

    /// Moment at a time of its own, seconds.
    pub(crate) fn at(&self, own_s: f64) -> CourseMoment {
        let world_s = self.clock.parameter(own_s, &rate(&self.motion, self.light_m_s));
        let [first, last] = self.span_s;
        let pose = self.motion.at(world_s.min(last - END * (last - first)));
        let event = Event { ct: world_s * self.light_m_s, position: pose.position };
        let observer = Observer { event, celerity: celerity_of(pose.velocity_m_s / self.light_m_s).0 };
        let turn = looking(pose.look.to_array(), Some(pose.up.to_array()));
        CourseMoment { observer, turn, fov_deg: self.fov_deg }
    }
}

/// Own time per world time, 1/γ.
fn rate(motion: &CameraMotion, light_m_s: f64) -> impl Fn(f64) -> f64 {
    move |time_s| celerity_of(motion.at(time_s).velocity_m_s / light_m_s).1
}
