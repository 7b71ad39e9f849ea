//! The light of a pixel must be that of one ray, bent by aberration, shifted and brightened by D. The ray tracer
//! follows it in f64. Here it is compared with closed forms first, and then the other renderers with it.
//!
//! In a wrong program, a boost the wrong way makes spheres oval; the wrong power of D makes walls too dark ahead; a
//! renderer that bends or lights differently differs in more than outlines.
#![allow(clippy::unwrap_used, reason = "a failed construction is a failed test")]

use built_in::lattice::Lattice;
use built_in::town;
use glam::{DVec3, Vec2, Vec3};
use image::{Rgb32FImage, RgbaImage};
use physics::{Aberration, Celerity, Event};
use render::display::{Development, Gamut};
use scene::mipmap::mipmap;
use scene::motion::{Motion, Uniform};
use scene::{Alpha, Lighting, Material, Mesh, Panorama, Scene};
use std::sync::atomic::{AtomicBool, AtomicUsize, Ordering};
use studio::Studio;
use system_tests::bodies::{Cone, celerity, exact, observer, outline, sphere};
use system_tests::photographer::{DEFAULT_MAP, Photographer, gpu};
use system_tests::turns::turn;
use system_tests::view::{View, middle};
use trace::{RayTracer, Traced};
use view::{Dial, Effects, Shot};

const SIZE: [u32; 2] = [96, 64];

/// Relative tolerance of a colour that is integrated and multiplied: f32 base colours, and the integral that makes
/// white white.
const LIGHT_TOLERANCE: f64 = 1e-4;

/// Relative tolerance of f64 coordinates of a few metres after two boosts.
const PLACE_TOLERANCE: f64 = 1e-9;

/// Largest distance of an outline, pixels: it runs between the middles of two pixels, and the sphere is made of
/// triangles.
const OUTLINE_TOLERANCE: f64 = 0.6;

/// Polygons cut for a twentieth of a pixel, which is less than shows.
const POLYGON: Dial = Dial::tolerance(0.05);

fn shot(view: &View, eye: DVec3, celerity: Celerity, effects: Effects) -> Shot {
    view.shot(&observer(eye, celerity), effects)
}

fn trace(tracer: &RayTracer, shot: &Shot) -> Traced {
    tracer.trace(shot, SIZE, 1, &AtomicBool::new(false), || {})
}

/// Walls of a room around the eye, all of one colour that they emit themselves.
fn room(colour: [f32; 3]) -> Scene {
    let mut room = Lattice { count: [1; 3], spacing: 1.0, side: 8.0 }.build();
    for mesh in &mut room.meshes {
        mesh.material = 0;
        // The walls are seen from within.
        mesh.indices.chunks_exact_mut(3).for_each(|corners| corners.swap(0, 1));
        mesh.colours.fill([1.0; 4]);
    }
    let [red, green, blue] = colour;
    room.materials = vec![Material { unlit: true, base_colour: [red, green, blue, 1.0], ..Material::default() }];
    room
}

#[test]
fn a_wall_is_brighter_by_the_fourth_power_of_d() {
    let colour = Vec3::new(0.5, 0.25, 0.125);
    let tracer = RayTracer::new(room(colour.to_array()), None, true).unwrap();
    let view = View { look: DVec3::new(0.3, 0.1, -1.0), up: DVec3::Y, fov_degrees: 90.0, size: SIZE };
    let effects = Effects { searchlight: true, ..Effects::GEOMETRY };
    for beta in [0.0, 0.6, 0.9] {
        let motion = celerity(DVec3::NEG_Z * beta);
        let traced = trace(&tracer, &shot(&view, DVec3::new(0.4, 0.2, 0.1), motion, effects));
        assert_eq!(traced.done, traced.tiles);
        let mut pixels = traced.light.iter();
        for pixel in (0..SIZE[1]).flat_map(|row| (0..SIZE[0]).map(move |column| [column, row])) {
            let (_, doppler) = Aberration::new(motion).world_from_observer(view.direction(middle(pixel)));
            let expected = colour.as_dvec3() * doppler.powi(4);
            let error = (*pixels.next().unwrap() / expected - 1.0).abs().max_element();
            assert!(error < LIGHT_TOLERANCE, "{error} at {pixel:?}, {beta} c");
        }
    }
}

