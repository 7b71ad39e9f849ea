//! Pictures that a headset's runtime lends: of one view, or of two of one size in two layers.

use crate::device::HeadsetDevice;
use ash::vk;
use ash::vk::Handle;
use openxr as xr;
use render::Gpu;
use render::display::Development;
use walls::Walls;
use wgpu::hal;
use wgpu::hal::api::Vulkan;

/// Near plane of the depth that is handed over, metres: what is nearer to an eye counts as there.
pub const DEPTH_NEAR_M: f64 = 0.05;
/// Format of depth.
const DEPTH: (vk::Format, wgpu::TextureFormat) = (vk::Format::D32_SFLOAT, wgpu::TextureFormat::Depth32Float);
/// Most views that share pictures.
const MOST_LAYERS: usize = 2;

/// Chain of pictures, each with a layer for each of its views.
struct Chain {
    // Dropped before the chain that owns the images.
    pictures: Vec<Picture>,
    chain: xr::Swapchain<xr::Vulkan>,
}

/// A picture of a chain.
struct Picture {
    layers: Vec<wgpu::TextureView>,
    /// Both layers as one target, where there are two.
    both: Option<wgpu::TextureView>,
}

/// Pictures of successive views that have one size.
pub(crate) struct ViewPictures {
    /// Number of the first of the views.
    pub first: usize,
    /// Number of the views.
    pub count: usize,
    /// Width and height, pixels.
    pub size: [u32; 2],
    colour: Chain,
    depth: Option<Chain>,
}

/// Pictures of a turn that are to be drawn: of one view, or of two that have one size.
#[derive(Clone, Copy)]
pub struct TurnPictures<'a> {
    /// Number of the first of these views among those of the headset.
    pub first: usize,
    /// Picture of each view. Its format is sRGB as it is stored.
    pub layers: &'a [wgpu::TextureView],
    /// Both pictures as one target, if both are to be drawn in one pass.
    pub both: Option<&'a wgpu::TextureView>,
    /// Depth of each picture, if the runtime takes it: reversed, 1 at [`DEPTH_NEAR_M`] before the eye.
    pub depths: &'a [wgpu::TextureView],
}

impl TurnPictures<'_> {
    /// Shows the light of a [headset's display](room::Display::headset) in the pictures. True if they have their depth.
    pub fn show(&self, gpu: &Gpu, walls: &mut Walls, development: &Development) -> bool {
        let mut encoder = gpu.device.create_command_encoder(&Default::default());
        match self.both {
            Some(both) => walls.show_views(gpu, &mut encoder, self.first, development, both, self.layers),
            None => {
                for (window, layer) in (self.first..).zip(self.layers) {
                    walls.show_window(gpu, &mut encoder, window, development, layer, [0, 0]);
                }
            }
        }
        let mut has_depth = !self.depths.is_empty();
        for (channel, depth) in (self.first..).zip(self.depths) {
            has_depth &= walls.show_depth(gpu, &mut encoder, channel, DEPTH_NEAR_M, depth);
        }
        gpu.queue.submit([encoder.finish()]);
        has_depth
    }
}

impl ViewPictures {
    /// Pictures for views of these sizes: successive views of one size share theirs. `formats`: those that the runtime
    /// takes. `with_depth`: true if it takes depth.
    pub fn of_views(
        session: &xr::Session<xr::Vulkan>,
        device: &HeadsetDevice,
        sizes: &[[u32; 2]],
        format: (vk::Format, wgpu::TextureFormat),
        with_depth: bool,
    ) -> xr::Result<Vec<Self>> {
        let made = |(first, count, size)| {
            let colour = Chain::new(session, device, size, count, format)?;
            // A runtime that refuses depth after all gets none.
            let depth = with_depth.then(|| Chain::new(session, device, size, count, DEPTH)).and_then(Result::ok);
            Ok(Self { first, count, size, colour, depth })
        };
        groups(sizes).into_iter().map(made).collect()
    }

    /// True if they have depth.
    pub fn has_depth(&self) -> bool {
        self.depth.is_some()
    }

    /// True for a runtime that takes depth in the format in which it is drawn.
    pub fn takes_depth(formats: &[u32]) -> bool {
        formats.contains(&(DEPTH.0.as_raw() as u32))
    }

    /// Lends the next pictures to `draw`, which returns true if it has drawn depth, and hands them over. Returns the
    /// same.
    pub fn lend(&mut self, in_one_pass: bool, mut draw: impl FnMut(&TurnPictures<'_>) -> bool) -> xr::Result<bool> {
        let colour = self.colour.acquire()?;
        let depth = self.depth.as_mut().map(Chain::acquire).transpose()?;
        let of_depth = self.depth.as_ref().zip(depth);
        let picture = &self.colour.pictures[colour];
        let has_depth = draw(&TurnPictures {
            first: self.first,
            layers: &picture.layers,
            both: picture.both.as_ref().filter(|_| in_one_pass),
            depths: of_depth.map_or(&[], |(chain, index)| &chain.pictures[index].layers),
        });
        self.colour.chain.release_image()?;
        if let Some(depth) = &mut self.depth {
            depth.chain.release_image()?;
        }
        Ok(has_depth && self.depth.is_some())
    }

    /// Part of the pictures that belongs to the view with this number among theirs; of their depth if `depth` is true.
    pub fn part(&self, layer: usize, depth: bool) -> Option<xr::SwapchainSubImage<'_, xr::Vulkan>> {
        let chain = if depth { self.depth.as_ref()? } else { &self.colour };
        let [width, height] = self.size.map(|side| i32::try_from(side).unwrap_or(i32::MAX));
        let rect = xr::Rect2Di { offset: xr::Offset2Di { x: 0, y: 0 }, extent: xr::Extent2Di { width, height } };
        Some(xr::SwapchainSubImage::new().swapchain(&chain.chain).image_array_index(layer as u32).image_rect(rect))
    }
}

