//! Picture map: the directions of the world that a picture sees, and their size in it.
//!
//! Directions are those of a cube around the eye, turned so that +z is along the motion. A boost then changes z
//! alone, and x and y keep every digit near dead astern. A part of a face is judged by a cone around it. Aberration
//! maps circles to circles (Penrose 1959), so the cone that the observer sees is known exactly from two points on the
//! meridian through the motion. The cone is conservative, so that every pixel finds its pane.

use glam::{DMat3, DVec2, DVec3};
use physics::{Celerity, DirectionCone, LightConeCoordinates};
use view::{Camera, Sides};

/// Largest ratio of the greatest enlargement to the mean at which the grid on a part is trusted.
const BENT: f64 = 2.0;

/// Directions that flat pictures by one observer in motion see, and their sizes in them. The pictures together may
/// stand for one that is not flat.
#[derive(Clone, Debug)]
pub struct PictureMap {
    /// Rotation from the axes of world and observer to those of the cube.
    pub cube_from_world: DMat3,
    pictures: Vec<MappedPicture>,
    kappa: f64,
}

/// A flat picture in the cube's axes.
#[derive(Clone, Copy, Debug)]
struct MappedPicture {
    /// Right, up and forward of the picture.
    axes: [DVec3; 3],
    /// Sides of the picture.
    sides: Sides,
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

impl PictureMap {
    /// Map for pictures by an observer of this celerity: their cameras, and their sizes in pixels. There must be one.
    pub fn new(pictures: &[(Camera, [u32; 2])], celerity: Celerity) -> Self {
        // The cube has z along the motion, and x towards the middle of the first picture, if that is another direction.
        let axis = |eye: DVec3| pictures[0].0.observer_from_eye * eye;
        let (forward, right, up) = (axis(DVec3::NEG_Z), axis(DVec3::X), axis(DVec3::Y));
        let motion = celerity.vector().normalize_or(forward);
        let side = [forward, right, up].into_iter().map(|axis| axis - axis.dot(motion) * motion);
        let side = side.max_by(|a, b| a.length_squared().total_cmp(&b.length_squared()));
        let x = side.unwrap_or(right).normalize();
        let cube_from_world = DMat3::from_cols(x, motion.cross(x), motion).transpose();

        let kappa = celerity.kappa();
        let mapped = |(camera, size): &(Camera, [u32; 2])| MappedPicture::new(camera, *size, &cube_from_world, kappa);
        Self { cube_from_world, pictures: pictures.iter().map(mapped).collect(), kappa }
    }

    /// True if any of a part may be in a picture.
    pub fn sees(&self, part: &CubePart) -> bool {
        let cone = self.cone(part);
        self.pictures.iter().any(|picture| picture.sides.may_show(&cone))
    }

    /// Size of a part in the pictures: in the one where it is largest. `None` if a grid on the part cannot tell it.
    pub fn extent(&self, part: &CubePart) -> Option<Extent> {
        let cone = self.cone(part);
        let seeing = self.pictures.iter().filter(|picture| picture.sides.may_show(&cone));
        seeing.map(|picture| picture.extent(part)).reduce(|one, other| Some(one?.or_larger(other?))).flatten()
    }

    /// Cone around a part of the cube as the observer sees it, cube's axes.
    fn cone(&self, part: &CubePart) -> DirectionCone {
        let middle = part.direction(DVec2::ZERO);
        let corners = [DVec2::new(-1.0, -1.0), DVec2::new(1.0, -1.0), DVec2::new(-1.0, 1.0), DVec2::ONE];
        let radius = corners.into_iter().map(|corner| angle(middle, part.direction(corner))).fold(0.0, f64::max);

        // Along the meridian from the motion through the middle, angles shrink as tan(θ'/2) = tan(θ/2) / κ, so both
        // ends of the cone are known.
        let from_motion = f64::atan2(middle.truncate().length(), middle.z);
        let seen = |world: f64| 2.0 * f64::atan2((0.5 * world).sin(), self.kappa * (0.5 * world).cos());
        let (near, far) = (seen(from_motion - radius), seen(from_motion + radius));
        let meridian = middle.truncate().normalize_or(DVec2::X);
        let (sine, cosine) = (0.5 * (near + far)).sin_cos();
        DirectionCone { axis: (meridian * sine).extend(cosine), radius_rad: 0.5 * (far - near) }
    }
}

impl Extent {
    fn or_larger(self, other: Self) -> Self {
        Self { most: self.most.max(other.most), mean: self.mean.max(other.mean), inside: self.inside || other.inside }
    }
}

impl MappedPicture {
    fn new(camera: &Camera, size: [u32; 2], cube_from_world: &DMat3, kappa: f64) -> Self {
        let axis = |eye: DVec3| *cube_from_world * (camera.observer_from_eye * eye);
        let tangents = camera.tangents(size);
        let [width, height] = size.map(f64::from);
        Self {
            axes: [axis(DVec3::X), axis(DVec3::Y), axis(DVec3::NEG_Z)],
            // Samples lie anywhere in a pixel, so the picture is taken one pixel wider all round.
            sides: Sides::of(camera, size, 1.0).turned(cube_from_world),
            middle: tangents.middle(),
            half_size: 0.5 * DVec2::new(width, height),
            focal_length: tangents.focal_length(size),
            kappa,
        }
    }

    /// Place of a world direction in the picture, pixels from the middle; `None` if it is behind the eye.
    fn pixel(&self, world: DVec3) -> Option<DVec2> {
        // The boost scales the two light-cone coordinates. Their computation has no cancellation.
        let seen = LightConeCoordinates::of(world.z, world.truncate().length_squared()).boosted(self.kappa);
        let observed = world.truncate().extend(seen.along());
        let [right, up, forward] = self.axes.map(|axis| axis.dot(observed));
        (forward > 0.0).then(|| (DVec2::new(right, up) / forward - self.middle) * self.focal_length)
    }

    /// Size of a part in the picture. `None` if a grid on the part cannot tell it.
    fn extent(&self, part: &CubePart) -> Option<Extent> {
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
