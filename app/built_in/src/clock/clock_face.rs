//! Clock in a scene: where its dial is, what it shows, and the hands in front of it.

use super::hand::HandKind;
use glam::{DAffine3, DMat3, DVec3, Vec3};
use scene::motion::{Animated, ChainLink, Motion, Uniform};
use scene::{LocalName, Mesh, Scene, SceneClock};
use std::sync::Arc;

/// Clock that is to be added to a scene.
pub(crate) struct ClockFace {
    /// Name, for captions.
    pub(crate) name: LocalName,
    /// Middle of the dial, metres, in the frame in which the clock rests.
    pub(crate) centre: Vec3,
    /// Unit vector to the right, as seen by an observer in front.
    pub(crate) right: Vec3,
    /// Unit vector out of the dial, level.
    pub(crate) out: Vec3,
    /// Radius of the dial, metres.
    pub(crate) radius: f32,
    /// Motion of the frame in which the clock rests; `None` for the world.
    pub(crate) motion: Option<Uniform>,
}

impl ClockFace {
    /// Adds hands to a scene, one mesh and one motion each, and the clock to its list. `material`: index of the hands'.
    pub(crate) fn furnish(self, scene: &mut Scene, hands: &[HandKind], material: usize) {
        for kind in hands {
            let mesh = kind.mesh(self.radius, material);
            let name = format!("{}: {}", self.name.english, mesh.name);
            let hung = Animated::new(name.clone(), vec![self.hung(), ChainLink::Keyed(kind.turn())]);
            let animated = self.motion.into_iter().fold(hung.as_clockwork(), Animated::aboard);
            scene.meshes.push(Mesh { name, motion: Some(scene.motions.len()), ..mesh });
            scene.motions.push(Motion::Animated(Arc::new(animated)));
        }
        let position = self.centre.as_dvec3();
        scene.clocks.push(SceneClock { name: self.name, position, motion: self.motion, ahead_s: 0.0 });
    }

    /// Transform from the dial's axes to those of the frame in which the clock rests.
    fn hung(&self) -> ChainLink {
        let matrix3 = DMat3::from_cols(self.right.as_dvec3(), DVec3::Y, self.out.as_dvec3());
        ChainLink::Fixed(DAffine3 { matrix3, translation: self.centre.as_dvec3() })
    }
}
