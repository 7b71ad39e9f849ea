//! The ride seen from outside: what *is*, beside what is *seen*.
//!
//! Three widgets, drawn by egui's painter into any [`egui::Ui`], so that they work in a window and in a texture that
//! hangs in a room: a Minkowski diagram of the ride ([`diagram`]), the world in miniature ([`miniature`]), and a
//! planner that says when to turn round ([`planner`]). All of them read a [`Trail`], which gathers the ride's
//! worldline frame by frame. Everything up to the drawing is a pure function of the frames: a replay shows the same.

mod diagram;
mod diagram_frame;
mod diagram_view;
mod figures;
mod line_clip;
mod miniature;
mod miniature_view;
mod pen;
mod plan_picture;
mod planner;
mod spacetime_map;
mod texture_mean;
mod trail;
mod trail_levels;
mod trail_point;
mod turn_plan;
mod words;

pub use diagram::diagram;
pub use diagram_frame::DiagramFrame;
pub use diagram_view::{DiagramAxis, DiagramView};
pub use miniature::{PlanTexture, miniature};
pub use miniature_view::{MapUp, MiniatureView};
pub use plan_picture::{PlanArea, PlanPicture};
pub use planner::planner;
pub use spacetime_map::{DiagramPlace, SpacetimeMap};
pub use trail::{PresentMoment, Trail, TrailEvent, WatchedClock};
pub use trail_point::TrailPoint;
pub use turn_plan::{PlannedJourney, TurnPlan, felt_g};
pub use words::InstrumentWords;
