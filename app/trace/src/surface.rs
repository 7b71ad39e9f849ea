//! Light that leaves a point of a surface towards the observer, in the frame in which the point rests: the f64 twin of
//! `surface.wgsl` and `sky.wgsl`.
//!
//! Textures are sampled at their full size, as the mean of the four nearest texels weighted by distance. The mean
//! over a pixel is left to the pixel's samples.

use super::bodies::Bodies;
use super::finish::Finish;
use super::hit::{Emission, RayHit};
use super::light::{LightShifts, SentLight};
use glam::{DVec3, DVec4, Vec2, Vec3, Vec4};
use physics::Observer;
use physics::colour::luminance;
use scene::carriers::{SceneCarriers, WHITE};
use scene::irradiance::Irradiance;
use scene::mipmap::linear_from_srgb;
use scene::motion::Motion;
use scene::{Alpha, Lamp, Lamplight, Lighting, Mesh, Panorama, Scene, Texture, Wrap};
use std::f64::consts::TAU;
use std::sync::Arc;
use view::Places;

/// Light that a scene's surfaces and its sky emit.
pub struct LitSurfaces {
    /// Scene as it was given.
    pub scene: Arc<Scene>,
    carriers: SceneCarriers,
    /// Irradiance of the resting scene, and of each motion.
    irradiance: (Irradiance, Vec<Irradiance>),
    /// Linear value of each sRGB code.
    linear: [f64; 256],
}

impl LitSurfaces {
    /// Computes the irradiance of the resting scene and of its motions.
    pub fn new(scene: Arc<Scene>, carriers: SceneCarriers) -> Self {
        let sky = &carriers.carriers[carriers.sky];
        let on_moving = |motion: &Motion| match motion {
            Motion::Uniform(uniform) => Irradiance::on_moving(&scene.light, uniform.celerity, sky),
            // This is computed again for every picture.
            Motion::Animated(_) => Irradiance::at_rest(&scene.light),
        };
        let irradiance = (Irradiance::at_rest(&scene.light), scene.motions.iter().map(on_moving).collect());
        let linear = std::array::from_fn(|code| f64::from(linear_from_srgb(code as f32 / 255.0)));
        Self { scene, carriers, irradiance, linear }
    }

    /// True if the material's mask leaves the surface there.
    pub fn is_there(&self, hit: &RayHit) -> bool {
        match self.scene.materials[self.scene.meshes[hit.mesh].material].alpha {
            Alpha::Opaque | Alpha::Blend => true,
            Alpha::Mask(threshold) => self.base(hit).w >= f64::from(threshold),
        }
    }

    /// Irradiance of each of the scene's motions, as it is shown to an observer.
    pub fn irradiances(&self, observer: &Observer, places: Places) -> Vec<Irradiance> {
        let sky = &self.carriers.carriers[self.carriers.sky];
        let irradiance = |(motion, irradiance): (&Motion, &Irradiance)| match motion {
            Motion::Uniform(_) => *irradiance,
            Motion::Animated(animated) => Irradiance::on_animated(&self.scene.light, animated, observer, places, sky),
        };
        self.scene.motions.iter().zip(&self.irradiance.1).map(irradiance).collect()
    }

    /// Opacity of a point, and the weights that it emits. `moving`: irradiance of each motion.
    pub fn light(
        &self,
        hit: &RayHit,
        emission: Emission,
        moving: &[Irradiance],
        bodies: &Bodies,
        light: &LightShifts,
    ) -> (f64, SentLight) {
        let mesh = &self.scene.meshes[hit.mesh];
        let material = &self.scene.materials[mesh.material];
        let base = self.base(hit);
        let mut weights = base.truncate();
        if material.spectrum.is_some() {
            weights = DVec3::splat(luminance(weights));
        }
        // An emissive material with a spectrum emits nothing else.
        let source = material.unlit || (material.spectrum.is_some() && material.is_source());
        let mut of_lamps = Vec::new();
        if !source {
            let mut irradiance = self.irradiance_on(hit, bodies, moving);
            for (lamp, light_of_it) in self.of_lamps(hit, emission, bodies, light) {
                match light.carrier_of_lamp(lamp, mesh.material) {
                    None => irradiance += light_of_it,
                    Some(carrier) => of_lamps.push((weights * light_of_it, carrier)),
                }
            }
            weights *= irradiance;
        }
        let mut emitted = if source { DVec3::ZERO } else { rgb(material.emissive) };
        if emitted != DVec3::ZERO {
            emitted *= self.look_up(material.emissive_texture, hit, Mesh::emissive_uv).truncate();
        }
        let opacity = if material.alpha == Alpha::Blend { base.w.clamp(0.0, 1.0) } else { 1.0 };
        let returned = (weights, self.carriers.materials[mesh.material]);
        (opacity, SentLight { returned, of_lamps, emitted: (emitted, WHITE) })
    }

