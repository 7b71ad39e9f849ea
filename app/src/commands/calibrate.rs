//! `rapidity devices --calibrate`: walks through the calibration of a bicycle, and writes its set-up file.

use crate::commands::bicycle_file::{document, write};
use crate::commands::calibrating_error::{CalibratingError, FIRST_LINE};
use crate::error::Error;
use crate::output::say::say;
use crate::session::interrupt::interrupted;
use hardware::{BicyclePort, SetUp};
use input::bicycle::{BicycleLineKind, BicyclePositions, RawReadings, SteadyReading};
use input::devices::{DeviceState, Devices, DevicesConfig};
use input::{BicycleConfig, Clock, DeskConfig, Signal};
use picture_files::files::{WriteError, whole, writable};
use std::io::{IsTerminal, Write};
use std::path::Path;
use std::sync::Arc;
use std::sync::atomic::{AtomicBool, Ordering};
use std::sync::mpsc::{Receiver, RecvTimeoutError, channel};
use std::thread;
use std::time::{Duration, Instant};

/// Time between two looks at the box.
const INTERVAL: Duration = Duration::from_millis(100);
/// Time for which a position is read once the rider holds it.
const READING: Duration = Duration::from_millis(700);
/// Angle of the handlebar that is asked for, degrees.
const ANGLE_DEG: f64 = 45.0;

/// Conversation with the rider, beside the live readings.
struct Dialogue {
    /// Port of the bicycle.
    port: String,
    devices: Devices,
    readings: RawReadings,
    answers: Receiver<String>,
    stop: Arc<AtomicBool>,
    terminal: bool,
}

/// Walks through the calibration of the bicycle at `port` and writes `file`; tables of others in it stay.
///
/// # Errors
/// A box that cannot be read, answers that end, or a file that cannot be written.
pub fn calibrate(file: &Path, set_up: &SetUp, port: BicyclePort) -> Result<(), Error> {
    writable(file)?;
    let mut document = document(file)?;
    let name = port.port.clone().ok_or(CalibratingError::NoPort)?;
    let before = set_up.desk()?.bicycle;
    let mut dialogue = Dialogue::begin(&name, port.baud)?;
    say(format_args!("The bicycle at {name} is calibrated. Enter goes on, Ctrl-C ends without a file."))?;
    let kind = dialogue.first_line()?;
    let positions = dialogue.walk(kind, &before)?;
    let config = positions.settings(&before).map_err(CalibratingError::from)?;
    let desk = DeskConfig { bicycle: config.clone(), ..DeskConfig::default() };
    desk.check().map_err(CalibratingError::from)?;
    if positions.is_askew() {
        say("Straight ahead is not 0, which a line of four fields has to say: set the zero in the box.")?;
    }
    if positions.kind == BicycleLineKind::Pulses && positions.pulses_per_turn == [0, 0] {
        say("Neither the wheel nor the pedals sent a pulse: what the speed is made from stays as it was.")?;
    }
    if positions.is_lopsided() {
        say(
            "The sensor goes much further to one side than to the other: was the handlebar straight, and were the angles right?",
        )?;
    }
    write(&mut document, &name, port.baud, &config);
    let text = document.to_string();
    whole(file, |temporary| std::fs::write(temporary, &text)).map_err(|error| WriteError::new(file, error))?;
    let file = file.display();
    say(format_args!(
        "Written: {file}. Check it with `rapidity devices --set-up {file}`, ride with `rapidity ride --set-up {file}`."
    ))?;
    Ok(())
}

