//! Laws: maps of surfaces, frusta and warps are inverse to each other. A wrong sign here turns a wall round, with
//! every picture on it.
#![allow(clippy::unwrap_used, reason = "helpers of tests, too, may fail the test")]

use glam::{DVec2, DVec3};
use rand::{RngExt, SeedableRng};
use room::surface::sweep;
use room::{
    CornerWarp, CylinderSurface, FlatSurface, MeasuredWarp, MeshSurface, ScreenSurface, SphereSurface, Warp, frustum,
    room_from_turned,
};
use view::Tangents;

/// Tolerance for the rounding of a few operations on metres.
const ROUNDING: f64 = 1e-12;

/// Tolerance of uv: rays within a micrometre's angle of a mesh's edges and poles lose digits.
const PLACE: f64 = 1e-9;

fn places(count: usize) -> impl Iterator<Item = DVec2> {
    let mut random = rand_chacha::ChaCha8Rng::seed_from_u64(5);
    (0..count).map(move |_| DVec2::new(random.random(), random.random()))
}

fn flat() -> FlatSurface {
    FlatSurface::from_centre(DVec3::new(0.3, 1.4, -2.0), DVec2::new(3.0, 2.0), DVec3::new(20.0, -10.0, 5.0)).unwrap()
}

/// Surfaces of every kind, each with its name and a point in front of it.
fn surfaces() -> Vec<(&'static str, ScreenSurface, DVec3)> {
    let cylinder = CylinderSurface {
        centre: DVec3::new(0.5, 0.1, -0.2),
        radius_m: 3.0,
        left_rad: 1.9,
        right_rad: -1.2,
        bottom_m: 0.2,
        top_m: 2.5,
    };
    let sphere = SphereSurface {
        centre: DVec3::new(0.0, 1.0, 0.3),
        radius_m: 4.0,
        left_rad: 3.0,
        right_rad: -2.0,
        bottom_rad: -0.3,
        top_rad: 1.5,
    };
    let whole = SphereSurface { left_rad: std::f64::consts::PI, right_rad: -std::f64::consts::PI, ..sphere };
    let profile = [DVec2::new(0.0, 1.0), DVec2::new(0.0, 0.0), DVec2::new(2.0, -0.3)];
    let sheet = sweep(DVec3::new(0.0, 0.0, -3.0), 4.0, &profile, 0.4).unwrap();
    let points = (0..5 * 4).map(|i| {
        let (x, y) = (f64::from(i % 5) / 4.0, f64::from(i / 5) / 3.0);
        DVec3::new(4.0 * x - 2.0, 3.0 * y, -3.0 + (x - 0.4) * (x - 0.4) + 0.2 * y)
    });
    vec![
        ("flat", ScreenSurface::Flat(flat()), DVec3::new(0.0, 1.6, 0.0)),
        ("cylinder", ScreenSurface::Cylinder(cylinder), DVec3::new(0.4, 1.6, -0.1)),
        ("sphere", ScreenSurface::Sphere(sphere), DVec3::new(0.4, 1.6, -0.1)),
        ("whole sphere", ScreenSurface::Sphere(whole), DVec3::new(0.4, 1.6, -0.1)),
        ("sheet", ScreenSurface::Mesh(Box::new(sheet)), DVec3::new(0.3, 1.6, -0.5)),
        ("grid", ScreenSurface::Mesh(Box::new(MeshSurface::grid(5, 4, points.collect()))), DVec3::new(0.3, 1.6, 1.0)),
    ]
}

#[test]
fn a_ray_to_a_place_hits_that_place() {
    for (name, surface, eye) in surfaces() {
        for uv in places(2000) {
            let point = surface.point(uv).unwrap();
            // The ray's distance is measured in units of the direction's length.
            let hit = surface.hit(eye, 0.5 * (point - eye)).unwrap_or_else(|| panic!("{name} {uv} is not hit"));
            assert!((hit.distance - 2.0).abs() < PLACE, "{name} {uv}: {}", hit.distance);
            assert!(hit.point.distance(point) < PLACE, "{name} {uv}");
            assert!(hit.uv.distance(uv) < PLACE, "{name} {uv}: {}", hit.uv);
            assert!(hit.normal.dot(eye - point) > 0.0, "{name} {uv}: the normal points away from the viewer");
            assert!((hit.normal.length() - 1.0).abs() < ROUNDING);
            assert!(surface.uv(point).unwrap().distance(uv) < 1e-6, "{name} {uv}");
        }
    }
}

