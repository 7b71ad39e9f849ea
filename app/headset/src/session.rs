//! Session of a headset: its turns, and the pictures of its eyes.

use crate::device::HeadsetDevice;
use crate::error::HeadsetError;
use ash::vk;
use ash::vk::Handle;
use glam::{DQuat, DVec2, DVec3};
use input::openxr::{XrHands, XrReport, XrRuntime, XrState};
use openxr as xr;
use room::HeadsetEye;
use std::time::Duration;
use wgpu::hal;
use wgpu::hal::api::Vulkan;

/// Kind of views: one for each eye.
const VIEWS: xr::ViewConfigurationType = xr::ViewConfigurationType::PRIMARY_STEREO;
/// Formats of pictures that are taken, the best first.
const FORMATS: [(vk::Format, wgpu::TextureFormat); 2] = [
    (vk::Format::R8G8B8A8_SRGB, wgpu::TextureFormat::Rgba8UnormSrgb),
    (vk::Format::B8G8R8A8_SRGB, wgpu::TextureFormat::Bgra8UnormSrgb),
];
/// Pause of a turn while the headset rests.
const REST: Duration = Duration::from_millis(20);

/// Pictures of one eye, which the runtime lends in turn.
struct EyePictures {
    // Dropped before the chain that owns the images.
    views: Vec<wgpu::TextureView>,
    chain: xr::Swapchain<xr::Vulkan>,
    size: [u32; 2],
}

/// Session of a headset. It must be dropped before the device.
pub struct Headset {
    eyes: [EyePictures; 2],
    hands: XrHands,
    head: xr::Space,
    waiter: xr::FrameWaiter,
    stream: xr::FrameStream<xr::Vulkan>,
    blend: xr::EnvironmentBlendMode,
    format: wgpu::TextureFormat,
    state: XrState,
    /// True once the head's place has been tracked, and not made up by the runtime alone.
    was_placed: bool,
    session: xr::Session<xr::Vulkan>,
    runtime: XrRuntime,
    // Kept until the session is gone.
    device: wgpu::Device,
}

/// Frame that the runtime waits for.
pub struct HeadsetTurn {
    /// Head and hands at the time at which the frame will be seen.
    pub report: XrReport,
    /// What each eye sees of the head's surroundings, left and right.
    pub eyes: [HeadsetEye; 2],
    /// True if the frame will be seen.
    pub is_seen: bool,
    /// True if the runtime sees the head. The place of one that tracks turns alone is always made up.
    pub sees_head: bool,
    /// Time from one frame of the headset to the next.
    pub period: Duration,
    predicted: xr::Time,
    views: Vec<xr::View>,
}

impl Headset {
    /// Begins a session on the runtime's device.
    ///
    /// # Errors
    /// A runtime that refuses, or takes no pictures of a usual format.
    pub fn new(runtime: XrRuntime, device: &HeadsetDevice) -> Result<Self, HeadsetError> {
        let refused = runtime.refused("a session");
        // SAFETY: the handles are those of the runtime's own device, which outlives the session.
        let made = unsafe { runtime.instance.create_session::<xr::Vulkan>(runtime.system, &device.handles) };
        let (session, waiter, stream) = made.map_err(&refused)?;
        let hands = XrHands::new(&runtime, &session)?;
        let head =
            session.create_reference_space(xr::ReferenceSpaceType::VIEW, xr::Posef::IDENTITY).map_err(&refused)?;
        let formats = session.enumerate_swapchain_formats().map_err(&refused)?;
        let known = |(format, _): &(vk::Format, _)| formats.contains(&(format.as_raw() as u32));
        let (raw_format, format) = FORMATS.into_iter().find(known).ok_or(HeadsetError::Format)?;
        let views = runtime
            .instance
            .enumerate_view_configuration_views(runtime.system, VIEWS)
            .map_err(runtime.refused("its views"))?;
        let [left, right] = views.as_slice() else { return Err(HeadsetError::Views(views.len())) };
        let pictures = |view: &xr::ViewConfigurationView| {
            let size = [view.recommended_image_rect_width, view.recommended_image_rect_height];
            EyePictures::new(&session, device, size, (raw_format, format)).map_err(&refused)
        };
        let eyes = [pictures(left)?, pictures(right)?];
        let blends = runtime.instance.enumerate_environment_blend_modes(runtime.system, VIEWS).map_err(&refused)?;
        let blend = blends.first().copied().unwrap_or(xr::EnvironmentBlendMode::OPAQUE);
        let device = device.gpu.device.clone();
        let state = XrState::default();
        drop(refused);
        Ok(Self {
            eyes,
            hands,
            head,
            waiter,
            stream,
            blend,
            format,
            state,
            was_placed: false,
            session,
            runtime,
            device,
        })
    }

