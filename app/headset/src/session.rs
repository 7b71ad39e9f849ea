//! Session of a headset: its turns, and what it tells of itself.

use crate::device::HeadsetDevice;
use crate::error::HeadsetError;
use crate::pictures::{DEPTH_NEAR_M, TurnPictures, ViewPictures};
use ash::vk;
use glam::{DQuat, DVec2, DVec3};
use input::openxr::{XrHands, XrNews, XrReport, XrRuntime, XrState};
use openxr as xr;
use room::HeadsetEye;
use std::time::{Duration, Instant};
use walls::draws_views;

/// Numbers of views that are drawn: one for each eye, or two for each eye, of which one lies within the other.
const VIEW_COUNTS: [usize; 2] = [2, 4];
/// Formats of pictures that are taken, the best first.
const FORMATS: [(vk::Format, wgpu::TextureFormat); 2] = [
    (vk::Format::R8G8B8A8_SRGB, wgpu::TextureFormat::Rgba8UnormSrgb),
    (vk::Format::B8G8R8A8_SRGB, wgpu::TextureFormat::Bgra8UnormSrgb),
];
/// Pause of a turn while the headset rests.
const REST: Duration = Duration::from_millis(20);

/// Session of a headset. It must be dropped before the device.
pub struct Headset {
    pictures: Vec<ViewPictures>,
    sizes: Vec<[u32; 2]>,
    /// True if both eyes' pictures are shown in one pass. A caller may set it to false.
    pub in_one_pass: bool,
    hands: XrHands,
    head: xr::Space,
    waiter: xr::FrameWaiter,
    stream: xr::FrameStream<xr::Vulkan>,
    blend: xr::EnvironmentBlendMode,
    format: wgpu::TextureFormat,
    state: XrState,
    /// True if the parts that no lens shows have changed since the last turn.
    masks_changed: bool,
    /// Views of the head and of the stage as they were known last; a head that is out of sight keeps them.
    seen: [Vec<xr::View>; 2],
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
    /// What each view sees of the head's surroundings: left and right by turns.
    pub eyes: Vec<HeadsetEye>,
    /// True if the frame will be seen.
    pub is_seen: bool,
    /// True if the runtime sees the head. The place of one that tracks turns alone is always made up.
    pub sees_head: bool,
    /// Time from one frame of the headset to the next.
    pub period: Duration,
    /// Moment at which the pose was asked for.
    pub asked: Instant,
    /// Time from then until the frame is seen, if the runtime's clock can be read.
    pub lead: Option<Duration>,
    /// True if the parts that [no lens shows](Headset::hidden) have changed.
    pub masks_changed: bool,
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
            .enumerate_view_configuration_views(runtime.system, runtime.views)
            .map_err(runtime.refused("its views"))?;
        if !VIEW_COUNTS.contains(&views.len()) {
            return Err(HeadsetError::Views(views.len()));
        }
        let size =
            |view: &xr::ViewConfigurationView| [view.recommended_image_rect_width, view.recommended_image_rect_height];
        let sizes: Vec<_> = views.iter().map(size).collect();
        let with_depth = runtime.takes_depth && ViewPictures::takes_depth(&formats);
        let pictures =
            ViewPictures::of_views(&session, device, &sizes, (raw_format, format), with_depth).map_err(&refused)?;
        let blends =
            runtime.instance.enumerate_environment_blend_modes(runtime.system, runtime.views).map_err(&refused)?;
        let blend = blends.first().copied().unwrap_or(xr::EnvironmentBlendMode::OPAQUE);
        let in_one_pass = draws_views(&device.gpu);
        let device = device.gpu.device.clone();
        let (state, seen) = (XrState::default(), Default::default());
        drop(refused);
        Ok(Self {
            pictures,
            sizes,
            in_one_pass,
            hands,
            head,
            waiter,
            stream,
            blend,
            format,
            state,
            seen,
            masks_changed: false,
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

    /// Width and height of each view's picture, pixels: left and right by turns.
    pub fn sizes(&self) -> &[[u32; 2]] {
        &self.sizes
    }

    /// True if the runtime takes the depth of pictures.
    pub fn takes_depth(&self) -> bool {
        self.pictures.iter().all(ViewPictures::has_depth)
    }

    /// Triangles of a view's picture that no lens shows: the tangents of their corners to the right and up, three by
    /// three.
    pub fn hidden(&self, view: usize) -> Vec<[f32; 2]> {
        if !self.runtime.knows_masks {
            return Vec::new();
        }
        let kind = xr::VisibilityMaskTypeKHR::HIDDEN_TRIANGLE_MESH;
        let Ok(mask) = self.session.get_visibility_mask_khr(self.runtime.views, view as u32, kind) else {
            return Vec::new();
        };
        let corner = |index: &u32| mask.vertices.get(*index as usize).map(|corner| [corner.x, corner.y]);
        mask.indices
            .chunks_exact(3)
            .filter_map(|of| of.iter().map(corner).collect::<Option<Vec<_>>>())
            .flatten()
            .collect()
    }

    /// Frame rates between which the headset can choose, Hz; none if it cannot.
    pub fn rates(&self) -> Vec<f32> {
        if self.runtime.knows_rates {
            self.session.enumerate_display_refresh_rates().unwrap_or_default()
        } else {
            Vec::new()
        }
    }

    /// Asks the headset for the one of its frame rates that is nearest to `wanted_hz`. Returns that.
    ///
    /// # Errors
    /// A runtime that refuses.
    pub fn choose_rate(&self, wanted_hz: f64) -> Result<Option<f32>, HeadsetError> {
        let distance = |rate: &f32| (f64::from(*rate) - wanted_hz).abs();
        let nearest = self.rates().into_iter().min_by(|one, other| distance(one).total_cmp(&distance(other)));
        if let Some(rate) = nearest {
            self.session.request_display_refresh_rate(rate).map_err(self.runtime.refused("a frame rate"))?;
        }
        Ok(nearest)
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
        let XrNews { stage_moves, masks_changed } = self.runtime.follow(&self.session, &mut self.state)?;
        self.hands.stage_moves_at(stage_moves);
        self.masks_changed |= masks_changed;
        if self.state == XrState::Idle {
            std::thread::sleep(REST);
            return Ok(None);
        }
        let refused = self.runtime.refused("a frame");
        let frame = self.waiter.wait().map_err(&refused)?;
        self.stream.begin().map_err(&refused)?;
        let predicted = frame.predicted_display_time;
        let asked = Instant::now();
        let now = self.runtime.now();
        let report = self.hands.report(&self.runtime, &self.session, predicted)?;
        let locate =
            |space: &xr::Space| self.session.locate_views(self.runtime.views, predicted, space).map_err(&refused);
        let located = [locate(&self.head)?, locate(self.hands.stage())?];
        if let Some((_, views)) = located.iter().find(|(_, views)| views.len() != self.sizes.len()) {
            return Err(HeadsetError::Views(views.len()));
        }
        let flags = located[1].0;
        let is_placed = flags.contains(xr::ViewStateFlags::POSITION_TRACKED);
        self.was_placed |= is_placed;
        let known = xr::ViewStateFlags::ORIENTATION_VALID | xr::ViewStateFlags::POSITION_VALID;
        let sees_head = flags.contains(known) && (is_placed || !self.was_placed);
        if located.iter().all(|(flags, _)| flags.contains(known)) {
            self.seen = located.map(|(_, views)| views);
        }
        let [of_head, views] = self.seen.clone();
        let eyes = match of_head.as_slice() {
            [] => HeadsetEye::usual(self.sizes.len()),
            known => known.iter().map(eye).collect(),
        };
        let is_seen = frame.should_render && !views.is_empty();
        let duration = |nanoseconds: i64| u64::try_from(nanoseconds).ok().map(Duration::from_nanos);
        let period = duration(frame.predicted_display_period.as_nanos()).unwrap_or_default();
        let lead = now.and_then(|now| duration(predicted.as_nanos() - now.as_nanos()));
        let masks_changed = std::mem::take(&mut self.masks_changed);
        Ok(Some(HeadsetTurn { report, eyes, is_seen, sees_head, period, asked, lead, masks_changed, predicted, views }))
    }

    /// Shows a turn: `draw` draws and submits the pictures of one view or two, leaves them as targets, and returns true
    /// if it has drawn their depth.
    ///
    /// # Errors
    /// A session that has ended.
    pub fn show(
        &mut self,
        turn: &HeadsetTurn,
        mut draw: impl FnMut(&TurnPictures<'_>) -> bool,
    ) -> Result<(), HeadsetError> {
        let refused = self.runtime.refused("a picture");
        if !turn.is_seen {
            return Ok(self.stream.end(turn.predicted, self.blend, &[]).map_err(&refused)?);
        }
        let mut has_depth = !self.pictures.is_empty();
        for pictures in &mut self.pictures {
            has_depth &= pictures.lend(self.in_one_pass, &mut draw).map_err(&refused)?;
        }
        let parts = |depth: bool| {
            let of_view = |view: usize| {
                let pictures = self.pictures.iter().find(|of| (of.first..of.first + of.count).contains(&view))?;
                pictures.part(view - pictures.first, depth)
            };
            (0..turn.views.len()).map(of_view).collect::<Option<Vec<_>>>()
        };
        // Reversed depth: what is infinitely far has 0.
        let depth = |part: xr::SwapchainSubImage<'_, xr::Vulkan>| xr::sys::CompositionLayerDepthInfoKHR {
            ty: xr::sys::CompositionLayerDepthInfoKHR::TYPE,
            next: std::ptr::null(),
            sub_image: part.into_raw(),
            min_depth: 0.0,
            max_depth: 1.0,
            near_z: f32::INFINITY,
            far_z: DEPTH_NEAR_M as f32,
        };
        let depths: Vec<_> =
            parts(has_depth).filter(|_| has_depth).unwrap_or_default().into_iter().map(depth).collect();
        let parts = parts(false).unwrap_or_default();
        let number_and_view = turn.views.iter().zip(parts).enumerate();
        let views: Vec<_> =
            number_and_view.map(|(number, (view, part))| shown(view, part, depths.get(number))).collect();
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

/// Picture as it was seen from a view, with its depth.
fn shown<'a>(
    view: &xr::View,
    part: xr::SwapchainSubImage<'a, xr::Vulkan>,
    depth: Option<&'a xr::sys::CompositionLayerDepthInfoKHR>,
) -> xr::CompositionLayerProjectionView<'a, xr::Vulkan> {
    let shown = xr::CompositionLayerProjectionView::new().pose(view.pose).fov(view.fov).sub_image(part);
    let Some(depth) = depth else { return shown };
    let raw = xr::sys::CompositionLayerProjectionView { next: std::ptr::from_ref(depth).cast(), ..shown.into_raw() };
    // SAFETY: all that the view points to lives as long as the view may.
    unsafe { xr::CompositionLayerProjectionView::from_raw(raw) }
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
