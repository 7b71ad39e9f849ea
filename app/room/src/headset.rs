//! Headset as a display: a screen for each eye that moves and turns with the head.

use crate::channel::{Channel, ChannelPart};
use crate::display::{Display, Screen};
use crate::reflection::Reflection;
use crate::surface::FlatSurface;
use crate::surface::shape::ScreenSurface;
use crate::viewer::{EYE_SEPARATION_M, EyeSide, Viewer};
use crate::window::{Combine, WindowPlace};
use glam::{DMat3, DQuat, DVec2, DVec3};

/// Distance of the screens from the eyes, metres. Directions alone count.
const DISTANCE_M: f64 = 1.0;
/// Eyes of a headset, in the order of its screens.
const SIDES: [EyeSide; 2] = [EyeSide::Left, EyeSide::Right];

/// Eye of a headset, and the part of its surroundings that its picture shows.
///
/// *Frame*: the head's axes (x right, y up, −z ahead), whose origin is midway between the eyes; metres.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct HeadsetEye {
    /// Place of the eye.
    pub position_m: DVec3,
    /// Turn `head_from_eye`; the picture is ahead of the eye, along its −z.
    pub orientation: DQuat,
    /// Tangents of the angles from straight ahead to the picture's left and lower edge; negative to the left and down.
    pub low: DVec2,
    /// Tangents of the angles to the right and the upper edge.
    pub high: DVec2,
}

impl HeadsetEye {
    /// Eyes of a headset that has not said anything yet: 64 mm apart, 90° wide and high.
    pub const USUAL: [Self; 2] = [Self::usual(-1.0), Self::usual(1.0)];

    const fn usual(side: f64) -> Self {
        Self {
            position_m: DVec3::new(0.5 * EYE_SEPARATION_M * side, 0.0, 0.0),
            orientation: DQuat::IDENTITY,
            low: DVec2::NEG_ONE,
            high: DVec2::ONE,
        }
    }
}

impl Display {
    /// Display of a headset whose left and right picture have these sizes in pixels: a window for each eye.
    pub fn headset(name: &str, eyes: &[HeadsetEye; 2], sizes: [[u32; 2]; 2]) -> Self {
        let viewer = Viewer { turns_pictures: true, ..Viewer::default() };
        let screen = |side: EyeSide| Screen {
            name: side.name().to_owned(),
            surface: ScreenSurface::Flat(FlatSurface {
                lower_left: DVec3::new(-1.0, -1.0, -1.0),
                right: 2.0 * DVec3::X,
                up: 2.0 * DVec3::Y,
            }),
            reflection: Reflection::default(),
        };
        let window = |(side, size): (EyeSide, [u32; 2])| WindowPlace {
            name: side.name().to_owned(),
            monitor: None,
            position: None,
            size,
            fullscreen: false,
            combine: Combine::None,
            swap_eyes: false,
        };
        let channel = |(number, side): (usize, EyeSide)| Channel {
            name: side.name().to_owned(),
            screen: number,
            eye: side,
            window: number,
            viewport: [0, 0, sizes[number][0], sizes[number][1]],
            part: ChannelPart::default(),
            warp: None,
            projector: None,
            alpha: None,
            beta: None,
        };
        let mut display = Self {
            name: name.to_owned(),
            viewer,
            screens: SIDES.map(screen).to_vec(),
            projectors: Vec::new(),
            windows: SIDES.into_iter().zip(sizes).map(window).collect(),
            channels: SIDES.into_iter().enumerate().map(channel).collect(),
            set_up: toml::Table::new(),
            notices: Vec::new(),
        };
        display.follow_head(eyes, viewer.head_m);
        display
    }

    /// Puts the screens of a [headset](Self::headset) before its eyes, for a head at this place in the room.
    pub fn follow_head(&mut self, eyes: &[HeadsetEye; 2], head_m: DVec3) {
        self.viewer.eye_separation_m = eyes[1].position_m.x - eyes[0].position_m.x;
        for ((screen, side), eye) in self.screens.iter_mut().zip(SIDES).zip(eyes) {
            let HeadsetEye { orientation, low, high, .. } = eye;
            // The display looks ahead; its pictures are turned with the head.
            let place_m = self.viewer.eye_m(side, head_m, DMat3::IDENTITY);
            let size = (*high - *low) * DISTANCE_M;
            screen.surface = ScreenSurface::Flat(FlatSurface {
                lower_left: place_m + *orientation * (DVec3::new(low.x, low.y, -1.0) * DISTANCE_M),
                right: *orientation * (DVec3::X * size.x),
                up: *orientation * (DVec3::Y * size.y),
            });
        }
    }
}

#[cfg(test)]
mod tests {
    //! Law: the frustum of each eye of a headset is the one that the runtime asks for, wherever the head is.

    use super::*;
    use crate::frustum::frustum;

    #[test]
    fn each_eyes_frustum_is_the_one_that_was_asked_for() {
        let eye = |side: f64, yaw: f64| HeadsetEye {
            position_m: DVec3::new(0.0315 * side, 0.0, 0.0),
            orientation: DQuat::from_rotation_y(yaw),
            low: DVec2::new(-1.1 - 0.1 * side, -0.9),
            high: DVec2::new(0.95 - 0.1 * side, 1.2),
        };
        let eyes = [eye(-1.0, 0.1), eye(1.0, -0.1)];
        let mut display = Display::headset("headset", &eyes, [[320, 240]; 2]);
        for head_m in [display.viewer.head_m, DVec3::new(-0.7, 1.1, 2.0)] {
            display.follow_head(&eyes, head_m);
            for (channel, eye) in display.channels.iter().zip(&eyes) {
                let place_m = display.viewer.eye_m(channel.eye, head_m, DMat3::IDENTITY);
                assert!((place_m - head_m - eye.position_m).length() < 1e-12);
                let found = frustum(&channel.flat(&display).unwrap(), place_m).unwrap();
                assert!((found.tangents.low - eye.low).length() < 1e-12);
                assert!((found.tangents.high - eye.high).length() < 1e-12);
                let ahead = found.room_from_eye * DVec3::NEG_Z;
                assert!((ahead - eye.orientation * DVec3::NEG_Z).length() < 1e-12, "{ahead}");
            }
        }
    }
}
