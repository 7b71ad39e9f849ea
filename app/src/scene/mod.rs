//! A scene: flattened meshes, at rest in the world or moving, their materials, and the light that falls on them.
//!
//! A scene is plain data. Files are read by `gltf` and `panorama`; built-in scenes are made by `town`, `spectra` and
//! `lattice`. Each gives a [`Scene`], which everything else reads: refinement, collision, renderers, export.
//! Instances are flattened (W 5.1.6), because the relativistic transform does not commute with a node's affine one.
//!
//! Positions are f32 metres relative to [`Scene::origin`], which is f64: a scene a million kilometres from
//! the world's origin keeps its millimetres.

pub mod check;
pub mod collision;
pub mod cut;
pub mod export;
pub mod falling;
pub mod gltf;
pub mod lamp;
pub mod lattice;
pub mod mipmap;
pub mod motion;
pub mod panorama;
pub mod refine;
pub mod source;
pub mod spectra;
pub mod town;
mod turn;

pub use lamp::{Lamp, Lamplight, Spot};

use glam::{DVec3, Vec2, Vec3};
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
    pub motions: Vec<motion::Motion>,
    /// Sun and sky, in the world frame.
    pub light: Lighting,
    /// Lamps at rest in the world; only the ray tracer draws them.
    pub lamps: Vec<Lamp>,
    /// Spectrum of that light: the radiance of a white surface on which light of colour 1 falls. `None`: spectrum of
    /// the colours themselves.
    pub illuminant: Option<Spectrum>,
    /// Luminance that is shown as white at rest, cd/m². `None`: luminance of the brightest spectrum at rest; 1 if
    /// there is no spectrum.
    pub white: Option<f64>,
    /// Picture at infinity, seen instead of the sky where no surface is.
    pub panorama: Option<Panorama>,
    /// Starting place and view of an observer.
    pub start: Start,
    /// Closed route round the scene (world metres, on the ground) that the built-in tour follows; empty if there is
    /// none.
    pub circuit: Vec<DVec3>,
    /// Features that the file asks for and this program does not draw, one sentence each.
    pub notices: Vec<String>,
}

/// Starting place of an observer and first direction of view.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Start {
    /// Point on the ground, world metres.
    pub position: DVec3,
    /// Direction of view, unit vector, world axes.
    pub look: DVec3,
}

impl Default for Start {
    fn default() -> Self {
        Self { position: DVec3::ZERO, look: DVec3::NEG_Z }
    }
}

/// Mesh of triangles that have one material.
///
/// All vertex arrays have the same length; `indices` has a multiple of three entries, each below that length.
/// Front faces are counter-clockwise.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Mesh {
    /// Name from the file's node and mesh, for messages.
    pub name: String,
    /// Index into [`Scene::materials`].
    pub material: usize,
    /// Positions of the vertices, metres, relative to [`Scene::origin`].
    /// Uniformly moving meshes have them in their own frame; animated meshes in their body's frame, without that
    /// origin (see [`motion`]).
    pub positions: Vec<Vec3>,
    /// Normals of the vertices, unit vectors, world axes.
    pub normals: Vec<Vec3>,
    /// Texture coordinates, origin at the picture's upper left (glTF).
    pub uvs: Vec<Vec2>,
    /// Linear colours and opacities of the vertices, multiplied into the base colour.
    pub colours: Vec<[f32; 4]>,
    /// Indices of vertices, three per triangle.
    pub indices: Vec<u32>,
    /// True if a vehicle collides with the mesh and rides on it; false for foliage and signs.
    pub solid: bool,
    /// Index into [`Scene::motions`]; `None` if the mesh rests in the world.
    pub motion: Option<usize>,
}

/// Surface and how it sends out light in the world frame (glTF's metallic–roughness model, diffuse part).
#[derive(Clone, Debug, PartialEq)]
pub struct Material {
    /// Name from the file, for messages.
    pub name: String,
    /// Linear factor of the base colour, and opacity.
    pub base_colour: [f32; 4],
    /// Index into [`Scene::textures`]; its colour multiplies the factor.
    pub base_colour_texture: Option<usize>,
    /// Linear radiance that the surface emits.
    pub emissive: [f32; 3],
    /// Index into [`Scene::textures`]; its colour multiplies `emissive`.
    pub emissive_texture: Option<usize>,
    /// True if the base colour is the radiance itself and no light falls on the surface (KHR_materials_unlit).
    pub unlit: bool,
    /// True if the surface is drawn from behind as well.
    pub double_sided: bool,
    /// Share of metal in the surface, 0 to 1. Only the ray tracer draws this and the fields up to `alpha`, and only
    /// when it follows mirrors.
    pub metallic: f32,
    /// Roughness of the surface: 0 for a mirror, 1 for a quite rough surface.
    pub roughness: f32,
    /// Refractive index of the matter behind the surface (KHR_materials_ior); 1 or more.
    pub index_of_refraction: f32,
    /// Share of the entering light that is transmitted (KHR_materials_transmission), 0 to 1.
    pub transmission: f32,
    /// True if a volume behind the surface (KHR_materials_volume) bends the transmitted light; false for a thin pane.
    pub solid_glass: bool,
    /// Treatment of the opacity.
    pub alpha: Alpha,
    /// Spectrum that replaces the colours: the emitted radiance of an unlit or emissive material, the reflectance of
    /// any other, times the base colour's luminance.
    pub spectrum: Option<Spectrum>,
}

