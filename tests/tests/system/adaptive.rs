//! A scene cut for a picture must be the same surface, and no place of it may be drawn farther from its exact
//! apparent position than the tolerance.
//!
//! In a wrong program, edges cut by more than their own ends decide give cracks. A triangle that is judged by its
//! edges alone puts the ground below the eye in the wrong place. If geometry outside the picture is ignored,
//! triangles from astern cross the picture. Vertices in f32 about the world's origin leave nothing in its place
//! astern at γ = 10⁶.
#![allow(clippy::unwrap_used, reason = "a failed construction is a failed test")]

use built_in::lattice::Lattice;
use exact_reference::random::{direction, seeded};
use glam::{DVec2, DVec3, Vec3};
use physics::{Celerity, Event, Observer, apparent};
use rand::RngExt;
use rand_chacha::ChaCha8Rng;
use scene::cut::{Cut, CutFineness, CutViewpoint};
use scene::{Mesh, Scene};
use std::collections::HashMap;
use system_tests::exact::{Boxes, differing};
use system_tests::photographer::Photographer;
use system_tests::view::View;
use view::Camera;
use view::Dial;

const SIZE: [u32; 2] = [640, 480];
const TOLERANCE_PX: f64 = 0.5;
const FINENESS: CutFineness = CutFineness { tolerance_px: TOLERANCE_PX, turn_rad: 0.0, triangles: 4_000_000 };
const LATTICE: Lattice = Lattice { count: [4, 4, 4], spacing: 4.0, side: 1.0 };

/// Tolerance for the rounding of f64 in a place astern at γ = 10⁶, pixels.
const ROUNDING_PX: f64 = 1e-4;

/// Square of 100 m, with corners counter-clockwise as seen from `normal`.
fn square(middle: DVec3, normal: DVec3) -> Mesh {
    let across = 50.0 * normal.any_orthonormal_vector();
    let up = normal.cross(across);
    let corners = [-across - up, across - up, across + up, up - across].map(|corner| (middle + corner).as_vec3());
    Mesh {
        positions: corners.to_vec(),
        normals: vec![normal.as_vec3(); 4],
        uvs: vec![glam::Vec2::ZERO; 4],
        colours: vec![[1.0; 4]; 4],
        indices: vec![0, 1, 2, 0, 2, 3],
        ..Mesh::default()
    }
}

fn scene(meshes: Vec<Mesh>) -> Scene {
    Scene { materials: LATTICE.build().materials, meshes, ..Scene::default() }
}

fn viewpoint(eye: DVec3, celerity: Celerity, look: DVec3, fov_degrees: f64) -> CutViewpoint {
    let observer = Observer { event: Event { ct: 0.0, position: eye }, celerity };
    CutViewpoint::new(observer, Camera::looking(look, DVec3::Y, fov_degrees.to_radians()), SIZE)
}

/// Random observer among the boxes, with a random direction of view.
fn random_viewpoint(random: &mut ChaCha8Rng, fastest: f64) -> CutViewpoint {
    let eye = DVec3::from_array([0, 1, 2].map(|_| random.random_range(-7.0..7.0)));
    let celerity = Celerity::new(direction(random) * random.random_range(0.0..fastest).sinh()).unwrap();
    let astern = random.random_range(0..3) == 0;
    let look = if astern { -celerity.vector() + 1e-9 * DVec3::X } else { direction(random) };
    viewpoint(eye, celerity, look, random.random_range(30.0..110.0))
}

/// Place in the picture of a place in the observer's space, pixels from the middle.
fn pixel(viewpoint: &CutViewpoint, seen: DVec3) -> Option<DVec2> {
    let eye = viewpoint.pictures[0].0.observer_from_eye.conjugate() * seen.normalize();
    let focal_length = viewpoint.pictures[0].0.tangents(SIZE).focal_length(SIZE).y;
    let at = eye.truncate() / -eye.z * focal_length;
    (eye.z < 0.0 && at.x.abs() < 0.5 * f64::from(SIZE[0]) && at.y.abs() < 0.5 * f64::from(SIZE[1])).then_some(at)
}

