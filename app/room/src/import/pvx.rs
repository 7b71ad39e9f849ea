//! ParaView's wall and CAVE files. Each `Machine` has one flat screen, given by three corners in metres: y up, −z
//! ahead, the eyes at the origin.

use super::file_name::file_name;
use super::xml;
use crate::channel::{Channel, ChannelPart};
use crate::display::{Display, Screen};
use crate::reflection::Reflection;
use crate::surface::flat::FlatSurface;
use crate::surface::shape::ScreenSurface;
use crate::viewer::{EyeSide, Viewer};
use crate::window::{Combine, Monitor, WindowPlace};
use glam::{DVec2, DVec3};
use roxmltree::Node;

/// Eye separation that ParaView uses when the file has none, metres.
const EYE_SEPARATION_M: f64 = 0.065;

/// Height of the window of a machine without `Geometry`, pixels.
const HEIGHT: f64 = 600.0;

/// Reads a file. An error's text is worded to follow the file's name.
pub(crate) fn parse(bytes: &[u8]) -> Result<Display, String> {
    let text = std::str::from_utf8(bytes).map_err(|_| "it is not UTF-8 text".to_owned())?;
    let document = xml::document(text, "pvx")?;
    let root = document.root_element();
    let separation = xml::first(root, "EyeSeparation").map(|node| xml::number(node, "Value")).transpose()?;
    let viewer =
        Viewer { eye_separation_m: separation.unwrap_or(EYE_SEPARATION_M), eye_scale: 1.0, head_m: DVec3::ZERO };
    if !(0.0..=1.0).contains(&viewer.eye_separation_m) {
        return Err(format!("its eye separation of {} m is none; people have 0.05 to 0.08", viewer.eye_separation_m));
    }
    let mut display = Display {
        name: String::new(),
        viewer,
        screens: Vec::new(),
        projectors: Vec::new(),
        windows: Vec::new(),
        channels: Vec::new(),
        tracker: None,
        notices: Vec::new(),
    };
    let mut names = Vec::new();
    for machine in xml::all(root, "Machine") {
        let name = file_name(xml::attribute(machine, "Name").unwrap_or("screen"), &mut names);
        add(&mut display, machine, name, &mut names)?;
    }
    if display.screens.is_empty() {
        return Err("it has no <Machine>, so there is no screen".into());
    }
    if xml::first(root, "UseOffAxisProjection").is_some_and(|node| xml::attribute(node, "Value") == Some("0")) {
        display.notices.push("UseOffAxisProjection is 0: screens are still seen from where the head is".into());
    }
    Ok(display)
}

