//! Mirrors and glass must obey their laws in the frame in which they rest. So a receding mirror reddens its image by
//! (1 − β)/(1 + β), and shows it under the angle that Einstein found in 1905. A pane at rest displaces a ray by
//! Snell's law and reflects by Fresnel's equations.
//!
//! In a wrong program, the law of reflection in the world's frame puts an image at the wrong height; one Doppler
//! factor in place of two gives the wrong brightness; the mirror's present place, instead of the place where the
//! light met it, gives both errors.
#![allow(clippy::unwrap_used, reason = "a failed construction is a failed test")]

use glam::{DQuat, DVec3, Vec2, Vec3};
use physics::{Beta, Event, Observer};
use scene::motion::{Animated, ChainLink, Keyed, Motion, Track, TrackKeys, Uniform};
use scene::{Material, Mesh, Scene};
use std::sync::Arc;
use std::sync::atomic::AtomicBool;
use system_tests::view::{View, middle};
use trace::{RayTracer, Traced};
use view::Effects;

const SIZE: [u32; 2] = [64, 64];

/// Relative tolerance of light after two boosts and four powers of D, with colours in f32.
const LIGHT_TOLERANCE: f64 = 1e-5;

/// Colours of the wall below and above its edge.
const WALL: [[f32; 3]; 2] = [[0.5, 0.25, 0.125], [0.25, 0.5, 1.0]];

const SEARCHLIGHT: Effects = Effects { searchlight: true, ..Effects::GEOMETRY };

/// Rectangle across z, from `low` to `high` in x and y. It faces +z or, if `back` is true, −z.
fn rectangle(z: f32, low: [f32; 2], high: [f32; 2], back: bool, material: usize) -> Mesh {
    let corners = [[low[0], low[1]], [high[0], low[1]], [high[0], high[1]], [low[0], high[1]]];
    Mesh {
        positions: corners.map(|[x, y]| Vec3::new(x, y, z)).to_vec(),
        normals: vec![if back { Vec3::NEG_Z } else { Vec3::Z }; 4],
        uvs: vec![Vec2::ZERO; 4],
        colours: vec![[1.0; 4]; 4],
        indices: if back { vec![0, 2, 1, 0, 3, 2] } else { vec![0, 1, 2, 0, 2, 3] },
        material,
        ..Mesh::default()
    }
}

/// Two materials of a wall, then one that turns rays.
fn materials(turning: Material) -> Vec<Material> {
    let paint = |[red, green, blue]: [f32; 3]| Material {
        unlit: true,
        base_colour: [red, green, blue, 1.0],
        ..Material::default()
    };
    vec![paint(WALL[0]), paint(WALL[1]), turning]
}

fn wall(z: f32, edge: f32, back: bool) -> [Mesh; 2] {
    [rectangle(z, [-900.0, -900.0], [900.0, edge], back, 0), rectangle(z, [-900.0, edge], [900.0, 900.0], back, 1)]
}

fn trace(scene: Scene, view: &View, bounces: u32) -> Traced {
    let tracer = RayTracer::new(scene, Some([0.0; 3]), true).unwrap().with_bounces(bounces);
    let shot = view.shot(&Observer::default(), SEARCHLIGHT);
    tracer.trace(&shot, SIZE, 1, &AtomicBool::new(false), || {})
}

/// Checks each pixel's light. `expected` returns the height on the wall at which the ray arrives, and the brightness
/// there.
fn hold(traced: &Traced, view: &View, edge: f64, expected: impl Fn(DVec3) -> (f64, f64)) {
    let mut compared = [0; 2];
    let pixels = (0..SIZE[1]).flat_map(|row| (0..SIZE[0]).map(move |column| [column, row]));
    for (pixel, light) in pixels.zip(&traced.light) {
        let (height, brightness) = expected(view.direction(middle(pixel)));
        if (height - edge).abs() < 1e-6 {
            continue;
        }
        let side = usize::from(height > edge);
        let colour = Vec3::from_array(WALL[side]).as_dvec3() * brightness;
        let error = (*light / colour - 1.0).abs().max_element();
        assert!(error < LIGHT_TOLERANCE, "{light} instead of {colour} at {pixel:?}");
        compared[side] += 1;
    }
    assert!(compared.iter().all(|count| *count > 300), "{compared:?} pixels below and above");
}

