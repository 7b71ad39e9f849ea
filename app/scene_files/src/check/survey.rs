//! Survey of all triangles of a scene.

use glam::DVec3;

use scene::Scene;

/// Result of the survey of all triangles.
#[derive(Default)]
pub struct Survey {
    /// Least and greatest corner relative to the scene's origin, metres.
    pub bounds: Option<[DVec3; 2]>,
    /// Length of the longest finite edge, metres.
    pub longest_edge: f64,
    /// Number of triangles without area.
    pub without_area: usize,
    /// Number of triangles with a corner that is not finite.
    pub not_finite: usize,
    /// Number of triangles that face away from their normals.
    pub inside_out: usize,
}

impl Survey {
    /// Surveys every triangle of a valid scene once.
    pub fn of(scene: &Scene) -> Self {
        let mut survey = Self::default();
        for mesh in &scene.meshes {
            // An animated mesh counts in its pose at time 0.
            let animated = mesh.motion.and_then(|motion| scene.motions[motion].animated());
            let pose = animated.map(|animated| animated.at(0.0));
            for &position in mesh.positions.iter().filter(|position| position.is_finite()) {
                let position = position.as_dvec3();
                let position = pose.map_or(position, |pose| pose.position(position) - scene.origin);
                let [least, most] = survey.bounds.unwrap_or([position; 2]);
                survey.bounds = Some([least.min(position), most.max(position)]);
            }
            for corners in mesh.indices.as_chunks::<3>().0 {
                let corners = corners.map(|corner| corner as usize);
                let [a, b, c] = corners.map(|corner| mesh.positions[corner].as_dvec3());
                let face = (b - a).cross(c - a);
                if !face.is_finite() {
                    survey.not_finite += 1;
                    continue;
                }
                let longest = a.distance(b).max(b.distance(c)).max(c.distance(a));
                survey.longest_edge = survey.longest_edge.max(longest);
                let normal: DVec3 = corners.iter().map(|&corner| mesh.normals[corner].as_dvec3()).sum();
                survey.without_area += usize::from(face == DVec3::ZERO);
                survey.inside_out += usize::from(face.dot(normal) < 0.0);
            }
        }
        survey
    }
}