#[test]
fn a_surface_is_seen_with_its_left_on_the_left() {
    // At the middle, u, v and the normal are right-handed.
    for (name, surface, _) in surfaces() {
        let at = |u: f64, v: f64| surface.point(DVec2::new(u, v)).unwrap();
        let (u, v) = (at(0.503, 0.71) - at(0.497, 0.71), at(0.5, 0.713) - at(0.5, 0.707));
        let normal = surface.normal(DVec2::new(0.5, 0.71)).unwrap();
        assert!(u.cross(v).normalize().dot(normal) > 0.99, "{name}");
    }
}

#[test]
fn rays_that_miss_hit_nothing() {
    for (name, surface, eye) in surfaces() {
        let centre = surface.point(DVec2::splat(0.5)).unwrap();
        assert!(surface.hit(centre, eye - centre).is_none_or(|hit| hit.distance > 1.0), "{name}: hit itself");
        assert!(surface.hit(eye, DVec3::new(f64::NAN, 0.0, 0.0)).is_none(), "{name}");
    }
    let ScreenSurface::Flat(flat) = surfaces().remove(0).1 else { panic!() };
    let beyond = flat.point(DVec2::new(1.001, 0.5));
    assert!(ScreenSurface::Flat(flat).hit(DVec3::Y, beyond - DVec3::Y).is_none());
    assert!(ScreenSurface::Flat(flat).hit(DVec3::Y, DVec3::Y - beyond).is_none(), "behind the ray");
}

#[test]
fn what_draws_the_room_gets_the_surface_itself() {
    for (name, surface, eye) in surfaces() {
        let mesh = surface.to_mesh(33, 33);
        for (point, uv) in mesh.points().iter().zip(mesh.uvs()) {
            assert!(point.distance(surface.point(*uv).unwrap()) < ROUNDING, "{name}");
        }
        for corners in mesh.triangles() {
            let [a, b, c] = corners.map(|corner| mesh.points()[corner as usize]);
            assert!((b - a).cross(c - a).dot(eye - a) > 0.0, "{name}: a triangle faces away from the viewer");
        }
    }
}

#[test]
fn a_sheet_bends_without_a_kink() {
    // A corner of 60° and one of 100°, rounded: each chord turns by at most 5°, and the two ends keep their places.
    let profile = [DVec2::new(0.0, 2.0), DVec2::new(0.0, 0.0), DVec2::new(2.0, -3.4), DVec2::new(4.0, 1.0)];
    let sheet = sweep(DVec3::ZERO, 1.0, &profile, 0.4).unwrap();
    let line: Vec<DVec3> = sheet.points().iter().step_by(2).copied().collect();
    for three in line.windows(3) {
        let turn = (three[1] - three[0]).angle_between(three[2] - three[1]).to_degrees();
        assert!(turn < 5.01, "{turn}° at {}", three[1]);
    }
    assert_eq!((line[0], line[line.len() - 1]), (DVec3::new(-0.5, 0.0, 2.0), DVec3::new(-0.5, 4.0, 1.0)));
}

#[test]
fn from_the_rim_of_a_dome_rays_go_as_equation_4_8_says() {
    let sphere = SphereSurface {
        centre: DVec3::ZERO,
        radius_m: 7.0,
        left_rad: std::f64::consts::PI,
        right_rad: -std::f64::consts::PI,
        bottom_rad: 0.0,
        top_rad: std::f64::consts::FRAC_PI_2,
    };
    let from = DVec3::new(4.2, 0.0, 5.6);
    for uv in places(500) {
        let direction = (sphere.point(uv) - from).normalize();
        let expected = from - 2.0 * direction.dot(from) * direction;
        let hit = ScreenSurface::Sphere(sphere).hit(from, direction).unwrap();
        assert!(hit.point.distance(expected) < 1e-11, "{uv}: {} {expected}", hit.point);
    }
}

