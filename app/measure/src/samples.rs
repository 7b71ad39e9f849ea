//! The dial `--samples`: the error of few samples of each pixel, against rays through very many places of it.

use std::sync::atomic::{AtomicBool, Ordering};

use super::clock;
use super::pictures::Measurement;
use super::quantiles::Sorted;
use super::reference::Reference;
use super::table::{Line, Markdown};
use crate::error::MeasureError;
use render::choice::Choice;
use render::target::Radiance;
use render::{GpuError, SceneRenderer};
use studio::Studio;
use trace::RayTracer;
use view::{Dial, Occasion};

const COUNTS: [u32; 3] = [1, 4, 16];
/// Samples of each pixel of the reference.
const MANY: u32 = 32;
/// Fine cut of triangles, so that the remaining error is that of the samples.
const FINE: Dial = Dial::tolerance(0.25);

/// Measures the dial at the pose in the middle of the path. Once `stop` is set, the results until then are returned.
///
/// # Errors
/// A lost device.
pub fn measure(
    measurement: &Measurement<'_>,
    tracer: &RayTracer,
    stop: &AtomicBool,
) -> Result<(String, Vec<Line>), MeasureError> {
    let Measurement { gpu, scene, shots, size, rounds, .. } = *measurement;
    let shot = &shots[shots.len() / 2];
    let reference = Reference::trace(tracer, shot, size, MANY, stop);
    let choice = Choice::of(scene.clone(), FINE, Occasion::Still)?;
    let mut renderer = SceneRenderer::new(gpu, choice.scene, Studio::format(gpu), None, choice.dial, Occasion::Still)?;
    let radiance = Radiance::new(gpu, size, Studio::format(gpu));
    let mut table = Markdown::new(&["samples a pixel", "", "ms", "ΔE2000", "99 %", "most", "FLIP"]);
    let mut lines = Vec::new();
    for count in COUNTS {
        // An interrupted reference is of no use.
        if stop.load(Ordering::Relaxed) {
            break;
        }
        let pending = renderer.submit(gpu, &shot.observer, shot.effects)?;
        let light = Studio::new(gpu, size, count).expose(gpu, &mut renderer, shot, pending)?;
        let compared = reference.compare(&light);
        let times = (0..rounds).map(|_| Ok(clock::still(gpu, &mut renderer, &radiance, shot, count)?.total()));
        let [ms, slow] = Sorted::of(times.collect::<Result<Vec<f64>, GpuError>>()?).usual_and_slow();
        let (delta_e, flip) = (compared.delta_e.summary(), compared.flip);
        let setting = format!("{FINE} --samples {count}");
        let mut cells = vec![setting.clone(), String::new(), format!("{ms:.1}")];
        cells.extend(delta_e.map(|delta_e| format!("{delta_e:.2}")));
        cells.push(format!("{flip:.4}"));
        table.add(cells);
        let [median, of_99, most] = delta_e;
        let numbers = vec![
            ("ms_median", ms),
            ("ms_95", slow),
            ("delta_e_median", median),
            ("delta_e_99", of_99),
            ("delta_e_most", most),
            ("flip", flip),
        ];
        lines.push(Line { dial: "samples", setting, numbers });
    }
    Ok((table.text(), lines))
}
