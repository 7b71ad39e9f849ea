//! Another ride, or another way to draw the present one, made ready beside the ride that goes on meanwhile.

use crate::error::Error;
use crate::session::scenes;
use crate::session::start::RideRoom;
use crate::session::waiting::WaitingRide;
use command::{RideOptions, WorldOptions};
use render::choice::Choice;
use std::thread::JoinHandle;
use view::{Dial, Occasion};

/// Work of a thread of its own on what is shown next.
pub struct Making {
    /// What it is, for a sentence.
    pub what: String,
    /// True if the rider is told of it.
    pub is_told: bool,
    thread: JoinHandle<Result<Made, Error>>,
}

/// What is ready to be shown.
pub enum Made {
    /// Another ride, and the choice of its method of drawing, which has its scene.
    Ride(Box<WaitingRide>, Box<Choice>),
    /// The scene of the present ride for another method of drawing.
    Method(Box<Choice>),
}

impl Making {
    /// Begins to make another ride ready, to be drawn by `dial`.
    pub fn ride(what: String, options: RideOptions, room: RideRoom, dial: Dial) -> Self {
        let made = Self::begin(what, move || {
            let mut waiting = WaitingRide::of(&options, room)?;
            let choice = Choice::of(std::mem::take(&mut waiting.scene), dial, Occasion::Ride)?;
            Ok(Made::Ride(Box::new(waiting), Box::new(choice)))
        });
        made.told()
    }

    /// Begins to make a scene ready again, to be drawn by `dial`.
    pub fn method(world: WorldOptions, dial: Dial) -> Self {
        Self::begin(dial.to_string(), move || {
            let world = scenes::load(&world)?;
            Ok(Made::Method(Box::new(Choice::of(world.scene, dial, Occasion::Ride)?)))
        })
    }

    /// The same work, of which the rider is told.
    #[must_use]
    pub fn told(self) -> Self {
        Self { is_told: true, ..self }
    }

    fn begin(what: String, work: impl FnOnce() -> Result<Made, Error> + Send + 'static) -> Self {
        Self { what, is_told: false, thread: std::thread::spawn(work) }
    }

    /// True once the work is done.
    pub fn is_done(&self) -> bool {
        self.thread.is_finished()
    }

    /// Outcome of the work, for which this waits.
    ///
    /// # Errors
    /// The work's own.
    pub fn outcome(self) -> Result<Made, Error> {
        self.thread.join().unwrap_or_else(|panic| std::panic::resume_unwind(panic))
    }
}
