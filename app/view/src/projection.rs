//! Projections: the direction that each place of a picture shows, and the eye that sees it in stereo.
//!
//! Directions are in the axes of the eye: x right, y up, −z through the middle of the picture.

use crate::shot::Shot;
use glam::{DVec2, DVec3};
use std::f64::consts::PI;
use std::fmt::{self, Display, Formatter};
use std::str::FromStr;
use thiserror::Error;

/// Full angle of a dome, degrees.
const DOME_DEGREES: f64 = 180.0;

/// Map from the places of a picture to directions.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub enum Projection {
    /// Plane ahead, as a pinhole camera sees it.
    #[default]
    Flat,
    /// All directions: the width is the whole turn, the height the angle from below to above (equirectangular), twice
    /// as wide as high.
    Sphere,
    /// Disc in a square whose radius is the angle from the middle (equidistant fisheye): a dome master.
    Fisheye {
        /// Full angle of the disc, radians, up to 2π.
        full_rad: f64,
    },
    /// Six faces of a cube in three columns and two rows: right, left, above; below, ahead, behind.
    Cube,
    /// Directions ahead, half of [`Sphere`](Self::Sphere), in a square.
    Vr180,
}

/// Text that names no projection.
#[derive(Clone, Debug, Error, PartialEq, Eq)]
#[error(
    "expected flat, sphere, fisheye, fisheye with a full angle in degrees from 1 to 360 as in fisheye:220, cube or vr180"
)]
pub struct ProjectionError;

/// Eye that turns with the direction it looks in, about an upright axis: omnidirectional stereo.
///
/// *Equation:* the eye that sees direction d lies at a d × u / |d × u|, u being upright (Peleg and Ben-Ezra 1999;
/// Google, Rendering Omni-directional Stereo Content). Straight above and below, where that has no direction, the eye
/// is in the middle.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct TurningEye {
    /// Distance a of the eye from the head's middle, metres: to the right if positive.
    pub aside_m: f64,
    /// Axis about which the head turns, a unit vector.
    pub upright: DVec3,
}

/// Way in which a picture takes its directions from an eye.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Framing {
    /// Map from places to directions.
    pub projection: Projection,
    /// Eye of a stereo picture; `None` for an eye in one place.
    pub eye: Option<TurningEye>,
}

/// Line of sight of a place in a picture.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct PlaceSight {
    /// Place of the eye from the shot's observer, at one time of the observer, metres.
    pub from_m: DVec3,
    /// Direction; (x, y, −1) in a flat picture, else a unit vector.
    pub ahead: DVec3,
    /// True in a flat picture.
    pub is_flat: bool,
}

impl Projection {
    /// Width and height of a picture that is not told its size, pixels.
    pub fn usual_size(self) -> [u32; 2] {
        match self {
            Self::Flat => [1280, 720],
            Self::Sphere => [4096, 2048],
            Self::Fisheye { .. } | Self::Vr180 => [2048, 2048],
            Self::Cube => [3072, 2048],
        }
    }

    /// Ratio of width and height that every picture has, in small whole numbers; `None` if any will do.
    pub fn shape(self) -> Option<[u32; 2]> {
        match self {
            Self::Flat => None,
            Self::Sphere => Some([2, 1]),
            Self::Fisheye { .. } | Self::Vr180 => Some([1, 1]),
            Self::Cube => Some([3, 2]),
        }
    }

    /// Direction of a place in a picture of `size` pixels, a unit vector; `None` where a picture shows nothing, and for
    /// a flat picture, whose camera knows.
    ///
    /// *Units:* pixels from the upper left corner; the centre of the first pixel is at one half.
    pub fn direction(self, size: [u32; 2], place: DVec2) -> Option<DVec3> {
        let share = place / DVec2::new(f64::from(size[0]), f64::from(size[1]));
        match self {
            Self::Flat => None,
            Self::Sphere => Some(on_sphere((2.0 * share.x - 1.0) * PI, (0.5 - share.y) * PI)),
            Self::Vr180 => Some(on_sphere((share.x - 0.5) * PI, (0.5 - share.y) * PI)),
            Self::Fisheye { full_rad } => {
                let out = (2.0 * share - 1.0) * DVec2::new(1.0, -1.0);
                let (sine, cosine) = (0.5 * full_rad * out.length()).sin_cos();
                (out.length() <= 1.0).then(|| (out.normalize_or_zero() * sine).extend(-cosine))
            }
            Self::Cube => {
                let face = (share * DVec2::new(3.0, 2.0)).floor().clamp(DVec2::ZERO, DVec2::new(2.0, 1.0));
                let within = (share * DVec2::new(3.0, 2.0) - face) * 2.0 - 1.0;
                let index = face.x as usize + 3 * face.y as usize;
                let [right, up, back] = FACES[index];
                Some((right * within.x - up * within.y - back).normalize())
            }
        }
    }
}

