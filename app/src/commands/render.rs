//! `rapidity render`: stills and films, without a window.
//!
//! A film without a recording shows what an inertial observer sees: the eye moves on a straight worldline, and the
//! frames are taken at equal steps of its proper time. A recorded ride is seen with the rider's eyes.

use crate::commands::cameraman::{Cameraman, Equipment, FilmOut, FilmRoll, dial_of_stills};
use crate::commands::render_room;
use crate::error::Error;
use crate::output::say::tell;
use crate::session::interrupt::{interrupted, interruption};
use crate::session::reel::{self, Ridden, Told};
use crate::session::scenes::{self, World};
use camera_paths::{CameraPath, PathFile, PathView};
use command::{Output, PartChoice, RenderOptions, SceneChoice, Viewpoint, WorldOptions};
use filming::{FrameFile, Look, Moment};
use glam::{DQuat, DVec3};
use physics::{Event, Observer};
use picture_files::files::writable;
use picture_files::{FarmPart, FrameNumbers, is_whole};
use render::Gpu;
use scene::Start;
use std::path::Path;
use std::sync::atomic::Ordering;
use view::{Camera, CameraLens, Gaze, OpenShutter, Optics};
use walls::StereoEyes;

/// Length of a film without `--seconds`, seconds of proper time.
const FILM_SECONDS: f64 = 10.0;
/// Number of gazes along a path while a shutter is open.
const GAZES: u32 = 9;
/// Number of moments of a recorded ride for each picture, where a shutter is open.
const MOMENTS: u64 = 8;

/// Carries out `rapidity render`.
///
/// # Errors
/// Any fault that keeps the picture from being drawn or written.
pub fn render(options: &RenderOptions) -> Result<(), Error> {
    options.passed_over().iter().for_each(tell);
    // An interruption counts from the beginning.
    interrupted();
    if !matches!(options.out, Output::Folder(_)) {
        writable(&options.out.path())?;
    }
    let part = part(options)?;
    let gpu = Gpu::new()?;
    if let (Some(display), Output::Folder(folder)) = (&options.room.display, &options.out) {
        return render_room::render(options, &gpu, display, folder);
    }
    if let Some(recording) = &options.replay {
        return recorded_ride(options, &gpu, recording, part);
    }
    if let Some(path) = &options.path {
        return path_film(options, &gpu, path, part);
    }
    let World { scene, speed_of_light_m_s: speed_of_light } = scenes::load(&options.world)?;
    let start = scene.start;
    let look = Look::of(&options.picture.presentation(&start), options.outside);
    let moment = |number: u64| {
        let own_s = number as f64 / options.film.frames_per_second();
        let gaze = inertial(&options.viewpoint, start, own_s * speed_of_light);
        let exposure = OpenShutter::straight(&gaze, options.rays.shutter.unwrap_or(0.0) * speed_of_light);
        Moment { gaze, own_s, look, exposure, told: None }
    };
    let first = moment(0);
    let due = match &options.film.frames {
        Some(numbers) => numbers.clone(),
        None => FrameNumbers::first(options.film.count(options.film.seconds.unwrap_or(FILM_SECONDS))),
    };
    let due = Due::of(options, &due, part);
    if due.is_done(options) {
        return Ok(());
    }
    let dial = dial_of_stills(&options.dial, &options.picture);
    let equipment = equipment(options, upright(&first.gaze));
    let mut camera = Cameraman::new(&gpu, scene, &options.picture, dial, equipment)?;
    match &options.out {
        Output::Picture(path) => camera.still(&first, path, FrameFile::Png),
        Output::Light(path) => camera.still(&first, path, FrameFile::Exr),
        Output::Folder(path) => Ok(writable(path)?),
        out @ (Output::Film(_) | Output::Sequence(..)) => {
            let moments = due.numbers.iter().map(|number| Ok((*number, moment(*number))));
            camera.film(moments, due.numbers.len() as u64, film_out(options, out))
        }
    }
}

