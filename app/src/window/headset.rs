//! The headset in which a ride is shown, and its left picture in the window.

use super::surface_interface::SurfaceInterface;
use crate::canvas::Canvas;
use crate::error::Error;
use crate::output::say::tell;
use command::{FrameRate, HEADSET};
use egui::load::SizedTexture;
use egui::{Color32, LayerId, Pos2, Rect, Ui, Vec2};
use headset::{HeadFade, Headset, HeadsetDevice, HeadsetError};
use input::decoder::{Actions, Decoder};
use input::head::{Recentring, TrackedHead};
use input::openxr::{OpenxrDecoder, XrReport, XrRuntime, XrUse};
use input::{Action, HeadConfig, HeadState, Nanos, TrackerUrl};
use render::Gpu;
use render::display::Development;
use render::target::texture;
use room::{Display, HeadsetEye};
use std::time::Instant;
use walls::Walls;

/// Headset that is worn, or was.
pub(super) struct Worn {
    /// Session of the headset; `None` once it has ended.
    pub(super) session: Option<Headset>,
    /// True if the channels are drawn for its views, false if for a window alone.
    pub(super) is_drawn_for: bool,
    /// Report of the last turn, until the headset rests.
    pub(super) last: Option<XrReport>,
    /// Copy of the left eye's picture, for the window.
    mirror: Option<(wgpu::TextureView, egui::TextureId)>,
    format: wgpu::TextureFormat,
    /// Head of whoever watches a recorded ride in it.
    pub(super) viewer: HeadsetViewer,
    /// Fade of its pictures while the head is not seen.
    pub(super) fade: HeadFade,
}

/// Head of whoever wears the headset, where no ride asks for it.
pub(super) struct HeadsetViewer {
    decoder: OpenxrDecoder,
    head: TrackedHead,
    began: Instant,
}

/// Reaches the headset, with the frame rate that was asked for. Returns the device that its runtime wants, and the
/// display of its eyes. `head`: how a rider's head is tracked in it.
///
/// # Errors
/// What is missing, with what to do about it.
pub(super) fn wear(frame_rate: Option<FrameRate>, head: Option<&HeadConfig>) -> Result<(Gpu, Worn, Display), Error> {
    let runtime = XrRuntime::new(XrUse::Pictures).map_err(HeadsetError::from)?;
    let device = HeadsetDevice::open(&runtime)?;
    let session = Headset::new(runtime, &device)?;
    let (headset, runtime) = session.names();
    tell(format_args!("headset: {headset}, by {runtime}"));
    if let Some(FrameRate::Held(wanted)) = frame_rate {
        match session.choose_rate(wanted) {
            Err(error) => tell(format_args!("headset: its frame rate stays as it is: {error}")),
            Ok(Some(rate)) => tell(format_args!("headset: {rate} frames per second")),
            Ok(None) => {
                tell(format_args!("headset: {runtime} sets its frame rate by itself; --frame-rate is left out"));
            }
        }
    }
    let sizes = session.sizes();
    let display = Display::headset(HEADSET, &HeadsetEye::usual(sizes.len()), sizes);
    let format = session.format();
    let viewer = HeadsetViewer::new(&display, head)?;
    let (session, last, mirror, fade) = (Some(session), None, None, HeadFade::default());
    Ok((device.gpu, Worn { session, is_drawn_for: false, last, mirror, format, viewer, fade }, display))
}

impl HeadsetViewer {
    /// Head that begins in the driver's seat, with the comfort of the settings of a rider's head.
    fn new(display: &Display, rider: Option<&HeadConfig>) -> Result<Self, Error> {
        let (home, recentre) = (display.viewer.head_m.to_array(), Recentring::Start);
        let usual = HeadConfig { home, recentre, ..HeadConfig::new(TrackerUrl::Openxr) };
        let config = match rider {
            Some(HeadConfig { stance, snap_turn_deg, wand, .. }) => {
                HeadConfig { stance: *stance, snap_turn_deg: *snap_turn_deg, wand: wand.clone(), ..usual }
            }
            None => usual,
        };
        let decoder = OpenxrDecoder::of_head(&config);
        Ok(Self { decoder, head: TrackedHead::new(config)?, began: Instant::now() })
    }

