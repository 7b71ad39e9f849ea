//! Law: displays of other programs are imported with their meaning. A wrong program would show them upside down,
//! mirrored, or in the wrong size.
#![allow(clippy::unwrap_used, reason = "helpers of tests, too, may fail the test")]

use crate::containers::{load, pfm, png, zip};
use glam::{DVec2, DVec3};
use room::{Combine, Display, DisplayError, EyeSide, Monitor, ScreenSurface};

/// Tolerance, metres, for the f32 of the files.
const SINGLE: f64 = 1e-6;

/// Description of version 2.0 with two projectors whose surface points are known.
const SOLID: &str = r#"<?xml version="1.0" encoding="utf-8"?>
<MPCDI profile="a3" geometry="2" color="2" date="2024-01-02 03:04:05" version="2.0">
  <display>
    <buffer id="b" xResolution="8" yResolution="4">
      <region id="left" x="0" y="0" xSize="0.5" ySize="1" xResolution="4" yResolution="2"/>
      <region id="right" x="0.5" y="0" xSize="0.5" ySize="1" xResolution="4" yResolution="2"/>
    </buffer>
  </display>
  <files>
    <fileset region="left">
      <geometryWarpFile>
        <path>.\maps\left.pfm</path><interpolation>linear</interpolation>
        <geometricUnit>cm</geometricUnit><originOf3DData>idealEyePoint</originOf3DData>
      </geometryWarpFile>
      <alphaMap><path>left.png</path><componentDepth>1</componentDepth><bitDepth>8</bitDepth><gammaEmbedded>2.0</gammaEmbedded></alphaMap>
      <betaMap><path>beta.png</path><componentDepth>1</componentDepth><bitDepth>8</bitDepth></betaMap>
    </fileset>
    <fileset region="right">
      <geometryWarpFile>
        <path>right.pfm</path><interpolation>linear</interpolation>
        <geometricUnit>cm</geometricUnit><originOf3DData>idealEyePoint</originOf3DData>
      </geometryWarpFile>
    </fileset>
  </files>
</MPCDI>"#;

/// Surface points of the left projector, centimetres; x to the left, y up, z into the screen: a wall 2 m before the
/// eye, from 1 m left of it to its middle, 1 m high to 1 m low; the middle row is 10 cm nearer.
const LEFT: [[[f32; 3]; 2]; 3] = [
    [[100.0, 100.0, 200.0], [0.0, 100.0, 200.0]],
    [[100.0, 0.0, 190.0], [0.0, 0.0, 190.0]],
    [[100.0, -100.0, 200.0], [0.0, -100.0, 200.0]],
];

fn solid(little: bool) -> Vec<u8> {
    let nan = f32::NAN;
    let right = [
        [[0.0, 100.0, 200.0], [-50.0, 100.0, 200.0], [nan, nan, nan]],
        [[0.0, -100.0, 200.0], [-50.0, -100.0, 200.0], [-100.0, -100.0, 200.0]],
    ];
    zip(&[
        ("mpcdi.xml", SOLID.as_bytes()),
        ("maps/LEFT.PFM", &pfm(&LEFT.each_ref().map(|row| row.as_slice()), little)),
        ("right.pfm", &pfm(&right.each_ref().map(|row| row.as_slice()), little)),
        ("left.png", &png(2, 1, &[255, 128])),
        ("beta.png", &png(1, 1, &[51])),
    ])
}

#[test]
fn profile_a3_puts_pixels_on_the_points_it_gives() {
    for little in [true, false] {
        let display = load("wall.mpcdi", &solid(little)).unwrap();
        assert_eq!((display.name.as_str(), display.screens.len(), display.channels.len()), ("wall", 2, 2));
        assert_eq!(display.viewer.head_m, DVec3::ZERO, "the ideal eye point");
        let point = |channel: usize, x, y| display.channels[channel].point(&display, DVec2::new(x, y));
        let near = |found: Option<DVec3>, expected: [f64; 3]| {
            assert!(found.unwrap().distance(expected.into()) < SINGLE, "{found:?} {expected:?}");
        };
        // The upper left pixel is on the left and above, whatever the file's order of rows.
        near(point(0, 0.0, 0.0), [-1.0, 1.0, -2.0]);
        near(point(0, 1.0, 0.0), [0.0, 1.0, -2.0]);
        near(point(0, 0.0, 1.0), [-1.0, -1.0, -2.0]);
        near(point(0, 0.5, 0.25), [-0.5, 0.5, -1.95]);
        near(point(1, 0.5, 1.0), [0.5, -1.0, -2.0]);
        near(point(1, 0.25, 0.5), [0.25, 0.0, -2.0]);
        assert_eq!(point(1, 0.9, 0.1), None, "unknown points are holes");
        let ScreenSurface::Mesh(mesh) = &display.screens[0].surface else { panic!("no mesh") };
        assert_eq!(mesh.triangles().len(), 4);
        // Every region is a window of its own on an output of its own.
        assert_eq!(display.windows[1].monitor, Some(Monitor::Index(1)));
        assert_eq!((display.windows[0].size, display.windows[0].fullscreen), ([4, 2], true));
    }
}

