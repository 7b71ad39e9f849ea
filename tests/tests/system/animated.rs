//! Each point of an animated body must be seen where it was when its light left: at the event where its worldline
//! crosses the observer's past light cone. Its light must be shifted by that point's own motion there. A body that
//! keys move evenly must look like the same body with a celerity.
//!
//! A wrong program shows bodies at their present places, which are metres away; or a Doppler factor of the wrong
//! moment, of the body's middle or of the world; or two renderers that differ. The expected values come from closed
//! forms of the worldlines, bisection on the light cone, and a textbook Lorentz transformation.
#![allow(clippy::unwrap_used, reason = "a failed construction is a failed test")]

use exact_reference::random::{direction, seeded};
use glam::{DAffine3, DQuat, DVec2, DVec3, Vec2, Vec3};
use physics::{Beta, Celerity, Event, Observer};
use rand::RngExt;
use rand_chacha::ChaCha8Rng;
use scene::cut::{Cut, CutFineness, CutViewpoint};
use scene::motion::{Animated, ChainLink, Keyed, Motion, ObservedBody, Track, TrackKeys, Uniform};
use scene::refine::refine;
use scene::{Lighting, Material, Mesh, Scene};
use std::collections::HashMap;
use std::f64::consts::{FRAC_PI_2, TAU};
use std::sync::Arc;
use std::sync::atomic::AtomicBool;
use system_tests::bodies::sphere;
use system_tests::photographer::{AS_GIVEN, DEFAULT_MAP, Photographer};
use system_tests::view::{View, middle};
use trace::RayTracer;
use view::{Dial, Effects};

const SIZE: [u32; 2] = [320, 240];

/// Accuracy that the program promises, in metres and in D.
const EXACT: f64 = 1e-9;

/// Largest distance in pixels between a small body's centre of gravity and the exact place of its middle.
const GRAVITY_PX: f64 = 0.25;

/// Relative tolerance of light: the table's own error, f32, and D between vertices.
const LIGHT_TOLERANCE: f64 = 0.004;

/// Speed of light in the worlds here, m/s.
const SPEED_OF_LIGHT: f64 = 10.0;

const ADAPTIVE: Dial = Dial::tolerance(0.05);

/// Body whose worldlines are known in closed form: place and v/c of a point of it at world time `ct`.
struct KnownBody {
    motion: Motion,
    at: fn(DVec3, f64) -> (DVec3, DVec3),
}

/// Middle of the circle, then its period in seconds.
const CENTRE: DVec3 = DVec3::new(2.0, 1.0, -12.0);
const PERIOD_S: f64 = 4.0;

/// Body on a node that turns once about the vertical, evenly, in four seconds.
fn circling() -> KnownBody {
    let turn = |quarter: u32| DQuat::from_rotation_y(FRAC_PI_2 * f64::from(quarter));
    let times = (0..=4).map(|quarter| 0.25 * PERIOD_S * f64::from(quarter)).collect();
    let keys = TrackKeys::slerp(times, (0..=4).map(turn).collect()).unwrap();
    let keys = keys.repeating([0.0, PERIOD_S], -DQuat::IDENTITY);
    let node =
        Keyed { translation: Track::Fixed(DVec3::ZERO), rotation: Track::Keyed(keys), scale: Track::Fixed(DVec3::ONE) };
    let links = vec![ChainLink::Fixed(DAffine3::from_translation(CENTRE)), ChainLink::Keyed(node)];
    let motion = Motion::Animated(Arc::new(Animated::new("carousel", links)));
    let at = |place: DVec3, ct: f64| {
        let rate = TAU / (PERIOD_S * SPEED_OF_LIGHT);
        let (sine, cosine) = (rate * ct).sin_cos();
        let turned = DVec3::new(cosine * place.x + sine * place.z, place.y, cosine * place.z - sine * place.x);
        (CENTRE + turned, rate * DVec3::new(turned.z, 0.0, -turned.x))
    };
    KnownBody { motion, at }
}

