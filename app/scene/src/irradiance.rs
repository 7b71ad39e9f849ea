//! Irradiance: the light that falls on a surface, in the surface's own frame, as every renderer uses it.
//!
//! On resting meshes it is the scene's sun and its hemisphere of sky and ground. On uniformly moving meshes the sun
//! comes from the aberrated direction, with shifted colour and D² times the flux (a parallel beam: D⁴ of radiance
//! over D² of solid angle), and the hemisphere is the world's, boosted, to first order in the normal (W 5.1.4). On an
//! animated body it is the light for its velocity at the moment at which it is seen, along its axes. Colours stay
//! weights on the sky's carrier; after a shift they are the weights that look the same to the standard observer.

use crate::lighting::Lighting;
use crate::motion::Animated;
use glam::{DMat3, DVec3, DVec4, Vec3};
use physics::colour::Carrier;
use physics::{Aberration, Celerity, Observer};
use view::Places;

/// Irradiance of a diffuse surface by its normal: weights on the sky's carrier.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Irradiance {
    /// Unit vector towards the sun, surface's frame.
    pub sun_direction: DVec3,
    /// Light of the sun on a surface that faces it.
    pub sun: DVec3,
    /// Light of sky and ground: red, green and blue as xyz · normal + w.
    pub ambient: [DVec4; 3],
}

impl Irradiance {
    /// Light on meshes that rest in the world.
    pub fn at_rest(light: &Lighting) -> Self {
        let [sky, ground, sun] = [light.sky, light.ground, light.sun].map(|colour| Vec3::from_array(colour).as_dvec3());
        let (mean, half) = (0.5 * (sky + ground), 0.5 * (sky - ground));
        let ambient = [0, 1, 2].map(|channel| DVec4::new(0.0, half[channel], 0.0, mean[channel]));
        Self { sun_direction: light.sun_direction.as_dvec3(), sun, ambient }
    }

    /// Light on meshes that move with `celerity`, in their own frame. `carrier`: the sky's.
    ///
    /// *Equation:* the hemisphere a + b·n is the irradiance of the radiance a + (3/2) b·ω; in the moving frame a' =
    /// ⟨L'⟩ and b' = 2 ⟨L' ω'⟩ over all directions there, which are means of D² L in the world.
    pub fn on_moving(light: &Lighting, celerity: Celerity, carrier: &Carrier) -> Self {
        let rest = Self::at_rest(light);
        if celerity == Celerity::ZERO {
            return rest;
        }
        let back = carrier.rgb_from_weights(1.0).inverse();
        let shifted = |doppler: f64| back * carrier.rgb_from_weights(doppler);
        let object = Aberration::new(celerity);
        let (sun_direction, doppler) = object.observer_from_world(rest.sun_direction);
        let sun = shifted(doppler) * rest.sun * (doppler * doppler);

        // Directions of the world around the motion: D depends only on the angle from it.
        const RINGS: u32 = 96;
        const SPOKES: u32 = 12;
        let along = celerity.vector().normalize_or(DVec3::NEG_Z);
        let across = along.any_orthonormal_vector();
        let other = along.cross(across);
        let mut sums = DMat3::ZERO;
        let mut mean = DVec3::ZERO;
        for ring in 0..RINGS {
            let cosine = -1.0 + (2.0 * f64::from(ring) + 1.0) / f64::from(RINGS);
            let sine = (1.0 - cosine * cosine).sqrt();
            let (_, doppler) = object.observer_from_world(along * cosine + across * sine);
            let weights_of = shifted(doppler) * (doppler * doppler / f64::from(RINGS * SPOKES));
            for spoke in 0..SPOKES {
                let (s, c) = (std::f64::consts::TAU * f64::from(spoke) / f64::from(SPOKES)).sin_cos();
                let direction = along * cosine + (across * c + other * s) * sine;
                let (seen, _) = object.observer_from_world(direction);
                let radiance =
                    DVec3::from_array(rest.ambient.map(|channel| channel.w + 1.5 * channel.truncate().dot(direction)));
                let weights = weights_of * radiance;
                mean += weights;
                sums += DMat3::from_cols(weights * seen.x, weights * seen.y, weights * seen.z);
            }
        }
        let ambient = [0, 1, 2].map(|channel| (2.0 * sums.row(channel)).extend(mean[channel]));
        Self { sun_direction, sun, ambient }
    }

    /// Light on an animated body, along its own axes, at the event of its middle that is shown. `carrier`: the sky's.
    ///
    /// The velocity of its middle stands for the whole body. D of the light that the body sends out is each point's
    /// own.
    pub fn on_animated(
        light: &Lighting,
        animated: &Animated,
        observer: &Observer,
        places: Places,
        carrier: &Carrier,
    ) -> Self {
        let pose = animated.as_shown(observer, places);
        let Self { sun_direction, sun, ambient } = Self::on_moving(light, animated.celerity(&pose), carrier);
        let body_from_world = pose.axes().transpose();
        let turned = |channel: DVec4| (body_from_world * channel.truncate()).extend(channel.w);
        Self { sun_direction: body_from_world * sun_direction, sun, ambient: ambient.map(turned) }
    }

