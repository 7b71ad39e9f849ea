//! Spheres and boxes, at rest or in motion, and their apparent positions.
//!
//! The expected apparent position of a moving place comes from its worldline in the world
//! (`physics::apparent::moving`), not from the body's own frame, in which the program works. The expected outline of
//! a sphere comes from the boost of a circle of directions.

use glam::{DMat3, DQuat, DVec3, Vec2, Vec3};
use physics::apparent::{Apparent, PointSource, moving};
use physics::{Beta, Boost, Celerity, Event, FourVector, Observer};
use scene::motion::{Motion, Uniform};
use scene::refine::refine;
use scene::{Material, Mesh, Scene};

use crate::view::{View, middle};

/// Brightness of the faces of a box that look neither along x nor against it.
pub const GREY: f32 = 0.5;

/// Celerity for a velocity in units of c.
///
/// # Panics
/// If the velocity reaches the speed of light.
pub fn celerity(beta: DVec3) -> Celerity {
    Beta::new(beta).expect("bodies of tests are slower than light").celerity()
}

/// An observer at world time 0.
pub fn observer(position: DVec3, celerity: Celerity) -> Observer {
    Observer { event: Event { ct: 0.0, position }, celerity }
}

/// Motion with this velocity whose light, sent at `position`, reaches `eye` at world time 0.
pub fn passing(beta: DVec3, position: DVec3, eye: DVec3) -> Uniform {
    Uniform { celerity: celerity(beta), anchor: Event { ct: -position.distance(eye), position } }
}

/// Scene of unlit meshes with one material.
pub fn unlit(meshes: Vec<Mesh>, motions: &[Uniform]) -> Scene {
    let materials = vec![Material { unlit: true, ..Material::default() }];
    Scene { materials, meshes, motions: motions.iter().copied().map(Motion::Uniform).collect(), ..Scene::default() }
}

/// Closed, white and unlit sphere of radius one about `centre`, of triangles with edges of at most `edge_m` metres.
///
/// # Panics
/// If that makes too many triangles.
pub fn sphere(centre: DVec3, edge_m: f32) -> Scene {
    let positions = [Vec3::X, Vec3::Y, Vec3::Z, -Vec3::X, -Vec3::Y, -Vec3::Z];
    let octahedron = Mesh {
        positions: positions.to_vec(),
        normals: positions.to_vec(),
        uvs: vec![Vec2::ZERO; 6],
        colours: vec![[1.0; 4]; 6],
        indices: vec![0, 1, 2, 1, 3, 2, 3, 4, 2, 4, 0, 2, 1, 0, 5, 3, 1, 5, 4, 3, 5, 0, 4, 5],
        ..Mesh::default()
    };
    let coarse = Scene { origin: centre, ..unlit(vec![octahedron], &[]) };
    let mut fine = refine(&coarse, edge_m).expect("spheres of tests are small");
    fine.meshes[0].positions.iter_mut().for_each(|position| *position = position.normalize());
    fine
}

/// Box about `centre`. The colour of a face tells its direction: red towards −x, green towards +x, grey elsewhere.
pub fn cuboid(centre: DVec3, half: f64, motion: usize) -> Mesh {
    let mut mesh = Mesh { motion: Some(motion), ..Mesh::default() };
    for axis in [DVec3::X, DVec3::Y, DVec3::Z] {
        for normal in [axis, -axis] {
            let side = normal.any_orthonormal_vector();
            let other = normal.cross(side);
            let first = mesh.positions.len() as u32;
            for (a, b) in [(-1.0, -1.0), (1.0, -1.0), (1.0, 1.0), (-1.0, 1.0)] {
                mesh.positions.push((centre + half * (normal + a * side + b * other)).as_vec3());
            }
            let colour = match normal.x {
                x if x < -0.5 => [1.0, 0.0, 0.0, 1.0],
                x if x > 0.5 => [0.0, 1.0, 0.0, 1.0],
                _ => [GREY, GREY, GREY, 1.0],
            };
            mesh.normals.extend([normal.as_vec3(); 4]);
            mesh.colours.extend([colour; 4]);
            mesh.indices.extend([0, 1, 2, 0, 2, 3].map(|corner| first + corner));
        }
    }
    mesh.uvs = vec![Vec2::ZERO; mesh.positions.len()];
    mesh
}

