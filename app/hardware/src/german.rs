//! German texts on devices. English ones are the [`Display`](std::fmt::Display) of the things themselves, which the
//! terminal shows. What the operating system and libraries say stays as they word it.

use input::SampleSource;
use input::devices::{DeviceFault, DeviceNote, TrainerError, TrainerRequest, UDEV_RULE, short_numbers};
use input::head::{HeardKind, HeardSensor};
use input::openxr::XrFault;
use input::trainer::ControlRefusal;
use input::trainer::wire::RequestRefusal;

/// Name of a source of samples.
pub fn source(source: SampleSource) -> &'static str {
    match source {
        SampleSource::Keyboard => "Tastatur",
        SampleSource::Gamepad => "Gamepad",
        SampleSource::SpaceMouse => "SpaceMouse",
        SampleSource::Spacenavd => "spacenavd",
        SampleSource::Bicycle => "Fahrrad",
        SampleSource::Trainer => "Rollentrainer",
        SampleSource::Vrpn => "VRPN",
        SampleSource::Dtrack => "DTrack",
        SampleSource::Opentrack => "opentrack",
        SampleSource::Openxr => "Headset",
        SampleSource::Mouse => "Maus",
        SampleSource::Settings => "Bedienung",
    }
}

/// Name of a thing that a tracker sends.
pub fn thing(thing: &HeardSensor) -> String {
    let HeardSensor { device, number, .. } = thing;
    match thing.kind {
        HeardKind::Sensor => format!("Sensor {number} von {device}"),
        HeardKind::Body => format!("Körper {number}"),
        HeardKind::InertialBody => format!("Inertialkörper {number}"),
        HeardKind::Flystick => format!("Flystick {number}"),
        HeardKind::Buttons => format!("Tasten von {device}"),
        HeardKind::Axes => format!("Achsen von {device}"),
    }
}

