//! What explains a ride: map, space-time diagram, clocks, places to go to.

use egui::{Area, Color32, ColorImage, Id, Pos2, Rangef, Rect, Sense, TextureHandle, TextureOptions, Ui, Vec2};
use glam::DVec3;
use input::Place;
use instruments::{DiagramFrame, DiagramView, InstrumentWords, MiniatureView, PlanPicture, PlanTexture, Trail};
use instruments::{PlannedJourney, WatchedClock, diagram, miniature, planner};
use interface::ClockRow;
use physics::Event;
use presentation::Presentation;
use ride::RideFrame;
use scene::{LocalName, NamedPlace, Scene, SceneClock};
use words::{Language, Phrase};

/// Largest side of the map's picture, pixels.
const PLAN_SIDE: u32 = 768;
/// Sizes of the map and the diagram in a window, points.
const MAP: Vec2 = Vec2::new(270.0, 350.0);
const DIAGRAM: Vec2 = Vec2::new(380.0, 400.0);
/// Distance from the window's sides, and from its lower edge, above the readings, points.
const MARGIN: f32 = 12.0;
const ABOVE: f32 = 104.0;
/// Most clocks in the table.
const MOST_CLOCKS: usize = 3;

/// Size of the planner, points, and the height of the table of clocks on a sheet.
const PLANNER: Vec2 = Vec2::new(270.0, 150.0);
const CLOCKS_HEIGHT: f32 = 106.0;

/// Journey that the planner plans.
#[derive(Clone, Copy, Debug)]
struct Journey {
    /// Number of the destination among the scene's places; `None` for the start.
    place: Option<usize>,
    planned: PlannedJourney,
}

/// Knowledge of the scene and of the way so far.
pub struct Guide {
    places: Vec<NamedPlace>,
    start: DVec3,
    clocks: Vec<SceneClock>,
    /// Language of the clocks' names in the diagram.
    language: Language,
    plan: Option<PlanPicture>,
    trail: Trail,
    diagram: DiagramView,
    miniature: MiniatureView,
    journey: Option<Journey>,
}

impl Guide {
    /// Guide of a scene, before the ride.
    pub fn new(scene: &Scene) -> Self {
        let mut trail = Trail::default();
        let language = Language::default();
        trail.watch(watched(&scene.clocks, language));
        Self {
            places: scene.places.clone(),
            clocks: scene.clocks.clone(),
            language,
            plan: PlanPicture::draw(scene, PLAN_SIDE),
            trail,
            diagram: DiagramView::default(),
            miniature: MiniatureView::default(),
            start: scene.start.position,
            journey: None,
        }
    }

    /// Notes a frame of the ride. `aspect`: width of the picture over its height.
    pub fn note(&mut self, frame: &RideFrame, presentation: &Presentation, aspect: f64) {
        if std::mem::replace(&mut self.language, presentation.language) != presentation.language {
            self.trail.watch(watched(&self.clocks, self.language));
        }
        self.trail.note(frame);
        self.journey = self.journey_ahead(frame);
        self.diagram.frame = if presentation.diagram_of_vehicle { DiagramFrame::Vehicle } else { DiagramFrame::World };
        self.diagram.follow(&self.trail);
        let half = 0.5 * presentation.fov_deg.to_radians();
        self.miniature.field_of_view_rad = 2.0 * (half.tan() * aspect).atan();
        self.miniature.aberration = presentation.effects.bend();
        self.miniature.follow(&self.trail, self.plan.as_ref().map(|plan| plan.area));
    }

    /// Marks an event in the diagram.
    pub fn mark(&mut self, name: &str, event: Event) {
        self.trail.mark(name, event);
    }

    /// Places to go to, with their names.
    pub fn places(&self, language: Language) -> Vec<(String, Place)> {
        let place = |place: &NamedPlace| Place {
            position_m: place.start.position.to_array(),
            look: place.start.look.to_array(),
        };
        self.places.iter().map(|named| (name(&named.name, language).to_owned(), place(named))).collect()
    }

    /// Readings of the clocks that are nearest to the rider, if a presentation shows them.
    pub fn wanted_clocks(&self, frame: &RideFrame, presentation: &Presentation) -> Vec<ClockRow> {
        let wanted = presentation.miniature || presentation.clocks;
        if wanted { self.clocks(frame, presentation.language) } else { Vec::new() }
    }

    /// Readings of the clocks that are nearest to the rider.
    fn clocks(&self, frame: &RideFrame, language: Language) -> Vec<ClockRow> {
        let observer = &frame.gaze.observer;
        let light_m_s = frame.vehicle.light_speed().speed_of_light_m_s();
        let away = |clock: &SceneClock| match &clock.motion {
            None => clock.position.distance(observer.event.position),
            Some(motion) => clock.position.distance(motion.own_from_world(observer.event).position),
        };
        let mut nearest: Vec<&SceneClock> = self.clocks.iter().collect();
        nearest.sort_by(|a, b| away(a).total_cmp(&away(b)));
        let row = |clock: &SceneClock| {
            let reading = clock.reading(observer, light_m_s);
            let readings_s = [reading.seen_s, reading.measured_s, reading.world_s];
            ClockRow { name: name(&clock.name, language).to_owned(), readings_s }
        };
        nearest.into_iter().take(MOST_CLOCKS).map(row).collect()
    }

