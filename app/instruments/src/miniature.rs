//! World in miniature: plan of the world with the vehicle, its way, its field of view, and both clocks.

use egui::epaint::{Mesh, Vertex};
use egui::{Align2, Color32, CornerRadius, FontId, Painter, Pos2, Rect, Shape, Stroke, TextureId, Vec2};
use physics::glam::{DVec2, DVec3};

use crate::figures::{clock, round_length, round_step};
use crate::miniature_view::MiniatureView;
use crate::pen::{self, ACCENT, EVENT, FAINT, INK, LIGHT, NOW, Pen, TEXT};
use crate::plan_picture::PlanArea;
use crate::trail::Trail;
use crate::words::InstrumentWords;

/// Picture of a plan as a texture of the interface.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct PlanTexture {
    /// Texture of [`PlanPicture::rgba`](crate::PlanPicture::rgba).
    pub id: TextureId,
    /// Part of the world that it shows.
    pub area: PlanArea,
}

/// Height of the row of clocks, points.
const CLOCKS: f32 = 44.0;
/// Length of the field of view on the map, as a share of the map's smaller side.
const WEDGE: f32 = 0.3;
/// Largest length of the scale bar, as a share of the map's width.
const BAR: f64 = 0.3;

/// Draws the map of a trail into `area`, with clocks, title and caption.
pub fn miniature(
    painter: &Painter,
    area: Rect,
    trail: &Trail,
    view: &MiniatureView,
    plan: Option<PlanTexture>,
    words: &InstrumentWords,
) {
    let inner = pen::frame(painter, area, words.miniature, words.miniature_caption);
    let Some(now) = trail.present() else { return };
    let clocks = Rect::from_min_max(Pos2::new(inner.left(), inner.bottom() - CLOCKS), inner.max);
    let readings = [(words.your_clock, now.own_s, ACCENT), (words.world_clock, now.world_s, INK)];
    for (number, (label, seconds, colour)) in readings.into_iter().enumerate() {
        let left = clocks.left() + 0.5 * clocks.width() * number as f32;
        let top = Pos2::new(left, clocks.top());
        let label = painter.text(top, Align2::LEFT_TOP, label, FontId::proportional(TEXT), FAINT);
        let text = clock(seconds, words);
        painter.text(label.left_bottom(), Align2::LEFT_TOP, text, FontId::proportional(22.0), colour);
    }

    let map = Rect::from_min_max(inner.min, Pos2::new(inner.right(), clocks.top() - 6.0));
    if !map.is_positive() || view.half_m() <= 0.0 {
        return;
    }
    let sheet = MapSheet { map, view, scale: 0.5 * f64::from(map.width().min(map.height())) / view.half_m() };
    let clip = painter.with_clip_rect(map.intersect(painter.clip_rect()));
    clip.rect_filled(map, CornerRadius::same(3), Color32::from_rgb(0x1d, 0x22, 0x24));
    sheet.plan(&clip, plan);
    let mut pen = Pen::new(&clip, map);
    sheet.field_of_view(&clip, trail);
    sheet.way(&pen, trail);
    sheet.vehicle(&clip, &mut pen, trail, words);
    sheet.scale_bar(&clip, &mut pen, words);
    sheet.north(&clip, &mut pen, words);
    painter.rect_stroke(map, CornerRadius::same(3), Stroke::new(1.0, FAINT), egui::StrokeKind::Inside);
}

/// Map in the interface.
struct MapSheet<'a> {
    map: Rect,
    view: &'a MiniatureView,
    /// Points per metre.
    scale: f64,
}

