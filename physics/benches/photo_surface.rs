//! The speed of the photo-surface kernel, as a share of the fastest copy of the same bytes.
//!
//! The kernel reads 12 bytes a vertex and writes 12 (apparent positions) or 16 (and D). Nothing can do that
//! faster than memory moves, so the ceiling is the best of several copies, through the caches and past them,
//! on as many threads. Every round measures every alternative once, and the table gives medians of ratios
//! within a round: on a machine that others use, only neighbours in time can be compared. Criterion's own
//! figures follow.
//!
//! ```text
//! cargo bench -p physics --bench photo_surface
//! ```
#![allow(clippy::print_stdout, clippy::print_stderr, reason = "a benchmark prints its figures")]
#![expect(clippy::unwrap_used, reason = "a benchmark that cannot run stops")]

use std::hint::black_box;
use std::process::Command;
use std::time::{Duration, Instant};

use criterion::{BenchmarkId, Criterion, Throughput};
use glam::{DVec3, Vec3};
use physics::photo_surface::{CHUNK, Instructions, Kernel, PhotoSurfaceEye, PhotoSurfaceMesh, Stores, Vertices};
use rayon::ThreadPoolBuilder;
use rayon::iter::{IntoParallelIterator, ParallelIterator};

/// Numbers of vertices: a small scene, the old town, and a large one; in L2, beyond it, and far beyond it.
const SIZES: [usize; 3] = [21_000, 136_000, 1_000_000];
const THREADS: [usize; 2] = [1, 2];
const ROUNDS: usize = 101;
/// Least time that the repetitions within a round take together.
const SPAN: Duration = Duration::from_micros(500);
/// Bytes written between repetitions that shall find a cold second-level cache.
const FLUSH_BYTES: usize = 4 << 20;

/// Celerities at which every chunk takes the f32 form, and at which those astern take the exact one.
const CELERITIES: [f64; 2] = [0.75, 100.0];

/// A town in square tiles of a chunk each, 40 m wide, around the eye; rows of vertices, near each other as in a mesh.
fn town(count: usize) -> Vertices {
    let tiles = (count.div_ceil(CHUNK) as f32).sqrt().ceil();
    let row = (CHUNK as f32).sqrt();
    let offsets = (0..count).map(|index| {
        let (tile, within) = ((index / CHUNK) as f32, (index % CHUNK) as f32);
        let column = tile % tiles + (within / row).fract();
        let line = (tile / tiles).floor() + within / CHUNK as f32;
        Vec3::new(40.0 * (column - tiles / 2.0), 10.0 * (0.618 * within).fract(), 40.0 * (line - tiles / 2.0))
    });
    Vertices::from_offsets(DVec3::ZERO, offsets).unwrap()
}

/// A stream of values that begins at a cache line.
struct Stream(Vec<f32>, usize);

impl Stream {
    fn new(count: usize) -> Self {
        Self(vec![1.0; count + 16], count)
    }

    fn values(&mut self) -> &mut [f32] {
        let skip = self.0.as_ptr().align_offset(64);
        &mut self.0[skip..skip + self.1]
    }
}

/// Memory for one mesh: what is copied, and where results go.
struct Memory {
    input: [Stream; 3],
    output: [Stream; 4],
}

impl Memory {
    fn new(count: usize) -> Self {
        Self { input: [(); 3].map(|()| Stream::new(count)), output: [(); 4].map(|()| Stream::new(count)) }
    }
}

#[derive(Clone, Copy, Debug, PartialEq)]
enum Work {
    CopyCached,
    CopyStreamed,
    Kernel { instructions: Instructions, stores: Stores, celerity: f64 },
}

