//! Latency and remaining noise of each velocity filter of the head: the table of docs/TRACKING.md.
//!
//!     cargo run --release -p input --example head_filters
//!
//! A synthetic head walks to and fro (0.6 m, 0.4 Hz: up to 1.5 m/s) and sways and bobs as walkers do. A tracker sees
//! it with half a millimetre of noise along each axis. The poses go through [`TrackedHead`] as in a ride, and the
//! result is compared with the true velocity:
//!
//! - *latency*: the delay of the true velocity that fits best;
//! - *noise*: RMS along each axis of the velocity that the tracker's noise adds while the head walks; *at rest*: the
//!   same while it stands;
//! - *shimmer*: shift of the picture by the noise at rest, where aberration is strongest and c is 30 km/h;
//! - *error*: RMS difference along each axis from the true velocity at that moment, latency included.
#![allow(clippy::print_stdout, clippy::print_stderr, reason = "an example prints its figures")]

use std::f64::consts::TAU;

use glam::{DQuat, DVec3};
use input::head::{TrackedHead, VelocityFilter};
use input::{HeadConfig, Nanos, SECOND, TrackedPose, TrackerUrl};

/// Noise of the tracker along each axis, metres.
const NOISE_M: f64 = 5e-4;
/// Length of the walk, seconds.
const WALK_S: f64 = 120.0;
/// Time after which the filters have settled, seconds.
const BEGUN_S: f64 = 2.0;
/// Tracker rates, Hz.
const RATES_HZ: [f64; 2] = [60.0, 200.0];
/// Speed of light, m/s.
const C_M_S: f64 = 30.0 / 3.6;
/// Amplitude (m) and frequency (Hz) along each axis; the ratios repeat only after a long time.
const WALK: [(f64, f64); 3] = [(0.03, 0.91), (0.02, 1.83), (0.6, 0.4)];

fn walk(time_s: f64) -> DVec3 {
    DVec3::from_array(WALK.map(|(reach, hz)| reach * (TAU * hz * time_s).sin()))
}

fn walk_velocity(time_s: f64) -> DVec3 {
    DVec3::from_array(WALK.map(|(reach, hz)| reach * TAU * hz * (TAU * hz * time_s).cos()))
}

/// Reproducible pseudo-random numbers: xorshift, then normal ones by Box and Muller.
struct Noise(u64);

impl Noise {
    fn uniform(&mut self) -> f64 {
        self.0 ^= self.0 << 13;
        self.0 ^= self.0 >> 7;
        self.0 ^= self.0 << 17;
        ((self.0 >> 11) as f64 + 0.5) / (1_u64 << 53) as f64
    }

    fn normal(&mut self) -> f64 {
        (-2.0 * self.uniform().ln()).sqrt() * (TAU * self.uniform()).cos()
    }
}

/// Time and filtered velocity after each frame of the tracker.
fn filtered(filter: VelocityFilter, rate_hz: f64, noise_m: f64, walk: fn(f64) -> DVec3) -> Vec<(f64, DVec3)> {
    let config = HeadConfig { velocity: filter, ..HeadConfig::new(TrackerUrl::Mouse) };
    let mut head = TrackedHead::new(config).expect("the settings are sound");
    let mut noise = Noise(1905);
    let mut track = Vec::new();
    for frame in 0..(WALK_S * rate_hz) as u64 {
        let time_s = frame as f64 / rate_hz;
        let at = (time_s * SECOND as f64) as Nanos;
        let jitter = DVec3::new(noise.normal(), noise.normal(), noise.normal()) * noise_m;
        head.pose(&TrackedPose {
            sensor: 0,
            at,
            measured_s: Some(time_s + 1.0),
            latency_s: None,
            position_m: walk(time_s) + jitter,
            orientation: DQuat::IDENTITY,
            velocity_m_s: None,
        });
        track.push((time_s, head.state(at).velocity_m_s));
    }
    assert_eq!(head.rejected().number(), 0, "{:?}", head.rejected());
    track.retain(|(time_s, _)| *time_s > BEGUN_S);
    track
}

/// Root of the mean square along an axis.
fn rms(differences: impl ExactSizeIterator<Item = DVec3>) -> f64 {
    let count = 3.0 * differences.len() as f64;
    (differences.map(DVec3::length_squared).sum::<f64>() / count).sqrt()
}

/// RMS difference from the velocity `delay_s` ago.
fn error(track: &[(f64, DVec3)], delay_s: f64) -> f64 {
    rms(track.iter().map(|(time_s, velocity)| *velocity - walk_velocity(time_s - delay_s)))
}

/// Delay of the true velocity that fits best, seconds, to 0.1 ms.
fn latency(track: &[(f64, DVec3)]) -> f64 {
    let best = |from_s: f64, step_s: f64, steps: u32| {
        let delays = (0..=steps).map(|step| from_s + step_s * f64::from(step));
        delays.min_by(|a, b| error(track, *a).total_cmp(&error(track, *b))).unwrap_or_default()
    };
    best(best(0.0, 5e-3, 40) - 5e-3, 1e-4, 100)
}

fn main() {
    let filters = [
        ("`off`", VelocityFilter::Off),
        ("`mean`, 4 frames", VelocityFilter::Mean { frames: 4 }),
        ("`mean`, 8 frames", VelocityFilter::Mean { frames: 8 }),
        ("`least-squares`, 0.05 s", VelocityFilter::LeastSquares { window_s: 0.05 }),
        ("`least-squares`, 0.1 s", VelocityFilter::LeastSquares { window_s: 0.1 }),
        ("`one-euro`", VelocityFilter::one_euro()),
    ];
    println!("| filter | tracker, Hz | latency, ms | noise, mm/s | at rest, mm/s | shimmer, degrees | error, mm/s |");
    println!("|---|---|---|---|---|---|---|");
    for (name, filter) in filters {
        for rate_hz in RATES_HZ {
            let (clean, noisy) = (filtered(filter, rate_hz, 0.0, walk), filtered(filter, rate_hz, NOISE_M, walk));
            let resting =
                rms(filtered(filter, rate_hz, NOISE_M, |_| DVec3::ZERO).iter().map(|(_, velocity)| *velocity));
            let noise = rms(noisy.iter().zip(&clean).map(|((_, noisy), (_, clean))| *noisy - *clean));
            println!(
                "| {name} | {rate_hz} | {:.0} | {:.0} | {:.0} | {:.2} | {:.0} |",
                1e3 * latency(&noisy),
                1e3 * noise,
                1e3 * resting,
                (resting / C_M_S).to_degrees(),
                1e3 * error(&noisy, 0.0)
            );
        }
    }
}
