//! Law: MPCDI's profiles 3d and sl put every pixel in the direction, or on the point, that the file's angles give. A
//! wrong program would mirror a turn, or tilt a dome.
#![allow(clippy::unwrap_used, reason = "helpers of tests, too, may fail the test")]

use crate::containers::{load, pfm, zip};
use glam::{DVec2, DVec3};
use room::{Channel, Display, ScreenSurface};

/// Tolerance for numbers that went through f32.
const SINGLE: f64 = 1e-6;

/// Description with a region of 40 × 30 pixels that says `region`, and with the fileset `files`.
fn description(profile: &str, region: &str, files: &str) -> String {
    format!(
        r#"<?xml version="1.0"?><MPCDI profile="{profile}" geometry="2" color="1" version="2.0"><display><buffer id="b">
        <region id="r" x="0" y="0" xSize="1" ySize="1" xResolution="40" yResolution="30">{region}</region></buffer></display>
        <files><fileset region="r">{files}</fileset></files></MPCDI>"#
    )
}

fn frustum([yaw, pitch, roll]: [f64; 3], [left, right, down, up]: [f64; 4]) -> String {
    format!(
        "<frustum><yaw>{yaw}</yaw><pitch>{pitch}</pitch><roll>{roll}</roll><rightAngle>{right}</rightAngle>\
         <leftAngle>{left}</leftAngle><upAngle>{up}</upAngle><downAngle>{down}</downAngle></frustum>"
    )
}

const WARP: &str = "<geometryWarpFile><path>w.pfm</path><interpolation>linear</interpolation></geometryWarpFile>";

fn bare(xml: &str) -> Result<Display, room::DisplayError> {
    load("x.mpcdi.xml", xml.as_bytes())
}

/// Direction in which the resting head sees a place of a channel's viewport.
fn seen(display: &Display, x: f64, y: f64) -> Option<DVec3> {
    let point = display.channels[0].point(display, DVec2::new(x, y))?;
    Some((point - display.viewer.head_m).normalize())
}

#[test]
fn a_fixed_eye_sees_the_edges_at_the_angles_given() {
    let tan = |degrees: f64| degrees.to_radians().tan();
    let straight = pfm(&[&[[0.0, 0.0, 0.0], [1.0, 0.0, 0.0]], &[[0.0, 1.0, 0.0], [1.0, 1.0, 0.0]]], true);
    let angles = [-50.0, 35.0, -15.0, 25.0];
    let warped = description("3d", &frustum([0.0; 3], angles), WARP);
    for display in [
        load("x.mpcdi", &zip(&[("mpcdi.xml", warped.as_bytes()), ("w.pfm", &straight)])).unwrap(),
        bare(&description("3d", &frustum([0.0; 3], angles), "")).unwrap(),
    ] {
        assert_eq!((display.channels.len(), display.channels[0].size()), (1, [40, 30]));
        for (x, y) in [(0.0, 0.0), (0.25, 0.5), (0.5, 0.5), (1.0, 0.0), (0.0, 1.0), (1.0, 1.0), (0.7, 0.9)] {
            let seen = seen(&display, x, y).unwrap();
            // Tangents run evenly from the left edge to the right one and from the upper to the lower.
            let expected = [tan(-50.0) + x * (tan(35.0) - tan(-50.0)), tan(25.0) + y * (tan(-15.0) - tan(25.0))];
            let found = [-seen.x / seen.z, -seen.y / seen.z];
            assert!(seen.z < 0.0 && (0..2).all(|i| (found[i] - expected[i]).abs() < SINGLE), "{x} {y}: {found:?}");
        }
        assert!(display.notices.iter().any(|notice| notice.contains("eye that stays where it is")));
        assert!(display.to_string().contains("40 × 30 pixels"), "{display}");
    }
}