/// Runs one repetition of the work.
fn run(work: Work, vertices: &Vertices, memory: &mut Memory, doppler: bool, threads: usize) {
    let Memory { input, output } = memory;
    match work {
        Work::Kernel { instructions, stores, celerity } => {
            let eye = PhotoSurfaceEye::new(DVec3::new(0.3, 1.7, 0.1), DVec3::X * celerity).unwrap();
            let [x, y, z, d] = output.each_mut().map(Stream::values);
            let mut surface = PhotoSurfaceMesh::new(vertices, [x, y, z]).unwrap();
            if doppler {
                surface = surface.with_doppler(d).unwrap();
            }
            let kernel = Kernel::with_instructions(instructions).unwrap().with_stores(stores);
            black_box(kernel.transform(&eye, vec![surface]));
        }
        Work::CopyCached | Work::CopyStreamed => {
            let [x, y, z] = input.each_mut().map(|stream| &*stream.values());
            let [to_x, to_y, to_z, to_d] = output.each_mut().map(Stream::values);
            let d_source = if doppler { x } else { &[] };
            let streams = [(to_x, x), (to_y, y), (to_z, z), (to_d, d_source)];
            let mut chunks: Vec<_> = streams
                .into_iter()
                .flat_map(|(to, from)| to.chunks_mut(CHUNK).zip(from.chunks(CHUNK)).enumerate())
                .collect();
            // Copy all streams of a chunk together, as the kernel works.
            chunks.sort_by_key(|(index, _)| *index);
            let copy = |(_, (to, from)): (usize, (&mut [f32], &[f32]))| {
                if work == Work::CopyStreamed {
                    streamed_copy(to, from);
                } else {
                    to.copy_from_slice(from);
                }
            };
            if threads == 1 {
                chunks.into_iter().for_each(copy);
            } else {
                chunks.into_par_iter().for_each(copy);
            }
        }
    }
}

/// Copies values past the caches.
#[cfg(target_arch = "x86_64")]
fn streamed_copy(to: &mut [f32], from: &[f32]) {
    use std::arch::x86_64::*;

    #[target_feature(enable = "avx")]
    fn lines(to: &mut [f32], from: &[f32]) {
        assert!(to.as_ptr().cast::<__m256>().is_aligned());
        let (to_lines, to_end) = to.as_chunks_mut::<8>();
        let (from_lines, from_end) = from.as_chunks::<8>();
        for (to, from) in to_lines.iter_mut().zip(from_lines) {
            // SAFETY: both are as long as the register, and the target is aligned to it.
            unsafe { _mm256_stream_ps(to.as_mut_ptr(), _mm256_loadu_ps(from.as_ptr())) }
        }
        to_end.copy_from_slice(from_end);
        _mm_sfence();
    }

    assert!(is_x86_feature_detected!("avx"), "the ceiling needs AVX");
    // SAFETY: the processor has the instructions.
    unsafe { lines(to, from) }
}

#[cfg(not(target_arch = "x86_64"))]
fn streamed_copy(to: &mut [f32], from: &[f32]) {
    to.copy_from_slice(from);
}

/// Seconds a repetition, a few repetitions long; with a cold second-level cache if the mesh does not fit it anyway.
fn time(cold: bool, mut repetition: impl FnMut()) -> f64 {
    // The first repetition only puts the caches into the state that this alternative leaves behind.
    repetition();
    let mut flush = vec![0_u8; if cold { FLUSH_BYTES } else { 0 }];
    let (mut spent, mut repetitions) = (Duration::ZERO, 0);
    while spent < SPAN {
        flush.iter_mut().step_by(64).for_each(|byte| *byte = byte.wrapping_add(1));
        black_box(&mut flush);
        let start = Instant::now();
        repetition();
        spent += start.elapsed();
        repetitions += 1;
    }
    spent.as_secs_f64() / f64::from(repetitions)
}

fn median(mut values: Vec<f64>) -> f64 {
    values.sort_by(f64::total_cmp);
    values[values.len() / 2]
}

fn kernels() -> Vec<Work> {
    let mut works = Vec::new();
    for instructions in Instructions::ALL.into_iter().filter(|instructions| instructions.are_available()) {
        for celerity in CELERITIES {
            works.push(Work::Kernel { instructions, stores: Stores::Automatic, celerity });
        }
    }
    let instructions = Instructions::fastest();
    for stores in [Stores::Cached, Stores::Streamed] {
        works.push(Work::Kernel { instructions, stores, celerity: CELERITIES[1] });
    }
    works
}