/// Apparent position of a place of a body, from its worldline in the world. `place` is given in the body's own frame.
pub fn exact(observer: &Observer, motion: &Uniform, place: DVec3) -> Apparent {
    let beta = motion.celerity.beta().vector();
    let gamma = motion.celerity.gamma();
    let along = motion.celerity.direction().unwrap_or(DVec3::X);
    let q = place - motion.anchor.position;
    let now = motion.anchor.position + q - along * (q.dot(along) * (1.0 - 1.0 / gamma));
    let position = now - beta * motion.anchor.ct;
    moving(observer, &PointSource { position, celerity: motion.celerity })
}

/// Directions between neighbouring pixels of which one shows a body and the other does not.
pub fn outline(view: &View, shown: impl Fn(u32, u32) -> bool) -> Vec<DVec3> {
    let [width, height] = view.size;
    let mut directions = Vec::new();
    for (column, row) in (0..height - 1).flat_map(|row| (0..width - 1).map(move |column| (column, row))) {
        let [x, y] = middle([column, row]);
        if shown(column, row) != shown(column + 1, row) {
            directions.push(view.direction([x + 0.5, y]));
        }
        if shown(column, row) != shown(column, row + 1) {
            directions.push(view.direction([x, y + 0.5]));
        }
    }
    directions
}

/// Circle on the sphere of directions: the directions n with n·axis = cosine.
#[derive(Clone, Copy, Debug)]
pub struct Cone {
    /// Axis of the cone, unit vector.
    pub axis: DVec3,
    cosine: f64,
}

impl Cone {
    /// Cone of the tangents from the origin to the unit sphere about `centre`.
    pub fn around(centre: DVec3) -> Self {
        let distance = centre.length();
        Self { axis: centre / distance, cosine: (1.0 - 1.0 / (distance * distance)).sqrt() }
    }

    /// Cone as an observer sees it: directions with n·a = cos α are orthogonal to the four-vector (−cos α, a), which
    /// is boosted.
    pub fn seen_at(&self, celerity: Celerity) -> Self {
        let normal = Boost::observer_from_world(celerity).apply(FourVector { t: -self.cosine, r: self.axis });
        let length = normal.r.length();
        Self { axis: normal.r / length, cosine: -normal.t / length }
    }

    /// Cone in other axes.
    pub fn turned(&self, rotation: DQuat) -> Self {
        Self { axis: rotation * self.axis, ..*self }
    }

    /// Cone nearest to some directions: points of a sphere lie on a circle if they lie in a plane, n·m = 1.
    pub fn through(directions: &[DVec3]) -> Self {
        let outer = |n: DVec3| DMat3::from_cols(n * n.x, n * n.y, n * n.z);
        let squares = directions.iter().fold(DMat3::ZERO, |sum, &n| sum + outer(n));
        let normal = squares.inverse() * directions.iter().sum::<DVec3>();
        Self { axis: normal.normalize(), cosine: 1.0 / normal.length() }
    }

    /// Angle from the axis to the cone, radians.
    pub fn half_angle(&self) -> f64 {
        self.cosine.acos()
    }

    /// Angle from the cone to a direction, radians.
    pub fn distance(&self, direction: DVec3) -> f64 {
        (direction.angle_between(self.axis) - self.half_angle()).abs()
    }

    /// View that looks at the middle of the cone, with room around it.
    pub fn view(&self, size: [u32; 2]) -> View {
        let fov_degrees = (3.0 * self.half_angle()).to_degrees().min(120.0);
        View { look: self.axis, up: DVec3::new(0.3, 0.9, 0.2), fov_degrees, size }
    }

    /// Root mean square distance of directions from the cone, pixels.
    pub fn residual(&self, directions: &[DVec3], view: &View) -> f64 {
        let squares: f64 = directions.iter().map(|&direction| self.distance(direction).powi(2)).sum();
        (squares / directions.len() as f64).sqrt() * view.focal_length()
    }

    /// Largest distance of directions from the cone, pixels.
    pub fn furthest(&self, directions: &[DVec3], view: &View) -> f64 {
        directions.iter().map(|&direction| self.distance(direction)).fold(0.0, f64::max) * view.focal_length()
    }
}
