//! Pictures traced tile by tile, from the middle outwards.

use crate::hit::TracedPlace;
use crate::light::ObservedLight;
use crate::path::{LitObserver, LitScene};
use glam::{DVec2, DVec3};
use image::Rgb32FImage;
use physics::Celerity;
use rayon::prelude::*;
use scene::{Scene, SceneFault};
use std::sync::atomic::{AtomicBool, AtomicUsize, Ordering};
use view::{Framing, OpenShutter, Optics, PlaceSight, Shot, Stored, sample_offset};

/// Side of a tile, pixels. Each tile is traced in one go.
const TILE: u32 = 16;

/// Tracer of one scene.
pub struct RayTracer {
    scene: LitScene,
    optics: Optics,
    /// Way in which pictures take their directions from the eye.
    pub framing: Framing,
    /// Worldline of the eye while the shutter is open.
    pub exposure: OpenShutter,
    /// Largest number of turns of a ray.
    bounces: u32,
}

/// Traced picture, rows from the top. Pixels that were not traced are black.
#[derive(Clone, Debug, PartialEq)]
pub struct Traced {
    /// Width and height, pixels.
    pub size: [u32; 2],
    /// Light of each pixel, linear sRGB in cd/m².
    pub light: Vec<DVec3>,
    /// Luminance of each pixel without any shift, relative to white.
    pub at_rest: Vec<f64>,
    /// Scale of the radiance, for the display.
    pub stored: Stored,
    /// Number of tiles that are finished.
    pub done: usize,
    /// Number of tiles of the whole picture.
    pub tiles: usize,
}

impl Traced {
    /// Light as 32-bit floats. Values beyond the range of f32 become its largest value.
    pub fn image(&self) -> Rgb32FImage {
        let largest = f64::from(f32::MAX);
        Rgb32FImage::from_fn(self.size[0], self.size[1], |column, row| {
            let index = row as usize * self.size[0] as usize + column as usize;
            image::Rgb(self.light[index].to_array().map(|value| value.clamp(-largest, largest) as f32))
        })
    }

    /// Light in the form of the renderers' targets: relative to white, scaled, with the luminance at rest as alpha.
    pub fn texels(&self) -> Vec<[f32; 4]> {
        let largest = f64::from(f32::MAX);
        let factor = self.stored.scale / self.stored.white;
        let short = |value: f64| value.clamp(-largest, largest) as f32;
        let texel = |(light, at_rest): (&DVec3, &f64)| (*light * factor).extend(*at_rest).to_array().map(short);
        self.light.iter().zip(&self.at_rest).map(texel).collect()
    }
}

impl RayTracer {
    /// Sorts the scene's triangles. `background` is a linear radiance that replaces the sky. If `exact_light` is
    /// true, the spectrum of every ray is integrated instead of looked up in the shift table.
    ///
    /// # Errors
    /// [`SceneFault`] if the scene breaks a promise of its types.
    pub fn new(scene: Scene, background: Option<[f32; 3]>, exact_light: bool) -> Result<Self, SceneFault> {
        scene.validate()?;
        let scene = LitScene::new(scene, background, exact_light);
        Ok(Self {
            scene,
            optics: Optics::default(),
            framing: Framing::default(),
            exposure: OpenShutter::default(),
            bounces: 0,
        })
    }

    /// Tracer with this lens.
    #[must_use]
    pub fn with_optics(self, optics: Optics) -> Self {
        Self { optics, ..self }
    }

    /// Tracer with mirrors and clear glass, which turn a ray up to `bounces` times.
    #[must_use]
    pub fn with_bounces(mut self, bounces: u32) -> Self {
        self.bounces = bounces;
        self.scene.set_clear_glass(bounces > 0);
        self
    }

    /// Traces a picture on all cores, from its middle outwards. `finished` is called for every tile. Once `stop` is
    /// set, no further tile is begun.
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
        let observer = self.scene.observer(&shot.observer, shot.effects.places);
        // The next free thread takes the next tile, so the order holds for any number of threads.
        let next = AtomicUsize::new(0);
        let traced: Vec<_> = tiles
            .par_iter()
            .filter_map(|_| {
                if stop.load(Ordering::Relaxed) {
                    return None;
                }
                let tile = tiles[next.fetch_add(1, Ordering::Relaxed)];
                let seen: Vec<_> =
                    pixels(tile).map(|pixel| self.pixel(shot, &observer, size, pixel, samples)).collect();
                finished();
                Some((tile, seen))
            })
            .collect();

