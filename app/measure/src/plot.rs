//! Plot of the table: time across, error up, both logarithmic; a line joins the rows that no other row beats.

use std::path::Path;

use plotters::coord::Shift;
use plotters::coord::combinators::BindKeyPoints;
use plotters::prelude::*;
use plotters::style::text_anchor::{HPos, Pos, VPos};
use plotters::style::{FontStyle, register_font};
use std::ops::Range;

use super::row::Row;

/// Size of the plot, pixels.
const SIZE: (u32, u32) = (1000, 620);
const FONT: &str = "sans-serif";
const FRONT: RGBColor = RGBColor(120, 120, 120);

/// Appearance of a dial's points.
struct Kind {
    dial: &'static str,
    name: &'static str,
    colour: RGBColor,
    /// True if values stand on the lower left of their points, where no better point can be; otherwise on the upper
    /// right.
    below: bool,
}

const KINDS: [Kind; 4] = [
    Kind { dial: "edge", name: "polygon, cut once (--edge, metres)", colour: RGBColor(214, 96, 36), below: true },
    Kind {
        dial: "transform",
        name: "the same, bent by the GPU (--transform gpu)",
        colour: RGBColor(140, 70, 160),
        below: false,
    },
    Kind {
        dial: "tolerance",
        name: "polygon, cut for the picture (--tolerance, pixels)",
        colour: RGBColor(20, 110, 180),
        below: true,
    },
    Kind {
        dial: "map-scale",
        name: "image (--map-scale, texels a pixel)",
        colour: RGBColor(40, 140, 60),
        below: false,
    },
];

/// Failure to draw or write a plot.
#[derive(Debug, thiserror::Error)]
#[error("it cannot be plotted: {0}")]
pub struct PlotError(String);

/// Draws the rows into an .svg or .png file.
///
/// # Arguments
/// * `title` — the subject and the machine of the measurement.
/// * `pixel_arcmin` — size of a pixel, arcminutes, for a horizontal line.
///
/// # Errors
/// [`PlotError`] if the file cannot be written.
pub fn plot(rows: &[Row], title: &str, pixel_arcmin: f64, path: &Path) -> Result<(), PlotError> {
    register_font(FONT, FontStyle::Normal, epaint_default_fonts::UBUNTU_LIGHT)
        .map_err(|_| PlotError("its font is damaged".to_owned()))?;
    if path.extension().is_some_and(|extension| extension.eq_ignore_ascii_case("svg")) {
        draw(&SVGBackend::new(path, SIZE).into_drawing_area(), rows, title, pixel_arcmin, " ").map_err(PlotError)
    } else {
        draw(&BitMapBackend::new(path, SIZE).into_drawing_area(), rows, title, pixel_arcmin, "  ").map_err(PlotError)
    }
}

