//! ParaView's wall and CAVE files. Each `Machine` has one flat screen, given by three corners in metres: y up, −z
//! ahead, the eyes at the origin.

use super::blank::blank;
use super::file_name::TakenNames;
use super::letters;
use super::xml;
use crate::channel::{Channel, ChannelPart};
use crate::display::{Display, Screen};
use crate::reflection::Reflection;
use crate::surface::flat::FlatSurface;
use crate::surface::shape::ScreenSurface;
use crate::viewer::EyeSide;
use crate::window::{Combine, Monitor, WindowPlace};
use glam::{DVec2, DVec3};
use roxmltree::Node;

/// Eye separation that ParaView uses when the file has none, metres.
const EYE_SEPARATION_M: f64 = 0.065;

/// Height of the window of a machine without `Geometry`, pixels.
const HEIGHT: f64 = 600.0;

/// Width of the window of a machine that has neither `Geometry` nor corners, over its height.
const ASPECT: f64 = 16.0 / 9.0;

/// Vertical field of view of a machine without corners, degrees: that of this program's windows.
const FIELD_DEG: f64 = 60.0;

/// Names of a machine's corners.
const CORNERS: [&str; 4] = ["LowerLeft", "LowerRight", "UpperRight", "UpperLeft"];

/// Reads a file. An error's text is worded to follow the file's name.
pub(crate) fn parse(bytes: &[u8]) -> Result<Display, String> {
    let text = letters::text(bytes);
    let document = xml::document(&text, "pvx")?;
    let root = document.root_element();
    let separation = xml::first(root, "EyeSeparation").map(|node| xml::number(node, "Value")).transpose()?;
    let mut display = blank(DVec3::ZERO);
    display.viewer.eye_separation_m = separation.unwrap_or(EYE_SEPARATION_M);
    if !(0.0..=1.0).contains(&display.viewer.eye_separation_m) {
        return Err(format!(
            "its eye separation of {} m is none; people have 0.05 to 0.08",
            display.viewer.eye_separation_m
        ));
    }
    let off_axis = xml::first(root, "UseOffAxisProjection").and_then(|node| xml::attribute(node, "Value"));
    let on_axis = off_axis.filter(|value| *value == "0" || value.eq_ignore_ascii_case("false"));
    let may_lack_corners = off_axis.is_none() || on_axis.is_some();
    let mut names = TakenNames::default();
    for machine in xml::all(root, "Machine") {
        let name = names.file_name(xml::attribute(machine, "Name").unwrap_or("screen"));
        add(&mut display, machine, name, may_lack_corners, &mut names)?;
    }
    if display.screens.is_empty() {
        return Err("it has no <Machine>, so there is no screen".into());
    }
    let has = |key: &str| xml::all(root, "Machine").any(|machine| xml::attribute(machine, key).is_some());
    if let Some(value) = on_axis.filter(|_| CORNERS.iter().any(|key| has(key))) {
        display.notices.push(format!(
            "UseOffAxisProjection is {value:?}: screens with corners are still seen from where the head is"
        ));
    }
    if has("ViewerId") {
        display.notices.push("ViewerId is not used: all screens are drawn for one viewer".into());
    }
    Ok(display)
}

/// Adds a machine's screen, window and channels. `may_lack_corners` is true if a machine without corners is an ordinary
/// window.
fn add(
    display: &mut Display,
    machine: Node<'_, '_>,
    name: String,
    may_lack_corners: bool,
    names: &mut TakenNames,
) -> Result<(), String> {
    let given = xml::attribute(machine, "Geometry");
    let given = given.map(|text| {
        geometry(text).ok_or_else(|| {
            format!(
                "{}: Geometry = {text:?} is not WIDTHxHEIGHT+X+Y in pixels, at least one each way",
                xml::place(machine)
            )
        })
    });
    let given = given.transpose()?;
    let ordinary = may_lack_corners && CORNERS.iter().all(|key| xml::attribute(machine, key).is_none());
    let flat = if ordinary {
        let aspect = given.map_or(ASPECT, |([width, height], _)| f64::from(width) / f64::from(height));
        display.notices.push(format!(
            "machine {name:?} has no corners: its window shows an ordinary view straight ahead, {FIELD_DEG}° high"
        ));
        let half = (0.5 * FIELD_DEG).to_radians().tan();
        FlatSurface::from_centre(DVec3::NEG_Z, DVec2::new(2.0 * half * aspect, 2.0 * half), DVec3::ZERO)
            .map_err(|error| format!("{}: {error}", xml::place(machine)))?
    } else {
        wall(machine)?
    };
    let (size, position) = given.unwrap_or_else(|| {
        let width = (HEIGHT * flat.size_m().x / flat.size_m().y).round().clamp(1.0, 8192.0);
        display.notices.push(format!("machine {name:?} has no Geometry: its window is {width} × {HEIGHT} pixels"));
        ([width as u32, HEIGHT as u32], None)
    });
    let index = display.screens.len();
    let mut window = WindowPlace {
        name: name.clone(),
        monitor: xml::attribute(machine, "Environment").and_then(monitor),
        position,
        size,
        fullscreen: xml::attribute(machine, "FullScreen")
            .is_some_and(|value| value != "0" && !value.eq_ignore_ascii_case("false")),
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
        let channel = if views.len() == 1 { name.clone() } else { names.file_name(&format!("{name}-{}", eye.name())) };
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

/// Rectangle of a machine's corners: the lower two and one of the upper ones. ParaView 3.8 to 3.10 had the left one,
/// later versions have the right one.
fn wall(machine: Node<'_, '_>) -> Result<FlatSurface, String> {
    let wrong = |error: &dyn std::fmt::Display| format!("{}: {error}", xml::place(machine));
    let (lower_left, lower_right) = (corner(machine, "LowerLeft")?, corner(machine, "LowerRight")?);
    let has = |key: &str| xml::attribute(machine, key).is_some();
    let upper_left = if has("UpperLeft") { Some(corner(machine, "UpperLeft")?) } else { None };
    let upper_right = match upper_left {
        Some(_) if !has("UpperRight") => None,
        _ => Some(corner(machine, "UpperRight")?),
    };
    let third = upper_left.or(upper_right.map(|corner| lower_left + corner - lower_right)).unwrap_or(lower_left);
    let flat = FlatSurface::from_corners(lower_left, lower_right, third).map_err(|error| wrong(&error))?;
    if let (Some(_), Some(corner)) = (upper_left, upper_right) {
        flat.closes(corner).map_err(|error| wrong(&error))?;
    }
    Ok(flat)
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
