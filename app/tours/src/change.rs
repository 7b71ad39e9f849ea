//! Changes of what is shown that a tour makes, and the actions that make them.

use crate::plan::{TourPanel, TourView};
use input::{Action, Setting, Switch};
use view::Effects;

/// Change of what is shown, at the beginning of a station.
#[derive(Clone, Debug, PartialEq)]
pub enum TourChange {
    /// Effects from now on.
    Effects(Effects),
    /// View from now on.
    View(TourView),
    /// Instruments from now on, and no others.
    Show(Vec<TourPanel>),
}

/// Present state of what a tour changes by turns.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct TourShown {
    /// View.
    pub view: TourView,
    /// Instruments that are shown.
    pub panels: Vec<TourPanel>,
}

impl TourShown {
    /// Takes a change over.
    pub fn take(&mut self, change: &TourChange) {
        match change {
            TourChange::Effects(_) => {}
            TourChange::View(view) => self.view = *view,
            TourChange::Show(panels) => self.panels.clone_from(panels),
        }
    }
}

/// Views in the order in which one action leads from each to the next.
const VIEWS: [TourView; 3] = [TourView::Seen, TourView::Measured, TourView::Instant];
/// Instruments that have a switch, each with it.
const SWITCHES: [(TourPanel, Switch); 2] =
    [(TourPanel::Diagram, Switch::Diagram), (TourPanel::Miniature, Switch::Miniature)];

impl TourChange {
    /// Actions that make the change. Clocks have no switch of their own: the program shows their readings with the
    /// caption.
    pub fn actions(&self, shown: &TourShown) -> Vec<Action> {
        let number = |view: TourView| VIEWS.iter().position(|known| *known == view).unwrap_or_default();
        match self {
            Self::Effects(effects) => vec![Action::Set(Setting::Effects, effects.to_string())],
            Self::View(view) => {
                let turns = (number(*view) + VIEWS.len() - number(shown.view)) % VIEWS.len();
                vec![Action::NextView; turns]
            }
            Self::Show(panels) => {
                let differs = |panel: &TourPanel| panels.contains(panel) != shown.panels.contains(panel);
                let turned = SWITCHES.iter().filter(|(panel, _)| differs(panel));
                turned.map(|(_, switch)| Action::Toggle(*switch)).collect()
            }
        }
    }
}
