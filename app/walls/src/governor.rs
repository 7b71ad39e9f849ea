//! Governor: the resolution at which a window, or a room, keeps its frame rate.
//!
//! The time of a frame is a fixed part, and a part in proportion to the pixels that are drawn
//! ([`FrameCost`](crate::frame_cost::FrameCost)). Where frames take longer than they may, fewer pixels are drawn, which
//! are then enlarged, as long as pixels are what takes the time; where there is room, more. A screen that waits for its
//! refresh hides how much room there is, so that after a quiet time more pixels are tried. What has failed is tried
//! again later and later.
//!
//! A frame that takes so long that own time is lost is answered at once, by as many pixels as it says; all other
//! changes await several frames.

use crate::frame_cost::{FrameCost, FrameParts};
use std::time::Duration;

/// Smallest share of the window's width and height that is drawn to hold the frame rate: coarser pictures are worse
/// than fewer frames.
const SMALL_SHARE: f64 = 0.45;
/// Smallest share that is drawn to hold half of the frame rate, below which nobody can steer.
const SMALLEST_SHARE: f64 = 0.25;
/// Part of a frame's time that pixels take at least where fewer of them are drawn: below it they gain little.
const WORTH: f64 = 1.0 / 3.0;
/// Factors on the number of pixels that are worth it above which fewer are drawn, and below which more.
const UNSURE: [f64; 2] = [1.25, 0.5];
/// Factor on the wanted time up to which a frame may only have waited for one refresh more.
const NEAR: f64 = 1.6;
/// Time of a frame above which own time is lost, seconds.
const LOST_S: f64 = 0.25;
/// Factor on the usual time of a frame above which a single one was held up by something else than its pixels.
const STALL: f64 = 4.0;
/// Number of frames whose median counts.
const FRAMES: usize = 5;
/// Number of frames after a change that do not count: targets are made anew, and frames may be one behind.
const SETTLING: usize = 2;
/// Excess of a frame's time over the wanted one that is borne.
const BORNE: f64 = 1.06;
/// Share of the wanted time that a change aims at.
const AIM: f64 = 0.92;
/// Share of the wanted time below which there is certainly room.
const ROOM: f64 = 0.8;
/// Largest and smallest factor on the number of pixels in one change.
const FACTORS: [f64; 2] = [0.4, 1.3];
/// Factor on the number of pixels that is tried after a quiet time.
const TRIED: f64 = 1.15;
/// Shortest and longest quiet time before more pixels are tried, seconds.
const QUIET_S: [f64; 2] = [3.0, 60.0];

/// Governor of one window's resolution.
#[derive(Clone, Debug)]
pub struct Governor {
    wanted_s: f64,
    share: f64,
    /// Cost of a frame, from the frames so far.
    cost: FrameCost,
    /// Times of the frames since the last change, seconds.
    times: Vec<f64>,
    /// Time since the last change, seconds.
    quiet_s: f64,
    /// Median time of a frame, once known, seconds.
    median_s: Option<f64>,
    /// Quiet time before more pixels are tried, seconds.
    patience_s: f64,
    /// Smallest share at which frames were too slow lately.
    too_slow: Option<f64>,
    /// Time of a frame up to which fewer pixels than are worth it have been tried, seconds.
    tried_s: f64,
    /// True if fewer pixels did not hold the rate lately.
    in_vain: bool,
    /// True if the frame before was held up.
    stalled: bool,
    /// True until the first frame after a change, which may still have the pixels from before it.
    changed: bool,
}

impl Governor {
    /// Governor that holds `frame_rate` frames per second.
    pub fn new(frame_rate: f64) -> Self {
        Self {
            wanted_s: frame_rate.recip(),
            share: 1.0,
            cost: FrameCost::default(),
            times: Vec::new(),
            quiet_s: 0.0,
            median_s: None,
            patience_s: QUIET_S[0],
            too_slow: None,
            tried_s: 0.0,
            in_vain: false,
            stalled: false,
            changed: false,
        }
    }

    /// Frames per second that are held.
    pub fn frame_rate(&self) -> f64 {
        self.wanted_s.recip()
    }

    /// Share of the window's width and height that is drawn.
    pub fn share(&self) -> f64 {
        self.share
    }

