//! Head-up display: speed, the rider's and the world's clock, distances, and the program's own pace.

use egui::{Color32, CornerRadius, FontId, Pos2, Rect, Stroke, StrokeKind, Ui, Vec2};
use words::{Language, Phrase};

/// Values that the head-up display shows.
#[derive(Clone, Debug, Default)]
pub struct Readings {
    /// Speed in the world as a fraction of the speed of light.
    pub beta: f64,
    /// Lorentz factor γ.
    pub gamma: f64,
    /// Rapidity η = asinh |u|.
    pub rapidity: f64,
    /// Speed of light, m/s.
    pub speed_of_light: f64,
    /// Time on the rider's own clock, seconds.
    pub own_clock_s: f64,
    /// Time on the world's clock, seconds.
    pub world_clock_s: f64,
    /// Length of road passed, as the world measures it, metres.
    pub road_m: f64,
    /// Distance on the rider's own odometer, for which the road is contracted, metres.
    pub own_m: f64,
    /// Number of frames per second.
    pub frame_rate: f64,
    /// Name and duration of each stage of a frame, milliseconds.
    pub stages_ms: Vec<(&'static str, f64)>,
    /// Sentence on the accuracy of the drawn positions.
    pub certainty: String,
    /// Notices for the rider, the most urgent first.
    pub notices: Vec<String>,
    /// Sentence for passers-by.
    pub invitation: Option<String>,
    /// Language of the labels.
    pub language: Language,
    /// True in a kiosk, where nobody asks for the program's pace.
    pub kiosk: bool,
    /// True if the ride is paused.
    pub paused: bool,
    /// True if a recording is being written.
    pub recording: bool,
}

const INK: Color32 = Color32::from_rgb(0xf6, 0xf1, 0xe4);
const FAINT: Color32 = Color32::from_rgb(0xb9, 0xb2, 0xa0);
const ACCENT: Color32 = Color32::from_rgb(0xff, 0xb3, 0x47);
const ALERT: Color32 = Color32::from_rgb(0xff, 0x6b, 0x57);
const BACKDROP: Color32 = Color32::from_rgba_premultiplied(0x0c, 0x0e, 0x12, 0xb8);

/// Size of the smallest letters that can be read at a glance, points.
const LEGIBLE: f32 = 10.0;

/// Height of the bar at the bottom, points.
const BAR_HEIGHT: f32 = 92.0;

/// Draws the head-up display over the picture.
pub fn show(ui: &Ui, readings: &Readings) {
    let painter = ui.painter();
    let screen = ui.ctx().content_rect();
    let language = readings.language;
    let scale = (screen.width() / 1100.0).clamp(0.55, 1.0);
    let bar = Rect::from_min_max(Pos2::new(screen.left(), screen.bottom() - BAR_HEIGHT * scale), screen.max);
    painter.rect_filled(bar, CornerRadius::ZERO, BACKDROP);

    // Four fields side by side: speed, the two clocks, distances, the numbers of relativity.
    let field = |index: usize| {
        let width = bar.width() / 4.0;
        Rect::from_min_size(bar.min + Vec2::new(width * index as f32, 0.0), Vec2::new(width, bar.height()))
            .shrink2(Vec2::new(18.0, 8.0) * scale)
    };
    // One text at the left and one at the right of a field; both are made smaller if they would meet.
    let row = |area: Rect, y: f32, left: (&str, f32, Color32), right: (&str, f32, Color32)| {
        let laid = |(words, size, colour): (&str, f32, Color32), share: f32| {
            let size = (size * scale).max(LEGIBLE) * share;
            painter.layout_no_wrap(language.decimals(words), FontId::proportional(size), colour)
        };
        let wanted = laid(left, 1.0).size().x + laid(right, 1.0).size().x + 8.0 * scale;
        let share = (area.width() / wanted).min(1.0);
        let (left, right) = (laid(left, share), laid(right, share));
        painter.galley(Pos2::new(area.left(), y - 0.5 * left.size().y), left, INK);
        painter.galley(Pos2::new(area.right() - right.size().x, y - 0.5 * right.size().y), right, INK);
    };
    let pair = |area: Rect, rows: [(&str, String); 2]| {
        for (number, (label, value)) in rows.into_iter().enumerate() {
            let y = area.top() + area.height() * (0.27 + 0.5 * number as f32);
            row(area, y, (label, 14.0, FAINT), (&value, 22.0, INK));
        }
    };

    let area = field(0);
    let kilometres_per_hour = readings.beta * readings.speed_of_light * 3.6;
    let limit = language.fill(Phrase::Light, &[&speed(readings.speed_of_light * 3.6)]);
    let own = speed(kilometres_per_hour);
    row(area, area.top() + 20.0 * scale, (&own, 34.0, INK), (&limit, 14.0, FAINT));
    let track = Rect::from_min_max(Pos2::new(area.left(), area.bottom() - 16.0 * scale), area.max);
    let filled = Rect::from_min_size(track.min, Vec2::new(track.width() * readings.beta as f32, track.height()));
    painter.rect_filled(filled, CornerRadius::same(3), ACCENT);
    painter.rect_stroke(track, CornerRadius::same(3), Stroke::new(1.0, FAINT), StrokeKind::Inside);

    let label = |phrase| language.text(phrase);
    pair(
        field(1),
        [
            (label(Phrase::YourClock), clock(readings.own_clock_s)),
            (label(Phrase::WorldClock), clock(readings.world_clock_s)),
        ],
    );
    pair(field(2), [(label(Phrase::Road), metres(readings.road_m)), (label(Phrase::Odometer), metres(readings.own_m))]);
    pair(
        field(3),
        [
            ("β", beta(readings.beta, readings.gamma)),
            (label(Phrase::GammaRapidity), format!("{} · {:.2}", number(readings.gamma), readings.rapidity)),
        ],
    );

    // At the top right, the program's own pace; at the top left, state and notices, moved below the pace if they
    // would meet.
    let most = screen.width() - 24.0;
    let laid = |words: &str, most| painter.layout(words.to_owned(), FontId::proportional(13.0), INK, most);
    let fits = |words: &str| laid(words, f32::INFINITY).size().x <= most;
    let pace = laid(&language.decimals(&pace(readings, fits)), most);
    let words = [(readings.recording, Phrase::Recording, ALERT), (readings.paused, Phrase::Paused, ACCENT)];
    let states = words.into_iter().filter(|(so, ..)| *so).map(|(_, phrase, colour)| (language.text(phrase), colour));
    let lines: Vec<_> = states
        .chain(readings.notices.iter().map(|notice| (notice.as_str(), INK)))
        .map(|(words, colour)| {
            painter.layout(
                words.to_owned(),
                FontId::proportional(17.0 * scale.max(0.75)),
                colour,
                screen.width() - 28.0,
            )
        })
        .collect();
    let widest = lines.iter().map(|line| line.size().x).fold(0.0, f32::max);
    let meet = widest + pace.size().x + 50.0 > screen.width();
    let mut y = screen.top() + 10.0 + if meet { pace.size().y + 12.0 } else { 0.0 };
    for line in lines {
        let at = Pos2::new(screen.left() + 14.0, y);
        y += line.size().y + 10.0;
        painter.rect_filled(Rect::from_min_size(at, line.size()).expand(5.0), CornerRadius::same(4), BACKDROP);
        painter.galley(at, line, INK);
    }
    if let Some(invitation) = &readings.invitation {
        let font = FontId::proportional(34.0 * scale);
        let line = painter.layout(invitation.clone(), font, INK, screen.width() - 80.0);
        let at = Pos2::new(screen.center().x - 0.5 * line.size().x, bar.top() - line.size().y - 36.0 * scale);
        painter.rect_filled(Rect::from_min_size(at, line.size()).expand(14.0), CornerRadius::same(8), BACKDROP);
        painter.galley(at, line, INK);
    }
    let at = Pos2::new(screen.right() - pace.size().x - 12.0, screen.top() + 8.0);
    painter.rect_filled(Rect::from_min_size(at, pace.size()).expand(5.0), CornerRadius::same(4), BACKDROP);
    painter.galley(at, pace, INK);
}

/// Line of the speed, beside that of light.
pub fn speed_line(readings: &Readings, language: Language) -> String {
    let kilometres_per_hour = readings.beta * readings.speed_of_light * 3.6;
    let limit = language.fill(Phrase::Light, &[&speed(readings.speed_of_light * 3.6)]);
    language.decimals(&format!("{} · {limit} · β {}", speed(kilometres_per_hour), beta(readings.beta, readings.gamma)))
}

/// Line of the clocks and the frame rate.
pub fn pace_line(readings: &Readings, language: Language) -> String {
    let rate = language.fill(Phrase::FramesPerSecond, &[&format!("{:.1}", readings.frame_rate)]);
    let [own, world] = [readings.own_clock_s, readings.world_clock_s].map(clock);
    let [your, its] = [Phrase::YourClock, Phrase::WorldClock].map(|phrase| language.text(phrase));
    language.decimals(&format!("{your} {own} · {its} {world} · {rate}"))
}

/// Text of the program's own pace; without the stages of a frame if one line has no room for them. `fits`: true if a
/// line has room for a text.
fn pace(readings: &Readings, fits: impl Fn(&str) -> bool) -> String {
    let language = readings.language;
    if readings.kiosk {
        return language.text(Phrase::HelpKey).to_owned();
    }
    let keys = language.text(Phrase::HelpAndMenu);
    let stages: Vec<String> = readings.stages_ms.iter().map(|(name, ms)| format!("{name} {ms:.1}")).collect();
    let rate = language.fill(Phrase::FramesPerSecond, &[&format!("{:.1}", readings.frame_rate)]);
    let pace = format!("{}   {rate}", readings.certainty);
    let whole = format!("{pace}   {} ms   {keys}", stages.join(" · "));
    if fits(&whole) { whole } else { format!("{pace}   {keys}") }
}

/// Text of β with as many nines as it has: the number of digits follows 1 − β = 1/(γ² (1 + β)).
fn beta(beta: f64, gamma: f64) -> String {
    if beta < 0.999 {
        return format!("{beta:.3}");
    }
    let short = 1.0 / (gamma * gamma * (1.0 + beta));
    if short > 1e-9 {
        format!("{beta:.*}", (1.0 - short.log10().floor()) as usize)
    } else {
        format!("1 − {short:.1e}")
    }
}

fn number(value: f64) -> String {
    if value < 100.0 { format!("{value:.3}") } else { format!("{value:.3e}") }
}

/// Text of a speed in km/h with about three digits; of a very large one in km/s.
fn speed(kilometres_per_hour: f64) -> String {
    match kilometres_per_hour {
        v if v < 999.95 => format!("{v:.1} km/h"),
        v if v < 99_999.5 => format!("{v:.0} km/h"),
        v => {
            let km_s = v / 3600.0;
            format!("{km_s:.*} km/s", (2.0 - km_s.log10().floor()).max(0.0) as usize)
        }
    }
}

fn metres(value: f64) -> String {
    match value {
        v if v < 9_999.5 => format!("{v:.0} m"),
        v if v < 9.999e9 => format!("{:.1} km", v / 1000.0),
        v => format!("{v:.2e} m"),
    }
}

fn clock(seconds: f64) -> String {
    if seconds.abs() >= 360_000.0 {
        return format!("{seconds:.3e} s");
    }
    let minutes = (seconds / 60.0).floor();
    format!("{minutes:02.0}:{:04.1}", (seconds - 60.0 * minutes).min(59.9))
}

#[cfg(test)]
mod tests {
    //! Law under test: the readings never contradict the state. A speed below that of light never reads 1, and a
    //! clock never reads 60 s. What there is no room for does not hide the street.

