//! `rapidity measure` without the extremes: pictures by each renderer's dials, the other dials, and the output of the
//! results.

use std::io::{self, Write};
use std::sync::atomic::Ordering;

use measure::choice::{self, Goal};
use measure::extremes;
use measure::pictures::{self, Kind, Measured, Measurement};
use measure::plot::plot;
use measure::table::{self, Line};
use measure::views::{self, FOV_DEGREES, Views};
use measure::{OF_RIDES, OF_STILLS, Row, precision, samples, shift_table, steps};
use presentation::Presentation;
use render::Gpu;
use ride::LightSpeed;
use scene::Start;
use studio::largest_side;
use trace::RayTracer;
use view::Gaze;

use crate::error::Error;
use crate::output::progress;
use crate::output::say::{say, tell};
use crate::session::interrupt::interrupted;
use crate::session::preferences::Preferences;
use crate::session::reel::{self, Ridden};
use crate::session::scenes::{self, World};
use command::MeasureOptions;
use picture_files::files::{WriteError, whole, writable};

/// Pictures per second at which poses are taken from a recording.
const LOOKED_THROUGH: f64 = 10.0;

/// Size of pictures that are compared, and of a ride's window, pixels.
const STILL_SIZE: [u32; 2] = [640, 360];
const RIDE_SIZE: [u32; 2] = [1280, 720];

/// Frame time of a ride without a goal for it, seconds: that of usual screens.
const FRAME_S: f64 = 1.0 / 60.0;
/// Longest frame time at which a ride is measured, seconds.
const LONGEST_FRAME_S: f64 = 1.0 / 15.0;

/// Carries out `rapidity measure`.
///
/// # Errors
/// Any fault that keeps it from being measured or written, and errors of the physics beyond what it promises.
pub fn measure(options: &MeasureOptions) -> Result<(), Error> {
    options.passed_over().iter().for_each(tell);
    if options.extremes { accuracy() } else { dials(options) }
}

/// Measures and writes the results.
///
/// # Errors
/// Any fault that prevents drawing the scene or writing the results, and a goal that no setting reaches.
fn dials(options: &MeasureOptions) -> Result<(), Error> {
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
    let views = looked_at(options)?;
    let (scene, shots) = (&views.scene, &views.shots);
    let pixel_arcmin = (2.0 * (0.5 * FOV_DEGREES).to_radians().tan() / f64::from(size[1])).to_degrees() * 60.0;
    let kind = match goal {
        None => Kind::Stills,
        Some(goal) => {
            let frame_s = if let Goal::Budget { ms } = goal { 1e-3 * ms } else { FRAME_S };
            Kind::Rides { own_m: views.light_speed.metres(frame_s.min(LONGEST_FRAME_S)) }
        }
    };
    tell(format_args!(
        "{}: {} poses of {} × {} pixels ({pixel_arcmin:.1} arcmin in the middle), {}, on {}",
        scene.name,
        shots.len(),
        size[0],
        size[1],
        if kind == Kind::Stills { "stills from nothing" } else { "frames of a ride" },
        gpu.description()
    ));

    let tracer = if kind == Kind::Stills { Some(RayTracer::new(scene.clone(), None, false)?) } else { None };
    let measurement = Measurement { gpu: &gpu, scene, shots, size, kind, rounds: options.rounds };
    let positions: &[_] = if kind == Kind::Stills { &OF_STILLS } else { &OF_RIDES };
    let bar = progress::bar("measuring", 0);
    let progress = |done: usize, total: usize| {
        bar.set_length(total as u64);
        bar.set_position(done as u64);
    };
    let Measured { rows, left_out } = pictures::measure(&measurement, positions, tracer.as_ref(), &stop, &progress)?;
    bar.finish_and_clear();
    left_out.iter().for_each(tell);
    say(table::of_pictures(&rows).trim_end())?;
    if !rows.is_empty() && rows.iter().all(|row| row.pixels == 0) {
        tell(
            "no pixel showed a surface of this scene, so nothing is known of directions; choose another --scene or --replay",
        );
    }
    let mut lines: Vec<Line> = rows.iter().map(Line::from).collect();
    if let Some(tracer) = &tracer {
        let mut add = |(text, of_dial): (String, Vec<Line>)| {
            if of_dial.is_empty() {
                return Ok(());
            }
            lines.extend(of_dial);
            say(format_args!("\n{}", text.trim_end()))
        };
        // Test `stop` before each one, so that an interrupt ends the run soon.
        if !stop.load(Ordering::Relaxed) {
            add(samples::measure(&measurement, tracer, &stop)?)?;
        }
        if !stop.load(Ordering::Relaxed) {
            add(shift_table::measure(&views))?;
        }
        if !stop.load(Ordering::Relaxed) {
            add(steps::measure(&views)?)?;
        }
        if !stop.load(Ordering::Relaxed) {
            add(precision::measure(&views)?)?;
        }
    }
    if stop.load(Ordering::Relaxed) {
        tell("interrupted: the tables hold what was measured until then");
    }
    write(
        options,
        &rows,
        &lines,
        &format!("{}, {} × {}, {}", scene.name, size[0], size[1], gpu.description()),
        pixel_arcmin,
    )?;
    match goal {
        Some(goal) if !stop.load(Ordering::Relaxed) => choose(&rows, goal, pixel_arcmin, size),
        _ => Ok(()),
    }
}