    /// Share with which a frame takes this long.
    pub fn share_within(&self, time: Duration) -> f64 {
        let pixels = self.cost.parts().map_or(1.0, |parts| parts.pixels_within(time.as_secs_f64()));
        pixels.sqrt().clamp(self.share, 1.0)
    }

    /// Begins with a share by the time that a frame with every pixel took which nobody saw.
    pub fn begin(&mut self, took: Duration) {
        if took.as_secs_f64() > BORNE * self.wanted_s {
            self.shorten(took.as_secs_f64());
        }
    }

    /// Takes the time from one frame to the next into account.
    pub fn frame(&mut self, took: Duration) {
        let took_s = took.as_secs_f64();
        self.times.push(took_s);
        self.quiet_s += took_s;
        let changed = std::mem::take(&mut self.changed);
        if took_s <= LOST_S {
            self.stalled = false;
        } else if !changed {
            let stall = self.median_s.is_some_and(|median_s| took_s > STALL * median_s);
            if !stall || self.stalled {
                self.shorten(took_s);
            }
            self.stalled = stall;
        }
        if self.times.len() < SETTLING + FRAMES {
            return;
        }
        let mut newest = self.times[self.times.len() - FRAMES..].to_vec();
        newest.sort_by(f64::total_cmp);
        let median_s = newest[FRAMES / 2];
        self.median_s = Some(median_s);
        if self.times.len() > 2 * (SETTLING + FRAMES) {
            self.times.drain(..FRAMES);
        }
        self.cost.see(self.pixels(), median_s);
        let Some(parts) = self.cost.parts() else { return };
        if median_s <= BORNE * self.wanted_s {
            self.in_vain = false;
            self.tried_s = 0.0;
        } else if self.regains_pixels(parts) {
            return;
        }
        // Down to the small share the whole rate is held, below it half of it.
        let (aimed_s, largest) =
            if self.share < SMALL_SHARE { (2.0 * self.wanted_s, SMALL_SHARE) } else { (self.wanted_s, 1.0) };
        let [_, most] = FACTORS;
        if median_s > BORNE * self.longest_s() {
            self.slow(parts, median_s);
        } else if median_s < ROOM * aimed_s && !self.would_fail(parts, aimed_s) {
            let pixels = parts.pixels_within(AIM * aimed_s).min(most * self.pixels()).max(self.pixels());
            self.change(pixels, SMALLEST_SHARE, largest);
        } else if self.quiet_s > self.patience_s && median_s < BORNE * aimed_s {
            self.change(TRIED * self.pixels(), SMALLEST_SHARE, largest);
        }
    }

    /// Share of all pixels that is drawn.
    fn pixels(&self) -> f64 {
        self.share * self.share
    }

    /// Longest time of a frame at the present share, seconds.
    fn longest_s(&self) -> f64 {
        if self.share > SMALL_SHARE { self.wanted_s } else { 2.0 * self.wanted_s }
    }

    /// Goes back to more pixels, where fewer were drawn in vain for a while; true if it does.
    fn regains_pixels(&mut self, parts: FrameParts) -> bool {
        let [_, few] = UNSURE;
        let back = self.pixels() < few * self.worth(parts) && self.quiet_s > self.patience_s;
        if back {
            self.in_vain = true;
            self.wait_longer();
            self.change(self.worth(parts), SMALLEST_SHARE, 1.0);
        }
        back
    }

    /// Changes the share because frames are too slow.
    fn slow(&mut self, parts: FrameParts, median_s: f64) {
        // A screen that waits for its refresh hides what pixels gain until the rate is held: they are worth a trial.
        let near = self.share > SMALL_SHARE && median_s < NEAR * self.wanted_s && !self.in_vain;
        let least = if near { 0.0 } else { self.worth(parts) };
        let ([many, _], [fewest, _]) = (UNSURE, FACTORS);
        if self.pixels() > many * least {
            self.fail();
            let pixels = parts.pixels_within(AIM * self.longest_s()).max(least);
            let smallest = if self.share > SMALL_SHARE { SMALL_SHARE } else { SMALLEST_SHARE };
            self.change(pixels.clamp(fewest * self.pixels(), 0.97 * self.pixels()), smallest, 1.0);
        } else if median_s > BORNE * (2.0 * self.wanted_s).max(self.tried_s) && self.quiet_s > self.patience_s {
            // Nobody can steer here: what fewer pixels gain is tried, in case the load grew while it was learned.
            self.tried_s = NEAR * median_s;
            self.change(fewest * self.pixels(), SMALLEST_SHARE, 1.0);
        }
    }

