//! Pictures at several settings of the renderers' dials: their times, their memory on the device, and their errors.
//!
//! At each pose every setting draws the same picture in turn, several times over, so that other load on the machine
//! affects all alike.
//!
//! - **Stills** are drawn from nothing: each picture waits for its cut or map. Their light is compared with rays
//!   traced through the same points of the same pixels.
//! - **Frames of a ride** are drawn one after another from an eye that moves on: photo-surfaces are one frame ahead,
//!   cuts are made beside the drawing and are a little late, maps are smooth. Their times are those of frames in this
//!   steady state, frames that take over a new cut among them. Their errors are those of the frame after, with the
//!   cut that it has.

use std::sync::atomic::{AtomicBool, Ordering};

use glam::DVec2;

use super::clock::{self, Stages};
use super::quantiles::Sorted;
use super::reference::{Compared, Reference};
use super::row::Row;
use super::{direction, views};
use crate::error::MeasureError;
use render::choice::Choice;
use render::target::{Format, Radiance};
use render::{Gpu, GpuError, Pending, SceneRenderer};
use scene::Scene;
use studio::{Shown, Studio};
use trace::RayTracer;
use view::{Dial, Occasion, Shot};

/// Samples of each pixel whose light is compared.
pub const SAMPLES: u32 = 4;

/// Time at a pose after which a setting is not timed there again, milliseconds: slow settings are known well enough
/// from one round.
const LONG_MS: f64 = 1500.0;

/// Number of frames of a ride that are drawn in one go.
const FRAMES: u32 = 4;

/// Samples of a window's pixel where hardware draws; software takes one.
const WINDOW_SAMPLES: u32 = 4;

/// Kind of pictures that are measured.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Kind {
    /// Stills, each of which waits for its cut or map.
    Stills,
    /// Frames of a ride, one after another.
    Rides {
        /// Proper time from frame to frame, metres of light travel.
        own_m: f64,
    },
}

impl Kind {
    /// Pace of the cuts for this kind.
    fn occasion(self) -> Occasion {
        match self {
            Self::Stills => Occasion::Still,
            Self::Rides { .. } => Occasion::Ride,
        }
    }
}

/// Subject and extent of a measurement.
pub struct Measurement<'a> {
    /// Device that draws.
    pub gpu: &'a Gpu,
    /// Scene that is drawn.
    pub scene: &'a Scene,
    /// Poses at which pictures are taken.
    pub shots: &'a [Shot],
    /// Width and height, pixels.
    pub size: [u32; 2],
    /// Stills, or frames of a ride.
    pub kind: Kind,
    /// Number of times that each picture is timed.
    pub rounds: u32,
}

/// Rows of all dials, and those that were left out.
#[derive(Clone, Debug, PartialEq)]
pub struct Measured {
    /// A row for each dial.
    pub rows: Vec<Row>,
    /// Dials that could not be measured, with the reason; a sentence each.
    pub left_out: Vec<String>,
}

/// A dial while it is measured.
struct Candidate {
    dial: Dial,
    renderer: SceneRenderer,
    /// Photo-surface of the frame after the one drawn last.
    pending: Pending,
    times: Vec<Stages>,
    directions: Vec<Sorted>,
    compared: Vec<Compared>,
    /// Memory held now, and the most so far, bytes.
    bytes: Option<(i64, i64)>,
    /// Number of frames drawn at this pose.
    frames: u32,
    /// Numbers of times, directions and comparisons from the poses before.
    before: [usize; 3],
}

