//! Camera path: courses one after the other, asked for by own time.

use crate::camera_course::CameraCourse;
use crate::course::PathCourse;
use crate::course_moment::CourseMoment;
use crate::error::CameraPathError;
use crate::part_plan::PartBefore;
use crate::path_file::{PathFile, PathScene};
use glam::DVec3;
use scene::ViewCamera;
use std::path::Path;
use view::Gaze;

/// Way of a film's camera through one scene or several.
///
/// # Example
///
/// A circle of 10 m at 0.6 of the speed of light, which is 10 m/s here: by its own clock, the camera is round after
/// 2π · 10 m / (6 m/s) / 1.25.
///
/// ```
/// use camera_paths::{CameraPath, PathScene};
/// # let folder = tempfile::tempdir()?;
/// # let file = folder.path().join("path.toml");
/// std::fs::write(&file, "watch = [0, 1, 0]\n[circle]\ncentre = [0, 1, 0]\nradius = 10\nspeed = 6\nfov = 50")?;
/// let usual = PathScene { scene: None, speed_of_light_m_s: Some(10.0) };
/// let path = CameraPath::read(&file, &usual)?;
/// assert!((path.length_s() - 2.0 * std::f64::consts::PI * 10.0 / 6.0 / 1.25).abs() < 1e-12);
/// let seen = path.at(1.0);
/// assert!((seen.gaze.observer.celerity.magnitude() - 0.75).abs() < 1e-12);
/// assert_eq!((seen.part, seen.fov_deg), (0, Some(50.0)));
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[derive(Clone, Debug)]
pub struct CameraPath {
    parts: Vec<PathPart>,
}

/// Part of a path.
#[derive(Clone, Debug)]
struct PathPart {
    scene: PathScene,
    /// Own time of its beginning, seconds.
    begins_s: f64,
    course: PathCourse,
}

/// View from one moment of a path.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct PathView {
    /// Number of the part, from 0, whose scene is seen ([`CameraPath::scenes`]).
    pub part: usize,
    /// Event and celerity of the eye, world axes, and its direction of view in the observer's axes.
    pub gaze: Gaze,
    /// Vertical field of view, degrees, where the path gives one.
    pub fov_deg: Option<f64>,
    /// Direction of the picture's top, observer's axes, of length 1.
    pub upright: DVec3,
}

impl CameraPath {
    /// Reads a path's file. `usual`: scene and speed of light of the parts that name none.
    ///
    /// # Errors
    /// [`CameraPathError`]: a file that is no path, or a camera that would be as fast as light.
    pub fn read(path: &Path, usual: &PathScene) -> Result<Self, CameraPathError> {
        let file = PathFile::read(path)?;
        let light = |scene: &PathScene| scene.speed_of_light_m_s.or(usual.speed_of_light_m_s).unwrap_or(f64::NAN);
        let lights: Vec<f64> = file.scenes().iter().map(light).collect();
        let mut camera_path = file.path(&lights)?;
        for part in &mut camera_path.parts {
            part.scene.scene = part.scene.scene.take().or_else(|| usual.scene.clone());
        }
        Ok(camera_path)
    }

    /// Path of a file where light has these speeds in its parts, m/s.
    pub(crate) fn of(file: &PathFile, lights_m_s: &[f64]) -> Result<Self, CameraPathError> {
        let name = &file.name;
        if lights_m_s.len() != file.parts.len() {
            let (parts, given) = (file.parts.len(), lights_m_s.len());
            return Err(CameraPathError::Scenes { name: name.clone(), parts, given });
        }
        let mut parts: Vec<PathPart> = Vec::with_capacity(file.parts.len());
        let mut begins_s = 0.0;
        for (number, ((plan, scene), light)) in file.parts.iter().zip(file.scenes()).zip(lights_m_s).enumerate() {
            if !(light.is_finite() && *light > 0.0) {
                return Err(CameraPathError::Light { name: name.clone(), light_m_s: *light });
            }
            let before = parts.last().filter(|_| plan.goes_on());
            let before = before.map(|before| PartBefore { end: before.course.at(before.course.length_s()) });
            let which = if file.parts.len() > 1 { format!("in part {} ", number + 1) } else { String::new() };
            let course = plan.course(*light, before, (name, &which))?;
            let length_s = course.length_s();
            let scene = PathScene { speed_of_light_m_s: Some(*light), ..scene };
            parts.push(PathPart { scene, begins_s, course });
            begins_s += length_s;
        }
        Ok(Self { parts })
    }

    /// Path of an animated camera of a scene (`Scene::cameras`), from its first key to its last, where light has the
    /// speed `speed_of_light_m_s`. Its keys' times are times of the world, and its turns are those of the observer's
    /// axes. Keys that the file joins by straight lines make the camera's celerity leap at each; those of a cubic
    /// spline do not.
    ///
    /// # Errors
    /// [`CameraPathError`]: a camera that is not animated, or would be as fast as light.
    pub fn of_gltf_camera(camera: &ViewCamera, speed_of_light_m_s: f64) -> Result<Self, CameraPathError> {
        let course = PathCourse::Camera(Box::new(CameraCourse::new(camera, speed_of_light_m_s)?));
        let scene = PathScene { scene: None, speed_of_light_m_s: Some(speed_of_light_m_s) };
        Ok(Self { parts: vec![PathPart { scene, begins_s: 0.0, course }] })
    }

    /// Length, seconds of the camera's own time.
    pub fn length_s(&self) -> f64 {
        self.parts.last().map_or(0.0, |part| part.begins_s + part.course.length_s())
    }

    /// Scenes of the parts, in their order, each with its speed of light.
    pub fn scenes(&self) -> Vec<PathScene> {
        self.parts.iter().map(|part| part.scene.clone()).collect()
    }

    /// Own times at which the parts begin, seconds.
    pub fn begins_s(&self) -> Vec<f64> {
        self.parts.iter().map(|part| part.begins_s).collect()
    }

    /// View at an own time, seconds. At the moment at which one part ends, the next is seen; before the beginning and
    /// after the end the path's first and last moments are.
    pub fn at(&self, own_s: f64) -> PathView {
        let part = self.parts.partition_point(|part| part.begins_s <= own_s).saturating_sub(1);
        let PathPart { begins_s, course, .. } = &self.parts[part];
        let CourseMoment { observer, turn, fov_deg } = course.at(own_s - begins_s);
        let gaze = Gaze { observer, observer_from_eye: turn };
        PathView { part, gaze, fov_deg, upright: turn * DVec3::Y }
    }
}

impl PathFile {
    /// Path where light has these speeds in the parts, m/s, one for each.
    ///
    /// # Errors
    /// [`CameraPathError`] if the camera would be as fast as light, or faster than can be shown.
    pub fn path(&self, speeds_of_light_m_s: &[f64]) -> Result<CameraPath, CameraPathError> {
        CameraPath::of(self, speeds_of_light_m_s)
    }
}