    /// Shows what is asked for over the picture of a window.
    pub fn show(&self, ui: &Ui, presentation: &Presentation, clocks: &[ClockRow]) {
        let screen = ui.ctx().content_rect();
        let room = screen.height() - ABOVE - MARGIN - 40.0;
        let bottom = screen.bottom() - ABOVE;
        let fit = |size: Vec2| size * (room / size.y).min(1.0);
        // Map, clocks and planner stand one above the other at the left.
        let mut above_left = bottom;
        if presentation.miniature {
            let size = fit(MAP);
            let at = Pos2::new(screen.left() + MARGIN, bottom - size.y);
            panel(ui, "map", at, size, |ui, area| self.map(ui, area, presentation.language));
            above_left = at.y - 8.0;
        }
        if !clocks.is_empty() {
            let area = Area::new(Id::unique("clocks")).interactable(false);
            let table = area
                .fixed_pos(Pos2::new(screen.left() + MARGIN, above_left))
                .pivot(egui::Align2::LEFT_BOTTOM)
                .show(ui.ctx(), |ui| interface::show_clocks(ui, presentation.language, clocks));
            above_left = table.response.rect.top() - 8.0;
        }
        if presentation.planner {
            let at = Pos2::new(screen.left() + MARGIN, above_left - PLANNER.y);
            panel(ui, "planner", at, PLANNER, |ui, area| self.planner(ui, area, presentation.language));
        }
        if presentation.diagram {
            let size = fit(DIAGRAM);
            // The menu has the right side; the map, if it is shown, the left.
            let beside_map = if presentation.miniature { MAP.x + MARGIN } else { 0.0 };
            let left = screen.left() + MARGIN + beside_map;
            let at_left = if presentation.menu { left } else { screen.right() - MARGIN - size.x };
            let at = Pos2::new(at_left, bottom - size.y);
            panel(ui, "diagram", at, size, |ui, area| self.diagram(ui, area, presentation.language));
        }
    }

    /// Part of a window's width, points, that is free of panels.
    pub fn free_width(&self, ui: &Ui, presentation: &Presentation) -> Rangef {
        let screen = ui.ctx().content_rect();
        let at_left = presentation.miniature || presentation.planner || presentation.clocks;
        let map = if at_left { MAP.x + MARGIN } else { 0.0 };
        // The menu has the right side, and the diagram stands beside the map then.
        let [beside_map, at_right] = match (presentation.diagram, presentation.menu) {
            (false, _) => [0.0; 2],
            (true, true) => [DIAGRAM.x + MARGIN, 0.0],
            (true, false) => [0.0, DIAGRAM.x + MARGIN],
        };
        let (left, right) = (screen.left() + map + beside_map, screen.right() - at_right);
        Rangef::new(left, right)
    }

    /// Shows what is asked for side by side on a sheet in a room.
    pub fn show_on_sheet(&self, ui: &mut Ui, presentation: &Presentation, clocks: &[ClockRow]) {
        let whole = ui.max_rect();
        let language = presentation.language;
        let half = Vec2::new(0.5 * whole.width() - 4.0, whole.height());
        let mut left = Rect::from_min_size(whole.min, half);
        if !clocks.is_empty() {
            let table = left.with_min_y(left.bottom() - CLOCKS_HEIGHT);
            interface::show_clocks(&mut ui.new_child(egui::UiBuilder::new().max_rect(table)), language, clocks);
            left.set_bottom(table.top() - 4.0);
        }
        if presentation.planner {
            let plan = left.with_min_y(left.bottom() - PLANNER.y);
            self.planner(ui, plan, language);
            left.set_bottom(plan.top() - 4.0);
        }
        if presentation.miniature {
            self.map(ui, left, language);
        }
        if presentation.diagram {
            self.diagram(
                ui,
                Rect::from_min_size(whole.min + Vec2::new(0.5 * whole.width() + 4.0, 0.0), half),
                language,
            );
        }
    }

    fn map(&self, ui: &Ui, area: Rect, language: Language) {
        let plan = self.plan.as_ref().map(|plan| PlanTexture { id: texture(ui, plan).id(), area: plan.area });
        miniature(ui.painter(), area, &self.trail, &self.miniature, plan, instrument_words(language));
    }

