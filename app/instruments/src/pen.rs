//! Pen of the instruments: colours of the head-up display, text on plates, lines of any length.

use egui::{Align2, Color32, CornerRadius, FontId, Painter, Pos2, Rect, Shape, Stroke, Vec2};

use crate::line_clip::clipped;

/// Colour of text and of the worldline.
pub const INK: Color32 = Color32::from_rgb(0xf6, 0xf1, 0xe4);
/// Colour of what is less important.
pub const FAINT: Color32 = Color32::from_rgb(0xb9, 0xb2, 0xa0);
/// Colour of the rider's present.
pub const ACCENT: Color32 = Color32::from_rgb(0xff, 0xb3, 0x47);
/// Colour of what is simultaneous for the rider.
pub const NOW: Color32 = Color32::from_rgb(0x86, 0xc5, 0xff);
/// Colour of light.
pub const LIGHT: Color32 = Color32::from_rgb(0xff, 0xe3, 0x92);
/// Colour of events.
pub const EVENT: Color32 = Color32::from_rgb(0xa8, 0xe0, 0x8c);
/// Ground of an instrument.
pub const BACKDROP: Color32 = Color32::from_rgba_premultiplied(0x0c, 0x0e, 0x12, 0xe0);
/// Ground of a label on a picture.
const PLATE: Color32 = Color32::from_rgba_premultiplied(0x0a, 0x0c, 0x10, 0xb0);
/// Colour of grids.
pub const GRID: Color32 = Color32::from_rgba_premultiplied(0x1c, 0x1b, 0x19, 0x20);

/// Size of usual text, points.
pub const TEXT: f32 = 14.0;
/// Size of titles, points.
pub const TITLE: f32 = 16.0;
/// Room between an instrument's border and its content, points.
pub const MARGIN: f32 = 10.0;

/// Pen that draws an instrument within bounds.
pub struct Pen<'a> {
    painter: &'a Painter,
    bounds: Rect,
    /// Labels so far, which others avoid.
    labels: Vec<Rect>,
}

impl<'a> Pen<'a> {
    /// Pen within `bounds`, a part of the painter's own.
    pub fn new(painter: &'a Painter, bounds: Rect) -> Self {
        Self { painter, bounds, labels: Vec::new() }
    }

    /// Cuts off lines outside the bounds, and draws those within.
    pub fn line(&self, from: [f64; 2], to: [f64; 2], stroke: Stroke) {
        if let Some(ends) = clipped(from, to, self.bounds) {
            self.painter.line_segment(ends, stroke);
        }
    }

    /// Draws a dashed line.
    pub fn dashed(&self, from: [f64; 2], to: [f64; 2], stroke: Stroke, dash: f32) {
        if let Some(ends) = clipped(from, to, self.bounds) {
            self.painter.extend(Shape::dashed_line(&ends, stroke, dash, 0.8 * dash));
        }
    }

    /// Draws a polyline, in as few paths as its cuts allow. Places nearer than `least` points to the last
    /// one are passed over.
    pub fn polyline(&self, points: impl Iterator<Item = [f64; 2]>, least: f64, stroke: Stroke) {
        let mut path: Vec<Pos2> = Vec::new();
        let mut before: Option<[f64; 2]> = None;
        let flush = |path: &mut Vec<Pos2>| {
            if path.len() > 1 {
                self.painter.add(Shape::line(std::mem::take(path), stroke));
            }
            path.clear();
        };
        let mut points = points.peekable();
        while let Some(point) = points.next() {
            let Some(from) = before else {
                before = Some(point);
                continue;
            };
            let is_last = points.peek().is_none();
            if !is_last && (point[0] - from[0]).hypot(point[1] - from[1]) < least {
                continue;
            }
            match clipped(from, point, self.bounds) {
                Some([start, end]) => {
                    if path.last().is_none_or(|last| last.distance(start) > 0.01) {
                        flush(&mut path);
                        path.push(start);
                    }
                    path.push(end);
                }
                None => flush(&mut path),
            }
            before = Some(point);
        }
        flush(&mut path);
    }

    /// Draws a dot with a dark rim, if it lies within the bounds. Returns its place.
    pub fn dot(&self, at: [f64; 2], radius: f32, colour: Color32) -> Option<Pos2> {
        let [at, _] = clipped(at, at, self.bounds)?;
        self.painter.circle(at, radius, colour, Stroke::new(1.0, Color32::from_black_alpha(0xc0)));
        Some(at)
    }

    /// Draws text beside a place, on a plate, within the bounds; moved down or up where another label is already, and
    /// left out where that does not help.
    pub fn label(&mut self, at: Pos2, align: Align2, text: &str, colour: Color32) {
        self.label_moved(at, align, text, colour, &[0.0, 1.1, -1.1]);
    }

    /// Draws text at a mark of an axis, on a plate; left out where another label is already.
    pub fn tick(&mut self, at: Pos2, align: Align2, text: &str) {
        self.label_moved(at, align, text, FAINT, &[0.0]);
    }

    /// Draws text at the first of some places, `shifts` in heights of the text, where no other label is.
    fn label_moved(&mut self, at: Pos2, align: Align2, text: &str, colour: Color32, shifts: &[f32]) {
        let galley = self.painter.layout_no_wrap(text.to_owned(), FontId::proportional(TEXT), colour);
        let room = self.bounds.shrink(4.0);
        let place = shifts.iter().find_map(|shift| {
            let rect = align.anchor_size(at + Vec2::new(0.0, shift * galley.size().y), galley.size());
            let inward = |low: f32, high: f32, least: f32, most: f32| (least - low).max(0.0) + (most - high).min(0.0);
            let rect = rect.translate(Vec2::new(
                inward(rect.left(), rect.right(), room.left(), room.right()),
                inward(rect.top(), rect.bottom(), room.top(), room.bottom()),
            ));
            self.labels.iter().all(|other| !other.intersects(rect)).then_some(rect)
        });
        let Some(rect) = place else { return };
        self.painter.rect_filled(rect.expand2(Vec2::new(3.0, 0.0)), CornerRadius::same(3), PLATE);
        self.painter.galley(rect.min, galley, colour);
        self.labels.push(rect.expand(2.0));
    }

    /// Keeps a place free of labels.
    pub fn keep_free(&mut self, place: Rect) {
        self.labels.push(place);
    }
}

/// Draws the ground of an instrument, its title at the top and its caption at the bottom. Returns the rectangle between
/// them.
pub fn frame(painter: &Painter, area: Rect, title: &str, caption: &str) -> Rect {
    painter.rect_filled(area, CornerRadius::same(8), BACKDROP);
    let inner = area.shrink(MARGIN);
    let top = painter.text(inner.left_top(), Align2::LEFT_TOP, title, FontId::proportional(TITLE), INK);
    if caption.is_empty() {
        return Rect::from_min_max(Pos2::new(inner.left(), top.bottom() + 6.0), inner.max);
    }
    let galley = painter.layout(caption.to_owned(), FontId::proportional(TEXT), FAINT, inner.width());
    let caption_top = inner.bottom() - galley.size().y;
    painter.galley(Pos2::new(inner.left(), caption_top), galley, FAINT);
    Rect::from_min_max(Pos2::new(inner.left(), top.bottom() + 6.0), Pos2::new(inner.right(), caption_top - 6.0))
}