    /// Light from a world direction in which there is no surface.
    pub fn sky(&self, direction: DVec3, background: Option<[f32; 3]>) -> SentLight {
        // Backgrounds and panoramas are given relative to white.
        let white = self.carriers.white_luminance;
        let sent = match (background, &self.scene.panorama) {
            (Some(colour), _) => (rgb(colour) * white, WHITE),
            (None, Some(panorama)) => (surrounding(panorama, direction) * white, WHITE),
            (None, None) => (sky(&self.scene.light, direction), self.carriers.sky),
        };
        SentLight { returned: sent, ..SentLight::default() }
    }

    /// Finish of a point; `None` if it is rough or animated.
    pub fn finish(&self, hit: &RayHit) -> Option<Finish> {
        let mesh = &self.scene.meshes[hit.mesh];
        if mesh.motion.is_some_and(|motion| self.scene.motions[motion].animated().is_some()) {
            return None;
        }
        let material = &self.scene.materials[mesh.material];
        Finish::of(material, || self.base(hit).truncate())
    }

    /// Interpolated normal of a point in its body's frame, on the visible side.
    pub fn normal(&self, hit: &RayHit) -> DVec3 {
        let mesh = &self.scene.meshes[hit.mesh];
        let [a, b, c] = hit.corners.map(|corner| mesh.normals[corner].as_dvec3());
        let normal = (a * hit.weights[0] + b * hit.weights[1] + c * hit.weights[2]).normalize_or_zero();
        if hit.front { normal } else { -normal }
    }

    /// Base colour and opacity of a point.
    fn base(&self, hit: &RayHit) -> DVec4 {
        let mesh = &self.scene.meshes[hit.mesh];
        let material = &self.scene.materials[mesh.material];
        let [a, b, c] = hit.corners.map(|corner| Vec4::from_array(mesh.colour(corner)).as_dvec4());
        let colour = a * hit.weights[0] + b * hit.weights[1] + c * hit.weights[2];
        Vec4::from_array(material.base_colour).as_dvec4()
            * colour
            * self.look_up(material.base_colour_texture, hit, Mesh::uv)
    }

    /// Irradiance of a point, by its interpolated normal on the visible side.
    fn irradiance_on(&self, hit: &RayHit, bodies: &Bodies, moving: &[Irradiance]) -> DVec3 {
        let mesh = &self.scene.meshes[hit.mesh];
        let normal = self.normal(hit);
        if let Some(irradiance) = mesh.motion.and_then(|motion| moving.get(motion)) {
            return irradiance.on(normal, 1.0);
        }
        let irradiance = &self.irradiance.0;
        let asks = self.scene.light.shadows && normal.dot(irradiance.sun_direction) > 0.0;
        let lit = !asks || bodies.sunlit(hit.position, normal, irradiance.sun_direction);
        irradiance.on(normal, if lit { 1.0 } else { 0.0 })
    }

    /// Light of the lamps that reach a point: indices of lamps, and weights on each lamp's carrier.
    fn of_lamps(&self, hit: &RayHit, emission: Emission, bodies: &Bodies, light: &LightShifts) -> Vec<(usize, DVec3)> {
        let scene = &self.scene;
        if scene.lamps.is_empty() {
            return Vec::new();
        }
        // Turn the normal from the body's own axes to the world's.
        let normal = bodies.axes(emission) * self.normal(hit);
        let moves = scene.meshes[hit.mesh].motion.is_some();
        let surface = bodies.in_world(scene, emission, hit.position);
        let place = surface.event.position;
        let of = |(number, lamp): (usize, &Lamp)| {
            let Lamplight { direction, doppler, strength } = lamp.falling(place, surface.celerity)?;
            let cosine = normal.dot(direction);
            let lit = strength > 0.0 && cosine > 0.0;
            let offset = if moves { DVec3::ZERO } else { normal };
            if !lit || !bodies.lamplit(place - scene.origin, offset, lamp.position - place) {
                return None;
            }
            let weights = rgb(lamp.colour) * (strength * cosine);
            Some((number, light.shifted_lamp(number, weights, doppler)))
        };
        scene.lamps.iter().enumerate().filter_map(of).collect()
    }

