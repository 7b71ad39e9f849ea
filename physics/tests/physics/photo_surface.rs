//! The law: every vertex of every mesh of a frame is written once, to its own place, with the same bits
//! whatever computed them, and what cannot be shown is counted.
//!
//! A wrong program would shift a mesh that does not fill its last line, flicker as the number of
//! threads changes, draw a spike to infinity, or write past the end of its memory.

use exact_reference::random::seeded;
use glam::{DVec3, Vec3};
use physics::photo_surface::{
    CHUNK, Instructions, Kernel, PhotoSurfaceError, PhotoSurfaceEye, PhotoSurfaceMesh, Stats, Stores, Vertices,
};
use physics::{Celerity, Event, Observer};
use rand::RngExt;

/// Relative error of two roundings of f32.
const ROUNDING: f32 = 1.2e-7;

/// A photo-surface in ordinary memory.
#[derive(Clone, Debug, PartialEq)]
struct WrittenSurface {
    position: [Vec<f32>; 3],
    doppler: Vec<f32>,
    stats: Stats,
}

impl WrittenSurface {
    fn bits(&self) -> Vec<u32> {
        self.position.iter().chain([&self.doppler]).flatten().map(|value| value.to_bits()).collect()
    }

    fn position(&self, index: usize) -> Vec3 {
        Vec3::from_array([0, 1, 2].map(|axis: usize| self.position[axis][index]))
    }
}

/// Value written before each transform: any that remains was forgotten.
const UNTOUCHED: f32 = -7.0;

fn see<'e, E>(kernel: Kernel, vertices: &Vertices, eye: &'e E) -> WrittenSurface
where
    PhotoSurfaceEye: From<&'e E>,
{
    let mut streams = [const { Vec::new() }; 4];
    streams.iter_mut().for_each(|stream| stream.resize(vertices.len(), UNTOUCHED));
    let [mut x, mut y, mut z, mut doppler] = streams;
    let surface = PhotoSurfaceMesh::new(vertices, [&mut x, &mut y, &mut z]).unwrap();
    let stats = kernel.transform(eye, vec![surface.with_doppler(&mut doppler).unwrap()]);
    WrittenSurface { position: [x, y, z], doppler, stats }
}

fn moving(celerity: DVec3) -> PhotoSurfaceEye {
    PhotoSurfaceEye::new(DVec3::new(0.5, 1.7, -0.3), celerity).unwrap()
}

/// Eyes at speeds that choose each of the formulas.
fn eyes() -> [PhotoSurfaceEye; 4] {
    [
        moving(DVec3::ZERO),
        moving(DVec3::new(0.3, 0.0, -0.6)),
        moving(DVec3::new(10.0, 2.0, 30.0)),
        moving(DVec3::new(-4e8, 2e8, 1e8)),
    ]
}

fn town(count: usize) -> Vertices {
    let mut random = seeded(11);
    let mut coordinate = move || random.random_range(-200.0..200.0);
    Vertices::from_world(DVec3::ZERO, (0..count).map(|_| DVec3::new(coordinate(), coordinate() / 20.0, coordinate())))
        .unwrap()
}

fn available() -> impl Iterator<Item = Kernel> {
    Instructions::ALL.into_iter().filter_map(|instructions| Kernel::with_instructions(instructions).ok())
}

#[test]
fn three_fifths_of_light_speed_is_exact() {
    let vertices = Vertices::from_world(DVec3::ZERO, [DVec3::NEG_Z, DVec3::Z, DVec3::X, DVec3::Y]).unwrap();
    let eye = PhotoSurfaceEye::new(DVec3::ZERO, DVec3::NEG_Z * 0.75).unwrap();
    for kernel in available() {
        let seen = see(kernel, &vertices, &eye);
        assert_eq!(seen.position(0), Vec3::new(0.0, 0.0, -2.0), "ahead");
        assert_eq!(seen.position(1), Vec3::new(0.0, 0.0, 0.5), "astern");
        assert_eq!(seen.position(2), Vec3::new(1.0, 0.0, -0.75), "to the right");
        assert_eq!(seen.position(3), Vec3::new(0.0, 1.0, -0.75), "above");
        assert_eq!(seen.doppler, [2.0, 0.5, 1.25, 1.25]);
    }
}

