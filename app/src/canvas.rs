//! Targets of a ride's frames: one flat picture, the surfaces of a room, or the room itself seen from outside.
//!
//! Each takes the same four steps for a frame. Photo-surfaces are submitted for its eyes. Its light is drawn. Its
//! viewer adapts. The developed light goes to windows.

use glam::{DMat3, DVec3};
use input::FreeLook;
use physics::worldline::{Thrust, WorldlineState};
use physics::{Celerity, Event, Observer};
use render::display::Development;
use render::{Gpu, GpuError, Pending, SceneRenderer};
use std::time::{Duration, Instant};
use view::{Camera, Effects, Gaze, OutsideView, Shot};
use walls::preview::{Preview, RoomOnlooker};
use walls::{Drawing, DrawnChannels, FlatPicture, Occupant, PictureShares, SubmittedRoom, Walls};

/// Target of a ride's frames.
pub enum Canvas {
    /// One flat picture, as the vehicle's driver sees it, in the only window.
    Picture(Box<FlatPicture>),
    /// Surfaces of a room in the vehicle, in as many windows as the display names.
    Room(Box<Walls>),
    /// The room itself, seen from outside, in one window.
    Preview(Box<RoomPreview>),
}

/// A room that is looked at from outside.
pub struct RoomPreview {
    /// Channels of the room.
    pub walls: Walls,
    preview: Preview,
    /// Point of view from outside.
    pub onlooker: RoomOnlooker,
    /// True while a mouse button turns the view.
    pub held: bool,
    occupant: Option<Occupant>,
}

/// Eyes of one frame, whose photo-surfaces are being computed.
#[must_use = "a frame that is not drawn was worked out in vain"]
pub enum Submitted {
    /// The eye of a flat picture.
    Picture {
        /// Picture that is to be drawn.
        shot: Box<Shot>,
        /// Photo-surface of its observer.
        pending: Pending,
    },
    /// Eyes of an occupant of a room.
    Room(Box<SubmittedRoom>),
}

/// Observer of one frame, in the vehicle and in its room.
#[derive(Clone, Copy, Debug)]
pub struct Watcher {
    /// View of a flat picture: along the vehicle's nose, turned by the rider's look.
    pub gaze: Gaze,
    /// Vehicle, and the head in it; a head at rest at the display's place if none is tracked.
    pub vehicle: WorldlineState,
    /// Acceleration and turn of the vehicle.
    pub thrust: Thrust,
    /// Head in the vehicle's room, if one is tracked.
    pub head: Option<walls::RoomHead>,
    /// Turn of a rider who looks round, whose head is not tracked. Screens that stand in the room know nothing of it.
    pub look: FreeLook,
    /// Camera outside of the eye, for a flat picture.
    pub outside: Option<OutsideView>,
}

impl Submitted {
    /// True if a photo-surface is being computed, false if the method needs none.
    pub fn is_under_way(&self) -> bool {
        match self {
            Self::Picture { pending, .. } => pending.is_under_way(),
            Self::Room(room) => room.is_under_way(),
        }
    }
}

impl Canvas {
    /// The room itself, seen from outside.
    pub fn preview(gpu: &Gpu, walls: Walls, screen: wgpu::TextureFormat) -> Self {
        let preview = Preview::new(gpu, &walls, screen);
        let onlooker = RoomOnlooker::outside(&walls);
        Self::Preview(Box::new(RoomPreview { walls, preview, onlooker, held: false, occupant: None }))
    }

    /// Channels of the room, if there is one.
    pub fn walls_mut(&mut self) -> Option<&mut Walls> {
        match self {
            Self::Picture(_) => None,
            Self::Room(walls) => Some(walls),
            Self::Preview(room) => Some(&mut room.walls),
        }
    }

    /// Changes the shares of the pictures' width and height that are drawn.
    pub fn set_shares(&mut self, shares: PictureShares) {
        match self {
            Self::Picture(picture) => picture.set_shares(shares),
            Self::Room(walls) => walls.set_shares(shares),
            Self::Preview(room) => room.walls.set_shares(shares),
        }
    }

    /// Share of the pictures' width and height that the frame drawn last has.
    pub fn share(&self) -> f64 {
        match self {
            Self::Picture(picture) => picture.share(),
            Self::Room(walls) => walls.share(),
            Self::Preview(room) => room.walls.share(),
        }
    }

    /// Size of the first window's picture, pixels; `None` for a room that is seen from outside.
    pub fn first_window_size(&self) -> Option<[u32; 2]> {
        match self {
            Self::Picture(picture) => Some(picture.size()),
            Self::Room(walls) => walls.display.windows.first().map(|window| window.size),
            Self::Preview(_) => None,
        }
    }

    /// Way in which the frame was drawn last.
    pub fn drawing(&self) -> Drawing {
        match self {
            Self::Picture(picture) => picture.drawing(),
            Self::Room(walls) => walls.drawing(),
            Self::Preview(room) => room.walls.drawing(),
        }
    }

    /// Begins anew, as if nothing had been drawn. `map_scale`: texels of a map for each pixel of a flat picture.
    pub fn begin_anew(&mut self, map_scale: f64) {
        match self {
            Self::Picture(picture) => {
                picture.set_map_scale(map_scale);
                picture.begin_anew();
            }
            Self::Room(walls) => walls.begin_anew(),
            Self::Preview(room) => room.walls.begin_anew(),
        }
    }

