//! The renderers at several settings of their dials: how long a picture takes, and how far from its place anything in it is drawn.
//!
//! Poses lie along the scene's circuit, or in a straight line from its start, at speeds from rest up. At each pose every setting draws the same
//! picture, one after the other, several times over: what the machine does besides falls on all alike. A picture is drawn from nothing, as a
//! still is: in a window, cuts and photo-surfaces are made beside the drawing.

use std::fs::File;
use std::io::Write;
use std::path::Path;
use std::sync::atomic::Ordering;
use std::time::Instant;

use glam::{DVec2, DVec3};
use physics::photo_surface::Eye;
use physics::{Beta, Celerity};

use super::direction::DirectionErrors;
use super::plot::plot;
use crate::command::{MeasureOptions, Renderer};
use crate::error::Error;
use crate::gpu::Gpu;
use crate::progress;
use crate::render::{interrupted, writable};
use crate::renderers::choice::{Bending, Choice};
use crate::renderers::image::MapQuality;
use crate::renderers::picture::{Shown, Studio};
use crate::renderers::polygon::{Pace, Tolerance};
use crate::renderers::target::Radiance;
use crate::renderers::{Effects, SceneRenderer, Shot};
use crate::scene::{Scene, source};
use crate::vehicle::World;
use crate::views::Camera;

/// Metres from the ground to the eye.
const EYE_HEIGHT_M: f64 = 1.6;
/// Vertical field of view, degrees.
const FOV_DEGREES: f64 = 60.0;
/// v/c at one pose after another.
const SPEEDS: [f64; 5] = [0.5, 0.8, 0.9, 0.95, 0.99];

/// One position of the dials.
#[derive(Clone, Copy, Debug, PartialEq)]
enum Setting {
    /// `--renderer polygon --edge METRES`.
    Edge(f64),
    /// `--renderer polygon --tolerance PIXELS`.
    Tolerance(f64),
    /// `--renderer image --map-scale N`.
    Map(f64),
}

const SETTINGS: [Setting; 11] = [
    Setting::Edge(2.0),
    Setting::Edge(1.0),
    Setting::Edge(0.5),
    Setting::Tolerance(4.0),
    Setting::Tolerance(2.0),
    Setting::Tolerance(1.0),
    Setting::Tolerance(0.5),
    Setting::Tolerance(0.25),
    Setting::Map(0.9),
    Setting::Map(2.0),
    Setting::Map(8.0),
];

impl Setting {
    /// As the command line has it.
    fn flags(self) -> String {
        match self {
            Self::Edge(metres) => format!("--renderer polygon --edge {metres}"),
            Self::Tolerance(pixels) => format!("--renderer polygon --tolerance {pixels}"),
            Self::Map(texels) => format!("--renderer image --map-scale {texels}"),
        }
    }

    fn choose(self, scene: Scene) -> Result<Choice, Error> {
        let tolerance = |pixels| Tolerance { pixels, pace: Pace::Still };
        let (renderer, bending, texels_per_pixel) = match self {
            Self::Edge(metres) => (Renderer::Polygon, Bending::Fixed { edge_m: metres, vertex_stage: false }, 1.0),
            Self::Tolerance(pixels) => (Renderer::Polygon, Bending::Adaptive(tolerance(pixels)), 1.0),
            Self::Map(texels) => (Renderer::Image, Bending::Adaptive(tolerance(1.0)), texels),
        };
        Ok(Choice::of(scene, renderer, bending, MapQuality { texels_per_pixel, smooth: false })?)
    }
}

/// What was measured of a setting.
#[derive(Clone, Debug, PartialEq)]
pub struct Row {
    /// Options that choose it.
    pub flags: String,
    /// Milliseconds a picture takes from nothing: bending, cutting or mapping, and drawing. Median and 95th percentile.
    pub ms: [f64; 2],
    /// Minutes of arc: median, 99th percentile and largest.
    pub arcmin: [f64; 3],
    /// Share of pixels that are off by more than one minute of arc.
    pub above_one: f64,
    /// No other setting is both faster and closer (by the 99th percentile).
    pub best: bool,
}

