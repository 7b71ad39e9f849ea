//! Certainty of a picture: an estimate of how far from their exact places things are drawn, from a few hundred edges
//! of the scene.
//!
//! Two errors are estimated. First, straight edges should bend ([`physics::interpolation_error`]), and a map has
//! texels of finite size. Second, f32 has 24 bits, and in the map the boost enlarges the rounding errors of the world
//! astern. The largest error of each kind found in the picture is reported.

use glam::{DVec2, DVec3};
use physics::Aberration;
use physics::interpolation_error::TriangleInterpolation;
use physics::photo_surface::accuracy::direction_error_rad;

use scene::Scene;
use scene::cut::{Cut, EdgeChord, SeenFrom};
use view::Shot;

/// Number of edges sampled.
const SAMPLES: usize = 512;

/// Smallest number of edges in the picture that says enough about it.
const FEW: usize = 8;

/// Rounding error of a direction in f32, radians.
const STEP: f64 = f32::EPSILON as f64;

/// Error from which on a picture gets a notice, pixels.
const NOTICED_PX: f64 = 2.0;

/// Way in which the directions of a picture are computed.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum EdgesDrawn {
    /// Straight edges between vertices that the kernel has bent.
    ByKernel,
    /// Straight edges between vertices that were bent in f64.
    InFull,
    /// Directions looked up in a map.
    FromMap {
        /// Texels for each pixel of the picture, along each axis.
        texels_per_pixel: f64,
    },
}

/// Sample of a scene's edges.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Edges {
    /// Ends of each edge in metres relative to the scene's origin, and the motion of its mesh.
    ends: Vec<([DVec3; 2], Option<usize>)>,
}

/// Estimated errors of a picture's directions.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Certainty {
    /// Error of straight edges or of texels of finite size, radians.
    pub drawn_rad: f64,
    /// Error of rounded numbers, radians.
    pub rounded_rad: f64,
    /// Angle of a pixel in the middle of the picture, radians.
    pub pixel_rad: f64,
}

/// Lengths of edges, and sizes of their coordinates, both divided by their distance from the eye. They stand for
/// edges anywhere.
#[derive(Default)]
struct Usual {
    lengths: Vec<f64>,
    coordinates: Vec<f64>,
}

impl Usual {
    fn add(&mut self, length: f64, coordinate: f64) {
        self.lengths.push(length);
        self.coordinates.push(coordinate);
    }

    /// Median of both; zeros if no edge is finite.
    fn median(mut self) -> (f64, f64) {
        [&mut self.lengths, &mut self.coordinates].into_iter().for_each(|values| values.sort_by(f64::total_cmp));
        let middle = self.lengths.len() / 2;
        let at = |values: &[f64]| values.get(middle).copied().unwrap_or_default();
        (at(&self.lengths), at(&self.coordinates))
    }
}

impl Edges {
    /// Sample of the edges of a scene.
    pub fn of(scene: &Scene) -> Self {
        let meshes = scene.meshes.iter().map(|mesh| (mesh.indices.as_slice(), mesh.motion));
        Self::sampled(meshes, |mesh, corner: u32| scene.meshes[mesh].positions[corner as usize].as_dvec3())
    }

    /// Sample of the edges of the resting part of a scene.
    pub fn of_resting(scene: &Scene) -> Self {
        let resting: Vec<_> = scene.meshes.iter().filter(|mesh| mesh.motion.is_none()).collect();
        let meshes = resting.iter().map(|mesh| (mesh.indices.as_slice(), None));
        Self::sampled(meshes, |mesh, corner: u32| resting[mesh].positions[corner as usize].as_dvec3())
    }

    /// Sample of the edges of a scene that was cut.
    pub fn of_cut(scene: &Scene, cut: &Cut) -> Self {
        let meshes = cut.meshes.iter().zip(&scene.meshes).map(|(cut, mesh)| (cut.indices(mesh), mesh.motion));
        Self::sampled(meshes, |mesh, corner: u32| cut.meshes[mesh].place(&scene.meshes[mesh], corner as usize))
    }

    /// Takes one edge of every n-th triangle, in turn its first, second and third.
    fn sampled<'a>(
        meshes: impl Iterator<Item = (&'a [u32], Option<usize>)> + Clone,
        place: impl Fn(usize, u32) -> DVec3,
    ) -> Self {
        let count: usize = meshes.clone().map(|(indices, _)| indices.len() / 3).sum();
        let step = count.div_ceil(SAMPLES).max(1);
        let mut ends = Vec::with_capacity(SAMPLES);
        // Number of the next triangle to be sampled, in the mesh that is at hand.
        let mut next = 0;
        for (mesh, (indices, motion)) in meshes.enumerate() {
            let triangles = indices.as_chunks::<3>().0;
            while let Some(corners) = triangles.get(next) {
                let number = ends.len();
                ends.push(([number % 3, (number + 1) % 3].map(|corner| place(mesh, corners[corner])), motion));
                next += step;
            }
            next -= triangles.len();
        }
        Self { ends }
    }
}

