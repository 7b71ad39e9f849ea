//! The vertices of a mesh at rest in the world, laid out for the kernel.
//!
//! Three streams of f32 hold the coordinates relative to one f64 origin, so that a mesh a million metres from the
//! world's origin keeps its detail. Streams are made of lines, as many vertices as the kernel takes at a time, the
//! last one padded: the kernel loads whole aligned lines and needs no special case at the end. Every chunk of
//! [`CHUNK`] vertices carries a bounding sphere, which tells the kernel once per frame if any of them lies so nearly
//! astern that the exact form is needed.

use glam::{DVec3, Vec3};

use super::error::PhotoSurfaceError;
use super::eye::PhotoSurfaceEye;
use super::line::{CHUNK, LINE, VertexLine};
use super::plan::{FormulaChoice, FramePlan};
use super::sphere::BoundingSphere;

/// The vertices of one mesh at rest in the world frame.
///
/// A vertex whose coordinates are not finite (as given, or once rounded to f32 metres from the origin) keeps
/// its index, is listed by [`Vertices::not_finite`], and is never given a direction by the kernel.
#[derive(Clone, Debug)]
pub struct Vertices {
    origin: DVec3,
    count: usize,
    streams: [Vec<VertexLine>; 3],
    spheres: Vec<BoundingSphere>,
    not_finite: Vec<usize>,
}

impl Vertices {
    /// Takes positions in the world frame, in metres, and rounds them to f32 relative to `origin`.
    ///
    /// # Errors
    /// [`PhotoSurfaceError::Origin`] if `origin` is not finite.
    ///
    /// # Accuracy
    /// A position is rounded by at most 6e-8 of its distance from `origin`: choose the middle of the mesh.
    ///
    /// # Example
    /// ```
    /// use glam::DVec3;
    /// use physics::photo_surface::Vertices;
    ///
    /// let corner = DVec3::new(1e6, 0.0, -3.0);
    /// let vertices = Vertices::from_world(corner, [corner, corner + DVec3::Y, DVec3::splat(f64::NAN)])?;
    /// assert_eq!(vertices.len(), 3);
    /// assert_eq!(vertices.not_finite(), [2]);
    /// # Ok::<(), physics::photo_surface::PhotoSurfaceError>(())
    /// ```
    pub fn from_world(origin: DVec3, positions: impl IntoIterator<Item = DVec3>) -> Result<Self, PhotoSurfaceError> {
        Self::from_offsets(origin, positions.into_iter().map(|p| (p - origin).as_vec3()))
    }

    /// Takes positions relative to `origin` (world axes, metres) as they are.
    ///
    /// # Errors
    /// [`PhotoSurfaceError::Origin`] if `origin` is not finite.
    pub fn from_offsets(origin: DVec3, offsets: impl IntoIterator<Item = Vec3>) -> Result<Self, PhotoSurfaceError> {
        if !origin.is_finite() {
            return Err(PhotoSurfaceError::Origin { origin });
        }
        let mut vertices =
            Self { origin, count: 0, streams: [const { Vec::new() }; 3], spheres: Vec::new(), not_finite: Vec::new() };
        for offset in offsets {
            vertices.push(offset);
        }
        vertices.spheres = (0..vertices.count).step_by(CHUNK).map(|first| vertices.bounding_sphere(first)).collect();
        Ok(vertices)
    }

    fn push(&mut self, offset: Vec3) {
        if !offset.is_finite() {
            self.not_finite.push(self.count);
        }
        let lane = self.count % LINE;
        for (stream, coordinate) in self.streams.iter_mut().zip(offset.to_array()) {
            if lane == 0 {
                stream.push(VertexLine([0.0; LINE]));
            }
            if let Some(line) = stream.last_mut() {
                line.0[lane] = coordinate;
            }
        }
        self.count += 1;
    }

    /// Sphere about the middle of the box around the chunk's finite vertices.
    fn bounding_sphere(&self, first: usize) -> BoundingSphere {
        let finite =
            || (first..self.count.min(first + CHUNK)).map(|index| self.offset(index)).filter(|p| p.is_finite());
        let mut finite_offsets = finite();
        let Some(seed) = finite_offsets.next() else {
            return BoundingSphere { centre: DVec3::ZERO, radius: 0.0 };
        };
        let (low, high) = finite_offsets.fold((seed, seed), |(low, high), p| (low.min(p), high.max(p)));
        let centre = (low + high) / 2.0;
        let radius = finite().map(|p| p.distance_squared(centre)).fold(0.0, f64::max).sqrt();
        BoundingSphere { centre, radius }
    }

    /// Position of a vertex relative to the origin, in metres.
    fn offset(&self, index: usize) -> DVec3 {
        DVec3::from_array([0, 1, 2].map(|axis: usize| f64::from(self.streams[axis][index / LINE].0[index % LINE])))
    }

    /// True if any vertex may lie where f32 alone loses its direction: within 14.5° of dead astern of an eye that is
    /// fast enough to matter. False for an eye whose position is not finite.
    ///
    /// A program that transforms with f32 only, as a GPU does, leaves such vertices to the kernel.
    pub fn reach_astern<'e, E>(&self, eye: &'e E) -> bool
    where
        PhotoSurfaceEye: From<&'e E>,
    {
        let plan = FramePlan::new(&PhotoSurfaceEye::from(eye), self.origin);
        self.spheres.iter().any(|sphere| plan.form(sphere) == FormulaChoice::ExactAstern)
    }

    /// Number of vertices, those that are not finite included.
    pub fn len(&self) -> usize {
        self.count
    }

    /// True if there is no vertex.
    pub fn is_empty(&self) -> bool {
        self.count == 0
    }

    /// Origin of the f32 coordinates; world frame, metres.
    pub fn origin(&self) -> DVec3 {
        self.origin
    }

    /// Indices of the vertices that are not finite, in rising order. A triangle that uses one cannot be drawn: leave
    /// it out, and say how many.
    pub fn not_finite(&self) -> &[usize] {
        &self.not_finite
    }

    pub(super) fn streams(&self) -> [&[VertexLine]; 3] {
        self.streams.each_ref().map(Vec::as_slice)
    }

    pub(super) fn spheres(&self) -> &[BoundingSphere] {
        &self.spheres
    }
}

#[cfg(test)]
mod tests {
    //! Law: a chunk's sphere holds all its finite vertices. A sphere that missed one would leave it to the form that
    //! loses directions astern.

    use super::*;

    #[test]
    fn every_finite_vertex_lies_in_its_chunks_sphere() {
        let count = 2 * CHUNK + 5;
        let vertices = Vertices::from_offsets(
            DVec3::ZERO,
            (0..count).map(|index| match index {
                7 => Vec3::NAN,
                _ => Vec3::new((0.1 * index as f32).sin(), index as f32, -3.0),
            }),
        )
        .unwrap();
        assert_eq!(vertices.spheres().len(), 3);
        for index in (0..count).filter(|&index| index != 7) {
            let sphere = vertices.spheres()[index / CHUNK];
            let distance = vertices.offset(index).distance(sphere.centre);
            assert!(distance <= sphere.radius * (1.0 + f64::EPSILON), "vertex {index}");
            assert!(sphere.radius < CHUNK as f64, "no larger than it must be");
        }
    }
}
