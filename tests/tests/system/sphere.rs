//! A sphere's outline must be a circle on every observer's sphere of directions, at any speed (Penrose 1959; W 4.2):
//! aberration maps circles to circles. The circle is known exactly: directions n with n·a = cos α are orthogonal to
//! the four-vector (−cos α, a), and that can be boosted.
//!
//! A wrong program shows the Lorentz-contracted ellipsoid: an oval, off by tens of pixels.
#![allow(clippy::unwrap_used, reason = "a failed construction is a failed test")]

use glam::{DVec3, Vec3};
use image::RgbaImage;
use system_tests::bodies::{Cone, celerity, outline, sphere};
use system_tests::photographer::Photographer;

const SIZE: [u32; 2] = [640, 480];

/// Length of the edges into which the sphere is cut, metres: its flat triangles stay within 2e-4 of its radius.
const EDGE_M: f32 = 0.03;

/// Largest distance of the outline from the circle, pixels. It runs between the middles of two pixels, so the search
/// is uncertain by half a pixel; the rest is for triangles.
const OUTLINE_TOLERANCE: f64 = 0.6;

/// Root mean square distance, pixels: an even spread over one pixel, 0.29, and a margin.
const RESIDUAL_TOLERANCE: f64 = 0.35;

/// Smallest distance of a contracted ellipsoid's outline from any circle, pixels, so that the test can tell them
/// apart.
const OVAL: f64 = 3.0;

/// Centres of spheres that an eye at the origin, moving along x, is about to pass, is passing and has passed.
fn places() -> impl Iterator<Item = DVec3> {
    [9.0, 4.0, 1.5, 0.0, -1.5, -4.0].into_iter().map(|along| DVec3::new(along, 0.8, -2.2))
}

fn is_white(picture: &RgbaImage) -> impl Fn(u32, u32) -> bool {
    |column, row| picture.get_pixel(column, row)[0] > 127
}

#[test]
fn sphere_outline_stays_circular() {
    for centre in places() {
        let mut photographer = Photographer::new(&sphere(centre, EDGE_M), SIZE, 1, Some([0.0; 3]));
        for beta in [0.0, 0.5, 0.9, 0.99] {
            let motion = celerity(DVec3::X * beta);
            let expected = Cone::around(centre).seen_at(motion);
            let view = expected.view(SIZE);
            let picture = photographer.moving(&view, DVec3::ZERO, motion);
            let outline = outline(&view, is_white(&picture));
            assert!(outline.len() > 500, "{} pixels of outline at {beta} c around {centre}", outline.len());

            let residual = Cone::through(&outline).residual(&outline, &view);
            assert!(residual < RESIDUAL_TOLERANCE, "{residual} pixels off a circle at {beta} c around {centre}");
            let pixels = expected.furthest(&outline, &view);
            assert!(pixels < OUTLINE_TOLERANCE, "{pixels} pixels off the exact circle at {beta} c around {centre}");
        }
    }
}

#[test]
fn a_contracted_ellipsoid_would_be_noticed() {
    let centre = DVec3::new(0.0, 0.8, -2.2);
    let gamma = celerity(DVec3::X * 0.9).gamma();
    let mut oval = sphere(centre, EDGE_M);
    oval.meshes[0].positions.iter_mut().for_each(|position| *position *= Vec3::new((1.0 / gamma) as f32, 1.0, 1.0));
    let mut photographer = Photographer::new(&oval, SIZE, 1, Some([0.0; 3]));
    let view = Cone::around(centre).view(SIZE);
    let picture = photographer.plain(&view, DVec3::ZERO);
    let outline = outline(&view, is_white(&picture));
    let residual = Cone::through(&outline).residual(&outline, &view);
    assert!(residual > OVAL, "an oval passed for a circle, {residual} pixels off");
}
