//! Among bodies at rest and in motion, every renderer must show what a ray meets first, with its light and in its
//! place. Along one line of sight the nearer apparent position sent its light later, so it hides the others, at rest
//! or in motion.
//!
//! In a wrong program, bodies pass in front of what hides them, or behind what they hide, if depths of different
//! frames are compared; or places are off by minutes of arc. (Lattice and town are the other two scenes:
//! `raytrace.rs`, `directions.rs`.)
#![allow(clippy::unwrap_used, reason = "a failed construction is a failed test")]

use built_in::lattice::Lattice;
use glam::DVec3;
use image::Rgb32FImage;
use measure::direction;
use physics::apparent::at_rest;
use physics::{Celerity, Observer};
use scene::motion::{Motion, Uniform};
use scene::{Material, Mesh, Scene};
use studio::Shown;
use system_tests::bodies::{cuboid, exact, observer, passing, sphere, unlit};
use system_tests::photographer::{DEFAULT_MAP, Photographer, RAYS};
use system_tests::view::{View, middle};
use view::{Dial, Effects};

const SIZE: [u32; 2] = [320, 240];

/// Polygons cut for a twentieth of a pixel, which is less than shows.
const POLYGON: Dial = Dial::tolerance(0.05);

/// Relative tolerance of light: a larger difference means another surface, or its outline.
const ALIKE: f64 = 0.01;

/// Shares of the pixels that must be alike: all but outlines, and a little less for a map with eight texels to the
/// pixel.
const SHARES: [f64; 2] = [0.99, 0.985];

/// Largest ratio of pixels with a wrong motion to pixels with a moving body: outlines of bodies some ten pixels wide.
const WRONG: f64 = 0.03;

/// Tenth of the smallest error that other programs' formulas have at γ = 701, arcminutes; the limit for 99 of 100
/// pixels.
const TENTH_OF_OTHERS_ARCMIN: f64 = 1.2;

/// Smallest number of pixels hidden, either way, for the test to be worth having.
const HIDDEN: usize = 40;

/// A scene, with the motions from which it was made.
struct MixedScene {
    scene: Scene,
    motions: Vec<Uniform>,
}

impl MixedScene {
    /// Puts moving meshes, each relative to its motion's anchor, among the resting ones.
    fn new(mut scene: Scene, moving: Vec<(Mesh, Uniform)>) -> Self {
        let motions: Vec<Uniform> = moving.iter().map(|(_, motion)| *motion).collect();
        for (number, (mut mesh, motion)) in moving.into_iter().enumerate() {
            let offset = (motion.anchor.position - scene.origin).as_vec3();
            mesh.positions.iter_mut().for_each(|position| *position += offset);
            mesh.motion = Some(number);
            scene.meshes.push(mesh);
        }
        scene.motions = motions.iter().copied().map(Motion::Uniform).collect();
        Self { scene, motions }
    }

    /// Scene with only the moving meshes (`moves` is true), or only the resting ones.
    fn part(&self, moves: bool) -> Scene {
        let mut scene = self.scene.clone();
        scene.meshes.retain(|mesh| mesh.motion.is_some() == moves);
        scene
    }

    /// Exact apparent position of a place that is shown.
    fn apparent(&self, who: &Observer, shown: &Shown) -> DVec3 {
        let place = shown.position + self.scene.origin;
        match shown.motion {
            Some(motion) => exact(who, &self.motions[motion], place).position,
            None => at_rest(who, place).position,
        }
    }

    /// Compares the light of both renderers with rays, and their directions with worldlines.
    fn hold(&self, who: &Observer, look: DVec3) {
        let view = View { look, up: DVec3::Y, fov_degrees: 60.0, size: SIZE };
        let (eye, celerity) = (who.event.position, who.celerity);
        let take = |scene: &Scene, by| Photographer::with(scene, SIZE, 1, None, by);
        let traced = take(&self.scene, RAYS).light(&view, eye, celerity, Effects::ALL);
        let met = self.met(&view, who);

        for (method, share) in [POLYGON, DEFAULT_MAP].into_iter().zip(SHARES) {
            let mut photographer = take(&self.scene, method);
            let drawn = photographer.light(&view, eye, celerity, Effects::ALL);
            let places = photographer.places(&view, eye, celerity);
            let pixels = (0..SIZE[1]).flat_map(|row| (0..SIZE[0]).map(move |column| [column, row]));
            let seen = pixels.zip(&places).filter_map(|(pixel, shown)| {
                Some((view.direction(middle(pixel)), self.apparent(who, shown.as_ref()?)))
            });
            let errors = direction::between(seen);
            let alike = alike(&drawn, &traced);
            let moves = |shown: &Option<Shown>| shown.and_then(|shown| shown.motion);
            let moving = met.iter().filter(|shown| moves(shown).is_some()).count();
            let wrong = met.iter().zip(&places).filter(|(met, shown)| moves(met) != moves(shown)).count();
            let what = format!(
                "{method}, observer at {celerity:?} towards {look}: {alike:.4} alike; {moving} of {} pixels move, {wrong} wrongly; \
                 99 % within {:.3}′, all {:.3}′",
                errors.count(),
                errors.quantile(0.99),
                errors.quantile(1.0),
            );
            println!("{what}");
            assert!(alike >= share, "{what}");
            assert!(wrong as f64 <= WRONG * moving as f64, "{what}");
            assert!(errors.count() > 2000 && errors.quantile(0.99) <= TENTH_OF_OTHERS_ARCMIN, "{what}");
        }
    }