#[test]
fn the_screens_corners_are_the_frustums() {
    let flat = flat();
    for eye in [DVec3::new(0.0, 1.6, 0.0), DVec3::new(-1.0, 0.3, 1.0), DVec3::new(2.0, 3.0, -1.0)] {
        let frustum = frustum(&flat, eye).unwrap();
        let eye_from_room = frustum.room_from_eye.transpose();
        let Tangents { low, high } = frustum.tangents;
        let corners = [
            (DVec2::ZERO, low),
            (DVec2::X, DVec2::new(high.x, low.y)),
            (DVec2::Y, DVec2::new(low.x, high.y)),
            (DVec2::ONE, high),
        ];
        for (uv, DVec2 { x, y }) in corners {
            let seen = eye_from_room * (flat.point(uv) - eye);
            assert!((seen.x / -seen.z - x).abs() < ROUNDING && (seen.y / -seen.z - y).abs() < ROUNDING, "{uv}");
        }
        // Between the corners, the ray of a place goes through that place: computing it by the surface or by the
        // frustum agrees.
        for place in places(200) {
            let point = flat.point(DVec2::new(place.x, 1.0 - place.y));
            let ray = frustum.ray(place).normalize();
            assert!(ray.distance((point - eye).normalize()) < ROUNDING);
        }
        assert!(frustum.room_from_eye.determinant() > 0.999_999);
    }
}

#[test]
fn a_frustum_straight_ahead_is_known() {
    let flat = FlatSurface::from_centre(DVec3::new(0.0, 0.0, -2.0), DVec2::new(4.0, 2.0), DVec3::ZERO).unwrap();
    let ahead = frustum(&flat, DVec3::ZERO).unwrap();
    assert_eq!(ahead.tangents, Tangents { low: DVec2::new(-1.0, -0.5), high: DVec2::new(1.0, 0.5) });
    let aside = frustum(&flat, DVec3::new(1.0, 0.5, -1.0)).unwrap();
    assert_eq!(aside.tangents, Tangents { low: DVec2::new(-3.0, -1.5), high: DVec2::new(1.0, 0.5) });
    for behind in [DVec3::new(0.0, 0.0, -2.0), DVec3::new(0.0, 0.0, -3.0), DVec3::NAN] {
        assert!(frustum(&flat, behind).is_err());
    }
}

#[test]
fn quarter_turns_are_exact() {
    assert_eq!(room_from_turned(90.0, 0.0, 0.0) * DVec3::NEG_Z, DVec3::NEG_X);
    assert_eq!(room_from_turned(-90.0, 0.0, 0.0) * DVec3::NEG_Z, DVec3::X);
    assert_eq!(room_from_turned(180.0, 0.0, 0.0) * DVec3::NEG_Z, DVec3::Z);
    assert_eq!(room_from_turned(0.0, 90.0, 0.0) * DVec3::NEG_Z, DVec3::Y);
    assert_eq!(room_from_turned(0.0, 0.0, 90.0) * DVec3::X, DVec3::Y);
    let [yaw, pitch, roll] = [33.0_f64, -21.0, 77.0].map(f64::to_radians);
    let euler = glam::DMat3::from_euler(glam::EulerRot::YXZ, yaw, pitch, roll);
    assert!(room_from_turned(33.0, -21.0, 77.0).abs_diff_eq(euler, ROUNDING));
}

#[test]
fn warps_are_undone_by_their_inverse() {
    let corners = [[0.05, 0.02], [0.9, 0.1], [0.97, 0.95], [0.0, 0.9]].map(DVec2::from);
    let keystone = CornerWarp::new(corners).unwrap();
    let shifted = (0..6 * 5).map(|i| {
        let place = DVec2::new(f64::from(i % 6) / 5.0, f64::from(i / 6) / 4.0);
        0.1 + 0.8 * place + 0.04 * DVec2::new((3.0 * place.y).sin(), place.x * place.x)
    });
    let measured = MeasuredWarp::new(6, 5, shifted.collect());
    for (name, warp) in [("corners", Warp::Corners(keystone)), ("grid", Warp::Grid(measured))] {
        let mut shown = 0;
        for place in places(2000) {
            let Some(picture) = warp.picture(place) else { continue };
            shown += 1;
            assert!(warp.viewport(picture).unwrap().distance(place) < PLACE, "{name} {place}");
        }
        assert!(shown > 1500, "{name}: {shown}");
    }
    // The picture's corners are drawn at their given places, and nothing outside.
    let warp = Warp::Corners(keystone);
    for (picture, viewport) in [DVec2::ZERO, DVec2::X, DVec2::ONE, DVec2::Y].into_iter().zip(corners) {
        assert!(warp.viewport(picture).unwrap().distance(viewport) < ROUNDING);
    }
    assert!(warp.picture(DVec2::new(0.01, 0.01)).is_none());
    let straight = warp.picture((corners[0] + corners[2]) * 0.5).unwrap();
    assert!((straight.x - straight.y).abs() < ROUNDING, "a diagonal stays one: {straight}");
    assert!(CornerWarp::new([corners[0], corners[2], corners[1], corners[3]]).is_err());
    assert!(CornerWarp::new([corners[3], corners[2], corners[1], corners[0]]).is_err(), "mirrored");
}

