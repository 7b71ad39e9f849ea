//! Frame in the windows: drawn, developed, with the interface over it.

use super::open::Open;
use super::operator::Operated;
use super::{calibrating, headset, readings};
use crate::canvas::Canvas;
use crate::error::Error;
use crate::session::tour_ride::TourMark;
use cabin::{PointerRay, Shown};
use input::{Action, SECOND, Sample};
use presentation::{Latency, Vignette};
use std::sync::atomic::Ordering;
use std::time::{Duration, Instant};
use words::Phrase;

/// Time for which a turn waits for the windows' textures: several refreshes of any monitor, and less than the quarter
/// of a second after which own time is not ridden.
const LONGEST_WAIT: Duration = Duration::from_millis(100);
/// Shortest time of a turn in which nothing is shown.
const HELD_PAUSE: Duration = Duration::from_millis(10);

impl Open {
    /// Draws one frame. Returns false when the ride is over.
    ///
    /// # Errors
    /// A lost device, or a recording that cannot be replayed.
    pub fn frame(&mut self) -> Result<bool, Error> {
        self.gpu.lost()?;
        if self.stop.load(Ordering::Relaxed) {
            return Ok(false);
        }
        self.look_ahead();
        let began = Instant::now();
        let turn = self.headset_turn();
        // The headset waits for no window.
        self.ask_for_textures(if turn.is_some() { Instant::now() } else { began + LONGEST_WAIT })?;
        let screens = self.in_step.turn();
        if turn.is_none() && screens.is_none() {
            // The ride goes on while nothing can be shown.
            let Some(frame) = self.ride.live.frame()? else { return Ok(false) };
            self.carry_out(frame.controls.actions);
            if self.leaves {
                return Ok(false);
            }
            std::thread::sleep(HELD_PAUSE.saturating_sub(began.elapsed()));
            return Ok(true);
        }
        let screens = screens.unwrap_or_default();
        if let Canvas::Picture(picture) = &mut self.canvas {
            picture.resize(self.windows[0].size());
        }

        // Devices to light, on one page: frame.rs.
        let mut shown = self.presentation;
        self.ride.live.language = shown.language;
        if turn.is_some() {
            // A picture that is late by a frame would be seen at a time for which it was not drawn.
            shown.latency = Latency::Low;
        }
        let Some(actions) = self.ride.frame(&self.gpu, &mut self.canvas, &shown)? else { return Ok(false) };
        self.carry_out(actions);
        if self.leaves {
            return Ok(false);
        }
        let shown = self.presentation;

        // Light to the windows, and the interface over the first.
        let readings = readings::readings(&self.ride, shown.language, self.kiosk);
        let has_operator = self.operator.is_some();
        let menu = (shown.menu || has_operator).then(|| self.menu());
        let [width, height] = self.windows[0].size().map(f64::from);
        for TourMark { name, event } in self.ride.live.take_marks() {
            self.guide.mark(name.in_language(shown.language.code()), event);
        }
        if let Some(frame) = &self.ride.frame {
            self.guide.note(frame, &shown, width / height);
        }
        let clocks = |frame| self.guide.wanted_clocks(frame, &shown);
        let clocks = self.ride.frame.as_ref().map_or_else(Vec::new, clocks);
        let caption = self.ride.live.caption();
        let keys = std::mem::take(&mut self.menu_keys);
        let room = Shown {
            presentation: &shown,
            readings: &readings,
            menu: menu.as_ref().filter(|_| shown.menu),
            caption: caption.as_ref(),
            clocks: &clocks,
            keys: &keys,
            now_s: self.ride.live.now() as f64 / SECOND as f64,
        };
        self.darken_edges(shown.vignette);
        let mut wanted = self.draw_room_interface(&room);
        let is_flat = self.room_interface.is_none();
        if is_flat {
            self.interface.press(keys);
        }
        if let Some(turn) = &turn {
            self.show_in_headset(turn, &shown.development)?;
        }
        let calibrating = self.calibrating.as_ref().filter(|calibrating| calibrating.active);
        let (page, guide, kiosk) = (&mut self.page, &self.guide, self.kiosk);
        for (number, texture) in &screens {
            let mut encoder = self.gpu.device.create_command_encoder(&Default::default());
            let screen = texture.texture.create_view(&wgpu::TextureViewDescriptor::default());
            let window = &self.windows[*number].window;
            let first_pixel = window.inner_position().map_or([0, 0], |place| [place.x, place.y]);
            let mut picture = None;
            if let Some(worn) = &mut self.worn {
                drop(render::display::clear(&mut encoder, &screen));
                let drawn = (&mut self.canvas, &shown.development);
                picture = worn.copy(&self.gpu, &mut encoder, drawn, &mut self.interface);
            } else {
                self.canvas.show(&self.gpu, &mut encoder, *number, &shown.development, &screen, first_pixel);
            }
            if *number == 0 {
                let size = [texture.texture.width(), texture.texture.height()];
                self.interface.draw(&self.gpu, window, &mut encoder, &screen, size, |ui| {
                    if let Some(picture) = picture {
                        headset::mirror(ui, picture);
                    }
                    if let Some(calibrating) = calibrating {
                        calibrating::show(ui, calibrating, shown.language);
                        return;
                    }
                    if shown.readings && is_flat {
                        interface::show_readings(ui, &readings);
                    }
                    if is_flat {
                        guide.show(ui, &shown, &clocks);
                    }
                    if let Some(caption) = caption.as_ref().filter(|_| is_flat) {
                        let free = guide.free_width(ui, &shown);
                        wanted.extend(interface::caption_window(ui, free, shown.language, caption));
                    }
                    if let Some(menu) = menu.as_ref().filter(|_| is_flat && shown.menu) {
                        wanted.extend(interface::menu_window(ui, page, &shown, menu));
                    }
                    if shown.help && is_flat && !interface::show_help(ui, shown.language, kiosk) {
                        wanted.push(Action::ToggleHelp);
                    }
                    if kiosk {
                        // The interface would show the pointer again.
                        ui.ctx().set_cursor_icon(egui::CursorIcon::None);
                    }
                });
            }
            self.gpu.queue.submit([encoder.finish()]);
        }
        for action in wanted {
            self.ride.live.say(|at| Sample::action(at, &action));
        }
        if let (Some(operator), Some(menu)) = (&mut self.operator, &menu) {
            let operated = Operated { presentation: &shown, readings: &readings, menu };
            let chosen = operator.draw(&self.gpu, &mut self.canvas, &operated)?;
            self.operate(chosen);
        }
        // Everything is drawn before anything is presented, so that nothing comes between the presents.
        if screens.len() > 1 {
            self.gpu.wait()?;
        }
        let mut first = None;
        let mut skew = Duration::ZERO;
        for (_, texture) in screens {
            self.gpu.queue.present(texture);
            skew = first.get_or_insert_with(Instant::now).elapsed();
        }
        self.in_step.presented(skew);
        self.ride.times.stage(Phrase::StageShow);
        Ok(true)
    }

