//! Scene check: a report on the contents of a scene, with warnings about likely mistakes.
//!
//! Notices come from the file (features that are not drawn). Warnings are found here, in the scene as it is drawn.
//! Neither keeps a scene from being shown.

use std::fmt;
use std::path::Path;

use glam::DVec3;
use physics::colour::Spectrum;

use crate::read::{SceneReadError, read};
use scene::collision::Collision;
use scene::motion::Motion;
use scene::{Material, Scene, SceneFault, Surroundings};

/// Plausible size of a scene, metres; outside of it the unit is probably not the metre.
const PLAUSIBLE_SIZE: std::ops::RangeInclusive<f64> = 0.1..=1e5;

/// Plausible brightness of white surfaces in sunlight, as a multiple of the luminance shown as white; above it the
/// sun's unit is probably wrong.
const PLAUSIBLE_SUN: f64 = 8.0;

/// Share of white's luminance below which a surface cannot be seen beside white.
const DARK: f64 = 1.0 / 300.0;

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
pub fn check(path: &Path) -> Result<Report, CheckError> {
    Ok(Report::new(&read(path, |_| {})?)?)
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
            moving: moving(scene),
            bounds,
            longest_edge: survey.longest_edge,
            notices: scene.notices.clone(),
            warnings: warnings(scene, &survey, &collision),
        })
    }
}

/// Result of the survey of all triangles.
#[derive(Default)]
struct Survey {
    /// Least and greatest corner relative to the scene's origin, metres.
    bounds: Option<[DVec3; 2]>,
    longest_edge: f64,
    without_area: usize,
    not_finite: usize,
    inside_out: usize,
}

impl Survey {
    fn of(scene: &Scene) -> Self {
        let mut survey = Self::default();
        for mesh in &scene.meshes {
            // An animated mesh counts in its pose at time 0.
            let animated = mesh.motion.and_then(|motion| scene.motions[motion].animated());
            let pose = animated.map(|animated| animated.at(0.0));
            for &position in mesh.positions.iter().filter(|position| position.is_finite()) {
                let position = position.as_dvec3();
                let position = pose.map_or(position, |pose| pose.position(position) - scene.origin);
                let [least, most] = survey.bounds.unwrap_or([position; 2]);
                survey.bounds = Some([least.min(position), most.max(position)]);
            }
            for corners in mesh.indices.as_chunks::<3>().0 {
                let corners = corners.map(|corner| corner as usize);
                let [a, b, c] = corners.map(|corner| mesh.positions[corner].as_dvec3());
                let face = (b - a).cross(c - a);
                if !face.is_finite() {
                    survey.not_finite += 1;
                    continue;
                }
                let longest = a.distance(b).max(b.distance(c)).max(c.distance(a));
                survey.longest_edge = survey.longest_edge.max(longest);
                let normal: DVec3 = corners.iter().map(|&corner| mesh.normals[corner].as_dvec3()).sum();
                survey.without_area += usize::from(face == DVec3::ZERO);
                survey.inside_out += usize::from(face.dot(normal) < 0.0);
            }
        }
        survey
    }
}

/// Descriptions of the moving bodies, in the order of the scene's motions.
fn moving(scene: &Scene) -> Vec<String> {
    let said = |(number, motion): (usize, &Motion)| {
        let beta = scene.fastest(number).beta;
        match motion {
            Motion::Uniform(uniform) => {
                let mesh = scene.meshes.iter().find(|mesh| mesh.motion == Some(number));
                let name = mesh.map_or("nothing", |mesh| mesh.name.as_str());
                format!("\"{name}\" at {beta:.6} c, a celerity of {:.6}", uniform.celerity.magnitude())
            }
            Motion::Animated(animated) => {
                let speed = beta * animated.speed_of_light_m_s();
                format!("\"{}\" by its animation, at up to {speed:.6} m/s: light has to be faster", animated.name)
            }
        }
    };
    scene.motions.iter().enumerate().map(said).collect()
}

/// Descriptions of the spectra of light and materials; equal spectra share a line.
fn spectra(scene: &Scene) -> Vec<String> {
    let mut owners: Vec<(&Spectrum, Vec<String>)> = Vec::new();
    let illuminant = scene.illuminant.iter().map(|spectrum| (spectrum, "the light".to_owned()));
    let materials = scene.materials.iter().filter_map(|material| {
        let role = if material.is_source() { "sent out by" } else { "returned by" };
        Some((material.spectrum.as_ref()?, format!("{role} \"{}\"", material.name)))
    });
    for (spectrum, owner) in illuminant.chain(materials) {
        match owners.iter_mut().find(|(known, _)| *known == spectrum) {
            Some((_, names)) => names.push(owner),
            None => owners.push((spectrum, vec![owner])),
        }
    }
    owners.into_iter().map(|(spectrum, owners)| format!("{}: {}", described(spectrum), owners.join(", "))).collect()
}