/// Length c²/a of the hyperbola, then the place of its turning point.
const LENGTH_M: f64 = 10.0;
const TURN: DVec3 = DVec3::new(-3.0, 0.5, -8.0);

/// Body that moves along x with constant proper acceleration, with a key every centimetre of light travel.
fn accelerated() -> KnownBody {
    let cts: Vec<f64> = (-6000..=2000).map(|step| f64::from(step) * 0.01).collect();
    let root = |ct: f64| ct.hypot(LENGTH_M);
    let times = cts.iter().map(|ct| ct / SPEED_OF_LIGHT).collect();
    let values = cts.iter().map(|&ct| TURN + DVec3::X * (root(ct) - LENGTH_M)).collect();
    let velocity = |ct: &f64| DVec3::X * (ct / root(*ct) * SPEED_OF_LIGHT);
    let keys = TrackKeys::<DVec3>::cubic(times, values, cts.iter().map(|ct| [velocity(ct); 2]).collect()).unwrap();
    let node = Keyed {
        translation: Track::Keyed(keys),
        rotation: Track::Fixed(DQuat::IDENTITY),
        scale: Track::Fixed(DVec3::ONE),
    };
    let motion = Motion::Animated(Arc::new(Animated::new("rocket", vec![ChainLink::Keyed(node)])));
    let at = |place: DVec3, ct: f64| {
        let root = ct.hypot(LENGTH_M);
        (TURN + DVec3::X * (root - LENGTH_M) + place, DVec3::X * (ct / root))
    };
    KnownBody { motion, at }
}

fn at(beta: DVec3) -> Celerity {
    Beta::new(beta).unwrap().celerity()
}

/// World time at which the light left by which the observer sees a point of known position, by bisection.
fn light_left(observer: &Observer, position: impl Fn(f64) -> DVec3) -> f64 {
    let lag = |ct: f64| (observer.event.ct - ct) - position(ct).distance(observer.event.position);
    let (mut early, mut late) = (observer.event.ct - 1000.0, observer.event.ct);
    for _ in 0..200 {
        let middle = 0.5 * (early + late);
        if lag(middle) > 0.0 { early = middle } else { late = middle }
    }
    0.5 * (early + late)
}

/// Exact apparent position and D of a point of a body.
fn expected(observer: &Observer, known: &KnownBody, place: DVec3) -> (DVec3, f64) {
    let ct = light_left(observer, |ct| (known.at)(place, ct).0);
    let (position, velocity) = (known.at)(place, ct);
    let towards = position - observer.event.position;
    let (u, gamma) = (observer.celerity.vector(), observer.celerity.gamma());
    // r' = r + u (u·r)/(γ + 1) − u t, with t = −|r|.
    let apparent = towards + u * (u.dot(towards) / (gamma + 1.0) + towards.length());
    let n = towards.normalize();
    let sent = (1.0 + velocity.dot(n)) / (1.0 - velocity.length_squared()).sqrt();
    (apparent, (gamma + u.dot(n)) / sent)
}

/// Random observer in front of both bodies, at rest or moving.
fn somebody(random: &mut ChaCha8Rng) -> Observer {
    let mut number = |from: f64, to: f64| random.random_range(from..to);
    let position = DVec3::new(number(-4.0, 4.0), number(-2.0, 3.0), number(-3.0, 6.0));
    let ct = number(-3.0, 12.0);
    let speed = if number(0.0, 1.0) < 0.3 { 0.0 } else { number(0.0, 2.0) };
    Observer { event: Event { ct, position }, celerity: Celerity::new(direction(random) * speed).unwrap() }
}

/// Sphere of triangles, with motion 0.
fn ball(middle: DVec3, radius: f64, fineness: f32) -> Mesh {
    let mut mesh = sphere(DVec3::ZERO, fineness).meshes.remove(0);
    mesh.positions.iter_mut().for_each(|place| *place = (middle + radius * place.as_dvec3()).as_vec3());
    mesh.motion = Some(0);
    mesh
}

