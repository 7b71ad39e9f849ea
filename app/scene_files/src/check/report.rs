//! Report on the contents of a scene.

use std::fmt;
use std::path::Path;

use glam::DVec3;

use super::descriptions::{first_view, moving, spectra};
use super::survey::Survey;
use super::warnings::warnings;
use crate::gltf::ReadRules;
use crate::read::{SceneReadError, read};
use serde_json::{Value, json};

use scene::collision::Collision;
use scene::{Scene, SceneFault};

/// Reason why there is no report.
#[derive(Debug, thiserror::Error)]
pub enum CheckError {
    /// A file that gives no scene.
    #[error(transparent)]
    Load(#[from] SceneReadError),
    /// A scene that breaks a promise of its types.
    #[error(transparent)]
    Damaged(#[from] SceneFault),
}

/// Largest number of moving bodies that the text names.
const MOST_MOVING: usize = 8;

/// Report on the contents of a scene.
#[derive(Clone, Debug, PartialEq)]
pub struct Report {
    /// Name of the scene.
    pub name: String,
    /// Number of meshes.
    pub meshes: usize,
    /// Number of triangles.
    pub triangles: usize,
    /// Number of vertices.
    pub vertices: usize,
    /// Number of materials.
    pub materials: usize,
    /// Number of textures.
    pub textures: usize,
    /// Size of all textures without mipmaps, in bytes.
    pub texture_bytes: usize,
    /// Spectra, each with the materials or lights that have it.
    pub spectra: Vec<String>,
    /// Luminance that is shown as white, cd/m², if the scene sets it.
    pub white: Option<f64>,
    /// Width and height of the panorama, in pixels, if there is one.
    pub panorama: Option<[u32; 2]>,
    /// First view of the scene, in words.
    pub first_view: String,
    /// Names of the scene's cameras, in the order of their numbers.
    pub cameras: Vec<String>,
    /// Speed of light that suits the scene, m/s, if it is of no particular one.
    pub speed_of_light_m_s: Option<f64>,
    /// Kind of the picture and its layout, if the file is a picture.
    pub picture: Option<String>,
    /// Motions, one line each: the moving body, its motion and its largest speed.
    pub moving: Vec<String>,
    /// Least and greatest corner of the box round all finite vertices, world metres; `None` if there are none.
    pub bounds: Option<[DVec3; 2]>,
    /// Length of the longest finite edge, metres; `refine` would split it first.
    pub longest_edge: f64,
    /// Features that the file asks for and that are not drawn.
    pub notices: Vec<String>,
    /// Likely mistakes that disturb an observer, each with advice.
    pub warnings: Vec<String>,
}

/// Loads a file and reports on it.
///
/// # Errors
/// [`CheckError`] if the file gives no scene.
pub fn check(path: &Path, rules: ReadRules<'_>) -> Result<Report, CheckError> {
    if panoramas::is_picture(path) {
        let (scene, picture) = panoramas::load_described(path, rules.budget).map_err(SceneReadError::from)?;
        return Ok(Report { picture: Some(picture), ..Report::new(&scene)? });
    }
    Ok(Report::new(&read(path, rules, |_| {})?)?)
}

impl Report {
    /// Surveys every triangle once.
    ///
    /// # Errors
    /// [`SceneFault`] if the scene breaks a promise of its types.
    pub fn new(scene: &Scene) -> Result<Self, SceneFault> {
        let collision = Collision::new(scene)?;
        let survey = Survey::of(scene);
        let bounds = survey.bounds.map(|bounds| bounds.map(|corner| scene.origin + corner));
        Ok(Self {
            name: scene.name.clone(),
            meshes: scene.meshes.len(),
            triangles: scene.triangle_count(),
            vertices: scene.vertex_count(),
            materials: scene.materials.len(),
            textures: scene.textures.len(),
            texture_bytes: scene.textures.iter().map(|texture| texture.rgba.len()).sum(),
            spectra: spectra(scene),
            white: scene.white,
            panorama: scene.panorama.as_ref().map(|panorama| [panorama.width, panorama.height]),
            first_view: first_view(scene),
            cameras: scene.cameras.iter().map(|camera| camera.name.clone()).collect(),
            speed_of_light_m_s: scene.speed_of_light_m_s,
            picture: None,
            moving: moving(scene),
            bounds,
            longest_edge: survey.longest_edge,
            notices: scene.notices.clone(),
            warnings: warnings(scene, &survey, &collision),
        })
    }
}

impl Report {
    /// Report as a JSON object, for other programs; lengths in metres.
    pub fn to_json(&self) -> Value {
        let corners = self.bounds.map(|corners| corners.map(|corner| corner.to_array()));
        json!({
            "name": self.name,
            "opens": self.first_view,
            "cameras": self.cameras,
            "speedOfLight": self.speed_of_light_m_s,
            "meshes": self.meshes,
            "triangles": self.triangles,
            "vertices": self.vertices,
            "materials": self.materials,
            "textures": self.textures,
            "textureBytes": self.texture_bytes,
            "spectra": self.spectra,
            "white": self.white,
            "panorama": self.panorama,
            "picture": self.picture,
            "moving": self.moving,
            "bounds": corners,
            "longestEdge": self.longest_edge,
            "notices": self.notices,
            "warnings": self.warnings,
        })
    }
}

impl fmt::Display for Report {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        writeln!(f, "scene       {}", self.name)?;
        writeln!(f, "opens       {}", self.first_view)?;
        if !self.cameras.is_empty() {
            let numbered = self.cameras.iter().enumerate().map(|(index, name)| format!("{} \"{name}\"", index + 1));
            writeln!(f, "cameras     {}", numbered.collect::<Vec<_>>().join(", "))?;
        }
        if let Some(speed) = self.speed_of_light_m_s {
            writeln!(f, "light       {speed} m/s, unless --speed-of-light says otherwise")?;
        }
        writeln!(f, "triangles   {}, {} vertices, {} meshes", self.triangles, self.vertices, self.meshes)?;
        let megabytes = self.texture_bytes as f64 / 1e6;
        writeln!(f, "materials   {}, {} textures of {megabytes:.1} MB", self.materials, self.textures)?;
        for spectrum in &self.spectra {
            writeln!(f, "spectrum    {spectrum}")?;
        }
        if let Some(white) = self.white {
            writeln!(f, "white       {white} cd/m²")?;
        }
        if let Some(picture) = &self.picture {
            writeln!(f, "picture     {picture}")?;
        }
        if let Some([width, height]) = self.panorama {
            writeln!(f, "panorama    {width} × {height} pixels")?;
        }
        if let Some([least, most]) = self.bounds {
            let size = most - least;
            writeln!(f, "size        {:.3} × {:.3} × {:.3} m (x, y, z)", size.x, size.y, size.z)?;
            writeln!(f, "from        {:.3}, {:.3}, {:.3} m", least.x, least.y, least.z)?;
            writeln!(f, "to          {:.3}, {:.3}, {:.3} m", most.x, most.y, most.z)?;
        }
        for moving in self.moving.iter().take(MOST_MOVING) {
            writeln!(f, "moves       {moving}")?;
        }
        if self.moving.len() > MOST_MOVING {
            writeln!(f, "moves       and {} more", self.moving.len() - MOST_MOVING)?;
        }
        writeln!(f, "edges       {:.3} m at most", self.longest_edge)?;
        for notice in &self.notices {
            writeln!(f, "notice:     {notice}")?;
        }
        for warning in &self.warnings {
            writeln!(f, "warning:    {warning}")?;
        }
        Ok(())
    }
}

#[cfg(test)]
#[path = "tests.rs"]
mod tests;
