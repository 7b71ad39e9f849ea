//! Windows that are larger than a graphics device can draw.

use crate::display::Display;

impl Display {
    /// Makes windows no larger than `limit` pixels a side, with everything in them to the same scale. Returns a
    /// sentence for each window that has become smaller.
    pub fn shrink_to(&mut self, limit: u32) -> Vec<String> {
        let before: Vec<[u32; 2]> = self.windows.iter().map(|window| window.size).collect();
        let mut notices = Vec::new();
        for window in &mut self.windows {
            let [width, height] = window.size;
            window.size = [width.min(limit), height.min(limit)];
            if window.size != [width, height] {
                notices.push(format!(
                    "window {:?}: {width} × {height} pixels are more than this graphics device can draw; it is {} × {} instead",
                    window.name, window.size[0], window.size[1]
                ));
            }
        }
        for channel in &mut self.channels {
            let (from, to) = (before[channel.window], self.windows[channel.window].size);
            for axis in [0, 1] {
                // Edges that meet meet again, because both are rounded alike.
                let scaled = |edge: u32| (u64::from(edge) * u64::from(to[axis]) / u64::from(from[axis])) as u32;
                let [low, high] = [channel.viewport[axis], channel.viewport[axis] + channel.viewport[axis + 2]];
                let low = scaled(low).min(to[axis] - 1);
                channel.viewport[axis] = low;
                channel.viewport[axis + 2] = scaled(high).saturating_sub(low).max(1);
            }
        }
        notices
    }
}