fn unlit() -> Scene {
    let light = Lighting { shadows: false, ..Lighting::default() };
    Scene { materials: vec![Material { unlit: true, ..Material::default() }], light, ..Scene::default() }
}

fn scene(motion: &Motion, mesh: Mesh) -> Scene {
    let mut scene = Scene { meshes: vec![mesh], motions: vec![motion.clone()], ..unlit() };
    scene.set_speed_of_light(SPEED_OF_LIGHT).unwrap();
    scene
}

fn animated(scene: &Scene) -> &Arc<Animated> {
    scene.motions[0].animated().unwrap()
}

#[test]
fn each_vertex_is_seen_at_its_own_retarded_event() {
    let mut random = seeded(31);
    let mut worst = [0.0_f64; 2];
    for (known, middle) in [(circling(), DVec3::X * 3.0), (accelerated(), DVec3::ZERO)] {
        let scene = scene(&known.motion, ball(middle, 0.5, 0.9));
        for _ in 0..200 {
            let who = somebody(&mut random);
            let course = ObservedBody::new(animated(&scene), &who);
            for place in scene.meshes[0].positions.iter().map(|place| place.as_dvec3()) {
                let (apparent, doppler) = expected(&who, &known, place);
                let seen = course.seen(place).unwrap();
                worst[0] = worst[0].max(seen.apparent.distance(apparent));
                worst[1] = worst[1].max((seen.doppler / doppler - 1.0).abs());
            }
        }
    }
    println!("vertices: {:.1e} m, D {:.1e}", worst[0], worst[1]);
    assert!(worst[0] < EXACT && worst[1] < EXACT, "{worst:?}");
}

#[test]
fn a_ray_meets_the_event_where_the_body_was() {
    let mut random = seeded(32);
    let mut worst = [0.0_f64; 2];
    let mut hits = 0;
    for (known, middle_of_body) in [(circling(), DVec3::X * 3.0), (accelerated(), DVec3::ZERO)] {
        let scene = scene(&known.motion, ball(middle_of_body, 1.0, 0.7));
        let tracer = RayTracer::new(scene, None, true).unwrap();
        for _ in 0..12 {
            let who = somebody(&mut random);
            let (look, _) = expected(&who, &known, middle_of_body);
            let fov_degrees = (4.0 / look.length()).to_degrees().clamp(4.0, 100.0);
            let view = View { look, up: DVec3::new(0.1, 1.0, 0.2), fov_degrees, size: [40, 30] };
            let places = tracer.places(&view.shot(&who, Effects::ALL), view.size);
            for place in places.into_iter().flatten() {
                let (apparent, doppler) = expected(&who, &known, place.position);
                worst[0] = worst[0].max(place.apparent.distance(apparent));
                worst[1] = worst[1].max((place.doppler / doppler - 1.0).abs());
                hits += 1;
            }
        }
    }
    println!("rays: {:.1e} m, D {:.1e}, {hits} hits", worst[0], worst[1]);
    assert!(hits > 4000, "{hits} hits");
    assert!(worst[0] < EXACT && worst[1] < EXACT, "{worst:?}");
}