/// Axes of a cube's faces in the order of [`Projection::Cube`]: right, up and back of each.
pub const FACES: [[DVec3; 3]; 6] = [
    [DVec3::Z, DVec3::Y, DVec3::NEG_X],
    [DVec3::NEG_Z, DVec3::Y, DVec3::X],
    [DVec3::X, DVec3::Z, DVec3::NEG_Y],
    [DVec3::X, DVec3::NEG_Z, DVec3::Y],
    [DVec3::X, DVec3::Y, DVec3::Z],
    [DVec3::NEG_X, DVec3::Y, DVec3::NEG_Z],
];

/// Direction at a longitude, to the right from straight ahead, and a latitude, radians.
fn on_sphere(longitude: f64, latitude: f64) -> DVec3 {
    let (across, ahead) = longitude.sin_cos();
    let (up, level) = latitude.sin_cos();
    DVec3::new(across * level, up, -ahead * level)
}

impl Display for Projection {
    fn fmt(&self, f: &mut Formatter<'_>) -> fmt::Result {
        match self {
            Self::Flat => f.write_str("flat"),
            Self::Sphere => f.write_str("sphere"),
            Self::Fisheye { full_rad } => write!(f, "fisheye:{}", full_rad.to_degrees()),
            Self::Cube => f.write_str("cube"),
            Self::Vr180 => f.write_str("vr180"),
        }
    }
}

impl FromStr for Projection {
    type Err = ProjectionError;
    fn from_str(text: &str) -> Result<Self, ProjectionError> {
        let fisheye = |degrees: f64| Self::Fisheye { full_rad: degrees.to_radians() };
        match text {
            "flat" => Ok(Self::Flat),
            "sphere" => Ok(Self::Sphere),
            "fisheye" => Ok(fisheye(DOME_DEGREES)),
            "cube" => Ok(Self::Cube),
            "vr180" => Ok(Self::Vr180),
            text => {
                let degrees = text.strip_prefix("fisheye:").and_then(|degrees| degrees.parse().ok());
                degrees.filter(|degrees| (1.0..=360.0).contains(degrees)).map(fisheye).ok_or(ProjectionError)
            }
        }
    }
}

impl TurningEye {
    /// Place of the eye that sees a direction, from the head's middle, metres.
    pub fn place_m(&self, direction: DVec3) -> DVec3 {
        direction.cross(self.upright).normalize_or_zero() * self.aside_m
    }
}

impl Framing {
    /// Line of sight of a place in the picture of a shot, of `size` pixels; `None` where nothing is shown.
    pub fn sight(&self, shot: &Shot, size: [u32; 2], place: DVec2) -> Option<PlaceSight> {
        let ahead = match self.projection {
            Projection::Flat => shot.camera.ahead(size, place),
            projection => projection.direction(size, place)?,
        };
        let from_m = self.eye.map_or(DVec3::ZERO, |eye| eye.place_m(ahead));
        Some(PlaceSight { from_m, ahead, is_flat: self.projection == Projection::Flat })
    }
}

#[cfg(test)]
mod tests {
    //! Law: the pixels of a projection cover exactly the directions that its name says, each once, at the angles that
    //! its name says; an eye of a stereo picture is square to what it looks at. A wrong program mirrors or stretches a
    //! dome, or turns depth inside out.
    #![allow(clippy::unwrap_used, reason = "a failed construction is a failed test")]

    use super::*;

    const DOME: Projection = Projection::Fisheye { full_rad: PI };

    /// Solid angle of a picture: of the two triangles that each pixel's corners make (Van Oosterom and Strackee 1983).
    fn solid_angle(projection: Projection, size: [u32; 2]) -> f64 {
        let mut sum = 0.0;
        for row in 0..size[1] {
            for column in 0..size[0] {
                // Corners are taken a little inwards, so that all lie on one face of a cube.
                let corner = |x: f64, y: f64| {
                    let inwards = |at: f64| 0.5 + (at - 0.5) * (1.0 - 1e-9);
                    let place = DVec2::new(f64::from(column) + inwards(x), f64::from(row) + inwards(y));
                    projection.direction(size, place)
                };
                let corners = [corner(0.0, 0.0), corner(1.0, 0.0), corner(1.0, 1.0), corner(0.0, 1.0)];
                let [Some(a), Some(b), Some(c), Some(d)] = corners else { continue };
                for [a, b, c] in [[a, b, c], [a, c, d]] {
                    let below = 1.0 + a.dot(b) + b.dot(c) + c.dot(a);
                    // Seen from within, these corners go round clockwise.
                    sum += 2.0 * a.dot(b.cross(c)).atan2(below);
                }
            }
        }
        sum
    }