    /// Settings of the head at present.
    pub(super) fn config(&self) -> &HeadConfig {
        self.head.config()
    }

    /// Carries out an action that concerns the head.
    pub(super) fn act(&mut self, action: &Action) {
        match action {
            Action::Stance(stance) => self.head.take_stance(*stance),
            Action::SnapTurn(degrees) => self.head.snap_by(*degrees),
            Action::Recentre => self.head.recentre(),
            _ => {}
        }
    }

    /// State of the head after a report.
    fn follow(&mut self, report: &[u8]) -> HeadState {
        let at = self.began.elapsed().as_nanos() as Nanos;
        self.decoder.bytes(at, report, &mut Actions::default());
        if self.decoder.take_moved() {
            self.head.axes_moved();
        }
        self.decoder.take_poses().iter().for_each(|pose| self.head.pose(pose));
        self.head.snap_turn(self.decoder.take_flicks());
        self.head.state(at)
    }
}

impl Worn {
    /// State of the head of whoever wears the headset, after a report.
    pub(super) fn follow(&mut self, report: &[u8]) -> HeadState {
        self.viewer.follow(report)
    }

    /// Draws the channels for its views from now on: without what no lens shows, and with the depth that the runtime
    /// takes.
    pub(super) fn fit(&mut self, gpu: &Gpu, walls: &mut Walls) {
        let Some(session) = &self.session else { return };
        walls.headset.get_or_insert_with(|| HeadsetEye::usual(session.sizes().len()));
        if session.takes_depth() {
            walls.keep_depth(gpu);
        }
        (0..session.sizes().len()).for_each(|view| walls.hide(gpu, view, &session.hidden(view)));
        self.is_drawn_for = true;
    }

    /// Draws the channels for a window or a photo alone from now on.
    pub(super) fn leave(&mut self, walls: &mut Walls) {
        walls.show_whole();
        self.is_drawn_for = false;
    }

    /// Format in which its pictures are written.
    pub(super) fn format(&self) -> wgpu::TextureFormat {
        self.format
    }

    /// Copies the left eye's picture for the window.
    pub(super) fn copy(
        &mut self,
        gpu: &Gpu,
        encoder: &mut wgpu::CommandEncoder,
        (canvas, development): (&mut Canvas, &Development),
        interface: &mut SurfaceInterface,
    ) -> Option<SizedTexture> {
        let size = canvas.first_window_size()?;
        let (view, id) = self.mirror.get_or_insert_with(|| {
            let usage = wgpu::TextureUsages::RENDER_ATTACHMENT | wgpu::TextureUsages::TEXTURE_BINDING;
            let view = texture(gpu, "mirror", size, self.format, 1, usage);
            let id = interface.register(gpu, &view);
            (view, id)
        });
        canvas.show(gpu, encoder, 0, development, view, [0, 0]);
        Some(SizedTexture::new(*id, size.map(|side| side as f32)))
    }
}

/// Shows the left eye's picture in the window, whole.
pub(super) fn mirror(ui: &Ui, picture: SizedTexture) {
    let screen = ui.ctx().content_rect();
    let scale = (screen.size() / picture.size).min_elem();
    let place = Rect::from_center_size(screen.center(), picture.size * scale);
    let whole = Rect::from_min_size(Pos2::ZERO, Vec2::splat(1.0));
    ui.ctx().layer_painter(LayerId::background()).image(picture.id, place, whole, Color32::WHITE);
}

#[cfg(test)]
mod tests {
    //! Law: whoever watches a recorded ride in a headset begins in the driver's seat, wherever the headset is, and
    //! looks and moves from there as the headset does; a recentring of its runtime makes the present place the seat.
    #![allow(clippy::unwrap_used, reason = "a failed construction is a failed test")]

    use super::*;
    use glam::{DQuat, DVec3};
    use input::WandConfig;
    use input::head::Stance;
    use input::openxr::{XrHand, XrPose};

