//! `rapidity measure` without the extremes: pictures by each renderer's dials, the other dials, and the output of the
//! results.

use std::sync::atomic::Ordering;

use super::dials::{OF_RIDES, OF_STILLS};
use super::pictures::{Kind, Measurement, Row, measure};
use super::plot::plot;
use super::table::{self, Line};
use super::views::{FOV_DEGREES, views};
use super::{choice, precision, samples, shift_table, steps};
use crate::command::{Goal, MeasureOptions};
use crate::error::Error;
use crate::gpu::Gpu;
use crate::render::{interrupted, writable};
use crate::renderers::picture::largest_side;
use crate::renderers::raytrace::RayTracer;

/// Size of pictures that are compared, and of a ride's window, pixels.
const STILL_SIZE: [u32; 2] = [640, 360];
const RIDE_SIZE: [u32; 2] = [1280, 720];

/// Frame time of a ride without a goal for it, seconds: that of usual screens.
const FRAME_S: f64 = 1.0 / 60.0;
/// Longest frame time at which a ride is measured, seconds.
const LONGEST_FRAME_S: f64 = 1.0 / 15.0;

/// Measures and writes the results.
///
/// # Errors
/// Any fault that prevents drawing the scene or writing the results, and a goal that no setting reaches.
pub fn run(options: &MeasureOptions) -> Result<(), Error> {
    let stop = interrupted();
    for path in options.out.iter().chain(&options.plot) {
        writable(path)?;
    }
    let gpu = Gpu::new()?;
    let goal = options.goal();
    let size = options.size.unwrap_or(if goal.is_some() { RIDE_SIZE } else { STILL_SIZE });
    let limit = largest_side(&gpu);
    if size.iter().any(|side| *side > limit) {
        return Err(Error::TooLarge { size, limit });
    }
    let views = views(&options.scene, options.speed_of_light, options.replay.as_deref(), options.poses)?;
    let (scene, shots) = (&views.scene, &views.shots);
    let pixel_arcmin = (2.0 * (0.5 * FOV_DEGREES).to_radians().tan() / f64::from(size[1])).to_degrees() * 60.0;
    let kind = match goal {
        None => Kind::Stills,
        Some(goal) => {
            let frame_s = if let Goal::Budget { ms } = goal { 1e-3 * ms } else { FRAME_S };
            Kind::Rides { own_m: views.world.metres(frame_s.min(LONGEST_FRAME_S)) }
        }
    };
    eprintln!(
        "{}: {} poses of {} × {} pixels ({pixel_arcmin:.1} arcmin in the middle), {}, on {}",
        scene.name,
        shots.len(),
        size[0],
        size[1],
        if kind == Kind::Stills { "stills from nothing" } else { "frames of a ride" },
        gpu.description()
    );

    let tracer = if kind == Kind::Stills { Some(RayTracer::new(scene.clone(), None, false)?) } else { None };
    let measurement = Measurement { gpu: &gpu, scene, shots, size, kind, rounds: options.rounds };
    let settings: &[_] = if kind == Kind::Stills { &OF_STILLS } else { &OF_RIDES };
    let rows = measure(&measurement, settings, tracer.as_ref(), &stop)?;
    print!("{}", table::of_pictures(&rows));
    if !rows.is_empty() && rows.iter().all(|row| row.pixels == 0) {
        eprintln!(
            "no pixel showed a surface of this scene, so nothing is known of directions; choose another --scene or --replay"
        );
    }
    let mut lines: Vec<Line> = rows.iter().map(Line::from).collect();
    if let Some(tracer) = &tracer {
        let mut add = |(text, of_dial): (String, Vec<Line>)| {
            if !of_dial.is_empty() {
                print!("\n{text}");
                lines.extend(of_dial);
            }
        };
        // Test `stop` before each one, so that an interrupt ends the run soon.
        if !stop.load(Ordering::Relaxed) {
            add(samples::measure(&measurement, tracer, &stop)?);
        }
        for measure in [shift_table::measure, steps::measure, precision::measure] {
            if !stop.load(Ordering::Relaxed) {
                add(measure(&views)?);
            }
        }
    }
    if stop.load(Ordering::Relaxed) {
        eprintln!("interrupted: the tables hold what was measured until then");
    }
    write(
        options,
        &rows,
        &lines,
        &format!("{}, {} × {}, {}", scene.name, size[0], size[1], gpu.description()),
        pixel_arcmin,
    )?;
    match goal {
        Some(goal) if !stop.load(Ordering::Relaxed) => choice::choose(&rows, goal, pixel_arcmin, size),
        _ => Ok(()),
    }
}

/// Writes the files that the options name.
fn write(options: &MeasureOptions, rows: &[Row], lines: &[Line], title: &str, pixel_arcmin: f64) -> Result<(), Error> {
    if let Some(out) = &options.out {
        table::write_csv(lines, out)?;
        eprintln!("wrote {}", out.display());
    }
    if let Some(path) = options.plot.as_ref().filter(|_| !rows.is_empty()) {
        plot(rows, title, pixel_arcmin, path)?;
        eprintln!("wrote {}", path.display());
    }
    Ok(())
}