    use super::*;

    #[test]
    fn beta_below_one_never_reads_one() {
        for exponent in 1..13 {
            let gamma = 10_f64.powi(exponent);
            let value = (1.0 - 1.0 / gamma / gamma).sqrt();
            assert!(!beta(value, gamma).starts_with("1.0"), "{}", beta(value, gamma));
        }
        assert_eq!(beta(0.6, 1.25), "0.600");
        assert_eq!(beta(0.999_95, 100.001_25), "0.999950");
    }

    #[test]
    fn a_small_window_shows_its_pace_in_one_line() {
        let readings = Readings {
            certainty: "±5.0 arcmin".to_owned(),
            frame_rate: 30.0,
            stages_ms: vec![("ride", 0.1), ("draw", 24.6)],
            ..Readings::default()
        };
        let whole = pace(&readings, |_| true);
        assert_eq!(whole, "±5.0 arcmin   30.0 frames/s   ride 0.1 · draw 24.6 ms   F1 help · F3 menu");
        let short = pace(&readings, |words| words.len() < whole.len());
        assert_eq!(short, "±5.0 arcmin   30.0 frames/s   F1 help · F3 menu");
        assert_eq!(pace(&Readings { kiosk: true, ..readings }, |_| true), "F1 help");
    }

    #[test]
    fn speeds_have_three_digits() {
        for (kilometres_per_hour, text) in [
            (0.0, "0.0 km/h"),
            (30.0, "30.0 km/h"),
            (999.96, "1000 km/h"),
            (2000.0, "2000 km/h"),
            (5399.0, "5399 km/h"),
            (100_000.0, "27.8 km/s"),
            (299_792.458 * 3600.0, "299792 km/s"),
        ] {
            assert_eq!(speed(kilometres_per_hour), text);
        }
    }

    #[test]
    fn clocks_carry_to_minutes() {
        assert_eq!(clock(0.0), "00:00.0");
        assert_eq!(clock(59.98), "00:59.9");
        assert_eq!(clock(61.25), "01:01.2");
        assert_eq!(clock(1e6), "1.000e6 s");
    }
}