#[test]
fn a_flying_mirror_shows_what_einstein_says() {
    const MIRROR_M: f64 = 5.0;
    const WALL_M: f64 = 3.0;
    let view = View { look: DVec3::NEG_Z, up: DVec3::Y, fov_degrees: 40.0, size: SIZE };
    // The mirror recedes, is at rest, approaches.
    for beta in [0.6, 0.0, -0.5] {
        let mirror = Material { metallic: 1.0, roughness: 0.0, ..Material::default() };
        let edge = 0.8;
        let [below, above] = wall(WALL_M as f32, edge, true);
        let mut scene = Scene {
            materials: materials(mirror),
            meshes: vec![below, above, rectangle(-(MIRROR_M as f32), [-90.0; 2], [90.0; 2], false, 2)],
            ..Scene::default()
        };
        if beta != 0.0 {
            let celerity = Beta::new(DVec3::NEG_Z * beta).unwrap().celerity();
            let anchor = Event { ct: 0.0, position: DVec3::NEG_Z * MIRROR_M };
            scene.motions = vec![Motion::Uniform(Uniform { celerity, anchor })];
            scene.meshes[2].motion = Some(0);
        }
        let expected = |direction: DVec3| {
            let cosine = -direction.z;
            let distance = MIRROR_M / (cosine + beta);
            let met = direction * distance;
            let scale = 1.0 + 2.0 * beta * cosine + beta * beta;
            let incoming = ((1.0 + beta * beta) * cosine + 2.0 * beta) / scale;
            let doppler = (1.0 - beta * beta) / scale;
            let across = DVec3::new(direction.x, direction.y, 0.0).normalize();
            let height = met.y + across.y * (WALL_M - met.z) * (1.0 - incoming * incoming).sqrt() / incoming;
            (height, doppler.powi(4))
        };
        let traced = trace(scene, &view, 1);
        hold(&traced, &view, f64::from(edge), expected);
        // In the middle the light goes straight on.
        let middle = traced.light[(SIZE[1] / 2 * SIZE[0] + SIZE[0] / 2) as usize].x / f64::from(WALL[0][0]);
        let straight = ((1.0 - beta) / (1.0 + beta)).powi(4);
        assert!((middle / straight - 1.0).abs() < 1e-3, "{middle} {straight}");
    }
}

fn pane(index_of_refraction: f32) -> Material {
    Material { transmission: 1.0, roughness: 0.0, solid_glass: true, index_of_refraction, ..Material::default() }
}

/// Share of light that a surface transmits (Fresnel's equations in their form with angles).
fn through(angle: f64, index: f64) -> f64 {
    let inner = (angle.sin() / index).asin();
    let across = ((angle - inner).sin() / (angle + inner).sin()).powi(2);
    let along = ((angle - inner).tan() / (angle + inner).tan()).powi(2);
    1.0 - 0.5 * (across + along)
}

#[test]
fn a_pane_displaces_what_is_behind_it_and_dims_it() {
    // The pane is two metres in front of the eye and a metre thick; a wall is three metres behind it.
    let (edge, index) = (0.4_f32, 1.5_f32);
    let [below, above] = wall(-6.0, edge, false);
    let (front, back) =
        (rectangle(-2.0, [-90.0; 2], [90.0; 2], false, 2), rectangle(-3.0, [-90.0; 2], [90.0; 2], true, 2));
    let scene =
        Scene { materials: materials(pane(index)), meshes: vec![below, above, front, back], ..Scene::default() };
    let view = View { look: DVec3::new(0.0, 0.1, -1.0), up: DVec3::Y, fov_degrees: 50.0, size: SIZE };
    let expected = |direction: DVec3| {
        let angle = (-direction.z).acos();
        let across = DVec3::new(direction.x, direction.y, 0.0).normalize().y;
        let inner = (angle.sin() / f64::from(index)).asin();
        let height = across * (5.0 * angle.tan() + inner.tan());
        (height, through(angle, f64::from(index)).powi(2))
    };
    hold(&trace(scene, &view, 1), &view, f64::from(edge), expected);
}

#[test]
fn glass_that_flies_through_the_picture_shifts_nothing() {
    // Light enters and leaves the glass's frame at the same angles. No change of colour or brightness is left but
    // Fresnel's, at the angle in the glass's own frame.
    let (beta, index, edge) = (0.6, 1.5_f32, 0.4_f32);
    let [below, above] = wall(-60.0, edge, false);
    let (mut front, mut back) =
        (rectangle(-2.0, [-90.0; 2], [90.0; 2], false, 2), rectangle(-3.0, [-90.0; 2], [90.0; 2], true, 2));
    (front.motion, back.motion) = (Some(0), Some(0));
    let celerity = Beta::new(DVec3::NEG_Z * beta).unwrap().celerity();
    let motions = vec![Motion::Uniform(Uniform { celerity, anchor: Event { ct: 0.0, position: DVec3::NEG_Z * 2.0 } })];
    let meshes = vec![below, above, front, back];
    let scene = Scene { materials: materials(pane(index)), meshes, motions, ..Scene::default() };
    let view = View { look: DVec3::NEG_Z, up: DVec3::Y, fov_degrees: 20.0, size: SIZE };
    let expected = |direction: DVec3| {
        // Angle in the glass's frame, which recedes: cos θ' = (cos θ + β)/(1 + β cos θ).
        let cosine = -direction.z;
        let own = (cosine + beta) / (1.0 + beta * cosine);
        let angle = own.acos();
        let across = DVec3::new(direction.x, direction.y, 0.0).normalize().y;
        let inner = (angle.sin() / f64::from(index)).asin();
        // By the glass's own clock the light is inside for n / cos θ'' metres; meanwhile the glass moves on.
        let gamma = 1.0 / (1.0 - beta * beta).sqrt();
        let distance = 2.0 / (cosine + beta);
        let entered = direction * distance;
        let (in_glass, shift) = (f64::from(index) / inner.cos(), inner.tan());
        // Interval in the glass's frame, boosted, from the face where the light leaves towards the eye to the face
        // where it entered.
        let z = gamma * (-1.0 + beta * in_glass);
        let met = DVec3::new(0.0, entered.y + across * shift, entered.z + z);
        let height = met.y + across * (60.0 + met.z) * (1.0 - cosine * cosine).sqrt() / cosine;
        (height, through(angle, f64::from(index)).powi(2))
    };
    hold(&trace(scene, &view, 1), &view, f64::from(edge), expected);
}

