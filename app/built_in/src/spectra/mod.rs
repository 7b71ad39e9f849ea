//! Built-in scene of spectra: a hall of three rooms in the light of 2800, 5900 and 10000 K, and two greens.
//!
//! The rooms are after W fig. 5.7, 5.11 and 5.14. Everything in them is colourless, so all visible light has the
//! lamp's spectrum: the Doppler shift turns each room into one of another temperature, D·T. Black bodies differ in
//! brightness by far more than eyes can bear, so each lamp is dimmed until a white is as bright as one at 2800 K. At
//! the gate hang the two greens of B fig. 2.4 in daylight (`paint`).
//!
//! The light in the rooms is computed once, at every vertex (`lamp`), and sent out from there, so no shading is
//! needed later. Outside, the sun shines with the spectrum of 5900 K.

mod lamp;
mod paint;
mod sheet;

use glam::{DVec3, Vec3, vec2, vec3};
use physics::colour::Spectrum;

use self::lamp::{Room, RoomBody};
use self::sheet::HallSheet;
use crate::turn::circle;
use scene::{Lighting, Material, Mesh, Scene, Start};

/// Temperatures of the rooms, from the gate on, kelvin.
pub const ROOM_KELVIN: [f64; 3] = [2800.0, 5900.0, 10000.0];
/// Temperature of daylight, kelvin.
pub const DAYLIGHT_KELVIN: f64 = 5900.0;

/// Width, height and depth of a room, metres.
const WIDTH: f32 = 8.0;
const HEIGHT: f32 = 5.0;
const DEPTH: f32 = 10.0;
/// Width and height of the doors, metres.
const DOOR: f32 = 4.0;
const DOOR_HEIGHT: f32 = 3.8;
/// Half the thickness of the walls between rooms, metres.
const HALF_WALL: f32 = 0.2;
/// Thickness, width and height of the gate, metres.
const GATE: f32 = 0.3;
const GATE_WIDTH: f32 = 18.0;
const GATE_HEIGHT: f32 = 7.0;
/// Position of the hall's far end along z, metres.
const END: f32 = -DEPTH * ROOM_KELVIN.len() as f32;
/// Extent of the pavement beyond the hall, metres.
const PAVEMENT: f32 = 60.0;

/// Edge length of cells that carry baked light, and of those that do not, metres.
const FINE: f32 = 0.2;
const COARSE: f32 = 2.0;

/// Brightness of the lamps as a multiple of white.
const LAMP: f32 = 4.0;

/// Materials, in the scene's order; those of the rooms come after them, three each.
const STONE: usize = 0;
const PAVING: usize = 1;
const GREEN_ON_ALUMINIUM: usize = 2;
const GREEN_ON_PINE: usize = 3;
const PLASTER: usize = 4;
const ROOMS: usize = 5;
/// Materials of a room: tiles of the floor, tiles of the walls, everything else.
const FLOOR: usize = 0;
const WALL: usize = 1;
const PLAIN: usize = 2;

/// Builds the scene.
///
/// *Frames, units*: metres, y up, the gate in the plane z = 0, the hall behind it along −z. The circuit leads through
/// the hall and back beside it.
pub fn build() -> Scene {
    let circuit = circuit();
    let white = luminance(ROOM_KELVIN[0]);
    let daylight = (white / luminance(DAYLIGHT_KELVIN)) as f32;
    Scene {
        name: "spectra".into(),
        textures: vec![
            paint::tiles("floor", 2, [235, 120], 90),
            paint::tiles("wall", 1, [238, 238], 150),
            paint::tiles("paving", 1, [190, 190], 140),
        ],
        materials: materials(),
        meshes: outside().into_iter().chain((0..ROOM_KELVIN.len()).flat_map(room)).collect(),
        light: light(daylight),
        illuminant: Some(Spectrum::Planck { kelvin: DAYLIGHT_KELVIN }),
        white: Some(white),
        start: Start { position: circuit[0], ..Start::default() },
        circuit,
        ..Scene::default()
    }
}

/// Luminance of a black body at rest, cd/m².
fn luminance(kelvin: f64) -> f64 {
    Spectrum::Planck { kelvin }.xyz(1.0).y
}

/// Light of a clear day whose white is as bright as a lamp of 2800 K.
fn light(dimmed: f32) -> Lighting {
    let colour = |colour: [f32; 3]| colour.map(|channel| channel * dimmed);
    Lighting {
        sun_direction: vec3(0.42, 0.72, 0.55).normalize(),
        sun: colour([0.85; 3]),
        sky: colour([0.42; 3]),
        ground: colour([0.2; 3]),
        zenith: colour([0.16, 0.32, 0.66]),
        horizon: colour([0.62, 0.74, 0.86]),
        shadows: true,
    }
}

