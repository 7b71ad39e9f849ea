//! Law: windows that are not left out show the same frame, after every turn, whatever their surfaces answer; none is
//! stopped for ever by another; and no texture is dropped but where its surface changes. A wrong program would show
//! the left eye a newer frame than the right one, freeze a wall because a window is minimised, or run out of textures.

use super::*;
use rand::{RngExt, SeedableRng};
use rand_chacha::ChaCha8Rng;
use std::cell::Cell;
use std::rc::Rc;

const FRAMES: u64 = 10_000;

/// Texture of a virtual window. The window counts those that are out.
struct VirtualTexture(Rc<Cell<u32>>);

impl Drop for VirtualTexture {
    fn drop(&mut self) {
        self.0.set(self.0.get() - 1);
    }
}

/// Answers that a surface gives.
#[derive(Clone, Copy, Debug, PartialEq)]
enum Fate {
    Texture,
    Timeout,
    Outdated,
    Lost,
    Occluded,
}

/// Window without a system: a frame number on its screen, and a fate that stays for some turns.
struct VirtualWindow {
    shown: u64,
    presents: u64,
    fate: Fate,
    turns: u32,
    textures_out: Rc<Cell<u32>>,
}

impl VirtualWindow {
    fn new() -> Self {
        Self { shown: 0, presents: 0, fate: Fate::Texture, turns: 0, textures_out: Rc::default() }
    }

    /// Answer to the question for a texture.
    fn answer(&self) -> TextureAnswer<VirtualTexture> {
        match self.fate {
            Fate::Texture => {
                assert_eq!(self.textures_out.get(), 0, "a surface gives one texture at a time");
                self.textures_out.set(1);
                TextureAnswer::Texture(VirtualTexture(Rc::clone(&self.textures_out)))
            }
            Fate::Timeout | Fate::Outdated | Fate::Lost => TextureAnswer::NotYet,
            Fate::Occluded => TextureAnswer::Unseen,
        }
    }
}

/// Virtual display of several windows.
struct VirtualDisplay {
    windows: Vec<VirtualWindow>,
    step: WindowsInStep<VirtualTexture>,
    newest: u64,
}

impl VirtualDisplay {
    fn new(count: usize) -> Self {
        let windows = (0..count).map(|_| VirtualWindow::new()).collect();
        Self { windows, step: WindowsInStep::new(count), newest: 0 }
    }

    /// One turn, as the program has it. Returns true if a frame was presented.
    fn turn(&mut self) -> bool {
        for number in self.step.lacking() {
            self.step.answer(number, self.windows[number].answer());
        }
        let out = |windows: &[VirtualWindow]| windows.iter().map(|window| window.textures_out.get()).sum::<u32>();
        let before = out(&self.windows);
        let Some(textures) = self.step.turn() else {
            assert_eq!(out(&self.windows), before, "a texture was given away");
            return false;
        };
        self.newest += 1;
        assert_eq!(textures.len(), before as usize, "a texture stayed behind");
        for (number, _) in &textures {
            self.windows[*number].shown = self.newest;
            self.windows[*number].presents += 1;
        }
        true
    }

    /// Numbers of the frames on the windows that are not left out.
    fn in_step(&self) -> Vec<u64> {
        let windows = (0..self.windows.len()).filter(|&number| !self.step.is_left_out(number));
        windows.map(|number| self.windows[number].shown).collect()
    }
}

/// Rides a display until [`FRAMES`] frames are presented, with fates that stay for up to `longest` turns.
fn ride(
    count: usize,
    seed: u64,
    fates: &[Fate],
    longest: u32,
    mut after: impl FnMut(&VirtualDisplay),
) -> VirtualDisplay {
    let mut random = ChaCha8Rng::seed_from_u64(seed);
    let mut display = VirtualDisplay::new(count);
    let mut turns = 0;
    while display.newest < FRAMES {
        for window in &mut display.windows {
            if window.turns > 0 {
                window.turns -= 1;
            } else if window.fate == Fate::Texture {
                window.fate = fates[random.random_range(0..fates.len())];
                window.turns = random.random_range(0..longest);
            } else {
                (window.fate, window.turns) = (Fate::Texture, random.random_range(0..16));
            }
        }
        // Now and then a window gets another size, and what it holds is dropped.
        if random.random_bool(0.02) {
            display.step.release(random.random_range(0..count));
        }
        display.turn();
        after(&display);
        turns += 1;
        assert!(turns < 200 * FRAMES, "no progress after frame {}", display.newest);
    }
    display
}

