//! Options that have no effect together with others: said in one sentence each, since nobody gives an option in vain.
//!
//! An option counts as given if its value is not the usual one. What contradicts another option is refused instead,
//! where the options are.

use std::path::Path;

use super::dial::DialOptions;
use super::line::CheckOptions;
use super::measure::MeasureOptions;
use super::picture::PictureOptions;
use super::render::RenderOptions;
use super::ride::{RideOptions, VehicleName};
use super::world::{SceneChoice, WorldOptions};
use input::TrackerUrl;
use presentation::{Latency, Vignette};
use render::display::Development;
use ride::Nose;
use view::{Effects, Projection, RendererName, Transform};

/// Sizes of pictures and numbers of samples without an option.
const USUAL_SIZE: [u32; 2] = [1280, 720];
const USUAL_SAMPLES: u32 = 4;

/// Sentences on options that are passed over.
#[derive(Debug, Default)]
struct Passed(Vec<String>);

impl Passed {
    /// Notes an option that is given, and the reason for which it does nothing.
    fn note(&mut self, given: bool, option: &str, why: &str) {
        if given {
            self.0.push(format!("{option} has no effect: {why}"));
        }
    }
}

impl RideOptions {
    /// Options of a ride that are passed over; `films`: the ride is filmed, and no window is opened.
    pub fn passed_over(&self, films: bool) -> Vec<String> {
        let mut passed = Passed::default();
        self.world.pass_over(self.replay.is_some(), &mut passed);
        if self.verify {
            let nothing = "--verify draws nothing";
            passed.note(self.drawing_is_given, "the way of drawing", nothing);
            passed.note(self.latency != Latency::default(), "--latency", nothing);
            passed.note(self.display.is_some(), "--display", nothing);
            self.picture.pass_over_drawing(nothing, &mut passed);
            return passed.0;
        }
        self.dial.pass_over(false, &mut passed);
        let devices = &self.devices;
        if films {
            passed.note(self.latency != Latency::default(), "--latency", "it is for windows, and this ride is filmed");
            passed.note(self.frame_rate.is_some(), "--frame-rate", "it is for windows, and this ride is filmed");
            let live = devices.are_ridden() || self.realtime;
            let replayed = self.replay.is_some();
            if live && self.record.is_some() {
                passed.note(
                    devices.tracker.is_some(),
                    "--tracker",
                    "a film is seen straight ahead; the head is recorded alone",
                );
            } else {
                passed.note(devices.tracker.is_some(), "--tracker", "a film is seen straight ahead; ride in a window");
            }
            passed.note(replayed && self.realtime, "--realtime", "a recorded ride needs no clock to be filmed");
            passed.note(
                self.vehicle.vehicle == Some(VehicleName::Bicycle) && self.vehicle.transport != Nose::default(),
                "--transport",
                "it is for --vehicle drive and fly",
            );
        } else {
            passed.note(self.realtime, "--realtime", "a window follows the clock anyway");
            let samples = self.picture.samples;
            passed.note(
                samples > 1 && samples != USUAL_SAMPLES,
                "the number in --samples",
                "a window takes 1 or 4 samples a pixel; it takes 4",
            );
            if self.display.is_some() {
                self.picture.pass_over_sizes(self.preview || self.is_headset(), &mut passed);
            }
            if self.is_headset() {
                passed.note(self.preview, "--preview", "a headset shows the ride from within");
                let other = devices.tracker.as_ref().is_some_and(|tracker| *tracker != TrackerUrl::Openxr);
                passed.note(other, "--tracker", "the headset's runtime tracks the head");
            }
        }
        self.pass_over_comfort(films, &mut passed);
        passed.0
    }

    /// Comfort that nothing of this ride has.
    fn pass_over_comfort(&self, films: bool, passed: &mut Passed) {
        let comfort = &self.comfort;
        let (headset, devices) = ("it is for a headset: --headset", &self.devices);
        passed.note(!self.is_headset() && comfort.vignette != Vignette::Off, "--vignette", headset);
        passed.note(
            comfort.cockpit == Some(true) && (films || self.display.is_none()),
            "--cockpit",
            "it is for a headset or a room: --display",
        );
        // A set-up may name the headset as the tracker.
        let tracked = self.is_headset() || devices.tracker == Some(TrackerUrl::Openxr) || devices.set_up.is_some();
        passed.note(!tracked && comfort.snap_turn.is_some(), "--snap-turn", headset);
        passed.note(!tracked && comfort.stance.is_some(), "--stance", headset);
    }
}

