//! What a picture sees of the world, direction by direction.
//!
//! Directions are those of a cube around the eye, turned so that +z is along the motion: a boost then changes z alone, and x and y keep every
//! digit beside the stern. A part of a face is judged by a cap around it. Aberration maps circles to circles (Penrose 1959), so the cap
//! that the observer sees is known exactly from two points on the meridian through the motion; it is conservative, so that no
//! pixel looks for a pane in vain.

use view::Camera;
use glam::{DMat3, DVec2, DVec3};
use physics::Celerity;

/// How many times more a part may be enlarged in one place than in the mean for its grid to be believed.
const BENT: f64 = 2.0;

/// What is seen: a flat picture, by an observer in motion.
#[derive(Clone, Copy, Debug)]
pub struct Sight {
    /// From the axes of world and observer to the cube's.
    pub cube_from_world: DMat3,
    /// Right, up and forward of the picture, cube's axes.
    picture: [DVec3; 3],
    /// Inward unit normals of the picture's edges, cube's axes.
    edges: [DVec3; 4],
    /// Pixels from the picture's middle to its right and upper edge.
    half_size: DVec2,
    /// Tangents of the picture's middle.
    middle: DVec2,
    /// Pixels per tangent of the picture.
    focal_length: DVec2,
    kappa: f64,
}

/// A square part of a cube's face.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Part {
    /// Index into [`FACES`].
    pub face: usize,
    /// Tangents of its middle.
    pub middle: DVec2,
    /// Tangents from its middle to its edge.
    pub half: f64,
}

/// How large a part is in the picture, across and down.
#[derive(Clone, Copy, Debug)]
pub struct Extent {
    /// Pixels, if it were everywhere as large as where it is largest.
    pub most: DVec2,
    /// Pixels, by the root mean square.
    pub mean: DVec2,
    /// All of it is in the picture.
    pub inside: bool,
}

/// Right, up and forward of a cube's face for one who looks at it from within, cube's axes; `warp.wgsl` orders them alike.
pub const FACES: [[DVec3; 3]; 6] = [
    [DVec3::Y, DVec3::X, DVec3::Z],
    [DVec3::X, DVec3::Y, DVec3::NEG_Z],
    [DVec3::Z, DVec3::Y, DVec3::X],
    [DVec3::Y, DVec3::Z, DVec3::NEG_X],
    [DVec3::X, DVec3::Z, DVec3::Y],
    [DVec3::Z, DVec3::X, DVec3::NEG_Y],
];

/// A circle of directions and all within it, in the observer's frame.
#[derive(Clone, Copy, Debug)]
struct Cap {
    middle: DVec3,
    /// Up to π.
    radius_rad: f64,
}

impl Sight {
    /// What `camera` sees, of `size` pixels, in motion with `celerity`.
    pub fn new(camera: &Camera, size: [u32; 2], celerity: Celerity) -> Self {
        let axis = |eye: DVec3| camera.observer_from_eye * eye;
        let (forward, right, up) = (axis(DVec3::NEG_Z), axis(DVec3::X), axis(DVec3::Y));
        let [width, height] = size.map(f64::from);
        // Samples lie anywhere in a pixel, so the picture is taken to be one pixel wider all round.
        let tangents = camera.tangents(size);
        let focal_length = tangents.focal_length(size);
        let (low, high) = (tangents.low - 1.0 / focal_length, tangents.high + 1.0 / focal_length);

        // The cube: z along the motion; x towards the middle of the picture, if that is another direction.
        let motion = celerity.vector().normalize_or(forward);
        let side = [forward, right, up].into_iter().map(|axis| axis - axis.dot(motion) * motion);
        let side = side.max_by(|a, b| a.length_squared().total_cmp(&b.length_squared()));
        let x = side.unwrap_or(right).normalize();
        let cube_from_world = DMat3::from_cols(x, motion.cross(x), motion).transpose();

        let edge = |sideways: DVec3, extent: f64| cube_from_world * (sideways + extent * forward).normalize();
        Self {
            cube_from_world,
            picture: [right, up, forward].map(|axis| cube_from_world * axis),
            edges: [edge(right, -low.x), edge(-right, high.x), edge(up, -low.y), edge(-up, high.y)],
            middle: tangents.middle(),
            half_size: 0.5 * DVec2::new(width, height),
            focal_length,
            kappa: celerity.gamma() + celerity.magnitude(),
        }
    }

    /// Whether any of a part may be in the picture.
    pub fn sees(&self, part: &Part) -> bool {
        let cap = self.cap(part);
        let reach = cap.radius_rad.min(std::f64::consts::FRAC_PI_2).sin();
        self.edges.iter().all(|edge| edge.dot(cap.middle) >= -reach)
    }