fn all_equal(numbers: &[u64]) -> bool {
    numbers.windows(2).all(|pair| pair[0] == pair[1])
}

#[test]
fn windows_that_are_only_late_never_show_different_frames() {
    let fates = [Fate::Timeout, Fate::Outdated, Fate::Lost];
    for (count, seed) in [(2, 1), (2, 2), (3, 3), (6, 4)] {
        // Some waits in a row, between which a window is resized, are within the patience of the others.
        let display = ride(count, seed, &fates, PATIENCE / 3, |display| {
            let shown: Vec<u64> = display.windows.iter().map(|window| window.shown).collect();
            assert!(all_equal(&shown), "{shown:?}");
        });
        assert!(display.windows.iter().all(|window| window.presents == FRAMES));
        assert!(display.step.held_turns > FRAMES / 10, "the windows were late");
    }
}

#[test]
fn windows_in_step_never_show_different_frames_whatever_surfaces_answer() {
    let fates = [Fate::Timeout, Fate::Outdated, Fate::Lost, Fate::Occluded];
    for (count, seed) in [(2, 5), (2, 6), (3, 7), (6, 8)] {
        let mut left_out = 0;
        let display = ride(count, seed, &fates, 4 * PATIENCE, |display| {
            let shown = display.in_step();
            assert!(all_equal(&shown), "{shown:?} of {count}");
            assert!(shown.iter().all(|&number| number == display.newest), "{shown:?}, {}", display.newest);
            left_out += u64::from(shown.len() < count);
        });
        assert!(left_out > FRAMES / 10, "windows were left out");
        for window in &display.windows {
            assert!(window.presents > FRAMES / 4, "{} of {FRAMES}", window.presents);
        }
    }
}

#[test]
fn a_minimised_window_stops_nobody_and_comes_back_in_step() {
    for count in [2, 3] {
        let mut display = VirtualDisplay::new(count);
        assert!(display.turn());
        display.windows[0].fate = Fate::Occluded;
        for _ in 0..100 {
            assert!(display.turn(), "an unseen window is left out at once");
        }
        assert_eq!([display.windows[0].shown, display.windows[1].shown], [1, 101]);
        display.windows[0].fate = Fate::Texture;
        assert!(display.turn());
        assert!(!display.step.is_left_out(0));
        assert!(display.windows.iter().all(|window| window.shown == 102));
    }
}

#[test]
fn a_window_that_never_answers_stops_the_others_for_a_bounded_number_of_turns() {
    let mut display = VirtualDisplay::new(2);
    assert!(display.turn());
    display.windows[1].fate = Fate::Timeout;
    let held = (0..1000).take_while(|_| !display.turn()).count();
    assert_eq!(held, PATIENCE as usize);
    assert!((0..100).all(|_| display.turn()), "it is not waited for a second time");
    display.windows[1].fate = Fate::Texture;
    assert!(display.turn());
    assert_eq!(display.in_step(), [103, 103]);
}

#[test]
fn a_window_that_comes_back_while_another_is_late_is_not_in_step_yet() {
    let mut display = VirtualDisplay::new(2);
    display.windows[0].fate = Fate::Occluded;
    assert!(display.turn());
    (display.windows[0].fate, display.windows[1].fate) = (Fate::Texture, Fate::Timeout);
    assert!(!display.turn());
    assert!(display.step.is_left_out(0), "its screen still shows an old frame");
    assert_eq!(display.in_step(), [1]);
    display.windows[1].fate = Fate::Texture;
    assert!(display.turn());
    assert_eq!(display.in_step(), [2, 2]);
}

#[test]
fn nothing_is_presented_while_no_window_is_seen() {
    let mut display = VirtualDisplay::new(2);
    display.windows.iter_mut().for_each(|window| window.fate = Fate::Occluded);
    assert!((0..100).all(|_| !display.turn()));
    assert_eq!(display.step.held_turns, 0, "no texture was held");
}

#[test]
fn skew_and_windows_left_out_are_told_of_several_windows_only() {
    let mut display = VirtualDisplay::new(2);
    display.turn();
    display.step.presented(Duration::from_micros(1250));
    display.windows[1].fate = Fate::Occluded;
    display.turn();
    display.step.presented(Duration::from_micros(10));
    let values = |values: &[&dyn std::fmt::Display; 6]| values.map(ToString::to_string).join(" ");
    assert_eq!(display.step.sentence(values).as_deref(), Some("2 2 0.01 1.25 1 0"));
    assert_eq!(VirtualDisplay::new(1).step.sentence(values), None);
}
