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
/// Names of a headset's screens. Those of the second pair lie within the first, and are finer.
const NAMES: [&str; 4] = ["left", "right", "left-inset", "right-inset"];

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
    /// Views of a headset that has not said anything yet: left and right by turns, 64 mm apart, 90° wide and high.
    pub fn usual(views: usize) -> Vec<Self> {
        (0..views).map(|view| Self::usual_of(if view % 2 == 0 { -1.0 } else { 1.0 })).collect()
    }

    fn usual_of(side: f64) -> Self {
        Self {
            position_m: DVec3::new(0.5 * EYE_SEPARATION_M * side, 0.0, 0.0),
            orientation: DQuat::IDENTITY,
            low: DVec2::NEG_ONE,
            high: DVec2::ONE,
        }
    }
}

impl Display {
    /// Display of a headset whose pictures have these sizes in pixels, left and right by turns: a window for each.
    pub fn headset(name: &str, eyes: &[HeadsetEye], sizes: &[[u32; 2]]) -> Self {
        let viewer = Viewer { turns_pictures: true, ..Viewer::default() };
        let views: Vec<_> =
            sizes.iter().enumerate().map(|(view, size)| (view, NAMES[view % NAMES.len()], *size)).collect();
        let screen = |&(_, name, _): &(usize, &str, [u32; 2])| Screen {
            name: name.to_owned(),
            surface: ScreenSurface::Flat(FlatSurface {
                lower_left: DVec3::new(-1.0, -1.0, -1.0),
                right: 2.0 * DVec3::X,
                up: 2.0 * DVec3::Y,
            }),
            reflection: Reflection::default(),
        };
        let window = |&(_, name, size): &(usize, &str, [u32; 2])| WindowPlace {
            name: name.to_owned(),
            monitor: None,
            position: None,
            size,
            fullscreen: false,
            combine: Combine::None,
            swap_eyes: false,
        };
        let channel = |&(view, name, size): &(usize, &str, [u32; 2])| Channel {
            name: name.to_owned(),
            screen: view,
            eye: side(view),
            window: view,
            viewport: [0, 0, size[0], size[1]],
            part: ChannelPart::default(),
            warp: None,
            projector: None,
            alpha: None,
            beta: None,
        };
        let mut display = Self {
            name: name.to_owned(),
            viewer,
            screens: views.iter().map(screen).collect(),
            projectors: Vec::new(),
            windows: views.iter().map(window).collect(),
            channels: views.iter().map(channel).collect(),
            set_up: toml::Table::new(),
            notices: Vec::new(),
        };
        display.follow_head(eyes, viewer.head_m);
        display
    }

    /// Puts the screens of a [headset](Self::headset) before its eyes, for a head at this place in the room.
    pub fn follow_head(&mut self, eyes: &[HeadsetEye], head_m: DVec3) {
        if let [left, right, ..] = eyes {
            self.viewer.eye_separation_m = right.position_m.x - left.position_m.x;
        }
        for ((view, screen), eye) in self.screens.iter_mut().enumerate().zip(eyes) {
            let HeadsetEye { orientation, low, high, .. } = eye;
            // The display looks ahead; its pictures are turned with the head.
            let place_m = self.viewer.eye_m(side(view), head_m, DMat3::IDENTITY);
            let size = (*high - *low) * DISTANCE_M;
            screen.surface = ScreenSurface::Flat(FlatSurface {
                lower_left: place_m + *orientation * (DVec3::new(low.x, low.y, -1.0) * DISTANCE_M),
                right: *orientation * (DVec3::X * size.x),
                up: *orientation * (DVec3::Y * size.y),
            });
        }
    }
}

/// Side of the eye that a view of a headset is for.
fn side(view: usize) -> EyeSide {
    if view.is_multiple_of(2) { EyeSide::Left } else { EyeSide::Right }
}

#[cfg(test)]
mod tests {
    //! Law: the frustum of each view of a headset, of one or two for each eye, is the one that the runtime asks for,
    //! wherever the head is, and left and right take turns.

    use super::*;
    use crate::frustum::frustum;

    #[test]
    fn each_eyes_frustum_is_the_one_that_was_asked_for() {
        let eye = |side: f64, yaw: f64, share: f64| HeadsetEye {
            position_m: DVec3::new(0.0315 * side, 0.0, 0.0),
            orientation: DQuat::from_rotation_y(yaw),
            low: share * DVec2::new(-1.1 - 0.1 * side, -0.9),
            high: share * DVec2::new(0.95 - 0.1 * side, 1.2),
        };
        let eyes = [eye(-1.0, 0.1, 1.0), eye(1.0, -0.1, 1.0), eye(-1.0, 0.12, 0.4), eye(1.0, -0.1, 0.4)];
        assert_frusta(&eyes[..2]);
        assert_frusta(&eyes);
    }

    fn assert_frusta(eyes: &[HeadsetEye]) {
        let sizes: Vec<_> = (0..eyes.len()).map(|view| [[320, 240], [400, 300]][view / 2]).collect();
        let mut display = Display::headset("headset", eyes, &sizes);
        let sides: Vec<_> = display.channels.iter().map(|channel| channel.eye).collect();
        assert_eq!(sides, [EyeSide::Left, EyeSide::Right].repeat(eyes.len() / 2));
        assert!(display.windows.iter().map(|window| window.size).eq(sizes));
        for head_m in [display.viewer.head_m, DVec3::new(-0.7, 1.1, 2.0)] {
            display.follow_head(eyes, head_m);
            for (channel, eye) in display.channels.iter().zip(eyes) {
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
