//! Kinds of packed data that the extension names.

/// Codec of a buffer view, the extension's `mode`.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Codec {
    /// Vertices, or any other records of equal size: `ATTRIBUTES`.
    Attributes,
    /// Indices of a list of triangles: `TRIANGLES`.
    Triangles,
    /// Indices in any order: `INDICES`.
    Indices,
}

/// Reversal of a rounding that was made before packing, the extension's `filter`.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Filter {
    /// No filter: `NONE`.
    None,
    /// Unit vectors on an octahedron, 4 or 8 bytes each: `OCTAHEDRAL`.
    Octahedral,
    /// Unit quaternions without their largest component, 8 bytes each: `QUATERNION`.
    Quaternion,
    /// Floats of few digits with a common exponent, multiples of 4 bytes: `EXPONENTIAL`.
    Exponential,
    /// Colours as brightness and two differences, with opacity, 4 or 8 bytes each: `COLOR`.
    Colour,
}