/// Measures these settings. Once `stop` is set, the results until then are returned.
///
/// # Errors
/// An error of the device or of the tracer that prevents drawing.
pub fn measure(
    measurement: &Measurement<'_>,
    dials: &[Dial],
    tracer: Option<&RayTracer>,
    stop: &AtomicBool,
    progress: &dyn Fn(usize, usize),
) -> Result<Measured, MeasureError> {
    let Measurement { gpu, shots, size, kind, .. } = *measurement;
    let exact = Studio::format(gpu);
    let format = match kind {
        Kind::Stills => exact,
        Kind::Rides { .. } => Format::fast(if gpu.is_software() { 1 } else { WINDOW_SAMPLES }),
    };
    let radiance = Radiance::new(gpu, size, format);
    let mut studio = Studio::new(gpu, size, SAMPLES);
    // Prepare everything before anything is timed.
    let (mut candidates, mut left_out) = (Vec::new(), Vec::new());
    for &dial in dials {
        match ready(measurement, dial, format) {
            Ok(candidate) => candidates.push(candidate),
            Err(error @ (MeasureError::Gpu(_) | MeasureError::PhotoSurface(_))) => return Err(error),
            Err(error) => left_out.push(format!("{dial} is left out: {error}")),
        }
    }
    let (mut done, total) = (0, shots.len() * candidates.len());
    progress(done, total);
    for (poses, shot) in shots.iter().enumerate() {
        candidates.iter_mut().for_each(Candidate::begin_pose);
        let reference = tracer.map(|tracer| Reference::trace(tracer, shot, size, SAMPLES, stop));
        // The first pictures compile pipelines and warm caches. They are compared, not timed.
        for candidate in &mut candidates {
            if stop.load(Ordering::Relaxed) {
                break;
            }
            let before = clock::device_bytes(gpu)?;
            if kind == Kind::Stills {
                candidate.judge(gpu, &mut studio, shot, measurement)?;
                if let Some(reference) = &reference {
                    let pending = candidate.renderer.submit(gpu, &shot.observer, shot.effects)?;
                    let light = studio.expose(gpu, &mut candidate.renderer, shot, pending)?;
                    candidate.compared.push(reference.compare(&light));
                }
            } else {
                candidate.begin(gpu)?;
                candidate.picture(gpu, &radiance, shot, kind)?;
            }
            candidate.hold(before, clock::device_bytes(gpu)?);
        }
        for _ in 0..measurement.rounds {
            for candidate in candidates.iter_mut().filter(|candidate| candidate.is_quick()) {
                if stop.load(Ordering::Relaxed) {
                    break;
                }
                let pictures = if kind == Kind::Stills { 1 } else { FRAMES };
                for _ in 0..pictures {
                    let stages = candidate.picture(gpu, &radiance, shot, kind)?;
                    candidate.times.push(stages);
                }
                candidate.renderer.settle();
            }
        }
        for candidate in candidates.iter_mut().filter(|_| !stop.load(Ordering::Relaxed)) {
            if let Kind::Rides { own_m } = kind {
                let shot = views::further(shot, f64::from(candidate.frames) * own_m);
                candidate.judge_ride(gpu, &mut studio, &shot, measurement, format)?;
            }
            done += 1;
            progress(done, total);
        }
        if stop.load(Ordering::Relaxed) {
            // Settings are compared at the same poses, if there is a pose that all have completed.
            candidates.iter_mut().filter(|_| poses > 0).for_each(Candidate::forget_pose);
            break;
        }
    }
    let measured =
        candidates.into_iter().filter(|candidate| !candidate.times.is_empty() && !candidate.directions.is_empty());
    let mut rows: Vec<Row> = measured.map(Candidate::row).collect();
    mark_best(&mut rows);
    Ok(Measured { rows, left_out })
}

/// Uploads the scene in the form that a setting needs.
fn ready(measurement: &Measurement<'_>, dial: Dial, format: Format) -> Result<Candidate, MeasureError> {
    let gpu = measurement.gpu;
    let occasion = measurement.kind.occasion();
    let choice = Choice::of(measurement.scene.clone(), dial, occasion)?;
    let before = clock::device_bytes(gpu)?;
    let renderer = SceneRenderer::new(gpu, choice.scene, format, None, choice.dial, occasion)?;
    let after = clock::device_bytes(gpu)?;
    let bytes = before.zip(after).map(|(before, after)| (after - before, after - before));
    Ok(Candidate {
        dial,
        renderer,
        pending: Pending::default(),
        times: Vec::new(),
        directions: Vec::new(),
        compared: Vec::new(),
        bytes,
        frames: 0,
        before: [0; 3],
    })
}

impl Candidate {
    /// Begins a new pose.
    fn begin_pose(&mut self) {
        self.before = [self.times.len(), self.directions.len(), self.compared.len()];
    }

    /// Drops the results of this pose.
    fn forget_pose(&mut self) {
        let [times, directions, compared] = self.before;
        self.times.truncate(times);
        self.directions.truncate(directions);
        self.compared.truncate(compared);
    }

    /// True if the setting is quick enough to be timed at this pose once more.
    fn is_quick(&self) -> bool {
        self.times[self.before[0]..].iter().map(|stages| stages.total()).sum::<f64>() < LONG_MS
    }

    /// Draws and times one more picture of a pose; in a ride, of the pose that the ride has reached.
    fn picture(&mut self, gpu: &Gpu, radiance: &Radiance, shot: &Shot, kind: Kind) -> Result<Stages, GpuError> {
        match kind {
            Kind::Stills => clock::still(gpu, &mut self.renderer, radiance, shot, 1),
            Kind::Rides { own_m } => {
                let at = |frame: u32| views::further(shot, f64::from(frame) * own_m);
                let (shown, next) = (at(self.frames), at(self.frames + 1));
                self.frames += 1;
                clock::frame(gpu, &mut self.renderer, radiance, (&shown, &mut self.pending), &next)
            }
        }
    }

    /// Begins a ride at another place.
    fn begin(&mut self, gpu: &Gpu) -> Result<(), GpuError> {
        self.frames = 0;
        self.pending = Pending::default();
        // The last upload frees its memory once the device is done.
        gpu.wait()?;
        Ok(())
    }