fn materials() -> Vec<Material> {
    let gray = |name: &str, level: f32, texture| Material {
        name: name.into(),
        base_colour: [level, level, level, 1.0],
        base_colour_texture: texture,
        ..Material::default()
    };
    let [aluminium, pine] = paint::greens();
    let green = |name: &str, spectrum| Material { spectrum: Some(spectrum), ..gray(name, 1.0, None) };
    let outside = [
        gray("stone", 0.72, Some(1)),
        gray("paving", 0.7, Some(2)),
        green("green paint on aluminium", aluminium),
        green("green paint on pine", pine),
        gray("plaster", 0.72, None),
    ];
    let rooms = ROOM_KELVIN.into_iter().flat_map(|kelvin| {
        // Each room's white is as bright as that at 2800 K.
        let level = (luminance(ROOM_KELVIN[0]) / luminance(kelvin)) as f32;
        let kinds = [("floor", Some(0)), ("wall", Some(1)), ("plain", None)];
        kinds.map(|(kind, texture)| Material {
            unlit: true,
            spectrum: Some(Spectrum::Planck { kelvin }),
            ..gray(&format!("{kind} at {kelvin} K"), level, texture)
        })
    });
    outside.into_iter().chain(rooms).collect()
}

/// Meshes of a room and the bodies in it; its number counts from the gate.
fn room(number: usize) -> Vec<Mesh> {
    let kelvin = ROOM_KELVIN[number];
    let front = -DEPTH * number as f32;
    let back = front - DEPTH;
    let (left, right) = (-WIDTH / 2.0, WIDTH / 2.0);
    let lamp = [vec2(-1.0, back + 2.0), vec2(1.0, front - 2.0)];
    let lamp_height = HEIGHT - 0.05;
    let room = Room {
        bounds: [vec3(left, 0.0, back + HALF_WALL), vec3(right, HEIGHT, front - HALF_WALL)],
        lamp,
        lamp_height,
        bodies: bodies(number, front),
    };
    let sheet =
        |name: &str, kind: usize| HallSheet::new(format!("{name} at {kelvin} K"), ROOMS + 3 * number + kind, FINE);

    let mut floor = sheet("floor", FLOOR);
    floor.patch(vec3(left, 0.0, front), Vec3::X * WIDTH, Vec3::NEG_Z * DEPTH);

    let mut walls = sheet("walls", WALL);
    walls.patch(vec3(left, 0.0, front), Vec3::NEG_Z * DEPTH, Vec3::Y * HEIGHT);
    walls.patch(vec3(right, 0.0, back), Vec3::Z * DEPTH, Vec3::Y * HEIGHT);
    for (plane, facing) in [(front - HALF_WALL, -1.0), (back + HALF_WALL, 1.0)] {
        let (side, lintel) = ((WIDTH - DOOR) / 2.0, HEIGHT - DOOR_HEIGHT);
        let across = Vec3::X * facing;
        for beside in [-WIDTH / 2.0, DOOR / 2.0] {
            walls.patch(vec3(beside * facing, 0.0, plane), across * side, Vec3::Y * HEIGHT);
        }
        walls.patch(vec3(-DOOR / 2.0 * facing, DOOR_HEIGHT, plane), across * DOOR, Vec3::Y * lintel);
    }

    let mut plain = sheet("ceiling and doors", PLAIN);
    plain.patch(vec3(left, HEIGHT, back), Vec3::X * WIDTH, Vec3::Z * DEPTH);
    for begin in [front, back + HALF_WALL] {
        let end = begin - HALF_WALL;
        plain.patch(vec3(-DOOR / 2.0, 0.0, begin), Vec3::NEG_Z * HALF_WALL, Vec3::Y * DOOR_HEIGHT);
        plain.patch(vec3(DOOR / 2.0, 0.0, end), Vec3::Z * HALF_WALL, Vec3::Y * DOOR_HEIGHT);
        plain.patch(vec3(-DOOR / 2.0, DOOR_HEIGHT, end), Vec3::X * DOOR, Vec3::Z * HALF_WALL);
    }

    let mut things = sheet("things", PLAIN);
    room.bodies.iter().for_each(|body| body.build(&mut things));

    let mut luminous = sheet("lamp", PLAIN);
    let size = lamp[1] - lamp[0];
    luminous.patch(vec3(lamp[0].x, lamp_height, lamp[0].y), Vec3::X * size.x, Vec3::Z * size.y);

    let baked = |position: Vec3, normal: Vec3| LAMP * room.radiance(position, normal);
    let mut meshes: Vec<Mesh> = [floor, walls, plain, things].map(|sheet| sheet.shaded(baked)).into();
    meshes.push(luminous.shaded(|_, _| LAMP));
    meshes
}

