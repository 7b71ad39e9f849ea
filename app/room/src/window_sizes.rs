//! Sizes of windows changed to those of a graphics device or a monitor, with everything in them to the same scale.

use crate::display::Display;
use crate::surface::{FlatSurface, ScreenSurface};
use glam::DVec2;

impl Display {
    /// Makes windows no larger than `limit` pixels a side, with everything in them to the same scale. Returns a
    /// sentence for each window that has become smaller.
    pub fn shrink_to(&mut self, limit: u32) -> Vec<String> {
        let mut notices = Vec::new();
        for index in 0..self.windows.len() {
            let [width, height] = self.windows[index].size;
            let smaller = [width.min(limit), height.min(limit)];
            if smaller != [width, height] {
                self.resize_window(index, smaller);
                notices.push(format!(
                    "window {:?}: {width} × {height} pixels are more than this graphics device can draw; it is {} × {} instead",
                    self.windows[index].name, smaller[0], smaller[1]
                ));
            }
        }
        notices
    }

    /// Gives a window another size, pixels, with everything in it to the same scale. A side of 0 counts as 1.
    pub fn resize_window(&mut self, window: usize, size: [u32; 2]) {
        let to = size.map(|side| side.max(1));
        let from = std::mem::replace(&mut self.windows[window].size, to);
        for channel in self.channels.iter_mut().filter(|channel| channel.window == window) {
            for axis in [0, 1] {
                // Edges that meet meet again, because both are rounded alike.
                let scaled = |edge: u32| (u64::from(edge) * u64::from(to[axis]) / u64::from(from[axis])) as u32;
                let [low, high] = [channel.viewport[axis], channel.viewport[axis] + channel.viewport[axis + 2]];
                let low = scaled(low).min(to[axis] - 1);
                channel.viewport[axis] = low;
                channel.viewport[axis + 2] = scaled(high).saturating_sub(low).max(1);
            }
        }
    }

    /// Lets windows fill their monitors: every one that has a monitor to itself, or is the only one. A window with a
    /// position stays where it is; it may span several monitors.
    pub fn fill_monitors(&mut self) {
        let monitors: Vec<_> = self.windows.iter().map(|window| window.monitor.clone()).collect();
        for window in &mut self.windows {
            let alone = monitors.iter().filter(|monitor| **monitor == window.monitor).count() == 1;
            window.fullscreen |= alone && window.position.is_none();
        }
    }

    /// Gives flat screens the shapes of the windows that they fill, at the same height round the same middle; for
    /// displays that nobody has measured.
    pub fn shape_screens_as_windows(&mut self) {
        for channel in &self.channels {
            let [width, height] = self.windows[channel.window].size;
            let fills = channel.viewport == [0, 0, width, height] && channel.part == Default::default();
            let ScreenSurface::Flat(flat) = &mut self.screens[channel.screen].surface else { continue };
            if fills && channel.warp.is_none() && channel.projector.is_none() {
                *flat = shaped(flat, f64::from(width) / f64::from(height));
            }
        }
    }
}

/// Screen of another ratio of width to height, at the same height round the same middle.
fn shaped(flat: &FlatSurface, ratio: f64) -> FlatSurface {
    let half = 0.5 * ratio * flat.size_m().y / flat.size_m().x;
    flat.part(DVec2::new(0.5 - half, 0.0), DVec2::new(0.5 + half, 1.0))
}