#[test]
fn looked_up_light_is_integrated_light() {
    let colour = [0.5, 0.25, 0.125];
    let [looked_up, integrated] = [false, true].map(|exact| RayTracer::new(room(colour), None, exact).unwrap());
    let view = View { look: DVec3::NEG_Z, up: DVec3::Y, fov_degrees: 90.0, size: SIZE };
    let shot = shot(&view, DVec3::ZERO, celerity(DVec3::NEG_Z * 0.8), Effects::ALL);
    let (one, other) = (trace(&looked_up, &shot), trace(&integrated, &shot));
    // The limit is the table's own promise; in luminance its error is a tenth of it.
    for (one, other) in one.light.iter().zip(&other.light) {
        assert!((*one - *other).length() < 1e-3 * other.length(), "{one} {other}");
    }
}

/// Checks a sphere that flies past at 0.9 c, as an observer with this celerity sees it.
fn hold_flying_sphere(observer_celerity: Celerity) {
    let centre = DVec3::new(0.3, 0.8, -2.2);
    let mut scene = sphere(centre, 0.03);
    let uniform = Uniform { celerity: celerity(DVec3::X * 0.9), anchor: Event { ct: -2.4, position: centre } };
    scene.motions = vec![Motion::Uniform(uniform)];
    scene.meshes[0].motion = Some(0);
    let observer = observer(DVec3::ZERO, observer_celerity);

    // The expected circle: tangents in the sphere's own frame, boosted.
    let seen_by = uniform.seen_by(&observer);
    let circle = Cone::around(centre - seen_by.position).seen_at(seen_by.celerity).turned(seen_by.observer_from_group);
    let view = circle.view([320, 240]);
    let tracer = RayTracer::new(scene, None, false).unwrap();
    let places = tracer.places(&shot(&view, DVec3::ZERO, observer_celerity, Effects::ALL), view.size);
    let outline = outline(&view, |column, row| places[(row * view.size[0] + column) as usize].is_some());
    assert!(outline.len() > 200, "{} pixels of outline", outline.len());
    let pixels = circle.furthest(&outline, &view);
    assert!(pixels < OUTLINE_TOLERANCE, "{pixels} pixels off the exact circle");

    // Each point must be at the apparent position of a moving point.
    let mut compared = 0;
    for place in places.iter().flatten() {
        let direct = exact(&observer, &uniform, place.position + centre);
        let off = place.apparent.distance(direct.position) / direct.position.length();
        assert!(off < PLACE_TOLERANCE, "{} {}", place.apparent, direct.position);
        assert!((place.doppler / direct.doppler - 1.0).abs() < PLACE_TOLERANCE);
        compared += 1;
    }
    assert!(compared > 1000, "{compared} points");
}

#[test]
fn a_sphere_that_flies_past_is_round_and_where_it_appears() {
    hold_flying_sphere(Celerity::ZERO);
    hold_flying_sphere(celerity(DVec3::new(0.1, 0.3, -0.5)));
}

/// Share of pixels whose channels differ by no more than `part` of the brighter one's largest channel.
fn alike(light: &Rgb32FImage, traced: &Traced, part: f64) -> f64 {
    let pairs = light.pixels().zip(&traced.light);
    let alike = pairs.filter(|(drawn, traced)| {
        let drawn = Vec3::from_array(drawn.0).as_dvec3();
        let largest = drawn.abs().max_element().max(traced.abs().max_element());
        (drawn - **traced).abs().max_element() <= part * largest
    });
    alike.count() as f64 / traced.light.len() as f64
}

