//! From where pictures are taken: along the scene's circuit, in a straight line from its start, or with the eyes of a recorded rider.

use std::path::Path;

use glam::DVec3;
use physics::photo_surface::Eye;
use physics::{Beta, Celerity};

use crate::command::SceneChoice;
use crate::error::Error;
use crate::film_ride;
use crate::render::shot;
use crate::renderers::{Effects, Shot};
use crate::scene::{Scene, source};
use crate::vehicle::World;
use crate::views::{Camera, Gaze};

/// Metres from the ground to the eye.
const EYE_HEIGHT_M: f64 = 1.6;
/// Vertical field of view, degrees.
pub const FOV_DEGREES: f64 = 60.0;
/// v/c at one pose after another.
const SPEEDS: [f64; 5] = [0.5, 0.8, 0.9, 0.95, 0.99];
/// Pictures a second at which a recording is looked through.
const LOOKED_THROUGH: f64 = 10.0;

/// What is looked at, and from where.
#[derive(Debug)]
pub struct Views {
    /// The scene.
    pub scene: Scene,
    /// How fast light is in it.
    pub world: World,
    /// The pictures' eyes.
    pub shots: Vec<Shot>,
}

/// The views of a scene, or of a recorded ride with its own speed of light.
///
/// # Errors
/// A scene or a recording that cannot be read, or is empty.
pub fn views(choice: &SceneChoice, speed_of_light_m_s: f64, replay: Option<&Path>, count: u32) -> Result<Views, Error> {
    let Some(recording) = replay else {
        let world = World::new(speed_of_light_m_s)?;
        let scene = source::load(choice, speed_of_light_m_s)?;
        let shots = built_in(&scene, count)?;
        return Ok(Views { scene, world, shots });
    };
    let (scene, speed_of_light_m_s, moments) = film_ride::reel(recording, choice, LOOKED_THROUGH, None)?;
    let world = World::new(speed_of_light_m_s)?;
    let gazes: Vec<Gaze> = moments.into_iter().map(|moment| moment.gaze).collect();
    if gazes.is_empty() {
        return Err(Error::NothingRidden);
    }
    let shots = evenly(&gazes, count as usize).map(|gaze| shot(gaze, FOV_DEGREES, Effects::ALL)).collect();
    Ok(Views { scene, world, shots })
}

/// So many of them, evenly spread, each from the middle of its part.
fn evenly<T>(all: &[T], count: usize) -> impl Iterator<Item = &T> {
    let count = count.min(all.len());
    (0..count).map(move |number| &all[(2 * number + 1) * all.len() / (2 * count)])
}

/// Along the circuit, looking ahead and, every other time, to the side.
fn built_in(scene: &Scene, count: u32) -> Result<Vec<Shot>, Error> {
    let pose = |number: u32| {
        let (place, ahead) = match scene.circuit.len() {
            0 => (scene.start.position, scene.start.look),
            corners => {
                let at = number as usize * corners / count as usize;
                let (here, next) = (scene.circuit[at], scene.circuit[(at + 1) % corners]);
                (here, (next - here).normalize_or(scene.start.look))
            }
        };
        let speed = SPEEDS[number as usize % SPEEDS.len()];
        let celerity = Beta::new(ahead.normalize() * speed).map_or(Celerity::ZERO, Beta::celerity);
        let look = if number.is_multiple_of(2) { ahead } else { ahead + 0.7 * ahead.cross(DVec3::Y) };
        let eye = Eye::new(place + DVec3::Y * EYE_HEIGHT_M, celerity.vector())?;
        let camera = Camera::looking(look, DVec3::Y, FOV_DEGREES.to_radians());
        Ok(Shot { camera, eye, ct: 0.0, effects: Effects::ALL, stored_scale: None })
    };
    (0..count).map(pose).collect()
}

/// The same shot, its eye further on its straight worldline by `own_m` metres of light travel of its own time.
///
/// # Errors
/// An eye that gets nowhere.
pub fn further(shot: &Shot, own_m: f64) -> Result<Shot, Error> {
    let eye = Eye::new(shot.eye.position() + shot.eye.celerity() * own_m, shot.eye.celerity())?;
    Ok(Shot { eye, ct: shot.ct + shot.celerity().gamma() * own_m, ..*shot })
}

#[cfg(test)]
mod tests {
    //! A path is taken evenly, and an eye goes on as its celerity says.

    use super::*;

    #[test]
    fn a_ride_is_looked_at_evenly_from_its_beginning_to_its_end() {
        let all: Vec<usize> = (0..100).collect();
        assert_eq!(evenly(&all, 5).copied().collect::<Vec<_>>(), [10, 30, 50, 70, 90]);
        assert_eq!(evenly(&all[..3], 5).copied().collect::<Vec<_>>(), [0, 1, 2]);
    }

    #[test]
    fn an_eye_goes_on_along_its_worldline() {
        let start = built_in(&crate::scene::lattice::Lattice::default().build(), 2).unwrap()[1];
        let later = further(&start, 3.0).unwrap();
        let (way, time) = (later.eye.position().distance(start.eye.position()), later.ct - start.ct);
        // At 0.8 c: u = 4/3, γ = 5/3.
        assert!((way - 4.0).abs() < 1e-12 && (time - 5.0).abs() < 1e-12, "{way} {time}");
    }
}