fn described(spectrum: &Spectrum) -> String {
    match spectrum {
        Spectrum::Planck { kelvin } => format!("Planck at {kelvin} K"),
        Spectrum::Sampled(sampled) => match sampled.samples() {
            [[first, _], .., [last, _]] => format!("{} samples from {first} to {last} nm", sampled.samples().len()),
            samples => format!("{} sample", samples.len()),
        },
        Spectrum::Rgb([red, green, blue]) => format!("rgb {red}, {green}, {blue}"),
        Spectrum::Gray => "gray".to_owned(),
    }
}

fn warnings(scene: &Scene, survey: &Survey, collision: &Collision) -> Vec<String> {
    let mut warnings = Vec::new();
    let mut warn = |holds: bool, warning: String| {
        if holds {
            warnings.push(warning);
        }
    };
    let Survey { without_area, not_finite, inside_out, .. } = *survey;
    let empty = scene.triangle_count() == 0;
    warn(empty && scene.panorama.is_none(), "there is nothing to draw: the scene has no triangles".into());
    warn(
        not_finite > 0,
        format!("triangles with corners that are nowhere (not finite): {not_finite}; they are not drawn"),
    );
    warn(without_area > 0, format!("triangles without area: {without_area}; remove them to save time"));
    let advice = "their light falls on the wrong side; turn their winding or their normals";
    warn(inside_out > 0, format!("triangles that face away from their normals: {inside_out}; {advice}"));
    for material in &scene.materials {
        let black = material.spectrum.is_some() && material.base_colour[..3].iter().all(|channel| *channel == 0.0);
        let advice = "the spectrum is multiplied by the base colour's luminance; make it white";
        warn(black, format!("material \"{}\" has a spectrum and a black base colour: {advice}", material.name));
    }
    // Luminance of a white surface in light of the colour 1, as a multiple of the luminance shown as white.
    let white = scene.white_luminance();
    let anything_lit =
        scene.materials.iter().any(|material| !(material.unlit || material.spectrum.is_some() && material.is_source()));
    let lit =
        if anything_lit { scene.illuminant.as_ref().map_or(1.0, |spectrum| spectrum.xyz(1.0).y) / white } else { 0.0 };
    let greatest = |colour: [f32; 3]| colour.into_iter().map(f64::from).fold(0.0, f64::max);
    let (brightest, sky) = (greatest(scene.light.sun) * lit, greatest(scene.light.sky) * lit);
    let advice = "name their luminance in cd/m² as extras.rapidity.white of the scene, or dim the sun to π lux";
    warn(
        brightest > PLAUSIBLE_SUN,
        format!("surfaces in the sun are up to {brightest:.1} times as bright as white: {advice}"),
    );
    let dark = |material: &&Material| match (material.is_source(), &material.spectrum) {
        (true, None) => f64::from(material.unlit).max(greatest(material.emissive)) / white < DARK,
        (true, Some(_)) => false,
        (false, _) => scene.illuminant.is_none() && brightest.max(sky) < DARK,
    };
    let dark: Vec<_> = scene.materials.iter().filter(dark).map(|material| material.name.as_str()).collect();
    let advice =
        "give a spectrum to them, or to the light that falls on them, or lower extras.rapidity.white of the scene";
    warn(
        white > 1.0 / DARK && !dark.is_empty(),
        format!(
            "{white:.3e} cd/m² are white, beside which colours, of 1 cd/m², are black ({}): {advice}",
            dark.join(", ")
        ),
    );
    if let Some([least, most]) = survey.bounds {
        let size = (most - least).max_element();
        let advice = "lengths are metres; scale the scene if they were not";
        warn(!PLAUSIBLE_SIZE.contains(&size), format!("the scene is {size} m large: {advice}"));
    }
    let grounded = |point: DVec3| collision.height_below(point).is_some();
    let advice = "a vehicle on wheels stays at its height";
    let solid = scene.meshes.iter().any(|mesh| mesh.solid);
    let ridden_in = !empty || scene.panorama.is_none();
    warn(ridden_in && !solid, format!("no mesh is solid: {advice} and passes through everything"));
    warn(solid && !grounded(scene.start.position), format!("there is no ground below the start: {advice}"));
    let airborne = scene.circuit.iter().filter(|&&point| !grounded(point)).count();
    let points = scene.circuit.len();
    warn(
        solid && airborne > 0,
        format!("points of the circuit without ground below: {airborne} of {points}; {advice}"),
    );
    warnings
}

