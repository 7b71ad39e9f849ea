//! Words of the instruments, in one table a language.

/// Visible text of the instruments in one language. `{}` stands for a number with its unit, in the order of the
/// sentence.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct InstrumentWords {
    /// Sign between whole numbers and their fractions.
    pub decimal: char,
    /// Title of the diagram in the world's frame.
    pub diagram_of_world: &'static str,
    /// Title of the diagram in the vehicle's frame.
    pub diagram_of_vehicle: &'static str,
    /// Caption of the diagram: `{}` is the own time between two dots.
    pub diagram_caption: &'static str,
    /// Label of the line of events that are simultaneous for the rider.
    pub your_now: &'static str,
    /// Label of the line of events that are simultaneous for the world.
    pub world_now: &'static str,
    /// Label of the lines of light.
    pub light: &'static str,
    /// Name of the first event of a ride.
    pub start: &'static str,
    /// Label of the axis of space, before its unit.
    pub space: &'static str,
    /// Label of the axis of time, before its unit.
    pub time: &'static str,
    /// Title of the map.
    pub miniature: &'static str,
    /// Caption of the map.
    pub miniature_caption: &'static str,
    /// Label of the rider's clock.
    pub your_clock: &'static str,
    /// Label of the world's clock.
    pub world_clock: &'static str,
    /// Letter of the north.
    pub north: &'static str,
    /// Title of the planner.
    pub planner: &'static str,
    /// Label of the felt acceleration.
    pub felt: &'static str,
    /// Sentence: `{}` distance to the turn, `{}` own time until it.
    pub turn_in: &'static str,
    /// Sentence for a turn that is due.
    pub turn_now: &'static str,
    /// Sentence: `{}` own time until arrival, `{}` world's time.
    pub arrive_in: &'static str,
    /// Sentence: `{}` distance beyond the destination.
    pub overshoot: &'static str,
    /// Sentence: `{}` distance to the destination, `{}` felt acceleration of the plan.
    pub plan_for: &'static str,
    /// Sentence where there is no destination.
    pub no_destination: &'static str,
}

impl InstrumentWords {
    /// English words.
    pub const ENGLISH: Self = Self {
        decimal: '.',
        diagram_of_world: "Space and time, as the world measures them",
        diagram_of_vehicle: "Space and time, as you measure them now",
        diagram_caption: "Your worldline, with a dot for every {} on your clock. What lies on the blue line happens now \
                          for you; light goes at 45°.",
        your_now: "your now",
        world_now: "the world's now",
        light: "light",
        start: "start",
        space: "place",
        time: "time",
        miniature: "The world from above",
        miniature_caption: "Where you are and have been in the world's frame. The light in your picture comes from the \
                            bright sector.",
        your_clock: "your clock",
        world_clock: "the world's clock",
        north: "N",
        planner: "Journey",
        felt: "you feel",
        turn_in: "turn round after {}, in {} of your time",
        turn_now: "turn round now",
        arrive_in: "arrival in {} of your time, {} of the world's",
        overshoot: "too fast to stop there: you will miss it by {}",
        plan_for: "{} ahead, at {}",
        no_destination: "no destination chosen",
    };

    /// German words.
    pub const GERMAN: Self = Self {
        decimal: ',',
        diagram_of_world: "Raum und Zeit, wie die Welt sie misst",
        diagram_of_vehicle: "Raum und Zeit, wie du sie jetzt misst",
        diagram_caption: "Deine Weltlinie, ein Punkt alle {} auf deiner Uhr. Was auf der blauen Linie liegt, geschieht \
                          für dich jetzt; Licht läuft unter 45°.",
        your_now: "dein Jetzt",
        world_now: "Jetzt der Welt",
        light: "Licht",
        start: "Start",
        space: "Ort",
        time: "Zeit",
        miniature: "Die Welt von oben",
        miniature_caption: "Wo du bist und warst, im System der Welt. Das Licht in deinem Bild kommt aus dem hellen \
                            Sektor.",
        your_clock: "deine Uhr",
        world_clock: "Uhr der Welt",
        north: "N",
        planner: "Reise",
        felt: "du spürst",
        turn_in: "umdrehen nach {}, in {} deiner Zeit",
        turn_now: "jetzt umdrehen",
        arrive_in: "Ankunft in {} deiner Zeit, {} der Welt",
        overshoot: "zu schnell, um dort zu halten: du schießt um {} hinaus",
        plan_for: "noch {}, bei {}",
        no_destination: "kein Ziel gewählt",
    };

    /// Sentence with its `{}` filled in, in their order.
    pub fn filled(sentence: &str, values: &[&str]) -> String {
        let mut filled = String::new();
        let mut values = values.iter();
        for (number, part) in sentence.split("{}").enumerate() {
            if number > 0 {
                filled += values.next().unwrap_or(&"");
            }
            filled += part;
        }
        filled
    }
}

#[cfg(test)]
mod tests {
    //! Law: both tables ask for the same numbers. A wrong program shows a brace, or loses a number.

    use super::*;

    #[test]
    fn both_languages_ask_for_the_same_numbers() {
        let numbers = |words: &InstrumentWords| {
            let sentences = [
                words.diagram_caption,
                words.turn_in,
                words.arrive_in,
                words.overshoot,
                words.plan_for,
                words.turn_now,
            ];
            sentences.map(|sentence| sentence.matches("{}").count())
        };
        assert_eq!(numbers(&InstrumentWords::ENGLISH), numbers(&InstrumentWords::GERMAN));
        assert_eq!(numbers(&InstrumentWords::ENGLISH), [1, 2, 2, 1, 2, 0]);
    }

    #[test]
    fn a_sentence_is_filled_in_order() {
        assert_eq!(InstrumentWords::filled("a {} b {} c", &["1", "2"]), "a 1 b 2 c");
        assert_eq!(InstrumentWords::filled("a {}", &[]), "a ");
    }
}