/// Bodies of a room, left and right of the way; every other room is its neighbour's mirror image.
fn bodies(number: usize, front: f32) -> Vec<RoomBody> {
    let mirrored = if number.is_multiple_of(2) { 1.0 } else { -1.0 };
    let at = |x: f32, y: f32, z: f32| vec3(x * mirrored, y, front - z);
    let block = |x: f32, base: f32, z: f32, half: f32, height: f32| RoomBody::Block {
        low: at(x, base, z) - vec3(half, 0.0, half),
        high: at(x, base, z) + vec3(half, height, half),
    };
    vec![
        // A ball on a plinth, a column with a block for a capital; a ball on the floor, a drum on a cube.
        block(-2.8, 0.0, 3.2, 0.6, 0.9),
        RoomBody::Ball { centre: at(-2.8, 1.55, 3.2), radius: 0.65 },
        RoomBody::Drum { base: at(-3.0, 0.0, 6.9), radius: 0.38, height: 2.6 },
        block(-3.0, 2.6, 6.9, 0.5, 0.3),
        RoomBody::Ball { centre: at(-2.3, 0.45, 5.3), radius: 0.45 },
        RoomBody::Ball { centre: at(2.9, 0.9, 4.0), radius: 0.9 },
        block(2.9, 0.0, 7.2, 0.7, 1.4),
        RoomBody::Drum { base: at(2.9, 1.4, 7.2), radius: 0.45, height: 0.9 },
        RoomBody::Drum { base: at(2.3, 0.0, 1.7), radius: 0.3, height: 0.7 },
    ]
}

/// Meshes outside the rooms, lit by the sun.
fn outside() -> Vec<Mesh> {
    let lit = |_: Vec3, _: Vec3| 1.0;

    // The pavement lies round the hall.
    let shell = WIDTH / 2.0 + 2.0 * HALF_WALL;
    let mut pavement = HallSheet::new("pavement", PAVING, COARSE);
    let mut slab = |x: [f32; 2], z: [f32; 2]| {
        pavement.patch(vec3(x[0], 0.0, z[0]), Vec3::X * (x[1] - x[0]), Vec3::Z * (z[1] - z[0]));
    };
    slab([-PAVEMENT, PAVEMENT], [PAVEMENT, 0.0]);
    slab([-PAVEMENT, -WIDTH / 2.0], [0.0, END]);
    slab([WIDTH / 2.0, PAVEMENT], [0.0, END]);
    slab([-PAVEMENT, PAVEMENT], [END, END - PAVEMENT]);

    // A gate at either end, walls and a roof between.
    let mut hall = HallSheet::new("hall", STONE, COARSE);
    for (behind, before) in [(0.0, GATE), (END - GATE, END)] {
        let (outer, inner) = (GATE_WIDTH / 2.0, DOOR / 2.0);
        hall.block(vec3(-outer, 0.0, behind), vec3(-inner, GATE_HEIGHT, before));
        hall.block(vec3(inner, 0.0, behind), vec3(outer, GATE_HEIGHT, before));
        hall.block(vec3(-inner, DOOR_HEIGHT, behind), vec3(inner, GATE_HEIGHT, before));
    }
    let roof = HEIGHT + 2.0 * HALF_WALL;
    hall.patch(vec3(-shell, 0.0, END), Vec3::Z * -END, Vec3::Y * roof);
    hall.patch(vec3(shell, 0.0, 0.0), Vec3::Z * END, Vec3::Y * roof);
    hall.patch(vec3(-shell, roof, 0.0), Vec3::X * 2.0 * shell, Vec3::Z * END);

    // Bollards along the way to the gate, plinths for two balls.
    let mut bollards = HallSheet::new("bollards", PLASTER, COARSE);
    for (side, row) in [-1.0, 1.0].into_iter().flat_map(|side| (0..3).map(move |row| (side, row as f32))) {
        let base = vec3(side * 8.2, 0.0, 3.0 + 4.0 * row);
        bollards.drum(base, 0.22, 1.0);
        bollards.ball(base + Vec3::Y * 1.2, 0.26);
    }
    bollards.drum(vec3(-4.6, 0.0, 3.0), 0.6, 0.7);
    bollards.drum(vec3(4.6, 0.0, 3.0), 0.6, 0.7);

    // The two greens: wooden boards and a ball to the left, metal plates and a ball to the right.
    let mut boards = HallSheet::new("painted boards", GREEN_ON_PINE, COARSE);
    for board in 0..6 {
        let left = -7.8 + 0.75 * board as f32;
        boards.block(vec3(left, 0.8, GATE), vec3(left + 0.7, 5.2, GATE + 0.1));
    }
    boards.ball(vec3(-4.6, 1.35, 3.0), 0.75);
    let mut plates = HallSheet::new("painted plates", GREEN_ON_ALUMINIUM, COARSE);
    for (column, row) in (0..2).flat_map(|column| (0..2).map(move |row| (column as f32, row as f32))) {
        let corner = vec3(3.35 + 2.25 * column, 0.8 + 2.225 * row, GATE);
        plates.block(corner, corner + vec3(2.2, 2.175, 0.1));
    }
    plates.ball(vec3(4.6, 1.35, 3.0), 0.75);

    [pavement, hall, bollards, boards, plates].map(|sheet| sheet.shaded(lit)).into()
}

