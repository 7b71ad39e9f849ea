//! Extent of a scene: the ball that holds all that can be seen in it at a finite distance.

use crate::mesh::Mesh;
use crate::motion::{Ball, Motion};
use crate::scene::Scene;
use glam::{DVec3, Vec3};

impl Scene {
    /// Ball round the middle of all meshes, world metres; `None` if there are none. Animated meshes count wherever
    /// they get to, uniformly moving ones where their files put them. Vertices that are not finite do not count.
    pub fn extent(&self) -> Option<Ball> {
        let boxes = self.meshes.iter().filter_map(|mesh| self.box_of(mesh));
        let whole = boxes.reduce(|[least, most], [lower, upper]| [least.min(lower), most.max(upper)])?;
        Some(ball_round(whole))
    }

    /// Box of a mesh, world metres: its least corner and its greatest.
    fn box_of(&self, mesh: &Mesh) -> Option<[DVec3; 2]> {
        let finite = mesh.positions.iter().copied().filter(|position| position.is_finite());
        let corners: [Vec3; 2] = finite.map(|p| [p, p]).reduce(|[least, most], [p, _]| [least.min(p), most.max(p)])?;
        let own = corners.map(|corner| corner.as_dvec3());
        let motion = mesh.motion.and_then(|index| self.motions.get(index)).and_then(Motion::animated);
        let world = match motion {
            None => own.map(|corner| self.origin + corner),
            Some(animated) => {
                let Ball { centre, radius } = animated.reach(ball_round(own));
                [centre - radius, centre + radius]
            }
        };
        world.iter().all(|corner| corner.is_finite()).then_some(world)
    }
}

/// Ball that holds a box.
fn ball_round([least, most]: [DVec3; 2]) -> Ball {
    Ball { centre: 0.5 * (least + most), radius: 0.5 * least.distance(most) }
}

#[cfg(test)]
mod tests {
    //! Law: every finite vertex of a scene lies in its ball, wherever it moves by keys, and a scene of sky has none.

    use super::*;
    use crate::motion::{Animated, ChainLink};
    use glam::DAffine3;
    use std::sync::Arc;

    fn mesh(positions: &[Vec3], motion: Option<usize>) -> Mesh {
        Mesh { positions: positions.to_vec(), motion, ..Mesh::default() }
    }

    #[test]
    fn the_ball_lies_round_the_middle_of_all_meshes() {
        let origin = DVec3::new(1e9, 0.0, 0.0);
        let meshes = vec![
            mesh(&[Vec3::new(-1.0, 0.0, 0.0), Vec3::new(0.0, 2.0, 0.0)], None),
            mesh(&[Vec3::new(3.0, 0.0, 3.0), Vec3::NAN], None),
            mesh(&[Vec3::INFINITY], None),
        ];
        let ball = Scene { origin, meshes, ..Scene::default() }.extent();
        assert_eq!(ball, Some(Ball { centre: origin + DVec3::new(1.0, 1.0, 1.5), radius: 0.5 * 29_f64.sqrt() }));
    }

    #[test]
    fn an_animated_mesh_counts_where_it_is() {
        let away = DAffine3::from_translation(DVec3::X * 100.0);
        let motion = Motion::Animated(Arc::new(Animated::new("a", vec![ChainLink::Fixed(away)])));
        let meshes = vec![mesh(&[Vec3::ZERO], None), mesh(&[Vec3::ZERO], Some(0))];
        let ball = Scene { meshes, motions: vec![motion], ..Scene::default() }.extent();
        assert_eq!(ball, Some(Ball { centre: DVec3::X * 50.0, radius: 50.0 }));
    }

    #[test]
    fn a_scene_of_sky_has_no_extent() {
        assert_eq!(Scene::default().extent(), None);
        assert_eq!(Scene { meshes: vec![mesh(&[], None)], ..Scene::default() }.extent(), None);
    }
}