impl Certainty {
    /// Certainty of a picture that shows these edges. `sight_of` returns how each motion is seen.
    pub fn of(
        edges: &Edges,
        sight_of: impl Fn(Option<usize>) -> SeenFrom,
        shot: &Shot,
        size: [u32; 2],
        drawn: EdgesDrawn,
    ) -> Self {
        let tangents = shot.camera.tangents(size);
        let pixel_rad = 1.0 / tangents.focal_length(size).max_element();
        let in_picture = |seen: DVec3| {
            let eye = shot.camera.observer_from_eye.conjugate() * seen;
            let at = eye.truncate() / -eye.z;
            eye.z < 0.0 && at.cmpgt(tangents.low).all() && at.cmplt(tangents.high).all()
        };
        let kernel = direction_error_rad(shot.observer.celerity.gamma());
        let mut certainty = Self { pixel_rad, ..Self::default() };
        match drawn {
            EdgesDrawn::ByKernel => certainty.rounded_rad = kernel,
            EdgesDrawn::InFull => certainty.rounded_rad = 2.0 * STEP,
            EdgesDrawn::FromMap { texels_per_pixel } => {
                certainty.drawn_rad = 0.5 * pixel_rad / texels_per_pixel.max(1e-3);
                certainty.rounded_rad = 2.0 * STEP;
            }
        }
        let mut sights = Vec::new();
        let mut seen_edges = 0;
        let mut usual = Usual::default();
        for ([a, b], motion) in &edges.ends {
            let index = sights.iter().position(|(of, _)| of == motion).unwrap_or_else(|| {
                sights.push((*motion, sight_of(*motion)));
                sights.len() - 1
            });
            let sight: &SeenFrom = &sights[index].1;
            let [from, to] = [a, b].map(|end| sight.towards(*end));
            let (middle, seen) = (0.5 * (from + to), sight.bend.apparent(0.5 * (from + to)));
            if !seen.is_finite() {
                continue;
            }
            // Positions about the scene's origin are turned and shifted in f32.
            let about = (0.5 * (*a + *b)).abs().max_element().max(sight.place.abs().max_element());
            usual.add(from.distance(to) / middle.length(), about / middle.length());
            if !in_picture(sight.observer_from_group * seen) {
                continue;
            }
            seen_edges += 1;
            if let EdgesDrawn::FromMap { .. } = drawn {
                let rounded = 2.0 * STEP * about / seen.length();
                certainty.rounded_rad = certainty.rounded_rad.max(rounded);
            } else {
                let error = match &sight.body {
                    None => sight.bend.error(middle, 0.5 * (from.length() + to.length())),
                    Some(body) => {
                        EdgeChord::of(|place| body.seen(place), [*a, *b], 0.0).map_or(0.0, |chord| chord.error_rad)
                    }
                };
                certainty.drawn_rad = certainty.drawn_rad.max(error);
            }
        }
        // If hardly any edge is in the picture, estimate from the usual edges of the scene.
        if seen_edges < FEW && drawn != EdgesDrawn::InFull && !edges.ends.is_empty() {
            let aberration = Aberration::new(shot.observer.celerity);
            let bend = TriangleInterpolation::new(shot.observer.celerity);
            let (length, about) = usual.median();
            for place in (0..81).map(|place| DVec2::new(f64::from(place % 9), f64::from(place / 9)) / 4.0 - 1.0) {
                let eye = (tangents.middle() + place * tangents.half()).extend(-1.0);
                let (world, doppler) = aberration.world_from_observer(shot.camera.observer_from_eye * eye);
                if let EdgesDrawn::FromMap { .. } = drawn {
                    certainty.rounded_rad = certainty.rounded_rad.max((2.0 * STEP * about / doppler).min(1.0));
                } else {
                    let error = length * length / 8.0 * bend.steepness(world);
                    certainty.drawn_rad = certainty.drawn_rad.max(error.min(1.0));
                }
            }
        }
        certainty
    }

    /// Larger of each error of two parts of a picture.
    pub fn or_worse(self, other: Self) -> Self {
        Self {
            drawn_rad: self.drawn_rad.max(other.drawn_rad),
            rounded_rad: self.rounded_rad.max(other.rounded_rad),
            pixel_rad: self.pixel_rad,
        }
    }

    /// Sum of both errors, radians.
    pub fn error_rad(&self) -> f64 {
        self.drawn_rad + self.rounded_rad
    }

    /// Sum of both errors, pixels.
    pub fn error_px(&self) -> f64 {
        if self.pixel_rad > 0.0 { self.error_rad() / self.pixel_rad } else { 0.0 }
    }