#[test]
fn a_wheel_is_cut_until_it_bends_and_has_no_cracks() {
    // Two halves of a square plate about the axis, of one triangle pair each; its corners move at 0.85 c.
    let known = circling();
    let half = 0.85 * PERIOD_S * SPEED_OF_LIGHT / TAU / 2.0_f64.sqrt();
    let plate = |from: f64, to: f64| Mesh {
        positions: [(from, -half), (from, half), (to, half), (to, -half)]
            .map(|(x, z)| DVec3::new(x, 0.0, z).as_vec3())
            .to_vec(),
        normals: vec![Vec3::Y; 4],
        uvs: vec![Vec2::ZERO; 4],
        colours: vec![[1.0; 4]; 4],
        indices: vec![0, 1, 2, 0, 2, 3],
        motion: Some(0),
        ..Mesh::default()
    };
    let mut scene = scene(&known.motion, plate(-half, 0.0));
    scene.meshes.push(plate(0.0, half));
    let mut random = seeded(33);
    for beta in [DVec3::ZERO, DVec3::new(0.1, 0.3, -0.6)] {
        let who = Observer { event: Event { ct: 1.0, position: DVec3::new(0.0, 5.0, 0.0) }, celerity: at(beta) };
        let (look, _) = expected(&who, &known, DVec3::ZERO);
        let view = View { look, up: DVec3::Y, fov_degrees: 60.0, size: SIZE };
        let viewpoint = CutViewpoint::new(who, view.camera(), SIZE);
        let fineness = CutFineness { tolerance_px: 0.5, turn_rad: 0.0, triangles: 1_000_000 };
        let cut = Cut::new(&scene, &viewpoint, fineness, None);
        assert!(cut.tolerance_px == 0.5 && cut.triangles > 100, "{} triangles", cut.triangles);
        let mut edges = HashMap::<[[u64; 3]; 2], u32>::new();
        let mut worst = 0.0_f64;
        for (cut, mesh) in cut.meshes.iter().zip(&scene.meshes) {
            for corners in cut.indices(mesh).chunks_exact(3) {
                let corners = [0, 1, 2].map(|corner: usize| cut.place(mesh, corners[corner] as usize));
                // Inside the plate two triangles share an edge, on the rim an edge belongs to one.
                for (a, b) in [(0, 1), (1, 2), (2, 0)] {
                    let mut ends = [corners[a], corners[b]].map(|end| end.to_array().map(f64::to_bits));
                    ends.sort_unstable();
                    *edges.entry(ends).or_default() += 1;
                }
                let (a, b): (f64, f64) = (random.random_range(0.0..1.0), random.random_range(0.0..1.0));
                let shares = [a.min(b), (a - b).abs(), 1.0 - a.max(b)];
                let mean = |of: [DVec3; 3]| of[0] * shares[0] + of[1] * shares[1] + of[2] * shares[2];
                let drawn = mean(corners.map(|corner| expected(&who, &known, corner).0));
                let seen = expected(&who, &known, mean(corners)).0;
                let inside = |at: DVec2| at.cmpgt(DVec2::ZERO).all() && at.x < 320.0 && at.y < 240.0;
                if view.look.dot(seen) > 0.0 && inside(pixel(&view, seen)) {
                    worst = worst.max(pixel(&view, seen).distance(pixel(&view, drawn)));
                }
            }
        }
        let on_rim = |end: [u64; 3]| {
            let place = DVec3::from_array(end.map(f64::from_bits)).as_vec3().abs();
            place.x.max(place.z) >= half as f32
        };
        for (ends, count) in edges {
            let cracked = count != 2 && !ends.into_iter().all(on_rim);
            assert!(!cracked, "{count} triangles have the edge {:?}", ends.map(|end| end.map(f64::from_bits)));
        }
        println!("wheel seen at {beta}: {} triangles, {worst:.2} pixels off", cut.triangles);
        assert!(worst < 0.5, "{worst} pixels off");
    }
}

/// Mean place of the bright pixels, pixels from the upper left corner.
fn centre_of_gravity(brightness: impl Iterator<Item = f64>) -> DVec2 {
    let (mut sum, mut weight) = (DVec2::ZERO, 0.0);
    for (index, bright) in brightness.enumerate() {
        let (column, row) = (index as u32 % SIZE[0], index as u32 / SIZE[0]);
        sum += bright * DVec2::from_array(middle([column, row]));
        weight += bright;
    }
    sum / weight
}

/// Place of a direction in the picture, pixels.
fn pixel(view: &View, seen: DVec3) -> DVec2 {
    let eye = view.camera().observer_from_eye.conjugate() * seen;
    let at = eye.truncate() / -eye.z * view.focal_length();
    DVec2::new(0.5 * f64::from(SIZE[0]) + at.x, 0.5 * f64::from(SIZE[1]) - at.y)
}