impl Dialogue {
    fn begin(port: &str, baud: Option<u32>) -> Result<Self, Error> {
        let usual = DevicesConfig::default();
        let config = DevicesConfig {
            bicycle: Some(port.to_owned()),
            baud: baud.unwrap_or(usual.baud),
            space_mouse: false,
            gamepad: false,
            ..usual
        };
        let (answered, answers) = channel();
        // The thread ends with the program: nothing wakes a reader of standard input.
        thread::spawn(move || {
            let lines = std::io::stdin().lines().map_while(Result::ok);
            lines.map_while(|line| answered.send(line).ok()).for_each(drop);
        });
        Ok(Self {
            port: port.to_owned(),
            devices: Devices::open(&config, Clock::start())?,
            readings: RawReadings::default(),
            answers,
            stop: interrupted(),
            terminal: std::io::stdout().is_terminal(),
        })
    }

    /// Takes what the box has sent.
    fn look(&mut self) {
        for sample in self.devices.drain() {
            if let Signal::Bytes(bytes) = &sample.signal {
                self.readings.bytes(bytes);
            }
        }
    }

    /// Kind of the box's lines, once one is good.
    fn first_line(&mut self) -> Result<BicycleLineKind, CalibratingError> {
        let began = Instant::now();
        loop {
            self.look();
            match self.readings.kind() {
                Some(BicycleLineKind::Bare) => return Err(CalibratingError::Bare { port: self.port.clone() }),
                Some(kind) => return Ok(kind),
                None if began.elapsed() > FIRST_LINE => return Err(self.silent()),
                None if self.stop.load(Ordering::Relaxed) => return Err(CalibratingError::Ended),
                None => thread::sleep(INTERVAL),
            }
        }
    }

    /// Error of a box that sends no good line, with the reason.
    fn silent(&self) -> CalibratingError {
        let state = self.devices.status().into_iter().next().map(|status| status.state);
        let why = match (state, self.readings.last_fault()) {
            (Some(DeviceState::Absent(why)), _) => why.to_string(),
            (_, Some(fault)) => fault.to_owned(),
            _ => "it is silent; is the box on, and the baud rate right?".to_owned(),
        };
        CalibratingError::Silent { port: self.port.clone(), why }
    }

    /// Asks for an answer, and shows live values until it comes.
    fn ask(&mut self, question: &str, live: impl Fn(&RawReadings) -> String) -> Result<String, Error> {
        say(format_args!("\n{question}"))?;
        let mut out = std::io::stdout();
        loop {
            self.look();
            if self.terminal {
                write!(out, "\r\x1b[K  {}  > ", live(&self.readings))?;
                out.flush()?;
            }
            match self.answers.recv_timeout(INTERVAL) {
                _ if self.stop.load(Ordering::Relaxed) => return Err(CalibratingError::Ended.into()),
                Ok(answer) => return Ok(answer.trim().to_owned()),
                Err(RecvTimeoutError::Timeout) => {}
                Err(RecvTimeoutError::Disconnected) => return Err(CalibratingError::Ended.into()),
            }
        }
    }

    /// Asks for a number; an empty answer is the usual one.
    fn number(&mut self, question: &str, usual: f64, live: impl Fn(&RawReadings) -> String) -> Result<f64, Error> {
        loop {
            let answer = self.ask(question, &live)?;
            if answer.is_empty() {
                return Ok(usual);
            }
            match answer.replace(',', ".").parse::<f64>() {
                Ok(number) if (1e-3..=1e3).contains(&number) => return Ok(number),
                _ => say(format_args!("{answer:?} is no number from 0.001 to 1000; Enter alone takes {usual}"))?,
            }
        }
    }

    /// Reads a position that the rider holds: steering and brake.
    fn hold(&mut self) -> Result<[SteadyReading; 2], CalibratingError> {
        self.readings.settle();
        let began = Instant::now();
        while began.elapsed() < READING {
            thread::sleep(INTERVAL);
            self.look();
            if self.stop.load(Ordering::Relaxed) {
                return Err(CalibratingError::Ended);
            }
        }
        match (self.readings.steer(), self.readings.brake()) {
            (Some(steer), Some(brake)) => Ok([steer, brake]),
            _ => Err(self.silent()),
        }
    }

