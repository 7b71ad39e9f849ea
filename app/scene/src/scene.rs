//! A scene: geometry, materials, light, and a place to start from, as plain data.

use crate::lamp::Lamp;
use crate::lighting::{Lighting, Panorama};
use crate::material::{Material, Texture};
use crate::mesh::Mesh;
use crate::motion::Motion;
use glam::DVec3;
use physics::colour::Spectrum;

/// The most triangles, and three times as many vertices, that a scene may have: about 10 GB of arrays. What would be more is refused
/// before memory is asked for.
pub const MAX_TRIANGLES: usize = 50_000_000;

/// The most different spectra that a scene's materials may have: each takes a fifth of a second to prepare, and a layer of the map.
pub const MAX_SPECTRA: usize = 64;

/// A world at rest: geometry, materials, light, and a place to start from.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Scene {
    /// What to call it in titles and messages.
    pub name: String,
    /// World position, in metres, that every mesh position is relative to.
    pub origin: DVec3,
    /// Pictures that materials refer to by index.
    pub textures: Vec<Texture>,
    /// Surfaces that meshes refer to by index.
    pub materials: Vec<Material>,
    /// Triangles, one entry per primitive and instance.
    pub meshes: Vec<Mesh>,
    /// How some of them move.
    pub motions: Vec<Motion>,
    /// Sun and sky, in the world frame.
    pub light: Lighting,
    /// Lamps at rest in the world, which the ray tracer alone draws.
    pub lamps: Vec<Lamp>,
    /// Spectrum of that light: the radiance of a white surface on which light of colour 1 falls. `None`: that of the colours themselves.
    pub illuminant: Option<Spectrum>,
    /// Luminance in cd/m² that is shown as white at rest. `None`: that of the brightest spectrum at rest; 1 where there is none.
    pub white: Option<f64>,
    /// What is seen where no surface is, instead of the sky.
    pub panorama: Option<Panorama>,
    /// Where a visitor begins.
    pub start: Start,
    /// A closed way round the scene (world metres, on the ground), if it has one: the built-in tour follows it.
    pub circuit: Vec<DVec3>,
    /// What the file asked for and this program does not draw, one sentence each.
    pub notices: Vec<String>,
}

/// Where a visitor stands at first and which way he looks.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Start {
    /// A point on the ground, world metres.
    pub position: DVec3,
    /// Unit vector, world axes.
    pub look: DVec3,
}

impl Default for Start {
    fn default() -> Self {
        Self { position: DVec3::ZERO, look: DVec3::NEG_Z }
    }
}

impl Scene {
    /// A number that tells this scene's solid part from another's: FNV-1a over every coordinate and index.
    ///
    /// Whoever stands on it and runs into it depends on nothing else, so a recording names it.
    pub fn fingerprint(&self) -> u64 {
        let mut hash = 0xcbf2_9ce4_8422_2325_u64;
        let mut take = |value: u32| {
            for byte in value.to_le_bytes() {
                hash = (hash ^ u64::from(byte)).wrapping_mul(0x0100_0000_01b3);
            }
        };
        for mesh in self.meshes.iter().filter(|mesh| mesh.solid) {
            mesh.positions.iter().flat_map(|position| position.to_array()).for_each(|value| take(value.to_bits()));
            mesh.indices.iter().for_each(|&index| take(index));
        }
        hash
    }

    /// The luminance that is shown as white at rest, cd/m²: [`Scene::white`], else that of the brightest spectrum, be it sent out or that of a
    /// white surface in the scene's light; 1 where colours are all there is.
    pub fn white_luminance(&self) -> f64 {
        let luminance = |spectrum: &Spectrum| spectrum.xyz(1.0).y;
        let sources = self.materials.iter().filter(|material| material.is_source()).filter_map(|material| {
            let [red, green, blue, _] = material.base_colour.map(f64::from);
            let share = physics::colour::luminance(DVec3::new(red, green, blue));
            Some(share * luminance(material.spectrum.as_ref()?))
        });
        self.white.unwrap_or_else(|| {
            let brightest = sources.chain(self.illuminant.as_ref().map(luminance)).fold(0.0, f64::max);
            if brightest > 0.0 && brightest.is_finite() { brightest } else { 1.0 }
        })
    }

    /// Number of vertices in all meshes.
    pub fn vertex_count(&self) -> usize {
        self.meshes.iter().map(|mesh| mesh.positions.len()).sum()
    }

    /// Number of triangles in all meshes.
    pub fn triangle_count(&self) -> usize {
        self.meshes.iter().map(|mesh| mesh.indices.len() / 3).sum()
    }
}
