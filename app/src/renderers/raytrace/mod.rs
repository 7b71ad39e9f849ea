//! The reference: one ray of light for every sample of every pixel, followed back to where it came from (W 5.2).
//!
//! A pixel is a direction in the observer's frame. Aberration takes it to the frame of whatever it may meet, in f64 and without any
//! approximation: to the world's for what rests there, to its own for each group of meshes that moves uniformly. In that frame nothing moves, so light
//! travels along a straight line from a body that is where it always was, and a hierarchy of boxes finds the first triangle on the
//! way (`hits`). What is met in several frames is compared by its distance in the observer's, which along one sight line also orders the
//! times at which the light left. The surface there sends out what its material, sun and sky make it send out in its own frame
//! (`surface`); the observer sees it shifted and brightened (`light`).
//!
//! What is animated rests in no frame: in its own a ray is a curve, which is followed where the body is (`curve`).
//!
//! Edges bend by themselves, and no triangle is cut. It is slow, and right: what the other renderers draw is held against it.

mod curve;
mod hits;
mod light;
mod surface;

use super::display::Stored;
use super::world::Spectra;
use super::{Effects, Shot};
use crate::scene::{Scene, SceneFault};
use crate::views::sample_offset;
use glam::{DVec2, DVec3};
use hits::{Bodies, Sight};
use image::Rgb32FImage;
use light::Light;
use physics::Celerity;
use rayon::prelude::*;
use std::sync::atomic::{AtomicBool, Ordering};
use surface::Surfaces;

pub use hits::Place;

/// Pixels along each side of what is traced in one go.
const TILE: u32 = 16;

/// What shines through less than this is not looked at.
const HIDDEN: f64 = 1e-4;

/// A scene, ready to be traced.
pub struct RayTracer {
    surfaces: Surfaces,
    bodies: Bodies,
    light: Light,
    background: Option<[f32; 3]>,
}

/// What was traced: rows from the top; black where nothing was.
#[derive(Clone, Debug, PartialEq)]
pub struct Traced {
    /// Pixels.
    pub size: [u32; 2],
    /// Linear sRGB in cd/m².
    pub light: Vec<DVec3>,
    /// Luminance without any shift, relative to white.
    pub at_rest: Vec<f64>,
    /// How the display is to take it.
    pub stored: Stored,
    /// Tiles that are finished.
    pub done: usize,
    /// Tiles of the whole picture.
    pub tiles: usize,
}

impl Traced {
    /// The light as 32-bit floats; what those do not hold is their largest value.
    pub fn image(&self) -> Rgb32FImage {
        let largest = f64::from(f32::MAX);
        Rgb32FImage::from_fn(self.size[0], self.size[1], |column, row| {
            let index = row as usize * self.size[0] as usize + column as usize;
            image::Rgb(self.light[index].to_array().map(|value| value.clamp(-largest, largest) as f32))
        })
    }

    /// The same as the renderers' targets hold it: relative to white, scaled, with the luminance at rest.
    pub fn texels(&self) -> Vec<[f32; 4]> {
        let largest = f64::from(f32::MAX);
        let factor = self.stored.scale / self.stored.white;
        let short = |value: f64| value.clamp(-largest, largest) as f32;
        let texel = |(light, at_rest): (&DVec3, &f64)| (*light * factor).extend(*at_rest).to_array().map(short);
        self.light.iter().zip(&self.at_rest).map(texel).collect()
    }
}

impl RayTracer {
    /// Sorts the scene. `background`: linear radiance instead of its sky. `exact_light`: integrate the spectrum of every ray instead of
    /// looking it up in the shift table.
    ///
    /// # Errors
    /// [`SceneFault`] if the scene breaks a promise of its types.
    pub fn new(scene: Scene, background: Option<[f32; 3]>, exact_light: bool) -> Result<Self, SceneFault> {
        scene.validate()?;
        let spectra = Spectra::of(&scene);
        let bodies = Bodies::of(&scene);
        let light = Light::new(&spectra, exact_light);
        Ok(Self { surfaces: Surfaces::new(scene, spectra), bodies, light, background })
    }

    /// Traces a picture, on all cores; `finished` is told of every tile. Once `stop` is set, no further tile is begun.
    ///
    /// The result does not depend on the number of threads.
    pub fn trace(
        &self,
        shot: &Shot,
        size: [u32; 2],
        samples: u32,
        stop: &AtomicBool,
        finished: impl Fn() + Sync,
    ) -> Traced {
        let tiles = tiles(size);
        let sight = self.sight(shot);
        let traced: Vec<_> = tiles
            .par_iter()
            .map(|tile| {
                if stop.load(Ordering::Relaxed) {
                    return None;
                }
                let pixels = pixels(*tile).map(|pixel| self.pixel(shot, &sight, size, pixel, samples)).collect();
                finished();
                Some(pixels)
            })
            .collect::<Vec<Option<Vec<(DVec3, f64)>>>>();

        let count = size[0] as usize * size[1] as usize;
        let (mut light, mut at_rest) = (vec![DVec3::ZERO; count], vec![0.0; count]);
        let mut done = 0;
        for (tile, of_tile) in tiles.iter().zip(traced) {
            let Some(of_tile) = of_tile else { continue };
            done += 1;
            for ([column, row], (seen, resting)) in pixels(*tile).zip(of_tile) {
                let index = row as usize * size[0] as usize + column as usize;
                (light[index], at_rest[index]) = (seen, resting);
            }
        }
        let shifted = shot.effects.shift_light()
            && (shot.celerity() != Celerity::ZERO || !self.surfaces.scene.motions.is_empty());
        let stored = Stored { white: self.light.white, scale: shot.scale(), shifted };
        Traced { size, light, at_rest, stored, done, tiles: tiles.len() }
    }