    fn report(time_ns: i64, place: [f32; 3], turn: DQuat) -> Vec<u8> {
        let orientation = Some(turn.to_array().map(|part| part as f32));
        let head = XrPose { position_m: Some(place), orientation, ..XrPose::default() };
        // The left hand is in use, and held before the eyes.
        let hands = [XrHand { pose: head, ..XrHand::default() }, XrHand::default()];
        XrReport { time_ns, head, hands, ..XrReport::default() }.to_bytes()
    }

    #[test]
    fn a_viewer_begins_in_the_seat_and_looks_round_from_there() {
        let display = Display::headset(HEADSET, &HeadsetEye::usual(2), &[[64; 2]; 2]);
        let rider = HeadConfig {
            snap_turn_deg: 90.0,
            wand: Some(WandConfig { sensor: 2, ..WandConfig::default() }),
            ..HeadConfig::new(TrackerUrl::Openxr)
        };
        let mut viewer = HeadsetViewer::new(&display, Some(&rider)).unwrap();
        let quarter = DQuat::from_rotation_y(std::f64::consts::FRAC_PI_2);
        let first = viewer.follow(&report(0, [3.0, 1.2, -5.0], quarter));
        assert!((first.position_m - display.viewer.head_m).length() < 1e-6, "{first:?}");
        assert!((first.orientation * DVec3::NEG_Z - DVec3::NEG_Z).length() < 1e-6, "{first:?}");
        // A step ahead, which is to the left of the runtime's room, and a look to the left.
        std::thread::sleep(std::time::Duration::from_millis(2));
        let turned = quarter * DQuat::from_rotation_y(0.5);
        let next = viewer.follow(&report(50_000_000, [2.9, 1.2, -5.0], turned));
        let moved = next.position_m - first.position_m;
        assert!((moved - DVec3::new(0.0, 0.0, -0.1)).length() < 1e-6, "{moved}");
        let ahead = DQuat::from_rotation_y(0.5) * DVec3::NEG_Z;
        assert!((next.orientation * DVec3::NEG_Z - ahead).length() < 1e-6, "{next:?}");
        // The left stick's flick turns the viewer, too, and the viewer may stand.
        let mut flicked = XrReport::from_bytes(&report(100_000_000, [2.9, 1.2, -5.0], turned)).unwrap();
        flicked.hands[0].axes[0] = -1.0;
        std::thread::sleep(std::time::Duration::from_millis(2));
        let left = viewer.follow(&flicked.to_bytes());
        assert!((left.position_m - next.position_m).length() < 1e-6, "{left:?}");
        let ahead = DQuat::from_rotation_y(std::f64::consts::FRAC_PI_2) * ahead;
        assert!((left.orientation * DVec3::NEG_Z - ahead).length() < 1e-6, "{left:?}");
        // The runtime moves its stage by a step that a head could make.
        std::thread::sleep(std::time::Duration::from_millis(2));
        let mut moved = XrReport::from_bytes(&report(150_000_000, [2.8, 1.2, -5.0], turned)).unwrap();
        moved.stage_moves = 1;
        let seat = viewer.follow(&moved.to_bytes());
        assert!((seat.position_m - display.viewer.head_m).length() < 1e-6, "{seat:?}");
        assert!((seat.orientation * DVec3::NEG_Z - DVec3::NEG_Z).length() < 1e-6, "{seat:?}");
        assert_eq!(seat.velocity_m_s, DVec3::ZERO);
        // The straight pose is wherever the viewer says.
        std::thread::sleep(std::time::Duration::from_millis(2));
        let mut stepped = XrReport::from_bytes(&report(200_000_000, [2.8, 1.2, -4.95], turned)).unwrap();
        stepped.stage_moves = 1;
        let aside = viewer.follow(&stepped.to_bytes());
        assert!((aside.position_m - display.viewer.head_m).length() > 0.04, "{aside:?}");
        viewer.act(&Action::Recentre);
        assert!((viewer.head.state(0).position_m - display.viewer.head_m).length() < 1e-6);
        viewer.act(&Action::Stance(Stance::Standing));
        assert!((viewer.head.state(0).position_m.y - 1.2).abs() < 1e-6);
    }
}
