//! Built-in railway: a platform with clocks, and two trains with clocks on their carriages that pass at 0.6 c and 0.8
//! c.
//!
//! The platform's clocks agree with each other in the world, those of a train aboard it. As a carriage passes one clock
//! after the other, its own falls behind by γ; and along the train each clock is behind the one that follows, for the
//! platform. The first train's clock and the platform's middle one both show [`FIRST_S`] as they meet.

use crate::clock::ClockFace;
use crate::clock::HandKind;
use crate::open_country;
use crate::shape::{FaceColour, Shape};
use crate::town::paint::dial as dial_paint;
use crate::turn::circle;
use glam::{DVec3, Vec2, Vec3, vec2, vec3};
use physics::{Beta, Event};
use scene::motion::{Motion, Uniform};
use scene::{LocalName, Material, Mesh, NamedPlace, Scene, Start, Texture, Wrap};

/// Speed of light that suits the scene, m/s: 108 km/h.
pub const SPEED_OF_LIGHT_M_S: f64 = 30.0;
/// Speed of the first train as a fraction of c, to the right.
pub const FIRST_BETA: f64 = 0.6;
/// Speed of the second train as a fraction of c, to the left.
pub const SECOND_BETA: f64 = 0.8;
/// Distance of the platform's clocks, metres: a carriage of the first train passes one each second.
pub const PLATFORM_SPACING_M: f32 = 18.0;
/// Length of a carriage and distance of the clocks aboard, metres, in the train's frame.
pub const CARRIAGE_M: f32 = 22.5;
/// World time at which the first clock of each train passes the platform's middle one, seconds.
pub const FIRST_S: f64 = 6.0;
/// World time at which the second train's first clock passes the middle of the platform, seconds.
pub const SECOND_S: f64 = 22.0;

/// Numbers of platform clocks on either side of the middle one, and of carriages.
const BESIDE: i32 = 4;
const CARRIAGES: [u32; 2] = [8, 6];
/// Sides of the trains that look at the platform, metres along z.
const SIDES: [f32; 2] = [-1.6, -6.6];
/// Depth of the tracks below the platform, metres.
const BED: f32 = -1.0;

/// Materials, in the scene's order.
const PAINTED: usize = 0;
const DIAL: usize = 1;
const HANDS: usize = 2;

const DARK: FaceColour = [0.035, 0.04, 0.05];

/// Builds the scene.
///
/// *Frames, units*: metres, y up; the tracks run along x, and the platform's floor is at height 0.
pub fn build() -> Scene {
    let mut scene = Scene {
        name: "train".to_owned(),
        textures: vec![dial_texture()],
        materials: vec![
            Material { name: "painted".to_owned(), ..Material::default() },
            Material { name: "dial".to_owned(), base_colour_texture: Some(0), ..Material::default() },
            Material { name: "hands".to_owned(), unlit: true, double_sided: true, ..Material::default() },
        ],
        light: open_country::daylight(),
        start: Start { position: DVec3::Z * 4.5, ..Start::default() },
        speed_of_light_m_s: Some(SPEED_OF_LIGHT_M_S),
        places: places(),
        ..Scene::default()
    };
    scene.meshes.extend(surroundings());
    for number in -BESIDE..=BESIDE {
        platform_clock(&mut scene, number);
    }
    for train in 0..2 {
        pass(&mut scene, train);
    }
    scene
}

/// Motion of a train, numbered from 0.
fn motion(train: usize) -> Uniform {
    let beta = [FIRST_BETA, -SECOND_BETA][train];
    let celerity = Beta::new(DVec3::X * beta).expect("slower than light").celerity();
    Uniform { celerity, anchor: Event { ct: [FIRST_S, SECOND_S][train] * SPEED_OF_LIGHT_M_S, position: DVec3::ZERO } }
}

fn dial_texture() -> Texture {
    let picture = dial_paint::picture(512);
    let (width, height, rgba) = (picture.width, picture.height, picture.rgba);
    Texture { name: "dial".to_owned(), width, height, rgba, wrap: [Wrap::Clamp; 2], nearest: false }
}