#[test]
fn an_eye_at_rest_sees_things_where_they_are() {
    let origin = DVec3::new(1e6, -2e5, 3e6);
    let eye = PhotoSurfaceEye::new(origin + DVec3::new(0.1, 0.2, 0.3), DVec3::ZERO).unwrap();
    let offsets =
        (0..1000).map(|index| Vec3::new(index as f32 * 0.37 - 100.0, (index % 7) as f32, -0.01 * index as f32));
    let vertices = Vertices::from_offsets(origin, offsets.clone()).unwrap();
    for kernel in available() {
        let seen = see(kernel, &vertices, &eye);
        for (index, offset) in offsets.clone().enumerate() {
            let there = (offset.as_dvec3() + origin - eye.position()).as_vec3();
            let error = (seen.position(index) - there).abs();
            assert!(error.max_element() <= ROUNDING * there.length(), "vertex {index}: {error}");
        }
        assert!(seen.doppler.iter().all(|&doppler| doppler == 1.0));
    }
}

#[test]
fn slow_eyes_see_nearly_what_resting_eyes_see() {
    let (vertices, resting) = (town(500), moving(DVec3::ZERO));
    let slow = moving(DVec3::X * 1e-12);
    let (rest, slow) = (see(Kernel::default(), &vertices, &resting), see(Kernel::default(), &vertices, &slow));
    for index in 0..500 {
        let difference = rest.position(index).distance(slow.position(index));
        assert!(difference <= 4.0 * ROUNDING * rest.position(index).length(), "vertex {index}");
        assert!((slow.doppler[index] - 1.0).abs() <= 4.0 * ROUNDING, "vertex {index}");
    }
}

#[test]
fn the_number_of_threads_does_not_change_a_bit() {
    let vertices = town(100_003);
    for eye in eyes() {
        let [one, two, eight] = [1, 2, 8].map(|threads| {
            let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build().unwrap();
            pool.install(|| see(Kernel::default(), &vertices, &eye))
        });
        assert_eq!(one.bits(), two.bits());
        assert_eq!(one.bits(), eight.bits());
        assert_eq!((one.stats, one.stats), (two.stats, eight.stats));
    }
}

#[test]
fn the_width_of_fused_registers_does_not_change_a_bit() {
    let [Ok(narrow), Ok(wide)] = [Instructions::Avx2, Instructions::Avx512].map(Kernel::with_instructions) else {
        eprintln!("this processor has not both AVX2 and AVX-512: nothing to compare");
        return;
    };
    let vertices = town(CHUNK + 21);
    for eye in eyes() {
        assert_eq!(see(narrow, &vertices, &eye).bits(), see(wide, &vertices, &eye).bits());
    }
}

#[test]
fn portable_results_differ_by_roundings_only() {
    let portable = Kernel::with_instructions(Instructions::Portable).unwrap();
    let vertices = town(CHUNK + 21);
    for eye in eyes() {
        let (a, b) = (see(portable, &vertices, &eye), see(Kernel::default(), &vertices, &eye));
        for index in 0..vertices.len() {
            let (a, b) = (a.position(index), b.position(index));
            assert!(a.distance(b) <= 10.0 * ROUNDING * b.length(), "vertex {index} of {eye:?}: {a} {b}");
        }
    }
}

#[test]
fn every_length_and_every_kind_of_store_writes_the_same() {
    for kernel in available() {
        for count in (0..40).chain([CHUNK - 1, CHUNK, CHUNK + 1]) {
            let vertices = town(count);
            for eye in eyes() {
                let cached = see(kernel.with_stores(Stores::Cached), &vertices, &eye);
                let streamed = see(kernel.with_stores(Stores::Streamed), &vertices, &eye);
                assert_eq!(cached.bits(), streamed.bits(), "{count} vertices");
                assert!(!cached.doppler.contains(&UNTOUCHED) && !cached.position[2].contains(&UNTOUCHED));
                assert_eq!(cached.stats, Stats { vertices: count, ..Stats::default() });
            }
        }
    }
}

