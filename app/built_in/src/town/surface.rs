//! Surfaces of the town: the name of each, the size and painter of its picture, and its material.
//!
//! One list serves materials, textures and faces. Sides of pictures are powers of two; together the pictures stay
//! below a hundred megabytes.

use glam::{Vec2, vec2};
use rayon::prelude::*;
use std::sync::atomic::{AtomicUsize, Ordering};

use super::canvas::PaintCanvas;
use super::paint::{dial, ground_floors, masonry, nature, signs, timber, tracery};
use super::pictures::TownPicture;
use scene::{Alpha, Material, Texture, Wrap};

/// Kind of surface.
#[derive(Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Debug)]
pub(super) enum TownSurface {
    Cobbles,
    Setts,
    Slabs,
    Ashlar,
    Rubble,
    Plaster,
    /// Storey of a house front, by its number in [`timber::FRONTS`].
    Front(usize),
    /// Ground floor, by its number in [`ground_floors::GROUND_FLOORS`].
    GroundFloor(usize),
    Tiles,
    Slate,
    Planks,
    /// Smooth paint of any tint.
    Paint,
    Iron,
    Gold,
    Lantern,
    Water,
    Awning,
    Produce,
    Signs,
    Clock,
    /// Hands of clocks, which turn.
    Hand,
    Lancet,
    Portal,
    Staves,
    Bark,
    Leaves,
    Flowers,
    Ivy,
    Grass,
    Hills,
}

/// Painter of a picture, from a seed.
type Brush = dyn Fn(u32) -> PaintCanvas + Send + Sync;

/// Recipe of a surface's picture and material.
struct Recipe {
    name: String,
    /// Function that paints the picture, if there is one.
    picture: Option<Box<Brush>>,
    base_colour: [f32; 4],
    wrap: [Wrap; 2],
    alpha: Alpha,
    unlit: bool,
    double_sided: bool,
}

impl TownSurface {
    /// Every surface, in the order of the scene's materials.
    fn all() -> Vec<Self> {
        use TownSurface::*;
        let mut all = vec![
            Cobbles, Setts, Slabs, Ashlar, Rubble, Plaster, Tiles, Slate, Planks, Paint, Iron, Gold, Lantern, Water,
            Awning, Produce, Signs, Clock, Hand, Lancet, Portal, Staves, Bark, Leaves, Flowers, Ivy, Grass, Hills,
        ];
        all.extend((0..timber::FRONTS.len()).map(Front));
        all.extend((0..ground_floors::GROUND_FLOORS.len()).map(GroundFloor));
        all
    }

    /// Name of the surface.
    pub(super) fn name(self) -> String {
        self.recipe().name
    }

    /// Size of one repetition of its picture, metres.
    pub(super) fn tile(self) -> Vec2 {
        match self {
            TownSurface::Cobbles => vec2(5.0, 5.0),
            TownSurface::Setts => vec2(5.76, 5.76),
            TownSurface::Slabs => vec2(4.0, 4.0),
            TownSurface::Ashlar | TownSurface::Rubble | TownSurface::Plaster => vec2(4.0, 4.0),
            TownSurface::Front(_) => timber::STRIP,
            TownSurface::GroundFloor(_) => ground_floors::STRIP,
            TownSurface::Tiles => vec2(4.32, 4.32),
            TownSurface::Slate => vec2(3.0, 3.0),
            TownSurface::Planks | TownSurface::Bark => vec2(2.0, 2.0),
            TownSurface::Water => vec2(3.0, 3.0),
            TownSurface::Staves => vec2(0.72, 0.925),
            TownSurface::Grass => vec2(9.0, 9.0),
            TownSurface::Hills => vec2(60.0, 60.0),
            _ => Vec2::ONE,
        }
    }

    /// True if a vehicle collides with the surface.
    pub(super) fn solid(self) -> bool {
        !matches!(
            self,
            TownSurface::Leaves
                | TownSurface::Flowers
                | TownSurface::Ivy
                | TownSurface::Signs
                | TownSurface::Awning
                | TownSurface::Clock
                | TownSurface::Hand
                | TownSurface::Lancet
                | TownSurface::Lantern
        )
    }