    /// Places that rays meet first. Among them must be resting surfaces that hide moving ones, and moving ones that
    /// hide resting ones.
    fn met(&self, view: &View, who: &Observer) -> Vec<Option<Shown>> {
        let places = |scene: &Scene| {
            let mut photographer = Photographer::with(scene, SIZE, 1, None, RAYS);
            photographer.places(view, who.event.position, who.celerity)
        };
        let [all, resting, moving] =
            [self.scene.clone(), self.part(false), self.part(true)].map(|scene| places(&scene));
        let shown = |shown: &Option<Shown>| shown.map(|shown| shown.motion.is_some());
        let mut hidden = [0, 0];
        for ((all, resting), moving) in all.iter().zip(&resting).zip(&moving) {
            if let (Some(moves), Some(_), Some(_)) = (shown(all), shown(resting), shown(moving)) {
                hidden[usize::from(moves)] += 1;
            }
        }
        println!("{hidden:?} pixels where what rests hides what moves, and the other way round");
        assert!(hidden.iter().all(|&count| count > HIDDEN), "{hidden:?}");
        all
    }
}

/// Share of pixels whose channels differ by little compared with the brighter one's largest.
fn alike(one: &Rgb32FImage, other: &Rgb32FImage) -> f64 {
    let is_alike = |(one, other): &(&image::Rgb<f32>, &image::Rgb<f32>)| {
        let channels = || one.0.into_iter().zip(other.0).map(|(a, b)| (f64::from(a), f64::from(b)));
        let largest = channels().map(|(a, b)| a.abs().max(b.abs())).fold(0.0, f64::max);
        channels().all(|(a, b)| (a - b).abs() <= ALIKE * largest)
    };
    one.pixels().zip(other.pixels()).filter(is_alike).count() as f64 / f64::from(SIZE[0] * SIZE[1])
}

fn ball(radius: f32) -> Mesh {
    let mut mesh = sphere(DVec3::ZERO, 0.2).meshes.remove(0);
    mesh.positions.iter_mut().for_each(|position| *position *= radius);
    mesh
}

fn along(gamma: f64) -> Celerity {
    Celerity::new(DVec3::NEG_Z * (gamma * gamma - 1.0).sqrt()).unwrap()
}

/// Lattice around the eye, with boxes and balls that fly through its alleys, in front of its boxes and behind them.
fn lattice(eye: DVec3) -> MixedScene {
    let mut scene = Lattice { count: [6, 6, 6], spacing: 4.0, side: 1.0 }.build();
    // One of the balls is lit by shifted daylight.
    scene.materials.push(Material { base_colour: [0.7, 0.5, 0.3, 1.0], ..Material::default() });
    scene.light = Default::default();
    scene.light.shadows = false;
    let fly = |mesh: Mesh, beta: DVec3, place: DVec3| (mesh, passing(beta, place, eye));
    let mut lit = ball(1.0);
    lit.material = 1;
    let moving = vec![
        fly(cuboid(DVec3::ZERO, 0.7, 0), DVec3::X * 0.9, DVec3::new(1.6, 1.5, -3.9)),
        fly(lit, DVec3::X * -0.9, DVec3::new(3.6, 4.0, -8.5)),
        fly(ball(1.2), DVec3::new(0.1, 0.5, -0.3), DVec3::new(-3.5, -3.4, -8.0)),
        fly(cuboid(DVec3::ZERO, 0.5, 0), DVec3::Z * 0.6, DVec3::new(-1.0, 0.4, -5.0)),
        // These two pass abeam.
        fly(cuboid(DVec3::ZERO, 0.6, 0), DVec3::Y * -0.5, DVec3::new(3.9, 1.4, 4.5)),
        fly(ball(1.2), DVec3::Z * 0.7, DVec3::new(-6.6, 4.8, 2.3)),
        // These two are astern.
        fly(cuboid(DVec3::ZERO, 0.7, 0), DVec3::Y * 0.9, DVec3::new(0.9, 0.5, 8.0)),
        fly(ball(1.0), DVec3::X * -0.9, DVec3::new(3.8, 3.5, 12.5)),
    ];
    MixedScene::new(scene, moving)
}