    /// Changes the share because of a single frame in which own time was lost.
    fn shorten(&mut self, took_s: f64) {
        let in_pixels = FrameParts::all_in_pixels(self.pixels(), took_s);
        let known = self.cost.parts().filter(|_| self.cost.has_spread());
        if known.is_none() {
            self.cost.see(self.pixels(), took_s);
        }
        let parts = known.unwrap_or(in_pixels);
        let [fewest, _] = FACTORS;
        // The whole rate, as far as one change goes; but no time lost, whatever that takes.
        let wanted = parts.pixels_within(AIM * self.longest_s()).max(fewest * self.pixels());
        let wanted = wanted.max(self.worth(parts));
        let kept = in_pixels.pixels_within(ROOM * LOST_S).min(parts.pixels_within(ROOM * LOST_S));
        self.fail();
        self.change(wanted.min(kept).min(self.pixels()), SMALLEST_SHARE, 1.0);
    }

    /// Remembers that the present share is too slow. One that has failed before is tried again later.
    fn fail(&mut self) {
        if self.too_slow.is_some_and(|slow| self.share >= 0.9 * slow) {
            self.wait_longer();
        } else {
            self.patience_s = QUIET_S[0];
        }
        self.too_slow = Some(self.share);
    }

    /// Doubles the quiet time before more pixels are tried.
    fn wait_longer(&mut self) {
        self.patience_s = (2.0 * self.patience_s).min(QUIET_S[1]);
    }

    /// Share of all pixels below which fewer gain little. Half of the rate goes before, where pixels can hold it.
    fn worth(&self, parts: FrameParts) -> f64 {
        let gains_much = parts.pixels_that_take(WORTH).min(parts.pixels_within(ROOM * LOST_S));
        let half_s = 2.0 * self.wanted_s;
        if parts.fixed_s < AIM * half_s { gains_much.min(parts.pixels_within(AIM * half_s)) } else { gains_much }
    }

    /// True if a share that was too slow lately is near, and would take too long still, by the pixels that it has more.
    fn would_fail(&self, parts: FrameParts, aimed_s: f64) -> bool {
        let near = self.too_slow.filter(|slow| self.quiet_s < self.patience_s && self.share * TRIED.sqrt() >= *slow);
        near.is_some_and(|slow| parts.time_s(slow * slow) > ROOM * aimed_s)
    }

    /// Draws this share of all pixels, between the shares `smallest` and `largest` of width and height.
    fn change(&mut self, pixels: f64, smallest: f64, largest: f64) {
        let share = pixels.sqrt().clamp(smallest, largest);
        self.quiet_s = 0.0;
        if share != self.share {
            let expected = self.cost.parts().map(|parts| parts.time_s(share * share));
            self.median_s = self.median_s.and(expected);
            self.share = share;
            self.times.clear();
            self.changed = true;
        }
    }
}

#[cfg(test)]
mod tests {
    //! Laws under test: the frame rate is held on machines of very different speeds, with as many pixels as they allow;
    //! a fast machine draws all; the resolution rests where the load does, and comes back when a load goes; no picture
    //! is coarsened for little gain; own time is lost in one frame at most.

    use super::*;

    /// Shares after `seconds` on a machine with this cost: fixed part, part of a full picture, seconds; and refresh of
    /// the screen that frames wait for, seconds, 0 if they do not.
    fn ride(governor: &mut Governor, [fixed, full, refresh]: [f64; 3], seconds: f64) -> Vec<(f64, f64)> {
        let mut frames = Vec::new();
        let mut now = 0.0;
        // A crude source of noise: times differ by a tenth.
        let mut noise = 0.3_f64;
        while now < seconds {
            noise = (noise * 97.0 + 0.13).fract();
            let work = (fixed + full * governor.share().powi(2)) * (0.95 + 0.1 * noise);
            let took = if refresh > 0.0 { (work / refresh).ceil() * refresh } else { work };
            governor.frame(Duration::from_secs_f64(took));
            now += took;
            frames.push((governor.share(), took));
        }
        frames
    }

