//! Observer in the frames of all bodies.
//!
//! The observer's event and celerity are taken to each body's frame once for each picture, a pixel's direction once
//! for each ray. In that frame the body rests, so light travels there along a straight line. Animated bodies rest in
//! no frame: their rays are followed in the frame in which their chain begins.

use glam::{DMat3, DQuat, DVec3};
use physics::{Aberration, Boost, Celerity, Contraction, FourVector, Observer};
use scene::Scene;
use scene::motion::{Animated, Motion, SeenBy};
use view::Places;

/// Observer in the frames of all bodies.
pub struct ObserverInBodies {
    /// Observer in the world.
    pub observer: Observer,
    bodies: Vec<ObserverInBody>,
    world: ObserverInBody,
}

/// Observer in the frame of one body.
pub struct ObserverInBody {
    /// Position, metres relative to the scene's origin.
    pub position: DVec3,
    /// Time of the observer in the body's frame, metres of light travel; for animated bodies, in that in which their
    /// chain begins.
    pub ct: f64,
    group_from_observer: DQuat,
    /// Delay of the light between body and observer.
    pub delay: LightDelay,
}

/// Delay of the light between a body and the observer.
pub enum LightDelay {
    /// Light takes its time.
    Travel(Aberration),
    /// No light: everything is where it is at the observer's present. A ray is a line of that present.
    Present(Contraction),
    /// Light takes no time. An animated body is in the pose of that moment, and all of it moves like its middle.
    PoseNow { observer: Aberration, object: Aberration, body_from_world: DMat3 },
    /// Light takes no time. The observer sees the world at one moment, with the light shifted nevertheless.
    MomentNow { observer: Aberration, object: Aberration, object_from_world: Boost },
}

/// Ray in a body's frame.
pub struct SightLine {
    /// Direction away from the observer, unit vector.
    pub direction: DVec3,
    /// Doppler factor from the body's frame to the observer.
    pub doppler: f64,
    /// Apparent metres for each metre of the ray.
    pub apparent: f64,
    /// Metres of time, in the body's frame (for animated bodies, in that in which their chain begins), for each metre
    /// of the ray: −1 for light that is followed back.
    pub time: f64,
}

impl SightLine {
    /// True if light comes along the line. One of an observer's present is spacelike.
    pub fn is_of_light(&self) -> bool {
        self.time <= -1.0
    }

    /// Line along a vector of the body's frame that stands for one apparent metre, and `time` metres of that frame's
    /// time.
    fn stretched(vector: DVec3, time: f64, doppler: f64) -> Self {
        let length = vector.length();
        Self { direction: vector / length, doppler, apparent: 1.0 / length, time: time / length }
    }
}

impl ObserverInBodies {
    /// Takes an observer to the frames of bodies with these motions.
    pub fn new(
        scene: &Scene,
        motions: impl Iterator<Item = Option<usize>>,
        observer: &Observer,
        places: Places,
    ) -> Self {
        let in_body = |motion| ObserverInBody::new(scene, observer, places, motion);
        Self { observer: *observer, bodies: motions.map(in_body).collect(), world: in_body(None) }
    }

    /// Observer in the frame of each body, in the bodies' order.
    pub fn bodies(&self) -> &[ObserverInBody] {
        &self.bodies
    }

    /// Time of the observer in the world, metres of light travel.
    pub fn world_ct(&self) -> f64 {
        self.world.ct
    }

    /// World direction of what is seen in a direction, and its Doppler factor.
    pub fn world(&self, seen: DVec3) -> (DVec3, f64) {
        let line = self.world.line(seen);
        (line.direction, line.doppler)
    }

    /// Distances at which the rays of all bodies begin: 0, at the eye.
    pub fn start(&self) -> Vec<f64> {
        vec![0.0; self.bodies.len()]
    }

    /// Places the observer in a body's frame exactly, to the last bit: at rest at `position`, at the body's time `ct`.
    pub fn place_at_rest(&mut self, body: usize, position: DVec3, ct: f64) {
        let delay = LightDelay::Travel(Aberration::new(Celerity::ZERO));
        self.bodies[body] = ObserverInBody { position, ct, group_from_observer: DQuat::IDENTITY, delay };
    }
}

