//! German texts.

use crate::phrase::Phrase;

/// German text of a phrase.
#[expect(clippy::too_many_lines, reason = "one line a phrase")]
pub fn text(phrase: Phrase) -> &'static str {
    match phrase {
        Phrase::MenuTitle => "Menü",
        Phrase::Vehicle => "Fahrzeug",
        Phrase::Bicycle => "Fahrrad",
        Phrase::BicyclePurpose => "In die Pedale treten und mit dem Lenker lenken.",
        Phrase::Drive => "Auto",
        Phrase::DrivePurpose => "In jede Richtung über den Boden gleiten.",
        Phrase::Fly => "Flug",
        Phrase::FlyPurpose => "Frei fliegen, auch auf und ab.",
        Phrase::SpeedOfLight => "Lichtgeschwindigkeit",
        Phrase::SpeedOfLightPurpose => {
            "Wie schnell das Licht in dieser Welt ist. Je langsamer, desto eher sieht man die Relativität."
        }
        Phrase::WalkingPace => "Schritttempo",
        Phrase::RealLight => "wie in der Natur",
        Phrase::ClockSpeed => "Gang deiner Uhr",
        Phrase::ClockSpeedPurpose => {
            "Wie viel deiner eigenen Zeit in einer Sekunde vergeht. Unter 1 siehst du alles in Zeitlupe."
        }
        Phrase::View => "Ansicht",
        Phrase::Seen => "gesehen",
        Phrase::SeenPurpose => "Alles dort, woher sein Licht kommt: was deine Augen sehen würden.",
        Phrase::Measured => "gemessen",
        Phrase::MeasuredPurpose => {
            "Alles dort, wo es für dich jetzt ist, längs deiner Bewegung verkürzt. Das sieht niemand: Man \
             rechnet es hinterher aus."
        }
        Phrase::Instant => "Licht sofort",
        Phrase::InstantPurpose => "Alles dort, wo es für die Welt jetzt ist, als bräuchte das Licht keine Zeit.",
        Phrase::Effects => "Effekte",
        Phrase::Doppler => "Doppler",
        Phrase::DopplerPurpose => "Verschiebt Farben: vorn blauer, hinten röter. Aus: Farben wie in Ruhe.",
        Phrase::Searchlight => "Scheinwerfer",
        Phrase::SearchlightPurpose => "Macht es vorn heller und hinten dunkler. Aus: Helligkeit wie in Ruhe.",
        Phrase::Brightness => "Helligkeit",
        Phrase::BrightnessPurpose => "Blendenstufen, um die das Bild heller ist. Jede verdoppelt das Licht.",
        Phrase::Automatic => "automatisch",
        Phrase::AutomaticPurpose => {
            "Wie ein Auge, das sich anpasst: im Mittel so hell wie in Ruhe. Aus: Was in Ruhe weiß ist, ist weiß."
        }
        Phrase::ToneCurve => "Tonwertkurve",
        Phrase::Colours => "Farben",
        Phrase::FieldOfView => "Blickfeld",
        Phrase::FieldOfViewPurpose => "Wie viel du von unten bis oben siehst. Klein ist wie ein Fernrohr.",
        Phrase::Head => "Kopfverfolgung",
        Phrase::HeadBoth => "Ort und Geschwindigkeit",
        Phrase::HeadBothPurpose => "Auch die Bewegung deines Kopfes ist relativistisch.",
        Phrase::HeadPlace => "Ort",
        Phrase::HeadPlacePurpose => "Dein Kopf gilt als ruhend im Fahrzeug, wo immer er ist.",
        Phrase::HeadOff => "aus",
        Phrase::HeadOffPurpose => "Das Bild stimmt für einen Ort und bleibt so.",
        Phrase::Frames => "Bilder",
        Phrase::Smooth => "flüssig",
        Phrase::SmoothPurpose => "Mehr Bilder in der Sekunde. Jedes kommt ein Bild später.",
        Phrase::Quick => "schnelle Antwort",
        Phrase::QuickPurpose => "Jedes Bild zeigt deine neueste Bewegung. Es sind weniger.",
        Phrase::LanguageChoice => "Sprache",
        Phrase::LanguagePurpose => "Sprache von allem, was hier geschrieben steht.",
        Phrase::Places => "Gehe zu",
        Phrase::PlacePurpose => "Setzt dich dort in Ruhe ab.",
        Phrase::Pause => "Anhalten",
        Phrase::PausePurpose => "Hält die Welt an oder lässt sie weitergehen. Umsehen und umhergehen kannst du weiter.",
        Phrase::Step => "Schritt",
        Phrase::StepPurpose => "Bewegt die angehaltene Welt um einen kleinen Schritt weiter.",
        Phrase::Restart => "Zum Anfang",
        Phrase::RestartPurpose => "Bringt dich dorthin zurück, wo die Fahrt begann.",
        Phrase::VignetteChoice => "Dunkler Rand",
        Phrase::VignetteOff => "aus",
        Phrase::VignetteWeak => "schwach",
        Phrase::VignetteStrong => "stark",
        Phrase::VignettePurpose => {
            "Verdunkelt den Rand deines Blicks, solange das Fahrzeug schneller oder langsamer wird oder sich dreht: das siehst du, spürst es aber nicht."
        }
        Phrase::VignetteIs => "dunkler Rand: {0}",
        Phrase::Cockpit => "Fahrzeuglinien",
        Phrase::CockpitShown => "gezeigt",
        Phrase::CockpitPurpose => "Linien um dich, die im Fahrzeug ruhen: daran halten sich die Augen.",
        Phrase::SnapTurn => "Drehschritte",
        Phrase::SnapTurnOff => "keine",
        Phrase::SnapTurnPurpose => {
            "Kippst du den Stick der anderen Hand zur Seite, drehst du dich im Fahrzeug um so viel, auf der Stelle."
        }
        Phrase::StanceChoice => "Du fährst",
        Phrase::Seated => "im Sitzen",
        Phrase::SeatedPurpose => "Wo du jetzt bist, ist der Fahrersitz, wie hoch du auch bist.",
        Phrase::Standing => "im Stehen",
        Phrase::StandingPurpose => {
            "Du stehst auf dem Boden des Fahrzeugs, so groß, wie du bist. Wo du jetzt bist, ist dein Platz."
        }
        Phrase::Straighten => "Gerade",
        Phrase::StraightenPurpose => "Macht Ort und Richtung deines verfolgten Kopfes zur Mitte.",
        Phrase::Photo => "Foto",
        Phrase::PhotoPurpose => "Speichert das Bild als Datei, photo-001.png und so weiter.",
        Phrase::PhotoSphere => "Rundum-Foto",
        Phrase::PhotoSpherePurpose => "Speichert ein Bild aller Richtungen, sphere-001.png und so weiter.",
        Phrase::Record => "Aufnehmen",
        Phrase::RecordPurpose => {
            "Speichert die ganze Fahrt als Datei, ride-001.mcap und so weiter, oder schließt die Datei ab."
        }
        Phrase::Outside => "Von außen",
        Phrase::OutsidePurpose => "Zeigt, was du siehst, als Körper im Raum, von außen. Die Kugel bist du.",
        Phrase::Freeze => "Einfrieren",
        Phrase::FreezePurpose => "Behält die Außenansicht, wie sie jetzt ist, während du weiterfährst.",
        Phrase::Miniature => "Karte",
        Phrase::MiniaturePurpose => "Zeigt die Welt von oben, deinen Weg bisher und beide Uhren.",
        Phrase::Diagram => "Diagramm",
        Phrase::DiagramPurpose => "Zeichnet deinen Weg durch Raum und Zeit, Licht unter 45 Grad.",
        Phrase::DiagramOfVehicle => "Dein System",
        Phrase::DiagramOfVehiclePurpose => "Zeichnet das Diagramm, wie du misst, statt wie die Welt.",
        Phrase::Readings => "Anzeigen",
        Phrase::ReadingsPurpose => "Zeigt Geschwindigkeit, Uhren und Strecken.",
        Phrase::Help => "Hilfe",
        Phrase::HelpPurpose => "Nennt alle Tasten.",
        Phrase::Leave => "Beenden",
        Phrase::LeavePurpose => "Beendet die Fahrt. Eine Aufnahme wird fertiggestellt.",
        Phrase::CloseMenu => "Schließen",
        Phrase::CloseMenuPurpose => "Schließt dieses Menü. F3 öffnet es wieder.",
        Phrase::Ride => "Fahrt",
        Phrase::Picture => "Bild",
        Phrase::Understand => "Verstehen",
        Phrase::Program => "Programm",
        Phrase::Devices => "Geräte",
        Phrase::RidePurpose => "Fahrzeug, Lichtgeschwindigkeit, deine Uhr, Orte.",
        Phrase::PicturePurpose => "Effekte, Helligkeit, Farben, Blickfeld.",
        Phrase::UnderstandPurpose => "Was man sieht und was ist: Ansichten, Karte, Diagramm.",
        Phrase::ProgramPurpose => "Sprache, Geräte und das Ende.",
        Phrase::ReinhardPurpose => "Erhält Einzelheiten im Hellen und lässt den Rest, wie er ist.",
        Phrase::LinearPurpose => "Zeigt Helligkeit, wie sie ist. Was heller als Weiß ist, ist weiß.",
        Phrase::ExponentialPurpose => "Helle Stellen laufen ins Weiße, wie auf Film.",
        Phrase::FilmicPurpose => "Mehr Kontrast mit dunklen Schatten, wie im Kino.",
        Phrase::HistogramPurpose => {
            "Teilt die Helligkeit des Schirms auf, sodass Dunkles und Helles Einzelheiten zeigen."
        }
        Phrase::DesaturatePurpose => "Farben, die der Schirm nicht zeigen kann, werden blasser.",
        Phrase::WhitePurpose => {
            "Farben, die der Schirm nicht zeigen kann, werden mit Weiß gemischt und dann abgedunkelt."
        }
        Phrase::ClampPurpose => {
            "Farben, die der Schirm nicht zeigen kann, werden abgeschnitten. Ihr Ton kann sich ändern."
        }
        Phrase::ClockOf => "Uhr",
        Phrase::ClockSeen => "wie du sie siehst",
        Phrase::ClockForYou => "jetzt, für dich",
        Phrase::ClockForWorld => "jetzt, für die Welt",
        Phrase::Clocks => "Uhren",
        Phrase::GoOn => "Weiter",
        Phrase::GoOnPurpose => "Setzt die Führung fort. Die Eingabetaste tut dasselbe.",
        Phrase::LookAround => "Anhalten und umsehen",
        Phrase::LookAroundPurpose => "Hält die Führung hier an. Weiter geht es, wann du willst.",
        Phrase::AnswerPurpose => "Wählt diese Antwort. Die Führung sagt, ob sie stimmt, und warum.",
        Phrase::Right => "Richtig.",
        Phrase::Wrong => "Nicht ganz.",
        Phrase::TourOver => "Die Führung ist zu Ende: Die Fahrt gehört dir.",
        Phrase::ColouringChoice => "Farben von außen",
        Phrase::ColouringPurpose => "Was die Farben der Außenansicht bedeuten.",
        Phrase::ByLight => "Licht",
        Phrase::ByDoppler => "Doppler-Faktor",
        Phrase::ByDelay => "Laufzeit des Lichts",
        Phrase::ColouringIs => "Farben von außen: {0}",
        Phrase::OnlyFlat => "die Außenansicht gibt es im flachen Fenster, nicht in einem Raum",
        Phrase::Light => "Licht: {0}",
        Phrase::YourClock => "deine Uhr",
        Phrase::WorldClock => "Uhr der Welt",
        Phrase::Road => "Straße gefahren",
        Phrase::Odometer => "dein Kilometerzähler",
        Phrase::GammaRapidity => "γ · Rapidität",
        Phrase::Recording => "Aufnahme läuft",
        Phrase::Paused => "angehalten: weiter mit P",
        Phrase::HelpAndMenu => "F1 Hilfe · F3 Menü",
        Phrase::HelpKey => "F1 Hilfe",
        Phrase::FramesPerSecond => "{0} Bilder/s",
        Phrase::Invitation => "Taste drücken oder losradeln: Die Fahrt gehört dir",
        Phrase::ClockRuns => "deine Uhr läuft × {0}",
        Phrase::PointsLost => "{0} Punkte der Szene haben keinen sichtbaren Ort und werden nicht gezeichnet",
        Phrase::ViewIs => "Ansicht: {0}",
        Phrase::ToneIs => "Tonwertkurve: {0}",
        Phrase::ExposureIs => "Belichtung: {0}",
        Phrase::On => "{0}: an",
        Phrase::Off => "{0}: aus",
        Phrase::HeadIs => "Kopfverfolgung: {0}",
        Phrase::NoHead => "kein Kopf wird verfolgt; --tracker nennt einen Tracker",
        Phrase::PhotoSaved => "Foto: {0}",
        Phrase::NotUnderstood => "{0}: keinen solchen Wert gibt es; nichts wurde geändert",
        Phrase::RapidityCapped => "Rapidität auf {0} begrenzt",
        Phrase::ControlsNotFinite => "ein Steuerwert ist keine endliche Zahl: er gilt als losgelassen",
        Phrase::TakenByRk4 => "das gewählte Verfahren gab einen Schritt auf: RK4 hat ihn gerechnet",
        Phrase::NotIntegrated => "ein Schritt ließ sich nicht rechnen: das Fahrzeug wartet",
        Phrase::HeldByWalls => "zu schnell für diese Mauern: abgebremst",
        Phrase::SpeedOfLightRefused => "mit dieser Lichtgeschwindigkeit lässt sich keine Welt rechnen",
        Phrase::ToGo => "Losfahren",
        Phrase::ToGoHow => {
            "W oder den Pfeil nach oben halten oder treten; A und D oder die Pfeile links und rechts lenken"
        }
        Phrase::ToStop => "Anhalten",
        Phrase::ToStopHow => "die Leertaste halten; die Rücktaste bringt dich zum Anfang",
        Phrase::ForHelp => "Hilfe",
        Phrase::ForHelpHow => "F1 zeigt und verbirgt diese Seite",
        Phrase::KeyPedal => "treten, zurückschieben; Schub vor, zurück; im Flug senken und heben die Pfeile die Nase",
        Phrase::KeySteer => "lenken; Schub seitwärts; die Pfeile drehen die Nase",
        Phrase::KeyLift => "Schub auf, ab im Flug",
        Phrase::KeyRoll => "rollen",
        Phrase::KeySprint => "sprinten",
        Phrase::KeyBrake => "bremsen",
        Phrase::KeyLook => {
            "nach links, rechts, oben, unten schauen, wie ein Zug mit der Maus; Räume und verfolgte Köpfe \
             schauen selbst"
        }
        Phrase::KeyAhead => "wieder nach vorn schauen, wie die mittlere Maustaste",
        Phrase::KeyStraight => "Ort und Richtung deines Kopfes werden die Mitte",
        Phrase::KeyBack => "zurückschauen, solange gehalten",
        Phrase::KeyVehicles => "Fahrrad, Auto, Flug",
        Phrase::KeyPause => "die Welt anhalten oder weitergehen lassen; umsehen geht weiter",
        Phrase::KeyStep => "ein Schritt, während angehalten ist",
        Phrase::KeyClock => "deine Uhr langsamer, schneller",
        Phrase::KeyView => "nächste Ansicht: gesehen, gemessen, Licht sofort",
        Phrase::KeyEffects => "Geometrie, Doppler-Verschiebung, Scheinwerfereffekt: an, aus",
        Phrase::KeyTone => "nächste Tonwertkurve",
        Phrase::KeyBrightness => "dunkler, heller",
        Phrase::KeyOutside => "von außen sehen, was du siehst (mit der Maus herumgehen); einfrieren; Farben",
        Phrase::KeyMap => "Karte der Welt, mit beiden Uhren",
        Phrase::KeyDiagram => "Raum-Zeit-Diagramm der Fahrt; in deinem System oder dem der Welt",
        Phrase::KeyPhoto => "Foto; Foto aller Richtungen",
        Phrase::KeyRecord => "die ganze Fahrt von Anfang an aufnehmen",
        Phrase::KeyRestart => "zurück zum Anfang",
        Phrase::KeyHelp => "diese Hilfe",
        Phrase::KeyReadings => "Anzeigen zeigen oder verbergen",
        Phrase::KeyMenu => "Menü",
        Phrase::KeyChoose => "im Menü wählen; eine Führung fortsetzen",
        Phrase::KeyCalibrate => "die Ecken der Bilder eines Raums verschieben",
        Phrase::KeyHead => "nächste Nutzung des verfolgten Kopfes",
        Phrase::KeyFullScreen => "ganzer Bildschirm",
        Phrase::KeyLeave => "beenden",
        Phrase::World => "Welt",
        Phrase::WorldPurpose => "Szenen, Führungen und Orte.",
        Phrase::SceneChoice => "Szene",
        Phrase::SceneTown => "Altstadt",
        Phrase::SceneTownPurpose => "Straßen, Häuser und Uhren, in denen Licht nur 30 km/h schnell ist.",
        Phrase::SceneDice => "Würfel",
        Phrase::SceneDicePurpose => "Würfel am Straßenrand. Was vorbeizieht, sieht gedreht aus, nicht verkürzt.",
        Phrase::SceneTrain => "Züge",
        Phrase::SceneTrainPurpose => "Ein Bahnsteig und Züge mit Uhren. Wessen Uhr geht nach?",
        Phrase::SceneLaboratory => "Labor",
        Phrase::SceneLaboratoryPurpose => {
            "Ein Würfel und eine Kugel fliegen vorbei, wie in einem veröffentlichten Versuch."
        }
        Phrase::SceneLattice => "Gitter",
        Phrase::SceneLatticePurpose => "Kästen in einem würfelförmigen Gitter, in dem man jede Krümmung sieht.",
        Phrase::SceneSpectra => "Spektren",
        Phrase::SceneSpectraPurpose => {
            "Lichter von drei Temperaturen und aus einzelnen Linien, und ihre Doppler-Verschiebung."
        }
        Phrase::TourChoice => "Führungen",
        Phrase::TourPurpose => "Fährt für dich, erklärt, was du siehst, und fragt. Jede dauert keine Minute.",
        Phrase::Loading => "{0} wird vorbereitet; die Fahrt geht solange weiter",
        Phrase::CannotLoad => "das lässt sich nicht zeigen: {0}",
        Phrase::HeadsetLost => "{0}; die Fahrt geht im Fenster weiter",
        Phrase::StaysRecorded => "eine aufgezeichnete Fahrt bleibt in ihrer Szene",
        Phrase::Method => "Zeichnen",
        Phrase::AutoPurpose => "Das Programm nimmt das Verfahren, das zur Szene passt.",
        Phrase::PolygonPurpose => "Krümmt jede Ecke jedes Dreiecks. Genau; je feiner, desto langsamer.",
        Phrase::ImagePurpose => {
            "Zeichnet eine Karte der Welt um dich und krümmt ihre Bildpunkte. Schnell in groben Szenen."
        }
        Phrase::Tolerance => "Größter Fehler",
        Phrase::TolerancePurpose => "Größter Abstand des Gezeichneten von seinem genauen Ort, in Bildpunkten.",
        Phrase::MapScale => "Feinheit",
        Phrase::MapScalePurpose => "Punkte der Karte für jeden Bildpunkt.",
        Phrase::ClocksPurpose => "Was Uhren in deiner Nähe zeigen: wie gesehen, jetzt für dich, jetzt für die Welt.",
        Phrase::Planner => "Reiseplan",
        Phrase::PlannerPurpose => "Sagt, wann du umdrehen und bremsen musst, um am Ort vor dir anzuhalten.",
        Phrase::Start => "der Anfang",
        Phrase::DeviceAt => "{0}: {1} mit {2} Hz",
        Phrase::BadMessages => "{0} unlesbar, zuletzt: {1}",
        Phrase::TrainerLine => "Rollentrainer {0} · {1} · {2}",
        Phrase::NoValue => "– {0}",
        Phrase::TurnsPerMinute => "U/min",
        Phrase::MoreThings => "und {0} weitere: siehe rapidity devices",
        Phrase::IsHead => "{0} (der Kopf)",
        Phrase::HeardAt => "{0}: {1} je Sekunde",
        Phrase::NotSeen => "nicht gesehen",
        Phrase::Angles => "Gieren {0}° Nicken {1}° Rollen {2}°",
        Phrase::Held => "gedrückt: {0}",
        Phrase::NoButton => "keine",
        Phrase::Axes => "Achsen {0}",
        Phrase::HeadTracked => "der Kopf wird verfolgt",
        Phrase::HeadNeverSeen => "der Kopf wurde noch nicht gesehen",
        Phrase::HeadLost => "der Kopf ist verloren und ruht an seinem letzten Ort",
        Phrase::PosesRejected => "{0}; verworfene Posen: {1}, zuletzt: {2}",
        Phrase::HeadLine => "{0}; {1} Posen verworfen",
        Phrase::HeadIsStraight => "dein Kopf ist gerade: sein Ort und seine Richtung sind die Mitte",
        Phrase::NoHeadToStraighten => {
            "kein Kopf wird verfolgt, also gibt es nichts gerade zu stellen; --tracker nennt einen Tracker"
        }
        Phrase::HeadIsCalibrated => {
            "der Tracker dieses Raums ist eingemessen, also bleibt der Kopf, wie er ist; recentre = \"key\" in \
             [tracker] erlaubt es"
        }
        Phrase::RecordedHeadStays => "ein aufgezeichneter Kopf bleibt, wie er war",
        Phrase::RecordedRide => "eine aufgezeichnete Fahrt",
        Phrase::RecordingInto => "Aufnahme vom Anfang der Fahrt an, in {0}",
        Phrase::RecordingEnds => "die Aufnahme ist beendet und wird auf der Platte fertiggestellt",
        Phrase::RecordingComplete => "die Aufnahme ist fertig",
        Phrase::NotRecorded => "die Fahrt wird nicht aufgenommen: {0}",
        Phrase::NotRemembered => {
            "die bisherige Fahrt ist nicht mehr bekannt ({0}), also lässt sie sich nicht aufnehmen; das Programm mit \
             --record DATEI starten"
        }
        Phrase::RecordingCut => "{0}: die Fahrt wurde nicht bis zum Ende aufgenommen",
        Phrase::ReplayDiffers => {
            "die Wiedergabe weicht in Bild {0} von der Aufnahme ab: {1} war {2}, ist {3}; stammt sie von dieser \
             Version, und ist die Szene dieselbe?"
        }
        Phrase::LostTime => {
            "{0} s deiner eigenen Zeit wurden nicht gefahren: Bilder brauchten länger als eine Viertelsekunde; ein \
             kleineres Bild hilft"
        }
        Phrase::PhotoFailed => "kein Foto: {0}",
        Phrase::LanguageNotKept => "die Sprache wird nicht gemerkt: {0}",
        Phrase::ChannelBlack => {
            "{0} ist schwarz: das Auge bei {1} m liegt {2} m hinter der Ebene der Leinwand; die Leinwand umdrehen \
             oder den Kopf davor bringen"
        }
        Phrase::DirectionsUncertain => {
            "Richtungen sind um etwa {0} unsicher; ein kleineres --tolerance oder --edge oder ein größeres \
             --map-scale hilft"
        }
        Phrase::AsternUncertain => {
            "Richtungen nach hinten sind um etwa {0} unsicher: 32 Bit fassen nicht mehr; --renderer polygon hilft"
        }
        Phrase::Arcminutes => "Bogenminuten",
        Phrase::Arcseconds => "Bogensekunden",
        Phrase::DrawnAt => "{0} · mit {1} % gezeichnet",
        Phrase::DrawnBy => "{0} Dreiecke, Renderer {1}, auf {2}",
        Phrase::InStep => {
            "{0} Fenster im Gleichtakt: Bild {1} innerhalb von {2} ms gezeigt (bisher höchstens {3} ms); {4} \
             ausgelassen; {5}-mal gewartet"
        }
        Phrase::OperatorTitle => "Rapidity: Bedienung",
        Phrase::StageRide => "Fahrt",
        Phrase::StageSubmit => "Auftrag",
        Phrase::StageTransform => "Umrechnung",
        Phrase::StageDraw => "Zeichnen",
        Phrase::StageShow => "Anzeige",
        Phrase::StagePose => "Pose bis Bild",
        Phrase::StageSeen => "Pose bis Licht",
        Phrase::CornersNeedRoom => {
            "Ecken lassen sich nur in den Fenstern eines Raums verschieben: mit --display und ohne --preview starten"
        }
        Phrase::CornerAt => "{0}: Ecke {1} bei {2}, {3} Pixel",
        Phrase::CornerUnsaved => "{0}, nicht gespeichert",
        Phrase::UpperLeft => "links oben",
        Phrase::UpperRight => "rechts oben",
        Phrase::LowerRight => "rechts unten",
        Phrase::LowerLeft => "links unten",
        Phrase::MeasuredWarp => {
            "Kanal {0} hat eine gemessene Verzerrung, also lassen sich seine Ecken nicht verschieben"
        }
        Phrase::NotConvex => {
            "Kanal {0}: die Ecken bilden in der Reihenfolge links oben, rechts oben, rechts unten, links unten kein \
             konvexes Viereck"
        }
        Phrase::NothingToSave => "nichts zu speichern: keine Ecke wurde verschoben",
        Phrase::SavedIn => "gespeichert in {0}",
        Phrase::NotSaved => "nicht gespeichert: {0}",
        Phrase::CornerNext => "nächste Ecke, dann die des nächsten Kanals; mit Umschalt die vorige",
        Phrase::CornerMove => "die Ecke um 1 Pixel verschieben, mit Umschalt um 10",
        Phrase::CornerBack => {
            "die Ecke an ihren Ort aus der Datei zurücksetzen; mit Umschalt in die Ecke des Bildbereichs"
        }
        Phrase::CornerSave => "speichern",
        Phrase::CornerLeave => "verlassen",
        Phrase::ShiftKey => "Umschalt",
        Phrase::SpaceKey => "Leertaste",
        Phrase::BackspaceKey => "Rücktaste",
        Phrase::EnterKey => "Eingabe",
    }
}
