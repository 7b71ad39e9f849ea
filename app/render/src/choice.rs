//! Which method draws a scene best.
//!
//! Straight edges must bend. `polygon` bends vertices, so it wants triangles that are short beside their distance: cut once, or for every picture;
//! `image` bends pixels, so it takes the scene as it was modelled, however coarse.

use super::Method;
use super::image::MapQuality;
use super::polygon::{Pace, Tolerance};
use crate::command::Renderer;
use crate::progress;
use scene::Scene;
use scene::refine::{RefineError, cut_beyond, refine};
use std::borrow::Cow;

/// A scene that has to be cut into so many times as many triangles is coarse.
const COARSE: usize = 4;

/// An edge of this length, in metres, bends well enough where a scene is seen from as near as people come.
const USUAL_EDGE_M: f64 = 0.5;

/// How the polygon renderer's straight edges are made to bend.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Bending {
    /// Longer ones are cut, once.
    Fixed {
        /// Metres.
        edge_m: f64,
        /// Whether vertices are bent by the GPU's vertex stage.
        vertex_stage: bool,
    },
    /// They are cut for every picture.
    Adaptive(Tolerance),
}

/// A scene as a method draws it.
#[derive(Debug)]
pub struct Choice {
    /// Cut for bending, if the method needs that.
    pub scene: Scene,
    /// How it is drawn.
    pub method: Method,
    /// Which method, and why, in one line.
    pub because: String,
}

impl Choice {
    /// Chooses, unless the user has, and cuts long triangles once where that is wanted.
    ///
    /// # Errors
    /// [`RefineError`] if that would make too many, or the scene breaks a promise.
    pub fn of(scene: Scene, wanted: Renderer, bending: Bending, quality: MapQuality) -> Result<Self, RefineError> {
        scene.validate()?;
        let triangles = scene.triangle_count();
        let edge = match bending {
            Bending::Fixed { edge_m, .. } => edge_m,
            Bending::Adaptive(_) => USUAL_EDGE_M,
        };
        let (image, why): (bool, Cow<'_, str>) = match wanted {
            Renderer::Image => (true, "as asked".into()),
            // The ray tracer takes scenes as they are; whoever asks this for it gets the one that comes closest.
            Renderer::Polygon | Renderer::Raytrace => (false, "as asked".into()),
            Renderer::Auto if triangles == 0 => (false, "there is only sky, which needs no map".into()),
            // A still by cuts takes no longer than one by a map, however fast the observer is, and is exact astern too. In a window they
            // share the time with drawing, and the map of a coarse scene is faster.
            Renderer::Auto if matches!(bending, Bending::Adaptive(Tolerance { pace: Pace::Still, .. })) => {
                (false, "its triangles are cut for every picture".into())
            }
            Renderer::Auto if cut_beyond(&scene, edge as f32, COARSE * triangles) => (
                true,
                format!(
                    "its {triangles} triangles are coarse: to bend their edges, --renderer polygon would cut them into more than {}",
                    COARSE * triangles
                )
                .into(),
            ),
            Renderer::Auto => (false, format!("its {triangles} triangles are fine enough to bend").into()),
        };
        let name = scene.name.clone();
        if image {
            let because = format!("{name}: drawn by the image renderer ({why})");
            return Ok(Self { scene, method: Method::Image(quality), because });
        }
        let because = format!("{name}: drawn by the polygon renderer ({why})");
        if let Bending::Adaptive(tolerance) = bending {
            return Ok(Self { scene, method: Method::Adaptive(tolerance), because });
        }
        let spinner = progress::spinner(format!("cutting triangles to {edge} m"));
        let scene = refine(&scene, edge as f32)?;
        spinner.finish_and_clear();
        let method = match bending {
            Bending::Fixed { vertex_stage: true, .. } => Method::VertexStage,
            _ => Method::Polygon,
        };
        Ok(Self { scene, method, because })
    }
}

#[cfg(test)]
mod tests {
    //! Who says how he wants it gets it; who does not gets what was measured to be best.

    use super::*;
    use built_in::lattice::Lattice;
    use scene::motion::{Motion, Uniform};
    use physics::{Celerity, Event};

    #[test]
    fn a_fixed_edge_cuts_once_and_a_tolerance_for_every_picture() {
        let quality = MapQuality { texels_per_pixel: 1.0, smooth: true };
        let choose = |wanted, bending| {
            let choice = Choice::of(Lattice::default().build(), wanted, bending, quality).unwrap();
            (choice.method, choice.scene.triangle_count())
        };
        let whole = Lattice::default().build().triangle_count();
        let fixed = Bending::Fixed { edge_m: 0.3, vertex_stage: false };
        assert!(matches!(choose(Renderer::Polygon, fixed), (Method::Polygon, cut) if cut > 10 * whole));
        let staged = Bending::Fixed { edge_m: 0.3, vertex_stage: true };
        assert!(matches!(choose(Renderer::Polygon, staged), (Method::VertexStage, cut) if cut > 10 * whole));
        let still = Tolerance { pixels: 0.5, pace: Pace::Still };
        assert_eq!(choose(Renderer::Auto, Bending::Adaptive(still)), (Method::Adaptive(still), whole));
        let ride = Tolerance { pixels: 1.5, pace: Pace::Ride };
        assert_eq!(choose(Renderer::Polygon, Bending::Adaptive(ride)), (Method::Adaptive(ride), whole));
        assert_eq!(choose(Renderer::Auto, Bending::Adaptive(ride)), (Method::Image(quality), whole));
    }

    #[test]
    fn motion_changes_nothing_of_the_choice() {
        let mut scene = Lattice::default().build();
        scene.meshes[0].motion = Some(0);
        scene.motions = vec![Motion::Uniform(Uniform { celerity: Celerity::ZERO, anchor: Event::default() })];
        let quality = MapQuality { texels_per_pixel: 1.0, smooth: true };
        let ride = Bending::Adaptive(Tolerance { pixels: 1.5, pace: Pace::Ride });
        let choice = Choice::of(scene, Renderer::Auto, ride, quality).unwrap();
        assert_eq!(choice.method, Method::Image(quality));
    }
}
