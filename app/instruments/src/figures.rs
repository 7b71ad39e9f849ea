//! Numbers as text: round steps, lengths and times with units, clocks.

use crate::words::InstrumentWords;

/// Length of a light-second, and of what is better told in light-seconds, metres.
const LIGHT_SECOND_M: f64 = 299_792_458.0;

/// Units of the diagram's axes for a speed of light and a width, which suit both axes.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct AxisUnits {
    /// Unit of length, metres, and its sign.
    pub length: (f64, &'static str),
    /// Unit of time, metres of light travel, and its sign.
    pub time: (f64, &'static str),
}

impl AxisUnits {
    /// Units for a world of this speed of light, m/s, and a diagram of this half width, metres.
    pub fn new(speed_of_light_m_s: f64, half_width_m: f64) -> Self {
        let length = match half_width_m {
            w if w >= 0.3 * LIGHT_SECOND_M && speed_of_light_m_s > 1e8 => (speed_of_light_m_s, "Ls"),
            w if w >= 4e3 => (1e3, "km"),
            w if w >= 2.0 => (1.0, "m"),
            w if w >= 2e-2 => (1e-2, "cm"),
            _ => (1e-3, "mm"),
        };
        let time = match half_width_m / speed_of_light_m_s {
            t if t >= 7200.0 => (3600.0, "h"),
            t if t >= 300.0 => (60.0, "min"),
            t if t >= 1.0 => (1.0, "s"),
            t if t >= 1e-3 => (1e-3, "ms"),
            t if t >= 1e-6 => (1e-6, "µs"),
            _ => (1e-9, "ns"),
        };
        Self { length, time: (time.0 * speed_of_light_m_s, time.1) }
    }
}

/// Round number (1, 2 or 5 times a power of ten) not below `least`, which is positive.
pub fn round_step(least: f64) -> f64 {
    let power = 10_f64.powf(least.log10().floor());
    let step = [1.0, 2.0, 5.0].into_iter().map(|digit| digit * power).find(|step| *step >= least * (1.0 - 1e-12));
    step.unwrap_or(10.0 * power)
}

/// Text of a multiple of `step`, with no more digits than it needs.
pub fn multiple(value: f64, step: f64, words: &InstrumentWords) -> String {
    if value.abs() >= 1e6 || (value != 0.0 && step < 1e-4) {
        return with_decimal(format!("{value:.2e}"), words);
    }
    let digits = (-step.log10().floor()).clamp(0.0, 4.0) as usize;
    let text = format!("{value:.digits$}");
    with_decimal(text.strip_prefix('-').map_or(text.clone(), |size| format!("−{size}")), words)
}

/// Text of a round length, without digits that tell nothing.
pub fn round_length(metres: f64, words: &InstrumentWords) -> String {
    without_zeros(length(metres, words), words)
}

/// Text of a round time, without digits that tell nothing.
pub fn round_time(seconds: f64, words: &InstrumentWords) -> String {
    without_zeros(time(seconds, words), words)
}

/// Text of a number with its unit, without zeros at the end of its fraction.
fn without_zeros(text: String, words: &InstrumentWords) -> String {
    match text.split_once(' ') {
        Some((number, unit)) if number.contains(words.decimal) && !number.contains('e') => {
            format!("{} {unit}", number.trim_end_matches('0').trim_end_matches(words.decimal))
        }
        _ => text,
    }
}

/// Text of a length.
pub fn length(metres: f64, words: &InstrumentWords) -> String {
    let (value, unit) = match metres.abs() {
        m if m >= 1e9 => return with_decimal(format!("{metres:.2e} m"), words),
        m if m >= 9_999.5 => (metres / 1e3, "km"),
        m if m >= 0.995 || m == 0.0 => (metres, "m"),
        m if m >= 0.01 => (metres * 100.0, "cm"),
        _ => (metres * 1e3, "mm"),
    };
    with_decimal(format!("{} {unit}", three_digits(value)), words)
}

/// Text of a time.
pub fn time(seconds: f64, words: &InstrumentWords) -> String {
    const YEAR_S: f64 = 365.25 * 86_400.0;
    let (value, unit) = match seconds.abs() {
        s if s >= 1e6 * YEAR_S => return with_decimal(format!("{seconds:.2e} s"), words),
        s if s >= 2.0 * YEAR_S => (seconds / YEAR_S, "a"),
        s if s >= 2.0 * 86_400.0 => (seconds / 86_400.0, "d"),
        s if s >= 7_200.0 => (seconds / 3_600.0, "h"),
        s if s >= 300.0 => (seconds / 60.0, "min"),
        s if s >= 0.1 || s == 0.0 => (seconds, "s"),
        s if s >= 1e-4 => (seconds * 1e3, "ms"),
        s if s >= 1e-7 => (seconds * 1e6, "µs"),
        _ => (seconds * 1e9, "ns"),
    };
    with_decimal(format!("{} {unit}", three_digits(value)), words)
}

/// Text of an acceleration in units of the standard acceleration of free fall.
pub fn gravities(value: f64, words: &InstrumentWords) -> String {
    let text = if value >= 1e4 { format!("{value:.1e} g") } else { format!("{} g", three_digits(value)) };
    with_decimal(text, words)
}

/// Reading of a clock: minutes and seconds, with hours from an hour on.
pub fn clock(seconds: f64, words: &InstrumentWords) -> String {
    if seconds.abs() >= 360_000.0 {
        return time(seconds, words);
    }
    let tenths = (seconds.max(0.0) * 10.0).floor();
    let (minutes, rest) = ((tenths / 600.0).floor(), tenths % 600.0 / 10.0);
    let text = match minutes {
        m if m >= 60.0 => format!("{:.0}:{:02.0}:{rest:04.1}", (m / 60.0).floor(), m % 60.0),
        m => format!("{m:02.0}:{rest:04.1}"),
    };
    with_decimal(text, words)
}

fn three_digits(value: f64) -> String {
    match value.abs() {
        v if v >= 99.95 => format!("{value:.0}"),
        v if v >= 9.995 => format!("{value:.1}"),
        0.0 => "0".to_owned(),
        _ => format!("{value:.2}"),
    }
}

fn with_decimal(text: String, words: &InstrumentWords) -> String {
    text.replace('.', &words.decimal.to_string())
}

#[cfg(test)]
mod tests {
    //! Law: numbers are round where they label, and short where they tell.

    use super::*;

    #[test]
    fn steps_are_round() {
        for (least, step) in [(1.0, 1.0), (1.1, 2.0), (2.0, 2.0), (3.0, 5.0), (7.0, 10.0), (0.03, 0.05), (1e12, 1e12)] {
            assert!((round_step(least) / step - 1.0).abs() < 1e-12, "{least}: {}", round_step(least));
        }
    }

    #[test]
    fn texts_have_units_and_the_languages_decimals() {
        let (english, german) = (&InstrumentWords::ENGLISH, &InstrumentWords::GERMAN);
        assert_eq!((length(12.345, english), length(12.345, german)), ("12.3 m".to_owned(), "12,3 m".to_owned()));
        assert_eq!((length(0.25, english), length(12_345.0, english)), ("25.0 cm".to_owned(), "12.3 km".to_owned()));
        assert_eq!((time(3.6 * 31_557_600.0, english), time(4.2, german)), ("3.60 a".to_owned(), "4,20 s".to_owned()));
        assert_eq!((multiple(-2.5, 0.5, german), multiple(20.0, 10.0, english)), ("−2,5".to_owned(), "20".to_owned()));
        assert_eq!((clock(61.27, english), clock(3_661.0, german)), ("01:01.2".to_owned(), "1:01:01,0".to_owned()));
        assert_eq!(gravities(0.25, english), "0.25 g");
        assert_eq!((round_time(2.0, german), round_length(50.0, english)), ("2 s".to_owned(), "50 m".to_owned()));
        assert_eq!((round_time(0.5, german), round_length(100.0, english)), ("0,5 s".to_owned(), "100 m".to_owned()));
    }

    #[test]
    fn units_suit_the_world() {
        let units = |c, width| {
            let units = AxisUnits::new(c, width);
            (units.length.1, units.time.1)
        };
        assert_eq!(units(30.0 / 3.6, 100.0), ("m", "s"));
        assert_eq!(units(299_792_458.0, 3e9), ("Ls", "s"));
        assert_eq!(units(299_792_458.0, 30.0), ("m", "ns"));
    }
}
