//! `rapidity check`: checks scenes, displays and recordings, and reports what is wrong with them.

use crate::command::CheckOptions;
use crate::error::Error;
use crate::output::say::{say, tell};
use crate::session::gaps::ShownTimes;
use input::recording::{Recording, RecordingEntry, RecordingError};
use room::Display;
use scene_files::panorama;
use std::path::Path;

/// Runs `rapidity check`: prints a paragraph for each file.
///
/// # Errors
/// [`Error::Checked`] if a file is not good. All files are checked first.
pub fn check(options: &CheckOptions) -> Result<(), Error> {
    let mut bad = 0;
    for path in &options.files {
        match report(path) {
            Ok(text) => say(format_args!("{}: good\n{text}", path.display()))?,
            Err(error) => {
                bad += 1;
                say(error)?;
            }
        }
    }
    if bad == 0 { Ok(()) } else { Err(Error::Checked { bad, files: options.files.len() }) }
}

fn report(path: &Path) -> Result<String, Error> {
    match path.extension().and_then(|extension| extension.to_str()) {
        Some("gltf" | "glb") => Ok(scene_files::check::check(path)?.to_string()),
        Some("mcap") => Ok(recording(path)?),
        _ if room::is_display(path) => Ok(Display::load(path)?.to_string()),
        _ if panorama::is_picture(path) => Ok(scene_files::check::check(path)?.to_string()),
        _ => Err(Error::UnknownKind { path: path.to_owned() }),
    }
}

/// Report on a recording that is complete.
fn recording(path: &Path) -> Result<String, RecordingError> {
    let mut recording = Recording::open(path)?;
    let header = recording.header().clone();
    let (mut samples, mut frames, mut last) = (0_u64, 0_u64, 0);
    let mut times = ShownTimes::default();
    for entry in recording.by_ref() {
        let entry = entry.inspect_err(|_| {
            tell(format_args!("{}: {frames} frames, {:.1} s, can be read", path.display(), last as f64 * 1e-9));
        })?;
        match entry {
            RecordingEntry::Sample(_) => samples += 1,
            RecordingEntry::Controls(_) => {}
            RecordingEntry::Frame(frame) => {
                frames += 1;
                last = frame.at;
                times.shown(frame.at);
            }
        }
    }
    let notices = [
        times.sentence(),
        recording.another().map(|offset| RecordingError::Another { path: path.to_owned(), offset }.to_string()),
    ];
    let notices: String = notices.into_iter().flatten().map(|notice| format!("\n  notice: {notice}")).collect();
    Ok(format!(
        "  a ride of {:.1} s in {}, {frames} frames, {samples} samples, recorded by version {}\n  light at {:.3} m/s, {} at {} s a step{notices}",
        last as f64 * 1e-9,
        header.scene,
        header.build,
        header.speed_of_light_m_s,
        header.integrator,
        header.step_s
    ))
}
