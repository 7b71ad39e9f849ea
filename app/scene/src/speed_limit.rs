//! Speed limit: the largest speed of an animated body, which must stay below that of light.
//!
//! Speeds are sampled between all keys of a chain, at the body's outermost points: |M' p| is convex in p, so no point
//! within is faster.

use std::sync::Arc;

use glam::DVec3;
use thiserror::Error;

use crate::motion::{Animated, Ball, ChainLink, Motion, Uniform};
use crate::scene::Scene;

/// Number of sampled times between two keys.
const LOOKS: usize = 16;

/// Largest number of sampled times for one chain.
const MOST_LOOKS: usize = 200_000;

/// Number of directions in which a body's outermost points are sought.
const DIRECTIONS: usize = 200;

/// Largest speed found, and its time.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Fastest {
    /// Speed as |v|/c.
    pub beta: f64,
    /// Time on the world's clock, seconds.
    pub time_s: f64,
}

/// Animation that is as fast as light or faster.
#[derive(Clone, Debug, Error, PartialEq)]
#[error(
    "{name} moves at {speed_m_s:.6} m/s at {time_s:.6} s of its animation, and light at {speed_of_light_m_s:.6} m/s: \
     slow the animation down, or raise --speed-of-light"
)]
pub struct TooFast {
    /// Name of the node.
    pub name: String,
    /// Speed of its fastest point, m/s.
    pub speed_m_s: f64,
    /// Time of that speed, seconds of the animation.
    pub time_s: f64,
    /// Speed of light in the world, m/s.
    pub speed_of_light_m_s: f64,
}

impl Scene {
    /// Sets the speed of light, m/s. Seconds of animations become times of the world, and no animation may be as fast
    /// as light.
    ///
    /// # Errors
    /// [`TooFast`], with the node, the time and the speed.
    pub fn set_speed_of_light(&mut self, speed_of_light_m_s: f64) -> Result<(), TooFast> {
        for (number, meshes) in self.moving_meshes().into_iter().enumerate() {
            let places = self.outermost(&meshes);
            let Motion::Animated(animated) = &mut self.motions[number] else { continue };
            let animated = Arc::make_mut(animated);
            animated.speed_of_light_m_s = speed_of_light_m_s;
            animated.ball = around(&places);
            let Fastest { beta, time_s } = animated.fastest(&places);
            // A NaN speed is refused as well.
            if beta >= 1.0 || beta.is_nan() {
                let (name, speed_m_s) = (animated.name.clone(), beta * speed_of_light_m_s);
                return Err(TooFast { name, speed_m_s, time_s, speed_of_light_m_s });
            }
        }
        Ok(())
    }

    /// Indices of the meshes with each motion. Found for all motions at once, since both may be many.
    pub fn moving_meshes(&self) -> Vec<Vec<usize>> {
        let mut meshes = vec![Vec::new(); self.motions.len()];
        for (index, mesh) in self.meshes.iter().enumerate() {
            if let Some(of_motion) = mesh.motion.and_then(|motion| meshes.get_mut(motion)) {
                of_motion.push(index);
            }
        }
        meshes
    }

    /// Largest speed of one of the scene's motions; `meshes`: those with this motion.
    pub fn fastest(&self, motion: usize, meshes: &[usize]) -> Fastest {
        match &self.motions[motion] {
            Motion::Uniform(Uniform { celerity, anchor: _ }) => {
                Fastest { beta: celerity.beta().vector().length(), time_s: 0.0 }
            }
            Motion::Animated(animated) => animated.fastest(&self.outermost(meshes)),
        }
    }

    /// Box that an animated body passes through, world metres: the places of its outermost points at sampled times.
    /// `None` for other motions. `meshes`: those with this motion.
    pub fn path_bounds(&self, motion: usize, meshes: &[usize]) -> Option<[DVec3; 2]> {
        /// Number of times that are looked at.
        const TIMES: usize = 48;
        let animated = self.motions[motion].animated()?;
        let (places, looks) = (self.outermost(meshes), animated.looks());
        let mut bounds: Option<[DVec3; 2]> = None;
        for time_s in looks.iter().step_by(looks.len().div_ceil(TIMES).max(1)) {
            let pose = animated.at(time_s * animated.speed_of_light_m_s);
            for position in places.iter().map(|place| pose.position(*place)).filter(|position| position.is_finite()) {
                let [least, most] = bounds.unwrap_or([position; 2]);
                bounds = Some([least.min(position), most.max(position)]);
            }
        }
        bounds
    }