#[test]
fn a_small_body_that_circles_is_drawn_where_it_was() {
    let known = circling();
    let place = DVec3::X * 3.0;
    let scene = scene(&known.motion, ball(place, 0.12, 0.2));
    let tracer = RayTracer::new(scene.clone(), Some([0.0; 3]), false).unwrap();
    for beta in [DVec3::ZERO, DVec3::new(0.3, 0.2, -0.4)] {
        let who = Observer { event: Event { ct: 0.0, position: DVec3::new(1.0, 2.0, 0.0) }, celerity: at(beta) };
        let (apparent, _) = expected(&who, &known, place);
        // Look beside the body, so that a program whose bodies follow the camera fails.
        let look = apparent.normalize() + DVec3::new(0.1, 0.06, 0.0);
        let view = View { look, up: DVec3::Y, fov_degrees: 30.0, size: SIZE };
        let exact = pixel(&view, apparent);
        let present = pixel(&view, (known.at)(place, 0.0).0 - who.event.position);
        assert!(exact.distance(present) > 50.0, "the test tells nothing: {exact} {present}");
        let bright = |rgb: [f32; 3]| f64::from(rgb[1]);
        let mut found = Vec::new();
        for method in [ADAPTIVE, AS_GIVEN, DEFAULT_MAP] {
            let mut photographer = Photographer::with(&scene, SIZE, 16, Some([0.0; 3]), method);
            let light = photographer.light(&view, who.event.position, who.celerity, Effects::GEOMETRY);
            found.push(centre_of_gravity(light.pixels().map(|pixel| bright(pixel.0))));
        }
        let traced = tracer.trace(&view.shot(&who, Effects::GEOMETRY), SIZE, 16, &AtomicBool::new(false), || {});
        found.push(centre_of_gravity(traced.light.iter().map(|light| light.y)));
        println!("{beta}: exact {exact}, found {found:?}");
        assert!(found.iter().all(|found| found.distance(exact) < GRAVITY_PX), "{exact}: {found:?}");
        // If light takes no time, the body is at its present place.
        let mut photographer = Photographer::with(&scene, SIZE, 16, Some([0.0; 3]), ADAPTIVE);
        let towards = (known.at)(place, 0.0).0 - who.event.position;
        let view = View { look: towards + DVec3::X, ..view };
        let plain = photographer.light(&view, who.event.position, who.celerity, Effects::NONE);
        let traced = tracer.trace(&view.shot(&who, Effects::NONE), SIZE, 16, &AtomicBool::new(false), || {});
        for found in [
            centre_of_gravity(plain.pixels().map(|pixel| bright(pixel.0))),
            centre_of_gravity(traced.light.iter().map(|light| light.y)),
        ] {
            assert!(found.distance(pixel(&view, towards)) < GRAVITY_PX, "{found} {}", pixel(&view, towards));
        }
    }
}

/// Grey box about the origin.
fn cuboid(half: DVec3) -> Mesh {
    let mut mesh = Mesh { motion: Some(0), ..Mesh::default() };
    for axis in [DVec3::X, DVec3::Y, DVec3::Z] {
        for normal in [axis, -axis] {
            let side = normal.any_orthonormal_vector();
            let other = normal.cross(side);
            let first = mesh.positions.len() as u32;
            for (a, b) in [(-1.0, -1.0), (1.0, -1.0), (1.0, 1.0), (-1.0, 1.0)] {
                mesh.positions.push((half * (normal + a * side + b * other)).as_vec3());
            }
            mesh.normals.extend([normal.as_vec3(); 4]);
            mesh.colours.extend([[0.5, 0.4, 0.3, 1.0]; 4]);
            mesh.indices.extend([0, 1, 2, 0, 2, 3].map(|corner| first + corner));
        }
    }
    mesh.uvs = vec![Vec2::ZERO; mesh.positions.len()];
    mesh
}