impl Default for Material {
    fn default() -> Self {
        Self {
            name: String::new(),
            base_colour: [1.0; 4],
            base_colour_texture: None,
            emissive: [0.0; 3],
            emissive_texture: None,
            unlit: false,
            double_sided: false,
            metallic: 0.0,
            roughness: 1.0,
            index_of_refraction: 1.5,
            transmission: 0.0,
            solid_glass: false,
            alpha: Alpha::Opaque,
            spectrum: None,
        }
    }
}

impl Material {
    /// True if the spectrum is that of emitted light, false if it is a reflectance.
    pub fn is_source(&self) -> bool {
        self.unlit || self.emissive != [0.0; 3]
    }
}

/// Treatment of a material's opacity (glTF `alphaMode`).
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub enum Alpha {
    /// Opacity is ignored.
    #[default]
    Opaque,
    /// Fragments with an opacity below this threshold are not drawn.
    Mask(f32),
    /// Surface is mixed with the things behind it.
    Blend,
}

/// Texture of a surface: 8-bit sRGB with straight alpha, rows from the top.
#[derive(Clone, Debug, PartialEq)]
pub struct Texture {
    /// Name from the file, for messages.
    pub name: String,
    /// Width, pixels.
    pub width: u32,
    /// Height, pixels.
    pub height: u32,
    /// Pixels: `width * height` times four bytes, R, G, B, A.
    pub rgba: Vec<u8>,
    /// Continuation beyond 0…1 along u and along v.
    pub wrap: [Wrap; 2],
    /// True if the texture is sampled without filtering when magnified.
    pub nearest: bool,
}

/// Panorama: a picture of all directions, infinitely far away, in the world frame.
///
/// The projection is equirectangular: the first row is straight up, the last straight down. Columns go once round to
/// the right; the middle one is −z.
#[derive(Clone, Debug, PartialEq)]
pub struct Panorama {
    /// Width, pixels.
    pub width: u32,
    /// Height, pixels.
    pub height: u32,
    /// Radiances of the pixels, `width * height`, linear sRGB, on the scale where white is 1.
    pub rgb: Vec<[f32; 3]>,
}

/// Continuation of a texture beyond its edges.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Wrap {
    /// Texture repeats.
    #[default]
    Repeat,
    /// Texture repeats, mirrored every other time.
    Mirror,
    /// Border pixels continue.
    Clamp,
}

/// Daylight in the world frame: the light on lit materials, and the sky seen where no surface is.
///
/// Colours are linear radiance on the scale where a white unlit surface is 1. A lit surface of albedo ρ sends out
/// ρ (sun · max(0, n·s) · visibility + sky hemisphere), so sun + sky near 1 keeps whites just below clipping.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Lighting {
    /// Unit vector towards the sun, world axes.
    pub sun_direction: Vec3,
    /// Light of the sun on a surface that faces it.
    pub sun: [f32; 3],
    /// Light from above, on a surface that faces up.
    pub sky: [f32; 3],
    /// Light bounced from the ground, on a surface that faces down.
    pub ground: [f32; 3],
    /// Sky seen at the zenith.
    pub zenith: [f32; 3],
    /// Sky seen at the horizon.
    pub horizon: [f32; 3],
    /// True if the sun casts shadows.
    pub shadows: bool,
}

impl Default for Lighting {
    /// Light of a clear late morning.
    fn default() -> Self {
        Self {
            sun_direction: Vec3::new(0.45, 0.75, 0.48).normalize(),
            sun: [0.80, 0.74, 0.64],
            sky: [0.30, 0.36, 0.46],
            ground: [0.16, 0.14, 0.12],
            zenith: [0.16, 0.32, 0.66],
            horizon: [0.62, 0.74, 0.86],
            shadows: true,
        }
    }
}

/// Fault in a scene that breaks a promise of its types.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
#[error("scene \"{scene}\" is damaged: {fault}; make it anew or load it from a file")]
pub struct SceneFault {
    /// Name of the scene.
    pub scene: String,
    /// Description of the fault, with its mesh, material or texture.
    pub fault: String,
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

    /// Checks what these types promise: array lengths and indices, not coordinates.
    ///
    /// Loaders keep the promises. This check is for scenes made by hand; after it, code may index freely.
    ///
    /// # Errors
    /// The first broken promise, as a [`SceneFault`].
    pub fn validate(&self) -> Result<(), SceneFault> {
        match self.fault() {
            None => Ok(()),
            Some(fault) => Err(SceneFault { scene: self.name.clone(), fault }),
        }
    }