#[test]
fn alpha_and_beta_become_gains_in_linear_light() {
    let display = load("wall.mpcdi", &solid(true)).unwrap();
    let gains = display.channels[0].gains(&display, [2, 1]).unwrap();
    // The file has beta = 51/255 = 0.2 and alpha = (value/255)²: out = in · alpha · (1 − beta) + beta.
    let alpha = (128.0_f32 / 255.0).powi(2);
    for (found, expected) in gains.factors.iter().zip([0.8, 0.8 * alpha]) {
        assert!((found - expected).abs() < 1e-5, "{found} {expected}");
    }
    assert!(gains.lifts.unwrap().iter().all(|lift| (lift - 0.2).abs() < 1e-5));
    assert!(display.channels[1].gains(&display, [2, 1]).is_none());
}

/// Description of version 1.0: `level`, other spellings, one region of a picture of 2 : 1.
const FLAT: &str = r#"<mpcdi profile="2d" level="1" date="2013-02-01 10:00:00" version="1.0"><display>
<buffer id="front" Xresolution="2000" Yresolution="1000">
<region id="p/1" Xresolution="4" Yresolution="4" x="0.5" y="0.0" xsize="0.5" ysize="0.5"/></buffer></display>
<files></files><fileset region="p/1"><geometrywarpfile><path>w.pfm</path></geometrywarpfile></fileset></mpcdi>"#;

#[test]
fn profile_2d_warps_its_part_of_a_flat_picture() {
    // The projector stands to the right: its picture is narrower above.
    let warp = pfm(&[&[[-0.25, 0.0, 0.0], [1.25, 0.0, 0.0]], &[[0.0, 1.0, 0.0], [1.0, 1.0, 0.0]]], true);
    let display = load("flat.mpcdi", &zip(&[("mpcdi.xml", FLAT.as_bytes()), ("w.pfm", &warp)])).unwrap();
    // The screen is flat, 4 m × 2 m, 2 m before the head; the region is its right upper quarter.
    let ScreenSurface::Flat(flat) = display.screens[0].surface else { panic!("not flat") };
    assert_eq!(flat.size_m(), DVec2::new(4.0, 2.0));
    assert!(display.notices.iter().any(|notice| notice.contains("2d")), "{:?}", display.notices);
    let channel = &display.channels[0];
    assert_eq!(channel.name, "p-1", "names are made fit for files");
    let point = |x, y| channel.point(&display, DVec2::new(x, y)).map(|point| point - display.viewer.head_m);
    assert!(point(0.0, 1.0).unwrap().distance(DVec3::new(0.0, 0.0, -2.0)) < SINGLE);
    assert!(point(1.0, 1.0).unwrap().distance(DVec3::new(2.0, 0.0, -2.0)) < SINGLE);
    assert_eq!(point(0.0, 0.0), None, "beyond the picture is black");
    let above = point(0.5, 0.0).unwrap();
    assert!(above.distance(DVec3::new(1.0, 1.0, -2.0)) < SINGLE, "{above}");
    // Without a resolution of the whole, that of the part tells its shape: 4 × 4 pixels are a quarter.
    let bare = FLAT.replace(" Xresolution=\"2000\" Yresolution=\"1000\"", "");
    let display = load("flat.mpcdi", &zip(&[("mpcdi.xml", bare.as_bytes()), ("w.pfm", &warp)])).unwrap();
    let ScreenSurface::Flat(flat) = display.screens[0].surface else { panic!("not flat") };
    assert_eq!(flat.size_m(), DVec2::new(4.0, 4.0));
}