    /// Format in which the pictures are written: sRGB as it is stored. The runtime reads the same bytes as sRGB.
    pub fn format(&self) -> wgpu::TextureFormat {
        self.format.remove_srgb_suffix()
    }

    /// Widths and heights of the left and the right eye's picture, pixels.
    pub fn sizes(&self) -> [[u32; 2]; 2] {
        [self.eyes[0].size, self.eyes[1].size]
    }

    /// Names of the headset and of its runtime.
    pub fn names(&self) -> (String, &str) {
        (self.runtime.headset(), self.runtime.name())
    }

    /// Waits until the runtime wants a frame; `None` while the headset rests, after a short pause. A turn that is given
    /// must be [shown](Self::show).
    ///
    /// # Errors
    /// A session that has ended.
    pub fn wait(&mut self) -> Result<Option<HeadsetTurn>, HeadsetError> {
        self.runtime.follow(&self.session, &mut self.state)?;
        if self.state == XrState::Idle {
            std::thread::sleep(REST);
            return Ok(None);
        }
        let refused = self.runtime.refused("a frame");
        let frame = self.waiter.wait().map_err(&refused)?;
        self.stream.begin().map_err(&refused)?;
        let predicted = frame.predicted_display_time;
        let report = self.hands.report(&self.runtime, &self.session, predicted)?;
        let locate = |space: &xr::Space| self.session.locate_views(VIEWS, predicted, space).map_err(&refused);
        let (of_head, (flags, views)) = (locate(&self.head)?.1, locate(self.hands.stage())?);
        let is_placed = flags.contains(xr::ViewStateFlags::POSITION_TRACKED);
        self.was_placed |= is_placed;
        let known = xr::ViewStateFlags::POSITION_VALID | xr::ViewStateFlags::ORIENTATION_VALID;
        let sees_head = flags.contains(known) && (is_placed || !self.was_placed);
        let [left, right] = of_head.as_slice() else { return Err(HeadsetError::Views(of_head.len())) };
        let eyes = [eye(left), eye(right)];
        let period =
            u64::try_from(frame.predicted_display_period.as_nanos()).map_or(Duration::ZERO, Duration::from_nanos);
        Ok(Some(HeadsetTurn { report, eyes, is_seen: frame.should_render, sees_head, period, predicted, views }))
    }

    /// Shows a turn: `draw` draws and submits the picture of an eye, 0 left and 1 right, and leaves it as a target. It
    /// writes sRGB as it is stored.
    ///
    /// # Errors
    /// A session that has ended.
    pub fn show(
        &mut self,
        turn: &HeadsetTurn,
        mut draw: impl FnMut(usize, &wgpu::TextureView),
    ) -> Result<(), HeadsetError> {
        let refused = self.runtime.refused("a picture");
        if !turn.is_seen {
            return Ok(self.stream.end(turn.predicted, self.blend, &[]).map_err(&refused)?);
        }
        for (number, eye) in self.eyes.iter_mut().enumerate() {
            let image = eye.chain.acquire_image().map_err(&refused)?;
            eye.chain.wait_image(xr::Duration::INFINITE).map_err(&refused)?;
            draw(number, &eye.views[image as usize]);
            eye.chain.release_image().map_err(&refused)?;
        }
        let views: Vec<_> = turn.views.iter().zip(&self.eyes).map(|(view, eye)| eye.shown(view)).collect();
        let layer = xr::CompositionLayerProjection::new().space(self.hands.stage()).views(&views);
        Ok(self.stream.end(turn.predicted, self.blend, &[&layer]).map_err(&refused)?)
    }
}

impl Drop for Headset {
    /// Waits for what is still drawn into the runtime's images, which go with the session.
    fn drop(&mut self) {
        let _ = self.device.poll(wgpu::PollType::wait_indefinitely());
    }
}

