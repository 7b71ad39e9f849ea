//! Scratch.
use glam::{DVec2, DVec3};
use physics::{Beta, photo_surface::Eye};
use rapidity::{
    gpu::Gpu,
    renderers::{picture::*, polygon::*},
    scene::*,
    views::Camera,
};
fn main() {
    let _ = DVec2::ZERO;
    let a: Vec<String> = std::env::args().collect();
    let beta: f64 = a[1].parse().unwrap();
    let samples: u32 = a[2].parse().unwrap();
    let gpu = Gpu::new().unwrap();
    println!("{}", gpu.description());
    let scene = lattice::Lattice::default().build();
    let scene = refine::refine(&scene, a[3].parse().unwrap()).unwrap();
    println!("{} triangles", scene.triangle_count());
    let mut r = PolygonRenderer::new(&gpu, &scene, Studio::format(&gpu), None).unwrap();
    let mut studio = Studio::new(&gpu, [1280, 720], samples);
    let u = Beta::new(DVec3::NEG_Z * beta).unwrap().celerity();
    let pos = DVec3::new(0.3, 0.2, 8.0);
    let t = std::time::Instant::now();
    r.submit(&gpu, Eye::new(pos, u.vector()).unwrap()).unwrap();
    let shot = Shot {
        camera: Camera::looking(DVec3::NEG_Z, DVec3::Y, 70f64.to_radians()),
        positions: Positions::Apparent,
        eye: pos,
        motion: u,
    };
    let p = studio.photograph(&gpu, &mut r, &shot).unwrap();
    println!("{:?}", t.elapsed());
    p.save(&a[4]).unwrap();
}
