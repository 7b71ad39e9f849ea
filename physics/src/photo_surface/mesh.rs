//! A mesh and the memory that its photo-surface goes to.

use std::mem::MaybeUninit;

use super::chunk::KernelChunk;
use super::error::PhotoSurfaceError;
use super::eye::PhotoSurfaceEye;
use super::line::{CHUNK, LINE};
use super::plan::FramePlan;
use super::simd;
use super::vertices::Vertices;

/// A mesh, and the memory for its apparent positions and, if wanted, Doppler factors.
///
/// The memory is the caller's and is only written. It may be part of a mapped GPU buffer; streams that begin at a
/// multiple of 64 bytes are written fastest.
#[derive(Debug)]
pub struct PhotoSurfaceMesh<'a> {
    vertices: &'a Vertices,
    position: [&'a mut [MaybeUninit<f32>]; 3],
    doppler: &'a mut [MaybeUninit<f32>],
}

impl<'a> PhotoSurfaceMesh<'a> {
    /// The photo-surface of `vertices`, as streams of the x, y and z of the apparent positions in metres.
    ///
    /// # Errors
    /// [`PhotoSurfaceError::OutputLength`] if a stream does not hold one value a vertex.
    pub fn new(vertices: &'a Vertices, position: [&'a mut [f32]; 3]) -> Result<Self, PhotoSurfaceError> {
        Self::in_write_only(vertices, position.map(simd::write_only))
    }

    /// As above, in memory that cannot be read, such as a mapped buffer.
    ///
    /// # Errors
    /// As [`PhotoSurfaceMesh::new`].
    pub fn in_write_only(
        vertices: &'a Vertices,
        position: [&'a mut [MaybeUninit<f32>]; 3],
    ) -> Result<Self, PhotoSurfaceError> {
        for (stream, values) in ["x", "y", "z"].into_iter().zip(&position) {
            check_length(vertices, stream, values)?;
        }
        Ok(Self { vertices, position, doppler: &mut [] })
    }

    /// Asks for the Doppler factor D of every vertex, too.
    ///
    /// # Errors
    /// [`PhotoSurfaceError::OutputLength`] if the stream does not hold one value a vertex.
    pub fn with_doppler(self, doppler: &'a mut [f32]) -> Result<Self, PhotoSurfaceError> {
        self.with_write_only_doppler(simd::write_only(doppler))
    }

    /// As above, in memory that cannot be read, such as a mapped buffer.
    ///
    /// # Errors
    /// As [`PhotoSurfaceMesh::with_doppler`].
    pub fn with_write_only_doppler(self, doppler: &'a mut [MaybeUninit<f32>]) -> Result<Self, PhotoSurfaceError> {
        check_length(self.vertices, "doppler", doppler)?;
        Ok(Self { doppler, ..self })
    }

    /// Vertices of the mesh.
    pub fn vertices(&self) -> &'a Vertices {
        self.vertices
    }

    pub(super) fn output_bytes(&self) -> usize {
        let [x, y, z] = &self.position;
        size_of_val(*x) + size_of_val(*y) + size_of_val(*z) + size_of_val(self.doppler)
    }

    /// Cuts the work into chunks, each with the formula it needs.
    pub(super) fn into_chunks(
        self,
        eye: &PhotoSurfaceEye,
        streaming: bool,
    ) -> impl Iterator<Item = KernelChunk<'a>> + use<'a> {
        let Self { vertices, position: [x, y, z], doppler } = self;
        let plan = FramePlan::new(eye, vertices.origin());
        let [in_x, in_y, in_z] = vertices.streams().map(|stream| stream.chunks(CHUNK / LINE));
        let position = x.chunks_mut(CHUNK).zip(y.chunks_mut(CHUNK)).zip(z.chunks_mut(CHUNK));
        // Go on with empty Doppler chunks if D is not wanted.
        let doppler = doppler.chunks_mut(CHUNK).chain(std::iter::repeat_with(<&mut [_]>::default));
        let input = in_x.zip(in_y).zip(in_z);
        vertices.spheres().iter().zip(input).zip(position).zip(doppler).map(
            move |(((sphere, ((in_x, in_y), in_z)), ((x, y), z)), doppler)| KernelChunk {
                plan,
                form: plan.form(sphere),
                input: [in_x, in_y, in_z],
                position: [x, y, z],
                doppler,
                streaming,
            },
        )
    }
}

fn check_length(
    vertices: &Vertices,
    stream: &'static str,
    values: &[MaybeUninit<f32>],
) -> Result<(), PhotoSurfaceError> {
    if values.len() == vertices.len() {
        Ok(())
    } else {
        Err(PhotoSurfaceError::OutputLength { stream, length: values.len(), vertices: vertices.len() })
    }
}