/// Dial that faces the platform.
fn dial(shape: &mut Shape, centre: Vec3, radius: f32) {
    const SIDES: u32 = 24;
    let corners: Vec<(Vec3, Vec2)> = (0..SIDES)
        .map(|side| {
            let c = circle(side as f32 / SIDES as f32);
            (centre + c.extend(0.0) * radius, vec2(0.5 + 0.49 * c.x, 0.5 - 0.49 * c.y))
        })
        .collect();
    shape.textured(&corners, [1.0; 3]);
}

/// Adds a clock on a post at the platform's edge, numbered from the middle.
fn platform_clock(scene: &mut Scene, number: i32) {
    const RADIUS: f32 = 0.62;
    const HEIGHT: f32 = 3.35;
    let x = PLATFORM_SPACING_M * number as f32;
    let mut post = Shape::new("post", PAINTED, false);
    post.cuboid(vec3(x - 0.06, 0.0, -0.36), vec3(x + 0.06, HEIGHT - RADIUS, -0.24), DARK);
    post.cuboid(vec3(x - 0.25, 0.0, -0.5), vec3(x + 0.25, 0.12, -0.1), DARK);
    post.disc(vec3(x, HEIGHT, -0.22), Vec3::X * 1.07 * RADIUS, Vec3::Y * 1.07 * RADIUS, 24, DARK);
    post.disc(vec3(x, HEIGHT, -0.24), Vec3::NEG_X * 1.07 * RADIUS, Vec3::Y * 1.07 * RADIUS, 24, DARK);
    let centre = vec3(x, HEIGHT, -0.2);
    let mut face = Shape::new("dial", DIAL, false);
    dial(&mut face, centre, RADIUS);
    scene.meshes.extend([post.finish(None), face.finish(None)]);
    let name = match number {
        0 => LocalName::new("platform clock, middle", "Bahnsteiguhr, Mitte"),
        left @ ..0 => {
            LocalName::new(format!("platform clock {}, left", -left), format!("Bahnsteiguhr {}, links", -left))
        }
        right => LocalName::new(format!("platform clock {right}, right"), format!("Bahnsteiguhr {right}, rechts")),
    };
    let face = ClockFace { name, centre, right: Vec3::X, out: Vec3::Z, radius: RADIUS, motion: None };
    face.furnish(scene, &[HandKind::Seconds, HandKind::Rounds], HANDS);
}

/// Adds a train, with a clock in the middle of each carriage.
fn pass(scene: &mut Scene, train: usize) {
    const RADIUS: f32 = 0.78;
    const HEIGHT: f32 = 1.55;
    let uniform = motion(train);
    let number = scene.motions.len();
    scene.motions.push(Motion::Uniform(uniform));
    let (side, forward) = (SIDES[train], if train == 0 { 1.0 } else { -1.0 });
    let mut body = Shape::new("carriages", PAINTED, false);
    let mut faces = Shape::new("dials aboard", DIAL, false);
    let middle = |carriage: u32| -forward * CARRIAGE_M * carriage as f32;
    for carriage in 0..CARRIAGES[train] {
        let x = middle(carriage);
        carriage_body(&mut body, vec3(x, 0.0, side), train, (carriage == 0).then_some(forward));
        dial(&mut faces, vec3(x, HEIGHT, side + 0.05), RADIUS);
    }
    scene.meshes.extend([body, faces].map(|shape| Mesh { motion: Some(number), ..shape.finish(None) }));
    for carriage in 0..CARRIAGES[train] {
        let name = LocalName::new(
            format!("train {}, carriage {}", train + 1, carriage + 1),
            format!("Zug {}, Wagen {}", train + 1, carriage + 1),
        );
        let centre = vec3(middle(carriage), HEIGHT, side + 0.05);
        let motion = Some(uniform);
        let face = ClockFace { name, centre, right: Vec3::X, out: Vec3::Z, radius: RADIUS, motion };
        face.furnish(scene, &[HandKind::Seconds], HANDS);
    }
}

