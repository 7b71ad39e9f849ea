//! Interface of a room: sheets that float in the vehicle, which every eye sees on every screen, and the pointer that
//! chooses on them.

use crate::cockpit::cockpit;
use crate::guide::Guide;
use glam::{DQuat, DVec2, DVec3};
use input::head::Tracking;
use input::{Action, WandButtons, WandState};
use interface::{Caption, ClockRow, DrawnSheet, MenuPage, MenuRide, Readings, SheetPointer};
use presentation::Presentation;
use render::Gpu;
use room::{Channel, Display, EyeSide};
use walls::{RoomSheet, SheetHit, meet};

/// Least and most pixels for each point of a sheet, along each axis, and the factor by which a sheet is finer than the
/// finest channel shows it.
const PIXELS_PER_POINT: [f64; 2] = [0.75, 2.0];
const FINER: f64 = 1.5;
/// Half width of a pointer's beam, and its reach where it meets nothing, metres.
const BEAM_M: (f64, f64) = (0.004, 4.0);

/// Sheet, and its place about the viewer's head.
struct PlacedSheet {
    drawn: DrawnSheet,
    /// Direction from the head: to the right of straight ahead, and up, radians.
    towards_rad: [f64; 2],
    /// Distance from the head, and width, metres.
    size_m: [f64; 2],
}

/// Ray of a pointer in the room.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct PointerRay {
    /// Start of the ray, room axes, metres.
    pub from_m: DVec3,
    /// Direction of the ray.
    pub direction: DVec3,
    /// True while its button is held.
    pub pressed: bool,
    /// True if a hand holds it, so that its beam is drawn.
    pub has_beam: bool,
}

/// What the sheets show.
pub struct Shown<'a> {
    /// How the ride is shown.
    pub presentation: &'a Presentation,
    /// Values of the head-up display.
    pub readings: &'a Readings,
    /// State that the menu shows, while it is open.
    pub menu: Option<&'a MenuRide>,
    /// Caption of a tour.
    pub caption: Option<&'a Caption>,
    /// Readings of clocks.
    pub clocks: &'a [ClockRow],
    /// Keys of the menu that were pressed since the last picture.
    pub keys: &'a [egui::Key],
    /// Time, seconds.
    pub now_s: f64,
}

/// Sheets of a room.
pub struct RoomInterface {
    head_m: DVec3,
    readings: PlacedSheet,
    menu: PlacedSheet,
    help: PlacedSheet,
    guide: PlacedSheet,
    caption: PlacedSheet,
    /// Lines of the vehicle, once they have been shown.
    cockpit: Option<RoomSheet>,
    pixels_per_rad: f64,
    /// True if the pointer is on a sheet.
    pointed_at: bool,
    beam: wgpu::TextureView,
}

impl PlacedSheet {
    /// Sheet of so many points, towards a direction, at a distance and of a width. `pixels_per_rad`: those of the
    /// finest channel.
    fn new((gpu, pixels_per_rad): (&Gpu, f64), points: [f32; 2], towards_deg: [f64; 2], size_m: [f64; 2]) -> Self {
        let [distance_m, width_m] = size_m;
        let points_per_rad = f64::from(points[0]) / width_m * distance_m;
        let [least, most] = PIXELS_PER_POINT;
        let drawn = DrawnSheet::new(gpu, points, (FINER * pixels_per_rad / points_per_rad).clamp(least, most) as f32);
        Self { drawn, towards_rad: towards_deg.map(f64::to_radians), size_m }
    }

    /// Lower left corner, and the vectors along the lower and the left edge, room axes, metres. The sheet faces the
    /// head.
    fn edges(&self, head_m: DVec3) -> [DVec3; 3] {
        let [right_rad, up_rad] = self.towards_rad;
        let [distance_m, width_m] = self.size_m;
        let turn = DQuat::from_rotation_y(-right_rad) * DQuat::from_rotation_x(up_rad);
        let (right, up) = (turn * DVec3::X * width_m, turn * DVec3::Y * width_m * self.drawn.aspect());
        let middle = head_m + turn * DVec3::NEG_Z * distance_m;
        [middle - 0.5 * (right + up), right, up]
    }

    fn met(&self, head_m: DVec3, ray: &PointerRay) -> Option<SheetHit> {
        let [corner, right, up] = self.edges(head_m);
        meet(corner, right, up, ray.from_m, ray.direction)
    }

    fn sheet(&self, head_m: DVec3) -> RoomSheet {
        let [corner_m, right_m, up_m] = self.edges(head_m);
        RoomSheet { corner_m, right_m, up_m, picture: self.drawn.picture().clone() }
    }
}

