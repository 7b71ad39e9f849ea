//! Built-in row of dice: large dice beside a straight road, for riding past them, and dice that fly past.
//!
//! At a large speed each die beside the observer seems turned, not shortened: its far face comes into view (Terrell,
//! Penrose 1959). Two files of dice cross the road ahead of a resting observer, who sees the same of them.

use crate::open_country;
use crate::shape::{FaceColour, Shape};
use glam::{DVec3, Vec2, Vec3, vec3};
use physics::{Beta, Event};
use scene::motion::{Motion, Uniform};
use scene::{LocalName, Material, Mesh, NamedPlace, Scene, Start};

/// Speed of light that suits the scene, m/s: 30 km/h.
pub const SPEED_OF_LIGHT_M_S: f64 = 30.0 / 3.6;
/// Edge of a die beside the road, metres.
pub const EDGE_M: f32 = 2.4;
/// Distance from one die's middle to the next's, metres, and number of dice on each side.
pub const SPACING_M: f32 = 8.0;
/// Number of dice on each side of the road.
pub const COUNT: u32 = 18;
/// Distance of the dice's middles from the middle of the road, metres.
pub const ASIDE_M: f32 = 4.4;

/// Half the width of the road, metres.
const HALF_ROAD: f32 = 2.4;
/// Colours of dice, and of the pips on them.
const COLOURS: [(FaceColour, FaceColour); 4] = [
    ([0.62, 0.045, 0.04], [0.92, 0.90, 0.84]),
    ([0.86, 0.82, 0.70], [0.03, 0.03, 0.04]),
    ([0.04, 0.16, 0.50], [0.92, 0.90, 0.84]),
    ([0.88, 0.52, 0.03], [0.04, 0.03, 0.03]),
];
/// Places of pips on a face of edge 2, by their number.
const PIPS: [&[(f32, f32)]; 6] = [
    &[(0.0, 0.0)],
    &[(-0.5, -0.5), (0.5, 0.5)],
    &[(-0.5, -0.5), (0.0, 0.0), (0.5, 0.5)],
    &[(-0.5, -0.5), (0.5, -0.5), (-0.5, 0.5), (0.5, 0.5)],
    &[(-0.5, -0.5), (0.5, -0.5), (0.0, 0.0), (-0.5, 0.5), (0.5, 0.5)],
    &[(-0.5, -0.5), (0.5, -0.5), (-0.5, 0.0), (0.5, 0.0), (-0.5, 0.5), (0.5, 0.5)],
];

/// Crossing file of dice: speed as a fraction of c (positive to the right), place along z, time at which the first
/// one crosses the road, time between two, seconds, and their number.
const CROSSINGS: [(f64, f32, f64, f64, u32); 2] = [(0.9, -12.0, 3.0, 9.0, 7), (-0.6, -44.0, 5.0, 11.0, 6)];

/// Outward normals of a die's faces and the pips on each; dice differ by a turn about the upright axis.
pub fn faces(turn: u32) -> [(Vec3, usize); 6] {
    let around = [(Vec3::Z, 1), (Vec3::X, 2), (Vec3::NEG_Z, 6), (Vec3::NEG_X, 5)];
    let pips = |side: usize| around[(side + turn as usize) % 4].1;
    let [front, right, back, left] = [0, 1, 2, 3].map(|side| (around[side].0, pips(side)));
    [front, right, back, left, (Vec3::Y, 3), (Vec3::NEG_Y, 4)]
}

/// Index of the material of flying dice.
const LUMINOUS: usize = 1;

/// Share of light on the face of a luminous die, so that its edges are seen.
fn shade(normal: Vec3) -> f32 {
    0.75 + 0.2 * normal.y + 0.08 * normal.z - 0.06 * normal.x
}

/// Adds a die about `centre`.
fn die(shape: &mut Shape, centre: Vec3, edge: f32, number: u32, shade: fn(Vec3) -> f32) {
    let (body, ink) = COLOURS[number as usize % COLOURS.len()];
    let half = edge / 2.0;
    for (normal, pips) in faces(number) {
        let up = if normal.y == 0.0 { Vec3::Y } else { Vec3::NEG_Z };
        let right = up.cross(normal);
        let middle = centre + normal * half;
        let [body, ink] = [body, ink].map(|colour| colour.map(|channel| channel * shade(normal)));
        shape.patch(middle - (right + up) * half, right * edge, up * edge, body);
        let size = half * if pips == 1 { 0.26 } else { 0.19 };
        for (x, y) in PIPS[pips - 1] {
            let at = middle + (right * *x + up * *y) * half + normal * (0.006 * edge);
            shape.disc(at, right * size, up * size, 12, ink);
        }
    }
}