/// Measures and writes the results.
///
/// # Errors
/// What keeps the scene from being drawn or the table from being written.
pub fn run(options: &MeasureOptions) -> Result<(), Error> {
    let stop = interrupted();
    for path in options.out.iter().chain(&options.plot) {
        writable(path)?;
    }
    let gpu = Gpu::new()?;
    let scene = source::load(&options.scene, World::OLD_TOWN.speed_of_light_m_s())?;
    let shots = shots(&scene, options.poses)?;
    let radiance = Radiance::new(&gpu, options.size, Studio::format(&gpu));
    let mut studio = Studio::new(&gpu, options.size, 1);
    let pixel_arcmin = FOV_DEGREES * 60.0 / f64::from(options.size[1]);
    eprintln!(
        "{}: {} poses of {} × {} pixels ({pixel_arcmin:.1} arcmin each), on {}",
        scene.name,
        shots.len(),
        options.size[0],
        options.size[1],
        gpu.description()
    );

    // Make everything ready before anything is timed.
    let mut renderers = Vec::new();
    for setting in SETTINGS {
        match setting.choose(scene.clone()) {
            Ok(choice) => {
                let renderer = SceneRenderer::new(&gpu, &choice.scene, Studio::format(&gpu), None, choice.method)?;
                renderers.push((setting, renderer, Vec::new(), Vec::new()));
            }
            Err(error) => eprintln!("{} is left out: {error}", setting.flags()),
        }
    }
    let bar = progress::bar("measuring", (shots.len() * renderers.len()) as u64);
    for shot in &shots {
        // The first picture compiles pipelines and warms caches; it is the one whose places are asked for.
        for (_, renderer, _, errors) in &mut renderers {
            if stop.load(Ordering::Relaxed) {
                break;
            }
            submit(&gpu, renderer, shot)?;
            let places = studio.places(&gpu, renderer, shot)?;
            errors.push(of_picture(shot, options.size, &places));
            time(&gpu, renderer, &radiance, shot)?;
            bar.inc(1);
        }
        for _ in 0..options.rounds {
            for (_, renderer, times, _) in &mut renderers {
                if !stop.load(Ordering::Relaxed) {
                    times.push(time(&gpu, renderer, &radiance, shot)?);
                }
            }
        }
    }
    bar.finish_and_clear();
    if stop.load(Ordering::Relaxed) {
        eprintln!("interrupted: the table holds what was measured until then");
    }
    let rows = renderers.into_iter().filter(|(_, _, times, _)| !times.is_empty());
    let mut rows: Vec<Row> = rows.map(|(setting, _, times, errors)| row(setting, times, errors)).collect();
    mark_best(&mut rows);
    print!("{}", table(&rows));
    if let Some(out) = &options.out {
        write_csv(&rows, out)?;
        eprintln!("wrote {}", out.display());
    }
    if let Some(path) = options.plot.as_ref().filter(|_| !rows.is_empty()) {
        let [width, height] = options.size;
        let title = format!("{}, {width} × {height}, {}", scene.name, gpu.description());
        plot(&rows, &title, pixel_arcmin, path)?;
        eprintln!("wrote {}", path.display());
    }
    Ok(())
}

/// Where pictures are taken, and at what speed: along the circuit, looking ahead and, every other time, to the side.
fn shots(scene: &Scene, poses: u32) -> Result<Vec<Shot>, Error> {
    let pose = |number: u32| {
        let (place, ahead) = match scene.circuit.len() {
            0 => (scene.start.position, scene.start.look),
            corners => {
                let at = number as usize * corners / poses as usize;
                let (here, next) = (scene.circuit[at], scene.circuit[(at + 1) % corners]);
                (here, (next - here).normalize_or(scene.start.look))
            }
        };
        let speed = SPEEDS[number as usize % SPEEDS.len()];
        let celerity = Beta::new(ahead.normalize() * speed).map_or(Celerity::ZERO, Beta::celerity);
        let look = if number.is_multiple_of(2) { ahead } else { ahead + 0.7 * ahead.cross(DVec3::Y) };
        let eye = Eye::new(place + DVec3::Y * EYE_HEIGHT_M, celerity.vector())?;
        let camera = Camera::looking(look, DVec3::Y, FOV_DEGREES.to_radians());
        Ok(Shot { camera, eye, ct: 0.0, effects: Effects::ALL, stored_scale: None })
    };
    (0..poses).map(pose).collect()
}

fn submit(gpu: &Gpu, renderer: &mut SceneRenderer, shot: &Shot) -> Result<(), Error> {
    if renderer.transforms(shot.effects) {
        renderer.submit(gpu, shot.eye, shot.ct)?;
    }
    Ok(())
}