#[test]
fn a_warp_of_a_fixed_eye_says_what_a_pixel_shows() {
    // The right half of the picture on all of the raster; the lower left corner is unknown.
    let half = pfm(&[&[[0.5, 0.0, 0.0], [1.0, 0.0, 0.0]], &[[f32::NAN; 3], [1.0, 1.0, 0.0]]], true);
    let xml = description("3d", &frustum([0.0; 3], [-45.0, 45.0, -45.0, 45.0]), WARP);
    let display = load("x.mpcdi", &zip(&[("mpcdi.xml", xml.as_bytes()), ("w.pfm", &half)])).unwrap();
    let near = |found: Option<DVec3>, expected: DVec3| found.unwrap().distance(expected.normalize()) < SINGLE;
    assert!(near(seen(&display, 0.0, 0.0), DVec3::new(0.0, 1.0, -1.0)));
    assert!(near(seen(&display, 1.0, 0.0), DVec3::new(1.0, 1.0, -1.0)));
    assert!(near(seen(&display, 0.5, 0.25), DVec3::new(0.5, 0.5, -1.0)));
    assert_eq!(seen(&display, 0.1, 0.9), None);
}

#[test]
fn turns_are_to_the_right_upwards_and_clockwise_in_this_order() {
    let square = [-45.0, 45.0, -45.0, 45.0];
    let middle = |angles| seen(&bare(&description("3d", &frustum(angles, square), "")).unwrap(), 0.5, 0.5).unwrap();
    let upper = |angles| seen(&bare(&description("3d", &frustum(angles, square), "")).unwrap(), 0.5, 0.0).unwrap();
    let (sin, cos) = 30.0_f64.to_radians().sin_cos();
    assert!(middle([90.0, 0.0, 0.0]).distance(DVec3::X) < SINGLE);
    assert!(middle([0.0, 30.0, 0.0]).distance(DVec3::new(0.0, sin, -cos)) < SINGLE);
    // A viewer who rolls clockwise by a right angle has their upper side on the right.
    assert!(upper([0.0, 0.0, 90.0]).distance(DVec3::new(1.0, 0.0, -1.0).normalize()) < SINGLE);
    // First to the right, then up about the turned axis, then roll about the line of sight.
    assert!(middle([90.0, 30.0, 77.0]).distance(DVec3::new(cos, sin, 0.0)) < SINGLE);
    let turned = upper([90.0, 30.0, 90.0]);
    assert!(turned.distance((DVec3::new(cos, sin, 0.0) + DVec3::Z).normalize()) < SINGLE, "{turned}");
}

/// Coordinate frame of a surveyor: x right, y ahead, z up.
fn frame([x, y, z]: [f64; 3]) -> String {
    format!(
        "<coordinateFrame><posx>{x}</posx><posy>{y}</posy><posz>{z}</posz><yawx>0</yawx><yawy>0</yawy><yawz>-1</yawz>\
         <pitchx>1</pitchx><pitchy>0</pitchy><pitchz>0</pitchz><rollx>0</rollx><rolly>1</rolly><rollz>0</rollz>\
         </coordinateFrame>"
    )
}

/// Wall 2 m ahead of the origin, 2 m × 2 m, in a surveyor's centimetres.
fn wall() -> Vec<u8> {
    let [left, right, low, high] = [-100.0, 100.0, -100.0, 100.0];
    pfm(&[&[[left, 200.0, high], [right, 200.0, high]], &[[left, 200.0, low], [right, 200.0, low]]], true)
}

const POINTS: &str = "<geometryWarpFile><path>w.pfm</path><geometricUnit>cm</geometricUnit>\
                      <originOf3DData>centerOfMass</originOf3DData></geometryWarpFile>";

