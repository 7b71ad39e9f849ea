//! Precision of the transform: f32 in the kernel that bends fixed meshes, f64 for the vertices of a cut. Both results
//! are written as f32.

use std::time::Instant;

use glam::{DVec3, Vec3};
use physics::Observer;
use physics::apparent;
use physics::photo_surface::{Kernel, PhotoSurfaceError, PhotoSurfaceMesh, Vertices};
use rayon::prelude::*;

use super::quantiles::Sorted;
use super::table::{Line, Markdown};
use super::views::Views;
use crate::error::MeasureError;
use scene::cut::SeenFrom;

/// Number of times that each is timed.
const ROUNDS: usize = 5;

/// Direction errors and times of one kind of transform.
#[derive(Default)]
struct Found {
    directions: Vec<f64>,
    ns: Vec<f64>,
}

/// Measures the precision on all vertices at rest, from all poses.
///
/// # Errors
/// A scene whose origin is not finite.
pub fn measure(Views { scene, shots, .. }: &Views) -> Result<(String, Vec<Line>), MeasureError> {
    let meshes = scene.meshes.iter().filter(|mesh| mesh.motion.is_none());
    let offsets: Vec<Vec3> = meshes.flat_map(|mesh| mesh.positions.iter().copied()).collect();
    let vertices = Vertices::from_offsets(scene.origin, offsets.iter().copied())?;
    let (mut short, mut long) = (Found::default(), Found::default());
    let mut streams = [(); 3].map(|()| vec![0.0_f32; offsets.len()]);
    let mut places = vec![Vec3::ZERO; offsets.len()];
    for shot in shots {
        let observer = shot.observer;
        let exact = |offset: &Vec3| apparent::at_rest(&observer, scene.origin + offset.as_dvec3()).position;
        let exact: Vec<DVec3> = offsets.par_iter().map(exact).collect();
        for _ in 0..ROUNDS {
            short.time(offsets.len(), || by_kernel(&observer, &vertices, &mut streams))?;
            long.time(offsets.len(), || {
                in_full(&SeenFrom::new(scene, &observer, None), &offsets, &mut places);
                Ok(())
            })?;
        }
        let [x, y, z] = &streams;
        let by_kernel = (0..offsets.len()).map(|index| Vec3::new(x[index], y[index], z[index]));
        short.directions.extend(by_kernel.zip(&exact).map(|(place, exact)| apart(place, *exact)));
        long.directions.extend(places.iter().zip(&exact).map(|(place, exact)| apart(*place, *exact)));
    }
    let mut table = Markdown::new(&["transform", "", "ns a vertex", "off by, µrad", "99 %", "most"]);
    let mut lines = Vec::new();
    for (setting, found) in [("f32 with f64 astern: --edge", short), ("f64: --tolerance", long)] {
        let [ns, _] = Sorted::of(found.ns).usual_and_slow();
        let errors = Sorted::of(found.directions).summary();
        let mut cells = vec![setting.to_owned(), String::new(), format!("{ns:.2}")];
        cells.extend(errors.map(|radians| format!("{:.4}", 1e6 * radians)));
        table.add(cells);
        let names = ["direction_rad_median", "direction_rad_99", "direction_rad_most"];
        let numbers = [("ns", ns)].into_iter().chain(names.into_iter().zip(errors)).collect();
        lines.push(Line { dial: "precision", setting: setting.to_owned(), numbers });
    }
    Ok((table.text(), lines))
}

impl Found {
    fn time(
        &mut self,
        count: usize,
        work: impl FnOnce() -> Result<(), PhotoSurfaceError>,
    ) -> Result<(), PhotoSurfaceError> {
        let began = Instant::now();
        work()?;
        self.ns.push(began.elapsed().as_secs_f64() * 1e9 / count.max(1) as f64);
        Ok(())
    }
}

fn by_kernel(observer: &Observer, vertices: &Vertices, [x, y, z]: &mut [Vec<f32>; 3]) -> Result<(), PhotoSurfaceError> {
    let surface = PhotoSurfaceMesh::new(vertices, [x, y, z])?;
    Kernel::default().transform(observer, vec![surface]);
    Ok(())
}

/// Bends vertices in f64, like `render` those of a cut.
fn in_full(sight: &SeenFrom, offsets: &[Vec3], places: &mut [Vec3]) {
    places.par_iter_mut().zip(offsets).for_each(|(place, offset)| {
        *place = (sight.observer_from_group * sight.bend.apparent(offset.as_dvec3() - sight.place)).as_vec3();
    });
}

/// Angle between two directions, by the chord, radians.
fn apart(place: Vec3, exact: DVec3) -> f64 {
    let [seen, exact] = [place.as_dvec3(), exact].map(DVec3::normalize_or_zero);
    2.0 * (0.5 * seen.distance(exact)).min(1.0).asin()
}

#[cfg(test)]
mod tests {
    //! Limits of the two transforms: 7e-7 rad for the kernel (`physics::photo_surface`); for f64 the rounding of the
    //! result to f32, half a unit in the last of 24 bits along each axis.

    use super::*;
    use crate::views::along_circuit;
    use physics::photo_surface::accuracy::DIRECTION_ERROR_RAD;
    use ride::LightSpeed;

    #[test]
    fn both_keep_what_they_promise() {
        let scene = built_in::lattice::Lattice::default().build();
        let shots = along_circuit(&scene, 2);
        let views = Views { scene, light_speed: LightSpeed::OLD_TOWN, shots };
        let (_, lines) = measure(&views).unwrap();
        let most = |line: &Line| line.numbers.iter().find(|(name, _)| *name == "direction_rad_most").unwrap().1;
        assert!(most(&lines[0]) < DIRECTION_ERROR_RAD, "{lines:?}");
        assert!(most(&lines[1]) < 6e-8 && most(&lines[1]) > 0.0, "{lines:?}");
    }
}