#[test]
fn a_bare_description_has_its_maps_beside_it() {
    let folder = tempfile::tempdir().unwrap();
    std::fs::write(folder.path().join("x.mpcdi.xml"), FLAT).unwrap();
    let path = folder.path().join("x.mpcdi.xml");
    assert!(Display::load(&path).unwrap_err().to_string().contains("w.pfm"));
    let straight = pfm(&[&[[0.0, 0.0, 0.0], [1.0, 0.0, 0.0]], &[[0.0, 1.0, 0.0], [1.0, 1.0, 0.0]]], true);
    std::fs::write(folder.path().join("w.pfm"), straight).unwrap();
    assert_eq!(Display::load(&path).unwrap().name, "x");
    // Maps outside the folder are refused.
    std::fs::write(&path, FLAT.replace("w.pfm", "../w.pfm")).unwrap();
    assert!(Display::load(&path).unwrap_err().to_string().contains("not beside it"));
}

#[test]
fn containers_with_flaws_are_refused_with_the_reason() {
    let container = |xml: &str, warp: &[u8]| load("x.mpcdi", &zip(&[("mpcdi.xml", xml.as_bytes()), ("w.pfm", warp)]));
    let straight = pfm(&[&[[0.0, 0.0, 0.0], [1.0, 0.0, 0.0]], &[[0.0, 1.0, 0.0], [1.0, 1.0, 0.0]]], true);
    assert!(container(FLAT, &straight).is_ok());
    let cases: [(Result<Display, DisplayError>, &str); 16] = [
        (load("x.mpcdi", b"PK\x03\x04 and nothing"), "no good zip"),
        (load("x.mpcdi", &zip(&[("other.xml", b"")])), "no \"mpcdi.xml\" in it"),
        (load("x.mpcdi", b"\xff\xfe"), "no XML"),
        (load("x.mpcdi", b"<a/>"), "its root is <a>"),
        (load("x.mpcdi", b"<MPCDI profile='2d'>"), "no XML"),
        (load("x.mpcdi", b"<MPCDI profile='2d'/>"), "no <region>"),
        (container(&FLAT.replace("2d", "4d"), &straight), "its profile is \"4d\"; the profiles are 2d, 3d, a3 and sl"),
        (container(&FLAT.replace("2d", "3d"), &straight), "it has no <frustum>"),
        (
            container(&FLAT.replace("\"2d\"", "\"a3\"").replace("<path>w.pfm</path>", ""), &straight),
            "needs its geometryWarpFile",
        ),
        (container(&FLAT.replace("xsize=\"0.5\"", "xsize=\"0.6\""), &straight), "no part of its buffer"),
        (container(&FLAT.replace("Xresolution=\"4\"", "Xresolution=\"0\""), &straight), "no raster"),
        (container(&FLAT.replace("Xresolution=\"4\"", ""), &straight), "line 3, <region>: it has no xResolution"),
        (container(FLAT, &straight[..straight.len() - 1]), "cut short"),
        (container(FLAT, b"P6\n2 2\n255\n"), "not with PF"),
        (container(FLAT, b"PF\n1 1\n-1\n012301230123"), "at least 2 × 2"),
        (container(FLAT, b"PF\n9999999 9999999\n-1\n"), "can be read"),
    ];
    for (result, word) in cases {
        let message = result.expect_err(word).to_string();
        assert!(message.contains(word) && message.contains("x.mpcdi"), "{message:?} does not say {word:?}");
    }
}

#[test]
fn cut_and_spoilt_containers_end_in_words() {
    let good = solid(true);
    for length in (0..good.len()).step_by(7) {
        assert!(load("x.mpcdi", &good[..length]).is_err(), "{length}");
    }
    for at in (0..good.len()).step_by(5) {
        let mut spoilt = good.clone();
        spoilt[at] ^= 0x55;
        // The load returns, with a display or an error.
        let _ = load("x.mpcdi", &spoilt).map(|display| display.to_string());
    }
}

/// ParaView file of two walls at a right angle, an eye each, and one in between.
const WALLS: &str = r#"<?xml version="1.0"?>
<!-- a corner -->
<pvx>
  <Process Type="render-server">
    <EyeSeparation Value="0.07"/>
    <Machine Name="node" Environment="DISPLAY=:0.1" Geometry="640x480+20-30" FullScreen="0" StereoType="Left"
      LowerLeft="-1 -1 -1.5" LowerRight="1 -1 -1.5" UpperRight="1 1 -1.5"/>
    <Machine Name="node" Geometry="640x480" FullScreen="1" StereoType="Right"
      LowerLeft="1 -1 -1.5" LowerRight="1.0 -1 1.5" UpperRight="1 1 1.5"/>
    <Machine Name="a/b" Geometry="101x50+0+0" StereoType="SplitViewportHorizontal"
      LowerLeft="-1 -1 -1.5" LowerRight="1 -1 -1.5" UpperRight="1 1 -1.5"/>
    <Machine Geometry="64x64" StereoType="Anaglyph" LowerLeft="-1 -1 -1.5" LowerRight="1 -1 -1.5" UpperRight="1 1 -1.5"/>
    <Machine StereoType="Crystal Eyes" LowerLeft="-1 -1 -1.5" LowerRight="1 -1 -1.5" UpperRight="1 1 -1.5"/>
  </Process>