/// Writes the files that the options name.
fn write(options: &MeasureOptions, rows: &[Row], lines: &[Line], title: &str, pixel_arcmin: f64) -> Result<(), Error> {
    if let Some(out) = &options.out {
        whole(out, |temporary| table::write_csv(lines, temporary)).map_err(|error| WriteError::new(out, error))?;
        tell(format_args!("wrote {}", out.display()));
    }
    if let Some(path) = options.plot.as_ref().filter(|_| rows.is_empty()) {
        tell(format_args!("{} was not written: there is nothing to plot", path.display()));
    }
    if let Some(path) = options.plot.as_ref().filter(|_| !rows.is_empty()) {
        whole(path, |temporary| plot(rows, title, pixel_arcmin, temporary).map_err(io::Error::other))
            .map_err(|error| WriteError::new(path, error))?;
        tell(format_args!("wrote {}", path.display()));
    }
    Ok(())
}

/// Prints ACCURACY.md.
fn accuracy() -> Result<(), Error> {
    let spinner = progress::spinner("measuring a billion steps and more");
    let rows = extremes::rows(extremes::Extent::FULL);
    spinner.finish_and_clear();
    let rows = rows?;
    std::io::stdout().write_all(extremes::document(&rows).as_bytes())?;
    Ok(extremes::check(&rows)?)
}

/// Scene that is measured, and the pictures taken in it.
fn looked_at(options: &MeasureOptions) -> Result<Views, Error> {
    let Some(recording) = &options.replay else {
        let World { scene, speed_of_light_m_s } = scenes::load(&options.world)?;
        let light_speed = LightSpeed::new(speed_of_light_m_s)?;
        let shots = views::along_circuit(&scene, options.poses);
        return Ok(Views { scene, light_speed, shots });
    };
    let Ridden { scene, speed_of_light, reel } = {
        let plain = |_: &Start| (Presentation::default(), true);
        reel::reel(recording, &options.world, (LOOKED_THROUGH, None), plain)?
    };
    let light_speed = LightSpeed::new(speed_of_light)?;
    let gazes: Vec<Gaze> = reel.evenly(options.poses).map(|moment| moment.gaze).collect();
    if gazes.is_empty() {
        return Err(Error::NothingRidden);
    }
    Ok(Views { scene, light_speed, shots: views::of_ride(&gazes, options.poses) })
}

/// Chooses the dial that reaches the goal best, and writes it where rides read it.
fn choose(rows: &[Row], goal: Goal, pixel_arcmin: f64, size: [u32; 2]) -> Result<(), Error> {
    let row = choice::best(rows, goal, pixel_arcmin)?;
    let note = format!(
        "Chosen by `rapidity measure --{goal}` for pictures of {} x {}: {:.1} ms a frame ({:.1} in 95 of 100), {:.2} pixels off.",
        size[0],
        size[1],
        row.ms[0],
        row.ms[1],
        row.arcmin[1] / pixel_arcmin
    );
    let path = Preferences::save_dial(row.dial, &note)?;
    tell(format_args!(
        "{} is best for --{goal}: {:.1} ms a frame, {:.1} in 95 of 100, and {:.2} pixels off in 99 of 100",
        row.dial,
        row.ms[0],
        row.ms[1],
        row.arcmin[1] / pixel_arcmin
    ));
    tell(format_args!("wrote {}: `rapidity ride` draws so from now on; delete the file to undo that", path.display()));
    Ok(())
}

#[cfg(all(test, unix))]
mod tests {
    //! Law: a table or a plot takes the place of an older one when it is whole. A program that writes into the older
    //! file changes what a second name of it holds.
    #![allow(clippy::unwrap_used, reason = "a folder that cannot be read is a failed test")]

    use super::*;
    use command::{Command, parse_from};
    use view::Dial;

    #[test]
    fn tables_and_plots_are_whole_or_not_there() {
        let folder = tempfile::tempdir().unwrap();
        let place = |name: &str| folder.path().join(name);
        for name in ["t.csv", "p.svg", "q.png"] {
            std::fs::write(place(name), "old").unwrap();
            std::fs::hard_link(place(name), place(name).with_extension("old")).unwrap();
        }
        let row = Row {
            dial: Dial::edge(0.5),
            ms: [1.0, 2.0],
            stages_ms: [[0.5; 2]; 3],
            bytes: None,
            pixels: 10,
            arcmin: [1.0, 2.0, 3.0],
            above_one: 0.5,
            colour: None,
            best: true,
        };
        for plot in ["p.svg", "q.png"] {
            let words = ["rapidity", "measure", "--out"].map(Into::into).into_iter();
            let paths = [place("t.csv").into_os_string(), "--plot".into(), place(plot).into_os_string()];
            let Ok(Command::Measure(options)) = parse_from(words.chain(paths)) else { panic!() };
            write(&options, std::slice::from_ref(&row), &[Line::from(&row)], "a scene", 4.0).unwrap();
        }
        for name in ["t.csv", "p.svg", "q.png"] {
            assert!(std::fs::read(place(name)).unwrap().len() > 20, "{name}");
            assert_eq!(std::fs::read_to_string(place(name).with_extension("old")).unwrap(), "old", "{name}");
        }
        assert_eq!(std::fs::read_dir(folder.path()).unwrap().count(), 6, "something is left");
    }
}