    /// Light on a surface with this unit normal, of which the share `sunlit` (0 to 1) is in the sun.
    pub fn on(&self, normal: DVec3, sunlit: f64) -> DVec3 {
        let ambient = DVec3::from_array(self.ambient.map(|channel| channel.dot(normal.extend(1.0)).max(0.0)));
        ambient + self.sun * (normal.dot(self.sun_direction).max(0.0) * sunlit)
    }
}

#[cfg(test)]
mod tests {
    //! Law under test: the light on a moving surface is the world's light as an observer on that surface sees it. A
    //! wrong power of D, a boost the wrong way or a colour shifted twice differs from a plain sum over directions of
    //! the surface's own frame.

    use super::*;
    use physics::Beta;

    fn celerity(beta: DVec3) -> Celerity {
        Beta::new(beta).expect("slower than light").celerity()
    }

    /// Means over directions of the moving frame: mean of L', and mean of L' times the direction.
    fn summed(light: &Lighting, celerity: Celerity, carrier: &Carrier) -> (DVec3, [DVec3; 3]) {
        let rest = Irradiance::at_rest(light);
        let object = Aberration::new(celerity);
        let back = carrier.rgb_from_weights(1.0).inverse();
        let count = 4000;
        let (mut mean, mut sums) = (DVec3::ZERO, [DVec3::ZERO; 3]);
        for n in 0..count {
            // Fibonacci's spiral: directions evenly spread over the sphere.
            let z = 1.0 - (2.0 * f64::from(n) + 1.0) / f64::from(count);
            let (sine, cosine) = (f64::from(n) * 2.399_963_229_728_653).sin_cos();
            let seen = DVec3::new(cosine, sine, 0.0) * (1.0 - z * z).sqrt() + DVec3::Z * z;
            let (direction, doppler) = object.world_from_observer(seen);
            let radiance = rest.ambient.map(|channel| channel.w + 1.5 * channel.truncate().dot(direction));
            let weights = back * carrier.rgb_from_weights(doppler) * DVec3::from_array(radiance) * doppler.powi(4)
                / f64::from(count);
            mean += weights;
            for (sum, weight) in sums.iter_mut().zip(weights.to_array()) {
                *sum += seen * weight;
            }
        }
        (mean, sums)
    }

    #[test]
    fn at_rest_light_is_the_scenes_own() {
        let light = Lighting::default();
        let irradiance = Irradiance::on_moving(&light, Celerity::ZERO, &Carrier::white());
        assert_eq!(irradiance.on(DVec3::Y, 0.0), Vec3::from_array(light.sky).as_dvec3());
        let below = irradiance.on(DVec3::NEG_Y, 0.0) - Vec3::from_array(light.ground).as_dvec3();
        assert!(below.length() < 1e-15);
        let facing =
            irradiance.on(light.sun_direction.as_dvec3(), 1.0) - irradiance.on(light.sun_direction.as_dvec3(), 0.0);
        assert!((facing - Vec3::from_array(light.sun).as_dvec3()).length() < 1e-6);
    }

    #[test]
    fn the_hemisphere_of_a_moving_surface_is_the_worlds_boosted() {
        let (light, carrier) = (Lighting::default(), Carrier::white());
        for beta in [DVec3::X * 0.1, DVec3::new(0.3, -0.2, 0.6), DVec3::Y * -0.9] {
            let irradiance = Irradiance::on_moving(&light, celerity(beta), &carrier);
            let (mean, sums) = summed(&light, celerity(beta), &carrier);
            for channel in 0..3 {
                let scale = mean.length();
                assert!((irradiance.ambient[channel].w - mean[channel]).abs() < 0.01 * scale, "{beta}");
                let slope = irradiance.ambient[channel].truncate();
                assert!((slope - 2.0 * sums[channel]).length() < 0.02 * scale, "{beta}: {slope} {:?}", sums[channel]);
            }
        }
    }

    #[test]
    fn the_sun_ahead_is_brighter_by_the_square_of_its_shift() {
        // The body flies into the sun at 0.6 c: D = 2. Grey light of a white carrier keeps about its colour.
        let light = Lighting { sun: [1.0; 3], sun_direction: Vec3::X, ..Lighting::default() };
        let carrier = Carrier::white();
        let irradiance = Irradiance::on_moving(&light, celerity(DVec3::X * 0.6), &carrier);
        assert!((irradiance.sun_direction - DVec3::X).length() < 1e-15);
        let seen = carrier.rgb_from_weights(1.0) * irradiance.sun;
        let shifted = carrier.rgb_from_weights(2.0) * DVec3::ONE * 4.0;
        assert!((seen - shifted).length() < 1e-9 * shifted.length(), "{seen} {shifted}");
        // Light from abeam comes from ahead in the body's frame: cos θ' = β, D = γ.
        let abeam = Irradiance::on_moving(&light, celerity(DVec3::NEG_Z * 0.6), &carrier);
        assert!((abeam.sun_direction - DVec3::new(0.8, 0.0, -0.6)).length() < 1e-15);
    }
}