    /// Measures the direction errors of a still.
    fn judge(
        &mut self,
        gpu: &Gpu,
        studio: &mut Studio,
        shot: &Shot,
        measurement: &Measurement<'_>,
    ) -> Result<(), GpuError> {
        let pending = match std::mem::take(&mut self.pending) {
            begun if begun.is_under_way() => begun,
            _ => self.renderer.submit(gpu, &shot.observer, shot.effects)?,
        };
        let places = studio.places(gpu, &mut self.renderer, shot, pending)?;
        self.directions.push(of_picture(shot, measurement.size, &places));
        Ok(())
    }

    /// Measures the direction errors of the frame after those that were timed. Windows have half floats, which cannot
    /// hold places. Interpolated texels have no place, so the nearest texel of a map is taken, which is no more
    /// accurate than the interpolation.
    fn judge_ride(
        &mut self,
        gpu: &Gpu,
        studio: &mut Studio,
        shot: &Shot,
        measurement: &Measurement<'_>,
        format: Format,
    ) -> Result<(), GpuError> {
        let texels = self.renderer.map_stats().map(|stats| stats.texels_per_pixel);
        let exact = Studio::format(gpu);
        self.renderer.draw_in(gpu, exact, Occasion::Still, texels);
        self.judge(gpu, studio, shot, measurement)?;
        self.renderer.draw_in(gpu, format, Occasion::Ride, texels.and(self.dial.map_scale));
        Ok(())
    }

    /// Updates the memory that the renderer holds.
    fn hold(&mut self, before: Option<i64>, after: Option<i64>) {
        let grown = before.zip(after).map_or(0, |(before, after)| after - before);
        self.bytes = self.bytes.map(|(now, most)| (now + grown, most.max(now + grown)));
    }

    fn row(self) -> Row {
        let of = |stage: fn(&Stages) -> f64| Sorted::of(self.times.iter().map(stage)).usual_and_slow();
        let directions = Sorted::together(self.directions);
        let pictures = self.compared.len() as f64;
        let flip = self.compared.iter().map(|compared| compared.flip).sum::<f64>() / pictures;
        let delta_e = Sorted::together(self.compared.into_iter().map(|compared| compared.delta_e));
        Row {
            dial: self.dial,
            ms: of(|stages| stages.total()),
            stages_ms: [of(|stages| stages.bend), of(|stages| stages.upload), of(|stages| stages.draw)],
            bytes: self.bytes.map(|(_, most)| most as f64),
            pixels: directions.count(),
            arcmin: directions.summary(),
            above_one: directions.share_above(1.0),
            colour: (pictures > 0.0).then(|| (delta_e.summary(), flip)),
            best: false,
        }
    }
}

/// Errors of all pixels that show a surface.
fn of_picture(shot: &Shot, size: [u32; 2], places: &[Option<Shown>]) -> Sorted {
    let shown = places.iter().enumerate().filter_map(|(number, place)| {
        let (column, row) = (number % size[0] as usize, number / size[0] as usize);
        let middle = DVec2::new(column as f64 + 0.5, row as f64 + 0.5);
        let direction = shot.camera.observer_from_eye * shot.camera.ahead(size, middle).normalize();
        Some((direction, place.as_ref()?.apparent))
    });
    direction::between(shown)
}

/// Marks the rows of the Pareto front: no other row is at least as fast and at least as accurate, and better in one
/// of the two.
fn mark_best(rows: &mut [Row]) {
    let points: Vec<[f64; 2]> = rows.iter().map(|row| [row.ms[0], row.arcmin[1]]).collect();
    for (row, &[ms, arcmin]) in rows.iter_mut().zip(&points) {
        let beats = |other: &[f64; 2]| other[0] <= ms && other[1] <= arcmin && (other[0] < ms || other[1] < arcmin);
        row.best = !points.iter().any(beats);
    }
}

#[cfg(test)]
mod tests {
    //! The front must hold exactly the rows that no other row beats.

    use super::*;

    fn row(ms: f64, arcmin: f64) -> Row {
        Row {
            dial: Dial::edge(1.0),
            ms: [ms; 2],
            stages_ms: [[0.0; 2]; 3],
            bytes: None,
            pixels: 1,
            arcmin: [arcmin; 3],
            above_one: 0.0,
            colour: None,
            best: false,
        }
    }

    #[test]
    fn the_front_is_what_nothing_beats() {
        let mut rows = [row(1.0, 9.0), row(2.0, 9.0), row(3.0, 4.0), row(4.0, 5.0), row(5.0, 1.0), row(5.0, 1.0)];
        mark_best(&mut rows);
        assert_eq!(rows.map(|row| row.best), [true, false, true, false, true, true]);
    }
}