#[test]
fn what_moves_evenly_by_keys_looks_like_what_has_a_celerity() {
    let celerity = at(DVec3::X * 0.8);
    let anchor = Event { ct: -11.0, position: DVec3::new(-2.0, 0.5, -9.0) };
    let (from, to) = (-200.0, 200.0);
    let place = |ct: f64| anchor.position + celerity.beta().vector() * (ct - anchor.ct);
    let keys =
        TrackKeys::linear(vec![from / SPEED_OF_LIGHT, to / SPEED_OF_LIGHT], vec![place(from), place(to)]).unwrap();
    let node = Keyed {
        translation: Track::Keyed(keys),
        rotation: Track::Fixed(DQuat::IDENTITY),
        scale: Track::Fixed(DVec3::ONE),
    };
    let by_keys = Motion::Animated(Arc::new(Animated::new("train", vec![ChainLink::Keyed(node)])));
    let has_celerity = Motion::Uniform(Uniform { celerity, anchor });
    // Keys give the places of all points in the world, where the box is contracted.
    let half = DVec3::new(1.0, 0.8, 1.2);
    let across = DVec3::new(0.2, 0.3, 0.4);
    for (lit, beta) in [(false, across), (true, across), (true, DVec3::ZERO)] {
        let material = Material { unlit: !lit, ..Material::default() };
        let shorter = scene(&by_keys, cuboid(half / DVec3::new(celerity.gamma(), 1.0, 1.0)));
        let shorter = Scene { materials: vec![material.clone()], ..shorter };
        let own = Scene { materials: vec![material], origin: anchor.position, ..scene(&has_celerity, cuboid(half)) };
        let who = Observer { event: Event { ct: 0.0, position: DVec3::ZERO }, celerity: at(beta) };
        let look = ObservedBody::new(animated(&shorter), &who).seen(DVec3::ZERO).unwrap().apparent;
        let view = View { look, up: DVec3::Y, fov_degrees: 35.0, size: SIZE };
        let mut pictures: Vec<Vec<DVec3>> = Vec::new();
        for scene in [&shorter, &own] {
            for method in [ADAPTIVE, AS_GIVEN, DEFAULT_MAP] {
                let fine = if method == AS_GIVEN { refine(scene, 0.05).unwrap() } else { scene.clone() };
                let mut photographer = Photographer::with(&fine, SIZE, 1, Some([0.0; 3]), method);
                let light = photographer.light(&view, who.event.position, who.celerity, Effects::ALL);
                pictures.push(light.pixels().map(|pixel| Vec3::from_array(pixel.0).as_dvec3()).collect());
            }
            let tracer = RayTracer::new(scene.clone(), Some([0.0; 3]), false).unwrap();
            let shot = view.shot(&who, Effects::ALL);
            pictures.push(tracer.trace(&shot, SIZE, 1, &AtomicBool::new(false), || {}).light);
        }
        let reference = pictures.pop().unwrap();
        let shown = reference.iter().filter(|light| **light != DVec3::ZERO).count();
        assert!(shown > 2000, "{shown} pixels");
        for (number, picture) in pictures.iter().enumerate() {
            let mut outline = 0;
            let mut worst = 0.0_f64;
            for (&found, &expected) in picture.iter().zip(&reference) {
                let off = (found - expected).length() / expected.length().max(1e-9);
                // A pixel at an edge may show the other of two faces.
                if off > 0.05 { outline += 1 } else { worst = worst.max(off) }
            }
            println!("lit {lit}, {beta}, picture {number}: {worst:.1e} off, {outline} of {shown} at edges");
            assert!(worst < LIGHT_TOLERANCE, "picture {number}, lit {lit}, {beta}: light off by {worst}");
            assert!(outline < shown / 50, "picture {number}, lit {lit}, {beta}: {outline} pixels differ");
        }
    }
}
