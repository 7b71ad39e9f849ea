//! The picture must not depend on the place where vertices are bent. The GPU's vertex stage, with the kernel for
//! vertices astern, must draw the same picture as the kernel alone.
//!
//! In a wrong program, f32 alone loses the part across the motion, which gives errors of minutes of arc to radians
//! astern at high speed. Vertices may stay where they were bent for the frame before. Moving bodies may be seen from
//! the world's eye.
#![allow(clippy::unwrap_used, reason = "a failed construction is a failed test")]

use built_in::lattice::Lattice;
use glam::{DVec3, Vec2};
use physics::{Celerity, Event};
use scene::motion::{Motion, Uniform};
use scene::refine::refine;
use scene::{Material, Mesh, Scene};
use system_tests::photographer::Photographer;
use system_tests::view::View;
use view::{Dial, Effects};

const SIZE: [u32; 2] = [200, 150];

/// Share of pixels, on outlines, that may show another surface, since the two ways round differently.
const OUTLINE_SHARE: f64 = 0.003;

/// Largest distance between the places that both show in a pixel, in edges of the cut scene.
const PLACE_TOLERANCE: f64 = 0.02;

const EDGE_M: f64 = 0.25;

/// Scenes drawn as they are given, with vertices bent by the kernel, and by the vertex stage.
const BOTH: [Dial; 2] = [Dial::edge(EDGE_M), Dial::vertex_stage(EDGE_M)];

fn lattice() -> Scene {
    let mut scene = Lattice { count: [5, 5, 5], spacing: 3.0, side: 0.8 }.build();
    // Half of the lattice flies away from the other half.
    let uniform = Uniform { celerity: Celerity::new(DVec3::new(0.2, 0.7, 0.1)).unwrap(), anchor: Event::default() };
    scene.motions = vec![Motion::Uniform(uniform)];
    let mut moving = scene.meshes[0].clone();
    moving.motion = Some(0);
    moving.indices = scene.meshes[0].indices.split_off(moving.indices.len() / 6 * 3);
    scene.meshes.push(moving);
    refine(&scene, EDGE_M as f32).unwrap()
}

#[test]
fn the_vertex_stage_draws_what_the_kernel_draws() {
    let scene = lattice();
    let mut pictures = BOTH.map(|method| Photographer::with(&scene, SIZE, 1, None, method));
    let mut total = 0;
    let speeds = [0.0, 0.75, 5.0, 100.0].map(|u: f64| DVec3::new(0.1, 0.2, -1.0).normalize() * u);
    for (celerity, look) in speeds.into_iter().flat_map(|u| [(u, DVec3::NEG_Z), (u, DVec3::new(1.0, 0.1, -0.6))]) {
        let view = View { look, up: DVec3::Y, fov_degrees: 70.0, size: SIZE };
        let (eye, u) = (DVec3::new(0.4, 0.3, 0.2), celerity.length());
        let celerity = Celerity::new(celerity).unwrap();
        let [by_kernel, by_stage] = pictures.each_mut().map(|photographer| photographer.places(&view, eye, celerity));
        let pairs = by_kernel.iter().zip(&by_stage);
        let apart = pairs.filter(|(kernel, stage)| match (kernel, stage) {
            (Some(kernel), Some(stage)) => kernel.position.distance(stage.position) > PLACE_TOLERANCE * EDGE_M,
            (kernel, stage) => kernel.is_some() != stage.is_some(),
        });
        let (apart, shown) = (apart.count() as f64, by_kernel.iter().flatten().count());
        println!("u = {u}, towards {look}: {shown} pixels show a surface, {apart} differ");
        assert!(apart <= OUTLINE_SHARE * f64::from(SIZE[0] * SIZE[1]), "u = {u} towards {look}: {apart} pixels differ");
        total += shown;

        // Compare light as well: the shift of each body is that of its own view.
        let [by_kernel, by_stage] =
            pictures.each_mut().map(|photographer| photographer.light(&view, eye, celerity, Effects::ALL));
        let close = |(a, b): &(&image::Rgb<f32>, &image::Rgb<f32>)| {
            a.0.iter().zip(&b.0).all(|(a, b)| (a - b).abs() <= 0.02 * a.abs().max(b.abs()))
        };
        let apart = by_kernel.pixels().zip(by_stage.pixels()).filter(|pair| !close(pair)).count() as f64;
        assert!(apart <= 3.0 * OUTLINE_SHARE * f64::from(SIZE[0] * SIZE[1]), "u = {u}: {apart} pixels shine otherwise");
    }
    assert!(total > 50_000, "{total} pixels show a surface");
}

/// Square of `half` metres to either side about the world's origin, facing `towards`, divided into small squares.
fn square(towards: DVec3, half: f64) -> Scene {
    const CELLS: u32 = 40;
    let (right, up) = towards.any_orthonormal_pair();
    let mut mesh = Mesh::default();
    for (row, column) in (0..=CELLS).flat_map(|row| (0..=CELLS).map(move |column| (row, column))) {
        let [x, y] = [column, row].map(|cell| half * (2.0 * f64::from(cell) / f64::from(CELLS) - 1.0));
        mesh.positions.push((x * right + y * up).as_vec3());
        if row < CELLS && column < CELLS {
            let [a, b] = [row, row + 1].map(|row| row * (CELLS + 1) + column);
            mesh.indices.extend([a, a + 1, b + 1, a, b + 1, b]);
        }
    }
    mesh.normals = vec![towards.as_vec3(); mesh.positions.len()];
    mesh.uvs = vec![Vec2::ZERO; mesh.positions.len()];
    mesh.colours = vec![[1.0; 4]; mesh.positions.len()];
    let materials = vec![Material { unlit: true, double_sided: true, ..Material::default() }];
    Scene { materials, meshes: vec![mesh], ..Scene::default() }
}

#[test]
fn what_lies_astern_keeps_its_digits() {
    // Three metres dead astern at γ = 10⁶, two micrometres fill the picture.
    let (gamma, distance) = (1e6, 3.0);
    let ahead = DVec3::new(0.3, -0.2, -1.0).normalize();
    let half = 2.0 * distance / (2.0 * gamma);
    let scene = square(ahead, half);
    let mut pictures = BOTH.map(|method| Photographer::with(&scene, SIZE, 1, None, method));
    let view = View { look: -ahead, up: DVec3::Y, fov_degrees: 70.0, size: SIZE };
    let celerity = Celerity::new(ahead * gamma).unwrap();
    // Look from there, from a place with nothing astern, and from there again: the streams must not keep old values.
    let [there, _, back] = [ahead * distance, -ahead * distance, ahead * distance].map(|eye| {
        let [by_kernel, by_stage] = pictures.each_mut().map(|photographer| photographer.places(&view, eye, celerity));
        let shown = by_kernel.iter().flatten().count();
        let apart = by_kernel.iter().zip(&by_stage).filter(|(kernel, stage)| match (kernel, stage) {
            (Some(kernel), Some(stage)) => kernel.position.distance(stage.position) > 0.001 * half,
            (kernel, stage) => kernel.is_some() != stage.is_some(),
        });
        let apart = apart.count();
        println!("at {eye}: {shown} pixels show the square, {apart} differ");
        assert!(apart as f64 <= OUTLINE_SHARE * f64::from(SIZE[0] * SIZE[1]), "at {eye}: {apart} pixels differ");
        shown
    });
    assert!(there > 5000 && there == back, "{there}, then {back} pixels show the square");
}