#[test]
fn any_alignment_of_the_output_gives_the_same_bits() {
    let vertices = town(100);
    let eye = moving(DVec3::new(0.0, 0.0, -20.0));
    let expected = see(Kernel::default(), &vertices, &eye);
    let kernel = Kernel::default().with_stores(Stores::Streamed);
    for shift in 0..17 {
        let mut memory = vec![UNTOUCHED; 4 * 100 + 40];
        let (before, used) = memory.split_at_mut(shift);
        let (x, rest) = used.split_at_mut(100);
        let (y, rest) = rest.split_at_mut(100);
        let (z, after) = rest.split_at_mut(100);
        kernel.transform(&eye, vec![PhotoSurfaceMesh::new(&vertices, [x, y, z]).unwrap()]);
        assert_eq!([&*x, &*y, &*z], expected.position.each_ref().map(Vec::as_slice), "shift {shift}");
        assert!(before.iter().chain(after.iter()).all(|&value| value == UNTOUCHED), "shift {shift}");
    }
}

#[test]
fn streamed_lines_hold_the_same_bits_where_they_are_aligned() {
    #[repr(align(64))]
    struct Aligned([[f32; 112]; 4]);
    let vertices = town(112);
    let mut memory = Aligned([[UNTOUCHED; 112]; 4]);
    let [x, y, z, doppler] = &mut memory.0;
    for kernel in available() {
        for eye in eyes() {
            let surface = PhotoSurfaceMesh::new(&vertices, [x, y, z]).unwrap().with_doppler(doppler).unwrap();
            kernel.with_stores(Stores::Streamed).transform(&eye, vec![surface]);
            let expected = see(kernel.with_stores(Stores::Cached), &vertices, &eye);
            assert_eq!([&x[..], y, z], expected.position.each_ref().map(Vec::as_slice));
            assert_eq!(doppler[..], expected.doppler);
        }
    }
}

#[test]
fn meshes_of_a_frame_are_written_each_to_its_own_place() {
    let eye = moving(DVec3::new(0.0, 0.0, -3.0));
    let meshes = [town(90_000), Vertices::from_world(DVec3::X, []).unwrap(), town(7), town(CHUNK)];
    let mut memory = meshes.each_ref().map(|mesh| [(); 3].map(|()| vec![UNTOUCHED; mesh.len()]));
    let surfaces = meshes
        .iter()
        .zip(&mut memory)
        .map(|(mesh, [x, y, z])| PhotoSurfaceMesh::new(mesh, [x, y, z]).unwrap())
        .collect();
    let stats = Kernel::default().transform(&eye, surfaces);
    assert_eq!(stats.vertices, 90_007 + CHUNK);
    for (mesh, written) in meshes.iter().zip(memory) {
        assert_eq!(written, see(Kernel::default(), mesh, &eye).position);
    }
}

#[test]
fn vertices_that_are_not_finite_are_counted_and_collapsed() {
    let bad = [f64::NAN, f64::INFINITY, f64::NEG_INFINITY, 1e300];
    let positions = (0..40).map(|index| match bad.get(index / 10) {
        Some(&bad) if index % 10 == 3 => DVec3::new(1.0, bad, -2.0),
        _ => DVec3::new(index as f64, 1.0, -2.0),
    });
    let vertices = Vertices::from_world(DVec3::ZERO, positions).unwrap();
    assert_eq!(vertices.not_finite(), [3, 13, 23, 33]);
    for kernel in available() {
        for eye in eyes() {
            let seen = see(kernel, &vertices, &eye);
            assert_eq!((seen.stats.not_finite_inputs, seen.stats.not_finite_results), (4, 0));
            for index in 0..40 {
                let collapsed = seen.position(index) == Vec3::ZERO && seen.doppler[index] == 0.0;
                assert_eq!(collapsed, vertices.not_finite().contains(&index), "vertex {index}");
            }
        }
    }
}

#[test]
fn results_beyond_the_range_of_f32_are_counted_and_collapsed() {
    // The last is not too far for its distance to be squared, only for the next step.
    let far = [DVec3::X * 1e30, DVec3::NEG_Z, DVec3::Z * 3e38, DVec3::Y * 1.5e19];
    let vertices = Vertices::from_world(DVec3::ZERO, far).unwrap();
    for kernel in available() {
        for eye in &eyes()[1..] {
            let seen = see(kernel, &vertices, eye);
            assert_eq!((seen.stats.not_finite_inputs, seen.stats.not_finite_results), (0, 3));
            assert_eq!([0, 2, 3].map(|index| seen.position(index)), [Vec3::ZERO; 3]);
            assert_eq!([0, 2, 3].map(|index| seen.doppler[index]), [0.0; 3]);
            assert!(seen.doppler[1] > 0.0);
        }
    }
}