impl RoomInterface {
    /// Sheets about the viewer of a display.
    pub fn new(gpu: &Gpu, display: &Display) -> Self {
        let amber = [255, 179, 71, 255];
        let pixels_per_rad = pixels_per_rad(display);
        let fine = (gpu, pixels_per_rad);
        Self {
            head_m: display.viewer.head_m,
            readings: PlacedSheet::new(fine, [700.0, 210.0], [0.0, -31.0], [2.0, 2.4]),
            menu: PlacedSheet::new(fine, [560.0, 300.0], [0.0, 18.0], [1.5, 1.5]),
            help: PlacedSheet::new(fine, [840.0, 940.0], [-69.0, 0.0], [1.6, 1.95]),
            guide: PlacedSheet::new(fine, [720.0, 460.0], [61.0, 0.0], [1.6, 2.0]),
            caption: PlacedSheet::new(fine, [560.0, 220.0], [0.0, -9.0], [1.6, 1.5]),
            cockpit: None,
            pixels_per_rad,
            pointed_at: false,
            beam: render::view_from_rows(gpu, "beam", [1, 1, 1], wgpu::TextureFormat::Rgba8Unorm, &amber),
        }
    }

    /// Draws the sheets, and returns them with the actions that were chosen on them.
    pub fn draw(
        &mut self,
        gpu: &Gpu,
        shown: &Shown<'_>,
        guide: &Guide,
        page: &mut MenuPage,
        ray: Option<PointerRay>,
    ) -> (Vec<RoomSheet>, Vec<Action>) {
        let Shown { presentation, readings, menu, caption, clocks, keys, now_s } = *shown;
        let (mut sheets, mut actions) = (Vec::new(), Vec::new());
        if presentation.cockpit {
            let (head_m, pixels_per_rad) = (self.head_m, self.pixels_per_rad);
            sheets.push(self.cockpit.get_or_insert_with(|| cockpit(gpu, head_m, pixels_per_rad)).clone());
        }
        if presentation.readings {
            self.readings
                .drawn
                .draw(gpu, now_s, (SheetPointer::default(), &[]), |ui| interface::show_readings(ui, readings));
            sheets.push(self.readings.sheet(self.head_m));
        }
        if presentation.help {
            let language = presentation.language;
            self.help.drawn.draw(gpu, now_s, (SheetPointer::default(), &[]), |ui| {
                interface::help_sheet(ui, language, readings.kiosk);
            });
            sheets.push(self.help.sheet(self.head_m));
        }
        if presentation.miniature || presentation.diagram || presentation.clocks || presentation.planner {
            self.guide.drawn.draw(gpu, now_s, (SheetPointer::default(), &[]), |ui| {
                guide.show_on_sheet(ui, presentation, clocks);
            });
            sheets.push(self.guide.sheet(self.head_m));
        }
        // The pointer is on the nearest of the sheets that it meets.
        let met =
            |sheet: &PlacedSheet, is_shown: bool| ray.filter(|_| is_shown).and_then(|ray| sheet.met(self.head_m, &ray));
        let hits = [met(&self.caption, caption.is_some()), met(&self.menu, menu.is_some())];
        let way = |hit: &Option<SheetHit>| hit.map_or(f64::INFINITY, |hit| hit.way);
        let nearest = way(&hits[0]).min(way(&hits[1]));
        let [on_caption, on_menu] = hits.map(|hit| hit.filter(|hit| hit.way == nearest));
        let pointer = |hit: Option<SheetHit>| SheetPointer {
            place: hit.map(|hit| hit.place.to_array()),
            pressed: ray.is_some_and(|ray| ray.pressed),
        };
        if let Some(caption) = caption {
            self.caption.drawn.draw(gpu, now_s, (pointer(on_caption), &[]), |ui| {
                actions.extend(interface::caption_sheet(ui, presentation.language, caption));
            });
            sheets.push(self.caption.sheet(self.head_m));
        }
        if let Some(menu) = menu {
            self.menu.drawn.draw(gpu, now_s, (pointer(on_menu), keys), |ui| {
                actions.extend(interface::menu_sheet(ui, page, presentation, menu));
            });
            sheets.push(self.menu.sheet(self.head_m));
        }
        let hit = on_caption.or(on_menu);
        self.pointed_at = hit.is_some();
        if let Some(ray) = ray.filter(|ray| ray.has_beam && (caption.is_some() || menu.is_some())) {
            sheets.push(self.beam(&ray, hit));
        }
        (sheets, actions)
    }

    /// True if the pointer was on a sheet in the picture drawn last.
    pub fn is_pointed_at(&self) -> bool {
        self.pointed_at
    }

    /// Beam of a pointer, up to what it meets: a ribbon that faces the head.
    fn beam(&self, ray: &PointerRay, hit: Option<SheetHit>) -> RoomSheet {
        let (half_m, reach_m) = BEAM_M;
        let along = ray.direction.normalize_or(DVec3::NEG_Z);
        let right_m = match hit {
            Some(hit) => ray.direction * hit.way,
            None => along * reach_m,
        };
        let across = along.cross(self.head_m - ray.from_m);
        let across = across.try_normalize().unwrap_or_else(|| along.any_orthonormal_vector());
        let up_m = across * 2.0 * half_m;
        RoomSheet { corner_m: ray.from_m - 0.5 * up_m, right_m, up_m, picture: self.beam.clone() }
    }
}