    fn fault(&self) -> Option<String> {
        let texture = |texture: &Texture| {
            let bytes = u64::from(texture.width) * u64::from(texture.height) * 4;
            (bytes != texture.rgba.len() as u64).then(|| {
                let (name, width, height, given) = (&texture.name, texture.width, texture.height, texture.rgba.len());
                format!("texture \"{name}\" of {width} × {height} pixels has {given} bytes instead of {bytes}")
            })
        };
        let spectrum = |spectrum: &Option<Spectrum>, of: &str| {
            // A spectrum from its own constructors is valid, but its public fields can be set without them.
            let checked = match spectrum.as_ref()? {
                Spectrum::Planck { kelvin } => Spectrum::planck(*kelvin),
                Spectrum::Rgb(rgb) => Spectrum::rgb(*rgb),
                good @ (Spectrum::Sampled(_) | Spectrum::Gray) => Ok(good.clone()),
            };
            checked.err().map(|fault| format!("the spectrum of {of}: {fault}"))
        };
        let white = || {
            let white = self.white.filter(|white| !(white.is_finite() && *white > 0.0))?;
            Some(format!("the luminance of white is {white} cd/m², not a finite number above 0"))
        };
        let panorama = || {
            let Panorama { width, height, rgb } = self.panorama.as_ref()?;
            let pixels = u64::from(*width) * u64::from(*height);
            let whole = pixels > 0 && pixels == rgb.len() as u64;
            (!whole).then(|| format!("the panorama of {width} × {height} pixels has {}", rgb.len()))
        };
        let material = |material: &Material| {
            let fault = spectrum(&material.spectrum, &format!("material \"{}\"", material.name));
            if fault.is_some() {
                return fault;
            }
            if !(material.index_of_refraction >= 1.0 && material.index_of_refraction.is_finite()) {
                let (name, index) = (&material.name, material.index_of_refraction);
                return Some(format!(
                    "material \"{name}\" has an index of refraction of {index}, which is not 1 or more"
                ));
            }
            let used = [material.base_colour_texture, material.emissive_texture];
            let missing = used.into_iter().flatten().find(|&index| index >= self.textures.len())?;
            let (name, count) = (&material.name, self.textures.len());
            Some(format!("material \"{name}\" uses texture {missing} of {count}"))
        };
        let mesh = |mesh: &Mesh| {
            let (name, count) = (&mesh.name, mesh.positions.len());
            if mesh.material >= self.materials.len() {
                return Some(format!("mesh \"{name}\" uses material {} of {}", mesh.material, self.materials.len()));
            }
            if let Some(motion) = mesh.motion.filter(|&motion| motion >= self.motions.len()) {
                return Some(format!("mesh \"{name}\" has motion {motion} of {}", self.motions.len()));
            }
            if [mesh.normals.len(), mesh.uvs.len(), mesh.colours.len()] != [count; 3] {
                return Some(format!("mesh \"{name}\" has vertex arrays of different lengths"));
            }
            if !mesh.indices.len().is_multiple_of(3) {
                return Some(format!("mesh \"{name}\" has {} indices, not three per triangle", mesh.indices.len()));
            }
            let beyond = mesh.indices.iter().find(|&&index| index as usize >= count)?;
            Some(format!("mesh \"{name}\" uses vertex {beyond} of {count}"))
        };
        let motion = |(number, motion): (usize, &motion::Motion)| {
            let motion::Motion::Uniform(motion::Uniform { anchor, .. }) = motion else { return None };
            let finite = anchor.position.is_finite() && anchor.ct.is_finite();
            (!finite)
                .then(|| format!("motion {number} passes {} at {} m, which is not finite", anchor.position, anchor.ct))
        };
        let spectra = || {
            let mut different: Vec<(&Spectrum, bool)> = Vec::new();
            for material in &self.materials {
                if let Some(spectrum) = material.spectrum.as_ref().map(|spectrum| (spectrum, material.is_source()))
                    && different.len() <= MAX_SPECTRA
                    && !different.contains(&spectrum)
                {
                    different.push(spectrum);
                }
            }
            let many = different.len() > MAX_SPECTRA;
            many.then(|| {
                format!("its materials have more than {MAX_SPECTRA} different spectra, which is all that can be drawn")
            })
        };
        let lamp = |lamp: &Lamp| {
            let place = (!lamp.position.is_finite()).then(|| format!("lamp \"{}\" is nowhere", lamp.name));
            place.or_else(|| spectrum(&lamp.spectrum, &format!("lamp \"{}\"", lamp.name)))
        };
        let textures = self.textures.iter().find_map(texture);
        textures
            .or_else(|| self.materials.iter().find_map(material))
            .or_else(|| self.meshes.iter().find_map(mesh))
            .or_else(|| self.motions.iter().enumerate().find_map(motion))
            .or_else(|| self.lamps.iter().find_map(lamp))
            .or_else(|| spectrum(&self.illuminant, "the light"))
            .or_else(white)
            .or_else(panorama)
            .or_else(spectra)
    }
}