    /// Darkens the edges of a headset's pictures with the motion of the frame that is shown.
    fn darken_edges(&mut self, vignette: Vignette) {
        let is_worn = self.worn.as_ref().is_some_and(|worn| worn.is_drawn_for);
        let (Some(frame), true) = (&self.ride.frame, is_worn) else { return };
        self.unfelt.follow(frame);
        if let Some(walls) = self.canvas.walls_mut() {
            walls.vignette = self.unfelt.veil(vignette);
        }
    }

    /// Asks every window that holds no texture for one. Windows that others wait for have until `until`.
    fn ask_for_textures(&mut self, until: Instant) -> Result<(), Error> {
        let lacking = self.in_step.lacking();
        for &number in &lacking {
            self.windows[number].ask()?;
        }
        for number in lacking {
            let until = if self.in_step.is_left_out(number) { Instant::now() } else { until };
            let answer = self.windows[number].answer(&self.gpu, until)?;
            self.in_step.answer(number, answer);
        }
        Ok(())
    }

    /// Draws the sheets of a room's interface. Returns the actions that were chosen on them.
    fn draw_room_interface(&mut self, shown: &Shown<'_>) -> Vec<Action> {
        let (Some(interface), Some(walls)) = (&mut self.room_interface, self.canvas.walls_mut()) else {
            return Vec::new();
        };
        // The wand of a recorded rider has chosen already.
        let frame = self.ride.frame.as_ref().filter(|_| !self.ride.live.is_recorded());
        let wand = frame.and_then(|frame| frame.controls.wand.as_deref());
        let buttons = self.room.head.as_ref().and_then(|head| head.wand.as_ref()).map(|wand| &wand.actions);
        // A press that was over before this picture has chosen, and counts for it.
        let chose = frame.is_some_and(|frame| frame.controls.actions.contains(&Action::Choose));
        let wand = wand.zip(buttons).and_then(|(wand, buttons)| cabin::of_wand(wand, buttons));
        let wand = wand.map(|ray| PointerRay { pressed: ray.pressed || chose, ..ray });
        // A press that was over before this picture counts for it.
        let pressed = std::mem::take(&mut self.mouse_clicked) || self.mouse_pressed;
        // The window shows the picture of a headset smaller, and turned with the head.
        let has_mouse = self.worn.is_none();
        let mouse = || {
            let (window, pixel) = self.pointed.filter(|_| has_mouse)?;
            cabin::of_mouse(&walls.display, window, pixel, pressed)
        };
        let (sheets, actions) = interface.draw(&self.gpu, shown, &self.guide, &mut self.page, wand.or_else(mouse));
        walls.sheets = sheets;
        actions
    }
}
