//! Reflection and refraction at a smooth surface, in the frame in which it rests: mirror, dielectric, glass.
//!
//! Polished metal reflects light by its base colour. Any other smooth surface reflects at its outermost layer what
//! Fresnel's equations give for its index of refraction. Of the light that enters, glass transmits a share
//! (`KHR_materials_transmission`): bent if the glass has a volume (`KHR_materials_volume`), straight on if it is a
//! pane. The rest is diffuse.

use glam::DVec3;
use scene::Material;

/// Largest roughness of a mirror.
const SMOOTH: f32 = 0.1;

/// Optical properties of a smooth surface.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Finish {
    base: DVec3,
    metallic: f64,
    transmission: f64,
    /// Index of refraction behind the surface.
    pub index: f64,
    /// True if there is a volume behind the surface, which bends light.
    pub solid: bool,
}

/// Sources of a smooth surface's light, as shares. Together they are at most 1.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Shares {
    /// Share of the mirrored light, by colour.
    pub mirrored: DVec3,
    /// Share of the light from behind, by colour.
    pub through: DVec3,
    /// Share of the diffuse light.
    pub diffuse: f64,
}

impl Finish {
    /// Finish of a material with this base colour; `None` if it is rough.
    pub fn of(material: &Material, base: impl FnOnce() -> DVec3) -> Option<Self> {
        (material.roughness <= SMOOTH && !material.unlit).then(|| Self {
            base: base(),
            metallic: f64::from(material.metallic),
            transmission: f64::from(material.transmission),
            index: f64::from(material.index_of_refraction),
            solid: material.solid_glass && material.transmission > 0.0,
        })
    }

    /// Index of refraction beyond the surface over that before it, by the side that the ray meets.
    pub fn beyond(&self, front: bool) -> f64 {
        if self.solid && !front { 1.0 / self.index } else { self.index }
    }

    /// Shares for light that leaves a side at an angle with this cosine to the normal.
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

/// Direction that a mirror shows along `direction`. `normal` points to the side from which the ray comes.
///
/// If the interpolated normal would show what is behind the surface, `plane`, the normal of the flat triangle, is
/// used.
pub fn mirrored(direction: DVec3, normal: DVec3, plane: DVec3) -> DVec3 {
    let by = |normal: DVec3| direction - normal * (2.0 * normal.dot(direction));
    let smooth = by(normal);
    if smooth.dot(plane) > 0.0 { smooth } else { by(plane) }
}

/// Direction beyond a surface. `index` is the index of refraction beyond over that before. `None` if all light is
/// reflected.
///
/// *Equation:* Snell's law: the component along the surface is 1/index of what it was.
pub fn refracted(direction: DVec3, normal: DVec3, index: f64) -> Option<DVec3> {
    let cosine = -normal.dot(direction);
    let along = (direction + normal * cosine) / index;
    let inner = 1.0 - along.length_squared();
    (inner > 0.0).then(|| along - normal * inner.sqrt())
}

/// Share of unpolarised light that is reflected (Fresnel), by the cosine of its angle to the normal. `index` is that
/// of [`refracted`].
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
    //! Fresnel's and Snell's laws at their exact points. A wrong program fails at Brewster's angle or at total
    //! reflection, or loses light.

    use super::*;

    #[test]
    fn glass_reflects_what_fresnel_says() {
        assert!((fresnel(1.0, 1.5) - 0.04).abs() < 1e-15);
        assert!((fresnel(1e-9, 1.5) - 1.0).abs() < 1e-7);
        // At Brewster's angle, tan θ = n, half of sin²(θ − θ') is left, and θ' = 90° − θ.
        let brewster = 1.5_f64.atan();
        let expected = 0.5 * (2.0 * brewster - std::f64::consts::FRAC_PI_2).sin().powi(2);
        assert!((fresnel(brewster.cos(), 1.5) - expected).abs() < 1e-15);
        // Reflection is equal from both sides of the surface, and total beyond the critical angle.
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
