//! Lamps: points at rest in the world that shine in all directions, or in a cone.
//!
//! Only the ray tracer draws lamps.

use glam::DVec3;
use physics::colour::Spectrum;
use physics::{Aberration, Celerity};

/// Point light (`KHR_lights_punctual`: point, spot).
#[derive(Clone, Debug, PartialEq)]
pub struct Lamp {
    /// Name from the file, for messages.
    pub name: String,
    /// Position in the world, metres.
    pub position: DVec3,
    /// Light on a surface that faces the lamp one metre away, on the scale of [`super::Lighting::sun`].
    pub colour: [f32; 3],
    /// Range beyond which the lamp does not shine, metres.
    pub range: Option<f64>,
    /// Cone of a spot light; `None` if the lamp shines in all directions.
    pub spot: Option<Spot>,
    /// Spectrum of light of colour 1 from a white surface. `None`: the scene's illuminant.
    pub spectrum: Option<Spectrum>,
}

/// Cone of a spot light.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Spot {
    /// Axis of the cone: unit vector along which it shines, world axes.
    pub direction: DVec3,
    /// Half-angle within which it has full brightness, radians.
    pub inner_rad: f64,
    /// Half-angle beyond which it is dark, radians.
    pub outer_rad: f64,
}

/// Light of a lamp on a surface, in the surface's frame.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Lamplight {
    /// Direction towards the lamp, unit vector, surface's frame.
    pub direction: DVec3,
    /// Doppler factor, ν_surface / ν_lamp.
    pub doppler: f64,
    /// Factor of [`Lamp::colour`] on a surface that faces the lamp; the shift of wavelengths is applied in addition.
    pub strength: f64,
}

impl Lamp {
    /// Light of the lamp on a surface that is at `place` (world, metres) and moves with `celerity`; `None` at the
    /// lamp itself.
    ///
    /// *Frames:* the direction is in the axes of the pure boost into the surface's frame.
    ///
    /// *Equation:* D² / r², r in the world. The lamp's Ṅ photons per second pass a place at rest as the current N (1,
    /// k), N = Ṅ / (4π r²), k from the lamp. In the surface's frame its time component, which is the flux through an
    /// area across it, is γ (1 − β·k) N = D N, and every photon has D times the energy. With the apparent distance r'
    /// = D r it is D⁴ / r'², the brightened image of the lamp.
    pub fn falling(&self, place: DVec3, celerity: Celerity) -> Option<Lamplight> {
        let away = self.position - place;
        let distance = away.length();
        let towards = away.try_normalize()?;
        let (direction, doppler) = Aberration::new(celerity).observer_from_world(towards);
        // glTF's own window function for a range, and its soft edge of a cone.
        let near = self.range.map_or(1.0, |range| (1.0 - (distance / range).powi(4)).clamp(0.0, 1.0));
        let cone = self.spot.map_or(1.0, |spot| spot.brightness(-towards));
        let strength = near * cone * doppler * doppler / (distance * distance);
        strength.is_finite().then_some(Lamplight { direction, doppler, strength })
    }
}

impl Spot {
    /// Relative brightness of the cone in a direction, world axes; 0 to 1.
    fn brightness(&self, direction: DVec3) -> f64 {
        let (inner, outer) = (self.inner_rad.cos(), self.outer_rad.cos());
        let share = (direction.dot(self.direction) - outer) / (inner - outer).max(1e-3);
        share.clamp(0.0, 1.0).powi(2)
    }
}

#[cfg(test)]
mod tests {
    //! Law under test: a moving surface gets as many photons of a lamp as the world counts, and each with another
    //! energy. A wrong power of D, or an angle of the wrong frame, differs from a count in the world.

    use super::*;
    use physics::{Beta, Boost, FourVector};
    use rand::{RngExt, SeedableRng};
    use rand_chacha::ChaCha8Rng;

    fn lamp() -> Lamp {
        Lamp { name: String::new(), position: DVec3::ZERO, colour: [1.0; 3], range: None, spot: None, spectrum: None }
    }

    #[test]
    fn a_moving_plate_gets_the_photons_that_the_world_sees_it_meet() {
        let mut random = ChaCha8Rng::seed_from_u64(11);
        let mut vector = |size: f64| DVec3::from_array([0, 1, 2].map(|_| size * random.random_range(-1.0..1.0)));
        for _ in 0..1000 {
            let (place, normal) = (vector(5.0), vector(1.0).normalize());
            let celerity = Celerity::new(vector(4.0)).expect("finite");
            let light = lamp().falling(place, celerity).expect("it is not there");
            let cosine = normal.dot(light.direction);

            // In the world, the plate's area is spanned by its two sides at one moment, and the plate runs into the
            // light or away from it.
            let stretch = |v: DVec3| Boost::observer_from_world(celerity).apply(FourVector { t: 0.0, r: v }).r;
            let area = stretch(normal) / celerity.gamma();
            let (distance, along) = (place.length(), place.normalize());
            let each_second = (along - celerity.beta().vector()).dot(-area) / (distance * distance);
            // Converted to the plate's own clock, and to the energy of each photon in the plate's frame.
            let energy = celerity.gamma() * (1.0 - celerity.beta().vector().dot(along));
            let expected = each_second * celerity.gamma() * energy;
            let got = light.strength * cosine;
            assert!((got - expected).abs() < 1e-12 * (light.strength + expected.abs()), "{got} {expected}");
        }
    }

    #[test]
    fn a_lamp_is_dimmer_by_the_square_of_its_distance_and_ends() {
        let strength = |lamp: &Lamp, place| lamp.falling(place, Celerity::ZERO).map(|light| light.strength);
        assert_eq!(strength(&lamp(), DVec3::X * 2.0), Some(0.25));
        assert_eq!(strength(&lamp(), DVec3::ZERO), None);
        let near = Lamp { range: Some(4.0), ..lamp() };
        assert_eq!(strength(&near, DVec3::X * 2.0), Some(0.25 * (1.0 - 1.0 / 16.0)));
        assert_eq!(strength(&near, DVec3::X * 4.1), Some(0.0));
        let spot = Spot { direction: DVec3::X, inner_rad: 0.2, outer_rad: 0.4 };
        let spot = Lamp { spot: Some(spot), ..lamp() };
        let at = |angle: f64| strength(&spot, DVec3::new(angle.cos(), angle.sin(), 0.0)).expect("it is not there");
        assert!((at(0.1) - 1.0).abs() < 1e-12 && at(0.41) == 0.0 && (0.1..0.9).contains(&at(0.3)));
        // The surface flies towards the lamp at 0.6 c: D = 2.
        let flying = Beta::new(DVec3::NEG_X * 0.6).expect("slower than light").celerity();
        let light = lamp().falling(DVec3::X * 2.0, flying).expect("it is not there");
        assert!((light.doppler - 2.0).abs() < 1e-15 && (light.strength - 1.0).abs() < 1e-14);
    }
}
