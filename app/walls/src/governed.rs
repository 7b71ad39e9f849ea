//! Room that holds its frame rate: its channels are drawn with a share of their pixels, and with more when nothing
//! changes.

use crate::picture_shares::{Drawing, PictureShares};
use crate::room_rest::RoomRest;
use crate::walls::{SubmittedRoom, Walls};
use render::{Gpu, GpuError, SceneRenderer};

impl Walls {
    /// Changes the shares of the channels' width and height that are drawn. Light that is kept exactly, as stills need
    /// it, is always drawn to the full.
    pub fn set_shares(&mut self, shares: PictureShares) {
        if self.enlarger.is_some() {
            self.shares = shares;
        }
    }

    /// Share of the channels' width and height that the frame drawn last has.
    pub fn share(&self) -> f64 {
        self.share
    }

    /// Way in which the frame was drawn last. A room at rest with no more pixels than in motion counts as moving; test
    /// grids are at rest.
    pub fn drawing(&self) -> Drawing {
        if self.rests || self.grids.is_some() { Drawing::Resting } else { Drawing::Moving }
    }

    /// Draws the frame drawn last with every pixel of the channels, unless it has them all.
    ///
    /// # Errors
    /// [`GpuError::Lost`] if the device went away.
    pub fn draw_whole(&mut self, gpu: &Gpu, renderer: &mut SceneRenderer) -> Result<(), GpuError> {
        let Some((occupant, effects)) = self.shown.filter(|_| self.share < 1.0) else { return Ok(()) };
        let shares = std::mem::take(&mut self.shares);
        let drawn = self.submit(gpu, renderer, &occupant, effects).and_then(|room| self.draw(gpu, renderer, room));
        self.shares = shares;
        drawn.map(drop)
    }

    /// Fits the targets of all channels to the share with which this room is drawn.
    pub(crate) fn fit(&mut self, gpu: &Gpu, renderer: &SceneRenderer, room: &SubmittedRoom) {
        let eyes: Vec<_> = room.eyes.iter().map(|eye| eye.eye).collect();
        let rest = RoomRest::after(
            self.rest.take().filter(|rest| renderer.is_still() || rest.is_at(&eyes)),
            eyes,
            room.effects,
        );
        self.rests = rest.is_still() && self.shares.resting > self.shares.moving;
        self.rest = Some(rest);
        self.shown = Some((room.occupant, room.effects));
        self.share = if self.rests { self.shares.resting } else { self.shares.moving };
        for (channel, picture) in self.display.channels.iter().zip(&mut self.pictures) {
            picture.fit(gpu, &self.display, channel, self.share);
        }
    }
}