/// Draws the picture or film as a recorded rider saw it.
fn recorded_ride(options: &RenderOptions, gpu: &Gpu, recording: &Path, part: FarmPart) -> Result<(), Error> {
    let rate = options.film.frames_per_second();
    let shown = |start: &Start| (options.picture.presentation(start), options.picture.is_given);
    // A film of no length has its first picture.
    let seconds = options.film.seconds.map(|seconds| if seconds > 0.0 { seconds } else { 0.5 / rate });
    // A shutter needs the ride between the pictures as well.
    let shutter_s = options.rays.shutter.unwrap_or(0.0);
    let finer = if shutter_s > 0.0 { MOMENTS } else { 1 };
    let ridden = reel::reel(recording, &options.world, (rate * finer as f64, seconds), shown)?;
    let Ridden { scene, reel, .. } = ridden;
    let turn = rider_look(&options.viewpoint);
    let seen = |mut moment: Moment<Told>| {
        moment.look.outside = options.outside.or(moment.look.outside);
        moment.gaze.observer_from_eye *= turn;
        moment.exposure = moment.exposure.turned(turn);
        moment
    };
    let count = reel.len().div_ceil(finer);
    let due = match &options.film.frames {
        Some(numbers) => numbers.clone(),
        None => FrameNumbers::first(count),
    };
    if let Some(beyond) = due.iter().find(|number| *number >= count) {
        return Err(Error::BeyondFilm { number: beyond, count });
    }
    let due = Due::of(options, &due, part);
    if due.is_done(options) {
        return Ok(());
    }
    let dial = dial_of_stills(&options.dial, &options.picture);
    let equipment = equipment(options, turn.inverse() * DVec3::Y);
    let mut camera = Cameraman::new(gpu, scene, &options.picture, dial, equipment)?;
    let last = || reel.last().map(seen).ok_or(Error::NothingRidden);
    match &options.out {
        Output::Picture(path) => camera.still(&last()?, path, FrameFile::Png),
        Output::Light(path) => camera.still(&last()?, path, FrameFile::Exr),
        Output::Folder(path) => Ok(writable(path)?),
        out @ (Output::Film(_) | Output::Sequence(..)) => {
            let mut numbers = due.numbers.iter().peekable();
            let pick = |(moment, number): (Moment<Told>, u64)| {
                numbers.next_if_eq(&&number).map(|number| Ok((*number, seen(moment))))
            };
            let (count, out) = (due.numbers.len() as u64, film_out(options, out));
            if finer > 1 {
                camera.film(reel.exposed(finer, shutter_s).zip(0..).filter_map(pick), count, out)
            } else {
                camera.film(reel.pictures().zip(0..).filter_map(pick), count, out)
            }
        }
    }
}