    /// Sum of both errors as text, in arcminutes or a unit that fits. `units`: names of arcminute and arcsecond.
    pub fn about(&self, [arcmin, arcsec]: [&str; 2]) -> String {
        match self.error_rad().to_degrees() * 60.0 {
            minutes if minutes >= 120.0 => format!("{:.0}°", minutes / 60.0),
            minutes if minutes >= 10.0 => format!("{minutes:.0} {arcmin}"),
            minutes if minutes >= 0.1 => format!("{minutes:.1} {arcmin}"),
            minutes => format!("{:.1} {arcsec}", 60.0 * minutes),
        }
    }

    /// True for a picture whose error is above `NOTICED_PX`.
    pub fn is_noticed(&self) -> bool {
        self.error_px() > NOTICED_PX
    }

    /// True if rounded numbers are the larger error.
    pub fn is_rounded(&self) -> bool {
        self.rounded_rad > self.drawn_rad
    }

    /// Sentence that says how large the error is, and why.
    pub fn sentence(&self) -> String {
        let about = self.about(["arcmin", "arcsec"]);
        if self.is_rounded() {
            format!("directions astern are uncertain by about {about}: 32 bits hold no more; --renderer polygon does")
        } else {
            format!(
                "directions are uncertain by about {about}; a smaller --tolerance, --edge or a larger --map-scale helps"
            )
        }
    }
}

#[cfg(test)]
mod tests {
    //! The estimate must agree with the picture: coarse edges get a notice, fine ones do not, and the map's rounding
    //! errors astern are found.

    use super::*;
    use built_in::lattice::Lattice;
    use physics::{Celerity, Event, Observer};
    use scene::refine::refine;
    use view::Camera;
    use view::Effects;

    fn of(scene: &Scene, speed: f64, look: DVec3, drawn: EdgesDrawn) -> Certainty {
        let shot = Shot {
            camera: Camera::looking(look, DVec3::Y, 1.2),
            observer: Observer {
                event: Event { ct: 0.0, position: DVec3::new(0.3, 0.1, 0.2) },
                celerity: Celerity::new(DVec3::NEG_Z * speed).unwrap(),
            },
            effects: Effects::ALL,
            stored_scale: None,
            outside: None,
        };
        let sight = |motion| SeenFrom::new(scene, &shot.observer, motion);
        Certainty::of(&Edges::of(scene), sight, &shot, [1280, 720], drawn)
    }

    #[test]
    fn coarse_edges_are_told_and_fine_ones_are_not() {
        let coarse = Lattice { count: [4, 4, 4], ..Lattice::default() }.build();
        let fine = refine(&coarse, 0.05).unwrap();
        let said = |scene, speed| of(scene, speed, DVec3::NEG_Z, EdgesDrawn::ByKernel);
        assert!(said(&coarse, 0.0).error_px() < 0.01);
        assert!(said(&coarse, 5.0).is_noticed(), "{:?}", said(&coarse, 5.0));
        assert!(!said(&fine, 0.75).is_noticed(), "{:?}", said(&fine, 0.75));
        assert!(said(&fine, 0.75).error_rad() < said(&coarse, 0.75).error_rad() / 10.0);
    }

    #[test]
    fn the_map_loses_directions_astern_and_says_so() {
        let scene = Lattice { count: [12, 12, 12], ..Lattice::default() }.build();
        let map = EdgesDrawn::FromMap { texels_per_pixel: 4.0 };
        let (slow, fast) = (of(&scene, 0.75, DVec3::Z, map), of(&scene, 701.0, DVec3::Z, map));
        assert!(!slow.is_noticed() && slow.rounded_rad < 1e-4, "{slow:?}");
        // One rounding step of f32, enlarged 1400 times.
        assert!((1e-4..1e-2).contains(&fast.rounded_rad), "{fast:?}");
        let fastest = of(&scene, 1e6, DVec3::Z, map);
        assert!(fastest.is_noticed() && fastest.sentence().contains("astern"), "{fastest:?}");
        let ahead = of(&scene, 1e6, DVec3::NEG_Z, map);
        assert!(ahead.rounded_rad < 0.1 * of(&scene, 1e6, DVec3::Z, map).rounded_rad, "{ahead:?}");
    }

    #[test]
    fn edges_half_a_metre_long_do_not_do_astern_at_gamma_701() {
        let scene = refine(&Lattice::default().build(), 0.5).unwrap();
        let fixed = of(&scene, 701.0, DVec3::Z, EdgesDrawn::ByKernel);
        assert!(fixed.is_noticed(), "{fixed:?}");
        assert!(!of(&scene, 701.0, DVec3::Z, EdgesDrawn::InFull).is_noticed());
    }
}