/// Motion by keys with velocity β. The body is at its modelled place when the world's clock shows 0.
fn by_keys(beta: DVec3) -> Motion {
    const SPEED_OF_LIGHT: f64 = 10.0;
    let end_s = 40.0;
    let end = beta * (end_s * SPEED_OF_LIGHT);
    let keys = TrackKeys::linear(vec![-end_s, end_s], vec![-end, end]).unwrap();
    let node = Keyed {
        translation: Track::Keyed(keys),
        rotation: Track::Fixed(DQuat::IDENTITY),
        scale: Track::Fixed(DVec3::ONE),
    };
    Motion::Animated(Arc::new(Animated::new("slide", vec![ChainLink::Keyed(node)])))
}

/// Scene with a mirror 5 m ahead and a moving wall 3 m behind the eye.
fn mirrored(motion: Motion) -> Scene {
    let mirror = Material { metallic: 1.0, roughness: 0.0, ..Material::default() };
    let [mut below, mut above] = wall(3.0, 0.0, true);
    (below.motion, above.motion) = (Some(0), Some(0));
    let meshes = vec![below, above, rectangle(-5.0, [-90.0; 2], [90.0; 2], false, 2)];
    let mut scene = Scene { materials: materials(mirror), meshes, motions: vec![motion], ..Scene::default() };
    scene.set_speed_of_light(10.0).unwrap();
    scene
}

#[test]
fn a_mirror_shows_what_moves_by_keys_like_what_has_that_celerity() {
    // The wall moves upwards. Its edge is seen where it was when the light left it for the mirror, metres below its
    // present place.
    let beta = DVec3::Y * 0.5;
    let view = View { look: DVec3::new(0.0, -0.5, -1.0), up: DVec3::Y, fov_degrees: 60.0, size: SIZE };
    let uniform = Uniform { celerity: Beta::new(beta).unwrap().celerity(), anchor: Event::default() };
    let known = trace(mirrored(Motion::Uniform(uniform)), &view, 1);
    let traced = trace(mirrored(by_keys(beta)), &view, 1);
    for (light, known) in traced.light.iter().zip(&known.light) {
        assert!((*light / *known - 1.0).abs().max_element() < LIGHT_TOLERANCE, "{light} instead of {known}");
    }
    let blue = traced.light.iter().filter(|light| light.z > light.x).count();
    assert!((300..SIZE[0] as usize * SIZE[1] as usize - 300).contains(&blue), "{blue} pixels above the edge");
}

#[test]
fn what_is_animated_turns_no_rays() {
    let view = View { look: DVec3::NEG_Z, up: DVec3::Y, fov_degrees: 40.0, size: SIZE };
    let scene = || {
        let mut scene = mirrored(by_keys(DVec3::X * 0.1));
        scene.meshes.iter_mut().for_each(|mesh| mesh.motion = (mesh.material == 2).then_some(0));
        scene
    };
    assert_eq!(trace(scene(), &view, 1), trace(scene(), &view, 0));
}

#[test]
fn without_bounces_a_mirror_is_as_dull_as_the_other_renderers_draw_it() {
    let mirror = Material { metallic: 1.0, roughness: 0.0, ..Material::default() };
    let rough = Material { metallic: 0.0, roughness: 1.0, ..Material::default() };
    let view = View { look: DVec3::NEG_Z, up: DVec3::Y, fov_degrees: 40.0, size: SIZE };
    let scene = |material| Scene {
        materials: materials(material),
        meshes: vec![rectangle(-5.0, [-2.0; 2], [2.0; 2], false, 2)],
        ..Scene::default()
    };
    assert_eq!(trace(scene(mirror.clone()), &view, 0), trace(scene(rough), &view, 0));
    assert_ne!(trace(scene(mirror.clone()), &view, 1), trace(scene(mirror), &view, 0));
}
