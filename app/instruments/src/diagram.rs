//! Minkowski diagram of the ride: worldline with dots of own time, light cone, the two "nows", events.

use egui::{Align2, Color32, CornerRadius, Painter, Pos2, Rect, Shape, Stroke, Vec2};
use physics::Event;

use crate::diagram_frame::DiagramFrame;
use crate::diagram_view::{DiagramView, PAST_SHARE};
use crate::figures::{AxisUnits, multiple, round_step, round_time};
use crate::pen::{self, ACCENT, EVENT, FAINT, GRID, INK, LIGHT, NOW, Pen};
use crate::spacetime_map::{DiagramPlace, SpacetimeMap};
use crate::trail::{PresentMoment, Trail};
use crate::trail_point::TrailPoint;
use crate::words::InstrumentWords;

/// Least distance of two grid lines, points.
const GRID_SPACING: f64 = 64.0;
/// Number of windows of own time whose worldline is drawn.
const WINDOWS: f64 = 4.0;
/// Number of dots of own time in a window.
const DOTS: f64 = 10.0;
/// Number of steps from the start beyond which an axis counts from the present event.
const FAR_STEPS: f64 = 1e5;

/// Draws the diagram of a trail into `area`, with its title and its caption.
pub fn diagram(painter: &Painter, area: Rect, trail: &Trail, view: &DiagramView, words: &InstrumentWords) {
    let dot_s = round_step(view.window_s / DOTS);
    let title = match view.frame {
        DiagramFrame::World => words.diagram_of_world,
        DiagramFrame::Vehicle => words.diagram_of_vehicle,
    };
    let caption = InstrumentWords::filled(words.diagram_caption, &[&round_time(dot_s, words)]);
    let plot = pen::frame(painter, area, title, &caption);
    let (Some(now), true) = (trail.present(), plot.is_positive() && view.half_width_m() > 0.0) else { return };
    let sheet = Sheet::new(plot, now, view);
    let mut pen = Pen::new(painter, plot);
    let axes = sheet.axes(trail);
    sheet.light_cone(painter);
    sheet.grid(&pen, &axes);
    sheet.nows(&pen);
    sheet.worldline(&pen, trail, dot_s, view.window_s);
    // Labels lie over all lines; those that come first have the first choice of place.
    sheet.events(&mut pen, trail, words);
    sheet.names(&mut pen, words);
    sheet.numbers(&mut pen, &axes, words);
    painter.rect_stroke(plot, CornerRadius::same(3), Stroke::new(1.0, FAINT), egui::StrokeKind::Inside);
}

/// Sheet of a diagram: its map, and the place of its present event in the interface.
struct Sheet<'a> {
    plot: Rect,
    now: &'a PresentMoment,
    view: &'a DiagramView,
    map: SpacetimeMap,
    /// Place of the present event, points.
    middle: Pos2,
    /// Points per metre.
    scale: f64,
}

impl<'a> Sheet<'a> {
    fn new(plot: Rect, now: &'a PresentMoment, view: &'a DiagramView) -> Self {
        let middle = Pos2::new(plot.center().x, plot.top() + plot.height() * (1.0 - PAST_SHARE as f32));
        let scale = f64::from(plot.width().min(plot.height())) / (2.0 * view.half_width_m());
        Self { plot, now, view, map: view.map(now), middle, scale }
    }

    /// Place in the interface, points.
    fn at(&self, place: DiagramPlace) -> [f64; 2] {
        [f64::from(self.middle.x) + self.scale * place.x, f64::from(self.middle.y) - self.scale * place.t]
    }

    /// Place of a point that many points to the right of and above the present event.
    fn beside(&self, right: f64, up: f64) -> [f64; 2] {
        [f64::from(self.middle.x) + right, f64::from(self.middle.y) - up]
    }

    /// A length that leads out of the sheet from anywhere in it, points.
    fn beyond(&self) -> f64 {
        2.0 * f64::from(self.plot.width() + self.plot.height())
    }