    fn median(mut values: Vec<f64>) -> f64 {
        values.sort_by(f64::total_cmp);
        values[values.len() / 2]
    }

    #[test]
    fn the_rate_is_held_with_as_many_pixels_as_the_machine_allows() {
        let wanted = 1.0 / 30.0;
        for (machine, possible) in [
            // (wanted − fixed) / full is the share of pixels that is possible.
            ([0.005, 0.100, 0.0], ((wanted - 0.005) / 0.100_f64).sqrt()),
            ([0.010, 0.060, 0.0], ((wanted - 0.010) / 0.060_f64).sqrt()),
            ([0.005, 0.100, 1.0 / 60.0], ((wanted - 0.005) / 0.100_f64).sqrt()),
        ] {
            let mut governor = Governor::new(30.0);
            let frames = ride(&mut governor, machine, 40.0);
            let late = &frames[frames.len() / 2..];
            let times = late.iter().map(|(_, took)| *took).collect();
            let shares = late.iter().map(|(share, _)| *share).collect();
            assert!(median(times) <= 1.07 * wanted, "{machine:?}");
            let share = median(shares);
            assert!((0.85 * possible..1.05 * possible).contains(&share), "{machine:?}: {share} of {possible}");
        }
    }

    #[test]
    fn a_machine_that_is_fast_enough_draws_every_pixel() {
        for refresh in [0.0, 1.0 / 60.0] {
            let mut governor = Governor::new(30.0);
            assert!(ride(&mut governor, [0.002, 0.010, refresh], 10.0).iter().all(|(share, _)| *share == 1.0));
        }
    }

    #[test]
    fn resolution_comes_back_when_a_load_goes_and_rests_while_it_stays() {
        let mut governor = Governor::new(30.0);
        ride(&mut governor, [0.005, 0.110, 0.0], 20.0);
        assert!(governor.share() < 0.6);
        ride(&mut governor, [0.005, 0.015, 0.0], 10.0);
        assert_eq!(governor.share(), 1.0);
        // A steady load: after a while hardly ever another resolution.
        ride(&mut governor, [0.005, 0.080, 0.0], 120.0);
        let late = ride(&mut governor, [0.005, 0.080, 0.0], 60.0);
        let changes = late.windows(2).filter(|pair| pair[0].0 != pair[1].0).count();
        assert!(changes <= 12, "{changes}");
    }

    #[test]
    fn pictures_are_no_coarser_than_steering_needs() {
        // Between the whole rate and half of it, the small share is kept.
        let mut governor = Governor::new(30.0);
        let frames = ride(&mut governor, [0.010, 0.180, 0.0], 60.0);
        assert!(frames[frames.len() / 2..].iter().all(|(share, _)| *share == SMALL_SHARE), "{}", governor.share());
        // Where even half of the rate is too much for it, fewer pixels are drawn.
        let mut governor = Governor::new(30.0);
        let frames = ride(&mut governor, [0.010, 0.500, 0.0], 60.0);
        let late = &frames[frames.len() / 2..];
        assert!(median(late.iter().map(|(_, took)| *took).collect()) <= 1.07 * 2.0 / 30.0);
        assert!(median(late.iter().map(|(share, _)| *share).collect()) > 0.28);
    }

    #[test]
    fn a_machine_that_is_too_slow_for_anything_keeps_the_smallest_share() {
        let mut governor = Governor::new(30.0);
        ride(&mut governor, [0.200, 1.0, 0.0], 60.0);
        assert!(governor.share() < 1.2 * SMALLEST_SHARE, "{}", governor.share());
    }

