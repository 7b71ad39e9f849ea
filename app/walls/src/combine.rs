//! Combines the pictures of both eyes on the same pixels: alternating rows or columns, a chequered pattern, or
//! red–cyan anaglyphs.

use bytemuck::bytes_of;
use glam::Vec2;
use render::Gpu;
use render::display::{Pass, UNFILTERED, UNIFORM, contents, encodes};
use room::Combine;

/// Pass that combines a left and a right picture on a screen.
pub struct Combiner(Pass);

impl Combiner {
    /// Combiner for a window of this kind; `None` if each channel has its own pixels. The pictures must be linear.
    pub fn new(gpu: &Gpu, combine: Combine, swap_eyes: bool, screen: wgpu::TextureFormat) -> Option<Self> {
        let pattern = match combine {
            Combine::None => return None,
            Combine::Rows => shaders::COMBINE_ROWS,
            Combine::Columns => shaders::COMBINE_COLUMNS,
            Combine::Checker => shaders::COMBINE_CHECKER,
            Combine::AnaglyphDubois => shaders::COMBINE_DUBOIS,
            Combine::AnaglyphGrey => shaders::COMBINE_GREY,
            Combine::AnaglyphHalfColour => shaders::COMBINE_HALF_COLOUR,
        };
        let overrides = [
            ("COMBINE", f64::from(pattern)),
            ("SWAP_EYES", f64::from(u8::from(swap_eyes))),
            ("ENCODE", f64::from(u8::from(encodes(screen)))),
        ];
        Some(Self(Pass::new(gpu, &shaders::COMBINE, &overrides, &[UNFILTERED, UNFILTERED, UNIFORM], screen)))
    }

    /// Writes both eyes' linear pictures to a part of the screen: x, y, width and height in pixels. `first_pixel` is
    /// the place of the screen's upper left pixel on its monitor. If `over` is true, the rest of the screen stays
    /// unchanged.
    #[expect(clippy::too_many_arguments, reason = "two pictures, and where they go")]
    pub fn show(
        &self,
        gpu: &Gpu,
        encoder: &mut wgpu::CommandEncoder,
        [left, right]: [&wgpu::TextureView; 2],
        screen: &wgpu::TextureView,
        viewport: [u32; 4],
        first_pixel: [i32; 2],
        over: bool,
    ) {
        let [x, y, ..] = viewport.map(|pixels| pixels as f32);
        let [column, row] = first_pixel.map(|pixel| pixel.rem_euclid(2) as f32);
        let placement = shaders::PlacementUniforms { origin: Vec2::new(x, y), exposure: 1.0, odd: row + 2.0 * column };
        let placement = contents(gpu, "placement", bytes_of(&placement), wgpu::BufferUsages::UNIFORM);
        let resources = [
            wgpu::BindingResource::TextureView(left),
            wgpu::BindingResource::TextureView(right),
            placement.as_entire_binding(),
        ];
        self.0.draw_part(gpu, encoder, screen, &resources, viewport, over);
    }
}