/// Sentence on a device that is not open.
pub fn fault(reason: &DeviceFault) -> String {
    match reason {
        DeviceFault::Sought => "wird gesucht".to_owned(),
        DeviceFault::ProgramEnds => "das Programm endet".to_owned(),
        DeviceFault::Gone(why) => {
            format!("nicht mehr da ({}); geht weiter, sobald das Gerät zurück ist", fault(why))
        }
        DeviceFault::System(text) => text.clone(),
        DeviceFault::NoGamepad => "kein Gamepad ist angeschlossen".to_owned(),
        DeviceFault::GamepadForbidden(path) => {
            format!("{path} darf nicht gelesen werden: `sudo usermod -aG input $USER`, dann neu anmelden")
        }
        DeviceFault::NoSerialPort(path) => {
            format!("{path} gibt es nicht: das Fahrrad anschließen oder einen anderen Anschluss nennen")
        }
        DeviceFault::SerialPortForbidden(path) => {
            format!("{path} darf nicht geöffnet werden: `sudo usermod -aG dialout $USER`, dann neu anmelden")
        }
        DeviceFault::SerialPort(path, why) => {
            format!("{path} lässt sich nicht als serieller Anschluss öffnen: {why}")
        }
        DeviceFault::NoHidList(why) => format!("die HID-Geräte lassen sich nicht auflisten: {why}"),
        DeviceFault::NoSpaceMouse => "keine SpaceMouse ist angeschlossen".to_owned(),
        DeviceFault::SpaceMouseForbidden { name, path, reason } => {
            let (rule, file) = UDEV_RULE;
            format!(
                "{name} darf an {path} nicht gelesen werden ({reason}): als root `{rule}` in {file} schreiben und das \
                 Gerät neu anschließen"
            )
        }
        DeviceFault::SpacenavdRefuses(place, why) => format!("spacenavd ist an {place} nicht erreichbar: {why}"),
        DeviceFault::NoSpacenavd(places) => format!("spacenavd läuft nicht ({places})"),
        DeviceFault::NeverSpacenavd(place) => format!("spacenavd gibt es hier nicht{place}"),
        DeviceFault::Both(one, other) => format!("{}; {}", fault(one), fault(other)),
        DeviceFault::PortTaken(program, place) => format!(
            "ein anderes Programm empfängt an {place}: es beenden oder {program} an einen anderen Port senden lassen"
        ),
        DeviceFault::NotOurAddress(place) => {
            format!("{place} ist keine Adresse dieses Rechners: eine nennen, die es ist, oder keine")
        }
        DeviceFault::Deaf(place, why) => format!("an {place} lässt sich nichts empfangen: {}", fault(why)),
        DeviceFault::NoInterface => "dieser Rechner hat dafür keine Netzwerkschnittstelle".to_owned(),
        DeviceFault::NoHost(host, why) => {
            format!("einen Rechner {host:?} gibt es nicht ({why}): einen anderen nennen")
        }
        DeviceFault::NoVrpnServer(place, why) => format!("kein VRPN-Server an {place}: {}", fault(why)),
        DeviceFault::At(place, why) => format!("{place}: {}", fault(why)),
        DeviceFault::NoTrainer(place, why) => format!("kein Rollentrainer an {place}: {}", fault(why)),
        DeviceFault::NoAddress => "er hat keine Adresse".to_owned(),
        DeviceFault::NoVrpnThere => {
            "dort wartet kein Programm: den VRPN-Server starten oder einen anderen Port nennen".to_owned()
        }
        DeviceFault::NoTrainerThere => {
            "dort wartet kein Gerät: den Rollentrainer einschalten oder einen anderen Port nennen".to_owned()
        }
        DeviceFault::NothingThere => "dort antwortet nichts: ist er eingeschaltet und in diesem Netz?".to_owned(),
        DeviceFault::NoGreeting => "er meldet sich nicht; ist es ein VRPN-Server?".to_owned(),
        DeviceFault::Silent(seconds) => format!("seit {seconds} s stumm"),
        DeviceFault::SilentWithoutDevices(seconds) => {
            format!("seit {seconds} s stumm; er hat kein Gerät gemeldet")
        }
        DeviceFault::SilentWithOthers(seconds, others) => {
            format!("seit {seconds} s stumm; dieses Gerät hat er nicht, aber {others}")
        }
        DeviceFault::Trainer(error) => trainer(error),
        DeviceFault::Headset(why) => headset(why),
    }
}

/// Sentence on a headset that cannot be used.
fn headset(fault: &XrFault) -> String {
    match fault {
        XrFault::NoLoader(why) => format!(
            "OpenXR ist nicht installiert ({why}): unter Debian oder Ubuntu `sudo apt-get install libopenxr-loader1`"
        ),
        XrFault::NoRuntime(why) => {
            format!("keine OpenXR-Laufzeit antwortet ({why}): zuerst die des Headsets starten (SteamVR, Monado, WiVRn)")
        }
        XrFault::Lacks(runtime, extension) => {
            format!("{runtime} fehlt {extension}: eine andere oder neuere OpenXR-Laufzeit verwenden")
        }
        XrFault::NoHeadset(runtime) => format!("{runtime} sieht kein Headset: anschließen und einschalten"),
        XrFault::Refused(runtime, what, why) => format!("{runtime} verweigert {what}: {why}"),
        XrFault::Ended(runtime) => format!("{runtime} hat die Sitzung beendet"),
    }
}

