//! Mesh as it comes out of the decoder.

/// Numbers of one kind, some for each point of a mesh.
#[derive(Clone, Debug, PartialEq)]
pub struct Attribute {
    /// Identity, by which glTF names it.
    pub unique_id: u32,
    /// Numbers for each point.
    pub components: usize,
    /// Numbers, point after point: dequantised, or integers; of normalised integers 0…1 or −1…1.
    pub values: Vec<f32>,
}

/// Triangles and attributes.
#[derive(Clone, Debug, PartialEq)]
pub struct DracoMesh {
    /// Number of points.
    pub points: usize,
    /// Corners of the triangles, three points each.
    pub indices: Vec<u32>,
    /// Attributes in the file's order.
    pub attributes: Vec<Attribute>,
}
