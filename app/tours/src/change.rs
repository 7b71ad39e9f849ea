//! Changes of what is shown that a tour makes, and the actions that make them.

use crate::plan::{TourEvent, TourPanel, TourView};
use input::{Action, Setting, Switch};
use view::Effects;

/// Change of what is shown, at the beginning of a station.
#[derive(Clone, Debug, PartialEq)]
pub enum TourChange {
    /// Effects from now on, and the view that they name.
    Effects(Effects),
    /// View from now on.
    View(TourView),
    /// Instruments from now on, and no others.
    Show(Vec<TourPanel>),
    /// Event that the diagram marks.
    Mark(TourEvent),
}

/// Instruments beside the diagram, each with its switch.
const SWITCHES: [(TourPanel, Switch); 2] =
    [(TourPanel::Miniature, Switch::Miniature), (TourPanel::Clocks, Switch::Clocks)];

impl TourChange {
    /// Actions that make the change, whatever is shown before.
    pub fn actions(&self) -> Vec<Action> {
        match self {
            Self::Effects(effects) => vec![Action::Set(Setting::Effects, effects.to_string())],
            Self::View(view) => vec![Action::Set(Setting::View, view.places().name().to_owned())],
            Self::Show(panels) => {
                let of_vehicle = panels.contains(&TourPanel::DiagramOfVehicle);
                let diagram = of_vehicle || panels.contains(&TourPanel::Diagram);
                let turned = SWITCHES.iter().map(|(panel, switch)| (*switch, panels.contains(panel)));
                let turned =
                    [(Switch::Diagram, diagram), (Switch::DiagramOfVehicle, of_vehicle)].into_iter().chain(turned);
                turned.map(|(switch, on)| Action::Turn(switch, on)).collect()
            }
            Self::Mark(_) => Vec::new(),
        }
    }
}
