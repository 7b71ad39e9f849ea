//! `rapidity render`: stills and films, without a window.
//!
//! A film without a recording shows what an inertial observer sees: the eye moves on a straight worldline, and the
//! frames are taken at equal steps of its proper time. A recorded ride is seen with the rider's eyes.

use crate::commands::cameraman::{Cameraman, dial_of_stills};
use crate::commands::render_room;
use crate::error::Error;
use crate::output::say::tell;
use crate::session::interrupt::interrupted;
use crate::session::reel::{self, Look, Moment, Ridden};
use crate::session::scenes::{self, World};
use command::{Output, RenderOptions, Viewpoint};
use physics::{Event, Observer};
use picture_files::files::writable;
use render::Gpu;
use scene::Start;
use std::path::Path;
use view::{Camera, Gaze, RendererName};

/// Length of a film without `--seconds`, seconds of proper time.
const FILM_SECONDS: f64 = 10.0;

/// Carries out `rapidity render`.
///
/// # Errors
/// Any fault that keeps the picture from being drawn or written.
pub fn render(options: &RenderOptions) -> Result<(), Error> {
    options.passed_over().iter().for_each(tell);
    // Only the ray tracer can be interrupted, and its interruption counts from the beginning.
    if options.dial.renderer == RendererName::Raytrace {
        interrupted();
    }
    let gpu = Gpu::new()?;
    if let (Some(display), Output::Folder(folder)) = (&options.room.display, &options.out) {
        return render_room::render(options, &gpu, display, folder);
    }
    writable(options.out.path())?;
    if let Some(recording) = &options.replay {
        return recorded_ride(options, &gpu, recording);
    }
    let World { scene, speed_of_light_m_s: speed_of_light } = scenes::load(&options.world)?;
    let start = scene.start;
    let camera = Cameraman::new(&gpu, scene, &options.picture, dial_of_stills(&options.dial, &options.picture))?;
    let mut camera = camera.with_rays(&options.rays, speed_of_light);
    let look = Look::of(&options.picture.presentation(&start), options.outside);
    let moment = |own_s: f64| {
        let gaze = inertial(&options.viewpoint, start, own_s * speed_of_light);
        Moment { gaze, own_s, look, told: None }
    };
    match &options.out {
        Output::Picture(path) => camera.still(&moment(0.0), path),
        Output::Light(path) => camera.light(&moment(0.0), path),
        Output::Folder(path) => Ok(writable(path)?),
        Output::Film(path) => {
            let rate = options.frames_per_second();
            let count = (options.seconds.unwrap_or(FILM_SECONDS) * rate).round().max(1.0);
            camera.film((0..count as u64).map(|frame| Ok(moment(frame as f64 / rate))), count as u64, rate, path)
        }
    }
}

/// Draws the picture or film as a recorded rider saw it.
fn recorded_ride(options: &RenderOptions, gpu: &Gpu, recording: &Path) -> Result<(), Error> {
    let rate = options.frames_per_second();
    let shown = |start: &Start| (options.picture.presentation(start), options.picture.is_given);
    let ridden = reel::reel(recording, &options.world, (rate, options.seconds), shown)?;
    let Ridden { scene, speed_of_light, reel } = ridden;
    let camera = Cameraman::new(gpu, scene, &options.picture, dial_of_stills(&options.dial, &options.picture))?;
    let mut camera = camera.with_rays(&options.rays, speed_of_light);
    let seen = |mut moment: Moment| {
        moment.look.outside = options.outside.or(moment.look.outside);
        moment
    };
    let last = || reel.last().map(seen).ok_or(Error::NothingRidden);
    match &options.out {
        Output::Picture(path) => camera.still(&last()?, path),
        Output::Light(path) => camera.light(&last()?, path),
        Output::Folder(path) => Ok(writable(path)?),
        Output::Film(path) => {
            let count = reel.len();
            camera.film(reel.pictures().map(|moment| Ok(seen(moment))), count, rate, path)
        }
    }
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