/// Milliseconds from nothing to a drawn picture.
fn time(gpu: &Gpu, renderer: &mut SceneRenderer, radiance: &Radiance, shot: &Shot) -> Result<f64, Error> {
    let started = Instant::now();
    submit(gpu, renderer, shot)?;
    if renderer.transforms(shot.effects) {
        let transformed = renderer.receive()?;
        renderer.show(gpu, transformed);
    }
    renderer.prepare(gpu, shot, radiance.size);
    let mut encoder = gpu.device.create_command_encoder(&Default::default());
    renderer.draw(gpu, &mut encoder, radiance, shot, DVec2::ZERO);
    gpu.queue.submit([encoder.finish()]);
    gpu.wait()?;
    Ok(started.elapsed().as_secs_f64() * 1e3)
}

/// Errors of all pixels that show a surface.
fn of_picture(shot: &Shot, size: [u32; 2], places: &[Option<Shown>]) -> DirectionErrors {
    let shown = places.iter().enumerate().filter_map(|(number, place)| {
        let (column, row) = (number % size[0] as usize, number / size[0] as usize);
        let middle = DVec2::new(column as f64 + 0.5, row as f64 + 0.5);
        let direction = shot.camera.observer_from_eye * shot.camera.ahead(size, middle).normalize();
        Some((direction, place.as_ref()?.apparent))
    });
    DirectionErrors::between(shown)
}

fn row(setting: Setting, mut times: Vec<f64>, errors: Vec<DirectionErrors>) -> Row {
    times.sort_by(f64::total_cmp);
    let at = |share: f64| times[((times.len() - 1) as f64 * share).round() as usize];
    let errors = DirectionErrors::together(errors);
    Row {
        flags: setting.flags(),
        ms: [at(0.5), at(0.95)],
        arcmin: [0.5, 0.99, 1.0].map(|share| errors.quantile(share)),
        above_one: errors.share_above(1.0),
        best: false,
    }
}

/// Marks the rows of the Pareto front: no other is at once as fast and as close, and better in one of the two.
fn mark_best(rows: &mut [Row]) {
    let points: Vec<[f64; 2]> = rows.iter().map(|row| [row.ms[0], row.arcmin[1]]).collect();
    for (row, &[ms, arcmin]) in rows.iter_mut().zip(&points) {
        let beats = |other: &[f64; 2]| other[0] <= ms && other[1] <= arcmin && (other[0] < ms || other[1] < arcmin);
        row.best = !points.iter().any(beats);
    }
}

/// As Markdown, which a terminal shows as well.
fn table(rows: &[Row]) -> String {
    let mut lines = vec![
        "|   | setting | ms a picture | 95 % | off by, arcmin: median | 99 % | most | share above 1′ |".to_owned(),
        "|---|---|--:|--:|--:|--:|--:|--:|".to_owned(),
    ];
    for Row { flags, ms: [median, slow], arcmin: [usual, of_99, most], above_one, best } in rows {
        let mark = if *best { "*" } else { " " };
        let share = 100.0 * above_one;
        lines.push(format!(
            "| {mark} | {flags:<36} | {median:7.1} | {slow:7.1} | {usual:8.3} | {of_99:8.3} | {most:8.2} | {share:5.1} % |"
        ));
    }
    lines.push("* no other is both faster and closer by the 99th percentile".to_owned());
    lines.join("\n") + "\n"
}

fn write_csv(rows: &[Row], path: &Path) -> Result<(), Error> {
    let fault = |error: std::io::Error| Error::Write { path: path.to_owned(), reason: error.to_string() };
    let mut file = File::create(path).map_err(fault)?;
    let heading = "flags,ms_median,ms_95,arcmin_median,arcmin_99,arcmin_most,share_above_1_arcmin,pareto";
    writeln!(file, "{heading}").map_err(fault)?;
    for Row { flags, ms, arcmin, above_one, best } in rows {
        let [median, of_99, most] = arcmin;
        let line = format!("{flags},{},{},{median},{of_99},{most},{above_one},{best}", ms[0], ms[1]);
        writeln!(file, "{line}").map_err(fault)?;
    }
    Ok(())
}

#[cfg(test)]
mod tests {
    //! The front holds exactly what nothing beats.

    use super::*;

    fn row(ms: f64, arcmin: f64) -> Row {
        Row { flags: String::new(), ms: [ms; 2], arcmin: [arcmin; 3], above_one: 0.0, best: false }
    }

    #[test]
    fn the_front_is_what_nothing_beats() {
        let mut rows = [row(1.0, 9.0), row(2.0, 9.0), row(3.0, 4.0), row(4.0, 5.0), row(5.0, 1.0), row(5.0, 1.0)];
        mark_best(&mut rows);
        assert_eq!(rows.map(|row| row.best), [true, false, true, false, true, true]);
    }
}