#[test]
fn what_moves_hides_and_is_hidden_as_rays_see_it() {
    let eye = DVec3::new(0.3, 0.4, 2.0);
    let world = lattice(eye);
    for gamma in [1.0, 2.3, 7.1] {
        world.hold(&observer(eye, along(gamma)), DVec3::NEG_Z);
    }
    world.hold(&observer(eye, along(1.25)), DVec3::Z);
}

#[test]
fn the_same_holds_astern_at_gamma_701() {
    // Ahead of such an observer everything appears that lies further than a quarter of a degree from astern. The test
    // things are some centimetres large, and enlarged some hundred times.
    let eye = DVec3::new(2.0, 1.0, -3.0);
    let wall = |half: f64, x: f64, y: f64, z: f64| {
        let mut mesh = cuboid(DVec3::new(x, y, z), half, 0);
        mesh.motion = None;
        mesh
    };
    let behind = DVec3::Z * 1.6;
    let resting = vec![wall(0.01, 0.012, 0.0, 0.0), wall(0.02, -0.03, 0.01, 0.0), wall(0.3, 0.0, 0.0, 2.8)];
    let scene = Scene { origin: eye + behind, ..unlit(resting, &[]) };
    let fly = |mesh: Mesh, beta: DVec3, x: f64, y: f64, z: f64| {
        (mesh, passing(beta, scene.origin + DVec3::new(x, y, z), eye))
    };
    let moving = vec![
        fly(cuboid(DVec3::ZERO, 0.004, 0), DVec3::X * 0.9, 0.004, 0.005, -0.6),
        fly(ball(0.02), DVec3::X * -0.9, 0.02, -0.012, 1.0),
        fly(cuboid(DVec3::ZERO, 0.012, 0), DVec3::new(0.0, 0.4, 0.3), -0.04, 0.03, 0.8),
    ];
    MixedScene::new(scene, moving).hold(&observer(eye, along(701.0)), DVec3::NEG_Z);
}

#[test]
fn a_finger_before_a_wall_is_seen_and_a_finger_behind_it_is_not() {
    const GAP_M: f64 = 0.02;
    let eye = DVec3::new(0.0, 0.2, 0.5);
    let view = View { look: DVec3::new(0.2, 0.1, -1.0), up: DVec3::Y, fov_degrees: 60.0, size: SIZE };
    for (offset, seen) in [(GAP_M, true), (-GAP_M, false)] {
        // The near face of the box is that far in front of the wall's, or behind it.
        let mut wall = cuboid(DVec3::NEG_Z * 108.0, 100.0, 0);
        wall.motion = None;
        let motion = passing(DVec3::X * 0.6, DVec3::new(1.0, 0.3, -9.0 + offset), eye);
        let world = MixedScene::new(unlit(vec![wall], &[]), vec![(cuboid(DVec3::ZERO, 1.0, 0), motion)]);
        for method in [POLYGON, DEFAULT_MAP] {
            let mut photographer = Photographer::with(&world.scene, SIZE, 1, None, method);
            for gamma in [1.0, 1.25, 2.3] {
                // The sides of the box are in the wall.
                let face = -8.0 + offset - 0.5 * GAP_M;
                let in_front = |shown: &&Shown| shown.motion.is_some() && shown.position.z > face;
                let count = |places: Vec<Option<Shown>>| places.iter().flatten().filter(in_front).count();
                let found = count(photographer.places(&view, eye, along(gamma)));
                let mut alone = Photographer::with(&world.part(true), SIZE, 1, None, RAYS);
                let whole = count(alone.places(&view, eye, along(gamma)));
                assert!(whole > 50, "γ = {gamma}: {whole} pixels of it");
                let (least, most) = if seen { (0.98 * whole as f64, 1.02 * whole as f64) } else { (0.0, 0.0) };
                let what = format!("{method}, γ = {gamma}, {offset} m before: {found} of {whole} pixels");
                println!("{what}");
                assert!((least..=most).contains(&(found as f64)), "{what}");
            }
        }
    }
}
