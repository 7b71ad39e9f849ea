//! Loading of the requested scene: built in, or from a file.

use crate::output::progress::{self, LateBar};
use crate::output::say::tell;
use built_in::lattice::Lattice;
use built_in::{dice, laboratory, spectra, town, train};
use command::{SceneChoice, WorldOptions};
use picture_cache::PictureCache;
use scene::{Scene, TooFast, ViewCamera};
use scene_files::gltf::{LoadStage, ReadRules};
use scene_files::read;
use std::path::PathBuf;
use thiserror::Error;

/// Reason why there is no scene.
#[derive(Debug, Error)]
pub enum SceneError {
    /// A file that gives no scene.
    #[error(transparent)]
    File(#[from] scene_files::SceneReadError),
    /// An animation faster than light.
    #[error("{}: {fault}", path.display())]
    TooFast {
        /// File of the scene.
        path: PathBuf,
        /// Animation, and its speed.
        fault: TooFast,
    },
    /// A camera that the scene does not have.
    #[error("{scene} has no camera \"{name}\": it has {known}")]
    NoCamera {
        /// Name of the scene.
        scene: String,
        /// Name that was asked for.
        name: String,
        /// Names that there are.
        known: String,
    },
}

/// Speed of light in a scene of which nothing is said, m/s: that of the old town, 30 km/h.
const SPEED_OF_LIGHT_M_S: f64 = 30.0 / 3.6;

/// Factor by which light is faster than the fastest animation, where the scene's size would make it slower.
const AHEAD_OF_ANIMATIONS: f64 = 1.25;

/// Scene and the speed of light in it.
pub struct World {
    /// Scene.
    pub scene: Scene,
    /// Speed of light, m/s.
    pub speed_of_light_m_s: f64,
}

/// Builds or reads the scene that the options name, as it was modelled, seen from the camera that they name.
///
/// # Errors
/// A fault of the file with its place, a camera that the scene does not have, or an animation faster than light.
pub fn load(options: &WorldOptions) -> Result<World, SceneError> {
    let choice = options.scene();
    let mut scene = read_scene(&choice, options)?;
    if let Some(name) = &options.camera {
        scene.start = camera(&scene, name)?.start;
    }
    let Some(speed_of_light_m_s) = options.speed_of_light else {
        return with_own_light(scene, &choice);
    };
    set_light(&mut scene, &choice, speed_of_light_m_s)?;
    Ok(World { scene, speed_of_light_m_s })
}

/// Scene of a recording, with the recording's speed of light in m/s.
///
/// # Errors
/// A fault of the file with its place, or an animation faster than light.
pub fn load_recorded(
    choice: &SceneChoice,
    options: &WorldOptions,
    speed_of_light_m_s: f64,
) -> Result<Scene, SceneError> {
    let mut scene = read_scene(choice, options)?;
    set_light(&mut scene, choice, speed_of_light_m_s)?;
    Ok(scene)
}

/// World whose speed of light suits the scene, with a line that says so.
fn with_own_light(mut scene: Scene, choice: &SceneChoice) -> Result<World, SceneError> {
    let suited = scene.speed_of_light_m_s;
    let mut speed_of_light_m_s = suited.unwrap_or(SPEED_OF_LIGHT_M_S);
    // One animation after the other may be too fast.
    for _ in 0..scene.motions.len() {
        let Err(fault) = scene.set_speed_of_light(speed_of_light_m_s) else { break };
        speed_of_light_m_s = AHEAD_OF_ANIMATIONS * fault.speed_m_s;
    }
    set_light(&mut scene, choice, speed_of_light_m_s)?;
    if suited.is_some() || speed_of_light_m_s != SPEED_OF_LIGHT_M_S {
        let speed = described_speed(speed_of_light_m_s);
        let name = &scene.name;
        tell(format_args!("{name}: light at {speed}, which suits the scene; --speed-of-light sets another"));
    }
    Ok(World { scene, speed_of_light_m_s })
}

/// Speed in the unit in which a reader knows it.
fn described_speed(speed_m_s: f64) -> String {
    match speed_m_s {
        slow if slow < 1.0 => format!("{} m/s", rounded(slow)),
        speed => format!("{} km/h", rounded(3.6 * speed)),
    }
}

/// Number with three digits.
fn rounded(value: f64) -> f64 {
    let digit = 10_f64.powf(value.log10().floor() - 2.0);
    // Rounded twice, so that the text has no digits beyond.
    format!("{:.12}", (value / digit).round() * digit).parse().unwrap_or(value)
}

fn set_light(scene: &mut Scene, choice: &SceneChoice, speed_of_light_m_s: f64) -> Result<(), SceneError> {
    let checked = scene.set_speed_of_light(speed_of_light_m_s);
    checked.map_err(|fault| SceneError::TooFast { path: choice.name().into(), fault })
}

/// Camera of a scene, by its name or its number from 1.
fn camera<'a>(scene: &'a Scene, name: &str) -> Result<&'a ViewCamera, SceneError> {
    let named = scene.cameras.iter().find(|camera| camera.name == name);
    let numbered = || name.parse::<usize>().ok().and_then(|number| scene.cameras.get(number.checked_sub(1)?));
    named.or_else(numbered).ok_or_else(|| SceneError::NoCamera {
        scene: scene.name.clone(),
        name: name.to_owned(),
        known: if scene.cameras.is_empty() {
            "no cameras".to_owned()
        } else {
            let names = scene.cameras.iter().map(|camera| format!("\"{}\"", camera.name));
            names.take(20).collect::<Vec<_>>().join(", ")
        },
    })
}

/// Old town, its pictures from the user's cache if they are there, else painted and kept for the next start.
fn old_town(no_cache: bool) -> Scene {
    let seed = town::TOWN_SEED;
    let cache = if no_cache { None } else { PictureCache::of_user() };
    if let Some(scene) = cache.as_ref().and_then(|cache| town::build_with(seed, cache.load(seed)?)) {
        return scene;
    }
    let bar = LateBar::new("painting the town");
    let pictures = town::paint_pictures(seed, |done, total| bar.told(done, total));
    bar.finish();
    if let Some(cache) = cache {
        // What cannot be kept is painted again the next time.
        let _ = cache.keep(seed, &pictures);
    }
    town::build_with(seed, pictures).expect("as many pictures are painted as the town has")
}

fn read_scene(choice: &SceneChoice, options: &WorldOptions) -> Result<Scene, SceneError> {
    match choice {
        SceneChoice::Town => Ok(old_town(options.no_cache)),
        SceneChoice::Spectra => Ok(spectra::build()),
        SceneChoice::Lattice => Ok(Lattice::default().build()),
        SceneChoice::Dice => Ok(dice::build()),
        SceneChoice::Train => Ok(train::build()),
        SceneChoice::Laboratory => Ok(laboratory::build()),
        SceneChoice::File(path) => {
            let bar = progress::bar(path.display().to_string(), 0);
            let budget = options.reading.budget();
            let rules = ReadRules { budget: &budget, trust: options.reading.trust };
            let scene = read(path, rules, |progress| {
                let stage = match progress.stage {
                    LoadStage::Pictures => "pictures",
                    LoadStage::Meshes => "meshes",
                };
                bar.set_message(format!("{}: {stage}", path.display()));
                bar.set_length(progress.total as u64);
                bar.set_position(progress.done as u64);
            })?;
            bar.finish_and_clear();
            for notice in &scene.notices {
                tell(format_args!("{}: {notice}", path.display()));
            }
            Ok(scene)
        }
    }
}
