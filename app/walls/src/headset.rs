//! Output of the channels' light to the pictures of a headset.

use crate::picture::ChannelPicture;
use crate::scene_depth::SceneDepth;
use crate::veil::Veil;
use crate::walls::Walls;
use render::Gpu;
use render::display::Development;

impl Walls {
    /// Keeps the depth of the pictures from now on, so that it can be [handed on](Self::show_depth).
    pub fn keep_depth(&mut self, gpu: &Gpu) {
        self.scene_depth.get_or_insert_with(|| SceneDepth::new(gpu));
        self.pictures.iter_mut().for_each(|picture| picture.keep_depth());
    }

    /// Draws all parts of the pictures from now on, keeps no depth, and darkens no edges.
    pub fn show_whole(&mut self) {
        self.vignette = Veil::NONE;
        self.pictures.iter_mut().for_each(ChannelPicture::show_whole);
    }

    /// Draws nothing in these triangles of a channel's picture from now on: tangents to the right and up, three by
    /// three.
    pub fn hide(&mut self, gpu: &Gpu, channel: usize, corners: &[[f32; 2]]) {
        if let Some(picture) = self.pictures.get_mut(channel) {
            picture.hide(gpu, corners);
        }
    }

    /// Shows the windows `first` and `first + 1`, of which each is the whole picture of one channel, in the two layers
    /// of `both`, in one pass; `layers` are these layers. Only for a device that
    /// [draws views](crate::draws_views).
    pub fn show_views(
        &mut self,
        gpu: &Gpu,
        encoder: &mut wgpu::CommandEncoder,
        first: usize,
        development: &Development,
        both: &wgpu::TextureView,
        layers: &[wgpu::TextureView],
    ) {
        if self.grids.is_some() {
            for (number, layer) in layers.iter().enumerate() {
                self.show_window(gpu, encoder, first + number, development, layer, [0, 0]);
            }
            return;
        }
        let exposures = [first, first + 1].map(|channel| self.exposure(channel));
        let Self { passes, pictures, adaptation, .. } = self;
        let views = [0, 1].map(|view| (pictures[first + view].light(), exposures[view]));
        passes.show_views(gpu, encoder, views, adaptation, development, both);
        for (channel, layer) in (first..).zip(layers) {
            let viewport = self.display.channels[channel].viewport;
            self.show_over(gpu, encoder, channel, layer, viewport);
        }
    }

    /// Fills `depth` with that of a channel's picture: reversed, 1 at `near_m` before the eye and 0 at infinity;
    /// apparent places in the observer's frame. False, and nothing is drawn, if the picture has none.
    pub fn show_depth(
        &self,
        gpu: &Gpu,
        encoder: &mut wgpu::CommandEncoder,
        channel: usize,
        near_m: f64,
        depth: &wgpu::TextureView,
    ) -> bool {
        let of_light = self.pictures[channel].depth().filter(|_| self.grids.is_none());
        let Some((scene_depth, (target, drawn_m))) = self.scene_depth.as_ref().zip(of_light) else { return false };
        scene_depth.draw(gpu, encoder, target, depth, (drawn_m, near_m));
        true
    }
}
