//! The life of the windows, from opening to closing.

use super::open::Open;
use crate::error::Error;
use crate::output::say::tell;
use crate::session::interrupt::interruption;
use crate::session::live::Live;
use crate::session::scenes;
use crate::session::waiting::WaitingRide;
use std::panic::AssertUnwindSafe;
use std::path::Path;
use std::sync::atomic::{AtomicBool, Ordering};
use std::sync::{Arc, Mutex, PoisonError};
use std::time::Duration;
use winit::application::ApplicationHandler;
use winit::error::EventLoopError;
use winit::event::WindowEvent;
use winit::event_loop::{ActiveEventLoop, ControlFlow, EventLoop};
use winit::window::WindowId;

/// Opens the windows and rides until they are closed.
///
/// # Errors
/// A missing graphical session or graphics device, or a fault while riding.
pub fn run(waiting: WaitingRide) -> Result<(), Error> {
    let events = EventLoop::new().map_err(|error| Error::Window(error.to_string()))?;
    events.set_control_flow(ControlFlow::Wait);
    let stranded = Stranded::default();
    let mut application = Application { waiting: Some(waiting), open: None, stranded, failed: None };
    let ended = outlived(|| events.run_app(&mut application));
    // Whatever has ended the windows, the recording is completed.
    let live = application.open.map(close).or_else(|| taken(&application.stranded));
    let finished = live.map_or(Ok(()), |mut live| Ok(live.finish()?));
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

/// Number of attempts to open the windows again after the loss of the graphics device, and the pause after each.
const ATTEMPTS: u32 = 30;
const ATTEMPT_PAUSE: Duration = Duration::from_secs(2);

/// Ride of windows that are closed, with all that they drew with.
fn close(open: Open) -> Live {
    open.ride.live
}

/// Ride whose windows are not open again yet.
type Stranded = Arc<Mutex<Option<Live>>>;

/// Ride that was stranded, if there is one.
fn taken(stranded: &Stranded) -> Option<Live> {
    stranded.lock().unwrap_or_else(PoisonError::into_inner).take()
}

/// State that winit calls.
struct Application {
    waiting: Option<WaitingRide>,
    open: Option<Open>,
    stranded: Stranded,
    failed: Option<Error>,
}

impl ApplicationHandler for Application {
    fn resumed(&mut self, events: &ActiveEventLoop) {
        if let Some(waiting) = self.waiting.take() {
            match Open::new(events, waiting) {
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
            Ok(()) if open.has_next() => self.show_next(events),
            Ok(()) => {}
            Err(error @ Error::Gpu(_)) if open.kiosk => self.reopen(events, error),
            Err(error) => self.fail(events, error),
        }
    }
}

impl Application {
    /// Shows in the windows what was made ready for them.
    fn show_next(&mut self, events: &ActiveEventLoop) {
        match self.open.take().map(Open::with_next) {
            Some(Ok(open)) => self.open = Some(open),
            Some(Err(error)) => self.fail(events, error),
            None => {}
        }
    }

    /// Opens the windows of a kiosk again after the loss of the graphics device. The ride goes on meanwhile.
    fn reopen(&mut self, events: &ActiveEventLoop, error: Error) {
        let Some(open) = self.open.take() else { return };
        tell(format_args!("{error}; the windows are opened again"));
        let (options, room, presentation) = (open.options.clone(), open.room.clone(), open.fresh);
        let mut live = close(open);
        live.fault(&error.to_string());
        *self.stranded.lock().unwrap_or_else(PoisonError::into_inner) = Some(live);
        let stop = interruption();
        for _ in 0..ATTEMPTS {
            let stranded = Arc::clone(&self.stranded);
            let begin = Box::new(move || taken(&stranded).ok_or(Error::WindowLost));
            let (options, room) = (options.clone(), room.clone());
            let opened = scenes::load(&options.world).map_err(Error::from).and_then(|world| {
                Open::new(events, WaitingRide { options, scene: world.scene, room, presentation, begin })
            });
            if let Ok(open) = opened {
                open.windows[0].window.request_redraw();
                self.open = Some(open);
                return;
            }
            if stop.load(Ordering::Relaxed) {
                break;
            }
            std::thread::sleep(ATTEMPT_PAUSE);
        }
        self.fail(events, error);
    }

    fn fail(&mut self, events: &ActiveEventLoop, error: Error) {
        self.failed.get_or_insert(error);
        events.exit();
    }
}