/// Sentence on a trainer that cannot be used.
fn trainer(error: &TrainerError) -> String {
    const WORDS: [&str; 2] = ["fremde", "gar nichts"];
    match error {
        TrainerError::Silent => "er meldet sich nicht; ist es ein Rollentrainer mit Direct Connect?".to_owned(),
        TrainerError::Closed => "er hat die Verbindung beendet; ist ein anderes Programm mit ihm verbunden?".to_owned(),
        TrainerError::Wire(error) => error.to_string(),
        TrainerError::NoFitnessMachine(services) => {
            let services = short_numbers(services, WORDS);
            format!(
                "er hat keinen Fitness-Machine-Dienst (1826), sondern {services}; einen Rollentrainer mit FTMS nennen"
            )
        }
        TrainerError::NoBikeData(characteristics) => {
            let characteristics = short_numbers(characteristics, WORDS);
            format!(
                "er sendet keine Fahrraddaten (2ad2), sondern {characteristics}; den Rollentrainer eines Fahrrads \
                 nennen"
            )
        }
        TrainerError::Refused(request, why) => {
            let request = match request {
                TrainerRequest::Services => "nennt seine Dienste nicht",
                TrainerRequest::Characteristics => "nennt nicht, was er an Daten hat",
                TrainerRequest::BikeData => "sendet seine Fahrraddaten nicht",
            };
            format!("er {request}: {}", refusal(*why))
        }
        TrainerError::System(text) => text.clone(),
    }
}

/// Reason why a trainer refuses a request.
fn refusal(refusal: RequestRefusal) -> &'static str {
    match refusal {
        RequestRefusal::Kind => "diese Art von Nachricht kennt er nicht",
        RequestRefusal::Service => "diesen Dienst hat er nicht",
        RequestRefusal::Characteristic => "dieses Merkmal hat er nicht",
        RequestRefusal::Operation => "das Merkmal erlaubt es nicht",
        RequestRefusal::Value => "den Wert lehnt er ab",
        RequestRefusal::Unnamed => "er meldet einen Fehler ohne Grund",
    }
}

/// Sentence on a device that is open and yet does not do all that it should.
pub fn note(note: DeviceNote) -> String {
    let why = match note {
        DeviceNote::NoControlPoint => {
            return "der Rollentrainer nimmt keine Befehle an (ihm fehlt der Control Point 2ad9): seine Bremse folgt \
                    der Straße nicht"
                .to_owned();
        }
        DeviceNote::NoControl(ControlRefusal::Taken) => "ein anderes Programm steuert ihn; es beenden",
        DeviceNote::NoControl(ControlRefusal::NoSlope) => "er kann keine Steigung nachbilden",
        DeviceNote::NoControl(ControlRefusal::Result(result)) => &format!("er antwortet mit Ergebnis {result}"),
        DeviceNote::NoControl(ControlRefusal::Write(why)) => refusal(why),
    };
    format!("der Rollentrainer lässt sich nicht steuern ({why}): seine Bremse folgt der Straße nicht")
}

#[cfg(test)]
mod tests {
    //! Law: whatever a device may be in has a German sentence, which is another than the English one and names the same
    //! port, host, program and number. The compiler asks for a sentence of each; a wrong one is a copy of the English,
    //! or loses what it is about.

    use super::*;
    use crate::heard::{fault as fault_in, note as note_in};
    use words::Language;

