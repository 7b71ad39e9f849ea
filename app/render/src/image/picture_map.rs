//! Picture map: the directions of the world that a picture sees, and their size in it.
//!
//! Directions are those of a cube around the eye, turned so that +z is along the motion. A boost then changes z
//! alone, and x and y keep every digit near dead astern. A part of a face is judged by a cap around it. Aberration
//! maps circles to circles (Penrose 1959), so the cap that the observer sees is known exactly from two points on the
//! meridian through the motion. The cap is conservative, so that every pixel finds its pane.

use glam::{DMat3, DVec2, DVec3};
use physics::{Celerity, LightConeCoordinates};
use view::Camera;

/// Largest ratio of the greatest enlargement to the mean at which the grid on a part is trusted.
const BENT: f64 = 2.0;

/// Picture map of a flat picture by an observer in motion.
#[derive(Clone, Copy, Debug)]
pub struct PictureMap {
    /// Rotation from the axes of world and observer to those of the cube.
    pub cube_from_world: DMat3,
    /// Right, up and forward of the picture, cube's axes.
    picture: [DVec3; 3],
    /// Inward unit normals of the picture's edges, cube's axes.
    edges: [DVec3; 4],
    /// Pixels from the middle of the picture to its right and upper edge.
    half_size: DVec2,
    /// Tangents of the middle of the picture.
    middle: DVec2,
    /// Pixels of the picture for each unit of tangent.
    focal_length: DVec2,
    kappa: f64,
}

/// A square part of a cube's face.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct CubePart {
    /// Index into [`FACES`].
    pub face: usize,
    /// Tangents of the middle of the part.
    pub middle: DVec2,
    /// Tangents from the middle of the part to its edge.
    pub half: f64,
}

/// Size of a part in the picture, across and down.
#[derive(Clone, Copy, Debug)]
pub struct Extent {
    /// Size by the greatest enlargement anywhere in the part, pixels.
    pub most: DVec2,
    /// Size by the root mean square of the enlargement, pixels.
    pub mean: DVec2,
    /// True if the whole part is in the picture.
    pub inside: bool,
}

/// Right, up and forward of each of the cube's faces, seen from within, cube's axes. `warp.wgsl` uses the same order.
pub const FACES: [[DVec3; 3]; 6] = [
    [DVec3::Y, DVec3::X, DVec3::Z],
    [DVec3::X, DVec3::Y, DVec3::NEG_Z],
    [DVec3::Z, DVec3::Y, DVec3::X],
    [DVec3::Y, DVec3::Z, DVec3::NEG_X],
    [DVec3::X, DVec3::Z, DVec3::Y],
    [DVec3::Z, DVec3::X, DVec3::NEG_Y],
];

/// A circle of directions with its inside, in the observer's frame.
#[derive(Clone, Copy, Debug)]
struct Cap {
    middle: DVec3,
    /// Angle from the middle to the circle, radians, at most π.
    radius_rad: f64,
}

impl PictureMap {
    /// Picture map of `camera` with `size` pixels, moving with `celerity`.
    pub fn new(camera: &Camera, size: [u32; 2], celerity: Celerity) -> Self {
        let axis = |eye: DVec3| camera.observer_from_eye * eye;
        let (forward, right, up) = (axis(DVec3::NEG_Z), axis(DVec3::X), axis(DVec3::Y));
        let [width, height] = size.map(f64::from);
        // Samples lie anywhere in a pixel, so the picture is taken one pixel wider all round.
        let tangents = camera.tangents(size);
        let focal_length = tangents.focal_length(size);
        let (low, high) = (tangents.low - 1.0 / focal_length, tangents.high + 1.0 / focal_length);

        // The cube has z along the motion, and x towards the middle of the picture, if that is another direction.
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
            kappa: celerity.kappa(),
        }
    }

    /// True if any of a part may be in the picture.
    pub fn sees(&self, part: &CubePart) -> bool {
        let cap = self.cap(part);
        let reach = cap.radius_rad.min(std::f64::consts::FRAC_PI_2).sin();
        self.edges.iter().all(|edge| edge.dot(cap.middle) >= -reach)
    }

    /// Cap around a part of the cube, in the observer's frame.
    fn cap(&self, part: &CubePart) -> Cap {
        let middle = part.direction(DVec2::ZERO);
        let corners = [DVec2::new(-1.0, -1.0), DVec2::new(1.0, -1.0), DVec2::new(-1.0, 1.0), DVec2::ONE];
        let radius = corners.into_iter().map(|corner| angle(middle, part.direction(corner))).fold(0.0, f64::max);

        // Along the meridian from the motion through the middle, angles shrink as tan(θ'/2) = tan(θ/2) / κ, so both
        // ends of the cap are known.
        let from_motion = f64::atan2(middle.truncate().length(), middle.z);
        let seen = |world: f64| 2.0 * f64::atan2((0.5 * world).sin(), self.kappa * (0.5 * world).cos());
        let (near, far) = (seen(from_motion - radius), seen(from_motion + radius));
        let meridian = middle.truncate().normalize_or(DVec2::X);
        let (sine, cosine) = (0.5 * (near + far)).sin_cos();
        Cap { middle: (meridian * sine).extend(cosine), radius_rad: 0.5 * (far - near) }
    }

    /// Place of a world direction in the picture, pixels from the middle; `None` if it is behind the eye.
    pub fn pixel(&self, world: DVec3) -> Option<DVec2> {
        // The boost scales the two light-cone coordinates. Their computation has no cancellation.
        let seen = LightConeCoordinates::of(world.z, world.truncate().length_squared()).boosted(self.kappa);
        let observed = world.truncate().extend(seen.along());
        let [right, up, forward] = self.picture.map(|axis| axis.dot(observed));
        (forward > 0.0).then(|| (DVec2::new(right, up) / forward - self.middle) * self.focal_length)
    }

    /// Size of a part in the picture. `None` if a grid on the part cannot tell it.
    pub fn extent(&self, part: &CubePart) -> Option<Extent> {
        const STEPS: usize = 4;
        let at = |column: usize, row: usize| {
            let place = DVec2::new(column as f64, row as f64) * (2.0 / STEPS as f64) - 1.0;
            self.pixel(part.direction(place))
        };
        // Margin of at least the distance at which a part that is barely in sight can be seen.
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
        // A grid that is bent too much, or reaches behind the eye, says little about the space between its points.
        let told = counts.min_element() > 0.0 && !behind && most.cmple(BENT * mean).all();
        let steps = STEPS as f64;
        told.then_some(Extent { most: steps * most, mean: steps * mean, inside })
    }
}

impl CubePart {
    /// Vector towards a place in the part; x from −1 left to 1 right, y from −1 below to 1 above. Not normalised.
    pub fn direction(&self, place: DVec2) -> DVec3 {
        let [right, up, forward] = FACES[self.face];
        let tangent = self.middle + self.half * place;
        forward + tangent.x * right + tangent.y * up
    }

    /// Quarters in the order lower left, lower right, upper left, upper right.
    pub fn quarters(self) -> [Self; 4] {
        let half = 0.5 * self.half;
        let quarter = |x: f64, y: f64| Self { middle: self.middle + half * DVec2::new(x, y), half, ..self };
        [quarter(-1.0, -1.0), quarter(1.0, -1.0), quarter(-1.0, 1.0), quarter(1.0, 1.0)]
    }
}

fn angle(one: DVec3, other: DVec3) -> f64 {
    f64::atan2(one.cross(other).length(), one.dot(other))
}