impl RenderOptions {
    /// Options of a picture or film that are passed over.
    pub fn passed_over(&self) -> Vec<String> {
        let mut passed = Passed::default();
        self.world.pass_over(self.replay.is_some(), &mut passed);
        self.dial.pass_over(true, &mut passed);
        if self.room.display.is_some() {
            self.picture.pass_over_sizes(self.room.preview, &mut passed);
        }
        if self.projection.projection != Projection::Flat {
            let all = "the projection says which directions a picture shows";
            passed.note(self.picture.fov.is_some(), "--fov", all);
            let wall = "it is for flat pictures";
            passed.note(self.projection.wall_distance.is_some(), "--wall-distance", wall);
        }
        if self.film.hdr.is_some() {
            let (given, usual) = (self.picture.development(), Development::default());
            let range = "a film of a high dynamic range needs no tone curve and no gamut mapping";
            passed.note(given.tone != usual.tone, "--tone", range);
            passed.note(given.gamut != usual.gamut, "--gamut", range);
        }
        if self.writes_light() {
            let light = "an .exr file holds light before it is developed";
            let (given, usual) = (self.picture.development(), Development::default());
            passed.note(given.exposure != usual.exposure, "--exposure", light);
            passed.note(given.tone != usual.tone, "--tone", light);
            passed.note(given.gamut != usual.gamut, "--gamut", light);
        }
        passed.0
    }
}

impl MeasureOptions {
    /// Options of a measurement that are passed over.
    pub fn passed_over(&self) -> Vec<String> {
        let mut passed = Passed::default();
        self.world.pass_over(self.replay.is_some(), &mut passed);
        passed.0
    }
}

impl CheckOptions {
    /// Options of a check that are passed over.
    pub fn passed_over(&self) -> Vec<String> {
        let mut passed = Passed::default();
        let refers = self.files.iter().any(|file| may_refer_to_files(file));
        passed.note(self.reading.trust && !refers, "--trust", "it is for scenes (.gltf, .glb), and none is named");
        passed.0
    }
}

impl WorldOptions {
    fn pass_over(&self, replays: bool, passed: &mut Passed) {
        passed.note(replays && self.camera.is_some(), "--camera", "the recorded rider says where the eye is");
        let refers = match &self.scene {
            Some(SceneChoice::File(file)) => may_refer_to_files(file),
            Some(_) => false,
            None => replays,
        };
        passed.note(self.reading.trust && !refers, "--trust", "this scene refers to no files");
    }
}

impl DialOptions {
    /// `stills`: pictures that are kept, of which automatic choice makes cuts unless --edge is given.
    fn pass_over(&self, stills: bool, passed: &mut Passed) {
        let by_cuts = stills && self.edge.is_none();
        let (map, edges) = match self.renderer {
            RendererName::Auto if by_cuts => (Some("auto cuts the triangles of a picture that is kept"), None),
            RendererName::Auto => (None, None),
            RendererName::Polygon => (Some("it is for --renderer image"), None),
            // That edges are not used is said where the method is chosen.
            RendererName::Image => (None, Some("it is for --renderer polygon")),
            RendererName::Raytrace => {
                (Some("rays need no map"), Some("rays need no cuts, as straight edges stay straight"))
            }
        };
        passed.note(self.map_scale.is_some() && map.is_some(), "--map-scale", map.unwrap_or_default());
        let why = edges.unwrap_or_default();
        passed.note(self.tolerance.is_some() && edges.is_some(), "--tolerance", why);
        if self.renderer == RendererName::Raytrace {
            passed.note(self.edge.is_some(), "--edge", why);
            passed.note(self.transform != Transform::default(), "--transform", why);
        }
    }
}

impl PictureOptions {
    /// Notes what does not apply to the pictures of a room, which have sizes of their own.
    fn pass_over_sizes(&self, preview: bool, passed: &mut Passed) {
        let own = "the pictures of a --display have sizes of their own";
        passed.note(self.size != USUAL_SIZE && !preview, "--size", own);
        passed.note(self.fov.is_some(), "--fov", own);
    }

    /// Notes every option of how a picture looks.
    fn pass_over_drawing(&self, why: &str, passed: &mut Passed) {
        passed.note(self.size != USUAL_SIZE, "--size", why);
        passed.note(self.fov.is_some(), "--fov", why);
        passed.note(self.samples != USUAL_SAMPLES, "--samples", why);
        passed.note(self.effects != Effects::ALL, "--effects", why);
        passed.note(self.background.is_some(), "--background", why);
        let (given, usual) = (self.development(), Development::default());
        passed.note(given.exposure != usual.exposure, "--exposure", why);
        passed.note(given.tone != usual.tone, "--tone", why);
        passed.note(given.gamut != usual.gamut, "--gamut", why);
    }
}