/// Draws the picture or film of a camera that moves along a path, in one scene after the other.
fn path_film(options: &RenderOptions, gpu: &Gpu, file: &Path, part: FarmPart) -> Result<(), Error> {
    let mut worlds = PathWorlds { options, world: None };
    let (path, scenes) = worlds.path(file)?;
    let rate = options.film.frames_per_second();
    let due = match &options.film.frames {
        Some(numbers) => numbers.clone(),
        None => FrameNumbers::first(options.film.count(options.film.seconds.unwrap_or(path.length_s()))),
    };
    let due = Due::of(options, &due, part);
    if due.is_done(options) {
        return Ok(());
    }
    let first = path.at(0.0);
    let upright = first.gaze.observer_from_eye.inverse() * first.upright;
    let dial = dial_of_stills(&options.dial, &options.picture);
    let is_still = matches!(options.out, Output::Picture(_) | Output::Light(_));
    let seen = |number: u64| {
        let own_s = if is_still { options.film.seconds.unwrap_or(0.0) } else { number as f64 / rate };
        (path.at(own_s), own_s)
    };
    let shutter_s = options.rays.shutter.unwrap_or(0.0);
    let moment = |view: &PathView, own_s: f64, start: &Start| {
        let look = Look::of(&options.picture.presentation(start), options.outside);
        let fov_deg = options.picture.fov.or(view.fov_deg).unwrap_or(look.fov_deg);
        // A cut to another part of the path is not blurred.
        let gaze = |share: f64| {
            let moment = path.at(own_s + share * shutter_s);
            if moment.part == view.part { moment.gaze } else { view.gaze }
        };
        let parts = if shutter_s > 0.0 { GAZES } else { 0 };
        let share = |gaze: u32| f64::from(gaze) / f64::from(GAZES - 1) - 0.5;
        let exposure = OpenShutter::along((0..parts).map(|number| gaze(share(number))).collect());
        Moment { gaze: view.gaze, own_s, look: Look { fov_deg, ..look }, exposure, told: None }
    };
    let mut roll = None;
    let mut numbers = due.numbers.as_slice();
    let mut shot = Ok(());
    while let (Some(number), Ok(())) = (numbers.first(), &shot) {
        // Take the pictures that the next scene has.
        let scene_of = |number: u64| &scenes[seen(number).0.part];
        let (here, count) =
            (scene_of(*number), numbers.iter().take_while(|next| scene_of(**next) == scene_of(*number)));
        let count = count.count();
        let World { scene, .. } = worlds.load(here)?;
        let (start, equipment) = (scene.start, equipment(options, upright));
        let mut camera = Cameraman::new(gpu, scene, &options.picture, dial, equipment)?;
        let moments = numbers[..count].iter().map(|number| {
            let (view, own_s) = seen(*number);
            Ok((*number, moment(&view, own_s, &start)))
        });
        match &options.out {
            Output::Picture(path) | Output::Light(path) => {
                let kind = if options.writes_light() { FrameFile::Exr } else { FrameFile::Png };
                let (view, own_s) = seen(0);
                return camera.still(&moment(&view, own_s, &start), path, kind);
            }
            out => {
                let (out, all) = (film_out(options, out), due.numbers.len() as u64);
                let roll = match &mut roll {
                    Some(roll) => roll,
                    roll => roll.insert(FilmRoll::open(gpu, equipment, options.picture.size, out, all)?),
                };
                shot = camera.shoot(moments, roll);
            }
        }
        if interruption().load(Ordering::Relaxed) {
            break;
        }
        numbers = &numbers[count..];
    }
    roll.map_or(Ok(()), |roll| roll.finish(shot))
}

/// Scenes of a path's parts, of which the one loaded last is kept.
struct PathWorlds<'a> {
    options: &'a RenderOptions,
    world: Option<(WorldOptions, World)>,
}

impl PathWorlds<'_> {
    /// Path of a file, or of the scene's own camera, and the world of each part.
    fn path(&mut self, file: &Path) -> Result<(CameraPath, Vec<WorldOptions>), Error> {
        let own = self.options.world.clone();
        if file == Path::new("camera") {
            let World { scene, speed_of_light_m_s } = self.load(&own)?;
            let named = |camera: &&scene::ViewCamera| own.camera.as_ref().is_none_or(|name| camera.name == *name);
            let moving = scene.cameras.iter().filter(named).find(|camera| camera.motion.is_some());
            let camera = moving.ok_or_else(|| Error::NoMovingCamera { scene: scene.name.clone() })?;
            let path = CameraPath::of_gltf_camera(camera, speed_of_light_m_s)?;
            self.world = Some((own.clone(), World { scene, speed_of_light_m_s }));
            return Ok((path, vec![own]));
        }
        let file = PathFile::read(file)?;
        let mut worlds = Vec::new();
        let mut speeds = Vec::new();
        for part in file.scenes() {
            let mut world = own.clone();
            if let Some(scene) = &part.scene {
                world = WorldOptions { scene: Some(SceneChoice::from_name(scene)), camera: None, ..world };
            }
            world.speed_of_light = part.speed_of_light_m_s.or(world.speed_of_light);
            let loaded = self.load(&world)?;
            speeds.push(loaded.speed_of_light_m_s);
            self.world = Some((world.clone(), loaded));
            worlds.push(world);
        }
        Ok((file.path(&speeds)?, worlds))
    }

    /// World of a part.
    fn load(&mut self, options: &WorldOptions) -> Result<World, Error> {
        match self.world.take() {
            Some((kept, world)) if kept == *options => Ok(world),
            _ => Ok(scenes::load(options)?),
        }
    }
}

/// Numbers of the pictures that are to be drawn, in order.
struct Due {
    numbers: Vec<u64>,
    /// Number of those that are there.
    kept: usize,
}