/// Draws the plot. `space` stands between words; in bitmaps, where letters have no side bearings, a single space is
/// hardly visible.
fn draw<B: DrawingBackend>(
    area: &DrawingArea<B, Shift>,
    rows: &[Row],
    title: &str,
    pixel_arcmin: f64,
    space: &str,
) -> Result<(), String> {
    let words = |text: &str| text.replace(' ', space);
    let told = |error: DrawingAreaErrorKind<B::ErrorType>| error.to_string();
    area.fill(&WHITE).map_err(told)?;
    let span = |values: Vec<f64>, below: f64, above: f64| {
        let positive = || values.iter().copied().filter(|value| *value > 0.0);
        (positive().fold(f64::INFINITY, f64::min) * below)..(positive().fold(0.0, f64::max) * above)
    };
    let across = span(rows.iter().map(|row| row.ms[0]).collect(), 0.8, 1.6);
    let up = span(rows.iter().map(|row| row.arcmin[1]).chain([pixel_arcmin]).collect(), 0.6, 1.8);
    let mut chart = ChartBuilder::on(area)
        .caption(words(title), (FONT, 22))
        .margin(14)
        .x_label_area_size(52)
        .y_label_area_size(70)
        .build_cartesian_2d(
            across.clone().log_scale().with_key_points(numbers(&across)),
            up.clone().log_scale().with_key_points(numbers(&up)),
        )
        .map_err(told)?;
    chart
        .configure_mesh()
        .x_desc(words("milliseconds a picture, from nothing"))
        .y_desc(words("direction error that 99 of 100 pixels do not exceed, arcmin"))
        .x_label_formatter(&label)
        .y_label_formatter(&label)
        .x_labels(16)
        .y_labels(16)
        .max_light_lines(4)
        .axis_desc_style((FONT, 18))
        .label_style((FONT, 15))
        .light_line_style(RGBColor(238, 238, 238))
        .bold_line_style(RGBColor(220, 220, 220))
        .draw()
        .map_err(told)?;

    // Line of one pixel, and line of the best rows.
    let pixel = [(across.start, pixel_arcmin), (across.end, pixel_arcmin)];
    chart.draw_series(LineSeries::new(pixel, BLACK.mix(0.35))).map_err(told)?;
    let note = Text::new(words("one pixel"), (across.start * 1.03, pixel_arcmin * 0.93), (FONT, 15).into_font());
    chart.draw_series([note]).map_err(told)?;
    let mut front: Vec<(f64, f64)> = rows.iter().filter(|row| row.best).map(|row| (row.ms[0], row.arcmin[1])).collect();
    front.sort_by(|a, b| a.0.total_cmp(&b.0));
    chart
        .draw_series(LineSeries::new(front, FRONT.stroke_width(2)))
        .map_err(told)?
        .label(words("no setting is both faster and closer"))
        .legend(|(x, y)| PathElement::new([(x, y), (x + 18, y)], FRONT.stroke_width(2)));

    for Kind { dial, name, colour, below } in KINDS {
        let (offset, anchor) =
            if below { ((-7, 2), (HPos::Right, VPos::Top)) } else { ((8, -2), (HPos::Left, VPos::Bottom)) };
        let style = (FONT, 17).into_font().color(&colour).pos(Pos::new(anchor.0, anchor.1));
        let of_dial = rows.iter().filter(|row| row.dial.turned().is_some_and(|(name, _)| name == dial));
        let points = of_dial
            .map(|row| (row.ms[0], row.arcmin[1], row.dial.turned().map_or(0.0, |(_, value)| value).to_string()));
        let marks = points.map(|(ms, arcmin, value)| {
            EmptyElement::at((ms, arcmin))
                + Circle::new((0, 0), 6, colour.filled())
                + Text::new(value, offset, style.clone())
        });
        chart
            .draw_series(marks)
            .map_err(told)?
            .label(words(name))
            .legend(move |(x, y)| Circle::new((x + 9, y), 5, colour.filled()));
    }
    chart
        .configure_series_labels()
        .position(SeriesLabelPosition::UpperRight)
        .label_font((FONT, 16))
        .background_style(WHITE.mix(0.9))
        .border_style(RGBColor(200, 200, 200))
        .draw()
        .map_err(told)?;
    area.present().map_err(told)
}

/// Labels along a logarithmic axis: numbers that begin with 1, 2 or 5, since there is no room for more.
fn numbers(range: &Range<f64>) -> Vec<f64> {
    let decades = range.start.log10().floor() as i32..=range.end.log10().ceil() as i32;
    let all = decades.flat_map(|power| [1.0, 2.0, 5.0].map(|first| first * 10.0_f64.powi(power)));
    all.filter(|number| range.contains(number)).collect()
}

/// Number as text, with as many digits as its size needs.
fn label(value: &f64) -> String {
    let digits = (-(value.log10() + 1e-9).floor()).max(0.0) as usize;
    format!("{value:.digits$}")
}

#[cfg(test)]
mod tests {
    //! Labels along an axis must show their own numbers, in as many digits as they need.

    use super::*;

    #[test]
    fn numbers_along_an_axis_begin_with_one_two_or_five() {
        let written = |range: Range<f64>| numbers(&range).iter().map(label).collect::<Vec<_>>();
        assert_eq!(written(0.03..7.0), ["0.05", "0.1", "0.2", "0.5", "1", "2", "5"]);
        assert_eq!(written(90.0..1999.0), ["100", "200", "500", "1000"]);
    }
}
