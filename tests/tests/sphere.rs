//! Law: a sphere's outline is a circle on every observer's sphere of directions, however fast he moves (Penrose 1959; W 4.2): aberration maps circles
//! to circles. Which circle is known exactly: directions n with n·a = cos α are orthogonal to the four-vector (−cos α, a), and that can be boosted.
//!
//! A wrong program shows the Lorentz-contracted ellipsoid: an oval, off by tens of pixels.
#![allow(clippy::unwrap_used, reason = "a failed construction is a failed test")]

use glam::{DMat3, DVec3, Vec2, Vec3};
use image::RgbaImage;
use physics::{Beta, Boost, Celerity, FourVector};
use rapidity::scene::refine::refine;
use rapidity::scene::{Material, Mesh, Scene};
use system_tests::photographer::Photographer;
use system_tests::view::{View, middle};

const SIZE: [u32; 2] = [640, 480];

/// Metres along the edges of the octahedron from which the sphere is made: its flat triangles stay within 2e-4 of its radius.
const EDGE_M: f32 = 0.03;

/// Pixels. An outline runs between the middles of two pixels, so half a pixel is lost in looking for it; the rest is for triangles.
const OUTLINE_TOLERANCE: f64 = 0.6;

/// Pixels: root mean square of an even spread over one pixel, 0.29, and a margin.
const RESIDUAL_TOLERANCE: f64 = 0.35;

/// Pixels that a contracted ellipsoid's outline must be from any circle, for this test to be worth having.
const OVAL: f64 = 3.0;

/// Closed, white and unlit: the points at most one metre from the origin, squeezed along x to `width` of that, about `centre`.
fn sphere(centre: DVec3, width: f32) -> Scene {
    let positions = [Vec3::X, Vec3::Y, Vec3::Z, -Vec3::X, -Vec3::Y, -Vec3::Z];
    let octahedron = Mesh {
        positions: positions.to_vec(),
        normals: positions.to_vec(),
        uvs: vec![Vec2::ZERO; 6],
        colours: vec![[1.0; 4]; 6],
        indices: vec![0, 1, 2, 1, 3, 2, 3, 4, 2, 4, 0, 2, 1, 0, 5, 3, 1, 5, 4, 3, 5, 0, 4, 5],
        ..Default::default()
    };
    let materials = vec![Material { unlit: true, ..Default::default() }];
    let coarse = Scene { origin: centre, materials, meshes: vec![octahedron], ..Default::default() };
    let mut fine = refine(&coarse, EDGE_M).unwrap();
    for position in &mut fine.meshes[0].positions {
        *position = position.normalize() * Vec3::new(width, 1.0, 1.0);
    }
    fine
}

/// The directions n with n·axis = cosine.
struct Cone {
    axis: DVec3,
    cosine: f64,
}

impl Cone {
    /// The tangents from the origin to the unit sphere about `centre`.
    fn around(centre: DVec3) -> Self {
        let distance = centre.length();
        Self { axis: centre / distance, cosine: (1.0 - 1.0 / (distance * distance)).sqrt() }
    }

    /// The same directions as an observer sees them.
    fn seen_at(&self, celerity: Celerity) -> Self {
        let normal = Boost::observer_from_world(celerity).apply(FourVector { t: -self.cosine, r: self.axis });
        let length = normal.r.length();
        Self { axis: normal.r / length, cosine: -normal.t / length }
    }

    /// The cone nearest to some directions: points of a sphere lie on a circle if they lie in a plane, n·m = 1.
    fn through(directions: &[DVec3]) -> Self {
        let outer = |n: DVec3| DMat3::from_cols(n * n.x, n * n.y, n * n.z);
        let squares = directions.iter().fold(DMat3::ZERO, |sum, &n| sum + outer(n));
        let normal = squares.inverse() * directions.iter().sum::<DVec3>();
        Self { axis: normal.normalize(), cosine: 1.0 / normal.length() }
    }

    fn half_angle(&self) -> f64 {
        self.cosine.acos()
    }

    /// Angle from the cone to a direction.
    fn distance(&self, direction: DVec3) -> f64 {
        (direction.angle_between(self.axis) - self.half_angle()).abs()
    }
}

/// Looks at the middle of a cone and leaves room around it.
fn view_of(cone: &Cone) -> View {
    let fov_degrees = (3.0 * cone.half_angle()).to_degrees().min(120.0);
    View { look: cone.axis, up: DVec3::new(0.3, 0.9, 0.2), fov_degrees, size: SIZE }
}

/// The directions between neighbouring pixels of which one shows the sphere and one does not.
fn outline(picture: &RgbaImage, view: &View) -> Vec<DVec3> {
    let white = |column, row| picture.get_pixel(column, row)[0] > 127;
    let mut directions = Vec::new();
    for (column, row) in (0..SIZE[1] - 1).flat_map(|row| (0..SIZE[0] - 1).map(move |column| (column, row))) {
        let [x, y] = middle([column, row]);
        if white(column, row) != white(column + 1, row) {
            directions.push(view.direction([x + 0.5, y]));
        }
        if white(column, row) != white(column, row + 1) {
            directions.push(view.direction([x, y + 0.5]));
        }
    }
    directions
}

/// Root mean square of the outline's distance from the circle nearest to it, in pixels.
fn residual(outline: &[DVec3], view: &View) -> f64 {
    let circle = Cone::through(outline);
    let squares: f64 = outline.iter().map(|&direction| circle.distance(direction).powi(2)).sum();
    (squares / outline.len() as f64).sqrt() * view.focal_length()
}

/// Centres of spheres that an eye at the origin, moving along x, is about to pass, is passing and has passed.
fn places() -> impl Iterator<Item = DVec3> {
    [9.0, 4.0, 1.5, 0.0, -1.5, -4.0].into_iter().map(|along| DVec3::new(along, 0.8, -2.2))
}

#[test]
fn sphere_outline_stays_circular() {
    for centre in places() {
        let mut photographer = Photographer::new(&sphere(centre, 1.0), SIZE, 1, Some([0.0; 3]));
        for beta in [0.0, 0.5, 0.9, 0.99] {
            let motion = Beta::new(DVec3::X * beta).unwrap().celerity();
            let expected = Cone::around(centre).seen_at(motion);
            let view = view_of(&expected);
            let outline = outline(&photographer.moving(&view, DVec3::ZERO, motion), &view);
            assert!(outline.len() > 500, "{} pixels of outline at {beta} c around {centre}", outline.len());

            let residual = residual(&outline, &view);
            assert!(residual < RESIDUAL_TOLERANCE, "{residual} pixels off a circle at {beta} c around {centre}");
            let worst = outline.iter().map(|&direction| expected.distance(direction)).fold(0.0, f64::max);
            let pixels = worst * view.focal_length();
            assert!(pixels < OUTLINE_TOLERANCE, "{pixels} pixels off the exact circle at {beta} c around {centre}");
        }
    }
}

#[test]
fn a_contracted_ellipsoid_would_be_noticed() {
    let centre = DVec3::new(0.0, 0.8, -2.2);
    let gamma = Beta::new(DVec3::X * 0.9).unwrap().celerity().gamma();
    let mut photographer = Photographer::new(&sphere(centre, (1.0 / gamma) as f32), SIZE, 1, Some([0.0; 3]));
    let view = view_of(&Cone::around(centre));
    let residual = residual(&outline(&photographer.plain(&view, DVec3::ZERO), &view), &view);
    assert!(residual > OVAL, "an oval passed for a circle, {residual} pixels off");
}
