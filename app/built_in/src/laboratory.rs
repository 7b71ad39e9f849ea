//! Built-in laboratory: a wire cube at 0.8 c and a sphere at 0.999 c pass a camera at right angles.
//!
//! After the pictures of Hornof et al. (Communications Physics 8, 161, 2025), who made snapshots of both with pulses
//! of laser light, slice by slice, as if light went 2 m/s: the cube looks turned, not shortened, and the sphere stays a
//! sphere whose far side comes into view. Their pictures show geometry alone, without the Doppler shift and the
//! searchlight effect; so does `--effects geometry`. At the wall stand the same bodies at rest.

use crate::shape::{FaceColour, Shape};
use crate::turn::circle;
use glam::{DVec3, Vec3, vec3};
use physics::{Beta, Event};
use scene::motion::{Motion, Uniform};
use scene::{Lighting, LocalName, Material, Mesh, NamedPlace, Scene, Start};

/// Speed of light, m/s, as in the experiment.
pub const SPEED_OF_LIGHT_M_S: f64 = 2.0;
/// Speed of the cube as a fraction of c.
pub const CUBE_BETA: f64 = 0.8;
/// Speed of the sphere as a fraction of c.
pub const SPHERE_BETA: f64 = 0.999;
/// Edge of the cube and diameter of the sphere, metres.
pub const SIZE_M: f32 = 1.0;
/// Height of the path of both, metres; the camera looks at it from 4.5 m away.
pub const HEIGHT_M: f32 = 1.5;
/// Time at which the first cube crosses the middle, of the first sphere, and from one to the next, seconds.
pub const TIMES_S: [f64; 3] = [6.0, 11.0, 12.0];

/// Number of each that pass, one after the other.
const COUNT: u32 = 8;
/// Thickness of the cube's bars, metres.
const BAR: f32 = 0.05;

/// Adds a cube of bars about `centre`; opposite faces differ in colour, so that a turn is seen.
fn cube(shape: &mut Shape, centre: Vec3) {
    const FRONT: FaceColour = [0.85, 0.30, 0.05];
    const BACK: FaceColour = [0.08, 0.35, 0.75];
    const ACROSS: FaceColour = [0.80, 0.80, 0.76];
    let (half, bar) = (SIZE_M / 2.0, BAR / 2.0);
    let mut rod = |middle: Vec3, reach: Vec3, colour| {
        shape.cuboid(centre + middle - reach, centre + middle + reach, colour);
    };
    for (z, colour) in [(half, FRONT), (-half, BACK)] {
        for side in [-half, half] {
            rod(vec3(0.0, side, z), vec3(half + bar, bar, bar), colour);
            rod(vec3(side, 0.0, z), vec3(bar, half - bar, bar), colour);
        }
    }
    for (x, y) in [(-half, -half), (half, -half), (half, half), (-half, half)] {
        rod(vec3(x, y, 0.0), vec3(bar, bar, half - bar), ACROSS);
    }
}

/// Adds a sphere about `centre`, in fields like a beach ball's; the half that looks to the right is of another colour.
fn sphere(shape: &mut Shape, centre: Vec3) {
    const AROUND: u32 = 32;
    const UP: u32 = 16;
    let at = |column: u32, row: u32| {
        let (turn, height) = (circle(column as f32 / AROUND as f32), circle(row as f32 / (2.0 * UP as f32)));
        // Poles are along z, towards the camera and away from it.
        centre + vec3(turn.x * height.y, turn.y * height.y, height.x) * (SIZE_M / 2.0)
    };
    for (row, column) in (0..UP).flat_map(|row| (0..AROUND).map(move |column| (row, column))) {
        let right = (column + AROUND / 4) % AROUND < AROUND / 2;
        let even = (column / 4 + row / 4).is_multiple_of(2);
        let colour = match (row < UP / 2, right, even) {
            (true, _, true) => [0.82, 0.80, 0.74],
            (true, true, false) => [0.70, 0.10, 0.06],
            (true, false, false) => [0.10, 0.42, 0.18],
            (false, _, true) => [0.10, 0.12, 0.20],
            (false, _, false) => [0.10, 0.30, 0.70],
        };
        let mut corners = vec![at(column, row), at(column, row + 1), at(column + 1, row + 1), at(column + 1, row)];
        if row == 0 {
            corners.remove(3);
        } else if row + 1 == UP {
            corners.remove(1);
        }
        shape.face(&corners, colour);
    }
}