/// Pixels that the finest flat screen shows for each radian, straight before the viewer; as fine as any sheet where no
/// screen is flat.
fn pixels_per_rad(display: &Display) -> f64 {
    let of = |channel: &Channel| {
        let flat = channel.flat(display)?;
        let normal = flat.right.cross(flat.up).normalize();
        let distance_m = (flat.lower_left - display.viewer.head_m).dot(normal).abs();
        Some(f64::from(channel.viewport[2]) / flat.right.length() * distance_m)
    };
    display
        .channels
        .iter()
        .filter_map(of)
        .fold(None, |finest: Option<f64>, pixels| Some(finest.map_or(pixels, |finest| finest.max(pixels))))
        .unwrap_or(f64::MAX)
}

/// Ray of a wand whose place is known. `buttons`: actions of its buttons, of which those that choose press.
pub fn of_wand(wand: &WandState, buttons: &WandButtons) -> Option<PointerRay> {
    /// Pull of the trigger from which it counts as held.
    const PULLED: f64 = 0.5;
    let seen = matches!(wand.tracked, Tracking::Tracked | Tracking::Fading);
    seen.then(|| PointerRay {
        from_m: wand.position_m,
        direction: wand.orientation * DVec3::NEG_Z,
        pressed: wand.buttons.numbers().any(|button| buttons.chooses(button)) || wand.trigger > PULLED,
        has_beam: true,
    })
}

/// Ray of a mouse at a pixel of one of the display's windows: from the viewer's head through the point of the room
/// that is shown there.
pub fn of_mouse(display: &Display, window: usize, pixel: DVec2, pressed: bool) -> Option<PointerRay> {
    let channel = display.channels.iter().find(|channel| {
        let [x, y, width, height] = channel.viewport.map(f64::from);
        let place = pixel - DVec2::new(x, y);
        channel.window == window && (0.0..width).contains(&place.x) && (0.0..height).contains(&place.y)
    })?;
    let [x, y, width, height] = channel.viewport.map(f64::from);
    let place = (pixel - DVec2::new(x, y)) / DVec2::new(width, height);
    let point = channel.point(display, place)?;
    let eye = display.viewer.eye_m(EyeSide::Centre, display.viewer.head_m, glam::DMat3::IDENTITY);
    Some(PointerRay { from_m: eye, direction: point - eye, pressed, has_beam: false })
}

#[cfg(test)]
impl RoomInterface {
    /// Points of the room at which the menu's controls are, room axes, metres.
    fn menu_controls(&self) -> Vec<DVec3> {
        let [corner, right, up] = self.menu.edges(self.head_m);
        let point = |[x, y]: [f64; 2]| corner + x * right + (1.0 - y) * up;
        self.menu.drawn.controls().into_iter().map(point).collect()
    }
}

#[cfg(test)]
#[path = "room_menu/tests.rs"]
mod menu_tests;

#[cfg(test)]
mod tests {
    //! Law: whoever points at the middle of a channel with the mouse points where the head sees that point; a wand
    //! points along its −z.

    use super::*;
    use input::HeldButtons;

    #[test]
    fn a_mouse_points_through_the_pixel_that_it_is_on() {
        let display = Display::built_in("cave4").unwrap();
        for channel in &display.channels {
            let [x, y, width, height] = channel.viewport.map(f64::from);
            let pixel = DVec2::new(x + 0.25 * width, y + 0.5 * height);
            let ray = of_mouse(&display, channel.window, pixel, true).unwrap();
            let point = channel.point(&display, DVec2::new(0.25, 0.5)).unwrap();
            let towards = (point - display.viewer.head_m).normalize();
            assert!(towards.dot(ray.direction.normalize()) > 1.0 - 1e-12, "{}", channel.name);
        }
        assert_eq!(of_mouse(&display, 99, DVec2::ZERO, false), None);
    }

    #[test]
    fn a_wand_points_along_its_axis_and_is_pressed_by_its_first_button() {
        let wand = WandState {
            position_m: DVec3::X,
            orientation: DQuat::from_rotation_y(std::f64::consts::FRAC_PI_2),
            tracked: Tracking::Tracked,
            buttons: HeldButtons(1),
            stick: [0.0; 2],
            trigger: 0.0,
        };
        let usual = WandButtons::default();
        let ray = of_wand(&wand, &usual).unwrap();
        assert!((ray.direction - DVec3::NEG_X).length() < 1e-12 && ray.pressed);
        assert_eq!(of_wand(&WandState { tracked: Tracking::Lost, ..wand }, &usual), None);
        // Whichever button chooses presses, and no other.
        let own = [("0".to_owned(), "photo".to_owned()), ("3".to_owned(), "choose".to_owned())];
        let own = WandButtons(own.into());
        assert!(!of_wand(&wand, &own).unwrap().pressed);
        assert!(of_wand(&WandState { buttons: HeldButtons(8), ..wand }, &own).unwrap().pressed);
    }
}
