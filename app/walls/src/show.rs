//! Output of the channels' light to windows and pictures.

use crate::head::Occupant;
use crate::preview::{Preview, RoomOnlooker};
use crate::sheet_passes::{SheetChannel, SheetScreen};
use crate::test_grid::DEVELOPMENT;
use crate::veil::{Veil, VeiledEye};
use crate::walls::Walls;
use glam::{DMat3, DVec3};
use image::RgbaImage;
use render::display::{DevelopedPart, Development, LINEAR_FORMAT, clear};
use render::target::texture;
use render::{Gpu, GpuError};
use room::{Combine, EyeSide};
use studio::{SCREEN_FORMAT, Sheet};

impl Walls {
    /// Shows all channels of a window in it. `first_pixel` is the place of the window's upper left pixel on its
    /// monitor.
    pub fn show_window(
        &mut self,
        gpu: &Gpu,
        encoder: &mut wgpu::CommandEncoder,
        window: usize,
        development: &Development,
        screen: &wgpu::TextureView,
        first_pixel: [i32; 2],
    ) {
        // A window that is smaller than described shows only the channels that fit into it.
        let size = screen.texture().size();
        let fits = |[x, y, width, height]: [u32; 4]| x + width <= size.width && y + height <= size.height;
        let of_window = |channel: &usize| {
            let channel = &self.display.channels[*channel];
            channel.window == window && fits(channel.viewport)
        };
        let channels: Vec<usize> = (0..self.display.channels.len()).filter(of_window).collect();
        let mut over = false;
        for &channel in &channels {
            let (eye, viewport) = (self.display.channels[channel].eye, self.display.channels[channel].viewport);
            // Channel of the other eye, if both share their pixels. Both are shown together with the left one.
            let partner = channels.iter().copied().find(|&other| {
                let other = &self.display.channels[other];
                other.eye != eye && other.viewport == viewport
            });
            match partner.filter(|_| self.display.windows[window].combine != Combine::None) {
                None => self.show(gpu, encoder, channel, development, screen, viewport, over),
                Some(_) if eye == EyeSide::Right => continue,
                Some(right) => {
                    let pair = [channel, right].map(|channel| self.developed(gpu, encoder, channel, development));
                    let combiner = self.combiners[window].as_ref().expect("its window combines");
                    combiner.show(gpu, encoder, [&pair[0], &pair[1]], screen, viewport, first_pixel, over);
                }
            }
            over = true;
        }
        if !over {
            drop(clear(encoder, screen));
        }
    }

    /// Developed picture of a channel.
    ///
    /// # Errors
    /// [`GpuError::Lost`] if the device went away.
    pub fn develop(&mut self, gpu: &Gpu, channel: usize, development: &Development) -> Result<RgbaImage, GpuError> {
        let [width, height] = self.display.channels[channel].size();
        let sheet = Sheet::new(gpu, [width, height], self.screen);
        let mut encoder = gpu.device.create_command_encoder(&Default::default());
        self.show(gpu, &mut encoder, channel, development, &sheet.view(), [0, 0, width, height], false);
        Ok(picture([width, height], self.screen, sheet.fetch(gpu, encoder)?))
    }

    /// Developed picture of a window, with all its channels.
    ///
    /// # Errors
    /// [`GpuError::Lost`] if the device went away.
    pub fn develop_window(
        &mut self,
        gpu: &Gpu,
        window: usize,
        development: &Development,
    ) -> Result<RgbaImage, GpuError> {
        let [width, height] = self.display.windows[window].size;
        let sheet = Sheet::new(gpu, [width, height], self.screen);
        let mut encoder = gpu.device.create_command_encoder(&Default::default());
        self.show_window(gpu, &mut encoder, window, development, &sheet.view(), [0, 0]);
        Ok(picture([width, height], self.screen, sheet.fetch(gpu, encoder)?))
    }

    /// Picture of the room as an onlooker sees it.
    ///
    /// # Errors
    /// [`GpuError::Lost`] if the device went away.
    pub fn develop_room(
        &mut self,
        gpu: &Gpu,
        size: [u32; 2],
        occupant: &Occupant,
        onlooker: &RoomOnlooker,
        development: &Development,
    ) -> Result<RgbaImage, GpuError> {
        let sheet = Sheet::new(gpu, size, SCREEN_FORMAT);
        let mut preview = Preview::new(gpu, self, SCREEN_FORMAT);
        let mut encoder = gpu.device.create_command_encoder(&Default::default());
        preview.draw(gpu, &mut encoder, self, (occupant, onlooker), development, &sheet.view());
        Ok(picture(size, SCREEN_FORMAT, sheet.fetch(gpu, encoder)?))
    }

    /// Picture of a channel in linear light, for further processing.
    pub fn developed(
        &mut self,
        gpu: &Gpu,
        encoder: &mut wgpu::CommandEncoder,
        channel: usize,
        development: &Development,
    ) -> wgpu::TextureView {
        let [width, height] = self.display.channels[channel].size();
        let usage = wgpu::TextureUsages::RENDER_ATTACHMENT | wgpu::TextureUsages::TEXTURE_BINDING;
        let made = || texture(gpu, "developed", [width, height], LINEAR_FORMAT, 1, usage);
        let linear = self.pictures[channel].developed.get_or_insert_with(made).clone();
        std::mem::swap(&mut self.passes, &mut self.linear_passes);
        self.show(gpu, encoder, channel, development, &linear, [0, 0, width, height], false);
        std::mem::swap(&mut self.passes, &mut self.linear_passes);
        linear
    }

