//! Phrases of the interface.

macro_rules! phrases {
    ($($(#[$doc:meta])* $name:ident),* $(,)?) => {
        /// Phrase of the interface, which every language has a text of. Numbers in braces stand for values.
        #[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
        pub enum Phrase {
            $($(#[$doc])* $name),*
        }

        impl Phrase {
            /// All phrases.
            pub const ALL: &[Self] = &[$(Self::$name),*];
        }
    };
}

phrases! {
    /// Title of the menu.
    MenuTitle,
    /// Choice of the vehicle.
    Vehicle,
    /// The bicycle.
    Bicycle,
    /// Use of the bicycle.
    BicyclePurpose,
    /// The car.
    Drive,
    /// Use of the car.
    DrivePurpose,
    /// Flight.
    Fly,
    /// Use of flight.
    FlyPurpose,
    /// Speed of light in the world.
    SpeedOfLight,
    /// Use of the speed of light.
    SpeedOfLightPurpose,
    /// Speed of light of 5 km/h.
    WalkingPace,
    /// Speed of light of nature.
    RealLight,
    /// Ratio of own time to real time.
    ClockSpeed,
    /// Use of the time scale.
    ClockSpeedPurpose,
    /// Choice of what is shown of the world.
    View,
    /// View of arriving light.
    Seen,
    /// Use of the view of arriving light.
    SeenPurpose,
    /// View of the observer's present.
    Measured,
    /// Use of the view of the observer's present.
    MeasuredPurpose,
    /// View of the world's present.
    Instant,
    /// Use of the view of the world's present.
    InstantPurpose,
    /// Choice of the effects of relativity.
    Effects,
    /// Doppler shift.
    Doppler,
    /// Use of the Doppler shift.
    DopplerPurpose,
    /// Searchlight effect.
    Searchlight,
    /// Use of the searchlight effect.
    SearchlightPurpose,
    /// Exposure of the picture.
    Brightness,
    /// Use of the exposure.
    BrightnessPurpose,
    /// Automatic exposure.
    Automatic,
    /// Use of automatic exposure.
    AutomaticPurpose,
    /// Tone curve of the picture.
    ToneCurve,
    /// Treatment of colours that the screen cannot show.
    Colours,
    /// Vertical field of view.
    FieldOfView,
    /// Use of the field of view.
    FieldOfViewPurpose,
    /// Use of the tracked head.
    Head,
    /// Place and velocity of the head.
    HeadBoth,
    /// Use of place and velocity of the head.
    HeadBothPurpose,
    /// Place of the head alone.
    HeadPlace,
    /// Use of the place of the head alone.
    HeadPlacePurpose,
    /// Tracking switched off.
    HeadOff,
    /// Use of no tracking.
    HeadOffPurpose,
    /// Order of a frame's work.
    Frames,
    /// Frames that overlap.
    Smooth,
    /// Use of frames that overlap.
    SmoothPurpose,
    /// Frames in sequence.
    Quick,
    /// Use of frames in sequence.
    QuickPurpose,
    /// Choice of the language.
    LanguageChoice,
    /// Use of the choice of the language.
    LanguagePurpose,
    /// Choice of a place to jump to.
    Places,
    /// Use of a place to jump to.
    PlacePurpose,
    /// Stop of the simulation.
    Pause,
    /// Use of the stop.
    PausePurpose,
    /// One step of the simulation.
    Step,
    /// Use of the step.
    StepPurpose,
    /// Return to the start.
    Restart,
    /// Use of the return to the start.
    RestartPurpose,
    /// Choice of the vignette.
    VignetteChoice,
    /// No vignette.
    VignetteOff,
    /// Weak vignette.
    VignetteWeak,
    /// Strong vignette.
    VignetteStrong,
    /// Use of the vignette.
    VignettePurpose,
    /// Name of the chosen vignette, in a sentence.
    VignetteIs,
    /// Lines of the vehicle about the rider.
    Cockpit,
    /// Lines of the vehicle that are shown.
    CockpitShown,
    /// Use of the lines of the vehicle.
    CockpitPurpose,
    /// Choice of the step by which a rider turns.
    SnapTurn,
    /// No turns in steps.
    SnapTurnOff,
    /// Use of turns in steps.
    SnapTurnPurpose,
    /// Choice of the rider's stance.
    StanceChoice,
    /// Seated rider.
    Seated,
    /// Use of a seat.
    SeatedPurpose,
    /// Standing rider.
    Standing,
    /// Use of standing.
    StandingPurpose,
    /// Straight pose of the head.
    Straighten,
    /// Use of the straight pose.
    StraightenPurpose,
    /// Picture of the window.
    Photo,
    /// Use of the picture.
    PhotoPurpose,
    /// Picture of all directions.
    PhotoSphere,
    /// Use of the picture of all directions.
    PhotoSpherePurpose,
    /// Recording of the ride.
    Record,
    /// Use of the recording.
    RecordPurpose,
    /// View from outside.
    Outside,
    /// Use of the view from outside.
    OutsidePurpose,
    /// View from outside that stays.
    Freeze,
    /// Use of the view that stays.
    FreezePurpose,
    /// Plan of the world.
    Miniature,
    /// Use of the plan.
    MiniaturePurpose,
    /// Minkowski diagram.
    Diagram,
    /// Use of the diagram.
    DiagramPurpose,
    /// Diagram in the vehicle's frame.
    DiagramOfVehicle,
    /// Use of the diagram in the vehicle's frame.
    DiagramOfVehiclePurpose,
    /// Head-up display.
    Readings,
    /// Use of the head-up display.
    ReadingsPurpose,
    /// Help.
    Help,
    /// Use of the help.
    HelpPurpose,
    /// End of the ride.
    Leave,
    /// Use of the end.
    LeavePurpose,
    /// End of the menu.
    CloseMenu,
    /// Use of the end of the menu.
    CloseMenuPurpose,
    /// Page of the menu on the ride.
    Ride,
    /// Page of the menu on the picture.
    Picture,
    /// Page of the menu on what explains.
    Understand,
    /// Page of the menu on the program.
    Program,
    /// Devices of the ride.
    Devices,
    /// Use of the page on the ride.
    RidePurpose,
    /// Use of the page on the picture.
    PicturePurpose,
    /// Use of the page on what explains.
    UnderstandPurpose,
    /// Use of the page on the program.
    ProgramPurpose,
    /// Use of a tone curve.
    ReinhardPurpose,
    /// Use of a tone curve.
    LinearPurpose,
    /// Use of a tone curve.
    ExponentialPurpose,
    /// Use of a tone curve.
    FilmicPurpose,
    /// Use of a tone curve.
    HistogramPurpose,
    /// Use of a treatment of colours.
    DesaturatePurpose,
    /// Use of a treatment of colours.
    WhitePurpose,
    /// Use of a treatment of colours.
    ClampPurpose,
    /// Heading of the clocks' names.
    ClockOf,
    /// Heading of what dials are seen to show.
    ClockSeen,
    /// Heading of what dials show at present for the rider.
    ClockForYou,
    /// Heading of what dials show at present for the world.
    ClockForWorld,
    /// Title of the table of clocks.
    Clocks,
    /// Button that goes on with a tour.
    GoOn,
    /// Use of the button that goes on.
    GoOnPurpose,
    /// Button that stops a tour.
    LookAround,
    /// Use of the button that stops a tour.
    LookAroundPurpose,
    /// Use of an answer.
    AnswerPurpose,
    /// Verdict on a right answer.
    Right,
    /// Verdict on a wrong answer.
    Wrong,
    /// Notice at the end of a tour.
    TourOver,
    /// Choice of what colours show from outside.
    ColouringChoice,
    /// Use of the colours from outside.
    ColouringPurpose,
    /// Colours of light.
    ByLight,
    /// Colours of the Doppler factor.
    ByDoppler,
    /// Colours of the delay.
    ByDelay,
    /// Notice of the colours from outside; {0}: their name.
    ColouringIs,
    /// Notice that rooms have no view from outside.
    OnlyFlat,
    /// Label of the speed of light on the display; {0}: the speed.
    Light,
    /// Label of the rider's clock.
    YourClock,
    /// Label of the world's clock.
    WorldClock,
    /// Label of the road travelled.
    Road,
    /// Label of the rider's odometer.
    Odometer,
    /// Label of γ and rapidity.
    GammaRapidity,
    /// State: a recording is written.
    Recording,
    /// State: the ride is held.
    Paused,
    /// Keys of help and menu.
    HelpAndMenu,
    /// Key of the help.
    HelpKey,
    /// Frame rate; {0}: frames a second.
    FramesPerSecond,
    /// Sentence for passers-by of a kiosk.
    Invitation,
    /// Notice of the time scale; {0}: ratio.
    ClockRuns,
    /// Notice of points without a place; {0}: number.
    PointsLost,
    /// Notice of the view; {0}: its name.
    ViewIs,
    /// Notice of the tone curve; {0}: its name.
    ToneIs,
    /// Notice of the exposure; {0}: its text.
    ExposureIs,
    /// Notice of a switch that is on; {0}: its name.
    On,
    /// Notice of a switch that is off; {0}: its name.
    Off,
    /// Notice of the use of the head; {0}: its name.
    HeadIs,
    /// Notice that no head is tracked.
    NoHead,
    /// Notice of a picture; {0}: its file.
    PhotoSaved,
    /// Notice of a value that a setting does not take; {0}: the value.
    NotUnderstood,
    /// Notice: the rapidity has reached its cap; {0}: the cap.
    RapidityCapped,
    /// Notice: a control is not finite.
    ControlsNotFinite,
    /// Notice: RK4 took a step.
    TakenByRk4,
    /// Notice: a step was not taken.
    NotIntegrated,
    /// Notice: walls hold the vehicle.
    HeldByWalls,
    /// Notice: a speed of light out of range.
    SpeedOfLightRefused,
    /// Help: heading of the first line.
    ToGo,
    /// Help: how to go.
    ToGoHow,
    /// Help: heading of the second line.
    ToStop,
    /// Help: how to stop.
    ToStopHow,
    /// Help: heading of the third line.
    ForHelp,
    /// Help: how to get help.
    ForHelpHow,
    /// Help: keys W, S and arrows.
    KeyPedal,
    /// Help: keys A, D and arrows.
    KeySteer,
    /// Help: keys R, F.
    KeyLift,
    /// Help: keys Q, E.
    KeyRoll,
    /// Help: key Shift.
    KeySprint,
    /// Help: space bar.
    KeyBrake,
    /// Help: keys J, L, I, K.
    KeyLook,
    /// Help: key O.
    KeyAhead,
    /// Help: key U.
    KeyStraight,
    /// Help: key M.
    KeyBack,
    /// Help: keys 1, 2, 3.
    KeyVehicles,
    /// Help: key P.
    KeyPause,
    /// Help: full stop.
    KeyStep,
    /// Help: keys − and =.
    KeyClock,
    /// Help: key X.
    KeyView,
    /// Help: keys G, B, N.
    KeyEffects,
    /// Help: key T.
    KeyTone,
    /// Help: brackets.
    KeyBrightness,
    /// Help: keys Y, F5.
    KeyOutside,
    /// Help: tabulator.
    KeyMap,
    /// Help: keys Z, F6.
    KeyDiagram,
    /// Help: key C, F8.
    KeyPhoto,
    /// Help: key V.
    KeyRecord,
    /// Help: backspace.
    KeyRestart,
    /// Help: keys F1, H.
    KeyHelp,
    /// Help: key F2.
    KeyReadings,
    /// Help: key F3.
    KeyMenu,
    /// Help: enter key.
    KeyChoose,
    /// Help: key F4.
    KeyCalibrate,
    /// Help: key F7.
    KeyHead,
    /// Help: key F11.
    KeyFullScreen,
    /// Help: escape key.
    KeyLeave,
    /// Page of the menu on where to ride.
    World,
    /// Use of the page on where to ride.
    WorldPurpose,
    /// Choice of the scene.
    SceneChoice,
    /// The old town.
    SceneTown,
    /// Sight of the old town.
    SceneTownPurpose,
    /// The row of dice.
    SceneDice,
    /// Sight of the row of dice.
    SceneDicePurpose,
    /// The trains.
    SceneTrain,
    /// Sight of the trains.
    SceneTrainPurpose,
    /// The laboratory.
    SceneLaboratory,
    /// Sight of the laboratory.
    SceneLaboratoryPurpose,
    /// The lattice of boxes.
    SceneLattice,
    /// Sight of the lattice.
    SceneLatticePurpose,
    /// The hall of spectra.
    SceneSpectra,
    /// Sight of the hall of spectra.
    SceneSpectraPurpose,
    /// Choice of a tour.
    TourChoice,
    /// Use of the tours.
    TourPurpose,
    /// Notice that something is being made ready; {0}: what.
    Loading,
    /// Notice of something that cannot be shown; {0}: the reason.
    CannotLoad,
    /// Notice of a headset whose session has ended; {0}: the reason.
    HeadsetLost,
    /// Notice that a ride which is shown again keeps its scene.
    StaysRecorded,
    /// Choice of the method of drawing.
    Method,
    /// Use of the choice by the program.
    AutoPurpose,
    /// Use of the polygon renderer.
    PolygonPurpose,
    /// Use of the image renderer.
    ImagePurpose,
    /// Choice of the largest error of a place.
    Tolerance,
    /// Use of the tolerance.
    TolerancePurpose,
    /// Choice of the fineness of the map.
    MapScale,
    /// Use of the fineness of the map.
    MapScalePurpose,
    /// Use of the readings of clocks.
    ClocksPurpose,
    /// The planner.
    Planner,
    /// Use of the planner.
    PlannerPurpose,
    /// The start of the ride.
    Start,
    /// Line of an open device; {0}: its kind, {1}: its name, {2}: samples a second.
    DeviceAt,
    /// Messages that could not be read; {0}: number, {1}: reason of the last.
    BadMessages,
    /// Line of the trainer; {0}: speed, {1}: cadence, {2}: power.
    TrainerLine,
    /// Value that is not measured; {0}: its unit.
    NoValue,
    /// Unit of the cadence.
    TurnsPerMinute,
    /// Things that the panel has no room for; {0}: number.
    MoreThings,
    /// Thing that is on the head; {0}: its name.
    IsHead,
    /// Thing that a tracker sends; {0}: its name, {1}: reports a second.
    HeardAt,
    /// State of a thing that its tracker does not see.
    NotSeen,
    /// Angles of a thing, degrees; {0}: yaw, {1}: pitch, {2}: roll.
    Angles,
    /// Buttons that are held; {0}: their numbers.
    Held,
    /// No button that is held.
    NoButton,
    /// Axes of a thing; {0}: their values.
    Axes,
    /// State: the head is tracked.
    HeadTracked,
    /// State: the head was never seen.
    HeadNeverSeen,
    /// State: the head is lost.
    HeadLost,
    /// Head that is not seen; {0}: its state, {1}: poses rejected, {2}: reason of the last.
    PosesRejected,
    /// Line of the head; {0}: its state, {1}: poses rejected.
    HeadLine,
    /// Notice: the head is straight.
    HeadIsStraight,
    /// Notice: no head can be straightened.
    NoHeadToStraighten,
    /// Notice: a head of a calibrated tracker stays.
    HeadIsCalibrated,
    /// Notice: a recorded head stays.
    RecordedHeadStays,
    /// Line on the devices of a ride that is replayed.
    RecordedRide,
    /// Notice: a recording begins; {0}: its file.
    RecordingInto,
    /// Notice: a recording is being completed.
    RecordingEnds,
    /// Notice: a recording is complete.
    RecordingComplete,
    /// Notice: the ride is not recorded; {0}: reason.
    NotRecorded,
    /// Notice: the past of the ride is lost; {0}: reason.
    NotRemembered,
    /// Notice: a recording lacks the end of the ride; {0}: its file.
    RecordingCut,
    /// Notice of a replay; {0}: frame, {1}: field, {2}: its recorded value, {3}: its value now.
    ReplayDiffers,
    /// Notice of own time that was lost; {0}: seconds.
    LostTime,
    /// Notice: no picture was saved; {0}: reason.
    PhotoFailed,
    /// Notice: the language was not saved; {0}: reason.
    LanguageNotKept,
    /// Notice of an eye behind a screen; {0}: channel, {1}: place of the eye, {2}: distance, metres.
    ChannelBlack,
    /// Notice of coarse edges; {0}: angle.
    DirectionsUncertain,
    /// Notice of rounded numbers; {0}: angle.
    AsternUncertain,
    /// Sixtieths of a degree.
    Arcminutes,
    /// Sixtieths of an arcminute.
    Arcseconds,
    /// Accuracy of a picture; {0}: error, {1}: share of the window's resolution, percent.
    DrawnAt,
    /// Line on the drawing; {0}: triangles, {1}: renderer, {2}: graphics device.
    DrawnBy,
    /// Line on several windows; {0}: windows, {1}: frame, {2} and {3}: skew and longest skew, milliseconds,
    /// {4}: windows left out, {5}: turns held.
    InStep,
    /// Title of the operator's window.
    OperatorTitle,
    /// Stage of a frame: devices and vehicle.
    StageRide,
    /// Stage of a frame: work for the other threads.
    StageSubmit,
    /// Stage of a frame: photo-surfaces.
    StageTransform,
    /// Stage of a frame: light.
    StageDraw,
    /// Stage of a frame: windows.
    StageShow,
    /// Time from a headset's pose to the picture that was handed over for it.
    StagePose,
    /// Time from a headset's pose to the moment at which its picture is seen.
    StageSeen,
    /// Notice: a flat picture has no corners to move.
    CornersNeedRoom,
    /// Corner that keys move; {0}: channel, {1}: corner, {2} and {3}: place, pixels.
    CornerAt,
    /// Corner that the file has elsewhere; {0}: the corner.
    CornerUnsaved,
    /// Corner of a picture.
    UpperLeft,
    /// Corner of a picture.
    UpperRight,
    /// Corner of a picture.
    LowerRight,
    /// Corner of a picture.
    LowerLeft,
    /// Message: a channel has no corners to move; {0}: channel.
    MeasuredWarp,
    /// Message: corners would make no picture; {0}: channel.
    NotConvex,
    /// Message: no corner has moved.
    NothingToSave,
    /// Message: corners are saved; {0}: file.
    SavedIn,
    /// Message: corners are not saved; {0}: reason.
    NotSaved,
    /// Meaning of a key while corners are moved.
    CornerNext,
    /// Meaning of keys while corners are moved.
    CornerMove,
    /// Meaning of a key while corners are moved.
    CornerBack,
    /// Meaning of a key while corners are moved.
    CornerSave,
    /// Meaning of a key while corners are moved.
    CornerLeave,
    /// Name of a key.
    ShiftKey,
    /// Name of a key.
    SpaceKey,
    /// Name of a key.
    BackspaceKey,
    /// Name of the enter key.
    EnterKey,
}
