//! Surfaces of the town: the name of each, the size and painter of its picture, and its material.
//!
//! One list serves materials, textures and faces. Sides of pictures are powers of two; together the pictures stay
//! below a hundred megabytes.

use glam::{Vec2, vec2};
use rayon::prelude::*;

use super::canvas::Canvas;
use super::paint::{ground_floors, masonry, nature, signs, timber, tracery};
use scene::{Alpha, Material, Texture, Wrap};

/// Kind of surface.
#[derive(Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Debug)]
pub(super) enum Surface {
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

/// Recipe of a surface's picture and material.
struct Recipe {
    name: String,
    /// Function that paints the picture, if there is one.
    picture: Option<Box<dyn Fn(u32) -> Canvas + Send + Sync>>,
    base_colour: [f32; 4],
    wrap: [Wrap; 2],
    alpha: Alpha,
    unlit: bool,
    double_sided: bool,
}

impl Surface {
    /// Every surface, in the order of the scene's materials.
    fn all() -> Vec<Self> {
        use Surface::*;
        let mut all = vec![
            Cobbles, Setts, Slabs, Ashlar, Rubble, Plaster, Tiles, Slate, Planks, Paint, Iron, Gold, Lantern, Water,
            Awning, Produce, Signs, Clock, Lancet, Portal, Staves, Bark, Leaves, Flowers, Ivy, Grass, Hills,
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
            Surface::Cobbles => vec2(5.0, 5.0),
            Surface::Setts => vec2(5.76, 5.76),
            Surface::Slabs => vec2(4.0, 4.0),
            Surface::Ashlar | Surface::Rubble | Surface::Plaster => vec2(4.0, 4.0),
            Surface::Front(_) => timber::STRIP,
            Surface::GroundFloor(_) => ground_floors::STRIP,
            Surface::Tiles => vec2(4.32, 4.32),
            Surface::Slate => vec2(3.0, 3.0),
            Surface::Planks | Surface::Bark => vec2(2.0, 2.0),
            Surface::Water => vec2(3.0, 3.0),
            Surface::Staves => vec2(0.72, 0.925),
            Surface::Grass => vec2(9.0, 9.0),
            Surface::Hills => vec2(60.0, 60.0),
            _ => Vec2::ONE,
        }
    }

    /// True if a vehicle collides with the surface.
    pub(super) fn solid(self) -> bool {
        !matches!(
            self,
            Surface::Leaves
                | Surface::Flowers
                | Surface::Ivy
                | Surface::Signs
                | Surface::Awning
                | Surface::Clock
                | Surface::Lancet
                | Surface::Lantern
        )
    }

    fn recipe(self) -> Recipe {
        let tile = self.tile();
        let square = |size: usize,
                      paint: fn([usize; 2], Vec2, u32) -> Canvas|
         -> Option<Box<dyn Fn(u32) -> Canvas + Send + Sync>> {
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
            Surface::Cobbles => Recipe { picture: square(1024, masonry::cobbles), ..plain },
            Surface::Setts => Recipe { picture: square(1024, masonry::setts), ..plain },
            Surface::Slabs => Recipe { picture: square(1024, masonry::slabs), ..plain },
            Surface::Ashlar => Recipe { picture: square(1024, masonry::ashlar), ..plain },
            Surface::Rubble => Recipe { picture: square(1024, masonry::rubble), ..plain },
            Surface::Plaster => Recipe { picture: square(512, masonry::plaster), ..plain },
            Surface::Tiles => Recipe { picture: square(1024, masonry::tiles), ..plain },
            Surface::Slate => Recipe { picture: square(512, masonry::slate), ..plain },
            Surface::Planks => Recipe { picture: square(512, masonry::planks), ..plain },
            Surface::Front(number) => Recipe {
                name: format!("house front {}", number + 1),
                picture: Some(Box::new(move |seed| timber::front(&timber::FRONTS[number], seed + 31 * number as u32))),
                wrap: [Wrap::Repeat, Wrap::Clamp],
                ..plain
            },
            Surface::GroundFloor(number) => Recipe {
                name: format!("ground floor {}", number + 1),
                picture: Some(Box::new(move |seed| {
                    ground_floors::ground_floor(&ground_floors::GROUND_FLOORS[number], seed + 47 * number as u32)
                })),
                wrap: [Wrap::Repeat, Wrap::Clamp],
                ..plain
            },
            Surface::Paint => plain,
            Surface::Iron => Recipe { base_colour: [0.035, 0.035, 0.04, 1.0], ..plain },
            Surface::Gold => Recipe { base_colour: [0.75, 0.48, 0.10, 1.0], ..plain },
            Surface::Lantern => Recipe { base_colour: [0.80, 0.74, 0.55, 1.0], ..plain },
            Surface::Water => Recipe { picture: square(256, nature::water), ..plain },
            Surface::Awning => Recipe { picture: square(256, signs::awning), double_sided: true, ..plain },
            Surface::Produce => Recipe { picture: square(512, nature::produce), ..plain },
            Surface::Signs => Recipe { picture: square(512, signs::signs), double_sided: true, ..plain },
            Surface::Clock => Recipe { picture: square(512, signs::clock), wrap: clamped, ..plain },
            Surface::Lancet => Recipe {
                picture: Some(Box::new(|seed| tracery::lancet([512, 1024], tracery::LANCET, seed))),
                ..cut_out
            },
            Surface::Portal => Recipe {
                picture: Some(Box::new(|seed| tracery::portal([512, 512], tracery::PORTAL, seed))),
                wrap: clamped,
                ..plain
            },
            Surface::Staves => Recipe { picture: square(256, masonry::staves), ..plain },
            Surface::Bark => Recipe { picture: square(256, nature::bark), ..plain },
            Surface::Leaves => Recipe { picture: square(512, nature::leaves), double_sided: true, ..cut_out },
            Surface::Flowers => Recipe { picture: square(512, nature::flowers), double_sided: true, ..cut_out },
            Surface::Ivy => Recipe { picture: square(512, nature::ivy), double_sided: true, ..cut_out },
            Surface::Grass => Recipe { picture: square(512, nature::grass), ..plain },
            Surface::Hills => Recipe { picture: square(512, nature::woods), unlit: true, ..plain },
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

/// Paints every picture, and lists the materials and textures.
pub(super) fn materials(seed: u32) -> (Vec<Material>, Vec<Texture>) {
    let recipes: Vec<Recipe> = Surface::all().into_iter().map(Surface::recipe).collect();
    let pictures: Vec<Option<Texture>> = recipes
        .par_iter()
        .map(|recipe| recipe.picture.as_ref().map(|paint| paint(seed).finish(&recipe.name, recipe.wrap)))
        .collect();
    let mut textures = Vec::new();
    let mut materials = Vec::new();
    for (recipe, picture) in recipes.into_iter().zip(pictures) {
        let base_colour_texture = picture.map(|picture| {
            textures.push(picture);
            textures.len() - 1
        });
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
    (materials, textures)
}