    /// The cap that the observer sees around a part of the cube.
    fn cap(&self, part: &Part) -> Cap {
        let middle = part.direction(DVec2::ZERO);
        let corners = [DVec2::new(-1.0, -1.0), DVec2::new(1.0, -1.0), DVec2::new(-1.0, 1.0), DVec2::ONE];
        let radius = corners.into_iter().map(|corner| angle(middle, part.direction(corner))).fold(0.0, f64::max);

        // Along the meridian from the motion through the middle, angles shrink as tan(θ'/2) = tan(θ/2) / κ; both ends of the cap do.
        let from_motion = f64::atan2(middle.truncate().length(), middle.z);
        let seen = |world: f64| 2.0 * f64::atan2((0.5 * world).sin(), self.kappa * (0.5 * world).cos());
        let (near, far) = (seen(from_motion - radius), seen(from_motion + radius));
        let meridian = middle.truncate().normalize_or(DVec2::X);
        let (sine, cosine) = (0.5 * (near + far)).sin_cos();
        Cap { middle: (meridian * sine).extend(cosine), radius_rad: 0.5 * (far - near) }
    }

    /// Where a direction of the world is in the picture, pixels from its middle; `None` if behind the eye.
    pub fn pixel(&self, world: DVec3) -> Option<DVec2> {
        // The boost scales the two light-cone coordinates, which nothing cancels in.
        let across = world.truncate().length_squared();
        let length = (across + world.z * world.z).sqrt();
        let big = length + world.z.abs();
        let small = across / big;
        let (ahead, behind) = if world.z >= 0.0 { (big, small) } else { (small, big) };
        let observed = world.truncate().extend(0.5 * (ahead * self.kappa - behind / self.kappa));
        let [right, up, forward] = self.picture.map(|axis| axis.dot(observed));
        (forward > 0.0).then(|| (DVec2::new(right, up) / forward - self.middle) * self.focal_length)
    }

    /// How large a part is in the picture. `None` if a grid on it cannot tell.
    pub fn extent(&self, part: &Part) -> Option<Extent> {
        const STEPS: usize = 4;
        let at = |column: usize, row: usize| {
            let place = DVec2::new(column as f64, row as f64) * (2.0 / STEPS as f64) - 1.0;
            self.pixel(part.direction(place))
        };
        // At least as far as a part can be seen that is only just in sight.
        let near = 1.25 * self.half_size + 2.0;
        let shown = |pixel: DVec2| pixel.abs().cmple(near).all();
        let (mut most, mut squares, mut counts) = (DVec2::ZERO, DVec2::ZERO, DVec2::ZERO);
        let (mut behind, mut inside) = (false, true);
        for row in 0..=STEPS {
            for column in 0..=STEPS {
                let here = at(column, row);
                behind |= here.is_none();
                inside &= here.is_some_and(|pixel| pixel.abs().cmple(self.half_size).all());
                for (axis, [column, row]) in [(0, [column + 1, row]), (1, [column, row + 1])] {
                    if column <= STEPS
                        && row <= STEPS
                        && let (Some(here), Some(there)) = (here, at(column, row))
                        && (shown(here) || shown(there))
                    {
                        most[axis] = most[axis].max(here.distance(there));
                        squares[axis] += here.distance_squared(there);
                        counts[axis] += 1.0;
                    }
                }
            }
        }
        let mean = DVec2::new((squares.x / counts.x).sqrt(), (squares.y / counts.y).sqrt());
        // A grid that is bent too much, or reaches behind the eye, says little about what is between its points.
        let told = counts.min_element() > 0.0 && !behind && most.cmple(BENT * mean).all();
        let steps = STEPS as f64;
        told.then_some(Extent { most: steps * most, mean: steps * mean, inside })
    }
}

impl Part {
    /// Towards a place in it, −1 to 1 from left to right and from below to above; not normalised.
    pub fn direction(&self, place: DVec2) -> DVec3 {
        let [right, up, forward] = FACES[self.face];
        let tangent = self.middle + self.half * place;
        forward + tangent.x * right + tangent.y * up
    }

    /// Left below, right below, left above, right above.
    pub fn quarters(self) -> [Self; 4] {
        let half = 0.5 * self.half;
        let quarter = |x: f64, y: f64| Self { middle: self.middle + half * DVec2::new(x, y), half, ..self };
        [quarter(-1.0, -1.0), quarter(1.0, -1.0), quarter(-1.0, 1.0), quarter(1.0, 1.0)]
    }
}

fn angle(one: DVec3, other: DVec3) -> f64 {
    f64::atan2(one.cross(other).length(), one.dot(other))
}
