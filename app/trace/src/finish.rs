//! What a smooth surface does to a ray of light, in the frame in which it rests: mirror, dielectric, glass.
//!
//! Polished metal returns light by its base colour. Anything else that is smooth returns by its outermost skin what Fresnel's equations say, for
//! its index of refraction; of what enters, glass lets a share through (`KHR_materials_transmission`), bent where it has a volume
//! (`KHR_materials_volume`) and straight on where it is a pane, and all else is diffuse.

use scene::Material;
use glam::DVec3;

/// Rougher than this is not a mirror.
const SMOOTH: f32 = 0.1;

/// A smooth surface.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Finish {
    base: DVec3,
    metallic: f64,
    transmission: f64,
    /// Of what lies behind the surface.
    pub index: f64,
    /// Whether there is a volume behind it, which bends light.
    pub solid: bool,
}

/// Where the light of a smooth surface comes from. Together no more than 1.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Shares {
    /// Mirrored, by colour.
    pub mirrored: DVec3,
    /// From behind, by colour.
    pub through: DVec3,
    /// Diffuse.
    pub diffuse: f64,
}

impl Finish {
    /// Of a material with this base colour; `None` if it is rough.
    pub fn of(material: &Material, base: impl FnOnce() -> DVec3) -> Option<Self> {
        (material.roughness <= SMOOTH && !material.unlit).then(|| Self {
            base: base(),
            metallic: f64::from(material.metallic),
            transmission: f64::from(material.transmission),
            index: f64::from(material.index_of_refraction),
            solid: material.solid_glass && material.transmission > 0.0,
        })
    }

    /// Index of refraction beyond the surface over that before it, by the side that is met.
    pub fn beyond(&self, front: bool) -> f64 {
        if self.solid && !front { 1.0 / self.index } else { self.index }
    }

    /// For light that leaves a side at an angle of this cosine to the normal.
    pub fn shares(&self, cosine: f64, front: bool) -> Shares {
        let skin = fresnel(cosine, self.beyond(front));
        let entering = (1.0 - self.metallic) * (1.0 - skin);
        Shares {
            mirrored: self.metallic * self.base + DVec3::splat((1.0 - self.metallic) * skin),
            through: self.base * (entering * self.transmission),
            diffuse: entering * (1.0 - self.transmission),
        }
    }
}

/// The direction that a mirror shows along `direction`; `normal` is towards the side that it comes from.
///
/// Where an interpolated normal would show what is behind the surface, that of the flat triangle, `plane`, is taken.
pub fn mirrored(direction: DVec3, normal: DVec3, plane: DVec3) -> DVec3 {
    let by = |normal: DVec3| direction - normal * (2.0 * normal.dot(direction));
    let smooth = by(normal);
    if smooth.dot(plane) > 0.0 { smooth } else { by(plane) }
}

/// The direction beyond a surface, of which `index` is the index of refraction beyond over that before; `None` where all light is reflected.
///
/// *Equation:* Snell's law: the component along the surface is 1/index of what it was.
pub fn refracted(direction: DVec3, normal: DVec3, index: f64) -> Option<DVec3> {
    let cosine = -normal.dot(direction);
    let along = (direction + normal * cosine) / index;
    let inner = 1.0 - along.length_squared();
    (inner > 0.0).then(|| along - normal * inner.sqrt())
}

/// Share of unpolarised light that is reflected (Fresnel), by the cosine of its angle to the normal; `index` as for [`refracted`].
pub fn fresnel(cosine: f64, index: f64) -> f64 {
    let inner = 1.0 - (1.0 - cosine * cosine) / (index * index);
    if inner <= 0.0 {
        return 1.0;
    }
    let inner = inner.sqrt();
    let across = (cosine - index * inner) / (cosine + index * inner);
    let along = (index * cosine - inner) / (index * cosine + inner);
    0.5 * (across * across + along * along)
}

#[cfg(test)]
mod tests {
    //! Fresnel's and Snell's laws at their exact points. A wrong program shows at Brewster's angle, at total reflection, or loses light.

    use super::*;

    #[test]
    fn glass_reflects_what_fresnel_says() {
        assert!((fresnel(1.0, 1.5) - 0.04).abs() < 1e-15);
        assert!((fresnel(1e-9, 1.5) - 1.0).abs() < 1e-7);
        // Brewster's angle, tan θ = n: half of sin²(θ − θ') is left, and θ' = 90° − θ.
        let brewster = 1.5_f64.atan();
        let expected = 0.5 * (2.0 * brewster - std::f64::consts::FRAC_PI_2).sin().powi(2);
        assert!((fresnel(brewster.cos(), 1.5) - expected).abs() < 1e-15);
        // The same from both sides of the surface; beyond the critical angle all.
        let inner = (1.0 - 0.36 / 2.25_f64).sqrt();
        assert!((fresnel(0.8, 1.5) - fresnel(inner, 1.0 / 1.5)).abs() < 1e-15);
        assert_eq!(fresnel(0.7, 1.0 / 1.5), 1.0);
    }

    #[test]
    fn snell_and_the_mirror_hold() {
        let direction = DVec3::new(0.6, -0.8, 0.0);
        let bent = refracted(direction, DVec3::Y, 1.5).unwrap_or_default();
        assert!((bent - DVec3::new(0.4, -(1.0_f64 - 0.16).sqrt(), 0.0)).length() < 1e-15);
        let back = refracted(bent, DVec3::Y, 1.0 / 1.5).unwrap_or_default();
        assert!((back - direction).length() < 1e-15);
        assert_eq!(refracted(direction, DVec3::Y, 0.5), None);
        assert!((mirrored(direction, DVec3::Y, DVec3::Y) - DVec3::new(0.6, 0.8, 0.0)).length() < 1e-15);
    }

    #[test]
    fn white_glass_and_white_metal_lose_nothing() {
        for (metallic, transmission) in [(0.0, 0.0), (0.0, 1.0), (1.0, 0.0), (0.3, 0.6)] {
            let material = Material { metallic, transmission, roughness: 0.0, ..Material::default() };
            let finish = Finish::of(&material, || DVec3::ONE).unwrap_or_else(|| unreachable!("it is smooth"));
            for cosine in [0.1, 0.5, 1.0] {
                let Shares { mirrored, through, diffuse } = finish.shares(cosine, true);
                assert!((mirrored + through + diffuse - DVec3::ONE).length() < 1e-12, "{finish:?}");
            }
        }
        assert_eq!(Finish::of(&Material::default(), || DVec3::ONE), None);
    }
}
