//! `rapidity check`: checks scenes, displays and recordings, and reports what is wrong with them.

use crate::error::Error;
use crate::output::say::{say, say_exactly, tell};
use command::{CheckOptions, ReadingOptions};
use hardware::SetUp;
use input::recording::{Recording, RecordingEntry, RecordingError};
use ride::ShownTimes;
use room::Display;
use scene_files::gltf::ReadRules;
use serde_json::{Value, json};
use std::io::Read;
use std::path::Path;

/// Report on a file that can be used, as text and as the members of a JSON object.
struct Good {
    /// Kind of the file, in a word.
    kind: &'static str,
    text: String,
    members: Value,
}

/// Runs `rapidity check`: prints a paragraph for each file, or a JSON object.
///
/// # Errors
/// [`Error::Checked`] if a file is not good. All files are checked first.
pub fn check(options: &CheckOptions) -> Result<(), Error> {
    options.passed_over().iter().for_each(tell);
    let mut bad = 0;
    for path in &options.files {
        let found = report(path, &options.reading);
        bad += usize::from(found.is_err());
        let path = path.display();
        let text = match (found, options.json) {
            (Ok(good), false) => format!("{path}: good\n{}", good.text),
            (Err(error), false) => error.to_string(),
            (Ok(good), true) => {
                let mut object = json!({ "file": path.to_string(), "good": true, "kind": good.kind });
                if let (Value::Object(object), Value::Object(members)) = (&mut object, good.members) {
                    object.extend(members);
                }
                object.to_string()
            }
            (Err(error), true) => {
                json!({ "file": path.to_string(), "good": false, "error": error.to_string() }).to_string()
            }
        };
        if options.json { say_exactly(text)? } else { say(text)? }
    }
    if bad == 0 { Ok(()) } else { Err(Error::Checked { bad, files: options.files.len() }) }
}

fn report(path: &Path, reading: &ReadingOptions) -> Result<Good, Error> {
    let budget = reading.budget();
    let rules = ReadRules { budget: &budget, trust: reading.trust };
    let ending = path.extension().and_then(|extension| extension.to_str()).map(str::to_ascii_lowercase);
    match ending.as_deref() {
        Some("gltf" | "glb") => scene("scene", path, rules),
        Some("mcap") => Ok(recording(path)?),
        Some("toml") if SetUp::of(None, Some(path)).is_ok_and(|set_up| !set_up.is_empty()) => {
            SetUp::of(None, Some(path))?.check()?;
            let text = "  a rider's hardware, for --set-up".to_owned();
            Ok(Good { kind: "set-up", text, members: json!({}) })
        }
        _ if room::is_display(path) => {
            let display = Display::load_within(path, &budget)?;
            SetUp::of(Some(&display), None)?.check()?;
            let members = json!({ "notices": display.notices });
            Ok(Good { kind: "display", text: display.to_string(), members })
        }
        _ if panoramas::is_picture(path) => scene("panorama", path, rules),
        _ if is_glb(path) => scene("scene", path, rules),
        _ => Err(Error::UnknownKind { path: path.to_owned() }),
    }
}

/// True if a file begins as a `.glb` does, whatever the ending of its name: models of other programs do.
fn is_glb(path: &Path) -> bool {
    let mut start = [0; 4];
    regular_file::open(path).is_ok_and(|mut file| file.read_exact(&mut start).is_ok() && &start == b"glTF")
}

fn scene(kind: &'static str, path: &Path, rules: ReadRules<'_>) -> Result<Good, Error> {
    let report = scene_files::check::check(path, rules)?;
    Ok(Good { kind, text: report.to_string(), members: report.to_json() })
}

/// Report on a recording that is complete.
fn recording(path: &Path) -> Result<Good, RecordingError> {
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
    let seconds = last as f64 * 1e-9;
    let another = recording.another().map(|offset| RecordingError::Another { path: path.to_owned(), offset });
    let notices: Vec<String> = times.sentence().into_iter().chain(another.map(|another| another.to_string())).collect();
    let said: String = notices.iter().map(|notice| format!("\n  notice: {notice}")).collect();
    let text = format!(
        "  a ride of {seconds:.1} s in {}, {frames} frames, {samples} samples, recorded by version {}\n  light at {:.3} m/s, {} at {} s a step{said}",
        header.scene, header.build, header.speed_of_light_m_s, header.integrator, header.step_s
    );
    let members = json!({
        "scene": header.scene,
        "seconds": seconds,
        "frames": frames,
        "samples": samples,
        "version": header.build,
        "speedOfLight": header.speed_of_light_m_s,
        "notices": notices,
    });
    Ok(Good { kind: "recording", text, members })
}