/// Compares both renderers with rays at several speeds. `shares` are the shares of pixels that must be alike to
/// `part`.
fn hold(scene: &Scene, eye: DVec3, look: DVec3, part: f64, shares: [f64; 2]) {
    let tracer = RayTracer::new(scene.clone(), None, false).unwrap();
    let view = View { look, up: DVec3::Y, fov_degrees: 60.0, size: SIZE };
    for (method, share) in [POLYGON, DEFAULT_MAP].into_iter().zip(shares) {
        let mut photographer = Photographer::with(scene, SIZE, 1, None, method);
        for beta in [0.0, 0.5, 0.9] {
            let motion = celerity(look.normalize() * beta);
            let light = photographer.light(&view, eye, motion, Effects::ALL);
            let traced = trace(&tracer, &shot(&view, eye, motion, Effects::ALL));
            let of = |part| alike(&light, &traced, part);
            println!("{method} at {beta} c: {:.4} to 1 %, {:.4} to 5 %, {:.4} to 20 %", of(0.01), of(0.05), of(0.2));
            assert!(of(part) >= share, "{method} at {beta} c: only {} of the pixels are alike to {part}", of(part));
        }
    }
}

#[test]
fn renderers_draw_the_lattice_as_rays_see_it() {
    let scene = Lattice { count: [6, 6, 6], spacing: 4.0, side: 1.0 }.build();
    // Faces have one colour each, so only outlines may differ, and a few more pixels of a map with eight texels to
    // the pixel.
    hold(&scene, DVec3::new(0.3, 0.4, 2.0), DVec3::NEG_Z, 0.01, [0.99, 0.98]);
}

#[test]
fn renderers_draw_the_town_as_rays_see_it() {
    let _turn = turn();
    // Each texture is replaced by its mean: if a texture is finer than pixels, a ray sees one texel, and the other
    // renderers the mean of many.
    let mut scene = town::build(1);
    for texture in &mut scene.textures {
        let mean = mipmap(texture).pop().unwrap();
        (texture.width, texture.height, texture.rgba) = (mean.width, mean.height, mean.rgba.into());
    }
    let eye = scene.start.position + DVec3::Y * 1.6;
    // The renderers' sun shadows are a map with soft edges and a gap of two of its texels, those of rays are exact.
    // Surfaces that shade themselves are darker by a few percent in many pixels.
    hold(&scene, eye, scene.start.look, 0.2, [0.97, 0.96]);
    hold(&scene, eye, scene.start.look, 0.01, [0.95, 0.94]);
    // Without shadows only outlines differ, in a town of many corners.
    scene.light.shadows = false;
    hold(&scene, eye, scene.start.look, 0.01, [0.99, 0.97]);
}

#[test]
fn any_number_of_threads_traces_the_same_bits() {
    let scene = Lattice::default().build();
    let tracer = RayTracer::new(scene, None, false).unwrap();
    let view = View { look: DVec3::NEG_Z, up: DVec3::Y, fov_degrees: 60.0, size: SIZE };
    let shot = shot(&view, DVec3::new(0.3, 0.4, 2.0), celerity(DVec3::NEG_Z * 0.5), Effects::ALL);
    let traced = [1, 2, 8].map(|threads| {
        let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build().unwrap();
        pool.install(|| trace(&tracer, &shot))
    });
    assert!(traced.iter().all(|other| *other == traced[0]));
}

#[test]
fn what_is_stopped_says_how_much_is_done() {
    let tracer = RayTracer::new(room([1.0; 3]), None, false).unwrap();
    let view = View { look: DVec3::NEG_Z, up: DVec3::Y, fov_degrees: 60.0, size: SIZE };
    let shot = shot(&view, DVec3::ZERO, Celerity::ZERO, Effects::ALL);
    let traced = tracer.trace(&shot, SIZE, 1, &AtomicBool::new(true), || {});
    assert_eq!((traced.done, traced.tiles), (0, 24));
    assert!(traced.light.iter().all(|light| *light == DVec3::ZERO));
}