impl fmt::Display for Report {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        writeln!(f, "scene       {}", self.name)?;
        writeln!(f, "triangles   {}, {} vertices, {} meshes", self.triangles, self.vertices, self.meshes)?;
        let megabytes = self.texture_bytes as f64 / 1e6;
        writeln!(f, "materials   {}, {} textures of {megabytes:.1} MB", self.materials, self.textures)?;
        for spectrum in &self.spectra {
            writeln!(f, "spectrum    {spectrum}")?;
        }
        if let Some(white) = self.white {
            writeln!(f, "white       {white} cd/m²")?;
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
        for moving in &self.moving {
            writeln!(f, "moves       {moving}")?;
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
mod tests {
    //! Laws under test: a report counts the contents, and warns of faults only. A wrong one would miss a hole below
    //! the start, or warn of a sound scene.

    use glam::{Vec2, Vec3};

    use super::*;
    use scene::{Material, Mesh, Texture};

    /// Scene with a square of ground, 10 m wide, in two triangles.
    fn ground() -> Scene {
        let positions = [(-5, -5), (-5, 5), (5, 5), (5, -5)].map(|(x, z)| Vec3::new(x as f32, 0.0, z as f32));
        let mesh = Mesh {
            name: "ground".into(),
            positions: positions.to_vec(),
            normals: vec![Vec3::Y; 4],
            uvs: vec![Vec2::ZERO; 4],
            colours: vec![[1.0; 4]; 4],
            indices: vec![0, 1, 2, 0, 2, 3],
            solid: true,
            ..Mesh::default()
        };
        let texture = Texture {
            name: "grass".into(),
            width: 4,
            height: 2,
            rgba: vec![0; 32],
            wrap: Default::default(),
            nearest: false,
        };
        Scene {
            name: "meadow".into(),
            origin: DVec3::new(0.0, 100.0, 0.0),
            textures: vec![texture],
            materials: vec![Material::default()],
            meshes: vec![mesh],
            start: scene::Start { position: DVec3::new(0.0, 100.0, 0.0), look: DVec3::NEG_Z },
            circuit: vec![DVec3::new(1.0, 100.0, 1.0)],
            ..Scene::default()
        }
    }

    fn warning(change: impl Fn(&mut Scene)) -> String {
        let mut scene = ground();
        change(&mut scene);
        let [warning] = Report::new(&scene).unwrap().warnings.try_into().expect("one warning");
        warning
    }

    #[test]
    fn a_sound_scene_is_counted_and_not_warned_of() {
        let report = Report::new(&ground()).unwrap();
        assert_eq!((report.meshes, report.triangles, report.vertices), (1, 2, 4));
        assert_eq!((report.materials, report.textures, report.texture_bytes), (1, 1, 32));
        assert_eq!(report.bounds, Some([DVec3::new(-5.0, 100.0, -5.0), DVec3::new(5.0, 100.0, 5.0)]));
        assert_eq!(report.longest_edge, 200_f64.sqrt());
        assert!(report.warnings.is_empty(), "{:?}", report.warnings);
    }

    #[test]
    fn what_is_wrong_is_warned_of() {
        assert!(warning(|scene| scene.meshes[0].indices.extend([0, 0, 1])).starts_with("triangles without area: 1;"));
        assert!(warning(|scene| scene.meshes[0].indices.swap(0, 1)).contains("face away from their normals: 1;"));
        assert!(warning(|scene| scene.start.position.x = 6.0).contains("no ground below the start"));
        assert!(warning(|scene| scene.circuit.push(DVec3::ZERO)).contains("without ground below: 1 of 2;"));
        assert!(warning(|scene| scene.meshes[0].solid = false).contains("no mesh is solid"));
        let far = |scene: &mut Scene| {
            scene.meshes[0].positions.push(Vec3::X * 1e6);
            scene.meshes[0].normals.push(Vec3::Y);
            scene.meshes[0].uvs.push(Vec2::ZERO);
            scene.meshes[0].colours.push([1.0; 4]);
        };
        assert!(warning(far).contains("lengths are metres"));
        let nowhere = |scene: &mut Scene| {
            far(scene);
            scene.meshes[0].positions[4] = Vec3::NAN;
            scene.meshes[0].indices.extend([0, 1, 4]);
        };
        assert!(warning(nowhere).contains("nowhere (not finite): 1;"));
    }

    #[test]
    fn an_empty_scene_says_so() {
        let report = Report::new(&Scene::default()).unwrap();
        assert!(report.warnings[0].contains("nothing to draw"));
        assert_eq!(report.bounds, None);
    }

    #[test]
    fn a_file_is_reported_as_it_is_drawn() {
        let folder = tempfile::TempDir::new().unwrap();
        let path = folder.path().join("meadow.glb");
        crate::export::write_glb(&ground(), &path).unwrap();
        let mut expected = Report::new(&ground()).unwrap();
        // The texture is drawn by no material, so it is not loaded.
        (expected.textures, expected.texture_bytes) = (0, 0);
        let report = check(&path).unwrap();
        assert_eq!(report, expected);
        let text = report.to_string();
        assert!(text.contains("2, 4 vertices, 1 meshes") && text.contains("10.000 × 0.000 × 10.000 m"), "{text}");
    }

    #[test]
    fn a_file_that_is_no_scene_is_an_error() {
        assert!(matches!(check(Path::new("/nowhere.glb")), Err(CheckError::Load(SceneReadError::Gltf(_)))));
    }
}
