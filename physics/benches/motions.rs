//! Cost of moving parts of a scene: the same vertices in one group, and in many groups with an eye each.
//!
//! The alternatives take turns; the ratio of the medians tells if moving objects cost more than resting ones.
#![allow(clippy::print_stdout, clippy::print_stderr, reason = "a benchmark prints its figures")]
#![allow(clippy::unwrap_used, reason = "a failed construction is a failed benchmark")]

use std::hint::black_box;
use std::time::Instant;

use glam::{DVec3, Vec3};
use physics::photo_surface::{Kernel, PhotoSurfaceEye, PhotoSurfaceMesh, Vertices};

const VERTICES: usize = 1 << 20;
const GROUPS: [usize; 5] = [1, 4, 16, 64, 256];
const ROUNDS: usize = 41;

/// A block of vertices, cut into groups of neighbours.
fn groups(count: usize) -> Vec<Vertices> {
    let place = |index: usize| {
        let along = index as f32 / VERTICES as f32;
        Vec3::new(
            100.0 * along - 50.0,
            10.0 * (0.618 * index as f32).fract(),
            30.0 - 20.0 * (0.37 * index as f32).fract(),
        )
    };
    let each = VERTICES / count;
    (0..count)
        .map(|group| Vertices::from_offsets(DVec3::ZERO, (group * each..(group + 1) * each).map(place)).unwrap())
        .collect()
}

/// The observer in each group's own frame.
fn eyes(count: usize) -> Vec<PhotoSurfaceEye> {
    (0..count)
        .map(|group| PhotoSurfaceEye::new(DVec3::Y, DVec3::new(0.75, 0.0, 0.001 * group as f64)).unwrap())
        .collect()
}

fn main() {
    // Take a single round if cargo only tests that the benchmark runs.
    let rounds = if std::env::args().any(|argument| argument == "--bench") { ROUNDS } else { 1 };
    let scenes: Vec<_> = GROUPS.iter().map(|&count| (groups(count), eyes(count))).collect();
    let mut output = [0, 1, 2].map(|_| vec![0.0_f32; VERTICES]);
    let mut times = vec![Vec::new(); scenes.len()];
    for _ in 0..rounds {
        for ((vertices, eyes), times) in scenes.iter().zip(&mut times) {
            let [mut x, mut y, mut z] = output.each_mut().map(Vec::as_mut_slice);
            let seen = vertices.iter().zip(eyes).map(|(vertices, eye)| {
                let streams = [&mut x, &mut y, &mut z].map(|stream| stream.split_off_mut(..vertices.len()).unwrap());
                (*eye, PhotoSurfaceMesh::new(vertices, streams).unwrap())
            });
            let seen = seen.collect();
            let started = Instant::now();
            black_box(Kernel::default().transform_each(seen));
            times.push(started.elapsed().as_secs_f64());
        }
    }
    println!("{VERTICES} vertices on {} threads, medians of {rounds} rounds", rayon::current_num_threads());
    println!("{:>8} {:>10} {:>8}", "motions", "ns/vertex", "ratio");
    let medians: Vec<f64> = times
        .iter_mut()
        .map(|times| {
            times.sort_by(f64::total_cmp);
            times[times.len() / 2]
        })
        .collect();
    for (count, median) in GROUPS.iter().zip(&medians) {
        println!("{count:>8} {:>10.3} {:>8.2}", 1e9 * median / VERTICES as f64, median / medians[0]);
    }
}