impl ObserverInBody {
    fn new(scene: &Scene, observer: &Observer, places: Places, motion: Option<usize>) -> Self {
        let rest = SeenBy {
            position: observer.event.position,
            celerity: observer.celerity,
            observer_from_group: DQuat::IDENTITY,
        };
        let uniform = match motion.map(|motion| &scene.motions[motion]) {
            None => None,
            Some(Motion::Uniform(uniform)) => Some(*uniform),
            Some(Motion::Animated(animated)) => return Self::of_animated(observer, places, animated),
        };
        let seen_by = uniform.map_or(rest, |uniform| uniform.seen_by(observer));
        let delay = match places {
            Places::Seen => LightDelay::Travel(Aberration::new(seen_by.celerity)),
            Places::Measured => LightDelay::Present(Contraction::new(seen_by.celerity)),
            Places::Instant => {
                let celerity = uniform.map_or(Celerity::ZERO, |uniform| uniform.celerity);
                LightDelay::MomentNow {
                    observer: Aberration::new(observer.celerity),
                    object: Aberration::new(celerity),
                    object_from_world: Boost::observer_from_world(celerity),
                }
            }
        };
        let group_from_observer = seen_by.observer_from_group.conjugate();
        let ct = uniform.map_or(observer.event.ct, |uniform| {
            let apart = observer.event - uniform.anchor;
            uniform.anchor.ct + Boost::observer_from_world(uniform.celerity).apply(apart).t
        });
        Self { position: seen_by.position - scene.origin, ct, group_from_observer, delay }
    }

    /// Observer for an animated body. Light, or the observer's present, is followed in the frame in which its chain
    /// begins; if light takes no time, the body is in one pose.
    fn of_animated(observer: &Observer, places: Places, animated: &Animated) -> Self {
        let own = animated.own_observer(observer);
        let ct = own.event.ct;
        let followed = match places {
            Places::Seen => Some(LightDelay::Travel(Aberration::new(own.celerity))),
            Places::Measured => Some(LightDelay::Present(Contraction::new(own.celerity))),
            Places::Instant => None,
        };
        if let Some(delay) = followed {
            let turn =
                animated.carrier().map_or(DQuat::IDENTITY, |carrier| carrier.seen_by(observer).observer_from_group);
            return Self { position: own.event.position, ct, group_from_observer: turn.conjugate(), delay };
        }
        let (position, group_from_observer) = (observer.event.position, DQuat::IDENTITY);
        let of_observer = Aberration::new(observer.celerity);
        let pose = animated.as_shown(observer, places);
        let body_from_world = pose.world_from_body.inverse();
        let object = Aberration::new(animated.celerity(&pose));
        let delay = LightDelay::PoseNow { observer: of_observer, object, body_from_world: body_from_world.matrix3 };
        Self { position: body_from_world.transform_point3(position), ct, group_from_observer, delay }
    }

    /// Ray in the body's frame of what is seen in a direction, a unit vector along the observer's axes.
    pub fn line(&self, seen: DVec3) -> SightLine {
        match &self.delay {
            LightDelay::Travel(aberration) => {
                let (direction, doppler) = aberration.world_from_observer(self.group_from_observer * seen);
                SightLine { direction, doppler, apparent: doppler, time: -1.0 }
            }
            LightDelay::Present(contraction) => {
                let seen = self.group_from_observer * seen;
                SightLine::stretched(contraction.world_from_observer(seen), contraction.world_time(seen), 1.0)
            }
            LightDelay::MomentNow { observer, object, object_from_world } => {
                let doppler = observer.observer_from_world(seen).1 / object.observer_from_world(seen).1;
                let FourVector { t, r } = object_from_world.apply(FourVector { t: 0.0, r: seen });
                SightLine::stretched(r, t, doppler)
            }
            LightDelay::PoseNow { observer, object, body_from_world } => {
                let doppler = observer.observer_from_world(seen).1 / object.observer_from_world(seen).1;
                SightLine::stretched(*body_from_world * seen, 0.0, doppler)
            }
        }
    }
}