/// Adds a carriage about `foot`, in the middle of its side that looks at the platform. `nose`: direction along x of the
/// foremost one's nose.
fn carriage_body(body: &mut Shape, foot: Vec3, train: usize, nose: Option<f32>) {
    const LIVERIES: [[FaceColour; 2]; 2] =
        [[[0.55, 0.045, 0.035], [0.82, 0.76, 0.62]], [[0.03, 0.14, 0.36], [0.78, 0.79, 0.80]]];
    const PANE: FaceColour = [0.05, 0.075, 0.10];
    const WIDTH: f32 = 2.8;
    let [low, high] = LIVERIES[train];
    let half = CARRIAGE_M / 2.0 - 0.35;
    let at = |x: f32, y: f32, z: f32| foot + vec3(x, y, z);
    body.cuboid(at(-half, -0.55, -WIDTH), at(half, 0.55, 0.0), low);
    body.cuboid(at(-half, 0.55, -WIDTH), at(half, 2.75, 0.0), high);
    body.cuboid(at(-half + 0.1, 2.75, -WIDTH + 0.2), at(half - 0.1, 3.0, -0.2), [0.30, 0.31, 0.32]);
    body.cuboid(at(-half + 0.4, -0.8, -WIDTH + 0.3), at(half - 0.4, -0.55, -0.3), DARK);
    for wheel in [-half + 2.2, -half + 4.2, half - 4.2, half - 2.2] {
        body.disc(at(wheel, -0.6, -0.02), Vec3::X * 0.42, Vec3::Y * 0.42, 16, DARK);
    }
    // Doors at the ends, windows between them and the clock.
    let panes = [-8.3, -6.5, -4.7, -2.9, 1.5, 3.3, 5.1, 6.9];
    for x in panes {
        body.patch(at(x, 1.0, 0.02), Vec3::X * 1.4, Vec3::Y * 1.1, PANE);
    }
    for x in [-half + 0.5, half - 1.7] {
        body.patch(at(x, -0.45, 0.02), Vec3::X * 1.2, Vec3::Y * 2.9, low);
        body.patch(at(x + 0.25, 1.0, 0.03), Vec3::X * 0.7, Vec3::Y * 1.1, PANE);
    }
    body.patch(at(-half, 0.62, 0.015), Vec3::X * 2.0 * half, Vec3::Y * 0.12, low);
    if let Some(forward) = nose {
        let tip = |y: f32, z: f32, out: f32| at(forward * (half + out), y, z);
        let corners = [tip(-0.55, 0.0, 0.0), tip(-0.55, -0.25, 1.7), tip(0.9, -0.25, 1.5), tip(2.75, 0.0, 0.0)];
        let mirrored = corners.map(|corner| vec3(corner.x, corner.y, 2.0 * foot.z - WIDTH - corner.z));
        let mut add = |corners: &[Vec3], colour| {
            let mut corners = corners.to_vec();
            if forward < 0.0 {
                corners.reverse();
            }
            body.face(&corners, colour);
        };
        let [a, b, c, d] = corners;
        let [e, f, g, h] = mirrored;
        add(&[a, b, c, d], low);
        add(&[h, g, f, e], low);
        add(&[b, f, g, c], low);
        add(&[c, g, h, d], PANE);
    }
}

/// Platform, tracks and country.
fn surroundings() -> Vec<Mesh> {
    let mut country = Shape::new("country", PAINTED, true);
    open_country::build(&mut country, BED - 0.15, |at| open_country::in_strip(at, Vec2::X, 13.0));

    let mut platform = Shape::new("platform", PAINTED, true);
    const HALF: f32 = 99.0;
    const EDGE: f32 = -0.9;
    for column in 0..110 {
        let x = -HALF + 1.8 * column as f32;
        for row in 0..5 {
            let tone = 0.36 + 0.035 * ((column * 7 + row * 5) % 4) as f32;
            let corner = vec3(x, 0.0, EDGE + 1.0 + 1.8 * (row + 1) as f32);
            platform.patch(corner, Vec3::X * 1.8, Vec3::NEG_Z * 1.8, [tone, tone * 0.97, tone * 0.92]);
        }
        platform.patch(vec3(x, 0.0, EDGE + 1.0), Vec3::X * 1.8, Vec3::NEG_Z * 0.4, [0.40, 0.39, 0.37]);
        platform.patch(vec3(x, 0.0, EDGE + 0.6), Vec3::X * 1.8, Vec3::NEG_Z * 0.2, [0.78, 0.66, 0.12]);
        platform.patch(vec3(x, 0.0, EDGE + 0.4), Vec3::X * 1.8, Vec3::NEG_Z * 0.4, [0.50, 0.49, 0.47]);
    }
    platform.patch(vec3(-HALF, BED, EDGE), Vec3::X * 2.0 * HALF, Vec3::NEG_Y * BED, [0.22, 0.20, 0.18]);
    let back = EDGE + 10.0;
    platform.patch(vec3(HALF, BED, back), Vec3::NEG_X * 2.0 * HALF, Vec3::NEG_Y * BED, [0.22, 0.20, 0.18]);
    for number in -4..4 {
        bench(&mut platform, vec3(PLATFORM_SPACING_M * (number as f32 + 0.5), 0.0, 7.2));
    }

    let mut tracks = Shape::new("tracks", PAINTED, true);
    for piece in 0..52 {
        let tone = 0.20 + 0.02 * (piece % 3) as f32;
        let corner = vec3(-260.0 + 10.0 * piece as f32, BED, EDGE);
        tracks.patch(corner, Vec3::X * 10.0, Vec3::NEG_Z * 10.4, [tone, tone * 0.96, tone * 0.9]);
    }
    for side in SIDES {
        let middle = side - 1.4;
        for sleeper in -100..100 {
            let x = 1.2 * sleeper as f32;
            tracks.patch(vec3(x, BED + 0.03, middle + 1.2), Vec3::X * 0.28, Vec3::NEG_Z * 2.4, [0.085, 0.06, 0.045]);
        }
        for rail in [-0.72, 0.72] {
            let z = middle + rail;
            tracks.cuboid(vec3(-240.0, BED, z - 0.04), vec3(240.0, BED + 0.14, z + 0.04), [0.33, 0.31, 0.30]);
        }
    }
    [country, platform, tracks].map(|shape| shape.finish(None)).into()
}

