//! Cost and gain of the shift table: integrating one colour against looking it up, and building the table of a
//! carrier, for white, thermal light, and a measured paint in thermal light.

use std::hint::black_box;
use std::slice;

use criterion::{Criterion, criterion_group, criterion_main};
use physics::colour::{Carrier, ShiftTable, Spectrum};

fn carriers() -> [(&'static str, Carrier); 3] {
    let planck = Spectrum::Planck { kelvin: 5900.0 };
    // Number of samples that a spectrometer gives.
    let samples: Vec<_> = (300..2500).map(|nm| [f64::from(nm), 0.5 + 0.4 * (f64::from(nm) / 80.0).sin()]).collect();
    let paint = Spectrum::sampled(samples).expect("ascending wavelengths, positive values");
    [
        ("white", Carrier::white()),
        ("planck", Carrier::emitted(planck.clone())),
        ("sampled", Carrier::reflected(Some(paint), Some(planck))),
    ]
}

fn one_colour(criterion: &mut Criterion) {
    const DOPPLER: f64 = 1.3;
    let mut group = criterion.benchmark_group("colour/one");
    for (name, carrier) in carriers() {
        group.bench_function(format!("integrated/{name}"), |bencher| {
            bencher.iter(|| carrier.rgb_from_weights(black_box(DOPPLER)));
        });
        let table = ShiftTable::new(slice::from_ref(&carrier), ShiftTable::NODES);
        group.bench_function(format!("looked-up/{name}"), |bencher| {
            bencher.iter(|| table.rgb_from_weights(0, black_box(DOPPLER)));
        });
    }
    group.finish();
}

fn table(criterion: &mut Criterion) {
    let mut group = criterion.benchmark_group("colour/table");
    group.sample_size(10);
    for (name, carrier) in carriers() {
        group.bench_function(name, |bencher| {
            bencher.iter(|| ShiftTable::new(black_box(slice::from_ref(&carrier)), ShiftTable::NODES));
        });
    }
    group.finish();
}

criterion_group!(benches, one_colour, table);
criterion_main!(benches);