    /// Shows a channel in a part of `screen`.
    #[expect(clippy::too_many_arguments, reason = "what is shown, how, and where")]
    fn show(
        &mut self,
        gpu: &Gpu,
        encoder: &mut wgpu::CommandEncoder,
        channel: usize,
        development: &Development,
        screen: &wgpu::TextureView,
        viewport: [u32; 4],
        over: bool,
    ) {
        let picture = &self.pictures[channel];
        let exposure = self.exposure(channel);
        let projector = self.display.channels[channel].projector(&self.display);
        let gamma = projector.and_then(|projector| projector.gamma);
        let part = DevelopedPart { viewport, over, exposure, gains: picture.gains.as_ref(), gamma };
        match &self.grids {
            None => {
                self.passes.show_part(gpu, encoder, picture.light(), &self.adaptation, development, screen, &part);
                self.show_over(gpu, encoder, channel, screen, viewport);
            }
            Some(grids) => {
                let part = DevelopedPart { exposure: 1.0, ..part };
                let light = &grids.lights[channel];
                self.passes.show_part(gpu, encoder, light, &grids.adaptation, &DEVELOPMENT, screen, &part);
            }
        }
    }

    /// Shows what lies over the light of a channel: a vignette, the sheets of the room, a fade.
    pub(crate) fn show_over(
        &mut self,
        gpu: &Gpu,
        encoder: &mut wgpu::CommandEncoder,
        channel: usize,
        screen: &wgpu::TextureView,
        viewport: [u32; 4],
    ) {
        self.show_veil(gpu, encoder, channel, (screen, viewport), self.vignette);
        self.show_sheets(gpu, encoder, channel, screen, viewport);
        self.show_veil(gpu, encoder, channel, (screen, viewport), self.fade);
    }

    /// Factor of a channel's light besides the common exposure, which is made for the scale with which the first
    /// channel stores its light.
    pub(crate) fn exposure(&self, channel: usize) -> f32 {
        let first = self.pictures.first().map_or(1.0, |picture| picture.stored.scale);
        (first / self.pictures[channel].stored.scale) as f32
    }

    /// Shows a veil over a channel's picture on a flat screen, for the eye whose light was drawn last.
    fn show_veil(
        &mut self,
        gpu: &Gpu,
        encoder: &mut wgpu::CommandEncoder,
        channel: usize,
        (screen, viewport): (&wgpu::TextureView, [u32; 4]),
        veil: Veil,
    ) {
        let Some((occupant, _)) = self.shown.as_ref().filter(|_| !veil.is_none()) else { return };
        let (viewer, of_display) = (&self.display.viewer, &self.display.channels[channel]);
        let Some(surface) = of_display.flat(&self.display) else { return };
        let turned = if viewer.turns_pictures { DMat3::IDENTITY } else { occupant.head.room_from_head };
        let eye_m = occupant.eye(viewer, of_display.eye).place_m;
        let eye = VeiledEye { eye_m, ahead: turned * DVec3::NEG_Z, screen: surface, viewport };
        let target = (screen, self.written(screen));
        self.veil_passes.draw(gpu, encoder, target, &veil, &eye);
    }

    /// Format in which a target is written: a headset's pictures are sRGB as it is stored, whatever reads them.
    fn written(&self, screen: &wgpu::TextureView) -> wgpu::TextureFormat {
        let format = screen.texture().format();
        let is_screen = format.remove_srgb_suffix() == self.screen.remove_srgb_suffix();
        if is_screen { self.screen } else { format }
    }

    /// Shows the sheets of the room over a channel's picture, as the eye sees them whose light was drawn last.
    fn show_sheets(
        &mut self,
        gpu: &Gpu,
        encoder: &mut wgpu::CommandEncoder,
        channel: usize,
        screen: &wgpu::TextureView,
        viewport: [u32; 4],
    ) {
        let Some((occupant, _)) = self.shown.as_ref().filter(|_| !self.sheets.is_empty()) else { return };
        // Sheets rest in the room; where pictures turn with the head, the room is seen turned against it.
        let sheets: Vec<_> = match self.display.viewer.turns_pictures {
            true => self.sheets.iter().map(|sheet| sheet.seen_by(&occupant.head)).collect(),
            false => self.sheets.clone(),
        };
        let (picture, of_display) = (&self.pictures[channel], &self.display.channels[channel]);
        let eye_m = occupant.eye(&self.display.viewer, of_display.eye).place_m;
        let surface = match (of_display.flat(&self.display), picture.points()) {
            (Some(flat), _) => SheetScreen::Flat(flat),
            (None, Some(points)) => SheetScreen::Table(points),
            (None, None) => return,
        };
        let gamma = of_display.projector(&self.display).and_then(|projector| projector.gamma);
        let gains = picture.gains.as_ref();
        let format = self.written(screen);
        let channel = SheetChannel { screen: surface, eye_m, viewport, gains, gamma, format };
        self.sheet_passes.draw(gpu, encoder, screen, &sheets, &channel);
    }
}

/// Picture of the bytes of a screen.
fn picture([width, height]: [u32; 2], format: wgpu::TextureFormat, mut bytes: Vec<u8>) -> RgbaImage {
    // Screens may hold blue first.
    if format.remove_srgb_suffix() == wgpu::TextureFormat::Bgra8Unorm {
        bytes.chunks_exact_mut(4).for_each(|pixel| pixel.swap(0, 2));
    }
    RgbaImage::from_raw(width, height, bytes).expect("a screen has four bytes a pixel")
}