/// True for a kind of scene that may refer to other files. A name without a known ending may be of any kind.
fn may_refer_to_files(file: &Path) -> bool {
    let ending = file.extension().map(|ending| ending.to_string_lossy().to_lowercase());
    !ending.is_some_and(|ending| {
        let others = ["png", "jpg", "jpeg", "webp", "tif", "tiff", "hdr", "exr", "mcap", "toml", "pvx", "mpcdi"];
        others.contains(&ending.as_str())
    })
}

#[cfg(test)]
mod tests {
    //! Law: an option that does nothing in the combination given is named, with the reason; one that does something is
    //! not.

    use super::super::{Command, parse_from};

    /// Sentences on the options of a line; `films`: there is no window.
    fn passed(line: &str, films: bool) -> String {
        let words = ["rapidity"].into_iter().chain(line.split_whitespace());
        let sentences = match parse_from(words).unwrap() {
            Command::Ride(options) => options.passed_over(films),
            Command::Render(options) => options.passed_over(),
            Command::Measure(options) => options.passed_over(),
            Command::Check(options) => options.passed_over(),
            other => panic!("{other:?}"),
        };
        sentences.join("\n")
    }

    #[test]
    fn options_without_an_effect_are_named() {
        for (line, films, told) in [
            ("ride --out a.mp4 --tracker mouse", true, "--tracker has no effect: a film is seen straight ahead; ride"),
            ("ride --out a.mp4 --realtime --record r.mcap --tracker mouse", true, "the head is recorded alone"),
            ("ride --out a.mp4 --latency low", true, "--latency"),
            ("ride --replay r.mcap --out a.mp4 --realtime", true, "--realtime"),
            ("ride --out a.mp4 --vehicle bicycle --transport gyroscopic", true, "--transport"),
            ("ride --realtime", false, "--realtime"),
            ("ride --samples 16", false, "--samples"),
            ("ride --display cave4 --fov 90", false, "--fov"),
            ("ride --display openxr --fov 90", false, "--fov"),
            ("ride --display openxr --preview", false, "--preview"),
            ("ride --headset --tracker mouse", false, "--tracker"),
            ("ride --display cave4 --size 64x64", false, "--size"),
            ("ride --replay r.mcap --camera 1", false, "--camera"),
            ("ride --replay r.mcap --verify --size 64x64", true, "--size"),
            ("ride --replay r.mcap --verify --edge 1", true, "the way of drawing"),
            ("ride --replay r.mcap --verify --tone filmic", true, "--tone"),
            ("ride --renderer polygon --map-scale 2", false, "--map-scale"),
            ("ride --renderer image --tolerance 2", false, "--tolerance"),
            ("ride --scene town --trust", false, "--trust"),
            ("render --out a.png --map-scale 2", true, "--map-scale"),
            ("render --out a.png --renderer raytrace --map-scale 2", true, "--map-scale"),
            ("render --out a.png --renderer raytrace --edge 2 --transform gpu", true, "--transform"),
            ("render --out a.png --renderer raytrace --tolerance 2", true, "--tolerance"),
            ("render --out a.exr --exposure 2", true, "--exposure"),
            ("render --out a.exr --tone filmic --gamut clamp", true, "--gamut"),
            ("render --out walls --display cave4 --fov 90", true, "--fov"),
            ("render --out a.png --scene a.hdr --trust", true, "--trust"),
            ("measure --replay r.mcap --camera 1", true, "--camera"),
            ("check a.mcap b.hdr --trust", true, "--trust"),
        ] {
            let sentences = passed(line, films);
            assert!(sentences.contains(told) && sentences.contains(" has no effect: "), "{line}\n{sentences}");
        }
    }

    #[test]
    fn options_with_an_effect_are_not_named() {
        for (line, films) in [
            ("ride", false),
            ("ride", true),
            ("ride --tracker mouse --display cave4 --latency low --map-scale 2 --tolerance 2", false),
            ("ride --out a.mp4 --realtime --bicycle /dev/null --samples 16 --fov 90 --size 64x64", true),
            ("ride --display cave4 --preview --size 64x64", false),
            ("ride --headset --size 64x64 --tracker openxr://", false),
            ("ride --replay r.mcap --trust", false),
            ("ride --replay r.mcap --verify --threads 2", true),
            ("render --out a.png --exposure 2 --tone filmic --size 64x64 --scene a.glb --trust --camera 1", true),
            ("render --out a.png --renderer image --map-scale 2", true),
            ("render --out a.png --edge 1 --transform gpu --map-scale 2", true),
            ("render --out walls --display cave4 --preview --size 64x64", true),
            ("measure --scene a.glb --camera 1 --trust", true),
            ("check a.mcap b.glb --trust", true),
        ] {
            assert_eq!(passed(line, films), "", "{line}");
        }
    }
}