    /// A fault of each kind, but for those that are made of others, with what its sentence must name.
    fn faults() -> Vec<(DeviceFault, &'static str)> {
        let text = str::to_owned;
        let forbidden =
            DeviceFault::SpaceMouseForbidden { name: text("Puck"), path: text("/x"), reason: text("EACCES") };
        let refused = |request| DeviceFault::Trainer(TrainerError::Refused(request, RequestRefusal::Service));
        vec![
            (DeviceFault::Sought, ""),
            (DeviceFault::ProgramEnds, ""),
            (DeviceFault::NoGamepad, "amepad"),
            (DeviceFault::GamepadForbidden(text("/x")), "/x"),
            (DeviceFault::NoSerialPort(text("/x")), "/x"),
            (DeviceFault::SerialPortForbidden(text("/x")), "usermod -aG dialout"),
            (DeviceFault::SerialPort(text("/x"), text("EIO")), "EIO"),
            (DeviceFault::NoHidList(text("EIO")), "EIO"),
            (DeviceFault::NoSpaceMouse, "SpaceMouse"),
            (forbidden, UDEV_RULE.0),
            (DeviceFault::SpacenavdRefuses(text("/x"), text("EIO")), "/x"),
            (DeviceFault::NoSpacenavd(text("/x, /y")), "/x, /y"),
            (DeviceFault::NeverSpacenavd(text(" (/x)")), " (/x)"),
            (DeviceFault::PortTaken("opentrack", text("0.0.0.0:4242")), "opentrack"),
            (DeviceFault::NotOurAddress(text("10.0.0.1:5000")), "10.0.0.1:5000"),
            (DeviceFault::NoInterface, ""),
            (DeviceFault::NoHost(text("cave"), text("EAI")), "\"cave\""),
            (DeviceFault::NoAddress, ""),
            (DeviceFault::NoVrpnThere, "VRPN"),
            (DeviceFault::NoTrainerThere, ""),
            (DeviceFault::NothingThere, ""),
            (DeviceFault::NoGreeting, "VRPN"),
            (DeviceFault::Silent(10), "10 s"),
            (DeviceFault::SilentWithoutDevices(10), "10 s"),
            (DeviceFault::SilentWithOthers(10, text("Head")), "Head"),
            (DeviceFault::Trainer(TrainerError::Silent), "Direct Connect"),
            (DeviceFault::Trainer(TrainerError::Closed), ""),
            (DeviceFault::Trainer(TrainerError::NoFitnessMachine(vec![])), "1826"),
            (DeviceFault::Trainer(TrainerError::NoBikeData(vec![Some(0x2ad3), None])), "2ad3"),
            (refused(TrainerRequest::Services), ""),
            (refused(TrainerRequest::Characteristics), ""),
            (refused(TrainerRequest::BikeData), ""),
        ]
    }

    fn differ(english: &str, german: &str, named: &str) {
        assert!(english.contains(named) && german.contains(named), "{english:?}, {german:?}: {named:?}");
        assert!(!german.is_empty() && german != english, "{german:?}");
    }

    #[test]
    fn every_fault_has_a_sentence_in_each_language() {
        for (each, named) in faults() {
            differ(&each.to_string(), &fault(&each), named);
            assert_eq!(fault_in(&each, Language::English), each.to_string());
            // What is made of it says it in the same language.
            let inner = || Box::new(each.clone());
            for outer in [
                DeviceFault::Gone(inner()),
                DeviceFault::Deaf("/y".to_owned(), inner()),
                DeviceFault::NoVrpnServer("/y".to_owned(), inner()),
                DeviceFault::NoTrainer("/y".to_owned(), inner()),
            ] {
                differ(&outer.to_string(), &fault_in(&outer, Language::German), named);
                assert!(fault(&outer).contains(&fault(&each)), "{outer}");
            }
            for outer in [DeviceFault::At("/y".to_owned(), inner()), DeviceFault::Both(inner(), inner())] {
                assert!(fault(&outer).contains(&fault(&each)), "{outer}");
            }
        }
        // What others say stays as they say it.
        assert_eq!(fault(&DeviceFault::System("EIO".to_owned())), "EIO");
        assert_eq!(fault(&DeviceFault::Trainer(TrainerError::System("EIO".to_owned()))), "EIO");
    }

    #[test]
    fn every_note_has_a_sentence_in_each_language() {
        let writes = (0..8).map(|response| ControlRefusal::Write(RequestRefusal::of(response)));
        let refusals = [ControlRefusal::Taken, ControlRefusal::NoSlope, ControlRefusal::Result(4)].into_iter();
        let notes = refusals.chain(writes).map(DeviceNote::NoControl).chain([DeviceNote::NoControlPoint]);
        for each in notes {
            assert_eq!(note_in(each, Language::English), each.to_string());
            differ(&each.to_string(), &note_in(each, Language::German), "");
        }
        let four = note(DeviceNote::NoControl(ControlRefusal::Result(4)));
        assert!(four.contains('4'), "{four}");
        for source in SampleSource::ALL {
            assert!(!super::source(source).is_empty(), "{source}");
        }
    }
}
