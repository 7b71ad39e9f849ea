//! English texts.

use crate::phrase::Phrase;

/// English text of a phrase.
#[expect(clippy::too_many_lines, reason = "one line a phrase")]
pub fn text(phrase: Phrase) -> &'static str {
    match phrase {
        Phrase::MenuTitle => "Menu",
        Phrase::Vehicle => "Vehicle",
        Phrase::Bicycle => "bicycle",
        Phrase::BicyclePurpose => "Pedal along the street, and steer with the handlebar.",
        Phrase::Drive => "drive",
        Phrase::DrivePurpose => "Glide over the ground in any direction.",
        Phrase::Fly => "fly",
        Phrase::FlyPurpose => "Fly freely, up and down as well.",
        Phrase::SpeedOfLight => "Speed of light",
        Phrase::SpeedOfLightPurpose => {
            "How fast light is in this world. The slower it is, the sooner you see relativity."
        }
        Phrase::WalkingPace => "walking pace",
        Phrase::RealLight => "real",
        Phrase::ClockSpeed => "Speed of your clock",
        Phrase::ClockSpeedPurpose => {
            "How much of your own time passes in a second. Below 1 you see everything in slow motion."
        }
        Phrase::View => "View",
        Phrase::Seen => "seen",
        Phrase::SeenPurpose => "Everything where its light comes from: what your eyes would see.",
        Phrase::Measured => "measured",
        Phrase::MeasuredPurpose => {
            "Everything where it is now for you, shortened along your motion. Nobody sees this: it is worked \
             out afterwards."
        }
        Phrase::Instant => "light at once",
        Phrase::InstantPurpose => "Everything where it is now for the world, as if light took no time.",
        Phrase::Effects => "Effects",
        Phrase::Doppler => "Doppler",
        Phrase::DopplerPurpose => "Shifts colours: bluer ahead, redder behind. Off: colours as at rest.",
        Phrase::Searchlight => "searchlight",
        Phrase::SearchlightPurpose => "Makes it brighter ahead and darker behind. Off: brightness as at rest.",
        Phrase::Brightness => "Brightness",
        Phrase::BrightnessPurpose => "Stops by which the picture is brighter. Each doubles the light.",
        Phrase::Automatic => "automatic",
        Phrase::AutomaticPurpose => {
            "As an eye adapts: on average as bright as at rest. Off: what is white at rest is white."
        }
        Phrase::ToneCurve => "Tone curve",
        Phrase::Colours => "Colours",
        Phrase::FieldOfView => "Field of view",
        Phrase::FieldOfViewPurpose => "How much you see from the lower to the upper edge. Small is like a telescope.",
        Phrase::Head => "Tracked head",
        Phrase::HeadBoth => "place and velocity",
        Phrase::HeadBothPurpose => "Your head's own motion is relativistic, too.",
        Phrase::HeadPlace => "place",
        Phrase::HeadPlacePurpose => "Your head counts as at rest in the vehicle, wherever it is.",
        Phrase::HeadOff => "off",
        Phrase::HeadOffPurpose => "The picture is right for one place, and stays so.",
        Phrase::Frames => "Frames",
        Phrase::Smooth => "smooth",
        Phrase::SmoothPurpose => "More pictures a second. Each is shown one picture later.",
        Phrase::Quick => "quick to answer",
        Phrase::QuickPurpose => "Each picture shows your newest movement. There are fewer of them.",
        Phrase::LanguageChoice => "Language",
        Phrase::LanguagePurpose => "Language of everything that is written here.",
        Phrase::Places => "Go to",
        Phrase::PlacePurpose => "Puts you there at rest.",
        Phrase::Pause => "Hold",
        Phrase::PausePurpose => "Stops the world, or lets it go on. You can still look and walk around.",
        Phrase::Step => "Step",
        Phrase::StepPurpose => "Moves the world on by one small step while it is held.",
        Phrase::Restart => "To the start",
        Phrase::RestartPurpose => "Takes you back to where the ride began.",
        Phrase::VignetteChoice => "Dark edges",
        Phrase::VignetteOff => "off",
        Phrase::VignetteWeak => "weak",
        Phrase::VignetteStrong => "strong",
        Phrase::VignettePurpose => {
            "Darkens the edges of what you see while the vehicle speeds up, slows down or turns, which you see and do not feel."
        }
        Phrase::VignetteIs => "dark edges: {0}",
        Phrase::Cockpit => "Vehicle lines",
        Phrase::CockpitShown => "shown",
        Phrase::CockpitPurpose => "Lines about you that rest in the vehicle: something to hold on to with the eyes.",
        Phrase::SnapTurn => "Turns in steps",
        Phrase::SnapTurnOff => "none",
        Phrase::SnapTurnPurpose => {
            "A flick of your other hand's stick turns you in the vehicle by so much, on the spot."
        }
        Phrase::StanceChoice => "You ride",
        Phrase::Seated => "seated",
        Phrase::SeatedPurpose => "Where you are now is the driver's seat, however high you are.",
        Phrase::Standing => "standing",
        Phrase::StandingPurpose => {
            "You stand on the vehicle's floor, as tall as you are. Where you are now is its place."
        }
        Phrase::Straighten => "Straighten",
        Phrase::StraightenPurpose => "Makes where your tracked head is and looks now the middle.",
        Phrase::Photo => "Photo",
        Phrase::PhotoPurpose => "Saves the picture as a file, photo-001.png and so on.",
        Phrase::PhotoSphere => "Photo all round",
        Phrase::PhotoSpherePurpose => "Saves a picture of all directions, sphere-001.png and so on.",
        Phrase::Record => "Record",
        Phrase::RecordPurpose => "Saves the whole ride as a file, ride-001.mcap and so on, or ends the file.",
        Phrase::Outside => "From outside",
        Phrase::OutsidePurpose => "Shows what you see as a shape in space, from outside. The ball is you.",
        Phrase::Freeze => "Freeze",
        Phrase::FreezePurpose => "Keeps the view from outside as it is now while you go on.",
        Phrase::Miniature => "Map",
        Phrase::MiniaturePurpose => "Shows the world from above, your way so far, and both clocks.",
        Phrase::Diagram => "Diagram",
        Phrase::DiagramPurpose => "Draws your way through space and time, with light at 45 degrees.",
        Phrase::DiagramOfVehicle => "Your frame",
        Phrase::DiagramOfVehiclePurpose => "Draws the diagram as you measure, instead of as the world does.",
        Phrase::Readings => "Readings",
        Phrase::ReadingsPurpose => "Shows speed, clocks and distances.",
        Phrase::Help => "Help",
        Phrase::HelpPurpose => "Lists every key.",
        Phrase::Leave => "Leave",
        Phrase::LeavePurpose => "Ends the ride. A recording is completed.",
        Phrase::CloseMenu => "Close",
        Phrase::CloseMenuPurpose => "Closes this menu. F3 opens it again.",
        Phrase::Ride => "Ride",
        Phrase::Picture => "Picture",
        Phrase::Understand => "Understand",
        Phrase::Program => "Program",
        Phrase::Devices => "Devices",
        Phrase::RidePurpose => "Vehicle, speed of light, your clock, places.",
        Phrase::PicturePurpose => "Effects, brightness, colours, field of view.",
        Phrase::UnderstandPurpose => "What is seen and what is: views, map, diagram.",
        Phrase::ProgramPurpose => "Language, devices, and the end.",
        Phrase::ReinhardPurpose => "Keeps detail in what is bright, and leaves the rest as it is.",
        Phrase::LinearPurpose => "Shows brightness as it is. What is brighter than white is white.",
        Phrase::ExponentialPurpose => "Bright places fade into white, as on photographic film.",
        Phrase::FilmicPurpose => "More contrast, with dark shadows, as in the cinema.",
        Phrase::HistogramPurpose => {
            "Shares the screen's brightness out, so that dark and bright places both show detail."
        }
        Phrase::DesaturatePurpose => "Colours that the screen cannot show become paler.",
        Phrase::WhitePurpose => "Colours that the screen cannot show are mixed with white, and then darkened.",
        Phrase::ClampPurpose => "Colours that the screen cannot show are cut off. Their hue may change.",
        Phrase::ClockOf => "clock",
        Phrase::ClockSeen => "as you see it",
        Phrase::ClockForYou => "now, for you",
        Phrase::ClockForWorld => "now, for the world",
        Phrase::Clocks => "Clocks",
        Phrase::GoOn => "Go on",
        Phrase::GoOnPurpose => "Goes on with the tour. The enter key does the same.",
        Phrase::LookAround => "Stop and look around",
        Phrase::LookAroundPurpose => "Stops the tour where it is. Go on when you like.",
        Phrase::AnswerPurpose => "Chooses this answer. The tour says whether it is right, and why.",
        Phrase::Right => "Right.",
        Phrase::Wrong => "Not so.",
        Phrase::TourOver => "The tour is over: the ride is yours.",
        Phrase::ColouringChoice => "Colours from outside",
        Phrase::ColouringPurpose => "What the colours of the view from outside mean.",
        Phrase::ByLight => "light",
        Phrase::ByDoppler => "Doppler factor",
        Phrase::ByDelay => "delay of light",
        Phrase::ColouringIs => "colours from outside: {0}",
        Phrase::OnlyFlat => "the view from outside is for a flat window, not for a room",
        Phrase::Light => "light: {0}",
        Phrase::YourClock => "your clock",
        Phrase::WorldClock => "the world's clock",
        Phrase::Road => "road travelled",
        Phrase::Odometer => "your odometer",
        Phrase::GammaRapidity => "γ · rapidity",
        Phrase::Recording => "recording",
        Phrase::Paused => "held: P to go on",
        Phrase::HelpAndMenu => "F1 help · F3 menu",
        Phrase::HelpKey => "F1 help",
        Phrase::FramesPerSecond => "{0} frames/s",
        Phrase::Invitation => "Press a key or start to pedal: the ride is yours",
        Phrase::ClockRuns => "your clock runs × {0}",
        Phrase::PointsLost => "{0} points of the scene have no visible place and are not drawn",
        Phrase::ViewIs => "view: {0}",
        Phrase::ToneIs => "tone curve: {0}",
        Phrase::ExposureIs => "exposure: {0}",
        Phrase::On => "{0}: on",
        Phrase::Off => "{0}: off",
        Phrase::HeadIs => "tracked head: {0}",
        Phrase::NoHead => "no head is tracked; name a tracker with --tracker",
        Phrase::PhotoSaved => "photo: {0}",
        Phrase::NotUnderstood => "{0}: no such value; nothing was changed",
        Phrase::RapidityCapped => "rapidity capped at {0}",
        Phrase::ControlsNotFinite => "a control is not a finite number: it counts as let go",
        Phrase::TakenByRk4 => "the chosen integrator gave up on a step: RK4 took it",
        Phrase::NotIntegrated => "a step could not be computed: the vehicle waits",
        Phrase::HeldByWalls => "too fast for these walls: slowed down",
        Phrase::SpeedOfLightRefused => "no world can be computed with such a speed of light",
        Phrase::ToGo => "To go",
        Phrase::ToGoHow => "hold W or the upward arrow, or pedal; A and D, or the arrows left and right, steer",
        Phrase::ToStop => "To stop",
        Phrase::ToStopHow => "hold the space bar; Backspace takes you back to the start",
        Phrase::ForHelp => "For help",
        Phrase::ForHelpHow => "F1 shows and hides this page",
        Phrase::KeyPedal => "pedal, push back; thrust forward, back; the arrows lower and raise the nose when flying",
        Phrase::KeySteer => "steer; thrust sideways; the arrows turn the nose",
        Phrase::KeyLift => "thrust up, down when flying",
        Phrase::KeyRoll => "roll",
        Phrase::KeySprint => "sprint",
        Phrase::KeyBrake => "brake",
        Phrase::KeyLook => {
            "look left, right, up, down, as a drag of the mouse does; rooms and tracked heads look by themselves"
        }
        Phrase::KeyAhead => "look ahead again, as the middle button does",
        Phrase::KeyStraight => "your head's present place and direction become the middle ones",
        Phrase::KeyBack => "look back, as long as it is held",
        Phrase::KeyVehicles => "bicycle, drive, fly",
        Phrase::KeyPause => "hold the world, or let it go on; you can still look around",
        Phrase::KeyStep => "one step while held",
        Phrase::KeyClock => "your clock slower, faster",
        Phrase::KeyView => "next view: seen, measured, light at once",
        Phrase::KeyEffects => "geometry, Doppler shift, searchlight effect: on, off",
        Phrase::KeyTone => "next tone curve",
        Phrase::KeyBrightness => "darker, brighter",
        Phrase::KeyOutside => "see from outside what you see (drag to go round it); freeze it; its colours",
        Phrase::KeyMap => "map of the world, with both clocks",
        Phrase::KeyDiagram => "space-time diagram of the ride; in your frame or the world's",
        Phrase::KeyPhoto => "photo; photo of all directions",
        Phrase::KeyRecord => "record the whole ride, from its beginning",
        Phrase::KeyRestart => "back to the start",
        Phrase::KeyHelp => "this help",
        Phrase::KeyReadings => "show or hide the readings",
        Phrase::KeyMenu => "menu",
        Phrase::KeyChoose => "choose in the menu; go on with a tour",
        Phrase::KeyCalibrate => "move the corners of a room's pictures",
        Phrase::KeyHead => "next use of the tracked head",
        Phrase::KeyFullScreen => "full screen",
        Phrase::KeyLeave => "leave",
        Phrase::World => "World",
        Phrase::WorldPurpose => "Scenes, tours, and places to go to.",
        Phrase::SceneChoice => "Scene",
        Phrase::SceneTown => "Old town",
        Phrase::SceneTownPurpose => "Streets, houses and clocks, where light rides no faster than 30 km/h.",
        Phrase::SceneDice => "Dice",
        Phrase::SceneDicePurpose => "Dice beside a road. What passes looks turned, not shortened.",
        Phrase::SceneTrain => "Trains",
        Phrase::SceneTrainPurpose => "A platform and trains with clocks. Whose clock is slow?",
        Phrase::SceneLaboratory => "Laboratory",
        Phrase::SceneLaboratoryPurpose => "A cube and a sphere fly past, as in a published experiment.",
        Phrase::SceneLattice => "Lattice",
        Phrase::SceneLatticePurpose => "Boxes in a cubic lattice, where every bend can be seen.",
        Phrase::SceneSpectra => "Spectra",
        Phrase::SceneSpectraPurpose => "Lights of three temperatures and of single lines, and their Doppler shift.",
        Phrase::TourChoice => "Tours",
        Phrase::TourPurpose => "Rides for you, explains what you see, and asks. Under a minute each.",
        Phrase::Loading => "{0} is being made ready; the ride goes on meanwhile",
        Phrase::CannotLoad => "it cannot be shown: {0}",
        Phrase::HeadsetLost => "{0}; the ride goes on in the window",
        Phrase::StaysRecorded => "a recorded ride stays in its scene",
        Phrase::Method => "Drawing",
        Phrase::AutoPurpose => "The program takes the method that suits the scene.",
        Phrase::PolygonPurpose => "Bends every corner of every triangle. Exact; the finer, the slower.",
        Phrase::ImagePurpose => "Draws a map of the world around you and bends its pixels. Fast in coarse scenes.",
        Phrase::Tolerance => "Largest error",
        Phrase::TolerancePurpose => "Largest distance of anything drawn from its exact place, pixels.",
        Phrase::MapScale => "Fineness",
        Phrase::MapScalePurpose => "Points of the map for each pixel of the picture.",
        Phrase::ClocksPurpose => "What clocks near you show: as seen, now for you, now for the world.",
        Phrase::Planner => "Planner",
        Phrase::PlannerPurpose => "Says when to turn round and brake to come to rest at the place ahead.",
        Phrase::Start => "the start",
        Phrase::DeviceAt => "{0}: {1} at {2} Hz",
        Phrase::BadMessages => "{0} bad, the last: {1}",
        Phrase::TrainerLine => "trainer {0} · {1} · {2}",
        Phrase::NoValue => "no {0}",
        Phrase::TurnsPerMinute => "rpm",
        Phrase::MoreThings => "and {0} more: see rapidity devices",
        Phrase::IsHead => "{0} (the head)",
        Phrase::HeardAt => "{0}: {1} a second",
        Phrase::NotSeen => "not seen",
        Phrase::Angles => "yaw {0}° pitch {1}° roll {2}°",
        Phrase::Held => "held: {0}",
        Phrase::NoButton => "none",
        Phrase::Axes => "axes {0}",
        Phrase::HeadTracked => "the head is tracked",
        Phrase::HeadNeverSeen => "the head has not been seen yet",
        Phrase::HeadLost => "the head is lost, and rests at its last place",
        Phrase::PosesRejected => "{0}; poses rejected: {1}, the last: {2}",
        Phrase::HeadLine => "{0}; {1} poses rejected",
        Phrase::HeadIsStraight => "your head is straight: its place and direction are the middle ones",
        Phrase::NoHeadToStraighten => {
            "no head is tracked, so there is nothing to straighten; name a tracker with --tracker"
        }
        Phrase::HeadIsCalibrated => {
            "this room's tracker is calibrated, so the head is not moved; recentre = \"key\" in [tracker] allows it"
        }
        Phrase::RecordedHeadStays => "a recorded head stays as it was",
        Phrase::RecordedRide => "a recorded ride",
        Phrase::RecordingInto => "recording, from the ride's beginning, into {0}",
        Phrase::RecordingEnds => "the recording has ended, and is being completed on the disk",
        Phrase::RecordingComplete => "the recording is complete",
        Phrase::NotRecorded => "the ride is not recorded: {0}",
        Phrase::NotRemembered => {
            "the ride so far is no longer remembered ({0}), so it cannot be recorded; start the program with --record \
             FILE"
        }
        Phrase::RecordingCut => "{0}: the ride was not recorded to its end",
        Phrase::ReplayDiffers => {
            "the replay differs from the recording in frame {0}: {1} was {2}, is {3}; was it recorded with this \
             version, and is the scene the same?"
        }
        Phrase::LostTime => {
            "{0} s of your own time were not ridden: frames took longer than a quarter of a second; a smaller picture \
             helps"
        }
        Phrase::PhotoFailed => "no photo: {0}",
        Phrase::LanguageNotKept => "the language is not kept: {0}",
        Phrase::ChannelBlack => {
            "{0} is black: the eye at {1} m is {2} m behind the screen's plane; turn the screen round or move the \
             head before it"
        }
        Phrase::DirectionsUncertain => {
            "directions are uncertain by about {0}; a smaller --tolerance, --edge or a larger --map-scale helps"
        }
        Phrase::AsternUncertain => {
            "directions astern are uncertain by about {0}: 32 bits hold no more; --renderer polygon does"
        }
        Phrase::Arcminutes => "arcmin",
        Phrase::Arcseconds => "arcsec",
        Phrase::DrawnAt => "{0} · drawn at {1} %",
        Phrase::DrawnBy => "{0} triangles by the {1} renderer on {2}",
        Phrase::InStep => {
            "{0} windows in step: frame {1} presented within {2} ms (at most {3} ms so far); {4} left out; {5} turns \
             held"
        }
        Phrase::OperatorTitle => "Rapidity: operator",
        Phrase::StageRide => "ride",
        Phrase::StageSubmit => "submit",
        Phrase::StageTransform => "transform",
        Phrase::StageDraw => "draw",
        Phrase::StageShow => "show",
        Phrase::StagePose => "pose to picture",
        Phrase::StageSeen => "pose to light",
        Phrase::CornersNeedRoom => {
            "corners can be moved only in the windows of a room: start with --display, without --preview"
        }
        Phrase::CornerAt => "{0}: {1} corner at {2}, {3} pixels",
        Phrase::CornerUnsaved => "{0}, not saved",
        Phrase::UpperLeft => "upper left",
        Phrase::UpperRight => "upper right",
        Phrase::LowerRight => "lower right",
        Phrase::LowerLeft => "lower left",
        Phrase::MeasuredWarp => "channel {0} has a measured warp, so its corners cannot be moved",
        Phrase::NotConvex => {
            "channel {0}: the corners make no convex quadrilateral in the order upper left, upper right, lower right, \
             lower left"
        }
        Phrase::NothingToSave => "nothing to save: no corner has been moved",
        Phrase::SavedIn => "saved in {0}",
        Phrase::NotSaved => "not saved: {0}",
        Phrase::CornerNext => "next corner, then the next channel's; with Shift the one before",
        Phrase::CornerMove => "move the corner by 1 pixel; with Shift by 10",
        Phrase::CornerBack => "put the corner back to its place in the file; with Shift to the viewport's corner",
        Phrase::CornerSave => "save",
        Phrase::CornerLeave => "leave",
        Phrase::ShiftKey => "Shift",
        Phrase::SpaceKey => "Space",
        Phrase::BackspaceKey => "Backspace",
        Phrase::EnterKey => "Enter",
    }
}