    /// Past and future of the present event, as far as light goes.
    fn light_cone(&self, painter: &Painter) {
        let painter = painter.with_clip_rect(self.plot.intersect(painter.clip_rect()));
        let (up, down) = (self.middle.y - self.plot.top(), self.plot.bottom() - self.middle.y);
        for (height, alpha) in [(-up, 0x10), (down, 0x1c)] {
            let side = height.abs();
            let corners = [Vec2::ZERO, Vec2::new(-side, height), Vec2::new(side, height)];
            let fill = LIGHT.gamma_multiply(f32::from(alpha as u8) / 255.0);
            let corners = corners.map(|corner| self.middle + corner).to_vec();
            painter.add(Shape::convex_polygon(corners, fill, Stroke::NONE));
        }
        let pen = Pen::new(&painter, self.plot);
        let far = self.beyond();
        for side in [-1.0, 1.0] {
            pen.line(self.beside(-side * far, -far), self.beside(side * far, far), Stroke::new(1.3, LIGHT));
        }
    }

    /// Marks of the axes of space and time of the frame in which the diagram is drawn. The world's axes count from the
    /// start, the vehicle's from the present event.
    fn axes(&self, trail: &Trail) -> [DiagramMarks; 2] {
        let units = AxisUnits::new(self.now.light_speed.speed_of_light_m_s(), self.view.half_width_m());
        let start = trail.start().unwrap_or(self.now.event);
        let [x, t] = match self.view.frame {
            DiagramFrame::World => [(self.now.event - start).r.dot(self.view.axis()), self.now.event.ct],
            DiagramFrame::Vehicle => [0.0, 0.0],
        };
        let across = [self.plot.left() - self.middle.x, self.plot.right() - self.middle.x];
        let upward = [self.middle.y - self.plot.bottom(), self.middle.y - self.plot.top()];
        [self.marks(units.length, x, across), self.marks(units.time, t, upward)]
    }

    fn grid(&self, pen: &Pen<'_>, [space, time]: &[DiagramMarks; 2]) {
        let (far, stroke) = (self.beyond(), Stroke::new(1.0, GRID));
        for (at, _) in &space.marks {
            pen.line(self.beside(*at, -far), self.beside(*at, far), stroke);
        }
        for (at, _) in &time.marks {
            pen.line(self.beside(-far, *at), self.beside(far, *at), stroke);
        }
    }

    /// Numbers and units at the axes.
    fn numbers(&self, pen: &mut Pen<'_>, [space, time]: &[DiagramMarks; 2], words: &InstrumentWords) {
        let corner = self.plot.shrink(4.0);
        pen.label(corner.left_top(), Align2::LEFT_TOP, &format!("{} / {}", words.time, time.unit), INK);
        let above = corner.right_bottom() - Vec2::new(0.0, 20.0);
        pen.label(above, Align2::RIGHT_BOTTOM, &format!("{} / {}", words.space, space.unit), INK);
        for (at, number) in &space.marks {
            let foot = Pos2::new(self.middle.x + *at as f32, corner.bottom());
            pen.tick(foot, Align2::CENTER_BOTTOM, &multiple(*number, space.step, words));
        }
        for (at, number) in &time.marks {
            let foot = Pos2::new(corner.left(), self.middle.y - *at as f32);
            pen.tick(foot, Align2::LEFT_CENTER, &multiple(*number, time.step, words));
        }
    }