impl EyePictures {
    fn new(
        session: &xr::Session<xr::Vulkan>,
        device: &HeadsetDevice,
        size: [u32; 2],
        (raw_format, format): (vk::Format, wgpu::TextureFormat),
    ) -> xr::Result<Self> {
        let usage = xr::SwapchainUsageFlags::COLOR_ATTACHMENT | xr::SwapchainUsageFlags::TRANSFER_SRC;
        let chain = session.create_swapchain(&xr::SwapchainCreateInfo {
            create_flags: xr::SwapchainCreateFlags::EMPTY,
            usage_flags: usage | xr::SwapchainUsageFlags::MUTABLE_FORMAT,
            format: raw_format.as_raw() as u32,
            sample_count: 1,
            width: size[0],
            height: size[1],
            face_count: 1,
            array_size: 1,
            mip_count: 1,
        })?;
        let extent = wgpu::Extent3d { width: size[0], height: size[1], depth_or_array_layers: 1 };
        let written = format.remove_srgb_suffix();
        let view = |image: u64| {
            let described = hal::TextureDescriptor {
                label: Some("eye"),
                size: extent,
                mip_level_count: 1,
                sample_count: 1,
                dimension: wgpu::TextureDimension::D2,
                format,
                usage: wgpu::TextureUses::COLOR_TARGET | wgpu::TextureUses::COPY_SRC,
                memory_flags: hal::MemoryFlags::empty(),
                view_formats: vec![written],
            };
            let descriptor = wgpu::TextureDescriptor {
                label: Some("eye"),
                size: extent,
                mip_level_count: 1,
                sample_count: 1,
                dimension: wgpu::TextureDimension::D2,
                format,
                usage: wgpu::TextureUsages::RENDER_ATTACHMENT | wgpu::TextureUsages::COPY_SRC,
                view_formats: &[written],
            };
            // SAFETY: the image is the runtime's, of this size, format and use, on this device; the callback keeps wgpu
            // from destroying it, and the texture is dropped before the chain. The runtime hands images over, and
            // wants them back, as colour targets.
            let texture = unsafe {
                let hal_device = device.gpu.device.as_hal::<Vulkan>()?;
                let raw = vk::Image::from_raw(image);
                let kept: hal::DropCallback = Box::new(|| {});
                let made =
                    hal_device.texture_from_raw(raw, &described, Some(kept), hal::vulkan::TextureMemory::External);
                let state = wgpu::TextureUses::COLOR_TARGET;
                device.gpu.device.create_texture_from_hal::<Vulkan>(made, &descriptor, state)
            };
            Some(texture.create_view(&wgpu::TextureViewDescriptor { format: Some(written), ..Default::default() }))
        };
        let images = chain.enumerate_images()?;
        let views: Option<Vec<_>> = images.into_iter().map(view).collect();
        Ok(Self { views: views.ok_or(xr::sys::Result::ERROR_GRAPHICS_DEVICE_INVALID)?, chain, size })
    }

    /// The eye's picture as it was seen from a view.
    fn shown(&self, view: &xr::View) -> xr::CompositionLayerProjectionView<'_, xr::Vulkan> {
        let [width, height] = self.size.map(|side| i32::try_from(side).unwrap_or(i32::MAX));
        let rect = xr::Rect2Di { offset: xr::Offset2Di { x: 0, y: 0 }, extent: xr::Extent2Di { width, height } };
        let image = xr::SwapchainSubImage::new().swapchain(&self.chain).image_array_index(0).image_rect(rect);
        xr::CompositionLayerProjectionView::new().pose(view.pose).fov(view.fov).sub_image(image)
    }
}

/// Eye of the head, from the runtime's view of it. Angles to the left and down are negative.
fn eye(view: &xr::View) -> HeadsetEye {
    let xr::Posef { position: at, orientation: turn } = view.pose;
    let tangents = |one: f32, other: f32| DVec2::new(f64::from(one).tan(), f64::from(other).tan());
    HeadsetEye {
        position_m: DVec3::new(at.x.into(), at.y.into(), at.z.into()),
        orientation: DQuat::from_xyzw(turn.x.into(), turn.y.into(), turn.z.into(), turn.w.into()).normalize(),
        low: tangents(view.fov.angle_left, view.fov.angle_down),
        high: tangents(view.fov.angle_right, view.fov.angle_up),
    }
}