/// Errors in pixels at random places of the cut whose exact or drawn position is in the picture.
fn errors(scene: &Scene, cut: &Cut, viewpoint: &CutViewpoint, random: &mut ChaCha8Rng) -> Vec<f64> {
    let mut errors = Vec::new();
    for (cut, mesh) in cut.meshes.iter().zip(&scene.meshes) {
        let image = |at| apparent::at_rest(&viewpoint.observer, at).position;
        let images: Vec<DVec3> = cut.places(mesh).map(image).collect();
        for corners in cut.indices(mesh).chunks_exact(3) {
            // Large triangles are few, and could reach into the picture from far beside it.
            let [a, b, c] = [0, 1, 2].map(|corner: usize| images[corners[corner] as usize].normalize());
            let size = a.distance(b).max(b.distance(c)).max(c.distance(a));
            for _ in 0..1 + (40.0 * size) as usize {
                let mut shares = [0, 1, 2].map(|_| random.random_range(1e-3..1.0_f64));
                let sum: f64 = shares.iter().sum();
                shares.iter_mut().for_each(|share| *share /= sum);
                let mean = |of: &dyn Fn(usize) -> DVec3| {
                    corners.iter().zip(shares).map(|(&corner, share)| of(corner as usize) * share).sum::<DVec3>()
                };
                let (drawn, seen) = (mean(&|corner| images[corner]), image(mean(&|corner| cut.place(mesh, corner))));
                match (pixel(viewpoint, seen), pixel(viewpoint, drawn)) {
                    (Some(seen), Some(drawn)) => errors.push(seen.distance(drawn)),
                    (None, None) => {}
                    // If only one position is in the picture, use the angle, which agrees with the distance in pixels
                    // approximately.
                    _ => {
                        let (seen, drawn) = (seen.normalize(), drawn.normalize());
                        let angle = seen.cross(drawn).length().atan2(seen.dot(drawn));
                        errors.push(angle * viewpoint.pictures[0].0.tangents(SIZE).focal_length(SIZE).y);
                    }
                }
            }
        }
    }
    errors
}

#[test]
fn no_place_of_the_picture_is_further_off_than_the_tolerance() {
    let mut random = seeded(41);
    let mut all = Vec::new();
    let boxes = LATTICE.build();
    for round in 0..60 {
        // γ is up to 10⁶; half of the time a wall of 100 m is right behind, or the ground below.
        let viewpoint = random_viewpoint(&mut random, 14.5);
        let motion = viewpoint.observer.celerity.vector().normalize();
        let (away, distance) = (if round % 4 == 0 { -motion } else { DVec3::NEG_Y }, 10.0_f64.powi(round % 3 - 1));
        let near = scene(vec![square(viewpoint.observer.event.position + distance * away, -away)]);
        for scene in [&boxes, &near] {
            let cut = Cut::new(scene, &viewpoint, FINENESS, None);
            assert_eq!(cut.tolerance_px, TOLERANCE_PX, "{} triangles did not do", cut.triangles);
            all.extend(errors(scene, &cut, &viewpoint, &mut random));
        }
    }
    all.sort_by(f64::total_cmp);
    let (count, largest) = (all.len(), all[all.len() - 1]);
    let of = |share: f64| all[(share * count as f64) as usize];
    println!("{count} places: median {:.4}, 99.9 % {:.4}, largest {largest:.4} pixels", of(0.5), of(0.999));
    assert!(count > 100_000, "{count} places are too few");
    assert!(of(0.999) <= TOLERANCE_PX + ROUNDING_PX, "99.9 %: {} pixels", of(0.999));
    assert!(largest <= 2.0 * TOLERANCE_PX, "{largest} pixels");
    assert!(of(0.999) > 0.1 * TOLERANCE_PX, "much finer than was asked for: {}", of(0.999));
}

#[test]
fn a_closed_surface_stays_closed_across_meshes_too() {
    let whole = LATTICE.build();
    // Divide the triangles among meshes that are cut independently.
    let apart = |part: usize| {
        let mut mesh = whole.meshes[0].clone();
        let triangles = mesh.indices.chunks_exact(3).enumerate().filter(|(number, _)| number % 3 == part);
        mesh.indices = triangles.flat_map(|(_, corners)| corners.to_vec()).collect();
        mesh
    };
    let torn = scene((0..3).map(apart).collect());
    let mut random = seeded(42);
    for _ in 0..12 {
        let viewpoint = random_viewpoint(&mut random, 8.0);
        // A cut for a slightly earlier place of the observer leaves many edges close to the limit.
        let mut earlier = viewpoint.clone();
        earlier.observer.event.position += 0.1 * direction(&mut random);
        let before = Cut::new(&torn, &earlier, FINENESS, None);
        for scene in [&whole, &torn] {
            let cut = Cut::new(scene, &viewpoint, FINENESS, Some(&before));
            let mut edges = HashMap::<[[u64; 3]; 2], i64>::new();
            for (cut, mesh) in cut.meshes.iter().zip(&scene.meshes) {
                let place = |corner: u32| cut.place(mesh, corner as usize).to_array().map(f64::to_bits);
                for corners in cut.indices(mesh).chunks_exact(3) {
                    for (a, b) in [(0, 1), (1, 2), (2, 0)].map(|(a, b)| (place(corners[a]), place(corners[b]))) {
                        *edges.entry([a.min(b), a.max(b)]).or_default() += if a < b { 1 } else { -1 };
                    }
                }
            }
            let open = edges.values().filter(|&&balance| balance != 0).count();
            assert_eq!(open, 0, "of {} edges {open} have one side only", edges.len());
        }
    }
}