    /// Walks through the positions, and reads each.
    fn walk(&mut self, kind: BicycleLineKind, before: &BicycleConfig) -> Result<BicyclePositions, Error> {
        let steer = |readings: &RawReadings| format!("steering sensor {}", shown(readings.steer()));
        let brake = |readings: &RawReadings| format!("brake sensor {}", shown(readings.brake()));
        let pulses = |readings: &RawReadings| {
            let [wheel, crank] = readings.pulses();
            format!("pulses: wheel {wheel}, crank {crank}")
        };

        self.ask("1. Hold the handlebar straight, let go of the brake, and press Enter.", steer)?;
        let [straight, released] = self.hold()?;

        let mut sides = Vec::new();
        for (step, side) in [(2, "left"), (3, "right")] {
            let question = format!(
                "{step}. Turn the handlebar {ANGLE_DEG} degrees to the {side}, hold it there, and press Enter; or type the angle at \
                 which you hold it. (No sensor there? Type none.)"
            );
            let degrees = loop {
                let answer = self.ask(&question, steer)?;
                match answer.replace(',', ".").parse::<f64>() {
                    _ if answer.is_empty() => break Some(ANGLE_DEG),
                    _ if answer.eq_ignore_ascii_case("none") => break None,
                    Ok(degrees) if (1.0..=120.0).contains(&degrees) => break Some(degrees),
                    _ => say(format_args!("{answer:?} is no angle from 1 to 120 degrees"))?,
                }
            };
            let Some(degrees) = degrees else { break };
            let [reading, _] = self.hold()?;
            sides.push((reading.median, degrees.to_radians()));
        }

        let question = "4. Pull the brake lever through, and press Enter. (No sensor there? Type none.)";
        let has_brake = loop {
            match self.ask(question, brake)?.to_ascii_lowercase().as_str() {
                "" => break true,
                "none" => break false,
                answer => say(format_args!("{answer:?} is neither Enter alone nor none"))?,
            }
        };
        let pulled = if has_brake { Some(self.hold()?[1]) } else { None };

        let pulses_per_turn = if kind == BicycleLineKind::Pulses { self.turns(pulses)? } else { [0, 0] };
        let [wheel, crank] = pulses_per_turn;
        let metres = |what: &str, usual: f64| format!("How many metres is one turn of the {what}? [{usual}]");
        let per_wheel =
            self.number(&metres("wheel", before.wheel_circumference_m), before.wheel_circumference_m, pulses)?;
        let per_crank = if wheel == 0 && crank > 0 {
            let usual = before.metres_per_crank_turn;
            say("The wheel sends nothing, so the speed is made from the pedals.")?;
            self.number(&metres("pedals", usual), usual, pulses)?
        } else {
            before.metres_per_crank_turn
        };
        Ok(BicyclePositions {
            kind,
            straight,
            left: sides.first().copied(),
            right: sides.get(1).copied(),
            brake: pulled.map(|pulled| [released, pulled]),
            pulses_per_turn,
            metres_per_turn: [per_wheel, per_crank],
        })
    }

    /// Pulses in one turn of the wheel, and of the crank.
    fn turns(&mut self, pulses: impl Fn(&RawReadings) -> String) -> Result<[u64; 2], Error> {
        let still = self.readings.pulses();
        self.ask(
            "5. Turn the wheel by one whole turn, with the pedals at rest if they can be, and press Enter.",
            &pulses,
        )?;
        self.hold()?;
        let turned = self.readings.pulses();
        self.ask("6. Turn the pedals by one whole turn, and press Enter.", &pulses)?;
        self.hold()?;
        let pedalled = self.readings.pulses();
        Ok([turned[0] - still[0], pedalled[1] - turned[1]])
    }
}

fn shown(reading: Option<SteadyReading>) -> String {
    reading.map_or_else(|| "silent".to_owned(), |reading| format!("{}", reading.median))
}