    #[test]
    fn pixels_cover_the_whole_sphere_once() {
        let full = [(Projection::Sphere, [256, 128]), (Projection::Cube, [96, 64])];
        for (projection, size) in full {
            let covered = solid_angle(projection, size);
            assert!((covered / (4.0 * PI) - 1.0).abs() < 1e-6, "{projection}: {covered}");
        }
        assert!((solid_angle(Projection::Vr180, [128, 128]) / (2.0 * PI) - 1.0).abs() < 1e-6);
        // Pixels on the rim of a disc are left out here: less than two rows of them.
        for (degrees, covered) in [(180.0_f64, 2.0 * PI), (360.0, 4.0 * PI), (90.0, 2.0 * PI * (1.0 - 0.5_f64.sqrt()))]
        {
            let dome = Projection::Fisheye { full_rad: degrees.to_radians() };
            let share = solid_angle(dome, [512, 512]) / covered;
            assert!(share < 1.0 && share > 0.98, "fisheye:{degrees}: {share}");
        }
    }

    #[test]
    fn angles_of_a_dome_are_even() {
        let size = [1000, 1000];
        for (place, angle) in
            [((500.0, 500.0), 0.0), ((750.0, 500.0), 45.0), ((500.0, 0.0), 90.0), ((500.0, 900.0), 72.0)]
        {
            let towards = DOME.direction(size, DVec2::new(place.0, place.1)).unwrap();
            assert!((towards.angle_between(DVec3::NEG_Z).to_degrees() - angle).abs() < 1e-9, "{place:?}");
        }
        // Right is right and up is up; beyond the rim there is nothing.
        assert!(DOME.direction(size, DVec2::new(999.0, 500.0)).unwrap().x > 0.99);
        assert!(DOME.direction(size, DVec2::new(500.0, 1.0)).unwrap().y > 0.99);
        assert_eq!(DOME.direction(size, DVec2::new(900.0, 900.0)), None);
    }

    #[test]
    fn every_face_of_a_cube_joins_the_one_ahead() {
        let size = [30, 20];
        let near = |column: f64, row: f64| Projection::Cube.direction(size, DVec2::new(column, row)).unwrap();
        for (middle, towards) in [
            ((5.0, 5.0), DVec3::X),
            ((15.0, 5.0), DVec3::NEG_X),
            ((25.0, 5.0), DVec3::Y),
            ((5.0, 15.0), DVec3::NEG_Y),
            ((15.0, 15.0), DVec3::NEG_Z),
            ((25.0, 15.0), DVec3::Z),
        ] {
            assert!(near(middle.0, middle.1).distance(towards) < 1e-12);
        }
        // Edges of the face ahead, and the places beside them: left of the right face, right of the left one, the
        // lower edge of the one above, the upper edge of the one below.
        let tiny = 1e-9;
        for (ahead, beside) in [
            ((20.0 - tiny, 13.0), (tiny, 3.0)),
            ((10.0 + tiny, 13.0), (20.0 - tiny, 3.0)),
            ((13.0, 10.0 + tiny), (23.0, 10.0 - tiny)),
            ((13.0, 20.0 - tiny), (3.0, 10.0 + tiny)),
        ] {
            assert!(near(ahead.0, ahead.1).distance(near(beside.0, beside.1)) < 1e-8, "{ahead:?}");
        }
    }

    #[test]
    fn a_turning_eye_is_square_to_its_view() {
        let eye = TurningEye { aside_m: 0.032, upright: DVec3::Y };
        for step in 0..8 {
            let longitude = f64::from(step) * PI / 4.0;
            for latitude in [-1.2, 0.0, 0.7] {
                let place = eye.place_m(on_sphere(longitude, latitude));
                assert!(place.distance(0.032 * DVec3::new(longitude.cos(), 0.0, longitude.sin())) < 1e-12);
            }
        }
        assert_eq!(eye.place_m(DVec3::Y), DVec3::ZERO);
    }

    #[test]
    fn names_are_read_as_they_are_written() {
        for name in ["flat", "sphere", "cube", "vr180", "fisheye:220", "fisheye:180"] {
            assert_eq!(name.parse::<Projection>().unwrap().to_string(), name);
        }
        assert_eq!("fisheye".parse::<Projection>().unwrap(), DOME);
        for wrong in ["", "dome", "fisheye:0", "fisheye:361", "fisheye:NaN", "Sphere"] {
            assert_eq!(wrong.parse::<Projection>(), Err(ProjectionError), "{wrong}");
        }
    }
}