#[test]
fn what_is_stopped_has_its_middle() {
    let tracer = RayTracer::new(room([1.0; 3]), None, false).unwrap();
    let view = View { look: DVec3::NEG_Z, up: DVec3::Y, fov_degrees: 60.0, size: SIZE };
    let shot = shot(&view, DVec3::ZERO, Celerity::ZERO, Effects::ALL);
    for threads in [1, 3] {
        let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build().unwrap();
        let (stop, finished) = (AtomicBool::new(false), AtomicUsize::new(0));
        let count = || {
            if finished.fetch_add(1, Ordering::Relaxed) + 1 == 4 {
                stop.store(true, Ordering::Relaxed);
            }
        };
        let traced = pool.install(|| tracer.trace(&shot, SIZE, 1, &stop, count));
        assert!((4..4 + threads).contains(&traced.done), "{} tiles with {threads} threads", traced.done);
        // The four tiles around the middle are among them.
        for (column, row) in (SIZE[0] / 2 - 16..SIZE[0] / 2 + 16).flat_map(|x| (24..40).map(move |y| (x, y))) {
            let light = traced.light[(row * SIZE[0] + column) as usize];
            assert!(light != DVec3::ZERO || threads > 1, "{column}, {row} is black");
        }
        assert_eq!(traced.light[0], DVec3::ZERO, "a corner is traced last");
    }
}

/// Square across z about the axis, of one unlit colour with this opacity.
fn sheet(z: f32, half: f32, colour: [f32; 4], alpha: Alpha) -> (Mesh, Material) {
    let corners = [[-half, -half], [half, -half], [half, half], [-half, half]];
    let mesh = Mesh {
        positions: corners.map(|[x, y]| Vec3::new(x, y, z)).to_vec(),
        normals: vec![Vec3::Z; 4],
        uvs: vec![Vec2::ZERO; 4],
        colours: vec![colour; 4],
        indices: vec![0, 1, 2, 0, 2, 3],
        ..Mesh::default()
    };
    (mesh, Material { unlit: true, alpha, ..Material::default() })
}

fn sheets(sheets: impl IntoIterator<Item = (Mesh, Material)>) -> Scene {
    let mut scene = Scene::default();
    for (number, (mut mesh, material)) in sheets.into_iter().enumerate() {
        mesh.material = number;
        scene.meshes.push(mesh);
        scene.materials.push(material);
    }
    scene
}

#[test]
fn sheets_are_mixed_in_their_order_and_masks_are_there_or_not() {
    let scene = sheets([
        sheet(-6.0, 9.0, [0.1, 0.2, 0.4, 1.0], Alpha::Opaque),
        // The nearer sheet is listed before the farther one; the ray must sort them.
        sheet(-3.0, 9.0, [1.0, 0.0, 0.5, 0.25], Alpha::Blend),
        sheet(-4.0, 9.0, [0.0, 1.0, 0.5, 0.5], Alpha::Blend),
        sheet(-2.0, 9.0, [9.0, 9.0, 9.0, 0.3], Alpha::Mask(0.5)),
    ]);
    let view = View { look: DVec3::NEG_Z, up: DVec3::Y, fov_degrees: 60.0, size: SIZE };
    let plain = Effects::GEOMETRY;
    let wall = Vec3::new(0.1, 0.2, 0.4).as_dvec3();
    let behind = DVec3::new(0.0, 1.0, 0.5) * 0.5 + wall * 0.5;
    let expected = DVec3::new(1.0, 0.0, 0.5) * 0.25 + behind * 0.75;
    let hidden = {
        let mut scene = scene.clone();
        scene.materials[3].alpha = Alpha::Mask(0.2);
        scene
    };
    for (scene, expected) in [(scene, expected), (hidden, DVec3::splat(9.0))] {
        let tracer = RayTracer::new(scene, None, false).unwrap();
        for beta in [0.0, 0.7] {
            let traced = trace(&tracer, &shot(&view, DVec3::ZERO, celerity(DVec3::Y * beta), plain));
            let middle = traced.light[(SIZE[1] / 2 * SIZE[0] + SIZE[0] / 2) as usize];
            assert!((middle - expected).length() < LIGHT_TOLERANCE, "{middle} {expected} at {beta} c");
        }
    }
}