impl Due {
    /// Pictures of a part of a farm, without those that are there and whole, if the options say so.
    fn of(options: &RenderOptions, numbers: &FrameNumbers, part: FarmPart) -> Self {
        let mut numbers: Vec<u64> = numbers.shared(options.film.step.unwrap_or(1), part).collect();
        numbers.sort_unstable();
        let all = numbers.len();
        if let (Output::Sequence(name, _), true) = (&options.out, options.film.resume) {
            let layout = options.projection.stereo;
            let size = layout.map_or(options.picture.size, |layout| layout.size(options.picture.size));
            let names = filming::eye_names(name, layout);
            numbers.retain(|number| !names.iter().all(|name| is_whole(&name.path(*number), size)));
        }
        Self { kept: all - numbers.len(), numbers }
    }

    /// True if nothing is left to draw of numbered pictures; says how many are kept.
    fn is_done(&self, options: &RenderOptions) -> bool {
        let Output::Sequence(name, _) = &options.out else { return false };
        if self.kept > 0 {
            tell(format_args!(
                "{}: {} pictures are there and whole, {} are to be drawn",
                name.pattern().display(),
                self.kept,
                self.numbers.len()
            ));
        } else if self.numbers.is_empty() {
            tell(format_args!("{}: no pictures fall to this part", name.pattern().display()));
        }
        self.numbers.is_empty()
    }
}

/// Part of the pictures that this program draws.
fn part(options: &RenderOptions) -> Result<FarmPart, Error> {
    match options.film.part {
        None => Ok(FarmPart::WHOLE),
        Some(PartChoice::Named(part)) => Ok(part),
        Some(PartChoice::Environment) => Ok(FarmPart::of_environment(|name| std::env::var(name).ok())?),
    }
}

/// Place of a film's pictures.
fn film_out<'a>(options: &RenderOptions, out: &'a Output) -> FilmOut<'a> {
    match out {
        Output::Sequence(name, kind) => FilmOut::Numbered(name, *kind),
        Output::Picture(path) | Output::Light(path) | Output::Film(path) | Output::Folder(path) => {
            FilmOut::Film(path, options.film.film_codec(path), options.film.frames_per_second())
        }
    }
}

/// Projection, eyes and lens. `upright`: axis of the head's turns, axes of the picture's middle.
fn equipment(options: &RenderOptions, upright: DVec3) -> Equipment {
    let (rays, projection) = (&options.rays, &options.projection);
    let lens = rays.aperture.zip(rays.focus).map(|(aperture_m, focus_m)| CameraLens { aperture_m, focus_m });
    let (separation_m, wall_m) = (projection.eye_separation_m(), projection.wall_m());
    Equipment {
        projection: projection.projection,
        stereo: projection.stereo.map(|layout| (StereoEyes { separation_m, wall_m, upright }, layout)),
        optics: Optics { lens },
        bounces: rays.bounces.unwrap_or(0),
        hdr: options.film.hdr,
    }
}

/// World's up in the axes of a gaze.
fn upright(gaze: &Gaze) -> DVec3 {
    gaze.observer_from_eye.inverse() * DVec3::Y
}

/// Turn of the picture against the rider's own gaze.
fn rider_look(viewpoint: &Viewpoint) -> DQuat {
    let ahead = Start { look: DVec3::NEG_Z, up: DVec3::Y, ..Start::default() };
    let look = viewpoint.look.unwrap_or(ahead.look);
    Camera::looking(look, viewpoint.up(&ahead), 1.0).observer_from_eye
}

/// View of an observer in uniform motion, `proper_time` metres of light travel after the start.
fn inertial(viewpoint: &Viewpoint, start: Start, proper_time: f64) -> Gaze {
    let position = viewpoint.position.unwrap_or(start.eye());
    let celerity = viewpoint.celerity();
    let event = Event { ct: celerity.gamma() * proper_time, position: position + celerity.vector() * proper_time };
    let look = viewpoint.look.unwrap_or(start.look);
    let observer_from_eye = Camera::looking(look, viewpoint.up(&start), 1.0).observer_from_eye;
    Gaze { observer: Observer { event, celerity }, observer_from_eye }
}
