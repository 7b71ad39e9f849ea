//! Changes of what is shown that a tour makes, and the actions that make them.

use crate::plan::{TourPanel, TourView};
use input::{Action, Setting, Switch};
use view::{Effects, Places};

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
            TourChange::Effects(effects) => {
                self.view = match effects.places {
                    Places::Seen => TourView::Seen,
                    Places::Measured => TourView::Measured,
                    Places::Instant => TourView::Instant,
                };
            }
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

#[cfg(test)]
mod tests {
    //! Law: whatever the effects and views of the stations before, the actions of a change lead to the view that it
    //! names. A tour that forgot which view its effects name would turn too far, or not far enough.

    use super::*;

    /// Places that are shown after these actions.
    fn after(actions: &[Action], places: Places) -> Places {
        actions.iter().fold(places, |places, action| match action {
            Action::NextView => places.next(),
            Action::Set(Setting::Effects, text) => text.parse::<Effects>().unwrap().places,
            other => panic!("{other:?}"),
        })
    }

    #[test]
    fn a_change_leads_to_its_view_from_every_other() {
        let named = [
            (TourView::Seen, Places::Seen),
            (TourView::Measured, Places::Measured),
            (TourView::Instant, Places::Instant),
        ];
        for effects in [Effects::ALL, Effects::MEASURED, Effects::NONE] {
            for (_, before) in named {
                for (view, expected) in named {
                    let (mut shown, mut places) = (TourShown::default(), before);
                    for change in [TourChange::Effects(effects), TourChange::View(view)] {
                        places = after(&change.actions(&shown), places);
                        shown.take(&change);
                    }
                    assert_eq!((places, shown.view), (expected, view), "{effects} from {before:?}");
                }
            }
        }
    }
}