/// Corners of the circuit: straight through the hall, and back beside it.
fn circuit() -> Vec<DVec3> {
    /// Radius of the turns, metres, and the z at which they begin.
    const TURN: f32 = 7.5;
    const NEAR: f32 = 12.0;
    const FAR: f32 = END - 8.0;
    /// Distance from one corner to the next on the straights, metres.
    const STEP: f32 = 2.0;
    let steps = ((NEAR - FAR) / STEP) as u32;
    let straight = |x: f32, from: f32, to: f32| {
        (0..steps).map(move |step| vec3(x, 0.0, from + (to - from) * step as f32 / steps as f32))
    };
    let half_turn = |z: f32, forward: f32| {
        (0..12).map(move |step| {
            let c = circle(step as f32 / 24.0) * TURN * forward;
            vec3(TURN - c.x, 0.0, z - c.y)
        })
    };
    let way = straight(0.0, NEAR, FAR).chain(half_turn(FAR, 1.0));
    let way = way.chain(straight(2.0 * TURN, FAR, NEAR)).chain(half_turn(NEAR, -1.0));
    way.map(Vec3::as_dvec3).collect()
}

#[cfg(test)]
mod tests {
    //! Laws under test: the scene is sound, its rooms are equally bright, and a rider comes round. A wrong scene
    //! would be black in one room, burnt out in another, or have a wall in the way.

    use super::*;
    use scene::Surroundings;
    use scene::collision::Collision;
    use scene_files::check::Report;

    #[test]
    fn nothing_is_wrong_with_it() {
        let report = Report::new(&build()).unwrap();
        assert_eq!(report.warnings, Vec::<String>::new());
        assert_eq!(report.spectra.len(), 5, "three rooms, daylight as the second, two greens: {:?}", report.spectra);
    }

    #[test]
    fn it_is_the_same_every_time() {
        assert_eq!(build(), build());
    }

    #[test]
    fn rooms_are_equally_bright_and_not_burnt_out() {
        let scene = build();
        let white = scene.white.unwrap();
        let radiances = |number: usize| {
            let kelvin = ROOM_KELVIN[number];
            let meshes = scene
                .meshes
                .iter()
                .filter(move |mesh| (ROOMS + 3 * number..ROOMS + 3 * number + 3).contains(&mesh.material));
            let lit = meshes.filter(|mesh| !mesh.name.starts_with("lamp"));
            let level = f64::from(scene.materials[ROOMS + 3 * number].base_colour[0]) * luminance(kelvin) / white;
            lit.flat_map(|mesh| &mesh.colours).map(|colour| level * f64::from(colour[0])).collect::<Vec<_>>()
        };
        let means = [0, 1, 2].map(|number| {
            let radiances = radiances(number);
            let brightest = radiances.iter().copied().fold(0.0, f64::max);
            assert!(brightest < 1.0, "room {number}: {brightest}");
            radiances.iter().sum::<f64>() / radiances.len() as f64
        });
        assert!(
            means.iter().all(|mean| (mean / means[0] - 1.0).abs() < 0.01 && (0.15..0.6).contains(mean)),
            "{means:?}"
        );
    }

    #[test]
    fn the_way_is_clear_all_round() {
        let collision = Collision::new(&build()).unwrap();
        let circuit = circuit();
        for (index, &place) in circuit.iter().enumerate() {
            let next = circuit[(index + 1) % circuit.len()];
            assert!((0.5..3.0).contains(&place.distance(next)), "from {place} to {next}");
            assert_eq!(collision.height_below(place).map(|ground| ground.height), Some(0.0), "{place}");
            let wall = collision.nearest_wall(place, 1.5);
            assert_eq!(wall, None, "{place}");
        }
    }
}