    fn recipe(self) -> Recipe {
        let tile = self.tile();
        let square = |size: usize, paint: fn([usize; 2], Vec2, u32) -> PaintCanvas| -> Option<Box<Brush>> {
            Some(Box::new(move |seed| paint([size, size], tile, seed)))
        };
        let plain = Recipe {
            name: format!("{self:?}").to_lowercase(),
            picture: None,
            base_colour: [1.0; 4],
            wrap: [Wrap::Repeat; 2],
            alpha: Alpha::Opaque,
            unlit: false,
            double_sided: false,
        };
        let clamped = [Wrap::Clamp; 2];
        let cut_out = Recipe { alpha: Alpha::Mask(0.5), wrap: clamped, ..plain_like(&plain) };
        match self {
            TownSurface::Cobbles => Recipe { picture: square(1024, masonry::cobbles), ..plain },
            TownSurface::Setts => Recipe { picture: square(1024, masonry::setts), ..plain },
            TownSurface::Slabs => Recipe { picture: square(1024, masonry::slabs), ..plain },
            TownSurface::Ashlar => Recipe { picture: square(1024, masonry::ashlar), ..plain },
            TownSurface::Rubble => Recipe { picture: square(1024, masonry::rubble), ..plain },
            TownSurface::Plaster => Recipe { picture: square(512, masonry::plaster), ..plain },
            TownSurface::Tiles => Recipe { picture: square(1024, masonry::tiles), ..plain },
            TownSurface::Slate => Recipe { picture: square(512, masonry::slate), ..plain },
            TownSurface::Planks => Recipe { picture: square(512, masonry::planks), ..plain },
            TownSurface::Front(number) => Recipe {
                name: format!("house front {}", number + 1),
                picture: Some(Box::new(move |seed| timber::front(&timber::FRONTS[number], seed + 31 * number as u32))),
                wrap: [Wrap::Repeat, Wrap::Clamp],
                ..plain
            },
            TownSurface::GroundFloor(number) => Recipe {
                name: format!("ground floor {}", number + 1),
                picture: Some(Box::new(move |seed| {
                    ground_floors::ground_floor(&ground_floors::GROUND_FLOORS[number], seed + 47 * number as u32)
                })),
                wrap: [Wrap::Repeat, Wrap::Clamp],
                ..plain
            },
            TownSurface::Paint => plain,
            TownSurface::Iron => Recipe { base_colour: [0.035, 0.035, 0.04, 1.0], ..plain },
            TownSurface::Gold => Recipe { base_colour: [0.75, 0.48, 0.10, 1.0], ..plain },
            TownSurface::Lantern => Recipe { base_colour: [0.80, 0.74, 0.55, 1.0], ..plain },
            TownSurface::Water => Recipe { picture: square(256, nature::water), ..plain },
            TownSurface::Awning => Recipe { picture: square(256, signs::awning), double_sided: true, ..plain },
            TownSurface::Produce => Recipe { picture: square(512, nature::produce), ..plain },
            TownSurface::Signs => Recipe { picture: square(512, signs::signs), double_sided: true, ..plain },
            TownSurface::Clock => Recipe { picture: square(512, dial::dial), wrap: clamped, ..plain },
            TownSurface::Hand => Recipe { base_colour: [0.6, 0.6, 0.6, 1.0], unlit: true, ..plain },
            TownSurface::Lancet => Recipe {
                picture: Some(Box::new(|seed| tracery::lancet([512, 1024], tracery::LANCET, seed))),
                ..cut_out
            },
            TownSurface::Portal => Recipe {
                picture: Some(Box::new(|seed| tracery::portal([512, 512], tracery::PORTAL, seed))),
                wrap: clamped,
                ..plain
            },
            TownSurface::Staves => Recipe { picture: square(256, masonry::staves), ..plain },
            TownSurface::Bark => Recipe { picture: square(256, nature::bark), ..plain },
            TownSurface::Leaves => Recipe { picture: square(512, nature::leaves), double_sided: true, ..cut_out },
            TownSurface::Flowers => Recipe { picture: square(512, nature::flowers), double_sided: true, ..cut_out },
            TownSurface::Ivy => Recipe { picture: square(512, nature::ivy), double_sided: true, ..cut_out },
            TownSurface::Grass => Recipe { picture: square(512, nature::grass), ..plain },
            TownSurface::Hills => Recipe { picture: square(512, nature::woods), unlit: true, ..plain },
        }
    }

    /// Index of the surface among the materials.
    pub(super) fn number(self) -> usize {
        Self::all().iter().position(|&surface| surface == self).unwrap_or_default()
    }
}

fn plain_like(recipe: &Recipe) -> Recipe {
    Recipe { name: recipe.name.clone(), picture: None, ..*recipe }
}

/// Paints every picture, in the order of [`materials`]. `painted` hears how many are finished, and of how many.
pub(super) fn paint(seed: u32, painted: impl Fn(usize, usize) + Sync) -> Vec<TownPicture> {
    let recipes: Vec<Recipe> = TownSurface::all().into_iter().map(TownSurface::recipe).collect();
    let brushes: Vec<_> = recipes.iter().filter_map(|recipe| recipe.picture.as_ref()).collect();
    let finished = AtomicUsize::new(0);
    let pictures = brushes.par_iter().map(|brush| {
        let picture = brush(seed).finish();
        painted(1 + finished.fetch_add(1, Ordering::Relaxed), brushes.len());
        picture
    });
    pictures.collect()
}

/// Lists the materials, and the textures that show `pictures`; `None` if these are not as many as there are surfaces
/// with pictures.
pub(super) fn materials(pictures: Vec<TownPicture>) -> Option<(Vec<Material>, Vec<Texture>)> {
    let mut pictures = pictures.into_iter();
    let mut textures = Vec::new();
    let mut materials = Vec::new();
    for recipe in TownSurface::all().into_iter().map(TownSurface::recipe) {
        let base_colour_texture = match recipe.picture {
            Some(_) => {
                let TownPicture { width, height, rgba } = pictures.next()?;
                let (name, wrap) = (recipe.name.clone(), recipe.wrap);
                textures.push(Texture { name, width, height, rgba, wrap, nearest: false });
                Some(textures.len() - 1)
            }
            None => None,
        };
        materials.push(Material {
            name: recipe.name,
            base_colour: recipe.base_colour,
            base_colour_texture,
            alpha: recipe.alpha,
            unlit: recipe.unlit,
            double_sided: recipe.double_sided,
            ..Material::default()
        });
    }
    pictures.next().is_none().then_some((materials, textures))
}