#[test]
fn a_shader_lamp_lights_the_points_before_its_lens() {
    let region = format!("{}{}", frustum([0.0; 3], [-45.0, 45.0, -45.0, 45.0]), frame([0.0, 150.0, 10.0]));
    let bend = pfm(&[&[[0.25, 0.0, 0.0], [0.75, 0.0, 0.0]], &[[0.25, 1.0, 0.0], [0.75, 1.0, 0.0]]], true);
    let plain = description("sl", &region, POINTS);
    let bent = plain.replace("</fileset>", "<distortionMap><path>d.pfm</path></distortionMap></fileset>");
    for (xml, [left, right]) in [(&plain, [-0.5, 0.5]), (&bent, [-0.25, 0.25])] {
        let files = [("mpcdi.xml", xml.as_bytes()), ("w.pfm", &wall()), ("d.pfm", &bend)];
        let display = load("x.mpcdi", &zip(&files)).unwrap();
        let ScreenSurface::Mesh(mesh) = &display.screens[0].surface else { panic!("no mesh") };
        assert!((mesh.size_m() - 8.0_f64.sqrt()).abs() < SINGLE);
        let projector = &display.projectors[0];
        assert!(projector.position_m.distance(DVec3::new(0.0, 0.1, -1.5)) < SINGLE && !projector.even);
        // From half a metre away, a picture of a right angle is 1 m wide.
        let point = |x, y| display.channels[0].point(&display, DVec2::new(x, y)).unwrap();
        assert!(point(0.0, 0.0).distance(DVec3::new(left, 0.6, -2.0)) < SINGLE, "{}", point(0.0, 0.0));
        assert!(point(1.0, 1.0).distance(DVec3::new(right, -0.4, -2.0)) < SINGLE);
        assert_eq!(display.viewer.head_m, projector.position_m, "the eye's place is not said");
        assert!(display.notices.iter().any(|notice| notice.contains("first projector")), "{:?}", display.notices);
        assert!(Channel::gains(&display.channels[0], &display, [4, 3]).is_none(), "maps do the blending");
    }
    let away = description("sl", &region.replace("<yaw>0</yaw>", "<yaw>180</yaw>"), POINTS);
    let display = load("x.mpcdi", &zip(&[("mpcdi.xml", away.as_bytes()), ("w.pfm", &wall())])).unwrap();
    assert_eq!(display.channels[0].point(&display, DVec2::splat(0.5)), None);
}

#[test]
fn shader_lamps_without_points_light_the_mesh_beside_their_file() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("head.mpcdi.xml");
    let region = format!("{}{}", frustum([0.0; 3], [-45.0, 45.0, -45.0, 45.0]), frame([0.0, -1.0, 0.0]));
    std::fs::write(&path, description("sl", &region, "")).unwrap();
    let missing = Display::load(&path).unwrap_err().to_string();
    assert!(
        missing.contains("region \"r\": it has no geometryWarpFile") && missing.contains("\"head.obj\""),
        "{missing}"
    );

    // A wall 1 m ahead of the origin, without places for pictures, one polygon.
    std::fs::write(folder.path().join("head.obj"), "v -4 1 -4\nv 4 1 -4\nv 4 1 4\nv -4 1 4\nf 1 2 3 4\n").unwrap();
    let display = Display::load(&path).unwrap();
    let point = display.channels[0].point(&display, DVec2::new(0.0, 0.0)).unwrap();
    assert!(point.distance(DVec3::new(-2.0, 2.0, -1.0)) < SINGLE, "{point}");
    // A quarter of the wall is lit: 22 % of the places that the report looks at.
    assert!(display.to_string().contains("22 % of it shown by 1 channel"), "{display}");
}

#[test]
fn lenses_and_frames_that_cannot_be_read_are_named() {
    let region = |angles, frame: &str| format!("{}{frame}", frustum([0.0; 3], angles));
    let good = [-20.0, 20.0, -20.0, 20.0];
    let plain = frame([0.0; 3]);
    for (profile, region, words) in [
        ("3d", region([20.0, -20.0, -20.0, 20.0], ""), "its angles are 20° to -20°"),
        ("3d", region([-90.0, 20.0, -20.0, 20.0], ""), "between -90° and 90°"),
        ("3d", region(good, "").replace("<roll>0</roll>", "<roll>x</roll>"), "<roll> \"x\" is no number"),
        ("3d", region(good, "").replace("<roll>0</roll>", ""), "it has no <roll>"),
        ("sl", region(good, ""), "it has no <coordinateFrame>"),
        ("sl", region(good, &plain.replace("<rolly>1", "<rolly>2")), "must be unit vectors at right angles"),
        ("sl", region(good, &plain.replace("<posx>0", "<posx>inf")), "<posx> \"inf\" is no number"),
    ] {
        let message = bare(&description(profile, &region, "")).unwrap_err().to_string();
        assert!(message.contains("region \"r\": ") && message.contains(words), "{message:?} does not say {words:?}");
    }
    let fish = description("sl", &region(good, &plain), "").replace(
        "</MPCDI>",
        "<extensionSet><extension name=\"BufferExtension\"><buffer id=\"b\"><region id=\"r\"><fisheye><f1>0.3</f1></fisheye>\
         </region></buffer></extension></extensionSet></MPCDI>",
    );
    let message = bare(&fish).unwrap_err().to_string();
    assert!(message.contains("fisheye"), "{message}");
}
