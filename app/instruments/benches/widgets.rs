//! Cost of the instruments in a frame: following the ride, laying out and tessellating diagram, map and planner, with
//! the trail of a long ride.
//!
//!     cargo bench -p instruments
//!
//! A room's frame takes 60 ms on a software driver; menu, map and diagram together may take a twentieth of it.
#![allow(clippy::print_stdout, clippy::unwrap_used, reason = "a benchmark prints its figures")]

#[path = "../examples/pictures/rides.rs"]
#[allow(dead_code, reason = "the pictures need more rides")]
mod rides;

use std::time::Instant;

use egui::{Pos2, Rect, Vec2};
use instruments::{
    DiagramView, InstrumentWords, MiniatureView, PlanPicture, PlanTexture, PlannedJourney, WatchedClock, diagram,
    miniature, planner,
};
use physics::glam::DVec3;

/// Length of the ride, hours.
const HOURS: f64 = 2.0;
/// Number of frames that are measured, and of those before them.
const FRAMES: usize = 300;
const BEFORE: usize = 30;
/// Time of a frame of a room on a software driver, µs.
const FRAME_US: f64 = 60_000.0;
/// Largest share of a frame that map and diagram may take: a part of the twentieth that they share with the menu.
const SHARE: f64 = 1.0 / 40.0;

fn main() {
    // Laps in a straight line and back, an hour of them, so that old and new parts of the way lie over each other.
    let laps = (HOURS * 3600.0 / 16.0) as usize;
    let thrusts: Vec<(f64, f64)> = (0..laps).flat_map(|_| [(0.294, 4.0), (-0.294, 8.0), (0.294, 4.0)]).collect();
    let moments = rides::straight(0.0, 30.0 / 3.6, &thrusts);
    let (ride, last) = moments.split_at(moments.len() - FRAMES);
    let mut trail = rides::trail(ride, |_| ());
    (0..8)
        .for_each(|n| trail.mark(format!("event {n}"), physics::Event { ct: 0.0, position: DVec3::X * f64::from(n) }));
    trail.watch(vec![WatchedClock { name: "tower".to_owned(), position: DVec3::new(60.0, 0.0, 9.0) }]);
    println!("{} frames, {} points kept", ride.len(), trail.point_count());
    let begun = Instant::now();
    let plan = PlanPicture::draw(&built_in::town::build(1), 1024).unwrap();
    println!("town and its plan {:?}: {:.0} ms", plan.size, begun.elapsed().as_secs_f64() * 1e3);

    let context = egui::Context::default();
    let image = egui::ColorImage::from_rgba_unmultiplied(plan.size.map(|side| side as usize), &plan.rgba);
    let texture = context.load_texture("plan", image, egui::TextureOptions::LINEAR);
    let plan = PlanTexture { id: texture.id(), area: plan.area };
    let (mut diagram_view, mut map_view) = (DiagramView::default(), MiniatureView::default());
    let mut times = [const { Vec::new() }; 5];
    for (number, moment) in last.iter().enumerate() {
        let begun = Instant::now();
        trail.note_moment(*moment);
        diagram_view.follow(&trail);
        map_view.follow(&trail, Some(plan.area));
        let followed = begun.elapsed();
        let area = |left: f32, height: f32| Rect::from_min_size(Pos2::new(left, 10.0), Vec2::new(420.0, height));
        let words = &InstrumentWords::ENGLISH;
        let journey = PlannedJourney {
            distance_m: 100.0,
            celerity: 0.1,
            acceleration_m_s2: 2.0,
            light_speed: moment.light_speed,
        };
        let of_diagram = drawn(&context, |painter| diagram(painter, area(10.0, 480.0), &trail, &diagram_view, words));
        let of_map =
            drawn(&context, |painter| miniature(painter, area(440.0, 520.0), &trail, &map_view, Some(plan), words));
        let of_planner =
            drawn(&context, |painter| planner(painter, area(10.0, 200.0), moment, ("gate", Some(&journey)), words));
        let empty = drawn(&context, |_| ());
        if number >= BEFORE {
            let of = [followed.as_secs_f64() * 1e6, of_diagram, of_map, of_planner, empty];
            times.iter_mut().zip(of).for_each(|(times, us)| times.push(us));
        }
    }
    let medians = times.map(|mut times| {
        times.sort_by(f64::total_cmp);
        times[times.len() / 2]
    });
    let [followed, of_diagram, of_map, of_planner, empty] = medians;
    println!(
        "medians of a frame: following {followed:.0} µs, diagram {of_diagram:.0}, map {of_map:.0}, planner {of_planner:.0}"
    );
    println!("each with {empty:.0} µs of an empty pass of the interface");
    let whole = followed + of_diagram + of_map + of_planner - 2.0 * empty;
    println!("together in one pass {whole:.0} µs, {:.2} % of a frame of {FRAME_US:.0} µs", 100.0 * whole / FRAME_US);
    assert!(whole < SHARE * FRAME_US, "the instruments take too long");
}

/// Time of laying out and tessellating some contents, µs.
fn drawn(context: &egui::Context, contents: impl Fn(&egui::Painter)) -> f64 {
    let screen = Rect::from_min_size(Pos2::ZERO, Vec2::new(1280.0, 720.0));
    let input = egui::RawInput { screen_rect: Some(screen), ..Default::default() };
    let begun = Instant::now();
    let mut output = context.run_ui(input, |ui| contents(ui.painter()));
    let shapes = context.tessellate(output.shapes, output.pixels_per_point);
    let us = begun.elapsed().as_secs_f64() * 1e6;
    assert!(shapes.len() < 10_000);
    output.textures_delta.clear();
    us
}