        let count = size[0] as usize * size[1] as usize;
        let (mut light, mut at_rest) = (vec![DVec3::ZERO; count], vec![0.0; count]);
        let done = traced.len();
        for (tile, of_tile) in traced {
            for ([column, row], seen) in pixels(tile).zip(of_tile) {
                let index = row as usize * size[0] as usize + column as usize;
                (light[index], at_rest[index]) = (seen.light, seen.at_rest);
            }
        }
        let shifted = shot.effects.shift_light() && (shot.observer.celerity != Celerity::ZERO || self.scene.moves());
        let stored = Stored { white: self.scene.white(), scale: shot.scale(), shifted };
        Traced { size, light, at_rest, stored, done, tiles: tiles.len() }
    }

    /// Number of tiles of a picture.
    pub fn tile_count(size: [u32; 2]) -> u64 {
        u64::from(size[0].div_ceil(TILE)) * u64::from(size[1].div_ceil(TILE))
    }

    /// Place in the scene that each pixel's centre shows, row by row; `None` for a pixel that shows no surface.
    pub fn places(&self, shot: &Shot, size: [u32; 2]) -> Vec<Option<TracedPlace>> {
        let observer = self.scene.observer(&shot.observer, shot.effects.places);
        let pixels: Vec<_> = pixels(Tile { first: [0, 0], beyond: size }).collect();
        let place = |pixel: &[u32; 2]| {
            let sight = self.sight(shot, size, *pixel, DVec2::ZERO)?;
            let seen = (shot.camera.observer_from_eye * sight.ahead).normalize();
            if sight.from_m == DVec3::ZERO {
                return self.scene.place(&observer, seen);
            }
            let (eye, seen) = Optics::default().look(shot, &OpenShutter::default(), sight, *pixel, 0);
            self.scene.place(&self.scene.observer(&eye, shot.effects.places), seen)
        };
        pixels.par_iter().map(place).collect()
    }

    /// Line of sight of a place in a pixel, given from its centre, in eye axes.
    fn sight(&self, shot: &Shot, size: [u32; 2], [column, row]: [u32; 2], offset: DVec2) -> Option<PlaceSight> {
        self.framing.sight(shot, size, DVec2::new(f64::from(column), f64::from(row)) + 0.5 + offset)
    }

    /// Mean of a pixel's samples.
    fn pixel(
        &self,
        shot: &Shot,
        observer: &LitObserver,
        size: [u32; 2],
        pixel: [u32; 2],
        samples: u32,
    ) -> ObservedLight {
        let samples = samples.max(1);
        let mut sum = ObservedLight::default();
        let (effects, bounces) = (shot.effects, self.bounces);
        for sample in 0..samples {
            // Where the picture shows nothing, it is black.
            let Some(sight) = self.sight(shot, size, pixel, sample_offset(sample, samples)) else { continue };
            if self.optics.is_pinhole() && self.exposure.is_instant() && sight.from_m == DVec3::ZERO {
                let seen = (shot.camera.observer_from_eye * sight.ahead).normalize();
                sum += self.scene.seen(observer, seen, effects, bounces);
            } else {
                let (observer, seen) = self.optics.look(shot, &self.exposure, sight, pixel, sample);
                let observer = self.scene.observer(&observer, effects.places);
                sum += self.scene.seen(&observer, seen, effects, bounces);
            }
        }
        sum * (1.0 / f64::from(samples))
    }
}

/// Part of a picture that is traced in one go: its first column and row, and those beyond it.
#[derive(Clone, Copy)]
struct Tile {
    first: [u32; 2],
    beyond: [u32; 2],
}

/// Tiles of a picture, those nearest to its middle first.
fn tiles(size: [u32; 2]) -> Vec<Tile> {
    let starts = |side: u32| (0..side).step_by(TILE as usize);
    let tile = |x: u32, y: u32| Tile { first: [x, y], beyond: [(x + TILE).min(size[0]), (y + TILE).min(size[1])] };
    let mut tiles: Vec<_> = starts(size[1]).flat_map(|y| starts(size[0]).map(move |x| tile(x, y))).collect();
    let from_middle = |tile: &Tile| {
        let side = |axis: usize| f64::from(tile.first[axis]) + 0.5 * f64::from(TILE) - 0.5 * f64::from(size[axis]);
        side(0).hypot(side(1))
    };
    tiles.sort_by(|one, other| from_middle(one).total_cmp(&from_middle(other)));
    tiles
}

/// Column and row of each pixel of a tile.
fn pixels(tile: Tile) -> impl Iterator<Item = [u32; 2]> {
    (tile.first[1]..tile.beyond[1])
        .flat_map(move |row| (tile.first[0]..tile.beyond[0]).map(move |column| [column, row]))
}