#[test]
fn a_panorama_is_behind_everything_as_the_others_draw_it() {
    let (width, height) = (64, 32);
    let colour = |x: u32, y: u32| {
        let (x, y) = (x as f32 / width as f32, y as f32 / height as f32);
        [0.3 + 0.2 * (x * std::f32::consts::TAU).sin(), 0.2 + 0.5 * y, 0.4]
    };
    let rgb = (0..height).flat_map(|y| (0..width).map(move |x| colour(x, y)));
    let mut scene = sheets([sheet(-6.0, 0.5, [0.1, 0.2, 0.4, 1.0], Alpha::Opaque)]);
    scene.panorama = Some(Panorama::new(width, height, rgb));
    hold(&scene, DVec3::ZERO, DVec3::new(0.2, 0.1, -1.0), 0.02, [0.98, 0.98]);
}

#[test]
fn lit_boxes_that_move_are_drawn_as_rays_see_them() {
    let mut scene = Lattice { count: [4, 4, 4], spacing: 3.0, side: 1.0 }.build();
    for material in &mut scene.materials {
        material.unlit = false;
    }
    scene.light = Lighting::default();
    let anchor = Event { ct: -3.0, position: DVec3::new(0.0, 0.0, -9.0) };
    scene.motions = vec![Motion::Uniform(Uniform { celerity: celerity(DVec3::new(0.5, 0.1, -0.3)), anchor })];
    for mesh in &mut scene.meshes {
        mesh.motion = Some(0);
    }
    let tracer = RayTracer::new(scene.clone(), None, false).unwrap();
    let mut photographer = Photographer::with(&scene, SIZE, 1, None, POLYGON);
    let view = View { look: DVec3::NEG_Z, up: DVec3::Y, fov_degrees: 60.0, size: SIZE };
    for beta in [DVec3::ZERO, DVec3::new(-0.2, 0.3, -0.6)] {
        let eye = DVec3::new(0.3, 0.4, 2.0);
        let light = photographer.light(&view, eye, celerity(beta), Effects::ALL);
        let traced = trace(&tracer, &shot(&view, eye, celerity(beta), Effects::ALL));
        let share = alike(&light, &traced, 0.01);
        println!("{beta}: {share:.4} to 1 %");
        assert!(share >= 0.99, "{beta}: only {share} of the pixels are alike");
    }
}

#[test]
fn traced_light_is_developed_as_drawn_light_is() {
    // Light that was drawn, then fetched and put in the place of traced light, must give the same picture.
    let scene = Lattice { count: [6, 6, 6], spacing: 4.0, side: 1.0 }.build();
    let view = View { look: DVec3::NEG_Z, up: DVec3::Y, fov_degrees: 60.0, size: SIZE };
    let (eye, motion) = (DVec3::new(0.3, 0.4, 2.0), celerity(DVec3::NEG_Z * 0.5));
    let mut photographer = Photographer::with(&scene, SIZE, 1, None, POLYGON);
    let drawn = photographer.seen(&view, eye, motion, Effects::ALL);
    let light = photographer.light(&view, eye, motion, Effects::ALL);

    let shot = shot(&view, eye, motion, Effects::ALL);
    let mut traced = trace(&RayTracer::new(scene, None, false).unwrap(), &shot);
    let own = develop(&traced);
    traced.light = light.pixels().map(|pixel| Vec3::from_array(pixel.0).as_dvec3()).collect();
    let developed = develop(&traced);
    let apart = |one: &RgbaImage, other: &RgbaImage, codes: u8| {
        let differ = one.as_raw().iter().zip(other.as_raw()).filter(|(one, other)| one.abs_diff(**other) > codes);
        differ.count() as f64 / one.as_raw().len() as f64
    };
    assert_eq!(apart(&drawn, &developed, 1), 0.0, "light that is the same looks the same");
    assert!(apart(&drawn, &own, 2) < 0.02, "{} of the values differ", apart(&drawn, &own, 2));
}

/// Picture developed from traced light in the photographer's way.
fn develop(traced: &Traced) -> RgbaImage {
    let development = Development { gamut: Gamut::Clamp, ..Development::default() };
    let mut studio = Studio::new(gpu(), traced.size, 1);
    studio.develop(gpu(), &traced.texels(), traced.stored, &development, None).unwrap()
}
