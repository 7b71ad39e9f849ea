//! A scene: geometry, materials, light, and a place to start from, as plain data.

use crate::clock::SceneClock;
use crate::lamp::Lamp;
use crate::lighting::Lighting;
use crate::local_name::LocalName;
use crate::material::{Material, Texture};
use crate::mesh::Mesh;
use crate::motion::{CameraMotion, Motion};
use crate::panorama::Panorama;
use glam::DVec3;
use physics::colour::Spectrum;

/// Largest number of triangles in a scene; three times as many vertices are allowed: about 10 GB of arrays. A larger
/// scene is refused before memory is asked for.
pub const MAX_TRIANGLES: usize = 50_000_000;

/// Largest number of different spectra among a scene's materials. Each takes a fifth of a second to prepare, and one
/// layer of the map.
pub const MAX_SPECTRA: usize = 64;

/// Scene: geometry, its motions, materials, light, and a place to start from.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Scene {
    /// Name of the scene in titles and messages.
    pub name: String,
    /// World position that every mesh position is relative to, metres.
    pub origin: DVec3,
    /// Pictures that materials refer to by index.
    pub textures: Vec<Texture>,
    /// Surfaces that meshes refer to by index.
    pub materials: Vec<Material>,
    /// Meshes, one for each primitive and instance.
    pub meshes: Vec<Mesh>,
    /// Motions that meshes refer to by index.
    pub motions: Vec<Motion>,
    /// Sun and sky, in the world frame.
    pub light: Lighting,
    /// Lamps at rest in the world; only the ray tracer draws them.
    pub lamps: Vec<Lamp>,
    /// Spectrum of [`Scene::light`]: the radiance of a white surface on which light of colour 1 falls. `None`: spectrum
    /// of the colours themselves.
    pub illuminant: Option<Spectrum>,
    /// Luminance that is shown as white at rest, cd/m². `None`: luminance of the brightest spectrum at rest; 1 if
    /// there is no spectrum.
    pub white: Option<f64>,
    /// Picture at infinity, seen instead of the sky where no surface is.
    pub panorama: Option<Panorama>,
    /// Starting place and view of an observer.
    pub start: Start,
    /// Places from which the scene's own cameras see it; the first that is perspective decides [`Scene::start`], unless
    /// the scene itself does.
    pub cameras: Vec<ViewCamera>,
    /// Speed of light that suits the scene's size, m/s, if the scene is of no particular one.
    pub speed_of_light_m_s: Option<f64>,
    /// Closed route round the scene (world metres, on the ground) that the built-in tour follows; empty if there is
    /// none.
    pub circuit: Vec<DVec3>,
    /// Places with a name, to which an observer can jump; the start is not among them.
    pub places: Vec<NamedPlace>,
    /// Clocks whose dials are part of the scene's meshes.
    pub clocks: Vec<SceneClock>,
    /// Features that the file asks for and this program does not draw, one sentence each.
    pub notices: Vec<String>,
}

/// Starting place of an observer and first direction of view.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Start {
    /// Point on the ground, or the eye itself if `eye_height_m` is 0; world metres.
    pub position: DVec3,
    /// Direction of view, unit vector, world axes.
    pub look: DVec3,
    /// Direction that is up in the picture, unit vector, world axes; not along `look`.
    pub up: DVec3,
    /// Height of the eye above `position`, metres; 0 for an eye in mid-air.
    pub eye_height_m: f64,
    /// Vertical field of view, radians; `None` for the program's own.
    pub field_of_view_rad: Option<f64>,
}

impl Default for Start {
    /// Standing visitor at the origin who looks along −z.
    fn default() -> Self {
        Self {
            position: DVec3::ZERO,
            look: DVec3::NEG_Z,
            up: DVec3::Y,
            eye_height_m: view::EYE_HEIGHT_M,
            field_of_view_rad: None,
        }
    }
}

impl Start {
    /// Place of the eye, world metres.
    pub fn eye(&self) -> DVec3 {
        self.position + DVec3::Y * self.eye_height_m
    }

    /// True if the observer stands on the ground, false for an eye in mid-air.
    pub fn is_on_ground(&self) -> bool {
        self.eye_height_m > 0.0
    }
}

/// Place to which an observer can jump.
#[derive(Clone, Debug, PartialEq)]
pub struct NamedPlace {
    /// Name, for a menu.
    pub name: LocalName,
    /// Place and first view there.
    pub start: Start,
}

/// Place from which a camera of the scene sees it.
#[derive(Clone, Debug, PartialEq)]
pub struct ViewCamera {
    /// Name from the file.
    pub name: String,
    /// Place and view of its eye, at the beginning if it moves.
    pub start: Start,
    /// Motion of the camera, if the file animates it; a film may follow it.
    pub motion: Option<CameraMotion>,
}

impl Scene {
    /// Fingerprint of the scene's solid part: FNV-1a over every coordinate and index of the solid meshes.
    ///
    /// Standing on a scene and colliding with it depends on nothing else, so a recording stores this number.
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

    /// Luminance that is shown as white at rest, cd/m²: [`Scene::white`], else that of the brightest spectrum.
    /// Candidates are the emitted spectra, and a white surface in the scene's light. 1 if the scene has colours only.
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