</pvx>"#;

#[test]
fn paraviews_walls_are_read() {
    let display = load("corner.pvx", WALLS.as_bytes()).unwrap();
    assert_eq!((display.name.as_str(), display.viewer.eye_separation_m), ("corner", 0.07));
    assert_eq!(display.viewer.head_m, DVec3::ZERO);
    let ScreenSurface::Flat(wall) = display.screens[1].surface else { panic!("not flat") };
    assert_eq!((wall.lower_left, wall.right, wall.up), (DVec3::new(1.0, -1.0, -1.5), DVec3::Z * 3.0, DVec3::Y * 2.0));
    assert_eq!(wall.normal(), DVec3::NEG_X);
    let window = &display.windows[0];
    assert_eq!((window.size, window.position, window.fullscreen), ([640, 480], Some([20, -30]), false));
    assert_eq!(window.monitor, Some(Monitor::Index(1)));
    assert_eq!((display.windows[1].position, display.windows[1].fullscreen), (None, true));
    let channels: Vec<(&str, EyeSide, [u32; 4])> =
        display.channels.iter().map(|channel| (channel.name.as_str(), channel.eye, channel.viewport)).collect();
    assert_eq!(
        channels,
        [
            ("node", EyeSide::Left, [0, 0, 640, 480]),
            ("node-2", EyeSide::Right, [0, 0, 640, 480]),
            ("a-b-left", EyeSide::Left, [0, 0, 50, 50]),
            ("a-b-right", EyeSide::Right, [50, 0, 50, 50]),
            ("screen-left", EyeSide::Left, [0, 0, 64, 64]),
            ("screen-right", EyeSide::Right, [0, 0, 64, 64]),
            ("screen-2", EyeSide::Centre, [0, 0, 600, 600]),
        ]
    );
    assert_eq!(display.windows[3].combine, Combine::AnaglyphDubois);
    for word in ["Crystal Eyes", "no Geometry", "Doppler"] {
        assert!(display.notices.iter().any(|notice| notice.contains(word)), "{word}: {:?}", display.notices);
    }
}

#[test]
fn paraviews_walls_with_flaws_are_refused_with_the_reason() {
    for (from, to, word) in [
        (
            "UpperRight=\"1 1 -1.5\"",
            "UpperRight=\"1 1\"",
            "line 6, <Machine>: UpperRight = \"1 1\" is not three numbers",
        ),
        ("UpperRight=\"1 1 -1.5\"", "UpperRight=\"2 1 -1.5\"", "no rectangle"),
        ("UpperRight=\"1 1 -1.5\"", "UpperRight=\"1 NaN -1.5\"", "length"),
        ("LowerRight=\"1 -1 -1.5\"", "", "it has no LowerRight"),
        ("640x480+20-30", "640x0", "is not WIDTHxHEIGHT+X+Y"),
        ("640x480+20-30", "640x480+20", "is not WIDTHxHEIGHT+X+Y"),
        ("640x480+20-30", "640x480+é-", "is not WIDTHxHEIGHT+X+Y"),
        ("0.07", "x", "Value = \"x\" is no number"),
        ("0.07", "-1", "eye separation"),
        ("Machine", "Engine", "no <Machine>"),
    ] {
        let text = if from == "Machine" { WALLS.replace(from, to) } else { WALLS.replacen(from, to, 1) };
        let message = load("x.pvx", text.as_bytes()).expect_err(word).to_string();
        assert!(message.contains(word) && message.contains("x.pvx"), "{message:?} does not say {word:?}");
    }
    let behind = "<pvx><Machine Name='m' LowerLeft='-1 -1 1' LowerRight='1 -1 1' UpperRight='1 1 1'/></pvx>";
    let message = load("x.pvx", behind.as_bytes()).unwrap_err().to_string();
    assert!(message.contains("channel \"m\"") && message.contains("1.000 m behind"), "{message}");
}
