//! Table of clocks: what each dial shows as it is seen, as it is now for the rider, as it is now for the world.

use egui::{Color32, Frame, Grid, RichText, Ui};
use words::{Language, Phrase};

/// Clock with its three readings, seconds.
#[derive(Clone, Debug, PartialEq)]
pub struct ClockRow {
    /// Name of the clock.
    pub name: String,
    /// Readings: seen, for the rider, for the world.
    pub readings_s: [f64; 3],
}

/// Colour of what is seen, as in the diagram.
const SEEN: Color32 = Color32::from_rgb(0xff, 0xe0, 0x8a);

/// Shows the table.
pub fn show(ui: &mut Ui, language: Language, clocks: &[ClockRow]) {
    Frame::window(ui.style()).show(ui, |ui| {
        Grid::new("clocks").num_columns(4).spacing([14.0, 3.0]).show(ui, |ui| {
            for heading in [Phrase::ClockOf, Phrase::ClockSeen, Phrase::ClockForYou, Phrase::ClockForWorld] {
                ui.label(RichText::new(language.text(heading)).small());
            }
            ui.end_row();
            let text = |seconds: f64| language.decimals(&reading(seconds));
            for ClockRow { name, readings_s: [seen, own, world] } in clocks {
                ui.label(name);
                ui.label(RichText::new(text(*seen)).monospace().color(SEEN));
                ui.label(RichText::new(text(*own)).monospace());
                ui.label(RichText::new(text(*world)).monospace());
                ui.end_row();
            }
        });
    });
}

/// Text of a dial: minutes and seconds to a tenth.
fn reading(seconds: f64) -> String {
    let tenths = (seconds.abs() * 10.0).round();
    let (minutes, rest) = ((tenths / 600.0).floor(), tenths % 600.0 / 10.0);
    let sign = if seconds < 0.0 && tenths > 0.0 { "−" } else { "" };
    format!("{sign}{minutes:02.0}:{rest:04.1}")
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_dial_never_reads_sixty_seconds_or_less_than_nothing() {
        for (seconds, text) in [(0.0, "00:00.0"), (59.96, "01:00.0"), (-0.01, "00:00.0"), (-61.5, "−01:01.5")] {
            assert_eq!(reading(seconds), text);
        }
    }
}