    /// Round marks of an axis between two places, points from the present event, which is at `present_m`, metres.
    fn marks(&self, (unit_m, unit): (f64, &'static str), present_m: f64, [from, to]: [f32; 2]) -> DiagramMarks {
        /// Largest number of marks.
        const MOST: f64 = 100.0;
        let step = round_step(GRID_SPACING / self.scale / unit_m);
        let present = present_m / unit_m;
        let base = if (present / step).abs() < FAR_STEPS { present } else { 0.0 };
        let number = |points: f32| f64::from(points) / self.scale / unit_m + base;
        let (first, last) = ((number(from) / step).ceil(), (number(to) / step).floor());
        let count = if (0.0..MOST).contains(&(last - first)) { (last - first) as usize + 1 } else { 0 };
        let mark = |index: usize| {
            // A sum with 0 makes 0 of −0.
            let value = (first + index as f64) * step + 0.0;
            ((value - base) * unit_m * self.scale, value)
        };
        DiagramMarks { marks: (0..count).map(mark).collect(), step, unit }
    }

    /// Lines of what is simultaneous with the present event, for the rider and for the world.
    fn nows(&self, pen: &Pen<'_>) {
        let far = self.beyond();
        let line = |slope: f64| (self.beside(-far, -slope * far), self.beside(far, slope * far));
        let (from, to) = line(self.map.world_now_slope());
        pen.dashed(from, to, Stroke::new(1.3, FAINT), 6.0);
        let (from, to) = line(self.map.now_slope());
        pen.line(from, to, Stroke::new(2.0, NOW));
    }

    /// Names of the lines.
    fn names(&self, pen: &mut Pen<'_>, words: &InstrumentWords) {
        // Labels stand where the lines are apart from each other and from light.
        let side = if self.map.now_slope() - self.map.world_now_slope() < 0.0 { -1.0 } else { 1.0 };
        let (yours, worlds, light) = match self.view.frame {
            DiagramFrame::World => (side, -side, -side),
            DiagramFrame::Vehicle => (-side, side, side),
        };
        let mut at_end = |slope: f64, side: f64, text: &str, colour: Color32| {
            let width = 0.5 * f64::from(self.plot.width()) - 6.0;
            let right = side * width.min(self.room(slope * side) / slope.abs().max(1e-9));
            let [x, y] = self.beside(right, slope * right);
            let align = if side > 0.0 { Align2::RIGHT_BOTTOM } else { Align2::LEFT_BOTTOM };
            pen.label(Pos2::new(x as f32, y as f32 - 3.0), align, text, colour);
        };
        at_end(self.map.now_slope(), yours, words.your_now, NOW);
        at_end(self.map.world_now_slope(), worlds, words.world_now, FAINT);
        at_end(light, light, words.light, LIGHT);
    }

    /// Room above the present event for a line that rises (positive), or below it, points.
    fn room(&self, rise: f64) -> f64 {
        let room = if rise > 0.0 { self.middle.y - self.plot.top() } else { self.plot.bottom() - self.middle.y };
        f64::from(room) - 26.0
    }

    fn worldline(&self, pen: &Pen<'_>, trail: &Trail, dot_s: f64, window_s: f64) {
        let points = trail.points_since(self.now.own_s - WINDOWS * window_s);
        // What rests at the start, as a measure of the way.
        if let Some(start) = trail.start() {
            let (rest, far) = (self.map.world_rest(), self.beyond());
            let [x, y] = self.at(self.map.place(start));
            if y.is_finite() && y.abs() < 1e6 && x.abs() < 1e6 {
                pen.dashed([x, y], [x + rest * far, y - far], Stroke::new(1.0, EVENT.gamma_multiply(0.55)), 3.0);
            }
        }
        for line in points.split(|point| point.begins).zip(beginnings(&points)) {
            let (rest, first) = line;
            let places = first.iter().chain(rest).map(|point| self.at(self.map.place(point.event)));
            pen.polyline(places, 1.0, Stroke::new(2.4, INK));
        }
        // The way on, if the motion stays.
        let far = self.beyond();
        let motion = self.map.motion();
        let stroke = Stroke::new(1.5, INK.gamma_multiply(0.6));
        pen.dashed(self.beside(0.0, 0.0), self.beside(motion * far, far), stroke, 4.0);
        for event in own_time_dots(&points, dot_s) {
            pen.dot(self.at(self.map.place(event)), 3.2, INK);
        }
    }

    fn events(&self, pen: &mut Pen<'_>, trail: &Trail, words: &InstrumentWords) {
        let here = pen.dot(self.beside(0.0, 0.0), 5.5, ACCENT);
        pen.keep_free(Rect::from_center_size(here.unwrap_or(self.middle), Vec2::splat(14.0)));
        let marked = trail.events().iter().map(|mark| (mark.name.as_str(), mark.event, EVENT));
        // Where a tour tells of events, clocks are dots without names beside them.
        let names_clocks = trail.events().is_empty();
        let seen = trail.seen_now().map(|(name, event)| (if names_clocks { name } else { "" }, event, LIGHT));
        let start = trail.start().map(|event| (words.start, event, EVENT));
        let all: Vec<(&str, Event, Color32)> = marked.chain(seen).chain(start).collect();
        for (name, event, colour) in all {
            let dot = pen.dot(self.at(self.map.place(event)), 4.5, colour);
            if let Some(at) = dot.filter(|_| !name.is_empty()) {
                pen.label(at + Vec2::new(9.0, 0.0), Align2::LEFT_CENTER, name, colour);
            }
        }
    }
}

/// Marks of one axis.
struct DiagramMarks {
    /// Distance of each mark from the present event, points, and its number.
    marks: Vec<(f64, f64)>,
    /// Step of the numbers.
    step: f64,
    /// Sign of the unit.
    unit: &'static str,
}

/// First points of the lines between the jumps of `points`, in the order of [`slice::split`]; none for what precedes
/// the first jump.
fn beginnings(points: &[TrailPoint]) -> impl Iterator<Item = Option<TrailPoint>> {
    std::iter::once(None).chain(points.iter().filter(|point| point.begins).map(|point| Some(*point)))
}

/// Events of the worldline at whole multiples of `step_s` of own time, between the points before and after.
pub fn own_time_dots(points: &[TrailPoint], step_s: f64) -> Vec<Event> {
    /// Largest number of dots.
    const MOST: usize = 400;
    let pairs = points.windows(2).filter(|pair| !pair[1].begins);
    let dots = pairs.flat_map(|pair| {
        let (from, to) = (&pair[0], &pair[1]);
        let span = to.own_s - from.own_s;
        let (first, last) = ((from.own_s / step_s).floor() + 1.0, (to.own_s / step_s).floor());
        let number = if last >= first { ((last - first) as usize).min(MOST) + 1 } else { 0 };
        (0..number).map(move |index| {
            let share = ((first + index as f64) * step_s - from.own_s) / span;
            let way = to.event - from.event;
            from.event + physics::FourVector { t: share * way.t, r: share * way.r }
        })
    });
    dots.take(MOST).collect()
}

#[cfg(test)]
mod tests {
    //! Law: the dots of a worldline are at equal own times. A wrong program has them at equal times of the world, or
    //! draws them across a jump.

    use super::*;
    use physics::glam::DVec3;

    #[test]
    fn dots_are_at_equal_own_times() {
        // β = 0.6, c = 1 m/s: an own second is 1.25 s of the world, and 0.75 m. Frames at uneven times.
        let own = [0.0, 0.3, 0.9, 1.7, 2.2, 3.9, 4.05];
        let point = |own_s: f64| TrailPoint {
            event: Event { ct: 1.25 * own_s, position: DVec3::X * 0.75 * own_s },
            own_s,
            begins: own_s == 0.0,
        };
        let mut points = own.map(point).to_vec();
        let dots = own_time_dots(&points, 1.0);
        let times: Vec<f64> = dots.iter().map(|dot| dot.ct / 1.25).collect();
        assert_eq!(times.len(), 4);
        for (number, (time, dot)) in (1..).zip(times.iter().zip(&dots)) {
            assert!((time - f64::from(number)).abs() < 1e-12, "{times:?}");
            assert!((dot.position.x - 0.75 * f64::from(number)).abs() < 1e-12);
        }
        points[5].begins = true;
        assert_eq!(own_time_dots(&points, 1.0).len(), 3, "there is no dot in a jump, from 2.2 s to 3.9 s");
    }
}
