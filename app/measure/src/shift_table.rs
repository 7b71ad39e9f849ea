//! Size of the shift table: the error and time of looking up shifted light, against integrating its spectrum.

use std::time::Instant;

use glam::DVec3;
use physics::colour::difference::{delta_e_2000, lab_from_xyz};
use physics::colour::{ShiftTable, xyz_from_rgb};
use rayon::prelude::*;

use super::quantiles::Sorted;
use super::table::{Line, Markdown};
use super::views::Views;
use scene::carriers::SceneCarriers;

const NODES: [usize; 6] = [255, 511, 1023, 2047, 4095, ShiftTable::NODES];
/// Number of Doppler factors looked up, from 1/20 to 20.
const DOPPLERS: u32 = 400;
const FARTHEST: f64 = 20.0;
/// Weights looked up: all together, and each alone.
const WEIGHTS: [DVec3; 4] = [DVec3::ONE, DVec3::X, DVec3::Y, DVec3::Z];

/// Measures the tables on all carriers of the scene's light: ΔE2000 of a colour as bright as white.
pub fn measure(Views { scene, .. }: &Views) -> (String, Vec<Line>) {
    let carriers = SceneCarriers::of(scene).carriers;
    // Spread evenly over ln D, in steps that are no multiple of any table's node distance.
    let doppler = |number: u32| FARTHEST.powf(2.0 * (f64::from(number) + 0.381_966) / f64::from(DOPPLERS) - 1.0);
    let places = (0..carriers.len()).flat_map(|carrier| (0..DOPPLERS).map(move |number| (carrier, doppler(number))));
    let places: Vec<(usize, f64)> = places.collect();
    let exact: Vec<_> =
        places.par_iter().map(|(carrier, doppler)| carriers[*carrier].rgb_from_weights(*doppler)).collect();
    let mut table = Markdown::new(&["shift table", "", "ms to make", "kB", "ΔE2000", "99 %", "most"]);
    let mut lines = Vec::new();
    for nodes in NODES {
        let began = Instant::now();
        let shift_table = ShiftTable::new(&carriers, nodes);
        let ms = began.elapsed().as_secs_f64() * 1e3;
        let errors = places.iter().zip(&exact).flat_map(|(&(carrier, doppler), exact)| {
            let looked_up = shift_table.rgb_from_weights(carrier, doppler);
            WEIGHTS.map(|weights| difference(looked_up * weights, *exact * weights))
        });
        let [median, of_99, most] = Sorted::of(errors).summary();
        let bytes = size_of_val(shift_table.texels()) as f64;
        let an_octave = shift_table.nodes() as f64 * std::f64::consts::LN_2 / (2.0 * ShiftTable::LN_LIMIT);
        let setting = format!("{} nodes ({an_octave:.0} an octave)", shift_table.nodes());
        let mut cells = vec![setting.clone(), String::new(), format!("{ms:.1}"), format!("{:.0}", bytes / 1e3)];
        cells.extend([median, of_99, most].map(|delta_e| format!("{delta_e:.1e}")));
        table.add(cells);
        let errors = [("delta_e_median", median), ("delta_e_99", of_99), ("delta_e_most", most)];
        let numbers = [("ms_median", ms), ("bytes", bytes)].into_iter().chain(errors).collect();
        lines.push(Line { dial: "shift-table", setting, numbers });
    }
    (table.text(), lines)
}

/// Difference ΔE2000 with the brightness of the true colour as white, which gives the largest value.
fn difference(looked_up: DVec3, exact: DVec3) -> f64 {
    let [looked_up, exact] = [looked_up, exact].map(|rgb| xyz_from_rgb() * rgb);
    // A spectrum that ends may leave no light, and then there is no error.
    if exact.y <= 0.0 || !exact.is_finite() {
        return 0.0;
    }
    let white = xyz_from_rgb() * DVec3::splat(exact.y);
    delta_e_2000(lab_from_xyz(looked_up, white), lab_from_xyz(exact, white))
}

#[cfg(test)]
mod tests {
    //! Error of interpolation, which scales with the square of the distance between nodes. In a wrong program, a node
    //! at a wrong place leaves an error that does not shrink.

    use super::*;
    use built_in::spectra;
    use ride::LightSpeed;

    #[test]
    fn twice_as_many_nodes_are_four_times_as_close() {
        let views = Views { scene: spectra::build(), light_speed: LightSpeed::OLD_TOWN, shots: Vec::new() };
        let (_, lines) = measure(&views);
        let most = |line: &Line| line.numbers.iter().find(|(name, _)| *name == "delta_e_99").unwrap().1;
        let errors: Vec<f64> = lines.iter().map(most).collect();
        // Start at 511 nodes: with fewer, the distance between nodes is larger than the features of the spectra.
        for pair in errors[1..].windows(2) {
            assert!((2.5..6.0).contains(&(pair[0] / pair[1])), "{errors:?}");
        }
    }
}
