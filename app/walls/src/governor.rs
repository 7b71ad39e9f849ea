//! Governor: the resolution at which a window keeps its frame rate.
//!
//! The time of a frame is a fixed part, and a part in proportion to the pixels that are drawn. Where frames take longer
//! than they may, fewer pixels are drawn, which are then enlarged; where there is room, more. A screen that waits for
//! its refresh hides how much room there is, so that after a quiet time more pixels are tried. What has failed is tried
//! again later and later.

use std::time::Duration;

/// Smallest share of the window's width and height that is drawn to hold the frame rate: coarser pictures are worse
/// than fewer frames.
const SMALL_SHARE: f64 = 0.45;
/// Smallest share that is drawn to hold half of the frame rate, below which nobody can steer.
const SMALLEST_SHARE: f64 = 0.25;
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
}

impl Governor {
    /// Governor that holds `frame_rate` frames per second.
    pub fn new(frame_rate: f64) -> Self {
        Self {
            wanted_s: frame_rate.recip(),
            share: 1.0,
            times: Vec::new(),
            quiet_s: 0.0,
            median_s: None,
            patience_s: QUIET_S[0],
            too_slow: None,
        }
    }

    /// Share of the window's width and height that is drawn.
    pub fn share(&self) -> f64 {
        self.share
    }

    /// Share with which a frame takes this long, if all of its time goes into pixels.
    pub fn share_within(&self, time: Duration) -> f64 {
        let of_frames = self.median_s.map_or(1.0, |median_s| self.share * (time.as_secs_f64() / median_s).sqrt());
        of_frames.clamp(self.share, 1.0)
    }

    /// Takes the time from one frame to the next into account.
    pub fn frame(&mut self, took: Duration) {
        let took_s = took.as_secs_f64();
        self.times.push(took_s);
        self.quiet_s += took_s;
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
        // Down to the small share the whole rate is held, below it half of it.
        let longest_s = if self.share > SMALL_SHARE { self.wanted_s } else { 2.0 * self.wanted_s };
        let smallest = if self.share > SMALL_SHARE { SMALL_SHARE } else { SMALLEST_SHARE };
        let (aimed_s, largest) =
            if self.share < SMALL_SHARE { (2.0 * self.wanted_s, SMALL_SHARE) } else { (self.wanted_s, 1.0) };
        let [least, most] = FACTORS;
        if median_s > BORNE * longest_s {
            // The same share failed before: wait longer until it is tried again.
            let again = self.too_slow.is_some_and(|slow| self.share >= 0.98 * slow);
            self.patience_s = if again { (2.0 * self.patience_s).min(QUIET_S[1]) } else { QUIET_S[0] };
            self.too_slow = Some(self.share);
            self.change((AIM * longest_s / median_s).clamp(least, 0.97), smallest, 1.0);
        } else if median_s < ROOM * aimed_s && !self.would_fail(median_s, aimed_s) {
            self.change((AIM * aimed_s / median_s).min(most), SMALLEST_SHARE, largest);
        } else if self.quiet_s > self.patience_s && median_s < BORNE * aimed_s {
            self.change(TRIED, SMALLEST_SHARE, largest);
        }
    }

    /// True if a share that was too slow lately is near, and would take too long still, by the pixels that it has more.
    fn would_fail(&self, median_s: f64, aimed_s: f64) -> bool {
        let near = self.too_slow.filter(|slow| self.quiet_s < self.patience_s && self.share * TRIED.sqrt() >= *slow);
        near.is_some_and(|slow| median_s * (slow / self.share).powi(2) > ROOM * aimed_s)
    }

    /// Multiplies the number of pixels, between the shares `smallest` and `largest`.
    fn change(&mut self, factor: f64, smallest: f64, largest: f64) {
        let share = (self.share * factor.sqrt()).clamp(smallest, largest);
        self.quiet_s = 0.0;
        if share != self.share {
            self.median_s = self.median_s.map(|median_s| median_s * (share / self.share).powi(2));
            self.share = share;
            self.times.clear();
        }
    }
}

#[cfg(test)]
mod tests {
    //! Laws under test: the frame rate is held on machines of very different speeds, with as many pixels as they allow;
    //! a fast machine draws all; the resolution rests where the load does, and comes back when a load goes.

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
}