    fn planner(&self, ui: &Ui, area: Rect, language: Language) {
        let Some(now) = self.trail.present() else { return };
        let (aim, journey) = match &self.journey {
            Some(journey) => (self.destination(journey, language), Some(&journey.planned)),
            None => ("", None),
        };
        planner(ui.painter(), area, now, (aim, journey), instrument_words(language));
    }

    fn destination(&self, journey: &Journey, language: Language) -> &str {
        match journey.place.and_then(|number| self.places.get(number)) {
            Some(place) => name(&place.name, language),
            None => language.text(Phrase::Start),
        }
    }

    /// Journey to the place that the nose points at best, at full thrust; `None` if it points at none.
    fn journey_ahead(&self, frame: &RideFrame) -> Option<Journey> {
        /// Cosine of the largest angle between the nose and the place: 20°.
        const AHEAD: f64 = 0.94;
        /// Smallest distance of a destination, metres.
        const NEAREST_M: f64 = 2.0;
        let state = frame.vehicle.state();
        let nose = state.orientation * DVec3::NEG_Z;
        let places = self.places.iter().enumerate().map(|(number, place)| (Some(number), place.start.position));
        let way = |(place, position): (Option<usize>, DVec3)| {
            let way = position - state.position;
            let cosine = way.normalize_or_zero().dot(nose).abs();
            (way.length() >= NEAREST_M).then_some((cosine, place, way.dot(nose)))
        };
        let all = places.chain([(None, self.start)]).filter_map(way);
        let (cosine, place, distance_m) = all.max_by(|one, other| one.0.total_cmp(&other.0))?;
        let light_speed = frame.vehicle.light_speed();
        let planned = PlannedJourney {
            distance_m,
            celerity: state.celerity.vector().dot(nose),
            acceleration_m_s2: frame.vehicle.settings().flight.thrust_per_s * light_speed.speed_of_light_m_s(),
            light_speed,
        };
        (cosine >= AHEAD).then_some(Journey { place, planned })
    }

    fn diagram(&self, ui: &Ui, area: Rect, language: Language) {
        diagram(ui.painter(), area, &self.trail, &self.diagram, instrument_words(language));
    }
}

/// Clocks whose light the diagram shows: the first ones that rest.
fn watched(clocks: &[SceneClock], language: Language) -> Vec<WatchedClock> {
    let at_rest = clocks.iter().filter(|clock| clock.motion.is_none()).take(MOST_CLOCKS);
    let watched =
        |clock: &SceneClock| WatchedClock { name: name(&clock.name, language).to_owned(), position: clock.position };
    at_rest.map(watched).collect()
}

/// Texts of the instruments in a language.
fn instrument_words(language: Language) -> &'static InstrumentWords {
    match language {
        Language::English => &InstrumentWords::ENGLISH,
        Language::German => &InstrumentWords::GERMAN,
    }
}

fn name(name: &LocalName, language: Language) -> &str {
    match language {
        Language::English => &name.english,
        Language::German => &name.german,
    }
}

/// Picture of the map as a texture of this interface, which is made once.
fn texture(ui: &Ui, plan: &PlanPicture) -> TextureHandle {
    let key = Id::unique("plan");
    let known = ui.ctx().data(|data| data.get_temp::<TextureHandle>(key));
    known.unwrap_or_else(|| {
        let size = plan.size.map(|side| side as usize);
        let image = ColorImage::from_rgba_unmultiplied(size, &plan.rgba);
        let made = ui.ctx().load_texture("plan", image, TextureOptions::LINEAR);
        ui.ctx().data_mut(|data| data.insert_temp(key, made.clone()));
        made
    })
}

/// Panel of a size at a place over the picture.
fn panel(ui: &Ui, name: &'static str, at: Pos2, size: Vec2, contents: impl FnOnce(&mut Ui, Rect)) {
    Area::new(Id::unique(name)).fixed_pos(at).interactable(false).show(ui.ctx(), |ui| {
        let (area, _) = ui.allocate_exact_size(size, Sense::hover());
        ui.painter().rect_filled(area, 0, Color32::TRANSPARENT);
        contents(ui, area);
    });
}

#[cfg(test)]
mod tests {
    //! Law: the diagram names the clocks that it watches in the rider's language.

    use super::*;

    #[test]
    fn clocks_are_watched_by_their_names_in_the_riders_language() {
        let clocks = built_in::train::build().clocks;
        let resting: Vec<&SceneClock> =
            clocks.iter().filter(|clock| clock.motion.is_none()).take(MOST_CLOCKS).collect();
        assert!(!resting.is_empty());
        for (language, of) in [
            (Language::English, (|name| &name.english) as fn(&LocalName) -> &String),
            (Language::German, |name| &name.german),
        ] {
            let names: Vec<String> = watched(&clocks, language).into_iter().map(|clock| clock.name).collect();
            assert_eq!(names, resting.iter().map(|clock| of(&clock.name).clone()).collect::<Vec<_>>());
        }
    }
}