    /// Tiles of a picture.
    pub fn tile_count(size: [u32; 2]) -> u64 {
        u64::from(size[0].div_ceil(TILE)) * u64::from(size[1].div_ceil(TILE))
    }

    /// Where in the scene is what each pixel's centre shows, row by row; `None` where it shows no surface.
    pub fn places(&self, shot: &Shot, size: [u32; 2]) -> Vec<Option<Place>> {
        let sight = self.sight(shot);
        let pixels: Vec<_> = pixels(Tile { first: [0, 0], beyond: size }).collect();
        let place = |pixel: &[u32; 2]| {
            let seen = direction(shot, size, *pixel, DVec2::ZERO);
            let hit = self.bodies.first(&sight, seen, &sight.start(), |hit| self.surfaces.is_there(hit))?;
            Some(self.bodies.place(&sight, seen, &hit))
        };
        pixels.par_iter().map(place).collect()
    }

    /// The observer of a shot, and the light that falls on what moves as he sees it.
    fn sight(&self, shot: &Shot) -> Sight {
        self.bodies.sight(&self.surfaces.scene, shot, self.surfaces.falling(shot))
    }

    /// The light of a pixel, and its luminance at rest.
    fn pixel(&self, shot: &Shot, sight: &Sight, size: [u32; 2], pixel: [u32; 2], samples: u32) -> (DVec3, f64) {
        let samples = samples.max(1);
        let mut sum = (DVec3::ZERO, 0.0);
        for sample in 0..samples {
            let seen = direction(shot, size, pixel, sample_offset(sample, samples));
            let (light, at_rest) = self.along(sight, seen, shot.effects);
            sum = (sum.0 + light, sum.1 + at_rest);
        }
        (sum.0 / f64::from(samples), sum.1 / f64::from(samples))
    }

    /// The light that comes from a direction of the observer's frame, and its luminance at rest.
    fn along(&self, sight: &Sight, seen: DVec3, effects: Effects) -> (DVec3, f64) {
        let mut light = DVec3::ZERO;
        let mut shines_through = 1.0;
        let mut start = sight.start();
        while shines_through > HIDDEN {
            let Some(found) = self.bodies.first(sight, seen, &start, |hit| self.surfaces.is_there(hit)) else { break };
            let (opacity, sent) = self.surfaces.light(&found.hit, &self.bodies, &sight.falling);
            let (colour, at_rest) = self.light.observed(&sent, effects, found.doppler);
            // As in the renderers' targets, the luminance at rest is that of what is not mixed with anything behind it.
            if opacity >= 1.0 {
                return (light + shines_through * colour, at_rest);
            }
            light += shines_through * opacity * colour;
            shines_through *= 1.0 - opacity;
            start = self.bodies.beyond(sight, seen, &found);
        }
        let (direction, doppler) = sight.world(seen);
        let sent = self.surfaces.sky(direction, self.background);
        let (colour, at_rest) = self.light.observed(&sent, effects, doppler);
        (light + shines_through * colour, at_rest)
    }
}

/// The unit vector that a place of a pixel sees along, observer's axes.
fn direction(shot: &Shot, size: [u32; 2], [column, row]: [u32; 2], offset: DVec2) -> DVec3 {
    let [width, height] = size.map(f64::from);
    let tan = (0.5 * shot.camera.fov_y_rad).tan();
    let x = f64::from(column) + 0.5 + offset.x - 0.5 * width;
    let y = 0.5 * height - f64::from(row) - 0.5 - offset.y;
    let pixel = 2.0 * tan / height;
    (shot.camera.observer_from_eye * DVec3::new(x * pixel, y * pixel, -1.0)).normalize()
}

#[derive(Clone, Copy)]
struct Tile {
    first: [u32; 2],
    beyond: [u32; 2],
}

fn tiles(size: [u32; 2]) -> Vec<Tile> {
    let starts = |side: u32| (0..side).step_by(TILE as usize);
    let tile = |x: u32, y: u32| Tile { first: [x, y], beyond: [(x + TILE).min(size[0]), (y + TILE).min(size[1])] };
    starts(size[1]).flat_map(|y| starts(size[0]).map(move |x| tile(x, y))).collect()
}

fn pixels(tile: Tile) -> impl Iterator<Item = [u32; 2]> {
    (tile.first[1]..tile.beyond[1])
        .flat_map(move |row| (tile.first[0]..tile.beyond[0]).map(move |column| [column, row]))
}