    /// Outermost vertices of these meshes, which have one motion, in the body's own frame.
    fn outermost(&self, meshes: &[usize]) -> Vec<DVec3> {
        let meshes = meshes.iter().map(|&index| &self.meshes[index]);
        let places: Vec<DVec3> = meshes
            .flat_map(|mesh| mesh.positions.iter().filter(|place| place.is_finite()).map(|place| place.as_dvec3()))
            .collect();
        if places.len() <= DIRECTIONS {
            return places;
        }
        // Fibonacci's spiral: directions evenly spread over the sphere.
        let furthest = |number: usize| {
            let z = 1.0 - (2.0 * number as f64 + 1.0) / DIRECTIONS as f64;
            let (sine, cosine) = (number as f64 * 2.399_963_229_728_653).sin_cos();
            let direction = DVec3::new(cosine, sine, 0.0) * (1.0 - z * z).sqrt() + DVec3::Z * z;
            places.iter().copied().max_by(|a, b| a.dot(direction).total_cmp(&b.dot(direction)))
        };
        (0..DIRECTIONS).filter_map(furthest).collect()
    }
}

impl Animated {
    /// Largest speed among some points of the body, and its time.
    fn fastest(&self, places: &[DVec3]) -> Fastest {
        let mut fastest = Fastest::default();
        for time_s in self.looks() {
            let pose = self.at(time_s * self.speed_of_light_m_s);
            for place in places {
                let beta = pose.beta(*place).length();
                if beta > fastest.beta || beta.is_nan() {
                    fastest = Fastest { beta, time_s };
                }
            }
        }
        fastest
    }

    /// Times at which the speed is sampled, seconds: between all keys; shorter periodic tracks are repeated to the
    /// end of the longest (at most 64 times).
    fn looks(&self) -> Vec<f64> {
        let keyed = || {
            self.links().iter().filter_map(|link| match link {
                ChainLink::Fixed(_) => None,
                ChainLink::Keyed(keyed) => Some(keyed),
            })
        };
        let tracks = keyed().flat_map(|keyed| {
            let of_translation = keyed.translation.keys().map(|keys| (keys.times_s(), keys.period_s()));
            let of_rotation = keyed.rotation.keys().map(|keys| (keys.times_s(), keys.period_s()));
            let of_scale = keyed.scale.keys().map(|keys| (keys.times_s(), keys.period_s()));
            [of_translation, of_rotation, of_scale].into_iter().flatten()
        });
        let tracks: Vec<(&[f64], Option<f64>)> = tracks.collect();
        let ends = tracks.iter().flat_map(|(times, _)| [times[0], times[times.len() - 1]]);
        let (from, to) = ends.fold((f64::INFINITY, f64::NEG_INFINITY), |(low, high), at| (low.min(at), high.max(at)));
        let mut keys: Vec<f64> = Vec::new();
        for (times, period) in tracks {
            let turns = period.map_or(1.0, |period| ((to - from) / period).ceil().clamp(1.0, 64.0));
            for turn in 0..turns as usize {
                keys.extend(times.iter().map(|time| time + turn as f64 * period.unwrap_or(0.0)));
            }
        }
        keys.sort_by(f64::total_cmp);
        keys.dedup();
        let looks = (MOST_LOOKS / keys.len().max(1)).clamp(1, LOOKS);
        let between = keys.windows(2).flat_map(|pair| {
            let [a, b] = [pair[0], pair[1]];
            (0..looks).map(move |look| a + (b - a) * (look as f64 + 0.5) / looks as f64)
        });
        // The keys themselves, too: there the speed is that of the piece that follows.
        between.chain(keys.iter().copied()).collect()
    }
}

fn around(places: &[DVec3]) -> Ball {
    let bounds = places.iter().fold(None, |bounds: Option<[DVec3; 2]>, &place| {
        Some(bounds.map_or([place; 2], |[least, most]| [least.min(place), most.max(place)]))
    });
    let Some([least, most]) = bounds else { return Ball::default() };
    let centre = 0.5 * (least + most);
    Ball { centre, radius: places.iter().map(|place| place.distance(centre)).fold(0.0, f64::max) }
}

#[cfg(test)]
mod tests {
    //! Law: the work is in proportion to the meshes and the motions, not to their product.
    use super::*;
    use crate::mesh::Mesh;
    use physics::{Celerity, Event};

    #[test]
    fn very_many_motions_find_their_meshes_soon() {
        let count = 200_000;
        let uniform = Uniform { celerity: Celerity::ZERO, anchor: Event::default() };
        let mut scene = Scene {
            meshes: (0..count).map(|n| Mesh { motion: Some(count - 1 - n), ..Mesh::default() }).collect(),
            motions: vec![Motion::Uniform(uniform); count],
            ..Scene::default()
        };
        let started = std::time::Instant::now();
        scene.set_speed_of_light(1.0).expect("nothing is animated");
        // A search among all meshes, for each motion, takes a minute.
        assert!(started.elapsed().as_secs() < 10, "{:?}", started.elapsed());
        assert_eq!(scene.moving_meshes()[7], [count - 8]);
    }
}