/// Builds the scene.
///
/// *Frames, units*: metres, y up; the camera looks along −z, and both bodies pass from left to right along x through
/// (0, [`HEIGHT_M`], 0).
pub fn build() -> Scene {
    let mut room = Shape::new("room", 0, true);
    const REACH: f32 = 36.0;
    const WALL: f32 = -4.0;
    // Floor of square slabs, and a wall with a line at each metre, by which lengths are read off.
    for (column, row) in (-18..18).flat_map(|column| (-2..6).map(move |row| (column, row))) {
        let tone = if (column + row) % 2 == 0 { 0.115 } else { 0.085 };
        let corner = vec3(2.0 * column as f32, 0.0, 2.0 * (row + 1) as f32);
        room.patch(corner, Vec3::X * 2.0, Vec3::NEG_Z * 2.0, [tone, tone, tone * 1.08]);
    }
    room.patch(vec3(-REACH, 0.0, WALL), Vec3::X * 2.0 * REACH, Vec3::Y * 5.0, [0.155, 0.165, 0.19]);
    for metre in -36..36 {
        let (wide, tone) = if metre % 5 == 0 { (0.03, 0.42) } else { (0.012, 0.26) };
        let foot = vec3(metre as f32 - wide, 0.0, WALL + 0.01);
        room.patch(foot, Vec3::X * 2.0 * wide, Vec3::Y * 5.0, [tone, tone, tone * 1.05]);
    }
    for height in 1..5 {
        let foot = vec3(-REACH, height as f32 - 0.012, WALL + 0.012);
        room.patch(foot, Vec3::X * 2.0 * REACH, Vec3::Y * 0.024, [0.26, 0.26, 0.275]);
    }

    // The same bodies at rest, on pedestals.
    let mut resting = Shape::new("bodies at rest", 0, true);
    for x in [-2.6, 2.6] {
        resting.cuboid(vec3(x - 0.4, 0.0, -3.2), vec3(x + 0.4, 0.55, -2.4), [0.30, 0.28, 0.25]);
    }
    cube(&mut resting, vec3(-2.6, 1.08, -2.8));
    sphere(&mut resting, vec3(2.6, 1.05, -2.8));

    let mut scene = Scene {
        name: "laboratory".to_owned(),
        // The moving ones are luminous: in their own frame the room's light comes from ahead, hundreds of times as
        // bright.
        materials: vec![
            Material { name: "painted".to_owned(), ..Material::default() },
            Material { name: "luminous".to_owned(), unlit: true, ..Material::default() },
        ],
        meshes: vec![room.finish(None), resting.finish(None)],
        light: Lighting {
            sun_direction: vec3(-0.35, 0.75, 0.6).normalize(),
            sun: [0.78, 0.76, 0.72],
            sky: [0.50, 0.52, 0.56],
            ground: [0.24, 0.24, 0.25],
            zenith: [0.010, 0.012, 0.018],
            horizon: [0.035, 0.04, 0.055],
            shadows: true,
        },
        start: Start { position: DVec3::Z * 4.5, ..Start::default() },
        speed_of_light_m_s: Some(SPEED_OF_LIGHT_M_S),
        places: vec![place("before the path", "vor der Bahn", 4.5), place("close to the path", "nah an der Bahn", 2.5)],
        ..Scene::default()
    };
    let [cube_s, sphere_s, every_s] = TIMES_S;
    passing(&mut scene, "cubes", CUBE_BETA, [cube_s, every_s], cube);
    passing(&mut scene, "spheres", SPHERE_BETA, [sphere_s, every_s], sphere);
    scene
}

fn place(english: &str, german: &str, away_m: f64) -> NamedPlace {
    let start = Start { position: DVec3::Z * away_m, ..Start::default() };
    NamedPlace { name: LocalName::new(english, german), start }
}

/// Adds bodies that pass along x, one after the other, at rest in their common frame.
fn passing(scene: &mut Scene, name: &str, beta: f64, [first_s, every_s]: [f64; 2], body: fn(&mut Shape, Vec3)) {
    let celerity = Beta::new(DVec3::X * beta).expect("slower than light").celerity();
    let position = DVec3::Y * f64::from(HEIGHT_M);
    let anchor = Event { ct: first_s * SPEED_OF_LIGHT_M_S, position };
    // Their distance in their own frame is longer by γ than in the world.
    let apart = celerity.gamma() * beta * every_s * SPEED_OF_LIGHT_M_S;
    let mut shape = Shape::new(name, 1, false);
    for follower in 0..COUNT {
        body(&mut shape, vec3((-f64::from(follower) * apart) as f32, HEIGHT_M, 0.0));
    }
    scene.meshes.push(Mesh { motion: Some(scene.motions.len()), ..shape.finish(None) });
    scene.motions.push(Motion::Uniform(Uniform { celerity, anchor }));
}

#[cfg(test)]
mod tests {
    //! Law: the bodies are those of the experiment, and a passing cube shows what Terrell and Penrose said: seen at
    //! right angles, its rear face is as wide as β, and its near face as 1/γ.

    use super::*;
    use physics::{Celerity, Observer, PointSource, apparent};

    #[test]
    fn the_scene_keeps_its_promises() {
        let scene = build();
        assert_eq!(scene.validate(), Ok(()));
        let speeds = [0, 1].map(|motion| scene.fastest(motion, &[]).beta);
        assert!((speeds[0] - CUBE_BETA).abs() < 1e-15 && (speeds[1] - SPHERE_BETA).abs() < 1e-12, "{speeds:?}");
    }

    #[test]
    fn a_cube_seen_from_afar_at_right_angles_is_turned_by_the_sine_of_beta() {
        let scene = build();
        let Motion::Uniform(motion) = &scene.motions[0] else { panic!("the cubes move uniformly") };
        // Light of the middle's passage meets the observer, so far away that perspective does not count.
        let far = 1e7;
        let event = Event { ct: motion.anchor.ct + far, position: DVec3::new(0.0, f64::from(HEIGHT_M), far) };
        let observer = Observer { event, celerity: Celerity::ZERO };
        let seen = |x: f64, z: f64| {
            let gamma = motion.celerity.gamma();
            let at_anchor = motion.anchor.position + DVec3::new(x / gamma, 0.0, z);
            let beta = motion.celerity.beta().vector();
            let position = at_anchor - beta * motion.anchor.ct;
            apparent::moving(&observer, &PointSource { position, celerity: motion.celerity }).position.x
        };
        let half = 0.5 * f64::from(SIZE_M);
        let (near, rear) = (seen(half, half) - seen(-half, half), seen(-half, half) - seen(-half, -half));
        assert!((near - 0.6).abs() < 1e-5 && (rear - 0.8).abs() < 1e-5, "{near} {rear}");
    }
}