#[test]
fn a_mesh_with_a_hole_shows_nothing_there() {
    let mut points: Vec<DVec3> = (0..16).map(|i| DVec3::new(f64::from(i % 4), f64::from(i / 4), -2.0)).collect();
    points[5] = DVec3::NAN;
    let surface = ScreenSurface::Mesh(Box::new(MeshSurface::grid(4, 4, points)));
    assert_eq!(surface.point(DVec2::new(0.3, 0.3)), None);
    assert_eq!(surface.point(DVec2::new(0.9, 0.9)).unwrap().z, -2.0);
    assert!(surface.hit(DVec3::new(0.9, 0.9, 0.0), DVec3::NEG_Z).is_none());
    assert!(surface.hit(DVec3::new(2.7, 2.7, 0.0), DVec3::NEG_Z).is_some());
}

#[test]
fn meshes_are_read_from_obj_and_csv_alike() {
    let folder = tempfile::tempdir().unwrap();
    let load = |name: &str, text: &str| {
        std::fs::write(folder.path().join(name), text).unwrap();
        let display = format!(
            "[[screen]]\nname = \"s\"\nmesh = \"{name}\"\n[[window]]\nname = \"w\"\nsize = [8, 8]\n\
             [[channel]]\nname = \"c\"\nscreen = \"s\"\nwindow = \"w\"\n"
        );
        let display = room::file::parse(&display, "d.toml", folder.path());
        display.map(|mut display| display.screens.remove(0).surface).map_err(|error| error.to_string())
    };
    let obj = "# a wall\nv -1 0 -2\nv 1 0 -2\nv 1 2 -2\nv -1 2 -2\nvt 0 0\nvt 1 0\nvt 1 1\nvt 0 1\nvn 0 0 1\nf 1/1/1 2/2/1 3/3/1 4/4/1\n";
    let csv = "u,v,x,y,z\n1,0, 1,0,-2\n0,0,-1,0,-2\n0,1,-1,2,-2\n1,1,1,2,-2 # last\n";
    let (one, other) = (load("a.obj", obj).unwrap(), load("b.csv", csv).unwrap());
    for uv in places(100) {
        let expected = DVec3::new(2.0 * uv.x - 1.0, 2.0 * uv.y, -2.0);
        assert!(
            one.point(uv).unwrap().distance(expected) < ROUNDING
                && other.point(uv).unwrap().distance(expected) < ROUNDING
        );
    }
    assert!((one.normal(DVec2::splat(0.3)).unwrap()).distance(DVec3::Z) < ROUNDING);
    // Indices that count backwards give the same mesh.
    let backwards = obj.replace("1/1/1 2/2/1 3/3/1 4/4/1", "-4/-4 -3/-3 -2/-2 -1/-1");
    assert_eq!(load("c.obj", &backwards).unwrap(), one);

    for (name, text, word) in [
        ("1.obj", obj.replace("4/4/1", "5/4/1"), "line 11: \"5/4/1\" names no v"),
        ("2.obj", obj.replace("4/4/1", "4"), "names no vt"),
        ("3.obj", obj.replace("v 1 2 -2", "v 1 nan -2"), "line 4: v needs three finite numbers"),
        ("4.obj", "v 0 0 0\n".into(), "no face"),
        ("5.obj", obj.replace("vt 1 1", "vt 1 2"), "outside 0 to 1"),
        ("6.csv", csv.replace("1,1,1,2,-2", ""), "no even grid"),
        ("7.csv", csv.replace("0,1,-1,2,-2", "0,1,-1,2"), "line 4: write u, v, x, y, z"),
        ("8.csv", String::new(), "no even grid"),
        ("9.stl", obj.into(), ".obj or a .csv"),
    ] {
        let error = load(name, &text).unwrap_err();
        assert!(error.contains(word) && error.contains(name), "{error}");
    }
}
