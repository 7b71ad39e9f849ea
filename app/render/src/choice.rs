//! Choice of the method that draws a scene best.
//!
//! Straight edges must bend. `polygon` bends vertices, so it needs triangles that are short beside their distance: cut
//! once, or for every picture. `image` bends pixels, so it takes the scene as it was modelled, however coarse.

use scene::Scene;
use scene::refine::{RefineError, cut_beyond, refine};
use std::borrow::Cow;
use view::{Dial, Occasion, RendererName};

/// Factor by which cutting multiplies the triangles of a coarse scene.
const COARSE: usize = 4;

/// Length of edges, metres, that bend well enough where a scene is seen from as near as people come.
const USUAL_EDGE_M: f64 = 0.5;

/// A scene, and the method that draws it.
#[derive(Debug)]
pub struct Choice {
    /// Scene, with its long edges cut where the method wants that.
    pub scene: Scene,
    /// Method and its setting, both named.
    pub dial: Dial,
    /// Method and the reason for it, in one line.
    pub because: String,
}

impl Choice {
    /// Chooses a method for a scene unless `wanted` names one, and cuts long edges once if `wanted` gives their length.
    ///
    /// # Errors
    /// [`RefineError`] if that would make too many triangles, or if the scene breaks a promise of its types.
    pub fn of(scene: Scene, wanted: Dial, occasion: Occasion) -> Result<Self, RefineError> {
        scene.validate()?;
        let (renderer, why) = renderer(&scene, wanted, occasion);
        let unused = match renderer {
            RendererName::Image if wanted.edge.is_some() => "; --edge and --transform are for polygon, and not used",
            _ => "",
        };
        let because = format!("{}: drawn by the {} renderer ({why}){unused}", scene.name, renderer.name());
        let dial = Dial { renderer, ..wanted };
        match (renderer, wanted.edge) {
            (RendererName::Polygon, Some(edge_m)) => Ok(Self { scene: refine(&scene, edge_m as f32)?, dial, because }),
            _ => Ok(Self { scene, dial, because }),
        }
    }
}

/// Name of the method, and the reason for it.
fn renderer(scene: &Scene, wanted: Dial, occasion: Occasion) -> (RendererName, Cow<'static, str>) {
    let triangles = scene.triangle_count();
    let edge_m = wanted.edge.unwrap_or(USUAL_EDGE_M);
    match wanted.renderer {
        RendererName::Image => (RendererName::Image, "as asked".into()),
        // The ray tracer takes scenes as they are. The method that draws in its place is the one that comes closest.
        RendererName::Polygon | RendererName::Raytrace => (RendererName::Polygon, "as asked".into()),
        RendererName::Auto if triangles == 0 => {
            (RendererName::Polygon, "there is only sky, which needs no map".into())
        }
        // A still by cuts takes no longer than one by a map, however fast the observer is, and is exact astern too.
        // In a window cuts share the time with drawing, and the map of a coarse scene is faster.
        RendererName::Auto if wanted.edge.is_none() && occasion == Occasion::Still => {
            (RendererName::Polygon, "its triangles are cut for every picture".into())
        }
        RendererName::Auto if cut_beyond(scene, edge_m as f32, COARSE * triangles) => (
            RendererName::Image,
            format!(
                "its {triangles} triangles are coarse: to bend their edges, --renderer polygon would cut them into more \
                 than {}",
                COARSE * triangles
            )
            .into(),
        ),
        RendererName::Auto => {
            (RendererName::Polygon, format!("its {triangles} triangles are fine enough to bend").into())
        }
    }
}

#[cfg(test)]
mod tests {
    //! Law under test: a method that is asked for is taken; otherwise the one that was measured to be best.
    #![allow(clippy::unwrap_used, reason = "a failed construction is a failed test")]

    use super::*;
    use built_in::lattice::Lattice;
    use physics::{Celerity, Event};
    use scene::motion::{Motion, Uniform};

    const AUTO: Dial = Dial { renderer: RendererName::Auto, ..Dial::tolerance(1.5) };

    #[test]
    fn a_fixed_edge_cuts_once_and_a_tolerance_for_every_picture() {
        let whole = Lattice::default().build().triangle_count();
        let choose = |wanted, occasion| {
            let choice = Choice::of(Lattice::default().build(), wanted, occasion).unwrap();
            (choice.dial.renderer, choice.scene.triangle_count())
        };
        for fixed in [Dial::edge(0.3), Dial::vertex_stage(0.3)] {
            let (renderer, cut) = choose(fixed, Occasion::Still);
            assert!(renderer == RendererName::Polygon && cut > 10 * whole, "{cut}");
        }
        assert_eq!(choose(AUTO, Occasion::Still), (RendererName::Polygon, whole));
        assert_eq!(choose(Dial::tolerance(1.5), Occasion::Ride), (RendererName::Polygon, whole));
        assert_eq!(choose(AUTO, Occasion::Ride), (RendererName::Image, whole));
    }

    #[test]
    fn motion_changes_nothing_of_the_choice() {
        let mut scene = Lattice::default().build();
        scene.meshes[0].motion = Some(0);
        scene.motions = vec![Motion::Uniform(Uniform { celerity: Celerity::ZERO, anchor: Event::default() })];
        let choice = Choice::of(scene, AUTO, Occasion::Ride).unwrap();
        assert_eq!(choice.dial.renderer, RendererName::Image);
    }
}