    /// Draws frames from the scene's start that nobody sees, so that the first frames of the ride wait for no pipeline,
    /// map or cut: its clock would run on meanwhile. Returns the time of the last of them, as it was drawn and shown.
    ///
    /// # Errors
    /// [`GpuError::Lost`] if the device went away.
    pub fn warm_up(
        &mut self,
        gpu: &Gpu,
        renderer: &mut SceneRenderer,
        start: &scene::Start,
        (effects, fov_deg, development): (Effects, f64, &Development),
        screens: &[wgpu::TextureView],
    ) -> Result<Duration, GpuError> {
        let orientation = Camera::looking(start.look, DVec3::Y, 1.0).observer_from_eye;
        let event = Event { ct: 0.0, position: start.eye() };
        let observer = Observer { event, celerity: Celerity::ZERO };
        let watcher = Watcher {
            gaze: Gaze { observer, observer_from_eye: orientation },
            vehicle: WorldlineState::new(event, Celerity::ZERO, orientation),
            thrust: Thrust::default(),
            head: None,
            look: FreeLook::default(),
            outside: None,
        };
        let mut took = Duration::ZERO;
        for _ in 0..2 {
            if let Self::Picture(picture) = self {
                picture.begin_anew();
            }
            let began = Instant::now();
            let submitted = self.submit(gpu, renderer, &watcher, effects, fov_deg)?;
            self.draw(gpu, renderer, submitted)?;
            self.adapt(gpu, development, None);
            let mut encoder = gpu.device.create_command_encoder(&Default::default());
            for (window, screen) in screens.iter().enumerate() {
                self.show(gpu, &mut encoder, window, development, screen, [0, 0]);
            }
            gpu.queue.submit([encoder.finish()]);
            gpu.wait()?;
            took = began.elapsed();
            renderer.settle();
        }
        Ok(took)
    }

    /// Begins the photo-surfaces of a frame, in parallel with other drawing. `fov_deg`: vertical field of view of a
    /// flat picture, degrees.
    ///
    /// # Errors
    /// [`GpuError::Lost`] if the device went away.
    pub fn submit(
        &mut self,
        gpu: &Gpu,
        renderer: &mut SceneRenderer,
        watcher: &Watcher,
        effects: Effects,
        fov_deg: f64,
    ) -> Result<Submitted, GpuError> {
        let Some(walls) = self.walls_mut() else {
            let shot = watcher.gaze.shot(fov_deg, effects);
            let shot = watcher.outside.map_or(shot, |outside| shot.from_outside(&outside));
            let pending = renderer.submit(gpu, &shot.observer, effects)?;
            return Ok(Submitted::Picture { shot: Box::new(shot), pending });
        };
        let head = watcher.head.unwrap_or_else(|| {
            let viewer = &walls.display.viewer;
            let looking = if viewer.turns_pictures { watcher.look } else { FreeLook::default() };
            let room_from_head = DMat3::from_quat(looking.nose_from_gaze());
            walls::RoomHead { room_from_head, ..walls::RoomHead::at_rest(viewer.head_m) }
        });
        let occupant = Occupant { vehicle: watcher.vehicle, thrust: watcher.thrust, head };
        Ok(Submitted::Room(Box::new(walls.submit(gpu, renderer, &occupant, effects)?)))
    }

    /// Draws the light of a frame.
    ///
    /// # Errors
    /// [`GpuError::Lost`] if the device went away.
    pub fn draw(
        &mut self,
        gpu: &Gpu,
        renderer: &mut SceneRenderer,
        submitted: Submitted,
    ) -> Result<DrawnChannels, GpuError> {
        match (self, submitted) {
            (Self::Picture(picture), Submitted::Picture { shot, pending }) => {
                picture.draw(gpu, renderer, &shot, pending)
            }
            (Self::Room(walls), Submitted::Room(room)) => walls.draw(gpu, renderer, *room),
            (Self::Preview(preview), Submitted::Room(room)) => {
                preview.occupant = Some(room.occupant);
                preview.walls.draw(gpu, renderer, *room)
            }
            // A frame is drawn on the canvas that it was submitted for.
            (_, _) => Ok(DrawnChannels::default()),
        }
    }

    /// Adapts the viewer to the light drawn last. `elapsed_s`: time to adapt, seconds; `None` adapts at once.
    pub fn adapt(&mut self, gpu: &Gpu, development: &Development, elapsed_s: Option<f64>) {
        match self {
            Self::Picture(picture) => picture.adapt(gpu, development, elapsed_s),
            Self::Room(walls) => walls.adapt(gpu, development, elapsed_s),
            Self::Preview(room) => room.walls.adapt(gpu, development, elapsed_s),
        }
    }

    /// Develops the light for window number `window`. `first_pixel`: place of the window's upper left pixel on its
    /// monitor.
    pub fn show(
        &mut self,
        gpu: &Gpu,
        encoder: &mut wgpu::CommandEncoder,
        window: usize,
        development: &Development,
        screen: &wgpu::TextureView,
        first_pixel: [i32; 2],
    ) {
        match self {
            Self::Picture(picture) => picture.show(gpu, encoder, development, screen),
            Self::Room(walls) => walls.show_window(gpu, encoder, window, development, screen, first_pixel),
            Self::Preview(room) => {
                let RoomPreview { walls, preview, onlooker, occupant, .. } = &mut **room;
                if let Some(occupant) = occupant {
                    preview.draw(gpu, encoder, walls, (occupant, onlooker), development, screen);
                }
            }
        }
    }
}