    /// Value of a texture where a ray hits, at the texture coordinates that `uv` gives for a vertex.
    fn look_up(&self, texture: Option<usize>, hit: &RayHit, uv: impl Fn(&Mesh, usize) -> Vec2) -> DVec4 {
        let Some(texture) = texture.map(|index| &self.scene.textures[index]).filter(|texture| !texture.rgba.is_empty())
        else {
            return DVec4::ONE;
        };
        let mesh = &self.scene.meshes[hit.mesh];
        let [a, b, c] = hit.corners.map(|corner| uv(mesh, corner).as_dvec2());
        let uv = a * hit.weights[0] + b * hit.weights[1] + c * hit.weights[2];
        let (x, y) = (uv.x * f64::from(texture.width), uv.y * f64::from(texture.height));
        if texture.nearest {
            return self.texel(texture, x.floor(), y.floor());
        }
        mixed(x, y, |x, y| self.texel(texture, x, y))
    }

    fn texel(&self, texture: &Texture, x: f64, y: f64) -> DVec4 {
        let column = wrapped(x, texture.width, texture.wrap[0]);
        let row = wrapped(y, texture.height, texture.wrap[1]);
        let start = 4 * (row * texture.width as usize + column);
        let [red, green, blue, alpha] = [0, 1, 2, 3].map(|channel| texture.rgba[start + channel]);
        let linear = |code: u8| self.linear[usize::from(code)];
        DVec4::new(linear(red), linear(green), linear(blue), f64::from(alpha) / 255.0)
    }
}

/// Bilinear mean of the four texels whose middles are around a place.
fn mixed<T>(x: f64, y: f64, texel: impl Fn(f64, f64) -> T) -> T
where
    T: std::ops::Mul<f64, Output = T> + std::ops::Add<Output = T>,
{
    let (x, y) = (x - 0.5, y - 0.5);
    let (left, top) = (x.floor(), y.floor());
    let (right_share, bottom_share) = (x - left, y - top);
    let row = |y: f64| texel(left, y) * (1.0 - right_share) + texel(left + 1.0, y) * right_share;
    row(top) * (1.0 - bottom_share) + row(top + 1.0) * bottom_share
}

/// Index of the texel in a row of `side` texels for an integer place inside or outside the row.
fn wrapped(place: f64, side: u32, wrap: Wrap) -> usize {
    let side = f64::from(side);
    let inside = match wrap {
        Wrap::Repeat => place.rem_euclid(side),
        Wrap::Mirror => {
            let place = place.rem_euclid(2.0 * side);
            if place < side { place } else { 2.0 * side - 1.0 - place }
        }
        Wrap::Clamp => place,
    };
    // A place that is not a number gives the first texel.
    inside.clamp(0.0, side - 1.0) as usize
}

fn surrounding(panorama: &Panorama, direction: DVec3) -> DVec3 {
    let longitude = direction.x.atan2(-direction.z);
    let latitude = direction.y.atan2(direction.x.hypot(direction.z));
    let x = (0.5 + longitude / TAU) * f64::from(panorama.width);
    let y = (0.5 - 2.0 * latitude / TAU) * f64::from(panorama.height);
    mixed(x, y, |x, y| {
        let column = wrapped(x, panorama.width, Wrap::Repeat);
        let row = wrapped(y, panorama.height, Wrap::Clamp);
        rgb(panorama.pixel(column, row))
    })
}

/// Radiance of the sky: a gradient from the horizon up, haze below, and the glow around the sun.
fn sky(light: &Lighting, direction: DVec3) -> DVec3 {
    let (horizon, zenith, ground) = (rgb(light.horizon), rgb(light.zenith), rgb(light.ground));
    let above = |altitude: f64| smoothstep(0.0, f64::from(shaders::SKY_ZENITH_FROM), altitude.max(0.0).sqrt());
    let clear = horizon.lerp(zenith, above(direction.y));
    let depth = f64::from(shaders::SKY_HAZE_DEPTH);
    let haze = (ground * f64::from(shaders::SKY_HAZE)).lerp(clear, smoothstep(-depth, 0.0, direction.y));
    let towards_sun = direction.dot(light.sun_direction.as_dvec3()).max(0.0);
    let [outer, inner] = shaders::SKY_SUN_EDGE.map(f64::from);
    let glow = f64::from(shaders::SKY_GLOW) * towards_sun.powi(shaders::SKY_GLOW_POWER as i32)
        + f64::from(shaders::SKY_SUN) * smoothstep(outer, inner, towards_sun);
    haze + glow * rgb(light.sun)
}

fn smoothstep(low: f64, high: f64, value: f64) -> f64 {
    let share = ((value - low) / (high - low)).clamp(0.0, 1.0);
    share * share * (3.0 - 2.0 * share)
}

fn rgb(colour: [f32; 3]) -> DVec3 {
    Vec3::from_array(colour).as_dvec3()
}
