//! Error of each velocity filter on the head of a ride that was recorded in a headset: the table of docs/HEADSET.md.
//!
//!     cargo run --release -p input --example head_prediction -- ride.mcap
//!
//! The head's poses go through [`TrackedHead`] as in the ride, once for each filter. What the filter says after a pose
//! is compared with what came later:
//!
//! - *velocity*: difference from that between the poses before and after, which no filter can know yet;
//! - *next place*: distance of the next pose from the place to which the velocity leads until then.
//!
//! `runtime` stands for the velocity that the headset's runtime says, where it says one, and `none` for a head that is
//! taken to be at rest.
#![allow(clippy::print_stdout, clippy::print_stderr, reason = "an example prints its figures")]

use std::error::Error;
use std::path::Path;

use glam::DVec3;
use input::decoder::{Actions, Decoder};
use input::head::{TrackedHead, VelocityFilter};
use input::openxr::OpenxrDecoder;
use input::recording::{Recording, RecordingEntry};
use input::{HeadConfig, SampleSource, Signal, TrackedPose, TrackerUrl};

/// Head after a pose: time, place, and velocity by a filter.
#[derive(Clone, Copy)]
struct Followed {
    time_s: f64,
    position_m: DVec3,
    velocity_m_s: DVec3,
}

/// Poses of the head in a recording.
fn poses(path: &Path) -> Result<Vec<TrackedPose>, Box<dyn Error>> {
    let mut decoder = OpenxrDecoder::default();
    let mut poses = Vec::new();
    for entry in Recording::open(path)? {
        if let RecordingEntry::Sample(sample) = entry?
            && sample.source == SampleSource::Openxr
            && let Signal::Bytes(bytes) = &sample.signal
        {
            decoder.bytes(sample.at, bytes, &mut Actions::default());
            poses.extend(decoder.take_poses().into_iter().filter(|pose| pose.sensor == 0));
        }
    }
    Ok(poses)
}

/// Head as a filter follows it.
fn filtered(poses: &[TrackedPose], filter: VelocityFilter) -> Result<Vec<Followed>, Box<dyn Error>> {
    let mut head = TrackedHead::new(HeadConfig { velocity: filter, ..HeadConfig::new(TrackerUrl::Openxr) })?;
    let mut followed = Vec::new();
    for pose in poses {
        head.pose(pose);
        let velocity_m_s = head.state(pose.at).velocity_m_s;
        let time_s = pose.measured_s.ok_or("a report without its time")?;
        followed.push(Followed { time_s, position_m: pose.position_m, velocity_m_s });
    }
    Ok(followed)
}

/// RMS, 95th percentile and largest of some lengths.
fn figures(mut lengths: Vec<f64>) -> [f64; 3] {
    lengths.sort_by(f64::total_cmp);
    let rms = (lengths.iter().map(|length| length * length).sum::<f64>() / lengths.len() as f64).sqrt();
    let at = |share: f64| lengths[((lengths.len() - 1) as f64 * share) as usize];
    [rms, at(0.95), at(1.0)]
}

fn main() -> Result<(), Box<dyn Error>> {
    let path = std::env::args().nth(1).ok_or("which recording? head_prediction -- ride.mcap")?;
    let poses = poses(Path::new(&path))?;
    if poses.len() < 4 {
        return Err(format!("{path} has {} poses of a headset: too few to compare", poses.len()).into());
    }
    let mut rows = Vec::new();
    for (name, filter) in [
        ("`off`", VelocityFilter::Off),
        ("`mean`, 4 frames", VelocityFilter::Mean { frames: 4 }),
        ("`least-squares`, 0.05 s", VelocityFilter::LeastSquares { window_s: 0.05 }),
        ("`one-euro`", VelocityFilter::one_euro()),
    ] {
        rows.push((name, filtered(&poses, filter)?));
    }
    let with = |velocity: &dyn Fn(&TrackedPose) -> DVec3| -> Result<Vec<Followed>, Box<dyn Error>> {
        let followed = filtered(&poses, VelocityFilter::Off)?;
        let pairs = followed.into_iter().zip(&poses);
        Ok(pairs.map(|(followed, pose)| Followed { velocity_m_s: velocity(pose), ..followed }).collect())
    };
    if poses.iter().all(|pose| pose.velocity_m_s.is_some()) {
        rows.push(("runtime", with(&|pose| pose.velocity_m_s.unwrap_or_default())?));
    }
    rows.push(("none", with(&|_| DVec3::ZERO)?));

    let first = poses[0].measured_s.unwrap_or_default();
    let seconds = poses[poses.len() - 1].measured_s.unwrap_or_default() - first;
    let fastest = rows[0].1.iter().map(|followed| followed.velocity_m_s.length()).fold(0.0, f64::max);
    println!("{} poses in {seconds:.1} s; the head moves at up to {fastest:.3} m/s\n", poses.len());
    println!("| filter | velocity, mm/s: RMS | 95 % | largest | next place, mm: RMS | 95 % | largest |");
    println!("|---|---|---|---|---|---|---|");
    for (name, followed) in rows {
        let (mut velocities, mut places) = (Vec::new(), Vec::new());
        for of in followed.windows(3).filter(|of| of[0].time_s < of[1].time_s && of[1].time_s < of[2].time_s) {
            let between = (of[2].position_m - of[0].position_m) / (of[2].time_s - of[0].time_s);
            velocities.push(1e3 * (of[1].velocity_m_s - between).length());
            let led = of[1].position_m + of[1].velocity_m_s * (of[2].time_s - of[1].time_s);
            places.push(1e3 * (of[2].position_m - led).length());
        }
        let cell = |value: f64| format!("{value:.2}");
        let cells: Vec<_> = [figures(velocities), figures(places)].concat().into_iter().map(cell).collect();
        println!("| {name} | {} |", cells.join(" | "));
    }
    Ok(())
}
