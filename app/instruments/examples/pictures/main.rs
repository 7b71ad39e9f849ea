//! Pictures of the instruments, to be looked at: PNG files of diagrams, map and planner for several rides.
//!
//!     cargo run --release -p instruments --example pictures -- [FOLDER]
#![allow(clippy::print_stdout, clippy::unwrap_used, reason = "an example prints its figures, and ends at a failure")]

mod raster;
mod rides;

use std::path::{Path, PathBuf};
use std::time::Instant;

use egui::{Pos2, Rect, Vec2};
use instruments::{
    DiagramFrame, DiagramView, InstrumentWords, MapUp, MiniatureView, PlanPicture, PlanTexture, PlannedJourney,
    PresentMoment, Trail, WatchedClock, diagram, miniature, planner,
};
use physics::glam::DVec3;
use raster::Raster;

/// Pixels per point.
const SCALE: f32 = 1.0;

fn main() {
    let folder = PathBuf::from(std::env::args().nth(1).unwrap_or_else(|| "instruments".to_owned()));
    std::fs::create_dir_all(&folder).unwrap();
    let light_m_s = 30.0 / 3.6;
    let there_and_back = rides::straight(0.0, light_m_s, &[(0.0, 2.0), (0.294, 4.0), (-0.294, 8.0), (0.294, 4.0)]);
    let steady = |beta| rides::straight(beta, light_m_s, &[(0.0, 15.0)]);
    let marks: &[(&str, f64, f64)] = &[("bell", 40.0, 30.0), ("lamp", 90.0, -10.0)];
    diagrams(&folder, "rest", &steady(0.0), marks);
    diagrams(&folder, "beta_0.6", &steady(0.6), marks);
    diagrams(&folder, "beta_0.99", &steady(0.99), marks);
    diagrams(&folder, "gamma_1e6", &steady(1.0 - 5e-13), &[]);
    diagrams(&folder, "there_and_back", &there_and_back, &[]);
    diagrams(&folder, "out", &there_and_back[..9 * 30], &[]);
    diagrams(&folder, "real_light", &rides::straight(0.0, 299_792_458.0, &[(0.2, 12.0)]), &[]);

    let town = built_in::town::build(1);
    let begun = Instant::now();
    let plan = PlanPicture::draw(&town, 1024).unwrap();
    println!(
        "plan of {} triangles, {:?} pixels: {:.0} ms",
        town.triangle_count(),
        plan.size,
        begun.elapsed().as_secs_f64() * 1e3
    );
    png(&folder.join("plan_town.png"), plan.size, &plan.rgba);
    let hall = PlanPicture::draw(&built_in::spectra::build(), 512).unwrap();
    png(&folder.join("plan_spectra.png"), hall.size, &hall.rgba);

    let moments = rides::tour(&town, 45);
    maps(&folder, &moments, &plan);
    let now = moments[moments.len() - 1];
    planners(&folder, &now);
}

/// Draws diagrams of a ride in both frames and both languages.
fn diagrams(folder: &Path, name: &str, moments: &[PresentMoment], marks: &[(&str, f64, f64)]) {
    for (frame, of_frame) in [(DiagramFrame::World, "world"), (DiagramFrame::Vehicle, "vehicle")] {
        let mut view = DiagramView::default();
        view.frame = frame;
        let mut trail = rides::trail(moments, |trail| view.follow(trail));
        for &(name, x, ct) in marks {
            trail.mark(name, physics::Event { ct, position: DVec3::X * x });
        }
        trail.watch(vec![WatchedClock { name: "tower".to_owned(), position: DVec3::new(60.0, 0.0, 0.0) }]);
        let words = if of_frame == "world" { InstrumentWords::ENGLISH } else { InstrumentWords::GERMAN };
        let size = Vec2::new(420.0, 480.0);
        picture(&folder.join(format!("diagram_{name}_{of_frame}.png")), size, None, |painter, area, _| {
            diagram(painter, area, &trail, &view, &words);
        });
    }
}

fn maps(folder: &Path, moments: &[PresentMoment], plan: &PlanPicture) {
    for (name, up, reach_m) in [("north", MapUp::North, None), ("vehicle", MapUp::Vehicle, Some(40.0))] {
        let mut view = MiniatureView::default();
        (view.up, view.reach_m) = (up, reach_m);
        let trail = rides::trail(moments, |trail| view.follow(trail, Some(plan.area)));
        let size = Vec2::new(420.0, 520.0);
        picture(&folder.join(format!("map_{name}.png")), size, Some(plan), |painter, area, plan| {
            miniature(painter, area, &trail, &view, plan, &InstrumentWords::ENGLISH);
        });
    }
    let mut view = MiniatureView::default();
    let trail: Trail = rides::trail(moments, |trail| view.follow(trail, None));
    picture(&folder.join("map_without_plan.png"), Vec2::new(420.0, 520.0), None, |painter, area, _| {
        miniature(painter, area, &trail, &view, None, &InstrumentWords::GERMAN);
    });
}

fn planners(folder: &Path, now: &PresentMoment) {
    let journey = |distance_m, celerity| PlannedJourney {
        distance_m,
        celerity,
        acceleration_m_s2: 2.45,
        light_speed: now.light_speed,
    };
    for (name, journey) in [("ahead", Some(journey(120.0, 0.3))), ("late", Some(journey(3.0, 1.5))), ("none", None)] {
        picture(&folder.join(format!("planner_{name}.png")), Vec2::new(320.0, 170.0), None, |painter, area, _| {
            planner(painter, area, now, ("", journey.as_ref()), &InstrumentWords::ENGLISH);
        });
    }
}

/// Draws contents into a PNG file.
fn picture(
    path: &Path,
    size: Vec2,
    plan: Option<&PlanPicture>,
    contents: impl Fn(&egui::Painter, Rect, Option<PlanTexture>),
) {
    let context = egui::Context::default();
    let margin = Vec2::splat(12.0);
    let screen = Rect::from_min_size(Pos2::ZERO, size + 2.0 * margin);
    let texture = plan.map(|plan| {
        let image = egui::ColorImage::from_rgba_unmultiplied(plan.size.map(|side| side as usize), &plan.rgba);
        (context.load_texture("plan", image, egui::TextureOptions::LINEAR), plan.area)
    });
    let plan = texture.as_ref().map(|(texture, area)| PlanTexture { id: texture.id(), area: *area });
    let mut raster = Raster::default();
    let mut drawn = Vec::new();
    // Fonts are laid out in the first pass.
    for _ in 0..2 {
        let input = egui::RawInput { screen_rect: Some(screen), ..Default::default() };
        let mut output = context.run_ui(input, |ui| {
            contents(ui.painter(), Rect::from_min_size(Pos2::ZERO + margin, size), plan);
        });
        raster.update(&output.textures_delta);
        output.textures_delta.clear();
        drawn = context.tessellate(output.shapes, output.pixels_per_point);
    }
    let pixels = [screen.width() * SCALE, screen.height() * SCALE].map(|side| side as usize);
    png(path, pixels.map(|side| side as u32), &raster.paint(&drawn, SCALE, pixels));
}

fn png(path: &Path, size: [u32; 2], rgba: &[u8]) {
    let file = std::io::BufWriter::new(std::fs::File::create(path).unwrap());
    let mut encoder = png::Encoder::new(file, size[0], size[1]);
    encoder.set_color(png::ColorType::Rgba);
    encoder.set_depth(png::BitDepth::Eight);
    encoder.write_header().unwrap().write_image_data(rgba).unwrap();
}