/// Adds a machine's screen, window and channels.
fn add(display: &mut Display, machine: Node<'_, '_>, name: String, names: &mut Vec<String>) -> Result<(), String> {
    let [lower_left, lower_right, upper_right] =
        ["LowerLeft", "LowerRight", "UpperRight"].map(|key| corner(machine, key));
    let (lower_left, lower_right, upper_right) = (lower_left?, lower_right?, upper_right?);
    let flat = FlatSurface::from_corners(lower_left, lower_right, lower_left + upper_right - lower_right)
        .map_err(|error| format!("{}: {error}", xml::place(machine)))?;
    let (size, position) = match xml::attribute(machine, "Geometry") {
        Some(text) => geometry(text).ok_or_else(|| {
            format!(
                "{}: Geometry = {text:?} is not WIDTHxHEIGHT+X+Y in pixels, at least one each way",
                xml::place(machine)
            )
        })?,
        None => {
            let width = (HEIGHT * flat.size_m().x / flat.size_m().y).round().clamp(1.0, 8192.0);
            display.notices.push(format!("machine {name:?} has no Geometry: its window is {width} × {HEIGHT} pixels"));
            ([width as u32, HEIGHT as u32], None)
        }
    };
    let index = display.screens.len();
    let mut window = WindowPlace {
        name: name.clone(),
        monitor: xml::attribute(machine, "Environment").and_then(monitor),
        position,
        size,
        fullscreen: xml::attribute(machine, "FullScreen").is_some_and(|value| value != "0"),
        combine: Combine::None,
        swap_eyes: false,
    };
    let whole = [0, 0, size[0], size[1]];
    let half = size[0] / 2;
    let both = |combine| (combine, vec![(EyeSide::Left, whole), (EyeSide::Right, whole)]);
    let stereo = xml::attribute(machine, "StereoType").unwrap_or_default();
    let (combine, views) = match stereo {
        "" => (Combine::None, vec![(EyeSide::Centre, whole)]),
        "Left" => (Combine::None, vec![(EyeSide::Left, whole)]),
        "Right" => (Combine::None, vec![(EyeSide::Right, whole)]),
        "Interlaced" => both(Combine::Rows),
        "Dresden" => both(Combine::Columns),
        "Checkerboard" => both(Combine::Checker),
        "Red-Blue" => both(Combine::AnaglyphGrey),
        "Anaglyph" => both(Combine::AnaglyphDubois),
        "SplitViewportHorizontal" if half > 0 => {
            (Combine::None, vec![(EyeSide::Left, [0, 0, half, size[1]]), (EyeSide::Right, [half, 0, half, size[1]])])
        }
        other => {
            display
                .notices
                .push(format!("machine {name:?}: stereo {other:?} is not to be had; it is shown to both eyes alike"));
            (Combine::None, vec![(EyeSide::Centre, whole)])
        }
    };
    window.combine = combine;
    if combine.is_anaglyph() {
        display.notices.push(format!("machine {name:?}: an anaglyph tells the eyes apart by colour, so it cannot show the Doppler shift's colours too"));
    }
    display.windows.push(window);
    for (eye, viewport) in &views {
        let channel = if views.len() == 1 { name.clone() } else { file_name(&format!("{name}-{}", eye.name()), names) };
        display.channels.push(Channel {
            name: channel,
            screen: index,
            eye: *eye,
            window: index,
            viewport: *viewport,
            part: ChannelPart { from: DVec2::ZERO, to: DVec2::ONE },
            warp: None,
            projector: None,
            alpha: None,
            beta: None,
        });
    }
    display.screens.push(Screen { name, surface: ScreenSurface::Flat(flat), reflection: Reflection::default() });
    Ok(())
}

fn corner(machine: Node<'_, '_>, key: &str) -> Result<DVec3, String> {
    let text = xml::attribute(machine, key).ok_or_else(|| format!("{}: it has no {key}", xml::place(machine)))?;
    let numbers: Vec<f64> = text.split_whitespace().filter_map(|word| word.parse().ok()).collect();
    match numbers.as_slice() {
        [x, y, z] if text.split_whitespace().count() == 3 => Ok(DVec3::new(*x, *y, *z)),
        _ => Err(format!("{}: {key} = {text:?} is not three numbers", xml::place(machine))),
    }
}

/// Width and height, pixels, and the window's place, if one is given.
type WindowGeometry = ([u32; 2], Option<[i32; 2]>);

/// Size and place from `WxH+X+Y`, as X11 writes them.
fn geometry(text: &str) -> Option<WindowGeometry> {
    let (width, rest) = text.split_once(['x', 'X'])?;
    let end = rest.find(['+', '-']).unwrap_or(rest.len());
    let size = [width.parse().ok()?, rest[..end].parse().ok()?];
    if size.iter().any(|side| !(1..=65_536).contains(side)) {
        return None;
    }
    let place = &rest[end..];
    if place.is_empty() {
        return Some((size, None));
    }
    let second = 1 + place[1..].find(['+', '-'])?;
    Some((size, Some([place[..second].parse().ok()?, place[second..].parse().ok()?])))
}

/// Monitor from the screen number in `DISPLAY=:0.1`.
fn monitor(environment: &str) -> Option<Monitor> {
    let display = environment.split_whitespace().find_map(|word| word.strip_prefix("DISPLAY="))?;
    let (_, numbers) = display.rsplit_once(':')?;
    Some(Monitor::Index(numbers.split_once('.')?.1.parse().ok()?))
}