#[test]
fn a_small_step_changes_few_edges() {
    let town = LATTICE.build();
    let celerity = Celerity::new(DVec3::new(0.3, 0.1, -2.0)).unwrap();
    let looking = |step: f64| viewpoint(DVec3::new(0.3, 0.2, step), celerity, DVec3::NEG_Z, 75.0);
    let first = Cut::new(&town, &looking(0.5), FINENESS, None);
    let mut changed = [0, 0];
    let mut kept = first.clone();
    // Turn to and fro: without the cut before, every edge close to the limit would change each time.
    for turn in 0..8 {
        let there = looking(0.5 - 0.02 * f64::from(turn % 2));
        let forgetful = Cut::new(&town, &there, FINENESS, None);
        let next = Cut::new(&town, &there, FINENESS, Some(&kept));
        changed[0] += usize::from(turn > 0) * next.split.symmetric_difference(&kept.split).count();
        changed[1] += usize::from(turn % 2 == 1) * 2 * forgetful.split.symmetric_difference(&first.split).count();
        kept = next;
    }
    println!("{} of {} edges changed, {} without a memory", changed[0], first.split.len(), changed[1]);
    assert!(changed[1] > 0, "the step was too small to tell");
    assert!(10 * changed[0] < first.split.len() && 2 * changed[0] < changed[1], "{changed:?}");
}

#[test]
fn any_number_of_threads_cuts_alike() {
    let scene = Lattice::default().build();
    let viewpoint = random_viewpoint(&mut seeded(43), 4.0);
    let cut_by = |threads| {
        let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build().unwrap();
        pool.install(|| Cut::new(&scene, &viewpoint, FINENESS, None))
    };
    let one = cut_by(1);
    assert!(one.meshes == cut_by(2).meshes && one.meshes == cut_by(8).meshes);
}

#[test]
fn too_many_triangles_make_the_cut_coarser_and_it_says_so() {
    let viewpoint = viewpoint(DVec3::new(0.3, 0.2, 0.5), Celerity::new(DVec3::Z * -5.0).unwrap(), DVec3::NEG_Z, 90.0);
    let few = CutFineness { tolerance_px: 0.02, triangles: 5000, ..FINENESS };
    let cut = Cut::new(&LATTICE.build(), &viewpoint, few, None);
    assert!(cut.triangles <= 5000 && cut.tolerance_px > 0.02, "{} for {}", cut.triangles, cut.tolerance_px);
}

#[test]
fn at_rest_nothing_is_cut() {
    let scene = LATTICE.build();
    let cut = Cut::new(&scene, &viewpoint(DVec3::splat(0.3), Celerity::ZERO, DVec3::X, 90.0), FINENESS, None);
    assert_eq!(cut.triangles, scene.triangle_count());
}

/// Linear colour, unlike the colour of any face.
const BACKGROUND: [f32; 3] = [0.01, 0.02, 0.03];

/// Place of the eye, metres; then the corner of a box, which is dead astern of the motion.
const EYE: DVec3 = DVec3::new(0.375, -0.21875, 0.53125);
const CORNER: Vec3 = Vec3::new(5.5, -1.5, 2.5);

/// Largest share of pixels that may differ at the outlines: at γ = 701 the picture ahead holds the whole world.
const SHARE_AT_MOST: f64 = 0.005;

#[test]
fn at_gamma_701_boxes_are_where_exact_rays_meet_them() {
    let boxes = Boxes::of(&LATTICE, BACKGROUND);
    let mut photographer =
        Photographer::with(&LATTICE.build(), SIZE, 1, Some(BACKGROUND), Dial::tolerance(TOLERANCE_PX));
    // The motion is aimed a little beside the corner, since that offset is enlarged 1400 times.
    let motion = EYE - CORNER.as_dvec3() + DVec3::new(4e-4, -2e-4, 7e-4);
    let celerity = Celerity::new(motion.normalize() * (701.0_f64 * 701.0 - 1.0).sqrt()).unwrap();
    for look in [motion, motion.cross(DVec3::Y), -motion] {
        let view = View { look, up: DVec3::new(0.1, 1.0, 0.0), fov_degrees: 90.0, size: SIZE };
        let drawn = photographer.moving(&view, EYE, celerity);
        let sight = boxes.seen_by(&view, EYE, celerity);
        let exact = sight.picture();
        let differing = differing(&drawn, &exact);
        let share = differing.len() as f64 / f64::from(SIZE[0] * SIZE[1]);
        let colours: std::collections::HashSet<_> = exact.pixels().map(|pixel| pixel.0).collect();
        println!("{look}: {share:.5} differ, {} colours", colours.len());
        assert!(colours.len() >= 2, "{look}: {} colours", colours.len());
        assert!(share < SHARE_AT_MOST, "{look}: {share} of the pixels differ");
        let reach = TOLERANCE_PX + 0.2;
        let stray = differing
            .iter()
            .find(|&&[column, row]| !sight.shows_near([column, row], drawn.get_pixel(column, row).0, reach, 16.0));
        assert_eq!(stray, None, "{look}: a pixel differs that no outline comes near");
    }
}