fn bench(shape: &mut Shape, foot: Vec3) {
    const WOOD: FaceColour = [0.34, 0.18, 0.08];
    for x in [-0.8, 0.7] {
        shape.cuboid(foot + vec3(x, 0.0, -0.2), foot + vec3(x + 0.1, 0.42, 0.2), DARK);
    }
    shape.cuboid(foot + vec3(-1.0, 0.42, -0.25), foot + vec3(1.0, 0.48, 0.25), WOOD);
    shape.cuboid(foot + vec3(-1.0, 0.55, 0.22), foot + vec3(1.0, 0.95, 0.28), WOOD);
}

fn places() -> Vec<NamedPlace> {
    let place = |english: &str, german: &str, [x, z]: [f64; 2], look: DVec3| NamedPlace {
        name: LocalName::new(english, german),
        start: Start { position: DVec3::new(x, 0.0, z), look: look.normalize(), ..Start::default() },
    };
    let end = 4.0 * f64::from(PLATFORM_SPACING_M);
    vec![
        place("middle of the platform", "Mitte des Bahnsteigs", [0.0, 4.5], DVec3::NEG_Z),
        place("left end of the platform", "linkes Ende des Bahnsteigs", [-end, 3.0], DVec3::new(1.0, 0.0, -0.25)),
        place("right end of the platform", "rechtes Ende des Bahnsteigs", [end, 3.0], DVec3::new(-1.0, 0.0, -0.25)),
    ]
}

#[cfg(test)]
mod tests {
    //! Law: the platform's clocks agree in the world and the train's do not; there a train's clock is slow by γ and
    //! behind the next by γ-free β·L'. A wrong program would turn all hands alike.

    use super::*;
    use physics::Observer;
    use scene::SceneClock;

    fn clocks(scene: &Scene, train: Option<usize>) -> Vec<&SceneClock> {
        let motion = train.map(motion);
        scene.clocks.iter().filter(|clock| clock.motion == motion).collect()
    }

    fn standing(time_s: f64, x: f64) -> Observer {
        let event = Event { ct: time_s * SPEED_OF_LIGHT_M_S, position: DVec3::new(x, 1.7, 4.5) };
        Observer { event, ..Observer::default() }
    }

    #[test]
    fn the_scene_keeps_its_promises() {
        let mut scene = build();
        assert_eq!(scene.validate(), Ok(()));
        assert_eq!(scene.set_speed_of_light(SPEED_OF_LIGHT_M_S), Ok(()));
        assert!(scene.triangle_count() < 40_000, "{}", scene.triangle_count());
        assert_eq!(scene.clocks.len(), 9 + 8 + 6);
    }

