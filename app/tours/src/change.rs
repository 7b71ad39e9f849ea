//! Changes of what is shown that a tour makes, and the actions that make them.

use crate::plan::{TourPanel, TourView};
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
}

/// Instruments that have a switch, each with it.
const SWITCHES: [(TourPanel, Switch); 3] = [
    (TourPanel::Diagram, Switch::Diagram),
    (TourPanel::Miniature, Switch::Miniature),
    (TourPanel::Clocks, Switch::Clocks),
];

impl TourChange {
    /// Actions that make the change, whatever is shown before.
    pub fn actions(&self) -> Vec<Action> {
        match self {
            Self::Effects(effects) => vec![Action::Set(Setting::Effects, effects.to_string())],
            Self::View(view) => vec![Action::Set(Setting::View, view.places().name().to_owned())],
            Self::Show(panels) => {
                SWITCHES.iter().map(|(panel, switch)| Action::Turn(*switch, panels.contains(panel))).collect()
            }
        }
    }
}
