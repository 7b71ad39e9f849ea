//! The life of the windows, from opening to closing.

use super::open::{Open, WaitingRide};
use crate::command::RideOptions;
use crate::error::Error;
use crate::session::live::Live;
use crate::session::start::RideRoom;
use scene::Scene;
use std::panic::AssertUnwindSafe;
use std::path::Path;
use std::sync::atomic::{AtomicBool, Ordering};
use winit::application::ApplicationHandler;
use winit::error::EventLoopError;
use winit::event::WindowEvent;
use winit::event_loop::{ActiveEventLoop, ControlFlow, EventLoop};
use winit::window::WindowId;

/// Function that begins the ride. It is called when everything else is ready, since the ride's clock starts with it.
pub type Begin = Box<dyn FnOnce() -> Result<Live, Error>>;

/// Opens the windows and rides until they are closed.
///
/// # Errors
/// A missing graphical session or graphics device, or a fault while riding.
pub fn run(options: &RideOptions, scene: Scene, room: RideRoom, begin: Begin) -> Result<(), Error> {
    let events = EventLoop::new().map_err(|error| Error::Window(error.to_string()))?;
    events.set_control_flow(ControlFlow::Wait);
    let waiting = Some(WaitingRide { scene, room, begin });
    let mut application = Application { options: options.clone(), waiting, open: None, failed: None };
    let ended = outlived(|| events.run_app(&mut application));
    // Whatever has ended the windows, the recording is completed.
    let finished = application.open.map_or(Ok(()), |mut open| Ok(open.ride.live.finish()?));
    ended?;
    application.failed.map_or(finished, Err)
}

/// Runs the windows. winit panics where it loses the display server, and such a panic is an error here.
fn outlived(run: impl FnOnce() -> Result<(), EventLoopError>) -> Result<(), Error> {
    static LOST: AtomicBool = AtomicBool::new(false);
    let usual = std::panic::take_hook();
    std::panic::set_hook(Box::new(move |panic| {
        if panic.location().is_some_and(|place| is_of_winit(place.file())) {
            LOST.store(true, Ordering::Relaxed);
        } else {
            usual(panic);
        }
    }));
    match std::panic::catch_unwind(AssertUnwindSafe(run)) {
        Ok(outcome) => outcome.map_err(|error| Error::Window(error.to_string())),
        Err(_) if LOST.load(Ordering::Relaxed) => Err(Error::WindowLost),
        Err(panic) => std::panic::resume_unwind(panic),
    }
}

/// True for a source file of winit.
fn is_of_winit(file: &str) -> bool {
    Path::new(file).components().any(|part| part.as_os_str().to_string_lossy().starts_with("winit-"))
}

/// State that winit calls.
struct Application {
    options: RideOptions,
    waiting: Option<WaitingRide>,
    open: Option<Open>,
    failed: Option<Error>,
}

impl ApplicationHandler for Application {
    fn resumed(&mut self, events: &ActiveEventLoop) {
        if let Some(waiting) = self.waiting.take() {
            match Open::new(events, &self.options, waiting) {
                Ok(open) => {
                    open.windows[0].window.request_redraw();
                    self.open = Some(open);
                }
                Err(error) => self.fail(events, error),
            }
        }
    }

    fn window_event(&mut self, events: &ActiveEventLoop, window: WindowId, event: WindowEvent) {
        let Some(open) = &mut self.open else { return };
        match open.event(events, window, event) {
            Ok(()) => {}
            Err(error) => self.fail(events, error),
        }
    }
}

impl Application {
    fn fail(&mut self, events: &ActiveEventLoop, error: Error) {
        self.failed.get_or_insert(error);
        events.exit();
    }
}