    #[test]
    fn in_the_world_the_platforms_clocks_agree_and_the_trains_are_behind_one_another() {
        let scene = build();
        let reading = |clock: &SceneClock| clock.reading(&standing(10.0, 3.0), SPEED_OF_LIGHT_M_S).world_s;
        assert!(clocks(&scene, None).into_iter().all(|clock| (reading(clock) - 10.0).abs() < 1e-12));
        for (train, beta) in [FIRST_BETA, SECOND_BETA].into_iter().enumerate() {
            let shown: Vec<f64> = clocks(&scene, Some(train)).into_iter().map(reading).collect();
            // The foremost is furthest behind: by β L'/c against the next.
            let behind_s = beta * f64::from(CARRIAGE_M) / SPEED_OF_LIGHT_M_S;
            assert!(shown.windows(2).all(|pair| (pair[1] - pair[0] - behind_s).abs() < 1e-9), "{shown:?}");
        }
    }

    #[test]
    fn a_carriages_clock_that_passes_the_platforms_runs_slow_by_gamma() {
        let scene = build();
        let foremost = clocks(&scene, Some(0))[0];
        for number in 0..=BESIDE {
            let passed = f64::from(number) * f64::from(PLATFORM_SPACING_M);
            let time_s = FIRST_S + passed / (FIRST_BETA * SPEED_OF_LIGHT_M_S);
            let shown = foremost.reading(&standing(time_s, 0.0), SPEED_OF_LIGHT_M_S).world_s;
            assert!((shown - (FIRST_S + (time_s - FIRST_S) * 0.8)).abs() < 1e-12, "{shown} at {time_s}");
        }
    }

    #[test]
    fn measured_hands_show_what_an_observers_own_present_reads_off_each_clock() {
        let mut scene = build();
        scene.set_speed_of_light(SPEED_OF_LIGHT_M_S).unwrap();
        for beta in [DVec3::ZERO, DVec3::X * 0.6, DVec3::new(-0.5, 0.0, 0.3)] {
            let observer = Observer { celerity: Beta::new(beta).unwrap().celerity(), ..standing(11.3, 2.0) };
            let hands = scene.motions.iter().filter_map(|motion| motion.animated());
            for animated in hands.filter(|animated| animated.name.contains("seconds")) {
                let clock = scene.clocks.iter().find(|clock| animated.name.starts_with(&*clock.name.english)).unwrap();
                let shown_s = clock.reading(&observer, SPEED_OF_LIGHT_M_S).measured_s;
                let angle = SceneClock::hand_rad(shown_s, crate::clock::ROUND_S);
                let expected = DVec3::new(angle.sin(), angle.cos(), 0.0);
                // The event of the dial's middle at the observer's present, and the hand's angle by its own time there.
                let body = scene::motion::ObservedBody::new(animated, &observer);
                let own_from_world = |event| animated.carrier().map_or(event, |carrier| carrier.own_from_world(event));
                let own = own_from_world(body.measured(DVec3::ZERO).unwrap().event);
                let tip = animated.in_carrier(own.ct).world_from_body.transform_vector3(DVec3::Y);
                assert!(tip.distance(expected) < 1e-6, "{} at {beta}", animated.name);
            }
        }
    }

    #[test]
    fn the_hands_of_each_clock_show_what_its_reading_says() {
        let mut scene = build();
        scene.set_speed_of_light(SPEED_OF_LIGHT_M_S).unwrap();
        let observer = standing(11.3, 2.0);
        let hands = scene.motions.iter().filter_map(|motion| motion.animated());
        for animated in hands.filter(|animated| animated.name.contains("seconds")) {
            let clock = scene.clocks.iter().find(|clock| animated.name.starts_with(&*clock.name.english)).unwrap();
            let shown_s = clock.reading(&observer, SPEED_OF_LIGHT_M_S).seen_s;
            // The retarded event of the middle of the dial, and the hand's angle by its own time there.
            let seen = scene::motion::ObservedBody::new(animated, &observer).seen(DVec3::ZERO).unwrap();
            let own = animated.carrier().map_or(seen.event, |carrier| carrier.own_from_world(seen.event));
            let tip = animated.in_carrier(own.ct).world_from_body.transform_vector3(DVec3::Y);
            let angle = SceneClock::hand_rad(shown_s, crate::clock::ROUND_S);
            assert!(tip.distance(DVec3::new(angle.sin(), angle.cos(), 0.0)) < 1e-6, "{}", animated.name);
        }
    }
}