/// First view, number of views and size of the pictures for views of these sizes.
fn groups(sizes: &[[u32; 2]]) -> Vec<(usize, usize, [u32; 2])> {
    let mut groups: Vec<(usize, usize, [u32; 2])> = Vec::new();
    for (view, &size) in sizes.iter().enumerate() {
        match groups.last_mut() {
            Some((_, count, shared)) if *shared == size && *count < MOST_LAYERS => *count += 1,
            _ => groups.push((view, 1, size)),
        }
    }
    groups
}

impl Chain {
    fn new(
        session: &xr::Session<xr::Vulkan>,
        device: &HeadsetDevice,
        size: [u32; 2],
        layers: usize,
        (raw_format, format): (vk::Format, wgpu::TextureFormat),
    ) -> xr::Result<Self> {
        let is_depth = format.is_depth_stencil_format();
        let written = format.remove_srgb_suffix();
        let mutable =
            if written == format { xr::SwapchainUsageFlags::EMPTY } else { xr::SwapchainUsageFlags::MUTABLE_FORMAT };
        let drawn = if is_depth {
            xr::SwapchainUsageFlags::DEPTH_STENCIL_ATTACHMENT
        } else {
            xr::SwapchainUsageFlags::COLOR_ATTACHMENT
        };
        let chain = session.create_swapchain(&xr::SwapchainCreateInfo {
            create_flags: xr::SwapchainCreateFlags::EMPTY,
            usage_flags: drawn | mutable | xr::SwapchainUsageFlags::TRANSFER_SRC,
            format: raw_format.as_raw() as u32,
            sample_count: 1,
            width: size[0],
            height: size[1],
            face_count: 1,
            array_size: layers as u32,
            mip_count: 1,
        })?;
        let extent = wgpu::Extent3d { width: size[0], height: size[1], depth_or_array_layers: layers as u32 };
        let state = if is_depth { wgpu::TextureUses::DEPTH_STENCIL_WRITE } else { wgpu::TextureUses::COLOR_TARGET };
        let other_formats: &[_] = if written == format { &[] } else { &[written] };
        let picture = |image: u64| {
            let described = hal::TextureDescriptor {
                label: Some("view"),
                size: extent,
                mip_level_count: 1,
                sample_count: 1,
                dimension: wgpu::TextureDimension::D2,
                format,
                usage: state | wgpu::TextureUses::COPY_SRC,
                memory_flags: hal::MemoryFlags::empty(),
                view_formats: other_formats.to_vec(),
            };
            let descriptor = wgpu::TextureDescriptor {
                label: Some("view"),
                size: extent,
                mip_level_count: 1,
                sample_count: 1,
                dimension: wgpu::TextureDimension::D2,
                format,
                usage: wgpu::TextureUsages::RENDER_ATTACHMENT | wgpu::TextureUsages::COPY_SRC,
                view_formats: other_formats,
            };
            // SAFETY: the image is the runtime's, of this size, format and use, on this device; the callback keeps wgpu
            // from destroying it, and the texture is dropped before the chain. The runtime hands images over, and
            // wants them back, as targets.
            let texture = unsafe {
                let hal_device = device.gpu.device.as_hal::<Vulkan>()?;
                let raw = vk::Image::from_raw(image);
                let kept: hal::DropCallback = Box::new(|| {});
                let made =
                    hal_device.texture_from_raw(raw, &described, Some(kept), hal::vulkan::TextureMemory::External);
                device.gpu.device.create_texture_from_hal::<Vulkan>(made, &descriptor, state)
            };
            let view = |base_array_layer, count, dimension| {
                texture.create_view(&wgpu::TextureViewDescriptor {
                    format: Some(written),
                    dimension: Some(dimension),
                    base_array_layer,
                    array_layer_count: Some(count),
                    ..Default::default()
                })
            };
            let layer = |layer| view(layer, 1, wgpu::TextureViewDimension::D2);
            Some(Picture {
                layers: (0..layers as u32).map(layer).collect(),
                both: (layers == MOST_LAYERS).then(|| view(0, layers as u32, wgpu::TextureViewDimension::D2Array)),
            })
        };
        let pictures: Option<Vec<_>> = chain.enumerate_images()?.into_iter().map(picture).collect();
        Ok(Self { pictures: pictures.ok_or(xr::sys::Result::ERROR_GRAPHICS_DEVICE_INVALID)?, chain })
    }

    /// Waits for the next picture. Returns its number.
    fn acquire(&mut self) -> xr::Result<usize> {
        let number = self.chain.acquire_image()?;
        self.chain.wait_image(xr::Duration::INFINITE)?;
        Ok(number as usize)
    }
}

#[cfg(test)]
mod tests {
    //! Law: both eyes share pictures if theirs have one size; wide views and the finer ones within them do not.

    use super::groups;

    #[test]
    fn views_of_one_size_share_pictures_two_by_two() {
        assert_eq!(groups(&[[320, 240]; 2]), [(0, 2, [320, 240])]);
        assert_eq!(groups(&[[320, 240]; 4]), [(0, 2, [320, 240]), (2, 2, [320, 240])]);
        let insets = [[1000, 900], [1000, 900], [600, 600], [600, 600]];
        assert_eq!(groups(&insets), [(0, 2, [1000, 900]), (2, 2, [600, 600])]);
        assert_eq!(groups(&[[320, 240], [300, 240]]), [(0, 1, [320, 240]), (1, 1, [300, 240])]);
    }
}