    #[test]
    fn no_picture_is_coarser_than_gains_much_and_it_rests_there() {
        // At half of the width and height, pixels take a third of the frame's time.
        let mut governor = Governor::new(30.0);
        let frames = ride(&mut governor, [0.080, 0.160, 0.0], 120.0);
        let coarser = frames.iter().filter(|(share, _)| *share < 0.475).count();
        assert!(coarser < 60, "more than a trial: {coarser}");
        let late = &frames[frames.len() / 4..];
        assert!(late.iter().all(|(share, _)| *share == late[0].0 && *share < 0.6), "{}", governor.share());
        // But where fewer pixels hold half of the rate, nobody must steer with less.
        let mut governor = Governor::new(30.0);
        let frames = ride(&mut governor, [0.050, 0.100, 0.0], 60.0);
        let late = frames[frames.len() / 2..].iter().map(|(_, took)| *took).collect();
        assert!(median(late) <= 1.07 * 2.0 / 30.0, "{}", governor.share());
        // Where pixels cost next to nothing, all of them are drawn, in spite of a first trial with fewer.
        let mut governor = Governor::new(30.0);
        let frames = ride(&mut governor, [0.100, 0.002, 0.0], 60.0);
        let late = &frames[frames.len() / 2..];
        assert!(late.iter().all(|(share, _)| *share > 0.95), "{}", governor.share());
        assert!(late.windows(2).all(|pair| pair[0].0 == pair[1].0));
    }

    #[test]
    fn a_load_that_grows_as_one_speeds_up_is_followed() {
        for full in [0.250, 0.350, 0.500] {
            for growing_s in [2.0, 5.0, 10.0, 20.0] {
                let mut governor = Governor::new(30.0);
                governor.begin(Duration::from_millis(100));
                ride(&mut governor, [0.020, 0.080, 0.0], 3.0);
                for step in 0..40 {
                    let grown = f64::from(step) / 40.0;
                    let machine = [0.020 + 0.010 * grown, 0.080 + (full - 0.080) * grown, 0.0];
                    ride(&mut governor, machine, growing_s / 40.0);
                }
                ride(&mut governor, [0.030, full, 0.0], 1.5);
                let frames = ride(&mut governor, [0.030, full, 0.0], 4.0);
                let slow = median(frames.iter().map(|(_, took)| *took).collect());
                assert!(slow <= 1.07 * 2.0 / 30.0, "{full} in {growing_s} s: {slow} s at {}", governor.share());
            }
        }
    }

    #[test]
    fn a_refresh_does_not_hide_that_the_rate_can_be_held() {
        // The unseen frame waited for no refresh, the others do: pixels seem to gain less than they do.
        let machine = [0.010, 0.060, 1.0 / 60.0];
        let mut governor = Governor::new(30.0);
        governor.begin(Duration::from_secs_f64(0.070));
        let frames = ride(&mut governor, machine, 40.0);
        let late = &frames[frames.len() / 2..];
        assert!(median(late.iter().map(|(_, took)| *took).collect()) <= 1.07 / 30.0, "{}", governor.share());
        // Where the rate is out of reach for all that, one trial is enough.
        let mut governor = Governor::new(30.0);
        let frames = ride(&mut governor, [0.040, 0.010, 0.0], 120.0);
        let late = &frames[frames.len() / 4..];
        assert!(late.iter().all(|(share, _)| *share > 0.95), "{}", governor.share());
    }

    #[test]
    fn own_time_is_lost_in_the_first_frame_at_most() {
        for machine in [[0.020, 0.400, 0.0], [0.020, 2.000, 0.0], [0.060, 0.250, 0.0]] {
            let frames = ride(&mut Governor::new(30.0), machine, 30.0);
            let lost: Vec<_> = frames.iter().skip(1).filter(|(_, took)| *took > LOST_S).collect();
            assert!(lost.is_empty(), "{machine:?}: {lost:?}");
            // A governor that knows an unseen frame loses none.
            let mut governor = Governor::new(30.0);
            governor.begin(Duration::from_secs_f64(machine[0] + machine[1]));
            let frames = ride(&mut governor, machine, 30.0);
            assert!(frames.iter().all(|(_, took)| *took <= LOST_S), "{machine:?}");
        }
    }

    #[test]
    fn a_fast_unseen_frame_and_a_single_stall_change_nothing() {
        let mut governor = Governor::new(30.0);
        governor.begin(Duration::from_millis(20));
        assert_eq!(governor.share(), 1.0);
        ride(&mut governor, [0.002, 0.010, 0.0], 1.0);
        governor.frame(Duration::from_secs(3));
        assert_eq!(governor.share(), 1.0);
        ride(&mut governor, [0.002, 0.010, 0.0], 1.0);
        assert_eq!(governor.share(), 1.0);
        // Two in succession are a load.
        governor.frame(Duration::from_secs(1));
        governor.frame(Duration::from_secs(1));
        assert!(governor.share() < 0.6, "{}", governor.share());
    }
}
