//! Points of view from which pictures are taken: along the scene's circuit, on a straight line from its start, or those
//! of a recorded rider.

use glam::DVec3;
use physics::{Beta, Celerity, Event, Observer};
use ride::LightSpeed;
use scene::Scene;
use view::{Camera, EYE_HEIGHT_M, Effects, Gaze, Shot};

/// Vertical field of view, degrees.
pub const FOV_DEGREES: f64 = 60.0;
/// v/c at one pose after another.
const SPEEDS: [f64; 5] = [0.5, 0.8, 0.9, 0.95, 0.99];

/// A scene, and the pictures that are taken in it.
#[derive(Debug)]
pub struct Views {
    /// Scene that is measured.
    pub scene: Scene,
    /// Speed of light in it.
    pub light_speed: LightSpeed,
    /// Pictures that are taken.
    pub shots: Vec<Shot>,
}

/// `count` pictures of a ride, evenly spread over its gazes, each from the middle of its part; fewer if the ride has
/// fewer gazes.
pub fn of_ride(gazes: &[Gaze], count: u32) -> Vec<Shot> {
    evenly(gazes, count as usize).map(|gaze| gaze.shot(FOV_DEGREES, Effects::ALL)).collect()
}

/// `count` elements, evenly spread, each from the middle of its part.
fn evenly<T>(all: &[T], count: usize) -> impl Iterator<Item = &T> {
    let count = count.min(all.len());
    (0..count).map(move |number| &all[(2 * number + 1) * all.len() / (2 * count)])
}

/// `count` pictures along the scene's circuit, which look ahead and, every other time, to the side.
pub fn along_circuit(scene: &Scene, count: u32) -> Vec<Shot> {
    let pose = |number: u32| {
        let (place, ahead) = match scene.circuit.len() {
            0 => (scene.start.eye() - DVec3::Y * EYE_HEIGHT_M, scene.start.look),
            corners => {
                let at = number as usize * corners / count as usize;
                let (here, next) = (scene.circuit[at], scene.circuit[(at + 1) % corners]);
                (here, (next - here).normalize_or(scene.start.look))
            }
        };
        let speed = SPEEDS[number as usize % SPEEDS.len()];
        let celerity = Beta::new(ahead.normalize() * speed).map_or(Celerity::ZERO, Beta::celerity);
        let look = if number.is_multiple_of(2) { ahead } else { ahead + 0.7 * ahead.cross(DVec3::Y) };
        let event = Event { ct: 0.0, position: place + DVec3::Y * EYE_HEIGHT_M };
        let camera = Camera::looking(look, DVec3::Y, FOV_DEGREES.to_radians());
        Shot {
            camera,
            observer: Observer { event, celerity },
            effects: Effects::ALL,
            stored_scale: None,
            outside: None,
        }
    };
    (0..count).map(pose).collect()
}

/// Picture of `shot` after its observer has gone on, on its straight worldline, by `own_m` metres of light travel of
/// proper time.
pub fn further(shot: &Shot, own_m: f64) -> Shot {
    let Observer { event, celerity } = shot.observer;
    let event = Event { ct: event.ct + celerity.gamma() * own_m, position: event.position + celerity.vector() * own_m };
    Shot { observer: Observer { event, celerity }, ..*shot }
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
        let start = along_circuit(&built_in::lattice::Lattice::default().build(), 2)[1];
        let later = further(&start, 3.0);
        let (way, time) = (
            later.observer.event.position.distance(start.observer.event.position),
            later.observer.event.ct - start.observer.event.ct,
        );
        // At 0.8 c: u = 4/3, γ = 5/3.
        assert!((way - 4.0).abs() < 1e-12 && (time - 5.0).abs() < 1e-12, "{way} {time}");
    }
}