impl MapSheet<'_> {
    fn at(&self, position: DVec3) -> [f64; 2] {
        let place = self.scale * self.view.place(position);
        [f64::from(self.map.center().x) + place.x, f64::from(self.map.center().y) - place.y]
    }

    /// Direction in the interface of a direction (x, z) of the world.
    fn towards(&self, way: DVec2) -> Vec2 {
        let way = self.view.turned(way);
        Vec2::new(way.x as f32, -way.y as f32)
    }

    fn plan(&self, painter: &Painter, plan: Option<PlanTexture>) {
        let Some(PlanTexture { id, area }) = plan else { return };
        let corners = [[0.0, 0.0], [1.0, 0.0], [1.0, 1.0], [0.0, 1.0]].map(|[u, v]: [f64; 2]| {
            let place = area.least + DVec2::new(u, v) * (area.most - area.least);
            let [x, y] = self.at(DVec3::new(place.x, 0.0, place.y));
            Vertex { pos: Pos2::new(x as f32, y as f32), uv: Pos2::new(u as f32, v as f32), color: Color32::WHITE }
        });
        // A plan that is too large or too far for f32 is not to be seen anyway.
        if corners.iter().all(|corner| corner.pos.x.abs() < 1e6 && corner.pos.y.abs() < 1e6) {
            let indices = vec![0, 1, 2, 0, 2, 3];
            painter.add(Shape::mesh(Mesh { indices, vertices: corners.to_vec(), texture_id: id }));
        }
    }

    fn field_of_view(&self, painter: &Painter, trail: &Trail) {
        let Some(now) = trail.present() else { return };
        let Some([here, _]) = self.within(now.event.position) else { return };
        let reach = WEDGE * self.map.width().min(self.map.height());
        let edge: Vec<Pos2> =
            self.view.seen_directions(now).iter().map(|way| here + reach * self.towards(*way)).collect();
        let mut mesh = Mesh::default();
        mesh.colored_vertex(here, LIGHT.gamma_multiply(0.55));
        edge.iter().for_each(|place| mesh.colored_vertex(*place, LIGHT.gamma_multiply(0.06)));
        (1..edge.len() as u32).for_each(|index| mesh.add_triangle(0, index, index + 1));
        painter.add(Shape::mesh(mesh));
        for place in [edge.first(), edge.last()].into_iter().flatten() {
            painter.line_segment([here, *place], Stroke::new(1.0, LIGHT.gamma_multiply(0.7)));
        }
    }

    /// Place in the interface, if it lies on the map.
    fn within(&self, position: DVec3) -> Option<[Pos2; 2]> {
        let at = self.at(position);
        crate::line_clip::clipped(at, at, self.map)
    }

    fn way(&self, pen: &Pen<'_>, trail: &Trail) {
        let points: Vec<_> = trail.points().collect();
        for (rest, first) in points
            .split(|point| point.begins)
            .zip(std::iter::once(None).chain(points.iter().filter(|point| point.begins).map(Some)))
        {
            let places = first.into_iter().chain(rest).map(|point| self.at(point.event.position));
            pen.polyline(places, 2.0, Stroke::new(2.4, NOW));
        }
    }

    fn vehicle(&self, painter: &Painter, pen: &mut Pen<'_>, trail: &Trail, words: &InstrumentWords) {
        let Some(now) = trail.present() else { return };
        if let Some(start) = trail.start()
            && let Some(at) = pen.dot(self.at(start.position), 4.0, EVENT)
        {
            pen.label(at + Vec2::new(8.0, 0.0), Align2::LEFT_CENTER, words.start, EVENT);
        }
        for mark in trail.events() {
            if let Some(at) = pen.dot(self.at(mark.event.position), 4.0, EVENT) {
                pen.label(at + Vec2::new(8.0, 0.0), Align2::LEFT_CENTER, &mark.name, EVENT);
            }
        }
        let Some([here, _]) = self.within(now.event.position) else { return };
        let ahead = self.towards(DVec2::new(now.heading.x, now.heading.z)).normalized();
        let beside = Vec2::new(-ahead.y, ahead.x);
        let arrow = [
            here + 11.0 * ahead,
            here - 7.0 * ahead + 7.0 * beside,
            here - 3.0 * ahead,
            here - 7.0 * ahead - 7.0 * beside,
        ];
        let rim = Stroke::new(1.2, Color32::from_black_alpha(0xd0));
        painter.add(Shape::convex_polygon(vec![arrow[0], arrow[1], arrow[2]], ACCENT, Stroke::NONE));
        painter.add(Shape::convex_polygon(vec![arrow[0], arrow[2], arrow[3]], ACCENT, Stroke::NONE));
        painter.add(Shape::closed_line(arrow.to_vec(), rim));
    }

    fn scale_bar(&self, painter: &Painter, pen: &mut Pen<'_>, words: &InstrumentWords) {
        // Round lengths are 1, 2 or 5 times a power of ten: the largest that has room.
        let longest_m = BAR * f64::from(self.map.width()) / self.scale;
        let mut metres = round_step(longest_m * (1.0 + 1e-9));
        for divisor in [2.0, 2.5, 2.0] {
            if metres > longest_m {
                metres = round_step(metres / divisor * (1.0 - 1e-9));
            }
        }
        let width = (metres * self.scale) as f32;
        let left = self.map.left_bottom() + Vec2::new(10.0, -12.0);
        let right = left + Vec2::new(width, 0.0);
        let plate = Rect::from_min_max(left - Vec2::new(6.0, 24.0), right + Vec2::new(6.0, 7.0));
        painter.rect_filled(plate, CornerRadius::same(3), Color32::from_black_alpha(0xa0));
        let stroke = Stroke::new(2.0, INK);
        painter.line_segment([left, right], stroke);
        for end in [left, right] {
            painter.line_segment([end - Vec2::new(0.0, 4.0), end + Vec2::new(0.0, 4.0)], stroke);
        }
        let middle = left + Vec2::new(0.5 * width, -4.0);
        painter.text(middle, Align2::CENTER_BOTTOM, round_length(metres, words), FontId::proportional(TEXT), INK);
        pen.keep_free(plate);
    }

    fn north(&self, painter: &Painter, pen: &mut Pen<'_>, words: &InstrumentWords) {
        let middle = self.map.right_top() + Vec2::new(-22.0, 22.0);
        let north = self.towards(DVec2::NEG_Y);
        painter.circle_filled(middle, 17.0, Color32::from_black_alpha(0xa0));
        painter.line_segment([middle + 8.0 * north, middle + 16.0 * north], Stroke::new(2.0, ACCENT));
        painter.text(middle, Align2::CENTER_CENTER, words.north, FontId::proportional(TEXT), INK);
        pen.keep_free(Rect::from_center_size(middle, Vec2::splat(36.0)));
    }
}