/// Prints medians of every alternative and its share of the best copy.
fn print_shares() {
    println!(
        "{:>8} {:>7} {:>7}  {:<44} {:>9} {:>6}",
        "vertices", "threads", "bytes", "alternative", "ns/vertex", "share"
    );
    for count in SIZES {
        let vertices = town(count);
        let mut memory = Memory::new(count);
        let cold = count > SIZES[0];
        for (threads, doppler) in THREADS.into_iter().flat_map(|threads| [(threads, false), (threads, true)]) {
            let pool = ThreadPoolBuilder::new().num_threads(threads).build().unwrap();
            let mut works = vec![Work::CopyCached, Work::CopyStreamed];
            works.extend(kernels());
            let rounds: Vec<Vec<f64>> = pool.install(|| {
                (0..ROUNDS)
                    .map(|_| {
                        works
                            .iter()
                            .map(|&work| time(cold, || run(work, &vertices, &mut memory, doppler, threads)))
                            .collect()
                    })
                    .collect()
            });
            let column = |index: usize| median(rounds.iter().map(|round| round[index]).collect());
            let best_copy = if column(0) < column(1) { 0 } else { 1 };
            for (index, work) in works.iter().enumerate() {
                let share = median(rounds.iter().map(|round| round[best_copy] / round[index]).collect());
                let label = match work {
                    Work::Kernel { instructions, stores, celerity } => {
                        format!("{instructions:?}, {stores:?}, u = {celerity}")
                    }
                    copy => format!("{copy:?}"),
                };
                println!(
                    "{count:>8} {threads:>7} {:>7}  {label:<44} {:>9.3} {share:>6.2}",
                    if doppler { "12 + 16" } else { "12 + 12" },
                    column(index) / count as f64 * 1e9,
                );
            }
        }
    }
}

fn criterion_figures(criterion: &mut Criterion) {
    let mut group = criterion.benchmark_group("photo_surface");
    group.sample_size(20).warm_up_time(SPAN * 200).measurement_time(SPAN * 1000);
    for count in SIZES {
        let vertices = town(count);
        let mut memory = Memory::new(count);
        group.throughput(Throughput::Bytes(28 * count as u64));
        for threads in THREADS {
            let pool = ThreadPoolBuilder::new().num_threads(threads).build().unwrap();
            let kernel = Work::Kernel {
                instructions: Instructions::fastest(),
                stores: Stores::Automatic,
                celerity: CELERITIES[1],
            };
            for (name, work) in [("kernel", kernel), ("copy", Work::CopyCached)] {
                let id = BenchmarkId::new(format!("{name}, {threads} threads"), count);
                group.bench_function(id, |bencher| {
                    pool.install(|| {
                        bencher.iter(|| run(work, &vertices, &mut memory, true, threads));
                    });
                });
            }
        }
    }
    group.finish();
}

/// Prints the commit and the processor that the figures belong to.
fn print_heading() {
    let commit = Command::new("git").args(["describe", "--always", "--dirty"]).output();
    let commit =
        commit.map_or_else(|_| "unknown".into(), |output| String::from_utf8_lossy(&output.stdout).into_owned());
    let processors = std::fs::read_to_string("/proc/cpuinfo").unwrap_or_default();
    let processor = processors.lines().find_map(|line| line.strip_prefix("model name")).unwrap_or("unknown");
    println!(
        "commit {}, processor {}, {:?}",
        commit.trim(),
        processor.trim_matches([' ', '\t', ':']),
        Instructions::fastest()
    );
}

fn main() {
    // Print nothing if cargo only tests that the benchmark runs.
    if std::env::args().any(|argument| argument == "--bench") {
        print_heading();
        print_shares();
    }
    let mut criterion = Criterion::default().configure_from_args();
    criterion_figures(&mut criterion);
    criterion.final_summary();
}