#[test]
fn a_vertex_at_the_eye_has_no_direction_and_no_shift() {
    let position = DVec3::new(0.5, 1.75, -0.25);
    let vertices = Vertices::from_world(DVec3::ZERO, [position]).unwrap();
    for kernel in available() {
        for celerity in [1.0, 1e3, 1e9] {
            let seen = see(kernel, &vertices, &PhotoSurfaceEye::new(position, DVec3::Y * celerity).unwrap());
            assert_eq!(seen.position(0), Vec3::ZERO);
            assert_eq!((seen.doppler[0], seen.stats.not_finite()), (0.0, 0));
        }
    }
}

#[test]
fn finite_garbage_never_panics() {
    let mut random = seeded(12);
    let mut garbage = || f64::from_bits(random.random());
    let mut vector = || DVec3::from_array(std::array::from_fn(|_| garbage()));
    for _ in 0..2000 {
        let (Ok(eye), origin) = (PhotoSurfaceEye::new(vector(), vector()), vector()) else {
            continue;
        };
        let Ok(vertices) = Vertices::from_world(origin, (0..33).map(|_| vector())) else {
            continue;
        };
        for kernel in available() {
            let seen = see(kernel, &vertices, &eye);
            assert!(seen.position.iter().chain([&seen.doppler]).flatten().all(|value| value.is_finite()));
        }
    }
}

#[test]
fn an_observer_sees_what_an_eye_of_the_same_place_and_celerity_sees() {
    let vertices = town(CHUNK + 21);
    for eye in eyes() {
        let event = Event { ct: 5.0, position: eye.position() };
        let observer = Observer { event, celerity: eye.celerity() };
        assert_eq!(see(Kernel::default(), &vertices, &observer).bits(), see(Kernel::default(), &vertices, &eye).bits());
        assert_eq!(vertices.reach_astern(&observer), vertices.reach_astern(&eye));
    }
}

#[test]
fn an_observer_at_no_finite_position_sees_nothing_and_every_vertex_is_counted() {
    let vertices = town(100);
    for bad in [f64::NAN, f64::INFINITY] {
        for celerity in [DVec3::ZERO, DVec3::X, DVec3::Y * 1e9] {
            let event = Event { ct: 0.0, position: DVec3::new(0.0, bad, 0.0) };
            let observer = Observer { event, celerity: Celerity::new(celerity).unwrap() };
            assert!(!vertices.reach_astern(&observer));
            for kernel in available() {
                let seen = see(kernel, &vertices, &observer);
                assert_eq!((seen.stats.not_finite_inputs, seen.stats.not_finite_results), (0, 100));
                assert!(seen.position.iter().chain([&seen.doppler]).flatten().all(|&value| value == 0.0));
            }
        }
    }
}

#[test]
fn input_that_cannot_be_used_is_refused_with_its_values() {
    let eye = PhotoSurfaceEye::new(DVec3::ZERO, DVec3::X * f64::INFINITY).unwrap_err();
    assert!(matches!(eye, PhotoSurfaceError::Eye { .. }) && eye.to_string().contains("inf"));
    let origin = Vertices::from_world(DVec3::NAN, []).unwrap_err();
    assert!(matches!(origin, PhotoSurfaceError::Origin { .. }) && origin.to_string().contains("NaN"));
    let vertices = town(3);
    let (mut x, mut y, mut z, mut doppler) = ([0.0; 3], [0.0; 2], [0.0; 3], [0.0; 4]);
    let error = PhotoSurfaceMesh::new(&vertices, [&mut x, &mut y, &mut z]).unwrap_err();
    assert_eq!(error, PhotoSurfaceError::OutputLength { stream: "y", length: 2, vertices: 3 });
    let mut y = [0.0; 3];
    let surface = PhotoSurfaceMesh::new(&vertices, [&mut x, &mut y, &mut z]).unwrap();
    let error = surface.with_doppler(&mut doppler).unwrap_err();
    assert_eq!(error, PhotoSurfaceError::OutputLength { stream: "doppler", length: 4, vertices: 3 });
}