/// Builds the scene.
///
/// *Frames, units*: metres, y up; the road runs along −z from the start.
pub fn build() -> Scene {
    let mut country = Shape::new("country", 0, true);
    let beside_road = |at: Vec2| {
        let crossing = CROSSINGS.iter().any(|crossing| (at.y - crossing.1).abs() < 4.0);
        crossing || open_country::in_strip(at, Vec2::Y, 13.0)
    };
    open_country::build(&mut country, 0.0, beside_road);

    // The road, its edges and its middle line.
    let mut road = Shape::new("road", 0, true);
    for piece in 0..42 {
        let from = 40.0 - 6.0 * piece as f32;
        let tone = if piece % 2 == 0 { 0.105 } else { 0.115 };
        let corner = vec3(-HALF_ROAD, 0.02, from);
        road.patch(corner, Vec3::X * 2.0 * HALF_ROAD, Vec3::NEG_Z * 6.0, [tone, tone, tone * 1.05]);
        let line = [0.72, 0.70, 0.64];
        road.patch(vec3(-0.07, 0.035, from), Vec3::X * 0.14, Vec3::NEG_Z * 3.0, line);
        for x in [-HALF_ROAD + 0.1, HALF_ROAD - 0.22] {
            road.patch(vec3(x, 0.035, from), Vec3::X * 0.12, Vec3::NEG_Z * 6.0, line);
        }
    }

    let mut row = Shape::new("dice", 0, true);
    for number in 0..COUNT {
        let z = -SPACING_M * number as f32;
        die(&mut row, vec3(-ASIDE_M, EDGE_M / 2.0, z), EDGE_M, number, |_| 1.0);
        die(&mut row, vec3(ASIDE_M, EDGE_M / 2.0, z), EDGE_M, number + 2, |_| 1.0);
    }

    let mut scene = Scene {
        name: "dice".to_owned(),
        // Flying dice are luminous: in their own frame the sun would come from ahead, many times as bright.
        materials: vec![
            Material { name: "painted".to_owned(), ..Material::default() },
            Material { name: "luminous".to_owned(), unlit: true, ..Material::default() },
        ],
        meshes: vec![country.finish(None), road.finish(None), row.finish(None)],
        light: open_country::daylight(),
        start: Start { position: DVec3::Z * 10.0, ..Start::default() },
        speed_of_light_m_s: Some(SPEED_OF_LIGHT_M_S),
        places: places(),
        ..Scene::default()
    };
    for (number, crossing) in CROSSINGS.into_iter().enumerate() {
        let (mesh, motion) = flying(number, crossing);
        scene.meshes.push(Mesh { motion: Some(scene.motions.len()), ..mesh });
        scene.motions.push(motion);
    }
    scene
}

/// File of dice that cross the road, each at rest in their common frame.
fn flying(number: usize, (beta, z, first_s, every_s, count): (f64, f32, f64, f64, u32)) -> (Mesh, Motion) {
    let celerity = Beta::new(DVec3::X * beta).expect("slower than light").celerity();
    let height = EDGE_M / 2.0 + 0.05;
    let position = vec3(0.0, height, z).as_dvec3();
    let anchor = Event { ct: first_s * SPEED_OF_LIGHT_M_S, position };
    // Their distance in their own frame is longer by γ than in the world.
    let apart = celerity.gamma() * beta * every_s * SPEED_OF_LIGHT_M_S;
    let mut shape = Shape::new(&format!("flying dice {}", number + 1), LUMINOUS, false);
    for follower in 0..count {
        let behind = (-f64::from(follower) * apart) as f32;
        die(&mut shape, vec3(behind, height, z), EDGE_M, 3 + 2 * number as u32 + follower, shade);
    }
    (shape.finish(None), Motion::Uniform(Uniform { celerity, anchor }))
}

fn places() -> Vec<NamedPlace> {
    let place = |english: &str, german: &str, position: DVec3, look: DVec3| NamedPlace {
        name: LocalName::new(english, german),
        start: Start { position, look: look.normalize(), ..Start::default() },
    };
    let middle = f64::from(SPACING_M) * f64::from(COUNT / 2);
    vec![
        place("beginning of the road", "Anfang der Straße", DVec3::Z * 10.0, DVec3::NEG_Z),
        place("among the dice", "zwischen den Würfeln", DVec3::NEG_Z * middle, DVec3::NEG_Z),
        place("beside a die", "neben einem Würfel", DVec3::new(1.4, 0.0, -24.0), DVec3::NEG_X),
    ]
}

#[cfg(test)]
mod tests {
    //! Law: dice are dice, whichever way they are turned, and the flying ones cross when they should.

    use super::*;
    use physics::{Celerity, Observer};

    #[test]
    fn pips_of_opposite_faces_add_to_seven() {
        for turn in 0..8 {
            let faces = faces(turn);
            for (normal, pips) in faces {
                let (_, opposite) = faces.iter().find(|face| face.0 == -normal).unwrap();
                assert_eq!(pips + opposite, 7);
            }
            let mut all = faces.map(|face| face.1);
            all.sort_unstable();
            assert_eq!(all, [1, 2, 3, 4, 5, 6]);
        }
    }

    #[test]
    fn a_face_has_as_many_pips_as_it_says() {
        assert!((1..=6).all(|pips| PIPS[pips - 1].len() == pips));
    }

    #[test]
    fn flying_dice_cross_the_road_one_after_the_other() {
        for (number, crossing) in CROSSINGS.into_iter().enumerate() {
            let (_, Motion::Uniform(motion)) = flying(number, crossing) else { panic!("they move uniformly") };
            let (beta, z, first_s, every_s, count) = crossing;
            for follower in 0..count {
                let time_s = first_s + every_s * f64::from(follower);
                let ct = time_s * SPEED_OF_LIGHT_M_S;
                let event = Event { ct, position: vec3(0.0, motion.anchor.position.y as f32, z).as_dvec3() };
                let own = motion.seen_by(&Observer { event, celerity: Celerity::ZERO }).position;
                let apart = motion.celerity.gamma() * beta * every_s * SPEED_OF_LIGHT_M_S;
                assert!((own.x + f64::from(follower) * apart).abs() < 1e-9, "{own}");
            }
        }
    }

    #[test]
    fn the_scene_keeps_its_promises() {
        let scene = build();
        assert_eq!(scene.validate(), Ok(()));
        assert!(scene.triangle_count() < 30_000, "{}", scene.triangle_count());
    }
}
