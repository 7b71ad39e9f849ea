//! The colour of an unlit material is the radiance that leaves it. So its linear factor must reach the picture as its
//! nearest sRGB byte (IEC 61966-2-1), in whatever form it was given and with any number of samples a pixel.
//!
//! In a wrong program, half floats or a gamma of 2.2 in place of the curve put dark values a byte off. A mean of
//! encoded values puts everything a little off after several samples. Light of the sun dims the colours.
#![allow(clippy::unwrap_used, reason = "a failed construction is a failed test")]

use exact_reference::random::seeded;
use glam::{DVec3, Vec2, Vec3};
use image::RgbaImage;
use rand::RngExt;
use scene::{Material, Mesh, Scene, Texture, Wrap};
use system_tests::colour::{encoded, linear, srgb_byte};
use system_tests::photographer::Photographer;
use system_tests::view::View;

/// Number of tiles along each side of a chart.
const SIDE: u32 = 16;

/// Side of a tile, pixels: enough for a pixel that no other tile touches.
const TILE: u32 = 4;

/// Distance in bytes from half way between two bytes at which f32 may take the other one. The power function of a
/// graphics driver is accurate to about 1e-5.
const TIE: f64 = 4e-3;

/// Place where a tile's colour is written.
#[derive(Clone, Copy, Debug)]
enum ColourPlace {
    Factor,
    FactorWithWhiteTexture,
    Vertices,
    /// A quarter in the factor, four times the colour in the vertices: the product counts, and is exact.
    FactorAndVertices,
}

const CARRIERS: [ColourPlace; 4] =
    [ColourPlace::Factor, ColourPlace::FactorWithWhiteTexture, ColourPlace::Vertices, ColourPlace::FactorAndVertices];

/// Wall of square tiles one metre ahead that fills a picture of 90°.
fn chart(colours: &[[f32; 3]], carrier: ColourPlace) -> Scene {
    let opaque = |[red, green, blue]: [f32; 3]| [red, green, blue, 1.0];
    let mut scene = Scene { name: "chart".into(), textures: vec![white()], ..Default::default() };
    for (tile, &colour) in (0..SIDE * SIDE).zip(colours) {
        let (factor, vertex) = match carrier {
            ColourPlace::Factor | ColourPlace::FactorWithWhiteTexture => (opaque(colour), [1.0; 4]),
            ColourPlace::Vertices => ([1.0; 4], opaque(colour)),
            ColourPlace::FactorAndVertices => (opaque([0.25; 3]), opaque(colour.map(|value| 4.0 * value))),
        };
        let base_colour_texture = matches!(carrier, ColourPlace::FactorWithWhiteTexture).then_some(0);
        if scene.materials.last().is_none_or(|material| material.base_colour != factor) {
            scene.materials.push(Material {
                base_colour: factor,
                base_colour_texture,
                unlit: true,
                ..Default::default()
            });
        }
        let corner = Vec3::new((tile % SIDE) as f32, (tile / SIDE) as f32, 0.0) * (2.0 / SIDE as f32);
        let corners = [Vec2::ZERO, Vec2::X, Vec2::ONE, Vec2::Y];
        let place = |at: Vec2| Vec3::new(-1.0, -1.0, -1.0) + corner + at.extend(0.0) * (2.0 / SIDE as f32);
        scene.meshes.push(Mesh {
            material: scene.materials.len() - 1,
            positions: corners.map(place).to_vec(),
            normals: vec![Vec3::Z; 4],
            uvs: corners.to_vec(),
            colours: vec![vertex; 4],
            indices: vec![0, 1, 2, 0, 2, 3],
            ..Default::default()
        });
    }
    scene
}

fn white() -> Texture {
    let (width, height) = (4, 4);
    Texture { name: "white".into(), width, height, rgba: vec![255; 64].into(), wrap: [Wrap::Repeat; 2], nearest: false }
}

/// Chart as read back from a picture file.
fn file_of(scene: &Scene, samples: u32) -> RgbaImage {
    let size = [SIDE * TILE; 2];
    let view = View { look: DVec3::NEG_Z, up: DVec3::Y, fov_degrees: 90.0, size };
    let picture = Photographer::new(scene, size, samples, None).plain(&view, DVec3::ZERO);
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("chart.png");
    picture.save(&path).unwrap();
    image::open(&path).unwrap().into_rgba8()
}

/// Checks the middle pixels of each tile: `accepts` must be true for the linear value and the byte.
fn assert_chart(colours: &[[f32; 3]], carrier: ColourPlace, samples: u32, accepts: impl Fn(f64, u8) -> bool) {
    let file = file_of(&chart(colours, carrier), samples);
    for (tile, colour) in (0..SIDE * SIDE).zip(colours) {
        let (column, row) = (tile % SIDE * TILE, (SIDE - 1 - tile / SIDE) * TILE);
        for [right, down] in [[1, 1], [2, 1], [1, 2], [2, 2]] {
            let pixel = file.get_pixel(column + right, row + down);
            for (&value, byte) in colour.iter().zip(pixel.0) {
                let exact = encoded(f64::from(value));
                assert!(
                    accepts(f64::from(value), byte),
                    "{value} is {byte} instead of {exact}: {carrier:?}, {samples} samples"
                );
            }
            assert_eq!(pixel[3], 255);
        }
    }
}

#[test]
fn all_256_steps_come_out_as_themselves() {
    let step = |byte: u8| linear(byte) as f32;
    // Use a different step for each channel, so that exchanged channels are found.
    let colours: Vec<_> = (0..=255u8).map(|byte| [byte, 255 - byte, byte.wrapping_mul(7)].map(step)).collect();
    for carrier in CARRIERS {
        for samples in [1, 4] {
            assert_chart(&colours, carrier, samples, |value, byte| byte == srgb_byte(value));
        }
    }
}

#[test]
fn random_factors_come_out_as_their_nearest_byte() {
    let mut random = seeded(11);
    let colours: Vec<_> = (0..256).map(|_| [(); 3].map(|()| random.random::<f32>().powi(2))).collect();
    let nearest = |value, byte: u8| (encoded(value) - f64::from(byte)).abs() <= 0.5 + TIE;
    for carrier in CARRIERS {
        for samples in [1, 3] {
            assert_chart(&colours, carrier, samples, nearest);
        }
    }
}

#[test]
fn what_is_brighter_than_white_is_white() {
    let colours = vec![[1.0, 1.5, 40.0]; 256];
    for samples in [1, 2] {
        assert_chart(&colours, ColourPlace::Factor, samples, |_, byte| byte == 255);
    }
}
